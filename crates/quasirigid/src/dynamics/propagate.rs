use std::f64::consts::TAU;
use std::ops::ControlFlow;

use thiserror::Error;

use super::form::{Equations, Form, MomentumForm, PaperForm};
use super::spin::{Accounted, Accounts};
use super::start::start;
use crate::math::ode::{Dop853, Ending, Solver, Watcher, Work, integrate};
use crate::math::polynomial::Kernel;
use crate::math::rotation;
use crate::math::simd::{Arithmetic, Plain, Task, dispatch};
use crate::math::sym::norm;
use crate::model::ReducedBody;

/// Where a propagation starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinState {
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
}

/// How a propagation is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Variable that is integrated.
    pub form: Form,
    /// Error allowed per step, relative to `|K|` or `|ω|` (1e-15 to 1e-2); the attitude is held to it in radians.
    pub tolerance: f64,
    /// Steps allowed.
    pub most_steps: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { form: Form::Momentum, tolerance: 1e-12, most_steps: 1_000_000_000 }
    }
}

/// The body at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub t: f64,
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, `R_NB`, scalar first.
    pub attitude: [f64; 4],
    /// Momentum (N·m·s), body axes.
    pub momentum: [f64; 3],
    /// Energy of the system integrated (J).
    pub energy: f64,
    /// Energy taken by the dashpots since the start (J). (P4)
    pub dissipated: f64,
    /// Change of energy that the integrator made by itself (J). (P4)
    pub energy_drift: f64,
    /// Relative change of `|K|`: in the momentum form what the integrator made before it was projected away (P6), in
    /// the paper's form the whole change, most of it the truncation of the series.
    pub momentum_drift: f64,
    /// Turns made, `∫|ω| dt / 2π`.
    pub turns: f64,
}

/// Receives what a propagation produces while it runs.
pub trait Observer {
    /// A sample at a time asked for.
    fn sample(&mut self, sample: &Sample);

    /// The internal coordinates and their rates, just before the sample they belong to; full runs only.
    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        let _ = (q, rate);
    }

    /// Called every few thousand steps; `Break` ends the propagation.
    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        let _ = t;
        ControlFlow::Continue(())
    }
}

impl Observer for Vec<Sample> {
    fn sample(&mut self, sample: &Sample) {
        self.push(*sample);
    }
}

/// How a propagation ended, with the last state reached; what was observed is valid up to there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Why it ended.
    pub outcome: Outcome,
    /// The last state reached.
    pub last: Sample,
    /// Work done.
    pub work: Work,
}

/// Why a propagation ended.
pub type Outcome = Ending;

/// A propagation that cannot start.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PropagateError {
    /// The body does not turn, or its spin is no number.
    #[error("the angular velocity {omega:?} rad/s is not a spin; give a finite one that is not zero")]
    NoSpin {
        /// Spin asked for (rad/s).
        omega: [f64; 3],
    },
    /// The tolerance cannot be met, or means nothing.
    #[error("the tolerance {tolerance:e} is out of range; choose one from 1e-15 to 1e-2")]
    Tolerance {
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The times do not ascend from zero.
    #[error("the output times must be finite, ascend and not be negative; {t} s follows {before} s")]
    Times {
        /// The time at fault (s).
        t: f64,
        /// The time before it (s).
        before: f64,
    },
    /// No momentum belongs to the spin: the series does not hold there.
    #[error(
        "the truncated series has no momentum for this spin; the theory does not hold here: lower the spin, stiffen the springs, or use order 1"
    )]
    NoMomentum,
}

/// Steps between two calls of [`Observer::progress`].
pub(super) const PROGRESS: u64 = 4096;

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
    check(initial.omega, times, options.tolerance)?;
    let power = Kernel::new(&body.power);
    let x = start(body, initial.omega, options.form).ok_or(PropagateError::NoMomentum)?;
    Ok(match options.form {
        Form::Momentum => {
            let equations = MomentumForm::new(body);
            dispatch(Propagation {
                equations: &equations,
                power: &power,
                x,
                initial,
                times,
                options,
                observer,
            })
        }
        Form::Paper => {
            let equations = PaperForm::new(body);
            dispatch(Propagation {
                equations: &equations,
                power: &power,
                x,
                initial,
                times,
                options,
                observer,
            })
        }
    })
}

