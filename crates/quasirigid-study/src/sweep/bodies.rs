//! Table of a study: which column gives which key of the model, and the value that a row gives.
//! A cell that cannot be read spoils its row and no other.

use quasirigid_io::model::{ChangeError, KeyPath, KeyValue, ModelError, Template};
use quasirigid_io::study_file::{ColumnSource, Distribution, KeySource, StudyFile, TableColumn, TableSource};
use quasirigid_io::table_file::{BodyTable, CellKind, TableError, bracketed_name, read_bodies, unit_ending};
use quasirigid_io::units::number_in;
use quasirigid_io::visible::Excerpt;
use quasirigid_math::expression::Expression;

use super::SweepError;
use super::cell::Cell;
use super::distribution::quantile;

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

    /// Takes the roles from `[columns]` of the study; columns that it does not name are left out, and told.
    fn mapped(
        &mut self,
        study: &StudyFile,
        source: &TableSource,
        columns: &[KeySource],
        template: &Template,
    ) -> Result<(), SweepError> {
        let mut used = vec![false; self.table.names.len()];
        for given in columns {
            template.find(&given.key).map_err(|error| nowhere(study, given.span.clone(), &error))?;
            let mut place = |name: &str| {
                let column = self.table.column(name);
                let column = column.ok_or_else(|| no_column(study, &self.table, name, &given.span))?;
                used[column] = true;
                Ok::<usize, SweepError>(column)
            };
            let (found, name) = match &given.source {
                ColumnSource::Column(name) => (Source::Column(place(name)?), name.clone()),
                ColumnSource::Formula(formula, names) => {
                    let columns = names.iter().map(|name| place(name)).collect::<Result<_, _>>()?;
                    (Source::Formula(formula.clone(), columns), given.key.to_string())
                }
            };
            let pairs = given.sigma.iter().map(|(name, sigma)| Ok([place(name)?, place(sigma)?]));
            let pairs = pairs.collect::<Result<Vec<_>, SweepError>>()?;
            let spreads = pairs.into_iter().map(|pair| self.spread(study, pair, &given.span));
            let spreads = spreads.collect::<Result<_, _>>()?;
            let unit = match found {
                Source::Column(column) => self.unit(study, column, given.unit.as_deref(), &given.span)?,
                Source::Formula(..) => given.unit.clone(),
            };
            let (key, default, marks) = (given.key.clone(), given.default.clone(), given.marks.clone());
            self.keys.push(KeyColumn {
                name,
                key,
                unit,
                kind: CellKind::Text,
                source: found,
                default,
                spreads,
                marks,
            });
        }
        self.keep(study, source, &mut used)?;
        let left: Vec<&str> = self
            .table
            .names
            .iter()
            .zip(used)
            .filter(|(_, used)| !used)
            .map(|(name, _)| name.as_str())
            .collect();
        if !left.is_empty() {
            let names: Vec<String> =
                left.iter().take(LISTED).map(|name| format!("{:?}", Excerpt::from(*name))).collect();
            let more = if left.len() > LISTED {
                format!(" and {} more", left.len() - LISTED)
            } else {
                String::new()
            };
            self.notes.push(format!("{}: columns left out: {}{more}", file_name(source), names.join(", ")));
        }
        Ok(())
    }

    /// Takes the roles from the names of the columns, and from `columns` of the table.
    fn named(
        &mut self,
        study: &StudyFile,
        source: &TableSource,
        template: &Template,
    ) -> Result<(), SweepError> {
        let table = &self.table;
        let asked =
            source.columns.iter().map(|column| &column.name).chain(source.keep.iter().map(|(name, _)| name));
        let is_key = |name: &String| {
            name.contains('.') && key_named(name).is_some_and(|key| template.find(&key).is_ok())
        };
        if !(asked.clone().any(|name| table.column(name).is_some()) || table.names.iter().any(is_key)) {
            return Err(no_table(study, source, asked.map(String::as_str).collect()));
        }
        for TableColumn { name, span, .. } in &source.columns {
            if table.column(name).is_none() {
                return Err(no_column(study, table, name, span));
            }
        }
        let mut used = vec![false; table.names.len()];
        self.keep(study, source, &mut used)?;
        for column in 0..self.table.names.len() {
            let name = self.table.names[column].clone();
            let given = source.columns.iter().find(|each| self.table.column(&each.name) == Some(column));
            let (name, key, unit, span) = match given {
                Some(TableColumn { name, key, unit, span }) => {
                    template.find(key).map_err(|error| nowhere(study, span.clone(), &error))?;
                    (name.clone(), key.clone(), unit.as_deref(), span)
                }
                None if used[column] || self.table.columns[column].iter().all(String::is_empty) => continue,
                None => {
                    let key = match key_named(&name) {
                        Some(key) => template.find(&key).map(|_| key),
                        None => name.parse::<KeyPath>(),
                    };
                    let key = key.map_err(|error| unknown(study, source, &name, &error))?;
                    (name, key, None, &source.span)
                }
            };
            let unit = self.unit(study, column, unit, span)?;
            let source = Source::Column(column);
            self.keys.push(KeyColumn {
                name,
                key,
                unit,
                kind: CellKind::Text,
                source,
                default: None,
                spreads: Vec::new(),
                marks: Vec::new(),
            });
        }
        Ok(())
    }

    /// Notes the columns that are carried through.
    fn keep(&mut self, study: &StudyFile, source: &TableSource, used: &mut [bool]) -> Result<(), SweepError> {
        for (name, span) in &source.keep {
            let column = self.table.column(name).ok_or_else(|| no_column(study, &self.table, name, span))?;
            used[column] = true;
        }
        let is_kept =
            |column: usize| source.keep.iter().any(|(name, _)| self.table.column(name) == Some(column));
        let kept = (0..self.table.names.len()).filter(|column| is_kept(*column));
        self.kept = kept.map(|column| (self.table.names[column].clone(), column)).collect();
        Ok(())
    }

    /// Number of the draws of a column whose standard deviation stands in another.
    fn spread(
        &mut self,
        study: &StudyFile,
        [column, sigma]: [usize; 2],
        span: &std::ops::Range<usize>,
    ) -> Result<usize, SweepError> {
        if let (Some(unit), Some(other)) = (&self.table.units[column], &self.table.units[sigma])
            && !same_unit(unit, other)
        {
            let message =
                format!("the table gives the value in {unit:?}, and its standard deviation in {other:?}");
            return Err(SweepError::File(study.refuse(span.clone(), message, "two units", None)));
        }
        let spread = Spread { column, sigma };
        let known = self.spreads.iter().position(|known| *known == spread);
        Ok(known.unwrap_or_else(|| {
            self.spreads.push(spread);
            self.spreads.len() - 1
        }))
    }

    /// Unit of a column: that of the study, which must be that of the table where both give one, else that of the table.
    fn unit(
        &mut self,
        study: &StudyFile,
        column: usize,
        asked: Option<&str>,
        span: &std::ops::Range<usize>,
    ) -> Result<Option<String>, SweepError> {
        let told = self.table.units[column].clone();
        match (asked, told) {
            (Some(asked), Some(told)) if !same_unit(asked, &told) => {
                let shown = if told.is_empty() { "a pure number".to_owned() } else { told };
                let message = format!("the study gives {asked} as the unit of the column, the table {shown}");
                Err(SweepError::File(study.refuse(span.clone(), message, "which one?", None)))
            }
            (Some(asked), _) => Ok(Some(asked.to_owned())),
            (None, Some(told)) => Ok(Some(told).filter(|unit| !unit.is_empty())),
            (None, None) => {
                let name = &self.table.names[column];
                let ending = unit_ending(name).map(str::to_owned);
                if let Some(unit) = &ending {
                    self.notes.push(format!(
                        "the column {name:?} is taken in {unit}, as its name ends; `unit` says otherwise"
                    ));
                }
                Ok(ending)
            }
        }
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

    /// The values of a body in a row, or why it has none.
    pub(super) fn changes(&self, body: usize, draw: Draw<'_>) -> Result<Vec<(KeyPath, KeyValue)>, String> {
        if let Some(reason) = self.table.unread.get(&body) {
            return Err(reason.clone());
        }
        self.keys.iter().map(|key| Ok((key.key.clone(), self.given(key, body, Some(draw))?))).collect()
    }

    /// The value that a body gives to a key; without a number to draw from, that of the table itself.
    pub(super) fn given(
        &self,
        key: &KeyColumn,
        body: usize,
        draw: Option<Draw<'_>>,
    ) -> Result<KeyValue, String> {
        let Source::Column(column) = key.source else {
            return match self.number(key, body, draw)? {
                Some(number) => Ok(key.measured(number)),
                None => self.default(key, body),
            };
        };
        let text = self.table.columns[column][body].as_str();
        if text.is_empty() || key.key.key() != "name" && self.is_missing(text) {
            return self.default(key, body);
        }
        if key.key.key() == "name" && key.unit.is_none() {
            return Ok(text.into());
        }
        if key.unit.is_some() || !key.spreads.is_empty() || !key.marks.is_empty() {
            return match self.number(key, body, draw)? {
                Some(number) => Ok(key.measured(number)),
                None => self.default(key, body),
            };
        }
        Ok(match (text.parse::<i64>(), text.parse::<f64>(), text) {
            (Ok(integer), _, _) => integer.into(),
            (_, Ok(number), _) => number.into(),
            (_, _, "true") => true.into(),
            (_, _, "false") => false.into(),
            _ => text.into(),
        })
    }

    /// The number of a body for a key, of drawn columns where these are uncertain; none where a value is missing.
    fn number(&self, key: &KeyColumn, body: usize, draw: Option<Draw<'_>>) -> Result<Option<f64>, String> {
        let value = |column: usize| {
            let Some(value) = self.cell(key, body, column)? else { return Ok(None) };
            let spread = key.spreads.iter().find(|spread| self.spreads[**spread].column == column);
            match spread.zip(draw) {
                Some((spread, draw)) => {
                    self.spread_value(key, body, *spread, value, draw(*spread as u32)).map(Some)
                }
                None => Ok(Some(value)),
            }
        };
        let (formula, columns) = match &key.source {
            Source::Column(column) => return value(*column),
            Source::Formula(formula, columns) => (formula, columns),
        };
        let values: Option<Vec<f64>> =
            columns.iter().map(|column| value(*column)).collect::<Result<_, _>>()?;
        let number = values.map(|values| formula.value(&values));
        match number.filter(|number| !number.is_finite()) {
            Some(number) => {
                Err(format!("row {} of the table: the formula of `{}` gives {number}", body + 1, key.key))
            }
            None => Ok(number),
        }
    }

    /// The number of a body in a column; none where the value is missing.
    fn cell(&self, key: &KeyColumn, body: usize, column: usize) -> Result<Option<f64>, String> {
        let text = self.table.columns[column][body].as_str();
        if self.is_missing(text) {
            return Ok(None);
        }
        key.number(text).filter(|number| number.is_finite()).map(Some).ok_or_else(|| {
            self.at(body, column, &format!("{:?} is not a finite number", Excerpt::from(text)))
        })
    }

    /// The value that a row draws about that of the table. One that is positive stays so.
    fn spread_value(
        &self,
        key: &KeyColumn,
        body: usize,
        spread: usize,
        mean: f64,
        u: f64,
    ) -> Result<f64, String> {
        let Spread { sigma, .. } = self.spreads[spread];
        match self.cell(key, body, sigma)? {
            Some(deviation) if deviation < 0.0 => {
                Err(self.at(body, sigma, &format!("{deviation} is no standard deviation")))
            }
            Some(deviation) if deviation > 0.0 => {
                let range = [if mean > 0.0 { 0.0 } else { f64::NEG_INFINITY }, f64::INFINITY];
                Ok(quantile(&Distribution::Normal { mean, deviation, range }, u))
            }
            _ => Ok(mean),
        }
    }

    /// The default of a key, for a body without a value.
    fn default(&self, key: &KeyColumn, body: usize) -> Result<KeyValue, String> {
        if let Some(default) = key.default() {
            return Ok(default);
        }
        let columns = key.columns();
        let lacking = columns.iter().find(|column| self.is_missing(&self.table.columns[**column][body]));
        let column = lacking.copied().unwrap_or_default();
        Err(match self.table.columns[column][body].as_str() {
            "" => {
                let name = self.table.names.get(column).map_or("", String::as_str);
                let name = if let Source::Column(_) = key.source { &key.name } else { name };
                format!("row {} of the table has no value in the column {name:?}", body + 1)
            }
            text => self.at(body, column, &format!("{:?} is not a finite number", Excerpt::from(text))),
        })
    }

    /// A problem of a cell, with its place.
    fn at(&self, body: usize, column: usize, problem: &str) -> String {
        let name = self.keys.iter().find(|key| matches!(key.source, Source::Column(own) if own == column));
        let name = name.map_or(&self.table.names[column], |key| &key.name);
        format!("row {} of the table, column {name:?}: {problem}", body + 1)
    }

    /// Cells of a body in a row as the results list them: keys, then columns carried through.
    pub(super) fn cells(&self, body: usize, draw: Draw<'_>) -> Vec<Cell> {
        let text = |column: usize| self.table.columns[column][body].as_str();
        let of_key = |key: &KeyColumn| match (key.kind, &key.source) {
            (CellKind::Number, _) => self
                .number(key, body, Some(draw))
                .ok()
                .flatten()
                .or_else(|| key.default_number())
                .map_or(Cell::Missing, Cell::Number),
            (_, Source::Column(column)) => match text(*column) {
                "" => Cell::Missing,
                text => Cell::Text(text.to_owned()),
            },
            (_, Source::Formula(..)) => Cell::Missing,
        };
        let of_kept = |(_, column): &(String, usize)| match text(*column) {
            "" => Cell::Missing,
            text => Cell::Text(text.to_owned()),
        };
        self.keys.iter().map(of_key).chain(self.kept.iter().map(of_kept)).collect()
    }
}

