//! Laws on an error: PID and bang-bang. (Y5), (Y7)

use std::path::Path;

use quasirigid_body::control::{Actuator, ControlLaw, Pid, RelayLaw};

use super::{Draft, NamedInput, numbers, outputs, quaternion};
use crate::model::channel::{Measured, attitude, measurement, orbit_attitude, orbit_rates, rates};
use crate::model::table::Table;
use crate::units::Dimension;

/// Errors of a law, axis by axis, and the rates of attitudes.
struct Errors {
    inputs: Vec<NamedInput>,
    rates: Vec<NamedInput>,
}

/// Errors of a law on an attitude, to a target or to the orbit, on a rate, or on one channel.
fn errors(table: &Table<'_>) -> Option<Errors> {
    let on = table.get("on");
    let word = match &on {
        Some(value) => value.text()?,
        None => "attitude",
    };
    let labelled = |all: [Measured; 3], label: &str| all.map(|of| (of, label.to_owned(), 0.0)).to_vec();
    let (inputs, rates) = match (word, &on) {
        ("attitude", _) => (labelled(attitude(quaternion(table)?), word), labelled(rates(), "rate")),
        ("orbit", _) => {
            if let Some(target) = table.get("target") {
                let message = "the orbital frame is the target of this law";
                return target.refuse(
                    message,
                    "no target beside it",
                    "leave it out, or write a law by formulas",
                );
            }
            (labelled(orbit_attitude(), word), labelled(orbit_rates(), "orbit_rate"))
        }
        ("rate", _) => {
            let target = table.vector_or_zero("target", Dimension::ANGULAR_VELOCITY)?;
            let named = rates().into_iter().zip(target).map(|(of, target)| (of, word.to_owned(), target));
            (named.collect(), Vec::new())
        }
        (_, Some(value)) => {
            let target = table.read_or("target", 0.0, |value| value.quantity(Dimension::NUMBER))?;
            (vec![(measurement(value, [1.0, 0.0, 0.0, 0.0])?, word.to_owned(), target)], Vec::new())
        }
        (_, None) => return None,
    };
    Some(Errors { inputs, rates })
}

pub(super) fn pid(table: &Table<'_>, period: Option<f64>, _: &Path) -> Option<Draft> {
    let Errors { mut inputs, rates } = errors(table)?;
    let n = inputs.len();
    let [proportional, integral, derivative, deadband] =
        ["proportional", "integral", "derivative", "deadband"]
            .map(|key| numbers(table, key, n, Dimension::NUMBER));
    let time = |key| table.read_or(key, None, |value| value.positive(Dimension::TIME).map(Some));
    let (filter, anti_windup) = (time("filter")?, time("anti_windup")?);
    let (derivative, outputs) = (derivative?, outputs(table, Some(n))?);
    let derives = derivative.iter().any(|gain| *gain != 0.0);
    let has_rates = derives && !rates.is_empty();
    if derives && !has_rates && filter.is_none() {
        let message =
            "the derivative of this error is not measured, and a derivative without a filter has no bounds";
        let help = "add for example filter = \"0.05 s\"";
        return table.get("derivative")?.refuse(message, "needs a filter", help);
    }
    let mut deadbands = deadband?;
    if has_rates {
        inputs.extend(rates);
        deadbands.resize(2 * n, 0.0);
    }
    let signs = outputs.iter().map(sign).collect();
    let filter = filter.filter(|_| derives);
    let pid = Pid {
        proportional: proportional?,
        integral: integral?,
        derivative,
        signs,
        has_rates,
        filter,
        anti_windup,
    };
    let law = pid.law(period);
    let start = vec![0.0; law.A.len()];
    Some(Draft { inputs, deadbands, law: ControlLaw::Linear(law), outputs, start })
}

pub(super) fn bang_bang(table: &Table<'_>, period: Option<f64>, _: &Path) -> Option<Draft> {
    let period = match period {
        Some(period) => period,
        None => return table.required("period", "period = \"0.1 s\"").and(None),
    };
    let Errors { mut inputs, rates } = errors(table)?;
    let n = inputs.len();
    let outputs = outputs(table, Some(n))?;
    table.required("level", "level = \"0.5 N m\"")?;
    let levels = numbers(table, "level", n, Dimension::TORQUE);
    let [on, hysteresis] = ["deadband", "hysteresis"].map(|key| numbers(table, key, n, Dimension::NUMBER));
    let (levels, on, hysteresis) = (levels?, on?, hysteresis?);
    let lead = table.read_or("lead", 0.0, |value| value.non_negative(Dimension::TIME))?;
    let least = table.read_or("minimum_on", period, |value| value.positive(Dimension::TIME))?;
    if !rates.is_empty() {
        inputs.extend(rates);
    } else if lead > 0.0 {
        let message = "the rate of this error is not measured";
        return table.get("lead")?.refuse(
            message,
            "no rate",
            "leave the lead out, or measure on = \"attitude\" or \"orbit\"",
        );
    } else {
        inputs.extend(inputs.clone());
    }
    if let Some(value) = table.get("hysteresis").filter(|_| on.iter().zip(&hysteresis).any(|(on, h)| h > on))
    {
        let message = "a hysteresis wider than the deadband never switches off";
        return value.refuse(message, "too wide", "make it narrower than `deadband`");
    }
    let off = on.iter().zip(&hysteresis).map(|(on, hysteresis)| on - hysteresis).collect();
    let levels = levels.iter().zip(&outputs).map(|(level, output)| level * sign(output)).collect();
    let least = ((least / period) * (1.0 - 1e-12)).ceil().clamp(1.0, f64::from(u32::MAX)) as u32;
    let law = ControlLaw::Relay(RelayLaw { levels, lead, on, off, least });
    Some(Draft { deadbands: vec![0.0; inputs.len()], start: vec![0.0; 2 * n], inputs, law, outputs })
}

/// Sign of an output that is to act on the carrier: a wheel does by its reaction.
fn sign(output: &Actuator<String>) -> f64 {
    if matches!(output, Actuator::Wheel { .. }) { -1.0 } else { 1.0 }
}
