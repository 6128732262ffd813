//! Patches of distorted cells under a constant strain.

use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

use super::block::{Block, SHAPES, solved};
use super::cell::wood;
use crate::finite::solid::stiffness;

/// With the displacements of the surface given, those within and the energy `½ ε·Dε V` are exact.
#[test]
fn a_constant_strain_is_exact_in_distorted_cells_of_a_turned_orthotropic_material() {
    let D = wood();
    let turn = Rotation3::from_scaled_axis(Vector3::new(1.1, 0.4, -0.7)).into_inner();
    let A = Matrix3::new(0.3, -1.2, 0.4, 0.1, 0.7, 0.9, -0.6, 0.2, -0.5);
    let strain = A + A.transpose();
    let voigt = Vector6::new(A[(0, 0)], A[(1, 1)], A[(2, 2)], strain[(1, 2)], strain[(2, 0)], strain[(0, 1)]);
    for shape in SHAPES {
        let block = Block::new(shape, [2; 3], 0.3).mapped(|x| turn * x + Vector3::new(0.4, 2.0, -1.0));
        let K = block.assembled(3, |nodes| stiffness(shape, nodes, &D));
        let exact = block.field(|x| A * x + Vector3::new(0.2, 0.3, -0.4));
        let found = solved(&K, &(0.0 * &exact), |row| block.outside(row / 3).then_some(exact[row]));
        assert!((&found - &exact).amax() < 1e-12 * exact.amax(), "{shape}: {:e}", (&found - &exact).amax());
        let energy = found.dot(&(&K * &found));
        assert!((energy / voigt.dot(&(D * voigt)) - 1.0).abs() < 1e-12, "{shape}: {energy}");
    }
}
