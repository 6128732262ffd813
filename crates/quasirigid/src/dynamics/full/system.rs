use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::keeper::{Invariant, Look, Motion as Followed, Seat};
use crate::dynamics::layout::{
    ANGLE, ATTITUDE, DISSIPATED, IMPULSE, Layout, MOMENTUM, PLACE, VELOCITY, WORK, attitude, triple,
};
use crate::math::dynamic_stiffness::{DynamicStiffness, Vibrator};
use crate::math::eigen::Dense;
use crate::math::ode::{Stiff, System};
use crate::math::rotation::{self, Turn};
use crate::math::simd::Arithmetic;
use crate::math::sparse::SparseRows;
use crate::math::sym::{self, add, cross, dot, norm, scale};
use crate::model::{Displaced, FlexibleBody, Kinetics, Motion, RANGE};

/// The full equations in momenta, `K̇ = K × ω + M`, `ṗ = ∂L/∂q − Bq̇ + Q`: no acceleration is solved for.
/// (S3), (S4), (T1), (C2)
#[derive(Clone, Debug)]
pub(super) struct FullSystem<'a> {
    system: Forced<'a>,
    layout: Layout,
    kinetics: Kinetics<'a>,
    /// Damping of each dissipator, if there are several: entries of the upper triangle, those off the diagonal doubled.
    accounts: Vec<Vec<(usize, usize, f64)>>,
    vibrator: Vibrator,
    shifts: Vec<DynamicStiffness>,
    /// Mass matrix of the vibrations, where it changes with the displacements.
    mass: Option<Dense>,
}

/// Steps of power iteration: the frequency is needed to a few per cent.
const POWER_ITERATIONS: usize = 40;

impl<'a> FullSystem<'a> {
    /// The equations of a body; none if its mass matrix is not positive.
    pub fn new(system: Forced<'a>) -> Option<Self> {
        let body = system.body;
        let layout = Layout::of(body);
        let accounts = body.dissipators().iter().take(layout.accounts).map(|part| upper(&part.damping));
        Some(Self {
            system,
            layout,
            kinetics: Kinetics::new(body)?,
            accounts: accounts.collect(),
            vibrator: vibrator(body),
            shifts: Vec::new(),
            mass: None,
        })
    }

    /// Free vibrations with this mass matrix.
    fn vibrator_of(&self, mass: &Dense) -> Vibrator {
        let (n, body) = (mass.size(), self.system.body);
        let entries = (0..n).flat_map(|j| (0..n).map(move |k| (j, k, mass.at(j, k))));
        let A = SparseRows::sum(n, entries.collect());
        Vibrator::new(A, vec![[0.0; 6]; n], [[0.0; 6]; 6], body.damping().clone(), body.stiffness().clone())
    }

    /// Adds what external forces do to the rates of a state. (F1), (F11)
    fn add_external(&self, t: f64, y: &[f64], motion: Motion<f64>, slow: &mut [f64], p_rate: &mut [f64]) {
        let velocity = triple(y, VELOCITY);
        let pose = Pose { t, attitude: attitude(y), place: triple(y, PLACE), velocity };
        let loads = self.system.loads(&pose, motion);
        let impulse = Turn::of(pose.attitude).to_inertial(loads.moment);
        let acceleration = self.system.acceleration(&pose, loads.force);
        let turning = add(triple(slow, MOMENTUM), loads.moment);
        for (at, rate) in
            [(MOMENTUM, turning), (IMPULSE, impulse), (PLACE, velocity), (VELOCITY, acceleration)]
        {
            slow[at..at + 3].copy_from_slice(&rate);
        }
        p_rate.iter_mut().zip(&loads.generalized).for_each(|(rate, Q)| *rate += Q);
        slow[WORK] = loads.power(motion, [0.0; 3]);
    }

    /// An upper estimate of the fastest rate of the elastic part, `|λ|` of `λ²M + λB + C` (1/s). (T3)
    pub fn fastest(&mut self) -> f64 {
        let body = self.system.body;
        let damping = self.largest(body.damping());
        let stiffness = self.largest(body.stiffness());
        0.5 * (damping + (damping * damping + 4.0 * stiffness).sqrt())
    }

    /// Largest eigenvalue of `M⁻¹X`, by power iteration.
    fn largest(&mut self, matrix: &SparseRows<f64>) -> f64 {
        let n = self.layout.n;
        let still = vec![0.0; n];
        let mut x: Vec<f64> = (0..n).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
        let mut largest = 0.0;
        for _ in 0..POWER_ITERATIONS {
            let force = matrix.times(&x);
            let scale = product(&force, &x);
            if !(scale > 0.0) {
                return largest;
            }
            let mut next = vec![0.0; n];
            self.kinetics.velocities([0.0; 3], &force, &still, &mut next);
            largest = product(&force, &next) / scale;
            let size = product(&next, &next).sqrt();
            x = next.iter().map(|entry| entry / size).collect();
        }
        largest
    }
}

