//! Bushings against hinges, full springs, closed forms and welds. (I11)

use std::sync::Arc;

use nalgebra::{Matrix3, Rotation3, Vector3};
use quasirigid::elements::{
    Assembly, Bushing, Carrier, Coefficient, ElasticMaterial, ElementError, End, Field, Frame, FrameNode,
    HingeCoefficient, Hinged, NodeRef, Part, PartKind, PartReduction, PlaceRef, Problem, Region,
    SectionShape, Solid, Spring, SpringLaw, TipMass,
};
use quasirigid::mesh::{Cell, Mesh, Shape};
use quasirigid::model::Rheology;
use quasirigid::reduction::{frequencies, reduce};

use super::common::turned_axes;
use crate::support::parts;

type V = Vector3<f64>;

const HINGE: [f64; 3] = [0.9, -0.3, 0.4];
const ON_HINGE: End = End::Hinged(PlaceRef { hinged: 0, place: 0 });
const ON_BOOM: End = End::Hinged(PlaceRef { hinged: 0, place: 1 });

/// A carrier that hardly moves.
fn ground() -> Carrier {
    let inertia = parts::diag([1e12, 1e12, 1e12]);
    parts::carrier(1e12, [0.0; 3], inertia)
}

fn column(axis: usize) -> [f64; 3] {
    turned_axes().matrix().column(axis).into_owned().into()
}

/// Coefficient with these values along the rotated axes.
fn turned(values: [f64; 3]) -> Coefficient {
    let R = *turned_axes().matrix();
    let full = R * Matrix3::from_diagonal(&V::from(values)) * R.transpose();
    Coefficient::Full(std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (full[(i, j)] + full[(j, i)]))))
}

/// Bushing between the carrier and an end, in the rotated axes, without any coefficient.
fn bushing(to: End) -> Bushing {
    Bushing {
        name: String::new(),
        from: End::Carrier,
        to,
        center: None,
        axes: [column(0), column(1)],
        stiffness: [0.0; 3],
        rotational_stiffness: [0.0; 3],
        damping: [0.0; 3],
        rotational_damping: [0.0; 3],
        rheology: Rheology::Elastic,
    }
}

fn boom(axes: Vec<[f64; 3]>, stiffness: Vec<f64>, damping: Vec<f64>) -> Hinged {
    Hinged {
        name: "boom".into(),
        mass: 2.5,
        center_of_mass: [1.6, -0.5, 0.9],
        inertia: [[0.3, 0.02, 0.01], [0.02, 0.5, -0.04], [0.01, -0.04, 0.45]],
        hinge: HINGE,
        axes,
        stiffness: HingeCoefficient::PerAxis(stiffness),
        damping: HingeCoefficient::PerAxis(damping),
        rheology: Rheology::Elastic,
        places: vec![("root".into(), HINGE), ("tip".into(), [2.1, -0.8, 1.2])],
        angle: None,
    }
}

fn satellite(hinged: Hinged, bushings: Vec<Bushing>) -> Assembly {
    let carrier =
        parts::carrier(30.0, [0.1, 0.0, -0.2], [[9.0, 0.3, 0.1], [0.3, 8.0, 0.2], [0.1, 0.2, 11.0]]);
    Assembly { carrier: Some(carrier), hinged: vec![hinged], bushings, ..Assembly::default() }
}

