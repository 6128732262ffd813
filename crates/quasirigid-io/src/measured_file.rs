//! Measured histories: times and any columns of a spin history, each with its standard deviations.

use std::path::Path;

use thiserror::Error;

use crate::table_file::{BadLine, BodyTable, TableError, Unnumbered, bracketed_name, read_numbers};
use crate::text_file::{
    self, FileError, Place, ReadProblem, Unread, bytes_of, kind_of, no_text_table, unread_table,
};
use crate::visible::Excerpt;

/// Largest file that is read (bytes).
const MAX_FILE: u64 = 256 * 1024 * 1024;
/// Beginning of the name of a column of standard deviations.
const SIGMA: &str = "sigma_";
/// Names of the column of times.
const TIMES: [&str; 2] = ["t", "time"];

/// Measured history.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// Times (s), ascending from zero or later.
    pub t: Vec<f64>,
    /// Columns that were measured.
    pub columns: Vec<MeasuredColumn>,
    /// Whether standard deviations are given.
    deviations: bool,
}

/// Column of a measured history.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredColumn {
    /// Name, as `simulate` names its columns.
    pub name: String,
    /// Unit, where the heading has one in brackets; else that of `simulate`.
    pub unit: Option<String>,
    /// Values, one for each time.
    pub values: Vec<f64>,
    /// Standard deviations, one for each time, or one for all.
    sigma: Vec<f64>,
}

/// A file that is no measured history, with the place and the problem.
pub type MeasuredFileError = FileError<MeasuredFileProblem>;

/// Problem of a measured history.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MeasuredFileProblem {
    /// A file that cannot be read at all.
    #[error("{0}")]
    Unread(String),
    /// A file of another kind.
    #[error("this is {kind}; give a table in text, with a heading such as t,wx,wy,wz")]
    Kind {
        /// What the file is.
        kind: &'static str,
    },
    /// A table whose heading cannot be read.
    #[error("{0}")]
    Table(TableError),
    /// A table without times or without anything else.
    #[error("{0}")]
    Columns(String),
    /// A line without its numbers.
    #[error("{0}")]
    Line(String),
    /// A row whose time or deviation cannot be.
    #[error("row {row}: {problem}")]
    Row {
        /// Row, from 1.
        row: usize,
        /// What is wrong.
        problem: String,
    },
}

impl ReadProblem for MeasuredFileProblem {
    fn unread(unread: Unread, limit: u64) -> Self {
        Self::Unread(unread_table(unread, limit))
    }

    fn not_text(byte: u8) -> Self {
        Self::Unread(no_text_table(byte))
    }
}

impl MeasuredColumn {
    /// A column in the unit of `simulate` with one standard deviation for all its values.
    #[must_use]
    pub fn new(name: &str, values: Vec<f64>, sigma: f64) -> Self {
        Self { name: name.to_owned(), unit: None, values, sigma: vec![sigma] }
    }

    /// Standard deviation at a row.
    #[must_use]
    pub fn deviation(&self, row: usize) -> f64 {
        self.sigma.get(row).or(self.sigma.first()).copied().unwrap_or(1.0)
    }

    /// Values and deviations times a factor.
    pub fn scale(&mut self, factor: f64) {
        self.values.iter_mut().chain(&mut self.sigma).for_each(|value| *value *= factor);
    }
}

impl Measurements {
    /// Columns with their deviations at ascending times (s).
    #[must_use]
    pub fn of_columns(t: Vec<f64>, columns: Vec<MeasuredColumn>) -> Self {
        Self { t, columns, deviations: true }
    }

    /// Number of measured values.
    #[must_use]
    pub fn count(&self) -> usize {
        self.columns.len() * self.t.len()
    }

    /// Whether standard deviations are given.
    #[must_use]
    pub fn has_deviations(&self) -> bool {
        self.deviations
    }
}

