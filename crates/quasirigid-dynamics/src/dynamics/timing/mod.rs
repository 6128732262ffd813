//! Timing of what acts on a body: places in time at which a run stops its steps, and the impulse of what is prescribed against a
//! quadrature of its own.
//!
//! An integrator learns of a force at the stages of its steps alone, so that a short force between two of them does not exist for it. The
//! times of what acts are known before the run: windows, rows of tables, corners of formulas, places where a formula changes quickly.
//! What acts by the motion has no such times: each step is compared with its own path, and taken back where it has passed something.
//! Equations (Z1) to (Z5), (Z7) and (Z8), docs/theory/19-events.md.

mod felt;
mod impulse;
mod missed;
mod prescribed;
mod sliding;
mod stops;

pub use missed::Missed;

pub(super) use felt::Along;
use felt::{FeltForce, Sight, felt_forces};
use impulse::Account;
use prescribed::prescribed;
use stops::{Stops, stops};

use super::control::ControlTimes;
use super::external::{Forced, Pose};
use super::run::Scan;
use crate::math::expression::Lobatto;
use crate::math::ode::{Checkpoint, StepRule, Stretch};
use crate::math::vec3::norm;
use crate::model::force::ForceLaw;
use crate::model::{FlexibleBody, Marker};

/// Timing of a run. (Z1)
#[derive(Debug)]
pub(super) struct Timing<'a> {
    stops: Stops<'a>,
    accounts: Vec<Account<'a>>,
    /// Forces by the motion, and times that no step passes because of them, ascending.
    felt: Vec<FeltForce<'a>>,
    passed: Vec<f64>,
    lobatto: Lobatto,
    /// Time at which the interval began that the steps are in, and the one at which it ends.
    interval: [f64; 2],
    end: f64,
    /// Force that was missed, which ends the run.
    pub missed: Option<Missed>,
}

/// What steps are compared with along their own path. (Z5)
pub(super) struct FeltLaws<'a> {
    pub body: &'a FlexibleBody,
    /// Laws of the forces by the motion.
    pub laws: Vec<&'a ForceLaw<Marker>>,
    /// Places in a step, as shares of it.
    pub shares: [f64; Lobatto::POINTS],
}

/// Sizes of errors that a run allows in a step, for the limits of the impulse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowed {
    /// Angular momentum (N·m·s).
    pub angular_momentum: f64,
    /// Velocity of the centre of mass (m/s); infinite where it is not followed.
    pub velocity: f64,
}

impl<'a> Timing<'a> {
    /// Timing of what acts on a body from `t = 0` to an end (s), controllers at their instants and in their field; none if nothing depends on the time.
    pub fn of(
        system: Forced<'a>,
        omega: [f64; 3],
        pose: &Pose<f64>,
        end: f64,
        controlled: ControlTimes,
    ) -> Option<Self> {
        if !(end > 0.0 && end.is_finite()) {
            return None;
        }
        let parts = prescribed(system);
        let mut stops = stops(system, omega, pose, end);
        stops.of_controllers(controlled);
        let felt = felt_forces(system);
        if parts.is_empty() && stops.is_empty() && felt.is_empty() {
            return None;
        }
        stops.follow(0.0);
        let accounts = parts.into_iter().map(Account::of).collect();
        let first = stops.next(0.0).min(end);
        let (passed, lobatto, interval) = (Vec::new(), Lobatto::new(), [0.0, first]);
        Some(Self { stops, accounts, felt, passed, lobatto, interval, end, missed: None })
    }

    /// Sets the limits of the impulse. (Z4)
    pub fn allow(&mut self, system: Forced, allowed: Allowed) {
        self.accounts.iter_mut().for_each(|account| account.allow(system.body, allowed));
        self.felt.iter_mut().for_each(|force| force.allow(allowed));
    }

    /// Cost and result of following the formulas so far.
    pub fn scan(&self) -> Scan {
        let (breaks, all) = (self.stops.breakpoints(), self.stops.list().len());
        Scan { evaluations: self.stops.evaluations, breakpoints: breaks as u64, stops: all as u64 }
    }

    /// Middles and lengths of the intervals in which forces change, as far as they are known.
    pub fn intervals(&self) -> Vec<[f64; 2]> {
        let ends = self.stops.list().iter().copied().chain([self.end]);
        let mut from = 0.0;
        let interval = |to: f64| {
            let interval = [0.5 * (from + to), to - from];
            from = to;
            interval
        };
        ends.map(interval).collect()
    }

