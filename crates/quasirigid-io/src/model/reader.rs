//! Registry of the tables that describe elements. A new kind is a file with a [`Reader`] and a line in `READERS`.

use std::path::Path;

use quasirigid_elements::{Assembly, ElementKind};

use super::key::{Key, Keys, TEXT, key};
use super::kinds::Variant;
use super::magnetic_field::CommonField;
use super::material::Materials;
use super::names::{Names, Part};
use super::part::Read;
use super::ranges::Ranges;
use super::rheology::Extremes;
use super::section::Sections;
use super::spans::{ElementSpans, NetworkSpans};
use super::table::Table;
use super::value::Value;
use crate::record::ShapeFileRecord;

/// Name of an element.
pub(super) const NAME: Key = key("name", TEXT.or("`point 1`, `spring tip-carrier`"), "unique");

/// Kind of table that describes elements: its name, its keys and its reading, in one place.
pub(super) struct Reader {
    /// Key of the table in the file.
    pub(super) key: &'static str,
    /// The table as messages call it.
    pub(super) title: &'static str,
    /// What the table describes.
    pub(super) meaning: &'static str,
    /// Keys of the table.
    pub(super) keys: Keyed,
    /// Kind of the elements; none of a table that stands for many.
    pub(super) kind: Option<ElementKind>,
    /// Naming of the elements.
    pub(super) naming: Naming,
    /// Part of the body that a name stands for where another table refers to it.
    pub(super) names: fn(usize) -> Part,
    /// Values that stand under other keys, each with its key and that of the element.
    pub(super) aliases: &'static [(&'static str, &'static str)],
    /// Tables inside the table whose values are values of the element, each with its key and its keys.
    pub(super) nested: &'static [(&'static str, &'static Keys)],
    /// Whether the table makes a body without a carrier.
    pub(super) is_body: bool,
    /// Reads one table into the draft of a body; none if something in it is wrong, which is reported.
    pub(super) read: Reading,
}

/// Keys of a table.
#[derive(Clone, Copy)]
pub(super) enum Keyed {
    /// Keys that every table has.
    All(&'static Keys),
    /// Keys of the kind that the table names.
    ByKind {
        /// Keys of a table without a kind.
        any: &'static Keys,
        /// Documentation of the kinds.
        kinds: fn() -> Vec<Variant>,
        /// Opens the table.
        open: for<'a> fn(&Value<'a>) -> Option<Table<'a>>,
        /// Kind of the element and what its name stands for, of a table whose elements are not those of the reader.
        other: fn(&Table<'_>) -> Option<Other>,
    },
}

/// Names of the elements of a kind.
#[derive(Clone, Copy)]
pub(super) enum Naming {
    /// Given, or made of this word and a number; no two elements share a name.
    Numbered(&'static str),
    /// Given or numbered, but apart from the names of other kinds.
    Apart(&'static str),
    /// Given or none.
    Optional,
    /// None.
    Nameless,
}

/// Table of an element whose keys have been checked.
pub(super) struct Opened<'a> {
    pub(super) reader: &'static Reader,
    /// Kind of the element; none of a table that stands for many.
    pub(super) kind: Option<ElementKind>,
    /// Number of the table under its key, from 1.
    pub(super) number: usize,
    /// Index among the elements of its kind.
    pub(super) index: usize,
    pub(super) table: Table<'a>,
}

/// Table of an element with its name.
pub(super) struct Entry<'t, 'a> {
    pub(super) table: &'t Table<'a>,
    /// Name of the element; empty without one.
    pub(super) name: &'t str,
    /// Index among the elements of its kind.
    pub(super) index: usize,
}

/// Materials, sections and files that elements are made from.
#[derive(Clone, Copy)]
pub(super) struct Sources<'s, 'a> {
    pub(super) materials: &'s Materials<'a>,
    pub(super) sections: &'s Sections<'a>,
    /// Folder of the files.
    pub(super) folder: &'s Path,
    /// Magnetic field of forces without one of their own.
    pub(super) field: CommonField,
}

/// Body as far as it has been read.
pub(super) struct Draft<'s, 'a> {
    pub(super) sources: Sources<'s, 'a>,
    pub(super) names: Names<'a>,
    pub(super) assembly: Assembly,
    pub(super) ranges: Ranges,
    pub(super) networks: Vec<NetworkSpans>,
    /// Suspect but not wrong things.
    pub(super) notes: Vec<String>,
    /// What was left out of files or repaired.
    pub(super) file_notes: Vec<String>,
    /// Files of shapes.
    pub(super) shapes: Vec<ShapeFileRecord>,
}

/// Kind of an element, and what its name stands for where another table refers to it.
type Other = (ElementKind, fn(usize) -> Part);

/// Function that reads a table into the draft of a body.
type Reading = for<'a> fn(&Entry<'_, 'a>, &mut Draft<'_, 'a>) -> Option<()>;

impl Reader {
    /// Reader of parts of finite elements: their names stand for nodes, and they make a body without a carrier.
    pub(super) const fn of_parts(
        key: &'static str,
        title: &'static str,
        meaning: &'static str,
        keys: &'static Keys,
        read: Reading,
    ) -> Self {
        Self {
            key,
            title,
            meaning,
            keys: Keyed::All(keys),
            kind: Some(ElementKind::Part),
            naming: Naming::Numbered(key),
            names: Part::Flexible,
            aliases: &[],
            nested: &[],
            is_body: true,
            read,
        }
    }

