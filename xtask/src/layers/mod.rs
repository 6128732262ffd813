//! Layers inside a crate, which cargo does not forbid, and no foreign types in public signatures.

mod imports;
mod signatures;
mod source;

use crate::finding::Finding;
use crate::tree::Tree;
use source::Source;

/// Modules of a crate that may use only some of its other modules.
type Table = [(&'static str, &'static [&'static str])];

/// The crate of the elements.
const ELEMENTS: &str = "quasirigid-elements";

/// Crates with layers inside: the analyses form a star about the body, and what elements are computed with knows no element.
const LAYERS: [(&str, &Table); 2] = [
    (
        "quasirigid-dynamics",
        &[
            ("reduction", &[]),
            ("dynamics", &[]),
            ("averaging", &[]),
            ("modes", &[]),
            ("submanifold", &["dynamics", "averaging", "modes"]),
            ("secular", &["reduction", "dynamics", "averaging", "modes", "submanifold"]),
            ("verification", &["reduction", "dynamics", "averaging", "modes", "submanifold", "secular"]),
        ],
    ),
    (ELEMENTS, &[("finite", &[]), ("flow", &["finite"]), ("structure", &["finite"])]),
];

/// Modules of the elements that may not use another: what a user refers to, what an element gives, the kinds, and their assembly are read
/// in this order.
const NEVER: [(&str, &[&str]); 5] = [
    ("contribution", &["kinds", "assembly"]),
    ("element", &["kinds", "assembly"]),
    ("visual", &["kinds", "assembly"]),
    ("reference", &["contribution", "element", "kinds", "assembly"]),
    ("kinds", &["assembly"]),
];

/// Names by which every module of these crates calls the crates below.
const BELOW: [&str; 2] = ["math", "model"];

/// Breaches of the layers and foreign types in public signatures, in the sources of every crate.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = Vec::new();
    for package in tree.crates() {
        let layers = LAYERS.iter().find(|(name, _)| *name == package).map_or(&[][..], |(_, table)| table);
        let (sources, unread) = source::of_crate(tree, package);
        findings.extend(unread);
        for source in &sources {
            findings.extend(imports_of(source, package, layers));
            findings.extend(signatures::check(source));
        }
    }
    findings
}

fn imports_of(source: &Source, package: &str, layers: &Table) -> Vec<Finding> {
    let Some(user) = source.module.first() else { return Vec::new() };
    let own = package.replace('-', "_");
    let may_use = layers.iter().find(|(name, _)| name == user).map(|(_, may_use)| *may_use);
    let never = NEVER
        .iter()
        .find(|(name, _)| name == user && package == ELEMENTS)
        .map_or(&[][..], |(_, never)| never);
    let breach = |path: &[String]| {
        let [first, used, ..] = path else { return None };
        if *first != own || used == user || BELOW.contains(&used.as_str()) {
            return None;
        }
        if never.contains(&used.as_str()) {
            return Some(format!("`{user}` may not use `{used}`"));
        }
        let may_use = may_use.filter(|may_use| !may_use.contains(&used.as_str()))?;
        Some(format!(
            "`{user}` may not use `{used}`; it may use `{}`",
            [&BELOW, may_use].concat().join("`, `")
        ))
    };
    imports::of(source, &own)
        .into_iter()
        .filter_map(|import| Some((breach(&import.path)?, import.line)))
        .map(|(message, line)| Finding::error(&source.path, line, message))
        .collect()
}

#[cfg(test)]
mod tests;
