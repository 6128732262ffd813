//! Keys that `--json` prints are those that the guide lists, and no number is printed as a text.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{MODEL, ROOT, ran, ran_in, ran_with};

type Keys = BTreeSet<String>;

/// Objects whose keys are names of the model.
const BY_NAME: [&str; 3] = ["dissipation", "displacements", "moves"];

/// Keys of an object and of all in it, with those that they belong to before a dot.
fn keys(value: &Value, path: &str, found: &mut Keys) {
    match value {
        Value::Object(entries) => {
            for (key, value) in entries {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                if !(BY_NAME.contains(&&**key) && value.is_object()) {
                    keys(value, &path, found);
                }
                found.insert(path);
            }
        }
        Value::Array(entries) => entries.iter().for_each(|entry| keys(entry, path, found)),
        Value::String(text) => assert!(!["inf", "-inf", "NaN"].contains(&&**text), "{path} is {text:?}"),
        _ => {}
    }
}

/// Keys that commands print, all together.
fn printed(lines: &[&str]) -> Keys {
    let mut found = Keys::new();
    for line in lines {
        keys(&ran(&format!("{line} --json --quiet")).json(), "", &mut found);
    }
    found.retain(|key| key != "inputs" && !key.starts_with("inputs."));
    found
}

/// Keys that `check` prints of a tetrahedron whose facets share no corners.
fn of_a_shape() -> Keys {
    let corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"];
    let facets = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let vertices: String =
        facets.iter().flatten().map(|corner: &usize| format!("v {}\n", corners[*corner])).collect();
    let model = "[material.rock]\ndensity = 2000\nshear = 1e9\npoisson = 0.25\n\
        [[surface]]\nfile = \"shape.obj\"\nunit = \"km\"\nmaterial = \"rock\"\n[initial]\nangular_velocity = [0, 0, 1e-4]\n";
    let folder = tempfile::TempDir::new().unwrap();
    fs::write(folder.path().join("shape.obj"), vertices + "f 1 2 3\nf 4 5 6\nf 7 8 9\nf 10 11 12\n").unwrap();
    fs::write(folder.path().join("model.toml"), model).unwrap();
    let mut found = Keys::new();
    keys(&ran_in(folder.path(), "check model.toml --json --quiet").json(), "", &mut found);
    found.retain(|key| key.starts_with("shapes"));
    found
}

/// Keys that a command prints of a body of so many coordinates that the slowest modes alone are found.
fn of_many_coordinates(command: &str) -> Keys {
    let point = |k: usize| {
        let (name, at, stiffness) = (format!("p{k}"), [1.0, 0.01 * k as f64, 0.3], 150 + 13 * k);
        format!(
            "[[point]]\nname = {name:?}\nmass = 0.2\nposition = {at:?}\n[[spring]]\nfrom = {name:?}\nto = \"carrier\"\n\
             stiffness = {stiffness}\ndamping = 0.3\n"
        )
    };
    let carrier = "[carrier]\nmass = 40\ncenter_of_mass = [0, 0, 0]\ninertia = [9, 13, 16]\n";
    let start = "[initial]\nangular_velocity = [0.05, 0.02, 0.4]\n";
    let model = format!("{carrier}{start}{}", (0..60).map(point).collect::<String>());
    let mut found = Keys::new();
    keys(&ran_with(&model, &format!("{command} model.toml --json --quiet")).json(), "", &mut found);
    found.retain(|key| key.contains("slowest"));
    found
}

/// Every object has its inputs, which the guide describes once.
#[test]
fn keys_of_inputs_are_in_the_guide() {
    let page = fs::read_to_string(Path::new(ROOT).join("docs/guide").join(PAGE)).unwrap();
    for command in ["check", "modes", "derive", "evolve"] {
        let mut found = Keys::new();
        let answer = ran(&format!("{command} examples/nutation-damper/model.toml --json --quiet")).json();
        keys(&answer["inputs"], "", &mut found);
        assert!(found.contains("files.sha256") && found.contains("body.mass"), "{command}: {found:?}");
        let told = |key: &&String| page.contains(&format!("`{}`", key.rsplit('.').next().unwrap()));
        let missing: Vec<_> = found.iter().filter(|key| !told(key)).collect();
        assert!(missing.is_empty(), "{command}: {missing:?}");
    }
}

