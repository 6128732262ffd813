//! Table of an evolution: states along a way, along a drift under a torque, along levels, or of a run of the full system.
//! Times are integrated row by row while the table is printed, so that an interrupted one is a shorter table and not a lost one.

use std::ops::ControlFlow;

use quasirigid::averaging::{
    Drift, DriftHistory, DriftLimits, DriftState, DriftStopReason, Elapsed, Evolution, LevelPassage,
    LevelRow, RotationState, Separatrix, SlowTorque,
};

use quasirigid::model::{Mode, Principal};
use quasirigid::secular::{DirectRow, DirectRun, EnergyRange};
use quasirigid_math::vec3::norm;

use super::answer::Answer;

/// Place of a state at an axis, as `ξ`.
const AT_AXIS: f64 = 36.0;

/// Direction of an angular momentum that nothing turns, in the axes in which it is the third.
const UNTURNED: [f64; 3] = [0.0, 0.0, 1.0];

/// The rows of a table: states of an evolution or of a drift.
pub struct EvolutionTable {
    pub first: DriftState,
    pub states: Vec<DriftState>,
    /// Evolution that gives the times of the states, where they are not known yet.
    evolution: Option<Evolution>,
    /// History of the drift, where there is a torque.
    pub drift: Option<DriftHistory>,
    pub status: &'static str,
    /// Estimated error of the time of the last state (s).
    pub error: f64,
    /// Powers (W) of a history of the full system, row by row.
    pub powers: Option<Vec<f64>>,
    /// Rows at the start whose times are known.
    known: usize,
    /// Levels of the slow energy, row by row.
    pub levels: Option<Vec<LevelRow>>,
    /// Time (s) up to which the last state stays, where it is steady before the time asked for has passed.
    stays: Option<f64>,
    /// Time (s) of the first passage through the separatrix, for histories whose rows do not hold it.
    crossed: Option<f64>,
}

impl EvolutionTable {
    /// States along the way; the first alone where nothing is dissipated.
    pub fn of_evolution(
        evolution: &Evolution,
        from: RotationState,
        to: RotationState,
        samples: usize,
    ) -> Self {
        let angular_momentum = evolution.motion(from).angular_momentum();
        let state = |rotation_state| DriftState {
            t: 0.0,
            rotation_state,
            angular_momentum,
            side: 1.0,
            direction: UNTURNED,
            revolutions: 0.0,
        };
        let samples = if evolution.power(from) > 0.0 { samples } else { 1 };
        let states: Vec<_> = evolution.rotation_states(from, to, samples).map(state).collect();
        let evolution = Some(evolution.clone());
        Self {
            first: state(from),
            states,
            evolution,
            drift: None,
            status: "finished",
            error: 0.0,
            powers: None,
            known: 1,
            levels: None,
            stays: None,
            crossed: None,
        }
    }

    /// Rows whose last one stays as it is up to a time (s), where it is reached before.
    pub fn staying(self, time: Option<f64>) -> Self {
        Self { stays: time, ..self }
    }

    /// Rows behind the start of the full system, which reaches the first of them at the time of `row`.
    pub fn behind(mut self, start: RotationState, row: &DirectRow) -> Self {
        self.states[0] = DriftState { t: row.t, revolutions: row.revolutions, ..self.states[0] };
        self.first = DriftState { rotation_state: start, t: 0.0, revolutions: 0.0, ..self.first };
        self.states.insert(0, self.first);
        self.known = 2;
        self
    }

