//! Thrust along slender parts: frequencies of columns under a dead load against their closed forms, and the load that buckles them. (K6), (F7)
//! `EI w'''' + P w'' = ρA ω² w`. The share of that load is the ratio in which the series of reduced equations converges. (E7)

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use quasirigid::dynamics::{Forced, Start, load_ratio_at_start};
use quasirigid::elements::{
    ApplicationPoint, Assembly, End, Frame, FrameNode, Member, NodeRef, Part, PartKind, PartReduction,
    SectionShape,
};
use quasirigid::model::Support;
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::modes::{SteadyModes, SteadyState, SteadyStateGuess};
use quasirigid_mesh::Shape;

use super::beams::Cantilever;
use super::common::turned_axes;
use super::meshes::{Hexahedra, solid, throughout};
use crate::support::{parts, sprung_body};

type V = Vector3<f64>;

const LENGTH: f64 = 4.0;
const WIDTH: f64 = 0.1;
const DENSITY: f64 = 1500.0;
const YOUNG: f64 = 2e9;
const ROOT: [f64; 3] = [0.4, -1.1, 0.7];
const SECTION: SectionShape = SectionShape::Rectangle { height: WIDTH, width: WIDTH };

fn bending() -> f64 {
    YOUNG * WIDTH.powi(4) / 12.0
}

/// Load that buckles a column clamped at one end, `π² EI / 4L²`.
fn euler() -> f64 {
    PI * PI * bending() / (4.0 * LENGTH * LENGTH)
}

/// Wave numbers `a` and `b` of `cos ax` and `cosh bx`.
fn waves(load: f64, omega: f64) -> [f64; 2] {
    let half = 0.5 * load / bending();
    let root = (half * half + DENSITY * WIDTH * WIDTH * omega * omega / bending()).sqrt();
    [(root + half).sqrt(), (root - half).sqrt()]
}

/// Boundary conditions of a column clamped at one end: no moment, and no shear beside the load's, at the other.
fn from_a_clamp(load: f64, omega: f64) -> f64 {
    clamped(load, omega, load / bending())
}

/// The same of a load that turns with the free end, along which it has no shear.
fn under_a_follower(load: f64, omega: f64) -> f64 {
    clamped(load, omega, 0.0)
}

fn clamped(load: f64, omega: f64, p: f64) -> f64 {
    let [a, b] = waves(load, omega);
    let (x, y) = (a * LENGTH, b * LENGTH);
    let first = |da: f64, db: f64| da + p * db;
    let moment = [-a * a * x.cos() - b * b * y.cosh(), -a * x.sin() - b * y.sinh()];
    let cosine = first(a.powi(3) * x.sin() - b.powi(3) * y.sinh(), -a * x.sin() - b * y.sinh());
    let sine = first(-a * a * x.cos() - b * b * y.cosh(), x.cos() - y.cosh());
    moment[0] * sine - moment[1] * cosine
}

/// The same of a column free at both ends, of a motion that is even about its middle.
fn free_and_even(load: f64, omega: f64) -> f64 {
    let ([a, b], p) = (waves(load, omega), load / bending());
    let (x, y) = (0.5 * a * LENGTH, 0.5 * b * LENGTH);
    let cosine = [-a * a * x.cos(), a.powi(3) * x.sin() - p * a * x.sin()];
    let cosh = [b * b * y.cosh(), b.powi(3) * y.sinh() + p * b * y.sinh()];
    cosine[0] * cosh[1] - cosh[0] * cosine[1]
}

/// Lowest frequency at which the conditions hold, by bisection.
fn lowest(conditions: fn(f64, f64) -> f64, load: f64, to: f64) -> f64 {
    let step = to / 500.0;
    let sign = |omega: f64| conditions(load, omega) > 0.0;
    let mut low = (1..500).map(|i| f64::from(i) * step).find(|low| sign(*low) != sign(low + step)).unwrap();
    let mut high = low + step;
    while high - low > 1e-13 * high {
        let middle = 0.5 * (low + high);
        if sign(middle) == sign(low) { low = middle } else { high = middle }
    }
    low
}

fn column() -> Cantilever {
    let material = parts::elastic(DENSITY, YOUNG, 0.0);
    let reduction = PartReduction { order: 3, modes: 6 };
    Cantilever { length: LENGTH, elements: 20, section: SECTION, material, hub: 1e9, reduction }
}

