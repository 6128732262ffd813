//! The answer of a run in words.

use std::fmt::{self, Write};
use std::path::Path;

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, HistoryRecord, RunRecord};
use quasirigid_io::visible::one_line;

use crate::layout::paragraph;
use crate::spark::spark;
use crate::verification;
use crate::words::{dissipation, significant, time};

/// The answer of a run for a terminal of 80 columns, and the place of its record.
pub fn text(record: &RunRecord, path: &Path) -> String {
    format!("{}\nRecord and report: {}\n", answer(record), path.join("report.html").display())
}

/// The answer of a run for a terminal of 80 columns.
pub fn answer(record: &RunRecord) -> String {
    let mut text = String::new();
    write(&mut text, record).expect("a string takes any text");
    text
}

fn write(out: &mut String, record: &RunRecord) -> fmt::Result {
    writeln!(
        out,
        "{}",
        paragraph(&format!("{}: {}", one_line(&record.model.name), record.validity.verdict), "", "  ")
    )?;
    for criterion in record.validity.criteria.iter().filter(|each| each.verdict == "fails") {
        writeln!(out, "{}", paragraph(&criterion.sentence, "  - ", "    "))?;
    }
    if let Some(about) = &record.about_spin {
        writeln!(out, "{}", paragraph(&about.sentence, "  + ", "    "))?;
    }
    if record.validity.valid {
        let residual = significant(record.reduction.residual, 2);
        let order = record.reduction.order;
        writeln!(out, "  Put into the full equations, order {order} leaves {residual} of the load.")?;
    }
    for note in &record.notes {
        writeln!(out, "{}", paragraph(note, "  Note: ", "  "))?;
    }
    for history in &record.histories {
        write_history(out, record.body.kind, history)?;
    }
    if let Some(evolution) = &record.evolution {
        writeln!(
            out,
            "\n{}",
            paragraph(&format!("Over many revolutions: {}", evolution.sentence), "", "  ")
        )?;
        if evolution.status == "finished" {
            write_nutation(out, record.body.kind, &evolution.columns)?;
        }
    }
    if let Some(verification) = &record.verification {
        write!(out, "\n{}", verification::text("Verification", verification))?;
    }
    Ok(())
}

fn write_history(out: &mut String, kind: BodyKind, history: &HistoryRecord) -> fmt::Result {
    let last = |name: &str| {
        let column = history.columns.iter().find(|column| column.name == name);
        column.and_then(|column| column.values.last().copied()).unwrap_or(f64::NAN)
    };
    let first = |name: &str| {
        let column = history.columns.iter().find(|column| column.name == name);
        column.and_then(|column| column.values.first().copied()).unwrap_or(f64::NAN)
    };
    let spin = ["wx", "wy", "wz"];
    let vector = |value: &dyn Fn(&str) -> f64| {
        spin.map(|name| format!("{:>12}", significant(value(name), 6))).join(" ")
    };
    let revolutions = significant(history.revolutions, 6);
    let title = format!(
        "{} body, {} ({revolutions} revolutions; {})",
        history.system,
        time(last("t")),
        history.message
    );
    writeln!(out, "\n{}", paragraph(&title, "", "  "))?;
    writeln!(out, "  spin at the start  {} rad/s", vector(&first))?;
    writeln!(out, "  spin at the end    {} rad/s", vector(&last))?;
    let degrees = |value: f64| significant(value.to_degrees(), 5);
    let angles = [degrees(first("nutation_max")), degrees(last("nutation_max"))];
    let axes = [first("circled_axis"), last("circled_axis")];
    let greatest = format!("{}, greatest", kind.nutation());
    writeln!(out, "  {greatest:<18} {}", nutation(&angles, axes))?;
    write_nutation(out, kind, &history.columns)?;
    writeln!(
        out,
        "  energy dissipated  {:>12} J of {} J",
        significant(history.dissipated, 5),
        significant(history.energy, 6)
    )?;
    if let Some(text) = dissipation(&history.dissipation) {
        writeln!(out, "{}", paragraph(&text, "  ", "      "))?;
    }
    let of_momentum = if history.form.starts_with("spin") { "of |K|, truncation included" } else { "of |K|" };
    writeln!(
        out,
        "  numerical drift    {:>12} J; {} {of_momentum}",
        significant(history.energy_drift, 2),
        significant(history.momentum_drift, 2)
    )
}

/// The greatest nutation against time, where it changes.
fn write_nutation(out: &mut String, kind: BodyKind, columns: &[Column]) -> fmt::Result {
    let named =
        |name: &str| columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice());
    match named("t").zip(named("nutation_max")).and_then(|(times, angles)| spark(times, angles)) {
        Some(line) => writeln!(out, "  {:<20} {line}", format!("{} over time", kind.nutation())),
        None => Ok(()),
    }
}

/// The greatest angles at the start and at the end, with the principal axes that are circled where these differ.
fn nutation([start, end]: &[String; 2], axes: [f64; 2]) -> String {
    match axes {
        [from, to] if from.is_finite() && to.is_finite() && from != to => {
            format!("{start:>12} degrees about axis {from} to {end} about axis {to}")
        }
        _ if start == "NaN" || end == "NaN" => {
            "not known: no steady spin is circled at the start or at the end".into()
        }
        _ => format!("{start:>12} to {end} degrees"),
    }
}
