//! Secular evolution of a torque-free rotation: energy falls at the mean power while `|K|` stays.
//! Time is a quadrature over `ξ`, which puts axis and separatrix at infinity, where the integrand is tame: any number of revolutions costs
//! the same.
//! Equations (A5) to (A7), docs/theory/10-torque-free.md.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::poinsot::FreeRotation;
use super::power::MeanPower;
use crate::math::quadrature::{Integral, integral};
use crate::model::Mode;

/// Secular evolution of the rotation of a free body: the energy falls at the mean power dissipated while `|K|` stays. (A6)
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let body = ring_of_points(4).body()?;
/// let evolution = Evolution::compute(&body, &reduce(&body, 3)?, 10.0)?;
/// if let [Some(from), Some(to)] = [0.5, 0.05].map(|angle| evolution.wobbling(angle)) {
///     assert!(evolution.time(from, to) > 0.0); // s in which the wobble falls to a tenth
/// }
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// An evolution owns its [`MeanPower`]: by value, shared in an [`Arc`], or borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Evolution<P = Arc<dyn MeanPower>> {
    power: P,
    moments: [f64; 3],
    G: f64,
}

/// A state of rotation at a given `|K|`: a mode, and the place `ξ` between the separatrix, `−∞`, and the axis, `+∞`.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationState {
    /// Axis that the angular momentum circles.
    pub mode: Mode,
    /// `ln` of the distance of `D` from the separatrix over that from the axis.
    pub xi: f64,
}

impl RotationState {
    /// Steady spin about the axis of a mode, `ξ = ∞`: evolves only under a torque.
    #[must_use]
    pub fn steady(mode: Mode) -> Self {
        Self { mode, xi: f64::INFINITY }
    }

    /// Rotation state of a motion; none at an axis, where nothing evolves.
    #[must_use]
    pub fn from_motion(motion: &FreeRotation) -> Option<Self> {
        let xi = motion.logit();
        (xi < f64::INFINITY).then(|| Self { mode: motion.mode(), xi: xi.max(SEPARATRIX) })
    }
}

/// Elapsed time and revolutions between two rotation states; negative from the later one to the earlier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elapsed {
    /// Time (s); infinite where nothing is dissipated.
    pub time: f64,
    /// Revolutions about the angular momentum, `∫ (2E/G) dt / 2π`.
    pub revolutions: f64,
    /// Estimated error of the time (s): negligible unless rounding or many resonances side by side hide the power.
    pub error: f64,
}

/// Distance from the separatrix, as `ξ`, below which the integrand is negligible: `e^{−40}`.
const SEPARATRIX: f64 = -40.0;
/// Place, as `ξ`, where a wobble is so small that only its first harmonic stands out of rounding.
const AXIS: f64 = 36.0;
/// Place, as `ξ`, where the angle of a wobble is below the rounding of a direction: `e^{−32}`.
const SETTLED_AT: f64 = 64.0;
/// Places `ξ` that count as next to the separatrix, `ln(0.01/0.99)`, and as the last that [`Evolution::rotation_states`] lists before it.
const NEAR_SEPARATRIX: f64 = -4.595_119_850_134_59;
const SEEN: f64 = -6.0;
/// Places `ξ` next to a plane of steady spins, and the relative difference of rates there up to which they are one.
const IN_PLANE: [f64; 2] = [-12.0, -16.0];
const SAME_RATE: f64 = 1e-3;
/// Relative error of a time.
const TIME_TOLERANCE: f64 = 1e-10;
/// Length in `ξ` of the pieces in which a time is looked for, and the limit of their number.
const PIECE: f64 = 2.0;
const PIECES: usize = 400;
/// Change of a place, relative to a piece, after which Newton's next step is rounding.
const NEWTON_ROUNDING: f64 = 1e-9;
/// Limit of Newton's steps towards a time within a piece.
const NEWTON_STEPS: usize = 60;

impl<P: MeanPower> Evolution<P> {
    /// The evolution of a free body with the angular momentum `G` (N·m·s).
    #[must_use]
    pub fn new(power: P, G: f64) -> Self {
        Self { moments: power.moments(), power, G }
    }

    /// Free rotation at a rotation state.
    #[must_use]
    pub fn motion(&self, RotationState { mode, xi }: RotationState) -> FreeRotation {
        FreeRotation::at_logit(self.moments, self.G, mode, xi)
    }

    /// Mean power dissipated (W). (A5)
    #[must_use]
    pub fn power(&self, rotation_state: RotationState) -> f64 {
        self.power.mean_power(&self.motion(rotation_state))
    }

