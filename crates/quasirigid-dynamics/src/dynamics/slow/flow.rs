//! Slow motion under forces at a state: internal coordinates slaved to the rigid motion, by Taylor series in time.
//! Forces are no polynomials in the angular velocity, so derivatives come from series along the flow; each pass gains one order and costs
//! two terms, so that a pass has two fewer than the one before.
//! Equations (E1), (E2) and (E5), docs/theory/09-forced-reduction.md; (C3), docs/theory/13-inside.md.

use std::ops::Range;

use crate::dynamics::external::{Forced, Pose};
use crate::math::ode::Checkpoint;
use crate::math::rotation;
use crate::math::scalar::Smooth;
use crate::math::sym3::{smooth_inverse, smooth_times};
use crate::math::taylor::Taylor;
use crate::math::vec3::{add, cross, scale};
use crate::model::MotionState;
use crate::model::force::Loads;

/// Slow motion at one moment: angular velocity, internal coordinates slaved to it, and loads.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowPoint {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Internal coordinates.
    pub q: Vec<f64>,
    /// Rates of the internal coordinates.
    pub rate: Vec<f64>,
    /// External loads.
    pub loads: Loads<f64>,
}

impl SlowPoint {
    /// Angular velocity and coordinates.
    #[must_use]
    pub fn motion(&self) -> MotionState<'_, f64> {
        MotionState { omega: self.omega, q: &self.q, rate: &self.rate }
    }
}

/// Highest order of the reduction of a forced body.
pub const MAX_FORCED_ORDER: usize = 5;

/// Slow motion of order `p` at a state. (E2)
///
/// Each improvement of the coordinates along the flow costs two derivatives and gains an order: of elastic ones from `p = 1`, of
/// cyclic rates, which begin a degree lower, from `p = 0`. (C3)
///
/// # Panics
/// If the order is above [`MAX_FORCED_ORDER`].
pub(super) fn slow_point(system: Forced, order: usize, K: [f64; 3], pose: &Pose<f64>) -> SlowPoint {
    passes(system, system.acts(), order, K, pose).0
}

/// Slow motion of order `p` without the actions from outside, at the momentary speeds of wheels. (E6)
///
/// # Panics
/// As [`slow_point`].
pub(super) fn free_point(system: Forced, order: usize, K: [f64; 3], pose: &Pose<f64>) -> SlowPoint {
    passes(system, false, order, K, pose).0
}

/// Whether forces by the time alone are zero with all their derivatives, so that the body moves as without them. (E6)
pub(super) fn rests(system: Forced, pose: &Pose<f64>) -> bool {
    const TERMS: usize = 2 * MAX_FORCED_ORDER + 1;
    let fixed = |value: [f64; 3]| value.map(Taylor::<TERMS>::from);
    let pose = Pose {
        t: Taylor::variable(pose.t),
        attitude: pose.attitude.map(Taylor::from),
        place: fixed(pose.place),
        velocity: fixed(pose.velocity),
    };
    let still = vec![Taylor::from(0.0); system.body.coordinates().len()];
    let Loads { force, moment, generalized } =
        system.loads(&pose, MotionState { omega: fixed([0.0; 3]), q: &still, rate: &still });
    let mut all = force.iter().chain(&moment).chain(&generalized);
    all.all(|load| (0..TERMS).all(|term| load.coefficient(term) == 0.0))
}

/// Least order whose dissipation has a correction, by which lower ones are judged. (E5)
const JUDGED: usize = 3;

/// What the last pass adds to the slow motion: as small beside it as the series converges. (E5)
#[derive(Clone, Debug)]
pub(super) struct Correction {
    q: Vec<f64>,
    rate: Vec<f64>,
}

impl Correction {
    /// Correction at a state, with the slow motion that it is part of.
    pub fn at(system: Forced, order: usize, K: [f64; 3], pose: &Pose<f64>) -> (SlowPoint, Self) {
        passes(system, system.acts(), order.max(JUDGED), K, pose)
    }

