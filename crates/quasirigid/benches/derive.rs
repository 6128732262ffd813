//! Time to derive the reduced equations of ten sprung points (30 coordinates), of more of them, and of bodies of a thousand coordinates:
//! sprung points alone, the same in a network whose stiffness is full, and a part of given modes, whose inertia couples every pair.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::elements::{
    Assembly, Carrier, Coefficient, End, GivenModes, NodalMass, Part, PartKind, PartReduction, Spectrum,
    Spring, SpringLaw,
};
use quasirigid::model::{FlexibleBody, Rheology};
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;

fn main() {
    divan::main();
}

#[divan::bench(args = [1, 2, 3, 5, 7])]
fn ten_points_at_order(bencher: Bencher, order: usize) {
    let body = ring_of_points(10).body().expect("the ring has an equilibrium");
    bencher.bench(|| reduce(&body, order));
}

#[divan::bench(args = [10, 100, 1000, 10_000, 100_000], sample_count = 5)]
fn assembly_of_points(bencher: Bencher, count: usize) {
    let assembly = ring_of_points(count);
    bencher.bench(|| assembly.body());
}

#[divan::bench(args = [10, 100, 1000, 10_000, 100_000], sample_count = 5)]
fn points_at_order_three(bencher: Bencher, count: usize) {
    let body = ring_of_points(count).body().expect("the ring has an equilibrium");
    bencher.bench(|| reduce(&body, 3));
}

#[divan::bench(args = [5, 7], sample_count = 3, sample_size = 1)]
fn ring_of_999_coordinates(bencher: Bencher, order: usize) {
    let body = ring_of_points(POINTS).body().expect("the ring has an equilibrium");
    bencher.bench(|| reduce(&body, order));
}

#[divan::bench(args = [5, 7], sample_count = 3, sample_size = 1)]
fn isotropic_points_of_999_coordinates(bencher: Bencher, order: usize) {
    let body = isotropic().body().expect("the points have an equilibrium");
    bencher.bench(|| reduce(&body, order));
}

#[divan::bench(args = [5, 7], sample_count = 3, sample_size = 1)]
fn network_of_999_coordinates(bencher: Bencher, order: usize) {
    let body = network().body().expect("the network has an equilibrium");
    bencher.bench(|| reduce(&body, order));
}

#[divan::bench(args = [5, 7], sample_count = 3, sample_size = 1)]
fn given_modes(bencher: Bencher, order: usize) {
    let body = modal(order);
    bencher.bench(|| reduce(&body, order));
}

const POINTS: usize = 333;

fn spring(name: String, from: usize, to: End, stiffness: f64, damping: f64) -> Spring {
    let law = SpringLaw::Spatial {
        stiffness: Coefficient::Isotropic(stiffness),
        damping: Coefficient::Isotropic(damping),
    };
    Spring { name, from: End::Point(from), to, law, rheology: Rheology::Elastic }
}

/// Each point on an isotropic spring of its own.
fn isotropic() -> Assembly {
    let springs = (0..POINTS).map(|i| spring(String::new(), i, End::Carrier, 900.0 + 40.0 * i as f64, 9.0));
    Assembly { springs: springs.collect(), ..ring_of_points(POINTS) }
}

/// Every two points joined by a spring as well.
fn network() -> Assembly {
    let mut network = isotropic();
    let pairs = (0..POINTS).flat_map(|i| (0..i).map(move |j| (i, j)));
    let joined =
        pairs.map(|(i, j)| spring(String::new(), i, End::Point(j), 2.0 + (i as f64 * j as f64).sin(), 0.0));
    network.springs.extend(joined);
    network
}

/// Discrete sine waves of a string of masses along each axis, on a carrier.
fn modal(order: usize) -> FlexibleBody {
    const NODES: usize = 40;
    let wave = |node: usize, mode: usize| {
        (std::f64::consts::PI * (node + 1) as f64 * (mode + 1) as f64 / (NODES + 1) as f64).sin()
    };
    let rows = 3 * NODES;
    let shape = |row: usize, mode: usize| if row % 3 == mode % 3 { wave(row / 3, mode / 3) } else { 0.0 };
    let place = |node: usize| {
        let x = node as f64 / NODES as f64;
        [1.0 + x, 0.3 * (4.0 * x).sin(), 0.2 * (5.0 * x).cos()]
    };
    let modes = GivenModes {
        mass: NodalMass {
            nodes: (0..NODES).map(place).collect(),
            node_labels: (0..NODES as u64).collect(),
            dofs: (0..rows).map(|row| (row / 3, row % 3)).collect(),
            entries: (0..rows).map(|row| (row, row, 0.1)).collect(),
        },
        shapes: (0..rows).map(|row| (0..rows).map(|mode| shape(row, mode)).collect()).collect(),
        interface: Vec::new(),
        spectrum: Spectrum::Modes {
            frequencies: (0..rows).map(|mode| 30.0 + 4.0 * mode as f64).collect(),
            damping_ratios: vec![0.02; rows],
        },
        rheology: Rheology::Elastic,
    };
    let part = Part {
        name: "string".to_owned(),
        kind: PartKind::Modes(modes),
        masses: Vec::new(),
        attached: Vec::new(),
        rayleigh: [0.0; 2],
    };
    let carrier = Carrier {
        mass: 30.0,
        center_of_mass: [0.1, -0.05, 0.02],
        inertia: [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]],
    };
    let reduction = PartReduction { order, modes: 0 };
    let assembly = Assembly { carrier: Some(carrier), parts: vec![part], reduction, ..Assembly::default() };
    assembly.body().expect("the string is held by its modes")
}
