//! The maps of the workspace are true: every path on them exists.

use crate::finding::Finding;
use crate::markdown::code_spans;
use crate::tree::Tree;

const MAPS: [&str; 2] = ["ARCHITECTURE.md", "CONTRIBUTING.md"];

/// Endings by which a name without a folder is known as a file at the root.
const FILES: [&str; 4] = [".md", ".toml", ".cff", ".rs"];

/// Paths between backticks in the maps that do not exist.
pub fn check(tree: &Tree) -> Vec<Finding> {
    MAPS.iter().flat_map(|map| missing(tree, map)).collect()
}

fn missing(tree: &Tree, map: &str) -> Vec<Finding> {
    let spans = tree.text(map).map(code_spans).unwrap_or_default();
    let paths = spans.into_iter().filter(|(_, span)| is_path(span));
    paths
        .map(|(line, span)| (line, span.trim_end_matches('/').to_owned()))
        .filter(|(_, path)| !tree.exists(path))
        .map(|(line, path)| Finding::error(map, line, format!("{path} does not exist")))
        .collect()
}

fn is_path(span: &str) -> bool {
    let plain = span.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c));
    plain && (span.contains('/') || FILES.iter().any(|end| span.ends_with(end)))
}

#[cfg(test)]
mod tests {
    use super::check;
    use crate::tree::sample;

    #[test]
    fn paths_that_do_not_exist_are_found() {
        let map = "`crates/a/src/` and `x.md`\n`a::b`, `cargo run`, `y.md`, `crates/b`";
        let tree = sample(&[
            ("crates/a/src/lib.rs", ""),
            ("x.md", ""),
            ("ARCHITECTURE.md", map),
            ("CONTRIBUTING.md", "`z.md`"),
        ]);
        let found: Vec<String> = check(&tree).iter().map(ToString::to_string).collect();
        assert_eq!(
            found,
            [
                "ARCHITECTURE.md:2: y.md does not exist",
                "ARCHITECTURE.md:2: crates/b does not exist",
                "CONTRIBUTING.md:1: z.md does not exist"
            ]
        );
    }
}