    /// From one slow motion to another.
    pub fn between(before: &SlowPoint, after: &SlowPoint) -> Self {
        Self { q: less(&after.q, &before.q), rate: less(&after.rate, &before.rate) }
    }

    /// No correction of a body with so many coordinates.
    pub fn none(coordinates: usize) -> Self {
        Self { q: vec![0.0; coordinates], rate: vec![0.0; coordinates] }
    }

    /// Takes up a change to another correction over a time (s), and forgets what is older than the vibrations of such a shape. (E5)
    pub fn follow(&mut self, system: Forced, [from, to]: [&Self; 2], time: f64) {
        let shape = less(&to.q, &from.q);
        let elapsed = time / (REMEMBERED * vibration_time(system, &shape));
        let (kept, gained) = if elapsed > 0.0 && elapsed.is_finite() {
            ((-elapsed).exp(), -(-elapsed).exp_m1() / elapsed)
        } else {
            (1.0, 1.0)
        };
        let grow = |own: &mut [f64], change: Vec<f64>| {
            own.iter_mut().zip(change).for_each(|(own, change)| *own = kept * *own + gained * change);
        };
        grow(&mut self.q, shape);
        grow(&mut self.rate, less(&to.rate, &from.rate));
    }

    /// Estimate of the error of the dissipated power (W) by the terms that the series leaves out, `2 δq̇·B·δq̇`. (E5)
    pub fn error_of_power(&self, system: Forced) -> f64 {
        2.0 * system.body.damping().quadratic(&self.rate)
    }

    /// Energy (J) of the free vibration with these displacements and rates, about a body that recoils. (E5)
    pub fn vibration_energy(&self, system: Forced) -> f64 {
        elastic_energy(system, &self.q) + kinetic_energy(system, &self.rate)
    }

    /// Saves displacements and rates.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        [&self.q, &self.rate].iter().for_each(|list| checkpoint.save_list(list));
    }

    /// Loads saved ones; none of another body.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        [&mut self.q, &mut self.rate].into_iter().try_for_each(|list| checkpoint.load_into(list))
    }
}

/// Radians of a vibration for which a change counts as one. (E5)
const REMEMBERED: f64 = 3.0;

/// Time (s) of a radian of vibration with a shape, by Rayleigh's quotient; infinite of one that no stiffness resists.
fn vibration_time(system: Forced, shape: &[f64]) -> f64 {
    (kinetic_energy(system, shape) / elastic_energy(system, shape)).sqrt()
}

/// Energy (J) that the stiffness stores at displacements.
pub(super) fn elastic_energy(system: Forced, q: &[f64]) -> f64 {
    0.5 * system.body.stiffness().quadratic(q)
}

