//! Integration of the reduced equations without forces: angular momentum or angular velocity, attitude, energy accounts.
//! Shares of several dissipators are integrated beside the solver and scaled to its total, so that accounts cost nothing in the state
//! vector, whose fixed length keeps the inner loop in registers.
//! Equations (P1) to (P6), docs/theory/05-propagation.md; (D4), docs/theory/11-materials.md.

use super::conserved_momentum::{Conserved, inside};
use super::form::error_scale;
use super::form::{AngularMomentumForm, AngularVelocityForm, Equations};
use super::invariant_monitor::{Invariant, InvariantMonitor, StateView, Trajectory};
use super::position::Position;
use super::quadrature::Quadrature;
use super::resting::stays_at_rest;
use super::run::{Observer, Options, PropagateError, Run, Sample, Scan, Start, check};
use super::spin::{ATTITUDE, Accounted, Accounts};
use super::start::start;
use crate::math::ode::{Checkpoint, Dop853, Solver, integrate};
use crate::math::polynomial::{Kernel, Series};
use crate::math::rotation;
use crate::math::simd::{Arithmetic, Task, dispatch};
use crate::math::vec3::{add, norm, scale};
use crate::model::{Form, ReducedBody};

/// Integrates the reduced equations of a body from `t = 0` and observes the body at the output times (s). (P1)–(P6)
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 3)?;
/// let mut samples: Vec<Sample> = Vec::new();
/// let start = Start::new([0.1, 0.0, 1.0], ALIGNED);
/// let run = propagate(&reduced, start, &[0.0, 5.0, 10.0], &Options::default(), &mut samples)?;
/// assert_eq!((run.outcome, samples.len()), (Outcome::Finished, 3));
/// assert!(samples[2].energy <= samples[0].energy);
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// # Errors
/// [`PropagateError`] before the first step. A later failure is an [`Outcome`](crate::dynamics::Outcome).
pub fn propagate(
    body: &ReducedBody,
    initial: Start,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    check(norm(initial.omega), initial.attitude, times, options)?;
    if initial.omega == [0.0; 3] {
        return Ok(stays_at_rest(body, initial, times, observer));
    }
    let x = start(body, initial.omega, options.form).ok_or(PropagateError::NoAngularMomentum)?;
    let inside = inside(body.angular_momentum(initial.omega), body.J, initial.omega);
    let shares = Shares::of(body);
    let plan = Plan { shares, x, inside, initial, times, options, observer };
    match options.form {
        Form::AngularMomentum => {
            dispatch(options.rounding, StepByStep { equations: &AngularMomentumForm::new(body), plan })
        }
        Form::AngularVelocity => {
            dispatch(options.rounding, StepByStep { equations: &AngularVelocityForm::new(body), plan })
        }
    }
}

/// Arguments of a propagation, for either form.
struct Plan<'a> {
    shares: Shares<'a>,
    x: [f64; 3],
    inside: [f64; 3],
    initial: Start,
    times: &'a [f64],
    options: &'a Options,
    observer: &'a mut dyn Observer,
}

/// Equations ready to be integrated: system, state, error allowed per step, monitor.
struct Prepared<'a, E> {
    system: Accounted<'a, E>,
    y: [f64; 12],
    allowed: [f64; 12],
    monitor: InvariantMonitor<'a, Reduced<'a, E>>,
    times: &'a [f64],
    options: &'a Options,
}

impl<'a> Plan<'a> {
    fn prepared<E: Equations>(self, equations: &'a E) -> Prepared<'a, E> {
        let Self { shares, x, inside, initial, times, options, observer } = self;
        let start =
            Accounts { x, attitude: initial.attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 };
        let y = start.pack();
        let K = equations.angular_momentum(x);
        let first = error_scale(options.form, x, inside);
        let (error, attitude, free) = (options.tolerance * first, options.tolerance, f64::INFINITY);
        let allowed =
            [error, error, error, free, attitude, attitude, attitude, attitude, free, free, free, free];
        let trajectory = Reduced { equations, form: options.form, initial, shares, taken: None };
        let angular_momentum = Conserved::new(rotation::to_inertial(initial.attitude, K), norm(K), inside);
        let monitor = InvariantMonitor::new(trajectory, &y, angular_momentum, options, observer);
        Prepared { system: Accounted { equations }, y, allowed, monitor, times, options }
    }
}

struct StepByStep<'a, E> {
    equations: &'a E,
    plan: Plan<'a>,
}

impl<E: Equations> Task for StepByStep<'_, E> {
    type Output = Result<Run, PropagateError>;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Self::Output {
        let Prepared { system, y, allowed, mut monitor, times, options } = self.plan.prepared(self.equations);
        monitor.trajectory.begin(0.0, &y);
        let mut solver = Dop853::<_, _, A>::new(system, 0.0, y, allowed);
        let first = monitor.resume(&mut solver)?;
        let reason = integrate(&mut solver, times, first, options.most_steps, &mut monitor);
        let last = monitor.sample(solver.t(), solver.y());
        let sums = monitor.trajectory.end(&last);
        let budget = monitor.trajectory.budget(&sums, &last);
        monitor.observer.budget(&budget);
        Ok(Run {
            outcome: monitor.outcome(reason),
            last,
            work: solver.work(),
            scan: Scan::default(),
            left_out: 0.0,
            load_ratio: 0.0,
            ringing: None,
        })
    }
}

