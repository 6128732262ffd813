//! Periodic response of the internal coordinates along a polhode: harmonics, mean power, state and share of the angular momentum.
//! The number of harmonics doubles until the power settles; next to the separatrix 512 may not do, and [`PeriodicResponse::truncation`]
//! then is the error.
//! Equations (H4) to (H6), docs/theory/14-spinning-frame.md.

use nalgebra::Complex;

use super::coefficients::Coefficients;
use super::operator::Operator;
use super::series::{Amplitudes, add_product, at, harmonics, value};
use super::spectrum::Spectrum;
use crate::averaging::response::Law;
use crate::math::sym3;
use crate::math::vec3;

/// Periodic motion of the internal coordinates along a polhode: the solution of Hill's equations that all others settle to where
/// they are stable. (H4)
#[derive(Clone, Debug)]
pub struct PeriodicResponse<'a> {
    coefficients: &'a Coefficients,
    spectrum: Spectrum,
    /// Amplitudes of displacements (mean rates of cyclic rows in place of their means) and of rates.
    x: Amplitudes,
    v: Amplitudes,
    residual: f64,
    truncation: f64,
}

/// Relative change of the power below which more harmonics are not needed.
const SETTLED_POWER: f64 = 1e-10;
/// Harmonics to begin with, and at most.
const MIN_HARMONICS: usize = 4;
const MAX_HARMONICS: usize = 512;
/// Share of the largest harmonic of the angular momentum below which a harmonic is too weak to be a measure.
const MEASURE: f64 = 0.1;

impl<'a> PeriodicResponse<'a> {
    /// The response along a polhode, harmonics doubled until the power settles.
    pub(super) fn along(coefficients: &'a Coefficients, spectrum: Spectrum) -> Self {
        let mut last =
            if spectrum.count == 0 { 0 } else { (spectrum.count / 2).clamp(MIN_HARMONICS, MAX_HARMONICS) };
        let mut found = Self::with(coefficients, spectrum, last, &Amplitudes::zeros(coefficients.size(), 2));
        while last > 0 && last < MAX_HARMONICS {
            let enough = last >= found.spectrum.count;
            if enough && found.truncation <= SETTLED_POWER {
                break;
            }
            last = (2 * last).min(MAX_HARMONICS);
            let next = Self::with(coefficients, found.spectrum, last, &found.x);
            let (power, before) = (next.power(), harmonic_power(coefficients, &found.v, &next.spectrum));
            found = Self { truncation: ((power - before) / power).abs(), ..next };
            if power == 0.0 {
                found.truncation = 0.0;
            }
        }
        found
    }

    fn with(coefficients: &'a Coefficients, spectrum: Spectrum, last: usize, start: &Amplitudes) -> Self {
        let (x, residual) = Operator::new(coefficients, &spectrum, last).solve(start);
        let v = Operator::velocities(coefficients, &spectrum, &x);
        let truncation = if last == 0 { 0.0 } else { f64::INFINITY };
        Self { coefficients, spectrum, x, v, residual, truncation }
    }

    /// Mean power dissipated (W). (H5)
    #[must_use]
    pub fn power(&self) -> f64 {
        harmonic_power(self.coefficients, &self.v, &self.spectrum)
    }

    /// Mean power of each harmonic (W) with its frequency (rad/s), from the mean on: rotors that rotate steadily in the mean have a share
    /// at the frequency zero. (H5)
    pub fn harmonic_powers(&self) -> impl Iterator<Item = (f64, f64)> {
        (0..=harmonics(&self.v)).map(|n| {
            (n as f64 * self.spectrum.frequency, power_at(self.coefficients, &self.v, &self.spectrum, n))
        })
    }

    /// Number of harmonics solved for.
    #[must_use]
    pub fn harmonics(&self) -> usize {
        harmonics(&self.x)
    }

    /// Relative residual of the linear system of the harmonics: not small where Hill's determinant vanishes, at the edge of a parametric
    /// resonance.
    #[must_use]
    pub fn residual(&self) -> f64 {
        self.residual
    }

    /// Relative change of the power when the number of harmonics was last doubled: not below 1e-10 only where their number
    /// reached its limit, next to the separatrix or at spins far above an elastic frequency.
    #[must_use]
    pub fn truncation(&self) -> f64 {
        self.truncation
    }

