//! `[columns]` of a study: which column of the table, or which formula in several, gives a key of the model.

use std::ops::Range;

use quasirigid_math::expression::Expression;

use super::table::unit;
use crate::model::key::{Keys, Shape, TEXT, any, key, list, of};
use crate::model::value::Value;
use crate::model::{KeyPath, KeyValue};

pub(super) const COLUMN: Keys = Keys {
    known: &[
        key("name", TEXT, "of the column"),
        key("formula", TEXT, "instead, of the numbers in several columns"),
        key("unit", TEXT.or("that of the column, or SI"), "of the number"),
        key("default", of(Shape::Value).or("the row is lost"), "where there is no value, in the unit"),
        key(
            "sigma",
            any(&[Shape::Text, Shape::Named(&Shape::Text)]).or("none"),
            "column with the standard deviation, in the same unit; of a formula `{ P = \"P_err\" }`, for each column",
        ),
        key("marks", list(&Shape::Text).or("none"), "taken away around the number, such as `*` and `:`"),
    ],
};

/// Key of the model with the columns that give it.
#[derive(Clone, Debug, PartialEq)]
pub struct KeySource {
    /// The key.
    pub key: KeyPath,
    /// Column or formula.
    pub source: ColumnSource,
    /// Unit of the number; none for that of the column, or plain numbers.
    pub unit: Option<String>,
    /// Value where the table has none.
    pub default: Option<KeyValue>,
    /// Columns, each with that of its standard deviation.
    pub sigma: Vec<(String, String)>,
    /// Texts that are taken away around the number.
    pub marks: Vec<String>,
    /// Place in the study.
    pub span: Range<usize>,
}

/// Source of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ColumnSource {
    /// The column of this name.
    Column(String),
    /// A formula, with the names of its columns in the order of its variables.
    Formula(Box<Expression>, Vec<String>),
}

/// Reads `[columns]`, in the order of the file.
pub(super) fn columns(value: &Value<'_>) -> Option<Vec<KeySource>> {
    let Some(entries) = value.entries() else {
        return value.mismatch("a table", "write a line for each key of the model");
    };
    let mut entries: Vec<_> = entries.collect();
    entries.sort_by_key(|(span, _)| span.start);
    let read: Vec<Option<KeySource>> =
        entries.iter().map(|(span, value)| column(span.clone(), value)).collect();
    read.into_iter().collect()
}

fn column(span: Range<usize>, value: &Value<'_>) -> Option<KeySource> {
    let key = match value.key().parse::<KeyPath>() {
        Ok(key) => key,
        Err(error) => {
            let help = "write the path of a key in quotes, such as \"ellipsoid.1.diameter\"";
            return value.refuse_at(span, error.to_string(), "not a path", help);
        }
    };
    if !value.is_table() {
        let source = ColumnSource::Column(value.text()?.to_owned());
        return Some(KeySource {
            key,
            source,
            unit: None,
            default: None,
            sigma: Vec::new(),
            marks: Vec::new(),
            span: value.span(),
        });
    }
    let table = value.table("the columns of a key", &COLUMN)?;
    let text = |value: Value<'_>| value.text().map(str::to_owned);
    let source = match (table.get("name"), table.get("formula")) {
        (Some(_), Some(both)) => {
            return both.refuse("`name` and `formula` both give the value", "given twice", "leave one out");
        }
        (_, Some(formula)) => of_formula(&formula)?,
        _ => ColumnSource::Column(table.read("name", "name = \"P\"", text)?),
    };
    let unit = table.get("unit").map_or(Some(None), |value| unit(&value).map(Some));
    let default = table.get("default").map_or(Some(None), |value| value.given().map(Some));
    let sigma = table.get("sigma").map_or(Some(Vec::new()), |value| sigma(&value, &source));
    let marks = table.read_or("marks", Vec::new(), |value| value.list("a list of texts", text));
    Some(KeySource {
        key,
        source,
        unit: unit?,
        default: default?,
        sigma: sigma?,
        marks: marks?,
        span: value.span(),
    })
}

