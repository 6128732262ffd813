use std::collections::BTreeSet;

use super::comments::comments;
use super::{code, documents};
use crate::finding::Finding;
use crate::tree::Tree;

const BIBLIOGRAPHY: &str = "docs/references.bib";

/// Reference keys in the documentation and in docstrings that the bibliography does not have.
pub fn check(tree: &Tree) -> Vec<Finding> {
    let known: BTreeSet<&str> =
        tree.text(BIBLIOGRAPHY).unwrap_or_default().lines().filter_map(entry).collect();
    let in_documents = documents(tree)
        .flat_map(|(file, line, text)| bracketed(text).into_iter().map(move |key| (key, file, line)));
    let in_code = code(tree).flat_map(|(file, text)| {
        cited(&comments(text)).into_iter().map(move |(key, line)| (key, file, line))
    });
    in_documents
        .chain(in_code)
        .filter(|(key, ..)| !known.contains(key))
        .map(|(key, file, line)| Finding::error(file, line, format!("{key} is not in {BIBLIOGRAPHY}")))
        .collect()
}

/// Key of the BibTeX entry that starts on this line: `@book{carr1981,`.
fn entry(line: &str) -> Option<&str> {
    let (_, rest) = line.trim_start().strip_prefix('@')?.split_once('{')?;
    rest.split(',').next().map(str::trim)
}

/// Keys cited in comments: in brackets anywhere, and bare under a heading `# References`.
fn cited<'t>(comments: &[(usize, &'t str)]) -> Vec<(&'t str, usize)> {
    let mut keys = Vec::new();
    let (mut under_references, mut previous) = (false, 0);
    for &(line, text) in comments {
        if text.starts_with('#') || line > previous + 1 {
            under_references = text == "# References";
        }
        previous = line;
        let found = if under_references { bare(text) } else { bracketed(text) };
        keys.extend(found.into_iter().map(|key| (key, line)));
    }
    keys
}

/// Keys in `[@carr1981]` or `[@kane1987; see @likins1966, p. 3]`.
fn bracketed(text: &str) -> Vec<&str> {
    text.match_indices('[')
        .filter_map(|(at, _)| text[at + 1..].split_once(']'))
        .flat_map(|(inside, _)| inside.split(';'))
        .filter_map(|part| {
            part.split_once('@').filter(|(before, _)| before.is_empty() || before.ends_with(' '))
        })
        .map(|(_, key)| {
            key.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '-').next().unwrap_or_default()
        })
        .filter(|key| !key.is_empty())
        .collect()
}

/// Words that look like a key: lower-case letters and the four digits of a year, with a letter for its second work.
fn bare(text: &str) -> Vec<&str> {
    let is_key = |word: &&str| {
        let year = word.trim_start_matches(|c: char| c.is_ascii_lowercase());
        let digits = year.trim_end_matches(|c: char| c.is_ascii_lowercase());
        year.len() < word.len() && digits.len() == 4 && digits.bytes().all(|c| c.is_ascii_digit())
    };
    text.split(|c: char| !c.is_alphanumeric()).filter(is_key).collect()
}
