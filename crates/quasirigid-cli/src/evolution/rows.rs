use quasirigid::averaging::{Drift, DriftEnding, DriftState, Evolution, Passage, SlowTorque, Stage};

use super::ageing::Ageing;

/// The rows of a table: stages of an evolution, or states of a drift.
pub struct Rows<'e> {
    pub first: DriftState,
    pub states: Vec<DriftState>,
    /// What the times of the states are still to be found from.
    evolution: Option<Evolution<'e>>,
    pub status: &'static str,
}

impl<'e> Rows<'e> {
    /// Stages along the way; the first alone where nothing is dissipated.
    pub fn of_evolution(evolution: &Evolution<'e>, from: Stage, to: Stage, samples: usize) -> Self {
        let momentum = evolution.motion(from).momentum();
        let state = |stage| DriftState { t: 0.0, stage, momentum, side: 1.0, turns: 0.0 };
        let samples = if evolution.power(from) > 0.0 { samples } else { 1 };
        let states: Vec<_> = evolution.stages(from, to, samples).map(state).collect();
        Self { first: state(from), states, evolution: Some(*evolution), status: "finished" }
    }

    /// Even times; the rows end where the target is reached.
    pub fn of_drift(
        ageing: &Ageing,
        torque: SlowTorque,
        start: DriftState,
        duration: f64,
        ending: Option<Stage>,
        samples: usize,
    ) -> Self {
        let last = samples.saturating_sub(1).max(1);
        let times: Vec<f64> = (0..samples).map(|i| duration * i as f64 / last as f64).collect();
        let (mut states, outcome) =
            Drift::new(ageing.power(), &ageing.principal, torque).follow(start, &times);
        if let Some(target) = ending {
            let evolution = ageing.evolution();
            let wanted = evolution.ratio(target);
            let reached = states.iter().position(|state| evolution.ratio(state.stage) >= wanted);
            states.truncate(reached.map_or(states.len(), |reached| reached + 1));
        }
        let status = match outcome {
            DriftEnding::Finished => "finished",
            DriftEnding::Held => "held",
            DriftEnding::Failed(_) => "failed",
        };
        Self { first: start, states, evolution: None, status }
    }

    /// Whether the angular momentum stays.
    pub fn steady(&self) -> bool {
        self.evolution.is_some()
    }

    /// The last state.
    pub fn last(&self) -> DriftState {
        self.states.last().copied().unwrap_or(self.first)
    }

    /// Time (s) of the first row in another mode than the first one.
    pub fn crossing(&self) -> Option<f64> {
        let crossed = self.states.iter().find(|state| state.stage.mode != self.first.stage.mode);
        crossed.map(|state| state.t)
    }

    /// A row with its time and turns, from the row before it.
    pub fn advance(&mut self, i: usize) -> DriftState {
        if let (Some(evolution), Some(before)) = (&self.evolution, i.checked_sub(1)) {
            let before = self.states[before];
            let Passage { time, turns } = evolution.passage(before.stage, self.states[i].stage);
            self.states[i].t = before.t + time;
            self.states[i].turns = before.turns + turns;
        }
        self.states[i]
    }
}
