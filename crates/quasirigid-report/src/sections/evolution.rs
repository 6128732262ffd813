//! Section on the secular evolution: its answer, nutation and power against time, harmonics, resonances and details.
//! The reduced power is drawn beside the one that was followed, because their distance shows where the reduced equations miss resonances.
//! Record: `EvolutionRecord` of quasirigid-io; theory in docs/theory/10-torque-free.md and (G5) to (G8), docs/theory/11-materials.md.

use std::f64::consts::TAU;

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{
    ApproachRecord, CrossingRecord, EstimateRecord, EvolutionRecord, HarmonicRecord, ObservedRecord,
};

use super::answer::tile;
use super::dissipation::bars;
use super::table::{facts, first, table};
use crate::figures::evolution::{harmonics as harmonics_figure, map, nutation, power as power_figure};
use crate::number::{digits, duration, percent, short, tidy};
use crate::verdict::Verdict;

/// Harmonics and resonances shown.
const MAX_LISTED: usize = 12;
/// Relative error of a time below which the error is not mentioned.
const EXACT: f64 = 1e-6;

/// The rotation over many revolutions: the answer, its numbers, nutation and power against time, and the dissipators.
pub fn section(kind: BodyKind, evolution: &EvolutionRecord) -> Markup {
    if evolution.status == "refused" {
        return html! { section aria-label="Over many revolutions" { h2 { "Over many revolutions" } (sentence(evolution)) } };
    }
    html! {
        section aria-label="Over many revolutions" {
            h2 { "Over many revolutions" }
            (sentence(evolution))
            @if let Some(seconds) = evolution.separatrix_time.filter(|seconds| seconds.is_finite()) {
                p { (separatrix(evolution, seconds)) }
            }
            dl {
                (time(evolution))
                (revolutions(evolution))
                @if of_axes(evolution) { (mode(evolution)) }
                (power(evolution))
            }
            (nutation(kind, evolution).draw())
            (power_figure(kind, evolution).draw())
            @if of_axes(evolution) { (map(kind, evolution).draw()) }
            (bars("Dissipation shares at the start", &evolution.dissipation))
            @if !evolution.harmonics.is_empty() { (harmonics_figure(kind, evolution).draw()) }
            @if of_axes(evolution) {
                (harmonics(kind, &evolution.harmonics))
                (resonances(kind, &evolution.resonances, evolution.approach.as_ref()))
            }
            (details(kind, evolution))
        }
    }
}

/// The answer, under a warning with the reason where the evolution ended before its target.
fn sentence(evolution: &EvolutionRecord) -> Markup {
    let (verdict, words) = match evolution.status.as_str() {
        "finished" => {
            return html! {
                p.lead { (evolution.sentence) }
                @if !evolution.verdict.is_empty() { p { (evolution.verdict) } }
            };
        }
        "refused" => (Verdict::Fails, "No answer."),
        "does-not-hold" => (Verdict::Fails, "This does not hold."),
        "interrupted" => (Verdict::Marginal, "Interrupted."),
        "failed" | "step-limit" => (Verdict::Fails, "Failed."),
        _ => (Verdict::Marginal, "Ended early."),
    };
    html! {
        div.verdict.(verdict.class()) {
            (verdict.icon())
            p { strong { (words) } " " (evolution.message) " " (evolution.sentence) " " (evolution.verdict) }
        }
    }
}

fn separatrix(evolution: &EvolutionRecord, seconds: f64) -> Markup {
    let [start, end] = [&evolution.mode_start, &evolution.mode_end].map(|mode| axis(mode));
    html! {
        "It reaches the separatrix after " (duration(seconds))
        @match (evolution.status.as_str(), start, end) {
            ("held", ..) => " and is held there.",
            (_, Some(start), Some(end)) if start != end => {
                ": there the angular momentum leaves the axis of " (start) " inertia and circles that of " (end) "."
            }
            _ => ".",
        }
    }
}

/// Whether the angular momentum circles axes of inertia, as it does without momentum wheels.
fn of_axes(evolution: &EvolutionRecord) -> bool {
    axis(&evolution.mode_end).is_some()
}

/// The axis that the angular momentum circles in a mode.
fn axis(mode: &str) -> Option<&'static str> {
    match mode {
        "long-axis" => Some("least"),
        "short-axis" => Some("greatest"),
        _ => None,
    }
}

fn time(evolution: &EvolutionRecord) -> Markup {
    let remark = match evolution.time_range {
        None => match evolution.time_error {
            Some(error) if error >= EXACT => format!("good to {}", percent(error)),
            _ => String::new(),
        },
        Some([least, f64::INFINITY]) => {
            format!("{} at the least, over the ranges of the materials", until(least))
        }
        Some([least, greatest]) => {
            format!("{} to {} over the ranges of the materials", until(least), until(greatest))
        }
    };
    let title = if evolution.status == "finished" { "End reached after" } else { "Followed for" };
    tile(title, html! { (until(evolution.time)) }, html! { (remark) })
}

fn revolutions(evolution: &EvolutionRecord) -> Markup {
    tile("Revolutions", html! { (tidy(evolution.revolutions, 3)) }, html! { "about the angular momentum" })
}

fn mode(evolution: &EvolutionRecord) -> Markup {
    let EvolutionRecord { mode_start, mode_end, ratio_start, ratio_end, separatrix_time, .. } = evolution;
    tile(
        "Mode, start → end",
        html! {
            @if mode_start == mode_end && separatrix_time.is_none() { (mode_start) small { " throughout" } }
            @else { (mode_start) " → " (mode_end) }
        },
        html! { i { "D" } "/" i { "I" } "₃ = " (tidy(*ratio_start, 5)) " → " (tidy(*ratio_end, 5)) },
    )
}

