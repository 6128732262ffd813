//! Table of a study: which column gives which key of the model, and the value that a row gives.
//! A cell that cannot be read spoils its row and no other.

use quasirigid_io::model::{ChangeError, KeyPath, KeyValue, ModelError, Template};
use quasirigid_io::study_file::{StudyFile, TableColumn, TableSource};
use quasirigid_io::table_file::{BodyTable, CellKind, TableError, read_bodies};
use quasirigid_io::visible::Excerpt;

use super::SweepError;
use super::cell::Cell;

/// Table of bodies with the roles of its columns.
#[derive(Clone, Debug)]
pub(super) struct Bodies {
    table: BodyTable,
    /// Columns that give keys.
    pub(super) keys: Vec<KeyColumn>,
    /// Columns that are carried through: name and number.
    pub(super) kept: Vec<(String, usize)>,
}

/// Column that gives a key of the model.
#[derive(Clone, Debug)]
pub(super) struct KeyColumn {
    pub(super) name: String,
    pub(super) key: KeyPath,
    pub(super) unit: Option<String>,
    /// Kind of the values, by the majority.
    pub(super) kind: CellKind,
    column: usize,
}

impl Bodies {
    /// Reads the table of a study and finds the role of each column.
    pub(super) fn read(
        study: &StudyFile,
        source: &TableSource,
        template: &Template,
    ) -> Result<Self, SweepError> {
        let table = read_bodies(&source.file).map_err(|error| located(study, source, &error))?;
        let asked =
            source.columns.iter().map(|column| &column.name).chain(source.keep.iter().map(|(name, _)| name));
        let is_key = |name: &String| {
            name.contains('.') && name.parse::<KeyPath>().is_ok_and(|key| template.find(&key).is_ok())
        };
        if !(asked.clone().any(|name| table.names.contains(name)) || table.names.iter().any(is_key)) {
            return Err(no_table(study, source, asked.map(String::as_str).collect()));
        }
        let missing = |name: &str, span: &std::ops::Range<usize>| {
            let message = format!("the table has no column {name:?}");
            let names: Vec<String> =
                table.names.iter().map(|name| Excerpt::from(name.as_str()).to_string()).collect();
            let help = format!("its columns are {}", names.join(", "));
            SweepError::File(study.refuse(span.clone(), message, "no such column", Some(help)))
        };
        for (name, span) in source
            .columns
            .iter()
            .map(|column| (&column.name, &column.span))
            .chain(source.keep.iter().map(|(name, span)| (name, span)))
        {
            if !table.names.contains(name) {
                return Err(missing(name, span));
            }
        }
        let (mut keys, mut kept) = (Vec::new(), Vec::new());
        for (column, name) in table.names.iter().enumerate() {
            if let Some(TableColumn { key, unit, span, .. }) =
                source.columns.iter().find(|each| each.name == *name)
            {
                template.find(key).map_err(|error| nowhere(study, span.clone(), &error))?;
                keys.push(KeyColumn {
                    name: name.clone(),
                    key: key.clone(),
                    unit: unit.clone(),
                    kind: CellKind::Text,
                    column,
                });
            } else if source.keep.iter().any(|(each, _)| each == name) {
                kept.push((name.clone(), column));
            } else if !table.columns[column].iter().all(String::is_empty) {
                let key = name.parse::<KeyPath>().and_then(|key| template.find(&key).map(|_| key));
                let key = key.map_err(|error| unknown(study, source, name, &error))?;
                keys.push(KeyColumn { name: name.clone(), key, unit: None, kind: CellKind::Text, column });
            }
        }
        for key in &mut keys {
            let numbers = table.columns[key.column].iter().filter(|text| text.parse::<f64>().is_ok()).count();
            let named = key.unit.is_none() && key.key.key() == "name";
            if !named && 2 * numbers > table.rows() {
                key.kind = CellKind::Number;
            }
        }
        Ok(Self { table, keys, kept })
    }

    /// Cells that give keys of the model and are no numbers: names, and files.
    pub(super) fn texts(&self) -> impl Iterator<Item = &str> {
        let named = self.keys.iter().filter(|key| key.kind == CellKind::Text);
        named.flat_map(|key| self.table.columns[key.column].iter().map(String::as_str))
    }

    /// Number of bodies.
    pub(super) fn rows(&self) -> u64 {
        self.table.rows() as u64
    }

    /// The values of a body, or why it has none.
    pub(super) fn changes(&self, body: usize) -> Result<Vec<(KeyPath, KeyValue)>, String> {
        if let Some(reason) = self.table.unread.get(&body) {
            return Err(reason.clone());
        }
        self.keys.iter().map(|key| Ok((key.key.clone(), self.given(key, body)?))).collect()
    }

    /// The value that a body gives to a key.
    pub(super) fn given(&self, key: &KeyColumn, body: usize) -> Result<KeyValue, String> {
        let text = self.table.columns[key.column][body].as_str();
        let name = &key.name;
        if text.is_empty() {
            return Err(format!("row {} of the table has no value in the column {name:?}", body + 1));
        }
        if let Some(unit) = &key.unit {
            return match text.parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(KeyValue::Text(format!("{text} {unit}"))),
                _ => Err(format!(
                    "row {} of the table, column {name:?}: {:?} is not a finite number",
                    body + 1,
                    Excerpt::from(text)
                )),
            };
        }
        if key.key.key() == "name" {
            return Ok(text.into());
        }
        Ok(match (text.parse::<i64>(), text.parse::<f64>(), text) {
            (Ok(integer), _, _) => integer.into(),
            (_, Ok(number), _) => number.into(),
            (_, _, "true") => true.into(),
            (_, _, "false") => false.into(),
            _ => text.into(),
        })
    }

    /// Cells of a body as the results list them: keys, then columns carried through.
    pub(super) fn cells(&self, body: usize) -> Vec<Cell> {
        let text = |column: usize| self.table.columns[column][body].as_str();
        let of_key = |key: &KeyColumn| match (key.kind, text(key.column)) {
            (_, "") => Cell::Missing,
            (CellKind::Number, text) => text.parse().map_or(Cell::Missing, Cell::Number),
            (_, text) => Cell::Text(text.to_owned()),
        };
        let of_kept = |(_, column): &(String, usize)| match text(*column) {
            "" => Cell::Missing,
            text => Cell::Text(text.to_owned()),
        };
        self.keys.iter().map(of_key).chain(self.kept.iter().map(of_kept)).collect()
    }
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
