use std::collections::{BTreeMap, HashSet};

use quasirigid::elements::Material;

use super::names::suggestion;
use super::rheology::{Extremes, Known, Scale, rheology};
use super::spans::ElementSpans;
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

const MATERIAL: Keys = Keys { known: &["density", "young", "shear", "poisson", "rheology"], later: &[] };

/// What an element is made of, and its rheology at the ends of the range it is known to.
pub(super) type Made = (Material, Extremes);

/// The `[material.NAME]` tables of a file.
pub(super) struct Materials<'a> {
    entries: BTreeMap<&'a str, Entry>,
}

struct Entry {
    /// The material, if nothing is wrong with it.
    material: Option<Made>,
    spans: ElementSpans,
}

impl<'a> Materials<'a> {
    /// Reads every material, also those that nothing is made of.
    pub(super) fn new(file: &Table<'a>) -> Self {
        let help = "write [material.rock], and its name in place of rock, with its keys below";
        let Some(value) = file.get("material") else { return Self { entries: BTreeMap::new() } };
        let Some(named) = value.entries() else {
            value.mismatch::<()>("a table for each material", help);
            return Self { entries: BTreeMap::new() };
        };
        let open = |(_, value): (_, Value<'a>)| {
            if !value.is_table() {
                return value.mismatch("a table with the name of a material", help);
            }
            let table = value.table("the material", &MATERIAL)?;
            Some((value.key(), Entry { material: material(&table), spans: spans(&table) }))
        };
        Self { entries: named.filter_map(open).collect() }
    }

    /// What an element is made of.
    pub(super) fn of(&self, element: &Table<'_>) -> Option<Made> {
        element.required("material", "material = \"rock\"").and_then(|value| self.named(&value))
    }

    /// The material with the name that a value gives.
    fn named(&self, value: &Value<'_>) -> Option<Made> {
        let name = value.text()?;
        if let Some(entry) = self.entries.get(name) {
            return entry.material.clone();
        }
        let help = match self.entries.len() {
            0 => format!("the file has no materials; add [material.{name}] with density, young and poisson"),
            count => suggestion(name, || self.entries.keys().copied(), count),
        };
        value.refuse(format!("there is no material {name:?}"), "unknown material", Some(help))
    }

    /// Where the values of an element stand, also those of its material.
    pub(super) fn spans(&self, element: &Table<'_>) -> ElementSpans {
        let mut spans = element.spans();
        let name = element.get("material").and_then(|value| value.words());
        if let Some(entry) = name.and_then(|name| self.entries.get(name)) {
            spans.values.extend(entry.spans.values.iter().cloned());
        }
        spans
    }

    /// A note on each material that none of these elements is made of.
    pub(super) fn unused<'t>(
        &self,
        elements: impl Iterator<Item = &'t Table<'a>>,
    ) -> impl Iterator<Item = String>
    where
        'a: 't,
    {
        let name = |table: &Table<'a>| table.get("material")?.words();
        let used: HashSet<&str> = elements.filter_map(name).collect();
        let rest = self.entries.keys().filter(move |name| !used.contains(*name));
        rest.map(|name| format!("nothing is made of the material {name:?}"))
    }
}

fn material(table: &Table<'_>) -> Option<Made> {
    let density = table
        .required("density", "density = \"2.5 g/cm^3\"")
        .and_then(|value| value.positive(Dimension::DENSITY));
    let poisson = table
        .required("poisson", "poisson = 0.25")
        .and_then(|value| value.between(Dimension::NUMBER, [-1.0, 0.5], "between -1 and 0.5"));
    let young = young(table, poisson);
    // the unit of the moduli does not matter where the material is refused for its own modulus
    let scale = Scale { dimension: Dimension::PRESSURE, modulus: young.unwrap_or(1.0) };
    let known = rheology(table, scale);
    let (density, young, poisson) = (density?, young?, poisson?);
    let Known { rheology, extremes } = known?;
    Some((Material { density, young, poisson, rheology }, extremes))
}

/// Reads Young's modulus, or the shear modulus and makes it of that: `E = 2 μ (1 + ν)`.
fn young(table: &Table<'_>, poisson: Option<f64>) -> Option<f64> {
    match (table.get("young"), table.get("shear")) {
        (None, Some(shear)) => {
            let shear = shear.positive(Dimension::PRESSURE)?;
            Some(2.0 * shear * (1.0 + poisson?))
        }
        (Some(_), Some(shear)) => shear.refuse(
            "`shear` follows from `young` and `poisson`".to_owned(),
            "given twice",
            Some("leave out one of the two moduli".to_owned()),
        ),
        (_, None) => table
            .required("young", "young = \"70 GPa\", or shear = \"26 GPa\"")?
            .positive(Dimension::PRESSURE),
    }
}

/// Where its values stand; a shear modulus gives Young's.
fn spans(table: &Table<'_>) -> ElementSpans {
    let mut spans = table.spans();
    if let Some(shear) = table.get("shear") {
        spans.values.push(("young", shear.span()));
    }
    spans
}
