//! Columns of a table as a history: which column is what, units, order of the rows, norms of the quaternions.

use std::collections::BTreeMap;

use super::error::{Fault, HistoryFileProblem};
use super::names::{Role, parts, roles};
use super::{HistoryFile, QuaternionOrder, Resolution};
use crate::text_file::Place;
use crate::units::{Dimension, quantity};

/// Column of a table.
pub(super) struct Column {
    pub values: Vec<f64>,
    pub resolution: Resolution,
}

/// Names of the wanted columns and their places in the table.
pub(super) struct Chosen {
    /// Indices of the wanted columns: the time, three rates, and those of the attitude.
    pub indices: Vec<usize>,
    attitude: Option<Stored>,
    time: (f64, Option<String>),
    rates: Option<(f64, Option<String>)>,
}

/// How an attitude is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stored {
    Named,
    Numbered,
    Rodrigues,
}

/// What a missing column of a rate would be.
const COMPONENTS: [&str; 3] = [
    "the x component of the angular velocity",
    "the y component of the angular velocity",
    "the z component of the angular velocity",
];

/// Largest deviation of the norm of a quaternion from one.
const UNIT: f64 = 1e-2;

impl Chosen {
    /// The columns of a history among those of these names, with the units that a row below the names may give.
    pub fn of(titles: &[String], units: &[Option<String>]) -> Result<Self, HistoryFileProblem> {
        let found = roles(titles);
        let of = |role: Role, what: &'static str| only(&found, titles, role, what);
        let missing = |what| HistoryFileProblem::Missing { what, known: titles.to_vec() };
        let time = of(Role::Time, "the time")?.ok_or_else(|| missing("the time"))?;
        let mut indices = vec![time];
        let named = |index: usize| {
            let told = units.get(index).and_then(Clone::clone).filter(|unit| !unit.is_empty());
            told.or_else(|| parts(&titles[index]).1.map(str::to_owned))
        };
        let attitude = attitude(&found, titles)?;
        let has_rates = (0..3).any(|axis| found.contains_key(&Role::Rate(axis)));
        let mut rates: Option<(f64, Option<String>)> = None;
        for axis in (0..3).filter(|_| has_rates || attitude.is_none()) {
            let index = of(Role::Rate(axis), "a component of the angular velocity")?
                .ok_or_else(|| missing(COMPONENTS[usize::from(axis)]))?;
            indices.push(index);
            let unit = (titles[index].as_str(), named(index));
            let read = factor(unit, Dimension::ANGULAR_VELOCITY, "an angular velocity")?;
            match &rates {
                Some((_, first)) if *first != read.1 => {
                    let text =
                        |unit: &Option<String>| unit.clone().unwrap_or_else(|| "no unit".to_owned()).into();
                    return Err(HistoryFileProblem::Units { first: text(first), second: text(&read.1) });
                }
                _ => rates = Some(read),
            }
        }
        let time = factor((&titles[time], named(time)), Dimension::TIME, "a time")?;
        let stored = attitude.map(|(stored, places)| {
            indices.extend(places);
            stored
        });
        Ok(Self { indices, attitude: stored, time, rates })
    }

    /// The history of these columns, which stand in the order of the indices.
    pub fn history(self, columns: Vec<Column>, notes: Vec<String>) -> Result<HistoryFile, Fault> {
        let whole = |problem| (Place::File, problem);
        let first = if self.rates.is_some() { 4 } else { 1 };
        let resolution = shared(&columns[1..first]);
        let rows = columns.first().map_or(0, |column| column.values.len());
        if rows == 0 {
            return Err(whole(HistoryFileProblem::Empty));
        }
        let attitude = match self.attitude {
            None => Vec::new(),
            Some(stored) => attitudes(stored, &columns[first..]).map_err(whole)?,
        };
        let attitude_rounding = shared(&columns[first..]).error(1.0);
        let order = match self.attitude {
            Some(Stored::Numbered) => QuaternionOrder::Unknown,
            _ => QuaternionOrder::ScalarFirst,
        };
        let mut columns = columns.into_iter().take(first).map(|column| column.values);
        let [time, x, y, z] = std::array::from_fn(|_| columns.next().unwrap_or_default());
        check_order(&time).map_err(whole)?;
        let (factor, rate_unit) = self.rates.unwrap_or((1.0, None));
        let rates = x.into_iter().zip(y).zip(z);
        Ok(HistoryFile {
            t: time.into_iter().map(|t| t * self.time.0).collect(),
            rates: rates.map(|((x, y), z)| [x, y, z].map(|rate| rate * factor)).collect(),
            attitude,
            order,
            time_unit: self.time.1,
            rate_unit,
            rate_factor: factor,
            resolution,
            attitude_rounding,
            notes,
        })
    }
}

