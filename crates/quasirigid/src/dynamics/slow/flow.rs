use crate::dynamics::external::{Forced, Pose};
use crate::math::rotation;
use crate::math::scalar::Smooth;
use crate::math::sym::{add, cross, scale, smooth_inverse, smooth_times};
use crate::math::taylor::Taylor;
use crate::model::Motion;
use crate::model::force::Loads;

/// The slow motion through a state: spin, internal coordinates that are slaved to it, and loads, at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowPoint {
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Internal coordinates.
    pub q: Vec<f64>,
    /// Their rates.
    pub rate: Vec<f64>,
    /// External loads.
    pub loads: Loads<f64>,
}

/// Highest order of the reduction of a forced body.
pub const MAX_FORCED_ORDER: usize = 5;

/// The slow motion of order `p` through a state. (E2)
///
/// # Panics
/// If the order is zero or above [`MAX_FORCED_ORDER`].
pub(super) fn slow_point(system: Forced, order: usize, K: [f64; 3], pose: &Pose<f64>) -> SlowPoint {
    match order {
        1 => point::<1>(system, order, K, pose),
        2 => point::<3>(system, order, K, pose),
        3 => point::<5>(system, order, K, pose),
        4 => point::<7>(system, order, K, pose),
        5 => point::<9>(system, order, K, pose),
        _ => unreachable!("orders are checked where they enter"),
    }
}

/// Improves the coordinates `p − 1` times along the flow: each time costs two derivatives and gains an order.
fn point<const N: usize>(system: Forced, order: usize, K: [f64; 3], pose: &Pose<f64>) -> SlowPoint {
    let n = system.body.coordinates().len();
    let mut q = vec![Taylor::<N>::from(0.0); n];
    let mut rate = q.clone();
    for _ in 1..order {
        let flow = Flow::along(system, K, pose, &q, &rate);
        q = flow.coordinates(system, &q, &rate);
        rate = q.iter().map(Taylor::derivative).collect();
    }
    let values = |list: &[Taylor<N>]| -> Vec<f64> { list.iter().map(|entry| entry.value()).collect() };
    let (q, rate) = (values(&q), values(&rate));
    let omega = spin(system, K, &q, &rate);
    let loads = loads(system, pose, Motion { omega, q: &q, rate: &rate });
    SlowPoint { omega, q, rate, loads }
}

/// Spin of a momentum at a displacement, `J(q)ω = K − h(q)q̇`. (S2)
fn spin<T: Smooth>(system: Forced, K: [T; 3], q: &[T], rate: &[T]) -> [T; 3] {
    let still = Motion { omega: [T::from(0.0); 3], q, rate };
    let internal = system.body.momentum(still);
    let rest = add(K, scale(T::from(-1.0), internal));
    smooth_times(smooth_inverse(system.body.inertia_at(q)), rest)
}

fn loads<T: Smooth>(system: Forced, pose: &Pose<T>, motion: Motion<T>) -> Loads<T> {
    if system.acts() { system.loads(pose, motion) } else { Loads::none(motion.q.len()) }
}

/// Taylor series in time of the slow variables, with the internal coordinates on a given path. (E1)
struct Flow<const N: usize> {
    omega: [Taylor<N>; 3],
    loads: Loads<Taylor<N>>,
}

impl<const N: usize> Flow<N> {
    fn along(system: Forced, K0: [f64; 3], start: &Pose<f64>, q: &[Taylor<N>], rate: &[Taylor<N>]) -> Self {
        let mut K = K0.map(Taylor::from);
        let mut pose = Pose {
            t: Taylor::variable(start.t),
            attitude: start.attitude.map(Taylor::from),
            place: start.place.map(Taylor::from),
            velocity: start.velocity.map(Taylor::from),
        };
        let inverse = smooth_inverse(system.body.inertia_at(q));
        let internal = system.body.momentum(Motion { omega: [Taylor::from(0.0); 3], q, rate });
        let spin = |K: [Taylor<N>; 3]| smooth_times(inverse, add(K, scale(Taylor::from(-1.0), internal)));
        for _ in 1..N {
            let omega = spin(K);
            let mut torque = cross(K, omega);
            if system.acts() {
                let loads = system.loads(&pose, Motion { omega, q, rate });
                torque = add(torque, loads.moment);
                let velocity = Taylor::integrals(system.acceleration(&pose, loads.force), start.velocity);
                pose.place = Taylor::integrals(pose.velocity, start.place);
                pose.velocity = velocity;
                pose.attitude = Taylor::integrals(rotation::rate(pose.attitude, omega), start.attitude);
            }
            K = Taylor::integrals(torque, K0);
        }
        let omega = spin(K);
        Self { omega, loads: loads(system, &pose, Motion { omega, q, rate }) }
    }

    /// `q = C⁻¹(∂T/∂q + Q − d/dt ∂T/∂q̇ − B q̇)`, from the coordinates of the order before. (E2)
    fn coordinates(&self, system: Forced, q: &[Taylor<N>], rate: &[Taylor<N>]) -> Vec<Taylor<N>> {
        let motion = Motion { omega: self.omega, q, rate };
        let load = system.body.load(motion);
        let momentum = system.body.generalized_momentum(motion);
        let mut rows = Vec::with_capacity(N * q.len());
        for (j, load) in load.iter().enumerate() {
            let mut right = *load + self.loads.generalized[j] - momentum[j].derivative();
            for (k, damping) in system.body.damping().row(j) {
                right = right - Taylor::from(*damping) * rate[k];
            }
            rows.extend((0..N).map(|term| right.coefficient(term)));
        }
        system.body.solve_stiffness(&mut rows, N);
        let (series, _) = rows.as_chunks::<N>();
        series.iter().map(|coefficients| Taylor::new(*coefficients)).collect()
    }
}
