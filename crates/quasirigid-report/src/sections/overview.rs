//! Overview: the first screen answers in a sentence, says how far that holds and what to do about it, and names the modes, the dissipators
//! and the fate of the rotation. Everything below it is evidence.

use std::collections::BTreeMap;

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{EvolutionRecord, RunRecord, SteadySpinRecord, place_of_spin};

use super::dissipation::bar;
use crate::columns::{column, ends, main_history};
use crate::number::{digits, duration, percent, short};
use crate::verdict::Verdict;

/// Modes and dissipators listed.
const MAX_LISTED: usize = 4;
/// Share of the dissipation below which a dissipator is not listed.
const LISTED_SHARE: f64 = 0.005;

/// The answer in a sentence, where the record has one; a history of equations that do not hold gives none.
pub fn answer(record: &RunRecord, shown: Verdict) -> Markup {
    let of_history = || history_sentence(record).filter(|_| shown != Verdict::Fails);
    let of_spin = || record.steady_spins.first().map(|spin| spin.sentence.clone());
    let sentence =
        answered(record).map(|evolution| evolution.sentence.clone()).or_else(of_history).or_else(of_spin);
    html! { @if let Some(sentence) = sentence { p.answer-sentence { (sentence) } } }
}

/// What the verdict means for the numbers of this record, and what to do about it.
pub fn advice(record: &RunRecord, verdict: Verdict) -> Option<String> {
    let [full, followed] = of_full_system(record);
    match verdict {
        Verdict::Holds => None,
        Verdict::Marginal => Some(format!(
            "Errors are of the size of the marginal ratios below; quasirigid verify {} measures them.",
            record.model.file
        )),
        Verdict::Fails if full || followed => Some(format!(
            "The {} of the full system and do not use them; what is called reduced below does.",
            match (full, followed) {
                (true, true) => "history and the answer are those",
                (true, false) => "history is that",
                _ => "answer is that",
            }
        )),
        Verdict::Fails => Some(format!(
            "Do not use the reduced history: follow the full system (quasirigid simulate {} --system full).",
            record.model.file
        )),
    }
}

/// Whether the main history, and the answer over many revolutions, are those of the full system.
fn of_full_system(record: &RunRecord) -> [bool; 2] {
    let full = main_history(record).is_some_and(|history| history.system == "full");
    let followed =
        answered(record).is_some_and(|evolution| evolution.road != "average" && evolution.road != "levels");
    [full, followed]
}

/// The verdict as a reader of this record needs it: numbers of the full system stand where the reduced equations fall.
pub fn headline(record: &RunRecord, verdict: Verdict) -> (Verdict, &'static str) {
    match verdict {
        Verdict::Fails if of_full_system(record).contains(&true) => {
            (Verdict::Marginal, "From the full system.")
        }
        other => (other, other.words()),
    }
}

/// Modes, dissipators and fate.
pub fn facts(record: &RunRecord) -> Markup {
    let (shown, _) = headline(record, Verdict::of_all(&record.validity));
    let modes = record.steady_spins.first().filter(|spin| !spin.modes.is_empty());
    let shares = shares(record, shown);
    let fate = fate(record);
    html! {
        @if modes.is_some() || shares.is_some() || fate.is_some() {
            section.overview aria-label="Overview" {
                @if let Some((title, sentence)) = fate { div { h2 { "Fate" } p.fate { (title) } p.remark { (sentence) } } }
                @if let Some(spin) = modes { (time_constants(record.body.kind, spin)) }
                @if let Some((when, shares)) = shares { (dissipators(when, shares)) }
            }
        }
    }
}

/// The evolution, where it has an answer.
pub fn answered(record: &RunRecord) -> Option<&EvolutionRecord> {
    let told = |evolution: &&EvolutionRecord| {
        !matches!(
            evolution.status.as_str(),
            "refused" | "does-not-hold" | "failed" | "interrupted" | "step-limit"
        )
    };
    record.evolution.as_ref().filter(told).filter(|evolution| !evolution.sentence.is_empty())
}

fn history_sentence(record: &RunRecord) -> Option<String> {
    let history = main_history(record)?;
    let (first, last) = ends(column(&history.columns, "t")?.values.iter().copied())?;
    let nutation =
        column(&history.columns, "nutation_max").and_then(|column| ends(column.values.iter().copied()));
    let changed = nutation.map_or_else(String::new, |(start, end)| {
        format!(" the {} {},", record.body.kind.nutation(), change(start.to_degrees(), end.to_degrees()))
    });
    Some(format!(
        "In {} the {} body makes {} revolutions:{changed} {} J are dissipated.",
        duration(last - first),
        history.system,
        digits(history.revolutions, 4),
        short(history.dissipated)
    ))
}

/// Change of an angle (degrees) larger than rounding, relative to it, that is told.
const TOLD: f64 = 1e-9;

