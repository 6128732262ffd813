use std::sync::Arc;

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, RotationState};
use quasirigid::dynamics::FullState;

use super::steady_spins::Ground;
use crate::error::StudyError;
use crate::evolution::secular::SecularEvolution;
use crate::settings::EvolveSettings;

/// Effective moments without a power: enough to place a rotation state.
#[derive(Debug)]
pub struct Levels(pub [f64; 3]);

impl MeanPower for Levels {
    fn moments(&self) -> [f64; 3] {
        self.0
    }

    fn mean_power(&self, _: &FreeRotation) -> f64 {
        0.0
    }
}

/// Way of an evolution: its start and its end.
pub struct Way {
    pub start: FullState,
    /// Whether the start is a state that was asked for, and not the file's.
    pub placed: bool,
    pub ends: [RotationState; 2],
    /// State of the start when its vibrations have died out.
    pub settled: Option<RotationState>,
    pub energies: [f64; 2],
    pub dissipators: Vec<String>,
}

impl Way {
    /// The way that is asked for, by the energies of the deformed body.
    pub fn of(
        ground: &Ground,
        full: FullState,
        asked: &EvolveSettings,
        secular: &SecularEvolution,
    ) -> Result<Self, StudyError> {
        let body = ground.body;
        let range = &ground.range;
        let levels: Arc<dyn MeanPower> = Arc::new(Levels(range.moments()));
        let evolution = Evolution::new(levels, range.angular_momentum());
        let energy = full.energy(body);
        let (start, from) = match asked.start {
            Some(target) => {
                let stage = secular.stage(&evolution, target)?;
                (range.state(body, stage).ok_or(StudyError::Steady)?, stage)
            }
            None => {
                // What moves inside may hold more energy than the steady spins leave to a wobble; it is that of the wobble when it has died out.
                let stage = range.stage(energy).or_else(|| range.settled(body, full.angular_momentum(body)));
                (full, stage.ok_or(StudyError::Steady)?)
            }
        };
        let asked = EvolveSettings { duration: None, ..asked.clone() };
        let to = secular.end(&evolution, from, &asked)?;
        let first = start.energy(body);
        Ok(Self {
            placed: asked.start.is_some(),
            ends: [from, to],
            settled: range.settled(body, start.angular_momentum(body)),
            start,
            energies: [first, evolution.motion(to).energy()],
            dissipators: body.dissipators().iter().map(|each| each.name.clone()).collect(),
        })
    }
}
