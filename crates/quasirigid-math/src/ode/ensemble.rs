//! Ensembles: many trajectories of one autonomous system, eight at a time.
//! A lane that has ended its trajectory takes the next one, so that none waits for the longest.

use super::StopReason;
use super::dop853_lanes::{Dop853Lanes, LaneStart, LaneSystem, Trial};
use super::dop853_tableau::{EXTRA, STAGES};
use super::system::{StepError, Work};
use crate::lanes::{LANES, Lanes};
use crate::simd::Arithmetic;

/// A trajectory of an ensemble.
#[derive(Clone, Debug, PartialEq)]
pub struct LaneRun<const D: usize> {
    /// State at each output time reached.
    pub outputs: Vec<[f64; D]>,
    /// Reason of the end.
    pub reason: StopReason,
    /// Work done, without the first rates, which the starts bring.
    pub work: Work,
}

/// Integrates from each start at the time zero to the last of the ascending `times`, with outputs at each of them.
///
/// `goes_on` is asked from moment to moment with the number of trajectories that have ended; `false` interrupts the others.
#[inline(always)]
pub fn integrate_lanes<S: LaneSystem<D>, R: Arithmetic, const D: usize>(
    system: &mut S,
    starts: &[LaneStart<D>],
    times: &[f64],
    most_steps: u64,
    goes_on: &mut dyn FnMut(usize) -> bool,
) -> Vec<LaneRun<D>> {
    let at_once = times.iter().take_while(|t| **t <= 0.0).count();
    let mut ensemble = Ensemble { starts, times, most_steps, at_once, begun: 0, ended: 0, runs: Vec::new() };
    ensemble.runs = starts.iter().map(|start| ensemble.not_begun(start)).collect();
    let mut solver = Dop853Lanes::<S, R, D>::new(system);
    let mut slots: [Option<LaneSlot>; LANES] = std::array::from_fn(|lane| ensemble.next(&mut solver, lane));
    for sweep in 1_u64.. {
        if slots.iter().all(Option::is_none) || (sweep % SWEEPS_PER_QUESTION == 0 && !goes_on(ensemble.ended))
        {
            break;
        }
        let trial = solver.step();
        if ensemble.count(&mut slots, &trial, solver.t()) {
            solver.prepare_dense();
        }
        for (lane, place) in slots.iter_mut().enumerate() {
            let Some(slot) = place else { continue };
            if trial.accepted.get(lane) {
                ensemble.output(slot, &solver, lane);
            }
            if let Some(reason) = ensemble.reason(slot, &trial, &solver, lane) {
                ensemble.end(slot, reason);
                *place = ensemble.next(&mut solver, lane);
            }
        }
    }
    for slot in slots.iter().flatten() {
        ensemble.end(slot, StopReason::Interrupted);
    }
    ensemble.runs
}

/// Sweeps between two questions whether to go on.
const SWEEPS_PER_QUESTION: u64 = 4096;

/// A trajectory in its lane.
struct LaneSlot {
    index: usize,
    /// Number of its next output.
    next: usize,
    steps: u64,
    rejected: u64,
    dense: u64,
}

/// Trajectories that wait, run and have ended.
struct Ensemble<'a, const D: usize> {
    starts: &'a [LaneStart<D>],
    times: &'a [f64],
    most_steps: u64,
    /// Number of outputs at the start.
    at_once: usize,
    begun: usize,
    ended: usize,
    runs: Vec<LaneRun<D>>,
}

