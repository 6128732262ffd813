//! Material reader: `[material.NAME]`, isotropic or orthotropic, shared by the elements that name it.
//! Materials are read before the elements and remember whether one named them, so that an unused one is noted as a likely misspelling.
//! Rheology: (G1), docs/theory/11-materials.md.

use std::cell::Cell;
use std::collections::BTreeMap;

use quasirigid_body::Rheology;
use quasirigid_elements::{ElasticMaterial, Material, Orthotropic};

use super::key::{Form, Keys, Shape, any, key, quantity};
use super::names::suggestion;
use super::rheology::{Extremes, RHEOLOGY, RheologyRange, Scale, rheology};
use super::spans::ElementSpans;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// Constant of an isotropic material, or three of an orthotropic one.
const MODULI: Form = any(&[Shape::Number, Shape::Vector]);

pub(super) const MATERIAL: Keys = Keys {
    known: &[
        key("density", quantity("kg/m³"), ""),
        key("young", MODULI.in_unit("Pa"), "three of an orthotropic material: E1, E2, E3"),
        key("shear", MODULI.in_unit("Pa"), "instead of `young`, or G12, G13, G23"),
        key(
            "mu_Q",
            quantity("Pa"),
            "instead: shear modulus times `Q` of the `rheology` (without one 100, noted)",
        ),
        key("poisson", MODULI, "−1 to 0.5, or ν12, ν13, ν23"),
        RHEOLOGY,
    ],
};

/// Material of an element, and the rheology at both ends of its range.
pub(super) type Made = (ElasticMaterial, Extremes);

/// The `[material.NAME]` tables of a file.
pub(super) struct Materials<'a> {
    entries: BTreeMap<&'a str, Entry>,
}

struct Entry {
    /// The material, if nothing is wrong with it.
    material: Option<Made>,
    spans: ElementSpans,
    /// Whether the quality factor is not the file's.
    quality_chosen: bool,
    /// Whether an element names the material.
    used: Cell<bool>,
}

impl<'a> Materials<'a> {
    /// Reads every material, also those that no element names.
    pub(super) fn new(file: &Table<'a>) -> Self {
        let help = "write [material.rock], and its name in place of rock, with its keys below";
        let open = |value: Value<'a>| {
            let table = value.table("the material", &MATERIAL)?;
            let entry = Entry {
                material: material(&table),
                spans: spans(&table),
                quality_chosen: table.get("mu_Q").is_some() && table.get("rheology").is_none(),
                used: Cell::new(false),
            };
            Some((value.key(), entry))
        };
        Self { entries: file.named("material", help).into_iter().filter_map(open).collect() }
    }

    /// Material of an element that takes isotropic materials alone.
    pub(super) fn of(&self, element: &Table<'_>) -> Option<(Material, Extremes)> {
        element.read("material", "material = \"rock\"", |value| self.isotropic(&value))
    }

    /// The isotropic material with the name that a value gives.
    pub(super) fn isotropic(&self, value: &Value<'_>) -> Option<(Material, Extremes)> {
        match self.named(value)? {
            (ElasticMaterial::Isotropic(material), extremes) => Some((material, extremes)),
            (ElasticMaterial::Orthotropic(_), _) => value.refuse(
                "this needs a material that is the same in every direction",
                "orthotropic",
                "solids and the layers of panels may be orthotropic",
            ),
        }
    }

    /// The material with the name that a value gives.
    pub(super) fn named(&self, value: &Value<'_>) -> Option<Made> {
        let name = value.text()?;
        if let Some(entry) = self.entries.get(name) {
            entry.used.set(true);
            return entry.material.clone();
        }
        let help = match self.entries.len() {
            0 => format!("the file has no materials; add [material.{name}] with density, young and poisson"),
            count => suggestion(name, || self.entries.keys().copied(), count),
        };
        value.refuse(format!("there is no material {name:?}"), "unknown material", help)
    }

    /// Places of the values of an element, also those of its material.
    pub(super) fn spans(&self, element: &Table<'_>) -> ElementSpans {
        let mut spans = element.spans();
        let name = element.get("material").and_then(|value| value.words());
        if let Some(entry) = name.and_then(|name| self.entries.get(name)) {
            spans.values.extend(entry.spans.values.iter().cloned());
        }
        spans
    }

    /// A note on each material whose quality factor was chosen here.
    pub(super) fn chosen(&self) -> impl Iterator<Item = String> {
        let chosen = self.entries.iter().filter(|(_, entry)| entry.quality_chosen);
        chosen.map(|(name, _)| {
            format!("the material {name:?} has `mu_Q` and no Q, so Q = {QUALITY} is taken; times depend on the product alone where the rotation is slow beside the vibrations")
        })
    }

    /// A note on each material that no element names.
    pub(super) fn unused(&self) -> impl Iterator<Item = String> {
        let rest = self.entries.iter().filter(|(_, entry)| !entry.used.get());
        rest.map(|(name, _)| format!("nothing is made of the material {name:?}"))
    }
}

