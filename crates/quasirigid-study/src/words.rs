//! Numbers and criteria in words.

use std::collections::BTreeMap;

use crate::layout::FIRM;
use quasirigid::dynamics::Ringing;
use quasirigid::model::{Displaced, FlexibleBody, HINGE_RANGE, RANGE, Reach, Watched};
use quasirigid::reduction::{Comparison, Criterion, Validity, Verdict};
use quasirigid_math::vec3::norm;

/// Beginning of a note that is told first.
pub const MAY_NOT_HOLD: &str = "MAY NOT HOLD";
/// Share of the length of a vector below which a component is rounding.
const COMPONENT_ROUNDING: f64 = 2e-8;

/// A criterion in words.
pub struct Words {
    /// Quantity that is compared.
    pub name: &'static str,
    /// Quantity in symbols.
    pub symbol: &'static str,
    /// Meaning of the number, in one sentence.
    pub sentence: String,
}

/// Meaning of a criterion for this body and spin.
pub fn criterion(criterion: &Criterion, validity: &Validity) -> Words {
    let (name, symbol) = names(criterion.comparison);
    Words { name, symbol, sentence: sentence(criterion, validity) }
}

fn names(comparison: Comparison) -> (&'static str, &'static str) {
    match comparison {
        Comparison::Spin => ("spin against slowest vibration", "|w|/Omega_min"),
        Comparison::Damping => ("spin against damping", "beta |w|"),
        Comparison::Relaxation => ("spin against friction", "tau |w|"),
        Comparison::Series => ("convergence of the series", "Omega_d+2/Omega_d"),
        Comparison::Resonance => ("harmonics near resonance", "nome^(n/2)"),
        Comparison::Linearity => ("displacement against size", "max|r|/max|rho|"),
        Comparison::Residual => ("residual of the full equations", "|residual|/|load|"),
        Comparison::Loads => ("load changed by displacement", "|dQ/dq|/C"),
        Comparison::Power => ("convergence of the power", "change of P/P"),
        Comparison::Wobbles => ("rates of small motions", "change of rate"),
        Comparison::Levels => ("averages along rigid polhodes", "max|f4|/max|f2|"),
        Comparison::Forgetting => ("decay of initial vibrations", "T2/T3"),
    }
}

fn sentence(criterion: &Criterion, validity: &Validity) -> String {
    let verdict = criterion.verdict();
    let ratio = significant(criterion.value, 3);
    let spin = significant(validity.T3.recip(), 4);
    match criterion.comparison {
        Comparison::Spin => match validity.vibrations.frequencies.first() {
            None => "The body has no elastic vibrations.".into(),
            Some(slowest) => {
                let softest = validity.vibrations.softest.as_deref().unwrap_or("the softest coordinate");
                let slowest = significant(*slowest, 4);
                format!(
                    "The spin, {spin} rad/s, is {ratio} times the slowest elastic frequency, {slowest} rad/s ({softest})."
                )
            }
        },
        Comparison::Damping => {
            let time = significant(validity.vibrations.damping_time, 3);
            format!(
                "Dashpots delay the springs by up to {time} s, which is {ratio} of the time 1/|w| of the spin."
            )
        }
        Comparison::Relaxation => match &validity.relaxation.slowest {
            None => "No internal rotor or liquid moves in this body.".into(),
            Some(slowest) => format!(
                "The slowest internal relaxation ({slowest}) takes {} s, which is {ratio} of the time 1/|w| of the spin.",
                significant(validity.relaxation.longest(), 3)
            ),
        },
        Comparison::Series => {
            format!("Successive terms of the same kind in Omega(K) have the ratio {ratio} at this spin.")
        }
        Comparison::Resonance => resonance(validity),
        Comparison::Linearity => match &validity.displacement {
            None => "No part of the body is displaced.".into(),
            Some((place, r)) => format!(
                "The largest displacement, of {place}, is {} m: {ratio} of the size of the body.",
                significant(*r, 3)
            ),
        },
        Comparison::Residual => {
            format!("Put into the full equations, the reduced ones leave {ratio} of the load unbalanced.")
        }
        Comparison::Loads => format!(
            "A displacement changes the external forces by up to {ratio} of the elastic force that resists it; from 1 on they buckle the body."
        ),
        Comparison::Power if criterion.value == 0.0 => {
            "No power is kept at this order, or none is dissipated.".into()
        }
        Comparison::Power => format!(
            "Two orders more change the power that is dissipated by {ratio} of itself: what follows from it is no better at this order."
        ),
        Comparison::Wobbles => format!(
            "Rate or frequency of a small motion about a steady spin differs by {ratio} from that of the modes of the full system."
        ),
        Comparison::Levels => format!(
            "The elastic torque is {ratio} of that of the rigid body: the angular momentum follows the rigid polhode no better than this, and averages along it have relative errors of this size."
        ),
        Comparison::Forgetting if verdict == Verdict::Holds => {
            "Vibrations excited at the start die out before the body has turned by a radian.".into()
        }
        Comparison::Forgetting if validity.T2.is_infinite() => {
            "Vibrations excited at the start are undamped; a start on the slow manifold excites none.".into()
        }
        Comparison::Forgetting => format!(
            "Vibrations excited at the start last while the body turns by {ratio} rad; a start on the slow manifold excites none."
        ),
    }
}

