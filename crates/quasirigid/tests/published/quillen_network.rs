//! N-body runs of the ellipsoid test against networks of the same recipe, solved by the discrete theory: no modulus is needed. The random
//! places of the runs are not known, so each network is another of its kind.

use std::collections::BTreeMap;

use quasirigid::elements::{Assembly, Network};
use quasirigid::model::{FlexibleBody, Rheology};

use super::quillen_runs::{SteadyRun, ellipsoid, power, semi_axes, steady_runs, summary};

/// Stiffness of every spring of the runs.
const STIFFNESS: f64 = 0.08;
/// Distances that give about as many masses and springs as the runs have, 1650 and 21 600.
const SPACING: f64 = 0.119;
const REACH: f64 = 0.279;
/// Modulus and time of the ellipsoid that the network is compared with.
const YOUNG: f64 = 3.0;
const TIME: f64 = 0.01;

/// A network, its numbers of masses and springs, and the body of it for springs of the time [`TIME`].
fn network(shape: [f64; 2]) -> ([usize; 2], FlexibleBody) {
    let network = Network {
        name: "rubble".into(),
        mass: 1.0,
        semi_axes: semi_axes(shape),
        center: [0.0; 3],
        spacing: SPACING,
        reach: REACH,
        stiffness: STIFFNESS,
        rheology: Rheology::KelvinVoigt { time: TIME },
        seed: 1,
    };
    let (points, springs) = network.parts(0);
    let count = [points.len(), springs.len()];
    (count, Assembly { points, springs, ..Assembly::default() }.body().unwrap())
}

#[test]
fn networks_of_the_same_recipe_dissipate_as_the_runs_did() {
    let mut bodies = BTreeMap::new();
    let (mut ratios, mut counts) = (Vec::new(), Vec::new());
    println!("run    masses springs     measured      network  ratio  effective E  outer E of the run");
    for SteadyRun { name, shape, omega, outer, time, measured } in steady_runs() {
        let (count, body) = bodies.entry(shape.map(f64::to_bits)).or_insert_with(|| network(shape));
        let found = power(body, omega);
        let effective = YOUNG * power(&ellipsoid(shape, YOUNG, TIME), omega) / found;
        let ratio = -measured / (found * time / TIME);
        println!(
            "{name:<6} {:>6} {:>7} {measured:>12.4e} {:>12.4e}  {ratio:.3}  {effective:>11.3}  {outer:.3}",
            count[0],
            count[1],
            -found * time / TIME
        );
        ratios.push(ratio);
        counts.push(*count);
    }
    let (median, near) = summary(&mut ratios);
    let mean = |which: usize| counts.iter().map(|count| count[which]).sum::<usize>() / counts.len();
    println!(
        "{} runs, median {median:.3}, {near} within 20 %; {} masses and {} springs on average",
        ratios.len(),
        mean(0),
        mean(1)
    );
    assert!((median - 1.0).abs() < 0.1, "{median}");
}
