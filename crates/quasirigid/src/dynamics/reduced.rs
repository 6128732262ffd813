use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::conserved::{Conserved, inside};
use super::event::Alarm;
use super::form::{Equations, Form, MomentumForm, PaperForm};
use super::quadrature::Quadrature;
use super::run::{Observer, Options, Outcome, Pace, PropagateError, Run, Sample, SpinState, check};
use super::spin::{Accounted, Accounts};
use super::start::start;
use crate::math::ode::{Dop853, Solver, Watcher, integrate};
use crate::math::polynomial::{Kernel, Series};
use crate::math::rotation;
use crate::math::simd::{Arithmetic, Plain, Task, dispatch};
use crate::math::vec3::{add, norm, scale};
use crate::model::ReducedBody;

/// Follows the reduced equations of a body from `t = 0` and observes it at the times asked for (s). (P1)–(P6)
///
/// # Errors
/// [`PropagateError`] before the first step. What goes wrong later is an [`Outcome`].
pub fn propagate(
    body: &ReducedBody,
    initial: SpinState,
    times: &[f64],
    options: Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    check(norm(initial.omega), initial.attitude, times, options.tolerance)?;
    let x = start(body, initial.omega, options.form).ok_or(PropagateError::NoMomentum)?;
    let power = Kernel::new(&body.power);
    let inside = inside(body.momentum(initial.omega), body.J, initial.omega);
    let shares = Shares::of(body);
    let plan = Plan { power: &power, shares, x, inside, initial, times, options: &options, observer };
    Ok(match options.form {
        Form::Momentum => dispatch(Propagation { equations: &MomentumForm::new(body), plan }),
        Form::Paper => dispatch(Propagation { equations: &PaperForm::new(body), plan }),
    })
}

/// A propagation ready to run, in either form.
struct Plan<'a> {
    power: &'a Kernel,
    shares: Shares<'a>,
    x: [f64; 3],
    inside: [f64; 3],
    initial: SpinState,
    times: &'a [f64],
    options: &'a Options,
    observer: &'a mut dyn Observer,
}

struct Propagation<'a, E> {
    equations: &'a E,
    plan: Plan<'a>,
}

impl<E: Equations> Task for Propagation<'_, E> {
    type Output = Run;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Run {
        let Self { equations, plan } = self;
        let Plan { power, shares, x, inside, initial, times, options, observer } = plan;
        let system = Accounted { equations, power };
        let start =
            Accounts { x, attitude: initial.attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 };
        let K = equations.momentum(x);
        let first = options.form.size(x, inside);
        let (error, attitude, free) = (options.tolerance * first, options.tolerance, f64::INFINITY);
        let allowed =
            [error, error, error, free, attitude, attitude, attitude, attitude, free, free, free, free];
        let mut solver = Dop853::<_, _, A>::new(system, 0.0, start.pack(), allowed);
        let mut keeper = Keeper {
            equations,
            form: options.form,
            initial,
            momentum: Conserved::new(rotation::to_inertial(initial.attitude, K), norm(K), inside),
            energy: equations.energy(x),
            drift: 0.0,
            alarm: Alarm::new(&options.events),
            taken: (!shares.kernels.is_empty()).then(|| Quadrature::new(0.0, shares.powers(initial.omega))),
            shares,
            observer,
            pace: Pace::new(),
        };
        keeper.alarm.set(&keeper.sample(0.0, start));
        let ending = integrate(&mut solver, times, options.most_steps, &mut keeper);
        let last = keeper.sample(solver.t(), Accounts::unpack(*solver.y()));
        keeper.settle(&last);
        Run { outcome: Outcome::of(ending, keeper.alarm.rung), last, work: solver.work() }
    }
}

/// Keeps the invariants and the accounts of a propagation.
struct Keeper<'a, E> {
    equations: &'a E,
    form: Form,
    initial: SpinState,
    /// Momentum at the start.
    momentum: Conserved,
    /// Energy at the start.
    energy: f64,
    /// `Σ ln(|K|/G)` of the projections made. (P6)
    drift: f64,
    alarm: Alarm,
    shares: Shares<'a>,
    /// What each dissipator has taken, if there are several.
    taken: Option<Quadrature>,
    observer: &'a mut dyn Observer,
    pace: Pace,
}

/// Powers of the dissipators of a reduced body, if there are several.
struct Shares<'a> {
    body: &'a ReducedBody,
    /// Four of them each.
    kernels: Vec<Kernel>,
}

/// Rows of a kernel.
const ROWS: usize = 4;

