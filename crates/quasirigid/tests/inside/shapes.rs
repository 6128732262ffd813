//! Cavities whose flow polynomials of the meridian or finite elements find: closed forms, convergence at the rate of the element,
//! and the estimates of the error.

use std::f64::consts::PI;

use quasirigid::elements::{Assembly, Cavity, CavityShape, SlowLiquid};
use quasirigid_mesh::meshing;

use super::bodies::{bare, tank};

fn slow(shape: CavityShape, resolution: usize) -> SlowLiquid {
    let cavity = Cavity { shape, resolution, ..tank([0.3, -0.2, 0.1], 1.0, 900.0, 0.02) };
    let mut assembly = Assembly { cavities: vec![cavity], ..bare() };
    assembly.reduction.order = 1;
    assembly.build().unwrap().liquids.remove(0)
}

/// Relative errors of the diagonal of `P` at two resolutions, and the order at which they fall.
fn errors(
    shape: impl Fn(usize) -> CavityShape,
    exact: [f64; 3],
    [coarse, fine]: [usize; 2],
) -> [[f64; 3]; 3] {
    let [coarser, finer] = [coarse, fine].map(|resolution| {
        let liquid = slow(shape(resolution), resolution);
        [0, 1, 2].map(|axis| liquid.tensor[axis][axis] / exact[axis] - 1.0)
    });
    let ratio = (fine as f64 / coarse as f64).ln();
    let orders = [0, 1, 2].map(|axis| (coarser[axis] / finer[axis]).abs().ln() / ratio);
    println!("{coarser:?} {finer:?} orders {orders:?}");
    [coarser, finer, orders]
}

#[test]
fn a_meshed_ball_and_ellipsoid_converge_to_the_closed_form() {
    let P = |a: f64, b: f64, c: f64| {
        let (a2, b2, c2) = (a * a, b * b, c * c);
        let sum = 3.0 * a2 * b2 * b2 + 2.0 * a2 * b2 * c2 + 3.0 * a2 * c2 * c2 + b2 * b2 * c2 + b2 * c2 * c2;
        16.0 * PI * a.powi(3) * b.powi(5) * c.powi(5) / (105.0 * sum)
    };
    for ([a, b, c], across, least) in [([0.4, 0.4, 0.4], [8, 16], 3.7), ([0.6, 0.45, 0.3], [6, 12], 3.45)] {
        let mesh =
            |resolution| CavityShape::Mesh(Box::new(meshing::ellipsoid([a, b, c], resolution, 1.0).unwrap()));
        let [_, finer, orders] = errors(mesh, [P(a, b, c), P(b, c, a), P(c, a, b)], across);
        assert!(finer.iter().all(|error| error.abs() < 1e-3), "{finer:?}");
        assert!(orders.iter().all(|order| *order > least), "{orders:?}");
    }
}

/// Axial values of cylinders of radius 1, by their height: the series of sines along the axis, summed to 10 digits.
const CYLINDERS: [(f64, f64); 5] = [
    (0.2, 8.079_048_219e-4),
    (1.0, 0.034_506_633_96),
    (2.0, 0.098_691_436_51),
    (5.0, 0.295_012_404_1),
    (20.0, 1.276_760_108),
];

#[test]
fn cylinders_answer_as_the_series() {
    let radius = 0.3;
    for (height, axial) in CYLINDERS {
        let liquid = slow(CavityShape::Cylinder { radius, height: height * radius }, 8);
        let gap = (liquid.tensor[2][2] / (axial * f64::powi(radius, 7)) - 1.0).abs();
        let estimate = liquid.errors.unwrap()[2];
        println!("{height}: {gap:e}, estimate {estimate:e}");
        assert!(gap < 1e-7 && gap < estimate && estimate < 1e-5, "{height}: {gap:e}, {estimate:e}");
    }
}

#[test]
fn meshed_cylinders_converge_to_the_series() {
    for ((height, axial), across, most) in [(CYLINDERS[1], [6, 12], 3e-4), (CYLINDERS[2], [4, 8], 6e-3)] {
        let radius = 0.3;
        let mesh = |resolution| meshing::cylinder(radius, height * radius, resolution, 1.0).unwrap();
        let shape = |resolution| CavityShape::Mesh(Box::new(mesh(resolution)));
        let exact = [1.0, 1.0, axial * f64::powi(radius, 7)];
        let [_, finer, orders] = errors(shape, exact, across);
        assert!(finer[2].abs() < most && orders[2] > 3.15, "{height}: {finer:?} {orders:?}");
    }
}

/// Polynomials of the meridian and finite elements, about the axis and across it.
#[test]
fn two_roads_agree_on_cavities_of_revolution() {
    let shapes = [
        (CavityShape::Cylinder { radius: 0.4, height: 0.5 }, meshing::cylinder(0.4, 0.5, 6, 1.0)),
        (CavityShape::Annulus { radii: [0.3, 0.5], height: 0.3 }, meshing::annulus([0.3, 0.5], 0.3, 6, 1.0)),
        (CavityShape::Ring { radius: 0.5, tube_radius: 0.2 }, meshing::ring(0.5, 0.2, 6, 1.0)),
        (
            CavityShape::Shell { outer: [0.5, 0.7, 0.5], inner: [0.2, 0.3, 0.2] },
            meshing::shell([0.5, 0.7, 0.5], [0.2, 0.3, 0.2], 4, 1.0),
        ),
    ];
    for (shape, mesh) in shapes {
        let cells = slow(CavityShape::Mesh(Box::new(mesh.unwrap())), 1);
        let exact = slow(shape.clone(), 8);
        let gaps = [0, 1, 2].map(|axis| cells.tensor[axis][axis] / exact.tensor[axis][axis] - 1.0);
        println!("{shape:?}: {gaps:?}, estimates {:?}", cells.errors);
        assert!(gaps.iter().all(|gap| gap.abs() < 0.02), "{shape:?}: {gaps:?}");
    }
}

/// A ring that is not slender is nearly the pipe that a slender one is, `P = π²R³a⁴/4`, but for `(a/R)²`.
#[test]
fn a_ring_is_nearly_a_pipe() {
    let gap = |tube: f64| {
        let liquid = slow(CavityShape::Ring { radius: 1.0, tube_radius: tube }, 8);
        liquid.tensor[2][2] / (0.25 * PI * PI * tube.powi(4)) - 1.0
    };
    assert!(gap(0.1).abs() < 1e-12, "{}", gap(0.1));
    let [near, far] = [gap(0.11), gap(0.22)];
    assert!(near.abs() < 0.02 && (far / near - 4.0).abs() < 0.2, "{near} {far}");
}

/// A wide cavity between plates a distance apart is Poiseuille's: `P = (d²/12) ∫ r² dV` about the normal, near enough.
#[test]
fn flat_cavities_are_flows_between_plates() {
    let (radius, height) = (1.0, 0.1);
    let liquid = slow(CavityShape::Cylinder { radius, height }, 8);
    let plates = height * height / 12.0 * (0.5 * PI * radius.powi(4) * height);
    assert!((liquid.tensor[2][2] / plates - 1.0).abs() < 0.2, "{}", liquid.tensor[2][2] / plates);
}
