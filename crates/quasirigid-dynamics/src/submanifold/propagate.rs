//! Integration of the reduced equations about a spin.
//! In normal form the coordinates are followed in axes that turn with their phases, where only amplitudes and slow shifts of phase are left:
//! a step spans many periods, and the values within are algebra. (W10)

use std::f64::consts::TAU;

use crate::dynamics::{Observer, Options, Outcome, PropagateError, Sample, check_times};
use crate::math::ode::{Dop853, Solver, StepObserver, StopReason, System, integrate};
use crate::math::rotation::{aligned, to_inertial};
use crate::math::simd::{Arithmetic, Unfused};
use crate::math::submanifold::{InvariantManifold, Style};
use crate::math::vec3::{add, norm, scale};
use crate::model::MotionState;

use super::history::{ManifoldRun, ManifoldStart};
use super::observables::Accrued;
use super::range::Defect;
use super::spin_manifold::SpinManifold;

/// Integrates the reduced equations about a spin from `t = 0` and observes the body at the output times (s). (W10)
///
/// # Errors
/// [`PropagateError`] before the first step. A later failure is an [`Outcome`].
pub fn propagate_on_manifold(
    manifold: &SpinManifold,
    start: &ManifoldStart,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<ManifoldRun, PropagateError> {
    check_times(times, options.tolerance)?;
    let phases = Phases::of(manifold, start);
    let accrued = manifold.accrued();
    let mut y: Vec<f64> = start.z.as_flattened().to_vec();
    y.resize(y.len() + accrued.len(), 0.0);
    let size = start.z.iter().map(|[re, im]| re.hypot(*im)).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let mut allowed = vec![options.tolerance * size; 2 * start.z.len()];
    allowed.push(options.tolerance);
    allowed.resize(y.len(), f64::INFINITY);
    let system = Slow { manifold: &manifold.manifold, accrued: &accrued, phases: &phases };
    let mut solver = Dop853::<_, _, Unfused>::new(system, 0.0, y, allowed);
    let mut monitor = Monitor::new(manifold, start, &phases, times, observer);
    let reason = integrate(&mut solver, times, 0, options.most_steps, &mut monitor);
    let (last, z) = monitor.sample(solver.t(), solver.y());
    monitor.worst.0.power = if monitor.drift == 0.0 { 0.0 } else { monitor.drift / last.dissipated.abs() };
    let outcome = match reason {
        StopReason::Finished | StopReason::Event => Outcome::Finished,
        StopReason::Interrupted => Outcome::Interrupted,
        StopReason::StepLimit => Outcome::StepLimit,
        StopReason::Failed(error) => Outcome::Failed(error),
    };
    let budget = monitor.budget(solver.t(), solver.y());
    monitor.observer.budget(&budget);
    Ok(ManifoldRun { outcome, last, z, powers: monitor.powers, worst: monitor.worst, work: solver.work() })
}

impl SpinManifold<'_> {
    /// Quantities that accrue: the turning, the revolutions, the energy taken by each dissipator.
    fn accrued(&self) -> Vec<&Accrued> {
        let observables = &self.observables;
        [&observables.turning, &observables.revolved].into_iter().chain(&observables.dissipated).collect()
    }

    /// Mean power (W) of all dissipators over the phases of the coordinates. (W8)
    pub(crate) fn mean_power(&self, z: &[[f64; 2]]) -> f64 {
        let monomials = self.manifold.monomials(z);
        self.observables.dissipated.iter().map(|accrued| accrued.at(&monomials)[0]).sum()
    }
}

/// Rates (rad/s) of the axes in which the coordinates are followed; zero in graph style.
struct Phases(Vec<f64>);

