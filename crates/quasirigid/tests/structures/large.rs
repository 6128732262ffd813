//! Beams that bend by more than their section: the full system along curved paths, point by point. (K12)–(K14)

use nalgebra::{DMatrix, Vector3};
use quasirigid::dynamics::{Forced, FullState, Observer, Options, Outcome, Run, Sample, propagate_full};
use quasirigid::elements::{
    Assembly, Carrier, Frame, FrameNode, Part, PartKind, Point, SectionShape, Spring, TipMass,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{Displaced, FlexibleBody, Kinetics, MotionState, RANGE, Support};
use quasirigid::prelude::CARRIER;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3;

use super::common::turned_axes;
use crate::support::parts;

/// A 6 m boom of a tube of 15 mm on an upper stage: a torsional inertia of 2e-4 kg·m² beside a tip mass of 3 kg.
struct Boom {
    young: f64,
    /// Damping in proportion to stiffness (s).
    damping: f64,
    /// Distance from the axis of the stage (m).
    aside: f64,
}

impl Boom {
    fn body(&self) -> FlexibleBody {
        self.assembly().body().unwrap()
    }

    fn assembly(&self) -> Assembly {
        let node = |name: &str, z: f64| FrameNode { name: name.to_owned(), position: [self.aside, 0.0, z] };
        let section = SectionShape::Tube { radius: 0.015, thickness: 0.001 };
        let material = parts::elastic(1600.0, self.young, 0.3);
        let member = parts::member([0, 1], section, material, 4);
        let part = Part {
            name: "boom".to_owned(),
            kind: PartKind::Frame(Frame {
                nodes: vec![node("root", 1.5), node("tip", 7.5)],
                members: vec![member],
            }),
            masses: vec![TipMass { node: 1, mass: 3.0, inertia: [[0.0; 3]; 3] }],
            attached: vec![0],
            rayleigh: [0.0, self.damping],
        };
        let inertia = parts::diag([1100.0, 1150.0, 300.0]);
        let carrier = parts::carrier(900.0, [0.0; 3], inertia);
        Assembly { carrier: Some(carrier), parts: vec![part], ..Assembly::default() }
    }
}

const TUBE: Boom = Boom { young: 90e9, damping: 1e-3, aside: 0.0 };

fn run(body: &FlexibleBody, omega: [f64; 3], duration: f64, tolerance: f64) -> (Run, Vec<Sample>) {
    let start = FullState::at_rest(body, omega, ALIGNED);
    let times: Vec<f64> = (0..=10).map(|i| duration * f64::from(i) / 10.0).collect();
    let options = Options { tolerance, ..Options::default() };
    let mut samples = Vec::new();
    let run = propagate_full(Forced::not(body), &start, &times, &options, &mut samples).unwrap();
    println!("{:?} at {} s, {:?}", run.outcome, run.last.t, run.work);
    (run, samples)
}

/// Displacement that bends the boom by so much of its length, with a twist and a stretch of the same elastic energy each.
fn bent(body: &FlexibleBody, share: f64) -> Vec<f64> {
    let reaches = &body.watched().reaches;
    let tip = reaches.iter().find(|reach| reach.name.contains("tip")).unwrap();
    let stiffness = body.stiffness();
    let unit: Vec<f64> = stiffness.diagonal().iter().map(|c| c.sqrt().recip()).collect();
    let size = tip.share(&unit);
    unit.iter().map(|q| q * share / size).collect()
}

/// Least eigenvalue of the mass matrix of angular velocity and rates over its diagonal at rest, from momenta.
fn least(body: &FlexibleBody, q: &[f64], momenta: &mut dyn FnMut(MotionState<f64>) -> Vec<f64>) -> f64 {
    let n = q.len();
    let mut matrix = |q: &[f64]| {
        let column = |i: usize, momenta: &mut dyn FnMut(MotionState<f64>) -> Vec<f64>| {
            let (mut omega, mut rate) = ([0.0; 3], vec![0.0; n]);
            if i < 3 {
                omega[i] = 1.0
            } else {
                rate[i - 3] = 1.0
            }
            momenta(MotionState { omega, q, rate: &rate })
        };
        let columns: Vec<Vec<f64>> = (0..3 + n).map(|i| column(i, momenta)).collect();
        DMatrix::from_fn(3 + n, 3 + n, |i, j| columns[j][i])
    };
    let rest = matrix(&vec![0.0; n]);
    let here = matrix(q);
    assert!((&here - here.transpose()).amax() < 1e-10 * here.amax());
    let scaled = DMatrix::from_fn(3 + n, 3 + n, |i, j| here[(i, j)] / (rest[(i, i)] * rest[(j, j)]).sqrt());
    let _ = body;
    scaled.symmetric_eigenvalues().min()
}

/// Issue 17: with momenta of the second order alone the kinetic energy has no lower bound once the boom bends by its radius. A twist of the
/// bent boom swings its tip: the mass matrix must have the same order as the momenta.
#[test]
fn the_kinetic_energy_stays_positive_far_beyond_the_section() {
    let body = TUBE.body();
    for share in [0.0, 1e-3, 0.003, 0.006, 0.05, 0.2] {
        let q = bent(&body, share);
        let second = least(&body, &q, &mut |motion| {
            [&body.angular_momentum(motion)[..], &body.generalized_momentum(motion)].concat()
        });
        let whole = least(&body, &q, &mut |motion| {
            let (K, p) = body.full_momenta(motion);
            [&K[..], &p].concat()
        });
        println!(
            "bent by {share} of the length: least eigenvalue {whole:.2e}, of the second order alone {second:.2e}"
        );
        assert!(whole > 0.0, "{share}: {whole}");
        assert_eq!(second > 0.0, share <= 1e-3, "{share}: {second}");
    }
}

/// Two methods for the second order of the paths: explicit fields, and reciprocity (K6). The momenta differ in the third order alone.
#[test]
fn explicit_paths_agree_with_reciprocity_to_the_second_order() {
    let body = Boom { aside: 0.7, ..TUBE }.body();
    let n = body.coordinates().len();
    let omega = [0.3, -0.8, 1.1];
    let differences = [1e-3, 1e-4].map(|share| {
        let q = bent(&body, share);
        let rate: Vec<f64> = (0..n).map(|j| q[j] * (1.3 + 2.0 * (j as f64).sin())).collect();
        let motion = MotionState { omega, q: &q, rate: &rate };
        let (K, p) = body.full_momenta(motion);
        let known = body.angular_momentum(motion);
        let gap = Vector3::from(K) - Vector3::from(known);
        let largest =
            body.generalized_momentum(motion).iter().zip(&p).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        [gap.norm(), largest]
    });
    let orders = [0, 1].map(|i| (differences[0][i] / differences[1][i]).log10());
    println!("differences {differences:?}, orders {orders:?}");
    // The momenta of the coordinates have the spin beside the rates: their second order is left to the mass matrix.
    assert!(orders[0] > 2.9 && orders[1] > 1.9, "{orders:?}");
}

/// `ṗ = ∂T/∂q`, by differences of the energy at constant velocities.
#[test]
fn loads_are_the_slope_of_the_kinetic_energy() {
    let body = Boom { aside: 0.7, ..TUBE }.body();
    let n = body.coordinates().len();
    let q = bent(&body, 0.1);
    let omega = <[f64; 3]>::from(turned_axes() * Vector3::new(0.3, -0.8, 1.1));
    let rate: Vec<f64> = (0..n).map(|j| q[j] * (1.3 + 2.0 * (j as f64).sin())).collect();
    let mut kinetics = Kinetics::new(&body).unwrap();
    let (K, p) = body.full_momenta(MotionState { omega, q: &q, rate: &rate });
    let mut found = vec![0.0; n];
    let mut back = vec![0.0; n];
    let velocities = kinetics.velocities(K, &p, &q, &mut back);
    assert!((Vector3::from(velocities.omega) - Vector3::from(omega)).norm() < 1e-9);
    velocities.add_loads(&q, &back, &mut found);
    for j in 0..n {
        let step = 1e-4 * bent(&body, 0.1)[j];
        let lagrangian = |sign: f64| {
            let mut moved = q.clone();
            moved[j] += sign * step;
            let motion = MotionState { omega, q: &moved, rate: &rate };
            let forces = body.stiffness().times(&moved);
            let elastic: f64 = forces.iter().zip(&moved).map(|(force, q)| force * q).sum();
            body.full_energy(motion) - elastic
        };
        let expected = (lagrangian(1.0) - lagrangian(-1.0)) / (2.0 * step);
        let damped: f64 = body.damping().row(j).map(|(k, b)| b * rate[k]).sum();
        let scale = (expected.abs() + damped.abs()).max(1e-3 * vec3::norm(K));
        assert!((found[j] + damped - expected).abs() < 1e-6 * scale, "{j}: {} {expected}", found[j] + damped);
    }
}

/// Issue 17: the boom of `beam.toml`, bent by 1.7 cm and more, ran away after 0.67 s; that of `softboom.toml` after 0.3 s.
#[test]
fn issue_0017_booms_run_to_the_end() {
    for (omega, duration) in [([0.0, 0.05, 1.047], 1.2), ([0.0, 0.18, 5.2], 0.4)] {
        let body = TUBE.body();
        let (run, samples) = run(&body, omega, duration, 1e-9);
        assert_eq!(run.outcome, Outcome::Finished);
        let drift = samples.iter().map(|sample| sample.energy_drift.abs()).fold(0.0, f64::max);
        println!("drift {drift:.1e} J of {} J", run.last.energy);
        assert!(drift < 1e-9 * run.last.energy, "{drift}");
    }
}

/// A boom beyond its range ends the run, with its name and its displacement.
#[test]
fn a_boom_beyond_its_range_ends_the_run() {
    let body = Boom { young: 1e9, ..TUBE }.body();
    // The spin along the boom is five times its frequency: nothing keeps the boom on the axis.
    let (run, _) = run(&body, [0.0, 0.3, 1.047], 10.0, 1e-7);
    let Outcome::LeftRange(left) = run.outcome else { panic!("{:?}", run.outcome) };
    let Displaced::Place { reach, share } = left else { panic!("{left:?}") };
    assert!(share > RANGE && share < 1.1 * RANGE, "{left:?}");
    assert_eq!(body.watched().reaches[reach].name, "\"boom\" tip");
    assert!(left.to_string().contains('%'));
}

/// Displacements of the tip across the boom.
struct Tip<'a>(&'a FlexibleBody, Vec<f64>);