/// Largest difference of the monomials of two bodies, relative to the largest, in the degrees 4 and 5.
fn difference(a: &Assembly, b: &Assembly) -> f64 {
    let [a, b] = [a, b].map(|assembly| reduce(&assembly.body().unwrap(), 4).unwrap());
    let degrees = [4, 5].map(|degree| {
        let (a, b) = (a.mu(degree), b.mu(degree));
        let row =
            |row: usize| a.row(row).iter().zip(b.row(row)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (0..3).map(row).fold(0.0, f64::max) / b.amax()
    });
    degrees.into_iter().fold(0.0, f64::max)
}

#[test]
fn springs_about_the_axes_of_a_hinge_are_a_bushing_in_it() {
    let axes = [0, 1, 2].map(column).to_vec();
    let (k, b) = ([40.0, 65.0, 90.0], [0.8, 0.3, 1.1]);
    let own = satellite(boom(axes.clone(), k.to_vec(), b.to_vec()), Vec::new());
    let in_it = Bushing { rotational_stiffness: k, rotational_damping: b, ..bushing(ON_HINGE) };
    let apart = satellite(boom(axes, vec![0.0; 3], vec![0.0; 3]), vec![in_it]);
    assert!(difference(&apart, &own) < 1e-12, "{:e}", difference(&apart, &own));
}

#[test]
fn a_bushing_at_a_point_is_a_full_spring() {
    let point = parts::free_point("mass", 1.3, [0.7, 1.1, -0.6]);
    let (k, b) = ([500.0, 800.0, 300.0], [4.0, 9.0, 2.0]);
    let law = SpringLaw::Spatial { stiffness: turned(k), damping: turned(b) };
    let spring =
        Spring { name: "s".into(), from: End::Carrier, to: End::Point(0), law, rheology: Rheology::Elastic };
    let base = satellite(boom(vec![column(0)], vec![200.0], vec![1.0]), Vec::new());
    let with_spring = Assembly { points: vec![point.clone()], springs: vec![spring], ..base.clone() };
    let bushing = Bushing { stiffness: k, damping: b, ..bushing(End::Point(0)) };
    let with_bushing = Assembly { points: vec![point], bushings: vec![bushing], ..base };
    assert!(difference(&with_bushing, &with_spring) < 1e-12);
}

/// One axis `a` through `h`, centre `c`: `K = Σ k_i (e_i·(a×(c−h)))² + κ_i (e_i·a)²` over the inertia about the axis.
#[test]
fn a_bushing_away_from_its_places_has_their_arms() {
    let axis = V::new(0.3, -0.8, 0.5).normalize();
    let (k, kappa) = ([500.0, 800.0, 300.0], [12.0, 3.0, 30.0]);
    let hinged = boom(vec![axis.into()], vec![0.0], vec![0.0]);
    let center = V::new(-0.4, 0.9, 1.7);
    let one = Bushing {
        center: Some(center.into()),
        stiffness: k,
        rotational_stiffness: kappa,
        ..bushing(ON_BOOM)
    };
    let assembly = Assembly { carrier: Some(ground()), ..satellite(hinged.clone(), vec![one]) };
    let moved = turned_axes().inverse() * axis.cross(&(center - V::from(HINGE)));
    let turned = turned_axes().inverse() * axis;
    let K: f64 = (0..3).map(|i| k[i] * moved[i].powi(2) + kappa[i] * turned[i].powi(2)).sum();
    let arm = axis.cross(&(V::from(hinged.center_of_mass) - V::from(HINGE)));
    let I = axis.dot(&(Matrix3::from(hinged.inertia) * axis)) + hinged.mass * arm.norm_squared();
    let found = frequencies(&assembly.body().unwrap()).unwrap()[0];
    assert!((found / (K / I).sqrt() - 1.0).abs() < 1e-9, "{found} {}", (K / I).sqrt());
}

/// Half the coefficients twice are the whole, and the order of the ends does not matter.
#[test]
fn bushings_add_up() {
    let hinged = boom(vec![column(0), column(2)], vec![10.0; 2], vec![0.1; 2]);
    let scaled = |by: f64| Bushing {
        center: Some([0.2, 0.4, -0.3]),
        stiffness: [500.0, 800.0, 300.0].map(|k| by * k),
        rotational_stiffness: [12.0, 3.0, 30.0].map(|k| by * k),
        damping: [2.0, 3.0, 1.0].map(|k| by * k),
        rotational_damping: [0.2, 0.1, 0.3].map(|k| by * k),
        ..bushing(ON_BOOM)
    };
    let whole = satellite(hinged.clone(), vec![scaled(1.0)]);
    let back = Bushing { from: ON_BOOM, to: End::Carrier, ..scaled(0.5) };
    assert!(difference(&satellite(hinged, vec![scaled(0.5), back]), &whole) < 1e-12);
}

const UPRIGHT: [[f64; 3]; 3] = parts::diag([1.0, 1.0, 1.0]);

const SECTION: SectionShape =
    SectionShape::General { area: 1e-4, second_y: 2e-9, second_z: 2e-9, torsion: 4e-9, shear: None };

/// Straight beam in the rotated axes, with a mass at its end.
fn beam(name: &str, turn: Rotation3<f64>, [from, to]: [V; 2], mass: Option<f64>, density: f64) -> Part {
    let node = |name: &str, place: V| FrameNode { name: name.into(), position: (turn * place).into() };
    let member = parts::member([0, 1], SECTION, parts::elastic(density, 70e9, 0.3), 8);
    let tip = mass.map(|mass| TipMass { node: 1, mass, inertia: parts::diag([1e-9, 1e-9, 1e-9]) });
    Part {
        name: name.into(),
        kind: PartKind::Frame(Frame {
            nodes: vec![node("root", from), node("tip", to)],
            members: vec![member],
        }),
        masses: tip.into_iter().collect(),
        attached: vec![0],
        rayleigh: [0.0; 2],
    }
}

/// A tip with a rotational spring: `k = 12 EI/L³ − (6 EI/L²)²/(4 EI/L + κ)` for a mass on a light cantilever.
#[test]
fn a_rotational_bushing_stiffens_the_tip_of_a_beam() {
    let (length, mass, EI) = (1.7, 0.8, 70e9 * 2e-9);
    for kappa in [0.0, 0.3 * EI / length, 4.0 * EI / length] {
        let turn = turned_axes();
        let boom =
            beam("boom", turn, [V::new(0.4, 0.2, -0.1), V::new(0.4 + length, 0.2, -0.1)], Some(mass), 1e-3);
        let spring =
            Bushing { rotational_stiffness: [kappa; 3], ..bushing(End::Node(NodeRef { part: 0, node: 1 })) };
        let assembly = Assembly {
            carrier: Some(ground()),
            parts: vec![boom],
            bushings: vec![spring],
            reduction: PartReduction { order: 3, modes: 4 },
            ..Assembly::default()
        };
        let k =
            12.0 * EI / length.powi(3) - (6.0 * EI / length.powi(2)).powi(2) / (4.0 * EI / length + kappa);
        let found = frequencies(&assembly.body().unwrap()).unwrap();
        for frequency in &found[..2] {
            let ratio = frequency / (k / mass).sqrt();
            assert!((ratio - 1.0).abs() < 1e-5, "{kappa}: {ratio}");
        }
    }
}

/// Two beams afloat in an L, joined at a corner.
fn corner(turn: Rotation3<f64>, stiffness: Option<f64>) -> Assembly {
    let corner = V::new(0.3, -0.6, 0.8);
    let mut parts = vec![
        beam("long", turn, [corner, corner + V::new(1.9, 0.0, 0.0)], Some(0.4), 2700.0),
        beam("short", turn, [corner, corner + V::new(0.0, 1.2, 0.3)], Some(0.3), 2700.0),
    ];
    parts.iter_mut().for_each(|part| part.attached.clear());
    let node = |part: usize| NodeRef { part, node: 0 };
    let mut assembly =
        Assembly { parts, reduction: PartReduction { order: 3, modes: 6 }, ..Assembly::default() };
    match stiffness {
        Some(k) => assembly.bushings.push(Bushing {
            from: End::Node(node(0)),
            to: End::Node(node(1)),
            center: Some((turn * (corner + V::new(0.2, 0.5, -0.4))).into()),
            axes: [V::new(1.0, 2.0, -0.5), V::new(0.1, 0.4, 1.0)].map(|axis| (turn * axis).into()),
            stiffness: [k, 2.0 * k, 3.0 * k],
            rotational_stiffness: [0.4 * k, 0.7 * k, 0.5 * k],
            ..bushing(End::Carrier)
        }),
        None => {
            let anchor = |part: usize| quasirigid::elements::Anchor::Nodes { part, nodes: vec![0] };
            assembly.connections.push(parts::weld(anchor(0), anchor(1)));
        }
    }
    assembly
}

#[test]
fn a_stiff_bushing_afloat_is_a_weld_and_a_soft_one_turns_with_the_body() {
    let lowest = |assembly: Assembly| frequencies(&assembly.body().unwrap()).unwrap()[0];
    let weld = lowest(corner(Rotation3::identity(), None));
    let stiff = lowest(corner(Rotation3::identity(), Some(3e7)));
    assert!((stiff / weld - 1.0).abs() < 1e-5, "{}", stiff / weld);
    let [soft, turned] = [Rotation3::identity(), turned_axes()].map(|turn| lowest(corner(turn, Some(30.0))));
    assert!(soft < 0.6 * weld, "{}", soft / weld);
    assert!((turned / soft - 1.0).abs() < 1e-9, "{}", turned / soft);
}

#[test]
fn bushings_that_cannot_be_are_refused() {
    let point = parts::free_point("mass", 1.3, [0.7, 1.1, -0.6]);
    let refusal = |bushing: Bushing| -> ElementError {
        let base = satellite(boom(vec![column(0)], vec![200.0], vec![1.0]), vec![bushing]);
        Assembly { points: vec![point.clone()], ..base }.check().remove(0)
    };
    let soft = Bushing { stiffness: [300.0; 3], ..bushing(End::Point(0)) };
    let off = refusal(Bushing { center: Some([0.7, 1.1, 0.0]), ..soft.clone() });
    assert!(matches!(off.problem, Problem::NoArm { .. }), "{off}");
    let bent = refusal(Bushing { rotational_damping: [0.0, 1.0, 0.0], ..soft.clone() });
    assert!(matches!(bent.problem, Problem::NoTurn { .. }), "{bent}");
    let flat = refusal(Bushing { axes: [[1.0, 2.0, 3.0], [-2.0, -4.0, -6.0]], ..soft.clone() });
    assert!(flat.field == Field::AXES && flat.problem == Problem::DependentAxes, "{flat}");
    let itself = refusal(Bushing { from: End::Point(0), ..soft.clone() });
    assert_eq!(itself.problem, Problem::SameEnds);
    let lost = refusal(Bushing { to: End::Point(7), ..soft.clone() });
    assert_eq!(lost.problem, Problem::NoSuchPoint { index: 7 });
    let negative = refusal(Bushing { stiffness: [1.0, -2.0, 3.0], ..soft.clone() });
    assert!(negative.field == Field::STIFFNESS, "{negative}");
    let mad = refusal(Bushing { rotational_stiffness: [f64::NAN; 3], ..bushing(ON_BOOM) });
    assert!(mad.field == Field::new("rotational_stiffness"), "{mad}");
}

/// A clamped beam whose tip a stiff bushing fixes to the carrier is clamped at both ends: `4.730² √(EI/ρA)/L²`.
#[test]
fn a_stiff_bushing_on_the_carrier_clamps_the_tip_of_a_beam() {
    let (length, density) = (1.7, 2700.0);
    let root = V::new(0.4, 0.2, -0.1);
    let boom = beam("boom", turned_axes(), [root, root + V::new(length, 0.0, 0.0)], None, density);
    let tip = End::Node(NodeRef { part: 0, node: 1 });
    let held = |k: f64| {
        let clamp = Bushing { stiffness: [k; 3], rotational_stiffness: [k; 3], ..bushing(tip) };
        let assembly = Assembly {
            carrier: Some(ground()),
            parts: vec![boom.clone()],
            bushings: vec![clamp],
            reduction: PartReduction { order: 3, modes: 6 },
            ..Assembly::default()
        };
        frequencies(&assembly.body().unwrap()).unwrap()[0]
    };
    let of = |root: f64| root.powi(2) * (70e9 * 2e-9 / (density * 1e-4)).sqrt() / length.powi(2);
    assert!((held(0.0) / of(1.875104) - 1.0).abs() < 1e-4, "{}", held(0.0) / of(1.875104));
    assert!((held(1e8) / of(4.730041) - 1.0).abs() < 3e-3, "{}", held(1e8) / of(4.730041));
}

/// A node of a solid has no rotations: a bushing at it is a full spring, and gives the solid no additional coordinate.
#[test]
fn a_bushing_at_a_node_of_a_solid_is_a_full_spring() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.4, 0.0], [0.0, 0.4, 0.0]];
    let place = |[x, y, z]: [f64; 3]| (turned_axes() * V::new(x + 0.2, y - 0.3, z + 0.5)).into();
    let nodes: Vec<[f64; 3]> =
        corners.iter().chain(&corners.map(|[x, y, _]| [x, y, 0.3])).map(|p| place(*p)).collect();
    let cell = Cell { label: 1, shape: Shape::Hex8, nodes: (0..8).collect() };
    let mesh = Mesh { nodes, node_labels: (1..=8).collect(), cells: vec![cell], sets: Vec::new() };
    let rubber = parts::elastic(1100.0, 2e6, 0.3);
    let region = Region {
        cells: vec![0],
        name: String::new(),
        material: ElasticMaterial::Isotropic(rubber),
        axes: UPRIGHT,
        grading: None,
    };
    let part = Part {
        name: "block".into(),
        kind: PartKind::Solid(Solid { mesh: Arc::new(mesh), regions: vec![region] }),
        masses: Vec::new(),
        attached: vec![1, 2, 5, 6],
        rayleigh: [0.0; 2],
    };
    let (k, b) = ([3e4, 8e4, 5e4], [40.0, 90.0, 20.0]);
    let base = Assembly {
        parts: vec![part],
        ..satellite(boom(vec![column(0)], vec![200.0], vec![1.0]), Vec::new())
    };
    // the last node of the structure: nothing follows it
    let corner = End::Node(NodeRef { part: 0, node: 7 });
    let with_bushing =
        Assembly { bushings: vec![Bushing { stiffness: k, damping: b, ..bushing(corner) }], ..base.clone() };
    let law = SpringLaw::Spatial { stiffness: turned(k), damping: turned(b) };
    let spring =
        Spring { name: "s".into(), from: End::Carrier, to: corner, law, rheology: Rheology::Elastic };
    let with_spring = Assembly { springs: vec![spring], ..base };
    let count = |assembly: &Assembly| assembly.body().unwrap().coordinates().len();
    assert_eq!(count(&with_bushing), count(&with_spring));
    assert!(difference(&with_bushing, &with_spring) < 1e-9, "{:e}", difference(&with_bushing, &with_spring));
}