/// Change of an angle (degrees) in words, also where it does not show in the digits of the angle.
fn change(start: f64, end: f64) -> String {
    let [from, to] = [start, end].map(|angle| digits(angle, 3));
    if from != to {
        return format!("goes from {from}° to {to}°");
    }
    let by = end - start;
    if by.abs() > TOLD * start {
        format!("of {from}° {} by {}°", if by > 0.0 { "grows" } else { "falls" }, digits(by.abs(), 2))
    } else {
        format!("stays at {from}°")
    }
}

/// Fate in a few words, and a sentence on it.
fn fate(record: &RunRecord) -> Option<(String, String)> {
    let stability = || {
        let spin = record.steady_spins.first().filter(|spin| spin.spin.is_some())?;
        let grows = spin.modes.iter().filter_map(|mode| mode.time_constant).filter(|time| *time < 0.0);
        let fastest = grows.fold(f64::NEG_INFINITY, f64::max);
        let about = format!("about {}", place_of_spin(&spin.axis));
        Some(match spin.stable {
            true => ("Stable".to_owned(), format!("No small motion {about} grows.")),
            false if fastest.is_finite() => (
                "Unstable".to_owned(),
                format!("A small motion {about} grows e-fold in {}.", duration(-fastest)),
            ),
            false if spin.slowest.is_some() => (
                "Stability not known".to_owned(),
                format!("Of the many small motions {about} those that were found do not grow."),
            ),
            false => ("Unstable".to_owned(), format!("A small motion {about} grows.")),
        })
    };
    let Some(evolution) = &record.evolution else { return stability() };
    if answered(record).is_none() {
        return Some(("Needs the full system".to_owned(), evolution.message.clone()));
    }
    let turns_over = evolution.mode_start != evolution.mode_end && evolution.mode_end == "short-axis";
    match evolution.separatrix_time.filter(|time| time.is_finite()) {
        Some(time) if turns_over => Some((
            format!("Flat spin after {}", duration(time)),
            "The rotation leaves the axis of least inertia for that of greatest inertia.".to_owned(),
        )),
        _ => stability(),
    }
}

fn time_constants(kind: BodyKind, spin: &SteadySpinRecord) -> Markup {
    let listed = spin.modes.iter().filter(|mode| !mode.overdamped).take(MAX_LISTED);
    html! {
        div {
            h2 { "Time constants" }
            table.compact {
                @for mode in listed {
                    tr {
                        th scope="row" { (kind.mode_name(&mode.name)) }
                        td {
                            @match mode.time_constant {
                                Some(time) if time < 0.0 => { "grows, " (duration(-time)) }
                                Some(time) => (duration(time)),
                                None if mode.neutral => "neutral to rounding",
                                None if let Some(bound) = mode.rate_bound => { "over " (duration(bound.recip())) }
                                None => "no decay",
                            }
                        }
                    }
                }
            }
            p.remark { "Small motions about the axis of " (spin.axis) " inertia, e-fold." }
        }
    }
}

/// Shares of the dissipators: over the run, else at the start of the evolution, else at the initial spin. Reduced equations that do not hold
/// tell none.
pub fn shares(record: &RunRecord, shown: Verdict) -> Option<(&'static str, &BTreeMap<String, f64>)> {
    let run = main_history(record).map(|history| ("Over the run.", &history.dissipation));
    let start = answered(record).map(|evolution| ("At the start.", &evolution.dissipation));
    let reduction = ("At the initial spin.", &record.reduction.dissipation);
    let reduced = shown != Verdict::Fails;
    let all = run.filter(|_| reduced).into_iter().chain(start).chain(Some(reduction).filter(|_| reduced));
    all.into_iter().find(|(_, shares)| !shares.is_empty())
}

fn dissipators(when: &str, shares: &BTreeMap<String, f64>) -> Markup {
    let mut parts: Vec<_> = shares.iter().filter(|(_, share)| **share >= LISTED_SHARE).collect();
    parts.sort_by(|a, b| b.1.total_cmp(a.1));
    html! {
        div {
            h2 { "Dissipation shares" }
            table.compact.shares-short {
                @for (name, share) in parts.iter().take(MAX_LISTED) {
                    tr { th scope="row" { (name) } td { (percent(**share)) } td { (bar(**share)) } }
                }
            }
            p.remark { (when) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::change;

    #[test]
    fn changes_below_the_digits_of_an_angle_are_told() {
        assert_eq!(change(24.0, 68.1), "goes from 24.0° to 68.1°");
        assert_eq!(change(3.0, 3.0012), "of 3.00° grows by 0.0012°");
        assert_eq!(change(3.0, 2.999_999_9), "of 3.00° falls by 1.0×10⁻⁷°");
        assert_eq!(change(3.0, 3.0), "stays at 3.00°");
    }
}
