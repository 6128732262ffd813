//! Rheology reader: six laws of viscoelastic response, each with an optional range of its first parameter.
//! A range gives the rheology at both ends, from which runs bound the times of the evolution; a measured table has none.
//! Equation (G1), docs/theory/11-materials.md.

use quasirigid_body::{Measured, Rheology, RheologyError};

use super::key::{KIND, Key, Keys, NUMBER, Shape, array, key, list, pick, quantity, shared};
use super::kinds::{Kind, Variant, kind, opened, variants};
use super::settings::optional;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// A rheology as a file gives it.
#[derive(Clone, Default)]
pub(super) struct RheologyRange {
    pub(super) rheology: Rheology,
    pub(super) extremes: Extremes,
}

/// Extremes: the rheology at the least and the greatest of its parameter, if the file gives a range.
pub(super) type Extremes = Option<[Rheology; 2]>;

/// Dimension of measured moduli, and the modulus that they are relative to.
#[derive(Clone, Copy)]
pub(super) struct Scale {
    pub(super) dimension: Dimension,
    pub(super) modulus: f64,
}

impl Scale {
    /// Plain numbers, multiples of the stiffness of a spring.
    pub(super) const OF_SPRING: Self = Self { dimension: Dimension::NUMBER, modulus: 1.0 };
}

