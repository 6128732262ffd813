//! What the motions of the whole body are called.

use nalgebra::{Complex, Vector3};

use super::state::SteadyState;
use super::turning::Turning;
use crate::math::vec3::norm;
use crate::modes::mode::SpinMode;

/// A mode with what its name follows from.
pub(super) struct Mover {
    pub mode: SpinMode,
    /// Rotation `θ` of the body, where a force knows its attitude.
    pub turn: Option<[Complex<f64>; 3]>,
    /// Whether the body that carries moves most.
    pub carried: bool,
}

/// A share of the rotation about an axis that makes it a rotation about it, or leaves none.
const CLEAR: f64 = 0.9;
/// Rates seen from outside that differ by this factor belong to a fast and a slow motion of the axis.
const APART: f64 = 2.0;

/// The modes with names of their own where there is no doubt: `pitch` and `roll-yaw` on an orbit, `nutation` and `precession` of a top.
pub(super) fn named(mut movers: Vec<Mover>, state: &SteadyState, axis: Option<[f64; 3]>) -> Vec<SpinMode> {
    if let (Some(axis), Turning::Set { orbit: true, .. }) = (axis, &state.turning) {
        for mover in movers.iter_mut().filter(|mover| mover.carried) {
            let Some(share) = mover.turn.map(|turn| about(turn, axis)) else { continue };
            if share >= CLEAR {
                mover.mode.name = "pitch".into();
            } else if share <= 1.0 - CLEAR {
                mover.mode.name = "roll-yaw".into();
            }
        }
    }
    if let (Some(axis), Turning::About(_)) = (axis, &state.turning) {
        top(&mut movers, axis, norm(state.omega));
    }
    movers.into_iter().map(|mover| mover.mode).collect()
}

/// Share of a rotation that is about an axis.
fn about(turn: [Complex<f64>; 3], axis: [f64; 3]) -> f64 {
    let along: Complex<f64> = turn.iter().zip(axis).map(|(turn, axis)| turn * axis).sum();
    along.norm_sqr() / turn.iter().map(Complex::norm_sqr).sum::<f64>()
}

/// Two motions of the axis of a top of which one is seen to be fast.
fn top(movers: &mut [Mover], axis: [f64; 3], spin: f64) {
    let across = |mover: &&mut Mover| {
        mover.carried
            && mover.mode.frequency > 0.0
            && mover.turn.is_some_and(|turn| about(turn, axis) <= 1.0 - CLEAR)
    };
    let mut pair: Vec<&mut Mover> = movers.iter_mut().filter(across).collect();
    if let [first, second] = pair.as_mut_slice() {
        let [a, b] = [&*first, &*second].map(|mover| seen(mover, axis, spin));
        if let (Some(a), Some(b)) = (a, b) {
            let (fast, slow) = if a > b { (first, second) } else { (second, first) };
            if a.max(b) >= APART * a.min(b) {
                fast.mode.name = "nutation".into();
                slow.mode.name = "precession".into();
            }
        }
    }
}

/// Rate at which the axis is seen to circle from outside, if it does so in one sense.
fn seen(mover: &Mover, axis: [f64; 3], spin: f64) -> Option<f64> {
    let axis = Vector3::from(axis);
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let second = axis.cross(&first);
    let turn = Vector3::from(mover.turn?);
    let part = |unit: Vector3<f64>| unit.x * turn.x + unit.y * turn.y + unit.z * turn.z;
    let (x, y) = (part(first), part(second));
    let i = Complex::new(0.0, 1.0);
    // x + iy of Re(θe^{iνt}): with e^{+iνt} half of (x + iy), with e^{−iνt} half of the conjugate of (x − iy).
    let [ahead, behind] = [(x + i * y).norm_sqr(), (x - i * y).norm_sqr()];
    let sense = if ahead >= CLEAR * (ahead + behind) {
        1.0
    } else if behind >= CLEAR * (ahead + behind) {
        -1.0
    } else {
        return None;
    };
    Some((spin + sense * mover.mode.frequency).abs())
}
