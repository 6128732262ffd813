use std::ops::ControlFlow;

use super::{Dense, Solver, StepError};

/// What happens along an integration.
pub trait Watcher<M: Solver> {
    /// The state at an output time.
    fn output(&mut self, t: f64, y: &M::State);

    /// The time within the last step at which the integration is to end, if there is one.
    fn event(&mut self, solver: &mut M) -> Option<f64> {
        let _ = solver;
        None
    }

    /// Called after each step, and free to correct the state; `Break` ends the integration.
    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()>;
}

/// Why an integration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// The last output time was reached.
    Finished,
    /// The watcher asked for an end.
    Interrupted,
    /// An event of the watcher happened; the state is the one of that moment.
    Event,
    /// The steps allowed were used up.
    StepLimit,
    /// No step could be made.
    Failed(StepError),
}

/// Integrates to the last of the ascending `times`, with outputs at each of them.
#[inline(always)]
pub fn integrate<M: Solver>(
    solver: &mut M,
    times: &[f64],
    most_steps: u64,
    watcher: &mut impl Watcher<M>,
) -> Ending {
    let mut next = 0;
    while next < times.len() && times[next] <= solver.t() {
        watcher.output(times[next], solver.y());
        next += 1;
    }
    while next < times.len() {
        if solver.work().steps >= most_steps {
            return Ending::StepLimit;
        }
        if let Err(error) = solver.step(times[times.len() - 1]) {
            return Ending::Failed(error);
        }
        let event = watcher.event(solver);
        let reached = event.unwrap_or(solver.t());
        if times[next] <= reached || event.is_some() {
            let dense = solver.dense();
            next = outputs(solver, &dense, times, next, reached, watcher);
            if event.is_some() {
                solver.rewind(reached, dense.at(reached));
                return Ending::Event;
            }
        }
        if watcher.stepped(solver).is_break() {
            return Ending::Interrupted;
        }
    }
    Ending::Finished
}

/// Outputs at the times up to the one reached; the number of the next time.
#[inline(always)]
fn outputs<M: Solver>(
    solver: &mut M,
    dense: &Dense<M::State>,
    times: &[f64],
    first: usize,
    reached: f64,
    watcher: &mut impl Watcher<M>,
) -> usize {
    let mut next = first;
    while next < times.len() && times[next] <= reached {
        watcher.output(times[next], &solver.output(dense, times[next]));
        next += 1;
    }
    next
}
