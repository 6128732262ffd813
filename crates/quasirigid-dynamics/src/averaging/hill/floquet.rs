//! Floquet multipliers of the internal coordinates over a period of the polhode: parametric resonance.
//! Magnus steps, because stiff friction then costs no steps; vibrations too fast for any harmonic of the angular velocity are left out, or
//! they alone would set the step.
//! Equations (H7) and (H8), docs/theory/14-spinning-frame.md.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};

use super::coefficients::Coefficients;
use super::spectrum::Spectrum;
use crate::averaging::poinsot::FreeRotation;
use crate::averaging::response::Law;
use crate::math::eigen::{Dense, NoConvergence, eigenvectors};
use crate::math::vec3::norm;

/// Stability of the periodic response along a polhode: the multipliers of the free motions of the internal coordinates over a
/// period. (H7)
#[derive(Clone, Debug, PartialEq)]
pub struct Floquet {
    /// Multipliers, real and imaginary parts, the largest first.
    pub multipliers: Vec<[f64; 2]>,
    /// Fastest growing motion, where a multiplier lies outside of the unit circle.
    pub resonance: Option<ParametricResonance>,
    /// Change of the largest multiplier when the steps were last halved.
    pub error: f64,
    /// Number of vibrations left out, too fast for any harmonic of the angular velocity.
    pub left_out: usize,
}

/// Parametric resonance: internal vibration that the period of the polhode makes grow from any disturbance.
#[derive(Clone, Debug, PartialEq)]
pub struct ParametricResonance {
    /// Growth rate (1/s).
    pub rate: f64,
    /// Frequency in the body frame (rad/s): of those that differ by multiples of the polhode's the one next to that of the
    /// vibration with the largest share, softened by the mean centrifugal force.
    pub frequency: f64,
    /// Coordinate with the largest share in that vibration.
    pub coordinate: String,
}

/// Relative amplitude below which a harmonic of the angular velocity couples no vibrations.
const WEAK: f64 = 1e-8;
/// Steps per period to begin with, per significant harmonic, and at most.
const STEPS_PER_HARMONIC: usize = 8;
const MAX_STEPS: usize = 8192;
/// Change of the multipliers at which the steps are short enough, and significant distance from the unit circle.
const SETTLED_MULTIPLIERS: f64 = 1e-9;
const OUTSIDE: f64 = 1e-8;

/// First-order system of the free motions of some rows.
struct FirstOrder<'a> {
    coefficients: &'a Coefficients,
    motion: &'a FreeRotation,
    /// Rows kept: vibrations, then cyclic rows.
    kept: Vec<usize>,
    elastic: usize,
    inverse_mass: DMatrix<f64>,
    drag: DMatrix<f64>,
    stiffness: DMatrix<f64>,
    coriolis: [DMatrix<f64>; 3],
    momentum: [DMatrix<f64>; 3],
    centrifugal: [DMatrix<f64>; 6],
}

/// Floquet multipliers along a polhode.
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails.
pub(super) fn floquet(
    coefficients: &Coefficients,
    spectrum: &Spectrum,
    motion: &FreeRotation,
) -> Result<Floquet, NoConvergence> {
    let mean = norm(spectrum.mean_spin());
    let frequency = if spectrum.frequency > 0.0 { spectrum.frequency } else { mean };
    let period = TAU / frequency;
    let strong = |amplitudes: &[Complex<f64>; 3]| amplitudes.iter().any(|c| c.norm() > WEAK * mean);
    let reach = 2 * (1 + spectrum.spin.iter().rposition(strong).unwrap_or(0));
    let fastest = reach as f64 * frequency.max(mean);
    let system = FirstOrder::new(coefficients, motion, fastest);
    let mut steps = STEPS_PER_HARMONIC * reach;
    let mut coarse = system.monodromy(period, steps);
    loop {
        steps *= 2;
        let fine = system.monodromy(period, steps);
        let better = (&fine * 16.0 - &coarse) / 15.0;
        let [before, now] = [&fine, &better].map(multipliers);
        let (before, now) = (before?, now?);
        let error = (size(before.0.first()) - size(now.0.first())).abs();
        if error <= SETTLED_MULTIPLIERS * size(now.0.first()).max(1.0)
            || steps >= MAX_STEPS
            || !error.is_finite()
        {
            let resonance = system.resonance(&now, frequency);
            let left_out = coefficients.size() - system.kept.len();
            return Ok(Floquet { multipliers: now.0, resonance, error, left_out });
        }
        coarse = fine;
    }
}

fn size(value: Option<&[f64; 2]>) -> f64 {
    value.map_or(0.0, |[re, im]| re.hypot(*im))
}

/// Eigenvalues of a matrix, the largest first, and the eigenvector of the first.
type Multipliers = (Vec<[f64; 2]>, Vec<[f64; 2]>);

