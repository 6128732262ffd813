//! Record of the evolution of a body with momentum wheels, in the columns of other evolutions; `circled_axis` is 0, no principal axis.

use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, EvolutionRecord, ObservedRecord};
use quasirigid_math::vec3::{norm, scale};

use super::answer::{Answer, Row};
use crate::evolution::answer::folding;
use crate::evolution::columns::{self, of_rows};
use crate::evolution::reason::Reason;
use crate::evolution::record::blank;
use crate::evolution::verdict::{followed_power, road};
use crate::evolution::words::finished;
use crate::evolution::{STEADY_SPIN, record, refusals};
use crate::settings::EvolveSettings;
use crate::words::{count, shares, significant, time};

/// Record of an evolution that no method leads along, with the rate (1/s) at which a small nutation falls, if known.
pub fn refused(reason: &Reason, rate: Option<f64>, G: f64, kind: BodyKind) -> EvolutionRecord {
    let times = [rate.map_or(f64::NAN, folding), f64::INFINITY];
    record::refused(&refusals::text(reason, kind, true), times, blank(G, STEADY_SPIN))
}

/// Record of an evolution that was followed.
pub fn answered(answer: Answer, asked: &EvolveSettings) -> EvolutionRecord {
    let Answer { method, verdict, budget, rows, attractor, steady, rate, crossed } = answer;
    let G = norm(attractor);
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let kind = asked.kind;
    let power = followed_power(method, kind)
        .unwrap_or_else(|| format!("the rate of the {} about the steady spin", kind.nutation()));
    let observed = |row: Row| {
        let [rotation_period, precession_period] = row.periods;
        let [nutation_least, nutation_greatest] = row.nutation;
        let energy_ratio = row.energy / steady;
        Some(ObservedRecord {
            rotation_period,
            precession_period,
            nutation_least,
            nutation_greatest,
            energy_ratio,
        })
    };
    EvolutionRecord {
        sentence: sentence(&rows, attractor, crossed, kind),
        road: road(method).into(),
        status: if verdict.fails { "does-not-hold" } else { "finished" }.into(),
        message: if verdict.fails { verdict.sentence.clone() } else { finished(last.t, asked) },
        method: power,
        start: observed(first),
        end: observed(last),
        time: last.t,
        time_error: verdict.error,
        revolutions: last.revolutions,
        power: first.power,
        dissipation: shares(budget.as_deref().unwrap_or(&[])),
        separatrix_time: crossed,
        damping_time: rate.map_or(f64::NAN, folding),
        growth_time: f64::INFINITY,
        columns: columns(&rows, G),
        verdict: verdict.sentence,
        ..blank(G, STEADY_SPIN)
    }
    .with_unknown_named()
}

fn sentence(rows: &[Row], attractor: [f64; 3], crossed: Option<f64>, kind: BodyKind) -> String {
    let nutation = kind.nutation();
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let axis = scale(norm(attractor).recip(), attractor).map(|entry| format!("{entry:.3}")).join(", ");
    let [from, to] = [first, last].map(|row| significant(row.nutation[1].to_degrees(), 3));
    let taken = format!("{}, {} revolutions", time(last.t), count(last.revolutions));
    let spin = format!("the steady spin that attracts, about the axis [{axis}]");
    match crossed {
        _ if last.nutation[1].is_nan() => format!(
            "The rotation does not come to circle {spin}, so far: its {nutation} about that is over {} degrees after {taken}.",
            significant(last.nutation[0].to_degrees(), 3)
        ),
        Some(seconds) => format!(
            "The rotation passes a separatrix after {} and ends with a {nutation} of {to} degrees about {spin}, in {taken}.",
            time(seconds)
        ),
        None if first.nutation[1].is_nan() => {
            format!(
                "The rotation comes to circle {spin}, and ends with a {nutation} of {to} degrees in {taken}."
            )
        }
        None => format!("The {nutation} about {spin}, falls from {from} to {to} degrees in {taken}."),
    }
}

fn columns(rows: &[Row], G: f64) -> Vec<Column> {
    let values = |row: &Row| -> columns::Row {
        let Row { t, revolutions, energy, nutation: [least, greatest], periods: [period, precession], power } =
            *row;
        [t, f64::NAN, 0.0, least, greatest, energy, G, period, precession, power, f64::NAN, revolutions]
    };
    of_rows(&rows.iter().map(values).collect::<Vec<_>>())
}
