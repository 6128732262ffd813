//! Integration of the reduced equations under external forces, in either form.
//! The angular-velocity form starts with the pole where its own displacements put it, or forces that depend on place cost an order or two.
//! Equations (E1) to (E3), docs/theory/09-forced-reduction.md; (P7), docs/theory/05-propagation.md.

use super::equations::SlowEquations;
use super::flow::{MAX_FORCED_ORDER, SlowPoint};
use super::motion::SlowMotion;
use super::state::SlowState;
use super::state::slow_state_point;
use super::system::SlowSystem;
use crate::dynamics::conserved_momentum::Conserved;
use crate::dynamics::external::Forced;
use crate::dynamics::invariant_monitor::{InvariantMonitor, StateView};
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, PLACE, SLOW_LENGTH, VELOCITY};
use crate::dynamics::position;
use crate::dynamics::run::{Observer, Options, PropagateError, Run, check, check_covered};
use crate::dynamics::scale::Scales;
use crate::math::ode::{Dop853, Solver, Stretch, integrate};
use crate::math::simd::Unfused;
use crate::model::{Form, MotionState};

/// Highest order of a form under forces.
fn highest(form: Form) -> usize {
    match form {
        Form::AngularMomentum => MAX_FORCED_ORDER,
        Form::AngularVelocity => 3,
    }
}

/// True if a form of the reduced equations of this order applies to a body: under forces the angular-velocity form covers elastic
/// coordinates alone, to order 3. (E3)
#[must_use]
pub fn takes(system: Forced, form: Form, order: usize) -> bool {
    let elastic_only = system.body.cyclic().is_empty() && system.body.wheels().is_empty();
    !system.acts() || (order <= highest(form) && (form == Form::AngularMomentum || elastic_only))
}

/// Start of the angular-velocity form: the angular velocity, and the pole displaced from the centre of mass by the displacements of (E3).
/// (P7)
fn paper_start(
    equations: SlowEquations,
    start: &SlowPoint,
    center: [f64; SLOW_LENGTH],
) -> [f64; SLOW_LENGTH] {
    let slow = SlowSystem { equations, form: Form::AngularVelocity, stretch: Stretch::default() };
    let put = |motion: MotionState<f64>| {
        let [pole, pole_velocity] = position::pole(equations.system.body, motion, &center);
        let mut y = center;
        y[MOMENTUM..MOMENTUM + 3].copy_from_slice(&start.omega);
        y[PLACE..PLACE + 3].copy_from_slice(&pole);
        y[VELOCITY..VELOCITY + 3].copy_from_slice(&pole_velocity);
        y
    };
    let StateView { omega, q, rate, .. } = slow.view(0.0, &put(start.motion()));
    put(MotionState { omega, q: &q, rate: &rate })
}

/// Integrates the reduced equations of a body under external forces from `t = 0` and observes the body at the output times (s).
/// (E1)–(E3), (E6)
///
/// The angular-momentum form takes orders to [`MAX_FORCED_ORDER`], the angular-velocity form to 3.
///
/// # Errors
/// [`PropagateError`] before the first step. A later failure is an [`Outcome`](crate::dynamics::Outcome).
pub fn propagate_forced(
    equations: SlowEquations,
    initial: &SlowState,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    let SlowEquations { system, order, .. } = equations;
    if order > highest(options.form) {
        return Err(PropagateError::Order { order });
    }
    let elastic_only = system.body.cyclic().is_empty() && system.body.wheels().is_empty();
    if options.form == Form::AngularVelocity && !elastic_only {
        return Err(PropagateError::AngularVelocityForm);
    }
    if ![initial.place, initial.velocity].as_flattened().iter().all(|value| value.is_finite()) {
        return Err(PropagateError::NotFinite);
    }
    let end = times.last().copied().unwrap_or_default();
    check_covered(system.forces, end)?;
    let settled = match options.form {
        Form::AngularMomentum => None,
        Form::AngularVelocity => Some(slow_state_point(system, order, initial)?),
    };
    let omega = match &settled {
        Some(point) => point.omega,
        None => equations.angular_velocity(initial)?,
    };
    let pose = initial.pose(0.0);
    let (scales, mut timing) = Scales::timed(system, omega, initial.angular_momentum, pose, end);
    check(scales.spin, initial.attitude, times, options)?;
    let mut y = initial.pack();
    let mut first = scales.angular_momentum;
    if let Some(point) = &settled {
        y = paper_start(equations, point, y);
        first = scales.spin;
    }
    let mut allowed = [f64::INFINITY; SLOW_LENGTH];
    allowed[MOMENTUM..MOMENTUM + 3].fill(options.tolerance * first);
    allowed[ATTITUDE..ATTITUDE + 4].fill(options.tolerance);
    allowed[PLACE..PLACE + 3].fill(options.tolerance * scales.place);
    allowed[VELOCITY..VELOCITY + 3].fill(options.tolerance * scales.velocity);
    let slow = SlowSystem { equations, form: options.form, stretch: Stretch::default() };
    let angular_momentum = slow.view(0.0, &y).angular_momentum;
    let angular_momentum = Conserved::of(angular_momentum, initial.attitude, scales.inside);
    let mut monitor =
        InvariantMonitor::new(SlowMotion::new(slow, &y), &y, angular_momentum, options, observer);
    if let Some(timing) = &mut timing {
        timing.allow(system, scales.allowed(options.tolerance));
    }
    monitor.timing = timing;
    let mut solver = Dop853::<_, _, Unfused>::new(slow, 0.0, y, allowed);
    let first = monitor.resume(&mut solver)?;
    let reason = integrate(&mut solver, times, first, options.most_steps, &mut monitor);
    let last = monitor.sample(solver.t(), solver.y());
    let outcome = monitor.outcome(reason);
    let motion = &monitor.trajectory;
    let (left_out, load_ratio, ringing) = (motion.left_out(), motion.load_ratio(), motion.ringing());
    Ok(Run { outcome, last, work: solver.work(), scan: monitor.scan(), left_out, load_ratio, ringing })
}