/// Two booms about parallel axes: `K = Σ k_i E_i E_iᵀ` with `E = (−(a×(c−h₁), a), (a×(c−h₂), a))` over both inertias about the axis. (I11)
#[test]
fn a_bushing_between_two_booms_strains_by_the_difference() {
    let axis = V::new(0.3, -0.8, 0.5).normalize();
    let first = boom(vec![axis.into()], vec![70.0], vec![0.0]);
    let second = Hinged {
        name: "other".into(),
        hinge: [-0.6, 0.5, 0.2],
        mass: 1.9,
        places: vec![("root".into(), [-0.6, 0.5, 0.2]), ("tip".into(), [1.4, 0.3, -0.7])],
        ..first.clone()
    };
    let center = V::new(0.4, 0.1, 0.6);
    let (k, kappa) = ([500.0, 800.0, 300.0], [12.0, 3.0, 30.0]);
    let between = Bushing {
        from: ON_BOOM,
        center: Some(center.into()),
        stiffness: k,
        rotational_stiffness: kappa,
        ..bushing(End::Hinged(PlaceRef { hinged: 1, place: 1 }))
    };
    let both = [&first, &second].map(Clone::clone);
    let assembly = Assembly {
        carrier: Some(ground()),
        hinged: both.to_vec(),
        ..satellite(first.clone(), vec![between])
    };
    let E = both.clone().map(|boom| turned_axes().inverse() * axis.cross(&(center - V::from(boom.hinge))));
    let turn = turned_axes().inverse() * axis;
    let entry = |i: usize, j: usize| -> f64 {
        let sign = if i == j { 1.0 } else { -1.0 };
        let strain: f64 = (0..3).map(|n| k[n] * E[i][n] * E[j][n] + kappa[n] * turn[n].powi(2)).sum();
        sign * strain + if i == j { 70.0 } else { 0.0 }
    };
    let inertia = both.map(|boom| {
        let arm = axis.cross(&(V::from(boom.center_of_mass) - V::from(boom.hinge)));
        axis.dot(&(Matrix3::from(boom.inertia) * axis)) + boom.mass * arm.norm_squared()
    });
    let scaled = |i: usize, j: usize| entry(i, j) / (inertia[i] * inertia[j]).sqrt();
    let (mean, half) = (0.5 * (scaled(0, 0) + scaled(1, 1)), 0.5 * (scaled(0, 0) - scaled(1, 1)));
    let root = half.hypot(scaled(0, 1));
    let found = frequencies(&assembly.body().unwrap()).unwrap();
    for (frequency, square) in found.iter().zip([mean - root, mean + root]) {
        assert!((frequency / square.sqrt() - 1.0).abs() < 1e-9, "{frequency} {}", square.sqrt());
    }
}

