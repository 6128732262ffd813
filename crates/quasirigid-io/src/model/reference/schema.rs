//! JSON Schema (draft 2020-12) of the model file, by which editors complete keys, show their meanings, and mark mistakes.
//! It allows what the readers allow, and leaves to them what depends on several keys.

use serde_json::{Map, Value, json};

use super::{Documented, Form, Key, Keys, Place, Shape, documented};

/// JSON Schema of the model file.
#[must_use]
pub fn schema() -> Value {
    let tables = documented();
    let in_a_file = tables.iter().filter(|table| !matches!(table.place, Place::Inside | Place::Study));
    let properties = in_a_file.map(|table| (table.name.to_owned(), placed(table)));
    let inside = tables.iter().filter(|table| table.place == Place::Inside);
    let definitions = inside.map(|table| (table.name.to_owned(), object(table)));
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Model file of quasirigid",
        "type": "object",
        "properties": properties.collect::<Map<_, _>>(),
        "additionalProperties": false,
        "$defs": definitions.collect::<Map<_, _>>(),
    })
}

fn placed(table: &Documented) -> Value {
    let object = object(table);
    let mut placed = match table.place {
        Place::Several => json!({ "type": "array", "items": object }),
        Place::Named => json!({ "type": "object", "additionalProperties": object }),
        _ => object,
    };
    placed["description"] = table.meaning.into();
    placed
}

/// A table with its keys, and with those of its kind where it has kinds.
fn object(table: &Documented) -> Value {
    let mut object = with_keys(table.keys());
    let variants = table.variants();
    if let (Some(kind), false) = (table.keys().known.first(), variants.is_empty()) {
        let words: Vec<&str> = variants.iter().map(|variant| variant.word).collect();
        object["properties"][kind.name]["enum"] = words.into();
        object["required"] = json!([kind.name]);
        let rule = |variant: &super::Variant| {
            let known: Vec<&str> = variant.keys.names().collect();
            json!({
                "if": { "properties": { kind.name: { "const": variant.word } }, "required": [kind.name] },
                "then": { "propertyNames": { "enum": known } },
            })
        };
        object["allOf"] = variants.iter().map(rule).collect();
    }
    object
}

fn with_keys(keys: &Keys) -> Value {
    let properties = keys.known.iter().map(|key| (key.name.to_owned(), property(key)));
    json!({
        "type": "object",
        "properties": properties.collect::<Map<_, _>>(),
        "additionalProperties": false,
    })
}

fn property(Key { form, meaning, .. }: &Key) -> Value {
    let mut property = value(&form.shape, form);
    let parts = [form.words(), (*meaning).to_owned()];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    property["description"] = parts.join("; ").into();
    property
}

/// Schema of a value; plain numbers have the unit of the form, and texts carry their own.
fn value(shape: &Shape, form: &Form) -> Value {
    let array = |count: usize, item: Value| json!({ "type": "array", "items": item, "minItems": count, "maxItems": count });
    match shape {
        Shape::Number if form.unit.is_empty() => json!({ "type": "number" }),
        Shape::Number | Shape::Formula => json!({ "type": ["number", "string"] }),
        Shape::Integer(least, u64::MAX) => json!({ "type": "integer", "minimum": least }),
        Shape::Integer(least, greatest) => {
            json!({ "type": "integer", "minimum": least, "maximum": greatest })
        }
        Shape::Text | Shape::Kind => json!({ "type": "string" }),
        Shape::Boolean => json!({ "type": "boolean" }),
        Shape::Words(words) => json!({ "enum": words }),
        Shape::Vector => array(3, value(&Shape::Number, form)),
        Shape::Matrix => array(3, value(&Shape::Vector, form)),
        Shape::Quaternion => array(4, value(&Shape::Number, form)),
        Shape::Array(count, item) => array(*count, value(item, form)),
        Shape::List(item) => json!({ "type": "array", "items": value(item, form) }),
        Shape::Table(keys) => with_keys(keys),
        Shape::Shared(name) => json!({ "$ref": format!("#/$defs/{name}") }),
        Shape::Named(item) => json!({ "type": "object", "additionalProperties": value(item, form) }),
        Shape::Value => json!({}),
        Shape::Any(shapes) => {
            json!({ "anyOf": shapes.iter().map(|shape| value(shape, form)).collect::<Vec<_>>() })
        }
    }
}
