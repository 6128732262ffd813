//! Section on validity: criteria with their verdicts, the three times, free vibrations and relaxations.
//! Values are shown beside their limits, so that a reader can judge a marginal case; frequencies are undamped ones.
//! Criteria: (V1) to (V11), docs/theory/04-validity.md.

use std::f64::consts::TAU;

use maud::{Markup, html};
use quasirigid_io::record::{CriterionRecord, ValidityRecord};

use super::table::{facts, first, table};
use crate::number::{digits, duration, short, tidy};
use crate::verdict::Verdict;

/// Frequencies and decay rates shown.
const MAX_RATES: usize = 12;

/// Criteria, the three times, and the free vibrations behind them.
pub fn section(validity: &ValidityRecord) -> Markup {
    html! {
        section aria-label="Validity" {
            h2 { "Validity of the reduced equations" }
            @if validity.criteria.is_empty() {
                p.absent { "The record holds no criteria." }
            } @else {
                div.criteria { (criteria(&validity.criteria)) }
            }
            (times(validity))
            div.pair {
                (vibrations("Natural frequencies, undamped", ["No.", "Ω [rad/s]", "Period [s]"], &validity.frequencies, TAU))
                (vibrations("Decay rates of free vibrations", ["No.", "Rate [1/s]", "Decay time [s]"], &validity.decay_rates, 1.0))
                @if !validity.relaxations.is_empty() {
                    @let rates: Vec<f64> = validity.relaxations.iter().map(|time| 1.0 / time).collect();
                    (vibrations("Relaxations of internal rotors and liquids, attitude fixed", ["No.", "Rate [1/s]", "Time [s]"], &rates, 1.0))
                }
            }
        }
    }
}

fn criteria(criteria: &[CriterionRecord]) -> Markup {
    table(
        "Criteria",
        &["Criterion", "Value", "Limit", "Verdict"],
        html! {
            @for criterion in criteria {
                @let verdict = Verdict::of_criterion(&criterion.verdict);
                tr.with-remark {
                    th scope="row" { (criterion.name) " " span.symbol { (criterion.symbol) } }
                    td { (digits(criterion.value, 3)) }
                    td { "< " (tidy(criterion.limit, 3)) }
                    td.word.(verdict.class()) { (verdict.icon()) " " (criterion.verdict) }
                }
                tr { td.remark colspan="4" { (criterion.sentence) } }
            }
        },
    )
}

fn times(validity: &ValidityRecord) -> Markup {
    facts(
        "Times",
        &[
            ("T₁, longest period of free vibration", longest(validity)),
            (
                "T₂, decay of the slowest free vibration by e",
                validity.T2.map_or_else(|| html! { "none: it does not decay" }, seconds),
            ),
            ("T₃, time of the spin 1/|ω|", seconds(validity.T3)),
        ],
    )
}

fn longest(validity: &ValidityRecord) -> Markup {
    if validity.frequencies.is_empty() {
        html! { "none: nothing vibrates" }
    } else {
        seconds(validity.T1)
    }
}

/// A time in seconds, and in a longer unit from 90 s on.
fn seconds(time: f64) -> Markup {
    html! {
        (short(time)) " s"
        @if time.is_finite() && time.abs() >= 90.0 { " = " (duration(time)) }
    }
}

/// Rates, and the time `numerator / rate` that each stands for.
fn vibrations(caption: &str, headings: [&str; 3], rates: &[f64], numerator: f64) -> Markup {
    if rates.is_empty() {
        return html! { p.absent { (caption) ": none." } };
    }
    let (shown, more) = first(rates, MAX_RATES);
    table(
        caption,
        &headings,
        html! {
            @for (i, rate) in shown.iter().enumerate() {
                tr { th scope="row" { (i + 1) } td { (digits(*rate, 5)) } td { (lasting(*rate, numerator)) } }
            }
            @if let Some(more) = more { tr { td.remark colspan="3" { (more) } } }
        },
    )
}

/// The time `numerator / rate`, or "infinite" at a rate of zero.
fn lasting(rate: f64, numerator: f64) -> String {
    if rate == 0.0 { "infinite".into() } else { digits(numerator / rate, 4) }
}
