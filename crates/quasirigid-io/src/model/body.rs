//! Body reader: every table of elements, the carrier, the support and the reduction become one assembly.
//! All tables are read even after a wrong one, so that one run reports every mistake; the laws of mechanics are checked later.

use std::path::Path;

use quasirigid_body::Support;
use quasirigid_elements::{Assembly, Carrier, ElementId, ElementKind};

use super::diagnostic::Problems;
use super::key::{Key, Keys, Shape, any, key, quantity, vector};
use super::magnetic_field::{self, CommonField, magnetic_field};
use super::material::Materials;
use super::names::Names;
use super::orbit::ORBIT;
use super::part::reduction;
use super::ranges::Ranges;
use super::reader::{Draft, Entry, Opened, Sources};
use super::section::Sections;
use super::spans::{ElementSpans, Spans};
use super::table::Table;
use super::value::Value;
use super::{Diagnostic, READERS, support};
use crate::record::ShapeFileRecord;
use crate::units::Dimension;

/// Inertia tensor of a rigid body.
pub(super) const INERTIA: Key = key(
    "inertia",
    any(&[Shape::Vector, Shape::Matrix]).in_unit("kg m²"),
    "about its own centre of mass; moments along the file's axes, or a tensor",
);

pub(super) const CARRIER: Keys = Keys {
    known: &[
        key("mass", quantity("kg"), "none beside an `[[ellipsoid]]` and where parts float"),
        key("center_of_mass", vector("m"), ""),
        INERTIA,
    ],
};

/// Points of a body without a carrier, at least: fewer have no inertia about some axis.
pub(super) const FEWEST_POINTS: usize = 3;

/// Body of a file.
pub(super) struct Body<'a> {
    /// Names of its parts.
    pub(super) names: Names<'a>,
    /// Assembly of the body, if nothing is wrong with its parts.
    pub(super) parts: Option<Parts>,
    /// What was left out of files or repaired.
    pub(super) file_notes: Vec<String>,
}

/// Assembly of a body, with its ranges and its places in the file.
pub(super) struct Parts {
    pub(super) assembly: Assembly,
    /// Assemblies with every rheology at the least and at the greatest of its range, if the file gives ranges.
    pub(super) extremes: Option<Box<[Assembly; 2]>>,
    /// Places of the elements in the file.
    pub(super) spans: Spans,
    /// Files of shapes.
    pub(super) shapes: Vec<ShapeFileRecord>,
}

impl Body<'_> {
    /// The body, if nothing is wrong with its parts.
    pub(super) fn assembly(&self) -> Option<&Assembly> {
        self.parts.as_ref().map(|parts| &parts.assembly)
    }
}

/// Reads everything that describes the body, its support, and the forces on it; suspect but not wrong things go into `notes`.
pub(super) fn body<'a>(
    file: &Table<'a>,
    folder: &Path,
    problems: &'a Problems<'a>,
    notes: &mut Vec<String>,
) -> Body<'a> {
    if !has_body(file) {
        report_missing_body(problems);
    }
    let (materials, sections) = (Materials::new(file), Sections::new(file));
    let opened = opened(file);
    let names = Names::new(&opened, problems);
    let mut spans = Spans::default();
    for Opened { reader, kind, table, index, .. } in &opened {
        spans.note(kind.iter().map(|kind| (kind.at(*index), reader.spans(table, &materials))));
    }
    let (field, field_spans) = common_field(file);
    spans.note(field_spans.map(|own| (ElementId::MAGNETIC_FIELD, own)));
    let sources = Sources { materials: &materials, sections: &sections, folder, field };
    let mut draft = Draft {
        sources,
        names,
        assembly: Assembly::default(),
        ranges: Ranges::default(),
        networks: Vec::new(),
        notes: Vec::new(),
        file_notes: Vec::new(),
        shapes: Vec::new(),
    };
    let good = single_tables(file, &mut draft.assembly, &mut spans) && !matches!(field, CommonField::Wrong);
    if let CommonField::Given(given) = field {
        draft.assembly.magnetic_field = Some(given);
    }
    let good = every(&opened, &mut draft) && good;
    notes.extend(magnetic_field::unused(&draft.assembly));
    notes.extend(materials.unused());
    notes.extend(materials.chosen());
    let Draft { names, assembly, ranges, networks, notes: of_parts, file_notes, shapes, .. } = draft;
    notes.extend(of_parts);
    spans.networks = networks;
    let parts = good.then(|| Parts { extremes: ranges.ends(&assembly), assembly, spans, shapes });
    Body { names, parts, file_notes }
}

