//! Harmonic balance of Hill's equations: linear system of the Fourier amplitudes, preconditioned by its diagonal blocks.
//! Each harmonic is factored with the mean angular velocity, the couplings follow by GMRES; unknowns are scaled to equal energy and to the
//! size of the wobble, so that a wobble of 1e-8 loses no digits.
//! Equation (H4), docs/theory/14-spinning-frame.md; GMRES `[@saad1986]`.

use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

use super::coefficients::Coefficients;
use super::series::{Amplitudes, add_product, derivative};
use super::spectrum::Spectrum;
use crate::averaging::response::Law;
use crate::math::gmres::gmres;
use crate::math::vec3;

/// Linear system of the harmonics 0 to `N` along a polhode, preconditioned by each harmonic alone in the mean angular velocity. (H4)
///
/// Unknowns are amplitudes of the displacement; the mean of a cyclic row is that of its rate, since the value itself displaces nothing.
pub(super) struct Operator<'a> {
    coefficients: &'a Coefficients,
    spectrum: &'a Spectrum,
    last: usize,
    alone: Vec<LU<Complex<f64>, Dyn, Dyn>>,
    /// Scales of the unknowns, row by row and harmonic by harmonic: equal energy, and the size of the wobble beside the mean.
    units: Amplitudes,
}

/// Residual at which the harmonics count as solved.
const SOLVED_RESIDUAL: f64 = 1e-14;
/// Largest Krylov space.
const MAX_KRYLOV_VECTORS: usize = 600;

impl<'a> Operator<'a> {
    pub fn new(coefficients: &'a Coefficients, spectrum: &'a Spectrum, last: usize) -> Self {
        let alone = (0..=last).map(|n| alone(coefficients, spectrum, n).lu()).collect();
        let units = units(coefficients, spectrum, last);
        Self { coefficients, spectrum, last, alone, units }
    }

    /// Solves for the harmonics from a start; returns them with the residual.
    pub fn solve(&self, start: &Amplitudes) -> (Amplitudes, f64) {
        let size = (self.coefficients.size(), 2 * (self.last + 1));
        let right = self.divided(self.solved(self.loads())).as_slice().to_vec();
        let mut from = Amplitudes::zeros(size.0, size.1);
        let columns = start.ncols().min(size.1);
        from.columns_mut(0, columns).copy_from(&start.columns(0, columns));
        let times = |x: &[f64]| {
            let x = Amplitudes::from_column_slice(size.0, size.1, x);
            let coupled = self.solved(self.coupled(&x.component_mul(&self.units)));
            (x + self.divided(coupled)).as_slice().to_vec()
        };
        let start = self.divided(from).as_slice().to_vec();
        let solved = gmres(times, &right, start, SOLVED_RESIDUAL, MAX_KRYLOV_VECTORS.min(right.len()));
        let x = Amplitudes::from_column_slice(size.0, size.1, &solved.x);
        (x.component_mul(&self.units), solved.residual)
    }

    /// Velocities of the rows, with the mean for cyclic ones. (H4)
    pub fn velocities(coefficients: &Coefficients, spectrum: &Spectrum, x: &Amplitudes) -> Amplitudes {
        let mut v = derivative(x, spectrum.frequency);
        for row in coefficients.elastic..coefficients.size() {
            v[(row, 0)] = x[(row, 0)];
        }
        v
    }

    /// Loads `½Ω·J_jΩ − h_j·Ω̇`, the loads of (G5).
    fn loads(&self) -> Amplitudes {
        let mut loads = Amplitudes::zeros(self.coefficients.size(), 2 * (self.last + 1));
        for (n, products) in self.spectrum.products.iter().enumerate().take(self.last + 1) {
            for (row, entry) in self.coefficients.rows.iter().enumerate() {
                let load: Complex<f64> = products.iter().zip(entry.load).map(|(m, F)| m * F).sum();
                loads[(row, 2 * n)] = load.re;
                loads[(row, 2 * n + 1)] = load.im;
            }
        }
        loads
    }

