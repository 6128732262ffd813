//! A light curve in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::periods::{PairObject, PeriodsObject};
use super::{LightCurve, View};
use crate::layout::paragraph;
use crate::words::{significant, time};

/// Lines that are listed.
const LISTED: usize = 8;

/// Note on a shape that was observed in rotation.
pub(super) const RELAXED: &str = "the surface is that of the relaxed body, without the bulge of the spin with which it was observed; the difference is a strain";

/// In which axes the places of a file are taken.
pub(super) fn of_frame(view: &View) -> Option<String> {
    matches!(view, View::File(_)).then(|| {
        "the places of the view are taken in the inertial axes of the model: where they are ecliptic, [initial] attitude turns the body from ecliptic axes; times are taken as light-time corrected".to_owned()
    })
}

impl LightCurve {
    pub(super) fn told(&self) -> String {
        let mut parts: Vec<String> = self
            .notes
            .iter()
            .filter(|note| note.starts_with(crate::MAY_NOT_HOLD))
            .map(|note| format!("{note}."))
            .collect();
        let from = if self.surface.convex { "" } else { ", with the shadows that it throws on itself" };
        let amplitude = if self.amplitude.is_finite() {
            format!("{} mag", significant(self.amplitude, 3))
        } else {
            "NOT finite: at times the body is dark".to_owned()
        };
        parts.push(format!(
            "{} times over {}; amplitude {amplitude}; mean brightness that of {} m^2{from}.",
            self.t.len(),
            time(self.t.last().copied().unwrap_or(0.0) - self.t.first().copied().unwrap_or(0.0)),
            significant(self.mean_brightness, 4)
        ));
        if let Some(residuals) = &self.residuals {
            parts.push(if residuals.rms.is_nan() {
                "Each block of the measured brightness has a single point and a scale of its own: nothing is compared.".to_owned()
            } else {
                format!(
                "The measured brightness differs by {} % (root mean square) in {}, each with a scale of its own.",
                significant(100.0 * residuals.rms, 3),
                if residuals.blocks.len() == 1 { "one block".to_owned() } else { format!("{} blocks", residuals.blocks.len()) }
            )
            });
        }
        parts.extend(self.periods.as_ref().map(PeriodsObject::told));
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
        for note in self.notes.iter().filter(|note| !note.starts_with(crate::MAY_NOT_HOLD)) {
            writeln!(out, "{}", paragraph(&format!("note: {note}"), "  ", "    "))?;
        }
        let surface = &self.surface;
        let error = if surface.error > 0.0 {
            format!("about {} %", significant(100.0 * surface.error, 2))
        } else {
            "none".to_owned()
        };
        writeln!(
            out,
            "\n  {:<22} {} ({} facets, {})",
            "surface",
            surface.kind,
            surface.facets,
            if surface.convex { "convex" } else { "not convex" }
        )?;
        writeln!(out, "  {:<22} {error}", "error of the facets")?;
        if let Some(albedo) = self.albedo {
            writeln!(out, "  {:<22} {}", "geometric albedo", significant(albedo, 4))?;
        }
        let [low, high] = ends(&self.phase_angle).map(|angle| significant(angle.to_degrees(), 4));
        writeln!(out, "  {:<22} {low} to {high} deg", "phase angle")?;
        let [low, high] = ends(&self.magnitude).map(|value| format!("{value:.3}"));
        let zero = if self.zero == "V" { "V, at 1 au from Sun and observer" } else { "over the mean" };
        writeln!(out, "  {:<22} {low} to {high} ({zero})", "magnitude")?;
        if let Some(periods) = &self.periods {
            periods.write(out)?;
        }
        Ok(())
    }
}

fn ends(values: &[f64]) -> [f64; 2] {
    [
        values.iter().copied().fold(f64::INFINITY, f64::min),
        values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

fn periods_of(pair: &PairObject) -> String {
    let [first, second] = pair.deviations;
    let told = |period: f64, deviation: f64| format!("{} +- {}", time(period), time(deviation));
    match pair.second {
        Some(other) => format!("{} and {}", told(pair.first, first), told(other, second)),
        None => told(pair.first, first),
    }
}

impl PeriodsObject {
    fn told(&self) -> String {
        let mut parts = Vec::new();
        match &self.pairs[..] {
            [] => parts.push(format!(
                "No frequency stands out of the {} curve, at periods above {}.",
                self.of,
                time(self.highest.recip())
            )),
            [best, others @ ..] => {
                let share = significant(100.0 * best.explained, 3);
                let kind = if best.second.is_some() {
                    "Two frequencies"
                } else {
                    "One frequency, as of a steady rotation or one that is not resolved,"
                };
                parts.push(format!(
                    "{kind} of the {} curve with the periods {} give {share} % of the power of its lines.",
                    self.of,
                    periods_of(best)
                ));
                if best.second.is_none() {
                    parts.push("A body that looks the same from both sides has two maxima a rotation, so that the period may be twice as long.".to_owned());
                }
                if let Some(alias) = others.first() {
                    parts.push(format!(
                        "The curve alone does not tell them from others such as {}.",
                        periods_of(alias)
                    ));
                }
            }
        }
        if let Some(model) = &self.model {
            let own = format!(
                "{} of precession and {} of rotation",
                time(model.precession_period),
                time(model.rotation_period)
            );
            parts.push(match (model.found, model.deviations) {
                (Some([precession, rotation]), Some([first, second])) => format!(
                    "The model has the periods {own}; by the multiples of their frequencies the curve has {} +- {} and {} +- {}, with {} % of the power.",
                    time(precession),
                    time(first),
                    time(rotation),
                    time(second),
                    significant(100.0 * model.explained, 3)
                ),
                _ => format!("The model has the periods {own}, and the lines of the curve do NOT tell both of them."),
            });
        }
        parts.join(" ")
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        writeln!(
            out,
            "\n  {:>14} {:>14} {:>12} {:>12}",
            "period", "frequency [Hz]", "amplitude", "of the model"
        )?;
        for line in self.lines.iter().take(LISTED) {
            let numbers = line.of_model.map_or_else(String::new, |[j, k]| format!("{j:+} {k:+}"));
            writeln!(
                out,
                "  {:>14} {:>14} {:>12} {numbers:>12}",
                time(line.frequency.recip()),
                significant(line.frequency, 7),
                significant(line.amplitude, 4)
            )?;
        }
        Ok(())
    }
}