impl<const D: usize> Ensemble<'_, D> {
    /// A trajectory before its first step.
    fn not_begun(&self, start: &LaneStart<D>) -> LaneRun<D> {
        let mut outputs = Vec::with_capacity(self.times.len());
        outputs.resize(self.at_once, start.y);
        let reason = if self.at_once == self.times.len() {
            StopReason::Finished
        } else if self.most_steps == 0 {
            StopReason::StepLimit
        } else {
            StopReason::Interrupted
        };
        LaneRun { outputs, reason, work: Work::default() }
    }

    /// Puts the next trajectory that needs steps into a lane, or leaves it idle.
    fn next<S: LaneSystem<D>, R: Arithmetic>(
        &mut self,
        solver: &mut Dop853Lanes<S, R, D>,
        lane: usize,
    ) -> Option<LaneSlot> {
        let end = self.times.last().copied().unwrap_or(0.0);
        if self.begun == self.starts.len() || self.at_once == self.times.len() || self.most_steps == 0 {
            solver.unload(lane);
            return None;
        }
        let index = self.begun;
        self.begun += 1;
        solver.load(lane, &self.starts[index], end);
        Some(LaneSlot { index, next: self.at_once, steps: 0, rejected: 0, dense: 0 })
    }

    /// Counts a trial in each lane, and tells whether a lane has passed its next output.
    #[inline(always)]
    fn count(&self, slots: &mut [Option<LaneSlot>; LANES], trial: &Trial, t: Lanes) -> bool {
        let mut passed = false;
        for (lane, slot) in slots.iter_mut().enumerate() {
            if let Some(slot) = slot {
                let accepted = trial.accepted.get(lane);
                slot.steps += u64::from(accepted);
                slot.rejected += u64::from(!accepted && !trial.stuck.get(lane));
                passed |= accepted && self.times[slot.next] <= t.0[lane];
            }
        }
        passed
    }

    /// Keeps the outputs of the step that a lane has made.
    #[inline(always)]
    fn output<S: LaneSystem<D>, R: Arithmetic>(
        &mut self,
        slot: &mut LaneSlot,
        solver: &Dop853Lanes<S, R, D>,
        lane: usize,
    ) {
        let reached = solver.t().0[lane];
        if self.times[slot.next] > reached {
            return;
        }
        let dense = solver.dense(lane);
        slot.dense += 1;
        while slot.next < self.times.len() && self.times[slot.next] <= reached {
            self.runs[slot.index].outputs.push(dense.at(self.times[slot.next]));
            slot.next += 1;
        }
    }

    /// Reason for which the trajectory of a lane ends after a trial, if it does.
    #[inline(always)]
    fn reason<S: LaneSystem<D>, R: Arithmetic>(
        &self,
        slot: &LaneSlot,
        trial: &Trial,
        solver: &Dop853Lanes<S, R, D>,
        lane: usize,
    ) -> Option<StopReason> {
        if trial.stuck.get(lane) {
            let error = StepError::at(solver.t().0[lane], solver.undefined(lane));
            return Some(StopReason::Failed(error));
        }
        let finished = (slot.next == self.times.len()).then_some(StopReason::Finished);
        finished.or((slot.steps >= self.most_steps).then_some(StopReason::StepLimit))
    }

    fn end(&mut self, slot: &LaneSlot, reason: StopReason) {
        let run = &mut self.runs[slot.index];
        let trials = slot.steps + slot.rejected;
        let evaluations = (STAGES as u64 - 1) * trials + slot.steps + EXTRA as u64 * slot.dense;
        run.work = Work { steps: slot.steps, rejected: slot.rejected, evaluations, ..Work::default() };
        run.reason = reason;
        self.ended += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ode::{Dop853, Solver, StepObserver, System, integrate};
    use crate::simd::{Rounding, Task, dispatch_lanes};
    use std::ops::ControlFlow;

    /// A pendulum by its sine and cosine, whose rates differ from lane to lane; a wide swing runs away.
    struct Pendulum;

    /// Angular velocity from which on the pendulum runs away, as its cube.
    const WILD: f64 = 1e3;

    impl System<[f64; 3]> for Pendulum {
        fn rate<R: Arithmetic>(&mut self, _: f64, [s, c, w]: &[f64; 3], rate: &mut [f64; 3]) {
            let away = if w.abs() >= WILD { w * w * w } else { 0.0 };
            *rate = [c * w, 0.0 - s * w, away - *s];
        }
    }

    impl LaneSystem<3> for Pendulum {
        fn rate<R: Arithmetic>(&self, [s, c, w]: &[Lanes; 3]) -> [Lanes; 3] {
            let zero = Lanes::splat(0.0);
            let cube = *w * *w * *w;
            let wild = Lanes::splat(WILD).at_most(w.max(zero - *w));
            [*c * *w, zero - *s * *w, cube.select(wild, zero) - *s]
        }
    }

    struct Kept(Vec<[f64; 3]>);

    impl<R: Arithmetic> StepObserver<Dop853<Pendulum, [f64; 3], R>> for Kept {
        fn output(&mut self, _: f64, y: &[f64; 3]) {
            self.0.push(*y);
        }

        fn stepped(&mut self, _: &mut Dop853<Pendulum, [f64; 3], R>) -> ControlFlow<()> {
            ControlFlow::Continue(())
        }
    }

    const ALLOWED: [f64; 3] = [1e-10, 1e-10, f64::INFINITY];
    const TIMES: [f64; 4] = [0.0, 1.0, 1.5, 30.0];

    /// Every trajectory in lanes and alone, by one arithmetic.
    struct Both;

    impl Task for Both {
        type Output = [Vec<LaneRun<3>>; 2];

        fn run<A: Arithmetic>(self) -> Self::Output {
            let mut starts: Vec<[f64; 3]> = (0..19).map(|i| [0.0, 1.0, 0.1 * 1.3_f64.powi(i)]).collect();
            starts[5][2] = WILD;
            starts[11][2] = f64::NAN;
            let lane = |y: &[f64; 3]| {
                let solver = Dop853::<_, _, A>::new(Pendulum, 0.0, *y, ALLOWED);
                LaneStart { y: *y, rate: *solver.rate(), h: solver.h(), allowed: ALLOWED }
            };
            let lanes: Vec<_> = starts.iter().map(lane).collect();
            let together = integrate_lanes::<_, A, 3>(&mut Pendulum, &lanes, &TIMES, u64::MAX, &mut |_| true);
            let alone = |y: &[f64; 3]| {
                let mut solver = Dop853::<_, _, A>::new(Pendulum, 0.0, *y, ALLOWED);
                let mut kept = Kept(Vec::new());
                let reason = integrate(&mut solver, &TIMES, 0, u64::MAX, &mut kept);
                let Work { steps, rejected, evaluations, .. } = solver.work();
                // two rates before the first step, which a lane is given
                LaneRun {
                    outputs: kept.0,
                    reason,
                    work: Work { steps, rejected, evaluations: evaluations - 2, ..Work::default() },
                }
            };
            [together, starts.iter().map(alone).collect()]
        }
    }

    #[test]
    fn lanes_are_single_trajectories() {
        let [exact, fastest] = [Rounding::Reproducible, Rounding::Fastest].map(|rounding| {
            let [together, alone] = dispatch_lanes(rounding, Both);
            // texts, since NaN is unequal to itself
            assert_eq!(format!("{together:?}"), format!("{alone:?}"));
            assert!(alone.iter().any(|run| run.work.rejected > 0), "a rejected step is compared, too");
            let failed = alone.iter().filter(|run| matches!(run.reason, StopReason::Failed(_))).count();
            assert_eq!(failed, 2);
            alone
        });
        assert_eq!(format!("{:?}", dispatch_plain()), format!("{exact:?}"), "registers change no bit");
        let gap = |i: usize| (exact[18].outputs[3][i] - fastest[18].outputs[3][i]).abs();
        assert!((0..3).all(|i| gap(i) < 1e-7));
    }

    /// By the registers that every processor has.
    fn dispatch_plain() -> Vec<LaneRun<3>> {
        let [together, _] = Both.run::<crate::simd::Unfused>();
        together
    }
}
