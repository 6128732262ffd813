//! The columns of a history, or of the evolution, by name.

use quasirigid_io::record::{Column, HistoryRecord, RunRecord};

use crate::number::time_unit;

/// The main history: the first one.
pub fn main_history(record: &RunRecord) -> Option<&HistoryRecord> {
    record.histories.first()
}

/// The column of that name, if it has rows.
pub fn column<'a>(columns: &'a [Column], name: &str) -> Option<&'a Column> {
    columns.iter().find(|column| column.name == name && !column.values.is_empty())
}

/// Three columns as one vector per row.
pub fn vectors(columns: &[Column], names: [&str; 3]) -> Option<Vec<[f64; 3]>> {
    let [x, y, z] = names.map(|name| column(columns, name));
    let (x, y, z) = (&x?.values, &y?.values, &z?.values);
    Some(x.iter().zip(y).zip(z).map(|((&x, &y), &z)| [x, y, z]).collect())
}

/// First and last value that are finite.
pub fn ends(values: impl DoubleEndedIterator<Item = f64> + Clone) -> Option<(f64, f64)> {
    let mut finite = values.filter(|value| value.is_finite());
    let first = finite.clone().next()?;
    Some((first, finite.next_back().unwrap_or(first)))
}

/// The unit in which a time column is drawn.
pub struct TimeUnit {
    /// Name of the unit.
    pub name: String,
    /// Length of the unit, in the unit of the record.
    pub length: f64,
}

impl TimeUnit {
    /// The unit that suits the longest of some tables.
    pub fn of_longest<'a>(tables: impl Iterator<Item = &'a [Column]>) -> Self {
        let units = tables.map(|columns| Self::of(columns, usize::MAX));
        units.max_by(|a, b| a.length.total_cmp(&b.length)).unwrap_or(Self { name: "s".into(), length: 1.0 })
    }

    /// The unit that suits the span of the first `rows` rows of the column `t`.
    pub fn of(columns: &[Column], rows: usize) -> Self {
        let Some(column) = column(columns, "t") else {
            return Self { name: "s".into(), length: 1.0 };
        };
        match (column.unit.as_str(), ends(column.values.iter().copied().take(rows))) {
            ("s", Some((first, last))) => {
                let (name, length) = time_unit(last - first);
                Self { name: name.into(), length }
            }
            (unit, _) => Self { name: unit.into(), length: 1.0 },
        }
    }
}

/// Length of a vector; does not overflow.
pub fn norm([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}
