//! Coordinates that a small motion of the body drives, told from those that only rounding moves.
//! A rotor along the axis across which a spin wobbles is not turned by it; in axes that are turned the sum of the loads on it is the rounding of
//! its terms, and what it dissipates is that of nothing.
//! Equation (M25), docs/theory/15-modes.md.

use nalgebra::Complex;

use super::spectrum::Eigenmotion;
use crate::math::connected_components::connected_components;
use crate::math::eigen::Dense;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, Mode, Principal, SpinCoefficients};

/// Load over its terms, and coupling over the inertia, damping and stiffness of both coordinates, below which it is rounding.
const ROUNDING: f64 = 1e-12;
/// Rounding of the axes of a body, times the relative difference of two moments.
const AXES: f64 = 1e-14;
/// Coordinates up to which groups are told apart.
const MOST_COORDINATES: usize = 150;

/// Groups of coordinates that move together, with the loads of a motion of the body on them. (M25)
pub(super) struct Driven<'a> {
    coefficients: &'a SpinCoefficients,
    groups: Vec<Vec<usize>>,
    /// Load over its size that is rounding, with that of the axes of the body.
    rounding: f64,
}

impl<'a> Driven<'a> {
    /// Groups of the coordinates of a body; of a large body, or one with liquids of an impedance, none.
    pub fn of(body: &FlexibleBody, coefficients: &'a SpinCoefficients) -> Self {
        let n = coefficients.h.len();
        let rounding = ROUNDING + AXES / apart(coefficients);
        if n > MOST_COORDINATES || !body.memories().is_empty() {
            return Self { coefficients, groups: Vec::new(), rounding };
        }
        let SpinCoefficients { mass, gyroscopic, centrifugal, .. } = coefficients;
        let damping = Dense::of(body.damping());
        let mut dashpots = damping.clone();
        let mut springs = Dense::of(body.stiffness());
        for viscoelastic in body.viscoelastic() {
            viscoelastic.stiffness.iter().for_each(|(j, k, entry)| springs.add(j, k, entry.abs()));
        }
        for j in 0..n {
            for k in 0..n {
                springs.add(j, k, -centrifugal.at(j, k));
                dashpots.add(j, k, gyroscopic.at(j, k));
            }
        }
        let own = |j: usize| [mass.at(j, j), damping.at(j, j), springs.at(j, j)].map(f64::abs);
        let coupled = |j: usize, k: usize| {
            let between = [mass.at(j, k), dashpots.at(j, k), springs.at(j, k)];
            let rates = [own(j), own(k)];
            let size = |kind: usize| (rates[0][kind] * rates[1][kind]).sqrt();
            let gyroscopic = (size(0) * size(2)).sqrt();
            let sizes = [size(0), size(1).max(gyroscopic), size(2)];
            between
                .iter()
                .zip(sizes)
                .any(|(between, size)| between.abs() > ROUNDING * size && between.abs() > 0.0)
        };
        let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| [j, k]));
        let pairs: Vec<[usize; 2]> = pairs.filter(|[j, k]| coupled(*j, *k)).collect();
        Self { coefficients, groups: connected_components(n, pairs), rounding }
    }

    /// Puts the coordinates at rest that a slow motion of the direction of spin moves by rounding alone. (M25)
    pub fn clear(&self, motion: &mut Eigenmotion) {
        for j in self.still(motion.lambda, motion.delta).collect::<Vec<_>>() {
            motion.q[j] = Complex::from(0.0);
            motion.rate[j] = Complex::from(0.0);
        }
    }

    /// Coordinates of the groups on which a motion `e^{λt}` with a change of the angular velocity (rad/s) has no load beyond rounding. (M25)
    pub fn still(&self, lambda: Complex<f64>, delta: [Complex<f64>; 3]) -> impl Iterator<Item = usize> {
        let loaded = move |j: &usize| {
            let (h, slope) = (self.coefficients.h[*j], self.coefficients.slopes[*j]);
            let along = |part: [f64; 3]| (0..3).map(|axis| delta[axis] * part[axis]).sum::<Complex<f64>>();
            let turning = delta.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
            let size = (norm(slope) + lambda.norm() * norm(h)) * turning;
            (along(slope) - lambda * along(h)).norm() > self.rounding * size
        };
        self.groups.iter().filter(move |group| !group.iter().any(loaded)).flatten().copied()
    }
}

/// Least difference of two moments of inertia that are not equal, over the greatest.
fn apart(coefficients: &SpinCoefficients) -> f64 {
    let moments = Principal::compute(coefficients.inertia).moments;
    let modes = [Mode::LongAxis, Mode::ShortAxis].into_iter().filter(|mode| mode.exists(moments));
    let gap = |mode: Mode| (moments[1] - moments[mode.circled()]).abs() / moments[2];
    modes.map(gap).fold(1.0, f64::min)
}
