//! Linear part of a polynomial system at a state, by exact differentiation of its polynomials.

use nalgebra::Complex;

use super::eigenpair::{Eigenpair, two_sided};
use super::ring::{Ring, Truncated};
use super::system::{Equations, PolynomialSystem};
use crate::eigen::{Dense, NoConvergence, eigenvectors};
use crate::lu::{ComplexDense, Lu};

/// Linear part `M₀ δẋ = A₀ δx` of a polynomial system at a state, `M₀ = ∂P/∂x`, `A₀ = ∂F/∂x`. (W2)
#[derive(Clone, Debug)]
pub struct LinearPart {
    /// State.
    pub state: Vec<f64>,
    /// Momenta and forces there.
    pub momenta: Vec<f64>,
    /// Forces there: zero at an equilibrium.
    pub forces: Vec<f64>,
    /// `M₀`.
    pub mass: Dense,
    /// `A₀`.
    pub slope: Dense,
    /// Gradient of the conserved quantity, if there is one.
    pub conserved: Option<Vec<f64>>,
    /// Size of each component.
    pub scales: Vec<f64>,
    factor: Option<Lu>,
}

/// Eigenvalue and its vector, real and imaginary parts.
pub type LinearMode = ([f64; 2], Vec<[f64; 2]>);

/// Variables that are differentiated by at a time.
const CHUNK: usize = 24;

impl LinearPart {
    /// Linear part at a state.
    #[must_use]
    pub fn at(system: &dyn PolynomialSystem, state: &[f64]) -> Self {
        let size = system.size();
        let (mut mass, mut slope) = (Dense::zero(size), Dense::zero(size));
        let (mut momenta, mut forces) = (vec![0.0; size], vec![0.0; size]);
        let mut conserved: Option<Vec<f64>> = None;
        for start in (0..size).step_by(CHUNK) {
            let width = CHUNK.min(size - start);
            let ring = Ring::new(width, 1);
            let component = |i: usize| {
                let inside = i.checked_sub(start).filter(|offset| *offset < width);
                inside.map_or_else(|| ring.constant(state[i]), |offset| ring.shifted(state[i], offset, 1.0))
            };
            let x: Vec<Truncated> = (0..size).map(component).collect();
            let Equations { momenta: P, forces: F } = system.equations(&ring, &x);
            let real = |a: &Truncated, i: usize| a.at(i).re;
            for row in 0..size {
                (momenta[row], forces[row]) = (real(&P[row], 0), real(&F[row], 0));
                for offset in 0..width {
                    mass.add(row, start + offset, real(&P[row], 1 + offset));
                    slope.add(row, start + offset, real(&F[row], 1 + offset));
                }
            }
            if let Some(quantity) = system.conserved(&ring, &P) {
                let gradient = conserved.get_or_insert_with(|| vec![0.0; size]);
                (0..width).for_each(|offset| gradient[start + offset] = real(&quantity, 1 + offset));
            }
        }
        let state = state.to_vec();
        let factor = Lu::new(&mass);
        Self { state, momenta, forces, mass, slope, conserved, scales: system.scales(), factor }
    }

    /// `M₀⁻¹ x`; none where `M₀` is singular.
    #[must_use]
    pub fn accelerations(&self, x: &[f64]) -> Option<Vec<f64>> {
        self.factor.as_ref()?.solve(x, 1)
    }

    /// Eigenvalues `λ` of `A₀x = λM₀x` with `Im λ ≥ 0`, real and imaginary part, and their vectors.
    ///
    /// # Errors
    /// [`NoConvergence`] if the solver fails or `M₀` is singular.
    pub fn spectrum(&self) -> Result<Vec<LinearMode>, NoConvergence> {
        let size = self.state.len();
        let scaled = |matrix: &Dense| {
            let mut scaled = Dense::zero(size);
            (0..size * size).for_each(|k| {
                scaled.add(k / size, k % size, matrix.at(k / size, k % size) * self.scales[k % size]);
            });
            scaled
        };
        let slope = scaled(&self.slope);
        let right: Vec<f64> = (0..size * size).map(|k| slope.at(k / size, k % size)).collect();
        let solved = Lu::new(&scaled(&self.mass)).and_then(|factor| factor.solve(&right, size));
        let mut system = Dense::zero(size);
        for (k, entry) in solved.ok_or(NoConvergence { size })?.into_iter().enumerate() {
            system.add(k / size, k % size, entry);
        }
        let (values, vectors) = eigenvectors(&system)?;
        let unscaled = |vector: Vec<[f64; 2]>| {
            vector.iter().zip(&self.scales).map(|([re, im], scale)| [re * scale, im * scale]).collect()
        };
        let upper = values.into_iter().zip(vectors).filter(|([_, im], _)| *im >= 0.0);
        Ok(upper.map(|(value, vector)| (value, unscaled(vector))).collect())
    }

    /// Eigenvalue with its right and left vectors, from approximations of the first two; none without convergence.
    #[must_use]
    pub fn refined(&self, lambda: [f64; 2], right: &[[f64; 2]]) -> Option<Eigenpair> {
        two_sided(self, lambda, right)
    }

    /// `s M₀ − A₀`.
    pub(super) fn pencil(&self, s: Complex<f64>) -> ComplexDense {
        let mut pencil = ComplexDense::zero(self.state.len());
        pencil.add_scaled([s.re, s.im], &self.mass);
        pencil.add_scaled([-1.0, 0.0], &self.slope);
        pencil
    }
}