/// A force along the column at a node: negative loads pull.
fn load(node: usize, load: f64) -> Force<ApplicationPoint> {
    load_in(node, load, Axes::Body)
}

fn load_in(node: usize, load: f64, axes: Axes) -> Force<ApplicationPoint> {
    let law = ForceLaw::Thrust {
        at: ApplicationPoint { on: End::Node(NodeRef { part: 0, node }), at: None },
        force: (-load * (turned_axes() * V::x())).into(),
        axes,
        wave: Wave::default(),
    };
    Force { name: format!("load {node}"), law }
}

/// Frequencies about a spin along the third of the rotated axes, lowest first.
pub fn frequencies_at(assembly: &Assembly, spin: f64) -> Vec<f64> {
    modes_at(assembly, spin).0
}

/// Modes about rest: frequencies, lowest first, and whether a motion grows.
fn modes(assembly: &Assembly) -> (Vec<f64>, bool) {
    modes_at(assembly, 0.0)
}

fn modes_at(assembly: &Assembly, spin: f64) -> (Vec<f64>, bool) {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let near = SteadyStateGuess {
        omega: (turned_axes() * (spin * V::z())).into(),
        attitude: [1.0, 0.0, 0.0, 0.0],
        place: [0.0; 3],
        velocity: [0.0; 3],
        asked: false,
    };
    let state = SteadyState::near(&body, &forces, near).unwrap();
    let modes = SteadyModes::about(&body, &forces, state).unwrap().modes;
    let mut frequencies: Vec<f64> =
        modes.iter().map(|mode| mode.frequency).filter(|f| *f > 0.25 + 0.5 * spin).collect();
    frequencies.sort_by(f64::total_cmp);
    (frequencies, modes.iter().any(|mode| mode.decay_rate < -0.1))
}

fn held(assembly: Assembly) -> Assembly {
    Assembly { support: Support::FixedPoint { point: ROOT }, ..assembly }
}

/// Rotary inertia and shear lower the frequency of the beam by 1.5e-3; its share under a load is that of the closed form.
#[test]
fn a_column_has_the_frequencies_of_its_closed_form_and_buckles() {
    let at = |share: f64| modes(&held(column().assembly(vec![load(20, share * euler())])));
    let rest = at(0.0).0[0];
    let exact = lowest(from_a_clamp, 0.0, 40.0);
    assert!((rest / exact - 1.0).abs() < 2e-3, "{rest} {exact}");
    for share in [-2.0, 0.3, 0.9] {
        let (found, grows) = at(share);
        let expected = lowest(from_a_clamp, share * euler(), 40.0) / exact;
        println!("{share} of Euler's load: {} of the frequency, closed form {expected}", found[0] / rest);
        assert!((found[0] / rest / expected - 1.0).abs() < 2e-3 && !grows, "{share}: {found:?}");
    }
    assert!(at(1.02).1 && !at(0.98).1);
}

/// A thrust that turns with the end raises the lowest frequency, and makes the column flutter at `20.05 EI/L²`.
#[test]
fn a_column_under_a_follower_has_the_frequencies_of_its_closed_form_and_flutters() {
    let at = |share: f64| modes(&held(column().assembly(vec![load_in(20, share * euler(), Axes::Place)])));
    let (rest, exact) = (at(0.0).0[0], lowest(under_a_follower, 0.0, 40.0));
    for share in [-2.0, 0.9, 4.0] {
        let (found, grows) = at(share);
        let expected = lowest(under_a_follower, share * euler(), 40.0) / exact;
        println!("{share} of Euler's load: {} of the frequency, closed form {expected}", found[0] / rest);
        assert!((found[0] / rest / expected - 1.0).abs() < 3e-3 && !grows, "{share}: {found:?}");
    }
    let beck = 20.05 * 4.0 / (PI * PI);
    assert!(at(1.01 * beck).1 && !at(0.99 * beck).1);
}

