//! Values of a model file after units and defaults: what the readers made of each key, for records that say what went in.
//! Readers note every number with its SI unit and every table with the keys that it may have; the tree of the file then gives each its path.

use std::collections::HashMap;
use std::ops::Range;

use serde_json::{Value as Json, json};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::Problems;
use super::initial::INITIAL;
use super::key::Keys;
use super::settings::RUN;
use super::syntax;
use super::table::former;
use crate::record::ValueRecord;

/// Most numbers and tables that are noted, and most values that are listed: a file with more has them in tables of points.
const MOST: usize = 4096;
/// Longest list whose numbers are listed.
const LONGEST: usize = 64;

/// Numbers and tables of a file as they were read.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct ValuesRead {
    numbers: Vec<(Range<usize>, f64, &'static str)>,
    tables: Vec<(Range<usize>, TableKeys)>,
}

/// Keys that a table may have; each list of them is one constant.
#[derive(Clone, Copy, Debug)]
struct TableKeys(&'static Keys);

impl PartialEq for TableKeys {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.0, other.0)
    }
}

impl ValuesRead {
    pub(super) fn measured(&mut self, span: Range<usize>, number: f64, unit: &'static str) {
        if self.numbers.len() < MOST {
            self.numbers.push((span, number, unit));
        }
    }

    pub(super) fn opened(&mut self, span: Range<usize>, keys: &'static Keys) {
        if self.tables.len() < MOST {
            self.tables.push((span, TableKeys(keys)));
        }
    }

    /// The values in the text that was read, and the number of those that are too many to be listed.
    pub(super) fn listed(&self, text: &str) -> (Vec<ValueRecord>, usize) {
        let Some(tree) = syntax::tree(text, &Problems::new(text)) else { return (Vec::new(), 0) };
        let place = |span: &Range<usize>| (span.start, span.end);
        let mut tables: HashMap<_, Vec<&'static Keys>> = HashMap::new();
        self.tables.iter().for_each(|(span, keys)| tables.entry(place(span)).or_default().push(keys.0));
        let numbers = self.numbers.iter().map(|(span, number, unit)| (place(span), (*number, *unit)));
        let mut list = Listing { numbers: numbers.collect(), tables, values: Vec::new(), left_out: 0 };
        list.table("", &tree, None);
        for (name, keys) in [("initial", &INITIAL), ("run", &RUN)] {
            if !tree.contains_key(name) {
                list.defaults(name, &DeTable::new(), keys);
            }
        }
        (list.values, list.left_out)
    }
}

/// Values in work.
struct Listing {
    numbers: HashMap<(usize, usize), (f64, &'static str)>,
    tables: HashMap<(usize, usize), Vec<&'static Keys>>,
    values: Vec<ValueRecord>,
    left_out: usize,
}

impl Listing {
    fn add(&mut self, key: String, value: Json, unit: &str, default: bool) {
        if self.values.len() < MOST {
            self.values.push(ValueRecord { key, value, unit: unit.to_owned(), default });
        } else {
            self.left_out += 1;
        }
    }

    fn table(&mut self, path: &str, entries: &DeTable<'_>, span: Option<Range<usize>>) {
        let mut sorted: Vec<_> = entries.iter().collect();
        sorted.sort_by_key(|(key, _)| key.span().start);
        for (key, value) in sorted {
            self.value(joined(path, key.get_ref()), value);
        }
        let Some(span) = span else { return };
        let known = self.tables.get(&(span.start, span.end)).into_iter().flatten();
        // a table that is only implied stands where its first child does
        let has = |keys: &&&Keys| {
            entries
                .keys()
                .all(|key| keys.names().any(|name| former(name) == key.get_ref() || name == key.get_ref()))
        };
        if let Some(keys) = known.filter(has).min_by_key(|keys| keys.known.len()).copied() {
            self.defaults(path, entries, keys);
        }
    }

    /// Adds the keys that a table leaves out and that have a default.
    fn defaults(&mut self, path: &str, entries: &DeTable<'_>, keys: &'static Keys) {
        let absent = |name: &'static str| !entries.contains_key(name) && !entries.contains_key(former(name));
        for key in keys.known.iter().filter(|key| absent(key.name)) {
            // names are given by number, and examples of them stand for their defaults
            if key.name != "name" && !matches!(key.form.default, "" | "none") {
                let value = of_words(key.form.default);
                let unit = if value.is_string() { "" } else { key.form.unit };
                self.add(joined(path, key.name), value, unit, true);
            }
        }
    }

    fn value(&mut self, path: String, value: &Spanned<DeValue<'_>>) {
        match value.get_ref() {
            DeValue::Table(entries) => self.table(&path, entries, Some(value.span())),
            DeValue::Array(items) if items.len() > LONGEST => {
                self.add(path, json!(format!("{} values", items.len())), "", false);
            }
            DeValue::Array(items) => match self.list(items) {
                Some((list, unit)) => self.add(path, list, unit, false),
                None => (1..).zip(items.iter()).for_each(|(i, item)| self.value(format!("{path}.{i}"), item)),
            },
            _ => {
                let (scalar, unit) = self.scalar(value);
                self.add(path, scalar, unit, false);
            }
        }
    }

    /// A list of scalars in one unit, as one value.
    fn list(&self, items: &[Spanned<DeValue<'_>>]) -> Option<(Json, &'static str)> {
        let compound = |item: &Spanned<DeValue<'_>>| item.get_ref().is_table() || item.get_ref().is_array();
        if items.iter().any(compound) {
            return None;
        }
        let read: Vec<_> = items.iter().map(|item| self.scalar(item)).collect();
        let unit = read.first().map_or("", |(_, unit)| unit);
        let uniform = read.iter().all(|(_, other)| *other == unit);
        uniform.then(|| (read.into_iter().map(|(scalar, _)| scalar).collect(), unit))
    }

    /// A number in its SI unit, or a value as it stands in the file.
    fn scalar(&self, value: &Spanned<DeValue<'_>>) -> (Json, &'static str) {
        let span = value.span();
        if let Some((number, unit)) = self.numbers.get(&(span.start, span.end)) {
            return (json!(number), unit);
        }
        let plain = match value.get_ref() {
            DeValue::Boolean(truth) => json!(truth),
            DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
                .map_or(json!(integer.to_string()), |i| json!(i)),
            DeValue::Float(float) => {
                float.as_str().parse::<f64>().map_or(json!(float.to_string()), |x| json!(x))
            }
            DeValue::String(text) => json!(text),
            DeValue::Datetime(date) => json!(date.to_string()),
            DeValue::Array(_) | DeValue::Table(_) => Json::Null,
        };
        (plain, "")
    }
}

/// A default as a value, where its words are one.
fn of_words(words: &str) -> Json {
    let plain = words.replace('`', "");
    serde_json::from_str(&plain).unwrap_or(Json::String(plain))
}

/// A path with one more segment, in quotes where it is no bare key.
fn joined(path: &str, key: &str) -> String {
    let bare = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_');
    let key = if !key.is_empty() && key.bytes().all(bare) { key.to_owned() } else { format!("{key:?}") };
    if path.is_empty() { key } else { format!("{path}.{key}") }
}
