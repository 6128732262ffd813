use std::ops::Range;

use super::layout::{ANGLE, ATTITUDE, DISSIPATED, Layout, MOMENTUM, SLOW, attitude, triple};
use crate::math::dynamic_stiffness::{DynamicStiffness, Vibrator};
use crate::math::ode::{Stiff, System};
use crate::math::rotation;
use crate::math::simd::Arithmetic;
use crate::math::sparse::SparseRows;
use crate::math::sym::{self, cross, dot, norm};
use crate::model::{FlexibleBody, Kinetics};

/// The full equations in momenta, `K̇ = K × ω + M`, `ṗ = ∂L/∂q − Bq̇ + Q`: no acceleration is solved for. (S3), (S4)
#[derive(Clone, Debug)]
pub(super) struct FullSystem<'a> {
    pub layout: Layout,
    pub kinetics: Kinetics<'a>,
    vibrator: Vibrator,
    shifts: Vec<DynamicStiffness>,
}

/// Steps of power iteration: the frequency is needed to a few per cent.
const POWER_ITERATIONS: usize = 40;

impl<'a> FullSystem<'a> {
    pub fn new(body: &'a FlexibleBody) -> Self {
        let layout = Layout { n: body.coordinates().len() };
        Self { layout, kinetics: Kinetics::new(body), vibrator: vibrator(body), shifts: Vec::new() }
    }

    /// Spin, rates, and energy of a state.
    pub fn motion(&mut self, y: &[f64]) -> ([f64; 3], Vec<f64>, f64) {
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let mut rate = vec![0.0; self.layout.n];
        let K = triple(y, MOMENTUM);
        let omega = self.kinetics.velocities(K, p, q, &mut rate).omega;
        let kinetic = dot(omega, K) + product(p, &rate);
        let elastic = product(&self.kinetics.body().stiffness().times(q), q);
        (omega, rate, 0.5 * (kinetic + elastic))
    }

    /// An upper estimate of the fastest rate of the elastic part, `|λ|` of `λ²M + λB + C` (1/s). (X1)
    pub fn fastest(&mut self) -> f64 {
        let body = self.kinetics.body();
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
    fn rate<A: Arithmetic>(&mut self, _: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let K = triple(y, MOMENTUM);
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let (slow, fast) = rate.split_at_mut(SLOW);
        let (q_rate, p_rate) = fast.split_at_mut(self.layout.n);
        let velocities = self.kinetics.velocities(K, p, q, q_rate);
        p_rate.fill(0.0);
        slow[DISSIPATED] = self.kinetics.add_loads(velocities, q_rate, p_rate);
        slow[ANGLE] = norm(velocities.omega);
        slow[MOMENTUM..MOMENTUM + 3].copy_from_slice(&cross(K, velocities.omega));
        slow[ATTITUDE..ATTITUDE + 4].copy_from_slice(&rotation::rate(attitude(y), velocities.omega));
    }
}

/// `L` is the free vibration of the body that recoils: `q̇ = M⁻¹p`, `ṗ = −Bq̇ − Cq`, with the mass of (V2).
impl Stiff<Vec<f64>> for FullSystem<'_> {
    fn stiff(&self) -> Range<usize> {
        SLOW..self.layout.len()
    }

    fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        self.shifts = shifts.map(|s| self.vibrator.at(s)).into();
    }

    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        self.vibrator.solve(&self.shifts[shift], right);
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

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