/// Reads the columns with standard deviations: one of a column, named ones of the columns of a formula.
fn sigma(value: &Value<'_>, source: &ColumnSource) -> Option<Vec<(String, String)>> {
    match (source, value.entries()) {
        (ColumnSource::Column(name), None) => Some(vec![(name.clone(), value.text()?.to_owned())]),
        (ColumnSource::Formula(_, names), Some(entries)) => {
            let pair = |(span, value): (Range<usize>, Value<'_>)| {
                if !names.iter().any(|name| name == value.key()) {
                    let message = format!("the formula has no column {:?}", value.key());
                    return value.refuse_at(
                        span,
                        message,
                        "not in the formula",
                        format!("it has {}", names.join(", ")),
                    );
                }
                Some((value.key().to_owned(), value.text()?.to_owned()))
            };
            entries.map(pair).collect::<Vec<_>>().into_iter().collect()
        }
        (ColumnSource::Column(_), Some(_)) => {
            value.mismatch("the name of a column", "write sigma = \"P_err\"")
        }
        (ColumnSource::Formula(..), None) => value.mismatch(
            "a table",
            "of a formula each column has its own standard deviation: write sigma = { P = \"P_err\" }",
        ),
    }
}

/// Reads a formula in columns. A name that is no word of a formula stands between backticks.
fn of_formula(value: &Value<'_>) -> Option<ColumnSource> {
    let (text, names) = variables(value.text()?);
    let words: Vec<String> = (0..names.len()).map(|place| format!("v{place}_")).collect();
    match Expression::parse(&text, &words.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(formula) => Some(ColumnSource::Formula(Box::new(formula), names)),
        Err(error) => {
            let message = format!("`formula`: {}", error.message);
            let help = "write a formula in names of columns, such as 1329/sqrt(pV)*10^(-H/5); names with other signs \
                        than letters and digits stand between backticks: `a/b`";
            value.refuse(message, "in this formula", help)
        }
    }
}

/// A formula with its columns replaced by variables of their own, and the names of the columns.
fn variables(text: &str) -> (String, Vec<String>) {
    let (mut out, mut names, mut rest) = (String::new(), Vec::<String>::new(), text);
    let variable = |names: &mut Vec<String>, name: &str| {
        let place = names.iter().position(|known| known == name).unwrap_or_else(|| {
            names.push(name.to_owned());
            names.len() - 1
        });
        format!("v{place}_")
    };
    while let Some(letter) = rest.chars().next() {
        let word = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
        let digits = rest.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(rest.len());
        if let Some((name, behind)) = rest.strip_prefix('`').and_then(|rest| rest.split_once('`')) {
            out += &variable(&mut names, name);
            rest = behind;
        } else if digits > 0 {
            // a number, with its exponent
            let exponent =
                rest[digits..].strip_prefix(['e', 'E']).map(|tail| tail.trim_start_matches(['+', '-']));
            let tail = match exponent.filter(|tail| tail.starts_with(|c: char| c.is_ascii_digit())) {
                Some(tail) => tail.trim_start_matches(|c: char| c.is_ascii_digit()),
                None => &rest[digits..],
            };
            out += &rest[..rest.len() - tail.len()];
            rest = tail;
        } else if word > 0 {
            let (name, behind) = rest.split_at(word);
            let calls = behind.trim_start().starts_with('(');
            out += &if calls || name == "pi" { name.to_owned() } else { variable(&mut names, name) };
            rest = behind;
        } else {
            out.push(letter);
            rest = &rest[letter.len_utf8()..];
        }
    }
    (out, names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_a_formula_are_columns() {
        let (text, names) = variables("1329e0/sqrt(pV)*10^(-H/5)*`a/b` + pV + 2.5E-3*pi");
        assert_eq!(text, "1329e0/sqrt(v0_)*10^(-v1_/5)*v2_ + v0_ + 2.5E-3*pi");
        assert_eq!(names, ["pV", "H", "a/b"]);
    }
}
