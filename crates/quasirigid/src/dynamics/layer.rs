use nalgebra::{Complex, DMatrix, DVector};

use super::full::FullState;
use super::slow::{SlowState, slow_state_point};
use super::{Forced, PropagateError};
use crate::math::eigen::{Dense, NoConvergence, eigenvectors, modes};
use crate::math::rotation;
use crate::math::sym::{add, cross, inverse, scale, times};
use crate::model::FlexibleBody;

/// The fast part of a motion that does not start on the slow manifold: free vibrations of the body that recoils, which
/// die out and leave the body turned a little. (B1)
#[derive(Clone, Debug)]
pub struct BoundaryLayer {
    /// The damped modes, slowest decay first.
    pub modes: Vec<DampedMode>,
    /// `J⁻¹h_j`.
    recoil: Vec<[f64; 3]>,
}

/// A damped mode: `q(t) = Re(shape · e^{λt})`.
#[derive(Clone, Debug, PartialEq)]
pub struct DampedMode {
    /// Decay rate `−Re λ` (1/s).
    pub decay: f64,
    /// Frequency `Im λ` (rad/s); zero if the mode creeps back without swinging.
    pub frequency: f64,
    /// Real and imaginary part of the displacement of each coordinate at `t = 0`.
    pub shape: Vec<[f64; 2]>,
}

/// Displacements and rates of the fast part at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct FastPart {
    /// Displacements of the coordinates.
    pub q: Vec<f64>,
    /// Their rates.
    pub rate: Vec<f64>,
    /// Spin that the recoil adds (rad/s), body axes.
    pub omega: [f64; 3],
    /// Rotation still to come until the vibrations have died out (rad), body axes.
    pub turn: [f64; 3],
}

/// Where the slow motion starts that a full motion settles on: the momentum and the attitude turned by what the fast
/// part will turn the body, `K(0⁺) = K(0) + K(0) × J⁻¹Σ h_j q_fast,j(0)`. (B2)
///
/// # Errors
/// [`PropagateError::Order`] if the order is beyond the reduction of forced bodies.
pub fn matched_start(system: Forced, order: usize, full: &FullState) -> Result<SlowState, PropagateError> {
    let body = system.body;
    let K = full.momentum(body);
    let state =
        SlowState { momentum: K, attitude: full.attitude, place: full.place, velocity: full.velocity };
    let slow = slow_state_point(system, order, &state)?;
    let fast: Vec<f64> = full.q.iter().zip(&slow.q).map(|(q, slow)| q - slow).collect();
    let turn = turned_by(&recoils(body), &fast);
    let rotation_N = rotation::to_inertial(full.attitude, turn);
    let attitude = rotation::turned(full.attitude, rotation_N);
    let momentum = rotation::Turn::of(attitude).to_body(rotation::to_inertial(full.attitude, K));
    Ok(SlowState { momentum, attitude, ..state })
}

impl BoundaryLayer {
    /// The fast part of a full state beside the slow motion of this order.
    ///
    /// # Errors
    /// [`PropagateError`] if the order is beyond the reduction of forced bodies, or the modes cannot be found.
    pub fn of(system: Forced, order: usize, full: &FullState) -> Result<Self, PropagateError> {
        let matched = matched_start(system, order, full)?;
        let slow = slow_state_point(system, order, &matched)?;
        let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>();
        let (q, rate) = (difference(&full.q, &slow.q), difference(&full.rate, &slow.rate));
        let modes = damped_modes(system.body, &q, &rate).map_err(|_| PropagateError::NoModes)?;
        Ok(Self { modes, recoil: recoils(system.body) })
    }

