//! Single cells.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector3};

use super::block::{Block, SHAPES, distorted, rigid};
use crate::finite::elasticity::{Orthotropic, isotropic, orthotropic};
use crate::finite::solid::{geometric, mass, stiffness};
use quasirigid_mesh::Shape;

/// Orthotropic material in rotated axes.
pub fn wood() -> Matrix6<f64> {
    let constants =
        Orthotropic { young: [11.0, 0.9, 0.5], poisson: [0.37, 0.42, 0.45], shear: [0.8, 0.7, 0.1] };
    let turn = nalgebra::Rotation3::from_scaled_axis(Vector3::new(-0.5, 0.8, 1.1));
    orthotropic(&constants, turn.matrix()).unwrap()
}

#[test]
fn a_rigid_motion_meets_no_force_and_no_other_is_free() {
    for shape in SHAPES {
        for D in [wood(), isotropic(3.0, 0.499).unwrap(), isotropic(3.0, 0.0).unwrap()] {
            let nodes = distorted(shape);
            let K = stiffness(shape, &nodes, &D);
            assert!((&K * rigid(&nodes)).amax() < 1e-13 * K.amax() * 10.0, "{shape}");
            assert!((&K - K.transpose()).amax() < 1e-14 * K.amax(), "{shape}");
            let mut values: Vec<f64> = K.symmetric_eigenvalues().iter().copied().collect();
            values.sort_by(f64::total_cmp);
            let most = values[values.len() - 1];
            assert!(values[5].abs() < 1e-14 * most && values[6] > 1e-5 * most, "{shape}: {:?}", &values[..8]);
        }
    }
}

#[test]
fn stiffness_grows_with_the_size_of_the_cell_and_with_the_modulus() {
    for shape in SHAPES {
        let nodes = distorted(shape);
        let larger: Vec<Vector3<f64>> = nodes.iter().map(|node| 1e-3 * node).collect();
        let K = stiffness(shape, &nodes, &wood());
        let scaled = stiffness(shape, &larger, &(7e10 * wood()));
        assert!((scaled - 7e7 * &K).amax() < 1e-11 * 7e7 * K.amax(), "{shape}");
    }
}

/// The moments of an affine image of the unit cube: over the cube `∫ x_i x_j = ¼ + δ_ij/12`.
#[test]
fn mass_has_the_moments_of_the_solid() {
    let stretch = Matrix3::new(1.3, 0.2, 0.0, -0.1, 0.7, 0.4, 0.3, 0.0, 0.9);
    let origin = Vector3::new(2.0, -1.5, 0.8);
    let density = 2.7;
    for shape in SHAPES {
        let block = Block::new(shape, [2; 3], 0.25).mapped(|x| stretch * x + origin);
        let M = block.assembled(1, |nodes| mass(shape, nodes, density));
        let ones = DMatrix::repeat(block.nodes.len(), 1, 1.0);
        let places = DMatrix::from_fn(block.nodes.len(), 3, |node, axis| block.nodes[node][axis]);
        let whole = density * stretch.determinant();
        let middle = stretch * Vector3::repeat(0.5) + origin;
        let second = stretch * stretch.transpose() / 12.0 + middle * middle.transpose();
        let close = |found: DMatrix<f64>, exact: DMatrix<f64>| {
            assert!((&found - &exact).amax() < 1e-13 * exact.amax(), "{shape}: {found} {exact}");
        };
        close(ones.transpose() * &M * &ones, DMatrix::repeat(1, 1, whole));
        close(ones.transpose() * &M * &places, DMatrix::from_row_slice(1, 3, (whole * middle).as_slice()));
        close(
            places.transpose() * &M * &places,
            DMatrix::from_column_slice(3, 3, (whole * second).as_slice()),
        );
        assert!(M.cholesky().is_some(), "{shape}: kinetic energy is positive");
    }
}

