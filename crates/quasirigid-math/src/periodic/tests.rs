use std::f64::consts::TAU;

use super::*;
use crate::elliptic::first_of_complement;

/// A system of plain functions: rates, and the directions of its parameters.
#[derive(Clone)]
struct Plain<F, G> {
    size: usize,
    rate: F,
    directions: G,
    parameters: usize,
}

impl<F, G> Unfolded for Plain<F, G>
where
    F: Fn(&[f64]) -> Vec<f64> + Clone + Send + Sync,
    G: Fn(&[f64]) -> Vec<Vec<f64>> + Clone + Send + Sync,
{
    fn size(&self) -> usize {
        self.size
    }

    fn parameters(&self) -> usize {
        self.parameters
    }

    fn rate(&mut self, z: &[f64], parameters: &[f64], rate: &mut [f64]) {
        rate.copy_from_slice(&(self.rate)(z));
        for (direction, parameter) in (self.directions)(z).iter().zip(parameters) {
            rate.iter_mut().zip(direction).for_each(|(rate, along)| *rate += parameter * along);
        }
    }

    fn directions(&mut self, z: &[f64]) -> Vec<Vec<f64>> {
        (self.directions)(z)
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

/// Pendulum of an amplitude with a very fast follower: the period is `4K(sin(a/2))`, and the unfolding parameter takes what little friction
/// dissipates: `π = friction` where its direction is the velocity.
#[test]
fn a_pendulum_has_the_period_of_its_amplitude() {
    let (amplitude, friction, fast) = (2.9_f64, 1e-2, 1e6);
    let rate = |z: &[f64]| vec![z[1], -z[0].sin() - friction * z[1], fast * (z[0] * z[0] - z[2])];
    let directions = |z: &[f64]| vec![vec![0.0, z[1], 0.0]];
    let system = Plain { size: 3, rate, directions, parameters: 1 };
    let exact = 4.0 * first_of_complement((0.5 * amplitude).cos().powi(2));
    let state = |share: f64| {
        let (sine, cosine) = (TAU * share).sin_cos();
        vec![amplitude * cosine, -amplitude * sine * TAU / exact, (amplitude * cosine).powi(2)]
    };
    // the first node has the amplitude, and no velocity
    let guess = Guess { period: 0.8 * exact, state: &state, parameters: vec![0.0] };
    let mut errors = Vec::new();
    for intervals in [16, 32, 64] {
        let found = periodic(&system, &guess, intervals).expect("a solution");
        errors.push((found.period() / exact - 1.0).abs());
        assert!(
            (found.parameters()[0] / friction - 1.0).abs() < [1.0, 0.1, 1e-2][errors.len() - 1],
            "{:?}",
            found.parameters()
        );
        let mean: f64 = found.samples().map(|(weight, z)| weight * z[1] * z[1]).sum();
        let action: f64 =
            (0..4096).map(|i| found.at((f64::from(i) + 0.5) / 4096.0)[1].powi(2) / 4096.0).sum();
        assert!((mean / action - 1.0).abs() < 1e-4, "{mean} {action}");
        assert!(found.samples().all(|(_, z)| (z[2] - z[0] * z[0]).abs() < 1e-4));
    }
    assert!(errors[2] < 1e-8 && errors[1] < errors[0] / 16.0 && errors[2] < errors[1] / 16.0, "{errors:?}");
}

/// Van der Pol's oscillator at `μ = 1`: period 6.663286859, by a plain integration at small steps; its second multiplier is the exponential of
/// the mean divergence over the cycle.
#[test]
fn a_limit_cycle_is_found_with_its_multipliers() {
    let rate = |z: &[f64]| vec![z[1], (1.0 - z[0] * z[0]) * z[1] - z[0]];
    let (mut z, h) = ([2.0, 0.0], 1e-4);
    let moved = |z: [f64; 2], k: &[f64], h: f64| [z[0] + h * k[0], z[1] + h * k[1]];
    let (mut path, mut crossings) = (Vec::new(), Vec::new());
    for step in 0..400_000 {
        let k1 = rate(&z);
        let k2 = rate(&moved(z, &k1, 0.5 * h));
        let k3 = rate(&moved(z, &k2, 0.5 * h));
        let k4 = rate(&moved(z, &k3, h));
        let next = [0, 1].map(|i| z[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        if z[1] > 0.0 && next[1] <= 0.0 && z[0] > 0.0 {
            crossings.push(h * (f64::from(step) + z[1] / (z[1] - next[1])));
            path.clear();
        }
        path.push(next);
        z = next;
    }
    let exact = crossings[crossings.len() - 1] - crossings[crossings.len() - 2];
    let top = path[0][0];
    let state = |share: f64| {
        let (sine, cosine) = (TAU * share).sin_cos();
        vec![top * (1.0 + share * 0.0) * cosine, -2.0 * sine]
    };
    // the first node has no velocity, so that the velocity comes first in the order of the components
    let turned = |z: &[f64]| {
        let rate = rate(&[z[1], z[0]]);
        vec![rate[1], rate[0]]
    };
    let swapped = Plain { size: 2, rate: turned, directions: |_: &[f64]| Vec::new(), parameters: 0 };
    let guess = |share: f64| {
        let z = state(share);
        vec![z[1], z[0]]
    };
    let guess = Guess { period: 6.5, state: &guess, parameters: Vec::new() };
    let found = periodic(&swapped, &guess, 96).expect("a cycle");
    assert!((found.period() / exact - 1.0).abs() < 1e-7, "{} {exact}", found.period());
    let divergence: f64 = found.samples().map(|(weight, z)| weight * (1.0 - z[1] * z[1])).sum();
    let mut multipliers = multipliers(&swapped, &found).expect("multipliers");
    multipliers.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert!((multipliers[1][0] - 1.0).abs() < 1e-6, "{multipliers:?}");
    assert!((multipliers[0][0] / (divergence * found.period()).exp() - 1.0).abs() < 1e-4, "{multipliers:?}");
}

/// A cycle and a follower in other units: the same period and multipliers, however far apart the units are.
#[test]
fn multipliers_do_not_depend_on_units() {
    let found = |units: [f64; 3]| {
        let own = move |z: &[f64]| {
            let x = [z[0] / units[0], z[1] / units[1], z[2] / units[2]];
            let radius = 1.0 - x[0] * x[0] - x[1] * x[1];
            let rates = [x[1] + radius * x[0], radius * x[1] - x[0], x[0] * x[1] - 0.3 * x[2]];
            rates.iter().zip(units).map(|(rate, unit)| rate * unit).collect::<Vec<_>>()
        };
        let system = Sized {
            plain: Plain { size: 3, rate: own, directions: |_: &[f64]| Vec::new(), parameters: 0 },
            units,
        };
        let state = |share: f64| {
            let (sine, cosine) = (TAU * share).sin_cos();
            vec![units[0] * sine, units[1] * cosine, 0.1 * units[2] * sine]
        };
        let cycle = periodic(&system, &Guess { period: 6.0, state: &state, parameters: Vec::new() }, 48)
            .expect("a cycle");
        let mut multipliers = multipliers(&system, &cycle).expect("multipliers");
        multipliers.sort_by(|a, b| a[0].total_cmp(&b[0]));
        (cycle.period(), multipliers)
    };
    let (period, plain) = found([1.0; 3]);
    assert!((period / TAU - 1.0).abs() < 1e-8, "{period}");
    for (multiplier, rate) in plain.iter().zip([-2.0, -0.3, 0.0_f64]) {
        assert!((multiplier[0] / (rate * TAU).exp() - 1.0).abs() < 1e-5, "{plain:?}");
    }
    let (other, turned) = found([3e17, 7e-14, 2e3]);
    assert!((other / period - 1.0).abs() < 1e-12, "{other} {period}");
    for (a, b) in plain.iter().zip(&turned) {
        assert!((a[0] / b[0] - 1.0).abs() < 1e-8, "{plain:?} {turned:?}");
    }
}

/// A plain system whose components have sizes of their own.
#[derive(Clone)]
struct Sized<S> {
    plain: S,
    units: [f64; 3],
}

impl<S: Unfolded> Unfolded for Sized<S> {
    fn size(&self) -> usize {
        self.plain.size()
    }

    fn parameters(&self) -> usize {
        self.plain.parameters()
    }

    fn rate(&mut self, z: &[f64], parameters: &[f64], rate: &mut [f64]) {
        self.plain.rate(z, parameters, rate);
    }

    fn directions(&mut self, z: &[f64]) -> Vec<Vec<f64>> {
        self.plain.directions(z)
    }

    fn scale(&self, component: usize) -> f64 {
        self.units[component]
    }
}
