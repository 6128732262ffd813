//! Integration of a drift: rotation states under slow torques, with the events that end or divide the integration.
//! One region of the sphere of angular momentum at a time, since the rates jump at the separatrix; every end is a root of one function on
//! the dense output, so that ends do not depend on the output times.
//! Equations (A8) and (A10), docs/theory/10-torque-free.md.

use std::ops::ControlFlow;

use super::rates::{Rates, Variables, direction, with_direction};
use super::region_choice::SEPARATRIX;
use super::stop_reason::{DriftHistory, DriftStopReason};
use super::{Drift, DriftLimits, DriftState};
use crate::averaging::evolution::RotationState;
use crate::averaging::power::MeanPower;
use crate::math::bisection::bisected;
use crate::math::ode::{Dop853, Solver};
use crate::math::simd::Unfused;
use crate::model::Mode;

/// Error allowed per step, in `ξ`, in the logarithm of `G`, and in the direction.
const STEP_TOLERANCE: f64 = 1e-10;
/// Places, as `ξ`, where a wobble counts as died out, and where a wobble grows again should the steady spin become unstable: a
/// disturbance of `e^{−40}` rad always exists.
const DIED_OUT: f64 = 81.0;
const SEED: f64 = 80.0;

/// Event that ends a part of the integration.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Mark {
    Target,
    Rest,
    SpunUp,
    SlowedDown,
    Separatrix,
    DiedOut,
    Unstable,
}

const MARKS: [Mark; 7] = [
    Mark::Target,
    Mark::Rest,
    Mark::SpunUp,
    Mark::SlowedDown,
    Mark::Separatrix,
    Mark::DiedOut,
    Mark::Unstable,
];

/// Integration of a drift in progress.
struct Way<'f, P> {
    drift: &'f Drift<P>,
    start: DriftState,
    times: &'f [f64],
    limits: &'f DriftLimits,
    /// True if `D` lies below the target at the start.
    below: bool,
    steady: bool,
    history: DriftHistory,
}

impl<P: MeanPower> Drift<P> {
    /// Follows the drift from a state, with the states at ascending times (s), until a limit of `limits` or a mark ends the drift. At the
    /// separatrix the most probable region is entered, (A10); of two equally probable regions the one on the positive side.
    ///
    /// `progress` is asked after each step, with the share of the time that is done; `Break` ends the drift there.
    pub fn follow(
        &self,
        start: DriftState,
        times: &[f64],
        limits: &DriftLimits,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> DriftHistory {
        let history = DriftHistory {
            states: Vec::with_capacity(times.len()),
            end: start,
            ending: DriftStopReason::Finished,
            passages: Vec::new(),
            died_out: None,
            steps: 0,
        };
        let mut way = Way { drift: self, start, times, limits, below: false, steady: false, history };
        way.set_out();
        while let ControlFlow::Continue(()) = way.part(&mut progress) {}
        way.history
    }
}

impl<'f, P: MeanPower> Way<'f, P> {
    fn set_out(&mut self) {
        let y = self.y();
        self.below =
            self.limits.target.is_some_and(|target| along(self.start.rotation_state) < along(target));
        self.steady = self.start.rotation_state.xi >= SEED && self.rates().of(self.start.t, &y)[0] >= 0.0;
    }

    /// Integrated variables at the state reached, from which a part begins.
    fn y(&self) -> Variables {
        let DriftState { rotation_state, angular_momentum, revolutions, direction, .. } = self.history.end;
        let logarithm = (angular_momentum / self.start.angular_momentum).ln();
        with_direction([rotation_state.xi.min(SEED), logarithm, revolutions], direction)
    }

    fn rates(&self) -> Rates<'f, P> {
        let DriftState { rotation_state, side, .. } = self.history.end;
        Rates {
            drift: self.drift,
            mode: rotation_state.mode,
            side,
            angular_momentum: self.start.angular_momentum,
            steady: self.steady,
        }
    }

    fn state(&self, t: f64, y: &Variables) -> DriftState {
        let DriftState { rotation_state: RotationState { mode, .. }, side, .. } = self.history.end;
        let xi = if self.steady { f64::INFINITY } else { y[0] };
        let angular_momentum = self.start.angular_momentum * y[1].exp();
        DriftState {
            t,
            rotation_state: RotationState { mode, xi },
            angular_momentum,
            side,
            direction: if self.drift.eddy.is_some() { direction(y) } else { self.start.direction },
            revolutions: y[2],
        }
    }

