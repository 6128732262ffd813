//! Balancing: a diagonal similarity by powers of two that makes the norms of each row and its column nearly equal.
//! The norms are Euclidean and include the diagonal, so that entries that are rounding errors are not raised beside large ones `[@james2014]`.

use super::matrices::Matrices;
use crate::lanes::{Lanes, Mask};
use crate::simd::Arithmetic;

/// Sweeps at most.
const SWEEPS: usize = 32;
/// Share of the norms that a change must leave at most to be made.
const WORTH: f64 = 0.95;

/// Balances the matrix of every lane; a lane that is balanced stays as it is while others go on.
#[inline(always)]
pub(super) fn balance<A: Arithmetic>(matrices: &mut Matrices) {
    for _ in 0..SWEEPS {
        let mut changed = Mask::NONE;
        for place in 0..matrices.size() {
            changed = changed | balance_place::<A>(matrices, place);
        }
        if !changed.any() {
            break;
        }
    }
}

/// Multiplies a column by a power of two, and divides the row by it, where that makes their norms smaller.
#[inline(always)]
fn balance_place<A: Arithmetic>(matrices: &mut Matrices, place: usize) -> Mask {
    let zero = Lanes::splat(0.0);
    let (mut row, mut column) = (zero, zero);
    for other in 0..matrices.size() {
        let (across, down) = (matrices.at(place, other), matrices.at(other, place));
        row = across.mul_add::<A>(across, row);
        column = down.mul_add::<A>(down, column);
    }
    let factor = (row / column).map(fourth_root);
    let inverse = Lanes::splat(1.0) / factor;
    let after = (column * factor * factor).sqrt() + (row * inverse * inverse).sqrt();
    let worth = after.at_most(Lanes::splat(WORTH) * (column.sqrt() + row.sqrt()));
    let change = worth & !row.at_most(zero) & !column.at_most(zero);
    if change.any() {
        let one = Lanes::splat(1.0);
        let (factor, inverse) = (factor.select(change, one), inverse.select(change, one));
        for other in (0..matrices.size()).filter(|other| *other != place) {
            matrices.set(other, place, matrices.at(other, place) * factor);
            matrices.set(place, other, matrices.at(place, other) * inverse);
        }
    }
    change
}

/// Power of two next to the fourth root of a positive number.
#[inline(always)]
fn fourth_root(number: f64) -> f64 {
    const BIAS: u64 = 1023;
    // biased exponent, two more for rounding; its bias is removed and put back beside the division
    let exponent = ((number.to_bits() >> 52) & 0x7ff) + 2;
    f64::from_bits(((exponent + 3 * BIAS) / 4) << 52)
}
