//! An audit in words: the verdict first, then what limits it.

use std::fmt::{self, Write};

use quasirigid::model::Mode;

use super::answer::{Audit, time_constant};
use super::drift::Drift;
use super::measure::{Measured, UnitSource};
use super::model::OfModel;
use super::order::unknown;
use super::rigid::Rigid;
use crate::layout::paragraph;
use crate::words::{significant, time};

/// Nutation (rad) above which the time constant of a small one is only the trend of its amplitude.
const LARGE: f64 = 0.35;
/// Misfit of Euler's equations from which the history is told not to be one of this body.
pub const ROUGH: f64 = 0.1;
/// Digits of angles in the table.
const DIGITS: i32 = 4;
/// Rounding of the energy, relative, from which a history tells nothing.
const COARSE: f64 = 0.1;
/// Relative change of the angular momentum that is told first.
const FORCED: f64 = 0.01;
/// Deviation of the factor of the units, relative, from which another inertia would fit better.
const OFF: f64 = 5e-3;

/// What the sentence of an audit is made from.
pub struct Told<'a> {
    /// History.
    pub measured: &'a Measured,
    /// Body.
    pub body: &'a Rigid,
    /// Drift.
    pub drift: &'a Drift,
    /// Time constant of the model.
    pub model: Option<&'a OfModel>,
    /// Rate (1/s) that nothing explains.
    pub left: Option<f64>,
    /// Noun of the angle.
    pub nutation: &'static str,
    /// Whether the history is the only one.
    pub alone: bool,
}

