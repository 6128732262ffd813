//! Inferred parameters in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::{Alternative, Combination, Inferred, Parameter};
use crate::layout::paragraph;
use crate::words::significant;

/// Heading of intervals by the profile likelihood.
const PROFILED: &str = "by the profile likelihood";

impl Inferred {
    /// The result in a few sentences, what does not hold first.
    pub(super) fn told(&self) -> String {
        let mut parts = Vec::new();
        if !self.converged {
            parts.push("The search did NOT end at a least: these are not the best values.".to_owned());
        }
        let (chi2, freedom) = (significant(self.chi2, 4), self.degrees_of_freedom);
        match self.explained {
            Some(false) if self.scatter.is_some() => parts.push(format!(
                "The model does NOT explain the data: what is left, {} about the best history, is no noise, as neighbouring residuals are alike (correlation {}). Another least, another key or another force is behind it.",
                significant(self.scatter.unwrap_or(f64::NAN), 3),
                significant(self.correlation, 2)
            )),
            Some(false) => parts.push(format!(
                "The model does NOT explain the data within their deviations: chi-squared is {chi2} for {freedom} degrees of freedom."
            )),
            Some(true) if freedom == 0 => parts.push(
                "As many values as keys: nothing is left to test the model by."
                    .to_owned(),
            ),
            Some(true) => parts.push(format!(
                "The model explains the data: chi-squared is {chi2} for {freedom} degrees of freedom."
            )),
            None => parts.push(format!(
                "The data scatter by {} about the best history; deviations are taken from this scatter.",
                significant(self.scatter.unwrap_or(f64::NAN), 3)
            )),
        }
        parts.extend(self.elsewhere());
        parts.extend(self.parameters.iter().filter_map(bounded));
        parts.extend(self.not_distinguished.iter().map(unseen));
        parts.join(" ")
    }

    /// Other values that fit nearly as well.
    fn elsewhere(&self) -> Option<String> {
        let place = |other: &Alternative| {
            let values = self.parameters.iter().zip(&other.values);
            let values = values.map(|(each, value)| {
                format!("{} = {} {}", each.key, significant(*value, 4), each.unit).trim_end().to_owned()
            });
            values.collect::<Vec<_>>().join(", ")
        };
        let places: Vec<String> = self.alternatives.iter().map(place).collect();
        (!places.is_empty()).then(|| {
            format!("The data do NOT tell these from other values: {} fit as well.", places.join("; or "))
        })
    }

    /// For a terminal of 80 columns.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes any text");
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "{}", paragraph(&format!("{}: {}", self.name, self.sentence), "", "  "))?;
        for note in &self.notes {
            writeln!(out, "{}", paragraph(&format!("note: {note}"), "  ", "    "))?;
        }
        self.write_keys(out)?;
        self.write_answers(out)
    }

    fn write_keys(&self, out: &mut String) -> fmt::Result {
        let width = self.parameters.iter().map(|each| each.key.len()).max().unwrap_or(0);
        writeln!(out, "\n  {:<width$} {:>14} {:>12} {:>14}", "key", "value", "sigma", "in the file")?;
        for each in &self.parameters {
            let unknown = if each.at_bound.is_some() { "AT A BOUND" } else { "NOT KNOWN" };
            let sigma = each.sigma.map_or_else(|| unknown.to_owned(), |sigma| significant(sigma, 3));
            let [value, before] = [each.value, each.before].map(|value| significant(value, 7));
            let line = format!("  {:<width$} {value:>14} {sigma:>12} {before:>14} {}", each.key, each.unit);
            writeln!(out, "{}", line.trim_end())?;
        }
        let width = width.max(PROFILED.len());
        let profiled = || self.parameters.iter().filter(|each| each.profiled);
        if profiled().next().is_some() {
            writeln!(out, "\n  {:<width$} {:>22} {:>22}", PROFILED, "68 %", "95 %")?;
        }
        for each in profiled() {
            let errors = [each.interval_68, each.interval_95].map(|ends| errors(each.value, ends));
            writeln!(out, "  {:<width$} {:>22} {:>22}", each.key, errors[0], errors[1])?;
        }
        if profiled().next().is_some() {
            writeln!(out, "  from {} models in all", self.models)?;
        }
        Ok(())
    }

    fn write_answers(&self, out: &mut String) -> fmt::Result {
        if self.measured.is_empty() {
            return Ok(());
        }
        let width = self.measured.iter().map(|each| each.quantity.len()).max().unwrap_or(0);
        writeln!(
            out,
            "\n  {:<width$} {:>11} {:>8} {:>11} {:>7}",
            "measured", "value", "sigma", "fitted", "off by"
        )?;
        for each in &self.measured {
            let [value, fitted] = [each.value, each.fitted].map(|value| significant(value, 5));
            let (sigma, off) = (significant(each.sigma, 2), significant(each.residual, 2));
            let line = format!(
                "  {:<width$} {value:>11} {sigma:>8} {fitted:>11} {off:>7} {}",
                each.quantity, each.unit
            );
            writeln!(out, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

fn unseen(combination: &Combination) -> String {
    let changes = combination.changes.iter();
    let changes: Vec<String> = changes
        .map(|change| {
            format!("{}{} % of {}", sign(change.relative), significant(change.relative.abs(), 2), change.key)
        })
        .collect();
    let known = combination.sigma.map_or_else(
        || "not at all".to_owned(),
        |sigma| format!("to {} % only", significant(100.0 * sigma, 2)),
    );
    match changes.as_slice() {
        [one] => format!(
            "The data do not tell {}: {known}.",
            one.split_once(" of ").map_or(one.as_str(), |split| split.1)
        ),
        _ => format!(
            "The data do not tell these keys apart: they see a change by {} {known}.",
            changes.join(" and ")
        ),
    }
}

fn sign(number: f64) -> char {
    if number < 0.0 { '-' } else { '+' }
}

/// Asymmetric errors of a value.
fn errors(value: f64, [low, high]: [Option<f64>; 2]) -> String {
    let error = |sign: char, end: Option<f64>| {
        let size = end.map_or_else(|| "unbounded".to_owned(), |end| significant((end - value).abs(), 3));
        format!("{sign}{size}")
    };
    format!("{} {}", error('+', high), error('-', low))
}

/// A key at a bound of its range: what the data allow on the other side.
fn bounded(parameter: &Parameter) -> Option<String> {
    let at = parameter.at_bound?;
    let [low, high] = parameter.interval_95;
    let unit = if parameter.unit.is_empty() { String::new() } else { format!(" {}", parameter.unit) };
    let value = format!("{}{unit}", significant(parameter.value, 4));
    let (bound, side, end) = if at == "low" { ("least", "most", high) } else { ("greatest", "least", low) };
    let reach = match end {
        Some(end) => format!("at {side} {}{unit} with 95 %", significant(end, 4)),
        None if parameter.profiled => "the data set no other end".to_owned(),
        None => "--profile auto tells how far the data let it go".to_owned(),
    };
    Some(format!("{} is at the {bound} value of its range, {value}: {reach}.", parameter.key))
}
