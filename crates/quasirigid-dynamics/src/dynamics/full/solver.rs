//! Automatic choice between the explicit and the implicit integrator, step by step.
//! Explicit steps do not show how long an accurate step could be, so the implicit method is tried from time to time; the numbers below are
//! the relative costs of steps.
//! "Choice of the method" and equation (T3), docs/theory/08-full-system.md.

use super::system::FullSystem;
use crate::math::ode::{
    Checkpoint, DenseOutput, Dop853, Radau, Solver, StepError, StepRule, Stiff, Stretch, Work,
};
use crate::math::simd::{Rounding, Unfused};
use crate::model::Method;

type State = Vec<f64>;
type Explicit<'a> = Dop853<FullSystem<'a>, State, Unfused>;
type Implicit<'a> = Radau<FullSystem<'a>, Unfused>;

/// Solver of the full system with two methods, one of them active.
pub(super) struct FullSolver<'a> {
    method: Method,
    rounding: Rounding,
    costs: Costs,
    active: Active<'a>,
    allowed: State,
    /// Fastest rate of the elastic part, or of the loop that a controller closes (1/s).
    fastest: f64,
    /// Steps since the last change of method.
    since: u64,
    /// Steps in a row that speak against the active method.
    against: u64,
    /// Explicit steps before the implicit method is tried.
    trust: u64,
    /// Work of the methods before the active one.
    done: Work,
}

