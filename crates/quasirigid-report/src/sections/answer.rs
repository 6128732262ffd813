//! The answer in four numbers.

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{HistoryRecord, RunRecord};

use super::dissipation::bars;
use crate::columns::{column, ends, main_history, norm, vectors};
use crate::number::{digits, duration, percent, short, tidy};

/// Drift up to this part of the dissipation is called small.
const SMALL_DRIFT: f64 = 0.01;

/// Spin at the start and at the end, energy dissipated, the integrator's own drift beside it, and revolutions.
pub fn section(record: &RunRecord) -> Markup {
    html! {
        section.answer aria-label="Result" {
            h2 { "Result" }
            @match main_history(record) {
                None => p.absent {
                    "The record holds no spin history: nothing was propagated"
                    @if record.evolution.is_some() { " turn by turn" } "."
                },
                Some(history) => {
                dl {
                    (spin(record.body.kind, history))
                    (dissipation(record, history))
                    (drift(history))
                    (revolutions(history))
                }
                (bars("What dissipated", &history.dissipation))
                },
            }
        }
    }
}

/// A number large enough to be read first, with its name and a remark.
pub fn tile(name: &str, value: Markup, remark: Markup) -> Markup {
    html! { div { dt { (name) } dd.value { (value) } dd.remark { (remark) } } }
}

fn spin(kind: BodyKind, history: &HistoryRecord) -> Markup {
    let omega = vectors(&history.columns, ["wx", "wy", "wz"]).unwrap_or_default();
    let nutation =
        column(&history.columns, "nutation_max").and_then(|column| ends(column.values.iter().copied()));
    let Some((start, end)) = ends(omega.iter().map(|&omega| norm(omega))) else {
        return tile("Spin, start → end", html! { "unknown" }, html! { "no rows with wx, wy, wz" });
    };
    let value = html! { (digits(start, 4)) " → " (digits(end, 4)) small { " rad/s" } };
    tile(
        "Spin, start → end",
        value,
        html! {
            @if let Some((start, end)) = nutation {
                (kind.nutation()) " " (digits(start.to_degrees(), 3)) "° → " (digits(end.to_degrees(), 3)) "°"
            } @else {
                "angular rate |ω|"
            }
        },
    )
}

fn dissipation(record: &RunRecord, history: &HistoryRecord) -> Markup {
    if let Some(power) = elsewhere(record, history) {
        return tile(
            "Energy dissipated",
            html! { "not in this history" },
            html! { "the dissipation has no equation of motion; over many revolutions it is " (short(power)) " W at the start" },
        );
    }
    let (share, of) = match free_energy(record, history) {
        Some(free) => (history.dissipated / free, "of what it can lose at this |K|"),
        None => (history.dissipated / history.energy, "of the energy at the start"),
    };
    tile(
        "Energy dissipated",
        html! { (short(history.dissipated)) small { " J" } },
        html! {
            @if share.is_finite() { (percent(share)) " " (of) }
        },
    )
}

/// Mean power (W) of dissipators whose laws the equations of a history leave out; none if there are no such dissipators.
fn elsewhere(record: &RunRecord, history: &HistoryRecord) -> Option<f64> {
    let evolution = record.evolution.as_ref()?;
    (history.dissipated == 0.0 && evolution.power > 0.0).then_some(evolution.power)
}

/// Energy above the least that the body can have at its angular momentum, `E − |K|²/2J₃`; none where external forces
/// change that.
fn free_energy(record: &RunRecord, history: &HistoryRecord) -> Option<f64> {
    if column(&history.columns, "work").is_some_and(|work| work.values.iter().any(|&work| work != 0.0)) {
        return None;
    }
    let (angular_momentum, _) = ends(column(&history.columns, "momentum")?.values.iter().copied())?;
    let free = history.energy - 0.5 * angular_momentum * angular_momentum / record.body.principal_moments[2];
    (free > 1e-12 * history.energy.abs()).then_some(free)
}

fn drift(history: &HistoryRecord) -> Markup {
    let of_dissipation = (history.energy_drift / history.dissipated).abs();
    let value = html! { (tidy(history.energy_drift, 2)) small { " J" } };
    tile(
        "Numerical drift of energy",
        value,
        html! {
            @if history.dissipated == 0.0 || !of_dissipation.is_finite() {
                "nothing was dissipated to compare it with"
            } @else if of_dissipation <= SMALL_DRIFT {
                (percent(of_dissipation)) " of the dissipation: small"
            } @else {
                strong.warning { (percent(of_dissipation)) " of the dissipation: too much, tighten the tolerance" }
            }
            @if history.momentum_drift.abs() < f64::EPSILON { "; |K| by less than its rounding" }
            @else { "; |K| by " (tidy(history.momentum_drift, 2)) " relative" }
        },
    )
}

fn revolutions(history: &HistoryRecord) -> Markup {
    let span = column(&history.columns, "t").and_then(|t| Some((ends(t.values.iter().copied())?, t)));
    tile(
        "Revolutions",
        html! { (tidy(history.revolutions, 5)) },
        html! {
            @if let Some(((first, last), column)) = span {
                "in " @if column.unit == "s" { (duration(last - first)) } @else { (short(last - first)) " " (column.unit) }
            }
        },
    )
}