/// Energy (J) of rates of the internal coordinates of a body that is not displaced, whose carrier recoils.
fn kinetic_energy(system: Forced, rate: &[f64]) -> f64 {
    let still = vec![0.0; rate.len()];
    let omega = spin(system, [0.0; 3], &still, rate);
    system.body.energy(MotionState { omega, q: &still, rate })
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Slow motion with or without the actions from outside, and what the last pass has added. Each pass uses up two terms of the series.
fn passes(
    system: Forced,
    acts: bool,
    order: usize,
    K: [f64; 3],
    pose: &Pose<f64>,
) -> (SlowPoint, Correction) {
    let body = system.body;
    let improved = match (body.coordinates().is_empty(), body.cyclic().is_empty()) {
        (true, _) => 0,
        (false, true) => order.saturating_sub(1),
        (false, false) => order,
    };
    let state = State { system, acts, K, pose };
    match improved {
        0 => state.point(&Path::<1>::still(system), &Path::<1>::still(system)),
        1 => state.last(&Path::still(system)),
        2 => state.last(&state.pass::<5, 3>(&Path::still(system))),
        3 => state.last(&state.pass::<5, 3>(&state.pass::<7, 5>(&Path::still(system)))),
        4 => {
            let second = state.pass::<7, 5>(&state.pass::<9, 7>(&Path::still(system)));
            state.last(&state.pass::<5, 3>(&second))
        }
        5 => {
            let second = state.pass::<9, 7>(&state.pass::<11, 9>(&Path::still(system)));
            state.last(&state.pass::<5, 3>(&state.pass::<7, 5>(&second)))
        }
        _ => unreachable!("orders are checked where they enter"),
    }
}

/// Coordinates and their rates along the flow, series of `N` terms in time.
struct Path<const N: usize> {
    q: Vec<Taylor<N>>,
    rate: Vec<Taylor<N>>,
}

impl<const N: usize> Path<N> {
    fn still(system: Forced) -> Self {
        let q = vec![Taylor::from(0.0); system.body.coordinates().len()];
        Self { rate: q.clone(), q }
    }

    /// The same with the first `M` terms alone.
    fn cut<const M: usize>(&self) -> Path<M> {
        let cut = |list: &[Taylor<N>]| {
            list.iter().map(|entry| Taylor::new(std::array::from_fn(|k| entry.coefficient(k)))).collect()
        };
        Path { q: cut(&self.q), rate: cut(&self.rate) }
    }

    fn values(&self) -> [Vec<f64>; 2] {
        [&self.q, &self.rate].map(|list| list.iter().map(|entry| entry.value()).collect())
    }
}

/// State at which the slow motion is sought.
struct State<'a> {
    system: Forced<'a>,
    acts: bool,
    K: [f64; 3],
    pose: &'a Pose<f64>,
}

impl State<'_> {
    /// Improves the coordinates along the flow; of their terms so many fewer are known. (E2)
    fn pass<const N: usize, const M: usize>(&self, Path { q, rate }: &Path<N>) -> Path<M> {
        let flow = Flow::along(self.system, self.acts, self.K, self.pose, [q, rate]);
        let (q, rate) = flow.coordinates(self.system, q, rate);
        Path { q, rate }.cut()
    }

    fn last(&self, before: &Path<3>) -> (SlowPoint, Correction) {
        self.point(before, &self.pass::<3, 1>(before))
    }

    /// Slow motion with these coordinates, and what they add to those before.
    fn point<const N: usize>(&self, before: &Path<N>, after: &Path<1>) -> (SlowPoint, Correction) {
        let Self { system, acts, K, pose } = *self;
        let ([q, rate], [old, old_rate]) = (after.values(), before.values());
        let added = Correction { q: less(&q, &old), rate: less(&rate, &old_rate) };
        let own = add(K, scale(-1.0, system.body.wheels().angular_momentum(pose.t)));
        let omega = spin(system, own, &q, &rate);
        let loads = loads(system, acts, pose, MotionState { omega, q: &q, rate: &rate });
        (SlowPoint { omega, q, rate, loads }, added)
    }
}

/// Angular velocity from an angular momentum without that of wheels, at a displacement: `J(q)ω = K − h(q)q̇`. (S2)
fn spin<T: Smooth>(system: Forced, K: [T; 3], q: &[T], rate: &[T]) -> [T; 3] {
    let still = MotionState { omega: [T::from(0.0); 3], q, rate };
    let internal = system.body.angular_momentum(still);
    let rest = add(K, scale(T::from(-1.0), internal));
    smooth_times(smooth_inverse(system.body.inertia_at(q)), rest)
}

/// Loads of what acts from outside, if anything does.
pub(super) fn loads<T: Smooth>(
    system: Forced,
    acts: bool,
    pose: &Pose<T>,
    motion: MotionState<T>,
) -> Loads<T> {
    if acts { system.loads(pose, motion) } else { Loads::none(motion.q.len()) }
}

/// Taylor series in time of the slow variables, with the internal coordinates on a given path. (E1)
struct Flow<const N: usize> {
    omega: [Taylor<N>; 3],
    loads: Loads<Taylor<N>>,
}

