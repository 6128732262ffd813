//! Averaged evolution of a tumbling asteroid over ten billion years.
#![allow(missing_docs, non_snake_case)]

use quasirigid::averaging::{
    Evolution, MeanPower, ObservedPeriods, PolynomialPower, Response, RotationState,
};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::{FlexibleBody, Mode, Rheology};
use quasirigid::reduction::reduce;

const HOUR: f64 = 3600.0;
const TEN_BILLION_YEARS: f64 = 31_557_600e10;

fn main() {
    divan::main();
}

/// (99942) Apophis as in `examples/apophis`.
fn apophis(rheology: Rheology) -> FlexibleBody {
    let ellipsoid = Ellipsoid {
        name: "Apophis".into(),
        semi_axes: [219.1, 151.2, 142.7],
        center: [0.0; 3],
        material: Material { density: 2020.0, young: 1.25e9, poisson: 0.25, rheology },
    };
    Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().expect("an ellipsoid")
}

fn constant() -> FlexibleBody {
    apophis(Rheology::QualityFactor { factor: 1000.0 })
}

fn viscous() -> FlexibleBody {
    apophis(Rheology::KelvinVoigt { time: 100.0 })
}

/// Angular momentum and rotation state of the observed periods.
fn start(moments: [f64; 3]) -> (f64, f64) {
    let observed =
        ObservedPeriods { rotation: 263.0 * HOUR, precession: 27.38 * HOUR, mode: Mode::ShortAxis };
    let motion = observed.motion(moments).expect("the observed periods");
    let G = motion.angular_momentum();
    (G, G * G / (2.0 * motion.energy() * moments[2]))
}

fn ten_billion_years(power: &dyn MeanPower, (G, ratio): (f64, f64)) -> Option<RotationState> {
    let evolution = Evolution::new(power, G);
    evolution.after(evolution.rotation_state(ratio)?, TEN_BILLION_YEARS)
}

#[divan::bench]
fn by_harmonics(bencher: divan::Bencher) {
    let response = Response::compute(&constant()).expect("modes");
    let start = start(response.moments());
    bencher.bench_local(|| ten_billion_years(&response, start));
}

#[divan::bench]
fn by_polynomial(bencher: divan::Bencher) {
    let power = PolynomialPower::from_reduced(&reduce(&viscous(), 3).expect("order 3"));
    let start = start(power.moments());
    bencher.bench_local(|| ten_billion_years(&power, start));
}

/// From semi-axes and observed periods to the state after ten billion years.
#[divan::bench]
fn whole_body(bencher: divan::Bencher) {
    bencher.bench_local(|| {
        let response = Response::compute(&constant()).expect("modes");
        ten_billion_years(&response, start(response.moments()))
    });
}

#[divan::bench]
fn body_alone(bencher: divan::Bencher) {
    bencher.bench_local(constant);
}

#[divan::bench]
fn modes_alone(bencher: divan::Bencher) {
    let body = constant();
    bencher.bench_local(|| Response::compute(&body));
}

#[divan::bench]
fn observed_start(bencher: divan::Bencher) {
    let moments = Response::compute(&constant()).expect("modes").moments();
    bencher.bench_local(|| start(moments));
}
