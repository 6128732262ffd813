//! Answer of an evolution with momentum wheels: its rows, of a history or of a small wobble that falls at the rate of the modes.

use std::f64::consts::TAU;

use quasirigid::secular::choice::{Method, Reason};
use quasirigid::secular::{DirectRow, DirectRun, DirectStopReason};
use quasirigid_math::vec3::norm;

use super::attracting_spin::AttractingSpin;
use crate::evolution::verdict::{Verdict, followed_fully};
use crate::settings::EvolveSettings;
use crate::words::significant;

/// Greatest wobble (rad) from which the modes alone are followed behind the full system.
pub const BEHIND: f64 = 0.01;

/// Row of an evolution.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub t: f64,
    pub revolutions: f64,
    pub energy: f64,
    /// Least and greatest angle (rad) from the steady spin circled.
    pub nutation: [f64; 2],
    /// Periods (s) of the wobble in the body and of the long axis about the angular momentum; not a number where they are not known.
    pub periods: [f64; 2],
    pub power: f64,
}

/// Evolution that was followed.
pub struct Answer {
    pub method: Method,
    pub verdict: Verdict,
    /// Energy that each dissipator takes, where the method measures it.
    pub budget: Option<Vec<(String, f64)>>,
    pub rows: Vec<Row>,
    /// Angular momentum (N·m·s, body axes) and energy (J) of the steady spin that attracts.
    pub attractor: [f64; 3],
    pub steady: f64,
    pub rate: Option<f64>,
    /// Time (s) at which a separatrix was passed.
    pub crossed: Option<f64>,
}

impl AttractingSpin<'_> {
    pub fn start(&self) -> Row {
        self.row(DirectRow { t: 0.0, energy: self.energy, dissipated: 0.0, revolutions: 0.0 }, f64::NAN)
    }

    fn row(&self, DirectRow { t, energy, revolutions, .. }: DirectRow, power: f64) -> Row {
        let nutation = self.wobble.nutation(energy);
        Row { t, revolutions: revolutions.abs(), energy, nutation, periods: [f64::NAN; 2], power }
    }

    pub fn answer(&self, method: Method, verdict: Verdict, rows: Vec<Row>) -> Answer {
        let attractor = self.pole.modes.equilibrium.angular_momentum;
        let (steady, rate) = (self.steady(), self.rate());
        Answer { method, verdict, budget: None, rows, attractor, steady, rate, crossed: None }
    }

    /// Rows of a history, evenly in time.
    pub fn of_run(&self, method: Method, run: &DirectRun, verdict: Verdict, samples: usize) -> Answer {
        let rows = &run.rows;
        let end = rows[rows.len() - 1];
        let last = samples.saturating_sub(1).max(1);
        let period = self.nutation().map_or(0.0, |mode| TAU / mode.frequency);
        let mut chosen: Vec<usize> = (0..=last)
            .map(|i| rows.partition_point(|row| row.t < end.t * i as f64 / last as f64).min(rows.len() - 1))
            .collect();
        chosen.dedup();
        let rows = chosen.into_iter().map(|i| self.row(rows[i], run.mean_power(i, period))).collect();
        let names = self.body.dissipators().iter().map(|each| each.name.clone());
        let budget = Some(names.zip(run.budget.iter().copied()).collect());
        Answer { budget, ..self.answer(method, verdict, rows) }
    }

    /// A run of the full system, and the modes behind it.
    pub fn with_tail(&self, run: DirectRun, goal: Option<f64>, asked: &EvolveSettings) -> Answer {
        let (first, end) = (run.rows[0], run.rows[run.rows.len() - 1]);
        let verdict = Verdict {
            sentence: followed_fully(asked.kind),
            error: Some(run.energy_drift.abs() / (first.energy - end.energy).abs()),
            ..Verdict::default()
        };
        let mut answer = self.of_run(Method::FullSystem, &run, verdict, asked.samples);
        let ended = goal.is_some_and(|goal| end.energy <= goal * (1.0 + f64::EPSILON));
        if ended || run.ending == DirectStopReason::Finished {
            return answer;
        }
        let left = asked.duration.map(|duration| duration - end.t);
        if let Ok(tail) = self.tail(self.row(end, f64::NAN), goal, left, asked.samples) {
            let nutation = asked.kind.nutation();
            answer.verdict.sentence = format!(
                "The full system was followed until its {nutation} was {} degrees, and the rate of the {nutation} from there on; the {nutation} is the envelope.",
                significant(BEHIND.to_degrees(), 2)
            );
            answer.rows.extend(&tail[1..]);
            // the rate of the nutation changes by the square of the wobble
            answer.verdict.error = answer.verdict.error.map(|error| error.max(BEHIND * BEHIND));
        }
        answer
    }

    /// Rows of a small wobble that falls at the rate of the modes, from a row to an energy (J) or for a time (s).
    pub fn tail(
        &self,
        from: Row,
        goal: Option<f64>,
        duration: Option<f64>,
        samples: usize,
    ) -> Result<Vec<Row>, Reason> {
        let rate = self.rate().filter(|rate| *rate > 0.0).ok_or(Reason::NoModalRate)?;
        let spin = &self.pole.modes.equilibrium;
        let (above, turning) = (from.energy - self.steady(), norm(spin.omega) / TAU);
        let falls = goal.map_or(f64::INFINITY, |goal| (above / (goal - self.steady())).ln() / (2.0 * rate));
        let length = duration.map_or(falls, |duration| duration.min(falls));
        let last = samples.saturating_sub(1).max(1);
        let row = |i: usize| {
            let t = length * i as f64 / last as f64;
            let left = above * (-2.0 * rate * t).exp();
            let row = DirectRow {
                t: from.t + t,
                energy: self.steady() + left,
                dissipated: above - left,
                revolutions: from.revolutions + turning * t,
            };
            self.row(row, 2.0 * rate * left)
        };
        Ok((0..=last).map(row).collect())
    }
}