    /// Mean power (W) that each dissipator takes, by name. (D2)
    #[must_use]
    pub fn budget(&self, rotation_state: RotationState) -> Vec<(String, f64)> {
        self.power.budget(&self.motion(rotation_state))
    }

    /// Rotation state with this `D/I₃`; none outside of `I₁/I₃` to 1, or at an axis, where nothing evolves.
    #[must_use]
    pub fn rotation_state(&self, ratio: f64) -> Option<RotationState> {
        let [I1, I2, I3] = self.moments;
        let D = ratio * I3;
        let (mode, from_separatrix, from_axis) =
            if D >= I2 { (Mode::ShortAxis, D - I2, I3 - D) } else { (Mode::LongAxis, I2 - D, D - I1) };
        (from_axis > 0.0)
            .then(|| RotationState { mode, xi: (from_separatrix / from_axis).ln().max(SEPARATRIX) })
    }

    /// Rotation state with this greatest angle (rad) between the angular momentum and the axis of greatest inertia; none where the two
    /// greatest moments are equal, since such a body has no such axis.
    #[must_use]
    pub fn wobbling(&self, angle: f64) -> Option<RotationState> {
        let mode = Mode::ShortAxis;
        mode.exists(self.moments)
            .then(|| RotationState { mode, xi: FreeRotation::logit_of(self.moments, mode, angle) })
    }

    /// Rotation state with a share `left` of the energy that `from` has above the steady spin about the axis of greatest inertia.
    #[must_use]
    pub fn faded(&self, from: RotationState, left: f64) -> Option<RotationState> {
        let over = 1.0 / self.motion(from).ratio() - 1.0;
        self.rotation_state(1.0 / (1.0 + left * over))
    }

    /// Rotation state that every dissipation ends in, as far as numbers tell it from a steady spin: next to the axis of greatest inertia, or
    /// to the plane of the two greatest moments where these are equal.
    #[must_use]
    pub fn settled(&self) -> RotationState {
        match Mode::ShortAxis.exists(self.moments) {
            true => RotationState { mode: Mode::ShortAxis, xi: SETTLED_AT },
            false => RotationState { mode: Mode::LongAxis, xi: SEPARATRIX },
        }
    }

    /// `D/I₃` of a rotation state.
    #[must_use]
    pub fn ratio(&self, RotationState { mode, xi }: RotationState) -> f64 {
        let [I1, I2, I3] = self.moments;
        let to_axis = 1.0 / (1.0 + xi.exp());
        match mode {
            Mode::ShortAxis => 1.0 - (I3 - I2) * to_axis / I3,
            Mode::LongAxis => (I1 + (I2 - I1) * to_axis) / I3,
        }
    }

    /// Elapsed time and revolutions between two rotation states. (A6)
    #[must_use]
    pub fn passage(&self, from: RotationState, to: RotationState) -> Elapsed {
        self.between(along(from), along(to))
    }

    /// Time (s) from one rotation state to another, negative if the second is the earlier; infinite where nothing is dissipated. (A6)
    #[must_use]
    pub fn time(&self, from: RotationState, to: RotationState) -> f64 {
        self.passage(from, to).time
    }

    /// Rotation states from one to another, both among them, evenly in `ξ`. The way between the last state before a separatrix and the
    /// first behind it, `ξ < −6`, is skipped: nothing visible changes there.
    pub fn rotation_states(
        &self,
        from: RotationState,
        to: RotationState,
        count: usize,
    ) -> impl Iterator<Item = RotationState> {
        let passes = along(from) < 0.0 && along(to) > 0.0;
        let margin = if passes { SEEN - SEPARATRIX } else { 0.0 };
        let shifted = |rotation_state: RotationState| {
            (along(rotation_state).abs() - margin).max(0.0).copysign(along(rotation_state))
        };
        let (start, way) = (shifted(from), shifted(to) - shifted(from));
        let last = count.saturating_sub(1).max(1);
        (0..count).map(move |i| match i {
            0 => from,
            _ if i == last => to,
            _ => {
                let x = start + way * i as f64 / last as f64;
                at(x + margin.copysign(x))
            }
        })
    }

    /// Time (s) from a rotation state to the separatrix; none if the evolution does not pass the separatrix.
    #[must_use]
    pub fn separatrix_time(&self, from: RotationState, to: RotationState) -> Option<f64> {
        (along(from) < 0.0 && along(to) > 0.0).then(|| self.between(along(from), 0.0).time)
    }

    /// Time (s) spent next to the separatrix, nearer to it than one part in a hundred of the way to either axis, as `D` measures it; none
    /// if the evolution passes no such place.
    #[must_use]
    pub fn lingering(&self, from: RotationState, to: RotationState) -> Option<f64> {
        let near = |mode| along(RotationState { mode, xi: NEAR_SEPARATRIX });
        let (low, high) = (near(Mode::LongAxis).max(along(from)), near(Mode::ShortAxis).min(along(to)));
        (low < high).then(|| self.between(low, high).time)
    }

