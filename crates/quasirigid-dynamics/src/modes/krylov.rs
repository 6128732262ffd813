//! Slowest motions about a steady spin by shift-and-invert Krylov iteration.
//! The quadratic eigenproblem is taken in first order, `(x, λx)`, in units of equal energy; a solution with `P(σ)` is all that a step costs.
//! Equation (M24), docs/theory/15-modes.md; `[@tisseur2001]`.

use nalgebra::Complex;

use super::blocks::{BlockPencil, BorderedFactor};
use super::iteration::{Nonlinear, Pair};
use crate::math::arnoldi::{extended, norm, scaled};
use crate::math::eigen::{Dense, NoConvergence, eigenvectors};
use crate::math::random::Random;
use crate::math::watch;

/// Krylov basis of the motions near a real shift.
pub(super) struct Krylov<'a> {
    pencil: &'a BlockPencil<'a>,
    factor: BorderedFactor,
    shift: f64,
    /// Units of `x` and of `λx`.
    units: Vec<f64>,
    vectors: Vec<Vec<f64>>,
    /// Projection of the iteration, one column for each vector but the last.
    columns: Vec<Vec<f64>>,
}

/// Shares of the vectors of a basis in a motion, real and imaginary parts.
type Share = Vec<[f64; 2]>;

/// Residual of a motion, relative to its eigenvalue's inverse distance from the shift, from which it is refined.
const CONVERGED: f64 = 1e-6;
/// The same from which there is a motion near, but not yet the motion.
const FORMING: f64 = 0.3;
/// A vector that keeps less than this share of its length is in the span of the others.
const DEPENDENT: f64 = 1e-13;

impl<'a> Krylov<'a> {
    /// Basis of one vector at a positive shift (1/s), by a seed; none where the shift is an eigenvalue.
    pub fn new(pencil: &'a BlockPencil<'a>, shift: f64, seed: u64) -> Option<Self> {
        let factor = pencil.factor(Complex::from(shift))?;
        let weights = pencil.weights(Complex::from(1.0));
        let most = weights.iter().fold(0.0, |most: f64, weight| most.max(*weight));
        // a coordinate without mass has no unit of its own
        let unit = |weight: &f64| if *weight > 0.0 { *weight } else { most }.sqrt().recip();
        let units: Vec<f64> = weights.iter().map(unit).collect();
        let mut random = Random::new(seed);
        let first: Vec<f64> = (0..2 * units.len()).map(|_| random.unit() - 0.5).collect();
        let length = norm(&first);
        Some(Self { pencil, factor, shift, units, vectors: vec![scaled(first, length)], columns: Vec::new() })
    }

    /// Extends the basis to so many vectors; false where it spans an invariant space, none where a solution fails.
    pub fn extend(&mut self, count: usize) -> Option<bool> {
        while self.columns.len() < count {
            watch::ask();
            let image = self.applied(&self.vectors[self.columns.len()])?;
            let (column, next) = extended(&self.vectors, image);
            let (length, left) = (norm(&column), column[self.vectors.len()]);
            self.columns.push(column);
            if !(left > DEPENDENT * length) {
                return Some(false);
            }
            self.vectors.push(next);
        }
        Some(true)
    }

    /// `(λ − σ)⁻¹` of the first-order form, in units.
    fn applied(&self, z: &[f64]) -> Option<Vec<f64>> {
        let size = self.units.len();
        let shift = self.shift;
        let x: Vec<f64> = z[..size].iter().zip(&self.units).map(|(z, unit)| z * unit / shift).collect();
        let v: Vec<f64> = z[size..].iter().zip(&self.units).map(|(z, unit)| z * unit).collect();
        let ahead: Vec<f64> = v.iter().zip(&x).map(|(v, x)| v + shift * x).collect();
        let ([mass, ..], [_, rate, _]) = (self.pencil.by_power(&ahead), self.pencil.by_power(&x));
        let load: Vec<_> = mass.iter().zip(&rate).map(|(mass, rate)| Complex::from(-(mass + rate))).collect();
        let solved = self.pencil.solve_by(&self.factor, Complex::from(shift), &load)?;
        let scaled = |place: usize, value: f64| value / self.units[place];
        let first = (0..size).map(|place| scaled(place, shift * solved[place].re));
        let second = (0..size).map(|place| scaled(place, x[place] + shift * solved[place].re));
        let next: Vec<f64> = first.chain(second).collect();
        next.iter().all(|entry| entry.is_finite()).then_some(next)
    }

    /// Slowest motions, `Im λ ≥ 0`, up to the first that has not converged: a fast motion far from others converges before slower ones do.
    ///
    /// # Errors
    /// [`NoConvergence`] if the eigenvalue solver fails.
    pub fn motions(&self) -> Result<Vec<Pair>, NoConvergence> {
        let count = self.columns.len();
        let mut projected = Dense::zero(count);
        for (column, entries) in self.columns.iter().enumerate() {
            let within = entries.iter().enumerate().take(count);
            within.for_each(|(row, entry)| projected.add(row, column, *entry));
        }
        let beyond = match self.vectors.len() > count {
            true => self.columns.last().and_then(|column| column.last()).copied().unwrap_or(0.0),
            false => 0.0,
        };
        let (values, shares) = eigenvectors(&projected)?;
        let upper = values.iter().zip(&shares).filter(|([_, im], _)| *im <= 0.0);
        let mut found: Vec<(Complex<f64>, f64, &Share)> = upper
            .map(|([re, im], share)| {
                let length = share.iter().fold(0.0_f64, |sum, [re, im]| sum.hypot(re.hypot(*im)));
                let last = share.last().map_or(0.0, |[re, im]| re.hypot(*im));
                let residual = beyond.abs() * last / (re.hypot(*im) * length);
                (self.shift + Complex::new(*re, *im).inv(), residual, share)
            })
            .filter(|(lambda, residual, _)| lambda.is_finite() && *residual < FORMING)
            .collect();
        found.sort_by(|a, b| a.0.norm().total_cmp(&b.0.norm()));
        let converged = found.into_iter().take_while(|(_, residual, _)| *residual <= CONVERGED);
        Ok(converged.map(|(lambda, _, share)| (lambda, self.combined(share))).collect())
    }

    /// Unknowns of a motion by its shares in the basis.
    fn combined(&self, share: &Share) -> Vec<Complex<f64>> {
        let entry = |place: usize| {
            let parts = self.vectors.iter().zip(share);
            let sum: Complex<f64> =
                parts.map(|(vector, [re, im])| Complex::new(*re, *im) * vector[place]).sum();
            sum * self.units[place]
        };
        (0..self.units.len()).map(entry).collect()
    }
}
