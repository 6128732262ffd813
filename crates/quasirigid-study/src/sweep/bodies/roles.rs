//! Roles of the columns of a table: those that `[columns]` of the study gives, or those of their names.

use std::ops::Range;

use quasirigid_io::model::{ChangeError, KeyPath, ModelError, Template};
use quasirigid_io::study_file::{ColumnSource, KeySource, StudyFile, TableColumn, TableSource};
use quasirigid_io::table_file::{BodyTable, CellKind, bracketed_name, unit_ending};
use quasirigid_io::units::number_in;
use quasirigid_io::visible::Excerpt;

use super::{Bodies, KeyColumn, Source, Spread, file_name, nowhere};
use crate::sweep::SweepError;

/// Columns that a note lists.
const LISTED: usize = 20;

impl Bodies {
    /// Takes the roles from `[columns]` of the study; columns that it does not name are left out, and told.
    pub(super) fn mapped(
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
    pub(super) fn named(
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
        span: &Range<usize>,
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
        span: &Range<usize>,
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
}

/// The key that a name of a column is, with a unit behind it or without.
fn key_named(name: &str) -> Option<KeyPath> {
    name.parse().ok().or_else(|| bracketed_name(name)?.parse().ok())
}

/// Whether two units are the same: a number in one is that number in the other.
fn same_unit(a: &str, b: &str) -> bool {
    a == b || number_in(&format!("1 {a}"), b) == Some(1.0)
}

fn no_column(study: &StudyFile, table: &BodyTable, name: &str, span: &Range<usize>) -> SweepError {
    let message = format!("the table has no column {name:?}");
    let names: Vec<String> =
        table.names.iter().map(|name| Excerpt::from(name.as_str()).to_string()).collect();
    let help = format!("its columns are {}", names.join(", "));
    SweepError::File(study.refuse(span.clone(), message, "no such column", Some(help)))
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

fn unknown(study: &StudyFile, source: &TableSource, name: &str, error: &ChangeError) -> SweepError {
    let message = format!("the column {name:?} of the table is no key of the model: {error}");
    let help = format!(
        "name its key with columns = {{ {name:?} = \"carrier.mass\" }}, or carry it through unread with keep = [{name:?}]"
    );
    let refused: ModelError = study.refuse(source.span.clone(), message, "this table", Some(help));
    SweepError::File(refused)
}