fn resonance(validity: &Validity) -> String {
    let Some(strongest) = validity.resonances.first() else {
        return "No significant harmonic of the polhode frequency lies within 10 % of an elastic frequency."
            .into();
    };
    format!(
        "Harmonic {} of the polhode frequency, {} rad/s, is near the elastic frequency {} rad/s; its strength is {} of the load.",
        strongest.harmonic,
        significant(strongest.forcing, 4),
        significant(strongest.frequency, 4),
        significant(strongest.strength, 2)
    )
}

/// The overall verdict, in one sentence; a second one where the motion holds, and the averages made of it do not.
pub fn verdict(validity: &Validity) -> String {
    let motion = motion(validity.verdict());
    if validity.verdict() == Verdict::Fails {
        return motion.into();
    }
    let fails = [validity.dissipation(), validity.averages()].map(|verdict| verdict == Verdict::Fails);
    let other = match fails {
        [false, false] => return motion.into(),
        [true, false] => DISSIPATION,
        [false, true] => "Averages along rigid polhodes DO NOT.",
        [true, true] => "Their dissipation at this order and averages along rigid polhodes DO NOT.",
    };
    format!("{motion} {other}")
}

fn motion(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "The reduced equations hold at this spin.",
        Verdict::Marginal => "The reduced equations are at the edge of their range at this spin.",
        Verdict::Fails => "The reduced equations DO NOT HOLD at this spin.",
    }
}

const DISSIPATION: &str = "Their dissipation DOES NOT at this order.";

/// The verdict on a motion that is followed, in a sentence or two; averages are not asked for there.
pub fn followed(validity: &Validity) -> String {
    let motion = motion(validity.verdict());
    match (validity.verdict(), validity.dissipation()) {
        (Verdict::Fails, _) | (_, Verdict::Holds) => motion.into(),
        (_, Verdict::Marginal) => {
            format!("{motion} Their dissipation is at the edge of its range at this order.")
        }
        (_, Verdict::Fails) => format!("{motion} {DISSIPATION}"),
    }
}

/// Sentences of the criteria that do not hold, the worst first.
pub fn reasons(validity: &Validity) -> Vec<String> {
    let lost = validity.verdict() == Verdict::Fails;
    let mut failing: Vec<_> = validity
        .criteria
        .iter()
        .filter(|criterion| criterion.comparison != Comparison::Forgetting)
        .filter(|criterion| criterion.comparison.concerns_motion() || !lost)
        .filter(|criterion| criterion.verdict() != Verdict::Holds)
        .collect();
    failing.sort_by_key(|criterion| std::cmp::Reverse(criterion.verdict()));
    failing.iter().map(|criterion| sentence(criterion, validity)).collect()
}

