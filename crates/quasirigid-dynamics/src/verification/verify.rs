//! Verification of orders: differences between full and reduced histories at ever stiffer springs, and their slope.
//! An order is a statement about `ε → 0`, so it can be measured on any body; differences near the error of the integrator are left out of
//! the slope.
//! Equation (E4), docs/theory/09-forced-reduction.md.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use thiserror::Error;

use super::compare::Difference;
use super::runs::{full, reduced};
use crate::dynamics::{Forced, Form, MAX_FORCED_ORDER, Options, Outcome, PropagateError, Start, takes};
use crate::math::vec3::norm;
use crate::model::FlexibleError;
use crate::reduction::{MAX_ORDER, ReductionError};
use crate::submanifold::SubmanifoldError;

/// Plan of a verification.
#[derive(Clone, Debug, PartialEq)]
pub struct VerificationPlan {
    /// Orders `p` to verify, from 0.
    pub orders: Vec<usize>,
    /// Revolutions of the histories at the initial spin.
    pub rotations: f64,
    /// Number of halvings of `ε`: `C → C/ε²`, `B → B/ε` with `ε = 1, ½, ¼, …`.
    pub halvings: usize,
    /// Number of times at which the histories are compared.
    pub samples: usize,
    /// Forms of the reduced equations; each with the orders that it is defined for. (P1), (P2), (E2), (E3)
    pub forms: Vec<Form>,
}

impl Default for VerificationPlan {
    fn default() -> Self {
        Self {
            orders: vec![1, 2, 3],
            rotations: 5.0,
            halvings: 4,
            samples: 200,
            forms: vec![Form::AngularMomentum, Form::AngularVelocity],
        }
    }
}

/// Differences between full and reduced histories, order by order.
#[derive(Clone, Debug, PartialEq)]
pub struct Verification {
    /// Factors `ε`, descending from 1, which is the model itself.
    pub epsilons: Vec<f64>,
    /// Duration of the histories (s).
    pub duration: f64,
    /// One row per form and order asked for.
    pub rows: Vec<OrderRow>,
    /// Steps of the full histories.
    pub steps: u64,
}

/// Differences measured at one order and form.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderRow {
    /// Order `p`.
    pub p: usize,
    /// Form of the equations.
    pub form: Form,
    /// Differences at each `ε`.
    pub differences: Vec<Difference>,
    /// Order in `ε` of the difference in angular velocity, from the two smallest `ε` whose differences stand above rounding; none without
    /// two.
    pub order: Option<f64>,
}

/// Error of a verification that could not be made.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VerificationError {
    /// No order to verify.
    #[error("no order to verify; choose orders from 0 to {highest}")]
    NoOrder {
        /// Highest order.
        highest: usize,
    },
    /// The order is out of range.
    #[error("order {order} cannot be verified here; choose orders from 0 to {highest}")]
    Order {
        /// Order asked for.
        order: usize,
        /// Highest order.
        highest: usize,
    },
    /// An amplitude of the nutation that no reduced equations about a spin reach.
    #[error(
        "an amplitude of {degrees} degrees is out of range; choose more than 0, and up to {most} degrees"
    )]
    Amplitude {
        /// Amplitude asked for (degrees).
        degrees: f64,
        /// Largest amplitude (degrees).
        most: f64,
    },
    /// A number of the plan is out of range.
    #[error(
        "a verification over {rotations} rotations with {halvings} halvings is out of range; choose more than 0 rotations, and 1 to 12 halvings"
    )]
    Plan {
        /// Rotations asked for.
        rotations: f64,
        /// Halvings asked for.
        halvings: usize,
    },
    /// The reduction failed.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// The stiffened body is invalid.
    #[error(transparent)]
    Body(#[from] FlexibleError),
    /// There are no reduced equations about the spin.
    #[error(transparent)]
    Submanifold(#[from] SubmanifoldError),
    /// The slow series does not hold at the angular velocity of the start. (Q8)
    #[error(
        "there is no slow manifold to start on at {spin:.4e} rad/s: the truncated series is not small there; lower the spin, or raise the stiffness of springs and the friction of rotors and liquids"
    )]
    NoSlowManifold {
        /// The angular velocity (rad/s).
        spin: f64,
    },
    /// The body does not turn at the start.
    #[error(
        "the body is at rest at the start: a verification lasts a number of rotations; give it an angular velocity"
    )]
    AtRest,
    /// A history could not start.
    #[error(transparent)]
    Propagate(#[from] PropagateError),
    /// A history ended early.
    #[error("a history ended early: {outcome}")]
    Unfinished {
        /// Reason of the end.
        outcome: Outcome,
    },
    /// The observer asked for an end.
    #[error("the verification was interrupted")]
    Interrupted,
}

/// Tolerances of the full and the reduced histories.
const FULL_TOLERANCE: f64 = 1e-13;
const REDUCED_TOLERANCE: f64 = 1e-14;
/// Relative difference in angular velocity per revolution that may be rounding; the errors allowed in the steps of the full history add
/// up to it.
const ROUNDING_PER_REVOLUTION: f64 = 1e-12;

