//! Plans of measurements in words and for a terminal of 80 columns.

use std::fmt::{self, Write};

use super::{AS_IT_STANDS, Design, Plan};
use crate::layout::paragraph;
use crate::words::significant;

/// Plans that are listed.
const LISTED: usize = 12;
/// Columns of the names.
const NAMES: usize = 48;
/// Ratio of deviations below which a sensor is dispensable.
const IDLE: f64 = 1.05;

impl Design {
    /// What would tell most, in a few sentences.
    pub(super) fn told(&self) -> String {
        let Some(best) = self.plans.iter().find(|plan| plan.complete && plan.worst.is_some()) else {
            return "No plan tells every key: add a sensor, a manoeuvre or a prior.".to_owned();
        };
        let mut parts = vec![format!(
            "Most would be told {}: {}.",
            in_motion(best),
            self.worst_of(best).unwrap_or_default()
        )];
        let beside = |plan: &&Plan| plan.manoeuvre == best.manoeuvre && !plan.complete;
        if let Some(alone) = self.plans.iter().filter(beside).find(|plan| plan.sensors.len() == 1) {
            parts.push(match self.worst_of(alone) {
                Some(worst) => format!("Of the sensors {} alone would tell most: {worst}.", alone.sensors[0]),
                None => "No sensor alone tells every key.".to_owned(),
            });
        }
        let all = best.sensors.len();
        let without = self.plans.iter().filter(beside).filter(|plan| plan.sensors.len() + 1 == all);
        let idle = without.filter(|_| all > 1).find_map(|plan| {
            let dispensable = plan.worst? < IDLE * best.worst?;
            let out = best.sensors.iter().find(|sensor| !plan.sensors.contains(sensor))?;
            dispensable.then(|| format!("{out} adds next to nothing there."))
        });
        parts.extend(idle);
        let file = self.plans.iter().find(|plan| plan.complete && plan.manoeuvre == AS_IT_STANDS);
        let file = file.filter(|_| best.manoeuvre != AS_IT_STANDS);
        if let Some((Some(file), Some(own))) = file.map(|plan| (plan.worst, best.worst)) {
            let ratio = significant(file / own, 2);
            parts.push(format!("The motion of the file would leave {ratio} times as large a deviation."));
        }
        parts.join(" ")
    }

    /// The key that a plan tells worst, with its deviation; none where a key is not told.
    fn worst_of(&self, plan: &Plan) -> Option<String> {
        plan.worst?;
        let each = self.keys.iter().zip(&plan.sigma);
        let sized = each.filter_map(|(key, sigma)| Some((key, (*sigma)?)));
        let relative = |(key, sigma): &(&super::DesignKey, f64)| {
            if key.value == 0.0 { f64::INFINITY } else { sigma / key.value.abs() }
        };
        let (key, sigma) = sized.max_by(|a, b| relative(a).total_cmp(&relative(b)))?;
        let unit = if key.unit.is_empty() { String::new() } else { format!(" {}", key.unit) };
        let share = relative(&(key, sigma));
        let share =
            if share.is_finite() { format!(" ({} %)", significant(100.0 * share, 2)) } else { String::new() };
        let at_worst = if self.keys.len() > 1 { " at worst" } else { "" };
        Some(format!("{} to {}{unit}{share}{at_worst}", key.key, significant(sigma, 3)))
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
        writeln!(out, "\n  sigma in % of the key, the worst; then of each key")?;
        for plan in self.plans.iter().take(LISTED) {
            let worst = plan.worst.map_or_else(
                || "NOT KNOWN".to_owned(),
                |worst| format!("{} %", significant(100.0 * worst, 2)),
            );
            let sensors = plan.sensors.join(" + ");
            let name = format!("{}: {sensors}", plan.manoeuvre);
            writeln!(
                out,
                "{}",
                paragraph(&format!("{worst:>10}  {name:<NAMES$}"), "  ", "              ").trim_end()
            )?;
            let each = self.keys.iter().zip(&plan.sigma).map(|(key, sigma)| {
                let sigma = sigma.map_or_else(|| "NOT KNOWN".to_owned(), |sigma| significant(sigma, 3));
                format!("{} {sigma} {}", key.key, key.unit).trim_end().to_owned()
            });
            let each = each.collect::<Vec<_>>().join(", ");
            writeln!(out, "{}", paragraph(&each, "              ", "              "))?;
        }
        if self.plans.len() > LISTED {
            writeln!(out, "  and {} more (--json lists them)", self.plans.len() - LISTED)?;
        }
        for none in &self.not_answered {
            let line = format!("NOT ANSWERED {}: {}", none.manoeuvre, none.reason);
            writeln!(out, "\n{}", paragraph(&line, "  ", "    "))?;
        }
        Ok(())
    }
}

fn in_motion(plan: &Plan) -> String {
    if plan.manoeuvre == AS_IT_STANDS {
        "by the motion of the file with all sensors".to_owned()
    } else {
        format!("by the motion of {:?} with all sensors", plan.manoeuvre)
    }
}
