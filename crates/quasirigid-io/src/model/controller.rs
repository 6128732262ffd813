//! Controller reader: `[[controller]]`, one function for each of three laws.
//! Whether what they name exists is checked on the body; here keys, units and names of channels are.
//! Equations (Y1) to (Y5), docs/theory/20-control.md.

use quasirigid_body::control::{
    Actuator, ControlLaw, Controller, FormulaLaw, Input, LinearLaw, Measurement, Output, Pid, Sampling,
};
use quasirigid_elements::{ElementKind, NamedController};
use quasirigid_math::expression::Expression;

use super::channel::{Measured, actuator, attitude, measurement, rates};
use super::key::{COUNT, Form, KIND, Keys, Shape, TEXT, any, key, list, named, of, pick, quantity};
use super::kinds::{Kind, kind, of_table, opened, variants};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

type Read = fn(&Table<'_>, Option<f64>) -> Option<Draft>;

/// Law with its channels, as far as its kind determines them.
struct Draft {
    /// Measurements with the names that `quantum` and `noise` know them by, and references.
    inputs: Vec<(Measured, String, f64)>,
    deadbands: Vec<f64>,
    law: ControlLaw,
    outputs: Vec<Actuator<String>>,
    start: Vec<f64>,
}

static KINDS: [Kind<Read>; 3] = [
    kind!(
        "[[controller]]",
        "pid",
        [
            "kind",
            "name",
            "on",
            "target",
            "proportional",
            "integral",
            "derivative",
            "filter",
            "anti_windup",
            "deadband",
            "outputs",
            "saturation",
            "period",
            "delay",
            "quantum",
            "noise",
            "seed"
        ],
        "proportional, integral, derivative (Y5)",
        pid
    ),
    kind!(
        "[[controller]]",
        "state-space",
        [
            "kind",
            "name",
            "inputs",
            "target",
            "outputs",
            "A",
            "B",
            "C",
            "D",
            "saturation",
            "period",
            "delay",
            "quantum",
            "noise",
            "seed"
        ],
        "ż = A z + B u, v = C z + D u; with a `period` the next z (Y1)",
        state_space
    ),
    kind!(
        "[[controller]]",
        "formula",
        [
            "kind",
            "name",
            "inputs",
            "target",
            "states",
            "next",
            "start",
            "torque",
            "motors",
            "saturation",
            "period",
            "delay",
            "quantum",
            "noise",
            "seed"
        ],
        "formulas with states (Y1)",
        formulas
    ),
];

const NUMBERS: Form = any(&[Shape::Number, Shape::Vector]);
const ROWS: Form = list(&Shape::List(&Shape::Number)).or("none");

/// Keys of a controller without a kind: those of every kind.
const ANY: Keys = Keys {
    known: &[
        key("kind", KIND, ""),
        NAME,
        key("on", TEXT.or("`\"attitude\"`"), "`\"attitude\"`, `\"rate\"`, or one channel"),
        key(
            "target",
            any(&[Shape::Quaternion, Shape::Vector, Shape::Number]).or("`[1, 0, 0, 0]`, or 0"),
            "attitude, rate (rad/s) or value that counts as zero",
        ),
        key("proportional", NUMBERS.or("0"), "kP, torque per error; SI units, for every axis or three"),
        key("integral", NUMBERS.or("0"), "kI, torque per integral of the error"),
        key(
            "derivative",
            NUMBERS.or("0"),
            "kD, torque per rate of the error, for an attitude the angular velocity",
        ),
        key("filter", quantity("s").or("none"), "time constant of the derivative"),
        key("anti_windup", quantity("s").or("none"), "in which saturation takes the integral back"),
        key("deadband", NUMBERS.or("0"), "half the width of the dead zone of the error"),
        key(
            "inputs",
            any(&[Shape::List(&Shape::Text), Shape::Named(&Shape::Text)]),
            "channels; of formulas with names of yours",
        ),
        key("outputs", list(&Shape::Text).or("`torque.x` to `z`"), "`torque.x`, `wheel.NAME.torque`"),
        key("A", ROWS, ""),
        key("B", ROWS, ""),
        key("C", ROWS, ""),
        key("D", list(&Shape::List(&Shape::Number)).or("zero"), ""),
        key("states", named(&Shape::Formula).or("none"), "rate of each state"),
        key("next", named(&Shape::Formula).or("none"), "instead, with a `period`: next value of each state"),
        key("start", named(&Shape::Number).or("0"), "of states"),
        key("torque", of(Shape::Array(3, &Shape::Formula)).in_unit("N m"), "on the carrier"),
        key("motors", named(&Shape::Formula).in_unit("N m"), "torque on each [[wheel]], by its name"),
        key(
            "saturation",
            any(&[Shape::Number, Shape::List(&Shape::Number)]).in_unit("N m").or("none"),
            "limit of every output, or of each",
        ),
        key("period", quantity("s").or("continuous"), "of the samples (Y3)"),
        key("delay", quantity("s").or("0"), "from sample to command"),
        key("quantum", named(&Shape::Number).or("0"), "rounding of a channel, SI units; sampled"),
        key("noise", named(&Shape::Number).or("0"), "standard deviation of a channel; sampled"),
        key("seed", COUNT.or("0"), "of the noise"),
    ],
};

pub(super) const READER: Reader = Reader {
    key: "controller",
    title: "[[controller]]",
    meaning: "controller of the attitude",
    keys: Keyed::ByKind {
        any: &ANY,
        kinds: || variants(&KINDS),
        open: |value| Some(opened(value, "[[controller]]", "kind", &ANY, &KINDS)?.0),
    },
    kind: Some(ElementKind::Controller),
    naming: Naming::Apart("controller"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.controllers.push(controller(entry.table, entry.name)?);
        Some(())
    },
};

fn controller(table: &Table<'_>, name: &str) -> Option<NamedController> {
    let sampling = sampling(table);
    let period = table.get("period").and_then(|value| value.positive(Dimension::TIME));
    let draft = (of_table(table, "kind", &KINDS)?.read)(table, period);
    let (sampling, Draft { inputs, deadbands, law, outputs, start }) = (sampling?, draft?);
    let labels: Vec<&str> = inputs.iter().map(|(_, label, _)| label.as_str()).collect();
    let [quantum, noise] = ["quantum", "noise"].map(|key| by_label(table, key, &labels));
    let limits = limits(table, outputs.len())?;
    let errors = quantum?.into_iter().zip(noise?).zip(deadbands);
    let input = |((of, _, reference), ((quantum, noise), deadband))| Input {
        of,
        reference,
        deadband,
        quantum,
        noise,
    };
    Some(Controller {
        name: name.to_owned(),
        inputs: inputs.into_iter().zip(errors).map(input).collect(),
        law,
        outputs: outputs.into_iter().zip(limits).map(|(to, limit)| Output { to, limit }).collect(),
        start,
        sampling,
    })
}

fn sampling(table: &Table<'_>) -> Option<Option<Sampling>> {
    let delay = table.read_or("delay", 0.0, |value| value.non_negative(Dimension::TIME));
    let seed = table.read_or("seed", 0, |value| value.integer(0..=usize::MAX));
    let Some(period) = table.get("period") else {
        for key in ["delay", "seed", "next"] {
            if let Some(value) = table.get(key) {
                let message = format!("`{key}` needs samples, and this controller is continuous");
                return value.refuse(message, "without a period", "add for example period = \"0.1 s\"");
            }
        }
        return Some(None);
    };
    let period = period.positive(Dimension::TIME);
    Some(Some(Sampling { period: period?, delay: delay?, seed: seed? as u64 }))
}

/// Values by the names of the inputs; zero where none is given.
fn by_label(table: &Table<'_>, key: &'static str, labels: &[&str]) -> Option<Vec<f64>> {
    let mut values = vec![0.0; labels.len()];
    for (name, value) in entries(table, key, "{ rate = 1e-5 }")? {
        let number = value.non_negative(Dimension::NUMBER)?;
        let mut known = false;
        for (label, own) in labels.iter().zip(&mut values).filter(|(label, _)| **label == name) {
            (*own, known) = (number, !label.is_empty());
        }
        if !known {
            let mut names = labels.to_vec();
            names.dedup();
            let help = format!("the controller measures {}", names.join(", "));
            return value.refuse(
                format!("`{key}`: the controller does not measure {name:?}"),
                "unknown",
                help,
            );
        }
    }
    Some(values)
}

fn limits(table: &Table<'_>, outputs: usize) -> Option<Vec<Option<f64>>> {
    let Some(value) = table.get("saturation") else { return Some(vec![None; outputs]) };
    if !value.is_array() {
        return value.positive(Dimension::TORQUE).map(|limit| vec![Some(limit); outputs]);
    }
    let limits = value.list("a limit for each output", |item| item.positive(Dimension::TORQUE).map(Some))?;
    if limits.len() == outputs { Some(limits) } else { counted(&value, limits.len(), outputs) }
}

fn counted<T>(value: &Value<'_>, found: usize, wanted: usize) -> Option<T> {
    let message = format!("`{}` has {found} entries for {wanted} of the controller", value.key());
    value.refuse(message, "another number", format!("write {wanted}"))
}

/// A number for each axis: one for all, or a list.
fn numbers(table: &Table<'_>, key: &'static str, count: usize) -> Option<Vec<f64>> {
    let Some(value) = table.get(key) else { return Some(vec![0.0; count]) };
    if !value.is_array() {
        return value.quantity(Dimension::NUMBER).map(|number| vec![number; count]);
    }
    let given = value.list("a number for each axis", |item| item.quantity(Dimension::NUMBER))?;
    if given.len() == count { Some(given) } else { counted(&value, given.len(), count) }
}

/// Entries of a table with names of the user's, in the order of the file; none without the key.
fn entries<'a>(table: &Table<'a>, key: &'static str, example: &str) -> Option<Vec<(String, Value<'a>)>> {
    let Some(value) = table.get(key) else { return Some(Vec::new()) };
    let Some(entries) = value.entries() else {
        return value.mismatch("a table", &format!("write {key} = {example}"));
    };
    let mut entries: Vec<_> = entries.collect();
    entries.sort_by_key(|(span, _)| span.start);
    Some(entries.into_iter().map(|(_, value)| (value.key().to_owned(), value)).collect())
}