impl Phases {
    /// Rates of the phases at the start, so that amplitudes alone are left to follow.
    fn of(manifold: &SpinManifold, start: &ManifoldStart) -> Self {
        let expansion = &manifold.manifold;
        let leads: Vec<usize> = leads(expansion).collect();
        let groups = expansion.masters[0].weight.len();
        let mut rates = vec![0.0; groups];
        if manifold.style == Style::NormalForm {
            let now = expansion.rates_at(&start.z);
            for (group, rate) in rates.iter_mut().enumerate() {
                let own = (0..leads.len()).find(|k| {
                    expansion.masters[leads[*k]]
                        .weight
                        .iter()
                        .enumerate()
                        .all(|(i, weight)| *weight == i32::from(i == group))
                });
                let Some(k) = own else { continue };
                let ([x, y], [u, v]) = (start.z[k], now[k]);
                let square = x * x + y * y;
                let still = expansion.masters[leads[k]].mode.lambda[1];
                *rate = if square > 0.0 { (x * v - y * u) / square } else { still };
            }
        }
        let own = |k: &usize| {
            expansion.masters[*k].weight.iter().zip(&rates).map(|(w, rate)| f64::from(*w) * rate).sum()
        };
        Self(leads.iter().map(own).collect())
    }

    /// Coordinates at a time from those in turning axes.
    fn coordinates(&self, t: f64, turning: &[f64]) -> Vec<[f64; 2]> {
        let pairs = turning.as_chunks::<2>().0.iter().zip(&self.0);
        pairs
            .map(|([x, y], rate)| {
                let (sine, cosine) = (rate * t).sin_cos();
                [x * cosine - y * sine, x * sine + y * cosine]
            })
            .collect()
    }
}

/// Indices of the masters that lead their pair of conjugates.
fn leads(expansion: &InvariantManifold) -> impl Iterator<Item = usize> + '_ {
    expansion.masters.iter().enumerate().filter(|(k, master)| master.partner >= *k).map(|(k, _)| k)
}

/// Motion of the coordinates in turning axes, with the means of what accrues.
struct Slow<'a> {
    manifold: &'a InvariantManifold,
    accrued: &'a [&'a Accrued],
    phases: &'a Phases,
}

impl System<Vec<f64>> for Slow<'_> {
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let (turning, _) = y.split_at(2 * self.phases.0.len());
        let z = turning.as_chunks::<2>().0;
        let monomials = self.manifold.monomials(z);
        let lead = leads(self.manifold);
        for ((k, place), ([x, y], phase)) in
            lead.zip(rate.chunks_exact_mut(2)).zip(z.iter().zip(&self.phases.0))
        {
            let [re, im] = monomials.value(&self.manifold.rates[k]);
            place.copy_from_slice(&[re + phase * y, im - phase * x]);
        }
        for (place, accrued) in rate[turning.len()..].iter_mut().zip(self.accrued) {
            *place = monomials.value(&accrued.mean)[0];
        }
    }
}

/// Largest number of output times at which the defect is evaluated.
const EXAMINED: usize = 200;

struct Monitor<'a, 'b> {
    manifold: &'a SpinManifold<'b>,
    start: &'a ManifoldStart,
    phases: &'a Phases,
    /// Attitude of the body aligned with its angular momentum at the start, and the direction of that in inertial axes.
    base: [f64; 4],
    fixed: [f64; 3],
    /// Periodic parts at the start of what accrues.
    first: Vec<f64>,
    energy: f64,
    /// Outputs so far, and how many lie between two that are examined.
    outputs: usize,
    stride: usize,
    /// Mean power (W) at the outputs.
    powers: Vec<f64>,
    worst: (Defect, f64),
    /// Largest change of energy (J) that no dissipator explains.
    drift: f64,
    observer: &'a mut dyn Observer,
}

