use nalgebra::Matrix3;

use super::Matrix12;
use super::element::Beam;
use super::interpolation::Fields;
use crate::math::quadrature::gauss_legendre;

/// Points of the Gauss rule: exact to degree 7, the integrands are of degree 6.
const POINTS: usize = 4;

/// Point of the Gauss rule along the beam.
pub(super) struct Slice {
    /// Place, from −½ to ½ of the length.
    pub t: f64,
    /// Weight (m).
    pub length: f64,
    pub fields: Fields,
}

impl Beam {
    /// Consistent mass matrix `M` (kg, kg·m, kg·m²), with the rotary inertia of the sections, in the axes of the
    /// body:
    ///
    /// ```text
    /// M = ∫ ρ [A UᵀU + Θᵀ (tr W − W) Θ] dx,     W = ∫ p pᵀ dA
    /// ```
    ///
    /// for the displacement `U` and the rotation `Θ` of a section by the coordinates. Rotary inertia about the beam
    /// is that of the area, `∫ (y² + z²) dA`, whatever the torsion constant.
    pub fn mass(&self) -> Matrix12 {
        let spread = self.spread();
        let rotary = spread.trace() * Matrix3::identity() - spread;
        self.integral(|Fields { place, turn, .. }, _| {
            self.density * (self.section.area * place.transpose() * place + turn.transpose() * rotary * turn)
        })
    }

    /// `∫ f dx` of a function of the fields and of their place `t`, over the length.
    pub(super) fn integral<T: std::iter::Sum<T> + std::ops::Mul<f64, Output = T>>(
        &self,
        f: impl Fn(&Fields, f64) -> T,
    ) -> T {
        self.slices().iter().map(|slice| f(&slice.fields, slice.t) * slice.length).sum()
    }

    /// Points of the Gauss rule along the beam.
    pub(super) fn slices(&self) -> Vec<Slice> {
        let slice = |[x, weight]: [f64; 2]| Slice {
            t: 0.5 * x,
            length: 0.5 * weight * self.length,
            fields: self.fields(0.5 * x),
        };
        gauss_legendre(POINTS).into_iter().map(slice).collect()
    }
}