impl KeyColumn {
    /// Columns that the value is taken from.
    fn columns(&self) -> &[usize] {
        match &self.source {
            Source::Column(column) => std::slice::from_ref(column),
            Source::Formula(_, columns) => columns,
        }
    }

    /// The number in a text, without the marks around it.
    fn number(&self, text: &str) -> Option<f64> {
        let mut text = text.trim();
        while let Some(rest) = self
            .marks
            .iter()
            .filter(|mark| !mark.is_empty())
            .find_map(|mark| text.strip_prefix(mark.as_str()).or(text.strip_suffix(mark.as_str())))
        {
            text = rest.trim();
        }
        text.parse().ok()
    }

    /// A number with the unit of the key.
    fn measured(&self, number: f64) -> KeyValue {
        match &self.unit {
            Some(unit) => KeyValue::Text(format!("{number:?} {unit}")),
            None => number.into(),
        }
    }

    /// The default as the model takes it: a plain number is in the unit of the key.
    fn default(&self) -> Option<KeyValue> {
        Some(match self.default.as_ref()? {
            KeyValue::Number(number) => self.measured(*number),
            KeyValue::Integer(integer) if self.unit.is_some() => self.measured(*integer as f64),
            other => other.clone(),
        })
    }

    /// The default as a number in the unit of the key.
    fn default_number(&self) -> Option<f64> {
        match self.default.as_ref()? {
            KeyValue::Number(number) => Some(*number),
            KeyValue::Integer(integer) => Some(*integer as f64),
            KeyValue::Text(text) => number_in(text, self.unit.as_deref()?),
            _ => None,
        }
    }
}