impl<const N: usize> Flow<N> {
    fn along(
        system: Forced,
        acts: bool,
        K0: [f64; 3],
        start: &Pose<f64>,
        [q, rate]: [&[Taylor<N>]; 2],
    ) -> Self {
        let mut K = K0.map(Taylor::from);
        let mut pose = Pose {
            t: Taylor::variable(start.t),
            attitude: start.attitude.map(Taylor::from),
            place: start.place.map(Taylor::from),
            velocity: start.velocity.map(Taylor::from),
        };
        let inverse = smooth_inverse(system.body.inertia_at(q));
        let still = MotionState { omega: [Taylor::from(0.0); 3], q, rate };
        let internal =
            add(system.body.angular_momentum(still), system.body.wheels().angular_momentum(pose.t));
        let spin = |K: [Taylor<N>; 3]| smooth_times(inverse, add(K, scale(Taylor::from(-1.0), internal)));
        let (feels_path, feels_attitude) = (system.feels_path(), system.feels_attitude());
        // forces by the time alone, in axes of the body, are the same in every pass
        let fixed = (acts && !feels_attitude && system.is_prescribed())
            .then(|| system.loads(&pose, MotionState { omega: spin(K), q, rate }));
        for _ in 1..N {
            let omega = spin(K);
            let mut torque = cross(K, omega);
            if let Some(loads) = &fixed {
                torque = add(torque, loads.moment);
            } else if acts {
                let loads = system.loads(&pose, MotionState { omega, q, rate });
                torque = add(torque, loads.moment);
                if feels_path {
                    let velocity = Taylor::integrals(system.acceleration(&pose, loads.force), start.velocity);
                    pose.place = Taylor::integrals(pose.velocity, start.place);
                    pose.velocity = velocity;
                }
                if feels_attitude {
                    pose.attitude = Taylor::integrals(rotation::rate(pose.attitude, omega), start.attitude);
                }
            }
            K = Taylor::integrals(torque, K0);
        }
        let omega = spin(K);
        let last = || loads(system, acts, &pose, MotionState { omega, q, rate });
        Self { omega, loads: fixed.unwrap_or_else(last) }
    }

    /// `q = C⁻¹(∂T/∂q + Q − d/dt ∂T/∂q̇ − B q̇)` of elastic coordinates, with their rates, and `q̇ = B⁻¹(…)` of cyclic ones, from the
    /// coordinates of the previous order. (E2), (C3)
    fn coordinates(
        &self,
        system: Forced,
        q: &[Taylor<N>],
        rate: &[Taylor<N>],
    ) -> (Vec<Taylor<N>>, Vec<Taylor<N>>) {
        let (body, cyclic) = (system.body, system.body.cyclic());
        let motion = MotionState { omega: self.omega, q, rate };
        let load = body.load(motion);
        let momentum = body.generalized_momentum(motion);
        let free = |j: usize| load[j] + self.loads.generalized[j] - momentum[j].derivative();
        let braked = |j: usize, by: &[Taylor<N>], but: Range<usize>| {
            let row = body.damping().row(j).filter(move |(k, _)| !but.contains(k));
            row.fold(free(j), |right, (k, damping)| right - Taylor::from(*damping) * by[k])
        };
        let mut held = rows((0..body.elastic()).map(|j| braked(j, rate, 0..0)));
        held.resize(N * q.len(), 0.0);
        body.solve_stiffness(&mut held, N);
        let q = series(&held);
        let mut rate: Vec<_> = q.iter().map(Taylor::derivative).collect();
        let mut turning = rows(cyclic.clone().map(|j| braked(j, &rate, cyclic.clone())));
        body.solve_friction(&mut turning, N);
        rate[cyclic].copy_from_slice(&series(&turning));
        (q, rate)
    }
}

fn rows<const N: usize>(list: impl Iterator<Item = Taylor<N>>) -> Vec<f64> {
    list.flat_map(|entry| (0..N).map(move |term| entry.coefficient(term))).collect()
}

fn series<const N: usize>(rows: &[f64]) -> Vec<Taylor<N>> {
    rows.as_chunks::<N>().0.iter().map(|coefficients| Taylor::new(*coefficients)).collect()
}