/// Keys that `simulate` prints of a body under a pulse that its parts cannot follow.
fn of_a_pulse() -> Keys {
    let model = "[carrier]\nmass = 40\ncenter_of_mass = [0, 0, 0]\ninertia = [9, 13, 16]\n\
        [[point]]\nname = \"tip\"\nmass = 2\nposition = [0.9, 0.2, 0.4]\n\
        [[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 200\ndamping = 8\n\
        [[force]]\nkind = \"torque\"\ntorque = [0, 2, 0]\nduring = [[0.5, 0.51]]\n\
        [initial]\nangular_velocity = [0, 0, 1e-3]\n";
    let folder = tempfile::TempDir::new().unwrap();
    fs::write(folder.path().join("model.toml"), model).unwrap();
    let asked = "simulate model.toml --system reduced --samples 2 --duration 1 --json --quiet";
    let mut found = Keys::new();
    keys(&ran_in(folder.path(), asked).json(), "", &mut found);
    found.retain(|key| key.starts_with("ringing"));
    assert_eq!(found.len(), 5, "{found:?}");
    found
}

/// Keys in the first column of the tables under a heading of a page.
fn listed(page: &str, heading: &str) -> Keys {
    let page = fs::read_to_string(Path::new(ROOT).join("docs/guide").join(page)).unwrap();
    let (_, section) = page.split_once(&format!("\n## {heading}\n")).expect(heading);
    let rows = section.split("\n## ").next().unwrap().lines().filter_map(|line| line.strip_prefix('|'));
    let cells = rows.filter_map(|row| row.split('|').next());
    cells.flat_map(|cell| cell.split('`').skip(1).step_by(2)).map(str::to_owned).collect()
}

fn under(key: &str, keys: &Keys) -> Keys {
    keys.iter().map(|inner| format!("{key}.{inner}")).collect()
}

/// The difference, both ways.
#[track_caller]
fn assert_same(printed: &Keys, listed: &Keys) {
    let missing: Vec<_> = printed.difference(listed).collect();
    let stale: Vec<_> = listed.difference(printed).collect();
    assert!(missing.is_empty() && stale.is_empty(), "not in the guide: {missing:?}; not printed: {stale:?}");
}

const PAGE: &str = "13-json.md";

#[test]
fn keys_of_check_and_modes_are_those_of_the_guide() {
    let spin = listed(PAGE, "Modes of a steady spin");
    let spins = under("steady_spins", &spin);
    let models = ["mercury-ring", "solar-panels", "ring-damper"]
        .map(|name| format!("check examples/{name}/model.toml"));
    let mut check = printed(&models.each_ref().map(String::as_str));
    check.extend(
        ["name", "degree", "cells", "error", "sentence"]
            .iter()
            .skip(1)
            .map(|key| format!("resolution.{key}")),
    );
    check.extend(printed(&[
        "check examples/nutation-damper/model.toml",
        "check examples/two-tanks/model.toml",
    ]));
    check.extend(of_a_shape());
    check.extend(of_many_coordinates("check"));
    let equations = under("about_spin.equations", &about_spin());
    check.retain(|key| !equations.contains(key));
    check.insert("steady_spins.modes.rate_bound".into()); // of a mode whose rate rounding hides: study::modes
    assert_same(&check, &(&listed(PAGE, "`check`") | &spins));
    let mut modes =
        printed(&["modes examples/three-masses/model.toml", "modes examples/heavy-top/model.toml"]);
    modes.extend(of_many_coordinates("modes"));
    modes.insert("steady_spins.modes.rate_bound".into());
    modes.insert("modes.rate_bound".into());
    modes.insert("no_solid".into()); // of a material that flows: cli::materials
    modes.insert("sleeping_forces".into()); // of forces that act later: study::modes
    assert_same(&modes, &(&(&listed(PAGE, "`modes`") | &spin) | &spins));
}

/// Keys of reduced equations about a spin, with those of their terms.
fn about_spin() -> Keys {
    listed(PAGE, "`derive --about spin`")
}