    /// Rotation state reached after a time (s), not negative; none if nothing is dissipated there.
    #[must_use]
    pub fn after(&self, from: RotationState, time: f64) -> Option<RotationState> {
        let mut start = along(from);
        let mut left = time;
        for _ in 0..PIECES {
            let piece = self.between(start, start + PIECE).time;
            if !piece.is_finite() {
                return None;
            }
            if piece >= left {
                return Some(at(self.within(start, left, left / piece)));
            }
            left -= piece;
            start += PIECE;
        }
        Some(at(start))
    }

    /// Rotation state at the end, or after a time (s) if that is sooner; the first where nothing is dissipated. (A6)
    #[must_use]
    pub fn sooner(&self, from: RotationState, to: RotationState, time: Option<f64>) -> RotationState {
        match time {
            Some(time) if self.time(from, to) > time => self.after(from, time).unwrap_or(from),
            _ => to,
        }
    }

    /// Place a `time` after `start`, less than a piece away and about this share of one: Newton's method between bounds.
    fn within(&self, start: f64, time: f64, share: f64) -> f64 {
        let (mut low, mut high) = (start, start + PIECE);
        let mut x = start + share * PIECE;
        for _ in 0..NEWTON_STEPS {
            let over = self.between(start, x).time - time;
            if over > 0.0 {
                high = x
            } else {
                low = x
            }
            let [slowness, _] = self.slowness(x);
            let next = x - over / slowness;
            if (next - x).abs() <= NEWTON_ROUNDING * PIECE {
                return next;
            }
            x = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        x
    }

    /// Rate (1/s) at which a small wobble about the axis of a mode changes: its angle falls as `e^{−rate·t}` about the axis
    /// of greatest inertia, and grows as `e^{rate·t}` about that of least. (A7)
    #[must_use]
    pub fn wobble_rate(&self, mode: Mode) -> f64 {
        let rotation_state = RotationState { mode, xi: AXIS };
        let motion = self.motion(rotation_state);
        0.5 * self.power.mean_power(&motion) / motion.energy_from_axis()
    }

    /// Rate (1/s) at which the angle between the angular momentum and the plane of the two greatest moments falls where these are equal, as
    /// `e^{−rate·t}`; none where the fall has no rate, as with a material of constant quality factor. (A12)
    #[must_use]
    pub fn plane_rate(&self) -> Option<f64> {
        let [I1, I2, _] = self.moments;
        let rate = |xi: f64| {
            let motion = self.motion(RotationState { mode: Mode::LongAxis, xi });
            let excess = motion.energy() * (I2 - I1) / (I2 * (1.0 + (-xi).exp()));
            0.5 * self.power.mean_power(&motion) / excess
        };
        let [near, nearer] = IN_PLANE.map(rate);
        ((near / nearer - 1.0).abs() < SAME_RATE).then_some(nearer)
    }

    fn between(&self, from: f64, to: f64) -> Elapsed {
        let mut slowness = |x: f64| self.slowness(x);
        let mut passage = Elapsed { time: 0.0, revolutions: 0.0, error: 0.0 };
        let ends = if from < 0.0 && to > 0.0 { vec![from, 0.0, to] } else { vec![from, to] };
        for [a, b] in ends.array_windows() {
            let Integral { value: [time, revolutions], error } =
                integral(&mut slowness, *a, *b, TIME_TOLERANCE);
            passage.time += time;
            passage.revolutions += revolutions;
            passage.error += error[0];
        }
        passage
    }

    /// Time (s) and revolutions per unit of the way.
    fn slowness(&self, x: f64) -> [f64; 2] {
        let motion = self.motion(at(x));
        let slowness = motion.energy_slope() / self.power.mean_power(&motion);
        [slowness, slowness * 2.0 * motion.energy() / (self.G * TAU)]
    }
}

/// Place of a rotation state on the way from the axis of least inertia, `−∞`, through the separatrix, 0, to the axis of greatest.
fn along(RotationState { mode, xi }: RotationState) -> f64 {
    match mode {
        Mode::ShortAxis => xi - SEPARATRIX,
        Mode::LongAxis => SEPARATRIX - xi,
    }
}

fn at(x: f64) -> RotationState {
    if x >= 0.0 {
        RotationState { mode: Mode::ShortAxis, xi: x + SEPARATRIX }
    } else {
        RotationState { mode: Mode::LongAxis, xi: SEPARATRIX - x }
    }
}
