use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{AboutSpinRecord, MasterRecord};

use super::table::table;
use crate::figures::about_spin::{dissipation, frequency, time_constant};
use crate::number::{digits, duration};

/// Reduced equations about the steady spin: the verdict, the modes that they follow, and the motion along their manifold.
pub fn section(kind: BodyKind, about: &AboutSpinRecord) -> Markup {
    let shares = dissipation(kind, about);
    html! {
        section aria-label="Reduced equations about the spin" {
            h2 { "Reduced equations about the spin" }
            p { (about.sentence) }
            (table(
                &format!("Modes that they follow, degree {}, {}", about.degree, about.style.replace('-', " ")),
                &["Mode", "Frequency in the body [rad/s]", "Time constant"],
                html! { @for master in &about.masters { (row(kind, master)) } },
            ))
            (time_constant(kind, about).draw())
            (frequency(kind, about).draw())
            @if shares.has_curves() { (shares.draw()) }
            @if !about.resonances.is_empty() {
                ul { @for sentence in &about.resonances { li { (sentence) } } }
            }
        }
    }
}

fn row(kind: BodyKind, master: &MasterRecord) -> Markup {
    let fold = match master.decay_rate {
        rate if rate > 0.0 => duration(rate.recip()),
        rate if rate < 0.0 => format!("grows, {}", duration(-rate.recip())),
        _ => "never".into(),
    };
    html! { tr { th scope="row" { (kind.mode_name(&master.name)) } td { (digits(master.frequency, 5)) } td { (fold) } } }
}
