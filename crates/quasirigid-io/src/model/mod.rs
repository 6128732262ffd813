//! Model files: a body, its initial state and the settings of a run, as a TOML text.
//!
//! Reading checks what concerns the file: keys, types, units, names, finite numbers. The laws of mechanics are
//! checked by [`quasirigid_elements`]; [`Model::diagnose`] finds the place in the file that they speak of.

mod appendage;
mod as_observed;
mod body;
mod body_kind;
mod boom;
mod bushing;
mod cavity;
mod change;
mod channel;
mod conductor;
mod controller;
pub(crate) mod diagnostic;
mod ellipsoid;
mod error;
mod evolve;
mod force;
mod formula;
mod hinged;
mod initial;
pub(crate) mod key;
mod key_value;
mod kinds;
mod literal;
mod magnetic_field;
mod material;
mod named;
mod names;
mod orbit;
mod part;
mod partial;
mod physics;
mod point;
mod ranges;
mod reader;
pub mod reference;
mod rheology;
mod rod;
mod rotation;
mod rotor;
mod section;
mod settings;
mod source;
pub(crate) mod spans;
mod spin_manifold;
mod spring;
mod start_file;
mod sunlight;
mod support;
mod surface;
pub(crate) mod syntax;
pub(crate) mod table;
mod tank;
mod timing;
mod trajectory;
mod uncertainty;
pub(crate) mod value;
mod values_read;
mod wheel;

use std::io::Read;
use std::path::Path;

use quasirigid_elements::{Assembly, ElementError};

pub use body_kind::BodyKind;
pub use change::{ChangeError, KeyContent, Path as KeyPath, Template, WrittenNumber, changed};
pub use diagnostic::Diagnostic;
pub use error::{FileProblem, ModelError};
pub use evolve::{EvolveMethod, PartialEvolve, Power, Target, TargetError};
pub use initial::{Displacements, Initial};
pub use key_value::KeyValue;
pub use named::{Named, former_name};
#[doc(hidden)]
pub use part::deck_notes;
pub use rotation::Rotation;
pub use settings::{MAX_ROWS, PartialRun, PartialVerify, RunTable, Stop, System};
pub use source::Source;
pub use spin_manifold::{ManifoldMasters, ManifoldStyle, MastersError, PartialSpinManifold};

use crate::files_read::{FileRead, listed};
use crate::record::{ShapeFileRecord, ValueRecord};
use crate::study_file::{VALUES, Varied};
use body::Parts;
use diagnostic::Problems;
use key::{Key, Keys, Shape, key, of};
use reader::Reader;
use reference::{Documented, Listed, Place};
use spans::Spans;
use table::Table;
use values_read::ValuesRead;

/// Readers of elements, in the order in which they read: those with nodes and places before those that refer to them.
const READERS: &[&Reader] = &[
    &ellipsoid::READER,
    &surface::READER,
    &part::beam::READER,
    &part::panel::READER,
    &part::solid::READER,
    &part::deck::READER,
    &part::matrices::READER,
    &part::modes::READER,
    &part::connection::READER,
    &point::READER,
    &hinged::READER,
    &boom::READER,
    &appendage::READER,
    &spring::READER,
    &bushing::READER,
    &part::network::READER,
    &rotor::READER,
    &wheel::READER,
    &cavity::READER,
    &tank::READER,
    &force::READER,
    &controller::READER,
    &rod::READER,
];

/// Tables of a file that describe no elements.
const OTHERS: [Documented; 10] = [
    other("body", "[body]", Place::Once, Listed::All(&settings::BODY), "the body as a whole"),
    other(
        "carrier",
        "[carrier]",
        Place::Once,
        Listed::All(&body::CARRIER),
        "rigid body that carries the others",
    ),
    other("material", "[material.NAME]", Place::Named, Listed::All(&material::MATERIAL), "elastic material"),
    other(
        "section",
        "[section.NAME]",
        Place::Named,
        Listed::ByKind { any: &section::ANY, kinds: section::documented },
        "cross-section of beams",
    ),
    other("reduction", "[reduction]", Place::Once, Listed::All(&part::REDUCTION), "coordinates of parts"),
    other(
        "support",
        "[support]",
        Place::Once,
        Listed::ByKind { any: &support::ANY, kinds: support::documented },
        "support of the body",
    ),
    other(
        "magnetic_field",
        "[magnetic_field]",
        Place::Once,
        Listed::All(&magnetic_field::TABLE),
        "field of controllers, and of forces without one of their own",
    ),
    other("initial", "[initial]", Place::Once, Listed::All(&initial::INITIAL), "state at time zero"),
    other("run", "[run]", Place::Once, Listed::All(&settings::RUN), "settings of the computation"),
    other("uncertainty", "[uncertainty]", Place::Named, Listed::All(&VALUES), "distributions of keys"),
];

