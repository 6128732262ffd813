use std::f64::consts::TAU;
use std::sync::Arc;

use super::poinsot::FreeRotation;
use super::power::MeanPower;
use crate::math::quadrature::{Integral, integral};
use crate::model::Mode;

/// How the rotation of a free body ages: its energy falls at the mean power dissipated while `|K|` stays. (A6)
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
/// An evolution owns its power: whatever is one by value, shared in an [`Arc`], or borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Evolution<P = Arc<dyn MeanPower>> {
    power: P,
    moments: [f64; 3],
    G: f64,
}

/// A state of rotation at a given `|K|`: a mode, and the place `ξ` between the separatrix, `−∞`, and the axis, `+∞`.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Axis that the momentum circles.
    pub mode: Mode,
    /// `ln` of the distance of `D` from the separatrix over that from the axis.
    pub xi: f64,
}

impl Stage {
    /// Steady spin about the axis of a mode, `ξ = ∞`: it ages only under a torque.
    #[must_use]
    pub fn steady(mode: Mode) -> Self {
        Self { mode, xi: f64::INFINITY }
    }

    /// The stage of a motion; none at an axis, where nothing ages.
    #[must_use]
    pub fn from_motion(motion: &FreeRotation) -> Option<Self> {
        let xi = motion.logit();
        (xi < f64::INFINITY).then(|| Self { mode: motion.mode(), xi: xi.max(SEPARATRIX) })
    }
}

/// What lies between two stages; negative from the later one to the earlier.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elapsed {
    /// Time (s); infinite where nothing is dissipated.
    pub time: f64,
    /// Turns about the angular momentum, `∫ (2E/G) dt / 2π`.
    pub turns: f64,
    /// Estimated error of the time (s): tiny unless rounding or a thicket of resonances hides the power.
    pub error: f64,
}

/// Distance from the separatrix, as `ξ`, below which nothing is left to integrate: `e^{−40}`.
const SEPARATRIX: f64 = -40.0;
/// Place, as `ξ`, where a wobble is so small that only its first harmonic is left.
const AXIS: f64 = 36.0;
/// Places that count as next to the separatrix, `ln(0.01/0.99)`, and as the last that are listed before it.
const NEAR: f64 = -4.595_119_850_134_59;
const SEEN: f64 = -6.0;
/// Relative error of a time.
const TOLERANCE: f64 = 1e-10;
/// Length of the pieces in which a time is looked for, and their number at most.
const PIECE: f64 = 2.0;
const PIECES: usize = 400;
/// Change of a place, relative to a piece, after which Newton's next step is rounding.
const SETTLED: f64 = 1e-9;
/// Newton's steps towards a time within a piece.
const STEPS: usize = 60;

impl<P: MeanPower> Evolution<P> {
    /// The evolution of a free body with the angular momentum `G` (N·m·s).
    #[must_use]
    pub fn new(power: P, G: f64) -> Self {
        Self { moments: power.moments(), power, G }
    }

    /// The rotation at a stage.
    #[must_use]
    pub fn motion(&self, Stage { mode, xi }: Stage) -> FreeRotation {
        FreeRotation::at_logit(self.moments, self.G, mode, xi)
    }

    /// Mean power dissipated (W). (A5)
    #[must_use]
    pub fn power(&self, stage: Stage) -> f64 {
        self.power.mean_power(&self.motion(stage))
    }

    /// Mean power (W) that each dissipator takes, by name. (D2)
    #[must_use]
    pub fn budget(&self, stage: Stage) -> Vec<(String, f64)> {
        self.power.budget(&self.motion(stage))
    }

    /// The stage with this `D/I₃`; none outside of `I₁/I₃` to 1, or at an axis, where nothing ages.
    #[must_use]
    pub fn stage(&self, ratio: f64) -> Option<Stage> {
        let [I1, I2, I3] = self.moments;
        let D = ratio * I3;
        let (mode, from_separatrix, from_axis) =
            if D >= I2 { (Mode::ShortAxis, D - I2, I3 - D) } else { (Mode::LongAxis, I2 - D, D - I1) };
        (from_axis > 0.0).then(|| Stage { mode, xi: (from_separatrix / from_axis).ln().max(SEPARATRIX) })
    }

    /// The stage with this greatest angle (rad) between the momentum and the axis of greatest inertia; none of a body that has
    /// no such axis, as its two greatest moments are equal.
    #[must_use]
    pub fn wobbling(&self, angle: f64) -> Option<Stage> {
        let mode = Mode::ShortAxis;
        mode.exists(self.moments)
            .then(|| Stage { mode, xi: FreeRotation::logit_of(self.moments, mode, angle) })
    }

    /// The stage where a share is left of the energy that a stage has above the steady spin about the axis of greatest
    /// inertia.
    #[must_use]
    pub fn faded(&self, from: Stage, left: f64) -> Option<Stage> {
        let over = 1.0 / self.motion(from).ratio() - 1.0;
        self.stage(1.0 / (1.0 + left * over))
    }