fn power(evolution: &EvolutionRecord) -> Markup {
    tile(
        "Mean power at the start",
        html! { (tidy(evolution.power, 3)) small { " W" } },
        html! { "at the angular momentum " (short(evolution.angular_momentum)) " N m s" },
    )
}

/// A time to an event, or "never" where it is infinite.
fn until(seconds: f64) -> String {
    if seconds == f64::INFINITY { "never".into() } else { duration(seconds) }
}

fn harmonics(kind: BodyKind, harmonics: &[HarmonicRecord]) -> Markup {
    if harmonics.is_empty() {
        return html! { p.absent { "The record holds no harmonics." } };
    }
    let (shown, more) = first(harmonics, MAX_LISTED);
    table(
        &format!("Harmonics of the {} at the start", kind.nutation()),
        &["Number", "Frequency [rad/s]", "Period", "Share in the power"],
        html! {
            @for harmonic in shown {
                tr {
                    th scope="row" { (harmonic.number) }
                    td { (digits(harmonic.frequency, 4)) }
                    td { (duration(TAU / harmonic.frequency)) }
                    td { (percent(harmonic.share)) }
                }
            }
            @if let Some(more) = more { tr { td.remark colspan="4" { (more) } } }
        },
    )
}

fn resonances(kind: BodyKind, crossings: &[CrossingRecord], approach: Option<&ApproachRecord>) -> Markup {
    html! {
        div.resonances {
            @if crossings.is_empty() {
                p {
                    "No harmonic of the " (kind.nutation()) " passes a natural frequency on the way"
                    @if let Some(near) = approach {
                        "; harmonic " (near.harmonic) " comes within " (percent(near.distance.abs())) " of "
                        (digits(near.frequency, 4)) " rad/s, " (near.coordinate)
                    }
                    "."
                }
            } @else {
                (crossing_table(crossings))
            }
        }
    }
}

fn crossing_table(crossings: &[CrossingRecord]) -> Markup {
    let (shown, more) = first(crossings, MAX_LISTED);
    let rows = html! {
        @for crossing in shown {
            tr {
                th scope="row" { (crossing.harmonic) }
                td { (digits(crossing.frequency, 4)) }
                td.word { (crossing.coordinate) }
                td { (digits(crossing.ratio, 5)) }
                td.word { (crossing.mode) }
                td { (percent(crossing.share)) }
            }
        }
        @if let Some(more) = more { tr { td.remark colspan="6" { (more) } } }
    };
    let headings = ["Harmonic", "Frequency [rad/s]", "Coordinate", "D/I₃", "Mode", "Share in the power"];
    table("Resonances on the way, strongest first", &headings, rows)
}

fn details(kind: BodyKind, evolution: &EvolutionRecord) -> Markup {
    let small = |fate: &str| format!("Small {} about the {fate} by e", kind.nutation());
    let [decay, growth, steady] = [
        "axis of greatest inertia, decay",
        "axis of least inertia, growth",
        "steady spin that attracts, decay",
    ]
    .map(small);
    let lingering = match evolution.lingering {
        None => "none: it does not come so near".into(),
        Some(f64::INFINITY) => "infinite".into(),
        Some(seconds) => duration(seconds),
    };
    let mut rows = vec![
        ("Method", html! { (evolution.method) }),
        ("Status", html! { (evolution.status) }),
        ("End", html! { (evolution.message) }),
    ];
    let ends = [("Rotation at the start", evolution.start), ("Rotation at the end", evolution.end)];
    let told = |(place, rotation): (_, Option<ObservedRecord>)| {
        rotation.map(|it| (place, html! { (observed(kind, it)) }))
    };
    rows.extend(ends.into_iter().filter_map(told));
    let damping = html! { (until(evolution.damping_time)) };
    if of_axes(evolution) {
        rows.extend([(&*decay, damping), (&*growth, html! { (until(evolution.growth_time)) })]);
    } else {
        rows.push((&steady, damping));
    }
    if !evolution.estimates.is_empty() {
        rows.push(("Published estimates of the decay", html! { (estimates(&evolution.estimates)) }));
    }
    rows.push(("Time within 1 % of the separatrix", html! { (lingering) }));
    facts("How it ages", &rows)
}

/// Published estimates, one after the other.
fn estimates(estimates: &[EstimateRecord]) -> String {
    let told = |EstimateRecord { source, least, greatest }: &EstimateRecord| {
        if least == greatest {
            return format!("{source} {}", duration(*least));
        }
        format!("{source} {} to {}", duration(*least), duration(*greatest))
    };
    estimates.iter().map(told).collect::<Vec<_>>().join("; ")
}

/// A rotation as observers describe it.
fn observed(kind: BodyKind, rotation: ObservedRecord) -> String {
    let nutation = kind.nutation();
    let spun = |period: f64| if period.is_finite() { duration(period) } else { "none".into() };
    let [least, greatest] =
        [rotation.nutation_least, rotation.nutation_greatest].map(|angle| digits(angle.to_degrees(), 3));
    format!(
        "P_ψ {}, P_φ {}, E/E₀ {}, {nutation} {least} to {greatest} degrees",
        spun(rotation.rotation_period),
        spun(rotation.precession_period),
        digits(rotation.energy_ratio, 5)
    )
}