const fn other(
    name: &'static str,
    title: &'static str,
    place: Place,
    listed: Listed,
    meaning: &'static str,
) -> Documented {
    Documented { name, title, meaning, place, listed }
}

const FILE: Keys = Keys { known: &KEYS };
const KEYS: [Key; OTHERS.len() + READERS.len()] = {
    let mut keys = [key("", of(Shape::Value), ""); OTHERS.len() + READERS.len()];
    let mut i = 0;
    while i < keys.len() {
        let (name, meaning) = if i < OTHERS.len() {
            (OTHERS[i].name, OTHERS[i].meaning)
        } else {
            (READERS[i - OTHERS.len()].key, READERS[i - OTHERS.len()].meaning)
        };
        keys[i] = key(name, of(Shape::Value), meaning);
        i += 1;
    }
    keys
};

/// A model file, read.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name of the body; the file's own name if it gives none.
    pub name: String,
    /// Kind of the body.
    pub kind: BodyKind,
    /// The body.
    pub assembly: Assembly,
    /// The body with every rheology at the least and at the greatest of its range; none if the file gives no range.
    pub extremes: Option<Box<[Assembly; 2]>>,
    /// State of the body at time zero.
    pub initial: Initial,
    /// Settings of the computation.
    pub run: RunTable,
    /// Keys of the model that are known by a distribution alone.
    pub uncertainty: Vec<Varied>,
    /// Notes on suspect but valid values, those on files first.
    pub notes: Vec<String>,
    /// What was left out of files or repaired, with counts; it stands among the notes too.
    pub file_notes: Vec<String>,
    /// Files of shapes, as they were read.
    pub shapes: Vec<ShapeFileRecord>,
    /// Notes on former names of keys and words, with those of today.
    pub former_names: Vec<String>,
    /// The text of the model.
    pub source: Source,
    /// Files that the model names, as they were read.
    pub files: Vec<FileRead>,
    spans: Spans,
    values_read: ValuesRead,
}

impl Model {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`ModelError::Unreadable`] if there is no text to read, [`ModelError::Invalid`] with every mistake in it.
    pub fn read(path: &Path) -> Result<Self, ModelError> {
        Self::new(Source::read(path)?)
    }

    /// Reads a model to the end of a stream; `file` stands in messages and names a nameless body, and paths in the model are relative to
    /// its folder.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_from(file: &Path, input: impl Read) -> Result<Self, ModelError> {
        Self::new(Source::read_from(file, input)?)
    }

    /// Reads the text of a model file; `file` stands in messages and names a nameless body.
    ///
    /// # Errors
    /// [`ModelError::Invalid`] with every mistake in the text.
    pub fn parse(file: &Path, text: &str) -> Result<Self, ModelError> {
        Self::new(Source::new(file, text.to_owned()))
    }

    /// Error of the library as a diagnostic of the file: with its place there, and advice.
    #[must_use]
    pub fn diagnose(&self, error: &ElementError) -> ModelError {
        self.diagnose_all(std::slice::from_ref(error))
    }

    /// Errors of the library as diagnostics of the file, in the order of the file.
    #[must_use]
    pub fn diagnose_all(&self, errors: &[ElementError]) -> ModelError {
        let mut diagnostics: Vec<Diagnostic> =
            errors.iter().map(|error| physics::diagnostic(error, &self.assembly, &self.spans)).collect();
        diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
        ModelError::Invalid { model: self.source.clone(), diagnostics }
    }

    /// Values of the file after units and defaults, in SI units, and the number of those that are too many to be listed.
    #[must_use]
    pub fn values(&self) -> (Vec<ValueRecord>, usize) {
        self.values_read.listed(&self.source.text)
    }

    fn new(source: Source) -> Result<Self, ModelError> {
        let problems = Problems::new(&source.text);
        let folder = source.file.parent().unwrap_or(Path::new(""));
        let (content, files) = listed(|| content(&source.text, folder, &problems));
        let (former_names, values_read) = (problems.former_names(), problems.values());
        let diagnostics = problems.into_diagnostics();
        match content {
            Some(Content { name, kind, parts, initial, run, uncertainty, notes, file_notes })
                if diagnostics.is_empty() =>
            {
                let name = name.unwrap_or_else(|| stem(&source.file));
                let Parts { assembly, extremes, spans, shapes } = parts;
                Ok(Self {
                    name,
                    kind,
                    assembly,
                    extremes,
                    initial,
                    run,
                    uncertainty,
                    notes,
                    file_notes,
                    shapes,
                    former_names,
                    source,
                    files,
                    spans,
                    values_read,
                })
            }
            _ => Err(ModelError::Invalid { model: source, diagnostics }),
        }
    }
}