    /// Couplings: forces of the harmonics of the angular velocity, without its mean, on each harmonic. (H4)
    fn coupled(&self, x: &Amplitudes) -> Amplitudes {
        let Coefficients { momentum, coriolis, centrifugal, .. } = self.coefficients;
        let v = Self::velocities(self.coefficients, self.spectrum, x);
        let zero = Amplitudes::zeros(x.nrows(), x.ncols());
        let (mut momenta, mut forces) = (zero.clone(), zero);
        for axis in 0..3 {
            let spin = self.spectrum.component(axis);
            add_product(&mut momenta, &spin, &(&momentum[axis] * x));
            add_product(&mut forces, &spin, &(&coriolis[axis] * &v));
        }
        for (index, matrix) in centrifugal.iter().enumerate() {
            add_product(&mut forces, &self.spectrum.product(index), &(matrix * x));
        }
        derivative(&momenta, self.spectrum.frequency) - forces
    }

    /// Preconditioner: solves each harmonic alone.
    fn solved(&self, mut right: Amplitudes) -> Amplitudes {
        for (n, factor) in self.alone.iter().enumerate() {
            let part = |row: usize| Complex::new(right[(row, 2 * n)], right[(row, 2 * n + 1)]);
            let b = DVector::from_fn(right.nrows(), |row, _| part(row));
            let x = factor.solve(&b).unwrap_or_else(|| DVector::from_element(b.len(), f64::NAN.into()));
            for row in 0..right.nrows() {
                right[(row, 2 * n)] = x[row].re;
                right[(row, 2 * n + 1)] = if n == 0 { 0.0 } else { x[row].im };
            }
        }
        right
    }

    fn divided(&self, x: Amplitudes) -> Amplitudes {
        x.component_div(&self.units)
    }
}

/// Matrix of one harmonic in the mean angular velocity: `C̃ − ν²A' + iν(B + Yᵀ − Y − W) − N'`; for the harmonic 0 the columns of cyclic
/// rows are those of their rates. (H4)
fn alone(coefficients: &Coefficients, spectrum: &Spectrum, n: usize) -> DMatrix<Complex<f64>> {
    let nu = n as f64 * spectrum.frequency;
    let mean_spin = spectrum.mean_spin();
    let mean_products = spectrum.products[0].map(|product| product.re);
    let coriolis = coefficients.mean(&coefficients.coriolis, mean_spin);
    let momentum = coefficients.mean(&coefficients.momentum, mean_spin);
    let centrifugal = coefficients.mean(&coefficients.centrifugal, mean_products);
    let rate = Complex::new(0.0, nu);
    let mut stiffness = centrifugal.map(|entry| Complex::from(-entry));
    stiffness += momentum.map(|entry| rate * entry);
    for (i, row) in coefficients.rows.iter().enumerate() {
        stiffness[(i, i)] += row.square;
    }
    // Force per rate, that of the mass included; the harmonic 0 has none from the mass.
    let mut drag = coefficients.impedance(nu, mean_spin) - coriolis.map(Complex::from);
    drag += coefficients.mass.map(|mass| rate * mass);
    for loss in &coefficients.losses {
        match loss.law {
            Law::Dashpots => drag += loss.matrix.map(Complex::from),
            Law::Material(_) => {
                let factor = Coefficients::factor(&loss.law, nu);
                stiffness += loss.matrix.map(|entry| factor * entry);
            }
        }
    }
    if n > 0 {
        return stiffness + drag * rate;
    }
    for column in coefficients.elastic..coefficients.size() {
        stiffness.set_column(column, &drag.column(column));
    }
    stiffness
}

fn units(coefficients: &Coefficients, spectrum: &Spectrum, last: usize) -> Amplitudes {
    let mean = spectrum.mean_spin();
    let spin = vec3::norm(mean).max(spectrum.frequency).max(f64::MIN_POSITIVE);
    let mut units = Amplitudes::zeros(coefficients.size(), 2 * (last + 1));
    for (row, entry) in coefficients.rows.iter().enumerate() {
        let weight = match coefficients
            .memories
            .iter()
            .find(|(start, memory)| (*start..start + memory.axes.len()).contains(&row))
        {
            Some((_, memory)) => spin * memory.inertia.sqrt(),
            None if entry.square > 0.0 => entry.square.sqrt(),
            None => spin,
        };
        for n in 0..=last {
            let rate = if n == 0 && row >= coefficients.elastic { spin } else { 1.0 };
            let unit = rate * spectrum.wobble.powi(n.min(2) as i32) / weight;
            units[(row, 2 * n)] = unit;
            units[(row, 2 * n + 1)] = unit;
        }
    }
    units
}
