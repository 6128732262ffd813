//! Tables with checked keys: an unknown key is reported with the nearest known one.
//! A key that is probably misspelt is not reported as missing too, so that one mistake gives one message.

use std::ops::Range;

use toml::de::DeTable;

use super::Diagnostic;
use super::diagnostic::Problems;
use super::key::Keys;
use super::spans::ElementSpans;
use super::value::Value;
use crate::nearest::nearest;
use crate::units::Dimension;

/// A table of the file whose keys have been checked.
pub(crate) struct Table<'a> {
    title: &'static str,
    header: Range<usize>,
    entries: &'a DeTable<'a>,
    /// Known keys that the table probably has, misspelt.
    misspelt: Vec<&'static str>,
    keys: &'static Keys,
    problems: &'a Problems<'a>,
}

impl<'a> Table<'a> {
    /// Reports every key that is not one of `keys`; `others` names the kinds of table that such a key is for.
    pub(crate) fn new(
        title: &'static str,
        header: Range<usize>,
        entries: &'a DeTable<'a>,
        keys: &'static Keys,
        others: &dyn Fn(&str) -> Option<String>,
        problems: &'a Problems<'a>,
    ) -> Self {
        problems.opened(header.clone(), keys);
        let mut misspelt = Vec::new();
        for key in entries.keys().filter(|key| !keys.has(key.get_ref())) {
            if problems.full() {
                break;
            }
            if let Some(today) = renamed(key.get_ref(), keys, TAKEN) {
                if entries.contains_key(today) {
                    problems.report(given_twice(key.get_ref(), key.span(), today));
                } else {
                    problems.renamed(
                        key.span(),
                        &format!("`{}` in {title}", key.get_ref()),
                        &format!("`{today}`"),
                    );
                }
                continue;
            }
            if let Some(kinds) = others(key.get_ref()) {
                problems.report(foreign_key(title, key.get_ref(), key.span(), keys, &kinds));
                continue;
            }
            let meant = renamed(key.get_ref(), keys, FORMER).or_else(|| nearest(key.get_ref(), keys.names()));
            problems.report(unknown_key(title, key.get_ref(), key.span(), keys, meant));
            misspelt.extend(meant);
        }
        Self { title, header, entries, misspelt, keys, problems }
    }

    /// Span of the start of the table.
    pub(crate) fn header(&self) -> Range<usize> {
        self.header.clone()
    }

    /// Places of the values of the table.
    pub(crate) fn spans(&self) -> ElementSpans {
        let values = self.keys.names().filter_map(|key| Some((key, self.get(key)?.span()))).collect();
        ElementSpans { header: self.header(), values }
    }

