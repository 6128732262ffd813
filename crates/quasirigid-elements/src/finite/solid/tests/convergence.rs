//! Convergence of refined cells to closed forms, and the absence of locking.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, Vector2, Vector3};

use super::block::{Block, SHAPES, solved};
use crate::finite::elasticity::isotropic;
use crate::finite::solid::slopes::{inverse, jacobian};
use crate::finite::solid::{mass, stiffness};
use quasirigid_mesh::{Rule, Shape};

/// `∇φ` and `∇∇φ` of `φ = e^x sin(0.6 y) cos(0.8 z)`, which is harmonic: a displacement in balance without a force.
fn smooth(x: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let (e, [sy, cy], [sz, cz]) =
        (x.x.exp(), [(0.6 * x.y).sin(), (0.6 * x.y).cos()], [(0.8 * x.z).sin(), (0.8 * x.z).cos()]);
    let gradient = e * Vector3::new(sy * cz, 0.6 * cy * cz, -0.8 * sy * sz);
    let (xx, yy, zz) = (sy * cz, -0.36 * sy * cz, -0.64 * sy * cz);
    let (xy, xz, yz) = (0.6 * cy * cz, -0.8 * sy * sz, -0.48 * cy * sz);
    (gradient, e * Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz))
}

/// `∫ |∇u_h − ∇u|² dV` where the displacement of the surface is given.
fn error(shape: Shape, count: usize) -> f64 {
    let D = isotropic(1.0, 0.3).unwrap();
    let block = Block::new(shape, [count; 3], 0.15);
    let K = block.assembled(3, |nodes| stiffness(shape, nodes, &D));
    let exact = block.field(|x| smooth(x).0);
    let found = solved(&K, &(0.0 * &exact), |row| block.outside(row / 3).then_some(exact[row]));
    let mut error = 0.0;
    for (cell, nodes) in block.cells.iter().enumerate() {
        let places = block.places(cell);
        for sample in shape.samples(Rule::Products) {
            let jacobian = jacobian(&places, sample);
            let mut departure = Matrix3::zeros();
            let mut at = Vector3::zeros();
            for (a, node) in nodes.iter().enumerate() {
                let slope = inverse(&jacobian) * Vector3::from(sample.gradients[a]);
                departure += Vector3::from_fn(|axis, _| found[3 * node + axis]) * slope.transpose();
                at += sample.functions[a] * places[a];
            }
            error += sample.weight * jacobian.determinant() * (departure - smooth(at).1).norm_squared();
        }
    }
    error
}

#[test]
fn the_energy_of_the_error_falls_with_twice_the_degree_of_the_cell() {
    for shape in SHAPES {
        let linear = shape.nodes() == shape.corners();
        let (counts, order) = if linear { ([4, 8], 2.0) } else { ([2, 4], 4.0) };
        let [coarse, fine] = counts.map(|count| error(shape, count));
        let rate = (coarse / fine).log2();
        assert!((rate - order).abs() < 0.35, "{shape}: {coarse:e} {fine:e}, order {rate}");
    }
}

/// Deflection of the end of a cantilever under a force there, relative to beam theory.
fn cantilever(shape: Shape, counts: [usize; 3], size: [f64; 3], poisson: f64) -> f64 {
    let D = isotropic(1.0, poisson).unwrap();
    let block = Block::new(shape, counts, 0.0).mapped(|x| x.component_mul(&Vector3::from(size)));
    let K = block.assembled(3, |nodes| stiffness(shape, nodes, &D));
    let end: Vec<usize> = (0..block.nodes.len()).filter(|node| block.even[*node].x > 1.0 - 1e-9).collect();
    let mut load = DVector::zeros(K.nrows());
    end.iter().for_each(|node| load[3 * node + 2] = 1.0 / end.len() as f64);
    let found = solved(&K, &load, |row| (block.even[row / 3].x < 1e-9).then_some(0.0));
    let [length, width, height] = size;
    let exact =
        4.0 * length.powi(3) / (width * height.powi(3)) + 2.4 * (1.0 + poisson) * length / (width * height);
    load.dot(&found) / exact
}

