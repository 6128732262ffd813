use std::f64::consts::TAU;
use std::ops::ControlFlow;

use super::layout::{ANGLE, ATTITUDE, DISSIPATED, Layout, MOMENTUM, WORK, attitude, triple};
use super::solver::{FullSolver, Method};
use super::start::FullState;
use super::system::FullSystem;
use crate::dynamics::propagate::{Observer, Outcome, PROGRESS, PropagateError, Run, Sample, check};
use crate::math::ode::{Solver, Watcher, integrate};
use crate::math::rotation;
use crate::math::sym::norm;
use crate::model::FlexibleBody;

/// How a full run is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FullOptions {
    /// Method of integration.
    pub method: Method,
    /// Error allowed per step (1e-15 to 1e-2): of the momentum relative to its size, of the attitude in radians, of the
    /// coordinates and their momenta relative to those that the whole energy would give them.
    pub tolerance: f64,
    /// Steps allowed.
    pub most_steps: u64,
}

impl Default for FullOptions {
    fn default() -> Self {
        Self { method: Method::Automatic, tolerance: 1e-12, most_steps: 1_000_000_000 }
    }
}

/// Follows the full equations of a body from `t = 0` and observes it at the times asked for (s). (S2)–(S6)
///
/// # Errors
/// [`PropagateError`] before the first step. What goes wrong later is an [`Outcome`].
pub fn propagate_full(
    body: &FlexibleBody,
    initial: &FullState,
    times: &[f64],
    options: FullOptions,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    check(initial.omega, times, options.tolerance)?;
    let system = FullSystem::new(body);
    let y = initial.pack(body);
    let allowed = allowed(body, initial.omega, &y, options.tolerance);
    let K = triple(&y, MOMENTUM);
    let mut keeper = Keeper {
        K_N: rotation::to_inertial(initial.attitude, K),
        G: norm(K),
        energy: initial.energy(body),
        drift: 0.0,
        system: system.clone(),
        observer,
    };
    let mut solver = FullSolver::new(system, y, allowed, options.method);
    let outcome: Outcome = integrate(&mut solver, times, options.most_steps, &mut keeper);
    let (last, ..) = keeper.sample(solver.t(), solver.y());
    Ok(Run { outcome, last, work: solver.work() })
}

/// Error allowed per step in each component.
fn allowed(body: &FlexibleBody, omega: [f64; 3], y: &[f64], tolerance: f64) -> Vec<f64> {
    let layout = Layout { n: body.coordinates().len() };
    let [xx, yy, zz, ..] = body.invariants().J;
    let inertia = xx + yy + zz;
    let mut allowed = vec![f64::INFINITY; layout.len()];
    allowed[MOMENTUM..MOMENTUM + 3].fill(tolerance * norm(triple(y, MOMENTUM)));
    allowed[ATTITUDE..ATTITUDE + 4].fill(tolerance);
    for (j, k, pair) in body.invariants().pairs.iter().filter(|(j, k, _)| j == k) {
        allowed[layout.q().start + j] = tolerance * (inertia / pair.A).sqrt();
        allowed[layout.p().start + k] = tolerance * norm(omega) * (inertia * pair.A).sqrt();
    }
    allowed
}

/// Keeps the invariants and the accounts of a full run.
struct Keeper<'a, 'o> {
    system: FullSystem<'a>,
    /// Inertial momentum.
    K_N: [f64; 3],
    /// `|K|` at the start.
    G: f64,
    /// Energy at the start.
    energy: f64,
    /// `Σ ln(|K|/G)` of the projections made. (P6)
    drift: f64,
    observer: &'o mut dyn Observer,
}

impl Keeper<'_, '_> {
    fn sample(&mut self, t: f64, y: &[f64]) -> (Sample, Vec<f64>) {
        let (omega, rate, energy) = self.system.motion(y);
        let momentum = triple(y, MOMENTUM);
        let sample = Sample {
            t,
            omega,
            attitude: rotation::aligned(attitude(y), momentum, self.K_N),
            momentum,
            energy,
            dissipated: y[DISSIPATED],
            energy_drift: energy - self.energy + y[DISSIPATED] - y[WORK],
            momentum_drift: self.drift,
            turns: y[ANGLE] / TAU,
        };
        (sample, rate)
    }

    /// Puts `|K|` back to its value (P6) and the attitude back to the inertial momentum (P3).
    fn hold_invariants(&mut self, solver: &mut FullSolver) {
        let y = solver.y();
        let (K, attitude) = (triple(y, MOMENTUM), attitude(y));
        let mut change = vec![0.0; y.len()];
        let drift = (norm(K) / self.G).ln();
        self.drift += drift;
        let aligned = rotation::aligned(attitude, K, self.K_N);
        for i in 0..3 {
            change[MOMENTUM + i] = -drift * K[i];
        }
        for i in 0..4 {
            change[ATTITUDE + i] = aligned[i] - attitude[i];
        }
        solver.correct(&change);
    }
}

impl<'a> Watcher<FullSolver<'a>> for Keeper<'_, '_> {
    fn output(&mut self, t: f64, y: &Vec<f64>) {
        let (sample, rate) = self.sample(t, y);
        self.observer.coordinates(&y[self.system.layout.q()], &rate);
        self.observer.sample(&sample);
    }

    fn stepped(&mut self, solver: &mut FullSolver<'a>) -> ControlFlow<()> {
        self.hold_invariants(solver);
        if solver.work().steps.is_multiple_of(PROGRESS) {
            self.observer.progress(solver.t())
        } else {
            ControlFlow::Continue(())
        }
    }
}