/// Refuses what no propagation can start from.
pub(super) fn check(omega: [f64; 3], times: &[f64], tolerance: f64) -> Result<(), PropagateError> {
    if !omega.iter().all(|w| w.is_finite()) || norm(omega) == 0.0 {
        return Err(PropagateError::NoSpin { omega });
    }
    if !(1e-15..=1e-2).contains(&tolerance) {
        return Err(PropagateError::Tolerance { tolerance });
    }
    let befores = std::iter::once(&0.0).chain(times);
    match befores.zip(times).find(|(before, t)| !(*t >= *before && t.is_finite())) {
        Some((&before, &t)) => Err(PropagateError::Times { t, before }),
        None => Ok(()),
    }
}

/// A propagation ready to run.
struct Propagation<'a, E> {
    equations: &'a E,
    power: &'a Kernel,
    x: [f64; 3],
    initial: SpinState,
    times: &'a [f64],
    options: Options,
    observer: &'a mut dyn Observer,
}

impl<E: Equations> Task for Propagation<'_, E> {
    type Output = Run;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Run {
        let Self { equations, power, x, initial, times, options, observer } = self;
        let system = Accounted { equations, power };
        let start =
            Accounts { x, attitude: initial.attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 };
        let (error, attitude, free) = (options.tolerance * norm(x), options.tolerance, f64::INFINITY);
        let allowed =
            [error, error, error, free, attitude, attitude, attitude, attitude, free, free, free, free];
        let mut solver = Dop853::<_, _, A>::new(system, 0.0, start.pack(), allowed);
        let K = equations.momentum(x);
        let mut keeper = Keeper {
            equations,
            form: options.form,
            K_N: rotation::to_inertial(initial.attitude, K),
            G: norm(K),
            energy: equations.energy(x),
            drift: 0.0,
            observer,
        };
        let outcome = integrate(&mut solver, times, options.most_steps, &mut keeper);
        Run { outcome, last: keeper.sample(solver.t(), Accounts::unpack(*solver.y())), work: solver.work() }
    }
}

/// Keeps the invariants and the accounts of a propagation.
struct Keeper<'a, E> {
    equations: &'a E,
    form: Form,
    /// Inertial momentum.
    K_N: [f64; 3],
    /// `|K|` at the start.
    G: f64,
    /// Energy at the start.
    energy: f64,
    /// `Σ ln(|K|/G)` of the projections made. (P6)
    drift: f64,
    observer: &'a mut dyn Observer,
}

impl<E: Equations> Keeper<'_, E> {
    fn sample(&self, t: f64, accounts: Accounts) -> Sample {
        let x = accounts.x;
        let K = self.equations.momentum(x);
        let energy = self.equations.energy(x);
        Sample {
            t,
            omega: self.equations.omega::<Plain>(x),
            attitude: rotation::aligned(accounts.attitude, K, self.K_N),
            momentum: K,
            energy,
            dissipated: accounts.dissipated,
            energy_drift: energy - self.energy - accounts.energy_change,
            momentum_drift: match self.form {
                Form::Momentum => self.drift,
                Form::Paper => norm(K) / self.G - 1.0,
            },
            turns: accounts.angle / TAU,
        }
    }

    /// Puts `|K|` back to its value (P6) and the attitude back to the inertial momentum (P3).
    #[inline(always)]
    fn hold_invariants(&mut self, solver: &mut impl Solver<State = [f64; 12]>) {
        let Accounts { x, attitude, .. } = Accounts::unpack(*solver.y());
        let mut change = Accounts { x: [0.0; 3], attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 };
        if self.form == Form::Momentum {
            let drift = (norm(x) / self.G).ln();
            self.drift += drift;
            change.x = x.map(|K| -drift * K);
        }
        let aligned = rotation::aligned(attitude, self.equations.momentum(x), self.K_N);
        change.attitude = std::array::from_fn(|i| aligned[i] - attitude[i]);
        solver.correct(&change.pack());
    }
}

impl<E: Equations, M: Solver<State = [f64; 12]>> Watcher<M> for Keeper<'_, E> {
    fn output(&mut self, t: f64, y: &[f64; 12]) {
        let sample = self.sample(t, Accounts::unpack(*y));
        self.observer.sample(&sample);
    }

    #[inline(always)]
    fn stepped(&mut self, solver: &mut M) -> ControlFlow<()> {
        self.hold_invariants(solver);
        if solver.work().steps.is_multiple_of(PROGRESS) {
            self.observer.progress(solver.t())
        } else {
            ControlFlow::Continue(())
        }
    }
}
