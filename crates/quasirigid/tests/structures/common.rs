//! Common parts of the tests of structures: rotated axes, the compliance of a body, and the error relative to another matrix.

use nalgebra::{Matrix3, Matrix6, MatrixXx6, Rotation3, Vector3};
use quasirigid::model::FlexibleBody;
use quasirigid_math::sym3;

/// Axes of a test body: its own as columns, in the file's frame.
pub fn turned_axes() -> Rotation3<f64> {
    Rotation3::from_euler_angles(0.7, -0.4, 1.9)
}

/// Compliance on the products xx, yy, zz, yz, zx, xy of the spin in the body's own axes: half its form is the elastic
/// energy.
pub fn compliance(body: &FlexibleBody, axes: Rotation3<f64>) -> Matrix6<f64> {
    let J1: Vec<Matrix3<f64>> =
        body.invariants().J1.iter().map(|J1| Matrix3::from(sym3::rows(*J1))).collect();
    let loads = loads(&J1, axes);
    let mut answers: Vec<f64> =
        loads.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect();
    body.solve_stiffness(&mut answers, 6);
    loads.tr_mul(&MatrixXx6::from_row_slice(&answers)).fixed_view::<6, 6>(0, 0).into_owned()
}

/// Load `½ ωᵀJ₁ω` on each coordinate, a row each, by the products of the spin in the body's own axes.
pub fn loads(J1: &[Matrix3<f64>], axes: Rotation3<f64>) -> MatrixXx6<f64> {
    let own: Vec<Matrix3<f64>> = J1.iter().map(|J1| axes.inverse() * J1 * axes).collect();
    let entries = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];
    MatrixXx6::from_fn(own.len(), |j, product| {
        let (a, b) = entries[product];
        if a == b { 0.5 * own[j][(a, b)] } else { own[j][(a, b)] }
    })
}

/// Inertia tensor in the body's own axes.
pub fn inertia(body: &FlexibleBody, axes: Rotation3<f64>) -> Matrix3<f64> {
    axes.inverse() * Matrix3::from(sym3::rows(body.invariants().J)) * axes
}

/// Largest difference of two matrices over the largest entry of the second.
pub fn error<const N: usize>(
    found: &nalgebra::SMatrix<f64, N, N>,
    expected: &nalgebra::SMatrix<f64, N, N>,
) -> f64 {
    (found - expected).amax() / expected.amax()
}

/// Largest difference of two vectors over the largest entry of the second.
pub fn vector_error(found: [f64; 3], expected: [f64; 3]) -> f64 {
    (Vector3::from(found) - Vector3::from(expected)).amax() / Vector3::from(expected).amax()
}

/// Numbers between −1 and 1 that are equal on every machine.
pub struct Numbers(pub u64);

impl Numbers {
    pub fn next(&mut self) -> f64 {
        // Constants of Knuth's MMIX; the high bits are the random ones.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}
