//! Inferred parameters in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::{Combination, Inferred};
use crate::layout::paragraph;
use crate::words::significant;

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
            Some(true) => parts.push(format!(
                "The model explains the data: chi-squared is {chi2} for {freedom} degrees of freedom."
            )),
            None => parts.push(format!(
                "The data scatter by {} about the best history; deviations are taken from this scatter.",
                significant(self.scatter.unwrap_or(f64::NAN), 3)
            )),
        }
        parts.extend(self.not_distinguished.iter().map(unseen));
        parts.join(" ")
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
        let width = self.parameters.iter().map(|each| each.key.len()).max().unwrap_or(0);
        writeln!(out, "\n  {:<width$} {:>14} {:>12} {:>14}", "key", "value", "sigma", "in the file")?;
        for each in &self.parameters {
            let sigma = each.sigma.map_or_else(|| "NOT KNOWN".to_owned(), |sigma| significant(sigma, 3));
            let [value, before] = [each.value, each.before].map(|value| significant(value, 7));
            let line = format!("  {:<width$} {value:>14} {sigma:>12} {before:>14} {}", each.key, each.unit);
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
