//! Reduced equations of a scene, with the powers in which common factors of all stiffnesses and dampings scale each term.
//! To the order three of the paper every term of an elastic body is one power of each: (R2) to (R11) with `C → sC`, `B → dB`.

use quasirigid::dynamics::Sample;
use quasirigid::model::{FlexibleBody, ReducedBody};
use quasirigid::reduction::{Comparison, Criterion, ReductionError, Validity, Verdict};
use quasirigid_io::record::{EquationsRecord, LimitRecord, StartRecord, TermRecord};
use quasirigid_math::polynomial::Series;
use quasirigid_math::vec3::norm;

use crate::study::Study;

/// Order to which a term has one power of the stiffness and one of the damping.
const SCALABLE: usize = 3;
/// Share by which a limit lies below a spin that is beyond it for another reason.
const BELOW: f64 = 1e-3;

/// The equations to an order, from the first sample of a history on, for a duration (s).
pub(crate) fn equations(
    study: &Study,
    asked: usize,
    (first, duration): (&Sample, f64),
    validity: &Validity,
) -> Result<EquationsRecord, ReductionError> {
    let body = &study.body;
    let fixed = unscalable(body);
    let order = if fixed.is_none() { asked.min(SCALABLE) } else { asked };
    let reduced: &ReducedBody = &*study.reduced(order)?;
    // a term of degree n above the rigid one is s^-1 for n = 2 and d s^-2 for n = 3
    let above = |rigid: i32| {
        move |degree: usize| match degree as i32 - rigid {
            2 => [-1, 0],
            3 => [-2, 1],
            _ => [0, 0],
        }
    };
    let scaled = fixed.is_none();
    Ok(EquationsRecord {
        order,
        scalable: scaled,
        note: fixed.unwrap_or_default().into(),
        energy_gradient: terms(&reduced.energy_of_momentum.gradient(), scaled, above(1)),
        c: terms(&reduced.c, scaled, above(-1)),
        T: terms(&reduced.T, scaled, above(-1)),
        momentum: terms(&reduced.K, scaled, above(1)),
        energy: terms(&reduced.energy, scaled, above(2)),
        power: terms(&reduced.power, scaled, |_| [-2, 1]),
        displacements: terms(&reduced.q, scaled, above(0)),
        limits: limits(validity, norm(first.omega)),
        start: StartRecord { momentum: first.angular_momentum, attitude: first.attitude, duration },
    })
}

/// Limits of the spin from the criteria at a spin that grow with it; at that spin their verdict is not milder than the one of all criteria.
fn limits(validity: &Validity, spin: f64) -> Vec<LimitRecord> {
    // power of the spin in the ratio, and powers of stiffness and damping in the limit
    let powers = |criterion: &Criterion| match criterion.comparison {
        Comparison::Spin | Comparison::Relaxation => Some([1.0, 0.5, 0.0]),
        Comparison::Damping => Some([1.0, 1.0, -1.0]),
        Comparison::Linearity => Some([2.0, 0.5, 0.0]),
        // beyond one the ratio of the terms grows with their degree
        Comparison::Series if criterion.value < 1.0 => Some([2.0, 0.5, 0.0]),
        _ => None,
    };
    let limit = |criterion: &Criterion| {
        let [power, stiffness, damping] = powers(criterion).filter(|_| criterion.value > 0.0)?;
        let reached = |ratio: f64| spin * (ratio / criterion.value).powf(1.0 / power);
        let [holds, fails] = [criterion.limit(), criterion.failure()].map(reached);
        Some(LimitRecord { holds, fails, stiffness, damping })
    };
    let holds = spin * (1.0 - BELOW);
    let told = match validity.verdict() {
        Verdict::Holds => None,
        Verdict::Marginal => Some(f64::INFINITY),
        Verdict::Fails => Some(holds),
    };
    let told = told.map(|fails| LimitRecord { holds, fails, stiffness: 0.5, damping: 0.0 });
    validity.criteria.iter().filter_map(limit).chain(told).collect()
}

/// Reason for which common factors do not scale the terms of a body by powers.
fn unscalable(body: &FlexibleBody) -> Option<&'static str> {
    if !body.cyclic().is_empty() || !body.memories().is_empty() {
        return Some(
            "The body has internal rotors or liquids, whose terms a factor of the stiffness does not scale.",
        );
    }
    if !body.wheels().driven.is_empty() || body.wheels().constant != [0.0; 3] {
        return Some("The body has momentum wheels, whose terms a factor of the stiffness does not scale.");
    }
    if !body.viscoelastic().is_empty() {
        return Some("The body has materials whose loss depends on the frequency.");
    }
    (body.elastic() == 0).then_some("The body is rigid.")
}

/// Terms of a series that are not zero; `powers` gives those of stiffness and damping by degree.
fn terms(series: &Series, scaled: bool, powers: impl Fn(usize) -> [i32; 2]) -> Vec<TermRecord> {
    let term = |(degree, monomials): (usize, usize)| {
        let part = series.part(degree);
        let row = |row: usize| part.row_of(monomials, row).map(<[f64]>::to_vec);
        let values: Vec<Vec<f64>> = (0..series.rows()).map(row).collect::<Option<_>>()?;
        let zero = values.iter().flatten().all(|value| *value == 0.0);
        let [stiffness, damping] = if scaled { powers(degree) } else { [0, 0] };
        (!zero).then_some(TermRecord { degree: monomials, stiffness, damping, values })
    };
    let degrees =
        (0..=series.degree()).flat_map(|degree| (0..=degree).rev().map(move |lower| (degree, lower)));
    degrees.filter_map(term).collect()
}
