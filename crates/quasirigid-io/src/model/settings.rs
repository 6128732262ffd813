use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

pub(super) const BODY: Keys = Keys { known: &["name"], later: &[] };
pub(super) const INITIAL: Keys =
    Keys { known: &["angular_velocity", "attitude", "displacements"], later: &[] };
pub(super) const RUN: Keys = Keys {
    known: &["order", "duration", "tolerance", "samples", "form"],
    later: &[("evolve", "evolve"), ("verify", "verify")],
};

/// Order of the reduced equations unless the file chooses another.
const ORDER: usize = 3;
const HIGHEST_ORDER: usize = 12;
const MOST_SAMPLES: usize = 10_000_000;
/// Largest deviation of a quaternion's norm from one that is taken for rounding.
const ROUNDED_NORM: f64 = 1e-3;
/// Largest deviation that is not worth a note.
const PRINTED_NORM: f64 = 1e-9;

/// State of the body at time zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Initial {
    /// Angular velocity (rad/s), body axes; none if the file gives none.
    pub angular_velocity: Option<[f64; 3]>,
    /// Unit quaternion, scalar first, that turns body components into inertial ones.
    pub attitude: [f64; 4],
}

impl Default for Initial {
    fn default() -> Self {
        Self { angular_velocity: None, attitude: [1.0, 0.0, 0.0, 0.0] }
    }
}

/// What to compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Order of the reduced equations, from 1 to 12.
    pub order: usize,
    /// Length of the spin history (s).
    pub duration: Option<f64>,
    /// Relative tolerance of the integrator.
    pub tolerance: Option<f64>,
    /// Number of rows of the spin history.
    pub samples: Option<usize>,
    /// Form of the reduced equations.
    pub form: Option<Form>,
}

impl Default for Run {
    fn default() -> Self {
        Self { order: ORDER, duration: None, tolerance: None, samples: None, form: None }
    }
}

/// Form in which the reduced equations are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// For the angular momentum, which keeps its length without torque.
    Momentum,
    /// For the angular velocity, as the paper writes them.
    Paper,
}

/// Reads `[initial]`; what is merely suspect goes into `notes`.
pub(super) fn initial(table: &Table<'_>, notes: &mut Vec<String>) -> Option<Initial> {
    let angular_velocity =
        optional(table.get("angular_velocity"), |value| value.vector(Dimension::ANGULAR_VELOCITY));
    let attitude = match table.get("attitude") {
        Some(value) => unit_quaternion(&value, notes),
        None => Some(Initial::default().attitude),
    };
    let displacements = table.get("displacements").is_none_or(|value| slow_manifold(&value).is_some());
    let initial = Initial { angular_velocity: angular_velocity?, attitude: attitude? };
    displacements.then_some(initial)
}

/// Reads `[run]`.
pub(super) fn run(table: &Table<'_>) -> Option<Run> {
    let order = optional(table.get("order"), |value| value.integer(1..=HIGHEST_ORDER));
    let duration = optional(table.get("duration"), |value| value.positive(Dimension::TIME));
    let tolerance = optional(table.get("tolerance"), |value| tolerance(&value));
    let samples = optional(table.get("samples"), |value| value.integer(2..=MOST_SAMPLES));
    let form = optional(table.get("form"), |value| form(&value));
    Some(Run {
        order: order?.unwrap_or(ORDER),
        duration: duration?,
        tolerance: tolerance?,
        samples: samples?,
        form: form?,
    })
}

/// Reads a value that may be absent: nothing only if it is there and wrong.
fn optional<'a, T>(value: Option<Value<'a>>, read: impl FnOnce(Value<'a>) -> Option<T>) -> Option<Option<T>> {
    match value {
        Some(value) => read(value).map(Some),
        None => Some(None),
    }
}

fn unit_quaternion(value: &Value<'_>, notes: &mut Vec<String>) -> Option<[f64; 4]> {
    let quaternion: [f64; 4] = value.numbers(Dimension::NUMBER)?;
    let norm = quaternion.iter().fold(0.0, |norm: f64, component| norm.hypot(*component));
    let deviation = (norm - 1.0).abs();
    if deviation > ROUNDED_NORM {
        let message = format!("`attitude` has the norm {norm}, but an attitude is a unit quaternion");
        let help = "write four numbers, scalar first, whose squares add up to 1".to_owned();
        return value.refuse(message, "not a unit quaternion", Some(help));
    }
    if deviation > PRINTED_NORM {
        notes.push(format!("the initial attitude has the norm {norm}; it was divided by it"));
    }
    Some(quaternion.map(|component| component / norm))
}

fn slow_manifold(value: &Value<'_>) -> Option<()> {
    if value.is_array() {
        let message = "`displacements` as numbers are not supported by this version of quasirigid".to_owned();
        return value.refuse(message, "not supported yet", Some("write \"slow-manifold\"".to_owned()));
    }
    value.choice(&[("slow-manifold", Some(())), ("rest", None)])
}

fn tolerance(value: &Value<'_>) -> Option<f64> {
    let tolerance = value.quantity(Dimension::NUMBER)?;
    if tolerance > 1e-15 && tolerance < 1e-2 {
        return Some(tolerance);
    }
    let message = format!("`tolerance` is {tolerance:e}, but must lie between 1e-15 and 1e-2");
    value.refuse(message, "out of range", Some("write for example tolerance = 1e-9".to_owned()))
}

fn form(value: &Value<'_>) -> Option<Form> {
    value.choice(&[("momentum", Some(Form::Momentum)), ("paper", Some(Form::Paper))])
}
