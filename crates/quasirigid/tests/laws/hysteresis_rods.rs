//! Hysteresis rods: a body that they brake against an integration written here, and the loss of a turn against the area of the loop. (Y10), (Y11)

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use quasirigid::dynamics::{Forced, FullState, Options, Outcome, Sample, propagate_controlled};
use quasirigid::elements::{Assembly, Carrier};
use quasirigid::model::control::{HysteresisLoop, HysteresisRod};
use quasirigid::model::force::MagneticField;

type V = Vector3<f64>;
type M = Matrix3<f64>;

const MU: f64 = 1.256_637_062_12e-6;
const MATERIAL: HysteresisLoop = HysteresisLoop { saturation: 0.74, remanence: 0.35, coercivity: 1.59 };

fn rod(axis: [f64; 3], volume: f64, demagnetization: f64) -> HysteresisRod {
    HysteresisRod { name: "rod".into(), axis, volume, demagnetization, material: MATERIAL }
}

fn assembly(J: &M, field: V, rods: Vec<HysteresisRod>) -> Assembly {
    let carrier = Carrier { mass: 2.0, center_of_mass: [0.1, -0.2, 0.3], inertia: (*J).into() };
    Assembly {
        carrier: Some(carrier),
        magnetic_field: Some(MagneticField::Uniform(field.into())),
        rods,
        ..Assembly::default()
    }
}

