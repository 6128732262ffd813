//! Periodic solutions of autonomous systems by collocation at Radau points, for stiff and weakly damped motion alike.
//!
//! Between nodes that share the period evenly the solution is a polynomial that satisfies the equations at three Radau points: order five at
//! the nodes, and stiff parts die out as they do `[@ascher1981]`. Newton's method solves for all of it at once, with the period and a few parameters
//! that unfold the conserved quantities; in exchange as many components of the first node are given.

mod chain;
mod interval;
mod scaled;
mod solution;

pub use solution::{Guess, PeriodicSolution};

use super::eigen::eigenvalues;
use super::threads::Team;
use super::watch;
use chain::Chain;
use interval::Interval;
use scaled::Scaled;

/// Autonomous system `ż = f(z) + Σ πₖ gₖ(z)` whose periodic solutions are sought, on several threads at a time.
pub trait Unfolded: Clone + Send + Sync {
    /// Number of components.
    fn size(&self) -> usize;

    /// Number of parameters `π`.
    fn parameters(&self) -> usize;

    /// Rates `f + Σ πₖ gₖ` at a state.
    fn rate(&mut self, z: &[f64], parameters: &[f64], rate: &mut [f64]);

    /// Direction `g` of each parameter at a state.
    fn directions(&mut self, z: &[f64]) -> Vec<Vec<f64>>;

    /// Size of a component, with which its errors and the steps of differences are measured.
    fn scale(&self, component: usize) -> f64;
}

/// Newton's steps at most, and the relative change at which they end.
const MOST_STEPS: usize = 40;
const CLOSED: f64 = 1e-9;
/// Ratio of the period to that of the guess beyond which another solution was found, as that of a period of zero.
const FARTHEST: f64 = 4.0;
/// Ratio of a change to the one before up to which the slopes are kept.
const FAST: f64 = 0.3;
/// Growth of the change over the smallest so far at which the iteration is given up.
const DIVERGED: f64 = 1e3;

/// Finds the periodic solution near a guess that has the guess's values in the first `parameters + 1` components of its first node.
///
/// None where Newton's method does not converge, or to a solution of another length.
pub fn periodic(system: &impl Unfolded, guess: &Guess, intervals: usize) -> Option<PeriodicSolution> {
    let mut scaled = Scaled::of(system);
    let state = |share: f64| scaled.down(&(guess.state)(share));
    let sampled = Guess { period: guess.period, state: &state, parameters: guess.parameters.clone() };
    let solution = PeriodicSolution::sampled(&sampled, intervals, system.parameters());
    Some(closed(&mut scaled, guess.period, solution)?.map(|state| scaled.up(state)))
}

/// Closes a guess sampled over a period of about this length by Newton's method.
fn closed(
    system: &mut impl Unfolded,
    period: f64,
    mut solution: PeriodicSolution,
) -> Option<PeriodicSolution> {
    let mut linear = linearised(system, &solution)?;
    let (mut before, mut smallest) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..MOST_STEPS {
        watch::ask();
        let change = newton(system, &linear, &mut solution)?;
        if !change.is_finite() || change > DIVERGED * smallest {
            return None;
        }
        if change < CLOSED {
            let longer = solution.period() / period;
            return (longer > 1.0 / FARTHEST && longer < FARTHEST).then_some(solution);
        }
        if change < FAST * before && before.is_finite() {
            for (i, interval) in linear.iter_mut().enumerate() {
                interval.update(system, &solution, i)?;
            }
        } else {
            linear = linearised(system, &solution)?;
        }
        (before, smallest) = (change, smallest.min(change));
    }
    None
}

/// Floquet multipliers of a periodic solution, real and imaginary part: the factors by which small changes have grown after a period, at the
/// same parameters. None where they are not found.
pub fn multipliers(system: &impl Unfolded, solution: &PeriodicSolution) -> Option<Vec<[f64; 2]>> {
    let scaled = Scaled::of(system);
    let linear = linearised(&scaled, &solution.clone().map(|state| scaled.down(state)))?;
    eigenvalues(&Chain::of(system.size(), &linear).monodromy()?).ok()
}

/// Intervals of a solution, linear in changes of it.
fn linearised(system: &impl Unfolded, solution: &PeriodicSolution) -> Option<Vec<Interval>> {
    let linear = |i| Interval::linear(&mut system.clone(), solution, i);
    Team::new().map((0..solution.intervals()).collect(), linear).into_iter().collect()
}

/// Takes one step of Newton's method; returns the largest relative change of a component.
fn newton(system: &mut impl Unfolded, linear: &[Interval], solution: &mut PeriodicSolution) -> Option<f64> {
    let (nodes, shared) = Chain::of(system.size(), linear).solved(1 + system.parameters())?;
    let mut largest = 0.0_f64;
    for (i, interval) in linear.iter().enumerate() {
        let stages = interval.change(&nodes[i], &shared);
        for (place, change) in stages.iter().enumerate() {
            largest = largest.max(change.abs() / system.scale(place % system.size()));
        }
        solution.move_by(i, &nodes[i], &stages);
    }
    solution.move_shared(&shared);
    Some(largest)
}

#[cfg(test)]
mod tests;
