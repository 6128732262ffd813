//! Lanes: eight numbers that take the same operations side by side, one for each of eight problems.
//! An operation on lanes rounds each as the same operation on one number does, so that a problem gives the same bits in any lane and alone.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Not, Sub};

use crate::scalar::Scalar;
use crate::simd::Arithmetic;

/// Number of lanes.
pub const LANES: usize = 8;

/// Numbers of eight problems, side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes(pub [f64; LANES]);

/// One truth for each lane: all bits set, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(64))]
pub struct Mask([u64; LANES]);

impl Mask {
    /// False in every lane.
    pub const NONE: Self = Self([0; LANES]);

    /// Truth in a lane.
    #[inline(always)]
    #[must_use]
    pub fn get(self, lane: usize) -> bool {
        self.0[lane] != 0
    }

    /// Sets the truth in a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, truth: bool) {
        self.0[lane] = if truth { u64::MAX } else { 0 };
    }

    /// Whether it is true in any lane.
    #[inline(always)]
    #[must_use]
    pub fn any(self) -> bool {
        let mut all = 0;
        let mut lane = 0;
        while lane < LANES {
            all |= self.0[lane];
            lane += 1;
        }
        all != 0
    }

    /// Lane by lane.
    #[inline(always)]
    fn each(self, other: Self, operation: impl Fn(u64, u64) -> u64) -> Self {
        let mut result = self;
        let mut lane = 0;
        while lane < LANES {
            result.0[lane] = operation(self.0[lane], other.0[lane]);
            lane += 1;
        }
        result
    }
}

impl Not for Mask {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        self.each(self, |a, _| !a)
    }
}

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    #[must_use]
    pub const fn splat(number: f64) -> Self {
        Self([number; LANES])
    }

    /// Lane by lane.
    #[inline(always)]
    fn each(self, other: Self, operation: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = self;
        let mut lane = 0;
        while lane < LANES {
            result.0[lane] = operation(self.0[lane], other.0[lane]);
            lane += 1;
        }
        result
    }

    /// `self · b + c`.
    #[inline(always)]
    #[must_use]
    pub fn mul_add<A: Arithmetic>(self, b: Self, c: Self) -> Self {
        let mut result = c;
        let mut lane = 0;
        while lane < LANES {
            result.0[lane] = A::mul_add(self.0[lane], b.0[lane], c.0[lane]);
            lane += 1;
        }
        result
    }

    /// A function of each lane.
    #[inline(always)]
    #[must_use]
    pub fn map(self, function: impl Fn(f64) -> f64) -> Self {
        self.each(self, |a, _| function(a))
    }

    /// Square root.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// Size.
    #[inline(always)]
    #[must_use]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The smaller number; where `self` is NaN, the other.
    #[inline(always)]
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        self.each(other, |a, b| if a < b { a } else { b })
    }

    /// The larger number; where `self` is NaN, the other.
    #[inline(always)]
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        self.each(other, |a, b| if a > b { a } else { b })
    }

    /// Where `self ≤ other`; false where either is NaN.
    #[inline(always)]
    #[must_use]
    pub fn at_most(self, other: Self) -> Mask {
        let mut mask = Mask::NONE;
        let mut lane = 0;
        while lane < LANES {
            mask.0[lane] = if self.0[lane] <= other.0[lane] { u64::MAX } else { 0 };
            lane += 1;
        }
        mask
    }

    /// `self` where the mask is true, `other` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn select(self, mask: Mask, other: Self) -> Self {
        let mut result = other;
        let mut lane = 0;
        while lane < LANES {
            result.0[lane] = if mask.0[lane] != 0 { self.0[lane] } else { other.0[lane] };
            lane += 1;
        }
        result
    }
}

impl From<f64> for Lanes {
    #[inline(always)]
    fn from(number: f64) -> Self {
        Self::splat(number)
    }
}

/// Operators lane by lane.
macro_rules! lane_by_lane {
    ($($type:ty: $trait:ident $name:ident $operator:tt;)+) => {
        $(impl $trait for $type {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                self.each(other, |a, b| a $operator b)
            }
        })+
    };
}

lane_by_lane! {
    Mask: BitAnd bitand &;
    Mask: BitOr bitor |;
    Lanes: Add add +;
    Lanes: Sub sub -;
    Lanes: Mul mul *;
    Lanes: Div div /;
}

impl Scalar for Lanes {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::Unfused;

    const A: Lanes = Lanes([1.0, -2.0, 0.0, -0.0, 4.0, f64::INFINITY, f64::NAN, 1e-300]);
    const B: Lanes = Lanes([3.0, -2.0, 0.5, 0.0, -1.0, 2.0, 5.0, f64::NAN]);

    /// The same bits; any NaN is one.
    fn same(a: f64, b: f64) -> bool {
        a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
    }

    #[test]
    fn operations_are_those_of_each_lane() {
        let c = Lanes::from(0.25);
        for lane in 0..LANES {
            let (a, b) = (A.0[lane], B.0[lane]);
            let found = [A + B, A - B, A * B, A / B, A.sqrt(), A.abs(), A.mul_add::<Unfused>(B, c)];
            let found = found.map(|lanes| lanes.0[lane]);
            let known = [a + b, a - b, a * b, a / b, a.sqrt(), a.abs(), a * b + 0.25];
            assert!(
                found.iter().zip(known).all(|(found, known)| same(*found, known)),
                "{lane}: {found:?} {known:?}"
            );
            let least = if a < b { a } else { b };
            let greatest = if a > b { a } else { b };
            assert!(same(A.min(B).0[lane], least) && same(A.max(B).0[lane], greatest), "{lane}");
        }
    }

    #[test]
    fn masks_choose_lane_by_lane() {
        let below = A.at_most(B);
        let mut odd = Mask::NONE;
        (0..LANES).for_each(|lane| odd.set(lane, lane % 2 == 1));
        for lane in 0..LANES {
            let (one, other) = (A.0[lane] <= B.0[lane], lane % 2 == 1);
            assert_eq!((below.get(lane), odd.get(lane), Mask::NONE.get(lane)), (one, other, false), "{lane}");
            let found = [below & odd, below & !odd, below | odd, !below].map(|mask| mask.get(lane));
            assert_eq!(found, [one && other, one && !other, one || other, !one], "{lane}");
            let mut alone = Mask::NONE;
            alone.set(lane, true);
            assert!(alone.any() && !Mask::NONE.any(), "{lane}");
            let chosen = if one { A } else { B }.0[lane];
            assert!(same(A.select(below, B).0[lane], chosen), "{lane}");
        }
        odd.set(3, false);
        assert!(!odd.get(3) && odd.get(5));
    }
}