impl Observer for Tip<'_> {
    fn sample(&mut self, _: &Sample) {}

    fn coordinates(&mut self, q: &[f64], _: &[f64]) {
        let tip = self.0.watched().reaches.iter().find(|reach| reach.name.contains("tip")).unwrap();
        self.1.push(tip.share(q) * tip.length);
    }
}

/// Angular acceleration of the hub (rad/s²), and the tip at 0.5, 1 and 1.5 s: a chain of rigid links, `rigid_links.py`, to 2e-4.
const CHAIN: [(f64, [f64; 3]); 4] = [
    (0.046257152054794526, [0.040729, 0.127727, 0.185777]),
    (0.15419050684931512, [0.135744, 0.425061, 0.615928]),
    (0.23128576027397263, [0.203576, 0.636159, 0.917128]),
    (0.28987815287671237, [0.255097, 0.795482, 1.140902]),
];

/// A second method at 3, 10, 15 and 19 % of the length. (K14)
#[test]
fn the_tip_follows_a_chain_of_rigid_links() {
    for (acceleration, chain) in CHAIN {
        let boom = TUBE.assembly();
        let carrier = Carrier { mass: 1e6, inertia: parts::diag([1e9, 1e9, 1e9]), ..boom.carrier.unwrap() };
        let force = Force {
            name: "motor".to_owned(),
            law: ForceLaw::Torque {
                torque: [1e9 * acceleration, 0.0, 0.0],
                axes: Axes::Body,
                wave: Wave { frequency: 0.0, phase: 0.0 },
            },
        };
        let support = Support::FixedPoint { point: [0.0; 3] };
        let parts = boom.parts;
        let assembly =
            Assembly { carrier: Some(carrier), parts, support, forces: vec![force], ..Assembly::default() };
        let body = assembly.body().unwrap();
        let forces = assembly.forces().unwrap();
        let start = FullState::at_rest(&body, [1e-9, 0.0, 0.0], ALIGNED);
        let options = Options { tolerance: 1e-7, ..Options::default() };
        let mut tip = Tip(&body, Vec::new());
        let system = Forced { body: &body, forces: &forces };
        let run = propagate_full(system, &start, &[0.5, 1.0, 1.5], &options, &mut tip).unwrap();
        assert_eq!(run.outcome, Outcome::Finished);
        let share = chain[2] / 6.0;
        for (found, exact) in tip.1.iter().zip(chain) {
            println!(
                "{share:.3}: tip {found:.5} m, chain {exact:.5}: {:+.1e} of the largest",
                (found - exact) / chain[2]
            );
            assert!((found - exact).abs() < (share * share + 5e-4) * chain[2], "{found} {exact}");
        }
    }
}

