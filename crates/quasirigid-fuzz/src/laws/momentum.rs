//! The angular momentum of a free body is constant in inertial axes: in the reduced equations degree by degree, and in the full ones.

use quasirigid::dynamics::{Forced, Options, Outcome, Sample, Start, propagate_full};
use quasirigid::model::ReducedBody;
use quasirigid_math::polynomial::{Homogeneous, Series};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::sym3;
use quasirigid_study::Study;

/// Rounding of a product of polynomials, relative to the largest term.
const PRODUCT_ROUNDING: f64 = 1e-12;
/// Largest condition of the inertia tensor with which the balance is judged.
const MAX_CONDITION: f64 = 1e6;
/// Tolerance of the integrator, the drift that so many of its steps may make, and their number.
const STEP_TOLERANCE: f64 = 1e-9;
const DRIFT: f64 = 1e-6;
const MAX_STEPS: u64 = 60;

/// `∇K f + ω × K = 0`. (R2), (R5)
pub fn of_reduced(body: &ReducedBody) {
    let condition = condition(body);
    if body.has_wheels() || !(condition < MAX_CONDITION) {
        return;
    }
    let mut omega = Series::zero(1, 3);
    omega.set(Homogeneous::identity());
    for degree in 2..=body.f.degree() {
        let mut sum = body.K.rate(&body.f, degree);
        let turning = omega.cross(&body.K, degree);
        let terms = (1..degree).filter(|part| *part <= body.K.degree());
        let largest = terms.map(|part| body.K.part(part).along(body.f.part(degree + 1 - part)).amax());
        let scale = largest.fold(turning.amax(), f64::max);
        sum.add_scaled(1.0, &turning);
        assert!(
            sum.amax() <= PRODUCT_ROUNDING * condition * scale || !scale.is_finite(),
            "the rate of the angular momentum at degree {degree} is {:e} of {scale:e}, condition {condition:e}",
            sum.amax()
        );
    }
}

/// Greatest over least moment of inertia, from above.
fn condition(body: &ReducedBody) -> f64 {
    let trace = |matrix: sym3::Sym| matrix[..3].iter().sum::<f64>();
    trace(body.J) * trace(sym3::inverse(body.J)).abs()
}

/// A few steps of the full equations, without forces: `|K|` stays, and energy is not made.
pub fn of_full(study: &Study, reduced: &ReducedBody) {
    let system = Forced::not(&study.body);
    let Ok(Start { omega, .. }) = study.initial() else { return };
    let spin = omega.iter().fold(0.0, |size: f64, w| size.hypot(*w));
    let Ok(settled) = Start::new(omega, ALIGNED).settled(system, reduced.order) else { return };
    let options = Options { tolerance: STEP_TOLERANCE, most_steps: MAX_STEPS, ..Options::default() };
    let mut samples: Vec<Sample> = Vec::new();
    let end = 0.01 / spin;
    let Ok(run) = propagate_full(system, &settled, &[0.0, end], &options, &mut samples) else { return };
    if !matches!(run.outcome, Outcome::Finished | Outcome::StepLimit) {
        return;
    }
    let last = run.last;
    assert!(last.momentum_drift.abs() <= DRIFT, "|K| drifts by {:e} over {} s", last.momentum_drift, last.t);
    assert!(
        last.energy.is_finite() && last.omega.iter().all(|w| w.is_finite()),
        "a run that went on has numbers: {last:?}"
    );
}
