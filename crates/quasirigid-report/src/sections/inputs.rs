//! What went in: the body that the inputs give, the files, and the values after units and defaults.

use maud::{Markup, html};
use quasirigid_io::record::{DerivedBodyRecord, InputsRecord};
use serde_json::Value;

use super::table::{facts, first, table};
use crate::number::{short, tidy};

/// Most values that are listed.
const MOST: usize = 400;

/// What went into the numbers of this record.
pub fn section(inputs: &InputsRecord) -> Markup {
    let files = html! {
        @for file in &inputs.files {
            tr { th scope="row" { (file.name) } td { (file.bytes) } td { code { (file.sha256) } } }
        }
    };
    html! {
        section.inputs aria-label="Inputs" {
            h2 { "What went in" }
            @if let Some(body) = &inputs.body { (derived(body)) }
            (table("Files that were read", &["File", "Bytes", "SHA-256"], files))
            (values(inputs))
        }
    }
}

fn derived(body: &DerivedBodyRecord) -> Markup {
    let quantity = |value: Option<f64>, unit: &str| value.map(|value| html! { (tidy(value, 5)) " " (unit) });
    let triple = |values: [f64; 3]| values.map(short).join(", ");
    let rows = [
        ("Mass", quantity(Some(body.mass), "kg")),
        ("Extent along the axes of the file", body.size.map(|size| html! { (triple(size)) " m" })),
        ("Volume of the solids", quantity(body.volume, "m³")),
        ("Principal moments", Some(html! { (triple(body.principal_moments)) " kg·m²" })),
        ("Density", quantity(body.density, "kg/m³")),
        ("Shear modulus μ", quantity(body.shear, "Pa")),
        ("Quality factor Q", quantity(body.quality_factor, "")),
        ("μQ", quantity(body.mu_Q, "Pa")),
    ];
    let known: Vec<(&str, Markup)> =
        rows.into_iter().filter_map(|(name, value)| Some((name, value?))).collect();
    facts("Body that the inputs give", &known)
}

fn values(inputs: &InputsRecord) -> Markup {
    let (shown, more) = first(&inputs.values, MOST);
    let rows = html! {
        @for value in shown {
            tr {
                th scope="row" { (value.key) }
                td { (text(&value.value)) @if !value.unit.is_empty() { " " (value.unit) } }
                td { @if value.default { "default" } @else { "given" } }
            }
        }
    };
    html! {
        (table("Values, in SI units", &["Key", "Value", "From"], rows))
        @if let Some(more) = more { p.remark { (more) } }
        @if inputs.values_left_out > 0 {
            p.remark { (inputs.values_left_out) " further values are told by the checksum of the model alone." }
        }
    }
}

fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), short),
        Value::Array(values) => values.iter().map(text).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}
