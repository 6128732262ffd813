//! Layers inside a crate, which cargo does not forbid, and no foreign types in public signatures.

mod imports;
mod signatures;
mod source;

use crate::finding::Finding;
use crate::tree::Tree;
use source::Source;

/// Modules of a crate that may use only some of its other modules.
type Table = [(&'static str, &'static [&'static str])];

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
    ("quasirigid-elements", &[("finite", &[]), ("flow", &["finite"]), ("structure", &["finite"])]),
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
    let Some((user, may_use)) =
        layers.iter().find(|(name, _)| source.module.first().is_some_and(|own| own == name))
    else {
        return Vec::new();
    };
    let own = package.replace('-', "_");
    let breach = |path: &[String]| {
        let [first, used, ..] = path else { return None };
        let allowed = used == user || BELOW.contains(&used.as_str()) || may_use.contains(&used.as_str());
        (*first == own && !allowed).then(|| {
            format!(
                "`{user}` may not use `{used}`; it may use `{}`",
                [&BELOW, *may_use].concat().join("`, `")
            )
        })
    };
    imports::of(source, &own)
        .into_iter()
        .filter_map(|import| Some((breach(&import.path)?, import.line)))
        .map(|(message, line)| Finding::error(&source.path, line, message))
        .collect()
}

#[cfg(test)]
mod tests;