type Read = fn(&Table<'_>, Scale) -> Option<RheologyRange>;

/// Law of dissipation of an element or a material.
pub(super) const RHEOLOGY: Key = key("rheology", shared("rheology").or("elastic"), "dissipation");

static KINDS: [Kind<Read>; 6] = [
    kind!(
        "`rheology`",
        "kelvin-voigt",
        ["kind", "time", "range"],
        "1 + iντ, a parallel dashpot",
        kelvin_voigt
    ),
    kind!("`rheology`", "quality-factor", ["kind", "Q", "range"], "1 + i/Q", quality_factor),
    kind!("`rheology`", "maxwell", ["kind", "time", "range"], "iντ/(1 + iντ), a dashpot in series", maxwell),
    kind!(
        "`rheology`",
        "standard-linear",
        ["kind", "time", "strength", "range"],
        "1 + Δ iντ/(1 + iντ)",
        standard_linear
    ),
    kind!(
        "`rheology`",
        "andrade",
        ["kind", "time", "creep_time", "exponent", "range"],
        "1/[1 + Γ(1+α)(iντA)^−α − i/ντ]",
        andrade
    ),
    kind!("`rheology`", "table", ["kind", "rows"], "as measured", measured),
];

/// Keys of a rheology without a kind: those of every kind.
pub(super) const ANY: Keys = Keys {
    known: &[
        key("kind", KIND, ""),
        key("time", quantity("s"), "τ"),
        key("Q", NUMBER, "at least 1"),
        key("strength", NUMBER, "Δ"),
        key("creep_time", quantity("s").or("τ"), "τA"),
        key("exponent", NUMBER.or("1/3"), "α, between 0 and 1"),
        key(
            "range",
            array(2, &Shape::Number).in_unit("its unit").or("none"),
            "least and greatest value of the key after `kind`",
        ),
        key(
            "rows",
            list(&Shape::Array(3, &Shape::Number)).in_unit("rad/s, Pa"),
            "frequency, modulus and loss of each: `[[\"1 Hz\", \"9.3 GPa\", 0.01], …]`",
        ),
    ],
};

/// Documentation of the kinds.
pub(super) fn documented() -> Vec<Variant> {
    variants(&KINDS)
}

/// Exponent of Andrade's law unless the file chooses another: Andrade's own, for metals.
const ANDRADE: f64 = 1.0 / 3.0;

/// Reads the `rheology` of an element, elastic if there is none.
pub(super) fn rheology(table: &Table<'_>, scale: Scale) -> Option<RheologyRange> {
    let Some(value) = table.get("rheology") else { return Some(RheologyRange::default()) };
    if !value.is_table() {
        return value.mismatch("a table", "write for example { kind = \"quality-factor\", Q = 100 }");
    }
    let (table, kind) = opened(&value, "`rheology`", "kind", &ANY, &KINDS)?;
    (kind.read)(&table, scale)
}

fn kelvin_voigt(table: &Table<'_>, _: Scale) -> Option<RheologyRange> {
    Some(time(table)?.of(|time| Rheology::KelvinVoigt { time }))
}

fn quality_factor(table: &Table<'_>, _: Scale) -> Option<RheologyRange> {
    let factor = Parameter::read(table, "Q", "Q = 100", Dimension::NUMBER, |value| value.quality())?;
    Some(factor.of(|factor| Rheology::QualityFactor { factor }))
}

fn maxwell(table: &Table<'_>, _: Scale) -> Option<RheologyRange> {
    Some(time(table)?.of(|time| Rheology::Maxwell { time }))
}

fn standard_linear(table: &Table<'_>, _: Scale) -> Option<RheologyRange> {
    let time = time(table);
    let strength = table.required("strength", "strength = 0.1")?.positive(Dimension::NUMBER)?;
    Some(time?.of(|time| Rheology::StandardLinear { time, strength }))
}

fn andrade(table: &Table<'_>, _: Scale) -> Option<RheologyRange> {
    let time = time(table);
    let creep_time = optional(table.get("creep_time"), |value| value.positive(Dimension::TIME));
    let exponent = table.read_or("exponent", ANDRADE, |value| {
        value.between(Dimension::NUMBER, [0.0, 1.0], "between 0 and 1")
    });
    let (creep_time, exponent) = (creep_time?, exponent?);
    let law = |time| Rheology::Andrade { time, creep_time: creep_time.unwrap_or(time), exponent };
    Some(time?.of(law))
}

fn measured(table: &Table<'_>, scale: Scale) -> Option<RheologyRange> {
    let value = table.required("rows", "rows = [[\"1 Hz\", \"70 GPa\", 0.01]]")?;
    let rows = value.list("rows of frequency, modulus and loss", |row| measurement(&row, scale))?;
    match Measured::new(rows.clone()) {
        Ok(measured) => Some(RheologyRange { rheology: Rheology::Table(measured), extremes: None }),
        Err(error) => {
            let span = descent(&rows, error).and_then(|row| Some(value.items()?.get(row)?.span()));
            let help = "write a row for each frequency, the lowest first";
            let message = format!("`rows`: {error}");
            value.refuse_at(span.unwrap_or_else(|| value.span()), message, "not a table", help)
        }
    }
}

/// Reads a frequency, the modulus there relative to that of the element, and the loss.
fn measurement(row: &Value<'_>, scale: Scale) -> Option<[f64; 3]> {
    let [frequency, modulus, loss] = row.array("numbers", Some)?;
    let frequency = frequency.positive(Dimension::FREQUENCY);
    let modulus = modulus.positive(scale.dimension);
    let loss = loss.positive(Dimension::NUMBER);
    Some([frequency?, modulus? / scale.modulus, loss?])
}

/// The row whose frequency does not ascend.
fn descent(rows: &[[f64; 3]], error: RheologyError) -> Option<usize> {
    let RheologyError::NotAscending { previous, next } = error else { return None };
    let found = rows.array_windows().position(|[a, b]| (a[0], b[0]) == (previous, next))?;
    Some(found + 1)
}

/// The first parameter of a law, and its range.
struct Parameter {
    value: f64,
    range: Option<[f64; 2]>,
}

fn time(table: &Table<'_>) -> Option<Parameter> {
    let positive = |value: &Value<'_>| value.positive(Dimension::TIME);
    Parameter::read(table, "time", "time = \"100 s\"", Dimension::TIME, positive)
}

impl Parameter {
    fn read(
        table: &Table<'_>,
        key: &'static str,
        example: &str,
        dimension: Dimension,
        allowed: impl Fn(&Value<'_>) -> Option<f64>,
    ) -> Option<Self> {
        let value = table.read(key, example, |value| allowed(&value));
        let range = optional(table.get("range"), |range| {
            let ends = range.array("numbers", |item| allowed(&item))?;
            around(&range, key, ends, value?, dimension)
        });
        Some(Self { value: value?, range: range? })
    }

    fn of(&self, law: impl Fn(f64) -> Rheology) -> RheologyRange {
        RheologyRange { rheology: law(self.value), extremes: self.range.map(|ends| ends.map(law)) }
    }
}

/// A range, if the value of the key lies in it.
fn around(
    range: &Value<'_>,
    key: &str,
    [least, greatest]: [f64; 2],
    value: f64,
    dimension: Dimension,
) -> Option<[f64; 2]> {
    if (least..=greatest).contains(&value) {
        return Some([least, greatest]);
    }
    let unit = dimension.unit();
    let space = if unit.is_empty() { "" } else { " " };
    let message =
        format!("`range` goes from {least} to {greatest}{space}{unit}, but `{key}` is {value}{space}{unit}");
    let help = format!("write the least and the greatest value that `{key}` may have");
    range.refuse(message, &format!("`{key}` is not in it"), help)
}
