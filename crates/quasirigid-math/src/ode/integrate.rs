//! Integration to output times: steps, events, dense outputs and the reasons to stop.
//! Events and corrections of an observer act between steps, so that every method gets them without code of its own.

use std::ops::ControlFlow;

use super::{DenseOutput, Solver, StepError, Stretch};

/// Observer of an integration from step to step.
pub trait StepObserver<M: Solver> {
    /// The state at an output time.
    fn output(&mut self, t: f64, y: &M::State);

    /// Time of an event within the last step, at which the integration ends; none without an event.
    fn event(&mut self, solver: &mut M) -> Option<f64> {
        let _ = solver;
        None
    }

    /// Time that no step from `t` on passes: the next breakpoint of the rate, or place where it changes quickly. (Z1)
    fn stop(&mut self, t: f64) -> f64 {
        let _ = t;
        f64::INFINITY
    }

    /// The stretch between breakpoints of the rate that a step from `t` on lies in, and whether it begins there; none without breakpoints.
    fn stretch(&mut self, t: f64) -> Option<(Stretch, bool)> {
        let _ = t;
        None
    }

    /// State at the start of the last step where this is taken back, because it has passed something that acted within it: the next steps then
    /// stop earlier. (Z5)
    fn takes_back(&mut self, solver: &mut M) -> Option<M::State> {
        let _ = solver;
        None
    }

    /// Called after each step, and free to correct the state; `Break` ends the integration.
    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()>;
}

/// Reason for which an integration stopped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StopReason {
    /// The last output time was reached.
    Finished,
    /// The observer asked for an end.
    Interrupted,
    /// An event of the observer happened; the state is the one of that moment.
    Event,
    /// The steps allowed are used up.
    StepLimit,
    /// No step could be made.
    Failed(StepError),
}

/// Integrates to the last of the ascending `times`, with outputs at each of them from the one with the number `first` on.
#[inline(always)]
pub fn integrate<M: Solver>(
    solver: &mut M,
    times: &[f64],
    first: usize,
    most_steps: u64,
    observer: &mut impl StepObserver<M>,
) -> StopReason {
    let end = times.last().copied().unwrap_or_default();
    integrate_until(solver, end, times, first, most_steps, observer).0
}

/// Integrates to a time not beyond the last of the ascending `times`, with outputs at each of them from the one with the number `first` on;
/// returns also the number of the next output.
#[inline(always)]
pub fn integrate_until<M: Solver>(
    solver: &mut M,
    end: f64,
    times: &[f64],
    first: usize,
    most_steps: u64,
    observer: &mut impl StepObserver<M>,
) -> (StopReason, usize) {
    let mut next = first;
    match observer.stretch(solver.t()) {
        Some((stretch, true)) if solver.work().steps > 0 => solver.restart(stretch),
        Some((stretch, _)) => solver.enter(stretch),
        None => {}
    }
    while next < times.len() && times[next] <= solver.t() {
        observer.output(times[next], solver.y());
        next += 1;
    }
    let mut pace = Pace { since: solver.t(), steps: 0, longest: 0.0 };
    while next < times.len() && solver.t() < end {
        if let Some(error) = pace.step(solver.t(), end) {
            return (StopReason::Failed(error), next);
        }
        if solver.work().steps >= most_steps {
            return (StopReason::StepLimit, next);
        }
        let from = solver.t();
        if let Err(error) = solver.step(end.min(observer.stop(from))) {
            return (StopReason::Failed(error), next);
        }
        if let Some(start) = observer.takes_back(solver) {
            solver.rewind(from, start);
            continue;
        }
        let event = observer.event(solver);
        let reached = event.unwrap_or(solver.t());
        if times[next] <= reached || event.is_some() {
            let dense = solver.dense();
            next = outputs(solver, &dense, times, next, reached, observer);
            if event.is_some() {
                solver.rewind(reached, dense.at(reached));
                return (StopReason::Event, next);
            }
        }
        if observer.stepped(solver).is_break() {
            return (StopReason::Interrupted, next);
        }
        if let Some((stretch, true)) = observer.stretch(solver.t()) {
            solver.restart(stretch);
        }
    }
    (StopReason::Finished, next)
}