impl Told<'_> {
    /// The answer in a few sentences.
    pub fn sentence(&self) -> String {
        let mut parts = self.warnings();
        let forced = self.drift.momentum_change.last.abs() > FORCED;
        parts.extend(self.momentum().filter(|_| forced));
        parts.push(self.verdict());
        parts.extend(self.momentum().filter(|_| !forced));
        parts.extend(self.explained());
        parts.join(" ")
    }

    /// Reasons for which the numbers may not hold.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if let Some(fit) = self.measured.fit.filter(|fit| fit.misfit > ROUGH) {
            warnings.push(format!(
                "This is NOT the motion of a free rigid body with this inertia: Euler's equations leave {} % of the change of the rates unexplained.",
                significant(100.0 * fit.misfit, 2)
            ));
        }
        if let Some(or) = self.measured.units.or {
            warnings.push(format!(
                "The file is taken to have {}; {or} would give the same motion with times a thousand times longer, so name the units in the heading.",
                self.measured.units.words()
            ));
        }
        if let Some(reason) = &self.measured.left_out {
            let (first, rest) = reason.split_at(1);
            warnings.push(format!("{}{rest}.", first.to_uppercase()));
        }
        warnings
    }

    fn verdict(&self) -> String {
        let drift = self.drift;
        let [momentum, energy] = [drift.momentum_change, drift.energy_change];
        let axis = match drift.mode {
            Mode::ShortAxis => "the axis of greatest inertia",
            Mode::LongAxis => "the axis of least inertia",
        };
        if let Some(rate) = self.left {
            let fate = if rate > 0.0 { "decays" } else { "GROWS" };
            let lost = (rate > 0.0) == (drift.mode == Mode::ShortAxis);
            let what = if lost { "damping" } else { "driving" };
            let beyond =
                if self.explains() { " beyond what the model explains" } else { ", which no rigid body has" };
            return format!(
                "The history INVENTS {what}: the {} about {axis} {fate} e-fold in {}{beyond}.",
                self.nutation,
                time(rate.abs().recip())
            );
        }
        if momentum.largest == 0.0 && energy.largest == 0.0 {
            return "The history keeps energy and angular momentum: neither changes at all.".to_owned();
        }
        if energy.rounding > COARSE {
            let size = significant(energy.rounding, 2);
            return if self.measured.derived.is_some() {
                format!(
                    "The rows are too far apart to tell: rates from the attitude leave the energy open to {size} relative."
                )
            } else {
                format!(
                    "The digits of the file are too few to tell: rounding alone may change the energy by {size} relative."
                )
            };
        }
        if !momentum.is_seen() && !energy.is_seen() {
            return format!(
                "The history keeps energy and angular momentum: neither changes by more than {}, {} and {} relative.",
                self.floor(),
                significant(energy.rounding, 2),
                significant(momentum.rounding, 2)
            );
        }
        format!(
            "The energy changes by {} and the angular momentum by {}, relative; {}",
            significant(energy.last, 3),
            significant(momentum.last, 3),
            self.without_constant(axis)
        )
    }

    /// Why there is no time constant.
    fn without_constant(&self, axis: &str) -> String {
        let (drift, nutation) = (self.drift, self.nutation);
        if !self.body.wobbles() {
            return format!("a body of three equal moments has no {nutation}.");
        }
        if !drift.has_wobble {
            return format!("there is no {nutation} above {} that could decay.", self.floor());
        }
        if let Some(at) = drift.crossing {
            return format!(
                "the motion crosses the separatrix at {} s, so that its {nutation} has no time constant.",
                significant(at, 6)
            );
        }
        if drift.short {
            return format!(
                "in {} revolutions, less than a period of the {nutation}, no trend can be told from an oscillation.",
                significant(drift.turns, 2)
            );
        }
        if self.explains() && time_constant(drift.wobble_trend.as_ref()).is_some() {
            return format!("the model explains the trend of the {nutation} about {axis}.");
        }
        format!("the {nutation} about {axis} has no trend above {}.", self.floor())
    }

    /// What a change has to exceed.
    fn floor(&self) -> &'static str {
        if self.measured.derived.is_some() {
            "what rates from the attitude show"
        } else {
            "the digits of the file"
        }
    }

    fn explains(&self) -> bool {
        matches!(self.model, Some(OfModel::Rate(rate)) if *rate != 0.0)
    }

    fn momentum(&self) -> Option<String> {
        let change = self.drift.momentum_change;
        let told = self.left.is_some() && change.is_seen();
        told.then(|| {
            format!(
                "The angular momentum changes, by {} relative: a torque acts, or the integrator does not keep it; the time constant presumes that no torque acts.",
                significant(change.last, 3)
            )
        })
    }

    fn explained(&self) -> Option<String> {
        let seen = time_constant(self.drift.wobble_trend.as_ref());
        match (self.model?, seen) {
            (OfModel::Unknown(reason), _) => {
                Some(format!("What the model itself loses is not known: {}.", reason.trim_end_matches('.')))
            }
            (OfModel::Rate(0.0), _) => Some("The model has no dissipation.".to_owned()),
            (OfModel::Rate(rate), Some(seen)) => Some(format!(
                "The {} has the time constant {} in the history and {} in the model, which explains {} % of the rate.",
                self.nutation,
                signed(seen),
                signed(rate.recip()),
                significant(100.0 * rate * seen, 3)
            )),
            (OfModel::Rate(rate), None) => Some(format!(
                "The model's own time constant is {}, which the history does not show.",
                signed(rate.recip())
            )),
        }
    }

    /// Notes on what was found in the file, and on the range of the numbers.
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.measured.file.notes.clone();
        let units = self.measured.units;
        match self.measured.source {
            UnitSource::Assumed if self.measured.derived.is_some() => notes.push(
                "times are taken in s: an attitude alone does not tell their unit; name it in the heading, as t [ms]".to_owned(),
            ),
            UnitSource::Assumed => notes.push(
                "the rates hardly change, so that their unit does not show: rad/s and s are taken; name units in the heading, as wx [deg/s]"
                    .to_owned(),
            ),
            UnitSource::Motion if units.factor() != 1.0 => {
                notes.push(format!("by Euler's equations the file has {}", units.words()));
            }
            _ => {}
        }
        if let Some(fit) = self.measured.fit {
            let off = fit.factor / units.factor() - 1.0;
            if off.abs() > OFF.max(3.0 * fit.error) {
                notes.push(format!(
                    "the rates change by {} % faster than Euler's equations with this inertia say: is it exact, and are the rows close enough?",
                    significant(100.0 * off, 2)
                ));
            }
        }
        if let Some(found) = self.measured.attitude {
            notes.push(match self.measured.derived {
                Some(error) => format!(
                    "the file has no rates: they are those of the attitude, {}, through seven rows, known to {} rad/s; three rows at each end have none",
                    found.convention.attitude_words(),
                    significant(error, 2)
                ),
                None => format!("the attitude is told by the rates: {}", found.convention.words()),
            });
        }
        if let (Some([from, to]), Some(_)) = (self.drift.wobble(), self.left)
            && from.max(to) > LARGE
        {
            let nutation = self.nutation;
            notes.push(format!(
                "the {nutation} is large, {} degrees: the time constant is the trend of its amplitude, not that of a small {nutation}",
                significant(from.max(to).to_degrees(), 3)
            ));
        }
        notes.extend(gap(&self.measured.file.t));
        notes.extend(self.left.filter(|_| self.alone).map(|_| unknown().to_owned()));
        notes
    }
}