/// Cells of a solid in place of the beam: the path of a node by the work of unit forces on it.
#[test]
fn a_column_of_cells_buckles_too() {
    let mut block = Hexahedra::default();
    block.add([16, 2, 2], |[x, y, z]| V::new(LENGTH * x, WIDTH * (y - 0.5), WIDTH * (z - 0.5)));
    let even = block.mesh(Shape::Hex20, |place| place);
    let places: Vec<V> = even.nodes.iter().map(|place| V::from(*place)).collect();
    let clamped: Vec<usize> = (0..places.len()).filter(|node| places[*node].x < 1e-9).collect();
    let tip = places.iter().position(|place| (place - LENGTH * V::x()).norm() < 1e-9).unwrap();
    let mesh = block.mesh(Shape::Hex20, |place| turned_axes() * place + V::from(ROOT));
    let material = parts::elastic(DENSITY, YOUNG, 0.0);
    let part = solid(mesh.clone(), &throughout(&mesh, &material), clamped);
    let hub = parts::carrier(1e9, ROOT, (1e9 * Matrix3::<f64>::identity()).into());
    let reduction = PartReduction { order: 3, modes: 6 };
    let at = |share: f64| {
        let forces = vec![load(tip, share * euler())];
        let assembly = Assembly {
            carrier: Some(hub.clone()),
            parts: vec![part.clone()],
            forces,
            reduction,
            ..Assembly::default()
        };
        modes(&held(assembly))
    };
    let rest = at(0.0).0[0];
    for share in [-1.0, 0.5] {
        let found = at(share).0[0] / rest;
        let expected = lowest(from_a_clamp, share * euler(), 40.0) / lowest(from_a_clamp, 0.0, 40.0);
        println!("{share} of Euler's load: {found} of the frequency, closed form {expected}");
        assert!((found / expected - 1.0).abs() < 5e-3, "{share}: {found} {expected}");
    }
    assert!(at(1.03).1 && !at(0.97).1);
}

/// A free column between two thrusts: the frame does not rotate with a motion that is even about the middle.
#[test]
fn a_free_column_between_two_thrusts() {
    let along = turned_axes() * V::x();
    let at = |share: f64| V::from(ROOT) + share * LENGTH * along;
    let node = |name: &str, share| FrameNode { name: name.to_owned(), position: at(share).into() };
    let member = Member {
        name: String::new(),
        ends: [0, 1],
        section: SECTION,
        up: Some((turned_axes() * V::y()).into()),
        material: parts::elastic(DENSITY, YOUNG, 0.0),
        elements: 20,
    };
    let kind =
        PartKind::Frame(Frame { nodes: vec![node("low", 0.0), node("high", 1.0)], members: vec![member] });
    let part =
        Part { name: "column".into(), kind, masses: Vec::new(), attached: Vec::new(), rayleigh: [0.0; 2] };
    let squeezed = |share: f64| {
        let pressure = 4.0 * share * euler();
        let forces = vec![load(0, -pressure), load(1, pressure)];
        let reduction = PartReduction { order: 3, modes: 8 };
        modes(&Assembly { parts: vec![part.clone()], forces, reduction, ..Assembly::default() })
    };
    let rest = squeezed(0.0).0[0];
    for share in [-1.0, 0.6] {
        let found = squeezed(share).0[0] / rest;
        let expected = lowest(free_and_even, 4.0 * share * euler(), 80.0) / lowest(free_and_even, 0.0, 80.0);
        println!("{share} of Euler's load: {found} of the frequency, closed form {expected}");
        assert!((found / expected - 1.0).abs() < 3e-3, "{share}: {found} {expected}");
    }
}

/// Ratio of the loads at a spin (rad/s) from a time to another.
fn ratio(assembly: &Assembly, spin: f64, duration: f64) -> f64 {
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let start = Start {
        omega: (turned_axes() * (spin * V::z())).into(),
        attitude: [1.0, 0.0, 0.0, 0.0],
        place: [3.0, -1.0, 2.0],
        velocity: [0.0; 3],
    };
    load_ratio_at_start(Forced { body: &body, forces: &forces }, start, duration)
}

/// Compression and tension alike, on the held column and on one that the recoil of a heavy hub leaves where it is.
#[test]
fn the_series_under_a_thrust_converges_as_the_share_of_eulers_load() {
    for share in [-2.0, 1e-4, 0.3, 0.98, 3.0] {
        let assembly = column().assembly(vec![load(20, share * euler())]);
        for assembly in [held(assembly.clone()), assembly] {
            let found = ratio(&assembly, 0.7, 10.0);
            println!("{share} of Euler's load: {found}");
            // shear makes the beam weaker by P/GA
            assert!((found / share.abs() - 1.0).abs() < 3e-3, "{share}: {found}");
        }
    }
}

