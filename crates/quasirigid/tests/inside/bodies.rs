//! Bodies with internal rotors and liquids, off their axes.

use std::ops::ControlFlow;

use quasirigid::dynamics::{Forced, Form, Start};
use quasirigid::elements::{
    Assembly, Cavity, CavityShape, Coefficient, End, Point, Regime, Spring, SpringLaw, Wheel, WheelSpeed,
};
use quasirigid::verification::{VerificationPlan, verify};

use crate::support::parts;
use crate::support::rotors::{ball, flywheel};

/// A carrier alone.
pub fn bare() -> Assembly {
    Assembly {
        carrier: Some(parts::carrier(
            40.0,
            [0.02, 0.1, 0.4],
            [[9.0, 0.2, 0.0], [0.2, 13.0, -0.4], [0.0, -0.4, 16.0]],
        )),
        ..Assembly::default()
    }
}

/// A sprung mass.
pub fn sprung() -> (Point, Spring) {
    let point = parts::free_point("mass", 1.2, [0.8, 0.3, 0.9]);
    let law = parts::diagonal([900.0, 1000.0, 800.0], [48.0, 36.0, 40.0]);
    let spring = parts::spring(End::Point(0), End::Carrier, law);
    (point, spring)
}

pub fn wheel(axis: [f64; 3], speed: WheelSpeed) -> Wheel {
    Wheel { name: "wheel".into(), axis, speed }
}

pub fn start(omega: [f64; 3]) -> Start {
    let attitude = quasirigid_math::rotation::turned([1.0, 0.0, 0.0, 0.0], [0.3, -0.2, 0.4]);
    Start::new(omega, attitude)
}

pub fn cavity(semi_axes: [f64; 3], density: f64, viscosity: f64) -> Cavity {
    let attitude = quasirigid_math::rotation::turned([1.0, 0.0, 0.0, 0.0], [0.4, -0.7, 0.2]);
    let shape = CavityShape::Ellipsoid { semi_axes };
    let center = [0.1, -0.3, 0.2];
    Cavity {
        name: "tank".into(),
        shape,
        center,
        attitude,
        density,
        viscosity,
        resolution: 4,
        regime: Regime::default(),
        modes: 0,
    }
}

/// A ball of liquid in line with the axes.
pub fn tank(center: [f64; 3], radius: f64, density: f64, viscosity: f64) -> Cavity {
    let attitude = quasirigid_math::rotation::ALIGNED;
    Cavity { center, attitude, ..cavity([radius; 3], density, viscosity) }
}

/// Sprung masses, a flywheel, a ball, a wheel, and liquids in a ball and in an ellipsoid, none in line with another.
pub fn everything() -> Assembly {
    let (point, spring) = sprung();
    let other = Point { name: "other".into(), mass: 0.7, position: [-0.5, 0.9, -0.2], ..point.clone() };
    let law = SpringLaw::Spatial {
        stiffness: Coefficient::Isotropic(600.0),
        damping: Coefficient::Diagonal([20.0, 30.0, 25.0]),
    };
    let between = Spring { from: End::Point(1), to: End::Point(0), law, ..spring.clone() };
    let held = Spring { from: End::Point(1), ..spring.clone() };
    let round =
        Cavity { name: "round".into(), center: [0.4, 0.2, -0.5], modes: 1, ..cavity([0.3; 3], 400.0, 0.2) };
    Assembly {
        points: vec![point, other],
        springs: vec![spring, between, held],
        rotors: vec![flywheel([0.3, 1.0, -0.5], 1.1, 12.0), ball(0.7, 9.0)],
        wheels: vec![wheel([1.0, 0.2, 0.4], WheelSpeed::Constant { angular_momentum: 6.0 })],
        cavities: vec![cavity([0.4, 0.3, 0.2], 500.0, 0.1), round],
        ..bare()
    }
}

/// Measured orders of `p = 0, 1, …`.
pub fn orders(assembly: &Assembly, omega: [f64; 3], highest: usize) -> Vec<f64> {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let system = Forced { body: &body, forces: &forces };
    let plan = VerificationPlan {
        orders: (0..=highest).collect(),
        rotations: 1.0,
        halvings: 3,
        samples: 40,
        forms: vec![Form::AngularMomentum],
    };
    let verification = verify(system, &start(omega), &plan, &mut |_| ControlFlow::Continue(())).unwrap();
    for row in &verification.rows {
        let gaps: Vec<f64> = row.differences.iter().map(|difference| difference.omega).collect();
        println!("p = {}: {:?} {gaps:?}", row.p, row.order);
    }
    verification.rows.iter().map(|row| row.order.unwrap()).collect()
}
