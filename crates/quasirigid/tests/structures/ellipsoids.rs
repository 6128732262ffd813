//! Meshes of an ellipsoid against the exact ellipsoid: mass, inertia and compliance, and their rate of convergence.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Matrix6, Vector3};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::FlexibleBody;
use quasirigid_mesh::Shape;

use super::common::{compliance, error, inertia, turned_axes};
use super::meshes::{Hexahedra, solid, throughout};
use crate::support::parts;

const COMPLIANCE: &str = include_str!("../../../../data/published/ellipsoid/compliance.csv");

/// Lengths in hands, masses in pounds, times in minutes: nothing is near one in SI.
const LENGTH: f64 = 0.1016;
const DENSITY: f64 = 0.45359237 / (LENGTH * LENGTH * LENGTH);
const SHEAR: f64 = 0.45359237 / (LENGTH * 3600.0);
const CENTER: [f64; 3] = [0.31, -0.17, 0.23];

fn rock(poisson: f64) -> Material {
    let young = 2.0 * (1.0 + poisson) * SHEAR;
    parts::elastic(DENSITY, young, poisson)
}

/// Ellipsoid of cells, its axes rotated, its centre off the origin.
fn meshed(shape: Shape, n: usize, semi_axes: [f64; 3], poisson: f64) -> FlexibleBody {
    let axes = turned_axes();
    let place = |x: Vector3<f64>| {
        axes * (LENGTH * x.component_mul(&Vector3::from(semi_axes))) + Vector3::from(CENTER)
    };
    let mesh = Hexahedra::ball(n).mesh(shape, place);
    let regions = throughout(&mesh, &rock(poisson));
    Assembly { parts: vec![solid(mesh, &regions, Vec::new())], ..Assembly::default() }.body().unwrap()
}

/// The row of the published table for semi-axes and Poisson's ratio, in our units: inertia and compliance.
fn published(semi_axes: [f64; 3], poisson: f64) -> (Matrix3<f64>, Matrix6<f64>) {
    let numbers = |line: &str| line.split(',').map(|field| field.parse().unwrap()).collect::<Vec<f64>>();
    let wanted = [semi_axes[0], semi_axes[1], semi_axes[2], poisson];
    let row = COMPLIANCE.lines().skip(1).map(numbers).find(|row| row[..4] == wanted).unwrap();
    let [xx, yy, zz, yz, zx, xy, b1, b2, b3] = row[7..16] else { panic!("16 columns") };
    let mut compliance = Matrix6::from_diagonal(&[xx, yy, zz, b1, b2, b3].into());
    for (i, j, entry) in [(1, 2, yz), (2, 0, zx), (0, 1, xy)] {
        (compliance[(i, j)], compliance[(j, i)]) = (entry, entry);
    }
    let moments = Matrix3::from_diagonal(&[row[4], row[5], row[6]].into());
    let unit = DENSITY * DENSITY * LENGTH.powi(7) / SHEAR;
    (DENSITY * LENGTH.powi(5) * moments, unit * compliance)
}

/// Errors of mass, inertia and compliance.
fn errors(
    body: &FlexibleBody,
    semi_axes: [f64; 3],
    moments: &Matrix3<f64>,
    exact: &Matrix6<f64>,
) -> [f64; 3] {
    let mass = DENSITY * 4.0 / 3.0 * PI * semi_axes.iter().product::<f64>() * LENGTH.powi(3);
    let axes = turned_axes();
    [
        (body.invariants().mass / mass - 1.0).abs(),
        error(&inertia(body, axes), moments),
        error(&compliance(body, axes), exact),
    ]
}

/// Facets lose mass with the square of their size, curved faces with its fourth power; the elastic energy is wrong by
/// the square of the error of the strain, which is of the degree of the cell.
#[test]
fn every_cell_approaches_the_ellipsoid_at_its_order() {
    let (semi_axes, poisson) = ([1.0, 0.8, 0.6], 0.4);
    let (moments, exact) = published(semi_axes, poisson);
    println!("cell                        n   mass      inertia   compliance  orders");
    for shape in [Shape::Tet4, Shape::Hex8, Shape::Tet10, Shape::Hex20, Shape::Hex27] {
        let linear = shape.nodes() == shape.corners();
        let counts = if linear { [2, 4] } else { [1, 2] };
        let found =
            counts.map(|n| errors(&meshed(shape, n, semi_axes, poisson), semi_axes, &moments, &exact));
        let orders = [0, 1, 2].map(|i| (found[0][i] / found[1][i]).log2());
        for (n, [mass, inertia, compliance]) in counts.iter().zip(found) {
            println!("{:<26} {n:>2}   {mass:.2e}  {inertia:.2e}  {compliance:.2e}", shape.to_string());
        }
        println!("{:>70} {:.2} {:.2} {:.2}", "", orders[0], orders[1], orders[2]);
        let order = if linear { 2.0 } else { 4.0 };
        for quantity in 0..3 {
            assert!((orders[quantity] - order).abs() < 0.5, "{shape}: {orders:?}");
        }
    }
}