/// Content of a file.
struct Content {
    name: Option<String>,
    kind: BodyKind,
    parts: Parts,
    initial: Initial,
    run: RunTable,
    uncertainty: Vec<Varied>,
    notes: Vec<String>,
    file_notes: Vec<String>,
}

fn content(text: &str, folder: &Path, problems: &Problems<'_>) -> Option<Content> {
    let tree = syntax::tree(text, problems)?;
    if tree.is_empty() {
        let message =
            if text.trim().is_empty() { "the file is empty" } else { "the file has comments but no model" };
        let help = "a model has at least a [carrier] with mass, center_of_mass and inertia, or an [[ellipsoid]] with \
                    semi_axes and material";
        problems.report(Diagnostic::new(0..0, message, "nothing to read").help(help));
        return None;
    }
    let file = Table::new("the file", 0..0, &tree, &FILE, &|_| None, problems);
    let mut notes = Vec::new();
    let titled = file.table("body", "[body]", &settings::BODY);
    let name = titled.as_ref().and_then(|table| table.get("name"));
    let name = name.and_then(|value| value.name()).map(str::to_owned);
    let kind = titled.as_ref().and_then(|table| table.get("kind"));
    let kind = kind.map(|value| value.named::<BodyKind>());
    let body = body::body(&file, folder, problems, &mut notes);
    let file_notes = body.file_notes.clone();
    notes.splice(..0, file_notes.iter().cloned());
    let initial = match file.table("initial", "[initial]", &initial::INITIAL) {
        Some(table) => initial::initial(&table, (&body, folder), &mut notes),
        None => Some(Initial::default()),
    };
    let observed = match (body.assembly(), &initial) {
        (Some(assembly), Some(initial)) => as_observed::spinning(&file, assembly, initial),
        _ => Some(()),
    };
    let mut body = body;
    let parts = body.parts.as_mut();
    let spun = match (parts, &initial) {
        (Some(parts), Some(initial)) => {
            let ends = parts.extremes.iter_mut().flat_map(|ends| ends.iter_mut());
            let assemblies = std::iter::once(&mut parts.assembly).chain(ends);
            assemblies
                .map(|assembly| tank::spun(&file, assembly, initial))
                .collect::<Option<Vec<_>>>()
                .map(drop)
        }
        _ => Some(()),
    };
    let run = match file.table("run", "[run]", &settings::RUN) {
        Some(table) => settings::run(&table),
        None => Some(RunTable::default()),
    };
    let uncertainty = match file.get("uncertainty") {
        Some(table) => uncertainty::uncertainty(&table, text),
        None => Some(Vec::new()),
    };
    spun?;
    observed?;
    let parts = body.parts?;
    let kind = match kind {
        Some(given) => given?,
        None => BodyKind::inferred(&file, &parts.assembly),
    };
    Some(Content {
        name,
        kind,
        parts,
        initial: initial?,
        run: run?,
        uncertainty: uncertainty?,
        notes,
        file_notes,
    })
}

fn stem(file: &Path) -> String {
    file.file_stem().map_or_else(|| "body".to_owned(), |stem| stem.to_string_lossy().into_owned())
}
