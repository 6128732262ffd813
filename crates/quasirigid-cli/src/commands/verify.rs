use std::fmt::{self, Write};
use std::ops::ControlFlow;

use quasirigid::verification::{OrderRow, Plan, Verification, VerificationError};
use serde_json::json;

use super::{Loaded, initial, load, notes};
use crate::args::Verify;
use crate::describe::{significant, time};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layout::paragraph;
use crate::motion::Motion;
use crate::progress::Bar;
use crate::{Ending, output};

/// Sets the full system against the reduced equations, and prints the differences with their order.
pub fn verify(arguments: &Verify) -> Result<Ending, Failure> {
    let Loaded { model, body, forces, order } = &load(&arguments.common)?;
    notes(model, &arguments.common);
    let start = initial(model, &arguments.common.model)?;
    let motion = Motion::new(model, body, forces, *order, start);
    let asked = model.run.verify.clone().unwrap_or_default();
    let defaults = Plan::default();
    let plan = Plan {
        orders: arguments.orders.clone().or(asked.orders).unwrap_or_else(|| (1..=*order).collect()),
        rotations: arguments.rotations.or(asked.rotations).unwrap_or(defaults.rotations),
        halvings: arguments.halvings.or(asked.halvings).unwrap_or(defaults.halvings),
        ..defaults
    };
    let interrupt = Interrupt::listen()?;
    let bar = Bar::new("verifying", arguments.common.quiet);
    let mut watch = |share: f64| {
        bar.show(share);
        if interrupt.pressed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let result = quasirigid::verification::verify(motion.system(), &motion.start, &plan, &mut watch);
    bar.clear();
    let verification = match result {
        Err(VerificationError::Interrupted) => return Err(Failure::Interrupted),
        other => other?,
    };
    if arguments.common.json {
        output::print(&object(&verification))?;
    } else {
        let mut text = String::new();
        write_text(&mut text, &model.name, &plan, &verification).expect("a string takes any text");
        output::print(&text)?;
    }
    Ok(if verification.reached() { Ending::Done } else { Ending::CheckFailed })
}

fn object(verification: &Verification) -> String {
    let row = |row: &OrderRow| {
        let of = |value: fn(&quasirigid::verification::Difference) -> f64| -> Vec<f64> {
            row.differences.iter().map(value).collect()
        };
        json!({
            "p": row.p,
            "order": row.order,
            "expected": row.p + 1,
            "reached": row.reached(),
            "epsilons": verification.epsilons,
            "errors": of(|difference| difference.omega),
            "attitude": of(|difference| difference.attitude),
            "dissipated": of(|difference| difference.dissipated),
            "dissipation": of(|difference| difference.dissipation),
        })
    };
    let object = json!({
        "reached": verification.reached(),
        "duration": verification.duration,
        "orders": verification.rows.iter().map(row).collect::<Vec<_>>(),
    });
    format!("{object:#}\n")
}

fn write_text(out: &mut String, name: &str, plan: &Plan, verification: &Verification) -> fmt::Result {
    let title = format!(
        "{name}: the full system against the reduced equations over {} rotations ({}), from the slow manifold, with \
         stiffness C/e^2 and damping B/e.",
        significant(plan.rotations, 4),
        time(verification.duration)
    );
    writeln!(out, "{}", paragraph(&title, "", "  "))?;
    writeln!(out, "\n  Largest difference in spin, relative to the spin")?;
    write!(out, "   p")?;
    for k in 0..verification.epsilons.len().min(COLUMNS) {
        write!(out, " {:>9}", format!("e = 1/{}", 1u64 << k))?;
    }
    writeln!(out, "   order (expected)")?;
    for row in &verification.rows {
        write!(out, "  {:>2}", row.p)?;
        for difference in row.differences.iter().take(COLUMNS) {
            write!(out, " {:>9.2e}", difference.omega)?;
        }
        let order = row.order.map_or("below rounding".into(), |order| format!("{order:.3}"));
        writeln!(out, "   {order} ({}){}", row.p + 1, if row.reached() { "" } else { " NOT REACHED" })?;
    }
    writeln!(out, "\n  At the model's own stiffness, at most")?;
    writeln!(out, "   p      spin   attitude    energy dissipated")?;
    for row in &verification.rows {
        let Some(own) = row.differences.first() else { continue };
        let attitude = format!("{:.2e} deg", own.attitude.to_degrees());
        let taken = format!("{:.2e} J of {:.4e} J", own.dissipated, own.dissipation);
        writeln!(out, "  {:>2} {:>9.2e}   {attitude}   {taken}", row.p, own.omega)?;
    }
    let verdict =
        if verification.reached() { "Every order is reached." } else { "NOT EVERY ORDER IS REACHED." };
    writeln!(out, "\n{verdict}")
}

/// Columns that fit a terminal.
const COLUMNS: usize = 5;