/// Two methods against the exact one: the table, and the element made of polynomials. The same mesh in both.
#[test]
fn meshes_agree_with_the_element_and_the_table() {
    let axes = turned_axes();
    for (semi_axes, poisson) in [([1.0, 0.5, 0.4], 0.25), ([2.3, 1.2, 0.96], 0.0)] {
        let straight = Ellipsoid {
            name: "rock".to_owned(),
            semi_axes: semi_axes.map(|axis| LENGTH * axis),
            center: CENTER,
            material: rock(poisson),
        };
        let element = Assembly { ellipsoids: vec![straight], ..Assembly::default() }.body().unwrap();
        let unturned = nalgebra::Rotation3::identity();
        let exact = compliance(&element, unturned);
        // Twelve digits in the table.
        assert!(error(&exact, &published(semi_axes, poisson).1) < 1e-10);
        let mesh = meshed(Shape::Hex27, 2, semi_axes, poisson);
        let gap = error(&compliance(&mesh, axes), &exact);
        let turn = error(&inertia(&mesh, axes), &inertia(&element, unturned));
        let center = Vector3::from(mesh.center_of_mass()) - Vector3::from(CENTER);
        println!("{semi_axes:?}: compliance {gap:.2e}, inertia {turn:.2e}, centre {:.1e}", center.amax());
        // 256 cells; four times less than the error of 32 of them.
        assert!(gap < 2e-3 && turn < 1e-3 && center.amax() < 1e-12 * LENGTH, "{gap} {turn} {center}");
    }
}

/// An incompressible sphere: Love's limit, and the closed form at Poisson's ratio 0.4999.
#[test]
fn quadratic_cells_do_not_lock() {
    let poisson = 0.4999;
    let closed = 4.0 * PI / 105.0 * (13.0 + 9.0 * poisson) / (7.0 + 5.0 * poisson);
    // Love: h₂ = 5ρga/19μ, seven digits.
    assert!((closed / 0.220_462_6 - 1.0).abs() < 2e-5, "{closed}");
    let unit = DENSITY * DENSITY * LENGTH.powi(7) / SHEAR;
    for shape in [Shape::Tet10, Shape::Hex20, Shape::Hex27] {
        let found = [1, 2].map(|n| compliance(&meshed(shape, n, [1.0; 3], poisson), turned_axes()) / unit);
        let shears =
            found.map(|found| (3..6).map(|i| (found[(i, i)] / closed - 1.0).abs()).fold(0.0, f64::max));
        // K₁₁ − K₁₂ = ½ k₁₂ of every body of revolution.
        let identity = (found[1][(0, 0)] - found[1][(0, 1)]) / (0.5 * found[1][(5, 5)]) - 1.0;
        let [coarse, fine] = shears;
        println!("{shape}: errors {coarse:.1e} {fine:.1e}, identity {identity:.1e}");
        assert!(shears[1] < 0.01 && shears[0] > 4.0 * shears[1], "{shape}: {shears:?}");
        assert!(identity.abs() < 0.01, "{identity}");
    }
}

/// `3GM²/8πR⁴` for a homogeneous sphere of the same mass and volume.
#[test]
fn the_central_pressure_is_that_of_the_sphere_of_equal_volume() {
    let semi_axes = [310.0, 270.0, 160.0];
    let material = parts::elastic(2100.0, 1e9, 0.25);
    let ellipsoid = Ellipsoid { name: "rock".into(), semi_axes, center: [1.0, 2.0, 3.0], material };
    let volume = 4.0 / 3.0 * PI * 310.0 * 270.0 * 160.0;
    let (mass, radius) = (2100.0 * volume, (3.0 * volume / (4.0 * PI)).cbrt());
    let expected = 3.0 * 6.6743e-11 * mass * mass / (8.0 * PI * radius.powi(4));
    assert!((ellipsoid.central_pressure() / expected - 1.0).abs() < 1e-14);
}
