//! Bodies whose parts are soft beside their spin.

use quasirigid::elements::{
    Assembly, Carrier, Frame, FrameNode, HingeCoefficient, Hinged, Material, Part, PartKind, PartReduction,
    Point, SectionShape, Spring, WheelSpeed,
};
use quasirigid::model::Rheology;
use quasirigid::prelude::CARRIER;

use crate::inside::bodies::{tank, wheel};
use crate::support::parts;
use crate::support::rotors::{ball, flywheel};

/// Two sprung masses, lowest frequencies 4.4 to 5.8 rad/s: the body of `manifold_at_spin.py` of the theory's prototype.
pub fn two_masses() -> Assembly {
    masses(1.0, 1.0)
}

fn masses(carrier: f64, held: f64) -> Assembly {
    let inertia = [9.0 * carrier, 13.0 * carrier, 16.0 * carrier];
    let mut body = Assembly::default().with(Carrier::principal(40.0 * carrier, inertia));
    let springs = [
        ("first", 2.0, [0.8, 0.3, 0.5], [60.0 * held, 90.0 * held, 70.0 * held], [3.0, 2.0, 4.0]),
        ("second", 1.5, [-0.6, 0.5, -0.2], [50.0 * held, 80.0 * held, 65.0 * held], [2.0, 3.0, 1.0]),
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
        angle: None,
    };
    Assembly { hinged: vec![boom], ..two_masses_without_points() }
}

fn two_masses_without_points() -> Assembly {
    Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]))
}

/// Carrier with a boom, a flywheel, a ball on friction and a momentum wheel (N·m·s).
pub fn rotors(angular_momentum: f64) -> Assembly {
    Assembly {
        rotors: vec![flywheel([0.3, 1.0, -0.5], 0.4, 0.6), ball(0.3, 0.5)],
        wheels: vec![wheel([1.0, 0.2, 4.0], WheelSpeed::Constant { angular_momentum })],
        ..hinged()
    }
}

/// Two sprung masses with a ball of liquid.
pub fn liquid() -> Assembly {
    Assembly { cavities: vec![tank([0.1, -0.2, 0.3], 0.3, 900.0, 0.05)], ..two_masses() }
}

/// Carrier with a slender beam whose material is a dashpot too, on curved paths, three degrees off the radius.
pub fn beam() -> Assembly {
    let node = |name: &str, position: [f64; 3]| FrameNode { name: name.to_owned(), position };
    let rheology = Rheology::KelvinVoigt { time: 0.02 };
    let material = Material { density: 1600.0, young: 9e9, poisson: 0.3, rheology };
    let member = parts::member([0, 1], SectionShape::Rectangle { height: 0.03, width: 0.02 }, material, 5);
    let nodes = vec![node("root", [0.3, -0.03, 0.04]), node("tip", [2.3, 0.07, -0.02])];
    let kind = PartKind::Frame(Frame { nodes, members: vec![member] });
    let part =
        Part { name: "beam".to_owned(), kind, masses: Vec::new(), attached: vec![0], rayleigh: [0.0; 2] };
    let reduction = PartReduction { order: 3, modes: 2 };
    Assembly { parts: vec![part], reduction, ..two_masses_without_points() }
}

/// Masses on springs too stiff to be pulled off by ten times the lowest frequency, a boom, a beam, rotors, a wheel (N·m·s) and a liquid, on a
/// carrier that keeps the spin across the beam.
pub fn everything(angular_momentum: f64) -> Assembly {
    let Assembly { parts, reduction, .. } = beam();
    let Assembly { hinged, rotors, wheels, .. } = rotors(angular_momentum);
    Assembly { hinged, rotors, wheels, cavities: liquid().cavities, parts, reduction, ..masses(20.0, 400.0) }
}