fn material(table: &Table<'_>) -> Option<Made> {
    let density =
        table.read("density", "density = \"2.5 g/cm^3\"", |value| value.positive(Dimension::DENSITY));
    if table.get("young").is_some_and(|value| value.is_array()) {
        return orthotropic(table, density);
    }
    let poisson = table.read("poisson", "poisson = 0.25", |value| {
        value.between(Dimension::NUMBER, [-1.0, 0.5], "between -1 and 0.5")
    });
    let (young, known) = match table.get("mu_Q") {
        Some(product) => of_product(table, &product, poisson)?,
        None => {
            let young = young(table, poisson);
            (young, relative_to(table, young))
        }
    };
    let (density, young, poisson) = (density?, young?, poisson?);
    let RheologyRange { rheology, extremes } = known?;
    Some((ElasticMaterial::Isotropic(Material { density, young, poisson, rheology }), extremes))
}

/// Quality factor of a material of which `mu_Q` alone is known, unless its rheology gives one.
const QUALITY: f64 = 100.0;

/// Young's modulus and the rheology of a material whose product of rigidity and quality factor is known.
fn of_product(
    table: &Table<'_>,
    product: &Value<'_>,
    poisson: Option<f64>,
) -> Option<(Option<f64>, Option<RheologyRange>)> {
    if let Some(modulus) = table.get("young").or_else(|| table.get("shear")) {
        return modulus.refuse(
            format!("`{}` follows from `mu_Q` and `Q`", modulus.key()),
            "given twice",
            "leave out one of the two",
        );
    }
    let known = match table.get("rheology") {
        None => RheologyRange { rheology: Rheology::QualityFactor { factor: QUALITY }, extremes: None },
        Some(_) => relative_to(table, None)?,
    };
    let Rheology::QualityFactor { factor } = known.rheology else {
        return product.refuse(
            "`mu_Q` is the product of the rigidity and the quality factor, and this rheology has none",
            "no Q",
            "write rheology = { kind = \"quality-factor\", Q = 100 }, or `shear` in place of `mu_Q`",
        );
    };
    let shear = product.positive(Dimension::PRESSURE)? / factor;
    Some((poisson.map(|poisson| 2.0 * shear * (1.0 + poisson)), Some(known)))
}

/// Reads the constants of a material with three planes of symmetry.
fn orthotropic(table: &Table<'_>, density: Option<f64>) -> Option<Made> {
    if let Some(product) = table.get("mu_Q") {
        return product.refuse(
            "`mu_Q` is for a material with one rigidity",
            "three moduli",
            "leave it out, and give `shear` and `rheology`",
        );
    }
    let moduli = |key: &'static str, example: &str| {
        let value = table.required(key, example);
        value.and_then(|value| value.array("moduli", |item| item.positive(Dimension::PRESSURE)))
    };
    let young: Option<[f64; 3]> = moduli("young", "young = [\"140 GPa\", \"9 GPa\", \"9 GPa\"]");
    let shear: Option<[f64; 3]> =
        moduli("shear", "shear = [\"5 GPa\", \"5 GPa\", \"3 GPa\"], for 12, 13, 23");
    let poisson = table.read("poisson", "poisson = [0.3, 0.3, 0.45], for 12, 13, 23", |value| {
        value.vector(Dimension::NUMBER)
    });
    let known = relative_to(table, young.map(|young| young[0]));
    let (density, young, poisson, shear) = (density?, young?, poisson?, shear?);
    let RheologyRange { rheology, extremes } = known?;
    Some((ElasticMaterial::Orthotropic(Orthotropic { density, young, poisson, shear, rheology }), extremes))
}

/// Reads the rheology of a material with this modulus.
fn relative_to(table: &Table<'_>, modulus: Option<f64>) -> Option<RheologyRange> {
    // any number does for a missing modulus: the material is refused for it anyway
    rheology(table, Scale { dimension: Dimension::PRESSURE, modulus: modulus.unwrap_or(1.0) })
}

/// Reads Young's modulus, or computes it from the shear modulus: `E = 2 μ (1 + ν)`.
fn young(table: &Table<'_>, poisson: Option<f64>) -> Option<f64> {
    match (table.get("young"), table.get("shear")) {
        (None, Some(shear)) => {
            let shear = shear.positive(Dimension::PRESSURE)?;
            Some(2.0 * shear * (1.0 + poisson?))
        }
        (Some(_), Some(shear)) => shear.refuse(
            "`shear` follows from `young` and `poisson`",
            "given twice",
            "leave out one of the two moduli",
        ),
        (_, None) => table
            .required("young", "young = \"70 GPa\", or shear = \"26 GPa\"")?
            .positive(Dimension::PRESSURE),
    }
}

/// Places of the values of a material; a shear modulus gives Young's.
fn spans(table: &Table<'_>) -> ElementSpans {
    let mut spans = table.spans();
    for key in ["shear", "mu_Q"] {
        spans.values.extend(table.get(key).map(|value| ("young", value.span())));
    }
    spans
}
