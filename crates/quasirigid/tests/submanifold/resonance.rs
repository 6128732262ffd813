//! Resonance met on the way: the frequency of the nutation rises as it decays, and comes to that of a boom that hardly damps.

use std::f64::consts::TAU;

use quasirigid::dynamics::{Forced, FullState, Options, Sample, propagate_full};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::prelude::{Assembly, CARRIER, Carrier, Point, Spring};
use quasirigid::submanifold::{Masters, SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::norm;

use super::derived;

/// Frequency (rad/s) of the boom: that of the nutation at about six degrees.
const BOOM: f64 = 2.785;

/// Satellite with a damper that creeps, and a light mass (kg) on a spring that hardly damps.
fn satellite(mass: f64) -> FlexibleBody {
    let mut satellite = Assembly::default().with(Carrier::principal(100.0, [10.0, 12.0, 16.0]));
    let boom = ("boom", mass, [0.0, 0.5, 0.0], mass * BOOM * BOOM, 0.005 * mass * BOOM);
    let damper = ("damper", 0.1, [0.4, 0.0, 0.2], 0.789, 0.562);
    for (name, mass, position, stiffness, damping) in [damper, boom] {
        let part = satellite.add(Point::new(name, mass, position).along([0.0, 0.0, 1.0]));
        satellite.add(Spring::isotropic(stiffness, damping).between(part, CARRIER));
    }
    satellite.body().unwrap()
}

/// Start at a wobble (degrees) at 60 rpm.
fn start(body: &FlexibleBody, wobble: f64) -> FullState {
    let (sine, cosine) = wobble.to_radians().sin_cos();
    let omega = [TAU * sine * 1.6 * 0.8, TAU * sine * 16.0 / 12.0 * 0.6, TAU * cosine];
    FullState::at_rest(body, omega, ALIGNED)
}

fn manifold<'a>(body: &'a FlexibleBody, from: &FullState, masters: Masters) -> SpinManifold<'a> {
    let (mode, angular_momentum, style) = (Mode::ShortAxis, from.angular_momentum(body), Style::NormalForm);
    derived(body, &SpinManifoldPlan { mode, angular_momentum, masters, degree: 9, style })
}

/// The angle at which the resonance is met is the one at which the full system excites a boom too light to react.
#[test]
fn a_resonance_is_met_where_the_full_system_excites_the_boom() {
    let body = satellite(1e-6);
    let from = start(&body, 10.0);
    let manifold = manifold(&body, &from, Masters::Nutation);
    let crossed = manifold.crossed_resonances(0.3);
    let [crossed] = crossed.as_slice() else { panic!("{crossed:?}") };
    assert!(crossed.name.contains("boom") && crossed.harmonic == 1, "{crossed:?}");
    let mut whole: Vec<Sample> = Vec::new();
    let times: Vec<f64> = (0..=40_000).map(|i| 0.02 * f64::from(i)).collect();
    propagate_full(Forced::not(&body), &from, &times, &Options::default(), &mut whole).unwrap();
    let nutation = nutation_at(&whole, crossed.frequency);
    assert!((crossed.nutation / nutation - 1.0).abs() < 0.05, "{crossed:?} {nutation}");
}

/// Greatest nutation angle (rad) of a history when the frequency of the transverse angular velocity over twenty periods rises to a value.
fn nutation_at(samples: &[Sample], frequency: f64) -> f64 {
    let rises = |pair: &[Sample]| (pair[0].omega[0] < 0.0 && pair[1].omega[0] >= 0.0).then(|| crossing(pair));
    let crossings: Vec<f64> = samples.windows(2).filter_map(rises).collect();
    let turns = crossings.windows(21).find(|turns| 20.0 * TAU / (turns[20] - turns[0]) >= frequency).unwrap();
    let tilt = |sample: &Sample| (sample.angular_momentum[2] / norm(sample.angular_momentum)).acos();
    let within = samples.iter().filter(|sample| turns[0] <= sample.t && sample.t <= turns[20]);
    let [most, least] = [turns[0], turns[19]].map(|from| {
        let turn = within.clone().filter(|sample| (from..from + TAU / frequency).contains(&sample.t));
        turn.map(tilt).fold(0.0, f64::max)
    });
    0.5 * (most + least)
}

fn crossing(pair: &[Sample]) -> f64 {
    let [a, b] = [&pair[0], &pair[1]].map(|sample| sample.omega[0]);
    pair[0].t - a / (b - a) * (pair[1].t - pair[0].t)
}

/// Energies from above the resonance to far below it: two masters follow the boom through, and the nutation alone refuses the start.
#[test]
fn two_masters_go_through_a_resonance() {
    let body = satellite(5e-4);
    let from = start(&body, 10.0);
    let times: Vec<f64> = (0..=4000).map(|i| 0.5 * f64::from(i)).collect();
    let options = Options { tolerance: 1e-10, ..Options::default() };
    let mut whole: Vec<Sample> = Vec::new();
    propagate_full(Forced::not(&body), &from, &times, &options, &mut whole).unwrap();
    let manifold = manifold(&body, &from, Masters::Automatic);
    let mut reduced: Vec<Sample> = Vec::new();
    let begin = manifold.start(&from);
    let run = propagate_on_manifold(&manifold, &begin, &times, &options, &mut reduced).unwrap();
    assert!(run.worst.0.largest() < 1e-3, "{:?}", run.worst);
    let [first, last] = [&whole[0], &whole[4000]].map(|sample| sample.energy - manifold.steady_energy());
    assert!(last < 1e-6 * first, "{first} {last}");
    for (full, reduced) in whole.iter().zip(&reduced).skip(100) {
        let [full, reduced] = [full, reduced].map(|sample| sample.energy - manifold.steady_energy());
        assert!((reduced / full - 1.0).abs() < 1e-3, "{full} {reduced}");
    }
    let alone = self::manifold(&body, &from, Masters::Nutation);
    assert!(alone.range(0.01).nutation < 0.5 * manifold.range(0.01).nutation);
}
