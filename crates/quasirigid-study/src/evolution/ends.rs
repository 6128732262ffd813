//! Start and end of an evolution: rotation states for the targets that a user gives.

use quasirigid::averaging::{Evolution, MeanPower, RotationState, Until};
use quasirigid::dynamics::FullState;
use quasirigid::model::Mode;
use quasirigid::secular::choice::{ReferenceSpins, Span};
use quasirigid_io::model::Target;

use crate::error::StudyError;
use crate::settings::EvolveSettings;

/// Share of the nutation's energy that is left at the end of an evolution without a target.
pub const LEFT: f64 = 0.01;

/// Rotation state of a target, for a body whose moments of inertia (kg·m²) are given.
pub fn state(
    evolution: &Evolution<impl MeanPower>,
    target: Target,
    moments: [f64; 3],
) -> Result<RotationState, StudyError> {
    match target {
        Target::Ratio(ratio) => {
            let least = moments[0] / moments[2];
            evolution.rotation_state(ratio).ok_or(StudyError::NoRotationState { ratio, least })
        }
        Target::Wobble(angle) => evolution.wobbling(angle).ok_or(StudyError::NoShortAxis { moments }),
    }
}

/// End of an evolution: the target or the time, whichever comes first; without either a hundredth of the wobble's energy.
pub fn end(
    evolution: &Evolution<impl MeanPower>,
    from: RotationState,
    asked: &EvolveSettings,
    moments: [f64; 3],
) -> Result<RotationState, StudyError> {
    let target = match asked.until {
        Some(target) => state(evolution, target, moments)?,
        None if asked.duration.is_some() => evolution.settled(),
        None => evolution.faded(from, LEFT).ok_or(StudyError::Steady)?,
    };
    let [start, end] = [from, target].map(|state| evolution.ratio(state));
    if end < start {
        return Err(match asked.until {
            Some(Target::Wobble(to)) => {
                let from = evolution.motion(from).nutation()[1];
                StudyError::Calmer { from, to, kind: asked.kind }
            }
            _ => StudyError::Backwards { from: start, to: end },
        });
    }
    Ok(evolution.sooner(from, target, asked.duration))
}

/// Energy above the steady spin, over that of the wobble, from which it is told to be of vibrations.
const VIBRATING: f64 = 1.1;
/// The same where the rotation without vibrations is known from the slow manifold, above the least energy.
const KNOWN: f64 = 1.02;
/// Share of the energy between a rotation and a steady spin below which the wobble is told by the angular momentum.
const SMALL: f64 = 1e-6;

/// Span that is asked for, by the energies of the deformed body; `moments` are those of the frozen one (kg·m²).
pub fn span(
    spins: &ReferenceSpins,
    full: FullState,
    asked: &EvolveSettings,
    moments: [f64; 3],
) -> Result<Span, StudyError> {
    let ReferenceSpins { body, range, .. } = spins;
    let evolution = spins.evolution();
    let (start, from, settled) = match asked.start {
        Some(target) => {
            let from = state(&evolution, target, moments)?;
            let start = range.state(body, from).ok_or(StudyError::Steady)?;
            let settled = range.settled(body, start.angular_momentum(body));
            (start, from, settled)
        }
        None => {
            let K = full.angular_momentum(body);
            if range.is_steady(body, K) {
                return Err(StudyError::Steady);
            }
            let projected = spins.projected(&full);
            let settled = projected.or_else(|| range.settled(body, K));
            let small = settled.filter(|state| {
                let motion = spins.motion(*state);
                let nearest = motion.energy_from_axis().min(motion.energy_from_separatrix());
                nearest < SMALL * motion.energy() // the energy of the whole body has no digits of it
            });
            // What moves inside may hold more energy than the wobble, which is left when it has died out.
            let by_energy = range.rotation_state(full.energy(body));
            let vibrating = settled.zip(by_energy).is_some_and(|(settled, state)| {
                let [still, whole] = [settled, state].map(|state| spins.motion(state).energy_from_axis());
                let known =
                    if projected.is_some() && settled.mode == Mode::ShortAxis { KNOWN } else { VIBRATING };
                settled.mode == state.mode && whole > known * still
            });
            let from = small.or(if vibrating { settled } else { by_energy }).or(settled);
            (full, from.ok_or(StudyError::Steady)?, settled)
        }
    };
    let to = end(&evolution, from, &EvolveSettings { duration: None, ..asked.clone() }, moments)?;
    Ok(Span {
        placed: asked.start.is_some(),
        duration: asked.duration,
        level_end: level_end(asked),
        samples: asked.samples,
        ..Span::new(spins, (start, settled), [from, to])
    })
}

/// End on level curves: the wobble, or the time, or a hundredth of the energy of the wobble without either; none of a ratio `D/I₃`.
pub fn level_end(asked: &EvolveSettings) -> Option<Until> {
    match (asked.until, asked.duration) {
        (Some(Target::Ratio(_)), _) => None,
        (Some(Target::Wobble(angle)), _) => Some(Until::Wobble(angle)),
        (None, Some(duration)) => Some(Until::Duration(duration)),
        (None, None) => Some(Until::EnergyLeft(LEFT)),
    }
}