impl System<Vec<f64>> for FullSystem<'_> {
    fn rate<A: Arithmetic>(&mut self, t: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let K = triple(y, MOMENTUM);
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let (slow, fast) = rate.split_at_mut(self.layout.slow());
        let (q_rate, p_rate) = fast.split_at_mut(self.layout.n);
        let wheels = self.system.body.wheels();
        let own = add(K, scale(-1.0, wheels.momentum(t)));
        let velocities = self.kinetics.velocities(own, p, q, q_rate);
        p_rate.fill(0.0);
        slow[DISSIPATED] = velocities.add_loads(q, q_rate, p_rate);
        let omega = velocities.omega;
        for (power, entries) in slow[self.layout.accounts()].iter_mut().zip(&self.accounts) {
            *power = entries.iter().map(|(j, k, entry)| entry * q_rate[*j] * q_rate[*k]).sum();
        }
        slow[ANGLE] = norm(omega);
        slow[MOMENTUM..MOMENTUM + 3].copy_from_slice(&cross(K, omega));
        slow[ATTITUDE..ATTITUDE + 4].copy_from_slice(&rotation::rate(attitude(y), omega));
        if self.system.acts() {
            let motion = Motion { omega, q, rate: q_rate };
            self.add_external(t, y, motion, slow, p_rate);
            slow[WORK] -= dot(omega, wheels.torque(t));
        } else {
            slow[PLACE..PLACE + 3].copy_from_slice(&triple(y, VELOCITY));
        }
    }
}

impl Followed for FullSystem<'_> {
    fn look(&mut self, t: f64, y: &[f64]) -> Look {
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let mut rate = vec![0.0; self.layout.n];
        let momentum = triple(y, MOMENTUM);
        let own = add(momentum, scale(-1.0, self.system.body.wheels().momentum(t)));
        let omega = self.kinetics.velocities(own, p, q, &mut rate).omega;
        let kinetic = dot(omega, own) + product(p, &rate);
        let elastic = product(&self.system.body.stiffness().times(q), q);
        let seat = Seat::of_center(self.system.body, Motion { omega, q, rate: &rate }, y);
        Look { omega, momentum, energy: 0.5 * (kinetic + elastic), q: q.to_vec(), rate, seat }
    }

    fn left(&self, y: &[f64]) -> Option<Displaced> {
        let farthest = self.system.body.paths()?.farthest(&y[self.layout.q()])?;
        (farthest.share > RANGE).then_some(farthest)
    }

    fn invariant(&self) -> Invariant {
        if self.system.acts() { Invariant::Impulse } else { Invariant::Momentum }
    }
}

/// `L` is the free vibration of the body that recoils: `q̇ = M⁻¹p`, `ṗ = −Bq̇ − Cq`, with the mass of (V2). (T2)
impl Stiff for FullSystem<'_> {
    fn stiff(&self) -> usize {
        self.layout.slow()
    }

    fn renew(&mut self, y: &[f64]) -> bool {
        let Some(mass) = self.kinetics.recoiling_mass(&y[self.layout.q()]) else { return false };
        if self.mass.as_ref().is_some_and(|known| alike(known, &mass)) {
            return false;
        }
        self.vibrator = self.vibrator_of(&mass);
        self.mass = Some(mass);
        true
    }

    fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        self.shifts = shifts.map(|s| self.vibrator.at(s)).into();
    }

    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        self.vibrator.solve(&mut self.shifts[shift], right);
    }
}

/// Free vibrations with recoil, `M = A − SSᵀ/m* − hJ⁻¹hᵀ`. (V2)
fn vibrator(body: &FlexibleBody) -> Vibrator {
    let invariants = body.invariants();
    let n = body.coordinates().len();
    let A = SparseRows::sum(n, invariants.pairs.iter().map(|(j, k, pair)| (j, k, pair.A)).collect());
    let rows = invariants.S.iter().zip(&invariants.h).map(|(S, h)| [S[0], S[1], S[2], h[0], h[1], h[2]]);
    let mut weights = [[0.0; 6]; 6];
    let inverse = sym::rows(sym::inverse(invariants.J));
    for i in 0..3 {
        weights[i][i] = body.translation().unwrap_or(0.0);
        weights[3 + i][3..].copy_from_slice(&inverse[i]);
    }
    Vibrator::new(A, rows.collect(), weights, body.damping().clone(), body.stiffness().clone())
}

/// Change of an entry of the mass matrix, over the geometric mean of those on its diagonal, that the iteration of an implicit step
/// does not feel.
const CHANGED: f64 = 0.01;

/// Whether two mass matrices are nearly the same.
fn alike(known: &Dense, mass: &Dense) -> bool {
    (0..mass.size()).all(|j| {
        (0..=j).all(|k| {
            let size = (mass.at(j, j) * mass.at(k, k)).sqrt();
            (mass.at(j, k) - known.at(j, k)).abs() <= CHANGED * size
        })
    })
}

/// Entries of a symmetric matrix on and above the diagonal, the others doubled.
fn upper(matrix: &SparseRows<f64>) -> Vec<(usize, usize, f64)> {
    let above = matrix.iter().filter(|(j, k, _)| j <= k);
    above.map(|(j, k, entry)| (j, k, if j == k { *entry } else { 2.0 * entry })).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