/// Doubt about reduced equations with a verdict along a motion on which displacements have changed the loads by a ratio (E7); none where they
/// hold.
pub fn load_doubt(verdict: Verdict, ratio: f64) -> Option<String> {
    let [range, remedy] = match verdict {
        Verdict::Holds => return None,
        Verdict::Marginal => ["were at the edge of their range", ""],
        Verdict::Fails => ["DID NOT HOLD", "; the full system follows this"],
    };
    let ratio = significant(ratio, 2);
    Some(format!(
        "The reduced equations {range}: displacements changed the external forces by up to {ratio} of the elastic forces that resist them{remedy}."
    ))
}

/// Doubt about reduced equations at the fastest rotation (rad/s) of a history, at a time (s), with what does not hold.
pub fn fastest_doubt(t: f64, spin: f64, validity: &Validity) -> String {
    let range = match validity.verdict() {
        Verdict::Fails => "DO NOT HOLD",
        _ => "are at the edge of their range",
    };
    format!(
        "The forces spun the body up to {} rad/s at t = {} s, where the reduced equations {range}: {} The full system follows this.",
        significant(spin, 3),
        significant(t, 6),
        reasons(validity).join(" ")
    )
}

/// Doubt about the angular velocity of reduced equations under forces that excite vibrations (E8).
pub fn ringing_doubt(ringing: Ringing) -> String {
    let Ringing { from, to, omega, share } = ringing;
    let [omega, rest] = [omega, 100.0 * Ringing::TOLD].map(|number| significant(number, 2));
    let share = if share < 10.0 {
        format!("{} % of", significant(100.0 * share, 2))
    } else {
        format!("{} times", significant(share, 2))
    };
    let span = if to > from {
        format!("from t = {} s to {} s", significant(from, 6), significant(to, 6))
    } else {
        format!("at t = {} s", significant(from, 6))
    };
    format!(
        "THE ANGULAR VELOCITY MAY BE WRONG {span}: forces change as fast as the body vibrates, and vibrations that the reduced equations do not have let it be off by up to about {omega} rad/s, {share} the largest of the run; energy and work are off there too. The angular momentum holds throughout, the angular velocity before and after to {rest} %; the full system has the vibrations."
    )
}

/// Share of the dissipated energy above which the integrator's own change of energy is noted.
const NOTED_DRIFT: f64 = 0.01;
/// Roundings of the energy that no tolerance takes away.
const ROUNDINGS: f64 = 8.0;

/// Energies of a history that a note may be due to (J).
#[derive(Clone, Copy, Debug)]
pub struct Accounts {
    /// Energy at the end.
    pub energy: f64,
    /// Change made by the integrator.
    pub drift: f64,
    /// Energy that the dashpots took.
    pub dissipated: f64,
    /// Energy of vibrations and of terms that the reduced equations leave out.
    pub left_out: f64,
}

/// Note that the dissipated energy is not that of the body, or that the drift of the integrator may imitate it, if it may. Under forces the drift
/// of a reduced body has the truncation of its series, too.
pub fn energy_note(system: &str, forced: bool, accounts: Accounts) -> Option<String> {
    let Accounts { energy, drift, dissipated, left_out } = accounts;
    let rounding = ROUNDINGS * f64::EPSILON * energy.abs();
    let notable = |doubt: f64| dissipated > 0.0 && doubt > NOTED_DRIFT * dissipated;
    if notable(left_out) {
        let [doubt, taken] = [left_out, dissipated].map(|energy| significant(energy, 2));
        return Some(format!(
            "THE DISSIPATED ENERGY MAY BE WRONG: forces that change as fast as the body vibrates, or displacements of the start, leave up to about {doubt} J in vibrations that the reduced equations do not have, beside {taken} J that the dashpots took; the full system has them."
        ));
    }
    if !notable(drift.abs()) || drift.abs() <= rounding {
        return None;
    }
    let (culprit, remedy) = if forced && system == "reduced" {
        ("The series that was cut off, or the integrator,", "use a higher order or a smaller tolerance")
    } else {
        ("The integrator", "use a smaller tolerance")
    };
    let [drift, taken] = [drift, dissipated].map(|energy| significant(energy, 2));
    Some(format!(
        "{culprit} changed the energy of the {system} body by {drift} J, beside {taken} J that the dashpots took: {remedy}."
    ))
}