    /// Time that no step from `t` on passes.
    pub fn stop(&mut self, t: f64) -> f64 {
        if t >= self.interval[1] {
            self.stops.follow(t);
            self.interval = [t, self.stops.next(t).min(self.end)];
        }
        self.passed.retain(|stop| *stop > t);
        self.passed.first().map_or(self.interval[1], |stop| stop.min(self.interval[1]))
    }

    /// What steps are compared with; none without a force by the motion. (Z5)
    pub fn felt(&self) -> Option<FeltLaws<'a>> {
        let body = self.felt.first()?.body;
        let laws = self.felt.iter().map(|force| force.law).collect();
        Some(FeltLaws { body, laws, shares: self.lobatto.points })
    }

    /// Whether a step is taken back, because it has not seen what acted along its path. (Z5)
    pub fn takes_back(&mut self, rule: StepRule, along: &[Along]) -> bool {
        let mut stops = Vec::new();
        for (force, along) in self.felt.iter_mut().zip(along) {
            match force.look(&self.lobatto, rule, along, self.end) {
                Sight::Seen => {}
                Sight::Again(found) => stops.extend(found),
                Sight::Missed(missed) => self.missed = self.missed.or(Some(missed)),
            }
        }
        let again = !stops.is_empty();
        self.passed.extend(stops);
        self.passed.sort_by(f64::total_cmp);
        again
    }

    /// The stretch between breakpoints that a step from `t` on lies in, and whether it begins there.
    pub fn stretch(&mut self, t: f64) -> Option<(Stretch, bool)> {
        self.stops.follow(t);
        self.stops.stretch(t)
    }

    /// Adds a step to the impulse, and compares it at the end of an interval. (Z4)
    pub fn stepped(&mut self, rule: StepRule, t: f64) {
        let [from, to] = self.interval;
        let stretch = self.stops.stretch(rule.t).map_or_else(Stretch::default, |(stretch, _)| stretch);
        let whole = t >= to;
        for account in &mut self.accounts {
            account.add(rule, stretch);
            if whole && self.missed.is_none() {
                self.missed = account.compare([from, t], stretch, to >= self.end);
            }
        }
        if let Some(lost) = self.stops.lost.filter(|lost| t > *lost) {
            let evaluations = self.stops.evaluations;
            self.missed = self.missed.or(Some(Missed::Unfollowed { t: lost, evaluations }));
        }
    }

    /// Saves the impulses.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.interval.iter().for_each(|t| checkpoint.save(*t));
        self.accounts.iter().for_each(|account| account.save(checkpoint));
        if !self.felt.is_empty() {
            for force in &self.felt {
                checkpoint.save(force.whole);
                force.sliding.save(checkpoint);
            }
            checkpoint.save_count(self.passed.len() as u64);
            self.passed.iter().for_each(|stop| checkpoint.save(*stop));
        }
    }

    /// Loads saved impulses.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        for t in &mut self.interval {
            *t = checkpoint.load()?;
        }
        self.stops.follow(self.interval[0]);
        self.accounts.iter_mut().try_for_each(|account| account.load(checkpoint))?;
        if !self.felt.is_empty() {
            for force in &mut self.felt {
                force.whole = checkpoint.load()?;
                force.sliding.load(checkpoint)?;
            }
            self.passed = (0..checkpoint.load_count()?).map(|_| checkpoint.load()).collect::<Option<_>>()?;
        }
        Some(())
    }
}

/// Impulse that turns the body by a radian in a second, or moves it by its radius of gyration (N·m·s of a torque, N·s of a force at a place). (Z8)
fn impulse_per_radian(body: &FlexibleBody, at: Option<&Marker>) -> f64 {
    let invariants = body.invariants();
    let [xx, yy, zz, ..] = invariants.J;
    let trace = xx + yy + zz;
    at.map_or(trace / 3.0, |at| {
        let gyration = (trace / invariants.mass).sqrt();
        (invariants.mass * gyration).min(trace / (3.0 * norm(at.position)))
    })
}

/// Error of the impulse that a step may have (N·m·s of a torque, N·s of a force at a place). (Z4)
fn allowed_impulse(body: &FlexibleBody, at: Option<&Marker>, allowed: Allowed) -> f64 {
    let Some(at) = at else { return allowed.angular_momentum };
    let invariants = body.invariants();
    let [xx, yy, zz, ..] = invariants.J;
    let gyration = ((xx + yy + zz) / invariants.mass).sqrt();
    let arm = norm(at.position).hypot(gyration);
    let shift = invariants.mass * allowed.velocity;
    (allowed.angular_momentum / arm).max(if shift.is_finite() { shift } else { 0.0 })
}
