//! Validity of the reduced equations at a given angular velocity: times, criteria, resonances and optimal order.
//! Every result is judged by the worst criterion that concerns the motion; dissipation and averages have verdicts of their own, since they
//! may fail where the motion holds.
//! Equations (V1) to (V11), docs/theory/04-validity.md; (R12) and (R14), docs/theory/03-reduction.md.

use thiserror::Error;

use super::angular_momentum_form::reverted;
use super::criterion::{Comparison, Criterion, Verdict};
use super::degrees::{Circles, DegreeSize, PowerChange, Sizes, levels_ratio, momentum_ratio, optimal_order};
use super::energetics;
use super::reduce::{ReductionError, manifold, reduce};
use super::relaxation::Relaxation;
use super::residual::residual;
use super::resonance::{Resonance, resonances};
use super::vibration::Vibrations;
use crate::math::eigen::NoConvergence;
use crate::math::vec3::{add, norm, scale};
use crate::model::MAX_ORDER;
use crate::model::{FlexibleBody, Principal, ReducedBody};

/// Validity of the reduced equations at an angular velocity. (V1)–(V11)
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let body = ring_of_points(4).body()?;
/// let validity = Validity::assess(&body, 3, [0.05, 0.0, 0.2])?;
/// assert!(validity.T1 > 0.0 && !validity.criteria.is_empty());
/// if validity.verdict() == Verdict::Fails {
///     println!("the reduced equations do not hold at this spin");
/// }
/// # Ok::<(), quasirigid::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Validity {
    /// Longest period of free vibration (s); zero for a rigid body. (V1)
    pub T1: f64,
    /// Time in which the slowest free vibration or relaxation decays by e (s); infinite if any of them does not decay. (V1)
    pub T2: f64,
    /// Time of the spin, `1/|ω|` (s). (V1)
    pub T3: f64,
    /// Free vibrations.
    pub vibrations: Vibrations,
    /// Relaxation of rotors and liquids.
    pub relaxation: Relaxation,
    /// Every criterion with its number.
    pub criteria: Vec<Criterion>,
    /// Harmonics of the polhode near an elastic frequency, strongest first.
    pub resonances: Vec<Resonance>,
    /// Watched place with the largest displacement, and the displacement (m).
    pub displacement: Option<(String, f64)>,
    /// Size of each degree of `f`, from 2 to at least `p + 4`. (R14)
    pub degrees: Vec<DegreeSize>,
    /// Order whose dropped terms are smallest, of those that the sizes can judge. (R14)
    pub optimal_order: usize,
}

/// Error of a validity that cannot be assessed.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ValidityError {
    /// The angular velocity is zero or no number.
    #[error("the angular velocity {omega:?} rad/s is not a spin; give a finite one that is not zero")]
    NoSpin {
        /// Angular velocity asked for (rad/s).
        omega: [f64; 3],
    },
    /// The vibrations could not be found.
    #[error(transparent)]
    Vibration(#[from] NoConvergence),
    /// The reduction failed.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
}

/// Degrees beyond the order asked for that the search for the optimal order takes.
const LOOK_AHEAD: usize = 4;
/// Spin over the lowest frequency at which sizes are measured.
const MEASURED: f64 = 0.1;

impl Validity {
    /// Assesses the equations of order `p` at an angular velocity (rad/s).
    ///
    /// # Errors
    /// [`ValidityError`] if the angular velocity is zero or not finite, the order is out of range, or an eigenvalue solver fails.
    pub fn assess(body: &FlexibleBody, order: usize, omega: [f64; 3]) -> Result<Self, ValidityError> {
        Self::assess_reduced(body, &reduce(body, order)?, omega)
    }

    /// Assesses the equations of a reduced body at an angular velocity (rad/s).
    ///
    /// # Errors
    /// As [`assess`](Self::assess).
    pub fn assess_reduced(
        body: &FlexibleBody,
        reduced: &ReducedBody,
        omega: [f64; 3],
    ) -> Result<Self, ValidityError> {
        Assessment::new(body, reduced)?.at(omega)
    }

    /// Worst verdict of the criteria that concern the motion on the slow manifold.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        self.worst(Comparison::concerns_motion)
    }

    /// Verdict on the power dissipated at the order and on the rates that follow, if the motion holds. (V11), (V12)
    #[must_use]
    pub fn dissipation(&self) -> Verdict {
        self.worst(|comparison| matches!(comparison, Comparison::Power | Comparison::Wobbles))
    }

    /// Verdict on averages along rigid polhodes, if the motion holds; where they fail, averages along levels of the slow energy may hold.
    /// (V10)
    #[must_use]
    pub fn averages(&self) -> Verdict {
        self.worst(|comparison| comparison == Comparison::Levels)
    }

    fn worst(&self, concerned: impl Fn(Comparison) -> bool) -> Verdict {
        let criteria = self.criteria.iter().filter(|criterion| concerned(criterion.comparison));
        criteria.map(Criterion::verdict).max().unwrap_or(Verdict::Holds)
    }
}

/// What the validity of a body takes of it at every angular velocity: its vibrations, and the equations some orders ahead. The costly part of
/// a [`Validity`], done once for many.
#[derive(Clone, Debug)]
pub struct Assessment<'a> {
    body: &'a FlexibleBody,
    reduced: ReducedBody,
    principal: Principal,
    vibrations: Vibrations,
    relaxation: Relaxation,
    /// Sizes of the equation `f` some orders ahead, and of the angular velocity as a series of the angular momentum.
    f: Sizes,
    Omega: Sizes,
    circles: Circles,
    /// Power of the order and of two orders ahead; at the highest orders of two orders behind.
    power: PowerChange,
}

