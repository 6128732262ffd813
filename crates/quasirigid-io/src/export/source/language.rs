//! What differs between languages: files, comments, names of variables, brackets of lists.
//! A template is source of its language in which `{{key}}` stands for a part that depends on the body.

use std::collections::BTreeMap;

/// Language of exported source.
#[derive(Clone, Copy, Debug)]
pub(super) struct Language {
    /// Files: what follows the name of the body in the name of the file, or a whole name, and the template.
    pub files: &'static [(FileName, &'static str)],
    /// Before, within and after a comment of several lines.
    pub comment: [&'static str; 3],
    /// Components of the angular momentum.
    pub variables: [&'static str; 3],
    /// End of a line that is continued.
    pub continued: &'static str,
    /// Brackets of a row and of a list of rows, and what separates rows.
    pub row: [&'static str; 2],
    pub list: [&'static str; 3],
}

/// Name of an exported file.
#[derive(Clone, Copy, Debug)]
pub(super) enum FileName {
    /// The name of the body with an ending.
    Ending(&'static str),
    /// A whole name.
    Whole(&'static str),
}

impl Language {
    /// A list of numbers.
    pub fn row(&self, numbers: &[String]) -> String {
        let [open, close] = self.row;
        format!("{open}{}{close}", numbers.join(", "))
    }

    /// A list of lists.
    pub fn list(&self, rows: &[String]) -> String {
        let [open, between, close] = self.list;
        format!("{open}{}{close}", rows.join(between))
    }

    /// Lines as one comment.
    pub fn commented(&self, lines: &[String]) -> String {
        let [first, each, last] = self.comment;
        let lines: Vec<_> = lines.iter().map(|line| format!("{each}{line}").trim_end().to_owned()).collect();
        format!("{first}{}{last}", lines.join("\n"))
    }
}

/// A template with its parts in place.
pub(super) fn filled(template: &str, parts: &BTreeMap<&str, String>) -> String {
    let mut pieces = template.split("{{");
    let mut text = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let part = piece.split_once("}}").and_then(|(key, rest)| Some((parts.get(key)?, rest)));
        match part {
            Some((value, rest)) => {
                text.push_str(value);
                text.push_str(rest);
            }
            None => {
                text.push_str("{{");
                text.push_str(piece);
            }
        }
    }
    text
}