/// Share below which a dissipator is not named, and the most that are.
const FAINT: f64 = 1e-3;
const MOST_DISSIPATORS: usize = 8;

/// Shares of dissipators in a power or an energy, by name; empty where nothing is dissipated.
pub fn shares(budget: &[(String, f64)]) -> BTreeMap<String, f64> {
    let whole: f64 = budget.iter().map(|(_, taken)| taken).sum();
    let mut shares = BTreeMap::new();
    for (name, taken) in budget.iter().filter(|_| whole > 0.0) {
        *shares.entry(name.clone()).or_default() += taken / whole;
    }
    shares
}

/// Shares of the dissipators in words, the largest first; none where nothing is dissipated.
pub fn dissipation(shares: &BTreeMap<String, f64>) -> Option<String> {
    if shares.len() < 2 {
        return None;
    }
    let mut parts: Vec<(&String, f64)> = shares.iter().map(|(name, share)| (name, *share)).collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let loud = parts.iter().take_while(|(_, share)| *share >= FAINT).take(MOST_DISSIPATORS).count();
    // A single one is named as briefly as counted.
    let named = if loud + 1 == parts.len() { parts.len() } else { loud };
    let percent = |share: f64| format!("{}{FIRM}%", significant(100.0 * share, 3));
    let mut list: Vec<String> =
        parts[..named].iter().map(|(name, share)| format!("{name} {}", percent(*share))).collect();
    if named < parts.len() {
        let rest: f64 = parts[named..].iter().map(|(_, share)| share).sum();
        list.push(format!("{} more {}", parts.len() - named, percent(rest)));
    }
    Some(format!("dissipation shares: {}", list.join(", ")))
}

/// A verdict in one word.
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Marginal => "marginal",
        Verdict::Fails => "fails",
    }
}

/// Name without quotes.
pub fn plain(name: &str) -> String {
    name.replace('"', "")
}

/// A number with so many significant digits, without an exponent where that is readable.
pub fn significant(value: f64, digits: i32) -> String {
    let size = value.abs();
    if value == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&size) {
        let decimals = (digits - 1).max(0) as usize;
        return format!("{value:.decimals$e}");
    }
    let decimals = (digits - 1 - size.log10().floor() as i32).max(0) as usize;
    format!("{value:.decimals$}")
}

/// Components of a vector, zero where one is rounding beside the length.
pub fn tidied(vector: [f64; 3]) -> [f64; 3] {
    let least = COMPONENT_ROUNDING * norm(vector);
    vector.map(|component| if component.abs() < least { 0.0 } else { component })
}

/// A motion that grows at a decay rate below zero (1/s).
pub fn growth(name: &str, decay_rate: f64) -> String {
    format!("a motion of {name} grows e-fold in {}", time(-decay_rate.recip()))
}

/// A time (s) in the unit a person would choose.
pub fn time(seconds: f64) -> String {
    const UNITS: [(f64, &str); 8] = [
        (31_557_600e9, "Gyr"),
        (31_557_600e6, "Myr"),
        (31_557_600e3, "kyr"),
        (31_557_600.0, "yr"),
        (86_400.0, "d"),
        (3_600.0, "h"),
        (60.0, "min"),
        (1.0, "s"),
    ];
    if seconds.is_infinite() {
        return "infinite".into();
    }
    let (size, unit) = UNITS.into_iter().find(|(size, _)| seconds.abs() >= 2.0 * size).unwrap_or((1.0, "s"));
    format!("{} {unit}", significant(seconds / size, 4))
}

