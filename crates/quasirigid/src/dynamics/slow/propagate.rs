use super::flow::MAX_FORCED_ORDER;
use super::state::SlowState;
use super::state::slow_state_point;
use super::system::SlowSystem;
use crate::dynamics::external::Forced;
use crate::dynamics::form::Form;
use crate::dynamics::keeper::Keeper;
use crate::dynamics::layout::{ATTITUDE, MOMENTUM, PLACE, SLOW, VELOCITY};
use crate::dynamics::run::{Observer, Options, Outcome, PropagateError, Run, check};
use crate::dynamics::scale::Scales;
use crate::math::ode::{Dop853, Solver, integrate};
use crate::math::simd::Plain;

/// Follows the reduced equations of order `p` of a body under external forces from `t = 0` and observes it at the times
/// asked for (s). (E1)–(E3)
///
/// The momentum form takes orders to [`MAX_FORCED_ORDER`], the paper's form to 3.
///
/// # Errors
/// [`PropagateError`] before the first step. What goes wrong later is an [`Outcome`].
pub fn propagate_forced(
    system: Forced,
    order: usize,
    initial: &SlowState,
    times: &[f64],
    options: Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    let highest = if options.form == Form::Paper { 3 } else { MAX_FORCED_ORDER };
    if order > highest {
        return Err(PropagateError::Order { order });
    }
    let elastic_only = system.body.cyclic().is_empty() && system.body.wheels().is_none();
    if options.form == Form::Paper && !elastic_only {
        return Err(PropagateError::PaperForm);
    }
    if ![initial.place, initial.velocity].as_flattened().iter().all(|value| value.is_finite()) {
        return Err(PropagateError::NotFinite);
    }
    let omega = slow_state_point(system, order, initial)?.omega;
    let end = times.last().copied().unwrap_or_default();
    let scales = Scales::of(system, omega, initial.momentum, initial.pose(0.0), end);
    check(scales.spin, initial.attitude, times, options.tolerance)?;
    let mut y = initial.pack();
    let mut first = scales.momentum;
    if options.form == Form::Paper {
        y[MOMENTUM..MOMENTUM + 3].copy_from_slice(&omega);
        first = scales.spin;
    }
    let mut allowed = [f64::INFINITY; SLOW];
    allowed[MOMENTUM..MOMENTUM + 3].fill(options.tolerance * first);
    allowed[ATTITUDE..ATTITUDE + 4].fill(options.tolerance);
    allowed[PLACE..PLACE + 3].fill(options.tolerance * scales.place);
    allowed[VELOCITY..VELOCITY + 3].fill(options.tolerance * scales.velocity);
    let slow = SlowSystem { system, order, form: options.form };
    let mut keeper = Keeper::new(slow, &y, scales.inside, &options, observer);
    let mut solver = Dop853::<_, _, Plain>::new(slow, 0.0, y, allowed);
    let ending = integrate(&mut solver, times, options.most_steps, &mut keeper);
    let last = keeper.sample(solver.t(), solver.y());
    Ok(Run { outcome: Outcome::of(ending, keeper.alarm.rung), last, work: solver.work() })
}