/// Under its own weight a column buckles at `ρAg L³ = 7.8373 EI`.
#[test]
fn the_series_under_weight_converges_as_the_share_of_the_height_that_stands() {
    for share in [0.2, 1.5] {
        let weight = 7.837_347 * share * bending() / LENGTH.powi(3);
        let acceleration = (-weight / (DENSITY * WIDTH * WIDTH) * (turned_axes() * V::x())).into();
        let gravity = Force { name: "weight".into(), law: ForceLaw::UniformGravity { acceleration } };
        let found = ratio(&held(column().assembly(vec![gravity])), 0.0, 1.0);
        println!("{share} of the weight that it carries: {found}");
        assert!((found / share - 1.0).abs() < 5e-3, "{share}: {found}");
    }
}

/// A drag `c` on a mass beside a spring `k` is as large as the spring at the rate `k/c`.
#[test]
fn drag_is_seen_beside_the_stiffness() {
    let pendant = parts::sprung(0.3, [0.2, 1.1, -0.4], [70.0; 3], [0.1; 3]);
    let inertia = [[9.0, 0.1, 0.0], [0.1, 11.0, 0.3], [0.0, 0.3, 15.0]];
    let law = ForceLaw::Drag { at: ApplicationPoint { on: End::Point(0), at: None }, coefficient: 4.0 };
    let assembly = Assembly {
        forces: vec![Force { name: "oil".into(), law }],
        ..sprung_body(parts::carrier(50.0, [0.1, 0.0, 0.2], inertia), &[pendant])
    };
    let found = ratio(&assembly, 1.7, 1.0);
    // the carrier recoils from the motion and from the force
    assert!((found / (1.7 * 4.0 / 70.0 * (1.0f64 - 0.3 / 50.3).powi(2)) - 1.0).abs() < 1e-12, "{found}");
}

/// A thrust that comes and goes is seen at its peak.
#[test]
fn waves_are_seen_at_their_peaks() {
    let pulsing = |frequency| {
        let Force { name, law } = load(20, 0.4 * euler());
        let ForceLaw::Thrust { at, force, axes, .. } = law else { unreachable!() };
        let wave = Wave { frequency, phase: 0.3 };
        ratio(
            &column().assembly(vec![Force { name, law: ForceLaw::Thrust { at, force, axes, wave } }]),
            0.0,
            30.0,
        )
    };
    for frequency in [0.1, 0.9, 40.0] {
        let found = pulsing(frequency);
        assert!(found > 0.95 * 0.4 && found < 1.003 * 0.4, "{frequency}: {found}");
    }
}

/// A force across the tip twists the column as it bends it sideways: `4.0126 √(EI GJ) / L²`.
#[test]
fn the_series_under_a_force_across_converges_as_the_share_of_the_lateral_buckling_load() {
    let torsion = 0.140_577 * WIDTH.powi(4) * 0.5 * YOUNG;
    let buckling = 4.012_6 * (bending() * torsion).sqrt() / (LENGTH * LENGTH);
    let Force { name, law } = load(20, 0.0);
    let ForceLaw::Thrust { at, axes, wave, .. } = law else { unreachable!() };
    let force = (0.4 * buckling * (turned_axes() * V::new(0.0, 0.6, 0.8))).into();
    let reduction = PartReduction { order: 3, modes: 16 };
    let column = Cantilever { reduction, ..column() };
    let across = Force { name, law: ForceLaw::Thrust { at, force, axes, wave } };
    let found = ratio(&column.assembly(vec![across]), 0.0, 1.0);
    assert!((found / 0.4 - 1.0).abs() < 2e-3, "{found}");
}

/// A thrust that turns with the end has no potential, and its passes die out: the first is `0.162` of a dead one's on the irregular start, and
/// from a third of Beck's load on the series is refused.
#[test]
fn a_follower_is_told_by_what_its_first_passes_do() {
    let at =
        |share: f64| ratio(&column().assembly(vec![load_in(20, share * euler(), Axes::Place)]), 0.0, 1.0);
    let (low, beck) = (at(0.1), at(20.05 * 4.0 / (PI * PI)));
    assert!((beck / low / (10.0 * 20.05 * 4.0 / (PI * PI)) - 1.0).abs() < 1e-9, "{low} {beck}");
    assert!(beck > 0.5 && low < 0.1, "{low} {beck}");
}
