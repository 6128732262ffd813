//! Runs of wobbling mass-spring bodies by other people, and the loss of a body of ours in one. `data/published/quillen_2019`.

use quasirigid::averaging::{FreeRotation, MeanPower, Response};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::{FlexibleBody, Rheology};

const RUNS: &str = include_str!("../../../../data/published/quillen_2019/runs.csv");

/// A run at a steady rate, in the units of the publication.
pub struct SteadyRun {
    pub name: String,
    /// Axis ratios `b`, `c` of the body, of the volume of the unit sphere.
    pub shape: [f64; 2],
    /// Spin in the principal axes of the figure.
    pub omega: [f64; 3],
    /// Young's modulus of the outer parts of the body, estimated.
    pub outer: f64,
    /// Relaxation time of the springs.
    pub time: f64,
    /// Rate of the energy.
    pub measured: f64,
}

/// All runs at a steady rate.
pub fn steady_runs() -> Vec<SteadyRun> {
    RUNS.lines().skip(1).filter_map(steady_run).collect()
}

fn steady_run(line: &str) -> Option<SteadyRun> {
    let (name, rest) = line.split_once(',').unwrap();
    let row: Vec<f64> = rest.split(',').map(|field| field.parse().unwrap()).collect();
    let [b, c, x, y, z, _, outer, time, measured, _, _, steady, ..] = row[..] else { panic!("15 columns") };
    let run = SteadyRun { name: name.to_owned(), shape: [b, c], omega: [x, y, z], outer, time, measured };
    (steady != 0.0).then_some(run)
}

/// Semi-axes of a body with the volume of the unit sphere.
pub fn semi_axes([b, c]: [f64; 2]) -> [f64; 3] {
    let long = (b * c).powf(-1.0 / 3.0);
    [long, long * b, long * c]
}

/// The homogeneous ellipsoid of mass one.
pub fn ellipsoid(shape: [f64; 2], young: f64, time: f64) -> FlexibleBody {
    let material = Material {
        density: 0.75 / std::f64::consts::PI,
        young,
        poisson: 0.25,
        rheology: Rheology::KelvinVoigt { time },
    };
    let ellipsoid =
        Ellipsoid { name: "solid".into(), semi_axes: semi_axes(shape), center: [0.0; 3], material };
    Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().unwrap()
}

/// Mean power at a spin in the principal axes of the figure.
pub fn power(body: &FlexibleBody, omega: [f64; 3]) -> f64 {
    let response = Response::compute(body).unwrap();
    let principal = response.principal();
    let omega = principal.axes.map(|axis| (0..3).map(|i| axis[i] * omega[i]).sum());
    response.mean_power(&FreeRotation::through(principal.moments, omega).unwrap())
}

/// Median of ratios, and the number within a fifth of one.
pub fn summary(ratios: &mut [f64]) -> (f64, usize) {
    ratios.sort_by(f64::total_cmp);
    let near = ratios.iter().filter(|ratio| (0.8..1.2).contains(*ratio)).count();
    (ratios[ratios.len() / 2], near)
}
