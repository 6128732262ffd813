//! Rotors with friction against the body that contains them.

use quasirigid::elements::{Rotor, RotorKind};

pub fn flywheel(axis: [f64; 3], inertia: f64, friction: f64) -> Rotor {
    Rotor { name: "flywheel".into(), kind: RotorKind::Flywheel { axis }, inertia, friction, speed: None }
}

pub fn ball(inertia: f64, friction: f64) -> Rotor {
    Rotor { name: "ball".into(), kind: RotorKind::Sphere, inertia, friction, speed: None }
}
