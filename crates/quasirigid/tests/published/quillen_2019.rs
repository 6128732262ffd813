//! Wobble damping of N-body mass-spring bodies, simulated by other people, against the Kelvin–Voigt ellipsoid: no
//! parameter is adjusted. `data/published/quillen_2019`.

use quasirigid::averaging::{FreeRotation, MeanPower, Response};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::Rheology;

const RUNS: &str = include_str!("../../../../data/published/quillen_2019/runs.csv");

/// Mean power of the ellipsoid of a run with this Young's modulus.
fn predicted(shape: [f64; 2], omega: [f64; 3], young: f64, time: f64) -> f64 {
    let long = (shape[0] * shape[1]).powf(-1.0 / 3.0); // volume-equivalent radius 1
    let ellipsoid = Ellipsoid {
        name: "network".into(),
        semi_axes: [long, long * shape[0], long * shape[1]],
        center: [0.0; 3],
        material: Material {
            density: 0.75 / std::f64::consts::PI,
            young,
            poisson: 0.25,
            rheology: Rheology::KelvinVoigt { time },
        },
    };
    let body = Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().unwrap();
    let response = Response::of(&body).unwrap();
    let principal = response.principal();
    let omega = principal.axes.map(|axis| (0..3).map(|i| axis[i] * omega[i]).sum());
    response.mean_power(&FreeRotation::through(principal.moments, omega))
}

#[test]
fn dissipation_of_every_steady_run_is_predicted() {
    let mut ratios = Vec::new();
    println!("run       measured    predicted  ratio");
    for line in RUNS.lines().skip(1) {
        let name = line.split(',').next().unwrap();
        let row: Vec<f64> = line.split(',').skip(1).map(|field| field.parse().unwrap()).collect();
        let [b, c, x, y, z, _, outer, time, measured, _, _, steady, ..] = row[..] else {
            panic!("15 columns")
        };
        if steady == 0.0 {
            continue;
        }
        let power = predicted([b, c], [x, y, z], outer, time);
        let ratio = -measured / power;
        println!("{name:<6} {measured:>12.4e} {:>12.4e}  {ratio:.3}", -power);
        ratios.push(ratio);
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    let near = ratios.iter().filter(|ratio| (0.8..1.2).contains(*ratio)).count();
    println!("{} runs, median {median:.3}, {near} within 20 %", ratios.len());
    assert!((median - 1.11).abs() < 0.03, "{median}");
    assert!(near as f64 >= 0.88 * ratios.len() as f64, "{near} of {}", ratios.len());
}
