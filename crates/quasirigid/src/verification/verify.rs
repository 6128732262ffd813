use std::f64::consts::TAU;
use std::ops::ControlFlow;

use thiserror::Error;

use super::compare::Difference;
use super::runs::{full, reduced};
use crate::dynamics::{Forced, Form, MAX_FORCED_ORDER, Options, Outcome, PropagateError, Start, takes};
use crate::math::vec3::norm;
use crate::model::FlexibleError;
use crate::reduction::{MAX_ORDER, ReductionError};

/// What a verification does.
#[derive(Clone, Debug, PartialEq)]
pub struct VerificationPlan {
    /// Orders `p` to verify, from 0.
    pub orders: Vec<usize>,
    /// Turns of the histories at the initial spin.
    pub rotations: f64,
    /// How often `ε` is halved: `C → C/ε²`, `B → B/ε` with `ε = 1, ½, ¼, …`.
    pub halvings: usize,
    /// Times at which the histories are compared.
    pub samples: usize,
    /// Forms of the reduced equations; each takes the orders that it is written for. (P1), (P2), (E2), (E3)
    pub forms: Vec<Form>,
}

impl Default for VerificationPlan {
    fn default() -> Self {
        Self {
            orders: vec![1, 2, 3],
            rotations: 5.0,
            halvings: 4,
            samples: 200,
            forms: vec![Form::Momentum, Form::Paper],
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
    /// Steps that the full histories took.
    pub steps: u64,
}

/// What was measured at one order.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderRow {
    /// Order `p`.
    pub p: usize,
    /// Form of the equations.
    pub form: Form,
    /// Differences at each `ε`.
    pub differences: Vec<Difference>,
    /// Order in `ε` of the difference in spin, from the smallest `ε` whose difference stands above rounding; none if
    /// there are no two of them.
    pub order: Option<f64>,
}

/// A verification that could not be made.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum VerificationError {
    /// No order to verify.
    #[error("no order to verify; choose orders from 0 to {highest}")]
    NoOrder {
        /// Highest order.
        highest: usize,
    },
    /// An order out of range.
    #[error("order {order} cannot be verified here; choose orders from 0 to {highest}")]
    Order {
        /// Order asked for.
        order: usize,
        /// Highest order.
        highest: usize,
    },
    /// A number of the plan that means nothing.
    #[error(
        "a verification over {rotations} rotations with {halvings} halvings means nothing; choose more than 0 rotations, and 1 to 12 halvings"
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
    /// The stiffened body is no body.
    #[error(transparent)]
    Body(#[from] FlexibleError),
    /// A history could not start.
    #[error(transparent)]
    Propagate(#[from] PropagateError),
    /// A history ended early.
    #[error("a history ended early: {outcome}")]
    Unfinished {
        /// Why it ended.
        outcome: Outcome,
    },
    /// The observer asked for an end.
    #[error("the verification was interrupted")]
    Interrupted,
}

/// Tolerances of the full and the reduced histories.
const FULL: f64 = 1e-13;
const REDUCED: f64 = 1e-14;
/// Differences in spin below this, per turn, may be rounding; the error allowed in each step of the full history adds up.
const ROUNDING: f64 = 1e-12;

/// Runs the full system and the reduced ones side by side, from the slow manifold, at `ε = 1, ½, ¼, …`. (E4)
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
        let exact = options(Form::Momentum, FULL);
        let truth = full(scaled, start, highest, &times, &exact, &mut |t| watch(share(t)))?;
        floors.push(ROUNDING * plan.rotations.max(1.0) + FULL * truth.steps as f64);
        steps += truth.steps;
        done += 1.0;
        for row in &mut rows {
            share = part(done);
            let options = options(row.form, REDUCED);
            let history = reduced(scaled, &truth.start, row.p, &times, &options, &mut |t| watch(share(t)))?;
            row.differences.push(Difference::between(&truth.samples, &history));
            done += 1.0;
        }
    }
    for row in &mut rows {
        row.order = order(&epsilons, &row.differences, &floors);
    }
    Ok(Verification { epsilons, duration, rows, steps })
}

/// The highest order asked for.
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

/// Slope of the difference in spin at the smallest `ε` where it stands above the integrator's own error.
fn order(epsilons: &[f64], differences: &[Difference], floors: &[f64]) -> Option<f64> {
    let above =
        differences.iter().zip(floors).take_while(|(difference, floor)| difference.omega > **floor).count();
    let (last, before) = (above.checked_sub(1)?, above.checked_sub(2)?);
    let ratio = differences[before].omega / differences[last].omega;
    Some(ratio.ln() / (epsilons[before] / epsilons[last]).ln())
}

/// An order that falls short by more than this is not reached.
const SHORT: f64 = 0.3;

/// Factors `ε = 1, ½, ¼, …` of so many halvings.
pub(super) fn halved(halvings: usize) -> Vec<f64> {
    (0..=halvings).map(|k| 0.5_f64.powi(k as i32)).collect()
}

/// Whether differences fall with the order expected; those in which no order is found are small enough.
pub(super) fn falls(order: Option<f64>, expected: usize, mut differences: impl Iterator<Item = f64>) -> bool {
    order.is_none_or(|order| order > expected as f64 - SHORT) && differences.all(f64::is_finite)
}

impl OrderRow {
    /// Whether the difference falls as `ε^{p+1}`, as it should; a difference that cannot be told from rounding is small
    /// enough.
    #[must_use]
    pub fn reached(&self) -> bool {
        falls(self.order, self.p + 1, self.differences.iter().map(|difference| difference.omega))
    }
}

impl Verification {
    /// Whether every order asked for was reached.
    #[must_use]
    pub fn reached(&self) -> bool {
        self.rows.iter().all(OrderRow::reached)
    }
}
