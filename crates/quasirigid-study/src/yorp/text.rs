//! YORP in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::{Yorp, YorpObject};
use crate::layout::paragraph;
use crate::words::{significant, time};

const DAY: f64 = 86_400.0;
/// Julian year (s) times a million.
const MILLION_YEARS: f64 = 1e6 * 365.25 * DAY;
/// Rows of the curve that a terminal shows.
const EVERY: usize = 3;

impl Yorp {
    pub(super) fn told(&self) -> String {
        let mut parts: Vec<String> = self
            .notes
            .iter()
            .filter(|note| note.starts_with(crate::MAY_NOT_HOLD))
            .map(|note| format!("{note}."))
            .collect();
        parts.push(match &self.now {
            Some(now) => format!(
                "At its obliquity of {} degrees sunlight {}, {} rad/d^2, and changes its obliquity by {} degrees in a million years.",
                significant(now.obliquity.to_degrees(), 4),
                spun(now),
                significant(now.spin_rate * DAY * DAY, 3),
                significant(now.obliquity_rate.to_degrees() * MILLION_YEARS, 3),
            ),
            None => {
                let ends = self.curve.iter().map(|at| at.spin_rate * DAY * DAY);
                let [low, high] = [ends.clone().fold(f64::INFINITY, f64::min), ends.fold(f64::NEG_INFINITY, f64::max)];
                format!(
                    "On a circular orbit at the distance of the Sun the spin changes by {} to {} rad/d^2, by the obliquity.",
                    significant(low, 3),
                    significant(high, 3)
                )
            }
        });
        parts.join(" ")
    }

    /// For a terminal of 80 columns.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        // writing to a text never fails
        let _ = self.write(&mut out);
        out
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "{}", paragraph(&format!("{}: {}", self.name, self.sentence), "", "  "))?;
        for note in self.notes.iter().filter(|note| !note.starts_with(crate::MAY_NOT_HOLD)) {
            writeln!(out, "{}", paragraph(&format!("note: {note}"), "  ", "    "))?;
        }
        writeln!(out)?;
        let mut line = |name: &str, value: String| writeln!(out, "  {name:<22} {value}");
        line("period of the spin", time(std::f64::consts::TAU / self.spin))?;
        line("greatest moment", format!("{} kg m^2", significant(self.moment, 4)))?;
        line("pressure of the light", format!("{} Pa", significant(self.pressure, 4)))?;
        line("thermal parameter", significant(self.thermal_parameter, 3))?;
        line("lag of the heat", format!("{} deg", significant(self.lag.to_degrees(), 3)))?;
        line("error", format!("about {} %", significant(100.0 * self.error, 2)))?;
        writeln!(
            out,
            "\n  {:>15} {:>16} {:>20} {:>20}",
            "obliquity [deg]", "spin [rad/d^2]", "obliquity [deg/Myr]", "doubles or halves"
        )?;
        for at in self.curve.iter().step_by(EVERY) {
            let lasts = at.doubling_time.or(at.halving_time).map_or_else(|| "never".to_owned(), time);
            writeln!(
                out,
                "  {:>15} {:>16} {:>20} {lasts:>20}",
                significant(at.obliquity.to_degrees(), 4),
                significant(at.spin_rate * DAY * DAY, 3),
                significant(at.obliquity_rate.to_degrees() * MILLION_YEARS, 3),
            )?;
        }
        Ok(())
    }
}

fn spun(at: &YorpObject) -> String {
    match (at.doubling_time, at.halving_time) {
        (Some(doubling), _) => format!("doubles its spin in {}", time(doubling)),
        (_, Some(halving)) => format!("halves its spin in {}", time(halving)),
        _ => "leaves its spin".to_owned(),
    }
}
