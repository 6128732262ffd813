//! Values of a model file with the key above them: each reading checks type, unit and range.
//! A failed reading reports a diagnostic and returns none, so that readers go on with `?` and every mistake is found in one run.

use std::ops::{Range, RangeInclusive};

use quasirigid_math::memory;
use toml::Spanned;
use toml::de::{DeInteger, DeValue};

use super::Diagnostic;
use super::diagnostic::Problems;
use super::key::Keys;
use super::key_value::KeyValue;
use super::literal;
use super::named::Named;
use super::spans::ElementSpans;
use super::table::Table;
use crate::nearest::nearest;
use crate::units::{Dimension, quantity};

/// A value of the file and the key above it. Every failed reading reports a diagnostic and returns none.
#[derive(Clone, Copy)]
pub(crate) struct Value<'a> {
    key: &'a str,
    inner: &'a Spanned<DeValue<'a>>,
    problems: &'a Problems<'a>,
}

impl<'a> Value<'a> {
    pub(crate) fn new(key: &'a str, inner: &'a Spanned<DeValue<'a>>, problems: &'a Problems<'a>) -> Self {
        Self { key, inner, problems }
    }

    /// The key above the value.
    pub(crate) fn key(&self) -> &'a str {
        self.key
    }

    /// Span of the value.
    pub(crate) fn span(&self) -> Range<usize> {
        self.inner.span()
    }

    /// Span of a part of the value, given by the bytes of that part in a text.
    pub(crate) fn span_of(&self, part: Range<usize>) -> Range<usize> {
        let Range { start, end } = self.span();
        match self.problems.text(start..end).and_then(|literal| literal::place(literal, part)) {
            Some(place) => start + place.start..start + place.end,
            None => start..end,
        }
    }

    pub(crate) fn is_array(&self) -> bool {
        self.inner.get_ref().is_array()
    }

    /// Whether the value is an array without elements.
    pub(crate) fn is_empty(&self) -> bool {
        self.inner.get_ref().as_array().is_some_and(|items| items.is_empty())
    }

    /// Whether the value is this text.
    pub(crate) fn is_word(&self, word: &str) -> bool {
        self.inner.get_ref().as_str() == Some(word)
    }

    pub(crate) fn is_table(&self) -> bool {
        self.inner.get_ref().is_table()
    }

    /// The elements of an array.
    pub(crate) fn items(&self) -> Option<Vec<Self>> {
        let items = self.inner.get_ref().as_array()?;
        Some(items.iter().map(|inner| Self { inner, ..*self }).collect())
    }

    /// A table.
    pub(crate) fn table(&self, title: &'static str, keys: &'static Keys) -> Option<Table<'a>> {
        self.table_among(title, keys, &|_| None)
    }

    /// A table of one of several kinds; `others` names those that an unknown key is for.
    pub(crate) fn table_among(
        &self,
        title: &'static str,
        keys: &'static Keys,
        others: &dyn Fn(&str) -> Option<String>,
    ) -> Option<Table<'a>> {
        match self.inner.get_ref().as_table() {
            Some(entries) => Some(Table::new(title, self.span(), entries, keys, others, self.problems)),
            None => self.mismatch("a table", &format!("write {title} with its keys")),
        }
    }

    /// The values of a table, without a look at its keys.
    pub(crate) fn entries(&self) -> Option<impl Iterator<Item = (Range<usize>, Self)>> {
        let (entries, problems) = (self.inner.get_ref().as_table()?, self.problems);
        Some(entries.iter().map(move |(key, inner)| (key.span(), Value::new(key.get_ref(), inner, problems))))
    }

    /// The value under a key of a table, without a look at the others.
    pub(crate) fn entry(&self, key: &'static str) -> Option<Self> {
        let inner = self.inner.get_ref().as_table()?.get(key)?;
        Some(Self { key, inner, ..*self })
    }

    /// Places of a table and of its values.
    pub(crate) fn spans(&self, keys: &Keys) -> ElementSpans {
        let values = keys.names().filter_map(|key| Some((key, self.entry(key)?.span()))).collect();
        ElementSpans { header: self.span(), values }
    }

    /// A text as it is, empty or not.
    pub(crate) fn words(&self) -> Option<&'a str> {
        self.inner.get_ref().as_str()
    }

    pub(crate) fn is_number(&self) -> bool {
        matches!(self.inner.get_ref(), DeValue::Integer(_) | DeValue::Float(_))
    }

    /// The value as a program would give it; dates are refused.
    pub(crate) fn given(&self) -> Option<KeyValue> {
        match self.inner.get_ref() {
            DeValue::String(text) => Some(KeyValue::Text(text.to_string())),
            DeValue::Boolean(boolean) => Some(KeyValue::Bool(*boolean)),
            DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
                Ok(integer) => Some(KeyValue::Integer(integer)),
                Err(_) => self.refuse("an integer beyond 64 bits", "too large", ""),
            },
            DeValue::Float(_) => self.quantity(Dimension::NUMBER).map(KeyValue::Number),
            DeValue::Array(_) => self.list("a list of values", |item| item.given()).map(KeyValue::List),
            DeValue::Table(_) => {
                let entries =
                    self.entries()?.map(|(_, value)| Some((value.key().to_owned(), value.given()?)));
                all(entries.collect()).map(KeyValue::Table)
            }
            DeValue::Datetime(_) => {
                self.mismatch("a number, a text, true or false, a list or a table", "write one of these")
            }
        }
    }

    /// A text.
    pub(crate) fn text(&self) -> Option<&'a str> {
        let help = format!("write the {} in quotes", self.key);
        match self.inner.get_ref().as_str() {
            Some("") => self.refuse(format!("`{}` is empty", self.key), "an empty text", help),
            Some(text) => Some(text),
            None => self.mismatch("a text", &help),
        }
    }

    /// A name: a text in one line.
    pub(crate) fn name(&self) -> Option<&'a str> {
        let text = self.text()?;
        if text.contains(['\t', '\n', '\u{b}', '\u{c}', '\r', '\u{85}', '\u{2028}', '\u{2029}']) {
            let help = "write it without line breaks and tabs";
            return self.refuse(
                format!("{text:?} is not in one line, as a name is"),
                "more than a line",
                help,
            );
        }
        Some(text)
    }

    /// One of several words.
    pub(crate) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let text = self.text()?;
        if let Some((_, value)) = choices.iter().find(|(word, _)| *word == text) {
            return Some(*value);
        }
        let words = choices.iter().map(|(word, _)| *word);
        let list = alternatives(&words.clone().map(|word| format!("{word:?}")).collect::<Vec<_>>());
        let help = match nearest(text, words) {
            Some(meant) => format!("did you mean {meant:?}? write {list}"),
            None => format!("write {list}"),
        };
        self.refuse(format!("`{}` cannot be {text:?}", self.key), "unknown word", help)
    }

    /// A setting that is one of a few.
    pub(crate) fn named<T: Named>(&self) -> Option<T> {
        let former = self.words().and_then(|word| Some((word, T::renamed(word)?)));
        if let Some((word, today)) = former {
            self.problems.renamed(self.span(), &format!("{} = {word:?}", self.key), &format!("{today:?}"));
            return T::of(word);
        }
        self.choice(&T::VALUES.iter().map(|(word, value, _)| (*word, *value)).collect::<Vec<_>>())
    }

    /// `true` or `false`.
    pub(crate) fn boolean(&self) -> Option<bool> {
        match self.inner.get_ref().as_bool() {
            Some(boolean) => Some(boolean),
            None => self.mismatch("true or false", "write true or false, without quotes"),
        }
    }

    /// Refuses a value that makes elements, so many of these bytes each, for which there is no room.
    pub(crate) fn room(&self, elements: f64, bytes: f64) -> Option<()> {
        match memory::ask(elements * bytes) {
            Ok(()) => Some(()),
            Err(cause) => self.refuse(
                format!("`{}` makes {elements} elements: {cause}", self.key),
                "too many",
                "write fewer: a body that spins slowly bends in long waves",
            ),
        }
    }

    /// An integer in a range.
    pub(crate) fn integer(&self, range: RangeInclusive<usize>) -> Option<usize> {
        let expected = format!("an integer from {} to {}", range.start(), range.end());
        let DeValue::Integer(integer) = self.inner.get_ref() else {
            return self.mismatch(&expected, &format!("write {expected}"));
        };
        match usize::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(value) if range.contains(&value) => Some(value),
            _ => self.refuse(
                format!("`{}` is {integer}, but must be {expected}", self.key),
                "out of range",
                format!("write {expected}"),
            ),
        }
    }

    /// A finite number: plain in SI units, or a text with its unit.
    pub(crate) fn quantity(&self, dimension: Dimension) -> Option<f64> {
        let number = self.number(dimension)?;
        self.problems.measured(self.span(), number, dimension.unit());
        Some(number)
    }

    fn number(&self, dimension: Dimension) -> Option<f64> {
        let (number, written) = match self.inner.get_ref() {
            DeValue::Float(float) => (float.as_str().parse().unwrap_or(f64::NAN), float.to_string()),
            DeValue::Integer(integer) => (nearest_number(integer), integer.to_string()),
            DeValue::String(text) => return self.quantity_in_words(text, dimension),
            _ => return self.mismatch(dimension.name(), &advice(dimension)),
        };
        if number.is_finite() {
            Some(number)
        } else {
            let message = format!("`{}` is {written}, which is not a finite number", self.key);
            self.refuse(message, "not a finite number", advice(dimension))
        }
    }

    /// A quantity above zero.
    pub(crate) fn positive(&self, dimension: Dimension) -> Option<f64> {
        let number = self.quantity(dimension)?;
        if number > 0.0 {
            Some(number)
        } else {
            self.outside(number, dimension, "positive", advice(dimension))
        }
    }

    /// A quantity that is zero or above.
    pub(crate) fn non_negative(&self, dimension: Dimension) -> Option<f64> {
        let number = self.quantity(dimension)?;
        let help = "write zero or a positive value";
        if number >= 0.0 {
            Some(number)
        } else {
            self.outside(number, dimension, "zero or positive", help.to_owned())
        }
    }

    /// A quantity between two bounds and equal to neither; `allowed` says so in words.
    pub(crate) fn between(
        &self,
        dimension: Dimension,
        [lower, upper]: [f64; 2],
        allowed: &str,
    ) -> Option<f64> {
        let number = self.quantity(dimension)?;
        if number > lower && number < upper {
            Some(number)
        } else {
            self.outside(number, dimension, allowed, advice(dimension))
        }
    }

    /// A quality factor: a pure number that is 1 or above.
    pub(crate) fn quality(&self) -> Option<f64> {
        let number = self.quantity(Dimension::NUMBER)?;
        let help = "for a material that loses more than it stores, write its kind \"maxwell\", \"standard-linear\" or \"table\"";
        if number >= 1.0 {
            Some(number)
        } else {
            self.outside(number, Dimension::NUMBER, "at least 1", help.to_owned())
        }
    }

    /// Three quantities.
    pub(crate) fn vector(&self, dimension: Dimension) -> Option<[f64; 3]> {
        self.numbers(dimension)
    }

    /// An array of exactly `N` quantities.
    pub(crate) fn numbers<const N: usize>(&self, dimension: Dimension) -> Option<[f64; N]> {
        self.array("numbers", |item| item.quantity(dimension))
    }

    /// Named places, a vector each, in the order of the file; `what` and `help` are for another kind of value.
    pub(crate) fn places(&self, what: &str, help: &str) -> Option<Vec<(String, [f64; 3])>> {
        let Some(entries) = self.entries() else { return self.mismatch(what, help) };
        let mut entries: Vec<_> = entries.collect();
        entries.sort_by_key(|(span, _)| span.start);
        let place = |(_, place): (_, Self)| Some((place.key().to_owned(), place.vector(Dimension::LENGTH)?));
        all(entries.into_iter().map(place).collect())
    }

    /// Three rows of three quantities.
    pub(crate) fn matrix(&self, dimension: Dimension) -> Option<[[f64; 3]; 3]> {
        self.array("rows", |row| row.vector(dimension))
    }

    /// An array of exactly `N` values, each read by `read`.
    pub(crate) fn array<T, const N: usize>(
        &self,
        noun: &str,
        read: impl Fn(Self) -> Option<T>,
    ) -> Option<[T; N]> {
        let items = match self.items() {
            Some(items) if items.len() == N => items,
            _ => {
                let help = format!("write {N} {noun} in brackets, with commas between them");
                return self.mismatch(&format!("an array of {N} {noun}"), &help);
            }
        };
        all(items.into_iter().map(read).collect())?.try_into().ok()
    }

    /// An array of any number of values, each read by `read`.
    pub(crate) fn list<T>(&self, expected: &str, read: impl Fn(Self) -> Option<T>) -> Option<Vec<T>> {
        match self.items() {
            Some(items) => all(items.into_iter().map(read).collect()),
            None => self.mismatch(expected, &format!("write {expected}")),
        }
    }

    /// Reports that the value is of another kind than expected.
    pub(crate) fn mismatch<T>(&self, expected: &str, help: &str) -> Option<T> {
        let found = self.found();
        self.refuse(format!("`{}`: found {found}, expected {expected}", self.key), &found, help)
    }

    /// Reports a problem of the value; an empty help is none.
    pub(crate) fn refuse<T>(
        &self,
        message: impl Into<String>,
        label: &str,
        help: impl Into<String>,
    ) -> Option<T> {
        self.refuse_at(self.span(), message, label, help)
    }

    /// Reports a problem at a place that belongs to the value; an empty help is none.
    pub(crate) fn refuse_at<T>(
        &self,
        span: Range<usize>,
        message: impl Into<String>,
        label: &str,
        help: impl Into<String>,
    ) -> Option<T> {
        let help = Some(help.into()).filter(|help| !help.is_empty());
        self.problems.report(Diagnostic { help, ..Diagnostic::new(span, message, label) });
        None
    }

    /// Kind of the value, in words.
    pub(crate) fn found(&self) -> String {
        match self.inner.get_ref() {
            DeValue::String(_) => "a text".to_owned(),
            DeValue::Integer(_) => "an integer".to_owned(),
            DeValue::Float(_) => "a decimal number".to_owned(),
            DeValue::Boolean(boolean) => boolean.to_string(),
            DeValue::Datetime(_) => "a date or time".to_owned(),
            DeValue::Array(items) if items.len() == 1 => "an array of 1 value".to_owned(),
            DeValue::Array(items) => format!("an array of {} values", items.len()),
            DeValue::Table(_) => "a table".to_owned(),
        }
    }

    fn quantity_in_words(&self, text: &str, dimension: Dimension) -> Option<f64> {
        match quantity(text, dimension) {
            Ok(number) => Some(number),
            Err(error) => {
                let message = format!("`{}`: {error}", self.key);
                self.refuse(message, &format!("{} is needed", dimension.name()), error.advice())
            }
        }
    }

    fn outside<T>(&self, number: f64, dimension: Dimension, allowed: &str, help: String) -> Option<T> {
        let unit = dimension.unit();
        let space = if unit.is_empty() { "" } else { " " };
        let message = format!("`{}` is {number}{space}{unit}, but must be {allowed}", self.key);
        self.refuse(message, &format!("must be {allowed}"), help)
    }
}

/// All values, if none is missing.
fn all<T>(values: Vec<Option<T>>) -> Option<Vec<T>> {
    values.into_iter().collect()
}

/// Words with commas between them, and "or" before the last.
pub(crate) fn alternatives(words: &[String]) -> String {
    match words {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => words.concat(),
    }
}

fn nearest_number(integer: &DeInteger<'_>) -> f64 {
    match i128::from_str_radix(integer.as_str(), integer.radix()) {
        Ok(number) => number as f64,
        Err(_) if integer.radix() == 10 => integer.as_str().parse().unwrap_or(f64::NAN),
        Err(_) => f64::INFINITY,
    }
}

fn advice(dimension: Dimension) -> String {
    if dimension.unit().is_empty() {
        "write a number".to_owned()
    } else {
        format!(
            "write a number in {}, or a text with its unit such as \"{}\"",
            dimension.unit(),
            dimension.example()
        )
    }
}