/// A displacement `u = Ax` has the stress `D sym A` everywhere; of a motion `v = b(c·x)` the energy is then
/// `½ V b² c·σc`.
#[test]
fn geometric_stiffness_is_that_of_a_uniform_stress() {
    let A = Matrix3::new(0.3, -1.2, 0.4, 0.1, 0.7, 0.9, -0.6, 0.2, -0.5);
    let c = Vector3::new(0.6, -1.1, 0.8);
    let D = wood();
    let strain = A + A.transpose();
    let voigt = nalgebra::Vector6::new(
        A[(0, 0)],
        A[(1, 1)],
        A[(2, 2)],
        strain[(1, 2)],
        strain[(2, 0)],
        strain[(0, 1)],
    );
    let [xx, yy, zz, yz, zx, xy]: [f64; 6] = (D * voigt).into();
    let stress = Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
    for shape in SHAPES {
        let block =
            Block::new(shape, [2; 3], 0.25).mapped(|x| x + 0.1 * A * x + Vector3::new(5.0, 1.0, -2.0));
        let u = block.field(|x| A * x);
        let volume = (Matrix3::identity() + 0.1 * A).determinant();
        let mut energy = 0.0;
        for (cell, nodes) in block.cells.iter().enumerate() {
            let own = DVector::from_fn(3 * nodes.len(), |row, _| u[3 * nodes[row / 3] + row % 3]);
            let S = geometric(shape, &block.places(cell), &D, &own);
            assert!((&S - S.transpose()).amax() < 1e-13 * S.amax());
            assert!((&S * DVector::repeat(nodes.len(), 1.0)).amax() < 1e-13 * S.amax());
            let v = DVector::from_fn(nodes.len(), |node, _| c.dot(&block.nodes[nodes[node]]));
            energy += v.dot(&(S * &v));
        }
        let exact = volume * c.dot(&(stress * c));
        assert!((energy / exact - 1.0).abs() < 1e-11, "{shape}: {energy} {exact}");
    }
}

/// Pure bending `u = (κxz, 0, −κx²/2)` of a bar: a hexahedron of 8 nodes has its exact stress `σ_xx = Eκz` and so the
/// geometric stiffness `∫ v'² σ_xx dV`, which for `v = xz` is `Eκ ∫ z² z dV + …`, here beside another choice of
/// nodes.
#[test]
fn geometric_stiffness_of_bending_is_that_of_its_stress() {
    let (young, curvature) = (3.0, 0.01);
    let D = isotropic(young, 0.0).unwrap();
    let size = Vector3::new(2.0, 0.5, 0.3);
    let nodes: Vec<Vector3<f64>> =
        Shape::Hex8.reference().into_iter().map(|at| 0.5 * size.component_mul(&Vector3::from(at))).collect();
    let u = DVector::from_iterator(
        24,
        nodes.iter().flat_map(|x| [curvature * x.x * x.z, 0.0, -0.5 * curvature * x.x * x.x]),
    );
    let S = geometric(Shape::Hex8, &nodes, &D, &u);
    // v = x + xz: ∫ σ_xx (1 + z)² dV = 2Eκ ∫ z² dV.
    let v = DVector::from_iterator(8, nodes.iter().map(|x| x.x + x.x * x.z));
    let exact = 2.0 * young * curvature * size.product() * size.z * size.z / 12.0;
    let found = v.dot(&(&S * &v));
    assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
}

/// `u = (x²z, 0, 0)` has the dilatation `2xz`, which a quadratic hexahedron smooths to nothing: `σ_xx = 8μxz/3` and
/// `σ_zx = μx²`. With `v = x + x²z/2` follows `∫ ∇v·σ∇v dV = 16μ/3 ∫ x²z² dV + μ ∫ x⁴ dV`.
#[test]
fn geometric_stiffness_has_the_stress_of_the_smoothed_dilatation() {
    let (young, poisson) = (3.0, 0.3);
    let D = isotropic(young, poisson).unwrap();
    let shear = 0.5 * young / (1.0 + poisson);
    let size = Vector3::new(2.0, 0.5, 0.7);
    for shape in [Shape::Hex20, Shape::Hex27] {
        let nodes: Vec<Vector3<f64>> =
            shape.reference().into_iter().map(|at| 0.5 * size.component_mul(&Vector3::from(at))).collect();
        let u =
            DVector::from_iterator(3 * nodes.len(), nodes.iter().flat_map(|x| [x.x * x.x * x.z, 0.0, 0.0]));
        let v = DVector::from_iterator(nodes.len(), nodes.iter().map(|x| x.x + 0.5 * x.x * x.x * x.z));
        let found = v.dot(&(geometric(shape, &nodes, &D, &u) * &v));
        let (squares, fourth) = ((size.x * size.z).powi(2) / 144.0, size.x.powi(4) / 80.0);
        let exact = shear * size.product() * (16.0 / 3.0 * squares + fourth);
        assert!((found / exact - 1.0).abs() < 1e-12, "{shape}: {found} {exact}");
    }
}
