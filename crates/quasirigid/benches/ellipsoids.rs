//! Throughput of the secular evolution of tumbling asteroids, each its own ellipsoid, in lanes and one by one.
#![allow(missing_docs, clippy::print_stdout)]

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use quasirigid::averaging::{
    EllipsoidLoss, Evolution, Response, Wobble, WobblingEllipsoid, ellipsoid_passages,
};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::Rheology;
use quasirigid::prelude::Rounding;
use quasirigid_math::random::Random;
use rayon::prelude::*;

const ASTEROIDS: usize = 1_000_000;
/// Asteroids that a thread takes at a time.
const BLOCK: usize = 4096;
const HOUR: f64 = 3600.0;

fn main() {
    let bodies = drawn();
    for rounding in [Rounding::Fastest, Rounding::Reproducible] {
        let one = seconds(|| ellipsoid_passages(&bodies[..100_000], rounding));
        println!("{rounding:?}, one core: {:.2} µs an asteroid", 1e6 * one / 1e5);
        let start = Instant::now();
        let all: Vec<_> =
            bodies.par_chunks(BLOCK).flat_map_iter(|block| ellipsoid_passages(block, rounding)).collect();
        let (whole, held) =
            (start.elapsed().as_secs_f64(), all.iter().filter(|passage| passage.is_ok()).count());
        println!(
            "{rounding:?}, {} threads: {whole:.2} s for {ASTEROIDS}, of which {held} hold",
            rayon::current_num_threads()
        );
    }
    let few = &bodies[..200];
    let alone = seconds(|| few.iter().map(by_itself).sum::<f64>());
    println!("one by one, 36 coordinates each: {:.2} µs an asteroid", 1e6 * alone / few.len() as f64);
}

fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}

/// Asteroids of 10 m to 10 km that tumble in all modes, half of them about the long axis.
fn drawn() -> Vec<WobblingEllipsoid> {
    let mut random = Random::new(2012);
    let mut unit = || random.unit();
    let mut asteroid = |i: usize| {
        let a = 10f64.powf(1.0 + 3.0 * unit());
        let b = a * (0.3 + 0.65 * unit());
        let c = b * (0.4 + 0.55 * unit());
        let (least, middle) = ((b * b + c * c) / (a * a + b * b), (c * c + a * a) / (a * a + b * b));
        WobblingEllipsoid {
            semi_axes: [a, b, c],
            density: 1000.0 + 2500.0 * unit(),
            shear: 10f64.powf(7.0 + 3.0 * unit()),
            poisson: 0.2 + 0.2 * unit(),
            loss: EllipsoidLoss::QualityFactor(10f64.powf(1.0 + 2.0 * unit())),
            spin: 2.0 * PI / (HOUR * 10f64.powf(0.5 + 2.0 * unit())),
            from: if i.is_multiple_of(2) {
                Wobble::Ratio(least + (middle - least) * unit())
            } else {
                Wobble::Nutation(0.3 + unit())
            },
            until: Wobble::Nutation(5f64.to_radians()),
        }
    };
    (0..ASTEROIDS).map(&mut asteroid).collect()
}

/// Time (s) of an asteroid from its flexible body, its modes and an adaptive quadrature.
fn by_itself(body: &WobblingEllipsoid) -> f64 {
    let EllipsoidLoss::QualityFactor(factor) = body.loss else { return f64::NAN };
    let young = 2.0 * body.shear * (1.0 + body.poisson);
    let material = Material {
        density: body.density,
        young,
        poisson: body.poisson,
        rheology: Rheology::QualityFactor { factor },
    };
    let ellipsoid = Ellipsoid { name: "rock".into(), semi_axes: body.semi_axes, center: [0.0; 3], material };
    let flexible =
        Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().expect("an ellipsoid");
    let response = Response::compute(&flexible).expect("modes");
    let evolution = Evolution::new(&response, body.spin * response.principal().moments[2]);
    let rotation_state = |wobble| match wobble {
        Wobble::Ratio(ratio) => evolution.rotation_state(ratio),
        Wobble::Nutation(angle) => evolution.wobbling(angle),
    };
    rotation_state(body.from)
        .zip(rotation_state(body.until))
        .map_or(f64::NAN, |(from, until)| evolution.time(from, until))
}