/// Reads a table of `t` and columns as `simulate` names them, each perhaps with `sigma_` and its name; others have the deviation `sigma`.
///
/// # Errors
/// [`MeasuredFileError`] says what is wrong and where.
pub fn read_measurements(file: &Path, sigma: Option<f64>) -> Result<Measurements, MeasuredFileError> {
    let bytes = bytes_of(file, MAX_FILE)?;
    of_bytes(file, &bytes, sigma).map_err(FileError::new(file))
}

type Fault = text_file::Fault<MeasuredFileProblem>;

fn of_bytes(file: &Path, bytes: &[u8], sigma: Option<f64>) -> Result<Measurements, Fault> {
    let kind = kind_of(bytes);
    if kind != "text" {
        return Err((Place::File, MeasuredFileProblem::Kind { kind }));
    }
    let mut titles = Vec::new();
    let read = read_numbers(file, bytes, |table: &BodyTable| {
        titles = (0..table.names.len()).map(|index| title(table, index)).collect();
        Ok::<_, std::convert::Infallible>((0..table.names.len()).collect())
    });
    let (columns, _) = read.map_err(|error| match error {
        Unnumbered::Table(error) => (Place::File, MeasuredFileProblem::Table(error)),
        Unnumbered::Unwanted(never) => match never {},
        Unnumbered::Line(BadLine { line, column, found }) => {
            let name = column.and_then(|at| titles.get(at)).map(|(name, _): &(String, Option<String>)| name);
            let found = Excerpt::from(found.as_str());
            let told = name.map_or_else(
                || format!("{found}; was the file cut off?"),
                |name| format!("{name}: {found:?} is not a finite number"),
            );
            (Place::Line(line), MeasuredFileProblem::Line(told))
        }
    })?;
    let values: Vec<Vec<f64>> = columns.into_iter().map(|column| column.values).collect();
    measured(titles, values, sigma)
}

/// Name and unit of a column.
fn title(table: &BodyTable, index: usize) -> (String, Option<String>) {
    let told = table.units.get(index).and_then(Clone::clone).filter(|unit| !unit.is_empty());
    let name = table.names[index].trim();
    (bracketed_name(name).unwrap_or(name).to_owned(), told)
}

fn measured(
    titles: Vec<(String, Option<String>)>,
    values: Vec<Vec<f64>>,
    sigma: Option<f64>,
) -> Result<Measurements, Fault> {
    let refuse = |problem: String| Err((Place::File, MeasuredFileProblem::Columns(problem)));
    let named: Vec<&str> = titles.iter().map(|(name, _)| name.as_str()).collect();
    let place = |name: &str| named.iter().position(|other| *other == name);
    if let Some(twice) = (0..named.len()).find(|at| named[..*at].contains(&named[*at])) {
        return refuse(format!("two columns are named {:?}", named[twice]));
    }
    let Some(times) = TIMES.iter().find_map(|name| place(name)) else {
        return refuse(format!("no column is the time `t`; there are {}", named.join(", ")));
    };
    let factor = seconds(titles[times].1.as_deref()).map_err(|problem| (Place::File, problem))?;
    let t: Vec<f64> = values[times].iter().map(|t| t * factor).collect();
    ascending(&t)?;
    let mut columns = Vec::new();
    for (at, (name, unit)) in titles.iter().enumerate() {
        if at == times || name.starts_with(SIGMA) {
            continue;
        }
        let own = place(&format!("{SIGMA}{name}")).map(|at| values[at].clone());
        let sigma = own.or(sigma.map(|sigma| vec![sigma])).unwrap_or_default();
        if let Some(row) = sigma.iter().position(|sigma| !(*sigma > 0.0)) {
            let problem = format!("the standard deviation of {name} is {}, but must be positive", sigma[row]);
            return Err((Place::File, MeasuredFileProblem::Row { row: row + 1, problem }));
        }
        columns.push(MeasuredColumn {
            name: name.clone(),
            unit: unit.clone(),
            values: values[at].clone(),
            sigma,
        });
    }
    let orphan = named.iter().find(|name| {
        name.strip_prefix(SIGMA).is_some_and(|of| !columns.iter().any(|column| column.name == of))
    });
    if let Some(orphan) = orphan {
        return refuse(format!("{orphan:?} is the deviation of a column that is not there"));
    }
    if columns.is_empty() {
        return refuse(
            "no column is measured beside the time; name columns as `simulate` does: wx, wy, energy"
                .to_owned(),
        );
    }
    let given = columns.iter().filter(|column| !column.sigma.is_empty()).count();
    if given != 0 && given != columns.len() {
        let lacking = columns.iter().find(|column| column.sigma.is_empty()).map_or("", |column| &column.name);
        return refuse(format!(
            "{lacking:?} has no deviation, and others have; add sigma_{lacking}, or --sigma for all that lack one"
        ));
    }
    Ok(Measurements { t, columns, deviations: given != 0 })
}

