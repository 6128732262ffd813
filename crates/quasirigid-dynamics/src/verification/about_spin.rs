//! Verification of the reduced equations about a spin: differences from full histories at ever smaller nutations, and their slope.
//! The full history starts on the spin manifold of the degree that is verified, so that the difference is that of the equations alone.
//! Equations (W3), (W14), docs/theory/18-submanifolds.md.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::compare::Difference;
use super::runs::finished;
use super::verify::{VerificationError, falls, slope};
use crate::dynamics::{Forced, Observer, Options, Sample, propagate_full};
use crate::model::FlexibleBody;
use crate::submanifold::{
    MAX_AMPLITUDE, ManifoldStart, SpinManifold, SpinManifoldPlan, propagate_on_manifold,
};

/// Plan of a verification about a spin.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinVerificationPlan {
    /// Steady spin, masters and style; its degree is not read.
    pub about: SpinManifoldPlan,
    /// Degrees to verify, from 1.
    pub degrees: Vec<usize>,
    /// Largest amplitude of the nutation (rad).
    pub amplitude: f64,
    /// Number of halvings of the amplitude.
    pub halvings: usize,
    /// Periods of the nutation over which the histories are compared.
    pub periods: f64,
    /// Number of times at which they are compared.
    pub samples: usize,
}

/// Differences between full histories and those of the reduced equations about a spin, degree by degree. (W14)
#[derive(Clone, Debug, PartialEq)]
pub struct SpinVerification {
    /// Amplitudes of the nutation (rad), descending.
    pub amplitudes: Vec<f64>,
    /// Duration of the histories (s).
    pub duration: f64,
    /// One row per degree.
    pub rows: Vec<DegreeRow>,
    /// Steps of the full histories.
    pub steps: u64,
}

/// Differences measured at one degree.
#[derive(Clone, Debug, PartialEq)]
pub struct DegreeRow {
    /// Degree `p`.
    pub degree: usize,
    /// Differences at each amplitude.
    pub differences: Vec<Difference>,
    /// Order in the amplitude of the difference in angular velocity, from the two smallest amplitudes whose differences stand above
    /// rounding; none without two.
    pub order: Option<f64>,
}

impl DegreeRow {
    /// True if the difference falls as `amplitude^{p+1}`, or is at the level of rounding.
    #[must_use]
    pub fn reached(&self) -> bool {
        falls(self.order, self.degree + 1, self.differences.iter().map(|difference| difference.omega))
    }
}

impl SpinVerification {
    /// True if every degree asked for was reached.
    #[must_use]
    pub fn reached(&self) -> bool {
        self.rows.iter().all(DegreeRow::reached)
    }
}

/// Tolerance of the histories, and the difference in angular velocity per period that may be rounding.
const HISTORY_TOLERANCE: f64 = 1e-13;
const ROUNDING_PER_PERIOD: f64 = 3e-12;

/// Verifies reduced equations about a spin: runs the full system and the reduced equations from the same points of the spin manifold at an
/// amplitude and its halves. (W14)
///
/// `watch` is called with the share of the work done; `Break` ends the verification.
///
/// # Errors
/// [`VerificationError`].
pub fn verify_about_spin(
    body: &FlexibleBody,
    plan: &SpinVerificationPlan,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<SpinVerification, VerificationError> {
    check(plan)?;
    let amplitudes: Vec<f64> = (0..=plan.halvings).map(|k| plan.amplitude * 0.5_f64.powi(k as i32)).collect();
    let whole = (plan.degrees.len() * amplitudes.len()) as f64;
    let mut found =
        SpinVerification { amplitudes: amplitudes.clone(), duration: 0.0, rows: Vec::new(), steps: 0 };
    for (i, degree) in plan.degrees.iter().copied().enumerate() {
        let about = SpinManifoldPlan { degree, ..plan.about.clone() };
        let manifold =
            SpinManifold::derive(body, &about, &mut |_| watch(i as f64 / plan.degrees.len() as f64))?;
        found.duration = plan.periods * TAU / manifold.masters[0].frequency;
        let mut differences = Vec::with_capacity(amplitudes.len());
        let mut floors = Vec::with_capacity(amplitudes.len());
        for (k, amplitude) in amplitudes.iter().copied().enumerate() {
            let share = (i * amplitudes.len() + k) as f64 / whole;
            let (difference, steps) =
                compared(&manifold, amplitude, plan, found.duration, &mut || watch(share))?;
            found.steps += steps;
            floors.push(ROUNDING_PER_PERIOD * plan.periods.max(1.0) + HISTORY_TOLERANCE * steps as f64);
            differences.push(difference);
        }
        let order = slope(&amplitudes, &differences, &floors);
        found.rows.push(DegreeRow { degree, differences, order });
    }
    Ok(found)
}

fn check(plan: &SpinVerificationPlan) -> Result<(), VerificationError> {
    let SpinVerificationPlan { amplitude, halvings, periods, .. } = *plan;
    if plan.degrees.is_empty() {
        return Err(VerificationError::NoOrder { highest: crate::submanifold::MAX_DEGREE });
    }
    if !(amplitude > 0.0 && amplitude <= MAX_AMPLITUDE) {
        return Err(VerificationError::Amplitude {
            degrees: amplitude.to_degrees(),
            most: MAX_AMPLITUDE.to_degrees().floor(),
        });
    }
    let sound = periods > 0.0 && periods.is_finite();
    if !(sound && (1..=12).contains(&halvings)) {
        return Err(VerificationError::Plan { rotations: periods, halvings });
    }
    Ok(())
}

/// Difference of a full and a reduced history from the same point of the spin manifold, and the steps of the full one.
fn compared(
    manifold: &SpinManifold,
    amplitude: f64,
    plan: &SpinVerificationPlan,
    duration: f64,
    watch: &mut dyn FnMut() -> ControlFlow<()>,
) -> Result<(Difference, u64), VerificationError> {
    let times: Vec<f64> = (1..=plan.samples).map(|i| duration * i as f64 / plan.samples as f64).collect();
    let mut z = vec![[0.0; 2]; manifold.expansion().free()];
    z[0] = [amplitude * PHASE.cos(), amplitude * PHASE.sin()];
    let attitude = crate::math::rotation::ALIGNED;
    let state = manifold.full_state(&z, attitude);
    let start = ManifoldStart { z, attitude, place: [0.0; 3], velocity: [0.0; 3], left_out: 0.0 };
    let options = Options { tolerance: HISTORY_TOLERANCE, ..Options::default() };
    let mut full = Collector { samples: Vec::new(), watch };
    let run = propagate_full(Forced::not(manifold.body), &state, &times, &options, &mut full)?;
    finished(run.outcome)?;
    let Collector { samples: full, watch } = full;
    let mut reduced = Collector { samples: Vec::new(), watch };
    finished(propagate_on_manifold(manifold, &start, &times, &options, &mut reduced)?.outcome)?;
    Ok((Difference::between(&full, &reduced.samples), run.work.steps))
}

/// Phase (rad) of the start: off the axes of every symmetry.
const PHASE: f64 = 0.4;

struct Collector<'a> {
    samples: Vec<Sample>,
    watch: &'a mut dyn FnMut() -> ControlFlow<()>,
}

impl Observer for Collector<'_> {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn progress(&mut self, _: f64) -> ControlFlow<()> {
        (self.watch)()
    }
}