    /// Integrates one part: in one region of the sphere of angular momentum, with a wobble or without.
    fn part(&mut self, progress: &mut impl FnMut(f64) -> ControlFlow<()>) -> ControlFlow<()> {
        let y = self.y();
        let [first, length] = [self.start.t, self.limits.end - self.start.t];
        self.outputs(self.history.end.t, |_| y);
        let at_once = [Mark::Target, Mark::Rest, Mark::SpunUp, Mark::SlowedDown]
            .into_iter()
            .find(|mark| self.past(*mark, self.history.end.t, &y) >= 0.0);
        if let Some(mark) = at_once {
            return self.met(mark);
        }
        let allowed = with_direction([STEP_TOLERANCE, STEP_TOLERANCE, f64::INFINITY], [STEP_TOLERANCE; 3]);
        let mut solver = Dop853::<_, _, Unfused>::new(self.rates(), self.history.end.t, y, allowed);
        loop {
            if solver.t() >= self.limits.end {
                return self.ended(DriftStopReason::Finished);
            }
            if self.history.steps >= self.limits.steps {
                return self.ended(DriftStopReason::StepLimit { steps: self.history.steps });
            }
            let before = solver.t();
            if let Err(error) = solver.step(self.limits.end) {
                return self.ended(DriftStopReason::Failed(error));
            }
            self.history.steps += 1;
            let (t, y) = (solver.t(), *solver.y());
            let dense = solver.dense();
            let place = |t: f64| if t < solver.t() { dense.at(t) } else { y };
            let located =
                |mark: Mark| (bisected([before, t], |t| self.past(mark, t, &place(t)), 0.0, true), mark);
            let marks = MARKS.into_iter().filter(|mark| self.past(*mark, t, &y) > 0.0).map(located);
            let next = marks.min_by(|a, b| a.0.total_cmp(&b.0));
            let t = next.map_or(t, |(t, _)| t);
            self.outputs(t, place);
            self.history.end = self.state(t, &place(t));
            if let Some((_, mark)) = next {
                return self.met(mark);
            }
            if progress((t - first) / length).is_break() {
                return self.ended(DriftStopReason::Interrupted);
            }
        }
    }

    /// Records the states at output times up to `last`.
    fn outputs(&mut self, last: f64, place: impl Fn(f64) -> Variables) {
        while let Some(t) = self.times.get(self.history.states.len()).copied().filter(|t| *t <= last) {
            let state = self.state(t, &place(t));
            self.history.states.push(state);
        }
    }

    /// Event function of a mark at a time (s): negative before the mark, positive past it.
    fn past(&self, mark: Mark, t: f64, y: &Variables) -> f64 {
        let mode = self.history.end.rotation_state.mode;
        match mark {
            Mark::Target => match self.limits.target {
                Some(target) if target.mode == mode => {
                    let away = along(RotationState { mode, xi: y[0] }) - along(target);
                    if self.below { away } else { -away }
                }
                _ => f64::NEG_INFINITY,
            },
            Mark::Rest => self.limits.rest.ln() - y[1],
            Mark::SpunUp => (self.turning(y) / self.limits.fastest).ln(),
            Mark::SlowedDown => (self.limits.slowest / self.turning(y)).ln(),
            Mark::Separatrix => SEPARATRIX - y[0],
            Mark::DiedOut if !self.steady => y[0] - DIED_OUT,
            Mark::Unstable if self.steady => -self.rates().of(t, y)[0],
            Mark::DiedOut | Mark::Unstable => f64::NEG_INFINITY,
        }
    }

    /// Rate (rad/s) about the angular momentum.
    fn turning(&self, y: &Variables) -> f64 {
        let motion = self.rates().motion(y[0], self.start.angular_momentum * y[1].exp());
        2.0 * motion.energy() / motion.angular_momentum()
    }

    /// Acts on a mark: ends the drift, or sets the state of the next part.
    fn met(&mut self, mark: Mark) -> ControlFlow<()> {
        match mark {
            Mark::Target => return self.ended(DriftStopReason::Target),
            Mark::Rest => return self.ended(DriftStopReason::Rest { share: self.limits.rest }),
            Mark::SpunUp => return self.ended(DriftStopReason::SpunUp { rate: self.turning(&self.y()) }),
            Mark::SlowedDown => {
                return self.ended(DriftStopReason::SlowedDown { rate: self.turning(&self.y()) });
            }
            Mark::Separatrix => {
                self.history.end.rotation_state.xi = SEPARATRIX;
                let Some((state, passage)) = self.drift.onward(&self.history.end) else {
                    return self.ended(DriftStopReason::Held);
                };
                self.history.end = state;
                self.history.passages.push(passage);
            }
            Mark::DiedOut => {
                self.history.died_out.get_or_insert(self.history.end.t);
                self.steady = true;
                self.history.end.rotation_state.xi = f64::INFINITY;
            }
            Mark::Unstable => {
                self.steady = false;
                self.history.end.rotation_state.xi = SEED;
            }
        }
        ControlFlow::Continue(())
    }

    fn ended(&mut self, ending: DriftStopReason) -> ControlFlow<()> {
        self.history.ending = ending;
        ControlFlow::Break(())
    }
}

/// Place of a rotation state between the axis of least inertia and that of greatest: rises with `D/I₃`.
fn along(RotationState { mode, xi }: RotationState) -> f64 {
    let from_separatrix = xi.max(SEPARATRIX) - SEPARATRIX;
    match mode {
        Mode::ShortAxis => from_separatrix,
        Mode::LongAxis => -from_separatrix,
    }
}
