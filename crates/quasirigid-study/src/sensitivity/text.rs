//! Sensitivities in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::Sensitivity;
use crate::layout::paragraph;
use crate::report::tornado_picture;
use crate::words::{significant, time};

/// Keys that the sentence names, and those that are listed.
const NAMED: usize = 3;
const LISTED: usize = 20;
/// Relative derivative below which a key does not matter.
const NOTHING: f64 = 5e-7;
/// Columns of the longest bar.
const BAR: f64 = 24.0;
/// Answers for a derivative, as most quantities need, and the time (s) from which the work is announced.
const ANSWERS: f64 = 12.0;
const PATIENCE: f64 = 1.0;

/// What the derivatives with respect to so many keys may take, from the time (s) of one answer; none if it is short.
pub(super) fn outlook(keys: usize, answer: f64) -> Option<String> {
    let threads = std::thread::available_parallelism().map_or(1.0, |count| count.get() as f64);
    let whole = keys as f64 * ANSWERS * answer / threads;
    (whole > PATIENCE).then(|| {
        format!(
            "one answer takes {}; the derivatives with respect to {keys} keys may take about {}",
            time(answer),
            time(whole)
        )
    })
}

impl Sensitivity {
    /// For a terminal of 80 columns: every key if asked for `all`, else the first.
    #[must_use]
    pub fn text(&self, all: bool) -> String {
        let mut text = String::new();
        self.write(&mut text, if all { usize::MAX } else { LISTED }).expect("a string takes any text");
        text
    }

    /// Tornado of the keys that matter, as an SVG file of its own; none where the quantity is zero or no key changes it.
    #[must_use]
    pub fn picture(&self) -> Option<String> {
        let shown = self.derivatives.iter().filter(|each| self.effect(each).abs() > NOTHING).take(LISTED);
        let effects: Vec<(&str, f64)> = shown.map(|each| (each.key.as_str(), self.effect(each))).collect();
        (self.value != 0.0).then(|| tornado_picture(&self.quantity, &effects))?
    }

    /// What matters most, in a sentence.
    pub(super) fn told(&self) -> String {
        let value = significant(self.value, 5);
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let strongest = self.derivatives.iter().filter(|each| self.effect(each).abs() > NOTHING).take(NAMED);
        let named = strongest.map(|each| {
            let change = signed(self.effect(each));
            if each.value == 0.0 {
                format!("{change} % for 1 % of {} in {}", significant(each.scale, 3), each.key)
            } else {
                format!("{change} % for 1 % more {}", each.key)
            }
        });
        let named: Vec<String> = named.collect();
        match named.as_slice() {
            [] => format!("{} is {value}{unit}; no number of the model changes it.", self.quantity),
            named => format!("{} is {value}{unit}; it changes most by {}.", self.quantity, named.join(", ")),
        }
    }

    /// Relative change of the quantity over that of a key, in sizes of the key; absolute where the quantity is zero.
    fn effect(&self, each: &super::KeyDerivative) -> f64 {
        let change = each.derivative * each.scale;
        if self.value == 0.0 { change } else { change / self.value.abs() }
    }

    fn write(&self, out: &mut String, listed: usize) -> fmt::Result {
        writeln!(out, "{}", paragraph(&format!("{}: {}", self.name, self.sentence), "", "  "))?;
        let shown: Vec<_> =
            self.derivatives.iter().filter(|each| self.effect(each).abs() > NOTHING).collect();
        let largest = shown.iter().map(|each| self.effect(each).abs()).fold(0.0, f64::max);
        if !shown.is_empty() {
            let width = shown.iter().take(listed).map(|each| each.key.len()).max().unwrap_or(0);
            writeln!(out, "\n  change in % for 1 % of the key")?;
            for each in shown.iter().take(listed) {
                let effect = self.effect(each);
                let bar = "#".repeat((BAR * effect.abs() / largest).ceil() as usize);
                writeln!(out, "  {:<width$} {:>10}  {bar}", each.key, signed(effect))?;
            }
            if shown.len() > listed {
                writeln!(out, "  and {} more (--all lists them)", shown.len() - listed)?;
            }
        }
        let idle: Vec<&str> = self.derivatives[shown.len()..].iter().map(|each| each.key.as_str()).collect();
        if !idle.is_empty() && !shown.is_empty() {
            writeln!(out, "\n{}", paragraph(&format!("without effect: {}", idle.join(", ")), "  ", "    "))?;
        }
        let mut reasons: Vec<&str> = self.not_known.iter().map(|none| none.reason.as_str()).collect();
        reasons.sort_unstable();
        reasons.dedup();
        for reason in reasons {
            let keys = self.not_known.iter().filter(|none| none.reason == reason);
            let keys: Vec<&str> = keys.map(|none| none.key.as_str()).collect();
            let line = format!("NOT KNOWN for {}: {reason}", keys.join(", "));
            writeln!(out, "\n{}", paragraph(&line, "  ", "    "))?;
        }
        Ok(())
    }
}

/// Why a quantity with a corner has no derivative. (O2)
pub(super) fn corner(slope: f64, corner: f64, scale: f64) -> String {
    let [before, after] = [slope - corner, slope + corner].map(|slope| significant(slope / scale, 4));
    format!(
        "the quantity has a corner or a jump there (slopes {before} before and {after} after): two modes of the same frequency, or a change of method"
    )
}

/// Why a quantity that is not smooth enough has no derivative.
pub(super) fn rough(step: f64) -> String {
    format!(
        "the differences do not settle down to steps of {} of the key: the quantity changes too sharply, or its own error is too large",
        significant(step, 2)
    )
}

fn signed(number: f64) -> String {
    let digits = significant(number, 4);
    if number > 0.0 { format!("+{digits}") } else { digits }
}
