//! Messages for a text that is no formula.

use std::ops::Range;

use super::ExpressionError;
use super::function::{CONSTANTS, FUNCTIONS};

/// Characters with a meaning in other languages, and their form here.
const FOREIGN: [(&str, &str); 8] = [
    ("×·∙⋅", "write `*`"),
    ("÷:", "write `/`"),
    ("−–—", "write `-`"),
    ("²", "write `^2`"),
    ("³", "write `^3`"),
    ("[{]}", "write parentheses `( )`"),
    ("√", "write `sqrt(x)`"),
    ("|", "write `abs(x)`"),
];

/// An error in a place.
pub fn error(span: Range<usize>, message: impl Into<String>) -> ExpressionError {
    ExpressionError { span, message: message.into() }
}

/// A character that no word begins with.
pub fn character(found: char, start: usize) -> ExpressionError {
    let advice = FOREIGN
        .iter()
        .find(|(characters, _)| characters.contains(found))
        .map_or("a formula has numbers, names, `+ - * / ^`, parentheses and commas", |(_, advice)| advice);
    let shown = found.escape_debug();
    error(start..start + found.len_utf8(), format!("`{shown}` is not allowed in a formula; {advice}"))
}

/// Digits and points that are no number; `rest` begins with them.
pub fn number(rest: &str, span: Range<usize>) -> ExpressionError {
    let found = &rest[..span.len()];
    let points = found.matches('.').count();
    if points > 1 {
        return error(span, format!("`{found}` has {points} decimal points; a number has one at most"));
    }
    if found == "." {
        return error(span, "a decimal point without digits; write a number such as `0.5`");
    }
    error(span, format!("`{found}` is beyond the largest number, 1.8e308"))
}

/// A name that is neither a variable nor anything else known.
pub fn unknown(name: &str, span: Range<usize>, called: bool, variables: &[&str]) -> ExpressionError {
    if called {
        let functions = listed(FUNCTIONS.iter().map(|(name, ..)| *name));
        return error(span, format!("unknown function `{name}`; known are {functions}"));
    }
    let constants = CONSTANTS.iter().map(|(name, _)| *name);
    let known = listed(variables.iter().copied().chain(constants));
    error(span, format!("unknown name `{name}`; known are {known}"))
}

/// A function with the wrong number of arguments.
pub fn arguments(name: &str, usage: &str, takes: usize, found: usize, span: Range<usize>) -> ExpressionError {
    let arguments = if takes == 1 { "argument" } else { "arguments" };
    error(span, format!("`{name}` takes {takes} {arguments}, found {found}; write `{usage}`"))
}

fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
