use maud::{Markup, html};
use quasirigid_io::record::BodyRecord;

use super::table::{facts, first, table};
use crate::number::{aligned, tidy, unit_with_power};

/// Names of internal coordinates shown.
const MAX_NAMES: usize = 24;

/// Mass, centre of mass, inertia and principal axes of the frozen body.
pub fn section(body: &BodyRecord) -> Markup {
    let (names, more) = first(&body.coordinates, MAX_NAMES);
    html! {
        section aria-label="Body" {
            h2 { "The body" }
            (facts("Frozen body", &[
                ("Mass", html! { (tidy(body.mass, 6)) " kg" }),
                ("Centre of mass, in the frame of the file", position(body.center_of_mass)),
                ("Pole, in the frame of the file", position(body.pole)),
                ("Support", html! { (body.support) }),
                ("Internal coordinates", html! {
                    (body.coordinates.len())
                    @if !names.is_empty() { ": " (names.join(", ")) }
                    @if let Some(more) = more { ", " (more) }
                }),
            ]))
            @if let Some(resolution) = &body.resolution { p { "Shape: " (resolution.sentence) } }
            (inertia(body))
            (principal(body))
        }
    }
}

fn position(place: [f64; 3]) -> Markup {
    let (power, [x, y, z]) = aligned_triple(place, 6);
    html! { "(" (x) ", " (y) ", " (z) ")\u{a0}" (unit_with_power(power, "m")) }
}

fn inertia(body: &BodyRecord) -> Markup {
    let (power, entries) = aligned(body.inertia.as_flattened(), 6);
    let caption =
        format!("Inertia about the pole, in the axes of the file [{}]", unit_with_power(power, "kg·m²"));
    table(
        &caption,
        &["", "x", "y", "z"],
        html! {
            @for (axis, row) in ["x", "y", "z"].into_iter().zip(entries.chunks(3)) {
                tr { th scope="row" { (axis) } @for entry in row { td { (entry) } } }
            }
        },
    )
}

fn principal(body: &BodyRecord) -> Markup {
    let (power, moments) = aligned_triple(body.principal_moments, 6);
    let heading = format!("Moment [{}]", unit_with_power(power, "kg·m²"));
    table(
        "Principal moments, ascending, and axes",
        &["Axis", &heading, "x", "y", "z"],
        html! {
            @for (i, moment) in moments.iter().enumerate() {
                tr {
                    th scope="row" { (i + 1) }
                    td { (moment) }
                    @for entry in aligned_triple(body.principal_axes[i], 5).1 { td { (entry) } }
                }
            }
        },
    )
}

fn aligned_triple(values: [f64; 3], significant: usize) -> (i32, [String; 3]) {
    let (power, mut texts) = aligned(&values, significant);
    (power, [0, 1, 2].map(|i| std::mem::take(&mut texts[i])))
}
