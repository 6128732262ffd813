//! Onset of whirl: the spin from which a motion beside the nutation grows.
//! The decay of the slowest internal motion changes sign there; it is looked for between spins that rise by a constant ratio, and located by
//! bisection. Spins at which every eigenvalue decays beyond doubt are passed over without the motions.
//! Equations (M4), (M9), docs/theory/15-modes.md.

use std::ops::ControlFlow;

use super::campbell::{SpinEigenvalues, campbell};
use super::equilibrium::{RelativeEquilibrium, SpinMagnitude};
use super::mode::{SpinMode, SpinModes};
use crate::model::{FlexibleBody, Mode};

/// Onset of whirl: the least spin of a range at which a motion beside the nutation grows. (M9)
#[derive(Clone, Debug, PartialEq)]
pub struct WhirlOnset {
    /// Angular velocity `|ω|` (rad/s).
    pub spin: f64,
    /// Name of what moves.
    pub name: String,
    /// Frequency (rad/s) of the motion, body axes.
    pub frequency: f64,
}

/// Spins that are examined, and the relative width to which the onset is located.
const EXAMINED: usize = 48;
const LOCATED: f64 = 1e-10;
/// Decay of an internal motion, relative to its frequency, that is rounding.
const DECAY_ROUNDING: f64 = 1e-12;
/// Decay, relative to the largest eigenvalue, that no rounding hides: an eigenvalue that is double is known to the square root of a rounding.
const CLEAR: f64 = 1e-7;
/// Number of spins whose eigenvalues are found side by side, and number of coordinates up to which they cost little beside the motions.
const TOGETHER: usize = 8;
const CHEAP_COORDINATES: usize = 40;

/// Onset of whirl between two spins (rad/s) about the axis that a mode circles; none if no motion beside the nutation grows in between, or
/// the caller ended the search. (M9)
///
/// Spins without a steady state or modes are passed over.
#[must_use]
pub fn whirl_onset(
    body: &FlexibleBody,
    mode: Mode,
    [from, to]: [f64; 2],
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Option<WhirlOnset> {
    let ratio = (to / from).powf((EXAMINED as f64).recip());
    let spins: Vec<f64> = (0..=EXAMINED).map(|i| from * ratio.powi(i as i32)).collect();
    let mut stable = None;
    let mut decaying = Vec::new();
    for (i, spin) in spins.iter().copied().enumerate() {
        if watch(i as f64 / EXAMINED as f64).is_break() {
            return None;
        }
        if i % TOGETHER == 0 {
            decaying = all_decay(body, mode, &spins[i..spins.len().min(i + TOGETHER)]);
        }
        match if decaying[i % TOGETHER] { Some(None) } else { growing(body, mode, spin) } {
            Some(Some(found)) => return Some(located(body, mode, stable, (spin, found))),
            Some(None) => stable = Some(spin),
            None => {}
        }
    }
    None
}

/// Whether at each spin every motion decays beyond doubt, by the eigenvalues alone: not about the axis of least inertia, where the nutation
/// grows, nor where materials and liquids have other eigenvalues than the equations of motion, nor for large bodies.
fn all_decay(body: &FlexibleBody, mode: Mode, spins: &[f64]) -> Vec<bool> {
    let exact = body.viscoelastic().is_empty() && body.memories().is_empty();
    if mode == Mode::LongAxis || !exact || body.coordinates().len() > CHEAP_COORDINATES {
        return vec![false; spins.len()];
    }
    let clear = |values: &[[f64; 2]]| {
        let largest = values.iter().fold(0.0_f64, |largest, [re, im]| largest.max(re.hypot(*im)));
        values.iter().all(|[re, _]| *re < -CLEAR * largest)
    };
    let decays = |column| matches!(column, Ok(SpinEigenvalues { eigenvalues, .. }) if clear(&eigenvalues));
    campbell(body, mode, spins).into_iter().map(decays).collect()
}

/// Bisects between a stable spin and one at which a motion grows.
fn located(
    body: &FlexibleBody,
    mode: Mode,
    stable: Option<f64>,
    (mut high, mut found): (f64, SpinMode),
) -> WhirlOnset {
    let Some(mut low) = stable else { return onset(high, found) };
    while high - low > LOCATED * high {
        let middle = 0.5 * (low + high);
        match growing(body, mode, middle) {
            Some(Some(grown)) => (high, found) = (middle, grown),
            Some(None) => low = middle,
            None => break,
        }
    }
    onset(high, found)
}

fn onset(spin: f64, SpinMode { name, frequency, .. }: SpinMode) -> WhirlOnset {
    WhirlOnset { spin, name, frequency }
}

/// The motion beside the nutation that grows at a spin (rad/s); none without modes there.
#[expect(clippy::option_option, reason = "a spin without modes is neither stable nor unstable")]
fn growing(body: &FlexibleBody, mode: Mode, spin: f64) -> Option<Option<SpinMode>> {
    let equilibrium = RelativeEquilibrium::extreme(body, mode, SpinMagnitude::Rate(spin)).ok()?;
    let modes = SpinModes::about(body, equilibrium).ok()?.modes;
    let grows = |mode: &SpinMode| !mode.nutation && mode.decay_rate < -DECAY_ROUNDING * mode.frequency;
    Some(modes.into_iter().find(grows))
}
