//! The full equations in numbers: relations between momenta, loads and energy, and the sum over the masses. (S2)–(S6)

use nalgebra::Vector3;
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::model::{FlexibleBody, MotionState};
use quasirigid_math::scalar::Jet;
use quasirigid_math::sym3::times;

use super::invariants::Cloud;
use crate::support::transform::rescaled;
use crate::support::{assemblies, cases, massive, massive_points, moments, units, vector};

type V = Vector3<f64>;

/// Rounding of sums of some hundred terms.
const ROUNDING: f64 = 1e-12;

/// A state in numbers.
#[derive(Clone, Debug)]
struct State {
    omega: [f64; 3],
    q: Vec<f64>,
    rate: Vec<f64>,
}

impl State {
    /// Coordinates and rates of every body start from the same numbers.
    fn new(omega: [f64; 3], numbers: &[f64], n: usize, amount: f64) -> Self {
        let some =
            |offset: usize| (0..n).map(|j| amount * numbers[(2 * j + offset) % numbers.len()]).collect();
        Self { omega, q: some(0), rate: some(1) }
    }

    fn motion(&self) -> MotionState<'_, f64> {
        MotionState { omega: self.omega, q: &self.q, rate: &self.rate }
    }
}

fn elastic(body: &FlexibleBody, q: &[f64]) -> f64 {
    body.stiffness().times(q).iter().zip(q).map(|(force, q)| 0.5 * force * q).sum()
}

/// Kinetic energy, which is the Lagrangian but for a term without rates and spin.
fn kinetic(body: &FlexibleBody, state: &State) -> f64 {
    body.energy(state.motion()) - elastic(body, &state.q)
}

/// Derivative of the kinetic energy with respect to one number of the state. The energy is quadratic in each of them,
/// so a central difference is exact whatever its step.
fn slope(body: &FlexibleBody, state: &State, step: f64, change: impl Fn(&mut State, f64)) -> f64 {
    let at = |sign: f64| {
        let mut moved = state.clone();
        change(&mut moved, sign * step);
        kinetic(body, &moved)
    };
    (at(1.0) - at(-1.0)) / (2.0 * step)
}

/// Numbers of the size of one unit of each coordinate, in the units of the body: coordinates in metres scale.
fn lengths(body: &FlexibleBody) -> Vec<f64> {
    let [xx, yy, zz, ..] = body.invariants().J;
    let gyration = ((xx + yy + zz) / body.invariants().mass).sqrt();
    body.coordinates().iter().map(|c| if c.unit == "m" { gyration } else { 1.0 }).collect()
}

/// Angular momentum and kinetic energy about the pole, by summing over the masses; a free body moves so that its centre
/// of mass rests.
fn by_newton(cloud: &Cloud, free: bool, state: &State) -> (V, f64) {
    let h = 1e-3;
    let place = |t: f64| {
        let moved = state.q.iter().zip(&state.rate).map(|(q, rate)| q + t * rate).collect::<Vec<_>>();
        cloud.at(&moved)
    };
    // Paths are straight in the first use, and in the second this error of h⁴ is below the measured one.
    let ends = [place(h), place(-h), place(2.0 * h), place(-2.0 * h)];
    let now = place(0.0);
    let omega = V::from(state.omega);
    let velocity = |i: usize| {
        let relative = (8.0 * (ends[0][i].1 - ends[1][i].1) - (ends[2][i].1 - ends[3][i].1)) / (12.0 * h);
        relative + omega.cross(&now[i].1)
    };
    let (mass, center, _) = moments(&now);
    let momentum: V = now.iter().enumerate().map(|(i, (m, _))| *m * velocity(i)).sum();
    let (center, drift) = if free { (center, momentum / mass) } else { (V::zeros(), V::zeros()) };
    let mut K = V::zeros();
    let mut energy = 0.0;
    for (i, (m, u)) in now.iter().enumerate() {
        let v = velocity(i) - drift;
        K += *m * (u - center).cross(&v);
        energy += 0.5 * m * v.norm_squared();
    }
    (K, energy)
}