/// Columns that a note lists.
const LISTED: usize = 20;

fn file_name(source: &TableSource) -> String {
    source.file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The key that a name of a column is, with a unit behind it or without.
fn key_named(name: &str) -> Option<KeyPath> {
    name.parse().ok().or_else(|| bracketed_name(name)?.parse().ok())
}

/// Whether two units are the same: a number in one is that number in the other.
fn same_unit(a: &str, b: &str) -> bool {
    a == b || number_in(&format!("1 {a}"), b) == Some(1.0)
}

fn no_column(study: &StudyFile, table: &BodyTable, name: &str, span: &std::ops::Range<usize>) -> SweepError {
    let message = format!("the table has no column {name:?}");
    let names: Vec<String> =
        table.names.iter().map(|name| Excerpt::from(name.as_str()).to_string()).collect();
    let help = format!("its columns are {}", names.join(", "));
    SweepError::File(study.refuse(span.clone(), message, "no such column", Some(help)))
}

/// A key that a study names and the model does not have, at its place in the study.
pub(super) fn nowhere(study: &StudyFile, span: std::ops::Range<usize>, error: &ChangeError) -> SweepError {
    SweepError::File(study.refuse(span, format!("the model has no such key: {error}"), "no such key", None))
}

/// A table that has nothing of what is asked. It may be any file, so that none of it is quoted.
fn no_table(study: &StudyFile, source: &TableSource, asked: Vec<&str>) -> SweepError {
    let message =
        "the first line of the table names no column that the study asks for, and no key of the model";
    let help = match asked.as_slice() {
        [] => "name the keys of its columns with columns = { .. }, or give another file".to_owned(),
        names => format!("the study asks for {}; is this the right file?", names.join(", ")),
    };
    SweepError::File(study.refuse(source.span.clone(), message.to_owned(), "this table", Some(help)))
}

fn located(study: &StudyFile, source: &TableSource, error: &TableError) -> SweepError {
    SweepError::File(study.refuse(source.span.clone(), error.to_string(), "this table", None))
}

fn unknown(study: &StudyFile, source: &TableSource, name: &str, error: &ChangeError) -> SweepError {
    let message = format!("the column {name:?} of the table is no key of the model: {error}");
    let help = format!(
        "name its key with columns = {{ {name:?} = \"carrier.mass\" }}, or carry it through unread with keep = [{name:?}]"
    );
    let refused: ModelError = study.refuse(source.span.clone(), message, "this table", Some(help));
    SweepError::File(refused)
}
