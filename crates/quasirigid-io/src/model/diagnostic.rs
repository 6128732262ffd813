//! Diagnostics of a model file: message, place, label and help, collected while the file is read.
//! All readers share one list behind a cell, so that none stops at the first mistake; above a hundred the rest are one mistake repeated.

use std::cell::RefCell;
use std::ops::Range;

use super::key::Keys;
use super::named::former_name;
use super::values_read::ValuesRead;
use crate::visible::shortened;

/// Most diagnostics kept for one file: a file with more has one mistake made many times.
const MAX_DIAGNOSTICS: usize = 100;

/// Something wrong in a model file, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Bytes of the file that the diagnostic is about.
    pub span: Range<usize>,
    /// Message, with the offending value.
    pub message: String,
    /// A few words to stand beside the place.
    pub label: String,
    /// Advice.
    pub help: Option<String>,
}

impl Diagnostic {
    pub(crate) fn new(span: Range<usize>, message: impl Into<String>, label: impl Into<String>) -> Self {
        Self { span, message: cut(message), label: cut(label), help: None }
    }

    pub(crate) fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(cut(help)), ..self }
    }

    /// The same at another place, of an excerpt of the file.
    #[must_use]
    pub fn at(&self, span: Range<usize>) -> Self {
        Self { span, ..self.clone() }
    }

    /// Line and column of the start of the diagnostic in `text`, both from 1, the column in characters.
    #[must_use]
    pub fn position(&self, text: &str) -> (usize, usize) {
        let before = &text[..text.floor_char_boundary(self.span.start)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let lines = before.bytes().filter(|byte| *byte == b'\n').count();
        (lines + 1, before[line_start..].chars().count() + 1)
    }
}

/// A text of a diagnostic; what it quotes may have any length.
fn cut(text: impl Into<String>) -> String {
    shortened(&text.into()).into_owned()
}

/// The diagnostics found so far in a file. All its readers share one, so that none stops at the first.
#[derive(Debug)]
pub(crate) struct Problems<'a> {
    text: &'a str,
    found: RefCell<Vec<Diagnostic>>,
    former: RefCell<Vec<String>>,
    values: RefCell<ValuesRead>,
}

impl<'a> Problems<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { text, found: RefCell::default(), former: RefCell::default(), values: RefCell::default() }
    }

    pub(crate) fn report(&self, diagnostic: Diagnostic) {
        let mut found = self.found.borrow_mut();
        if found.len() <= MAX_DIAGNOSTICS {
            found.push(diagnostic);
        }
    }

    /// Whether the list is full, so that no more are kept.
    pub(crate) fn full(&self) -> bool {
        self.found.borrow().len() > MAX_DIAGNOSTICS
    }

    /// Notes that a former name stands at a span, with the name of today.
    pub(crate) fn renamed(&self, span: Range<usize>, former: &str, today: &str) {
        let note = format!("line {}: {}", self.line(span), former_name(former, today));
        let mut notes = self.former.borrow_mut();
        if !notes.contains(&note) {
            notes.push(note);
        }
    }

    /// Notes on the former names in the file.
    pub(crate) fn former_names(&self) -> Vec<String> {
        self.former.borrow().clone()
    }

    /// Notes the number in SI units for which a value at a span stands.
    pub(crate) fn measured(&self, span: Range<usize>, number: f64, unit: &'static str) {
        self.values.borrow_mut().measured(span, number, unit);
    }

    /// Notes the keys that a table at a span may have.
    pub(crate) fn opened(&self, span: Range<usize>, keys: &'static Keys) {
        self.values.borrow_mut().opened(span, keys);
    }

    /// Values that were read up to here.
    pub(crate) fn values(&self) -> ValuesRead {
        self.values.borrow().clone()
    }

    /// Text of the file at a span.
    pub(crate) fn text(&self, span: Range<usize>) -> Option<&'a str> {
        self.text.get(span)
    }

    /// Line of the file, from 1, at which a span starts.
    pub(crate) fn line(&self, span: Range<usize>) -> usize {
        Diagnostic::new(span, "", "").position(self.text).0
    }

    /// The diagnostics in the order of the file, each once.
    pub(crate) fn into_diagnostics(self) -> Vec<Diagnostic> {
        let mut found = self.found.into_inner();
        found.sort_by_key(|diagnostic| diagnostic.span.start);
        let full = found.len() > MAX_DIAGNOSTICS;
        found.dedup();
        if full {
            found.truncate(MAX_DIAGNOSTICS);
            if let Some(last) = found.last().map(|diagnostic| diagnostic.span.clone()) {
                found.push(Diagnostic::new(last, "there are more problems like these", "and more"));
            }
        }
        found
    }
}
