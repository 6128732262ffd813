use quasirigid::elements::{ElementKind, Ellipsoid};

use super::material::Materials;
use super::names::Part;
use super::reader::{Keyed, Naming, Reader};
use super::rheology::Extremes;
use super::table::{Keys, Table};
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "ellipsoid",
    title: "[[ellipsoid]]",
    keys: Keyed::All(&ELLIPSOID),
    kind: Some(ElementKind::Ellipsoid),
    naming: Naming::Numbered("ellipsoid"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: true,
    read: |entry, draft| {
        let (ellipsoid, range) = ellipsoid(entry.table, entry.name, draft.sources.materials)?;
        draft.assembly.ellipsoids.push(ellipsoid);
        draft.range(ElementKind::Ellipsoid, entry, range)
    },
};

const ELLIPSOID: Keys = Keys { known: &["name", "semi_axes", "center", "material"] };

/// Reads an `[[ellipsoid]]`, and the rheology at both ends of its range.
pub(super) fn ellipsoid(
    table: &Table<'_>,
    name: &str,
    materials: &Materials<'_>,
) -> Option<(Ellipsoid, Extremes)> {
    let semi_axes = table
        .required("semi_axes", "semi_axes = [\"2.3 km\", \"1.2 km\", \"950 m\"]")
        .and_then(|value| value.array("numbers", |axis| axis.positive(Dimension::LENGTH)));
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let (material, extremes) = materials.of(table)?;
    Some((Ellipsoid { name: name.to_owned(), semi_axes: semi_axes?, center: center?, material }, extremes))
}