proptest! {
    #![proptest_config(cases(32))]

    /// Relations `K = ∂T/∂ω`, `π_j = ∂T/∂q̇_j`, load `= ∂T/∂q_j`, all of one function. (S4), (S6)
    #[test]
    fn momenta_and_loads_are_derivatives_of_the_kinetic_energy(
        assembly in assemblies(), units in units(), omega in vector(), numbers in vec(-1.0..1.0, 24)
    ) {
        let body = rescaled(&assembly, units).body().unwrap();
        let (time, units) = (units.time, lengths(&body));
        let mut state = State::new(omega.map(|w| w / time), &numbers, units.len(), 0.5);
        for (j, unit) in units.iter().enumerate() {
            state.q[j] *= unit;
            state.rate[j] *= unit / time;
        }
        let T = body.energy(state.motion());
        let K = body.angular_momentum(state.motion());
        for (axis, K) in K.into_iter().enumerate() {
            let expected = slope(&body, &state, 1.0 / time, |state, step| state.omega[axis] += step);
            prop_assert!((K - expected).abs() < ROUNDING * T * time, "K: {} {expected}", K);
        }
        let (momenta, loads) = (body.generalized_momentum(state.motion()), body.load(state.motion()));
        for (j, unit) in units.iter().enumerate() {
            let expected = slope(&body, &state, unit / time, |state, step| state.rate[j] += step);
            prop_assert!((momenta[j] - expected).abs() * unit < ROUNDING * T * time, "π: {} {expected}", momenta[j]);
            let expected = slope(&body, &state, *unit, |state, step| state.q[j] += step);
            prop_assert!((loads[j] - expected).abs() * unit < ROUNDING * T, "load: {} {expected}", loads[j]);
        }
    }

    /// Along any motion whatever, `Ė = ω·K̇ + q̇·(π̇ − load + C q)`: the work of all forces, (S5). Rates by Taylor series
    /// in time.
    #[test]
    fn energy_changes_by_the_work_done(
        assembly in assemblies(), omega in vector(), turning in vector(), numbers in vec(-1.0..1.0, 48)
    ) {
        let body = assembly.body().unwrap();
        let units = lengths(&body);
        let some = |j: usize, i: usize| numbers[(3 * j + i) % numbers.len()] * units[j];
        let n = units.len();
        let jet = |value, first, second| Jet { value, first, second };
        let spin: [Jet; 3] = std::array::from_fn(|i| jet(omega[i], turning[i], 0.0));
        let q: Vec<Jet> = (0..n).map(|j| jet(some(j, 0), some(j, 1), some(j, 2))).collect();
        let rate: Vec<Jet> = (0..n).map(|j| jet(some(j, 1), some(j, 2), 0.0)).collect();
        let motion = MotionState { omega: spin, q: &q, rate: &rate };
        let K = body.angular_momentum(motion);
        let (momenta, loads) = (body.generalized_momentum(motion), body.load(motion));
        let spring = body.stiffness().times(&q.iter().map(|q| q.value).collect::<Vec<_>>());
        let mut work: f64 = (0..3).map(|i| omega[i] * K[i].first).sum();
        for j in 0..n {
            work += rate[j].value * (momenta[j].first - loads[j].value + spring[j]);
        }
        let energy = |t: f64| {
            let state = State {
                omega: std::array::from_fn(|i| omega[i] + t * turning[i]),
                q: (0..n).map(|j| some(j, 0) + t * some(j, 1) + 0.5 * t * t * some(j, 2)).collect(),
                rate: (0..n).map(|j| some(j, 1) + t * some(j, 2)).collect(),
            };
            body.energy(state.motion())
        };
        let h = 0.01;
        let odd = |i: f64| energy(i * h) - energy(-i * h);
        let rate_of_energy = (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * h);
        // Differences of sixth order of a polynomial in time of degree ten, rounding 1e-16/h.
        let scale = energy(0.0).abs().max(elastic(&body, &(0..n).map(|j| some(j, 0)).collect::<Vec<_>>()));
        prop_assert!((rate_of_energy - work).abs() < 1e-10 * scale, "{rate_of_energy} {work} of {scale}");
    }

    /// Straight paths: exact for any displacement. The pole of a free body moves so that the centre of mass rests. (S6)
    #[test]
    fn momentum_and_energy_are_sums_over_the_masses(
        massive in massive_points(), held in any::<bool>(), point in vector(), omega in vector(),
        numbers in vec(-1.0..1.0, 24)
    ) {
        let mut massive = massive;
        if held {
            massive.assembly.support = quasirigid::model::Support::FixedPoint { point };
        }
        let body = massive.assembly.body().unwrap();
        let state = State::new(omega, &numbers, body.coordinates().len(), 1.0);
        let (K, T) = by_newton(&Cloud::of(&massive, &body), !held, &state);
        let gap = (V::from(body.angular_momentum(state.motion())) - K).norm();
        // Rates by differences over 1e-3 round by 1e-13.
        prop_assert!(gap < 1e-11 * T.max(K.norm()), "K: {gap:e}");
        prop_assert!((kinetic(&body, &state) - T).abs() < 1e-11 * T);
    }

    /// Paths on hinges in the full equations: momentum, energy and inertia at any angles are sums over the masses. (I12), (K13)
    #[test]
    fn full_momentum_and_energy_on_hinges_are_sums_over_the_masses(
        massive in massive().prop_filter("a hinge", |m| !m.appendages.is_empty()),
        omega in vector(), numbers in vec(-1.0..1.0, 24)
    ) {
        let body = massive.assembly.body().unwrap();
        let free = body.translation().is_some();
        let cloud = Cloud::of(&massive, &body);
        let mut state = State::new(omega, &numbers, body.coordinates().len(), 1.0);
        let (K, T) = by_newton(&cloud, free, &state);
        let size = T.max(K.norm());
        let gap = (V::from(body.full_momenta(state.motion()).0) - K).norm();
        let energy = body.full_energy(state.motion()) - elastic(&body, &state.q);
        // rates by differences of fourth order over 1e-3
        prop_assert!(gap < 1e-10 * size, "K: {gap:e} of {size}");
        prop_assert!((energy - T).abs() < 1e-10 * size, "T: {energy} {T}");
        state.rate.fill(0.0);
        let still = by_newton(&cloud, free, &state).0;
        let turned = times(body.full_inertia_at(&state.q), omega);
        prop_assert!((V::from(turned) - still).norm() < 1e-12 * size, "J: {turned:?} {still}");
    }

    /// Curved paths: the error of the expansion is cubic in the displacements. (S1), (S6)
    #[test]
    fn momentum_of_curved_paths_errs_by_the_cube_of_the_displacement(
        massive in massive().prop_filter("a hinge", |m| !m.appendages.is_empty()),
        omega in vector(), numbers in vec(-1.0..1.0, 24)
    ) {
        let body = massive.assembly.body().unwrap();
        let free = body.translation().is_some();
        let cloud = Cloud::of(&massive, &body);
        // Sums over several states, in which no cubic term vanishes by accident.
        let gap = |amount: f64| {
            let (mut angular_momentum, mut energy) = (0.0, 0.0);
            for first in 0..6 {
                let state = State::new(omega, &numbers[first..], body.coordinates().len(), amount);
                let (K, T) = by_newton(&cloud, free, &state);
                angular_momentum += (V::from(body.angular_momentum(state.motion())) - K).norm();
                energy += (kinetic(&body, &state) - T).abs();
            }
            (angular_momentum, energy)
        };
        let (large, small) = (gap(4e-3), gap(2e-3));
        // 2³ = 8, less a fourth-order term of relative size 1e-2, plus the rounding of the differences.
        let floor = 1e-13 * body.invariants().J[0];
        prop_assert!(small.0 < large.0 / 7.5 + floor, "K: {large:?} {small:?}");
        prop_assert!(small.1 < large.1 / 7.5 + floor, "T: {large:?} {small:?}");
    }
}
