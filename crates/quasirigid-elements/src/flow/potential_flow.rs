//! Integrals of the potential flow of an ideal liquid in a rotating cavity.

use nalgebra::{Matrix3, Vector3};

/// Slip of an ideal liquid of unit density past a body that rotates about each axis. (L12)
///
/// The flow has a potential, `∂φ_l/∂n = n·(e_l × r)` on the wall. Relative to the body it is `w_l = ∇φ_l − e_l × r`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PotentialFlowMoments {
    /// `∫ w_k·w_l dV` (m⁵): the inertia of the frozen liquid less that of the equivalent body.
    pub volume: Matrix3<f64>,
    /// `∮ w_k·w_l dS` (m⁴).
    pub surface: Matrix3<f64>,
    /// `∫ w_k × w_l dV` along each axis (m⁵).
    pub turning: [Matrix3<f64>; 3],
}

impl PotentialFlowMoments {
    /// Adds a place with its share of the volume (m³).
    pub fn add_volume(&mut self, share: f64, w: &[Vector3<f64>; 3]) {
        for k in 0..3 {
            for l in 0..3 {
                self.volume[(k, l)] += share * w[k].dot(&w[l]);
                let across = w[k].cross(&w[l]);
                (0..3).for_each(|axis| self.turning[axis][(k, l)] += share * across[axis]);
            }
        }
    }

    /// Adds a place of the wall with its share of the area (m²).
    pub fn add_surface(&mut self, share: f64, w: &[Vector3<f64>; 3]) {
        for k in 0..3 {
            (0..3).for_each(|l| self.surface[(k, l)] += share * w[k].dot(&w[l]));
        }
    }

    /// Inertia tensor of the equivalent body, given that of the frozen liquid, both of unit density (m⁵). (L12)
    pub fn equivalent(&self, frozen: Matrix3<f64>) -> Matrix3<f64> {
        frozen - self.volume
    }

    /// Slip of a cavity about z, rotated in the cycle of the axes until the cavity is about another one.
    pub fn about(&self, axis: usize) -> Self {
        let own = |other: usize| (other + 2 - axis) % 3;
        let turned = |matrix: &Matrix3<f64>| Matrix3::from_fn(|k, l| matrix[(own(k), own(l))]);
        Self {
            volume: turned(&self.volume),
            surface: turned(&self.surface),
            turning: [0, 1, 2].map(|axis| turned(&self.turning[own(axis)])),
        }
    }
}