/// A thick undamped boom on a free stage, nutating: nothing but the integrator changes the energy. Over 100 revolutions the drift was
/// 7.5e-8 J of 30.5 J, in 80 s.
#[test]
fn energy_stays_over_many_turns() {
    let mut boom = TUBE.assembly();
    let part = &mut boom.parts[0];
    let PartKind::Frame(frame) = &mut part.kind else { panic!("a frame") };
    frame.members[0].section = SectionShape::Circle { radius: 0.5 };
    frame.members[0].material.young = 2e6;
    frame.members[0].material.density = 100.0;
    frame.members[0].elements = 2;
    part.rayleigh = [0.0; 2];
    let body = boom.body().unwrap();
    let rotations = 10.0;
    let (run, samples) = run(&body, [0.0, 0.02, 0.4], rotations * std::f64::consts::TAU / 0.4, 1e-9);
    assert_eq!(run.outcome, Outcome::Finished);
    let drift = samples.iter().map(|sample| sample.energy_drift.abs()).fold(0.0, f64::max);
    println!("{:.0} turns, drift {drift:.1e} J of {} J", run.last.revolutions, run.last.energy);
    assert!(run.last.revolutions > 0.99 * rotations && drift < 5e-8 * run.last.energy, "{drift}");
}

/// A boom beside a chain of points on springs ten thousand times as stiff as those to the carrier: rounding ends the progress of the
/// displacements early, and they are balanced all the same.
#[test]
fn displacements_that_rounding_disturbs_are_balanced() {
    let mut assembly = Boom { aside: 0.7, ..TUBE }.assembly();
    let mut last = None;
    for (i, x) in [0.3, 0.5, 0.7, 0.9, 1.1, 1.3].into_iter().enumerate() {
        let point = assembly.add(Point::new(format!("point {i}"), 0.2, [x, 0.4 - 0.3 * x, 0.2 * x]));
        assembly.add(Spring::isotropic(30.0, 1.0).between(point, CARRIER));
        if let Some(before) = last.replace(point) {
            assembly.add(Spring::isotropic(3e5, 1.0).between(before, point));
        }
    }
    let body = assembly.body().unwrap();
    assert!(body.paths().is_some());
    for spin in [0.1, 0.17, 0.23, 0.31, 0.4] {
        let omega = [0.1 * spin, -0.2 * spin, spin];
        let q = body.balanced(omega).unwrap().q;
        let slopes = body.about_spin_on_paths(omega, &q).slopes;
        let pulls: Vec<f64> = slopes.iter().map(|slope| 0.5 * vec3::dot(omega, *slope)).collect();
        let held = body.stiffness().times(&q);
        // Forces by the displacements of equal energy that they cause.
        let units = body.stiffness().diagonal().iter().map(|c| c.sqrt()).collect::<Vec<_>>();
        let largest = pulls.iter().zip(&units).map(|(pull, unit)| (pull / unit).abs()).fold(0.0, f64::max);
        for ((pull, held), unit) in pulls.iter().zip(&held).zip(&units) {
            assert!((pull - held).abs() / unit < 1e-9 * largest, "{pull} {held}");
        }
    }
}
