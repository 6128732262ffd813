//! The theory and the guide list each of their chapters under its number.

use crate::finding::Finding;
use crate::tree::Tree;

/// Folders of chapters `NN-name.md`, each with a `README.md` that lists them.
const FOLDERS: [&str; 2] = ["docs/theory", "docs/guide"];

/// Chapters without a line `N. [title](NN-name.md)` in the `README.md` of their folder.
pub fn check(tree: &Tree) -> Vec<Finding> {
    FOLDERS.iter().flat_map(|folder| unlisted(tree, folder)).collect()
}

fn unlisted(tree: &Tree, folder: &str) -> Vec<Finding> {
    let contents = format!("{folder}/README.md");
    let Some(text) = tree.text(&contents) else { return Vec::new() };
    tree.files(folder, ".md")
        .filter_map(|(path, _)| path.strip_prefix(folder)?.strip_prefix('/'))
        .filter_map(|name| Some((name, number(name)?)))
        .filter(|(name, number)| !text.lines().any(|line| lists(line, *number, name)))
        .map(|(name, number)| {
            Finding::error(&contents, 1, format!("{name} is not listed: no line \"{number}. [...]({name})\""))
        })
        .collect()
}

/// Number of a chapter: 3 of `03-name.md`.
fn number(name: &str) -> Option<usize> {
    name.split_once('-')?.0.parse().ok()
}

fn lists(line: &str, number: usize, name: &str) -> bool {
    line.starts_with(&format!("{number}. [")) && line.contains(&format!("]({name})"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    fn found(contents: &str) -> Vec<String> {
        let tree = sample(&[
            ("docs/guide/README.md", contents),
            ("docs/guide/01-start.md", ""),
            ("docs/guide/12-modes.md", ""),
            ("docs/guide/notes.md", ""),
            ("docs/theory/01-system.md", ""),
        ]);
        check(&tree).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn contents_with_every_chapter_pass() {
        assert_eq!(found("1. [Start](01-start.md): first.\n12. [Modes](12-modes.md).\n"), [""; 0]);
    }

    #[test]
    fn a_chapter_that_is_left_out_or_has_another_number_is_found() {
        let modes = "docs/guide/README.md:1: 12-modes.md is not listed: no line \"12. [...](12-modes.md)\"";
        assert_eq!(found("1. [Start](01-start.md)\n"), [modes]);
        assert_eq!(found("1. [Start](01-start.md)\n2. [Modes](12-modes.md)\n"), [modes]);
        assert_eq!(found("1. [Start](01-start.md), [modes](12-modes.md)\n"), [modes]);
    }
}
