//! Averaged secular evolution against closed forms and against the reduced equations themselves.

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, PolynomialPower, RotationState};
use quasirigid::dynamics::{Forced, Options, Sample, Start, propagate, propagate_full};
use quasirigid::elements::Assembly;
use quasirigid::model::{Mode, Principal, ReducedBody};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::norm;

use crate::support::parts;
use crate::support::sprung_body;

const AXIAL: AxialMass = AxialMass { carrier: 2.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.4 };

/// The closed time law of a mass on the axis, over nine tenths of the way. (X2)
#[test]
fn mass_on_the_axis_ages_by_its_closed_law() {
    let body = AXIAL.assembly().body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    let G = 1.4;
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, G);
    // u = cos² of the nutation; 1/D = u/C + (1 − u)/A.
    let ratio = |u: f64| 1.0 / (AXIAL.C * (u / AXIAL.C + (1.0 - u) / AXIAL.A));
    let rotation_state = |u: f64| evolution.rotation_state(ratio(u)).unwrap();
    for (from, to) in [(0.1, 0.9), (0.5, 0.999), (0.05, 0.06), (0.9, 0.2)] {
        let found = evolution.time(rotation_state(from), rotation_state(to));
        let expected = AXIAL.time(G, from, to);
        assert!((found / expected - 1.0).abs() < 1e-10, "{from} to {to}: {found} {expected}");
    }
}

/// Nothing is dissipated: no time leads anywhere, neither forwards nor to minus infinity.
#[test]
fn without_power_no_stage_is_ever_reached() {
    let undamped = AxialMass { b: 0.0, ..AXIAL };
    let reduced = reduce(&undamped.assembly().body().unwrap(), 3).unwrap();
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, 1.4);
    let [from, to] = [0.3, 0.7].map(|share| evolution.rotation_state(1.0 / 1.5 + share / 3.0).unwrap());
    assert!(evolution.power(from) == 0.0 && evolution.power(from).is_sign_positive());
    assert_eq!(evolution.time(from, to), f64::INFINITY);
}

/// A triaxial body with two masses off every axis, the stiffer the smaller `ε`.
pub fn tumbler(epsilon: f64) -> Assembly {
    let carrier = parts::carrier(40.0, [0.0; 3], parts::diag([9.0, 13.0, 16.0]));
    let sprung = |mass, position, stiffness: f64| {
        parts::sprung(mass, position, [stiffness / epsilon.powi(2); 3], [30.0 / epsilon; 3])
    };
    sprung_body(carrier, &[sprung(1.0, [0.4, 1.0, 0.5], 120.0), sprung(1.3, [-0.6, 0.5, -0.7], 150.0)])
}

/// Times in which `D/I₃` reaches 0.97 from a spin, by the reduced equations of these orders and by the full system if asked for: relative
/// differences from the averaged time, each with the energy dissipated half-way.
fn gaps_in_time(epsilon: f64, omega: [f64; 3], mode: Mode, orders: &[usize], full: bool) -> Vec<[f64; 2]> {
    let body = tumbler(epsilon).body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    let Principal { moments, .. } = Principal::compute(reduced.J);
    let G = norm(reduced.angular_momentum(omega));
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, G);
    let ratio = |sample: &Sample| norm(sample.angular_momentum).powi(2) / (2.0 * sample.energy * moments[2]);
    let averaged = |start: &Sample| {
        let (from, to) =
            (evolution.rotation_state(ratio(start)).unwrap(), evolution.rotation_state(0.97).unwrap());
        assert_eq!((from.mode, to.mode), (mode, Mode::ShortAxis));
        evolution.time(from, to)
    };
    let longest = 1.2
        * evolution
            .time(rotation_state_of(&evolution, &reduced, omega), evolution.rotation_state(0.97).unwrap());
    let grid: Vec<f64> = (0..=4000).map(|i| longest * f64::from(i) / 4000.0).collect();
    let options = Options { tolerance: 1e-11, ..Options::default() };
    let mut histories = Vec::new();
    for order in orders {
        let mut samples = Vec::new();
        let start = Start::new(omega, ALIGNED);
        let reduced = reduce(&body, *order).unwrap();
        propagate(&reduced, start, &grid, &options, &mut samples).unwrap();
        histories.push(samples);
    }
    if full {
        let mut samples = Vec::new();
        let start = Start::new(omega, ALIGNED);
        let settled = start.settled(Forced::not(&body), 5).unwrap();
        propagate_full(Forced::not(&body), &settled, &grid, &options, &mut samples).unwrap();
        histories.push(samples);
    }
    let gap = |samples: &Vec<Sample>| {
        let after = samples.iter().position(|sample| ratio(sample) >= 0.97).unwrap();
        let [a, b] = [&samples[after - 1], &samples[after]].map(|sample| (sample.t, ratio(sample)));
        let reached = a.0 + (b.0 - a.0) * (0.97 - a.1) / (b.1 - a.1);
        [reached / averaged(&samples[0]) - 1.0, samples[grid.len() / 2].dissipated]
    };
    let gaps: Vec<[f64; 2]> = histories.iter().map(gap).collect();
    println!("epsilon {epsilon}: {longest:.0} s, gaps {gaps:?}");
    gaps
}