/// Resolution of columns that one writer wrote.
fn shared(columns: &[Column]) -> Resolution {
    let columns: Vec<(Resolution, &[f64])> =
        columns.iter().map(|column| (column.resolution, column.values.as_slice())).collect();
    Resolution::shared(&columns)
}

/// The column of a role, if there is one and no other.
fn only(
    found: &BTreeMap<Role, Vec<usize>>,
    titles: &[String],
    role: Role,
    what: &'static str,
) -> Result<Option<usize>, HistoryFileProblem> {
    match found.get(&role).map(Vec::as_slice) {
        None | Some([]) => Ok(None),
        Some([one]) => Ok(Some(*one)),
        Some([first, second, ..]) => {
            let name = |index: usize| titles[index].as_str().into();
            Err(HistoryFileProblem::Twice { what, first: name(*first), second: name(*second) })
        }
    }
}

/// A way to store an attitude, the roles of its parts, and their number.
type Kind = (Stored, fn(u8) -> Role, u8);

/// Columns of an attitude; none where there is not a whole one.
fn attitude(
    found: &BTreeMap<Role, Vec<usize>>,
    titles: &[String],
) -> Result<Option<(Stored, Vec<usize>)>, HistoryFileProblem> {
    let kinds: [Kind; 3] = [
        (Stored::Named, Role::Quaternion, 4),
        (Stored::Numbered, Role::Numbered, 4),
        (Stored::Rodrigues, Role::Rodrigues, 3),
    ];
    for (stored, role, count) in kinds {
        let places = (0..count).map(|part| only(found, titles, role(part), "a part of the attitude"));
        let places = places.collect::<Result<Option<Vec<usize>>, _>>()?;
        if let Some(places) = places {
            return Ok(Some((stored, places)));
        }
    }
    Ok(None)
}

/// SI value of the unit of a column, and its name; one where it has none.
fn factor(
    (name, unit): (&str, Option<String>),
    dimension: Dimension,
    what: &'static str,
) -> Result<(f64, Option<String>), HistoryFileProblem> {
    let Some(unit) = unit else { return Ok((1.0, None)) };
    let plain = match unit.as_str() {
        "dps" | "°/s" => "deg/s",
        "rps" | "Hz" => "rev/s",
        "secs" => "s",
        other => other,
    };
    match quantity(&format!("1 {plain}"), dimension) {
        Ok(factor) => Ok((factor, Some(unit))),
        Err(_) => Err(HistoryFileProblem::Unit { name: name.into(), unit: unit.as_str().into(), what }),
    }
}

fn check_order(times: &[f64]) -> Result<(), HistoryFileProblem> {
    let bad = times.windows(2).position(|pair| !(pair[1] > pair[0]));
    bad.map_or(Ok(()), |at| {
        Err(HistoryFileProblem::Order { row: at + 2, t: times[at + 1], before: times[at] })
    })
}

/// Unit quaternions of the columns.
fn attitudes(stored: Stored, columns: &[Column]) -> Result<Vec<[f64; 4]>, HistoryFileProblem> {
    let rows = columns.first().map_or(0, |column| column.values.len());
    let at = |part: usize, row: usize| columns.get(part).map_or(0.0, |column| column.values[row]);
    (0..rows)
        .map(|row| {
            if stored == Stored::Rodrigues {
                return Ok(of_rodrigues([0, 1, 2].map(|part| at(part, row))));
            }
            let four = [0, 1, 2, 3].map(|part| at(part, row));
            let norm = four.iter().map(|part| part * part).sum::<f64>().sqrt();
            if (norm - 1.0).abs() <= UNIT {
                Ok(four.map(|part| part / norm))
            } else {
                Err(HistoryFileProblem::NotUnit { row: row + 1, norm })
            }
        })
        .collect()
}

/// Quaternion, scalar first, of modified Rodrigues parameters, `e tan(φ/4)`.
fn of_rodrigues(sigma: [f64; 3]) -> [f64; 4] {
    let square: f64 = sigma.iter().map(|part| part * part).sum();
    let [x, y, z] = sigma.map(|part| 2.0 * part / (1.0 + square));
    [(1.0 - square) / (1.0 + square), x, y, z]
}