    /// The value of a key, if the table has it.
    pub(crate) fn get(&self, key: &'static str) -> Option<Value<'a>> {
        let (key, value) = match (self.entries.get(key), TAKEN.iter().find(|(_, today)| *today == key)) {
            (Some(value), _) => (key, value),
            (None, Some((former, _))) => (*former, self.entries.get(*former)?),
            (None, None) => return None,
        };
        Some(Value::new(key, value, self.problems))
    }

    /// The value of a key that must be there; a table without it is told to add a line such as `example`.
    pub(crate) fn required(&self, key: &'static str, example: &str) -> Option<Value<'a>> {
        let value = self.get(key);
        if value.is_none() && !self.misspelt.contains(&key) {
            let message = format!("{} has no `{key}`", self.title);
            let label = format!("`{key}` is missing here");
            let help = format!("add a line such as: {example}");
            self.problems.report(Diagnostic::new(self.header(), message, label).help(help));
        }
        value
    }

    /// The value of a key that must be there, read.
    pub(crate) fn read<T>(
        &self,
        key: &'static str,
        example: &str,
        read: impl FnOnce(Value<'a>) -> Option<T>,
    ) -> Option<T> {
        self.required(key, example).and_then(read)
    }

    /// The value of a key, read, or a usual one if the key is absent.
    pub(crate) fn read_or<T>(
        &self,
        key: &'static str,
        usual: T,
        read: impl FnOnce(Value<'a>) -> Option<T>,
    ) -> Option<T> {
        self.get(key).map_or(Some(usual), read)
    }

    /// Three quantities, zero if the key is absent.
    pub(crate) fn vector_or_zero(&self, key: &'static str, dimension: Dimension) -> Option<[f64; 3]> {
        self.read_or(key, [0.0; 3], |value| value.vector(dimension))
    }

    /// The table under a key that stands once, as in `[carrier]`.
    pub(crate) fn table(
        &self,
        key: &'static str,
        title: &'static str,
        keys: &'static Keys,
    ) -> Option<Table<'a>> {
        self.single(key, title)?.table(title, keys)
    }

    /// The value under a key that stands once.
    pub(crate) fn single(&self, key: &'static str, title: &'static str) -> Option<Value<'a>> {
        let value = self.get(key)?;
        if value.is_array() {
            let message = format!("there is one {title}, not a list of them");
            let help = format!("write {title} once, with single brackets");
            self.problems.report(Diagnostic::new(value.span(), message, "a list").help(help));
            return None;
        }
        Some(value)
    }

    /// The values under a key that can stand any number of times.
    pub(crate) fn several(&self, key: &'static str, title: &'static str) -> Vec<Value<'a>> {
        let Some(value) = self.get(key) else {
            return Vec::new();
        };
        let Some(items) = value.items() else {
            let message = format!("`{key}` is a list of tables, but {} stands here", value.found());
            let help = format!("write {title}, with double brackets, once for each");
            self.problems.report(Diagnostic::new(value.span(), message, "not a list of tables").help(help));
            return Vec::new();
        };
        items
    }

    /// The named tables under a key, as in `[material.rock]`; `help` shows one.
    pub(crate) fn named(&self, key: &'static str, help: &str) -> Vec<Value<'a>> {
        let Some(value) = self.get(key) else { return Vec::new() };
        let Some(named) = value.entries() else {
            value.mismatch::<()>(&format!("a table for each {key}"), help);
            return Vec::new();
        };
        let table = |(_, value): (_, Value<'a>)| {
            if value.is_table() {
                return Some(value);
            }
            value.mismatch(&format!("a table with the name of a {key}"), help)
        };
        named.filter_map(table).collect()
    }
}

/// Keys of earlier versions, with those of today.
const FORMER: &[(&str, &str)] = &[("freedoms", "dofs")];

/// Keys of the version before, which this one still takes, with those of today.
const TAKEN: &[(&str, &str)] =
    &[("manifold", "spin_manifold"), ("method", "integrator"), ("rotations", "revolutions")];

/// The present name of a former key, if the table has such a key.
fn renamed(key: &str, keys: &Keys, names: &'static [(&str, &str)]) -> Option<&'static str> {
    let (_, now) = names.iter().find(|(former, now)| *former == key && keys.has(now))?;
    Some(now)
}

/// The name that a key had in the version before, or its own.
pub(super) fn former(key: &'static str) -> &'static str {
    TAKEN.iter().find(|(_, today)| *today == key).map_or(key, |(former, _)| former)
}

fn given_twice(former: &str, span: Range<usize>, today: &str) -> Diagnostic {
    let message = format!("`{former}` is the former name of `{today}`, which is there too");
    Diagnostic::new(span, message, "given twice").help(format!("leave `{former}` out"))
}

fn foreign_key(title: &str, key: &str, span: Range<usize>, keys: &Keys, kinds: &str) -> Diagnostic {
    let message = format!("`{key}` is not a key of {title}");
    let help = format!("it is for {kinds}; the keys here are {}", listed(keys));
    Diagnostic::new(span, message, "not for this kind").help(help)
}

fn unknown_key(title: &str, key: &str, span: Range<usize>, keys: &Keys, meant: Option<&str>) -> Diagnostic {
    let message = format!("unknown key {key:?} in {title}");
    let list = format!("the keys are {}", listed(keys));
    let help = match meant {
        Some(known) => format!("did you mean `{known}`? {list}"),
        None => list,
    };
    Diagnostic::new(span, message, "unknown key").help(help)
}

fn listed(keys: &Keys) -> String {
    keys.names().collect::<Vec<_>>().join(", ")
}
