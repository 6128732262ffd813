//! Layers: the table of allowed imports, and no foreign types in public signatures.

mod imports;
mod signatures;
mod source;

use crate::finding::Finding;
use crate::tree::{Tree, is_below};
use source::Source;

/// The crate of the physics.
const PHYSICS: &str = "quasirigid";

/// Modules that each top-level module of the physics crate may use, beside itself: the description of a body in a row, then a star
/// without sideways arrows. `math` is the crate `quasirigid-math` by its name in the physics.
const MODULES: [(&str, &[&str]); 15] = [
    ("model", &["math"]),
    ("finite", &["math", "model"]),
    ("flow", &["math", "model", "finite"]),
    ("structure", &["math", "model", "finite"]),
    ("elements", &["math", "model", "finite", "flow", "structure"]),
    ("reduction", &["math", "model"]),
    ("dynamics", &["math", "model"]),
    ("averaging", &["math", "model"]),
    ("modes", &["math", "model"]),
    ("submanifold", &["math", "model", "dynamics", "averaging", "modes"]),
    ("secular", &["math", "model", "reduction", "dynamics", "averaging", "modes", "submanifold"]),
    (
        "verification",
        &["math", "model", "reduction", "dynamics", "averaging", "modes", "submanifold", "secular"],
    ),
    ("problems", &["math", "model", "elements", "reduction", "dynamics", "averaging"]),
    (
        "error",
        &[
            "math",
            "model",
            "elements",
            "reduction",
            "dynamics",
            "averaging",
            "modes",
            "submanifold",
            "secular",
            "verification",
        ],
    ),
    (
        "prelude",
        &[
            "math",
            "model",
            "elements",
            "reduction",
            "dynamics",
            "averaging",
            "modes",
            "submanifold",
            "verification",
        ],
    ),
];

/// Modules that each crate may use of the others.
const CRATES: [(&str, &[&str]); 10] = [
    ("quasirigid-linear", &[]),
    ("quasirigid-math", &["quasirigid_linear"]),
    ("quasirigid-mesh", &["quasirigid_math"]),
    ("quasirigid", &["quasirigid_math", "quasirigid_mesh"]),
    (
        "quasirigid-io",
        &[
            "quasirigid_math",
            "quasirigid_mesh",
            "quasirigid::model",
            "quasirigid::elements",
            "quasirigid::dynamics::Form",
            "quasirigid::dynamics::Method",
        ],
    ),
    ("quasirigid-report", &["quasirigid_io::record", "quasirigid_io::visible"]),
    ("quasirigid-study", &["quasirigid", "quasirigid_math", "quasirigid_io", "quasirigid_report"]),
    ("quasirigid-cli", &["quasirigid", "quasirigid_io", "quasirigid_study"]),
    ("quasirigid-python", &["quasirigid", "quasirigid_io", "quasirigid_study"]),
    (
        "quasirigid-fuzz",
        &[
            "quasirigid",
            "quasirigid_math",
            "quasirigid_mesh",
            "quasirigid_io",
            "quasirigid_report",
            "quasirigid_study",
        ],
    ),
];

/// Libraries that only one folder may name.
const CONFINED: [(&str, &str); 1] = [("faer", "crates/quasirigid-linear/src")];

/// Breaches of the import table and foreign types in public signatures, in the sources of every crate.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in tree.crates() {
        let Some((_, may_use)) = CRATES.iter().find(|(name, _)| *name == package) else {
            let manifest = format!("crates/{package}/Cargo.toml");
            findings.push(Finding::error(&manifest, 1, "this crate has no row in the import table"));
            continue;
        };
        let (sources, unread) = source::of_crate(tree, package);
        findings.extend(unread);
        for source in &sources {
            findings.extend(imports_of(source, package, may_use));
            findings.extend(signatures::check(source));
        }
    }
    findings
}

fn imports_of(source: &Source, package: &str, may_use: &[&str]) -> Vec<Finding> {
    let own = package.replace('-', "_");
    let complaint = |path: &[String]| {
        if path.len() < 2 {
            None
        } else if path[0] == own {
            if package == PHYSICS { between_modules(source, &path[1]) } else { None }
        } else if CRATES.iter().any(|(name, _)| name.replace('-', "_") == path[0]) {
            between_crates(package, may_use, path)
        } else {
            outside_its_folder(source, &path[0])
        }
    };
    imports::of(source, &own)
        .into_iter()
        .filter_map(|import| Some((complaint(&import.path)?, import.line)))
        .map(|(message, line)| Finding::error(&source.path, line, message))
        .collect()
}

fn between_modules(source: &Source, used: &str) -> Option<String> {
    let user = source.module.first()?; // the root itself only lists the modules
    let Some((_, may_use)) = MODULES.iter().find(|(name, _)| name == user) else {
        return Some(format!("module `{user}` has no row in the import table"));
    };
    if used == user || may_use.contains(&used) {
        None
    } else if MODULES.iter().any(|(name, _)| *name == used) {
        Some(format!("`{user}` may not use `{used}`; it may use {}", listed(may_use)))
    } else {
        Some(format!("`crate::{used}` is no module of the import table; name the module it comes from"))
    }
}

fn between_crates(user: &str, may_use: &[&str], path: &[String]) -> Option<String> {
    let allowed = |name: &&str| name.split("::").zip(path).all(|(wanted, found)| wanted == found);
    if may_use.iter().any(allowed) {
        return None;
    }
    Some(format!("`{user}` may not use `{}`; it may use {}", path.join("::"), listed(may_use)))
}

fn outside_its_folder(source: &Source, library: &str) -> Option<String> {
    let (_, folder) = CONFINED.iter().find(|(name, _)| *name == library)?;
    (!is_below(&source.path, folder)).then(|| format!("only {folder} may name `{library}`"))
}

fn listed(names: &[&str]) -> String {
    if names.is_empty() { "nothing of ours".to_owned() } else { format!("`{}`", names.join("`, `")) }
}

#[cfg(test)]
mod tests;
