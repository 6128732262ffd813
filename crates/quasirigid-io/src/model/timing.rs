//! Reader of the times at which a force acts: `during`, `timetable` and `interpolation` of `[[force]]`.
//! Equations (F13), (F14), docs/theory/07-forces.md.

use std::path::Path;

use quasirigid_body::force::{Interpolation, Timetable, Windows};

use super::table::Table;
use super::value::Value;
use crate::table_file::read_bodies;
use crate::units::Dimension;

/// Reads the windows in which a force acts; none without them.
pub(super) fn windows(table: &Table<'_>) -> Option<Option<Windows>> {
    let Some(value) = table.get("during") else { return Some(None) };
    let example = "during = [[\"1000 s\", \"1000.1 s\"], [\"25 min\", \"26 min\"]]";
    let list = value.list("a list of windows", |window| window.numbers::<2>(Dimension::TIME))?;
    let items = value.items().unwrap_or_default();
    match Windows::new(list) {
        Ok(windows) => Some(Some(windows)),
        Err(problem) => {
            let at = problem.index().and_then(|index| items.get(index - 1)).map_or(value.span(), Value::span);
            let help = format!("windows have a start and a later end, in order and apart: {example}");
            value.refuse_at(at, format!("`during`: {problem}"), "in this window", help)
        }
    }
}

/// Reads the table of a force or torque whose components stand under `key` elsewhere; none without one.
pub(super) fn tabled(table: &Table<'_>, key: &'static str, folder: &Path) -> Option<Option<Timetable>> {
    let Some(value) = table.get("timetable") else {
        return table.get("interpolation").map(|value| alone(&value));
    };
    for other in [key, "frequency", "period", "phase"] {
        if let Some(other) = table.get(other) {
            return Some(twice(&other));
        }
    }
    Some(timetable(&value, table, folder))
}

/// Refuses what a timetable says already.
pub(super) fn twice<T>(value: &Value<'_>) -> Option<T> {
    let message = format!("`{}` beside a `timetable`, which has the components at each time", value.key());
    value.refuse(message, "given twice", "leave out one of the two")
}

/// Refuses an interpolation of nothing.
pub(super) fn alone<T>(value: &Value<'_>) -> Option<T> {
    let message = "`interpolation` is that of a `timetable`, and there is none";
    value.refuse(message, "of what?", "add timetable = \"burns.csv\", or leave it out")
}

fn timetable(value: &Value<'_>, table: &Table<'_>, folder: &Path) -> Option<Timetable> {
    let choices = [("held", Interpolation::Held), ("linear", Interpolation::Linear)];
    let interpolation = table.read_or("interpolation", Interpolation::Held, |value| value.choice(&choices));
    let found = rows(&folder.join(value.text()?));
    let interpolation = interpolation?;
    let found =
        found.and_then(|rows| Timetable::new(&rows, interpolation).map_err(|problem| problem.to_string()));
    match found {
        Ok(timetable) => Some(timetable),
        Err(message) => {
            let help = "the table is looked for beside the model: CSV with the columns t, x, y, z in this order, t in seconds and \
                        ascending, components in N or N m";
            value.refuse(format!("`timetable`: {message}"), "cannot be used", help)
        }
    }
}

/// Rows of a file: time and components.
pub(super) fn rows(file: &Path) -> Result<Vec<(f64, [f64; 3])>, String> {
    let table = read_bodies(file).map_err(|error| error.to_string())?;
    if let Some((_, reason)) = table.unread.first_key_value() {
        return Err(reason.clone());
    }
    let [t, x, y, z] = table.columns.as_slice() else {
        return Err(format!(
            "the table has {} columns, and 4 are needed: t and three components",
            table.names.len()
        ));
    };
    if table.names.first().map(String::as_str) != Some("t") {
        let name = table.names.first().map_or("", String::as_str);
        return Err(format!("the first column is named {name:?}, and must be named \"t\""));
    }
    let number = |row: usize, column: &[String]| {
        let text = column[row].as_str();
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| format!("row {} has {text:?} where a finite number is needed", row + 1))
    };
    (0..table.rows())
        .map(|row| Ok((number(row, t)?, [number(row, x)?, number(row, y)?, number(row, z)?])))
        .collect()
}