/// Motion of the reduced equations in a form, with the accounts of the dissipators.
struct Reduced<'a, E> {
    equations: &'a E,
    form: Form,
    initial: Start,
    shares: Shares<'a>,
    /// Energies taken by the dissipators, if there are several, since the start.
    taken: Option<Quadrature>,
}

/// Powers of the dissipators of a reduced body, if there are several.
struct Shares<'a> {
    body: &'a ReducedBody,
    /// Kernels of `KERNEL_ROWS` powers each.
    kernels: Vec<Kernel>,
}

/// Rows of a kernel.
const KERNEL_ROWS: usize = 4;

impl<'a> Shares<'a> {
    fn of(body: &'a ReducedBody) -> Self {
        let powers: Vec<&Series> = body.power_shares.iter().map(|(_, power)| power).collect();
        let groups = if powers.len() > 1 { powers.chunks(KERNEL_ROWS) } else { [].chunks(KERNEL_ROWS) };
        Self { body, kernels: groups.map(|group| Kernel::new(&Series::stacked(group))).collect() }
    }

    /// Number of dissipators among which the energy is to be shared; none if there is one.
    fn count(&self) -> usize {
        if self.kernels.is_empty() { 0 } else { self.body.power_shares.len() }
    }

    /// Power (W) of each dissipator at an angular velocity.
    fn powers(&self, omega: [f64; 3]) -> Vec<f64> {
        let all = self.kernels.iter().flat_map(|kernel| kernel.at(omega));
        all.take(self.body.power_shares.len()).collect()
    }
}

impl<E: Equations> Reduced<'_, E> {
    /// Begins to sum up what the dissipators take, at a state.
    fn begin(&mut self, t: f64, y: &[f64]) {
        let powers = || self.shares.powers(self.equations.omega(Accounts::unpack(y).x));
        self.taken = (self.shares.count() > 0).then(|| Quadrature::new(t, powers()));
    }

    /// Sums of what the dissipators have taken up to the last sample; of one dissipator alone any number.
    fn end(&mut self, last: &Sample) -> Vec<f64> {
        self.taken.take().map_or_else(Vec::new, |mut taken| {
            taken.add(last.t, self.shares.powers(last.omega));
            taken.sums()
        })
    }

    /// Energy taken by each dissipator: its share of these integrals, times the total that the solver has integrated. (D4)
    fn budget(&self, sums: &[f64], last: &Sample) -> Vec<(String, f64)> {
        let names = self.shares.body.power_shares.iter().map(|(name, _)| name.clone());
        let sums = if sums.is_empty() { &[1.0] } else { sums };
        let whole: f64 = sums.iter().sum();
        let share = |sum: &f64| if whole > 0.0 { last.dissipated * sum / whole } else { 0.0 };
        names.zip(sums.iter().map(share)).collect()
    }
}

impl<E: Equations> Trajectory for Reduced<'_, E> {
    type State = [f64; 12];

    const ATTITUDE: usize = ATTITUDE;

    #[inline(always)]
    fn view(&mut self, _: f64, y: &[f64]) -> StateView {
        let Accounts { x, dissipated, energy_change, angle, .. } = Accounts::unpack(y);
        StateView {
            omega: self.equations.omega(x),
            angular_momentum: self.equations.angular_momentum(x),
            energy: self.equations.energy(x),
            q: Vec::new(),
            rate: Vec::new(),
            dissipated,
            work: 0.0,
            explained: [energy_change, 0.0],
            angle,
            impulse: [0.0; 3],
        }
    }

    #[inline(always)]
    fn angular_momentum(&mut self, _: f64, y: &[f64]) -> [f64; 3] {
        self.equations.angular_momentum(Accounts::unpack(y).x)
    }

    fn position(&self, t: f64, _: &[f64], view: &StateView, attitude: [f64; 4]) -> Position {
        let Start { place, velocity, .. } = self.initial;
        let place = add(place, scale(t, velocity));
        let offset = rotation::to_inertial(attitude, self.shares.body.pole.vector(view.omega));
        Position { place, velocity, pole: add(place, offset) }
    }

    #[inline(always)]
    fn change(&self, _: &[f64; 12], x: [f64; 3], attitude: [f64; 4]) -> [f64; 12] {
        Accounts { x, attitude, dissipated: 0.0, energy_change: 0.0, angle: 0.0 }.pack()
    }

    #[inline(always)]
    fn energy_balance(&self, y: &[f64], K: [f64; 3]) -> Option<(f64, [f64; 3])> {
        let gradient = self.equations.energy_gradient(K)?;
        Some((self.equations.energy(K) - Accounts::unpack(y).energy_change, gradient))
    }

    #[inline(always)]
    fn invariant(&self) -> Invariant {
        match self.form {
            Form::AngularMomentum => Invariant::AngularMomentum,
            Form::AngularVelocity => Invariant::Direction,
        }
    }

    #[inline(always)]
    fn stepped(&mut self, t: f64, y: &[f64]) {
        if let Some(taken) = &mut self.taken {
            let omega = self.equations.omega(Accounts::unpack(y).x);
            taken.add(t, self.shares.powers(omega));
        }
    }

    fn save(&self, checkpoint: &mut Checkpoint) {
        self.taken.iter().for_each(|taken| taken.save(checkpoint));
    }

    fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.taken.iter_mut().try_for_each(|taken| taken.load(checkpoint))
    }

    fn show_coordinates(&self, view: &StateView, observer: &mut dyn Observer) {
        if observer.keeps_coordinates() {
            let body = self.shares.body;
            observer.coordinates(&body.q.value(view.omega), &body.rate.value(view.omega));
        }
    }
}
