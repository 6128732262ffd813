//! Driven coordinates: places and angles of parts that a drive prescribes over time, and what no drive can follow.
//! Equations (T7) and (T10), docs/theory/08-full-system.md.

use std::fmt;
use std::ops::Range;

use crate::math::expression::Expression;
use crate::math::taylor::Taylor;

/// Drive of an internal coordinate: it keeps the coordinate at a function of time, whatever that takes. (T7)
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Name of the part, as in the model file.
    pub name: String,
    /// Coordinate, an elastic one.
    pub coordinate: usize,
    /// Value (m or rad): an expression of the single variable `t` (s).
    pub law: Expression,
}

/// Fault of a law that no drive follows.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DriveFault {
    /// The law has no value, rate or acceleration.
    NoValue {
        /// Time (s).
        t: f64,
    },
    /// The law jumps.
    Jump {
        /// Time (s).
        t: f64,
        /// Value before.
        from: f64,
        /// Value after.
        to: f64,
    },
    /// The law changes too often for its corners and jumps to be known.
    Unfollowed,
}

impl fmt::Display for DriveFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoValue { t } => write!(
                f,
                "has no value, rate or acceleration at t = {t} s; look for a logarithm, division, square root or other broken power there"
            ),
            Self::Jump { t, from, to } => write!(
                f,
                "jumps from {from} to {to} at t = {t} s, which takes an infinite force; let it change over some time"
            ),
            Self::Unfollowed => f.write_str(
                "changes too often in this time for all of its corners to be found; shorten the run, or write it without abs, min, max and step",
            ),
        }
    }
}

/// Evaluations of a law that its corners may cost.
const EVALUATIONS: u64 = 1_000_000;
/// Distance from a corner at which both of its sides are looked at, relative to the time: more than the rounding of its place.
const BESIDE: f64 = 64.0 * f64::EPSILON;
/// Change of a law across a corner, relative to its largest value, that is a jump.
const JUMP: f64 = 1e-9;

impl Drive {
    /// Value, rate and acceleration at a time (s). (T7)
    #[must_use]
    pub fn at(&self, t: f64) -> [f64; 3] {
        self.law.value(&[Taylor::<3>::variable(t)]).derivatives()
    }

    /// The drive in a body with these coordinates kept and the others locked; none if its own is locked.
    pub(super) fn locked(&self, kept: &Range<usize>) -> Option<Self> {
        let coordinate = kept.contains(&self.coordinate).then(|| self.coordinate - kept.start)?;
        Some(Self { coordinate, ..self.clone() })
    }

    /// Whether the law may have corners or jumps, which steps must not pass.
    #[must_use]
    pub fn has_corners(&self) -> bool {
        self.law.is_narrow_in(|_| true)
    }

    /// Fault of the law from `t = 0` to an end (s); none of one that a drive follows. (T10)
    #[must_use]
    pub fn fault(&self, end: f64) -> Option<DriveFault> {
        let (mut looks, mut breaks) = (vec![0.0, end], Vec::new());
        if self.has_corners() {
            let found = self.law.changes(0, &[0.0], [0.0, end], EVALUATIONS);
            if !found.complete {
                return Some(DriveFault::Unfollowed);
            }
            looks.extend(found.ends.iter().filter(|t| !found.breaks.contains(t)));
            breaks = found.breaks;
        }
        let mut largest = 0.0_f64;
        for t in looks {
            let value = self.at(t);
            if !value.iter().all(|part| part.is_finite()) {
                return Some(DriveFault::NoValue { t });
            }
            largest = largest.max(value[0].abs());
        }
        breaks.into_iter().find_map(|t| self.fault_at(t, largest))
    }

    /// Fault at a corner of a law whose values are this large.
    fn fault_at(&self, t: f64, largest: f64) -> Option<DriveFault> {
        let [before, after] = [t * (1.0 - BESIDE), t * (1.0 + BESIDE)].map(|t| self.at(t));
        if !before.iter().chain(&after).all(|part| part.is_finite()) {
            return Some(DriveFault::NoValue { t });
        }
        let ([from, ..], [to, ..]) = (before, after);
        let jumps = (to - from).abs() > JUMP * largest.max(from.abs()).max(to.abs());
        jumps.then_some(DriveFault::Jump { t, from, to })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str, end: f64) -> Option<DriveFault> {
        let law = Expression::parse(text, &["t"]).unwrap();
        Drive { name: "boom".into(), coordinate: 0, law }.fault(end)
    }

    #[test]
    fn corners_are_followed_and_jumps_are_not() {
        for law in ["2", "0.3*t", "min(t, 10)", "3 + abs(t-7.1)*1e-4", "max(0, t-3)^2", "sin(3*t)*exp(-t/9)"]
        {
            assert_eq!(fault(law, 40.0), None, "{law}");
        }
        let Some(DriveFault::Jump { t, from, to }) = fault("1e-5*(2 + step(t-11.3))", 40.0) else { panic!() };
        assert!((t - 11.3).abs() < 1e-12 && (from / 2e-5 - 1.0).abs() + (to / 3e-5 - 1.0).abs() < 1e-12);
        assert_eq!(fault("step(t-41)", 40.0), None);
    }

    #[test]
    fn laws_without_a_value_or_a_rate_are_refused() {
        for law in ["sqrt(t)", "t^1.5", "ln(t-3)", "sqrt(9-t)", "1/(t-40)"] {
            assert!(
                matches!(fault(law, 40.0), Some(DriveFault::NoValue { .. })),
                "{law}: {:?}",
                fault(law, 40.0)
            );
        }
        assert!(fault("1/(t-7.3)", 40.0).is_some());
        assert_eq!(fault("abs(sin(1e9*t))", 1e4), Some(DriveFault::Unfollowed));
    }
}