fn followed(assembly: &Assembly, omega: V, attitude: UnitQuaternion<f64>, times: &[f64]) -> Vec<Sample> {
    let built = assembly.build().unwrap();
    let [x, y, z, w] = attitude.into_inner().coords.into();
    let start = FullState::at_rest(&built.body, omega.into(), [w, x, y, z]);
    let mut samples: Vec<Sample> = Vec::new();
    let options = Options { tolerance: 1e-12, ..Options::default() };
    let system = Forced { body: &built.body, forces: &built.forces };
    let run = propagate_controlled(system, &built.controls, &start, times, &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    samples
}

/// Motion with the inductions of two rods.
#[derive(Clone, Copy)]
struct State {
    attitude: Quaternion<f64>,
    omega: V,
    B: [f64; 2],
}

impl State {
    fn plus(&self, rate: &Self, h: f64) -> Self {
        Self {
            attitude: self.attitude + rate.attitude * h,
            omega: self.omega + rate.omega * h,
            B: [0, 1].map(|i| self.B[i] + h * rate.B[i]),
        }
    }
}

/// Rates with the law in the induction itself: `dB/dt = (2k/π) B_s cos²(πB/2B_s) ((H − H_l)/2H_c)² dH/dt`, `H_l` on the other limiting curve; the
/// field inside a rod is `H_e − N M`, of which also the rate is solved for here.
fn rate(J: &M, field: V, rods: &[HysteresisRod], state: &State) -> State {
    let HysteresisLoop { saturation, remanence, coercivity } = MATERIAL;
    let k = (PI / 2.0 * remanence / saturation).tan() / coercivity;
    let seen = UnitQuaternion::new_normalize(state.attitude).inverse() * field;
    let change = -state.omega.cross(&seen);
    let (mut torque, mut B_rate) = (V::zeros(), [0.0; 2]);
    for (i, rod) in rods.iter().enumerate() {
        let (axis, N, B) = (V::from(rod.axis), rod.demagnetization, state.B[i]);
        let [outside, driving] = [seen, change].map(|vector| axis.dot(&vector) / MU);
        let inside = (outside - N * B / MU) / (1.0 - N);
        let middle = (PI / 2.0 * B / saturation).tan() / k;
        let other = middle - coercivity * driving.signum();
        let slope = 2.0 / PI
            * k
            * saturation
            * (PI / 2.0 * B / saturation).cos().powi(2)
            * ((inside - other) / (2.0 * coercivity)).powi(2);
        // dB = slope dH, (1 − N) dH = dH_e − N dB/μ₀
        B_rate[i] = slope * driving / (1.0 - N + N * slope / MU);
        torque += rod.volume * (B / MU - inside) * axis.cross(&seen);
    }
    let gyroscopic = (J * state.omega).cross(&state.omega);
    State {
        attitude: state.attitude * Quaternion::from_imag(0.5 * state.omega),
        omega: J.try_inverse().unwrap() * (gyroscopic + torque),
        B: B_rate,
    }
}

/// Induction in the middle of the loop at a field outside, by halving.
fn start(rod: &HysteresisRod, outside: f64) -> f64 {
    let k = (PI / 2.0 * MATERIAL.remanence / MATERIAL.saturation).tan() / MATERIAL.coercivity;
    let (mut low, mut high) = (-MATERIAL.saturation, MATERIAL.saturation);
    for _ in 0..200 {
        let B = 0.5 * (low + high);
        let inside = (outside - rod.demagnetization * B / MU) / (1.0 - rod.demagnetization);
        let short = (PI / 2.0 * B / MATERIAL.saturation).tan() / k < inside;
        if short { low = B } else { high = B }
    }
    0.5 * (low + high)
}

/// A tumbling body with two rods, one of them short, about axes of no symmetry.
#[test]
fn a_body_with_rods_is_braked_as_their_law_says() {
    let J = M::new(0.011, 0.001, -0.0005, 0.001, 0.014, 0.0007, -0.0005, 0.0007, 0.02) * 1e-2;
    let field = V::new(12e-6, -25e-6, 18e-6);
    let rods = vec![rod([0.6, 0.0, 0.8], 7e-6, 3e-4), rod([0.0, 1.0, 0.0], 5e-6, 0.02)];
    let attitude = UnitQuaternion::from_scaled_axis(V::new(0.4, -1.1, 0.7));
    let omega = V::new(0.5, -0.3, 0.4);
    let times: Vec<f64> = (0..=6).map(|i| 5.0 * f64::from(i)).collect();
    let samples = followed(&assembly(&J, field, rods.clone()), omega, attitude, &times);
    let seen = attitude.inverse() * field;
    let B = [0, 1].map(|i| start(&rods[i], V::from(rods[i].axis).dot(&seen) / MU));
    let mut state = State { attitude: attitude.into_inner(), omega, B };
    let (steps, mut gone) = (40_000, 0.0);
    for sample in &samples {
        if sample.t > 0.0 {
            let h = 5.0 / f64::from(steps);
            for _ in 0..steps {
                let k1 = rate(&J, field, &rods, &state);
                let k2 = rate(&J, field, &rods, &state.plus(&k1, 0.5 * h));
                let k3 = rate(&J, field, &rods, &state.plus(&k2, 0.5 * h));
                let k4 = rate(&J, field, &rods, &state.plus(&k3, h));
                for (rate, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                    state = state.plus(&rate, weight * h / 6.0);
                }
            }
        }
        let gap = (V::from(sample.omega) - state.omega).norm();
        // where the field turns back the law has a corner, of which the steps here do not know
        assert!(gap < 1e-7 * omega.norm(), "{}: {:?} {} {gap:e}", sample.t, sample.omega, state.omega);
        gone = (state.omega - omega).norm();
    }
    assert!(gone > 0.1, "the rods do something: {gone}");
    let [first, last] = [&samples[0], &samples[samples.len() - 1]];
    assert!((last.energy - first.energy - last.work).abs() < 1e-9 * first.energy, "{}", last.work);
}

/// Lag `s`, from 0 on the one to 1 on the other limiting curve, at the end of a sweep between fields of this size that comes again.
fn periodic_end(most: f64) -> f64 {
    let (mut low, mut high): (f64, f64) = (0.5, 1.0);
    for _ in 0..200 {
        let end = 0.5 * (low + high);
        let reached = (most / MATERIAL.coercivity + (1.0 - end).atanh()).tanh();
        if reached > end { low = end } else { high = end }
    }
    0.5 * (low + high)
}

/// Area `∮ H dB` of the loop between fields of this size: twice the integral of the rising branch, whose lag is a hyperbolic tangent; by
/// Simpson's rule.
fn area(most: f64) -> f64 {
    let HysteresisLoop { coercivity, .. } = MATERIAL;
    let from = (1.0 - periodic_end(most)).atanh();
    let n = 20_000;
    let h = 2.0 * most / f64::from(n);
    let integrand = |i: i32| {
        let H = h * f64::from(i) - most;
        let s = ((H + most) / (2.0 * coercivity) + from).tanh();
        H * s * s * MATERIAL.slope(H - coercivity * (2.0 * s - 1.0))
    };
    let weight = |i: i32| if i == 0 || i == n { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
    2.0 * h / 3.0 * (0..=n).map(|i| weight(i) * integrand(i)).sum::<f64>()
}

/// A heavy body turns steadily across the field: each turn takes `V ∮ H dB` from it, however fast it turns.
#[test]
fn a_turn_takes_the_area_of_the_loop() {
    let volume = 7e-8;
    for (most, speed) in [(1.0, 1.0_f64), (4.0, 0.02), (25.0, 3.0)] {
        let field = V::new(most * MU, 0.0, 0.0);
        let J = M::from_diagonal(&V::new(1.0, 1.1, 1.2)) * 1e3 * speed.powi(-2);
        let assembly = assembly(&J, field, vec![rod([1.0, 0.0, 0.0], volume, 0.0)]);
        let turn = TAU / speed;
        let turns = [40.0, 41.0, 45.0];
        let times: Vec<f64> = [0.0].into_iter().chain(turns).map(|turns| turns * turn).collect();
        let samples = followed(&assembly, V::new(0.0, 0.0, speed), UnitQuaternion::identity(), &times);
        let known = volume * area(most);
        let taken = |from: usize, to: usize| samples[from].work - samples[to].work;
        assert!((taken(1, 2) / known - 1.0).abs() < 1e-6, "{most}: {:e} {known:e}", taken(1, 2));
        assert!((taken(2, 3) / (4.0 * known) - 1.0).abs() < 1e-6, "{most}: {:e} {known:e}", taken(2, 3));
    }
    // far into saturation the loop is the major one
    let whole = 4.0 * MATERIAL.saturation * MATERIAL.coercivity;
    assert!((area(3000.0) / whole - 1.0).abs() < 2e-3, "{} {whole}", area(3000.0));
}

/// Rods that cannot be, by their own problem.
#[test]
fn rods_that_cannot_be_are_refused() {
    let good = rod([0.0, 0.0, 2.0], 1e-7, 1e-4);
    let of = |rod: HysteresisRod| assembly(&M::identity(), V::new(0.0, 0.0, 3e-5), vec![rod]);
    assert!(of(good.clone()).check().is_empty());
    let material = |saturation, remanence, coercivity| HysteresisLoop { saturation, remanence, coercivity };
    for (rod, told) in [
        (HysteresisRod { axis: [0.0; 3], ..good.clone() }, "direction"),
        (HysteresisRod { volume: 0.0, ..good.clone() }, "not positive"),
        (HysteresisRod { demagnetization: 1.0, ..good.clone() }, "demagnetisation factor 1"),
        (HysteresisRod { demagnetization: f64::NAN, ..good.clone() }, "demagnetisation factor NaN"),
        (HysteresisRod { material: material(0.7, 0.7, 1.0), ..good.clone() }, "not less than the saturation"),
        (HysteresisRod { material: material(0.7, 0.3, -1.0), ..good.clone() }, "not positive"),
    ] {
        let bad = of(rod);
        for error in [bad.check().remove(0), bad.build().unwrap_err()] {
            assert!(error.to_string().contains(told), "{told}: {error}");
        }
    }
    let nowhere = Assembly { magnetic_field: None, ..of(good) };
    assert!(nowhere.build().unwrap_err().to_string().contains("it needs a magnetic field"));
}
