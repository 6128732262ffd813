//! Bodies whose parts are soft beside their spin.

use quasirigid::elements::{Assembly, Carrier, HingeCoefficient, Hinged, Point, Spring, WheelSpeed};
use quasirigid::model::Rheology;
use quasirigid::prelude::CARRIER;

use crate::inside::bodies::{tank, wheel};
use crate::support::rotors::{ball, flywheel};

/// Two sprung masses, lowest frequencies 4.4 to 5.8 rad/s: the body of `manifold_at_spin.py` of the theory's prototype.
pub fn two_masses() -> Assembly {
    let mut body = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    let springs = [
        ("first", 2.0, [0.8, 0.3, 0.5], [60.0, 90.0, 70.0], [3.0, 2.0, 4.0]),
        ("second", 1.5, [-0.6, 0.5, -0.2], [50.0, 80.0, 65.0], [2.0, 3.0, 1.0]),
    ];
    for (name, mass, position, stiffness, damping) in springs {
        let point = body.add(Point::new(name, mass, position));
        body.add(Spring::diagonal(stiffness, damping).between(point, CARRIER));
    }
    body
}

/// Carrier with a boom on a hinge of two axes: a curved path.
pub fn hinged() -> Assembly {
    let boom = Hinged {
        name: "boom".into(),
        mass: 1.8,
        center_of_mass: [1.1, 0.5, 0.3],
        inertia: [[0.02, -0.01, 0.0], [-0.01, 0.11, 0.005], [0.0, 0.005, 0.12]],
        hinge: [0.5, 0.2, 0.3],
        axes: vec![[0.0, 0.0, 1.0], [0.4, -0.9, 0.0]],
        stiffness: HingeCoefficient::PerAxis(vec![22.0, 35.0]),
        damping: HingeCoefficient::PerAxis(vec![1.1, 1.6]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
    };
    Assembly { hinged: vec![boom], ..two_masses_without_points() }
}

fn two_masses_without_points() -> Assembly {
    Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]))
}

/// Two sprung masses with a flywheel, a ball on friction and a momentum wheel.
pub fn rotors() -> Assembly {
    Assembly {
        rotors: vec![flywheel([0.3, 1.0, -0.5], 0.4, 0.6), ball(0.3, 0.5)],
        wheels: vec![wheel([1.0, 0.2, 4.0], WheelSpeed::Constant { angular_momentum: 5.0 })],
        ..two_masses()
    }
}

/// Two sprung masses with a ball of liquid.
pub fn liquid() -> Assembly {
    Assembly { cavities: vec![tank([0.1, -0.2, 0.3], 0.3, 900.0, 0.05)], ..two_masses() }
}

/// Masses, a boom, rotors, a wheel and a liquid.
pub fn everything() -> Assembly {
    Assembly { hinged: hinged().hinged, cavities: liquid().cavities, ..rotors() }
}