    /// Internal coordinates and rates of the body at a time (s) of the motion; cyclic coordinates have their periodic part. (H4)
    #[must_use]
    pub fn state(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let phase = self.spectrum.frequency * (t + self.spectrum.origin);
        let rows = &self.coefficients.rows;
        let size = rows.first().map_or(0, |row| row.shape.len());
        let (mut q, mut rate) = (vec![0.0; size], vec![0.0; size]);
        for (i, row) in rows.iter().enumerate() {
            let mean = if i < self.coefficients.elastic { 0.0 } else { self.x[(i, 0)] };
            let (x, v) = (value(&self.x, i, phase) - mean, value(&self.v, i, phase));
            for (j, shape) in row.shape.iter().enumerate() {
                q[j] += shape * x;
                rate[j] += shape * v;
            }
        }
        (q, rate)
    }

    /// Share of the internal motion in the periodic part of the angular momentum: the largest `|δK_n|/|K_n|`, harmonic by
    /// harmonic. (H6)
    ///
    /// The error of the average along the rigid polhode is of this order. Where `|K_n|` is below a tenth of the largest one, a tenth of
    /// the largest is the measure.
    #[must_use]
    pub fn share(&self) -> f64 {
        let rigid = |n: usize| {
            let moments = self.coefficients.principal.moments;
            let amplitudes = self.spectrum.spin.get(n).copied().unwrap_or_default();
            amplitudes.iter().zip(moments).map(|(c, I)| (I * c.norm()).powi(2)).sum::<f64>().sqrt()
        };
        let largest = (1..self.spectrum.spin.len()).map(rigid).fold(0.0, f64::max);
        if largest == 0.0 {
            return 0.0;
        }
        let inside = self.internal_momentum();
        let share = |n: usize| {
            let size = (0..3).map(|axis| at(&inside, axis, n).norm_sqr()).sum::<f64>().sqrt();
            size / rigid(n).max(MEASURE * largest)
        };
        (1..=self.harmonics()).map(share).fold(0.0, f64::max)
    }

    /// `δK = h q̇ + q_j J_j Ω` in principal axes. (H6)
    fn internal_momentum(&self) -> Amplitudes {
        let Coefficients { rows, principal, inertia, elastic, .. } = self.coefficients;
        let columns = self.x.ncols();
        let mut sum = Amplitudes::zeros(3, columns);
        let shares = |column: &dyn Fn(usize) -> [f64; 3]| {
            Amplitudes::from_fn(3, rows.len(), |axis, row| vec3::dot(principal.axes[axis], column(row)))
        };
        sum += shares(&|row| rows[row].h) * &self.v;
        let mut displaced = self.x.clone();
        for row in *elastic..rows.len() {
            displaced.row_mut(row).fill(0.0);
        }
        for axis in 0..3 {
            let J = shares(&|row| sym3::times(inertia[row], principal.axes[axis]));
            let moved = J * &displaced;
            add_product(&mut sum, &self.spectrum.component(axis), &moved);
            sum += moved * self.spectrum.mean_spin()[axis];
        }
        sum
    }
}

fn harmonic_power(coefficients: &Coefficients, v: &Amplitudes, spectrum: &Spectrum) -> f64 {
    (0..=harmonics(v)).map(|n| power_at(coefficients, v, spectrum, n)).sum()
}

/// `2 v̄ᵀ[B + Im μ̃/ν S + Re D]v` of a harmonic, without the factor 2 for the mean. (H5)
fn power_at(coefficients: &Coefficients, v: &Amplitudes, spectrum: &Spectrum, n: usize) -> f64 {
    let nu = n as f64 * spectrum.frequency;
    let parts = [v.column(2 * n), v.column(2 * n + 1)];
    let quadratic = |matrix: &Amplitudes| parts.iter().map(|part| part.dot(&(matrix * part))).sum::<f64>();
    let mut power = 0.0;
    for loss in &coefficients.losses {
        power += match loss.law {
            Law::Dashpots => quadratic(&loss.matrix),
            Law::Material(_) if n == 0 => 0.0,
            Law::Material(_) => Coefficients::factor(&loss.law, nu).im / nu * quadratic(&loss.matrix),
        };
    }
    if !coefficients.memories.is_empty() {
        let force = coefficients.impedance(nu, spectrum.mean_spin());
        let rate = parts[0].zip_map(&parts[1], Complex::new);
        power += rate.dotc(&(force * &rate)).re;
    }
    if n == 0 { power } else { 2.0 * power }
}
