//! Modes of the spinning body against the full system, an independent method. (M1)–(M5)

use proptest::prelude::*;
use quasirigid::dynamics::{Forced, FullState, Observer, Options, Sample, propagate_full};
use quasirigid::elements::{Assembly, Carrier, Rotor, RotorKind, Wheel, WheelSpeed};
use quasirigid::model::{FlexibleBody, MotionState, Principal, Watched};
use quasirigid::modes::{ModeRange, RelativeEquilibrium, SpinMagnitude, SpinMode, SpinModes};
use quasirigid::problems::hub_of_points;
use quasirigid_math::eigen::{Dense, modes};
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::{cross, norm};

use crate::support::parts;
use crate::support::transform::{Units, rescaled, rotated};
use crate::support::{assemblies, cases, rotation, sprung_body, units, vector};

/// Size of the motion beside the steady spin, whose square is left out.
const SMALL: f64 = 1e-5;
/// Relative difference between a small motion and its mode: the square of its size, and a run at 1e-13.
const DIFFERENCE: f64 = 1e-3;

/// The last state of a full run.
#[derive(Default)]
pub struct Last {
    pub omega: [f64; 3],
    pub q: Vec<f64>,
}

impl Observer for Last {
    fn sample(&mut self, sample: &Sample) {
        self.omega = sample.omega;
    }

    fn coordinates(&mut self, q: &[f64], _: &[f64]) {
        self.q = q.to_vec();
    }
}

/// Angular velocity, displacements and rates of a mode at a time, times a factor.
fn at(mode: &SpinMode, t: f64, factor: f64) -> ([f64; 3], Vec<f64>, Vec<f64>) {
    let (growth, turn) = (factor * (-mode.decay_rate * t).exp(), mode.frequency * t);
    let real = |[re, im]: [f64; 2]| growth * (re * turn.cos() - im * turn.sin());
    let rate = |[re, im]: [f64; 2]| {
        let (sigma, nu) = (-mode.decay_rate, mode.frequency);
        real([sigma * re - nu * im, sigma * im + nu * re])
    };
    (
        mode.omega.map(real),
        mode.shape.iter().copied().map(real).collect(),
        mode.shape.iter().copied().map(rate).collect(),
    )
}

/// Largest difference between a full run from a mode and the mode itself after a radian or a decay, relative to its size.
fn difference(body: &FlexibleBody, modes: &SpinModes, mode: &SpinMode) -> f64 {
    let spin = norm(modes.equilibrium.omega);
    let scale = |omega: [f64; 3], q: &[f64]| {
        let moved =
            q.iter().zip(&body.invariants().pairs.row_diagonal()).map(|(q, A)| q * q * A).sum::<f64>();
        let J = times(body.invariants().J, omega);
        (omega.iter().zip(J).map(|(a, b)| a * b).sum::<f64>() / (spin * spin) + moved).sqrt()
    };
    let size = scale([spin, 0.0, 0.0], &vec![0.0; body.coordinates().len()]);
    let (omega, q, _) = at(mode, 0.0, 1.0);
    let factor = SMALL * size / scale(omega, &q);
    let t = 1.0 / mode.decay_rate.hypot(mode.frequency);
    let (omega, q, rate) = at(mode, 0.0, factor);
    let steady = &modes.equilibrium;
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
    let turned = [0, 1, 2].map(|i| steady.omega[i] + omega[i]);
    let start =
        FullState { q: sum(&steady.q, &q), rate, ..FullState::at_rest(body, turned, [1.0, 0.0, 0.0, 0.0]) };
    let mut last = Last::default();
    let options = Options { tolerance: 1e-13, ..Options::default() };
    propagate_full(Forced::not(body), &start, &[t], &options, &mut last).unwrap();
    let (omega, q, _) = at(mode, t, factor);
    let gap = [0, 1, 2].map(|i| last.omega[i] - steady.omega[i] - omega[i]);
    let mut left: Vec<f64> = last.q.iter().zip(sum(&steady.q, &q)).map(|(a, b)| a - b).collect();
    left[body.cyclic()].fill(0.0);
    scale(gap, &left) / (SMALL * size)
}

