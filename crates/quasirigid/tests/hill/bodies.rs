//! Bodies and motions that the tests share.

use quasirigid::averaging::{FreeRotation, HillResponse};
use quasirigid::dynamics::FullState;
use quasirigid::elements::{Assembly, End, Point, PointMotion as Line};
use quasirigid::model::{FlexibleBody, Mode, MotionState, Principal};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::sym3;
use quasirigid_math::vec3;

use crate::support::parts;

/// A motion with a mean spin of about `spin` (rad/s).
pub fn motion(body: &FlexibleBody, spin: f64, mode: Mode, xi: f64) -> FreeRotation {
    let moments = Principal::compute(body.invariants().J).moments;
    FreeRotation::at_logit(moments, spin * moments[mode.circled()], mode, xi)
}

/// Two masses on skew lines, far from every axis, on a carrier without symmetry: masses (kg), stiffnesses (N/m), damping ratio.
pub fn skew(masses: [f64; 2], stiffness: [f64; 2], ratio: f64) -> Assembly {
    lines([[0.3, -0.4, 0.9], [0.8, 0.5, 0.2]], masses, stiffness, ratio)
}

/// Two masses on given lines.
pub fn lines(line: [[f64; 3]; 2], masses: [f64; 2], stiffness: [f64; 2], ratio: f64) -> Assembly {
    let place = [[0.9, 0.3, 0.4], [-0.5, 0.8, -0.6]];
    let point = |i: usize| Point {
        name: format!("mass {i}"),
        mass: masses[i],
        position: place[i],
        motion: Line::Line(line[i]),
    };
    let spring = |i: usize| {
        parts::spring(
            End::Point(i),
            End::Carrier,
            parts::isotropic(stiffness[i], 2.0 * ratio * (masses[i] * stiffness[i]).sqrt()),
        )
    };
    Assembly {
        carrier: Some(parts::carrier(
            30.0,
            [0.1, -0.2, 0.05],
            [[9.0, 0.3, -0.2], [0.3, 12.0, 0.5], [-0.2, 0.5, 16.0]],
        )),
        points: (0..2).map(point).collect(),
        springs: (0..2).map(spring).collect(),
        ..Assembly::default()
    }
}

/// Angular velocity and state of a full run whose angular momentum is that of a motion at its start.
pub fn full_start(body: &FlexibleBody, hill: &HillResponse, motion: &FreeRotation) -> FullState {
    let (q, rate) = hill.state(motion, 0.0).unwrap();
    let J = body.invariants().J;
    let K = sym3::times(J, hill.principal().vector(motion.omega(0.0)));
    let inside = body.angular_momentum(MotionState { omega: [0.0; 3], q: &q, rate: &rate });
    let left = vec3::add(K, vec3::scale(-1.0, inside));
    let omega = sym3::times(sym3::inverse(body.inertia_at(&q)), left);
    FullState { q, rate, ..FullState::at_rest(body, omega, ALIGNED) }
}
