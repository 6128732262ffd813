//! Reference of the model file and the study file: every table with its keys, as the readers have them.
//! One list serves the command `keys`, the schema for editors, and the tables of the guide.

mod markdown;
mod schema;

use serde::Serialize;

use super::key::{Form, Key, Keys, Shape};
use super::kinds::Variant;
use super::names::NODES;
use super::orbit::ORBIT;
use super::part::{MATRIX_IN_FILE, NUMBERS_IN_FILE};
use super::reader::{Keyed, Reader};
use super::value::alternatives;
use super::{OTHERS, READERS, rheology};
use crate::nearest::nearest;
use crate::study_file::{STUDY, VALUES};

pub use markdown::filled;
pub use schema::schema;

/// Reference of a table: its keys with their values and meanings.
#[derive(Clone, Debug, Serialize)]
pub struct TableReference {
    /// Name, such as `spring`.
    pub name: &'static str,
    /// Header, such as `[[spring]]`; of a table in others its name.
    pub title: &'static str,
    /// What the table describes.
    pub meaning: &'static str,
    /// Keys of the table, of all its kinds.
    pub keys: Vec<KeyReference>,
    /// Kinds, if there are several.
    pub kinds: Vec<KindReference>,
}

/// Reference of a key.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize)]
pub struct KeyReference {
    /// Name; of a key in an inner table after a dot.
    pub name: String,
    /// Form, unit, and default in parentheses.
    pub value: String,
    /// Meaning; empty where name and unit say it.
    pub meaning: &'static str,
}

/// Reference of a kind of table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct KindReference {
    /// Word that chooses the kind.
    pub word: &'static str,
    /// Keys that not every kind has.
    pub keys: Vec<&'static str>,
    /// Meaning; empty where the word says it.
    pub meaning: &'static str,
}

/// Reference of every table, in the order of the readers.
#[must_use]
pub fn tables() -> Vec<TableReference> {
    documented().iter().map(Documented::reference).collect()
}

/// The name of a table that is probably meant, if one is near.
#[must_use]
pub fn nearest_table(name: &str) -> Option<&'static str> {
    nearest(name, documented().iter().map(|table| table.name))
}

/// Place of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Once in a file, `[run]`.
    Once,
    /// Any number of times, `[[spring]]`.
    Several,
    /// With a name of the user's, `[material.rock]`.
    Named,
    /// In other tables.
    Inside,
    /// In a study file.
    Study,
}

/// Keys of a documented table.
#[derive(Clone, Copy)]
pub(super) enum Listed {
    All(&'static Keys),
    ByKind { any: &'static Keys, kinds: fn() -> Vec<Variant> },
}

/// A table with its documentation.
#[derive(Clone, Copy)]
pub(super) struct Documented {
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    pub(super) meaning: &'static str,
    pub(super) place: Place,
    pub(super) listed: Listed,
}

impl Documented {
    const fn inside(name: &'static str, listed: Listed, meaning: &'static str) -> Self {
        Self { name, title: name, meaning, place: Place::Inside, listed }
    }

    /// Keys of the table, of all its kinds.
    fn keys(&self) -> &'static Keys {
        let (Listed::All(keys) | Listed::ByKind { any: keys, .. }) = self.listed;
        keys
    }

    fn variants(&self) -> Vec<Variant> {
        match self.listed {
            Listed::All(_) => Vec::new(),
            Listed::ByKind { kinds, .. } => kinds(),
        }
    }

    fn reference(&self) -> TableReference {
        let variants = self.variants();
        let own = |name: &&str| !variants.iter().all(|variant| variant.keys.has(name));
        let kind = |variant: &Variant| KindReference {
            word: variant.word,
            keys: variant.keys.names().filter(own).collect(),
            meaning: variant.meaning,
        };
        let mut keys = Vec::new();
        list("", self.keys(), &mut keys);
        if let (Some(first), false) = (keys.first_mut(), variants.is_empty()) {
            let words: Vec<String> = variants.iter().map(|variant| format!("`{:?}`", variant.word)).collect();
            first.value = alternatives(&words);
        }
        let kinds = variants.iter().map(kind).collect();
        TableReference { name: self.name, title: self.title, meaning: self.meaning, keys, kinds }
    }
}

/// Every table: those of a file, those in other tables, those of studies.
fn documented() -> Vec<Documented> {
    let element = |reader: &&Reader| Documented {
        name: reader.key,
        title: reader.title,
        meaning: reader.meaning,
        place: Place::Several,
        listed: match reader.keys {
            Keyed::All(keys) => Listed::All(keys),
            Keyed::ByKind { any, kinds, .. } => Listed::ByKind { any, kinds },
        },
    };
    OTHERS.into_iter().chain(READERS.iter().map(element)).chain(INSIDE).collect()
}

/// Tables that several others have, and those of studies.
const INSIDE: [Documented; 7] = [
    Documented::inside(
        "rheology",
        Listed::ByKind { any: &rheology::ANY, kinds: rheology::documented },
        "law of dissipation",
    ),
    Documented::inside("orbit", Listed::All(&ORBIT), "orbit of the centre of mass"),
    Documented::inside("node", Listed::All(&NODES), "nodes of a part, or a place on an appendage"),
    Documented::inside("matrix", Listed::All(&MATRIX_IN_FILE), "matrix in a file"),
    Documented::inside("numbers", Listed::All(&NUMBERS_IN_FILE), "numbers in a file"),
    Documented::inside("values", Listed::All(&VALUES), "values of a key that is varied or uncertain"),
    Documented {
        name: "study",
        title: "study file",
        meaning: "the same questions to many bodies",
        place: Place::Study,
        listed: Listed::All(&STUDY),
    },
];

/// Lists keys, each followed by those of a table that it holds.
fn list(path: &str, keys: &Keys, found: &mut Vec<KeyReference>) {
    for Key { name, form, meaning } in keys.known {
        let name = format!("{path}{name}");
        found.push(KeyReference { name: name.clone(), value: form.words(), meaning });
        if let Some(inner) = inner(&form.shape) {
            list(&format!("{name}."), inner, found);
        }
    }
}

/// Keys of the tables in a value, unless they are listed elsewhere.
fn inner(shape: &Shape) -> Option<&'static Keys> {
    match shape {
        Shape::Table(keys) => Some(keys),
        Shape::Array(_, shape) | Shape::List(shape) | Shape::Named(shape) => inner(shape),
        Shape::Any(shapes) => shapes.iter().find_map(inner),
        _ => None,
    }
}
