//! Appendages known by their cantilever modes alone, against the parts that the modes are of. (K17), (K18)

use nalgebra::{Complex, DMatrix, Matrix3, Vector3};
use proptest::prelude::*;
use quasirigid::elements::{
    Appendage, AppendageMode, Assembly, Carrier, End, Extent, Field, Frame, FrameNode, Incomplete,
    InertiaPoint, Part, PartKind, PartReduction, Problem, SectionShape, Spring, TipMass,
};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::modes::{
    CantileverMode, CantileverModes, LinearInput, LinearModel, LinearOutput, SteadyState,
};
use quasirigid::reduction::{Vibrations, reduce};
use quasirigid_math::sym3;

use super::common::turned_axes;
use crate::support::{cases, parts, rotation, vector};

type V = Vector3<f64>;
type C = Complex<f64>;

/// Interface of the boom.
const ROOT: [f64; 3] = [0.6, -0.2, 0.3];

fn hub() -> Carrier {
    parts::carrier(60.0, [0.05, -0.1, 0.08], [[14.0, 0.5, -0.3], [0.5, 17.0, 0.4], [-0.3, 0.4, 21.0]])
}

/// A boom through these places from its root on, with a mass at its tip.
fn boom(name: &str, places: &[V], tip: f64) -> Part {
    let nodes = places
        .iter()
        .enumerate()
        .map(|(i, place)| FrameNode { name: format!("{i}"), position: (*place).into() });
    let section = SectionShape::Tube { radius: 8e-3, thickness: 1e-3 };
    let mut material = parts::elastic(2700.0, 70e9, 0.3);
    material.rheology = Rheology::KelvinVoigt { time: 2e-3 };
    let members =
        (1..places.len()).map(|i| parts::member([i - 1, i], section, material.clone(), 4)).collect();
    Part {
        name: name.into(),
        kind: PartKind::Frame(Frame { nodes: nodes.collect(), members }),
        masses: vec![TipMass { node: places.len() - 1, mass: tip, inertia: [[0.0; 3]; 3] }],
        attached: vec![0],
        rayleigh: [0.0; 2],
    }
}

fn on_hub(parts: Vec<Part>) -> Assembly {
    let reduction = PartReduction { order: 3, modes: 4 };
    Assembly { carrier: Some(hub()), parts, reduction, ..Assembly::default() }
}

/// Boom with an elbow, skew to every axis.
fn bent() -> Part {
    let root = V::from(ROOT);
    boom("boom", &[root, root + V::new(1.5, 0.4, -0.3), root + V::new(2.1, 1.6, 0.5)], 0.8)
}

/// Boom on a line.
fn straight() -> (Part, V) {
    let along = V::new(2.4, 0.9, -0.7);
    (boom("boom", &[ROOT.into(), V::from(ROOT) + along], 0.8), along)
}

/// Sheet that a vendor writes of the parts on the hub of a body, in axes of its own, with rotations about a point (m, from the interface,
/// sheet's axes).
fn sheet(
    assembly: &Assembly,
    interface: [f64; 3],
    axes: Matrix3<f64>,
    rotation_about: [f64; 3],
) -> Appendage {
    let body = assembly.body().unwrap();
    let from_pole = |place: V| CantileverModes::about(&body, (place - V::from(body.pole())).into()).unwrap();
    let (at_interface, carrier) = (from_pole(interface.into()), assembly.locked_carrier().unwrap().unwrap());
    let shifted = from_pole(V::from(interface) + axes * V::from(rotation_about));
    let own = |v: [f64; 3]| (axes.transpose() * V::from(v)).into();
    let mass = body.invariants().mass - carrier.mass;
    let first = body.invariants().mass * V::from(body.center_of_mass())
        - carrier.mass * V::from(carrier.center_of_mass);
    let inertia = Matrix3::from(at_interface.inertia) - Matrix3::from(carrier.inertia_about(interface));
    let inertia = axes.transpose() * inertia * axes;
    let mode = |mode: &CantileverMode| AppendageMode {
        frequency: mode.frequency,
        damping_ratio: mode.damping_ratio,
        translation: own(mode.translation),
        rotation: own(mode.rotation),
    };
    Appendage {
        name: "boom".into(),
        interface,
        axes: [axes.column(0).into_owned().into(), (axes.column(1) + 0.4 * axes.column(0)).into()],
        mass,
        center_of_mass: own((first / mass - V::from(interface)).into()),
        inertia: (0.5 * (inertia + inertia.transpose())).into(),
        inertia_about: InertiaPoint::Interface,
        rotation_about,
        extent: Extent::Unknown,
        modes: shifted.modes.iter().map(mode).collect(),
    }
}

fn with(appendages: Vec<Appendage>) -> Assembly {
    Assembly { carrier: Some(hub()), appendages, ..Assembly::default() }
}

