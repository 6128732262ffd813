//! A liquid in a ball and an ellipsoid, against closed forms.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use quasirigid::averaging::{FreeRotation, MeanPower, PolynomialPower, Response};
use quasirigid::elements::{Assembly, Cavity, CavityShape};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::reduction::reduce;
use quasirigid_mesh::meshing;

use super::bodies::{bare, cavity};

const DENSITY: f64 = 1260.0;
const VISCOSITY: f64 = 0.03;

fn body(tank: Cavity, order: usize) -> FlexibleBody {
    let mut assembly = Assembly { cavities: vec![tank], ..bare() };
    assembly.reduction.order = order;
    assembly.body().unwrap()
}

/// Mass matrix, friction, and angular momentum of the cyclic coordinates.
fn matrices(body: &FlexibleBody) -> (DMatrix<f64>, DMatrix<f64>, Vec<Vector3<f64>>) {
    let n = body.coordinates().len();
    let (mut A, mut B) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
    body.invariants().pairs.iter().for_each(|(j, k, pair)| A[(j, k)] = pair.A);
    body.damping().iter().for_each(|(j, k, entry)| B[(j, k)] = *entry);
    (A, B, body.invariants().h.iter().map(|h| Vector3::from(*h)).collect())
}

/// Coefficients of `1 − χ` in powers of `z² = s a²/ν`, by repeated responses of friction to inertia.
fn moments(body: &FlexibleBody, axis: Vector3<f64>, count: usize) -> Vec<f64> {
    let (A, B, h) = matrices(body);
    let load = DVector::from_iterator(h.len(), h.iter().map(|h| h.dot(&axis)));
    let solve = B.cholesky().unwrap();
    let mut x = solve.solve(&load);
    let mut found = Vec::new();
    for power in 0..count {
        found.push(load.dot(&x) * if power % 2 == 0 { 1.0 } else { -1.0 });
        x = solve.solve(&(&A * x));
    }
    found
}

/// Series of the liquid ball, `χ = (5/z²)(z i₁′/i₁ − 1) = 1 − z²/35 + 2z⁴/1575 − 37z⁶/606375 + …` (anchors of the literature).
#[test]
fn a_ball_answers_as_the_series_of_the_unsteady_flow() {
    let radius = 0.4;
    let inertia = DENSITY * 8.0 / 15.0 * std::f64::consts::PI * f64::powi(radius, 5);
    let series = [1.0 / 35.0, -2.0 / 1575.0, 37.0 / 606_375.0];
    let tank = cavity([radius; 3], DENSITY, VISCOSITY);
    let body = body(tank, 3);
    let axis = Vector3::new(0.3, -0.5, 0.8).normalize();
    for (power, (found, expected)) in moments(&body, axis, 3).into_iter().zip(series).enumerate() {
        let scale = inertia * (radius * radius / VISCOSITY).powi(power as i32 + 1);
        assert!((found / (expected * scale) - 1.0).abs() < 1e-11, "z^{}: {found}", 2 * power + 2);
    }
}

/// Torque `μ₃ = ω × Πω̇ + d/dt (Πω̇)` with Euler's `ω̇`, homogeneous and cubic, with the closed form of `P` in rotated axes.
#[test]
fn the_torque_begins_with_a_cubic() {
    let semi_axes = [0.6, 0.45, 0.3];
    let tank = cavity(semi_axes, DENSITY, VISCOSITY);
    let turn = {
        let attitude = tank.attitude;
        let column = |axis| Vector3::from(quasirigid_math::rotation::to_inertial(attitude, axis));
        Matrix3::from_columns(&[column([1.0, 0.0, 0.0]), column([0.0, 1.0, 0.0]), column([0.0, 0.0, 1.0])])
    };
    let P = |a: f64, b: f64, c: f64| {
        let (a2, b2, c2) = (a * a, b * b, c * c);
        let sum = 3.0 * a2 * b2 * b2 + 2.0 * a2 * b2 * c2 + 3.0 * a2 * c2 * c2 + b2 * b2 * c2 + b2 * c2 * c2;
        16.0 * std::f64::consts::PI * a.powi(3) * b.powi(5) * c.powi(5) / (105.0 * sum)
    };
    let [a, b, c] = semi_axes;
    let own = Matrix3::from_diagonal(&Vector3::new(P(a, b, c), P(b, c, a), P(c, a, b)));
    let Pi = DENSITY / VISCOSITY * (turn * own * turn.transpose());
    let body = body(tank, 1);
    let reduced = reduce(&body, 1).unwrap();
    let J = Matrix3::from_row_slice(&body.inertia().concat());
    let inverse = J.try_inverse().unwrap();
    for w in [Vector3::new(0.3, -0.7, 0.2), Vector3::new(-1.1, 0.4, 0.9)] {
        let euler = |w: Vector3<f64>| inverse * (J * w).cross(&w);
        let first = euler(w);
        let second = inverse * ((J * first).cross(&w) + (J * w).cross(&first));
        let expected = w.cross(&(Pi * first)) + Pi * second;
        let mut found = [0.0; 3];
        reduced.mu(3).add_value(w.into(), &mut found);
        assert!((Vector3::from(found) - expected).norm() < 1e-12 * expected.norm(), "{found:?} {expected:?}");
    }
    assert_eq!(reduced.mu(2).degree(), 2);
}

