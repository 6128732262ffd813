//! Names of the motions of the whole body: pitch and roll-yaw, nutation and precession.

use nalgebra::{Complex, Vector3};

use super::frame_rotation::FrameRotation;
use super::state::SteadyState;
use crate::math::vec3::norm;
use crate::modes::mode::SpinMode;

/// Mode with the data that its name follows from.
pub(super) struct NamedMotion {
    pub mode: SpinMode,
    /// Rotation `θ` of the body, where a force depends on the attitude.
    pub turn: Option<[Complex<f64>; 3]>,
    /// True if the carrier moves most.
    pub carried: bool,
    /// Twice the kinetic energy in inertial axes over that in axes that turn with the body: zero of a lasting tilt, in which nothing moves.
    pub moving: f64,
}

/// Share of the rotation about an axis from which a motion counts as about the axis, and below one minus which as across it.
const CLEAR: f64 = 0.9;
/// Ratio of rates in inertial axes from which they count as a fast and a slow motion of the axis.
const APART: f64 = 2.0;
/// Share `moving` of a lasting tilt, which is no mode, and of a slow precession of the axis of the spin.
const TILT: f64 = 1e-12;
const SLOW: f64 = 1e-4;
/// Share of the carrier in the kinetic energy from which an oscillation may be the nutation.
const LEAST_SHARE: f64 = 0.05;
const PRECESSION: &str = "precession";

/// Modes, with names of their own where there is no doubt: `pitch` and `roll-yaw` on an orbit, `nutation` and `precession` of a top. Where the forces
/// know the attitude about the spin alone, or next to nothing else, the direction of the spin in space is no mode, or the precession, and the other motion
/// across it is the nutation.
pub(super) fn named(
    mut motions: Vec<NamedMotion>,
    state: &SteadyState,
    axis: Option<[f64; 3]>,
) -> Vec<SpinMode> {
    if let (Some(axis), FrameRotation::Set { orbit: true, .. }) = (axis, &state.turning) {
        for motion in motions.iter_mut().filter(|motion| motion.carried) {
            let Some(share) = motion.turn.map(|turn| about(turn, axis)) else { continue };
            if share >= CLEAR {
                motion.mode.name = "pitch".into();
            } else if share <= 1.0 - CLEAR {
                motion.mode.name = "roll-yaw".into();
            }
        }
    }
    if let (Some(axis), FrameRotation::About(_)) = (axis, &state.turning) {
        top(&mut motions, axis, norm(state.omega));
    }
    if norm(state.omega) > 0.0 {
        let all = motions.len();
        motions.retain(|motion| motion.moving > TILT);
        let precesses = |motion: &&mut NamedMotion| motion.moving <= SLOW && motion.mode.name == "rotation";
        let fewer = motions.len() < all;
        let slow: Vec<_> = motions.iter_mut().filter(precesses).collect();
        if state.turning == FrameRotation::Own || !slow.is_empty() || fewer {
            slow.into_iter().for_each(|motion| motion.mode.name = PRECESSION.into());
            nutation(&mut motions, state);
        }
    }
    motions.into_iter().map(|motion| motion.mode).collect()
}

/// Names the motion of the whole body across the axis of its spin, where no force depends on the direction of that: of those that oscillate the one in
/// which the carrier has the largest share, however slow the others are and whatever else it meets; else all of those that do not, the
/// slowest first.
fn nutation(motions: &mut [NamedMotion], state: &SteadyState) {
    let axis = state.omega.map(|component| component / norm(state.omega));
    let across = |motion: &&mut NamedMotion| {
        let delta = motion.mode.omega.map(|[re, im]| Complex::new(re, im));
        about(delta, axis) <= 1.0 - CLEAR && motion.mode.name != PRECESSION
    };
    let mut found: Vec<&mut NamedMotion> = motions.iter_mut().filter(across).collect();
    let swings =
        |motion: &NamedMotion| motion.mode.frequency > 0.0 && carried_share(&motion.mode) >= LEAST_SHARE;
    let most = (0..found.len())
        .filter(|number| swings(found[*number]) && found.iter().any(|motion| motion.carried))
        .max_by(|a, b| carried_share(&found[*a].mode).total_cmp(&carried_share(&found[*b].mode)));
    if let Some(number) = most {
        found[number].mode.nutation = true;
        found[number].mode.name = "nutation".into();
        return;
    }
    found.retain(|motion| motion.carried);
    found.sort_by(|a, b| a.mode.decay_rate.abs().total_cmp(&b.mode.decay_rate.abs()));
    for (place, motion) in found.into_iter().enumerate() {
        motion.mode.nutation = place == 0;
        motion.mode.name = "nutation".into();
    }
}

/// Share of the carrier in the kinetic energy of a mode.
fn carried_share(mode: &SpinMode) -> f64 {
    mode.moves.iter().find(|(name, _)| name == "body").map_or(0.0, |(_, share)| *share)
}

/// Share of a rotation that is about an axis.
fn about(turn: [Complex<f64>; 3], axis: [f64; 3]) -> f64 {
    let along: Complex<f64> = turn.iter().zip(axis).map(|(turn, axis)| turn * axis).sum();
    along.norm_sqr() / turn.iter().map(Complex::norm_sqr).sum::<f64>()
}

/// Names the two motions of the axis of a top, of which one is fast in inertial axes.
fn top(motions: &mut [NamedMotion], axis: [f64; 3], spin: f64) {
    let across = |motion: &&mut NamedMotion| {
        motion.carried
            && motion.mode.frequency > 0.0
            && motion.turn.is_some_and(|turn| about(turn, axis) <= 1.0 - CLEAR)
    };
    let mut pair: Vec<&mut NamedMotion> = motions.iter_mut().filter(across).collect();
    if let [first, second] = pair.as_mut_slice() {
        let [a, b] = [&*first, &*second].map(|motion| seen(motion, axis, spin));
        if let (Some(a), Some(b)) = (a, b) {
            let (fast, slow) = if a > b { (first, second) } else { (second, first) };
            if a.max(b) >= APART * a.min(b) {
                fast.mode.name = "nutation".into();
                slow.mode.name = PRECESSION.into();
            }
        }
    }
}

/// Rate at which the axis circles in inertial axes, if in one sense.
fn seen(motion: &NamedMotion, axis: [f64; 3], spin: f64) -> Option<f64> {
    let axis = Vector3::from(axis);
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let second = axis.cross(&first);
    let turn = Vector3::from(motion.turn?);
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
    Some((spin + sense * motion.mode.frequency).abs())
}
