use quasirigid::elements::{Cavity, CavityShape};
use quasirigid::math::rotation::ALIGNED;

use super::initial::unit_quaternion;
use super::kinds::{Kind, kind, opened};
use super::spans::ElementSpans;
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

type Read = fn(&Table<'_>) -> Option<CavityShape>;

/// Keys of every cavity.
macro_rules! keys {
    ($($own:literal),*) => {
        &[
            "shape",
            "name",
            $($own,)*
            "center",
            "attitude",
            "density",
            "kinematic_viscosity",
            "dynamic_viscosity",
            "modes",
        ]
    };
}

static SHAPES: [Kind<Read>; 2] = [
    kind!("[[cavity]]", "shape", "sphere", keys!("radius"), sphere),
    kind!("[[cavity]]", "shape", "ellipsoid", keys!("semi_axes"), ellipsoid),
];

/// Keys of a cavity that does not say its shape.
const ANY: Keys = Keys { known: keys!("radius", "semi_axes"), later: &[] };

/// A `[[cavity]]` whose keys have been checked.
pub(super) struct CavityTable<'a> {
    pub(super) table: Table<'a>,
    shape: &'static Kind<Read>,
}

/// Opens every `[[cavity]]` that says what shape it has.
pub(super) fn tables<'a>(file: &Table<'a>) -> Vec<CavityTable<'a>> {
    let open = |value: &Value<'a>| {
        let (table, shape) = opened(value, "[[cavity]]", "shape", &ANY, &SHAPES)?;
        Some(CavityTable { table, shape })
    };
    file.several("cavity", "[[cavity]]").iter().filter_map(open).collect()
}

impl CavityTable<'_> {
    /// Reads it.
    pub(super) fn cavity(&self, name: &str) -> Option<Cavity> {
        let table = &self.table;
        let shape = (self.shape.read)(table);
        let center = table.vector_or_zero("center", Dimension::LENGTH);
        let attitude = match table.get("attitude") {
            Some(value) => unit_quaternion(&value, &mut Vec::new()),
            None => Some(ALIGNED),
        };
        let density = table
            .required("density", "density = 1000.0")
            .and_then(|value| value.positive(Dimension::DENSITY));
        let viscosity = viscosity(table, density);
        let modes = table.get("modes").map_or(Some(0), |value| value.integer(0..=usize::MAX));
        Some(Cavity {
            name: name.to_owned(),
            shape: shape?,
            center: center?,
            attitude: attitude?,
            density: density?,
            viscosity: viscosity?,
            modes: modes?,
        })
    }

    /// Where its values stand; a radius gives the semi-axes, either viscosity the viscosity.
    pub(super) fn spans(&self) -> ElementSpans {
        let mut spans = self.table.spans();
        let aliases = [
            ("radius", "semi_axes"),
            ("kinematic_viscosity", "viscosity"),
            ("dynamic_viscosity", "viscosity"),
        ];
        for (key, field) in aliases {
            if let Some(value) = self.table.get(key) {
                spans.values.push((field, value.span()));
            }
        }
        spans
    }
}

/// Kinematic viscosity (m²/s), from either.
fn viscosity(table: &Table<'_>, density: Option<f64>) -> Option<f64> {
    match (table.get("kinematic_viscosity"), table.get("dynamic_viscosity")) {
        (Some(_), Some(dynamic)) => {
            let message = "`dynamic_viscosity` beside `kinematic_viscosity`: one gives the other".to_owned();
            dynamic.refuse(message, "one of the two", Some("leave one of them out".to_owned()))
        }
        (None, Some(dynamic)) => Some(dynamic.positive(Dimension::DYNAMIC_VISCOSITY)? / density?),
        _ => table
            .required("kinematic_viscosity", "kinematic_viscosity = \"5 cSt\"")?
            .positive(Dimension::KINEMATIC_VISCOSITY),
    }
}

fn sphere(table: &Table<'_>) -> Option<CavityShape> {
    let radius = length(table, "radius", "radius = 0.3")?;
    Some(CavityShape::Ellipsoid { semi_axes: [radius; 3] })
}

fn ellipsoid(table: &Table<'_>) -> Option<CavityShape> {
    let semi_axes = table
        .required("semi_axes", "semi_axes = [0.6, 0.45, 0.3]")
        .and_then(|value| value.array("numbers", |axis| axis.positive(Dimension::LENGTH)))?;
    Some(CavityShape::Ellipsoid { semi_axes })
}

fn length(table: &Table<'_>, key: &'static str, example: &str) -> Option<f64> {
    table.required(key, example).and_then(|value| value.positive(Dimension::LENGTH))
}