impl<'a> Shares<'a> {
    fn of(body: &'a ReducedBody) -> Self {
        let powers: Vec<&Series> = body.power_shares.iter().map(|(_, power)| power).collect();
        let groups = if powers.len() > 1 { powers.chunks(ROWS) } else { [].chunks(ROWS) };
        Self { body, kernels: groups.map(|group| Kernel::new(&Series::stacked(group))).collect() }
    }

    /// Power (W) that each takes at a spin.
    fn powers(&self, omega: [f64; 3]) -> Vec<f64> {
        let all = self.kernels.iter().flat_map(|kernel| kernel.value::<Plain>(omega));
        all.take(self.body.power_shares.len()).collect()
    }
}

impl<E: Equations> Keeper<'_, E> {
    /// Tells the observer what each dissipator has taken: their shares in the integrals over the steps, of the whole that the solver
    /// has integrated. (D4)
    fn settle(&mut self, last: &Sample) {
        let names = self.shares.body.power_shares.iter().map(|(name, _)| name.clone());
        let sums = match &mut self.taken {
            None => vec![1.0],
            Some(taken) => {
                taken.add(last.t, self.shares.powers(last.omega));
                taken.sums()
            }
        };
        let whole: f64 = sums.iter().sum();
        let share = |sum: f64| if whole > 0.0 { last.dissipated * sum / whole } else { 0.0 };
        self.observer.budget(&names.zip(sums.into_iter().map(share)).collect::<Vec<_>>());
    }

    fn sample(&self, t: f64, accounts: Accounts) -> Sample {
        let x = accounts.x;
        let K = self.equations.momentum(x);
        let energy = self.equations.energy(x);
        let attitude = self.momentum.aligned(accounts.attitude, K);
        let omega = self.equations.omega::<Plain>(x);
        let place = add(self.initial.place, scale(t, self.initial.velocity));
        let offset = rotation::to_inertial(attitude, self.shares.body.pole.vector(omega));
        Sample {
            t,
            omega,
            attitude,
            momentum: K,
            energy,
            dissipated: accounts.dissipated,
            work: 0.0,
            energy_drift: energy - self.energy - accounts.energy_change,
            momentum_drift: match self.form {
                Form::Momentum if self.momentum.held() => self.drift,
                Form::Momentum | Form::Paper => self.momentum.change(K),
            },
            turns: accounts.angle / TAU,
            place,
            velocity: self.initial.velocity,
            pole: add(place, offset),
        }
    }

    /// Puts `|K|` back to its value (P6) and the attitude back to the inertial momentum (P3).
    #[inline(always)]
    fn hold_invariants(&mut self, solver: &mut impl Solver<State = [f64; 12]>) {
        let Accounts { x, attitude, .. } = Accounts::unpack(*solver.y());
        let mut change = Accounts { x: [0.0; 3], attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 };
        if self.form == Form::Momentum && self.momentum.held() {
            let drift = self.momentum.drift(x);
            self.drift += drift;
            change.x = x.map(|K| -drift * K);
        }
        let aligned = self.momentum.aligned(attitude, self.equations.momentum(x));
        change.attitude = std::array::from_fn(|i| aligned[i] - attitude[i]);
        solver.correct(&change.pack());
    }
}

impl<E: Equations, M: Solver<State = [f64; 12]>> Watcher<M> for Keeper<'_, E> {
    fn output(&mut self, t: f64, y: &[f64; 12]) {
        let sample = self.sample(t, Accounts::unpack(*y));
        if self.observer.keeps_coordinates() {
            let body = self.shares.body;
            self.observer.coordinates(&body.q.value(sample.omega), &body.rate.value(sample.omega));
        }
        self.observer.sample(&sample);
    }

    fn event(&mut self, solver: &mut M) -> Option<f64> {
        if self.alarm.idle() {
            return None;
        }
        let mut alarm = std::mem::take(&mut self.alarm);
        let end = self.sample(solver.t(), Accounts::unpack(*solver.y()));
        let mut dense = None;
        let event = alarm.check(&end, |t| {
            let dense = dense.get_or_insert_with(|| solver.dense());
            self.sample(t, Accounts::unpack(dense.at(t)))
        });
        self.alarm = alarm;
        event
    }

    #[inline(always)]
    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()> {
        self.hold_invariants(solver);
        if let Some(taken) = &mut self.taken {
            let omega = self.equations.omega::<Plain>(Accounts::unpack(*solver.y()).x);
            taken.add(solver.t(), self.shares.powers(omega));
        }
        if self.pace.due(solver.work().steps) {
            self.observer.progress(solver.t())
        } else {
            ControlFlow::Continue(())
        }
    }
}
