use crate::math::vec3::dot;
use crate::model::force::MagneticField;

/// Eddy currents of a body in the mean of a magnetic field. (A14), (F17), (F19)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EddyTorque {
    /// Magnetic tensor (S·m⁴), body axes.
    pub tensor: [[f64; 3]; 3],
    /// Magnetic field.
    pub field: MagneticField,
}

impl EddyTorque {
    /// True if the currents, or the field, are zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.tensor == [[0.0; 3]; 3] || self.field.is_zero()
    }

    /// Sum with the currents of another tensor in the same field.
    #[must_use]
    pub fn with(&self, tensor: [[f64; 3]; 3]) -> Self {
        let sum = |i: usize, j: usize| self.tensor[i][j] + tensor[i][j];
        Self { tensor: [0, 1, 2].map(|i| [0, 1, 2].map(|j| sum(i, j))), field: self.field }
    }

    /// True if the tensor is the same about every axis.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = self.tensor;
        [xy, xz, yx, yz, zx, zy] == [0.0; 6] && xx == yy && yy == zz
    }

    /// Bound on the rate (1/s) at which the angular momentum of a body with this least moment of inertia (kg·m²) changes.
    #[must_use]
    pub fn greatest_rate(&self, least_moment: f64) -> f64 {
        let trace = |rows: [[f64; 3]; 3]| rows[0][0] + rows[1][1] + rows[2][2];
        0.5 * trace(self.tensor) * trace(self.field.mean_square()) / least_moment
    }

    /// Magnetic tensor (S·m⁴) along these axes, without its products: none of them has a mean over a free rotation.
    pub(super) fn along(&self, axes: [[f64; 3]; 3]) -> [f64; 3] {
        axes.map(|axis| dot(axis, self.tensor.map(|row| dot(row, axis))))
    }
}
