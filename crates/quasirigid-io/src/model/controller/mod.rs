//! Controller reader: `[[controller]]`, one function for each of five laws.
//! Whether what they name exists is checked on the body; here keys, units and names of channels are.
//! Equations (Y1) to (Y5) and (Y7) to (Y9) and (Y12), docs/theory/20-control.md.

mod b_dot;
mod formulas;
mod on_error;
mod state_space;

use std::path::Path;

use quasirigid_body::control::{Actuator, ControlLaw, Controller, Input, Output, Sampling};
use quasirigid_elements::{ElementKind, NamedController};

use self::b_dot::b_dot;
use self::formulas::formulas;
use self::on_error::{bang_bang, pid};
use self::state_space::state_space;
use crate::model::channel::{Measured, actuator};
use crate::model::key::{
    BOOLEAN, COUNT, Form, KIND, Keys, Shape, TEXT, any, key, list, named, of, pick, quantity,
};
use crate::model::kinds::{Kind, kind, of_table, opened, variants};
use crate::model::names::Part;
use crate::model::reader::{Keyed, NAME, Naming, Reader};
use crate::model::table::Table;
use crate::model::value::Value;
use crate::units::Dimension;

/// Reader of a law from its table, the period of its samples, and the folder of the model file.
type Read = fn(&Table<'_>, Option<f64>, &Path) -> Option<Draft>;

/// Measurement, the name that `quantum` and `noise` know it by, and its reference.
type NamedInput = (Measured, String, f64);

/// Law with its channels, as far as its kind determines them.
struct Draft {
    inputs: Vec<NamedInput>,
    deadbands: Vec<f64>,
    law: ControlLaw,
    outputs: Vec<Actuator<String>>,
    start: Vec<f64>,
}

static KINDS: [Kind<Read>; 5] = [
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
            "matrices",
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
            "moment",
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
    kind!(
        "[[controller]]",
        "bang-bang",
        [
            "kind",
            "name",
            "on",
            "target",
            "level",
            "lead",
            "deadband",
            "hysteresis",
            "minimum_on",
            "outputs",
            "period",
            "delay",
            "quantum",
            "noise",
            "seed"
        ],
        "pairs of thrusters, on or off (Y7)",
        bang_bang
    ),
    kind!(
        "[[controller]]",
        "b-dot",
        ["kind", "name", "gain", "saturation", "bang_bang", "period", "delay", "quantum", "noise", "seed"],
        "coils against the rate of the field (Y9)",
        b_dot
    ),
];

const NUMBERS: Form = any(&[Shape::Number, Shape::Vector]);
const ROWS: Form = list(&Shape::List(&Shape::Number)).or("none");

/// Keys of a controller without a kind: those of every kind.
const ANY: Keys = Keys {
    known: &[
        key("kind", KIND, ""),
        NAME,
        key("on", TEXT.or("`\"attitude\"`"), "`\"attitude\"`, `\"orbit\"`, `\"rate\"`, or one channel"),
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
        key(
            "deadband",
            NUMBERS.or("0"),
            "half the width of the dead zone of the error; of thrusters the error beyond which they fire",
        ),
        key("level", NUMBERS.in_unit("N m"), "torque of a pair of thrusters"),
        key("lead", quantity("s").or("0"), "they switch by the error and this times its rate"),
        key("hysteresis", NUMBERS.or("0"), "from firing to not, below the deadband"),
        key("minimum_on", quantity("s").or("a `period`"), "of a pulse, in whole periods"),
        key(
            "inputs",
            any(&[Shape::List(&Shape::Text), Shape::Named(&Shape::Text)]),
            "channels; of formulas with names of yours",
        ),
        key(
            "outputs",
            list(&Shape::Text).or("`torque.x` to `z`"),
            "`torque.x`, `wheel.NAME.torque`, `moment.x`",
        ),
        key(
            "matrices",
            TEXT.or("none"),
            "file beside the model with the matrices A, B, C and D: .mat or .npz",
        ),
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
            "moment",
            of(Shape::Array(3, &Shape::Formula)).in_unit("A m²"),
            "dipole moment of coils on the carrier",
        ),
        key("gain", NUMBERS.in_unit("A m² s/T"), "k, moment per rate of the field"),
        key("bang_bang", BOOLEAN.or("false"), "moments of the size `saturation`, by the sign alone; sampled"),
        key(
            "saturation",
            any(&[Shape::Number, Shape::List(&Shape::Number)]).in_unit("N m, A m²").or("none"),
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
        other: |_| None,
    },
    kind: Some(ElementKind::Controller),
    naming: Naming::Apart("controller"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let folder = draft.sources.folder;
        draft.assembly.controllers.push(controller(entry.table, entry.name, folder)?);
        Some(())
    },
};

fn controller(table: &Table<'_>, name: &str, folder: &Path) -> Option<NamedController> {
    let sampling = sampling(table);
    let period = table.get("period").and_then(|value| value.positive(Dimension::TIME));
    let draft = (of_table(table, "kind", &KINDS)?.read)(table, period, folder);
    let (sampling, Draft { inputs, deadbands, law, outputs, start }) = (sampling?, draft?);
    let labels: Vec<&str> = inputs.iter().map(|(_, label, _)| label.as_str()).collect();
    let [quantum, noise] = ["quantum", "noise"].map(|key| by_label(table, key, &labels));
    let limits = limits(table, &outputs)?;
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

fn limits(table: &Table<'_>, outputs: &[Actuator<String>]) -> Option<Vec<Option<f64>>> {
    let Some(value) = table.get("saturation") else { return Some(vec![None; outputs.len()]) };
    let sizes: Vec<Dimension> = outputs.iter().map(size_of).collect();
    let Some(items) = value.items() else {
        let Some(size) = sizes.first().filter(|first| sizes.iter().all(|size| size == *first)) else {
            let message = "the outputs are torques and moments, and one limit is given";
            return value.refuse(message, "of which?", "write a limit for each output, in their order");
        };
        return value.positive(*size).map(|limit| vec![Some(limit); outputs.len()]);
    };
    if items.len() != outputs.len() {
        return counted(&value, items.len(), outputs.len());
    }
    items.iter().zip(sizes).map(|(item, size)| item.positive(size).map(Some)).collect()
}

/// Dimension of the commands of an actuator.
fn size_of(output: &Actuator<String>) -> Dimension {
    match output {
        Actuator::Torque { .. } | Actuator::Wheel { .. } => Dimension::TORQUE,
        Actuator::Moment { .. } => Dimension::MAGNETIC_MOMENT,
    }
}

fn counted<T>(value: &Value<'_>, found: usize, wanted: usize) -> Option<T> {
    let message = format!("`{}` has {found} entries for {wanted} of the controller", value.key());
    value.refuse(message, "another number", format!("write {wanted}"))
}

/// A number for each axis: one for all, or a list.
fn numbers(table: &Table<'_>, key: &'static str, count: usize, dimension: Dimension) -> Option<Vec<f64>> {
    let Some(value) = table.get(key) else { return Some(vec![0.0; count]) };
    if !value.is_array() {
        return value.quantity(dimension).map(|number| vec![number; count]);
    }
    let given = value.list("a number for each axis", |item| item.quantity(dimension))?;
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