impl<'a> Assessment<'a> {
    /// Prepares the assessment of the equations of a reduced body.
    ///
    /// # Errors
    /// [`ValidityError`] if the order is out of range, or an eigenvalue solver fails.
    pub fn new(body: &'a FlexibleBody, reduced: &ReducedBody) -> Result<Self, ValidityError> {
        let order = reduced.order;
        let ahead = manifold(body, (order + LOOK_AHEAD).min(MAX_ORDER))?;
        let other = if order + 2 <= MAX_ORDER { order + 2 } else { order - 2 };
        let other = energetics::power(body, &ahead, other).0;
        let [lower, higher] = if order + 2 <= MAX_ORDER {
            [reduced.power.clone(), other]
        } else {
            [other, reduced.power.clone()]
        };
        let vibrations = Vibrations::compute(body)?;
        // sizes are measured in the middle of the spins that the theory takes
        let radius = vibrations.frequencies.first().map_or(1.0, |slowest| MEASURED * slowest);
        let principal = Principal::compute(reduced.J);
        Ok(Self {
            body,
            relaxation: Relaxation::compute(body)?,
            Omega: Sizes::new(reverted(&ahead.K.truncated(5), reduced.J), radius * principal.moments[2]),
            power: PowerChange::new(lower, higher, radius),
            circles: Circles::new(&ahead.f, reduced.J, radius),
            f: Sizes::new(ahead.f, radius),
            principal,
            vibrations,
            reduced: reduced.clone(),
        })
    }

    /// Assesses the equations at an angular velocity (rad/s).
    ///
    /// # Errors
    /// [`ValidityError::NoSpin`].
    pub fn at(&self, omega: [f64; 3]) -> Result<Validity, ValidityError> {
        let Self { body, reduced, principal, vibrations, relaxation, f, .. } = self;
        let spin = norm(omega);
        if !spin.is_finite() || spin == 0.0 {
            return Err(ValidityError::NoSpin { omega });
        }
        let slowest = vibrations.frequencies.first().copied().unwrap_or(f64::INFINITY);
        let decay = vibrations.decay_rates.first().map_or(f64::INFINITY, |rate| rate.max(0.0));
        let decay = decay.min(relaxation.longest().recip());
        let resonances = if body.wheels().is_empty() {
            resonances(principal, &vibrations.free_frequencies, omega)
        } else {
            Vec::new()
        };
        let displacement = displacement(body, reduced, omega);
        let angular_momentum = norm(reduced.angular_momentum(omega));
        let series = |degrees| momentum_ratio(&self.Omega, angular_momentum, degrees);
        let criteria = [
            (Comparison::Spin, spin / slowest),
            (Comparison::Damping, spin * vibrations.damping_time),
            (Comparison::Relaxation, spin * relaxation.longest()),
            (Comparison::Series, series([1, 3]).max(series([3, 5]))),
            (Comparison::Resonance, resonances.first().map_or(0.0, |strongest| strongest.strength)),
            (Comparison::Linearity, displacement.as_ref().map_or(0.0, |(_, r)| r / size(body))),
            (Comparison::Residual, left_over(body, reduced, omega)),
            (Comparison::Power, self.power.at(spin)),
            (Comparison::Levels, levels_ratio(f, &self.circles, spin)),
            (Comparison::Forgetting, spin / decay),
        ];
        let degrees = f.degrees(spin);
        Ok(Validity {
            T1: std::f64::consts::TAU / slowest,
            T2: decay.recip(),
            T3: spin.recip(),
            vibrations: vibrations.clone(),
            relaxation: relaxation.clone(),
            criteria: criteria.map(|(comparison, value)| Criterion { comparison, value }).to_vec(),
            resonances,
            displacement,
            optimal_order: optimal_order(&degrees),
            degrees,
        })
    }
}

/// Residual of the reduced equations on the coordinates that their order slaves, relative to the load. (R12)
fn left_over(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> f64 {
    let residual = residual(body, reduced, omega);
    let elastic = if reduced.order > 1 { residual.elastic } else { 0.0 };
    let cyclic = if reduced.order > 0 { residual.cyclic } else { 0.0 };
    elastic.max(cyclic)
}

/// Watched place with the largest displacement on the slow manifold, and the displacement (m).
fn displacement(body: &FlexibleBody, reduced: &ReducedBody, omega: [f64; 3]) -> Option<(String, f64)> {
    let q = reduced.q.value(omega);
    let moved = body.markers().iter().map(|marker| {
        let r = marker.shapes.iter().fold([0.0; 3], |r, (j, H)| add(r, scale(q[*j], *H)));
        (marker.name.clone(), norm(r))
    });
    moved.max_by(|(_, a), (_, b)| a.total_cmp(b))
}

/// Size of the body: the largest distance of a marker or of the gyration of the whole body from the pole.
fn size(body: &FlexibleBody) -> f64 {
    let [xx, yy, zz, ..] = body.invariants().J;
    let gyration = (0.5 * (xx + yy + zz) / body.invariants().mass).sqrt();
    body.markers().iter().map(|marker| norm(marker.position)).fold(gyration, f64::max)
}
