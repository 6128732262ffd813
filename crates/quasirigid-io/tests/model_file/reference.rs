//! The reference of the keys: the tables of the guide, the schema for editors, and the words that readers take are those of one list.

use std::fs;
use std::path::{Path, PathBuf};

use quasirigid_io::model::Model;
use quasirigid_io::model::reference::{filled, nearest_table, schema, tables};
use serde_json::Value;

use super::{CARRIER, ELLIPSOID, POINT, ROCK};

/// Set to write the tables of the guide instead of comparing them.
const WRITE: &str = "QUASIRIGID_WRITE_DOCS";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Files below a folder with this name or ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| match path.is_dir() {
            true => files(&path, ending),
            false => Some(path).filter(|path| path.to_string_lossy().ends_with(ending)).into_iter().collect(),
        })
        .collect()
}

#[test]
fn tables_of_keys_in_the_guide_are_those_of_the_readers() {
    let mut named = String::new();
    for file in files(&root().join("docs/guide"), ".md") {
        let chapter = fs::read_to_string(&file).unwrap();
        named += &chapter.lines().filter(|line| line.starts_with("<!-- keys: ")).collect::<String>();
        let filled = filled(&chapter).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        if std::env::var_os(WRITE).is_some() {
            fs::write(&file, filled).unwrap();
        } else {
            assert!(chapter == filled, "{}: set {WRITE}=1 to write its tables anew", file.display());
        }
    }
    let named: Vec<&str> = named.split(' ').collect();
    for table in tables() {
        let shown = named.contains(&table.name) || table.name == "uncertainty"; // which has `values`
        assert!(shown, "no chapter has the keys of {}", table.name);
    }
}

#[test]
fn a_marker_without_a_table_is_refused() {
    let wrong = |chapter: &str| filled(chapter).unwrap_err();
    assert_eq!(
        wrong("<!-- keys: sprin -->\n<!-- end -->\n"),
        "<!-- keys: sprin -->: there is no table \"sprin\""
    );
    assert_eq!(wrong("<!-- keys: spring -->\n"), "<!-- keys: spring --> has no <!-- end -->");
    assert_eq!(nearest_table("sprin"), Some("spring"));
}

/// Whether a schema allows a value: the words of draft 2020-12 that ours has.
fn allows(schema: &Value, root: &Value, value: &Value) -> bool {
    let schema = match schema["$ref"].as_str() {
        Some(place) => root.pointer(&place[1..]).expect("a definition"),
        None => schema,
    };
    let Value::Object(rules) = schema else { return schema == &Value::Bool(true) };
    rules.iter().all(|(rule, wanted)| match rule.as_str() {
        "type" => match wanted {
            Value::String(name) => is_of_type(name, value),
            names => names.as_array().unwrap().iter().any(|name| is_of_type(name.as_str().unwrap(), value)),
        },
        "enum" => wanted.as_array().unwrap().contains(value),
        "const" => wanted == value,
        "minimum" => value.as_f64().is_none_or(|number| number >= wanted.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|number| number <= wanted.as_f64().unwrap()),
        "minItems" => value.as_array().is_none_or(|items| items.len() as u64 >= wanted.as_u64().unwrap()),
        "maxItems" => value.as_array().is_none_or(|items| items.len() as u64 <= wanted.as_u64().unwrap()),
        "items" => value.as_array().is_none_or(|items| items.iter().all(|item| allows(wanted, root, item))),
        "required" => wanted.as_array().unwrap().iter().all(|key| value.get(key.as_str().unwrap()).is_some()),
        "properties" => wanted
            .as_object()
            .unwrap()
            .iter()
            .all(|(key, rule)| value.get(key).is_none_or(|value| allows(rule, root, value))),
        "additionalProperties" => value.as_object().is_none_or(|entries| {
            let known = &schema["properties"];
            entries.iter().all(|(key, value)| known.get(key).is_some() || allows(wanted, root, value))
        }),
        "propertyNames" => value
            .as_object()
            .is_none_or(|entries| entries.keys().all(|key| allows(wanted, root, &key.as_str().into()))),
        "anyOf" => wanted.as_array().unwrap().iter().any(|schema| allows(schema, root, value)),
        "allOf" => wanted.as_array().unwrap().iter().all(|schema| allows(schema, root, value)),
        "if" => !allows(wanted, root, value) || allows(&schema["then"], root, value),
        "then" | "$schema" | "$defs" | "title" | "description" => true,
        other => panic!("{other} is not checked here"),
    })
}