/// Spacing of rows beside the usual one that is told as a gap.
const GAP: f64 = 10.0;

fn gap(t: &[f64]) -> Option<String> {
    let spacing = |k: usize| t[k + 1] - t[k];
    let longest = (0..t.len() - 1).max_by(|a, b| spacing(*a).total_cmp(&spacing(*b)))?;
    let mean = (t[t.len() - 1] - t[0]) / (t.len() - 1) as f64;
    (spacing(longest) > GAP * mean).then(|| {
        format!("no rows from {} s to {} s", significant(t[longest], 6), significant(t[longest + 1], 6))
    })
}

/// A time constant in words, with its fate.
fn signed(constant: f64) -> String {
    if constant < 0.0 { format!("{} (growing)", time(-constant)) } else { time(constant) }
}

impl Audit {
    /// For a terminal of 80 columns: the verdict, then a table.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes any text");
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let name = quasirigid_io::visible::one_line(&self.file);
        writeln!(out, "{}", paragraph(&format!("{name}: {}", self.sentence), "", "  "))?;
        for note in &self.notes {
            writeln!(out, "{}", paragraph(&format!("note: {note}"), "  ", "    "))?;
        }
        let relative = |value: f64| significant(value, 3);
        writeln!(
            out,
            "\n  {:<18} {:>12} {:>12} {:>12}",
            "relative change", "start to end", "largest", "of rounding"
        )?;
        for (name, last, largest, rounding) in [
            ("energy", self.energy_drift, self.energy_excursion, self.rounding.energy),
            ("angular momentum", self.momentum_drift, self.momentum_excursion, self.rounding.momentum),
        ] {
            let [last, largest, rounding] = [last, largest, rounding].map(relative);
            writeln!(out, "  {name:<18} {last:>12} {largest:>12} {rounding:>12}")?;
        }
        if let Some(attitude) = &self.attitude {
            let angle = relative(attitude.direction_drift.to_degrees());
            writeln!(out, "  the angular momentum turns by {angle} degrees in inertial axes")?;
        }
        let (rows, turns, span) = (self.rows, significant(self.turns, 3), time(self.duration));
        let UnitWords { rates, times } = UnitWords::of(self);
        writeln!(
            out,
            "  {rows} rows, {span}, {turns} revolutions; {rates} and {times}, {}",
            self.rounding.digits
        )?;
        self.write_intervals(out)
    }

    fn write_intervals(&self, out: &mut String) -> fmt::Result {
        if self.dissipation.len() < 2 {
            return Ok(());
        }
        writeln!(
            out,
            "\n  {:>12} {:>12} {:>10} {:>14} {:>14}",
            "from (s)", "to (s)", self.nutation, "power (1/s)", "e-fold"
        )?;
        for interval in &self.dissipation {
            let [from, to] = interval.interval.map(|t| significant(t, 6));
            let wobble = interval
                .wobble
                .map_or_else(String::new, |angle| format!("{}°", significant(angle.to_degrees(), DIGITS)));
            let power = interval.relative_power.map_or_else(String::new, |power| significant(power, 3));
            let fold = match interval.time_constant {
                Some(constant) if constant < 0.0 => format!("GROWS {}", time(-constant)),
                Some(constant) => time(constant),
                None => "-".to_owned(),
            };
            let worst = if self.worst_interval == Some(interval.interval) { "  fastest" } else { "" };
            writeln!(out, "  {from:>12} {to:>12} {wobble:>10} {power:>14} {fold:>14}{worst}")?;
        }
        Ok(())
    }
}

struct UnitWords<'a> {
    rates: &'a str,
    times: &'a str,
}

impl<'a> UnitWords<'a> {
    fn of(audit: &'a Audit) -> Self {
        Self { rates: &audit.units.rates, times: &audit.units.times }
    }
}
