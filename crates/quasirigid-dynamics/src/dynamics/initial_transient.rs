//! Initial transient of a motion off the slow manifold: fast part, matched start of the slow motion, composite angular velocity.
//! The recoil of the vibrations turns the body a little before they die out; without that rotation of the start the error after the decay
//! is one order larger.
//! Equations (B1) to (B3), docs/theory/09-forced-reduction.md; (C8), docs/theory/13-inside.md.

use nalgebra::Complex;

use super::damped::{DampedMode, damped_modes};
use super::full::FullState;
use super::slow::{SlowPoint, SlowState, slow_state_point};
use super::{Forced, PropagateError};
use crate::math::rotation;
use crate::math::sym3::{inverse, times};
use crate::math::vec3::{add, cross, scale};
use crate::model::FlexibleBody;

/// Initial transient of a motion off the slow manifold: free vibrations of the recoiling body, which die out and leave the body turned a
/// little. (B1)
#[derive(Clone, Debug)]
pub struct BoundaryLayer {
    /// Damped modes, slowest decay first.
    pub modes: Vec<DampedMode>,
    /// `J⁻¹h_j`.
    recoil: Vec<[f64; 3]>,
}

/// Fast part at one time: displacements, rates and recoil.
#[derive(Clone, Debug, PartialEq)]
pub struct FastPart {
    /// Displacements of the coordinates.
    pub q: Vec<f64>,
    /// Rates of the coordinates.
    pub rate: Vec<f64>,
    /// Angular velocity of the recoil (rad/s), body axes.
    pub omega: [f64; 3],
    /// Rotation still to come until the vibrations have died out (rad), body axes.
    pub turn: [f64; 3],
}

/// Start of the slow motion that a full motion settles on: attitude and body components of the angular momentum after the rotation by the
/// fast part, `K(0⁺) = K(0) + K(0) × J⁻¹Σ h_j q_fast,j(0)`. (B2)
///
/// # Errors
/// [`PropagateError::Order`] if the order is beyond the reduction of forced bodies.
pub fn matched_start(system: Forced, order: usize, full: &FullState) -> Result<SlowState, PropagateError> {
    let body = system.body;
    let K = full.angular_momentum(body);
    let state = SlowState {
        angular_momentum: K,
        attitude: full.attitude,
        place: full.place,
        velocity: full.velocity,
    };
    let slow = slow_state_point(system, order, &state)?;
    let turn = turned_by(&recoils(body), &outstanding(body, full, &slow));
    let rotation_N = rotation::to_inertial(full.attitude, turn);
    let attitude = rotation::turned(full.attitude, rotation_N);
    let angular_momentum = rotation::Turn::of(attitude).to_body(rotation::to_inertial(full.attitude, K));
    Ok(SlowState { angular_momentum, attitude, ..state })
}

impl BoundaryLayer {
    /// Fast part of a full state beside the slow motion of this order.
    ///
    /// # Errors
    /// [`PropagateError`] if the order is beyond the reduction of forced bodies, or the modes cannot be found.
    pub fn compute(system: Forced, order: usize, full: &FullState) -> Result<Self, PropagateError> {
        let matched = matched_start(system, order, full)?;
        let slow = slow_state_point(system, order, &matched)?;
        let (q, rate) = (outstanding(system.body, full, &slow), difference(&full.rate, &slow.rate));
        let modes = damped_modes(system.body, &q, &rate).map_err(|_| PropagateError::NoModes)?;
        Ok(Self { modes, recoil: recoils(system.body) })
    }

    /// Fast part at a time (s).
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

/// Remaining travel of the coordinates until the fast part has died out, with opposite sign: for elastic ones the displacement, for
/// cyclic ones `−B⁻¹(M q̇ + B q)`, from the momentum that friction takes. (B2), (C8)
fn outstanding(body: &FlexibleBody, full: &FullState, slow: &SlowPoint) -> Vec<f64> {
    let mut q = difference(&full.q, &slow.q);
    let cyclic = body.cyclic();
    if cyclic.is_empty() {
        return q;
    }
    q[cyclic.clone()].fill(0.0);
    let inertia = body.recoiling_mass_times(&difference(&full.rate, &slow.rate));
    let braked = body.damping().times(&q);
    let mut path: Vec<f64> = cyclic.clone().map(|j| -inertia[j] - braked[j]).collect();
    body.solve_friction(&mut path, 1);
    q[cyclic].copy_from_slice(&path);
    q
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn recoils(body: &FlexibleBody) -> Vec<[f64; 3]> {
    let inverse = inverse(body.invariants().J);
    body.invariants().h.iter().map(|h| times(inverse, *h)).collect()
}

fn turned_by(recoil: &[[f64; 3]], q: &[f64]) -> [f64; 3] {
    recoil.iter().zip(q).fold([0.0; 3], |sum, (recoil, q)| add(sum, scale(*q, *recoil)))
}

/// Angular velocity of the composite solution: that of the slow motion, the recoil of the fast part, and the rotation of the body axes
/// still to come. (B3)
#[must_use]
pub fn composite_spin(slow: [f64; 3], fast: &FastPart) -> [f64; 3] {
    add(add(slow, fast.omega), scale(-1.0, cross(slow, fast.turn)))
}
