//! Modes from another program: all of them together are the body whose matrices they come from.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use quasirigid::elements::{
    Anchor, Assembly, Carrier, Connection, ElementError, GivenModes, Part, PartKind, PartReduction, Problem,
    Spectrum, TipMass,
};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::reduction::reduce;

use super::common::vector_error;
use super::exported::{Body, ExportedModes, NODES, RATIO, entries};
use crate::support::parts;

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn carrier() -> Carrier {
    parts::carrier(40.0, [0.1, -0.05, 0.02], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]])
}

fn build(
    kind: PartKind,
    carrier: Option<Carrier>,
    connections: Vec<Connection>,
    order: usize,
) -> Result<FlexibleBody, ElementError> {
    let part = Part {
        name: "wing".to_owned(),
        kind,
        masses: Vec::new(),
        attached: Vec::new(),
        rayleigh: [0.02, 1e-3],
    };
    Assembly {
        carrier,
        parts: vec![part],
        connections,
        reduction: PartReduction { order, modes: 0 },
        ..Assembly::default()
    }
    .body()
}

/// Two bodies have the same mass, inertia and reduced equations.
fn assert_same(found: &FlexibleBody, expected: &FlexibleBody, order: usize) {
    assert!((found.invariants().mass / expected.invariants().mass - 1.0).abs() < 1e-14);
    let vectors = |body: &FlexibleBody| body.inertia();
    for (found, expected) in vectors(found).into_iter().zip(vectors(expected)) {
        assert!(vector_error(found, expected) < 1e-12);
    }
    let (found, expected) = (reduce(found, order).unwrap(), reduce(expected, order).unwrap());
    for omega in [[0.9, 0.4, -0.3], [0.2, -1.1, 0.7]] {
        let error = vector_error(found.torque(omega), expected.torque(omega));
        assert!(error < 1e-9, "order {order}: {error:e}");
    }
}

/// Part of modes; the scale of each shape is arbitrary.
fn of_modes(body: &Body, found: &ExportedModes, kept: impl Fn(usize) -> bool) -> PartKind {
    let kept: Vec<usize> = (0..found.frequencies.len()).filter(|mode| kept(*mode)).collect();
    let shapes = found.shapes.select_columns(&kept);
    let scaled = DMatrix::from_fn(shapes.nrows(), shapes.ncols(), |row, mode| {
        shapes[(row, mode)] * (0.3 + mode as f64) * if mode % 2 == 0 { 1.0 } else { -1.0 }
    });
    PartKind::Modes(GivenModes {
        mass: body.mass.clone(),
        shapes: rows(&scaled),
        interface: Vec::new(),
        spectrum: Spectrum::Modes {
            frequencies: kept.iter().map(|mode| found.frequencies[*mode]).collect(),
            damping_ratios: vec![RATIO; kept.len()],
        },
        rheology: Rheology::Elastic,
    })
}

#[test]
fn all_modes_are_the_body_on_a_carrier() {
    let body = Body::new(7, false).held();
    for order in [3, 4, 5] {
        let matrices = build(body.matrices(0), Some(carrier()), Vec::new(), order).unwrap();
        let modes = of_modes(&body, &body.modes(0), |_| true);
        assert_same(&build(modes, Some(carrier()), Vec::new(), order).unwrap(), &matrices, order);
    }
}

#[test]
fn all_free_modes_are_the_body_without_a_carrier() {
    let body = Body::new(8, true);
    let found = body.modes(0);
    let elastic = |mode: usize| found.frequencies[mode] > 1e-3;
    assert_eq!((0..6 * NODES).filter(|mode| elastic(*mode)).count(), 6 * NODES - 6);
    // At order 4 the torque distinguishes their frames, which differ by a rotation of the second degree in the coordinates.
    let matrices = build(body.matrices(0), None, Vec::new(), 3).unwrap();
    let modes = build(of_modes(&body, &found, elastic), None, Vec::new(), 3).unwrap();
    assert_same(&modes, &matrices, 3);
}