/// Residual of `λθ + Ω × θ = δω`, relative to `δω`; none of the modes that are a steady spin about another direction.
fn rotation_residual(modes: &SpinModes, mode: &SpinMode) -> f64 {
    let Some(turn) = modes.rotation(mode) else { return 0.0 };
    let [sigma, nu] = [-mode.decay_rate, mode.frequency];
    let part = |part: usize| cross(modes.equilibrium.omega, turn.map(|pair| pair[part]));
    let across = [part(0), part(1)];
    let size = mode.omega.as_flattened().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let gap = |axis: usize| {
        let [re, im] = turn[axis];
        let [real, imaginary] = mode.omega[axis];
        let left = sigma * re - nu * im + across[0][axis] - real;
        left.hypot(sigma * im + nu * re + across[1][axis] - imaginary)
    };
    (0..3).map(gap).fold(0.0, f64::max) / size
}

trait RowDiagonal {
    fn row_diagonal(&self) -> Vec<f64>;
}

impl RowDiagonal for quasirigid_math::sparse::SparseRows<quasirigid::model::Pair> {
    fn row_diagonal(&self) -> Vec<f64> {
        (0..self.size()).map(|j| self.row(j).find(|(k, _)| *k == j).map_or(0.0, |(_, pair)| pair.A)).collect()
    }
}

/// Trace of the damping in the metric of the masses at the displacements of the spin: the sum of all decay rates, those of pairs twice.
fn trace(body: &FlexibleBody, modes: &SpinModes) -> f64 {
    let (q, n) = (&modes.equilibrium.q, body.coordinates().len());
    let (mut mass, mut damping) = (Dense::zero(3 + n), Dense::zero(3 + n));
    for column in 0..3 + n {
        let one = |i: usize| if i == column { 1.0 } else { 0.0 };
        let rate: Vec<f64> = (3..3 + n).map(one).collect();
        let (K, p) = body.full_momenta(MotionState { omega: [0, 1, 2].map(one), q, rate: &rate });
        K.iter().chain(&p).enumerate().for_each(|(row, momentum)| mass.add(row, column, *momentum));
    }
    body.damping().iter().for_each(|(j, k, B)| damping.add(3 + j, 3 + k, *B));
    // B x = Ω² M x with M positive definite: the trace is the sum of Ω².
    let inverse = modes_of(&damping, &mass);
    inverse.iter().sum()
}

fn modes_of(damping: &Dense, mass: &Dense) -> Vec<f64> {
    modes(damping, mass).unwrap().frequencies.iter().map(|frequency| frequency.powi(-2)).collect()
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn full_systems_move_in_their_modes(assembly in assemblies(), share in 0.05..0.8f64, axis in 0..3usize, inside in 0..3u8) {
        let mut assembly = assembly;
        if inside > 0 {
            let axis = [0.3, -0.8, 0.5];
            assembly.rotors.push(Rotor {
                name: "rotor".into(), kind: RotorKind::Flywheel { axis }, inertia: 1e-3, friction: 0.004, speed: None,
            });
        }
        if inside > 1 {
            let speed = WheelSpeed::Constant { angular_momentum: 0.02 };
            assembly.wheels.push(Wheel { name: "wheel".into(), axis: [0.2, 0.5, -0.9], speed });
        }
        // Modes and full system share the paths of hinges, also beyond the range in which they are those of a body.
        let Ok(body) = assembly.body().map(|body| body.watching(Watched::default())) else { return Ok(()) };
        let lowest = quasirigid::reduction::frequencies(&body).unwrap()[0];
        let axis = Principal::compute(body.invariants().J).axes[axis];
        let Ok(steady) = RelativeEquilibrium::near(&body, axis, SpinMagnitude::Rate(share * lowest)) else { return Ok(()) };
        let modes = SpinModes::about(&body, steady).unwrap();
        for mode in &modes.modes {
            let turned = rotation_residual(&modes, mode);
            prop_assert!(turned < 1e-9, "{}: {turned:e}", mode.name);
            let found = difference(&body, &modes, mode);
            prop_assert!(found < DIFFERENCE, "{}: {found:e} of {mode:?}", mode.name);
        }
        let sum: f64 = modes.modes.iter().map(|mode| mode.decay_rate * if mode.frequency > 0.0 { 2.0 } else { 1.0 }).sum();
        let expected = trace(&body, &modes);
        prop_assert!((sum / expected - 1.0).abs() < 1e-9, "{sum:e} {expected:e}");
    }

    #[test]
    fn modes_turn_with_the_body_and_know_no_units(assembly in assemblies(), R in rotation(), units in units(), direction in vector()) {
        let body = assembly.body().unwrap();
        let lowest = quasirigid::reduction::frequencies(&body).unwrap()[0];
        let near = |body: &FlexibleBody, axis: [f64; 3], rate: f64| {
            RelativeEquilibrium::near(body, axis, SpinMagnitude::Rate(rate)).map(|steady| SpinModes::about(body, steady).unwrap())
        };
        let principal = Principal::compute(body.invariants().J);
        let axis = principal.axes[if direction[0] > 0.0 { 2 } else { 0 }];
        let Ok(found) = near(&body, axis, 0.3 * lowest) else { return Ok(()) };
        let turned = <[f64; 3]>::from(R * nalgebra::Vector3::from(axis));
        let other = near(&rotated(&assembly, &R).body().unwrap(), turned, 0.3 * lowest).unwrap();
        let scaled = near(&rescaled(&assembly, units).body().unwrap(), axis, 0.3 * lowest / units.time).unwrap();
        for (mode, (other, scaled)) in found.modes.iter().zip(other.modes.iter().zip(&scaled.modes)) {
            let size = mode.decay_rate.hypot(mode.frequency);
            for (decay, frequency) in
                [(other.decay_rate, other.frequency), (scaled.decay_rate * units.time, scaled.frequency * units.time)]
            {
                let gap = (decay - mode.decay_rate).hypot(frequency - mode.frequency);
                prop_assert!(gap < 1e-9 * size, "{mode:?} {decay:e} {frequency:e}");
            }
        }
    }
}

