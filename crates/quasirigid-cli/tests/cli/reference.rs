//! `keys`: one table, all of them; `schema`.

use std::fs;

use serde_json::Value;

use crate::support::{ROOT, ran};

#[test]
fn a_table_is_printed_with_values_and_meanings() {
    let spring = ran("keys spring");
    assert_eq!((spring.code, &*spring.stderr), (Some(0), ""));
    assert!(spring.stdout.starts_with("[[spring]]: spring and dashpot\n  name"), "{}", spring.stdout);
    let damping = "  damping         1, 3 or 3×3, N s/m (0); of a parallel dashpot\n";
    assert!(spring.stdout.contains(damping), "{}", spring.stdout);
    assert_eq!(ran("keys [[spring]]").stdout, spring.stdout);
    assert!(spring.stdout.lines().all(|line| line.chars().count() <= 80), "{}", spring.stdout);
}

#[test]
fn every_table_is_printed_where_none_is_named() {
    let all = ran("keys").stdout;
    for table in ["[carrier]", "[material.NAME]", "[[spring]]", "[[cavity]]", "rheology", "study file"] {
        assert!(all.lines().any(|line| line.starts_with(&format!("{table}: "))), "{table}: {all}");
    }
    let kind = "\"maxwell\"          time, range; iντ/(1 + iντ), a dashpot in series";
    assert!(all.contains(kind), "{all}");
    let json = ran("keys --json").json();
    let names = json["tables"].as_array().unwrap().iter().map(|table| table["name"].as_str().unwrap());
    assert!(names.eq(all.lines().filter_map(|line| line.split_once(": ")).filter_map(|(title, _)| {
        let bare = title.trim_matches(['[', ']']).split('.').next()?;
        (!title.starts_with(' ')).then_some(if title == "study file" { "study" } else { bare })
    })));
}

#[test]
fn an_unknown_table_is_refused_with_the_nearest() {
    let refused = ran("keys sprin");
    assert!(refused.refusal().contains("no table \"sprin\"; did you mean \"spring\"?"), "{}", refused.stderr);
}

#[test]
fn the_schema_is_that_of_the_model_file() {
    let schema = ran("schema").json();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    let stiffness = &schema["properties"]["spring"]["items"]["properties"]["stiffness"];
    let meaning = "1, 3 or 3×3, N/m; isotropic, along the file's axes, or a symmetric matrix";
    assert_eq!(stiffness["description"], meaning);
    let examples = fs::read_to_string(format!("{ROOT}/examples/schema.json")).unwrap();
    assert_eq!(
        serde_json::from_str::<Value>(&examples).unwrap(),
        schema,
        "quasirigid schema > examples/schema.json"
    );
}
