//! Table of a study: which column gives which key of the model, and the value that a row gives.
//! A cell that cannot be read spoils its row and no other.

mod roles;
mod values;

use std::ops::Range;

use quasirigid_io::model::{ChangeError, KeyPath, KeyValue, Template};
use quasirigid_io::study_file::{StudyFile, TableSource};
use quasirigid_io::table_file::{BodyTable, CellKind, TableError, read_bodies};
use quasirigid_math::expression::Expression;

use super::SweepError;

/// Table of bodies with the roles of its columns.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    table: BodyTable,
    /// Columns that give keys.
    pub(super) keys: Vec<KeyColumn>,
    /// Columns that are carried through: name and number.
    pub(super) kept: Vec<(String, usize)>,
    /// What was made of the table, where that is not plain.
    pub(super) notes: Vec<String>,
    /// Texts for no value that the study names.
    missing: Vec<String>,
    /// Columns of which every row draws a value.
    spreads: Vec<Spread>,
}

/// Column with that of its standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spread {
    column: usize,
    sigma: usize,
}

/// Column, or formula in several, that gives a key of the model.
#[derive(Clone, Debug)]
pub(super) struct KeyColumn {
    pub(super) name: String,
    pub(super) key: KeyPath,
    pub(super) unit: Option<String>,
    /// Kind of the values, by the majority.
    pub(super) kind: CellKind,
    source: Source,
    default: Option<KeyValue>,
    /// Numbers of its columns that are drawn.
    spreads: Vec<usize>,
    marks: Vec<String>,
}

#[derive(Clone, Debug)]
enum Source {
    Column(usize),
    Formula(Box<Expression>, Vec<usize>),
}

/// Number between 0 and 1 from which a row draws the value of a column, by the number of the column among those that are drawn.
pub(super) type Draw<'d> = &'d dyn Fn(u32) -> f64;

/// Texts of catalogues for no value.
const MISSING: [&str; 14] =
    ["", "-", "--", "---", "...", "NaN", "nan", "NAN", "null", "NULL", "None", "N/A", "n/a", "NA"];

impl Bodies {
    /// Reads the table of a study and finds the role of each column.
    pub(super) fn read(
        study: &StudyFile,
        source: &TableSource,
        template: &Template,
    ) -> Result<Self, SweepError> {
        let table = read_bodies(&source.file).map_err(|error| located(study, source, &error))?;
        let missing = source.missing.clone();
        let notes = table.notes.iter().map(|note| format!("{}: {note}", file_name(source))).collect();
        let (keys, kept, spreads) = (Vec::new(), Vec::new(), Vec::new());
        let mut bodies = Self { table, keys, kept, notes, missing, spreads };
        match &study.columns {
            Some(columns) => bodies.mapped(study, source, columns, template)?,
            None => bodies.named(study, source, template)?,
        }
        for place in 0..bodies.keys.len() {
            let key = &bodies.keys[place];
            let numeric = match &key.source {
                Source::Formula(..) => true,
                Source::Column(column) => {
                    let texts =
                        || bodies.table.columns[*column].iter().filter(|text| !bodies.is_missing(text));
                    let numbers = texts().filter(|text| key.number(text).is_some()).count();
                    let named = key.unit.is_none() && key.key.key() == "name";
                    !named && 2 * numbers > texts().count()
                }
            };
            if numeric {
                bodies.keys[place].kind = CellKind::Number;
            }
        }
        let gaps = bodies.gaps();
        bodies.notes.extend(gaps);
        Ok(bodies)
    }

    /// How many bodies have the default of a key, and how many lack the standard deviation of one.
    fn gaps(&self) -> Vec<String> {
        let lacks = |column: usize, row: usize| self.is_missing(&self.table.columns[column][row]);
        let rows = || (0..self.table.rows()).filter(|row| !self.table.unread.contains_key(row));
        let of_key = |key: &KeyColumn| {
            let without =
                rows().filter(|row| key.columns().iter().any(|column| lacks(*column, *row))).count();
            let lacks_sigma =
                |row: &usize| key.spreads.iter().any(|spread| lacks(self.spreads[*spread].sigma, *row));
            let certain = rows().filter(lacks_sigma).count();
            let default = key.default().filter(|_| without > 0);
            let default = default
                .map(|value| format!("{without} rows have no value for `{}`, and take {value}", key.key));
            let certain = (certain > 0).then(|| {
                format!("{certain} rows have no uncertainty of `{}`, and take the value itself", key.key)
            });
            default.into_iter().chain(certain)
        };
        self.keys.iter().flat_map(of_key).collect()
    }

    fn is_missing(&self, text: &str) -> bool {
        MISSING.contains(&text) || self.missing.iter().any(|missing| missing == text)
    }

    /// Cells that give keys of the model and are no numbers: names, and files.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        let named = self.keys.iter().filter(|key| key.kind == CellKind::Text);
        let columns = named.filter_map(|key| match &key.source {
            Source::Column(column) => Some(*column),
            Source::Formula(..) => None,
        });
        columns.flat_map(|column| self.table.columns[column].iter().map(String::as_str))
    }

    /// Number of bodies.
    pub(super) fn rows(&self) -> u64 {
        self.table.rows() as u64
    }

    /// Number of columns that are drawn.
    pub(super) fn uncertain(&self) -> u32 {
        self.spreads.len() as u32
    }
}

fn file_name(source: &TableSource) -> String {
    source.file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// A key that a study names and the model does not have, at its place in the study.
pub(super) fn nowhere(study: &StudyFile, span: Range<usize>, error: &ChangeError) -> SweepError {
    SweepError::File(study.refuse(span, format!("the model has no such key: {error}"), "no such key", None))
}

fn located(study: &StudyFile, source: &TableSource, error: &TableError) -> SweepError {
    SweepError::File(study.refuse(source.span.clone(), error.to_string(), "this table", None))
}