    /// Rows at even times up to the end of a drift, which is located exactly; a drift that ends early is followed once more for them.
    pub fn of_drift(
        answer: &Answer,
        torque: SlowTorque,
        start: DriftState,
        limits: DriftLimits,
        samples: usize,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Self {
        let last = samples.saturating_sub(1).max(1);
        let times = |end: f64| -> Vec<f64> {
            (0..samples).map(|i| if i == last { end } else { end * i as f64 / last as f64 }).collect()
        };
        let drift = Drift::new(answer.power(), &answer.principal, torque);
        let mut history = drift.follow(start, &times(limits.end), &limits, &mut progress);
        if history.end.t < limits.end && history.ending != DriftStopReason::Interrupted {
            history = drift.follow(start, &times(history.end.t), &limits, &mut progress);
        }
        let mut states = std::mem::take(&mut history.states);
        if states.last().is_none_or(|state| state.t < history.end.t) {
            states.push(history.end);
        }
        let status = history.ending.word();
        let crossed = history.passages.first().map(|passage| passage.t);
        Self {
            first: start,
            states,
            evolution: None,
            drift: Some(history),
            status,
            error: 0.0,
            powers: None,
            known: 1,
            levels: None,
            stays: None,
            crossed,
        }
    }

    /// Rows of a history of the full system from a rotation state, evenly in time.
    pub fn of_run(run: &DirectRun, range: &EnergyRange, from: RotationState, samples: usize) -> Self {
        let rows = &run.rows;
        let end = rows[rows.len() - 1];
        let last = samples.saturating_sub(1).max(1);
        let chosen = (0..samples).map(|i| {
            let t = end.t * i as f64 / last as f64;
            if i == last { rows.len() - 1 } else { rows.partition_point(|row| row.t < t).min(rows.len() - 1) }
        });
        let mut chosen: Vec<usize> = chosen.collect();
        chosen.dedup();
        let settled = |mode| RotationState { mode, xi: AT_AXIS };
        let state = |row: &DirectRow| {
            let mode = range.polhode(row.energy).mode();
            let rotation_state = range.rotation_state(row.energy).unwrap_or(settled(mode));
            DriftState {
                t: row.t,
                rotation_state,
                angular_momentum: range.angular_momentum(),
                side: 1.0,
                direction: UNTURNED,
                revolutions: row.revolutions,
            }
        };
        let power = |i: usize| run.mean_power(i, range.polhode(rows[i].energy).polhode_period());
        let mut states: Vec<DriftState> = chosen.iter().map(|i| state(&rows[*i])).collect();
        states[0].rotation_state = from;
        let powers = chosen.iter().map(|i| power(*i)).collect();
        let mode = |row: &DirectRow| range.polhode(row.energy).mode();
        let crossed = rows.iter().find(|row| mode(row) != mode(&rows[0])).map(|row| row.t);
        Self {
            first: states[0],
            states,
            evolution: None,
            drift: None,
            status: "finished",
            error: 0.0,
            powers: Some(powers),
            known: 1,
            levels: None,
            stays: None,
            crossed,
        }
    }

    /// Rows of an evolution along levels of the slow energy; the principal axis next to the circled one gives the mode.
    pub fn of_levels(passage: &LevelPassage, principal: &Principal) -> Self {
        let mode = |circled: [f64; 3]| {
            let along = principal.components(circled).map(f64::abs);
            if along[0] > along[2] { Mode::LongAxis } else { Mode::ShortAxis }
        };
        let state = |row: &LevelRow| {
            let mode = mode(row.circled);
            let angular_momentum = norm(row.angular_momentum);
            DriftState {
                t: row.time,
                rotation_state: RotationState { mode, xi: 0.0 },
                angular_momentum,
                side: 1.0,
                direction: UNTURNED,
                revolutions: row.revolutions,
            }
        };
        let states: Vec<DriftState> = passage.rows.iter().map(state).collect();
        let other = |separatrix: &&Separatrix| {
            separatrix.circled.is_some_and(|axis| mode(axis) != states[0].rotation_state.mode)
        };
        let crossed = passage.separatrices.iter().find(other).map(|separatrix| separatrix.time);
        Self {
            first: states[0],
            states,
            evolution: None,
            drift: None,
            status: "finished",
            error: 0.0,
            powers: Some(passage.rows.iter().map(|row| row.power).collect()),
            known: 1,
            levels: Some(passage.rows.clone()),
            stays: None,
            crossed,
        }
    }

    /// Whether the angular momentum is constant.
    pub fn steady(&self) -> bool {
        self.evolution.is_some()
    }

    /// The last state.
    pub fn last(&self) -> DriftState {
        self.states.last().copied().unwrap_or(self.first)
    }

    /// Time (s) of the first passage through the separatrix, in a history that is not steady.
    pub fn crossing(&self) -> Option<f64> {
        self.crossed
    }

    /// A row with its time and revolutions, from the row before it.
    pub fn advance(&mut self, i: usize) -> DriftState {
        if let (Some(evolution), Some(before)) =
            (&self.evolution, i.checked_sub(1).filter(|_| i >= self.known))
        {
            let before = self.states[before];
            let Elapsed { time, revolutions, error } =
                evolution.passage(before.rotation_state, self.states[i].rotation_state);
            self.states[i].t = before.t + time;
            self.states[i].revolutions = before.revolutions + revolutions;
            self.error += error.abs();
        }
        if let (Some(evolution), Some(end)) =
            (&self.evolution, self.stays.filter(|_| i >= self.known && i + 1 == self.states.len()))
        {
            let state = &mut self.states[i];
            let (left, motion) = (end - state.t, evolution.motion(state.rotation_state));
            if left > 0.0 {
                let turning = motion.energy() / (std::f64::consts::PI * motion.angular_momentum());
                (state.t, state.revolutions) = (end, state.revolutions + left * turning);
            }
        }
        self.states[i]
    }
}