/// Verifies orders: runs the full system and the reduced ones from the slow manifold, at `ε = 1, ½, ¼, …`. (E4)
///
/// ```
/// use std::ops::ControlFlow;
///
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let body = ring_of_points(1).body()?;
/// let start = Start::new([0.1, 0.2, 0.5], ALIGNED);
/// let plan = VerificationPlan { orders: vec![2], rotations: 0.5, samples: 5, ..VerificationPlan::default() };
/// let verification = verify(Forced::not(&body), &start, &plan, &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!(verification.epsilons.len(), 5);
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// `watch` is called with the share of the work done; `Break` ends the verification.
///
/// # Errors
/// [`VerificationError`].
pub fn verify(
    system: Forced,
    start: &Start,
    plan: &VerificationPlan,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let highest = check(system, plan)?;
    if start.omega == [0.0; 3] {
        return Err(VerificationError::AtRest);
    }
    let duration = plan.rotations * TAU / norm(start.omega);
    let times: Vec<f64> = (1..=plan.samples).map(|i| duration * i as f64 / plan.samples as f64).collect();
    let epsilons = halved(plan.halvings);
    let all = plan.forms.iter().flat_map(|form| plan.orders.iter().map(|p| (*form, *p)));
    let mut rows: Vec<OrderRow> = all
        .filter(|(form, p)| takes(system, *form, *p))
        .map(|(form, p)| OrderRow { p, form, differences: Vec::new(), order: None })
        .collect();
    let runs = (epsilons.len() * (rows.len() + 1)) as f64;
    let (mut done, mut floors, mut steps) = (0.0, Vec::new(), 0);
    for epsilon in &epsilons {
        let body = system.body.stiffened(*epsilon)?;
        let scaled = Forced { body: &body, ..system };
        let part = |done: f64| move |t: f64| (done + t / duration) / runs;
        let mut share = part(done);
        let options = |form, tolerance: f64| Options { form, tolerance, ..Options::default() };
        let exact = options(Form::AngularMomentum, FULL_TOLERANCE);
        let truth = full(scaled, start, highest, &times, &exact, &mut |t| watch(share(t)))?;
        floors.push(ROUNDING_PER_REVOLUTION * plan.rotations.max(1.0) + FULL_TOLERANCE * truth.steps as f64);
        steps += truth.steps;
        done += 1.0;
        for row in &mut rows {
            share = part(done);
            let options = options(row.form, REDUCED_TOLERANCE);
            let history = reduced(scaled, &truth.start, row.p, &times, &options, &mut |t| watch(share(t)))?;
            row.differences.push(Difference::between(&truth.samples, &history));
            done += 1.0;
        }
    }
    for row in &mut rows {
        row.order = slope(&epsilons, &row.differences, &floors);
    }
    Ok(Verification { epsilons, duration, rows, steps })
}

/// Checks a plan; returns the highest order asked for.
fn check(system: Forced, plan: &VerificationPlan) -> Result<usize, VerificationError> {
    let highest = if system.acts() { MAX_FORCED_ORDER - 2 } else { MAX_ORDER - 2 };
    let Some(&most) = plan.orders.iter().max() else {
        return Err(VerificationError::NoOrder { highest });
    };
    if most > highest {
        return Err(VerificationError::Order { order: most, highest });
    }
    let VerificationPlan { rotations, halvings, .. } = *plan;
    if !(rotations > 0.0 && rotations.is_finite() && (1..=12).contains(&halvings)) {
        return Err(VerificationError::Plan { rotations, halvings });
    }
    Ok(most)
}

/// Slope of the difference in angular velocity at the smallest `ε` where the difference stands above the error of the integrator.
pub(super) fn slope(epsilons: &[f64], differences: &[Difference], floors: &[f64]) -> Option<f64> {
    let above =
        differences.iter().zip(floors).take_while(|(difference, floor)| difference.omega > **floor).count();
    let (last, before) = (above.checked_sub(1)?, above.checked_sub(2)?);
    let ratio = differences[before].omega / differences[last].omega;
    Some(ratio.ln() / (epsilons[before] / epsilons[last]).ln())
}

/// Shortfall of the measured order up to which an order counts as reached.
const ORDER_SHORTFALL: f64 = 0.3;

/// Factors `ε = 1, ½, ¼, …` for a number of halvings.
pub(super) fn halved(halvings: usize) -> Vec<f64> {
    (0..=halvings).map(|k| 0.5_f64.powi(k as i32)).collect()
}

/// True if differences fall with the expected order; without a measured order they are small enough.
pub(super) fn falls(order: Option<f64>, expected: usize, mut differences: impl Iterator<Item = f64>) -> bool {
    order.is_none_or(|order| order > expected as f64 - ORDER_SHORTFALL) && differences.all(f64::is_finite)
}

impl OrderRow {
    /// True if the difference falls as `ε^{p+1}`, or is at the level of rounding.
    #[must_use]
    pub fn reached(&self) -> bool {
        falls(self.order, self.p + 1, self.differences.iter().map(|difference| difference.omega))
    }
}

impl Verification {
    /// True if every order asked for was reached.
    #[must_use]
    pub fn reached(&self) -> bool {
        self.rows.iter().all(OrderRow::reached)
    }
}
