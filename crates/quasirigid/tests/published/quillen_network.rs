//! The same N-body runs against networks of the same recipe, solved by the discrete theory: no modulus is needed. The random
//! places of the runs are not known, so each network is another of its kind. `data/published/quillen_2019`.

use std::collections::BTreeMap;

use quasirigid::averaging::{FreeRotation, MeanPower, Response};
use quasirigid::elements::{Assembly, Ellipsoid, Material, Network};
use quasirigid::model::{FlexibleBody, Rheology};

const RUNS: &str = include_str!("../../../../data/published/quillen_2019/runs.csv");
/// Stiffness of every spring of the runs.
const STIFFNESS: f64 = 0.08;
/// Distances that give about as many masses and springs as the runs have, 1650 and 21 600.
const SPACING: f64 = 0.119;
const REACH: f64 = 0.279;
/// Modulus and time of the ellipsoid that the network is compared with.
const YOUNG: f64 = 3.0;
const TIME: f64 = 0.01;

/// Semi-axes of a body with the volume of the unit sphere.
fn semi_axes([b, c]: [f64; 2]) -> [f64; 3] {
    let long = (b * c).powf(-1.0 / 3.0);
    [long, long * b, long * c]
}

/// A network, its numbers of masses and springs, and the body it is for springs of the time [`TIME`].
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

fn ellipsoid(shape: [f64; 2]) -> FlexibleBody {
    let material = Material {
        density: 0.75 / std::f64::consts::PI,
        young: YOUNG,
        poisson: 0.25,
        rheology: Rheology::KelvinVoigt { time: TIME },
    };
    let ellipsoid =
        Ellipsoid { name: "solid".into(), semi_axes: semi_axes(shape), center: [0.0; 3], material };
    Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().unwrap()
}

/// Mean power at a spin in the principal axes of the figure.
fn power(body: &FlexibleBody, omega: [f64; 3]) -> f64 {
    let response = Response::of(body).unwrap();
    let principal = response.principal();
    let omega = principal.axes.map(|axis| (0..3).map(|i| axis[i] * omega[i]).sum());
    response.mean_power(&FreeRotation::through(principal.moments, omega))
}

#[test]
fn networks_of_the_same_recipe_dissipate_as_the_runs_did() {
    let mut bodies = BTreeMap::new();
    let (mut ratios, mut counts) = (Vec::new(), Vec::new());
    println!("run    masses springs     measured      network  ratio  effective E  outer E of the run");
    for line in RUNS.lines().skip(1) {
        let name = line.split(',').next().unwrap();
        let row: Vec<f64> = line.split(',').skip(1).map(|field| field.parse().unwrap()).collect();
        let [b, c, x, y, z, _, outer, time, measured, _, _, steady, ..] = row[..] else {
            panic!("15 columns")
        };
        if steady == 0.0 {
            continue;
        }
        let key = [b, c].map(f64::to_bits);
        let (count, body) = bodies.entry(key).or_insert_with(|| network([b, c]));
        let found = power(body, [x, y, z]);
        let effective = YOUNG * power(&ellipsoid([b, c]), [x, y, z]) / found;
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
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    let near = ratios.iter().filter(|ratio| (0.8..1.2).contains(*ratio)).count();
    let mean = |which: usize| counts.iter().map(|count| count[which]).sum::<usize>() / counts.len();
    println!(
        "{} runs, median {median:.3}, {near} within 20 %; {} masses and {} springs on average",
        ratios.len(),
        mean(0),
        mean(1)
    );
    assert!((median - 1.0).abs() < 0.1, "{median}");
}