    /// Kind of the element of a table.
    pub(super) fn kind_of(&self, table: &Table<'_>) -> Option<ElementKind> {
        self.other(table).map(|(kind, _)| kind).or(self.kind)
    }

    /// What the name of the element of a table stands for.
    pub(super) fn part_of(&self, table: &Table<'_>, index: usize) -> Part {
        self.other(table).map_or(self.names, |(_, names)| names)(index)
    }

    fn other(&self, table: &Table<'_>) -> Option<Other> {
        match self.keys {
            Keyed::All(_) => None,
            Keyed::ByKind { other, .. } => other(table),
        }
    }

    /// Opens the tables of this reader in a file; values that are no such tables are reported.
    pub(super) fn open<'a>(&self, file: &Table<'a>) -> Vec<Table<'a>> {
        let open = |value: &Value<'a>| match self.keys {
            Keyed::All(keys) => value.table(self.title, keys),
            Keyed::ByKind { open, .. } => open(value),
        };
        file.several(self.key, self.title).iter().filter_map(open).collect()
    }

    /// Places of the values of an element in the file, also those of its material and those under other keys.
    pub(super) fn spans<'a>(&self, table: &Table<'a>, materials: &Materials<'a>) -> ElementSpans {
        let mut spans = materials.spans(table);
        for (key, field) in self.aliases {
            spans.values.extend(table.get(key).map(|value| (*field, value.span())));
        }
        for (key, keys) in self.nested {
            spans.values.extend(table.get(key).into_iter().flat_map(|value| value.spans(keys).values));
        }
        spans
    }
}

impl<'a> Draft<'_, 'a> {
    /// Adds a part of finite elements with the names of its nodes.
    pub(super) fn part(&mut self, entry: &Entry<'_, 'a>, read: Option<Read>) -> Option<()> {
        let Read { part, nodes, extremes, notes } = read?;
        self.file_notes.extend(notes);
        self.names.nodes.insert(entry.index, nodes);
        self.assembly.parts.push(part);
        self.ranges.set(ElementKind::Part.at(entry.index), extremes);
        Some(())
    }

    /// Notes the range of the rheology of an element.
    pub(super) fn range(&mut self, kind: ElementKind, entry: &Entry<'_, 'a>, range: Extremes) -> Option<()> {
        self.ranges.set(kind.at(entry.index), vec![range]);
        Some(())
    }
}
