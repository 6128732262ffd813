//! Columns of an evolution: the table of its rows, and the rows at its ends as observers describe them.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::averaging::{DriftState, Evolution, LevelRow, MeanPower};
use quasirigid_io::record::{Column, ObservedRecord};
use quasirigid_math::vec3::norm;

use super::answer::Answer;
use super::inputs::Inputs;
use super::table::EvolutionTable;

/// Indices of columns.
const RATIO: usize = 1;
const NUTATION: usize = 3;
const ENERGY: usize = 5;
const PERIOD: usize = 7;
const POWER: usize = 9;
/// Columns of the table, each with its unit.
pub const COLUMNS: [(&str, &str); 12] = [
    ("t", "s"),
    ("D_over_I3", "1"),
    ("circled_axis", "1"),
    ("nutation_min", "rad"),
    ("nutation_max", "rad"),
    ("energy", "J"),
    ("momentum", "N m s"),
    ("polhode_period", "s"),
    ("precession_period", "s"),
    ("power", "W"),
    ("polynomial_power", "W"),
    ("turns", "1"),
];

/// Values of a row, in the order of the columns.
pub type Row = [f64; COLUMNS.len()];

/// Columns of rows.
pub fn of_rows(rows: &[Row]) -> Vec<Column> {
    let column = |(i, (name, unit)): (usize, &(&str, &str))| Column {
        name: (*name).into(),
        unit: (*unit).into(),
        values: rows.iter().map(|row| row[i]).collect(),
    };
    COLUMNS.iter().enumerate().map(column).collect()
}

/// A row of the table as observers describe it.
pub fn observed(columns: &[Column], row: usize) -> Option<ObservedRecord> {
    let at = |column: usize| columns[column].values.get(row).copied();
    Some(ObservedRecord {
        rotation_period: at(PERIOD)?,
        precession_period: at(PERIOD + 1)?,
        nutation_least: at(NUTATION)?,
        nutation_greatest: at(NUTATION + 1)?,
        energy_ratio: at(RATIO)?.recip(),
    })
}

impl Answer<'_> {
    /// The table of the rows; fewer of them if the watch ends the work.
    pub fn columns(
        &self,
        rows: &mut EvolutionTable,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Vec<Column> {
        let mut found = Vec::with_capacity(rows.states.len());
        let ended = rows.status == "interrupted"; // states that a drift has reached are still listed
        for i in 0..rows.states.len() {
            if watch(i as f64 / rows.states.len() as f64).is_break() && !ended {
                rows.states.truncate(i);
                rows.status = "interrupted";
                break;
            }
            found.push(self.row(rows, i));
        }
        of_rows(&found)
    }

    fn row(&self, rows: &mut EvolutionTable, i: usize) -> Row {
        let mut values = self.row_of_state(rows.advance(i));
        if let Some(powers) = &rows.powers {
            values[POWER] = powers[i];
        }
        let level = rows.levels.as_ref().map(|rows| rows[i]);
        if let Some(LevelRow {
            energy, nutation, period, long_axis_precession_rate, angular_momentum, ..
        }) = level
        {
            let G = norm(angular_momentum);
            values[RATIO] = G * G / (2.0 * energy * self.principal.moments[2]);
            [values[NUTATION], values[NUTATION + 1]] = nutation;
            let precession = TAU / long_axis_precession_rate;
            (values[ENERGY], values[PERIOD], values[PERIOD + 1]) = (energy, period, precession);
        }
        values
    }

    fn row_of_state(&self, state: DriftState) -> Row {
        let motion = Evolution::new(self.power(), state.angular_momentum).motion(state.rotation_state);
        let [least, greatest] = motion.nutation();
        [
            state.t,
            motion.ratio(),
            (motion.mode().circled() + 1) as f64,
            least,
            greatest,
            motion.energy(),
            motion.angular_momentum(),
            motion.polhode_period(),
            TAU / (motion.long_axis_precession_rate()
                + self.precession_with_bulge(motion.angular_momentum())),
            self.power().mean_power(&motion),
            self.inputs.powers.polynomial.mean_power(&motion),
            state.revolutions,
        ]
    }

    /// By how much a body observed in rotation goes round its angular momentum (N·m·s) faster than the rigid body of the polhode
    /// (rad/s): its bulge, which grows with the square of the spin, adds to the moment that it circles. (G19)
    fn precession_with_bulge(&self, angular_momentum: f64) -> f64 {
        let Inputs { observed, initial, .. } = self.inputs;
        let shift = observed.map_or(0.0, |observed| observed.shift(self.principal.moments, initial.mode()));
        shift * angular_momentum * (angular_momentum / initial.angular_momentum()).powi(2)
    }
}