/// Nodes on arms that rotate carry the whole along by `½ J⁻¹ Σ Y_jk q_j q_k`, with `Y` the symmetric part of `Z`. Of a floating body the
/// frame goes with it, the frame of modes does not. So the energy to the sixth degree is the same at spins that differ by this rotation and
/// its rate: the difference is of a higher one.
#[test]
fn a_floating_frame_follows_the_second_order() {
    let body = Body::new(8, true);
    let found = body.modes(0);
    let whole = build(body.matrices(0), None, Vec::new(), 4).unwrap();
    let modes = of_modes(&body, &found, |mode| found.frequencies[mode] > 1e-3);
    let modes = build(modes, None, Vec::new(), 4).unwrap();
    let [whole, of_modes] = [&whole, &modes].map(|body| reduce(body, 4).unwrap());
    let inertia = Matrix3::from_fn(|i, j| modes.inertia()[i][j]).try_inverse().unwrap();
    let turn = |q: &[f64], p: &[f64]| -> Vector3<f64> {
        let pairs = modes.invariants().pairs.iter();
        let carried = pairs.map(|(j, k, pair)| Vector3::from(pair.Z) * 0.5 * (q[j] * p[k] + q[k] * p[j]));
        inertia * carried.sum::<Vector3<f64>>()
    };
    let gap = |size: f64, turned: bool| {
        let omega = size * Vector3::new(0.9, 0.4, -0.3);
        let (mut q, mut rate) = (vec![0.0; modes.coordinates().len()], vec![0.0; modes.coordinates().len()]);
        of_modes.q.part(2).add_value(omega.into(), &mut q);
        of_modes.rate.part(3).add_value(omega.into(), &mut rate);
        let there = if turned { omega - (0.5 * turn(&q, &q)).cross(&omega) + turn(&q, &rate) } else { omega };
        let energies = [(&whole, there), (&of_modes, omega)]
            .map(|(reduced, omega)| reduced.energy.truncated(6).scalar::<f64>(omega.into()));
        (energies[0] - energies[1]).abs()
    };
    let degree = |turned: bool| (gap(2.0, turned) / gap(1.0, turned)).log2();
    println!("degree of the gap {:.2}, without the turn {:.2}", degree(true), degree(false));
    assert!(degree(true) > 7.0 && (degree(false) - 6.0).abs() < 0.2);
}

/// Modes of Craig and Bampton: unit displacements of the first nodes, then modes that leave them at rest.
fn craig_bampton(body: &Body, still: usize) -> GivenModes {
    let (constraint, fixed) = (body.constraint_modes(still), body.modes(still));
    let (first, rest) = (constraint.ncols(), fixed.shapes.ncols());
    let mut shapes = DMatrix::zeros(6 * NODES, first + rest);
    shapes.columns_mut(0, first).copy_from(&constraint);
    shapes.columns_mut(first, rest).copy_from(&fixed.shapes);
    let stiffness = shapes.tr_mul(&body.K) * &shapes;
    let mut damping = DMatrix::zeros(first + rest, first + rest);
    damping
        .view_mut((first, first), (rest, rest))
        .copy_from(&DMatrix::from_diagonal(&fixed.frequencies.map(|frequency| 2.0 * RATIO * frequency)));
    GivenModes {
        mass: body.mass.clone(),
        shapes: rows(&shapes),
        interface: (0..still).collect(),
        spectrum: Spectrum::Matrices { stiffness: entries(&stiffness), damping: entries(&damping) },
        rheology: Rheology::Elastic,
    }
}

fn hinge(node: usize) -> Connection {
    Connection {
        from: Anchor::Carrier,
        to: Anchor::Nodes { part: 0, nodes: vec![node] },
        axes: vec![[0.3, -0.5, 0.8]],
        stiffness: vec![70.0],
        damping: vec![2.0],
        rheology: Rheology::Elastic,
    }
}

#[test]
fn an_interface_is_held_as_nodes_are() {
    let body = Body::new(9, true);
    for still in [1, 2] {
        let expected = build(body.matrices(still), Some(carrier()), vec![hinge(0)], 4).unwrap();
        let modes = PartKind::Modes(craig_bampton(&body, still));
        assert_same(&build(modes, Some(carrier()), vec![hinge(0)], 4).unwrap(), &expected, 4);
    }
}

#[test]
fn an_interface_of_any_number_of_nodes_floats() {
    let body = Body::new(10, true);
    for still in [1, 2, 4] {
        let expected = build(body.matrices(still), None, Vec::new(), 3).unwrap();
        let modes = PartKind::Modes(craig_bampton(&body, still));
        assert_same(&build(modes, None, Vec::new(), 3).unwrap(), &expected, 3);
    }
}

