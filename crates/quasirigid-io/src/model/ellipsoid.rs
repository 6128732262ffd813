use quasirigid_elements::{ElementKind, Ellipsoid, ObservedShape};

use super::as_observed::{SHAPE, observed};
use super::key::{Keys, TEXT, VECTOR, key, quantity, vector};
use super::material::Materials;
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::rheology::Extremes;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "ellipsoid",
    title: "[[ellipsoid]]",
    meaning: "homogeneous elastic body",
    keys: Keyed::All(&ELLIPSOID),
    kind: Some(ElementKind::Ellipsoid),
    naming: Naming::Numbered("ellipsoid"),
    names: |_| Part::Throughout,
    aliases: &[("diameter", "semi_axes")],
    nested: &[],
    is_body: true,
    read: |entry, draft| {
        let ellipsoid = ellipsoid(entry.table, entry.name, draft.sources.materials);
        let observed = observed(entry.table);
        let (ellipsoid, range) = ellipsoid?;
        if observed? {
            let moments = entry.table.get("moment_ratios").is_some();
            draft.assembly.as_observed =
                Some(if moments { ObservedShape::Moments } else { ObservedShape::Surface });
        }
        draft.assembly.ellipsoids.push(ellipsoid);
        draft.range(ElementKind::Ellipsoid, entry, range)
    },
};

const ELLIPSOID: Keys = Keys {
    known: &[
        NAME,
        key("semi_axes", vector("m"), "along the file's axes"),
        key("diameter", quantity("m"), "of the sphere of equal volume, instead, with one of the next two"),
        key("axis_ratios", VECTOR, ""),
        key("moment_ratios", VECTOR, "of the moments of inertia"),
        SHAPE,
        key("center", vector("m").or("0"), ""),
        key("material", TEXT, ""),
    ],
};

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

/// Reads the semi-axes (m), or computes them from the diameter of the sphere of equal volume and the shape.
fn semi_axes(table: &Table<'_>) -> Option<[f64; 3]> {
    let given = |key: &'static str| table.get(key).map(|value| (key, value));
    let mut shapes = ["semi_axes", "axis_ratios", "moment_ratios"].into_iter().filter_map(given);
    let first = shapes.next();
    if let (Some((known, _)), Some((key, again))) = (&first, shapes.next()) {
        return again.refuse(
            format!("`{key}` follow from `{known}`"),
            "given twice",
            "leave out one of the two",
        );
    }
    let diameter = table.get("diameter");
    let (diameter, ratios) = match (diameter, first) {
        (None, None) => {
            return table.required("semi_axes", "semi_axes = [\"2.3 km\", \"1.2 km\", \"950 m\"]").and(None);
        }
        (None, Some(("semi_axes", axes))) => {
            return axes.array("numbers", |axis| axis.positive(Dimension::LENGTH));
        }
        (Some(diameter), Some(("semi_axes", _))) => {
            return diameter.refuse(
                "`diameter` follows from `semi_axes`",
                "given twice",
                "leave out one of the two; `axis_ratios` and `moment_ratios` go with `diameter`",
            );
        }
        (None, Some(_)) => return table.required("diameter", "diameter = \"340 m\"").and(None),
        (Some(_), None) => return table.required("axis_ratios", "axis_ratios = [1.8, 1.2, 1.0]").and(None),
        (Some(diameter), Some(ratios)) => (diameter, ratios),
    };
    let (key, value) = ratios;
    let ratios: Option<[f64; 3]> = value.array("numbers", |ratio| ratio.positive(Dimension::NUMBER));
    let (diameter, ratios) = (diameter.positive(Dimension::LENGTH)?, ratios?);
    let ratios = if key == "moment_ratios" { axes_of_moments(&value, ratios)? } else { ratios };
    let mean = ratios.map(f64::cbrt).into_iter().product::<f64>(); // the product of the ratios might overflow
    Some(ratios.map(|ratio| 0.5 * diameter * (ratio / mean)))
}

/// Ratios of the semi-axes of the homogeneous ellipsoid with moments of inertia in these ratios: `a² : b² : c² = B+C−A : A+C−B : A+B−C`.
fn axes_of_moments(value: &Value<'_>, moments: [f64; 3]) -> Option<[f64; 3]> {
    let greatest = moments.into_iter().fold(0.0, f64::max);
    let moments = moments.map(|moment| moment / greatest);
    let squares = moments.map(|moment| moments.iter().sum::<f64>() - 2.0 * moment);
    if squares.iter().all(|square| *square > 0.0) {
        return Some(squares.map(f64::sqrt));
    }
    value.refuse(
        "no body has these moments of inertia: the greatest is not below the sum of the others",
        "these ratios",
        "",
    )
}