#[test]
fn keys_of_equations_about_a_spin_are_those_of_the_guide() {
    let mut derive = printed(&[
        "derive examples/explorer1/model.toml --about spin",
        "derive examples/nutation-damper/model.toml --about spin --degree 3",
    ]);
    // met by few bodies
    derive.extend(["name", "harmonic", "nutation", "frequency"].map(|key| format!("met.{key}")));
    derive.extend(["spin", "name", "frequency"].map(|key| format!("whirl_onset.{key}")));
    derive.extend(["exponents", "name", "frequency", "distance"].map(|key| format!("resonances.{key}")));
    assert_same(&derive, &about_spin());
}

#[test]
fn keys_of_histories_are_those_of_the_guide() {
    let simulate = printed(&["simulate examples/three-masses/model.toml --samples 2 --duration 1"]);
    let mut simulate = simulate;
    simulate.extend(of_a_pulse());
    simulate.extend(printed(&[
        "simulate examples/nutation-damper/model.toml --system spin-manifold --times 0,1",
    ]));
    assert_same(&simulate, &listed(PAGE, "`simulate`"));
    let verify = "verify examples/boom-satellite/model.toml --orders 1 --halvings 2";
    assert_same(&printed(&[verify]), &listed(PAGE, "`verify`"));
}

#[test]
fn keys_of_evolve_are_those_of_the_guide() {
    let mut evolve = printed(&[
        "evolve examples/apophis/model.toml",
        "evolve examples/nutation-damper/model.toml",
        "evolve examples/nutation-damper/model.toml --start 80deg --until 5deg --method average",
    ]);
    evolve.insert("uncertainty".to_owned()); // with --uncertainty-samples alone
    assert_same(&evolve, &listed(PAGE, "`evolve`"));
}

#[test]
fn keys_of_derive_are_those_of_the_guide() {
    let derive =
        printed(&["derive examples/three-masses/model.toml", "derive examples/heavy-top/model.toml"]);
    let term = ["exponents", "value"].map(str::to_owned).into();
    let polynomials = [
        "mu",
        "momentum",
        "spin_of_momentum",
        "energy_of_momentum",
        "c",
        "T",
        "force",
        "energy",
        "power",
        "displacements",
        "rates",
    ];
    let terms = polynomials.iter().filter(|name| derive.contains(&format!("{name}.value")));
    let terms = terms.fold(Keys::new(), |all, name| &all | &under(name, &term));
    let start = listed("04-derive-equations.md", "Under forces");
    let displaced = ["moment_variation", "force_variation", "mu", "phi", "displacements"];
    let forces: Keys = start
        .iter()
        .map(|key| match displaced.contains(&&**key) {
            true => format!("forces.start.displaced.{key}"),
            false => format!("forces.start.{key}"),
        })
        .chain(["forces.names", "forces.start"].map(str::to_owned))
        .collect();
    assert_same(&derive, &(&(&listed("04-derive-equations.md", "As JSON") | &terms) | &forces));
}

#[test]
fn keys_of_light_curves_are_those_of_the_guide() {
    let view = "docs/guide/data/sky.csv --epoch 2449000.5 --absolute-magnitude 15.3";
    let mut curve = printed(&[&format!("lightcurve examples/toutatis/model.toml --view {view} --periods")]);
    // with measured brightness alone
    let measured = ["", ".rms", ".blocks", ".blocks.block", ".blocks.points", ".blocks.scale", ".blocks.rms"];
    curve.extend(measured.map(|key| format!("residuals{key}")));
    assert_same(&curve, &listed(PAGE, "`lightcurve`"));
}

#[test]
fn keys_of_yorp_are_those_of_the_guide() {
    let found = printed(&["yorp examples/sunlit-rock/model.toml"]);
    assert_same(&found, &listed(PAGE, "`yorp`"));
}

/// A refused evolution has unknown numbers, and lists them; events that never happen have infinite times.
#[test]
fn null_is_what_is_infinite_or_not_known() {
    let refused = ran("evolve examples/spherical-tank/model.toml --method full --json --quiet").json();
    assert!(refused["time"].is_null() && refused["power"].is_null(), "{refused}");
    assert_eq!(refused["not_known"], serde_json::json!(["time", "turns"]));
    let lossless = MODEL.replace("damping = 30.0", "damping = 0.0");
    let forever = ran_with(&lossless, "evolve model.toml --until 0.99 --json --quiet").json();
    assert!(forever["time"].is_null() && forever["damping_time"].is_null(), "{forever}");
    assert_eq!(forever["not_known"], serde_json::json!([]));
}
