//! Place of a motion on a section after whole revolutions, and leaps over many of them.
//! Sums are kept in two parts: after 10⁹ revolutions the rounding of a time is a share of a revolution.
//! Equation (P12), docs/theory/05-propagation.md.

use std::f64::consts::TAU;

use super::rates::Fit;
use super::revolution::ROWS;
use crate::math::ode::{Checkpoint, Dop853, Solver, System};
use crate::math::simd::{Arithmetic, Plain};

/// Place on a section after whole revolutions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub revolutions: u64,
    /// Sums of the changes since the start, in the order of [`Revolution::changes`], with their rounding errors.
    sums: [f64; ROWS],
    carry: [f64; ROWS],
}

/// Row of the precession, of which whole turns do not matter.
const PRECESSION: usize = 2;
/// Error allowed per step, relative to the whole change.
const TOLERANCE: f64 = 1e-15;
/// Error of `ln ψ` that is always allowed.
const ROUNDING: f64 = 1e-18;
/// Limit of the steps of a leap.
const STEPS: usize = 100_000;

impl Place {
    pub fn new(sums: [f64; ROWS]) -> Self {
        Self { revolutions: 0, sums, carry: [0.0; ROWS] }
    }

    /// Angle (rad) from the axis.
    pub fn psi(&self) -> f64 {
        self.sums[0].exp()
    }

    /// Sums of the changes, in the order of [`Revolution::changes`].
    pub fn sums(&self) -> [f64; ROWS] {
        self.sums
    }

    /// Time (s) from here to `t`.
    pub fn before(&self, t: f64) -> f64 {
        (t - self.sums[1]) - self.carry[1]
    }

    /// After more revolutions that make these changes, in the order of [`Revolution::changes`].
    ///
    /// [`Revolution::changes`]: super::revolution::Revolution::changes
    pub fn moved(&self, revolutions: u64, changes: [f64; ROWS]) -> Self {
        let mut place = Self { revolutions: self.revolutions + revolutions, ..*self };
        for ((sum, carry), change) in place.sums.iter_mut().zip(&mut place.carry).zip(changes) {
            let whole = *sum + change;
            let part = whole - *sum;
            *carry += (*sum - (whole - part)) + (change - part);
            let settled = whole + *carry;
            *carry -= settled - whole;
            *sum = settled;
        }
        place.sums[PRECESSION] = place.sums[PRECESSION].rem_euclid(TAU);
        place
    }

    /// After the most whole revolutions, `most` at the most, that end before a time (s) and on the interval of the rates; `at` receives
    /// places passed, as the number of revolutions and the angle. (P12)
    pub fn leap(&self, fit: &Fit, until: f64, most: u64, mut at: impl FnMut(f64, f64)) -> Self {
        let left = self.before(until);
        let psi = self.psi();
        let rates = fit.at(psi, 0.0);
        let end = if rates[0] > 0.0 { fit.ends()[1] } else { fit.ends()[0] };
        let room = (end / psi).ln() / rates[0];
        let whole = (left / rates[1]).min(room).min(most as f64).max(1.0);
        let beyond = |y: &[f64; ROWS]| y[1] > left || !fit.holds(psi * y[0].exp());
        let mut allowed =
            fit.largest().map(|rate| if rate > 0.0 { TOLERANCE * whole * rate } else { f64::INFINITY });
        allowed[0] = allowed[0].max(ROUNDING);
        let slow = Slow { fit, psi };
        let mut solver = Dop853::<_, _, Plain>::new(slow, 0.0, [0.0; ROWS], allowed);
        solver.try_step(whole);
        let mut reached = (0, [0.0; ROWS]);
        for _ in 0..STEPS {
            let before = solver.t();
            if before >= whole || solver.step(whole).is_err() {
                break;
            }
            let (low, high) = (before.floor() as u64, solver.t().floor() as u64);
            let over = beyond(solver.y());
            let last = if over { last_where(low, high, |n| !beyond(&solver.within(n as f64))) } else { high };
            if last > low {
                reached = (last, solver.within(last as f64));
                at(self.revolutions as f64 + last as f64, psi * reached.1[0].exp());
            }
            if over {
                break;
            }
        }
        self.moved(reached.0, reached.1)
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_count(self.revolutions);
        checkpoint.save_list(&self.sums);
        checkpoint.save_list(&self.carry);
    }

    pub fn load(checkpoint: &mut Checkpoint) -> Option<Self> {
        let mut place = Self { revolutions: checkpoint.load_count()?, sums: [0.0; ROWS], carry: [0.0; ROWS] };
        checkpoint.load_into(&mut place.sums)?;
        checkpoint.load_into(&mut place.carry)?;
        Some(place)
    }
}

/// The last number from `low` to `high` for which a condition holds that holds at `low` and, once broken, stays so.
pub(super) fn last_where(low: u64, high: u64, mut holds: impl FnMut(u64) -> bool) -> u64 {
    let (mut low, mut high) = (low, high + 1);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if holds(middle) { low = middle } else { high = middle }
    }
    low
}

/// Changes since a place, with the number of revolutions for the independent variable.
struct Slow<'a> {
    fit: &'a Fit,
    psi: f64,
}

impl System<[f64; ROWS]> for Slow<'_> {
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &[f64; ROWS], rate: &mut [f64; ROWS]) {
        *rate = self.fit.at(self.psi, y[0]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A million revolutions of 0.3 s at a time of 10⁹ s, where the rounding of the time is 10⁻⁷ s: what is left to a time loses none of
    /// them. The period is a sum of powers of two, so that the time of all of them is exact.
    #[test]
    fn times_of_many_revolutions_lose_nothing() {
        let (start, count) = (1e9, 1_000_000_u32);
        let period = 0.3_f64 - 0.3_f64.rem_euclid(f64::powi(2.0, -26)) + f64::powi(2.0, -30);
        let mut place = Place::new([0.0, start, 0.0, 0.0, 0.0, 0.0]);
        for _ in 0..count {
            place = place.moved(1, [0.0, period, 0.0, 0.0, 0.0, 0.0]);
        }
        assert_eq!(place.revolutions, u64::from(count));
        let end = start + (f64::from(count) * period).floor();
        let left = place.before(end) + (f64::from(count) * period).fract();
        assert!(left.abs() < 1e-10, "{left:e} s");
    }
}