/// Two points at one place: a bushing between them is a full spring, and pulls them in opposite senses.
#[test]
fn a_bushing_between_two_points_is_a_full_spring() {
    let point = |name: &str, mass: f64| parts::free_point(name, mass, [0.7, 1.1, -0.6]);
    let spatial = |from: End, to: End, k: [f64; 3], b: [f64; 3]| Spring {
        name: "s".into(),
        from,
        to,
        law: SpringLaw::Spatial { stiffness: turned(k), damping: turned(b) },
        rheology: Rheology::Elastic,
    };
    let (k, b) = ([500.0, 800.0, 300.0], [4.0, 9.0, 2.0]);
    let to_carrier = |index: usize, k: f64| spatial(End::Carrier, End::Point(index), [k; 3], [1.0; 3]);
    let base = Assembly {
        points: vec![point("a", 1.3), point("b", 0.4)],
        springs: vec![to_carrier(0, 700.0), to_carrier(1, 200.0)],
        ..satellite(boom(vec![column(0)], vec![200.0], vec![1.0]), Vec::new())
    };
    let mut with_spring = base.clone();
    with_spring.springs.push(spatial(End::Point(0), End::Point(1), k, b));
    let between = Bushing { from: End::Point(0), stiffness: k, damping: b, ..bushing(End::Point(1)) };
    let with_bushing = Assembly { bushings: vec![between], ..base };
    assert!(difference(&with_bushing, &with_spring) < 1e-12);
}

/// Nodes apart that a stiff bushing joins are one rigid piece, wherever its centre is, as if they were welded.
#[test]
fn a_stiff_bushing_between_nodes_apart_is_a_rigid_link() {
    let lowest = |center: Option<V>| {
        let mut assembly = corner(turned_axes(), center.map(|_| 3e8));
        let PartKind::Frame(frame) = &mut assembly.parts[1].kind else { unreachable!("beams") };
        for node in &mut frame.nodes {
            node.position = (V::from(node.position) + V::new(0.3, -0.2, 0.5)).into();
        }
        if let (Some(bushing), Some(center)) = (assembly.bushings.first_mut(), center) {
            bushing.center = Some(center.into());
        }
        frequencies(&assembly.body().unwrap()).unwrap()[0]
    };
    let weld = lowest(None);
    for center in [V::new(0.3, -0.6, 0.8), V::new(-0.2, 0.5, 0.1)] {
        let stiff = lowest(Some(center));
        assert!((stiff / weld - 1.0).abs() < 1e-5, "{}", stiff / weld);
    }
}
