//! Reduction to Hessenberg form by Householder's reflections, in lanes.

use super::matrices::Matrices;
use crate::lanes::Lanes;
use crate::simd::Arithmetic;

/// Reduces the matrix of every lane to one with zeros below the first subdiagonal, by orthogonal similarities.
#[inline(always)]
pub(super) fn reduce<A: Arithmetic>(matrices: &mut Matrices) {
    let size = matrices.size();
    let zero = Lanes::splat(0.0);
    let mut normal = vec![zero; size];
    let mut sums = vec![zero; size];
    for column in 0..size.saturating_sub(2) {
        let first = column + 1;
        let lead = matrices.at(first, column);
        let mut rest = zero;
        for row in first + 1..size {
            let entry = matrices.at(row, column);
            rest = entry.mul_add::<A>(entry, rest);
            normal[row] = entry;
        }
        let none = rest.at_most(Lanes::splat(f64::MIN_POSITIVE));
        let length = lead.mul_add::<A>(lead, rest).sqrt();
        let length = (zero - length).select(lead.at_most(zero), length);
        normal[first] = lead + length;
        // I − factor · normal · normalᵀ
        let factor = zero.select(none, Lanes::splat(1.0) / (length * normal[first]));
        let scaled = |sum: Lanes| zero - factor * sum;
        matrices.set(first, column, lead.select(none, zero - length));
        for row in first + 1..size {
            matrices.set(row, column, zero);
        }
        sums[first..].fill(zero);
        for (row, entries) in matrices.rows_mut(first).take(size - first).enumerate() {
            let weight = normal[first + row];
            for (sum, entry) in sums[first..].iter_mut().zip(&entries[first..size]) {
                *sum = weight.mul_add::<A>(*entry, *sum);
            }
        }
        sums[first..].iter_mut().for_each(|sum| *sum = scaled(*sum));
        for (row, entries) in matrices.rows_mut(first).take(size - first).enumerate() {
            let weight = normal[first + row];
            for (sum, entry) in sums[first..].iter().zip(&mut entries[first..size]) {
                *entry = weight.mul_add::<A>(*sum, *entry);
            }
        }
        for entries in matrices.rows_mut(0).take(size) {
            let mut sum = zero;
            for (weight, entry) in normal[first..].iter().zip(&entries[first..size]) {
                sum = weight.mul_add::<A>(*entry, sum);
            }
            let sum = scaled(sum);
            for (weight, entry) in normal[first..].iter().zip(&mut entries[first..size]) {
                *entry = weight.mul_add::<A>(sum, *entry);
            }
        }
    }
}
