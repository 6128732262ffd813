//! Periodic motions of the free full system in body axes, on which the mean power of a wobble is exact: no transient, no window.
//! A slow loss keeps the motion from closing. A torque across the angular momentum that feeds the rotation closes it; what it feeds is what the
//! body loses.
//! Equation (Q19), docs/theory/16-methods.md.

use crate::math::periodic::{Guess, PeriodicSolution, Unfolded, multipliers, periodic};
use crate::math::vec3::{add, cross, dot, norm, scale, unit};
use crate::model::{FlexibleBody, Kinetics, MotionState};

/// Periodic motion of the full system in body axes. (Q19)
#[derive(Clone, Debug)]
pub struct PeriodicMotion {
    /// Period (s).
    pub period: f64,
    /// Mean power dissipated (W).
    pub power: f64,
    /// Mean power of each dissipator (W), in the order of [`FlexibleBody::dissipators`].
    pub budget: Vec<f64>,
    /// Mean energy (J).
    pub energy: f64,
    solution: PeriodicSolution,
}

/// Guess of a periodic motion: angular velocity (rad/s, body axes) and displacements at a share of the period, from 0 to 1.
pub struct MotionGuess<'a> {
    /// Period (s).
    pub period: f64,
    /// Angular momentum (N·m·s, body axes) at the start, which the motion passes through.
    pub start: [f64; 3],
    /// Angular velocity (rad/s, body axes) at a share of the period.
    pub omega: &'a dyn Fn(f64) -> [f64; 3],
    /// Displacements at an angular velocity, at rest in the body.
    pub displacements: &'a dyn Fn([f64; 3]) -> Vec<f64>,
    /// Motion near by, whose internal motion is taken instead.
    pub near: Option<&'a PeriodicMotion>,
}

/// Finds the periodic motion of a free body near a guess, on so many intervals. (Q19)
///
/// None where Newton's method does not converge, the mass matrix is not positive, or friction beyond the damping matrix acts.
#[must_use]
pub fn periodic_motion(body: &FlexibleBody, guess: &MotionGuess, intervals: usize) -> Option<PeriodicMotion> {
    let system = ClosedSystem::new(body, guess.start)?;
    let first = system.guessed(guess, 0.0)?;
    let state = |share: f64| {
        let mut state = system.guessed(guess, share).unwrap_or_else(|| first.clone());
        if share == 0.0 {
            state[..3].copy_from_slice(&guess.start);
        }
        state
    };
    let guess = Guess { period: guess.period, state: &state, parameters: Vec::new() };
    system.clone().found(&guess, intervals)
}

impl PeriodicMotion {
    /// The motion on another number of intervals; none where Newton's method does not converge.
    #[must_use]
    pub fn on(&self, body: &FlexibleBody, intervals: usize) -> Option<Self> {
        let state = |share: f64| self.solution.at(share);
        let start = state(0.0);
        let parameters = self.solution.parameters().to_vec();
        let guess = Guess { period: self.period, state: &state, parameters };
        ClosedSystem::new(body, [start[0], start[1], start[2]])?.found(&guess, intervals)
    }

    /// Largest rate (1/s) at which a change of the motion grows, beside those along the motion, in its energy and in its angular momentum; none
    /// where it is not found.
    #[must_use]
    pub fn growth(&self, body: &FlexibleBody) -> Option<f64> {
        let start = self.solution.at(0.0);
        let mut system = ClosedSystem::new(body, [start[0], start[1], start[2]])?;
        system.rescale(&self.solution.samples().map(|(_, state)| state.to_vec()).collect::<Vec<_>>());
        Some(growth(multipliers(&system, &self.solution)?, self.period))
    }
}

/// Samples of a guess that give the sizes of the components.
const SAMPLES: usize = 16;
/// Least size of a component, over that of its momentum or displacement at the energy of the rotation.
const LEAST_SIZE: f64 = 1e-3;

