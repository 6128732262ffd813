use nalgebra::{DMatrix, DVector, Matrix2, Matrix2xX, Matrix3xX};

use super::section::ShellSection;

/// Strains at a point of an element per unit of its displacements, in its axes, and the area the point stands for.
///
/// A stiffness is the sum `Σ area (εᵀAε + εᵀBκ + κᵀBε + κᵀDκ + γᵀSγ)`.
pub(super) struct Sample {
    /// Area (m²).
    pub area: f64,
    /// Gradients of the shape functions (1/m), a column per node.
    pub slopes: Matrix2xX<f64>,
    /// Membrane strain `ε` (11, 22, 2·12).
    pub membrane: Matrix3xX<f64>,
    /// Curvature `κ` (1/m), the gradient of the strain in height.
    pub bending: Matrix3xX<f64>,
    /// Transverse shear `γ` (13, 23).
    pub shear: Matrix2xX<f64>,
}

impl Sample {
    pub fn stiffness(&self, section: &ShellSection) -> DMatrix<f64> {
        let force = section.A * &self.membrane + section.B * &self.bending;
        let moment = section.B * &self.membrane + section.D * &self.bending;
        let shear = section.S * &self.shear;
        self.area * (self.membrane.tr_mul(&force) + self.bending.tr_mul(&moment) + self.shear.tr_mul(&shear))
    }

    /// Membrane force (N/m) of a displacement.
    pub fn tension(&self, section: &ShellSection, u: &DVector<f64>) -> Matrix2<f64> {
        let force = section.A * (&self.membrane * u) + section.B * (&self.bending * u);
        Matrix2::new(force[0], force[2], force[2], force[1])
    }
}
