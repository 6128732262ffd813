//! Response of the harmonics against the full system, an independent method.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector, Vector3};
use quasirigid::averaging::{HillResponse, MeanPower, Response};
use quasirigid::dynamics::{Forced, FullState, Observer, Options, Outcome, Sample, propagate_full};
use quasirigid::model::{FlexibleBody, Mode, MotionState, Principal};
use quasirigid_math::sym3;
use quasirigid_math::vec3;

use super::bodies::{full_start, lines, motion, skew};

/// Samples and coordinates at the end of a run.
#[derive(Default)]
struct End {
    sample: Sample,
    q: Vec<f64>,
    rate: Vec<f64>,
}

impl Observer for End {
    fn sample(&mut self, sample: &Sample) {
        self.sample = *sample;
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        (self.q, self.rate) = (q.to_vec(), rate.to_vec());
    }
}

/// A tumbling body with dampers of a hundred-thousandth of its mass takes the power of the harmonics, from spins slow beside the dampers'
/// frequency to faster ones, and stays in the state of the harmonics.
#[test]
fn a_tumbling_body_takes_the_power_of_the_harmonics() {
    let mass = 3e-4;
    let along_short = [[0.2, -0.1, 0.9], [-0.15, 0.2, 0.95]];
    let along_long = [[0.9, -0.1, 0.2], [0.95, 0.2, -0.15]];
    for (mode, xi, line) in [(Mode::ShortAxis, 0.6, along_short), (Mode::LongAxis, 0.6, along_long)] {
        for ratio in [0.1, 0.7, 1.3] {
            let frequency: f64 = 2.0;
            let stiffness = mass * frequency * frequency;
            let body = lines(line, [mass, 0.8 * mass], [1.3 * stiffness, stiffness], 0.15).body().unwrap();
            let hill = HillResponse::compute(&body).unwrap();
            let motion = motion(&body, ratio * frequency, mode, xi);
            let floquet = hill.floquet(&motion).unwrap();
            let start = full_start(&body, &hill, &motion);
            // After one period the wobble has changed by the dissipated energy.
            let time = motion.polhode_period();
            let mut samples: Vec<Sample> = Vec::new();
            let options = Options { tolerance: 1e-13, ..Options::default() };
            let run = propagate_full(Forced::not(&body), &start, &[time], &options, &mut samples).unwrap();
            assert_eq!(run.outcome, Outcome::Finished);
            let measured = samples[0].dissipated / time;
            let predicted = hill.mean_power(&motion);
            let alone = Response::compute(&body).unwrap().mean_power(&motion);
            let share = hill.share(&motion).unwrap();
            let gap = measured / predicted - 1.0;
            println!(
                "{mode:?} {ratio}: full {measured:.6e}, harmonics {gap:+.2e}, uncoupled {:+.2e}, share {share:.1e}, {:?}",
                alone / measured - 1.0,
                floquet.resonance
            );
            assert!(floquet.resonance.is_none());
            assert!(
                share < 1e-3 && gap.abs() < 5.0 * share.max(1e-5),
                "{mode:?} {ratio}: {gap:e}, share {share:e}"
            );
            assert!(ratio < 0.5 || (alone / measured - 1.0).abs() > 0.1, "the couplings matter");
        }
    }
}

/// Rates of `(K, q, p)` in the full system.
fn rates(body: &FlexibleBody, y: &DVector<f64>) -> DVector<f64> {
    let n = body.coordinates().len();
    let (K, q, p) = (y.rows(0, 3), y.rows(3, n), y.rows(3 + n, n));
    let q = q.as_slice().to_vec();
    let mut matrix = DMatrix::zeros(3 + n, 3 + n);
    for column in 0..3 + n {
        let (mut omega, mut rate) = ([0.0; 3], vec![0.0; n]);
        if column < 3 {
            omega[column] = 1.0
        } else {
            rate[column - 3] = 1.0
        }
        let motion = MotionState { omega, q: &q, rate: &rate };
        let entries = body.angular_momentum(motion).into_iter().chain(body.generalized_momentum(motion));
        matrix.set_column(column, &DVector::from_iterator(3 + n, entries));
    }
    let right = DVector::from_iterator(3 + n, K.iter().chain(p.iter()).copied());
    let both = matrix.lu().solve(&right).unwrap();
    let omega = [both[0], both[1], both[2]];
    let rate = both.rows(3, n).as_slice().to_vec();
    let turned = vec3::cross([K[0], K[1], K[2]], omega);
    let load = body.load(MotionState { omega, q: &q, rate: &rate });
    let (springs, dashpots) = (body.stiffness().times(&q), body.damping().times(&rate));
    let force = (0..n).map(|j| load[j] - springs[j] - dashpots[j]);
    DVector::from_iterator(3 + 2 * n, turned.into_iter().chain(rate.iter().copied()).chain(force))
}

