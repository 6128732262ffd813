//! Loads that displacements change, beside the stiffness that resists these: the ratio in which the series under forces converges.
//! It is a property of the body and its forces at a pose, not of the motion: a boom above its buckling load that happens to be straight has no
//! series either.
//! Equation (E7), docs/theory/09-forced-reduction.md.

use super::flow::{elastic_energy, loads};
use crate::dynamics::control::ControlTimes;
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::run::Start;
use crate::dynamics::timing::Timing;
use crate::math::sym3::{inverse, times};
use crate::math::taylor::Taylor;
use crate::math::vec3::{add, norm, scale};
use crate::model::MotionState;

/// Passes of the power iteration. The largest counts: where a force has a potential each grows more than the last, and where it turns with a
/// place the first ones may be all.
const PASSES: usize = 16;
/// Places of a run, and of each interval in which forces change, at which they are looked at.
const LOOKS: usize = 17;
const INTERVAL_LOOKS: [f64; 5] = [1e-9, 0.25, 0.5, 0.75, 1.0 - 1e-9];
/// Most intervals that are looked at.
const MOST_INTERVALS: usize = 64;

/// Largest change of the loads by displacements, beside the stiffness, at the pose of a start, over the times to `end` (s) at which the forces
/// act. (E7)
#[must_use]
pub fn load_ratio_at_start(system: Forced, start: Start, end: f64) -> f64 {
    let Start { omega, attitude, place, velocity } = start;
    let pose = Pose { t: 0.0, attitude, place, velocity };
    let intervals = Timing::of(system, omega, &pose, end, ControlTimes::default())
        .map_or_else(Vec::new, |t| t.intervals());
    let stride = intervals.len().div_ceil(MOST_INTERVALS).max(1);
    let inside = |[middle, length]: &[f64; 2]| INTERVAL_LOOKS.map(|share| middle + (share - 0.5) * length);
    let even = (0..LOOKS).map(|look| end * look as f64 / (LOOKS - 1) as f64);
    let times = even.chain(intervals.iter().step_by(stride).flat_map(inside));
    times.map(|t| load_ratio(system, omega, &Pose { t, ..pose })).fold(0.0, worse)
}

/// The larger of two ratios; a number that is none is worst.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Change of the loads at an angular momentum (N·m·s, body axes). (E7)
pub(super) fn load_ratio_of(system: Forced, K: [f64; 3], pose: &Pose<f64>) -> f64 {
    let own = add(K, scale(-1.0, system.body.wheels().angular_momentum(pose.t)));
    load_ratio(system, times(inverse(system.body.invariants().J), own), pose)
}

/// Change of the loads by displacements and, at the rate `|ω|`, by their rates, beside the stiffness: the larger growth by
/// `C⁻¹ ∂Q/∂q` and `|ω| C⁻¹ ∂Q/∂q̇` on the body without displacements. (E7)
fn load_ratio(system: Forced, omega: [f64; 3], pose: &Pose<f64>) -> f64 {
    if system.body.elastic() == 0 {
        return 0.0;
    }
    let still = vec![Taylor::<2>::from(0.0); system.body.coordinates().len()];
    let pose = Pose {
        t: Taylor::from(pose.t),
        attitude: pose.attitude.map(Taylor::from),
        place: pose.place.map(Taylor::from),
        velocity: pose.velocity.map(Taylor::from),
    };
    let spin = norm(omega);
    let omega = omega.map(Taylor::from);
    let changed = |motion: MotionState<Taylor<2>>| -> Vec<f64> {
        loads(system, true, &pose, motion).generalized.iter().map(|load| load.coefficient(1)).collect()
    };
    let line = |shape: &[f64], length: f64| -> Vec<Taylor<2>> {
        shape.iter().map(|entry| Taylor::new([0.0, length * entry])).collect()
    };
    let displaced = |shape: &[f64]| changed(MotionState { omega, q: &line(shape, 1.0), rate: &still });
    let moving = |shape: &[f64]| changed(MotionState { omega, q: &still, rate: &line(shape, spin) });
    let start = under(system, general(system));
    worse(growth(system, &start, displaced), growth(system, &start, moving))
}

/// Largest growth of displacements in a pass of the power iteration from a start, by the loads that they change.
fn growth(system: Forced, start: &[f64], changed: impl Fn(&[f64]) -> Vec<f64>) -> f64 {
    let mut shape = start.to_vec();
    let mut largest = 0.0;
    for pass in 0..=PASSES {
        let size = elastic_energy(system, &shape).sqrt();
        if pass > 0 {
            largest = worse(largest, size);
        }
        if size == 0.0 || !size.is_finite() {
            break;
        }
        shape.iter_mut().for_each(|entry| *entry /= size);
        shape = under(system, changed(&shape));
    }
    largest
}

/// Forces of irregular sizes on the coordinates, each beside its own stiffness.
fn general(system: Forced) -> Vec<f64> {
    const IRREGULAR: f64 = 0.618_033_988_749_895;
    let size = |(j, stiffness): (usize, f64)| (1.0 + (IRREGULAR * j as f64).fract()) * stiffness.abs().sqrt();
    system.body.stiffness().diagonal().into_iter().enumerate().map(size).collect()
}

/// Displacements under a load.
fn under(system: Forced, mut load: Vec<f64>) -> Vec<f64> {
    system.body.solve_stiffness(&mut load, 1);
    load
}