/// A number of things, in the words a person would choose.
pub fn count(number: f64) -> String {
    const WORDS: [(f64, &str); 4] = [(1e12, " trillion"), (1e9, " billion"), (1e6, " million"), (1.0, "")];
    if number == f64::INFINITY {
        return "over 1e308".into();
    }
    if number.abs() >= 1e15 {
        return significant(number, 3);
    }
    let (size, word) = WORDS.into_iter().find(|(size, _)| number.abs() >= *size).unwrap_or((1.0, ""));
    format!("{}{word}", significant(number / size, 3))
}

/// Part or hinge that has left the range of its paths, in words.
pub fn displaced(body: &FlexibleBody, left: Displaced) -> String {
    let (reach, share) = match left {
        Displaced::Place { reach, share } => (reach, share),
        Displaced::Gimbal { gimbal, .. } => {
            let name = body.watched().gimbals.get(gimbal).map_or("a hinge", |hinge| hinge.name.as_str());
            return format!(
                "{name:?} came to the gimbal lock of its hinge, where its three axes lie in one plane and their angles end (a hinge with its middle \
                 axis elsewhere locks elsewhere),"
            );
        }
        Displaced::Hinge { hinge, angle } => {
            let name = body.watched().hinges.get(hinge).map_or("a hinge", |hinge| hinge.name.as_str());
            let [angle, range] = [angle, HINGE_RANGE].map(|angle| significant(angle.to_degrees(), 3));
            return format!(
                "{name:?} turned on its hinge by {angle} degrees, beyond the {range} degrees to which the springs at places on it hold,"
            );
        }
    };
    let name = body.watched().reaches.get(reach).map(|reach| reach.name.as_str());
    let [share, range] = [share, RANGE].map(|share| significant(100.0 * share, 3));
    format!(
        "{} was displaced by {share} % of its distance from where it is held, beyond the {range} % to which its paths hold,",
        name.unwrap_or("a part")
    )
}

/// Range of parts and hinges in the full system, in words; none without them.
pub fn range(body: &FlexibleBody) -> Option<String> {
    let Watched { reaches, hinges, .. } = body.watched();
    let mut shortest: BTreeMap<&str, &Reach> = BTreeMap::new();
    for reach in reaches {
        let part = reach.name.split('"').nth(1).unwrap_or(&reach.name);
        let known = shortest.entry(part).or_insert(reach);
        if reach.length < known.length {
            *known = reach;
        }
    }
    let places =
        shortest.values().map(|reach| format!("{} {} m", reach.name, significant(RANGE * reach.length, 3)));
    let parts = (!shortest.is_empty()).then(|| {
        let range = significant(100.0 * RANGE, 3);
        format!(
            "parts up to displacements of {range} % of their length ({})",
            places.collect::<Vec<_>>().join(", ")
        )
    });
    let turned = (!hinges.is_empty()).then(|| {
        let range = significant(HINGE_RANGE.to_degrees(), 3);
        format!("appendages with springs at places on them up to hinge angles of {range} degrees")
    });
    let followed: Vec<String> = parts.into_iter().chain(turned).collect();
    (!followed.is_empty())
        .then(|| format!("The full system follows {}, and ends there.", followed.join(" and ")))
}

#[cfg(test)]
mod tests {
    use super::{Accounts, energy_note};

    #[test]
    fn drift_of_some_roundings_of_the_energy_is_no_alarm() {
        let note = |energy, drift, dissipated| {
            energy_note("reduced", false, Accounts { energy, drift, dissipated, left_out: 0.0 })
        };
        assert_eq!(note(1.2, 4.8e-19, 1e-17), None);
        assert!(note(1.2, 4.8e-3, 1e-2).is_some());
        assert!(note(1.2e-20, 4.8e-23, 1e-22).is_some());
    }
}
