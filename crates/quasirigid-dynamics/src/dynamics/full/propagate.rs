//! Integration of the full system from an initial state, with monitor, events and error scales.
//! Errors are allowed per component by its share of the energy; quantities that steer nothing (accounts, place without forces) get none,
//! or they would set the step.
//! "Errors allowed" and equations (T1), docs/theory/08-full-system.md; (D4), docs/theory/11-materials.md.

use super::drives::energy;
use super::solver::FullSolver;
use super::start::FullState;
use super::system::FullSystem;
use crate::dynamics::conserved_momentum::Conserved;
use crate::dynamics::control::{ControlBlock, Seen};
use crate::dynamics::external::Forced;
use crate::dynamics::invariant_monitor::InvariantMonitor;
use crate::dynamics::layout::{ATTITUDE, Layout, MOMENTUM, PLACE, VELOCITY, WORK, triple};
use crate::dynamics::run::{Observer, Options, PropagateError, Run, check, check_covered};
use crate::dynamics::scale::Scales;
use crate::math::ode::{Solver, integrate};
use crate::model::FlexibleBody;
use crate::model::control::Controls;

/// Integrates the full equations of a body from `t = 0` and observes the body at the output times (s). (S2)–(S6), (F11)
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let body = ring_of_points(2).body()?;
/// let system = Forced::not(&body);
/// let settled = Start::new([0.1, 0.0, 1.0], ALIGNED).settled(system, 3)?;
/// let options = Options { tolerance: 1e-9, ..Options::default() };
/// let mut samples: Vec<Sample> = Vec::new();
/// let run = propagate_full(system, &settled, &[0.0, 1.0], &options, &mut samples)?;
/// assert_eq!(run.outcome, Outcome::Finished);
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// # Errors
/// [`PropagateError`] before the first step. A later failure is an [`Outcome`](crate::dynamics::Outcome).
pub fn propagate_full(
    system: Forced,
    initial: &FullState,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    propagate_controlled(system, Controls::NONE, initial, times, options, observer)
}

/// Integrates the full equations of a body under controllers from `t = 0`, as [`propagate_full`] those without; the states of their laws
/// are part of the motion, and their instants are breakpoints. (Y1)–(Y4)
///
/// # Errors
/// [`PropagateError`] before the first step. A later failure is an [`Outcome`](crate::dynamics::Outcome).
pub fn propagate_controlled(
    system: Forced,
    controls: &Controls,
    initial: &FullState,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<Run, PropagateError> {
    let end = times.last().copied().unwrap_or_default();
    check_drives(system.body, end)?;
    let initial = &initial.clone().driven(system.body);
    check_state(system.body, initial)?;
    let block = ControlBlock::of(controls);
    let layout = Layout::of(system.body).with_controls(block.len());
    let mut y = initial.pack(system.body, layout);
    let seen = Seen { t: 0.0, attitude: initial.attitude, motion: initial.motion() };
    y[layout.controls()].copy_from_slice(&block.start(&seen));
    let started = &y[layout.controls()];
    let torque = block.size(&seen, started);
    if !(torque.is_finite() && started.iter().all(|value| value.is_finite())) {
        return Err(PropagateError::NoForce);
    }
    check_covered(system.forces, end)?;
    let (pose, motion) = (initial.pose(), (initial.omega, triple(&y, MOMENTUM)));
    let (mut scales, mut timing) = Scales::controlled(system, (torque, block.times()), motion, pose, end);
    if initial.omega == [0.0; 3] {
        scales.stir(initial.energy(system.body));
    }
    check(scales.spin, initial.attitude, times, options)?;
    let mut sizes = sizes(system.body, layout, &scales);
    sizes[layout.controls()].copy_from_slice(&block.sizes(&seen, started, &scales));
    if let Some(energy) = energy(system.body, end) {
        sizes[WORK] = energy.max(scales.spin * scales.angular_momentum);
    }
    let allowed = sizes.iter().map(|size| options.tolerance * size).collect();
    let mut full = FullSystem::new(system, controls, &sizes).ok_or(PropagateError::LightCarrier)?;
    full.begin(&mut y, end);
    let angular_momentum = Conserved::of(triple(&y, MOMENTUM), initial.attitude, scales.inside);
    let mut monitor = InvariantMonitor::new(full.clone(), &y, angular_momentum, options, observer);
    if let Some(timing) = &mut timing {
        timing.allow(system, scales.allowed(options.tolerance));
    }
    monitor.timing = timing;
    let mut solver = FullSolver::new(full, y, allowed, options.method, options.rounding);
    let first = monitor.resume(&mut solver)?;
    let reason = integrate(&mut solver, times, first, options.most_steps, &mut monitor);
    let last = monitor.sample(solver.t(), solver.y());
    let run = Run {
        outcome: monitor.outcome(reason),
        last,
        work: solver.work(),
        scan: monitor.scan(),
        left_out: 0.0,
        load_ratio: 0.0,
        ringing: None,
    };
    observer.budget(&budget(system.body, &solver.y()[layout.accounts()], last.dissipated));
    Ok(run)
}

/// Refuses laws that no drive follows up to an end (s). (T10)
pub(super) fn check_drives(body: &FlexibleBody, end: f64) -> Result<(), PropagateError> {
    let faults = body.drives().iter().filter_map(|drive| Some((drive.coordinate, drive.fault(end)?)));
    match faults.into_iter().next() {
        Some((coordinate, fault)) => Err(PropagateError::Drive { coordinate, fault }),
        None => Ok(()),
    }
}

/// Refuses a state that is none of a body.
pub(super) fn check_state(body: &FlexibleBody, initial: &FullState) -> Result<(), PropagateError> {
    let (coordinates, rates) = (initial.q.len(), initial.rate.len());
    let needed = body.coordinates().len();
    if (coordinates, rates) != (needed, needed) {
        return Err(PropagateError::Coordinates { coordinates, rates, needed });
    }
    let FullState { q, rate, place, velocity, .. } = initial;
    if !q.iter().chain(rate).chain(place).chain(velocity).all(|value| value.is_finite()) {
        return Err(PropagateError::NotFinite);
    }
    Ok(())
}

/// Energy taken by each dissipator, from the accounts of a state if there are several. (D4)
fn budget(body: &FlexibleBody, accounts: &[f64], dissipated: f64) -> Vec<(String, f64)> {
    let energies = if accounts.is_empty() { &[dissipated] } else { accounts };
    let names = body.dissipators().iter().map(|part| part.name.clone());
    names.zip(energies.iter().copied()).collect()
}

/// Error scale of each component; infinite where its error has no effect.
pub(super) fn sizes(body: &FlexibleBody, layout: Layout, scales: &Scales) -> Vec<f64> {
    let mut sizes = vec![f64::INFINITY; layout.len()];
    sizes[MOMENTUM..MOMENTUM + 3].fill(scales.angular_momentum);
    sizes[ATTITUDE..ATTITUDE + 4].fill(1.0);
    sizes[PLACE..PLACE + 3].fill(scales.place);
    sizes[VELOCITY..VELOCITY + 3].fill(scales.velocity);
    for (j, k, pair) in body.invariants().pairs.iter().filter(|(j, k, _)| j == k) {
        sizes[layout.q().start + j] = (scales.inertia / pair.A).sqrt();
        sizes[layout.p().start + k] = scales.spin * (scales.inertia * pair.A).sqrt();
    }
    for drive in body.drives() {
        sizes[layout.q().start + drive.coordinate] = f64::INFINITY;
        sizes[layout.p().start + drive.coordinate] = f64::INFINITY;
    }
    sizes
}