enum Active<'a> {
    Explicit(Box<Explicit<'a>>),
    Implicit(Box<Implicit<'a>>),
}

/// Limit of an explicit step times the fastest rate that counts as fit; the method ceases to be stable at about 6.
const STABILITY: f64 = 4.0;
/// Limit of an explicit step times the fastest rate for which dense output is as accurate as the end of the step: beyond, the stages
/// leave the slow manifold and only the end returns.
const RESOLVED: f64 = 1.0;
/// Steps in a row before a change of method.
const PATIENCE: u64 = 12;

/// Costs of implicit steps beside explicit ones.
#[derive(Clone, Copy, Debug)]
struct Costs {
    /// Implicit step times the fastest rate below which it does not pay.
    worthwhile: f64,
    /// Explicit steps before the implicit method is first tried; twice as many after each trial that did not pay.
    trust: u64,
    /// First implicit step over the last explicit one.
    leap: f64,
}

impl Costs {
    /// Stage after stage an implicit step costs as much as four explicit ones of `STABILITY`; side by side it costs less than one.
    fn of(system: &FullSystem) -> Self {
        match system.steering() {
            None => Self { worthwhile: 16.0, trust: 50, leap: 3.0 },
            Some(_) => Self { worthwhile: 3.0, trust: 12, leap: 5.0 },
        }
    }
}

impl<'a> FullSolver<'a> {
    pub fn new(
        mut system: FullSystem<'a>,
        y: State,
        allowed: State,
        method: Method,
        rounding: Rounding,
    ) -> Self {
        let (fastest, costs) = (system.fastest(&y), Costs::of(&system));
        let explicit = Explicit::new(system.clone(), 0.0, y.clone(), allowed.clone());
        let active = match method {
            Method::Implicit => {
                let h = explicit.h();
                Active::Implicit(Box::new(Implicit::rounded(system, 0.0, y, &allowed, h, rounding)))
            }
            Method::Automatic | Method::Explicit => Active::Explicit(Box::new(explicit)),
        };
        Self {
            method,
            rounding,
            costs,
            active,
            allowed,
            fastest,
            since: 0,
            against: 0,
            trust: costs.trust,
            done: Work::default(),
        }
    }

    /// Holds a torque on the carrier (N·m, body axes) from now on.
    pub fn hold(&mut self, torque: [f64; 3]) {
        let (t, y) = (self.t(), self.y().clone());
        match &mut self.active {
            Active::Explicit(solver) => {
                solver.system_mut().hold(torque);
                solver.rewind(t, y);
            }
            Active::Implicit(solver) => {
                solver.system_mut().hold(torque);
                solver.rewind(t, y);
            }
        }
    }

    /// The torque (N·m, body axes) that is held on the carrier.
    pub fn held(&self) -> [f64; 3] {
        match &self.active {
            Active::Explicit(solver) => solver.system().held(),
            Active::Implicit(solver) => solver.system().held(),
        }
    }

    /// True if the last step speaks against the active method.
    fn misfit(&self) -> bool {
        match &self.active {
            Active::Explicit(solver) => solver.h() * self.fastest > STABILITY,
            Active::Implicit(solver) => solver.h() * self.fastest < self.costs.worthwhile,
        }
    }

    /// True if the other method is to be tried.
    fn due(&self) -> bool {
        let unfit = self.against >= PATIENCE;
        let due = match &self.active {
            Active::Explicit(_) => self.since >= self.trust || (unfit && self.trust == self.costs.trust),
            Active::Implicit(_) => unfit,
        };
        due && self.method == Method::Automatic
    }

    fn switch(&mut self) {
        if matches!(self.active, Active::Implicit(_)) {
            self.trust =
                if self.since < 3 * PATIENCE { self.trust.saturating_mul(2) } else { self.costs.trust };
        }
        (self.since, self.against) = (0, 0);
        self.done = self.work();
        let allowed = self.allowed.clone();
        self.active = match &self.active {
            Active::Explicit(solver) => {
                let (t, y, h) = (solver.t(), solver.y().clone(), self.costs.leap * solver.h());
                Active::Implicit(Box::new(Implicit::rounded(
                    solver.system().clone(),
                    t,
                    y,
                    &allowed,
                    h,
                    self.rounding,
                )))
            }
            Active::Implicit(solver) => {
                let (t, y) = (solver.t(), solver.y().clone());
                Active::Explicit(Box::new(Explicit::new(solver.system().clone(), t, y, allowed)))
            }
        };
    }
}

/// Calls a method of the active solver.
macro_rules! active {
    ($self:expr, $solver:ident => $call:expr) => {
        match $self {
            Active::Explicit($solver) => $call,
            Active::Implicit($solver) => $call,
        }
    };
}

impl Solver for FullSolver<'_> {
    type State = State;

    fn t(&self) -> f64 {
        active!(&self.active, solver => solver.t())
    }

    fn y(&self) -> &State {
        active!(&self.active, solver => solver.y())
    }

    fn work(&self) -> Work {
        self.done + active!(&self.active, solver => solver.work())
    }

    fn step(&mut self, end: f64) -> Result<(), StepError> {
        if self.due() {
            self.switch();
        }
        active!(&mut self.active, solver => solver.step(end))?;
        self.since += 1;
        self.against = if self.misfit() { self.against + 1 } else { 0 };
        Ok(())
    }

    fn dense(&mut self) -> DenseOutput<State> {
        active!(&mut self.active, solver => solver.dense())
    }

    fn output(&mut self, dense: &DenseOutput<State>, t: f64) -> State {
        match &mut self.active {
            Active::Explicit(solver) if solver.last_step() * self.fastest > RESOLVED => solver.within(t),
            _ => dense.at(t),
        }
    }

    fn correct(&mut self, change: &State) {
        active!(&mut self.active, solver => solver.correct(change));
    }

    fn rewind(&mut self, t: f64, y: State) {
        active!(&mut self.active, solver => solver.rewind(t, y));
    }

    fn enter(&mut self, stretch: Stretch) {
        active!(&mut self.active, solver => solver.enter(stretch));
    }

    fn restart(&mut self, stretch: Stretch) {
        active!(&mut self.active, solver => solver.restart(stretch));
    }

    fn rule(&self) -> StepRule {
        active!(&self.active, solver => solver.rule())
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        let Self { active, since, against, trust, done, .. } = self;
        let implicit = matches!(active, Active::Implicit(_));
        [u64::from(implicit), *since, *against, *trust]
            .into_iter()
            .for_each(|count| checkpoint.save_count(count));
        checkpoint.save_work(*done);
        active!(active, solver => solver.save(checkpoint));
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        let implicit = checkpoint.load_count()? == 1;
        if implicit != matches!(self.active, Active::Implicit(_)) {
            self.switch();
        }
        let Self { active, since, against, trust, done, .. } = self;
        for count in [since, against, trust] {
            *count = checkpoint.load_count()?;
        }
        *done = checkpoint.load_work()?;
        active!(active, solver => solver.load(checkpoint))
    }
}
