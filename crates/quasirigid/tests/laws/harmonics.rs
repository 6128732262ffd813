//! Harmonics of a free rotation, and the response of a body to them.

use std::f64::consts::TAU;

use proptest::prelude::*;
use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, PolynomialPower, Response, RotationState};
use quasirigid::dynamics::{Forced, FullState, Options, Sample, propagate_full};
use quasirigid::elements::{Assembly, Coefficient, End, SpringLaw};
use quasirigid::model::{Measured, Mode, Rheology};
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::dot;

use super::evolution::tumbler;
use crate::support::parts;
use crate::support::transform::{rotated, stiffened};
use crate::support::{bodies, cases, rotation};

const MOMENTS: [f64; 3] = [0.61, 0.965, 1.0];

/// The series in the nome against the Fourier sums of the spin itself, from axis to separatrix and on a body of revolution.
#[test]
fn harmonics_are_the_fourier_series_of_the_products() {
    let triaxial = [-22.0, -6.0, 0.0, 4.0, 30.0].map(|xi| (MOMENTS, xi));
    let round = [([0.7, 0.7, 1.0], Mode::ShortAxis, 0.3), ([0.7, 1.0, 1.0], Mode::LongAxis, -1.0)];
    let cases = triaxial
        .into_iter()
        .flat_map(|(I, xi)| [(I, Mode::ShortAxis, xi), (I, Mode::LongAxis, xi)])
        .chain(round);
    for (I, mode, xi) in cases {
        let motion = FreeRotation::at_logit(I, 1.3, mode, xi);
        let period = motion.polhode_period();
        let points = 3000;
        let products: Vec<[f64; 6]> = (0..points)
            .map(|i| {
                let [x, y, z] = motion.omega(period * f64::from(i) / f64::from(points));
                [x * x, y * y, z * z, y * z, z * x, x * y]
            })
            .collect();
        let largest = products.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        let mut seen = 0;
        for harmonic in motion.harmonics() {
            assert!((harmonic.frequency * period / TAU / harmonic.number as f64 - 1.0).abs() < 1e-14);
            for product in 0..6 {
                let sums = (0..points).map(|i| {
                    let angle = TAU * harmonic.number as f64 * f64::from(i) / f64::from(points);
                    [angle.cos(), -angle.sin()]
                        .map(|wave| products[i as usize][product] * wave / f64::from(points))
                });
                let sum = sums.fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
                for (part, sum) in harmonic.products.iter().zip(sum) {
                    assert!(
                        (part[product] - sum).abs() < 3e-15 * largest,
                        "{mode:?} {xi} {product} {harmonic:?} {sum}"
                    );
                }
            }
            seen = harmonic.number;
        }
        assert!(seen >= 2, "{seen} harmonics");
    }
}

