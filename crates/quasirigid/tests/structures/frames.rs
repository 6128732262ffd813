//! Frames of beams on a carrier.

use quasirigid::elements::{
    Anchor, Assembly, Carrier, Connection, Field, Frame, FrameNode, HingeCoefficient, Hinged, Part, PartKind,
    PartReduction, Problem, SectionShape,
};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::reduction::reduce;

use crate::support::parts;

const ROOT: [f64; 3] = [0.6, -0.2, 0.4];
const TIP: [f64; 3] = [1.9, 0.9, 1.1];
/// Radius large enough that the rotary inertia of the sections counts: a thousandth of the inertia.
const RADIUS: f64 = 0.12;

fn carrier() -> Carrier {
    parts::carrier(40.0, [0.1, -0.05, 0.02], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]])
}

fn boom(young: f64, elements: usize) -> Part {
    let node = |name: &str, position| FrameNode { name: name.to_owned(), position };
    let material = parts::elastic(2700.0, young, 0.3);
    let section = SectionShape::Circle { radius: RADIUS };
    let kind = PartKind::Frame(Frame {
        nodes: vec![node("root", ROOT), node("tip", TIP)],
        members: vec![parts::member([0, 1], section, material, elements)],
    });
    Part { name: "boom".to_owned(), kind, masses: Vec::new(), attached: Vec::new(), rayleigh: [0.0; 2] }
}

/// The boom on a hinge, as beams that hardly bend.
fn of_beams(axes: &[[f64; 3]], stiffness: f64, damping: f64, young: f64, order: usize) -> FlexibleBody {
    let count = axes.len();
    let hinge = Connection {
        from: Anchor::Carrier,
        to: Anchor::Nodes { part: 0, nodes: vec![0] },
        axes: axes.to_vec(),
        stiffness: vec![stiffness; count],
        damping: vec![damping; count],
        rheology: Rheology::Elastic,
    };
    Assembly {
        carrier: Some(carrier()),
        parts: vec![boom(young, 3)],
        connections: vec![hinge],
        reduction: PartReduction { order, modes: 0 },
        ..Assembly::default()
    }
    .body()
    .unwrap()
}

/// The boom on a hinge, as a rigid cylinder.
fn of_a_rod(axes: &[[f64; 3]], stiffness: f64, damping: f64) -> FlexibleBody {
    let line = [0, 1, 2].map(|axis| TIP[axis] - ROOT[axis]);
    let length = line.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    let mass = 2700.0 * std::f64::consts::PI * RADIUS * RADIUS * length;
    let along = line.map(|entry| entry / length);
    let across = mass * (length * length / 12.0 + RADIUS * RADIUS / 4.0);
    let spin = mass * RADIUS * RADIUS / 2.0;
    let inertia = [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| if i == j { across } else { 0.0 } + (spin - across) * along[i] * along[j])
    });
    let hinged = Hinged {
        name: "boom".to_owned(),
        mass,
        center_of_mass: [0, 1, 2].map(|axis| 0.5 * (ROOT[axis] + TIP[axis])),
        inertia,
        hinge: ROOT,
        axes: axes.to_vec(),
        stiffness: HingeCoefficient::PerAxis(vec![stiffness; axes.len()]),
        damping: HingeCoefficient::PerAxis(vec![damping; axes.len()]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    Assembly { carrier: Some(carrier()), hinged: vec![hinged], ..Assembly::default() }.body().unwrap()
}

/// Two methods for one hinge: finite elements with a connection, their curved paths from the stress of the loads; and a rigid appendage
/// with its paths in closed form. All degrees up to the seventh agree as the beams stiffen; with two axes, which gimbals and a rotation
/// vector count differently, those up to the fifth.
#[test]
fn stiff_beams_on_a_hinge_are_a_hinged_appendage() {
    for (axes, order) in [(vec![[0.3, -0.8, 0.5]], 5), (vec![[0.3, -0.8, 0.5], [0.9, 0.4, 0.1]], 3)] {
        let all = of_a_rod(&axes, 90.0, 4.0);
        let expected = reduce(&all, order).unwrap().torque([0.9, 0.4, -0.3]);
        let error = |young: f64| {
            let few = of_beams(&axes, 90.0, 4.0, young, order);
            let found = reduce(&few, order).unwrap().torque([0.9, 0.4, -0.3]);
            let largest = expected.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
            (0..3).map(|axis| (found[axis] - expected[axis]).abs()).fold(0.0, f64::max) / largest
        };
        let errors = [1e9, 1e11].map(error);
        // Bending is in proportion to the compliance of the beams.
        assert!(errors[1] < 1e-5 && (errors[1] / errors[0] / 0.01 - 1.0).abs() < 0.1, "{errors:?}");
    }
}

/// A fourth axis is one too many, three are a ball joint.
#[test]
fn a_hinge_of_four_axes_is_refused() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
    let built = |count: usize| {
        let hinge = Connection {
            from: Anchor::Carrier,
            to: Anchor::Nodes { part: 0, nodes: vec![0] },
            axes: axes[..count].to_vec(),
            stiffness: vec![90.0; count],
            damping: vec![4.0; count],
            rheology: Rheology::Elastic,
        };
        let parts = vec![boom(1e9, 3)];
        Assembly { carrier: Some(carrier()), parts, connections: vec![hinge], ..Assembly::default() }.body()
    };
    assert!(built(3).is_ok());
    let error = built(4).unwrap_err();
    assert_eq!((error.field, error.problem), (Field::HINGE, Problem::AxisCount { count: 4 }));
}
