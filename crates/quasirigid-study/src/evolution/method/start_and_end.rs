use std::sync::Arc;

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, Stage};
use quasirigid::dynamics::FullState;

use super::steady_spins::Ground;
use crate::error::StudyError;
use crate::evolution::Asked;
use crate::evolution::ageing::Ageing;

/// Effective moments alone: what places a stage, without a power.
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

/// From where to where.
pub struct Way {
    pub start: FullState,
    /// Whether the start is a stage that was asked for, and not the file's.
    pub placed: bool,
    pub ends: [Stage; 2],
    /// The start when its vibrations have died out.
    pub settled: Option<Stage>,
    pub energies: [f64; 2],
    pub dissipators: Vec<String>,
}

impl Way {
    /// The way that is asked for, by the energies of the deformed body.
    pub fn of(ground: &Ground, full: FullState, asked: &Asked, ageing: &Ageing) -> Result<Self, StudyError> {
        let body = ground.body;
        let range = &ground.range;
        let levels: Arc<dyn MeanPower> = Arc::new(Levels(range.moments()));
        let evolution = Evolution::new(levels, range.momentum());
        let energy = full.energy(body);
        let (start, from) = match asked.from {
            Some(target) => {
                let stage = ageing.stage(&evolution, target)?;
                (range.state(body, stage).ok_or(StudyError::Steady)?, stage)
            }
            None => (full, range.stage(energy).ok_or(StudyError::Steady)?),
        };
        let asked = Asked { duration: None, ..asked.clone() };
        let to = ageing.end(&evolution, from, &asked)?;
        let first = start.energy(body);
        Ok(Self {
            placed: asked.from.is_some(),
            ends: [from, to],
            settled: range.settled(body, start.momentum(body)),
            start,
            energies: [first, evolution.motion(to).energy()],
            dissipators: body.dissipators().iter().map(|each| each.name.clone()).collect(),
        })
    }
}