    /// `D/I₃` at a stage.
    #[must_use]
    pub fn ratio(&self, Stage { mode, xi }: Stage) -> f64 {
        let [I1, I2, I3] = self.moments;
        let to_axis = 1.0 / (1.0 + xi.exp());
        match mode {
            Mode::ShortAxis => 1.0 - (I3 - I2) * to_axis / I3,
            Mode::LongAxis => (I1 + (I2 - I1) * to_axis) / I3,
        }
    }

    /// What lies between two stages. (A6)
    #[must_use]
    pub fn passage(&self, from: Stage, to: Stage) -> Elapsed {
        self.between(along(from), along(to))
    }

    /// Time (s) from one stage to another, negative if the second is the earlier; infinite where nothing is dissipated. (A6)
    #[must_use]
    pub fn time(&self, from: Stage, to: Stage) -> f64 {
        self.passage(from, to).time
    }

    /// Stages from one to another, both among them, evenly along the way, but for the last steps to and from a separatrix
    /// that is passed, `ξ < −6`, where nothing more is to be seen.
    pub fn stages(&self, from: Stage, to: Stage, count: usize) -> impl Iterator<Item = Stage> {
        let passes = along(from) < 0.0 && along(to) > 0.0;
        let margin = if passes { SEEN - SEPARATRIX } else { 0.0 };
        let shifted = |stage: Stage| (along(stage).abs() - margin).max(0.0).copysign(along(stage));
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

    /// Time (s) from a stage to the separatrix; none if the way does not lead through it.
    #[must_use]
    pub fn separatrix_time(&self, from: Stage, to: Stage) -> Option<f64> {
        (along(from) < 0.0 && along(to) > 0.0).then(|| self.between(along(from), 0.0).time)
    }

    /// Time (s) spent next to the separatrix, nearer to it than one part in a hundred of the way to either axis, as `D`
    /// measures it; none if the way leads past no such place.
    #[must_use]
    pub fn lingering(&self, from: Stage, to: Stage) -> Option<f64> {
        let near = |mode| along(Stage { mode, xi: NEAR });
        let (low, high) = (near(Mode::LongAxis).max(along(from)), near(Mode::ShortAxis).min(along(to)));
        (low < high).then(|| self.between(low, high).time)
    }

    /// The stage reached after a time (s), not negative; none if nothing is dissipated there.
    #[must_use]
    pub fn after(&self, from: Stage, time: f64) -> Option<Stage> {
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

    /// The place a time after another, less than a piece away and about this share of one: Newton's method between bounds.
    fn within(&self, start: f64, time: f64, share: f64) -> f64 {
        let (mut low, mut high) = (start, start + PIECE);
        let mut x = start + share * PIECE;
        for _ in 0..STEPS {
            let over = self.between(start, x).time - time;
            if over > 0.0 {
                high = x
            } else {
                low = x
            }
            let [slowness, _] = self.slowness(x);
            let next = x - over / slowness;
            if (next - x).abs() <= SETTLED * PIECE {
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
        let stage = Stage { mode, xi: AXIS };
        let motion = self.motion(stage);
        0.5 * self.power.mean_power(&motion) / motion.energy_from_axis()
    }

    fn between(&self, from: f64, to: f64) -> Elapsed {
        let mut slowness = |x: f64| self.slowness(x);
        let mut passage = Elapsed { time: 0.0, turns: 0.0, error: 0.0 };
        let ends = if from < 0.0 && to > 0.0 { vec![from, 0.0, to] } else { vec![from, to] };
        for [a, b] in ends.array_windows() {
            let Integral { value: [time, turns], error } = integral(&mut slowness, *a, *b, TOLERANCE);
            passage.time += time;
            passage.turns += turns;
            passage.error += error[0];
        }
        passage
    }

    /// Time (s) and turns per unit of the way.
    fn slowness(&self, x: f64) -> [f64; 2] {
        let motion = self.motion(at(x));
        let slowness = motion.energy_slope() / self.power.mean_power(&motion);
        [slowness, slowness * 2.0 * motion.energy() / (self.G * TAU)]
    }
}

/// A stage on the way from the axis of least inertia, `−∞`, through the separatrix, 0, to the axis of greatest.
fn along(Stage { mode, xi }: Stage) -> f64 {
    match mode {
        Mode::ShortAxis => xi - SEPARATRIX,
        Mode::LongAxis => SEPARATRIX - xi,
    }
}

fn at(x: f64) -> Stage {
    if x >= 0.0 {
        Stage { mode: Mode::ShortAxis, xi: x + SEPARATRIX }
    } else {
        Stage { mode: Mode::LongAxis, xi: SEPARATRIX - x }
    }
}