/// Cells of a tenth of the length are 20 times as wide as high; at ν = 0.3 the clamp, which holds the section flat,
/// stiffens the beam over about its width.
#[test]
fn a_thin_cantilever_bends_as_a_beam() {
    let size = [10.0, 0.5, 0.1];
    for shape in [Shape::Hex8, Shape::Hex20, Shape::Hex27, Shape::Wedge15, Shape::Tet10] {
        for (poisson, tolerance) in [(0.0, 0.003), (0.3, 0.035)] {
            let share = cantilever(shape, [10, 1, 1], size, poisson);
            assert!((share - 1.0).abs() < tolerance, "{shape} with ν = {poisson}: {share}");
        }
    }
    let share = cantilever(Shape::Hex8, [20, 1, 1], size, 0.0);
    assert!((share - 1.0).abs() < 0.001, "{share}");
}

/// Radial displacement of a long hollow cylinder of radii 1 and 2 that rotates about its axis and keeps its length: `u = A r + B/r − ρω² r³
/// / 8(λ + 2μ)`, with `A` and `B` from free surfaces; `E = ρω² = 1`.
fn radial(poisson: f64) -> impl Fn(f64) -> f64 {
    let shear = 0.5 / (1.0 + poisson);
    let lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    let bulk = lame + 2.0 * shear;
    // σ_r = (λ + 2μ) u' + λ u/r
    let row =
        |r: f64| [2.0 * (lame + shear), -2.0 * shear / (r * r), (3.0 * bulk + lame) * r * r / (8.0 * bulk)];
    let ([a, b, f], [c, d, g]) = (row(1.0), row(2.0));
    let share = Matrix2::new(a, b, c, d).lu().solve(&Vector2::new(f, g)).unwrap();
    move |r: f64| share[0] * r + share[1] / r - r.powi(3) / (8.0 * bulk)
}

/// Largest error of the radial displacement at the inner and outer surface, relative to the exact one.
fn spinning(shape: Shape, counts: [usize; 3], poisson: f64) -> f64 {
    let D = isotropic(1.0, poisson).unwrap();
    let block = Block::new(shape, counts, 0.0).mapped(|x| {
        let (sin, cos) = (0.5 * std::f64::consts::PI * (1.0 - x.y)).sin_cos();
        Vector3::new((1.0 + x.x) * cos, (1.0 + x.x) * sin, -0.4 * x.z)
    });
    let K = block.assembled(3, |nodes| stiffness(shape, nodes, &D));
    let M = block.assembled(1, |nodes| mass(shape, nodes, 1.0));
    let force =
        M * DMatrix::from_fn(
            block.nodes.len(),
            3,
            |node, axis| if axis < 2 { block.nodes[node][axis] } else { 0.0 },
        );
    let load = DVector::from_fn(K.nrows(), |row, _| force[(row / 3, row % 3)]);
    let held = |row: usize| {
        let at = block.even[row / 3];
        let side = match row % 3 {
            0 => at.y < 1e-9,
            1 => at.y > 1.0 - 1e-9,
            _ => at.z < 1e-9 || at.z > 1.0 - 1e-9,
        };
        side.then_some(0.0)
    };
    let found = solved(&K, &load, held);
    let exact = radial(poisson);
    let error = |node: usize| {
        let x = block.nodes[node];
        let r = x.xy().norm();
        let along = (found[3 * node] * x.x + found[3 * node + 1] * x.y) / r;
        (along / exact(r) - 1.0).abs()
    };
    let surface =
        (0..block.nodes.len()).filter(|node| block.even[*node].x < 1e-9 || block.even[*node].x > 1.0 - 1e-9);
    surface.map(error).fold(0.0, f64::max)
}

#[test]
fn cells_do_not_lock_where_the_material_is_nearly_incompressible() {
    let limits = [
        (Shape::Tet10, 0.013),
        (Shape::Wedge15, 0.015),
        (Shape::Hex8, 0.02),
        (Shape::Hex20, 1e-4),
        (Shape::Hex27, 1e-4),
    ];
    for (shape, limit) in limits {
        for poisson in [0.3, 0.4999, 0.499_999] {
            let error = spinning(shape, [4, 6, 1], poisson);
            assert!(error < limit, "{shape} with ν = {poisson}: {error}");
        }
    }
}

#[test]
fn linear_tetrahedra_and_wedges_lock_as_documented() {
    for shape in [Shape::Tet4, Shape::Wedge6] {
        assert!(spinning(shape, [4, 6, 1], 0.3) < 0.1, "{shape}");
        assert!(spinning(shape, [4, 6, 1], 0.4999) > 0.5, "{shape}");
    }
}
