//! Multirevolution method: whole revolutions of the nutation are passed in leaps, and only the last one before an output or an event is integrated.
//! Next to a separatrix, and where a revolution changes too much, the motion is integrated as it is.
//! "Many revolutions", docs/theory/05-propagation.md.

use std::cell::Cell;
use std::f64::consts::TAU;
use std::marker::PhantomData;
use std::ops::ControlFlow;

use super::circling::{Advance, Circling};
use super::place::last_where;
use super::revolution::Motion;
use crate::dynamics::form::{AngularMomentumForm, Equations};
use crate::dynamics::invariant_monitor::InvariantMonitor;
use crate::dynamics::quadrature::Quadrature;
use crate::dynamics::reduced::{Prepared, Reduced, Shares};
use crate::dynamics::run::{Options, PropagateError, Run, Scan};
use crate::dynamics::spin::{Accounted, Accounts};
use crate::dynamics::steady::IsolatedSpin;
use crate::math::ode::{Checkpoint, Dop853, Solver, StepObserver, StopReason, Work, integrate_until};
use crate::math::simd::Arithmetic;
use crate::math::vec3::norm;

type Direct<'a, A> = Dop853<Accounted<'a, AngularMomentumForm>, [f64; 12], A>;

/// Doublings of a stretch of one revolution that is integrated before a section is looked for again.
const LONGEST: u32 = 6;

/// Where a motion is.
enum Stage {
    /// At a state, on no section.
    Free { t: f64, y: [f64; 12] },
    /// On a section, after whole revolutions.
    Circling(Box<Circling>),
}

/// Follows a motion by the multirevolution method.
struct Follower<'w, 'a, A> {
    motion: Motion<'w, A>,
    spins: &'w [IsolatedSpin],
    monitor: InvariantMonitor<'a, Reduced<'a, AngularMomentumForm>>,
    allowed: [f64; 12],
    times: &'a [f64],
    options: &'a Options,
    /// Number of the next output.
    next: usize,
    /// Stretches integrated since the last section.
    lost: u32,
    /// Last state.
    last: (f64, [f64; 12]),
    /// Energies of several dissipators, but for a factor, of the stages before this one.
    taken: Vec<f64>,
    work: &'w Cell<Work>,
}

/// Integrates prepared equations by the multirevolution method.
pub(in crate::dynamics) fn follow<A: Arithmetic>(
    prepared: Prepared<'_, AngularMomentumForm>,
    spins: &[IsolatedSpin],
) -> Result<Run, PropagateError> {
    let Prepared { system, y, allowed, monitor, times, options } = prepared;
    let work = Cell::new(Work::default());
    let motion = Motion { equations: system.equations, work: &work, arithmetic: PhantomData::<A> };
    let taken = vec![0.0; monitor.trajectory.shares.count()];
    let mut follower = Follower {
        motion,
        spins,
        monitor,
        allowed,
        times,
        options,
        next: 0,
        lost: 0,
        last: (0.0, y),
        taken,
        work: &work,
    };
    let mut stage = Stage::Free { t: 0.0, y };
    if let Some(checkpoint) = follower.monitor.observer.resumes() {
        stage = follower.load(checkpoint).ok_or(PropagateError::Checkpoint)?;
    }
    let reason = follower.run(stage);
    let Follower { mut monitor, last: (t, y), taken, .. } = follower;
    let last = monitor.sample(t, &y);
    let budget = monitor.trajectory.budget(&taken, &last);
    monitor.observer.budget(&budget);
    Ok(Run { outcome: monitor.outcome(reason), last, work: work.get(), scan: Scan::default(), left_out: 0.0 })
}

impl<'w, 'a, A: Arithmetic> Follower<'w, 'a, A> {
    fn run(&mut self, mut stage: Stage) -> StopReason {
        let mut reason = StopReason::Finished;
        while self.next < self.times.len() && reason == StopReason::Finished {
            (stage, reason) = match stage {
                Stage::Free { t, y } => self.free(t, y),
                Stage::Circling(circling) => self.circle(circling),
            };
            if self.work.get().steps >= self.options.most_steps {
                reason = StopReason::StepLimit;
            } else if reason == StopReason::Finished && self.moment(&stage).is_break() {
                reason = StopReason::Interrupted;
            }
        }
        if let Stage::Circling(circling) = &stage {
            self.add(circling.taken());
        }
        reason
    }