/// Derivatives of a function of the state, with a Richardson step.
fn slopes(y: &DVector<f64>, steps: &DVector<f64>, f: impl Fn(&DVector<f64>) -> DVector<f64>) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(f(y).len(), y.len());
    for column in 0..y.len() {
        let [far, near] = [1.0, 0.5].map(|scale| {
            let h = scale * steps[column];
            let at = |side: f64| {
                let mut moved = y.clone();
                moved[column] += side * h;
                f(&moved)
            };
            (at(1.0) - at(-1.0)) / (2.0 * h)
        });
        matrix.set_column(column, &((near * 4.0 - far) / 3.0));
    }
    matrix
}

/// Near a pole the power over twice the energy of the wobble is the real part of an eigenvalue of the full system linearised
/// about its steady spin, but for the share of the dampers' mass.
#[test]
fn a_small_wobble_has_the_eigenvalue_of_the_full_system() {
    for (mode, spin) in [(Mode::ShortAxis, 1.1), (Mode::ShortAxis, 2.6), (Mode::LongAxis, 1.4)] {
        let gaps = [1e-3, 1e-4].map(|mass| {
            let body = skew([mass, 0.8 * mass], [4.0 * mass, 3.0 * mass], 0.2).body().unwrap();
            let hill = HillResponse::compute(&body).unwrap();
            let motion = motion(&body, spin, mode, 30.0);
            let predicted = hill.mean_power(&motion) / (2.0 * motion.energy_from_axis());
            let start = full_start(&body, &hill, &motion);
            let G = motion.angular_momentum();
            let rate = vec![0.0; 2];
            let still = MotionState { omega: start.omega, q: &start.q, rate: &rate };
            let state = body
                .angular_momentum(still)
                .into_iter()
                .chain(start.q.iter().copied())
                .chain(body.generalized_momentum(still));
            let mut y = DVector::from_iterator(7, state);
            let momentum = mass * spin;
            let steps = DVector::from_vec(vec![
                1e-3 * G,
                1e-3 * G,
                1e-3 * G,
                1e-2,
                1e-2,
                1e-2 * momentum,
                1e-2 * momentum,
            ]);
            for _ in 0..8 {
                let conditions = |y: &DVector<f64>| {
                    let rates = rates(&body, y);
                    let mut all = rates.as_slice().to_vec();
                    all.push((y.rows(0, 3).norm_squared() - G * G) / G);
                    DVector::from_vec(all)
                };
                let matrix = slopes(&y, &steps, conditions);
                let change = matrix.svd(true, true).solve(&conditions(&y), 1e-13).unwrap();
                y -= change;
            }
            let left = rates(&body, &y).norm();
            assert!(left < 1e-11 * G * spin, "not steady: {left:e}");
            let polhode = TAU / motion.polhode_period();
            let values = slopes(&y, &steps, |y| rates(&body, y)).complex_eigenvalues();
            let wobble = values
                .iter()
                .filter(|value| value.im > 0.0)
                .min_by(|a, b| (a.im - polhode).abs().total_cmp(&(b.im - polhode).abs()))
                .unwrap();
            let sign = if mode == Mode::ShortAxis { -1.0 } else { 1.0 };
            println!("{mode:?} {spin} {mass:e}: eigenvalue {:e}, harmonics {predicted:e}", sign * wobble.re);
            (predicted / (sign * wobble.re) - 1.0).abs()
        });
        assert!(gaps[1] < 1e-4 && gaps[1] < 0.15 * gaps[0], "{mode:?} {spin}: {gaps:?}");
    }
}

