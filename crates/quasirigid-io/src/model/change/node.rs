//! Steps of a path through the tree of a model text: tables by key, lists by name or number.
//! The editing library has two kinds of table and two of list, in headers and inline; here they are one each, with one wording of what is
//! missing.

use toml_edit::{Array, ArrayOfTables, Item, TableLike, Value};

use super::KeyContent;
use super::path::Segment;
use crate::nearest::nearest;

/// Most names that a message lists.
const LISTED: usize = 12;

/// A place in the tree of a model text.
pub(super) enum Node<'a> {
    Table(&'a mut dyn TableLike),
    Tables(&'a mut ArrayOfTables),
    List(&'a mut Array),
    Plain(&'a mut Value),
}

impl<'a> Node<'a> {
    fn of_item(item: &'a mut Item) -> Option<Self> {
        match item {
            Item::None => None,
            Item::Value(value) => Some(Self::of_value(value)),
            Item::Table(table) => Some(Self::Table(table)),
            Item::ArrayOfTables(tables) => Some(Self::Tables(tables)),
        }
    }

    fn of_value(value: &'a mut Value) -> Self {
        match value {
            Value::InlineTable(table) => Self::Table(table),
            Value::Array(list) => Self::List(list),
            plain => Self::Plain(plain),
        }
    }

    /// Kind of content.
    pub(super) fn found(self) -> KeyContent {
        if matches!(self, Self::Plain(_)) { KeyContent::Plain } else { KeyContent::Compound }
    }

    /// The entry that a segment names, if there is one.
    pub(super) fn get(self, segment: &Segment) -> Option<Self> {
        self.below(segment).ok()
    }

    /// The entry that a segment names, or what there is instead, in words.
    pub(super) fn below(self, segment: &Segment) -> Result<Self, String> {
        match self {
            Self::Table(table) => {
                let missing = missing_key(table, segment);
                table.get_mut(&segment.text).and_then(Self::of_item).ok_or(missing)
            }
            Self::Tables(tables) => {
                let index = entry(segment, &names_of_tables(tables))?;
                let count = tables.len();
                let table = tables.get_mut(index).map(|table| Self::Table(table));
                table.ok_or_else(|| no_number(segment, count))
            }
            Self::List(list) => {
                let index = entry(segment, &names_of_values(list))?;
                let count = list.len();
                list.get_mut(index).map(Self::of_value).ok_or_else(|| no_number(segment, count))
            }
            Self::Plain(value) => Err(below_plain(value, segment)),
        }
    }

    /// Puts a value in the place that a segment names. A table or a list is replaced only by one of these.
    pub(super) fn put(&mut self, segment: &Segment, value: Value, compound: bool) -> Result<(), String> {
        match self {
            Self::Table(table) => put_in_table(*table, segment, value, compound),
            Self::List(list) => {
                let (index, count) = (entry(segment, &names_of_values(list))?, list.len());
                let old = list.get_mut(index).ok_or_else(|| no_number(segment, count))?;
                replace(old, value);
                Ok(())
            }
            Self::Tables(tables) => {
                entry(segment, &names_of_tables(tables))?;
                Err(format!("`{}` is a table; name one of its keys", segment.text))
            }
            Self::Plain(old) => Err(below_plain(old, segment)),
        }
    }
}

/// Puts a value under a key of a table, which may be new.
fn put_in_table(
    table: &mut dyn TableLike,
    segment: &Segment,
    value: Value,
    compound: bool,
) -> Result<(), String> {
    let key = &segment.text;
    match table.get_mut(key) {
        Some(Item::Value(old)) => {
            if matches!(old, Value::InlineTable(_)) && !compound {
                return Err(format!("`{key}` is a table; name one of its keys"));
            }
            replace(old, value);
        }
        Some(Item::Table(_)) if compound => {
            table.insert(key, Item::Value(value));
        }
        Some(Item::Table(_)) => return Err(format!("`{key}` is a table; name one of its keys")),
        Some(Item::ArrayOfTables(tables)) => {
            let count = tables.len();
            return Err(format!("`{key}` is a list of {count} tables; name one of them and its key"));
        }
        Some(Item::None) | None => {
            if segment.number.is_some() {
                return Err(missing_key(table, segment));
            }
            table.insert(key, Item::Value(value));
        }
    }
    Ok(())
}

/// Replaces a value and keeps the blanks and comments about it.
fn replace(old: &mut Value, mut new: Value) {
    *new.decor_mut() = old.decor().clone();
    *old = new;
}

/// Index of the entry that a segment names by its name or its number.
fn entry(segment: &Segment, names: &[Option<String>]) -> Result<usize, String> {
    if let Some(number) = segment.number {
        return number
            .checked_sub(1)
            .filter(|index| *index < names.len())
            .ok_or_else(|| no_number(segment, names.len()));
    }
    let mut named = names.iter().enumerate().filter(|(_, name)| name.as_deref() == Some(&segment.text));
    match (named.next(), named.next()) {
        (Some((index, _)), None) => Ok(index),
        (Some((first, _)), Some((second, _))) => Err(format!(
            "entries {} and {} are both named {:?}; give the number of one",
            first + 1,
            second + 1,
            segment.text
        )),
        (None, _) => Err(no_name(segment, names)),
    }
}

fn no_number(segment: &Segment, count: usize) -> String {
    match count {
        0 => format!("there is no entry {}: the list is empty", segment.text),
        1 => format!("there is no entry {}: the list has one, number 1", segment.text),
        _ => format!("there is no entry {}: the list has {count}, numbered from 1", segment.text),
    }
}

fn no_name(segment: &Segment, names: &[Option<String>]) -> String {
    let known: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
    let instead = match (known.len(), names.len()) {
        (0, 0) => "the list is empty".to_owned(),
        (0, 1) => "the only entry has no name; its number is 1".to_owned(),
        (0, count) => format!("the {count} entries have no names; give a number from 1"),
        _ => instead(&segment.text, &known, "the names are"),
    };
    format!("there is no entry named {:?}; {instead}", segment.text)
}

fn missing_key(table: &dyn TableLike, segment: &Segment) -> String {
    let keys: Vec<&str> = table.iter().map(|(key, _)| key).collect();
    let instead = if keys.is_empty() {
        "nothing stands there".to_owned()
    } else {
        instead(&segment.text, &keys, "there is")
    };
    format!("there is no `{}`; {instead}", segment.text)
}

/// The nearest of the entries that are there, and a list of them.
fn instead(word: &str, known: &[&str], lead: &str) -> String {
    let more = if known.len() > LISTED { ", ..." } else { "" };
    let listed: Vec<String> = known.iter().take(LISTED).map(|name| in_path(name)).collect();
    let list = format!("{lead} {}{more}", listed.join(", "));
    match nearest(word, known.iter().copied()) {
        Some(meant) => format!("did you mean `{}`? {list}", in_path(meant)),
        None => list,
    }
}

/// A name as it stands in a path: in quotes, unless it is a bare key of TOML that is no number.
pub(super) fn in_path(name: &str) -> String {
    let bare = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    let plain = !name.is_empty() && name.chars().all(bare) && name.parse::<usize>().is_err();
    if plain { name.to_owned() } else { format!("{name:?}") }
}

fn below_plain(value: &Value, segment: &Segment) -> String {
    let bare = value.clone().decorated("", "");
    format!("`{}` stands below {bare}, {}, which has no parts", segment.text, value.type_name())
}

fn names_of_tables(tables: &ArrayOfTables) -> Vec<Option<String>> {
    tables.iter().map(name).collect()
}

fn names_of_values(list: &Array) -> Vec<Option<String>> {
    list.iter().map(|value| value.as_inline_table().and_then(name)).collect()
}

fn name(table: &impl TableLike) -> Option<String> {
    table.get("name")?.as_str().map(str::to_owned)
}
