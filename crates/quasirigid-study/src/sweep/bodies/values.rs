//! Values that a row of a study takes from a body of its table.

use quasirigid_io::model::{KeyPath, KeyValue};
use quasirigid_io::study_file::Distribution;
use quasirigid_io::table_file::CellKind;
use quasirigid_io::units::number_in;
use quasirigid_io::visible::Excerpt;

use super::{Bodies, Draw, KeyColumn, Source, Spread};
use crate::sweep::cell::Cell;
use crate::sweep::distribution::quantile;

impl Bodies {
    /// The values of a body in a row, or why it has none.
    pub(in crate::sweep) fn changes(
        &self,
        body: usize,
        draw: Draw<'_>,
    ) -> Result<Vec<(KeyPath, KeyValue)>, String> {
        if let Some(reason) = self.table.unread.get(&body) {
            return Err(reason.clone());
        }
        self.keys.iter().map(|key| Ok((key.key.clone(), self.given(key, body, Some(draw))?))).collect()
    }

    /// The value that a body gives to a key; without a number to draw from, that of the table itself.
    pub(in crate::sweep) fn given(
        &self,
        key: &KeyColumn,
        body: usize,
        draw: Option<Draw<'_>>,
    ) -> Result<KeyValue, String> {
        let of_number = || match self.number(key, body, draw)? {
            Some(number) => Ok(key.measured(number)),
            None => self.default(key, body),
        };
        let Source::Column(column) = key.source else { return of_number() };
        let text = self.table.columns[column][body].as_str();
        let is_name = key.key.key() == "name";
        if text.is_empty() || !is_name && self.is_missing(text) {
            return self.default(key, body);
        }
        if is_name && key.unit.is_none() {
            return Ok(text.into());
        }
        if key.unit.is_some() || !key.spreads.is_empty() || !key.marks.is_empty() {
            return of_number();
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
    pub(in crate::sweep) fn cells(&self, body: usize, draw: Draw<'_>) -> Vec<Cell> {
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
    pub(super) fn columns(&self) -> &[usize] {
        match &self.source {
            Source::Column(column) => std::slice::from_ref(column),
            Source::Formula(_, columns) => columns,
        }
    }

    /// The number in a text, without the marks around it.
    pub(super) fn number(&self, text: &str) -> Option<f64> {
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
    pub(super) fn default(&self) -> Option<KeyValue> {
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