const AXES: Matrix3<f64> = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);

/// Largest gap of the free frequencies up to a hundred times the lowest, relative to each: the solver works with their inverse squares.
fn frequency_gap(a: &FlexibleBody, b: &FlexibleBody) -> f64 {
    let [a, b] = [a, b].map(|body| Vibrations::compute(body).unwrap().free_frequencies);
    assert_eq!(a.len(), b.len());
    let slow = a.iter().zip(&b).filter(|(_, expected)| **expected < 100.0 * b[0]);
    slow.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// Transfer matrix from torques to angular velocities at rest.
fn transfer(body: &FlexibleBody, s: C) -> DMatrix<C> {
    let inputs = [0, 1, 2].map(|axis| LinearInput::Torque { axis });
    let outputs = [0, 1, 2].map(|axis| LinearOutput::Rate { axis });
    let model = LinearModel::about(body, &[], SteadyState::at_rest(body), &inputs, &outputs, None).unwrap();
    let of = |rows: &[Vec<f64>]| DMatrix::from_fn(rows.len(), rows[0].len(), |i, k| C::from(rows[i][k]));
    let (A, B) = (of(&model.A), of(&model.B));
    let size = A.nrows();
    of(&model.C) * (DMatrix::identity(size, size) * s - A).lu().solve(&B).unwrap() + of(&model.D)
}

fn transfer_gap(a: &FlexibleBody, b: &FlexibleBody) -> f64 {
    let lowest = Vibrations::compute(b).unwrap().free_frequencies[0];
    let at = [C::new(0.0, 0.2), C::new(0.0, 1.001), C::new(0.02, 3.0), C::new(0.0, 17.0)];
    let gap = |s: C| {
        let expected = transfer(b, s * lowest);
        (transfer(a, s * lowest) - &expected).norm() / expected.norm()
    };
    at.into_iter().map(gap).fold(0.0, f64::max)
}

/// Largest difference of the torques of the reduced equations of order 3, relative to the largest.
fn reduced_gap(a: &FlexibleBody, b: &FlexibleBody) -> f64 {
    let [a, b] = [a, b].map(|body| reduce(body, 3).unwrap());
    let (a, b) = (a.mu(4), b.mu(4));
    let row = |row: usize| a.row(row).iter().zip(b.row(row)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (0..3).map(row).fold(0.0, f64::max) / b.amax()
}

#[test]
fn a_sheet_gives_the_motions_at_rest_of_the_part_that_it_is_of() {
    let full = on_hub(vec![bent()]);
    let axes = *turned_axes().matrix();
    for (about, axes) in [([0.0; 3], Matrix3::identity()), ([0.7, -0.4, 1.1], axes), ([-2.0, 0.3, 0.0], AXES)]
    {
        let (truth, found) =
            (full.body().unwrap(), with(vec![sheet(&full, ROOT, axes, about)]).body().unwrap());
        let [frequencies, transfers] = [frequency_gap(&found, &truth), transfer_gap(&found, &truth)];
        println!("frequencies {frequencies:.1e}, transfer functions {transfers:.1e}");
        assert!(frequencies < 1e-10, "{frequencies:e}");
        assert!(transfers < 1e-9, "{transfers:e}");
    }
}

/// The load of a steady spin is in a sheet where the mass is on a line; without the line it is not, and the equations say so.
#[test]
fn a_line_gives_the_load_of_a_steady_spin() {
    let (part, along) = straight();
    let full = on_hub(vec![part]);
    let truth = full.body().unwrap();
    let axes = *turned_axes().matrix();
    let plain = sheet(&full, ROOT, axes, [0.2, 0.1, -0.3]);
    let line = Appendage { extent: Extent::Line((axes.transpose() * along).into()), ..plain.clone() };
    let (plain, line) = (with(vec![plain]), with(vec![line]));
    let [unknown, known] = [&plain, &line].map(|assembly| reduced_gap(&assembly.body().unwrap(), &truth));
    println!("reduced equations: {known:.1e} on a line, {unknown:.1e} without");
    // rotary inertia and stretching of the tube, (8 mm / 2.7 m)²
    assert!(known < 1e-4, "{known:e}");
    assert!(unknown > 0.1, "{unknown:e}");
    assert_eq!(plain.incomplete_at(3), [Incomplete::SheetLoads]);
    assert_eq!(line.incomplete_at(3), []);
    assert_eq!(line.incomplete_at(4), [Incomplete::Sheets]);
}

/// A point that moves across a plane, as a flat panel bends.
#[test]
fn a_normal_gives_the_load_of_a_steady_spin() {
    let (axes, normal) = (*turned_axes().matrix(), V::new(0.2, -0.5, 0.9).normalize());
    let side = normal.cross(&V::x()).normalize();
    let place = |a: f64, b: f64| V::from(ROOT) + a * side + b * normal.cross(&side);
    let masses = [(1.2, place(1.1, 0.3)), (0.7, place(1.8, -0.5)), (0.9, place(0.9, 1.4))];
    let point = |(i, (mass, at)): (usize, &(f64, V))| {
        parts::line_point(format!("{i}"), *mass, (*at).into(), normal.into())
    };
    let points: Vec<_> = masses.iter().enumerate().map(point).collect();
    let end = End::Point;
    let mut springs: Vec<Spring> = (0..3)
        .map(|i| parts::spring(end(i), End::Carrier, parts::isotropic(40.0 + 25.0 * i as f64, 0.3)))
        .collect();
    springs.push(parts::spring(end(0), end(1), parts::isotropic(30.0, 0.0)));
    let full = Assembly { carrier: Some(hub()), points, springs, ..Assembly::default() };
    let panel = sheet(&full, ROOT, axes, [0.0; 3]);
    let panel = Appendage { extent: Extent::Plane((axes.transpose() * normal).into()), ..panel };
    let (truth, found) = (full.body().unwrap(), with(vec![panel]).body().unwrap());
    // damping couples the modes of the points, which a sheet leaves out
    assert!(frequency_gap(&found, &truth) < 1e-10);
    let [a, b] = [&found, &truth].map(growth);
    assert!((&a - &b).amax() < 1e-10 * b.amax(), "{a} {b}");
}

/// Growth of the inertia under spin, `J₁ C⁻¹ J₁` over the pairs of axes.
fn growth(body: &FlexibleBody) -> DMatrix<f64> {
    let J1 = &body.invariants().J1;
    let loads = DMatrix::from_fn(J1.len(), 6, |j, pair| J1[j][pair]);
    let mut answers: Vec<f64> =
        loads.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()).collect();
    body.solve_stiffness(&mut answers, 6);
    loads.tr_mul(&DMatrix::from_row_slice(J1.len(), 6, &answers))
}

/// A part beside a sheet, and both as sheets: coordinates and sums of the two kinds stand side by side.
#[test]
fn a_sheet_stands_beside_a_part_and_beside_another_sheet() {
    let second = boom("second", &[V::new(-0.5, 0.1, 0.2), V::new(-1.9, -0.6, 0.9)], 1.3);
    let first = on_hub(vec![bent()]);
    let one = sheet(&first, ROOT, *turned_axes().matrix(), [0.3, 0.0, 0.1]);
    let two = sheet(&on_hub(vec![second]), [-0.5, 0.1, 0.2], AXES, [0.0; 3]);
    let two = Appendage { name: "second".into(), ..two };
    let truth = Assembly { appendages: vec![two.clone()], ..first }.body().unwrap();
    let found = with(vec![one, two]).body().unwrap();
    assert!(frequency_gap(&found, &truth) < 1e-10, "{:e}", frequency_gap(&found, &truth));
    assert!(transfer_gap(&found, &truth) < 1e-9, "{:e}", transfer_gap(&found, &truth));
    let gap = V::from(found.center_of_mass()) - V::from(truth.center_of_mass());
    assert!(gap.amax() < 1e-12);
}

/// A sheet of a few modes with random factors that a body can have.
fn random_sheet() -> impl Strategy<Value = Appendage> {
    let mode = (0.5..9.0_f64, 0.0..0.1_f64, vector(), vector());
    (proptest::collection::vec(mode, 1..5), vector(), vector(), rotation(), vector()).prop_map(
        |(modes, interface, center, R, about)| {
            let modes =
                modes.into_iter().map(|(frequency, damping_ratio, translation, rotation)| AppendageMode {
                    frequency,
                    damping_ratio,
                    translation: translation.map(|x| 0.3 * x),
                    rotation: rotation.map(|x| 0.3 * x),
                });
            Appendage {
                name: "sheet".into(),
                interface,
                axes: [R.column(0).into_owned().into(), R.column(1).into_owned().into()],
                mass: 9.0,
                center_of_mass: center.map(|x| 0.3 * x),
                inertia: parts::diag([4.0, 5.0, 6.0]),
                inertia_about: InertiaPoint::CenterOfMass,
                rotation_about: about.map(|x| 0.3 * x),
                extent: Extent::Unknown,
                modes: modes.collect(),
            }
        },
    )
}

proptest! {
    #![proptest_config(cases(24))]

    /// Two sheets of one interface are one sheet: masses, moments and inertia add, and the modes stand side by side. A sheet in other
    /// axes is the same. (K17)
    #[test]
    fn sheets_of_one_interface_merge(one in random_sheet(), two in random_sheet(), R in rotation()) {
        let two = Appendage { name: "two".into(), interface: one.interface, axes: one.axes, rotation_about: one.rotation_about, ..two };
        let mass = one.mass + two.mass;
        let [a, b] = [&one, &two].map(|sheet| V::from(sheet.center_of_mass));
        let center = (one.mass * a + two.mass * b) / mass;
        let shifted = |sheet: &Appendage, arm: V| Matrix3::from(sheet.inertia) + sheet.mass * (arm.norm_squared() * Matrix3::identity() - arm * arm.transpose());
        let inertia = shifted(&one, a) + shifted(&two, b);
        let merged = Appendage {
            mass,
            center_of_mass: center.into(),
            inertia: inertia.into(),
            inertia_about: InertiaPoint::Interface,
            modes: one.modes.iter().chain(&two.modes).copied().collect(),
            ..one.clone()
        };
        let body = with(vec![merged.clone()]).body().unwrap();
        let apart = with(vec![one, two]).body().unwrap();
        prop_assert!(frequency_gap(&body, &apart) < 1e-12);
        prop_assert!(transfer_gap(&body, &apart) < 1e-9);
        prop_assert!((growth(&body) - growth(&apart)).amax() <= 1e-11 * growth(&apart).amax());
        let turn = |v: [f64; 3]| -> [f64; 3] { (R.transpose() * V::from(v)).into() };
        let own = Matrix3::from_columns(&[V::from(merged.axes[0]), V::from(merged.axes[1]), V::from(merged.axes[0]).cross(&V::from(merged.axes[1]))]) * R;
        let turned = Appendage {
            axes: [own.column(0).into_owned().into(), own.column(1).into_owned().into()],
            center_of_mass: turn(merged.center_of_mass),
            inertia: (R.transpose() * inertia * R).into(),
            rotation_about: turn(merged.rotation_about),
            modes: merged.modes.iter().map(|mode| AppendageMode { translation: turn(mode.translation), rotation: turn(mode.rotation), ..*mode }).collect(),
            ..merged
        };
        let turned = with(vec![turned]).body().unwrap();
        for (a, b) in turned.invariants().h.iter().zip(&body.invariants().h) {
            prop_assert!((V::from(*a) - V::from(*b)).amax() < 1e-12 * (1.0 + V::from(*b).amax()));
        }
        let [a, b] = [&turned, &body].map(|body| Matrix3::from(sym3::rows(body.invariants().J)));
        prop_assert!((a - b).amax() < 1e-13 * b.amax());
    }
}

#[test]
fn modes_that_carry_more_than_there_is_are_refused() {
    let full = on_hub(vec![straight().0]);
    let base = sheet(&full, ROOT, Matrix3::identity(), [0.0; 3]);
    assert_eq!(with(vec![base.clone()]).check(), []);
    let refused = |appendage: Appendage| {
        let errors = with(vec![appendage]).check();
        let [error] = errors.as_slice() else { panic!("{errors:?}") };
        (error.field, error.problem.to_string())
    };
    let mut twice = base.clone();
    twice.modes.extend(base.modes.clone());
    let (field, message) = refused(twice);
    assert_eq!(field, Field::MODES);
    assert!(message.starts_with("the modes carry 1") && message.contains(" % of the "), "{message}");
    let light = Appendage {
        mass: 1.0,
        center_of_mass: [0.0; 3],
        inertia: parts::diag([1.0, 1.0, 1.0]),
        modes: vec![AppendageMode {
            frequency: 2.0,
            damping_ratio: 0.0,
            translation: [1.04_f64.sqrt(), 0.0, 0.0],
            rotation: [0.0; 3],
        }],
        ..base.clone()
    };
    assert_eq!(refused(light.clone()).1, "the modes carry 104 % of the mass along x");
    // each axis alone would do, together they carry 0.6 + 0.6
    let both = AppendageMode {
        translation: [0.6_f64.sqrt(), 0.0, 0.0],
        rotation: [0.0, 0.6_f64.sqrt(), 0.0],
        ..light.modes[0]
    };
    let (_, message) = refused(Appendage { modes: vec![both], ..light.clone() });
    assert_eq!(message, "the modes carry 120 % of the mass in a translation with a rotation");
    // a rod has no inertia about its own line
    let rod = Appendage { inertia: parts::diag([0.0, 1.0, 1.0]), ..light.clone() };
    let torsion = AppendageMode { translation: [0.0; 3], rotation: [0.01, 0.0, 0.0], ..light.modes[0] };
    let (_, message) = refused(Appendage { modes: vec![torsion], ..rod });
    assert!(message.contains("of which the appendage has none"), "{message}");
    let (field, message) = refused(Appendage { modes: Vec::new(), ..light.clone() });
    assert_eq!((field, message.as_str()), (Field::MODES, "there are no modes"));
    let still = AppendageMode { frequency: 0.0, ..light.modes[0] };
    assert!(matches!(
        with(vec![Appendage { modes: vec![still], ..light }]).check()[0].problem,
        Problem::NotPositive { .. }
    ));
}
