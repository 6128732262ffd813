//! List of materials: the crates that a package is built from, in CycloneDX's JSON, from what cargo says of them.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

/// The list of the materials of `package`, from the output of `cargo metadata` and the text of `Cargo.lock`.
///
/// # Errors
/// A sentence, if the metadata do not have the package.
pub fn materials(metadata: &Value, lock: &str, package: &str, timestamp: &str) -> Result<Value, String> {
    let checksums = checksums(lock);
    let packages: BTreeMap<&str, &Value> =
        list(&metadata["packages"]).map(|package| (text(&package["id"]), package)).collect();
    let root = list(&metadata["packages"]).find(|entry| entry["name"] == package);
    let root = root
        .map(|root| text(&root["id"]))
        .ok_or_else(|| format!("cargo metadata has no package {package}"))?;
    let graph = reached(metadata, root);
    // Sorted by name and version, not by the identifiers of cargo, which contain the folder of the checkout.
    let mut parts: Vec<(String, &str)> = graph.keys().map(|id| (reference(packages[id]), *id)).collect();
    parts.sort_unstable();
    let components = parts.iter().filter(|(_, id)| *id != root);
    let components: Vec<Value> =
        components.map(|(_, id)| component("library", packages[id], &checksums)).collect();
    let dependencies: Vec<Value> = parts
        .iter()
        .map(|(name, id)| {
            let on: BTreeSet<String> = graph[id].iter().map(|id| reference(packages[id])).collect();
            json!({"ref": name, "dependsOn": on})
        })
        .collect();
    Ok(json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"timestamp": timestamp, "component": component("application", packages[root], &checksums)},
        "components": components,
        "dependencies": dependencies,
    }))
}

/// Packages that a build of `root` compiles, each with those it uses: the tests' own dependencies are none of them.
fn reached<'m>(metadata: &'m Value, root: &'m str) -> BTreeMap<&'m str, Vec<&'m str>> {
    let nodes: BTreeMap<&str, &Value> =
        list(&metadata["resolve"]["nodes"]).map(|node| (text(&node["id"]), node)).collect();
    let (mut graph, mut open) = (BTreeMap::new(), vec![root]);
    while let Some(id) = open.pop() {
        if graph.contains_key(id) {
            continue;
        }
        let used = |dependency: &&Value| list(&dependency["dep_kinds"]).any(|kind| kind["kind"] != "dev");
        let uses = nodes.get(id).into_iter().flat_map(|node| list(&node["deps"]).filter(used));
        let uses: Vec<&str> = uses.map(|dependency| text(&dependency["pkg"])).collect();
        open.extend(&uses);
        graph.insert(id, uses);
    }
    graph
}

fn component(kind: &str, package: &Value, checksums: &BTreeMap<(String, String), String>) -> Value {
    let (name, version) = (text(&package["name"]), text(&package["version"]));
    let reference = reference(package);
    let mut component =
        json!({"type": kind, "bom-ref": reference, "name": name, "version": version, "purl": reference});
    if let Some(license) = package["license"].as_str() {
        // Old manifests write a slash.
        component["licenses"] = json!([{"expression": license.replace('/', " OR ")}]);
    }
    if let Some(checksum) = checksums.get(&(name.to_owned(), version.to_owned())) {
        component["hashes"] = json!([{"alg": "SHA-256", "content": checksum}]);
    }
    component
}

/// Name of a package for everyone, its URL.
fn reference(package: &Value) -> String {
    format!("pkg:cargo/{}@{}", text(&package["name"]), text(&package["version"]))
}

/// SHA-256 of the packages that come from a registry, by name and version.
fn checksums(lock: &str) -> BTreeMap<(String, String), String> {
    let lock: toml::Table = lock.parse().unwrap_or_default();
    let packages = lock.get("package").and_then(toml::Value::as_array).into_iter().flatten();
    let entry = |package: &toml::Value| {
        let field = |key: &str| Some(package.get(key)?.as_str()?.to_owned());
        Some(((field("name")?, field("version")?), field("checksum")?))
    };
    packages.filter_map(entry).collect()
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A program that uses `math`, which is built with `cc` and tested with `proptest`.
    fn metadata() -> Value {
        let package = |id: &str, name: &str, license: Value| json!({"id": id, "name": name, "version": "1.0.0", "license": license});
        let uses = |id: &str, kind: Value| json!({"pkg": id, "dep_kinds": [{"kind": kind}]});
        json!({
            "packages": [
                package("1", "program", json!("MIT")),
                package("2", "math", json!("MIT/Apache-2.0")),
                package("3", "cc", Value::Null),
                package("4", "proptest", json!("MIT")),
            ],
            "resolve": {"nodes": [
                {"id": "1", "deps": [uses("2", Value::Null)]},
                {"id": "2", "deps": [uses("3", json!("build")), uses("4", json!("dev"))]},
                {"id": "3", "deps": []},
                {"id": "4", "deps": []},
            ]},
        })
    }

    const LOCK: &str = "[[package]]\nname = \"cc\"\nversion = \"1.0.0\"\nchecksum = \"ab12\"\n[[package]]\nname = \"math\"\nversion = \"1.0.0\"\n";

    #[test]
    fn materials_are_what_is_compiled_by_name() {
        let list = materials(&metadata(), LOCK, "program", "2026-12-01T00:00:00Z").unwrap();
        assert_eq!(list["metadata"]["component"]["name"], "program");
        assert_eq!(
            list["components"],
            json!([
                {"type": "library", "bom-ref": "pkg:cargo/cc@1.0.0", "name": "cc", "version": "1.0.0", "purl": "pkg:cargo/cc@1.0.0",
                 "hashes": [{"alg": "SHA-256", "content": "ab12"}]},
                {"type": "library", "bom-ref": "pkg:cargo/math@1.0.0", "name": "math", "version": "1.0.0",
                 "purl": "pkg:cargo/math@1.0.0", "licenses": [{"expression": "MIT OR Apache-2.0"}]},
            ])
        );
        assert_eq!(
            list["dependencies"],
            json!([
                {"ref": "pkg:cargo/cc@1.0.0", "dependsOn": []},
                {"ref": "pkg:cargo/math@1.0.0", "dependsOn": ["pkg:cargo/cc@1.0.0"]},
                {"ref": "pkg:cargo/program@1.0.0", "dependsOn": ["pkg:cargo/math@1.0.0"]},
            ])
        );
    }

    #[test]
    fn a_package_that_cargo_does_not_know_is_refused() {
        let message = "cargo metadata has no package other";
        assert_eq!(materials(&metadata(), LOCK, "other", "").unwrap_err(), message);
    }
}
