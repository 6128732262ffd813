//! Secular evolution of bodies of revolution, against laws in closed form.

use std::f64::consts::PI;

use quasirigid::averaging::{Evolution, MeanPower, PolynomialPower, Response, RotationState};
use quasirigid::elements::{Assembly, Carrier, Cavity, CavityShape, End, Point, Regime};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;

use crate::support::parts;
use crate::support::rotors::{ball, flywheel};

const DENSITY: f64 = 1261.0;
const VISCOSITY: f64 = 12.0;

/// A carrier with a ball of a very viscous liquid at its middle.
fn tank(carrier: Carrier, radius: f64) -> Assembly {
    let tank = Cavity {
        name: "tank".into(),
        shape: CavityShape::Ellipsoid { semi_axes: [radius; 3] },
        center: carrier.center_of_mass,
        attitude: ALIGNED,
        density: DENSITY,
        viscosity: VISCOSITY,
        resolution: 1,
        regime: Regime::default(),
        modes: 0,
    };
    Assembly { carrier: Some(carrier), cavities: vec![tank], ..Assembly::default() }
}

fn moments(body: &FlexibleBody) -> [f64; 2] {
    let J = body.inertia();
    [J[0][0], J[2][2]]
}

/// `(ρ/ν) P` of a ball.
fn liquid(radius: f64) -> f64 {
    DENSITY / VISCOSITY * 8.0 * PI * radius.powi(7) / 525.0
}

fn rotation_state(evolution: &Evolution<impl MeanPower>, angle: f64) -> RotationState {
    let rotation_state = evolution.wobbling(angle).unwrap();
    assert_eq!(rotation_state.mode, Mode::ShortAxis);
    rotation_state
}

/// `tan θ = tan θ₀ e^{−Γt}`, `Γ = (ρP/ν)(C − A)K²/(A³C)`, over ten e-foldings.
#[test]
fn the_tangent_of_the_angle_falls_exponentially() {
    let inertia = parts::diag([3.0, 3.0, 4.2]);
    let assembly = tank(parts::carrier(30.0, [0.1, -0.2, 0.4], inertia), 0.11);
    let body = assembly.body().unwrap();
    let [A, C] = moments(&body);
    let K = 2.7;
    let rate = liquid(0.11) * (C - A) * K * K / (A.powi(3) * C);
    let power = PolynomialPower::from_reduced(&reduce(&body, 1).unwrap());
    let evolution = Evolution::new(&power, K);
    let (first, last) = (80.0_f64.to_radians(), (80.0_f64.to_radians().tan() * (-10.0_f64).exp()).atan());
    for folds in [0.5, 3.0, 10.0] {
        let angle = (first.tan() * f64::exp(-folds)).atan();
        let time = evolution.time(rotation_state(&evolution, first), rotation_state(&evolution, angle));
        assert!((time * rate / folds - 1.0).abs() < 1e-8, "{folds}: {}", time * rate / folds - 1.0);
    }
    let whole = evolution.time(rotation_state(&evolution, first), rotation_state(&evolution, last));
    assert!((whole * rate / 10.0 - 1.0).abs() < 1e-8);
}

const SPRUNG: f64 = 0.9;
const STIFF: f64 = 4.0e7;
const TIME: f64 = 6.0e-5;
const DROP: f64 = 0.03;
const RING: f64 = 1.3;
const AXIAL: f64 = 0.7;

/// Body with a ring of six sprung masses, one on the axis, a ball of liquid, and a ball and three flywheels with friction.
fn everything() -> Assembly {
    let point = |position: [f64; 3], name: String| parts::free_point(name, SPRUNG, position);
    let ring = (0..6).map(|i| {
        let (sin, cos) = (f64::from(i) * PI / 3.0 + 0.2).sin_cos();
        point([RING * cos, RING * sin, 0.0], format!("ring {i}"))
    });
    let points: Vec<Point> = ring.chain([point([0.0, 0.0, AXIAL], "axis".into())]).collect();
    let law = parts::isotropic(STIFF, TIME * STIFF);
    let spring = |i: usize| parts::spring(End::Point(i), End::Carrier, law);
    let springs = (0..points.len()).map(spring).collect();
    let mass = 30.0;
    let inertia = parts::diag([30.0, 30.0, 44.0]);
    let liquid = DENSITY * 4.0 / 3.0 * PI * DROP.powi(3);
    let low = -SPRUNG * AXIAL / (mass + liquid);
    let rotors = vec![ball(1.1e-4, 120.0)]
        .into_iter()
        .chain(parts::diag([1.0, 1.0, 1.0]).into_iter().enumerate().map(|(i, axis)| {
            let mut rotor = flywheel(axis, 0.9e-4, 150.0);
            rotor.name = format!("flywheel {i}");
            rotor
        }))
        .collect();
    let tank = tank(parts::carrier(mass, [0.0, 0.0, low], inertia), DROP);
    Assembly { points, springs, rotors, ..tank }
}

/// `u̇ = 2(C−A)K²/(A³C) · u(1−u) · [Π + K² τ (k₁₃ u/C² + k₁₂ (1−u)/A²)]` with `u = cos²θ`: liquid, ball, flywheels, ring and
/// axial mass at once.
#[test]
fn every_mechanism_adds_to_the_law_of_bodies_of_revolution() {
    let body = everything().body().unwrap();
    let [A, C] = moments(&body);
    assert!(body.center_of_mass().iter().all(|entry| entry.abs() < 1e-14));
    let K = 90.0;
    let lever = SPRUNG * SPRUNG / STIFF;
    let ring = 6.0 * lever * RING * RING;
    let k13 = ring * (2.0 * A - C).powi(2) / (2.0 * A * A) + lever * (AXIAL * C / A).powi(2);
    let Pi = liquid(DROP) + 1.1e-4 * 1.1e-4 / 120.0 + 0.9e-4 * 0.9e-4 / 150.0;
    let slowness = |u: f64| {
        let elastic = K * K * TIME * (k13 * u / (C * C) + ring * (1.0 - u) / (A * A));
        assert!(elastic > 0.01 * Pi && elastic < 100.0 * Pi, "all mechanisms matter");
        A.powi(3) * C / (2.0 * (C - A) * K * K * (Pi + elastic))
    };
    let square = |angle: f64| angle.cos().powi(2);
    let [from, to] = [75.0_f64, 2.0].map(f64::to_radians);
    // With x = ln(u/(1−u)) the factor u(1−u) is gone; Simpson's rule.
    let logit = |angle: f64| (square(angle) / (1.0 - square(angle))).ln();
    let (low, high, steps) = (logit(from), logit(to), 4000);
    let h = (high - low) / f64::from(steps);
    let expected: f64 = (0..=steps)
        .map(|i| {
            let weight = if i == 0 || i == steps {
                1.0
            } else if i % 2 == 1 {
                4.0
            } else {
                2.0
            };
            weight * h / 3.0 * slowness(1.0 / (1.0 + (-(low + h * f64::from(i))).exp()))
        })
        .sum();
    let polynomial = PolynomialPower::from_reduced(&reduce(&body, 3).unwrap());
    let response = Response::compute(&body).unwrap();
    for power in [&polynomial as &dyn MeanPower, &response] {
        let evolution = Evolution::new(power, K);
        let time = evolution.time(rotation_state(&evolution, from), rotation_state(&evolution, to));
        assert!((time / expected - 1.0).abs() < 1e-8, "{:e}", time / expected - 1.0);
    }
}