fn multipliers(matrix: &DMatrix<f64>) -> Result<Multipliers, NoConvergence> {
    let mut dense = Dense::zero(matrix.nrows());
    for row in 0..matrix.nrows() {
        (0..matrix.ncols()).for_each(|column| dense.add(row, column, matrix[(row, column)]));
    }
    let (values, vectors) = eigenvectors(&dense)?;
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| size(values.get(*b)).total_cmp(&size(values.get(*a))));
    let first = order.first().map_or_else(Vec::new, |i| vectors[*i].clone());
    Ok((order.iter().map(|i| values[*i]).collect(), first))
}

/// Damping and stiffness of some rows, materials evaluated at the frequency of each vibration. (H7)
fn viscoelastic(coefficients: &Coefficients, kept: &[usize]) -> (DMatrix<f64>, DMatrix<f64>) {
    let rows: Vec<_> = kept.iter().map(|i| &coefficients.rows[*i]).collect();
    let mut drag = DMatrix::zeros(rows.len(), rows.len());
    let mut stiffness =
        DMatrix::from_fn(rows.len(), rows.len(), |i, j| if i == j { rows[i].square } else { 0.0 });
    for loss in &coefficients.losses {
        let matrix = loss.matrix.select_rows(kept).select_columns(kept);
        if matches!(loss.law, Law::Dashpots) {
            drag += matrix;
            continue;
        }
        let factor = |i: usize| {
            let frequency = rows[i].square.sqrt();
            let factor = Coefficients::factor(&loss.law, frequency);
            if frequency > 0.0 { [factor.re, factor.im / frequency] } else { [0.0; 2] }
        };
        let factors: Vec<[f64; 2]> = (0..rows.len()).map(factor).collect();
        stiffness += matrix.map_with_location(|i, j, entry| entry * 0.5 * (factors[i][0] + factors[j][0]));
        drag += matrix.map_with_location(|i, j, entry| entry * (factors[i][1] * factors[j][1]).sqrt());
    }
    (drag, stiffness)
}

impl<'a> FirstOrder<'a> {
    fn new(coefficients: &'a Coefficients, motion: &'a FreeRotation, fastest: f64) -> Self {
        let slow = |i: &usize| coefficients.rows[*i].square <= fastest * fastest;
        let kept: Vec<usize> = (0..coefficients.size()).filter(slow).collect();
        let elastic = kept.iter().filter(|i| **i < coefficients.elastic).count();
        let part = |matrix: &DMatrix<f64>| matrix.select_rows(&kept).select_columns(&kept);
        let (drag, stiffness) = viscoelastic(coefficients, &kept);
        let inverse_mass = part(&coefficients.mass)
            .try_inverse()
            .unwrap_or_else(|| DMatrix::from_element(kept.len(), kept.len(), f64::NAN));
        Self {
            inverse_mass,
            drag,
            stiffness,
            coriolis: coefficients.coriolis.each_ref().map(part),
            momentum: coefficients.momentum.each_ref().map(part),
            centrifugal: coefficients.centrifugal.each_ref().map(part),
            kept,
            elastic,
            coefficients,
            motion,
        }
    }

    /// Frequency of a kept vibration.
    fn frequency(&self, place: usize) -> f64 {
        self.coefficients.rows[self.kept[place]].square.sqrt()
    }

    /// Frequency of a vibration by itself in the mean centrifugal force; zero where that overcomes its stiffness.
    fn softened_frequency(&self, place: usize) -> f64 {
        let softened = self.motion.mean(2, |[x, y, z]| {
            let products = [x * x, y * y, z * z, y * z, z * x, x * y];
            let taken = self.centrifugal.iter().zip(products).map(|(matrix, m)| matrix[(place, place)] * m);
            self.stiffness[(place, place)] - taken.sum::<f64>()
        });
        softened.max(0.0).sqrt()
    }

    /// Matrix of the rates of displacements, in units of equal energy, and momenta: `v = A'⁻¹(p − Yᵀq)`, `q̇ = v`, `ṗ = (Y + W − B)v +
    /// (N' − C)q`. (H7)
    fn rates(&self, t: f64) -> DMatrix<f64> {
        let omega = self.motion.omega(t);
        let [x, y, z] = omega;
        let products = [x * x, y * y, z * z, y * z, z * x, x * y];
        let sum = |matrices: &[DMatrix<f64>], weights: &[f64]| {
            let zero = DMatrix::zeros(self.kept.len(), self.kept.len());
            matrices.iter().zip(weights).fold(zero, |sum, (matrix, weight)| sum + matrix * *weight)
        };
        let (n, elastic) = (self.kept.len(), self.elastic);
        let momentum = sum(&self.momentum, &omega);
        let coriolis = sum(&self.coriolis, &omega) - &self.drag;
        let softening = sum(&self.centrifugal, &products) - &self.stiffness;
        let by_displacement = -&self.inverse_mass * momentum;
        let force_by_displacement = softening + &coriolis * &by_displacement;
        let force_by_momentum = &coriolis * &self.inverse_mass;
        let mut rates = DMatrix::zeros(elastic + n, elastic + n);
        for column in 0..elastic {
            let unit = self.frequency(column);
            for row in 0..elastic {
                rates[(row, column)] = by_displacement[(row, column)] * self.frequency(row) / unit;
            }
            for row in 0..n {
                rates[(elastic + row, column)] = force_by_displacement[(row, column)] / unit;
            }
        }
        for column in 0..n {
            for row in 0..elastic {
                rates[(row, elastic + column)] = self.inverse_mass[(row, column)] * self.frequency(row);
            }
            for row in 0..n {
                rates[(elastic + row, elastic + column)] = force_by_momentum[(row, column)];
            }
        }
        rates
    }