/// The liquid at rest is part of the body: mass, centre of mass and inertia.
#[test]
fn the_frozen_liquid_belongs_to_the_body() {
    let tank = cavity([0.6, 0.45, 0.3], DENSITY, VISCOSITY);
    let mass = DENSITY * 4.0 / 3.0 * std::f64::consts::PI * 0.6 * 0.45 * 0.3;
    let (alone, center) = (bare().carrier.unwrap(), Vector3::from(tank.center));
    let body = body(tank, 1);
    assert!((body.invariants().mass / (alone.mass + mass) - 1.0).abs() < 1e-14);
    let together = (alone.mass * Vector3::from(alone.center_of_mass) + mass * center) / (alone.mass + mass);
    assert!((Vector3::from(body.center_of_mass()) - together).norm() < 1e-14);
    let trace = |J: [[f64; 3]; 3]| J[0][0] + J[1][1] + J[2][2];
    let own = 2.0 * mass / 5.0 * (0.36 + 0.2025 + 0.09);
    let apart = alone.mass * mass / (alone.mass + mass)
        * (Vector3::from(alone.center_of_mass) - center).norm_squared();
    assert!((trace(body.inertia()) / (trace(alone.inertia) + own + 2.0 * apart) - 1.0).abs() < 1e-13);
}

/// The slow flow of a ball rotates with the body as a solid ball does: `W_jk = A ê_j × ê_k` of its three flows. (C9), (L3)
#[test]
fn the_slow_flow_of_a_ball_turns_as_a_solid_one() {
    let body = body(cavity([0.4; 3], DENSITY, VISCOSITY), 1);
    let (A, _, h) = matrices(&body);
    assert_eq!(h.len(), 3);
    for (j, k, pair) in body.invariants().pairs.iter().filter(|(j, k, _)| j != k) {
        let expected = A[(j, j)] * h[j].normalize().cross(&h[k].normalize());
        assert!((Vector3::from(pair.Z) - expected).norm() < 1e-12 * A[(j, j)], "{j} {k}");
    }
}

/// Finite elements and polynomials agree on the cubic and the quartic torque of an ellipsoid of liquid.
#[test]
fn a_meshed_ellipsoid_turns_as_the_exact_one() {
    let semi_axes = [0.6, 0.45, 0.3];
    let exact = cavity(semi_axes, DENSITY, VISCOSITY);
    let mesh = meshing::ellipsoid(semi_axes, 8, 1.0).unwrap();
    let meshed = Cavity { shape: CavityShape::Mesh(Box::new(mesh)), ..exact.clone() };
    let [exact, meshed] = [exact, meshed].map(|tank| reduce(&body(tank, 2), 2).unwrap());
    for degree in [3, 4] {
        let mut gap = meshed.mu(degree);
        gap.add_scaled(-1.0, &exact.mu(degree));
        let share = gap.amax() / exact.mu(degree).amax();
        assert!(share < 0.02, "degree {degree}: {share}");
    }
}

/// Where a rotation is slow, the power of the harmonics, which take the liquid's response at every frequency, is that of the slow flow; the
/// difference falls as the square of the spin.
#[test]
fn harmonics_join_the_slow_flow() {
    let ring = CavityShape::Ring { radius: 0.4, tube_radius: 0.03 };
    for shape in [CavityShape::Ellipsoid { semi_axes: [0.3; 3] }, ring] {
        let body = body(Cavity { shape, ..cavity([0.3; 3], 100.0, VISCOSITY) }, 1);
        let (polynomial, response) =
            (PolynomialPower::from_reduced(&reduce(&body, 1).unwrap()), Response::compute(&body).unwrap());
        let gaps = [0.2, 0.1].map(|spin| {
            let motion = FreeRotation::at_logit(response.moments(), spin * 13.0, Mode::ShortAxis, 0.3);
            (response.mean_power(&motion) / polynomial.mean_power(&motion) - 1.0).abs()
        });
        println!("{gaps:?}");
        assert!(gaps[0] < 0.1 && (gaps[0] / gaps[1]).log2() > 1.5, "{gaps:?}");
    }
}
