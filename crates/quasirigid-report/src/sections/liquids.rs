use maud::{Markup, html};
use quasirigid_io::record::LiquidRecord;

use super::table::{facts, table};
use crate::number::{aligned, digits, tidy, unit_with_power};

/// Effect of each liquid on a slow rotation, or the body that the liquid is equivalent to.
pub fn section(liquids: &[LiquidRecord]) -> Markup {
    html! {
        section aria-label="Liquids" {
            h2 { "Liquids" }
            @for liquid in liquids { (one(liquid)) }
        }
    }
}

fn one(liquid: &LiquidRecord) -> Markup {
    let facts = facts(
        &liquid.name,
        &[
            ("Mass", html! { (tidy(liquid.mass, 5)) " kg" }),
            ("Reynolds number |ω|a²/ν at the initial spin", html! { (digits(liquid.reynolds, 3)) }),
            (
                "a, radius of a ball of liquid that follows as slowly",
                html! { (digits(liquid.radius, 4)) " m" },
            ),
            ("ν, kinematic viscosity", html! { (digits(liquid.viscosity, 4)) " m²/s" }),
            ("Flow", html! { (flow(liquid)) }),
        ],
    );
    html! {
        (facts)
        @match &liquid.equivalent_inertia {
            Some(inertia) => (tensor("Inertia of the equivalent body, in the axes of the file", "kg·m²", inertia)),
            None => (tensor("P of the slow flow, Π = (ρ/ν) P, in the axes of the file", "m⁷", &liquid.P)),
        }
    }
}

fn flow(liquid: &LiquidRecord) -> String {
    match (liquid.equivalent_inertia, liquid.errors) {
        (Some(_), _) => "ideal behind a boundary layer".into(),
        (None, None) => "viscous, exact".into(),
        (None, Some(errors)) => {
            let worst = errors.into_iter().fold(0.0, f64::max);
            format!("viscous, found numerically, in error by about {} %", digits(100.0 * worst, 1))
        }
    }
}

fn tensor(caption: &str, unit: &str, entries: &[[f64; 3]; 3]) -> Markup {
    let largest = entries.as_flattened().iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let clean = |entry: &f64| if entry.abs() > ENTRY_ROUNDING * largest { *entry } else { 0.0 };
    let values: Vec<f64> = entries.as_flattened().iter().map(clean).collect();
    let (power, texts) = aligned(&values, 6);
    table(
        &format!("{caption} [{}]", unit_with_power(power, unit)),
        &["", "x", "y", "z"],
        html! {
            @for (axis, row) in ["x", "y", "z"].into_iter().zip(texts.chunks(3)) {
                tr { th scope="row" { (axis) } @for entry in row { td { (entry) } } }
            }
        },
    )
}

/// Entries below this share of the largest are rounding.
const ENTRY_ROUNDING: f64 = 1e-12;
