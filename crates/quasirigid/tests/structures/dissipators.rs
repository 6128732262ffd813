//! Dissipators of a structure: names, and shares that sum to the whole.

use nalgebra::DMatrix;
use quasirigid::elements::{
    Anchor, Assembly, Connection, End, Frame, FrameNode, Material, Member, Network, NodeRef, Part, PartKind,
    PartReduction, SectionShape, Spring, SpringLaw,
};
use quasirigid::model::{FlexibleBody, Rheology};

use crate::support::matrices::dense;
use crate::support::parts;

/// Rounding relative to the largest entry of the whole.
const ROUNDING: f64 = 1e-12;

fn boom(name: &str, from: [f64; 3], to: [f64; 3], rheologies: &[Rheology], rayleigh: [f64; 2]) -> Part {
    let count = rheologies.len();
    let along = |i: usize| [0, 1, 2].map(|k| from[k] + (to[k] - from[k]) * i as f64 / count as f64);
    let node = |i: usize| FrameNode { name: format!("n{i}"), position: along(i) };
    let named =
        |rheology: &Rheology| if matches!(rheology, Rheology::KelvinVoigt { .. }) { "steel" } else { "" };
    let member = |(i, rheology): (usize, &Rheology)| Member {
        name: named(rheology).to_owned(),
        ends: [i, i + 1],
        section: SectionShape::Circle { radius: 0.05 },
        up: None,
        material: Material { density: 2700.0, young: 7e9, poisson: 0.3, rheology: rheology.clone() },
        elements: 2,
    };
    let nodes = (0..=count).map(node).collect();
    let members = rheologies.iter().enumerate().map(member).collect();
    let kind = PartKind::Frame(Frame { nodes, members });
    Part { name: name.to_owned(), kind, masses: Vec::new(), attached: Vec::new(), rayleigh }
}

fn hinge(from: Anchor, part: usize, damping: f64) -> Connection {
    let to = Anchor::Nodes { part, nodes: vec![0] };
    Connection {
        from,
        to,
        axes: vec![[0.3, 0.1, 1.0]],
        stiffness: vec![4000.0],
        damping: vec![damping],
        rheology: Rheology::Elastic,
    }
}

/// Booms of shared and of different materials on hinges, with a strut between them.
fn satellite() -> Assembly {
    let (steel, foam) = (Rheology::KelvinVoigt { time: 1e-3 }, Rheology::QualityFactor { factor: 30.0 });
    let mut parts = vec![
        boom("mast", [0.5, 0.1, 0.2], [2.0, 0.9, 0.4], &[steel.clone(), foam.clone()], [0.0; 2]),
        boom("arm", [-0.5, 0.2, 0.1], [-1.7, 1.0, 0.9], &[steel], [0.02, 0.0]),
        boom("pole", [0.1, -0.5, 0.3], [0.4, -2.1, 0.6], &[foam], [0.0, 2e-3]),
        boom("rod", [0.1, 0.3, 0.6], [0.2, 0.9, 1.6], &[Rheology::Elastic], [0.0; 2]),
    ];
    parts[3].attached = vec![0];
    parts[1].attached = vec![0];
    parts[2].attached = vec![0];
    let strut = parts::spring(
        End::Node(NodeRef { part: 0, node: 2 }),
        End::Node(NodeRef { part: 1, node: 1 }),
        SpringLaw::Axial {
            stiffness: 900.0,
            damping: 12.0,
            anchor: None,
            prestress: quasirigid::elements::Prestress::Relaxed,
        },
    );
    let carrier =
        parts::carrier(40.0, [0.1, -0.05, 0.02], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]]);
    Assembly {
        carrier: Some(carrier),
        parts,
        connections: vec![hinge(Anchor::Carrier, 0, 5.0)],
        springs: vec![strut.clone(), Spring { name: "tie".to_owned(), ..strut.clone() }, strut],
        reduction: PartReduction { order: 4, modes: 2 },
        ..Assembly::default()
    }
}

fn names(body: &FlexibleBody) -> Vec<&str> {
    body.dissipators().iter().map(|dissipator| dissipator.name.as_str()).collect()
}