fn is_of_type(name: &str, value: &Value) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        other => panic!("{other} is no type"),
    }
}

fn allowed(text: &str) -> bool {
    let value = serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap();
    let schema = schema();
    allows(&schema, &schema, &value)
}

#[test]
fn the_schema_allows_every_model_that_we_ship() {
    let mut count = 0;
    for file in files(&root().join("examples"), "model.toml") {
        assert!(allowed(&fs::read_to_string(&file).unwrap()), "{}", file.display());
        count += 1;
    }
    for file in files(&root().join("docs/guide"), ".md") {
        let chapter = fs::read_to_string(&file).unwrap();
        let blocks = chapter.split("```toml\n# complete").skip(1).filter_map(|rest| rest.split("```").next());
        for block in blocks {
            assert!(allowed(&format!("#{block}")), "{}: {block}", file.display());
            count += 1;
        }
    }
    assert!(count > 30, "{count}");
}

#[test]
fn the_schema_refuses_what_the_readers_refuse() {
    let sound = format!("{CARRIER}{POINT}");
    assert!(allowed(&sound));
    for (wrong, why) in [
        ("[[points]]\n", "unknown table"),
        ("[[spring]]\nstifness = 1\n", "unknown key"),
        ("[run]\norder = 13\n", "out of range"),
        ("[run]\norder = \"3\"\n", "a text for an integer"),
        ("[run]\nform = \"papr\"\n", "unknown word"),
        ("[support]\nkind = \"free\"\npoint = [0, 0, 0]\n", "key of another kind"),
        ("[support]\npoint = [0, 0, 0]\n", "no kind"),
        ("[initial]\nangular_velocity = [1, 2]\n", "two numbers for three"),
        ("[initial]\nattitude = [\"1\", 0, 0, 0]\n", "a text for a pure number"),
        ("[run]\nstop = { validity = 1 }\n", "a number for a boolean"),
    ] {
        let text = format!("{sound}{wrong}");
        assert!(!allowed(&text), "{why}");
        assert!(Model::parse(Path::new("model.toml"), &text).is_err(), "{why}");
    }
}

/// Words under a key in a schema.
fn words_of(rule: &Value) -> Vec<&str> {
    let own = rule["enum"].as_array().into_iter().flatten();
    let others = rule["anyOf"].as_array().into_iter().flatten().flat_map(|rule| rule["enum"].as_array());
    own.chain(others.flatten()).filter_map(Value::as_str).collect()
}

/// A wrong word is refused with the list of the right ones, which is that of the reference.
#[test]
fn words_of_the_reference_are_those_that_readers_take() {
    let schema = schema();
    let mut count = 0;
    for (table, rule) in schema["properties"].as_object().unwrap() {
        let (header, rule) = match (&rule["items"], &rule["additionalProperties"]) {
            (Value::Object(_), _) => (format!("[[{table}]]"), &rule["items"]),
            (_, Value::Object(_)) => (format!("[{table}.x]"), &rule["additionalProperties"]),
            _ => (format!("[{table}]"), rule),
        };
        for (key, rule) in rule["properties"].as_object().unwrap() {
            let words = words_of(rule);
            if words.is_empty() || ["axes", "interpolation"].contains(&&**key) {
                continue; // those of forces, read once other keys are right
            }
            let body = if table == "carrier" { String::new() } else { format!("{CARRIER}{POINT}") };
            let kind = match (table.as_str(), key.as_str()) {
                ("cavity", "flow") | ("tank", "settled_by" | "surface") => "shape = \"sphere\"\nradius = 1\n",
                ("force", "shape") => "kind = \"eddy-current\"\nconductivity = 1\n",
                _ => "",
            };
            let text = format!("{body}{header}\n{kind}{key} = \"no such word\"\n");
            let message = Model::parse(Path::new("model.toml"), &text).unwrap_err().to_string();
            for word in words {
                assert!(message.contains(word), "{table}.{key} does not take {word}: {message}");
            }
            count += 1;
        }
    }
    assert!(count >= 8, "{count}");
    assert!(allowed(&format!("{ELLIPSOID}[material.rock]\n{ROCK}")));
}
