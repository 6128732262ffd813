//! Nodes that follow others: masses on rigid arms, and hinges on parts that rotate, in a spin and under a thrust. (K19)

use nalgebra::{Complex, DMatrix, Matrix2, Matrix3, Rotation3, Unit, Vector3};
use quasirigid::elements::{
    Anchor, ApplicationPoint, Assembly, Connection, End, Frame, FrameNode, Material, Member, NodeRef, Part,
    PartKind, PartReduction, SectionShape, TipMass,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{Rheology, Support};

use super::buckling::frequencies_at;
use super::common::turned_axes;
use crate::support::parts;

type V = Vector3<f64>;

const ROOT: [f64; 3] = [0.4, -1.1, 0.7];
const SPIN: f64 = 3.0;

fn place(at: V) -> V {
    V::from(ROOT) + turned_axes() * at
}

/// A line of members through places in the body's own axes, each with its material.
fn frame(name: &str, places: &[V], materials: &[Material], width: f64) -> Part {
    let node = |(i, at): (usize, &V)| FrameNode { name: format!("{i}"), position: place(*at).into() };
    let member = |(i, material): (usize, &Material)| Member {
        name: String::new(),
        ends: [i, i + 1],
        section: SectionShape::Rectangle { height: width, width },
        up: Some((turned_axes() * V::new(0.3, 1.0, 0.7)).into()),
        material: material.clone(),
        elements: 6,
    };
    let nodes = places.iter().enumerate().map(node).collect();
    let members = materials.iter().enumerate().map(member).collect();
    let kind = PartKind::Frame(Frame { nodes, members });
    Part { name: name.to_owned(), kind, masses: Vec::new(), attached: Vec::new(), rayleigh: [0.0; 2] }
}

fn on_hub(parts: Vec<Part>, connections: Vec<Connection>, forces: Vec<Force<ApplicationPoint>>) -> Assembly {
    let J = turned_axes() * Matrix3::from_diagonal(&V::new(1e9, 1e9, 1.2e9)) * turned_axes().inverse();
    let hub = parts::carrier(1e9, ROOT, (0.5 * (J + J.transpose())).into());
    let reduction = PartReduction { order: 3, modes: 8 };
    let support = Support::FixedPoint { point: ROOT };
    Assembly { carrier: Some(hub), parts, connections, forces, reduction, support, ..Assembly::default() }
}

fn nodes(part: usize, node: usize) -> Anchor {
    Anchor::Nodes { part, nodes: vec![node] }
}

/// A mass beside the tip of a boom on a rigid arm, as a node that is welded on at a distance and as one at the end of a stiff member.
#[test]
fn a_mass_on_a_rigid_arm_is_one_on_a_stiff_member() {
    let soft = parts::elastic(1000.0, 2e9, 0.3);
    let stiff = parts::elastic(1e-3, 2e14, 0.3);
    let ends = |across: V| [V::zeros(), V::new(4.0, 0.0, 0.0), V::new(4.9, 0.0, 0.0) + across];
    let (straight, bent) = (ends(V::zeros()), ends(V::new(0.0, 0.3, -0.2)));
    let mass = |node| TipMass { node, mass: 3.0, inertia: parts::diag([0.02, 0.03, 0.04]) };
    let thrust = |part, node, push: f64| {
        let law = ForceLaw::Thrust {
            at: ApplicationPoint { on: End::Node(NodeRef { part, node }), at: None },
            force: (turned_axes() * V::new(-push, 0.0, 0.0)).into(),
            axes: Axes::Body,
            wave: Wave::default(),
        };
        vec![Force { name: "thrust".into(), law }]
    };
    let welded = |ends: &[V; 3], push| {
        let boom = Part { attached: vec![0], ..frame("boom", &ends[..2], std::slice::from_ref(&soft), 0.08) };
        let tip = Part { masses: vec![mass(0)], ..frame("tip", &ends[2..], &[], 0.08) };
        on_hub(vec![boom, tip], vec![parts::weld(nodes(0, 1), nodes(1, 0))], thrust(1, 0, push))
    };
    let on_member = |ends: &[V; 3], push| {
        let own = frame("boom", ends, &[soft.clone(), stiff.clone()], 0.08);
        let part = Part { attached: vec![0], masses: vec![mass(2)], ..own };
        on_hub(vec![part], Vec::new(), thrust(0, 2, push))
    };
    let cases = [(&bent, 0.0, 0.0), (&bent, SPIN, 0.0), (&straight, 0.0, 60.0), (&straight, SPIN, -40.0)];
    for (ends, spin, push) in cases {
        let [found, expected] =
            [welded(ends, push), on_member(ends, push)].map(|assembly| frequencies_at(&assembly, spin));
        for (found, expected) in found.iter().zip(&expected).take(5) {
            assert!((found / expected - 1.0).abs() < 2e-4, "{spin} rad/s, {push} N: {found} for {expected}");
        }
    }
    let [still, spun] = [0.0, SPIN].map(|spin| frequencies_at(&welded(&bent, 0.0), spin)[1]);
    assert!(spun > 1.1 * still, "{still} {spun}");
}

/// Two stiff parts on two hinges about different axes, the second in the end of the first: exact positions of both angles, with the
/// derivatives of kinetic energy and springs by differences.
#[test]
fn a_hinge_on_a_rotating_part_has_the_motions_of_its_linkage() {
    let rigid = parts::elastic(500.0, 1e15, 0.3);
    let width = 0.02;
    let first = [V::zeros(), V::new(1.5, 0.2, 0.0)];
    let second = [first[1], V::new(2.1, 0.5, 0.4), V::new(2.3, -0.4, 0.9)];
    let axes = [V::new(0.2, 0.1, 1.0).normalize(), V::new(0.1, 1.0, -0.3).normalize()];
    let stiffness = [30.0, 14.0];
    let hinge = |from, to, i: usize| Connection {
        from,
        to,
        axes: vec![(turned_axes() * axes[i]).into()],
        stiffness: vec![stiffness[i]],
        damping: vec![0.0],
        rheology: Rheology::Elastic,
    };
    let parts = vec![
        frame("first", &first, std::slice::from_ref(&rigid), width),
        frame("second", &second, &[rigid.clone(), rigid.clone()], width),
    ];
    let hinges = vec![hinge(Anchor::Carrier, nodes(0, 0), 0), hinge(nodes(0, 1), nodes(1, 0), 1)];
    let assembly = on_hub(parts, hinges, Vec::new());
    let points: Vec<(usize, f64, V)> =
        [(0, first[0], first[1]), (1, second[0], second[1]), (1, second[1], second[2])]
            .iter()
            .flat_map(|(part, from, to)| {
                let mass = 500.0 * width * width * (to - from).norm() / 200.0;
                (0..200).map(move |i| (*part, mass, from + (to - from) * ((f64::from(i) + 0.5) / 200.0)))
            })
            .collect();
    let turn = |i: usize, angle: f64| Rotation3::from_axis_angle(&Unit::new_unchecked(axes[i]), angle);
    let at = |(part, _, p): &(usize, f64, V), q: [f64; 2]| {
        let outer = if *part == 1 { first[1] + turn(1, q[1]) * (p - first[1]) } else { *p };
        turn(0, q[0]) * outer
    };
    for spin in [0.3, 1.0] {
        let omega = V::new(0.0, 0.0, spin);
        let potential = |q: [f64; 2]| {
            let springs = 0.5 * (stiffness[0] * q[0] * q[0] + stiffness[1] * q[1] * q[1]);
            springs
                - points
                    .iter()
                    .map(|point| 0.5 * point.1 * omega.cross(&at(point, q)).norm_squared())
                    .sum::<f64>()
        };
        let h = 1e-3;
        let moved =
            |q: [f64; 2], j: usize, by: f64| if j == 0 { [q[0] + by, q[1]] } else { [q[0], q[1] + by] };
        let slope =
            |q: [f64; 2], j: usize| (potential(moved(q, j, h)) - potential(moved(q, j, -h))) / (2.0 * h);
        let hessian = |q: [f64; 2]| {
            Matrix2::from_fn(|j, k| (slope(moved(q, k, h), j) - slope(moved(q, k, -h), j)) / (2.0 * h))
        };
        let mut q = [0.0; 2];
        for _ in 0..20 {
            let step = hessian(q).try_inverse().unwrap() * nalgebra::Vector2::new(slope(q, 0), slope(q, 1));
            q = [q[0] - step[0], q[1] - step[1]];
        }
        let rates = |point: &(usize, f64, V)| {
            [0, 1].map(|j| (at(point, moved(q, j, h)) - at(point, moved(q, j, -h))) / (2.0 * h))
        };
        let (mut M, mut G) = (Matrix2::zeros(), Matrix2::zeros());
        for point in &points {
            let u = rates(point);
            M += Matrix2::from_fn(|j, k| point.1 * u[j].dot(&u[k]));
            G += Matrix2::from_fn(|j, k| 2.0 * point.1 * u[j].dot(&omega.cross(&u[k])));
        }
        let expected = vibrations(&M, &G, &hessian(q));
        let found = frequencies_at(&assembly, spin);
        println!("{spin} rad/s, at {q:?}: {:?}, the linkage {expected:?}", &found[..2]);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-3, "{spin} rad/s: {found} for {expected}");
        }
    }
}

/// Frequencies of `M q̈ + G q̇ + K q = 0`, lowest first.
fn vibrations(M: &Matrix2<f64>, G: &Matrix2<f64>, K: &Matrix2<f64>) -> Vec<f64> {
    let inverse = M.try_inverse().unwrap();
    let mut matrix = DMatrix::zeros(4, 4);
    matrix.view_mut((0, 2), (2, 2)).copy_from(&Matrix2::identity());
    matrix.view_mut((2, 0), (2, 2)).copy_from(&(-inverse * K));
    matrix.view_mut((2, 2), (2, 2)).copy_from(&(-inverse * G));
    let values: Vec<Complex<f64>> = matrix.complex_eigenvalues().iter().copied().collect();
    let mut found: Vec<f64> = values.iter().map(|value| value.im).filter(|im| *im > 0.0).collect();
    found.sort_by(f64::total_cmp);
    found
}