    /// The fast part at a time (s).
    #[must_use]
    pub fn at(&self, t: f64) -> FastPart {
        let n = self.recoil.len();
        let (mut q, mut rate) = (vec![0.0; n], vec![0.0; n]);
        for mode in &self.modes {
            let lambda = Complex::new(-mode.decay, mode.frequency);
            let swing = (lambda * t).exp();
            for ((q, rate), [re, im]) in q.iter_mut().zip(&mut rate).zip(&mode.shape) {
                let now = Complex::new(*re, *im) * swing;
                *q += now.re;
                *rate += (lambda * now).re;
            }
        }
        let omega = scale(-1.0, turned_by(&self.recoil, &rate));
        let turn = turned_by(&self.recoil, &q);
        FastPart { q, rate, omega, turn }
    }
}

fn recoils(body: &FlexibleBody) -> Vec<[f64; 3]> {
    let inverse = inverse(body.invariants().J);
    body.invariants().h.iter().map(|h| times(inverse, *h)).collect()
}

fn turned_by(recoil: &[[f64; 3]], q: &[f64]) -> [f64; 3] {
    recoil.iter().zip(q).fold([0.0; 3], |sum, (recoil, q)| add(sum, scale(*q, *recoil)))
}

/// Damped free vibrations from a displacement and its rate, in the undamped modes `(Ωη, η̇)`. (V3), with the recoil of (V2)
fn damped_modes(body: &FlexibleBody, q: &[f64], rate: &[f64]) -> Result<Vec<DampedMode>, NoConvergence> {
    let n = q.len();
    let mass = body.recoiling_mass_matrix();
    let undamped = modes(&mass, &Dense::of(body.stiffness()))?;
    let shape = |row: usize, mode: usize| undamped.shapes.at(row, mode);
    let mut system = Dense::zero(2 * n);
    for (k, frequency) in undamped.frequencies.iter().enumerate() {
        system.add(k, n + k, *frequency);
        system.add(n + k, k, -frequency);
        let column: Vec<f64> = (0..n).map(|row| shape(row, k)).collect();
        let force = body.damping().times(&column);
        for row in 0..n {
            system.add(n + row, n + k, -(0..n).map(|j| shape(j, row) * force[j]).sum::<f64>());
        }
    }
    // Modal coordinates by orthogonality, Xᵀ M X = 1.
    let (inertia, moving) = (mass.times(q), mass.times(rate));
    let modal = |force: &[f64], k: usize| (0..n).map(|j| shape(j, k) * force[j]).sum::<f64>();
    let start = (0..2 * n).map(|i| {
        let value = if i < n { undamped.frequencies[i] * modal(&inertia, i) } else { modal(&moving, i - n) };
        Complex::from(value)
    });
    let (values, vectors) = eigenvectors(&system)?;
    let matrix = DMatrix::from_fn(2 * n, 2 * n, |row, column| {
        let [re, im] = vectors[column][row];
        Complex::new(re, im)
    });
    let start = DVector::from_iterator(2 * n, start);
    let amplitudes = matrix.lu().solve(&start).ok_or(NoConvergence { size: 2 * n })?;
    let mut found: Vec<DampedMode> = Vec::with_capacity(n);
    for ((value, vector), amplitude) in values.iter().zip(&vectors).zip(amplitudes.iter()) {
        let [decay, frequency] = [-value[0], value[1]];
        if frequency < 0.0 {
            continue;
        }
        let twice = if frequency > 0.0 { 2.0 } else { 1.0 };
        let displacement = |row: usize| {
            let part = |k: usize| {
                let eta = Complex::new(vector[k][0], vector[k][1]) * amplitude / undamped.frequencies[k];
                eta * shape(row, k) * twice
            };
            let sum: Complex<f64> = (0..n).map(part).sum();
            [sum.re, sum.im]
        };
        found.push(DampedMode { decay, frequency, shape: (0..n).map(displacement).collect() });
    }
    found.sort_by(|a, b| a.decay.total_cmp(&b.decay));
    Ok(found)
}

/// Spin of the composite solution: the slow spin, the recoil of the fast part, and the body axes that have not yet turned.
/// (B3)
#[must_use]
pub fn composite_spin(slow: [f64; 3], fast: &FastPart) -> [f64; 3] {
    add(add(slow, fast.omega), scale(-1.0, cross(slow, fast.turn)))
}
