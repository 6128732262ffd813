//! The map of the workspace is true: every path on it exists, and every module folder is on it.

mod drawing;

use std::collections::BTreeSet;

use crate::finding::Finding;
use crate::markdown::{blocks, code_spans};
use crate::tree::Tree;

const MAP: &str = "ARCHITECTURE.md";

/// Endings by which a name without a folder is known as a file at the root.
const FILES: [&str; 4] = [".md", ".toml", ".cff", ".rs"];

/// Paths in `ARCHITECTURE.md` that do not exist, and folders with a `mod.rs` that it leaves out.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let Some(map) = tree.text(MAP) else { return Vec::new() };
    let named: Vec<(usize, String)> =
        blocks(map).iter().flat_map(drawing::paths).chain(mentioned(map)).collect();
    let missing = named
        .iter()
        .filter(|(_, path)| !tree.exists(path))
        .map(|(line, path)| Finding::error(MAP, *line, format!("{path} does not exist")));
    let names: BTreeSet<&str> = named.iter().map(|(_, path)| path.as_str()).collect();
    let unnamed = tree
        .files("crates", "/mod.rs")
        .filter_map(|(path, _)| path.strip_suffix("/mod.rs"))
        .filter(|folder| folder.split('/').nth(2) == Some("src") && !names.contains(folder))
        .map(|folder| Finding::error(MAP, 1, format!("{folder} is not on the map")));
    missing.chain(unnamed).collect()
}

/// Paths between backticks in the prose.
fn mentioned(map: &str) -> impl Iterator<Item = (usize, String)> {
    code_spans(map)
        .into_iter()
        .filter(|(_, span)| is_path(span))
        .map(|(line, span)| (line, span.trim_end_matches('/').to_owned()))
}

fn is_path(span: &str) -> bool {
    let plain = span.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c));
    plain && (span.contains('/') || FILES.iter().any(|end| span.ends_with(end)))
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::sample;

    const SOURCE: (&str, &str) = ("crates/a/src/math/mod.rs", "");
    const DRAWING: &str = "# Map\n```text\nroot/\n├── crates/\n│   └── a/src/   sources\n│       └── math/\n└── x.md  text\n```\n";

    fn found(map: &str) -> Vec<String> {
        let tree = sample(&[SOURCE, ("x.md", ""), ("ARCHITECTURE.md", map), ("crates/a/tests/b/mod.rs", "")]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_true_map_passes() {
        assert_eq!(found(DRAWING), [""; 0]);
        assert_eq!(
            found("`crates/a/src/math/`, `x.md`, `Mat<f64>`, `math::sym`, `a / b`, `docs/*.md`"),
            [""; 0]
        );
    }

    #[test]
    fn a_path_that_does_not_exist_is_found() {
        let drawn = DRAWING.replace("x.md", "y.md");
        assert_eq!(found(&drawn), ["ARCHITECTURE.md:7: y.md does not exist"]);
        let mentioned = format!("{DRAWING}and\n`crates/b` with `y.md`\n");
        assert_eq!(
            found(&mentioned),
            ["ARCHITECTURE.md:10: crates/b does not exist", "ARCHITECTURE.md:10: y.md does not exist"]
        );
    }

    #[test]
    fn a_module_folder_left_out_is_found() {
        assert_eq!(found("`crates/a/src`"), ["ARCHITECTURE.md:1: crates/a/src/math is not on the map"]);
    }

    #[test]
    fn without_a_map_there_is_nothing_to_check() {
        assert_eq!(check(&sample(&[SOURCE])), []);
    }
}