fn rotation_state_of(
    evolution: &Evolution<impl MeanPower>,
    reduced: &ReducedBody,
    omega: [f64; 3],
) -> RotationState {
    let G = norm(reduced.angular_momentum(omega));
    evolution
        .rotation_state(G * G / (2.0 * reduced.energy(omega) * Principal::compute(reduced.J).moments[2]))
        .unwrap()
}

/// The error of averaging over rigid polhodes, the elastic part of energy and angular momentum, falls as `ε²`.
#[test]
fn averaged_time_is_the_reduced_time_the_better_the_stiffer_the_body() {
    let gaps = [1.0, 0.5, 0.25]
        .map(|epsilon| gaps_in_time(epsilon, [0.4, 0.2, 0.9], Mode::ShortAxis, &[3], false)[0][0].abs());
    let orders = [gaps[0] / gaps[1], gaps[1] / gaps[2]].map(f64::log2);
    assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.15), "{gaps:?} {orders:?}");
}

/// Full, reduced, averaged: the differences fall as theory says. The full system departs from the paper's equations by `ε²` of the
/// dissipation, from those of order 5 by `ε⁴`; averaging costs `ε²`.
#[test]
fn full_reduced_and_averaged_histories_close_up() {
    let [coarse, fine] =
        [1.0, 0.5].map(|epsilon| gaps_in_time(epsilon, [0.4, 0.2, 0.9], Mode::ShortAxis, &[3, 5], true));
    let order = |coarse: f64, fine: f64| (coarse / fine).abs().log2();
    let taken = |gaps: &[[f64; 2]], system: usize| gaps[system][1] / gaps[2][1] - 1.0;
    let [paper, fifth] = [0, 1].map(|system| order(taken(&coarse, system), taken(&fine, system)));
    let averaged = order(coarse[2][0], fine[2][0]);
    println!("{coarse:?} {fine:?}");
    println!("orders: full to p = 3 {paper}, full to p = 5 {fifth}, full to averaged {averaged}");
    assert!((paper - 2.0).abs() < 0.2 && (averaged - 2.0).abs() < 0.2, "{paper} {averaged}");
    assert!((fifth - 4.0).abs() < 0.3, "{fifth}");
}

/// Through the separatrix, where the phase on arrival decides on a fraction of a revolution.
#[test]
fn averaged_time_leads_through_the_separatrix() {
    let gap = gaps_in_time(0.5, [1.0, 0.35, 0.3], Mode::LongAxis, &[3], false)[0][0].abs();
    assert!(gap < 1e-3, "{gap}");
}

/// The mean of the square of a component is an elliptic integral; here by brute force over many points.
#[test]
fn mean_over_a_polhode_needs_few_points() {
    for (mode, xi) in [
        (Mode::ShortAxis, 3.0),
        (Mode::ShortAxis, -8.0),
        (Mode::LongAxis, -20.0),
        (Mode::LongAxis, 0.0),
        (Mode::ShortAxis, 60.0),
    ] {
        let motion = FreeRotation::at_logit([0.61, 0.965, 1.0], 1.0, mode, xi);
        let value =
            |omega: [f64; 3]| (omega[0] * omega[1]).powi(2) * omega[2] + omega[1].powi(6) + omega[2].powi(4);
        let points = 40_000;
        let brute = (0..points)
            .map(|i| value(motion.omega(motion.polhode_period() * f64::from(i) / f64::from(points))))
            .sum::<f64>()
            / f64::from(points);
        let mut calls = 0;
        let found = motion.mean(6, |omega| {
            calls += 1;
            value(omega)
        });
        assert!((found / brute - 1.0).abs() < 1e-13, "{mode:?} {xi}: {found} {brute}");
        assert!(calls < 600, "{calls} points");
    }
}

/// The time next to the separatrix is that between the places a hundredth of the way to either axis, as `D` measures it; of a way that ends
/// or begins in between it is the part.
#[test]
fn the_time_next_to_the_separatrix_is_that_between_its_hundredths() {
    let reduced = reduce(&tumbler(0.05).body().unwrap(), 3).unwrap();
    let [I1, I2, I3] = Principal::compute(reduced.J).moments;
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, 20.0);
    let long = |share: f64| evolution.rotation_state((I2 + share * (I1 - I2)) / I3).unwrap();
    let short = |share: f64| evolution.rotation_state((I2 + share * (I3 - I2)) / I3).unwrap();
    assert_eq!((long(0.01).mode, short(0.01).mode), (Mode::LongAxis, Mode::ShortAxis));
    for ([from, to], [low, high]) in [
        ([long(0.8), short(0.9)], [long(0.01), short(0.01)]),
        ([long(0.004), short(0.9)], [long(0.004), short(0.01)]),
        ([long(0.8), short(0.002)], [long(0.01), short(0.002)]),
    ] {
        let (found, expected) = (evolution.lingering(from, to).unwrap(), evolution.time(low, high));
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
    assert_eq!(evolution.lingering(short(0.02), short(0.9)), None);
    assert_eq!(evolution.lingering(long(0.8), long(0.02)), None);
}
