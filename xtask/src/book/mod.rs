//! The book: mdBook's `docs/SUMMARY.md` names every chapter once, every link of a document leads somewhere, and the pages are built from the
//! files that the forge shows.

mod build;
mod links;
mod preprocess;

use std::path::Path;

use crate::finding::Finding;
use crate::markdown::targets;
use crate::tree::Tree;

pub use build::build;
pub use preprocess::preprocess;

/// Folder of the chapters.
const SOURCE: &str = "docs";
const SUMMARY: &str = "docs/SUMMARY.md";

/// Chapters that the summary leaves out or repeats, and links of any document that lead nowhere.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let mut findings = tree.text(SUMMARY).map_or_else(Vec::new, |summary| misnamed(tree, summary));
    findings.extend(links::check(tree));
    findings
}

fn misnamed(tree: &Tree, summary: &str) -> Vec<Finding> {
    let named: Vec<_> = targets(summary).into_iter().map(|target| &summary[target]).collect();
    let chapters = tree.files(SOURCE, ".md").map(|(path, _)| path).filter(|path| *path != SUMMARY);
    chapters
        .map(|path| path[SOURCE.len()..].trim_start_matches('/'))
        .map(|path| (path, named.iter().filter(|name| **name == path).count()))
        .filter(|(_, times)| *times != 1)
        .map(|(path, times)| Finding::error(SUMMARY, 1, format!("{path} is named {times} times, not once")))
        .collect()
}

/// The path that a link in `file` leads to, without its anchor; of the file itself if the link is an anchor alone.
fn resolved(file: &str, target: &str) -> String {
    let path = target.split('#').next().unwrap_or_default();
    if path.is_empty() {
        return file.to_owned();
    }
    let mut parts: Vec<&str> =
        Path::new(file).parent().into_iter().flat_map(Path::iter).filter_map(|part| part.to_str()).collect();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Whether a link leads to another site.
fn is_outward(target: &str) -> bool {
    target.contains("://") || target.starts_with("mailto:")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    #[test]
    fn a_summary_names_every_chapter_once() {
        let found = |summary: &str| {
            let chapters = [("docs/README.md", ""), ("docs/guide/01-start.md", "")];
            let tree = sample(&[("docs/SUMMARY.md", summary), chapters[0], chapters[1]]);
            check(&tree).iter().map(ToString::to_string).collect::<Vec<_>>()
        };
        assert_eq!(found("[Docs](README.md)\n\n- [1. Start](guide/01-start.md)\n"), [""; 0]);
        assert_eq!(
            found("[Docs](README.md)\n\n- [Docs](README.md)\n"),
            [
                "docs/SUMMARY.md:1: README.md is named 2 times, not once",
                "docs/SUMMARY.md:1: guide/01-start.md is named 0 times, not once"
            ]
        );
    }

    #[test]
    fn links_resolve_from_the_folder_of_their_file() {
        for (target, path) in [
            ("02-b.md#c", "docs/guide/02-b.md"),
            ("../../examples/", "examples"),
            ("#c", "docs/guide/01-a.md"),
            ("../../../x", "../x"),
        ] {
            assert_eq!(resolved("docs/guide/01-a.md", target), path);
        }
    }
}
