use std::ops::ControlFlow;

use super::{Dop853, StepError, System};
use crate::math::simd::Arithmetic;

/// What happens along an integration.
pub trait Watcher<const N: usize> {
    /// The state at an output time.
    fn output(&mut self, t: f64, y: [f64; N]);

    /// Called after each step, and free to correct the state; `Break` ends the integration.
    fn stepped(&mut self, solver: &mut Dop853<N>) -> ControlFlow<()>;
}

/// Why an integration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// The last output time was reached.
    Finished,
    /// The watcher asked for an end.
    Interrupted,
    /// The steps allowed were used up.
    StepLimit,
    /// No step could be made.
    Failed(StepError),
}

/// Integrates to the last of the ascending `times`, with outputs at each of them.
#[inline(always)]
pub fn integrate<A: Arithmetic, const N: usize>(
    solver: &mut Dop853<N>,
    system: &impl System<N>,
    times: &[f64],
    most_steps: u64,
    watcher: &mut impl Watcher<N>,
) -> Ending {
    let mut next = 0;
    while next < times.len() && times[next] <= solver.t() {
        watcher.output(times[next], *solver.y());
        next += 1;
    }
    while next < times.len() {
        if solver.work().steps >= most_steps {
            return Ending::StepLimit;
        }
        if let Err(error) = solver.step::<A>(system, times[times.len() - 1]) {
            return Ending::Failed(error);
        }
        if times[next] <= solver.t() {
            let dense = solver.dense::<A>(system);
            while next < times.len() && times[next] <= solver.t() {
                watcher.output(times[next], dense.at(times[next]));
                next += 1;
            }
        }
        if watcher.stepped(solver).is_break() {
            return Ending::Interrupted;
        }
    }
    Ending::Finished
}