/// So do the slowest modes of a body of many coordinates, and what is said of the others.
#[test]
fn slowest_modes_turn_with_the_body_and_know_no_units() {
    let assembly = hub_of_points(55, 120.0);
    let R = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.3).into_inner();
    let units = Units { length: 3e-4, mass: 2e5, time: 7e3 };
    let body = assembly.body().unwrap();
    let axis = Principal::compute(body.invariants().J).axes[2];
    let found = |assembly: &Assembly, axis: [f64; 3], rate: f64| {
        let body = assembly.body().unwrap();
        let steady = RelativeEquilibrium::near(&body, axis, SpinMagnitude::Rate(rate)).unwrap();
        SpinModes::about(&body, steady).unwrap()
    };
    let own = found(&assembly, axis, 0.5);
    let turned = found(&rotated(&assembly, &R), <[f64; 3]>::from(R * nalgebra::Vector3::from(axis)), 0.5);
    let scaled = found(&rescaled(&assembly, units), axis, 0.5 / units.time);
    for (other, time) in [(&turned, 1.0), (&scaled, units.time)] {
        assert_eq!(other.modes.len(), own.modes.len());
        for (mode, other) in own.modes.iter().zip(&other.modes) {
            let gap =
                (other.decay_rate * time - mode.decay_rate).hypot(other.frequency * time - mode.frequency);
            assert!(gap < 1e-9 * mode.frequency, "{mode:?} {other:?}");
            // coordinates are named by axes of the file
            assert!(time == 1.0 || mode.name == other.name, "{} {}", mode.name, other.name);
            let decay = (other.decay_rate * time / mode.decay_rate - 1.0).abs();
            assert!(decay < 1e-6, "{} {decay:e}", mode.name);
        }
        let (ModeRange::Slowest(slow), ModeRange::Slowest(own)) = (other.range, own.range) else {
            panic!("all modes")
        };
        assert!((slow.rate * time / own.rate - 1.0).abs() < 1e-6, "{slow:?} {own:?}");
        assert_eq!((slow.missing, slow.positive_energy), (Some(0), true));
    }
}

/// A body of revolution, with a mass at its centre that takes no part, nutates at `Ω(C − A)/A` in its own axes and at `G/A` in space, where
/// in the other sense it is the spin that is left: `Ω − Ω(C − A)/A`.
#[test]
fn a_nutation_is_seen_from_outside_at_the_angular_momentum_over_the_transverse_moment() {
    let mass = parts::sprung(1.0, [0.0; 3], [90.0; 3], [1.0; 3]);
    let (A, C, spin) = (9.0, 16.0, 0.7);
    let body = sprung_body(Carrier::principal(40.0, [A, A, C]), &[mass]).body().unwrap();
    let steady = RelativeEquilibrium::near(&body, [0.0, 0.0, 1.0], SpinMagnitude::Rate(spin)).unwrap();
    let modes = SpinModes::about(&body, steady).unwrap();
    let nutation = modes.nutation().unwrap();
    assert!((nutation.frequency / (spin * (C - A) / A) - 1.0).abs() < 1e-9, "{nutation:?}");
    let [slow, fast] = modes.seen_from_outside(nutation);
    assert!((fast / (spin * C / A) - 1.0).abs() < 1e-9, "{fast}");
    assert!((slow - (spin - spin * (C - A) / A)).abs() < 1e-9, "{slow}");
}
