//! Angular momentum and energy of a free body with internal rotors and liquids in motion.

use quasirigid::dynamics::{Forced, FullState, Observer, Options, Outcome, Sample, propagate_full};
use quasirigid_math::rotation::{to_inertial, turned};
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies::everything;

/// Samples, and the whole state at each.
#[derive(Default)]
struct History {
    samples: Vec<Sample>,
    inside: Vec<(Vec<f64>, Vec<f64>)>,
}

impl Observer for History {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        self.inside.push((q.to_vec(), rate.to_vec()));
    }
}

impl History {
    fn states(&self) -> impl Iterator<Item = FullState> {
        self.samples.iter().zip(&self.inside).map(|(sample, (q, rate))| FullState {
            omega: sample.omega,
            attitude: sample.attitude,
            q: q.clone(),
            rate: rate.clone(),
            place: [0.0; 3],
            velocity: [0.0; 3],
        })
    }
}

/// Released with all internal elements in motion: the angular momentum of all parts is conserved, and the energy that they lose is `∫q̇ᵀBq̇
/// dt`. (C5)
#[test]
fn momentum_stays_and_friction_takes_the_energy() {
    let body = everything().body().unwrap();
    let mut released =
        FullState::at_rest(&body, [0.5, 0.7, 0.9], turned([1.0, 0.0, 0.0, 0.0], [0.3, -0.2, 0.4]));
    body.cyclic().enumerate().for_each(|(i, j)| released.rate[j] = 2.0 * (1.0 + i as f64).sin());
    // Dense at the start, where the fast relaxations are: t = T s³.
    let (end, steps) = (3.0, 2000);
    let s: Vec<f64> = (0..=steps).map(|i| f64::from(i) / f64::from(steps)).collect();
    let times: Vec<f64> = s.iter().map(|s| end * s.powi(3)).collect();
    let mut history = History::default();
    let options = Options { tolerance: 1e-13, ..Options::default() };
    let run = propagate_full(Forced::not(&body), &released, &times, &options, &mut history).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);

    let inertial = |state: &FullState| to_inertial(state.attitude, state.angular_momentum(&body));
    let K = inertial(&released);
    let moved = history.states().map(|state| norm(add(inertial(&state), scale(-1.0, K))) / norm(K));
    let moved = moved.fold(0.0, f64::max);
    let power = |state: &FullState| -> f64 {
        let force = body.damping().times(&state.rate);
        force.iter().zip(&state.rate).map(|(force, rate)| force * rate).sum()
    };
    let rows: Vec<f64> =
        history.states().zip(&s).map(|(state, s)| 3.0 * end * s * s * power(&state)).collect();
    // Simpson's rule.
    let panel = |i: usize| rows[2 * i] + 4.0 * rows[2 * i + 1] + rows[2 * i + 2];
    let taken = (0..rows.len() / 2).map(panel).sum::<f64>() / (3.0 * f64::from(steps));
    let last = history.states().last().unwrap();
    let lost = released.energy(&body) - last.energy(&body);
    let (balance, account) = (lost / taken - 1.0, run.last.dissipated / taken - 1.0);
    println!(
        "moved {moved:e}, drift {:e}, lost {lost}, balance {balance:e}, account {account:e}",
        run.last.momentum_drift
    );
    assert!(lost > 0.1 * released.energy(&body), "{lost}");
    assert!(moved < 1e-11 && run.last.momentum_drift.abs() < 1e-11);
    assert!(balance.abs() < 1e-9 && account.abs() < 1e-9);
}