/// Whether a file has a carrier, or a table that is a body without one.
fn has_body(file: &Table<'_>) -> bool {
    let count = |key| file.get(key).and_then(|value| value.items()).map_or(0, |items| items.len());
    let present = |key| file.get(key).is_some_and(|value| !value.is_empty());
    file.get("carrier").is_some()
        || count("point") >= FEWEST_POINTS
        || READERS.iter().any(|reader| reader.is_body && present(reader.key))
}

/// Opens the tables of elements, each with the index among those of its kind.
fn opened<'a>(file: &Table<'a>) -> Vec<Opened<'a>> {
    let mut counts: Vec<(Option<ElementKind>, usize)> = Vec::new();
    let mut opened = Vec::new();
    for reader in READERS {
        for (number, table) in (1..).zip(reader.open(file)) {
            let kind = reader.kind_of(&table);
            let known = counts.iter().position(|(known, _)| *known == kind);
            let entry = known.unwrap_or_else(|| {
                counts.push((kind, 0));
                counts.len() - 1
            });
            opened.push(Opened { reader, kind, number, index: counts[entry].1, table });
            counts[entry].1 += 1;
        }
    }
    opened
}

/// Reads every table of an element, also those after a wrong one.
fn every<'a>(opened: &[Opened<'a>], draft: &mut Draft<'_, 'a>) -> bool {
    let mut good = true;
    for (number, Opened { reader, index, table, .. }) in opened.iter().enumerate() {
        let name = draft.names.given(number).to_owned();
        good &= (reader.read)(&Entry { table, name: &name, index: *index }, draft).is_some();
    }
    good
}

/// Reads the tables that stand once; false if something is wrong with one of them.
fn single_tables(file: &Table<'_>, assembly: &mut Assembly, spans: &mut Spans) -> bool {
    let table = file.table("carrier", "[carrier]", &CARRIER);
    spans.note(table.iter().map(|table| (ElementId::CARRIER, table.spans())));
    assembly.carrier = table.as_ref().and_then(carrier);
    let supported = support::table(file);
    spans.note(supported.iter().map(|(table, _)| (ElementId::SUPPORT, table.spans())));
    let support = match supported {
        Some((table, kind)) => (kind.read)(&table),
        None => file.get("support").is_none().then_some(Support::Free),
    };
    let reduction = reduction(file);
    let good = (assembly.carrier.is_some() || file.get("carrier").is_none())
        && support.is_some()
        && reduction.is_some();
    assembly.support = support.unwrap_or_default();
    assembly.reduction = reduction.unwrap_or_default();
    good
}

/// Reads the magnetic field of the model, with the places of its values.
fn common_field(file: &Table<'_>) -> (CommonField, Option<ElementSpans>) {
    if file.get("magnetic_field").is_none() {
        return (CommonField::Absent, None);
    }
    let Some(table) = file.table("magnetic_field", "[magnetic_field]", &magnetic_field::TABLE) else {
        return (CommonField::Wrong, None);
    };
    let mut spans = table.spans();
    spans.values.extend(table.get("orbit").into_iter().flat_map(|value| value.spans(&ORBIT).values));
    (magnetic_field(&table).map_or(CommonField::Wrong, CommonField::Given), Some(spans))
}

/// Reads the inertia tensor of an element: three principal values in the file's axes, or a matrix.
pub(super) fn inertia(value: &Value<'_>) -> Option<[[f64; 3]; 3]> {
    let items = value.items().unwrap_or_default();
    if items.len() != 3 {
        let help = "write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix";
        return value.mismatch("3 principal values or a 3x3 matrix", help);
    }
    if items.iter().any(Value::is_array) {
        return value.matrix(Dimension::INERTIA);
    }
    let [x, y, z] = value.vector(Dimension::INERTIA)?;
    Some([[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]])
}

fn carrier(table: &Table<'_>) -> Option<Carrier> {
    let mass = table.read("mass", "mass = 40.0", |value| value.positive(Dimension::MASS));
    let center_of_mass = table
        .read("center_of_mass", "center_of_mass = [0.0, 0.0, 0.0]", |value| value.vector(Dimension::LENGTH));
    let inertia = table.read("inertia", "inertia = [9.0, 13.0, 16.0]", |value| inertia(&value));
    Some(Carrier { mass: mass?, center_of_mass: center_of_mass?, inertia: inertia? })
}

fn report_missing_body(problems: &Problems<'_>) {
    let message = "the file has no [carrier] and no part that is elastic throughout";
    let help = "add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; \
                or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]";
    problems.report(Diagnostic::new(0..0, message, "no body in this file").help(help));
}