/// Free full system in body axes without attitude and cyclic coordinates, `z = (K, q, p)`, with the torques that unfold the energy and `|K|`:
/// `λ k × (ω × K)` and `μ ω_s K` along the unit vector `k` of `K`, with the spin `ω_s` of the start.
#[derive(Clone, Debug)]
struct ClosedSystem<'a> {
    kinetics: Kinetics<'a>,
    wheels: [f64; 3],
    /// Number of elastic coordinates, and of all.
    elastic: usize,
    n: usize,
    /// Rotation about the angular momentum of the start (rad/s).
    spin: f64,
    scales: Vec<f64>,
    q: Vec<f64>,
    rates: Vec<f64>,
    loads: Vec<f64>,
}

/// What a state has: the rate of its angular momentum, and the power dissipated.
struct Flow {
    omega: [f64; 3],
    power: f64,
}

impl<'a> ClosedSystem<'a> {
    fn new(body: &'a FlexibleBody, start: [f64; 3]) -> Option<Self> {
        if !body.frictions().is_empty() || !body.drives().is_empty() {
            return None;
        }
        let (elastic, n) = (body.elastic(), body.coordinates().len());
        let mut system = Self {
            kinetics: Kinetics::new(body)?,
            wheels: body.wheels().angular_momentum(0.0),
            elastic,
            n,
            spin: 1.0,
            scales: vec![1.0; 3 + elastic + n],
            q: vec![0.0; n],
            rates: vec![0.0; n],
            loads: vec![0.0; n],
        };
        let mut still = vec![0.0; 3 + elastic + n];
        still[..3].copy_from_slice(&start);
        system.spin = norm(system.flow(&still).omega);
        Some(system)
    }

    /// Rates of the coordinates and loads on them at a state.
    fn flow(&mut self, z: &[f64]) -> Flow {
        let K = [z[0], z[1], z[2]];
        self.q[..self.elastic].copy_from_slice(&z[3..3 + self.elastic]);
        let own = add(K, scale(-1.0, self.wheels));
        let velocities = self.kinetics.velocities(own, &z[3 + self.elastic..], &self.q, &mut self.rates);
        self.loads.fill(0.0);
        let power = velocities.add_loads(&self.q, &self.rates, &mut self.loads);
        Flow { omega: velocities.omega, power }
    }

    /// State of a guess at a share of its period; none if the guess is no number.
    fn guessed(&self, guess: &MotionGuess, share: f64) -> Option<Vec<f64>> {
        let body = self.kinetics.body();
        let omega = (guess.omega)(share);
        let near = guess.near.map(|near| near.solution.at(share));
        let q = match &near {
            Some(near) => {
                let mut q = vec![0.0; self.n];
                q[..self.elastic].copy_from_slice(&near[3..3 + self.elastic]);
                q
            }
            None => (guess.displacements)(omega),
        };
        let (own, p) = body.full_momenta(MotionState { omega, q: &q, rate: &vec![0.0; self.n] });
        let K = scale(norm(guess.start), unit(add(own, self.wheels)));
        let p = near.as_ref().map_or(&p[..], |near| &near[3 + self.elastic..]);
        let state: Vec<f64> = K.iter().chain(&q[..self.elastic]).chain(p).copied().collect();
        state.iter().all(|value| value.is_finite()).then_some(state)
    }

    /// Takes the sizes of the components from samples, none below a share of that at the energy of the rotation.
    fn rescale(&mut self, samples: &[Vec<f64>]) {
        let body = self.kinetics.body();
        let G = norm([samples[0][0], samples[0][1], samples[0][2]]);
        let energy = G * self.spin;
        let stiffness = body.stiffness().diagonal();
        let own = |entries: f64, at: f64| if entries > 0.0 { at } else { 0.0 };
        for k in 0..self.elastic + self.n {
            let place = 3 + k;
            let largest = samples.iter().map(|z| z[place].abs()).fold(0.0, f64::max);
            let natural = if k < self.elastic {
                own(stiffness[k], (energy / stiffness[k]).sqrt())
            } else {
                (energy * body.invariants().modal_mass(k - self.elastic)).sqrt()
            };
            let size = largest.max(LEAST_SIZE * natural);
            self.scales[place] = if size > 0.0 { size } else { 1.0 };
        }
        self.scales[..3].fill(G);
    }