/// Matrix that takes `(K, q, p)` from the start of a run a period on.
fn flow(body: &FlexibleBody, start: &FullState, period: f64, steps: &DVector<f64>) -> DMatrix<f64> {
    let n = body.coordinates().len();
    let state = |omega: [f64; 3], q: &[f64], rate: &[f64]| {
        let motion = MotionState { omega, q, rate };
        let entries = body.angular_momentum(motion).into_iter().chain(q.iter().copied());
        DVector::from_iterator(3 + 2 * n, entries.chain(body.generalized_momentum(motion)))
    };
    let end = |y: &DVector<f64>| {
        let rates = rates(body, y);
        let q = y.rows(3, n).as_slice().to_vec();
        let rate = rates.rows(3, n).as_slice().to_vec();
        let inside = body.angular_momentum(MotionState { omega: [0.0; 3], q: &q, rate: &rate });
        let K = [y[0] - inside[0], y[1] - inside[1], y[2] - inside[2]];
        let omega = sym3::times(sym3::inverse(body.inertia_at(&q)), K);
        let from = FullState { omega, q, rate, ..start.clone() };
        let mut end = End::default();
        let options = Options { tolerance: 1e-14, ..Options::default() };
        propagate_full(Forced::not(body), &from, &[period], &options, &mut end).unwrap();
        state(end.sample.omega, &end.q, &end.rate)
    };
    slopes(&state(start.omega, &start.q, &start.rate), steps, end)
}

/// Multipliers of light dampers on a heavy body are those of the full system over the same polhode; where the stiffness of one oscillates
/// at twice its frequency the motion grows as Mathieu's equation says.
#[test]
fn multipliers_are_those_of_the_full_system() {
    let (mass, spin) = (2e-5, 1.3);
    let light = skew([mass, mass], [1.0, 1.0], 1.0).body().unwrap();
    let motion = motion(&light, spin, Mode::ShortAxis, 5.0);
    let principal = Principal::compute(light.invariants().J);
    let line = Vector3::new(0.3, -0.4, 0.9).normalize();
    let period = motion.polhode_period();
    let polhode = TAU / period;
    // Amplitudes of the softening of the first line by the spin, over its mass.
    let softening = |harmonic: f64| {
        let term = |i: usize| {
            let omega = Vector3::from(principal.vector(motion.omega(period * i as f64 / 64.0)));
            let part = omega.norm_squared() - omega.dot(&line).powi(2);
            Complex::from_polar(part / 64.0, -TAU * harmonic * i as f64 / 64.0)
        };
        (0..64).map(term).sum::<Complex<f64>>()
    };
    for (tuning, ratio) in [(0.5, 0.002), (0.8, 0.02), (1.7, 0.02)] {
        let stiffness = mass * (softening(0.0).re + (tuning * polhode).powi(2));
        let body = skew([mass, mass], [stiffness, 40.0 * stiffness], ratio).body().unwrap();
        let hill = HillResponse::compute(&body).unwrap();
        let floquet = hill.floquet(&motion).unwrap();
        let start = full_start(&body, &hill, &motion);
        let (G, momentum) = (motion.angular_momentum(), mass * spin);
        let steps = [1e-4 * G, 1e-4 * G, 1e-4 * G, 1e-2, 1e-2, 1e-2 * momentum, 1e-2 * momentum];
        let full = flow(&body, &start, period, &DVector::from_row_slice(&steps)).complex_eigenvalues();
        println!("{tuning}: {floquet:?}, full {:?}", full.as_slice());
        assert_eq!((floquet.multipliers.len(), full.len()), (4, 7));
        for [re, im] in &floquet.multipliers {
            let near = full.iter().map(|value| (value - Complex::new(*re, *im)).norm());
            let gap = near.fold(f64::INFINITY, f64::min);
            assert!(gap < 2e-4, "{tuning}: {re} {im} {gap:e}");
        }
        assert_eq!(floquet.resonance.is_some(), tuning == 0.5);
        if let Some(resonance) = floquet.resonance {
            let damping = ratio * (stiffness / mass).sqrt();
            let mathieu = 2.0 * softening(1.0).norm() / (4.0 * tuning * polhode) - damping;
            println!("rate {:e}, Mathieu {mathieu:e}", resonance.rate);
            assert!((resonance.rate / mathieu - 1.0).abs() < 0.05, "{resonance:?} {mathieu:e}");
            assert_eq!(resonance.coordinate, "\"mass 0\" along its line");
            assert!((resonance.frequency / (0.5 * polhode) - 1.0).abs() < 1e-6, "{resonance:?}");
        }
    }
}