    /// Integrates to the next passage of a section, or for a revolution where none comes.
    fn free(&mut self, t: f64, y: [f64; 12]) -> (Stage, StopReason) {
        let state = Accounts::unpack(&y);
        let shares = &self.monitor.trajectory.shares;
        let circling = Circling::start(&self.motion, shares, self.spins, (t, &state));
        let spin = norm(self.motion.equations.omega(state.x));
        let stretch = f64::from(1 << self.lost) * TAU / spin;
        let end = circling.as_ref().map_or(t + stretch, Circling::time);
        self.lost = if circling.is_some() { 0 } else { (self.lost + 1).min(LONGEST) };
        let reason = self.integrate(t, y, end);
        match circling {
            Some(circling) if reason == StopReason::Finished && self.next < self.times.len() => {
                let near = self.monitor.watches() && self.passes(&circling);
                (if near { self.leave(&circling) } else { Stage::Circling(Box::new(circling)) }, reason)
            }
            _ => (Stage::Free { t: self.last.0, y: self.last.1 }, reason),
        }
    }

    /// Goes on by whole revolutions before the next output, or makes it.
    fn circle(&mut self, mut circling: Box<Circling>) -> (Stage, StopReason) {
        let until = self.times[self.next];
        let before = circling.kept();
        match circling.advance(&self.motion, &self.monitor.trajectory.shares, until, u64::MAX) {
            Advance::Lost => (self.leave(&circling), StopReason::Finished),
            Advance::Arrived => {
                let reason = self.output(&circling, until);
                (Stage::Circling(circling), reason)
            }
            Advance::Moved if self.monitor.watches() && self.passes(&circling) => {
                let leaped = circling.place.revolutions - before.0.revolutions;
                let quiet = last_where(0, leaped, |count| {
                    circling.back(&before);
                    self.go(&mut circling, until, count);
                    !self.passes(&circling)
                });
                circling.back(&before);
                self.go(&mut circling, until, quiet + 1);
                (self.leave(&circling), StopReason::Finished)
            }
            Advance::Moved => {
                self.last = (circling.time(), circling.state().pack());
                (Stage::Circling(circling), StopReason::Finished)
            }
        }
    }

    /// Goes on by a number of revolutions that are known to end before a time.
    fn go(&self, circling: &mut Circling, until: f64, count: u64) {
        let end = circling.place.revolutions + count;
        let shares = &self.monitor.trajectory.shares;
        while circling.place.revolutions < end {
            let most = end - circling.place.revolutions;
            if circling.advance(&self.motion, shares, until, most) != Advance::Moved {
                return;
            }
        }
    }

    /// Leaves a section: the motion goes on as from any state.
    fn leave(&mut self, circling: &Circling) -> Stage {
        self.add(circling.taken());
        let (t, y) = (circling.time(), circling.state().pack());
        self.last = (t, y);
        self.monitor.watch_from(t, &y);
        Stage::Free { t, y }
    }

    /// Integrates from a state to a time, with outputs and events.
    fn integrate(&mut self, t: f64, y: [f64; 12], end: f64) -> StopReason {
        let mut solver = self.direct(t, y);
        self.monitor.trajectory.begin(t, &y);
        let end = end.min(self.times.last().copied().unwrap_or_default());
        let steps = self.work.get().steps;
        let most = self.options.most_steps.saturating_sub(steps);
        let mut flight = Flight { monitor: &mut self.monitor, before: steps };
        let (reason, next) = integrate_until(&mut solver, end, self.times, self.next, most, &mut flight);
        self.next = next;
        self.last = (solver.t(), *solver.y());
        self.work.set(self.work.get() + solver.work());
        let taken = self.monitor.trajectory.taken.take();
        self.add(taken);
        reason
    }