    /// The periodic motion near a guess.
    fn found(mut self, guess: &Guess, intervals: usize) -> Option<PeriodicMotion> {
        let samples: Vec<Vec<f64>> = (0..SAMPLES).map(|i| (guess.state)(i as f64 / SAMPLES as f64)).collect();
        self.rescale(&samples);
        let solution = periodic(&self, guess, intervals)?;
        Some(self.judged(solution))
    }

    /// Means over a solution.
    fn judged(mut self, solution: PeriodicSolution) -> PeriodicMotion {
        let body = self.kinetics.body();
        let mut budget = vec![0.0; body.dissipators().len()];
        let (mut power, mut energy) = (0.0, 0.0);
        for (weight, z) in solution.samples() {
            let flow = self.flow(z);
            power += weight * flow.power;
            energy += weight * self.energy(z, flow.omega);
            for (sum, dissipator) in budget.iter_mut().zip(body.dissipators()) {
                *sum += weight * dissipator.power(&self.rates);
            }
        }
        let period = solution.period();
        PeriodicMotion { period, power, budget, energy, solution }
    }

    /// Energy of a state (J), without that of wheels.
    fn energy(&self, z: &[f64], omega: [f64; 3]) -> f64 {
        let own = add([z[0], z[1], z[2]], scale(-1.0, self.wheels));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let elastic = product(&self.kinetics.body().stiffness().times(&self.q), &self.q);
        0.5 * (dot(omega, own) + product(&z[3 + self.elastic..], &self.rates) + elastic)
    }

    /// Torques (N·m) that unfold the energy and `|K|`.
    fn torques(&self, z: &[f64], omega: [f64; 3]) -> [[f64; 3]; 2] {
        let K = [z[0], z[1], z[2]];
        [cross(unit(K), cross(omega, K)), scale(self.spin, K)]
    }
}

impl Unfolded for ClosedSystem<'_> {
    fn size(&self) -> usize {
        self.scales.len()
    }

    fn parameters(&self) -> usize {
        2
    }

    fn rate(&mut self, z: &[f64], parameters: &[f64], rate: &mut [f64]) {
        let Flow { omega, .. } = self.flow(z);
        let mut turning = cross([z[0], z[1], z[2]], omega);
        for (torque, parameter) in self.torques(z, omega).iter().zip(parameters) {
            turning = add(turning, scale(*parameter, *torque));
        }
        let (slow, fast) = rate.split_at_mut(3);
        slow.copy_from_slice(&turning);
        let (q_rate, p_rate) = fast.split_at_mut(self.elastic);
        q_rate.copy_from_slice(&self.rates[..self.elastic]);
        p_rate.copy_from_slice(&self.loads);
    }

    fn directions(&mut self, z: &[f64]) -> Vec<Vec<f64>> {
        let Flow { omega, .. } = self.flow(z);
        let rest = vec![0.0; self.size() - 3];
        self.torques(z, omega).iter().map(|torque| [torque, rest.as_slice()].concat()).collect()
    }

    fn scale(&self, component: usize) -> f64 {
        self.scales[component]
    }
}

/// Largest rate (1/s) of growth by multipliers over a period, beside the three nearest to one.
fn growth(mut multipliers: Vec<[f64; 2]>, period: f64) -> f64 {
    let from_one = |[re, im]: &[f64; 2]| (re - 1.0).hypot(*im);
    multipliers.sort_by(|a, b| from_one(a).total_cmp(&from_one(b)));
    let sizes = multipliers.iter().skip(NEUTRAL).map(|[re, im]| re.hypot(*im));
    sizes.fold(f64::MIN_POSITIVE, f64::max).ln() / period
}

/// Multipliers of one: along the motion, in its energy and in its angular momentum.
const NEUTRAL: usize = 3;