fn quaternion(table: &Table<'_>) -> Option<[f64; 4]> {
    table.read_or("target", [1.0, 0.0, 0.0, 0.0], |value| value.numbers::<4>(Dimension::NUMBER))
}

fn outputs(table: &Table<'_>, wanted: Option<usize>) -> Option<Vec<Actuator<String>>> {
    let Some(value) = table.get("outputs") else {
        return match wanted {
            Some(1) => table.required("outputs", "outputs = [\"torque.y\"]").and(None),
            _ => Some([0, 1, 2].map(|axis| Actuator::Torque { axis }).to_vec()),
        };
    };
    let outputs = value.list("a list of channels", |item| actuator(&item))?;
    match wanted {
        Some(wanted) if outputs.len() != wanted => counted(&value, outputs.len(), wanted),
        _ => Some(outputs),
    }
}

fn pid(table: &Table<'_>, period: Option<f64>) -> Option<Draft> {
    let on = table.get("on");
    let word = match &on {
        Some(value) => value.text()?,
        None => "attitude",
    };
    let mut inputs: Vec<(Measured, String, f64)> = match (word, &on) {
        ("attitude", _) => attitude(quaternion(table)?).map(|of| (of, word.to_owned(), 0.0)).to_vec(),
        ("rate", _) => {
            let target = table.vector_or_zero("target", Dimension::ANGULAR_VELOCITY)?;
            rates().into_iter().zip(target).map(|(of, target)| (of, word.to_owned(), target)).collect()
        }
        (_, Some(value)) => {
            let target = table.read_or("target", 0.0, |value| value.quantity(Dimension::NUMBER))?;
            vec![(measurement(value, [1.0, 0.0, 0.0, 0.0])?, word.to_owned(), target)]
        }
        (_, None) => return None,
    };
    let n = inputs.len();
    let [proportional, integral, derivative, deadband] =
        ["proportional", "integral", "derivative", "deadband"].map(|key| numbers(table, key, n));
    let time = |key| table.read_or(key, None, |value| value.positive(Dimension::TIME).map(Some));
    let (filter, anti_windup) = (time("filter")?, time("anti_windup")?);
    let (derivative, outputs) = (derivative?, outputs(table, Some(n))?);
    let derives = derivative.iter().any(|gain| *gain != 0.0);
    let has_rates = word == "attitude" && derives;
    if derives && !has_rates && filter.is_none() {
        let message =
            "the derivative of this error is not measured, and a derivative without a filter has no bounds";
        let help = "add for example filter = \"0.05 s\"";
        return table.get("derivative")?.refuse(message, "needs a filter", help);
    }
    let mut deadbands = deadband?;
    if has_rates {
        inputs.extend(rates().map(|of| (of, "rate".to_owned(), 0.0)));
        deadbands.resize(2 * n, 0.0);
    }
    let sign = |output: &Actuator<String>| if matches!(output, Actuator::Wheel { .. }) { -1.0 } else { 1.0 };
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

fn state_space(table: &Table<'_>, _: Option<f64>) -> Option<Draft> {
    let target = quaternion(table)?;
    let channels = table.required("inputs", "inputs = [\"attitude.x\", \"rate.x\"]")?;
    let inputs = channels.list("a list of channels", |item| {
        Some((measurement(&item, target)?, item.text()?.to_owned(), 0.0))
    })?;
    let outputs = outputs(table, None)?;
    let rows = |key: &'static str| {
        let row = |row: Value<'_>| row.list("a row of numbers", |item| item.quantity(Dimension::NUMBER));
        table.read_or(key, Vec::new(), |value| value.list("a list of rows", row))
    };
    let (A, B, C, D) = (rows("A"), rows("B"), rows("C"), rows("D"));
    let (A, B, mut C, mut D) = (A?, B?, C?, D?);
    if A.is_empty() && C.is_empty() {
        C = vec![Vec::new(); outputs.len()];
    }
    if D.is_empty() {
        D = vec![vec![0.0; inputs.len()]; outputs.len()];
    }
    let start = vec![0.0; A.len()];
    let law = ControlLaw::Linear(LinearLaw { E: vec![Vec::new(); A.len()], A, B, C, D });
    Some(Draft { deadbands: vec![0.0; inputs.len()], inputs, law, outputs, start })
}

/// Names that every formula of a controller has.
const GIVEN: [&str; 11] = ["t", "wx", "wy", "wz", "qw", "qx", "qy", "qz", "ex", "ey", "ez"];

fn formulas(table: &Table<'_>, period: Option<f64>) -> Option<Draft> {
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

/// Outputs of formulas: a torque on the carrier, torques of motors, or both.
fn commanded(
    table: &Table<'_>,
    read: &dyn Fn(&Value<'_>) -> Option<Expression>,
) -> Option<(Vec<Actuator<String>>, Vec<Expression>)> {
    let (mut outputs, mut law) = (Vec::new(), Vec::new());
    let motors = entries(table, "motors", "{ wheel = \"0.1*ex\" }")?;
    let torque = if motors.is_empty() {
        Some(table.required("torque", "torque = [\"-2*ex - 5*wx\", \"0\", \"0\"]")?)
    } else {
        table.get("torque")
    };
    if let Some(torque) = torque {
        outputs.extend([0, 1, 2].map(|axis| Actuator::Torque { axis }));
        law.extend(torque.array::<_, 3>("formulas", |item| read(&item))?);
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