    fn direct(&self, t: f64, y: [f64; 12]) -> Direct<'w, A> {
        let system = Accounted { equations: self.motion.equations };
        Dop853::new(system, t, y, self.allowed)
    }

    /// Output at a time within the revolution that begins on the section. The time of the revolution is counted from its begin, where the rounding
    /// of a long time is none.
    fn output(&mut self, circling: &Circling, t: f64) -> StopReason {
        let end = circling.place.before(t);
        let mut solver = self.direct(0.0, circling.state().pack());
        while solver.t() < end {
            if let Err(error) = solver.step(end) {
                return StopReason::Failed(error);
            }
        }
        self.work.set(self.work.get() + solver.work());
        self.last = (t, *solver.y());
        StepObserver::<Direct<'w, A>>::output(&mut self.monitor, t, &self.last.1);
        self.next += 1;
        StopReason::Finished
    }

    /// Whether an event has happened at a passage, or happens within the revolution that follows.
    fn passes(&mut self, circling: &Circling) -> bool {
        let (t, y) = (circling.time(), circling.state().pack());
        let Some(revolution) = circling.period(&self.motion) else { return true };
        self.monitor.has_passed(t, &y) || {
            let mut solver = self.direct(t, y);
            let end = t + revolution;
            self.monitor.probe(t, &y, |monitor| {
                while solver.t() < end {
                    if solver.step(end).is_err() || monitor.event(&mut solver).is_some() {
                        return true;
                    }
                }
                false
            })
        }
    }

    /// Adds energies that the dissipators took.
    fn add(&mut self, taken: Option<Quadrature>) {
        let sums = taken.map(|taken| taken.sums()).unwrap_or_default();
        self.taken.iter_mut().zip(sums).for_each(|(whole, sum)| *whole += sum);
    }

    /// Tells the observer of the progress, and saves a checkpoint that it wants.
    fn moment(&mut self, stage: &Stage) -> ControlFlow<()> {
        let Some(flow) = self.monitor.progress(self.work.get().steps, self.last.0) else {
            return ControlFlow::Continue(());
        };
        if self.monitor.observer.wants_checkpoint() {
            let (taken, lost, work, (t, y)) = (&self.taken, self.lost, self.work.get(), self.last);
            self.monitor.save(|_, checkpoint| {
                checkpoint.save_work(work);
                checkpoint.save_count(lost.into());
                checkpoint.save_list(taken);
                checkpoint.save(t);
                checkpoint.save_list(&y);
                stage.save(checkpoint);
            });
        }
        flow
    }

    /// Stage of a checkpoint; none if it is of another motion.
    fn load(&mut self, mut checkpoint: Checkpoint) -> Option<Stage> {
        let Self { monitor, work, taken, lost, last: (t, y), .. } = self;
        let mut stage = None;
        self.next = monitor.load(&mut checkpoint, |trajectory, checkpoint| {
            work.set(checkpoint.load_work()?);
            *lost = u32::try_from(checkpoint.load_count()?).ok().filter(|lost| *lost <= LONGEST)?;
            checkpoint.load_into(taken)?;
            *t = checkpoint.load()?;
            checkpoint.load_into(y)?;
            stage = Some(Stage::load(checkpoint, &trajectory.shares)?);
            Some(())
        })?;
        stage
    }
}

impl Stage {
    fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_count(u64::from(matches!(self, Self::Circling(_))));
        match self {
            Self::Free { t, y } => {
                checkpoint.save(*t);
                checkpoint.save_list(y);
            }
            Self::Circling(circling) => circling.save(checkpoint),
        }
    }

    fn load(checkpoint: &mut Checkpoint, shares: &Shares<'_>) -> Option<Self> {
        if checkpoint.load_count()? == 1 {
            return Some(Self::Circling(Box::new(Circling::load(checkpoint, shares)?)));
        }
        let (t, mut y) = (checkpoint.load()?, [0.0; 12]);
        checkpoint.load_into(&mut y)?;
        Some(Self::Free { t, y })
    }
}

/// Observer of a stretch that is integrated as it is.
struct Flight<'f, 'a> {
    monitor: &'f mut InvariantMonitor<'a, Reduced<'a, AngularMomentumForm>>,
    /// Steps before.
    before: u64,
}

impl<'w, A: Arithmetic> StepObserver<Direct<'w, A>> for Flight<'_, '_> {
    fn output(&mut self, t: f64, y: &[f64; 12]) {
        StepObserver::<Direct<'w, A>>::output(self.monitor, t, y);
    }

    fn event(&mut self, solver: &mut Direct<'w, A>) -> Option<f64> {
        self.monitor.event(solver)
    }

    fn stepped(&mut self, solver: &mut Direct<'w, A>) -> ControlFlow<()> {
        self.monitor.settle(solver)?;
        self.monitor
            .progress(self.before + solver.work().steps, solver.t())
            .unwrap_or(ControlFlow::Continue(()))
    }
}
