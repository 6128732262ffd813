//! Laws by formulas. (Y1)

use std::path::Path;

use quasirigid_body::control::{Actuator, ControlLaw, FormulaLaw, Measurement};
use quasirigid_math::expression::Expression;

use super::{Draft, entries, quaternion};
use crate::model::channel::{attitude, measurement, rates};
use crate::model::table::Table;
use crate::model::value::Value;
use crate::units::Dimension;

/// Names that every formula of a controller has.
const GIVEN: [&str; 11] = ["t", "wx", "wy", "wz", "qw", "qx", "qy", "qz", "ex", "ey", "ez"];

pub(super) fn formulas(table: &Table<'_>, period: Option<f64>, _: &Path) -> Option<Draft> {
    let target = quaternion(table)?;
    let given = [Measurement::Time].into_iter().chain(rates());
    let given = given.chain([0, 1, 2, 3].map(|component| Measurement::Quaternion { component }));
    let given = given.chain(attitude(target)).zip(GIVEN).map(|(of, name)| (of, name.to_owned(), 0.0));
    let mut inputs: Vec<_> = given.collect();
    for (name, value) in entries(table, "inputs", "{ tip = \"velocity.tip.x\" }")? {
        inputs.push((measurement(&value, target)?, name, 0.0));
    }
    let key = if period.is_some() { "next" } else { "states" };
    if let Some(states) = table.get("states").filter(|_| period.is_some()) {
        let message = "a sampled controller has no rates of states, but their next values";
        return states.refuse(message, "sampled", "give them under `next`");
    }
    let states = entries(table, key, "{ z = \"ex\" }")?;
    let names: Vec<String> =
        inputs.iter().map(|(_, name, _)| name).chain(states.iter().map(|(name, _)| name)).cloned().collect();
    let read = |value: &Value<'_>| formula(value, &names);
    let law_states = states.iter().map(|(_, value)| read(value)).collect::<Option<Vec<_>>>();
    let (outputs, law_outputs) = commanded(table, &read)?;
    let mut start = vec![0.0; states.len()];
    for (name, value) in entries(table, "start", "{ z = 0.1 }")? {
        let Some(place) = states.iter().position(|(state, _)| *state == name) else {
            return value.refuse(format!("there is no state {name:?}"), "unknown", "name one of the states");
        };
        start[place] = value.quantity(Dimension::NUMBER)?;
    }
    let law = ControlLaw::Formulas(FormulaLaw { states: law_states?, outputs: law_outputs });
    Some(Draft { deadbands: vec![0.0; inputs.len()], inputs, law, outputs, start })
}

/// Outputs of formulas: a torque on the carrier, torques of motors, a moment of coils, or several.
fn commanded(
    table: &Table<'_>,
    read: &dyn Fn(&Value<'_>) -> Option<Expression>,
) -> Option<(Vec<Actuator<String>>, Vec<Expression>)> {
    let (mut outputs, mut law) = (Vec::new(), Vec::new());
    let motors = entries(table, "motors", "{ wheel = \"0.1*ex\" }")?;
    let moment = table.get("moment");
    let torque = if motors.is_empty() && moment.is_none() {
        Some(table.required("torque", "torque = [\"-2*ex - 5*wx\", \"0\", \"0\"]")?)
    } else {
        table.get("torque")
    };
    if let Some(torque) = torque {
        outputs.extend([0, 1, 2].map(|axis| Actuator::Torque { axis }));
        law.extend(torque.array::<_, 3>("formulas", |item| read(&item))?);
    }
    if let Some(moment) = moment {
        outputs.extend([0, 1, 2].map(|axis| Actuator::Moment { axis }));
        law.extend(moment.array::<_, 3>("formulas", |item| read(&item))?);
    }
    for (wheel, value) in motors {
        outputs.push(Actuator::Wheel { wheel });
        law.push(read(&value)?);
    }
    Some((outputs, law))
}

fn formula(value: &Value<'_>, names: &[String]) -> Option<Expression> {
    let variables: Vec<&str> = names.iter().map(String::as_str).collect();
    let text = match value.words() {
        Some(text) => text.to_owned(),
        None if value.is_number() => format!("{:?}", value.quantity(Dimension::NUMBER)?),
        None => return value.mismatch("a formula", "write a formula, or a number"),
    };
    match Expression::parse(&text, &variables) {
        Ok(formula) => Some(formula),
        Err(error) => {
            let help = format!("write a formula in {}", names.join(" "));
            let message = format!("`{}`: {}", value.key(), error.message);
            value.refuse_at(value.span_of(error.span), message, "in this formula", help)
        }
    }
}
