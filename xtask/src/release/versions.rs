//! One version: the workspace, its crates, the Python package, the citation, the recipe and the changelog name the same.

use crate::finding::Finding;
use crate::tree::Tree;

const MANIFEST: &str = "Cargo.toml";
const PYTHON: &str = "pyproject.toml";
const CITATION: &str = "CITATION.cff";
const RECIPE: &str = "conda/recipe.yaml";
const CHANGELOG: &str = "CHANGELOG.md";
/// Words of the changelog's first entry before its release.
pub const UNRELEASED: &str = "not yet released";

/// Version of the workspace.
pub fn version(tree: &Tree) -> Option<String> {
    let manifest = table(tree, MANIFEST)?;
    Some(manifest.get("workspace")?.get("package")?.get("version")?.as_str()?.to_owned())
}

/// Entry of the changelog that comes first: version, and day or [`UNRELEASED`].
pub fn entry(tree: &Tree) -> Option<(&str, &str)> {
    tree.text(CHANGELOG)?.lines().find_map(|line| line.strip_prefix("## "))?.split_once(", ")
}

/// Versions other than that of the workspace, and a day of release other than that of the changelog.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let Some(version) = version(tree) else { return Vec::new() };
    let (entered, day) = entry(tree).unwrap_or_default();
    let mut named = crates(tree);
    named.extend(python(tree).map(|version| (PYTHON.to_owned(), version)));
    named.push((CITATION.into(), field(tree, CITATION, "version:")));
    named.push((RECIPE.into(), field(tree, RECIPE, "version:")));
    named.push((CHANGELOG.into(), entered.to_owned()));
    let others = named.into_iter().filter(|(_, named)| *named != version);
    let mut findings: Vec<Finding> = others
        .map(|(file, named)| {
            Finding::error(&file, 1, format!("version \"{named}\", but the workspace has {version}"))
        })
        .collect();
    let released = field(tree, CITATION, "date-released:");
    if day != UNRELEASED && day != released {
        let message = format!("date-released \"{released}\", but {CHANGELOG} has \"{day}\"");
        findings.push(Finding::error(CITATION, 1, message));
    }
    findings
}

/// Files and versions of the workspace's crates: those that dependencies ask for, and those that a manifest does not take from the workspace.
fn crates(tree: &Tree) -> Vec<(String, String)> {
    let manifest = table(tree, MANIFEST).unwrap_or_default();
    let dependencies = manifest.get("workspace").and_then(|workspace| workspace.get("dependencies"));
    let asked = dependencies.and_then(toml::Value::as_table).into_iter().flatten();
    let own = asked.filter(|(_, dependency)| dependency.get("path").is_some());
    let asked = own.map(|(_, dependency)| (MANIFEST.to_owned(), text(dependency.get("version"))));
    let members = tree.files("crates", "/Cargo.toml").map(|(path, _)| path);
    let members = members.filter(|path| path.matches('/').count() == 2).filter_map(|path| {
        let manifest = table(tree, path)?;
        let version = manifest.get("package")?.get("version");
        version
            .is_none_or(|version| version.get("workspace").is_none())
            .then(|| (path.to_owned(), text(version)))
    });
    asked.chain(members).collect()
}

/// Version of the Python package; none if maturin takes that of its crate.
fn python(tree: &Tree) -> Option<String> {
    let project = table(tree, PYTHON)?.get("project")?.clone();
    let dynamic = project.get("dynamic").and_then(toml::Value::as_array);
    let is_dynamic = dynamic.is_some_and(|names| names.iter().any(|name| name.as_str() == Some("version")));
    (!is_dynamic).then(|| text(project.get("version")))
}

fn table(tree: &Tree, file: &str) -> Option<toml::Table> {
    tree.text(file)?.parse().ok()
}

fn text(value: Option<&toml::Value>) -> String {
    value.and_then(toml::Value::as_str).unwrap_or("none").to_owned()
}

/// Value of the first line of a YAML file that has this key.
fn field(tree: &Tree, file: &str, key: &str) -> String {
    let mut lines = tree.text(file).unwrap_or_default().lines();
    let value = lines.find_map(|line| line.trim_start().strip_prefix(key));
    value.unwrap_or("none").trim().trim_matches(['"', '\'']).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    const FILES: [(&str, &str); 7] = [
        (
            "Cargo.toml",
            "[workspace.package]\nversion = \"0.2.0\"\n[workspace.dependencies]\na = { path = \"crates/a\", version = \"0.2.0\" }\nb = \"1.0\"\n",
        ),
        ("crates/a/Cargo.toml", "[package]\nversion.workspace = true\n"),
        ("crates/a/fuzz/Cargo.toml", "[package]\nversion = \"0.0.0\"\n"),
        ("pyproject.toml", "[project]\ndynamic = [\"version\"]\n"),
        ("CITATION.cff", "cff-version: 1.2.0\nversion: 0.2.0\ndate-released: 2026-12-01\n"),
        ("conda/recipe.yaml", "context:\n  version: \"0.2.0\"\n"),
        ("CHANGELOG.md", "# Changelog\n\n## 0.2.0, 2026-12-01\n\n## 0.1.0, 2026-11-01\n"),
    ];

    fn found(file: &str, from: &str, to: &str) -> Vec<String> {
        let changed = FILES.map(|(path, text)| {
            (path, if path == file { text.replacen(from, to, 1) } else { text.to_owned() })
        });
        let changed: Vec<_> = changed.iter().map(|(path, text)| (*path, text.as_str())).collect();
        check(&sample(&changed)).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn versions_that_agree_pass() {
        assert_eq!(found("", "", ""), [""; 0]);
        assert_eq!(found("CHANGELOG.md", "2026-12-01", UNRELEASED), [""; 0]);
    }

    #[test]
    fn a_version_that_differs_is_found_wherever_it_stands() {
        for (file, from, to, named) in [
            ("Cargo.toml", "version = \"0.2.0\" }", "version = \"0.1.0\" }", "0.1.0"),
            ("crates/a/Cargo.toml", "version.workspace = true", "version = \"0.3.0\"", "0.3.0"),
            ("pyproject.toml", "dynamic = [\"version\"]", "version = \"0.2\"", "0.2"),
            ("CITATION.cff", "version: 0.2.0", "version: 0.1.0", "0.1.0"),
            ("conda/recipe.yaml", "0.2.0", "0.2.1", "0.2.1"),
            ("CHANGELOG.md", "## 0.2.0, 2026-12-01\n\n", "", "0.1.0"),
        ] {
            let findings = found(file, from, to);
            let message = format!("{file}:1: version \"{named}\", but the workspace has 0.2.0");
            assert!(findings.contains(&message), "{findings:?}");
        }
    }

    #[test]
    fn the_day_of_the_release_is_that_of_the_changelog() {
        let message = "CITATION.cff:1: date-released \"2026-12-02\", but CHANGELOG.md has \"2026-12-01\"";
        assert_eq!(found("CITATION.cff", "2026-12-01", "2026-12-02"), [message]);
    }
}