/// Pace of an integration: steps since a time, and the longest mean step so far.
struct Pace {
    since: f64,
    steps: u64,
    longest: f64,
}

/// Steps over which the pace is taken, the share of the way that they must make, and the share of the longest mean step that is none.
const PACED: u64 = 200_000;
const LEAST_SHARE: f64 = 1e-6;
const FALLEN: f64 = 1e-3;

impl Pace {
    /// Counts a step, taken back or not; the error of steps that lead nowhere.
    fn step(&mut self, t: f64, end: f64) -> Option<StepError> {
        self.steps += 1;
        if self.steps < PACED {
            return None;
        }
        let (way, left) = (t - self.since, end - t);
        let longest = self.longest.max(way);
        *self = Self { since: t, steps: 0, longest };
        let fell = way < FALLEN * longest || way <= f64::EPSILON * t.abs();
        (fell && way < LEAST_SHARE * left).then_some(StepError::Crawls { t, step: way / PACED as f64 })
    }
}

/// Writes the outputs up to the time reached and returns the number of the next one.
#[inline(always)]
fn outputs<M: Solver>(
    solver: &mut M,
    dense: &DenseOutput<M::State>,
    times: &[f64],
    first: usize,
    reached: f64,
    observer: &mut impl StepObserver<M>,
) -> usize {
    let mut next = first;
    while next < times.len() && times[next] <= reached {
        observer.output(times[next], &solver.output(dense, times[next]));
        next += 1;
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ode::{Dop853, System};
    use crate::simd::{Arithmetic, Unfused};

    /// A switch that turns back at once whatever it changes.
    struct Switch;

    impl System<[f64; 1]> for Switch {
        fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 1], rate: &mut [f64; 1]) {
            *rate = [if y[0] < 1.0 { 1.0 } else { -0.3 }];
        }
    }

    struct Nobody;

    impl<M: Solver> StepObserver<M> for Nobody {
        fn output(&mut self, _: f64, _: &M::State) {}

        fn stepped(&mut self, _: &mut M) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }
    }

    /// Steps as long as ever lead on, however far the end is; much shorter ones do not.
    #[test]
    fn a_far_end_is_no_crawl() {
        let mut pace = Pace { since: 0.0, steps: 0, longest: 0.0 };
        let mut crawls = |from: f64, step: f64| {
            (1..=2 * PACED).find_map(|count| pace.step(from + step * count as f64, 1e12))
        };
        assert_eq!(crawls(0.0, 0.3), None);
        let from = 0.6 * PACED as f64;
        assert!(matches!(crawls(from, 1e-6), Some(StepError::Crawls { .. })));
    }

    /// Steps that lead nowhere end a run, with the place; the same switch is passed once where it does not turn back.
    #[test]
    fn steps_that_lead_nowhere_end_a_run() {
        type Method = Dop853<Switch, [f64; 1], Unfused>;
        let from = |y: f64| Method::new(Switch, 0.0, [y], [1e-11]);
        let found = integrate(&mut from(0.0), &[1000.0], 0, u64::MAX, &mut Nobody);
        let StopReason::Failed(StepError::Crawls { t, step }) = found else { panic!("{found:?}") };
        assert!((t - 1.0).abs() < 1e-3 && step < 1e-9, "{t} {step}");
        assert_eq!(integrate(&mut from(0.0), &[0.99], 0, u64::MAX, &mut Nobody), StopReason::Finished);
        assert_eq!(integrate(&mut from(9.0), &[20.0], 0, u64::MAX, &mut Nobody), StopReason::Finished);
    }
}