/// The polynomial is the limit of low frequencies; the response departs from it by the square of the small parameter.
#[test]
fn response_becomes_the_polynomial_power_at_low_frequencies() {
    for (mode, xi) in [(Mode::ShortAxis, 0.5), (Mode::LongAxis, 1.0)] {
        let gaps = [1.0, 0.5, 0.25].map(|epsilon| {
            let body = tumbler(0.5 * epsilon).body().unwrap();
            let (polynomial, response) = (
                PolynomialPower::from_reduced(&reduce(&body, 3).unwrap()),
                Response::compute(&body).unwrap(),
            );
            let motion = FreeRotation::at_logit(response.moments(), 18.0, mode, xi);
            response.mean_power(&motion) / polynomial.mean_power(&motion) - 1.0
        });
        let orders = [gaps[0] / gaps[1], gaps[1] / gaps[2]].map(f64::log2);
        println!("{mode:?}: gaps {gaps:?}, orders {orders:?}");
        assert!((orders[1] - 2.0).abs() < 0.05 && gaps[2].abs() < 0.02, "{gaps:?} {orders:?}");
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// Any body, far below its frequencies, takes the power of its polynomial; a rotation of the axes changes nothing.
    #[test]
    fn slow_bodies_take_the_polynomial_power(assembly in bodies(), R in rotation(), xi in -3.0..6.0, long in any::<bool>()) {
        let assembly = stiffened(&assembly, 1e8, 1e4);
        let body = assembly.body().unwrap();
        let (polynomial, response) =
            (PolynomialPower::from_reduced(&reduce(&body, 3).unwrap()), Response::compute(&body).unwrap());
        let mode = if long { Mode::LongAxis } else { Mode::ShortAxis };
        let slow = 1e-3 * response.frequencies().next().unwrap().0 * response.moments()[0];
        let motion = FreeRotation::at_logit(response.moments(), slow, mode, xi);
        let [expected, found] = [&polynomial as &dyn MeanPower, &response].map(|power| power.mean_power(&motion));
        prop_assert!((found / expected - 1.0).abs() < 1e-4, "{found:e} {expected:e}");
        let turned = Response::compute(&rotated(&assembly, &R).body().unwrap()).unwrap();
        let again = turned.mean_power(&FreeRotation::at_logit(turned.moments(), slow, mode, xi));
        prop_assert!((again / found - 1.0).abs() < 1e-8, "{again:e} {found:e}");
    }
}

/// A table of the loss tangent 1/50 is a quality factor of 50, spring by spring; one law for all springs or two equal ones
/// that have to be coupled.
#[test]
fn laws_may_differ_from_spring_to_spring() {
    let constant = Rheology::QualityFactor { factor: 50.0 };
    let measured = Rheology::Table(Measured::new(vec![[1e-3, 1.0, 0.02], [1e3, 1.0, 0.02]]).unwrap());
    let power = |rheologies: [&Rheology; 2]| {
        let mut assembly = tumbler(1.0);
        for (spring, rheology) in assembly.springs.iter_mut().zip(rheologies) {
            spring.rheology = rheology.clone();
            let SpringLaw::Spatial { damping, .. } = &mut spring.law else { panic!("a spatial law") };
            *damping = Coefficient::Isotropic(0.0);
        }
        let response = Response::compute(&assembly.body().unwrap()).unwrap();
        response.mean_power(&FreeRotation::at_logit(response.moments(), 18.0, Mode::ShortAxis, 0.5))
    };
    let [one, other, mixed] =
        [[&constant, &constant], [&measured, &measured], [&constant, &measured]].map(power);
    assert!((one / other - 1.0).abs() < 1e-12 && (one / mixed - 1.0).abs() < 1e-10, "{one} {other} {mixed}");
    let [left, right] = [[&constant, &Rheology::Elastic], [&Rheology::Elastic, &constant]].map(power);
    assert!(((left + right) / one - 1.0).abs() < 1e-3, "{left} {right} {one}");
}

/// A body with a light damper mass at the rim that moves along the axis of spin.
fn with_damper(stiffness: f64, damping: f64, mass: f64) -> Assembly {
    Assembly {
        carrier: Some(parts::carrier(100.0, [0.0; 3], parts::diag([10.0, 12.0, 16.0]))),
        points: vec![parts::line_point("damper", mass, [1.5, 0.4, 0.0], [0.0, 0.0, 1.0])],
        springs: vec![parts::spring(End::Point(0), End::Carrier, parts::isotropic(stiffness, damping))],
        ..Assembly::default()
    }
}

/// A nutation damper tuned below, to, and above the frequency of the polhode: the full system takes in twenty periods the power of the
/// response, within 1 %. The paper's power, which has no resonance, is off by a factor.
#[test]
fn response_is_that_of_the_full_system_at_resonance() {
    let (mass, ratio) = (2e-5, 0.1);
    // The wobble softens the spring by its square, which the response leaves out.
    let omega = [0.01, 0.0, 1.0];
    for tuning in [0.7, 0.95, 1.0, 1.05, 1.6] {
        let polhode = {
            let light = with_damper(1.0, 1.0, mass).body().unwrap();
            let response = Response::compute(&light).unwrap();
            TAU / FreeRotation::through(response.moments(), omega).unwrap().polhode_period()
        };
        let frequency = tuning * polhode;
        let body =
            with_damper(mass * frequency * frequency, 2.0 * ratio * mass * frequency, mass).body().unwrap();
        let response = Response::compute(&body).unwrap();
        let period = TAU / polhode;
        let times = [40.0 * period, 60.0 * period];
        let mut samples = Vec::new();
        let start = FullState::at_rest(&body, omega, ALIGNED);
        let options = Options { tolerance: 1e-13, ..Options::default() };
        propagate_full(Forced::not(&body), &start, &times, &options, &mut samples).unwrap();
        let measured = (samples[1].dissipated - samples[0].dissipated) / (times[1] - times[0]);
        let axes = response.principal().axes;
        let motion = |sample: &Sample| {
            let in_axes = axes.map(|axis| dot(axis, sample.omega));
            FreeRotation::through(response.moments(), in_axes).unwrap()
        };
        let [from, to] = [&samples[0], &samples[1]].map(|sample| response.mean_power(&motion(sample)));
        let predicted = 0.5 * (from + to);
        let polynomial =
            PolynomialPower::from_reduced(&reduce(&body, 3).unwrap()).mean_power(&motion(&samples[0]));
        println!(
            "tuned to {tuning}: full {measured:.5e} W, response {predicted:.5e} W ({:+.3} %), polynomial {polynomial:.3e} W",
            100.0 * (measured / predicted - 1.0)
        );
        assert!((measured / predicted - 1.0).abs() < 0.01, "{tuning}: {measured:e} {predicted:e}");
        assert!(tuning != 1.0 || (polynomial / measured - 1.0).abs() > 0.5);
    }
}

/// Where a harmonic meets the elastic frequency, its frequency is that one, and the power has a peak.
#[test]
fn crossings_are_where_harmonics_meet_elastic_frequencies() {
    let body = with_damper(2e-5 * 0.09, 2e-5 * 0.006, 2e-5).body().unwrap();
    let response = Response::compute(&body).unwrap();
    let evolution = Evolution::new(&response, 16.0);
    let crossings = response.resonances(&evolution);
    assert!(crossings.len() >= 4, "{crossings:?}");
    for crossing in &crossings {
        let polhode = TAU / evolution.motion(crossing.rotation_state).polhode_period();
        assert!((polhode * crossing.harmonic as f64 / crossing.frequency - 1.0).abs() < 1e-12);
        assert_eq!(crossing.coordinate, "\"damper\" along its line");
    }
    let strongest = &crossings[0];
    assert_eq!(strongest.harmonic, 1);
    let power = |shift: f64| {
        evolution.power(RotationState { xi: strongest.rotation_state.xi + shift, ..strongest.rotation_state })
    };
    assert!(power(0.0) > 2.0 * power(0.5) && power(0.0) > 2.0 * power(-0.5));
}
