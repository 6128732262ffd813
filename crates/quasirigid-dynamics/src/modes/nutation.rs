//! Motions of the direction of spin among those of a spectrum: the nutation, and its partner about the middle axis.

use nalgebra::Complex;

use super::candidates::{SLOW_DIRECTION_RATIO, Source};
use super::mode::{Frame, OVERDAMPED, kinetic};
use super::shares::moving;
use super::slow::SlowDirection;
use super::spectrum::Eigenmotion;
use crate::math::sphere::tangents;
use crate::math::sym3;
use crate::math::vec3::{self, norm, scale};

/// Share of the largest tilt of the angular momentum from which a mode may be the nutation.
const CLEAR: f64 = 0.1;
/// Logarithm of the ratio to the rigid-body frequency beyond which an oscillating mode gives way to other candidates for the nutation, unless
/// the angular momentum leaves the axis most in it: with nearly equal moments elasticity decides the frequency.
const FAR_FREQUENCY: f64 = 1.5;

impl Frame<'_> {
    /// Indices of the motions of the direction of spin, the nutation first: none for a body like a sphere, two where one grows and one
    /// decays without oscillation.
    pub(super) fn of_direction(
        &self,
        found: &[Eigenmotion],
        sources: &[Source],
        slow: Option<&SlowDirection>,
    ) -> Vec<usize> {
        let tilts: Vec<f64> = found.iter().map(|motion| self.tilt(motion)).collect();
        let known = sources.iter().take_while(|source| **source != Source::Spectrum).count();
        let mut indices: Vec<usize> = match slow {
            Some(slow) if slow.neutral() == 2 => Vec::new(),
            _ if known > 0 => (0..known).collect(),
            Some(slow) if slow.neutral() == 1 => {
                self.slowest(found).map_or_else(|| self.nutation(found, &tilts), |slowest| vec![slowest])
            }
            _ => self.nutation(found, &tilts),
        };
        indices.sort_by(|a, b| found[*b].lambda.re.total_cmp(&found[*a].lambda.re));
        indices
    }

    /// The slowest motion, which is that of the direction beside a neutral one, if it is slow beside the others: a rotor decays as it does. (M13)
    fn slowest(&self, found: &[Eigenmotion]) -> Option<usize> {
        let size = |i: &usize| found[*i].lambda.norm();
        let mut order: Vec<usize> = (0..found.len()).collect();
        order.sort_by(|a, b| size(a).total_cmp(&size(b)));
        let others = order.get(1).map_or(f64::INFINITY, size).min(norm(self.equilibrium.omega));
        order.first().copied().filter(|slowest| size(slowest) < SLOW_DIRECTION_RATIO * others)
    }

    /// Indices of the nutation: of the modes in which the angular momentum leaves the axis most, the one nearest in frequency to that of
    /// the rigid body, of equally near ones that of the largest tilt; an oscillating one, if near enough or of the largest tilt of all. About the middle axis, where the rigid body leaves it and returns to it without
    /// oscillation, two of opposite sign.
    fn nutation(&self, found: &[Eigenmotion], tilts: &[f64]) -> Vec<usize> {
        let product = self.rigid_product();
        let rigid = product.abs().sqrt();
        let near = |i: &usize| (found[*i].lambda.norm() / rigid).ln().abs();
        let most = |candidates: &[usize]| candidates.iter().map(|i| tilts[*i]).fold(0.0, f64::max);
        let nearest = |candidates: &[usize]| {
            let most = most(candidates);
            let clear = candidates.iter().copied().filter(|i| tilts[*i] >= CLEAR * most);
            clear.min_by(|a, b| near(a).total_cmp(&near(b)).then(tilts[*b].total_cmp(&tilts[*a])))
        };
        let all: Vec<usize> = (0..found.len()).collect();
        let of = |keep: &dyn Fn(Complex<f64>) -> bool| -> Vec<usize> {
            all.iter().copied().filter(|i| keep(found[*i].lambda)).collect()
        };
        if product < 0.0 {
            let [away, back] = [
                of(&|lambda| lambda.im == 0.0 && lambda.re > 0.0),
                of(&|lambda| lambda.im == 0.0 && lambda.re < 0.0),
            ];
            let pair = [
                nearest(&away).filter(|i| near(i) < FAR_FREQUENCY),
                nearest(&back).filter(|i| near(i) < FAR_FREQUENCY),
            ];
            if let [Some(away), Some(back)] = pair {
                return vec![away, back];
            }
        }
        let swinging = of(&|lambda| lambda.im.abs() > OVERDAMPED * lambda.re.abs());
        let foremost = |i: &usize| tilts[*i] >= most(&all);
        nearest(&swinging)
            .filter(|i| near(i) < FAR_FREQUENCY || foremost(i))
            .or_else(|| nearest(&all))
            .into_iter()
            .collect()
    }

    /// Square of the frequency (rad²/s²) of the rigid body beside its steady spin, negative where it leaves it: `K²` times the determinant of
    /// `J⁻¹ − 1/Λ` across the axis.
    fn rigid_product(&self) -> f64 {
        let K = self.equilibrium.angular_momentum;
        let [first, second] = tangents(scale(norm(K).recip(), K));
        let inverse = sym3::inverse(self.coefficients.inertia);
        let excess = |a: [f64; 3], b: [f64; 3]| {
            vec3::dot(a, sym3::times(inverse, b)) - vec3::dot(a, b) / self.equilibrium.ratio
        };
        let determinant = excess(first, first) * excess(second, second) - excess(first, second).powi(2);
        vec3::dot(K, K) * determinant
    }

    /// Square of the tilt of the angular momentum from the axis, per kinetic energy of the mode.
    fn tilt(&self, motion: &Eigenmotion) -> f64 {
        let Eigenmotion { delta, rate, q, .. } = motion;
        let spin = norm(self.equilibrium.omega);
        let axis = scale(spin.recip(), self.equilibrium.omega);
        let K = self.angular_momentum(*delta, rate, q);
        let along = K[0] * axis[0] + K[1] * axis[1] + K[2] * axis[2];
        let across: f64 = (0..3).map(|i| (K[i] - along * axis[i]).norm_sqr()).sum();
        let energy = kinetic(&moving(self.body, self.coefficients, *delta, rate, &[]));
        if energy > 0.0 { across / (self.equilibrium.ratio.abs() * energy) } else { 0.0 }
    }
}