impl<'a, 'b> Monitor<'a, 'b> {
    fn new(
        manifold: &'a SpinManifold<'b>,
        start: &'a ManifoldStart,
        phases: &'a Phases,
        times: &[f64],
        observer: &'a mut dyn Observer,
    ) -> Self {
        let monomials = manifold.manifold.monomials(&start.z);
        let direction = manifold.direction(&monomials);
        let fixed = to_inertial(start.attitude, direction);
        let first = manifold.accrued().iter().map(|accrued| accrued.at(&monomials)[1]).collect();
        let energy = manifold.full_state(&start.z, start.attitude).energy(manifold.body);
        Self {
            manifold,
            start,
            phases,
            base: aligned(start.attitude, manifold.axis(), fixed),
            fixed,
            first,
            energy,
            outputs: 0,
            powers: Vec::with_capacity(times.len()),
            stride: times.len().div_ceil(EXAMINED).max(1),
            worst: (Defect::default(), 0.0),
            drift: 0.0,
            observer,
        }
    }

    /// Sample at a time, with the coordinates.
    fn sample(&self, t: f64, y: &[f64]) -> (Sample, Vec<[f64; 2]>) {
        let Self { manifold, start, .. } = self;
        let body = manifold.body;
        let z = self.phases.coordinates(t, &y[..2 * self.phases.0.len()]);
        let monomials = manifold.manifold.monomials(&z);
        let totals = self.totals(&monomials, y);
        let attitude = manifold.attitude(self.base, self.fixed, totals[0], &monomials);
        let state = manifold.full_state(&z, attitude);
        let angular_momentum = state.angular_momentum(body);
        let energy = state.energy(body);
        let dissipated: f64 = totals[2..].iter().sum();
        let place = add(start.place, scale(t, start.velocity));
        let motion = MotionState { omega: state.omega, q: &state.q, rate: &state.rate };
        let (offset, _) = body.pole_from_center(motion);
        let G = norm(manifold.spin.angular_momentum);
        let sample = Sample {
            t,
            omega: state.omega,
            attitude,
            angular_momentum,
            energy,
            dissipated,
            work: 0.0,
            energy_drift: energy - self.energy + dissipated,
            momentum_drift: (norm(angular_momentum) / G - 1.0).abs(),
            revolutions: totals[1] / TAU,
            place,
            velocity: start.velocity,
            pole: add(place, to_inertial(attitude, offset)),
        };
        (sample, z)
    }

    /// Totals since the start of what accrues.
    fn totals(&self, monomials: &crate::math::submanifold::Monomials, y: &[f64]) -> Vec<f64> {
        let means = &y[2 * self.phases.0.len()..];
        let accrued = self.manifold.accrued();
        let parts = accrued.iter().zip(means).zip(&self.first);
        parts.map(|((accrued, mean), first)| mean + accrued.at(monomials)[1] - first).collect()
    }

    fn budget(&self, t: f64, y: &[f64]) -> Vec<(String, f64)> {
        let z = self.phases.coordinates(t, &y[..2 * self.phases.0.len()]);
        let totals = self.totals(&self.manifold.manifold.monomials(&z), y);
        let names = self.manifold.body.dissipators().iter().map(|dissipator| dissipator.name.clone());
        names.zip(totals[2..].iter().copied()).collect()
    }
}

impl<M: Solver<State = Vec<f64>>> StepObserver<M> for Monitor<'_, '_> {
    fn output(&mut self, t: f64, y: &Vec<f64>) {
        let (sample, z) = self.sample(t, y);
        if self.outputs.is_multiple_of(self.stride) {
            let motion = self.manifold.defect_around(&z).motion;
            if !(motion <= self.worst.0.motion) {
                self.worst = (Defect { motion, power: 0.0 }, t);
            }
        }
        self.outputs += 1;
        self.powers.push(self.manifold.mean_power(&z));
        self.drift = self.drift.max(sample.energy_drift.abs());
        if self.observer.keeps_coordinates() {
            let state = self.manifold.full_state(&z, sample.attitude);
            self.observer.coordinates(&state.q, &state.rate);
        }
        self.observer.sample(&sample);
    }

    fn stepped(&mut self, solver: &mut M) -> std::ops::ControlFlow<()> {
        self.observer.progress(solver.t())
    }
}