fn seconds(unit: Option<&str>) -> Result<f64, MeasuredFileProblem> {
    let Some(unit) = unit else { return Ok(1.0) };
    crate::units::number_in(&format!("1 {unit}"), "s")
        .ok_or_else(|| MeasuredFileProblem::Columns(format!("{:?} is no unit of time", Excerpt::from(unit))))
}

fn ascending(t: &[f64]) -> Result<(), Fault> {
    let refuse =
        |row: usize, problem: String| Err((Place::File, MeasuredFileProblem::Row { row: row + 1, problem }));
    if t.first().is_some_and(|first| *first < 0.0) {
        return refuse(0, format!("the time {} is before that of the start, 0", t[0]));
    }
    match (1..t.len()).find(|at| !(t[*at] > t[*at - 1])) {
        Some(at) => refuse(at, format!("the time {} does not follow {}; sort the rows", t[at], t[at - 1])),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, sigma: Option<f64>) -> Result<Measurements, String> {
        of_bytes(Path::new("x.csv"), text.as_bytes(), sigma).map_err(|(_, problem)| problem.to_string())
    }

    #[test]
    fn columns_are_read_with_their_deviations_and_units() {
        let found =
            read("t [ms],wx [deg/s],sigma_wx,energy\n0,1.5,0.1,3\n500,2.5,0.2,4\n", Some(0.01)).unwrap();
        assert_eq!(found.t, [0.0, 0.5]);
        let [wx, energy] = &found.columns[..] else { panic!("{found:?}") };
        assert_eq!(
            (wx.name.as_str(), wx.unit.as_deref(), wx.values.as_slice()),
            ("wx", Some("deg/s"), &[1.5, 2.5][..])
        );
        assert_eq!([wx.deviation(1), energy.deviation(1)], [0.2, 0.01]);
        assert!(found.has_deviations() && found.count() == 4);
        assert!(!read("time,wx\n0,1\n1,2\n", None).unwrap().has_deviations());
    }

    #[test]
    fn what_is_no_measured_history_is_told() {
        for (text, told) in [
            ("wx,wy\n1,2\n", "no column is the time"),
            ("t\n1\n", "no column is measured"),
            ("t,wx\n1,2\n1,3\n", "row 2: the time 1 does not follow 1"),
            ("t,wx\n-1,2\n1,3\n", "before that of the start"),
            ("t,wx,sigma_wx\n0,2,0\n", "must be positive"),
            ("t,wx,sigma_wy\n0,2,1\n", "deviation of a column that is not there"),
            ("t,wx,wy,sigma_wy\n0,2,3,1\n", "\"wx\" has no deviation"),
            ("t,wx\n0,nan\n", "is not a finite number"),
            ("t,wx,wx\n0,1,2\n", "two columns are named"),
            ("t [kg],wx\n0,1\n", "is no unit of time"),
        ] {
            let found = read(text, None).unwrap_err();
            assert!(found.contains(told), "{text:?}: {found}");
        }
    }
}
