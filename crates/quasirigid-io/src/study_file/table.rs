use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::model::KeyPath;
use crate::model::key::{Keys, Shape, TEXT, key, list, named};
use crate::model::value::Value;
use crate::units::Measure;

pub(super) const TABLE: Keys = Keys {
    known: &[
        key("file", TEXT, "text, VOTable, Parquet or XLSX"),
        key(
            "columns",
            named(&Shape::Any(&[Shape::Text, Shape::Table(&COLUMN)])).or("named like keys"),
            "key of each column",
        ),
        key("keep", list(&Shape::Text).or("none"), "columns carried through unread"),
        key("missing", list(&Shape::Text).or("none"), "texts for no value, beside `-`, `NaN` and `null`"),
    ],
};
const COLUMN: Keys =
    Keys { known: &[key("key", TEXT, "path"), key("unit", TEXT.or("SI"), "of plain numbers")] };

/// Table of bodies, a row each.
#[derive(Clone, Debug, PartialEq)]
pub struct TableSource {
    /// The file, CSV or Parquet.
    pub file: PathBuf,
    /// Place of its name in the study.
    pub span: Range<usize>,
    /// Columns that are keys of the model under another name, or in another unit.
    pub columns: Vec<TableColumn>,
    /// Columns that are carried through unread, each with its place in the study.
    pub keep: Vec<(String, Range<usize>)>,
    /// Texts that stand for no value.
    pub missing: Vec<String>,
}

/// Column of a table that gives a key of the model.
#[derive(Clone, Debug, PartialEq)]
pub struct TableColumn {
    /// Name of the column.
    pub name: String,
    /// Key of the model.
    pub key: KeyPath,
    /// Unit of its numbers; none for plain ones and for texts.
    pub unit: Option<String>,
    /// Place in the study.
    pub span: Range<usize>,
}

/// Reads `[table]`.
pub(super) fn table(value: &Value<'_>, folder: &Path) -> Option<TableSource> {
    let table = value.table("[table]", &TABLE)?;
    let file = table.required("file", "file = \"bodies.csv\"");
    let columns = match table.get("columns") {
        None => Some(Vec::new()),
        Some(columns) => match columns.entries() {
            None => columns.mismatch(
                "a table",
                "write { \"a_km\" = { key = \"ellipsoid.1.semi_axes.1\", unit = \"km\" } }",
            ),
            Some(entries) => {
                entries.map(|(_, value)| column(&value)).collect::<Vec<_>>().into_iter().collect()
            }
        },
    };
    let keep = match table.get("keep") {
        None => Some(Vec::new()),
        Some(keep) => {
            keep.list("a list of names of columns", |name| Some((name.text()?.to_owned(), name.span())))
        }
    };
    let missing = table.read_or("missing", Vec::new(), |value| {
        value.list("a list of texts", |item| match item.words() {
            Some(text) => Some(text.trim().to_owned()),
            None => item.mismatch("a text", "write it in quotes as it stands in the table"),
        })
    });
    let file = file?;
    Some(TableSource {
        file: folder.join(file.text()?),
        span: file.span(),
        columns: columns?,
        keep: keep?,
        missing: missing?,
    })
}

fn column(value: &Value<'_>) -> Option<TableColumn> {
    let (key, unit) = if value.is_table() {
        let table = value.table("a column", &COLUMN)?;
        (table.required("key", "key = \"ellipsoid.1.semi_axes.1\"")?, table.get("unit"))
    } else {
        (*value, None)
    };
    let path = match key.text()?.parse::<KeyPath>() {
        Ok(path) => path,
        Err(error) => return key.refuse(error.to_string(), "not a path", ""),
    };
    let unit = match unit {
        None => None,
        Some(unit) => Some(self::unit(&unit)?),
    };
    Some(TableColumn { name: value.key().to_owned(), key: path, unit, span: value.span() })
}

/// Reads a unit.
pub(super) fn unit(value: &Value<'_>) -> Option<String> {
    let text = value.text()?;
    match Measure::parse(&format!("1 {text}")) {
        Ok(_) => Some(text.to_owned()),
        Err(error) => value.refuse(format!("`unit`: {error}"), "no unit", error.advice()),
    }
}
