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
    aliases: &[("diameter", "semi_axes")],
    nested: &[],
    is_body: true,
    read: |entry, draft| {
        let (ellipsoid, range) = ellipsoid(entry.table, entry.name, draft.sources.materials)?;
        draft.assembly.ellipsoids.push(ellipsoid);
        draft.range(ElementKind::Ellipsoid, entry, range)
    },
};

const ELLIPSOID: Keys =
    Keys { known: &["name", "semi_axes", "diameter", "axis_ratios", "center", "material"] };

/// Reads an `[[ellipsoid]]`, and the rheology at both ends of its range.
pub(super) fn ellipsoid(
    table: &Table<'_>,
    name: &str,
    materials: &Materials<'_>,
) -> Option<(Ellipsoid, Extremes)> {
    let semi_axes = semi_axes(table);
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let (material, extremes) = materials.of(table)?;
    Some((Ellipsoid { name: name.to_owned(), semi_axes: semi_axes?, center: center?, material }, extremes))
}

/// Reads the semi-axes (m), or computes them from the diameter of the sphere of equal volume and the ratios of the axes.
fn semi_axes(table: &Table<'_>) -> Option<[f64; 3]> {
    let Some(diameter) = table.get("diameter") else {
        let axes = table.required("semi_axes", "semi_axes = [\"2.3 km\", \"1.2 km\", \"950 m\"]");
        if let (Some(_), Some(ratios)) = (&axes, table.get("axis_ratios")) {
            return ratios.refuse(
                "`axis_ratios` follow from `semi_axes`".to_owned(),
                "given twice",
                Some("leave them out, or give `diameter` in the place of `semi_axes`".to_owned()),
            );
        }
        return axes?.array("numbers", |axis| axis.positive(Dimension::LENGTH));
    };
    if let Some(axes) = table.get("semi_axes") {
        return axes.refuse(
            "`semi_axes` follow from `diameter` and `axis_ratios`".to_owned(),
            "given twice",
            Some("leave out one of the two".to_owned()),
        );
    }
    let ratios = table.required("axis_ratios", "axis_ratios = [1.8, 1.2, 1.0]");
    let ratios: Option<[f64; 3]> =
        ratios.and_then(|value| value.array("numbers", |ratio| ratio.positive(Dimension::NUMBER)));
    let (diameter, ratios) = (diameter.positive(Dimension::LENGTH)?, ratios?);
    let mean = ratios.map(f64::cbrt).into_iter().product::<f64>(); // the product of the ratios might overflow
    Some(ratios.map(|ratio| 0.5 * diameter * (ratio / mean)))
}