    /// Monodromy matrix: takes a state over a period, by Magnus' series to the fourth order. (H8)
    fn monodromy(&self, period: f64, steps: usize) -> DMatrix<f64> {
        let h = period / steps as f64;
        let size = self.elastic + self.kept.len();
        let root = 3.0_f64.sqrt();
        let mut state = DMatrix::identity(size, size);
        for step in 0..steps {
            let middle = h * (step as f64 + 0.5);
            let [a, b] = [-1.0, 1.0].map(|side| self.rates(middle + side * h * root / 6.0));
            let twist = (&b * &a - &a * &b) * (root / 12.0 * h * h);
            state = ((a + b) * (0.5 * h) + twist).exp() * state;
        }
        state
    }

    /// Parametric resonance of the largest multiplier, if outside of the unit circle.
    fn resonance(&self, (values, vector): &Multipliers, polhode: f64) -> Option<ParametricResonance> {
        let first = values.first()?;
        let size = size(Some(first));
        if !(size > 1.0 + OUTSIDE) {
            return None;
        }
        let n = self.kept.len();
        let energy = |place: usize| {
            let [re, im] = vector[self.elastic + place];
            let own = if place < self.elastic { vector[place] } else { [0.0; 2] };
            re * re + im * im + own[0] * own[0] + own[1] * own[1]
        };
        let most = (0..n).max_by(|a, b| energy(*a).total_cmp(&energy(*b)))?;
        let turned = first[1].atan2(first[0]).abs() / TAU * polhode;
        let own = self.softened_frequency(most);
        let near = |base: f64| base + ((own - base) / polhode).round() * polhode;
        let frequency = [near(turned), near(-turned)]
            .into_iter()
            .min_by(|a, b| (a - own).abs().total_cmp(&(b - own).abs()))?;
        Some(ParametricResonance {
            rate: size.ln() * polhode / TAU,
            frequency: frequency.abs(),
            coordinate: self.coefficients.rows[self.kept[most]].name.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Mode;
    use crate::problems::ring_of_points;

    /// A resonance is named for the coordinate with the most energy at whatever phase its vector is told, potential or kinetic.
    #[test]
    fn the_name_of_a_resonance_is_no_matter_of_its_phase() {
        let body = ring_of_points(1).body().unwrap();
        let coefficients = Coefficients::compute(&body, usize::MAX).unwrap();
        let motion = FreeRotation::at_logit(coefficients.principal.moments, 10.0, Mode::ShortAxis, 0.5);
        let system = FirstOrder::new(&coefficients, &motion, f64::MAX);
        assert_eq!((system.elastic, system.kept.len()), (3, 3));
        // Displacements, then momenta, of vibrations whose energies are as 1 to 0.9, in halves of both kinds or in one.
        let halves = std::f64::consts::FRAC_1_SQRT_2;
        for (most, [large, small]) in [
            (0, [[1.0, 0.0], [0.0, 0.9]]),
            (0, [[0.0, 1.0], [0.9, 0.0]]),
            (1, [[halves, halves], [0.9 * halves, 0.9 * halves]]),
            (2, [[0.0, 1.0], [0.0, 0.9]]),
        ] {
            let mut amplitudes = [0.0; 6];
            let other = (most + 1) % 3;
            for (place, [displacement, momentum]) in [(most, large), (other, small)] {
                (amplitudes[place], amplitudes[3 + place]) = (displacement, momentum);
            }
            for phase in [0.0, 0.4, std::f64::consts::FRAC_PI_2, 2.9] {
                let vector = amplitudes.iter().map(|size| [size * f64::cos(phase), size * f64::sin(phase)]);
                let found = system.resonance(&(vec![[1.1, 0.3]], vector.collect()), 2.0).unwrap();
                assert_eq!(found.coordinate, coefficients.rows[system.kept[most]].name, "{most} {phase}");
                assert!((found.rate - 1.1_f64.hypot(0.3).ln() * 2.0 / TAU).abs() < 1e-12, "{found:?}");
            }
        }
        let names: std::collections::BTreeSet<_> = coefficients.rows.iter().map(|row| &row.name).collect();
        assert_eq!(names.len(), 3, "{names:?}");
    }
}