/// Damping, and the viscoelastic stiffness of each rheology, of the dissipators and of the whole.
fn compare(body: &FlexibleBody) {
    let size = body.coordinates().len();
    let zero = DMatrix::<f64>::zeros(size, size);
    let sum = body.dissipators().iter().fold(zero.clone(), |sum, part| sum + dense(&part.damping));
    let whole = dense(body.damping());
    assert!((&sum - &whole).amax() <= ROUNDING * whole.amax(), "damping");
    for viscoelastic in body.viscoelastic() {
        let same = body.dissipators().iter().filter_map(|part| part.loss.as_ref());
        let same = same.filter(|loss| loss.rheology == viscoelastic.rheology);
        let sum = same.fold(zero.clone(), |sum, loss| sum + dense(&loss.stiffness));
        let whole = dense(&viscoelastic.stiffness);
        assert!((&sum - &whole).amax() <= ROUNDING * whole.amax(), "{:?}", viscoelastic.rheology);
    }
}

#[test]
fn dissipators_of_parts_sum_to_the_whole() {
    let body = satellite().body().unwrap();
    assert_eq!(
        names(&body),
        [
            "spring mast n2-arm n1",
            "tie",
            "spring mast n2-arm n1 2",
            "mast steel",
            "mast material 2",
            "arm",
            "pole",
            "connection carrier-mast"
        ]
    );
    compare(&body);
    compare(&body.stiffened(0.25).unwrap());
    assert!(
        body.dissipators()
            .iter()
            .all(|part| part.loss.is_none() || part.name == "mast material 2" || part.name == "pole")
    );
}

/// Share of a part: the dissipation of the body when all others dissipate nothing; the coordinates are kept, the losses left out.
#[test]
fn a_dissipator_alone_keeps_its_damping() {
    let whole = satellite().body().unwrap();
    let mut assembly = satellite();
    assembly.connections[0].damping = vec![10.0];
    assembly.springs.iter_mut().for_each(|spring| {
        if let SpringLaw::Axial { damping, .. } = &mut spring.law {
            *damping *= 2.0;
        }
    });
    let twice = assembly.body().unwrap();
    // The space of the coordinates holds the responses to each loss, and is the same for twice the dashpots up to rotations in it; traces
    // over the stiffness are not.
    let trace = |body: &FlexibleBody, name: &str| {
        let part = body.dissipators().iter().find(|part| part.name == name).unwrap();
        let stiffness = dense(body.stiffness()).cholesky().unwrap();
        stiffness.solve(&dense(&part.damping)).trace()
    };
    for (name, factor) in [("arm", 1.0), ("mast steel", 1.0), ("tie", 2.0), ("connection carrier-mast", 2.0)]
    {
        let ratio = trace(&twice, name) / trace(&whole, name);
        assert!((ratio / factor - 1.0).abs() < 1e-6, "{name} {ratio}");
    }
}

#[test]
fn springs_and_parts_of_a_body_without_a_carrier_have_their_names() {
    let mut assembly = satellite();
    assembly.carrier = None;
    assembly.connections = vec![
        hinge(Anchor::Nodes { part: 1, nodes: vec![0] }, 0, 5.0),
        hinge(Anchor::Nodes { part: 0, nodes: vec![0] }, 2, 0.0),
        hinge(Anchor::Nodes { part: 2, nodes: vec![0] }, 3, 3.0),
    ];
    assembly.parts.iter_mut().for_each(|part| part.attached.clear());
    let body = assembly.body().unwrap();
    compare(&body);
    for name in ["tie", "spring mast n2-arm n1 2", "connection arm-mast", "connection pole-rod", "arm"] {
        assert!(names(&body).contains(&name), "{name} in {:?}", names(&body));
    }
    assert!(!names(&body).contains(&"connection mast-pole") && !names(&body).contains(&"rod"));
}

#[test]
fn a_network_is_one_dissipator() {
    let network = Network {
        name: "rubble".to_owned(),
        mass: 3.0,
        semi_axes: [1.7, 1.1, 0.8],
        center: [0.3, -2.0, 0.7],
        spacing: 0.5,
        reach: 1.2,
        stiffness: 0.08,
        rheology: Rheology::KelvinVoigt { time: 0.3 },
        seed: 7,
    };
    let (points, springs) = network.parts(0);
    let body = Assembly { points, springs, ..Assembly::default() }.body().unwrap();
    assert_eq!(names(&body), ["rubble"]);
    compare(&body);
}
