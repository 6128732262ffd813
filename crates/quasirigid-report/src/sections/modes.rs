use std::collections::BTreeMap;

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{CampbellRecord, ModeList, ModeRecord, SteadySpinRecord, place_of_spin};

use super::table::{first, table};
use crate::figures::campbell::campbell;
use crate::number::{digits, duration, percent};

/// Modes shown of each steady spin, and dissipators of each mode.
const MAX_LISTED: usize = 12;
const SHARES: usize = 3;

/// Steady spins with the angular momentum of the start, instability first, with the small motions about them.
pub fn section(kind: BodyKind, spins: &[SteadySpinRecord], diagram: Option<&CampbellRecord>) -> Markup {
    html! {
        section aria-label="Modes" {
            h2 { "Steady spins and their modes" }
            @for spin in spins { (one(kind, spin)) }
            @if let Some(diagram) = diagram { (campbell(kind, diagram).draw()) }
        }
    }
}

fn one(kind: BodyKind, spin: &SteadySpinRecord) -> Markup {
    let modes = spin.mode_list();
    let (shown, more) = first(&modes.listed, MAX_LISTED);
    html! {
        p { (spin.sentence) }
        @if !shown.is_empty() {
            (table(
                &format!("Modes about {}", place_of_spin(&spin.axis)),
                &["Mode", "Frequency in the body [rad/s]", "Damping ratio", "Time constant", "Dissipated by"],
                html! { @for mode in shown { (row(kind, mode)) } },
            ))
            @if let Some(more) = more { p.absent { (more) } }
            @if !modes.folded.is_empty() { p.absent { (folded(&modes)) } }
        }
    }
}

/// Overdamped modes in a line.
fn folded(modes: &ModeList) -> String {
    let [least, most] = modes.folded_times().map(duration);
    format!("{} overdamped motions, with time constants of {least} to {most}", modes.folded.len())
}

fn row(kind: BodyKind, mode: &ModeRecord) -> Markup {
    let fold = match mode.time_constant {
        None if mode.neutral => "neutral".into(),
        None if let Some(bound) = mode.rate_bound => format!("over {}", duration(bound.recip())),
        Some(constant) if constant < 0.0 => format!("grows, {}", duration(-constant)),
        Some(constant) => duration(constant),
        None => "never".into(),
    };
    html! {
        tr {
            th scope="row" { (kind.mode_name(&mode.name)) }
            td { (digits(mode.frequency, 5)) }
            td { (digits(mode.damping_ratio, 2)) }
            td { (fold) }
            td { (shares(&mode.dissipation)) }
        }
    }
}

fn shares(shares: &BTreeMap<String, f64>) -> String {
    let mut list: Vec<_> = shares.iter().collect();
    list.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    let words = list.iter().take(SHARES).map(|(name, share)| format!("{name} {}", percent(**share)));
    words.collect::<Vec<_>>().join(", ")
}
