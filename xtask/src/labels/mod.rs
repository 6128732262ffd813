//! Equation labels and reference keys: every one that the code cites exists in the documentation, and every label is cited.

mod comments;
mod keys;

use std::collections::BTreeMap;

use crate::finding::Finding;
use crate::tree::{Tree, is_below};
use comments::comments;

/// Labels that no code needs to cite, with the reason.
const NOT_IN_CODE: [(&str, &str); 0] = [];

/// Labels defined in the theory, each with its file and line.
type Definitions<'t> = BTreeMap<&'t str, (&'t str, usize)>;

/// Labels and keys that are cited but not defined, defined twice, or defined and not used.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let (definitions, mut findings) = definitions(tree);
    let cited = in_code(tree);
    for (label, file, line) in in_documents(tree).into_iter().chain(cited.iter().copied()) {
        if !definitions.contains_key(label) {
            let message = format!("({label}) is not defined in docs/theory");
            findings.push(Finding::error(file, line, message));
        }
    }
    for (&label, &place) in &definitions {
        let is_cited = cited.iter().any(|(name, ..)| *name == label);
        findings.extend(judged(label, place, is_cited, &NOT_IN_CODE));
    }
    findings.extend(keys::check(tree));
    findings
}

/// Finding at the definition of a label, given whether code cites it and which labels are excused.
fn judged(
    label: &str,
    (file, line): (&str, usize),
    is_cited: bool,
    excused: &[(&str, &str)],
) -> Option<Finding> {
    let reason = excused.iter().find(|(name, _)| *name == label).map(|(_, reason)| *reason);
    match (is_cited, reason) {
        (true, None) => None,
        (true, Some(_)) => {
            Some(Finding::error(file, line, format!("({label}) is cited in code, so it needs no excuse")))
        }
        (false, Some(reason)) => {
            Some(Finding::warning(file, line, format!("({label}) is not cited in code: {reason}")))
        }
        (false, None) => Some(Finding::error(file, line, format!("({label}) is not cited in code"))),
    }
}

fn definitions(tree: &Tree) -> (Definitions<'_>, Vec<Finding>) {
    let (mut definitions, mut findings) = (Definitions::new(), Vec::new());
    for (file, line, text) in lines(tree.files("docs/theory", ".md")) {
        for label in labels(text).into_iter().filter(|label| text.contains(&format!("**({label})**"))) {
            match definitions.get(label) {
                Some((first, at)) => {
                    let message = format!("({label}) is already defined at {first}:{at}");
                    findings.push(Finding::error(file, line, message));
                }
                None => {
                    definitions.insert(label, (file, line));
                }
            }
        }
    }
    (definitions, findings)
}

/// Labels cited in the documentation, definitions included.
fn in_documents(tree: &Tree) -> Vec<(&str, &str, usize)> {
    documents(tree)
        .flat_map(|(file, line, text)| labels(text).into_iter().map(move |label| (label, file, line)))
        .collect()
}

/// Labels cited in comments of the crates.
fn in_code(tree: &Tree) -> Vec<(&str, &str, usize)> {
    code(tree)
        .flat_map(|(file, text)| comments(text).into_iter().map(move |comment| (file, comment)))
        .flat_map(|(file, (line, text))| labels(text).into_iter().map(move |label| (label, file, line)))
        .collect()
}

/// Lines of the documentation and of the paper, with their file and number.
fn documents(tree: &Tree) -> impl Iterator<Item = (&str, usize, &str)> {
    let readme = tree.text("README.md").map(|text| ("README.md", text));
    lines(tree.files("docs", ".md").chain(tree.files("paper", ".md")).chain(readme))
}

/// Sources and tests of the crates.
fn code(tree: &Tree) -> impl Iterator<Item = (&str, &str)> {
    tree.files("crates", ".rs").filter(|(path, _)| {
        let inside = path.splitn(3, '/').nth(2).unwrap_or_default();
        is_below(inside, "src") || is_below(inside, "tests")
    })
}

fn lines<'t>(
    files: impl Iterator<Item = (&'t str, &'t str)>,
) -> impl Iterator<Item = (&'t str, usize, &'t str)> {
    files.flat_map(|(file, text)| (1..).zip(text.lines()).map(move |(line, text)| (file, line, text)))
}

/// Labels in a text: `R4` for a parenthesis with a capital, that of the chapter, and one or two digits that is no function call.
fn labels(text: &str) -> Vec<&str> {
    let is_label = |inside: &str| {
        let digits = inside.strip_prefix(|letter: char| letter.is_ascii_uppercase()).unwrap_or_default();
        (1..=2).contains(&digits.len()) && digits.bytes().all(|digit| digit.is_ascii_digit())
    };
    text.match_indices('(')
        .filter(|(at, _)| !text[..*at].ends_with(|before: char| before.is_alphanumeric() || before == '_'))
        .filter_map(|(at, _)| text[at + 1..].split_once(')'))
        .map(|(inside, _)| inside)
        .filter(|inside| is_label(inside))
        .collect()
}

#[cfg(test)]
mod tests;