#[test]
fn what_is_no_mode_is_refused() {
    let body = Body::new(11, true);
    let problem = |modes: GivenModes, connections: Vec<Connection>| {
        build(PartKind::Modes(modes), Some(carrier()), connections, 3).unwrap_err().problem
    };
    let good = || craig_bampton(&body, 1);
    let inner = problem(good(), vec![hinge(0), hinge(3)]);
    assert_eq!(inner, Problem::NotInterface { node: "\"wing\" node 40".to_owned() });
    let missing = GivenModes { shapes: good().shapes[1..].to_vec(), ..good() };
    assert_eq!(problem(missing, vec![hinge(0)]), Problem::ShapeRows { rows: 29, dofs: 30 });
    let narrow = good().shapes.iter().map(|row| row[..5].to_vec()).collect();
    let narrow = GivenModes { shapes: narrow, ..good() };
    assert_eq!(problem(narrow, vec![hinge(0)]), Problem::ShapeColumns { columns: 5, interface: 6 });
    let mut moved = good();
    moved.shapes[2][7] = 0.4;
    let expected = Problem::NotUnit { node: 10, component: 2, column: 7, share: 0.4 };
    assert_eq!(problem(moved, vec![hinge(0)]), expected);
    let PartKind::Modes(all) = of_modes(&body, &body.modes(0), |mode| mode > 5) else { panic!("modes") };
    let with = |frequencies: Vec<f64>, damping_ratios: Vec<f64>| GivenModes {
        spectrum: Spectrum::Modes { frequencies, damping_ratios },
        ..all.clone()
    };
    let few = problem(with(vec![1.0; 3], vec![0.0; 24]), Vec::new());
    assert_eq!(few, Problem::ValuePerMode { modes: 24, values: 3 });
    let still = problem(with(vec![0.0; 24], vec![0.0; 24]), Vec::new());
    assert_eq!(still, Problem::NotPositive { value: 0.0 });
    let driven = problem(with(vec![1.0; 24], vec![-1e-3; 24]), Vec::new());
    assert_eq!(driven, Problem::Indefinite { eigenvalue: -1e-3 });
    let mut coupled = with(vec![1.0; 24], vec![0.0; 24]);
    coupled.mass.entries.iter_mut().filter(|(row, ..)| *row < 3).for_each(|entry| entry.2 *= 20.0);
    assert!(matches!(problem(coupled, Vec::new()), Problem::CoupledModes { .. }));
    let mut massless = with(vec![1.0; 24], vec![0.0; 24]);
    massless.shapes.iter_mut().for_each(|row| row[3] = 0.0);
    assert_eq!(problem(massless, Vec::new()), Problem::EmptyMode { mode: 3 });
}

/// The response of the omitted modes to a load that grows with the place is less than the bound, and the bound is zero when none is
/// omitted. (K11)
#[test]
fn modes_left_out_add_less_than_the_bound() {
    let body = Body::new(12, false).held();
    let found = body.modes(0);
    let pole = [0.3, -0.2, 0.1];
    let place = |node: usize| body.mass.nodes[node];
    let energies = |kept: usize| -> Vec<f64> {
        let answer = |load: usize| {
            let (a, b) = (load % 3, load / 3);
            let field = DVector::from_fn(body.size(), |row, _| {
                let (node, component) = body.mass.dofs[row];
                if component == a { place(node)[b] - pole[b] } else { 0.0 }
            });
            let forces = found.shapes.tr_mul(&(&body.M * field));
            let modes = forces.iter().zip(&found.frequencies).take(kept);
            modes.map(|(force, frequency)| (force / frequency).powi(2)).sum()
        };
        (0..9).map(answer).collect()
    };
    let all = energies(body.size());
    for kept in [6, 12, 18, body.size()] {
        let PartKind::Modes(modes) = of_modes(&body, &found, |mode| mode < kept) else { panic!("modes") };
        let bound = modes.missing(pole).unwrap();
        let some = energies(kept);
        let largest = some.iter().copied().fold(0.0, f64::max);
        let missing = (0..9).map(|load| all[load] - some[load]).fold(0.0, f64::max) / largest;
        println!("{kept} modes leave out {missing:.1e}, at most {bound:.1e}");
        assert!(missing <= bound + 1e-12 && bound < 5.0, "{kept} modes: {missing} {bound}");
        assert!(kept < body.size() || bound.abs() < 1e-10, "{bound}");
    }
    assert_eq!(craig_bampton(&Body::new(12, true), 1).missing(pole), None);
}

/// A rigid body at a node equals its entries in the matrices, whether the node is free or moved by modes.
#[test]
fn a_rigid_body_at_a_node_adds_its_mass_and_inertia() {
    let inertia = [[0.3, 0.02, -0.01], [0.02, 0.4, 0.03], [-0.01, 0.03, 0.5]];
    let tip = TipMass { node: 3, mass: 1.7, inertia };
    let bare = Body::new(13, false).held();
    let body = |kind: PartKind, masses: Vec<TipMass>| {
        let part = Part { name: "wing".to_owned(), kind, masses, attached: Vec::new(), rayleigh: [0.0; 2] };
        Assembly { carrier: Some(carrier()), parts: vec![part], ..Assembly::default() }.body()
    };
    let PartKind::Matrices(mut heavy) = bare.matrices(0) else { panic!("matrices") };
    // The first node has no rows.
    let row = 6 * (tip.node - 1);
    heavy.mass.entries.extend((0..3).map(|axis| (row + axis, row + axis, tip.mass)));
    let rotations = (0..9).map(|entry| (entry / 3, entry % 3));
    heavy.mass.entries.extend(rotations.map(|(a, b)| (row + 3 + a, row + 3 + b, inertia[a][b])));
    let expected = body(PartKind::Matrices(heavy), Vec::new()).unwrap();
    assert_same(&body(bare.matrices(0), vec![tip.clone()]).unwrap(), &expected, 3);
    let modes = of_modes(&bare, &bare.modes(0), |_| true);
    assert_same(&body(modes, vec![tip.clone()]).unwrap(), &expected, 3);
    let beyond = body(bare.matrices(0), vec![TipMass { node: 9, ..tip }]).unwrap_err();
    assert_eq!(beyond.problem, Problem::NoSuchNode { index: 9, count: NODES });
}
