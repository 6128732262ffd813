//! Coordinates that a small motion of the body drives, told from those that only rounding moves.
//! A rotor along the axis across which a spin wobbles is not turned by it; in axes that are turned the sum of the loads on it is the rounding of
//! its terms, and what it dissipates is that of nothing.
//! Equation (M25), docs/theory/15-modes.md.

use nalgebra::Complex;

use super::spectrum::Eigenmotion;
use crate::math::connected_components::connected_components;
use crate::math::eigen::Dense;
use crate::math::vec3::{dot, norm};
use crate::model::{Coordinate, FlexibleBody, SpinCoefficients};

/// Load over its terms, and coupling over the inertia, damping and stiffness of both coordinates, below which it is rounding.
const ROUNDING: f64 = 1e-12;
/// Rounding of the axis of a steady spin, times the relative difference of its moment from the next.
const AXES: f64 = 1e-14;
/// Coordinates up to which groups are told apart.
const MOST_COORDINATES: usize = 150;

/// Uncertain turn of the axis of a steady spin towards an axis beside it, by the rounding of the moments. (M25)
#[derive(Clone, Copy, Debug)]
pub(super) struct Tilt {
    /// Unit vectors along the axis of the spin and the one beside it.
    pub plane: [[f64; 3]; 2],
    /// Relative difference of their moments.
    pub apart: f64,
}

impl Tilt {
    /// Length of the part of a vector that the turn changes, times its angle (rad).
    fn of(&self, vector: [f64; 3]) -> f64 {
        let [a, b] = self.plane.map(|axis| dot(axis, vector));
        AXES / self.apart * a.hypot(b)
    }
}

/// Groups of coordinates that move together, those of a part always, so that axes do not matter; with the loads of a motion of the body on them.
/// (M25)
pub(super) struct Driven<'a> {
    coefficients: &'a SpinCoefficients,
    groups: Vec<Vec<usize>>,
    tilts: &'a [Tilt],
}

impl<'a> Driven<'a> {
    /// Groups of the coordinates of a body, with the turns of the axis of the spin; of a large body, or one with liquids of an impedance, none.
    pub fn of(body: &FlexibleBody, coefficients: &'a SpinCoefficients, tilts: &'a [Tilt]) -> Self {
        let n = coefficients.h.len();
        if n > MOST_COORDINATES || !body.memories().is_empty() {
            return Self { coefficients, groups: Vec::new(), tilts };
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
        let parts: Vec<&str> = body.coordinates().iter().map(Coordinate::part).collect();
        let own = |j: usize| [mass.at(j, j), damping.at(j, j), springs.at(j, j)].map(f64::abs);
        let coupled = |j: usize, k: usize| {
            let between = [mass.at(j, k), dashpots.at(j, k), springs.at(j, k)];
            let rates = [own(j), own(k)];
            let size = |kind: usize| (rates[0][kind] * rates[1][kind]).sqrt();
            let gyroscopic = (size(0) * size(2)).sqrt();
            let sizes = [size(0), size(1).max(gyroscopic), size(2)];
            let of_a_part = parts[j] == parts[k];
            of_a_part
                || between
                    .iter()
                    .zip(sizes)
                    .any(|(between, size)| between.abs() > ROUNDING * size && between.abs() > 0.0)
        };
        let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| [j, k]));
        let pairs: Vec<[usize; 2]> = pairs.filter(|[j, k]| coupled(*j, *k)).collect();
        Self { coefficients, groups: connected_components(n, pairs), tilts }
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
        let turning = delta.iter().map(Complex::norm_sqr).sum::<f64>().sqrt();
        let along = move |part: [f64; 3]| (0..3).map(|axis| delta[axis] * part[axis]).sum::<Complex<f64>>();
        let rounding =
            |part: [f64; 3]| ROUNDING * norm(part) + self.tilts.iter().map(|tilt| tilt.of(part)).sum::<f64>();
        let load = move |j: usize| {
            let (h, slope) = (self.coefficients.h[j], self.coefficients.slopes[j]);
            let unit = self.coefficients.mass.at(j, j).sqrt();
            let size = (rounding(slope) + lambda.norm() * rounding(h)) * turning;
            [(along(slope) - lambda * along(h)).norm() / unit, size / unit]
        };
        let loaded = move |group: &Vec<usize>| {
            let loads = group.iter().map(|j| load(*j));
            let [load, size] = loads.fold([0.0; 2], |a, b| [f64::max(a[0], b[0]), f64::max(a[1], b[1])]);
            load > size
        };
        self.groups.iter().filter(move |group| !loaded(group)).flatten().copied()
    }
}
