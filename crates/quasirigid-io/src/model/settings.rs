//! Run settings: `[run]` with its tables `stop`, `verify` and `evolve`.
//! Absent settings stay absent where the command line may give them; defaults are chosen in the study.

use std::f64::consts::PI;

use quasirigid_body::{Form, Method};

use super::evolve::{Evolve, evolve};
use super::manifold::{Manifold, manifold};
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;

pub(super) const BODY: Keys = Keys { known: &["name"] };
pub(super) const RUN: Keys = Keys {
    known: &[
        "order",
        "duration",
        "tolerance",
        "samples",
        "form",
        "systems",
        "method",
        "stop",
        "verify",
        "evolve",
        "manifold",
    ],
};
const STOP: Keys = Keys { known: &["energy", "nutation", "validity"] };
const VERIFY: Keys = Keys { known: &["rotations", "orders", "halvings"] };

/// Order of the reduced equations unless the file chooses another.
const ORDER: usize = 3;
const HIGHEST_ORDER: usize = 12;
pub(super) const MOST_SAMPLES: usize = 10_000_000;
/// Most halvings of the spin: the last is a thousandth of the first, and its run a thousand times as long.
const MOST_HALVINGS: usize = 10;

/// Settings of the computation.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Order of the reduced equations, from 0 to 12.
    pub order: usize,
    /// Whether the file gives the order.
    pub order_given: bool,
    /// Length of the spin history (s).
    pub duration: Option<f64>,
    /// Relative tolerance of the integrator.
    pub tolerance: Option<f64>,
    /// Number of rows of the spin history.
    pub samples: Option<usize>,
    /// Form of the reduced equations.
    pub form: Option<Form>,
    /// Systems of equations to integrate.
    pub systems: Option<Vec<System>>,
    /// Method for the full system.
    pub method: Option<Method>,
    /// Events that end a run before its time.
    pub stop: Stop,
    /// Comparison of the reduced equations with the full ones; none if the file does not ask for it.
    pub verify: Option<Verify>,
    /// Secular evolution of the rotation; none if the file does not ask for it.
    pub evolve: Option<Evolve>,
    /// Reduced equations about the steady spin; none if the file does not ask for them.
    pub manifold: Option<Manifold>,
}

impl Default for RunSettings {
    fn default() -> Self {
        Self {
            order: ORDER,
            order_given: false,
            duration: None,
            tolerance: None,
            samples: None,
            form: None,
            systems: None,
            method: None,
            stop: Stop::default(),
            verify: None,
            evolve: None,
            manifold: None,
        }
    }
}

/// A system of equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// The reduced equations.
    Reduced,
    /// The frozen body.
    Rigid,
    /// The body with all its coordinates, which is stiff.
    Full,
    /// The reduced equations about the steady spin.
    Manifold,
}

/// Events that end a run before its time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stop {
    /// Energy (J) at which a run ends.
    pub energy: Option<f64>,
    /// Nutation angle (rad) at which a run ends.
    pub nutation: Option<f64>,
    /// Whether a run ends where the reduced equations cease to hold.
    pub validity: bool,
}

/// Comparison of the reduced equations with the full ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verify {
    /// Length of each run in rotations.
    pub rotations: Option<f64>,
    /// Orders of the reduced equations.
    pub orders: Option<Vec<usize>>,
    /// Number of halvings of `ε`.
    pub halvings: Option<usize>,
}

/// Reads `[run]`.
pub(super) fn run(table: &Table<'_>) -> Option<RunSettings> {
    let order = optional(table.get("order"), |value| value.integer(0..=HIGHEST_ORDER));
    let duration = optional(table.get("duration"), |value| value.positive(Dimension::TIME));
    let tolerance = optional(table.get("tolerance"), |value| tolerance(&value));
    let samples = optional(table.get("samples"), |value| value.integer(2..=MOST_SAMPLES));
    let form = optional(table.get("form"), |value| value.named());
    let systems = optional(table.get("systems"), |value| systems(&value));
    let method = optional(table.get("method"), |value| value.named());
    let stop = table.read_or("stop", Stop::default(), |value| stop(&value));
    let verify = optional(table.get("verify"), |value| verify(&value));
    let evolve = optional(table.get("evolve"), |value| evolve(&value));
    let manifold = optional(table.get("manifold"), |value| manifold(&value));
    Some(RunSettings {
        order: order?.unwrap_or(ORDER),
        order_given: table.get("order").is_some(),
        duration: duration?,
        tolerance: tolerance?,
        samples: samples?,
        form: form?,
        systems: systems?,
        method: method?,
        stop: stop?,
        verify: verify?,
        evolve: evolve?,
        manifold: manifold?,
    })
}

/// Reads a value that may be absent; the outer option is none only if the value is there and wrong.
pub(super) fn optional<'a, T>(
    value: Option<Value<'a>>,
    read: impl FnOnce(Value<'a>) -> Option<T>,
) -> Option<Option<T>> {
    match value {
        Some(value) => read(value).map(Some),
        None => Some(None),
    }
}

fn tolerance(value: &Value<'_>) -> Option<f64> {
    let tolerance = value.quantity(Dimension::NUMBER)?;
    if (1e-15..=1e-2).contains(&tolerance) {
        return Some(tolerance);
    }
    let message = format!("`tolerance` is {tolerance:e}, but must lie from 1e-15 to 1e-2");
    value.refuse(message, "out of range", "write for example tolerance = 1e-9")
}

fn systems(value: &Value<'_>) -> Option<Vec<System>> {
    let help = "write for example [\"reduced\", \"rigid\", \"full\"]";
    distinct(value, "a list of systems", help, |item| item.named())
}

fn stop(value: &Value<'_>) -> Option<Stop> {
    let table = value.table("`stop`", &STOP)?;
    let energy = optional(table.get("energy"), |value| value.positive(Dimension::ENERGY));
    let nutation = optional(table.get("nutation"), |value| nutation(&value));
    let validity = table.read_or("validity", false, |value| value.boolean());
    Some(Stop { energy: energy?, nutation: nutation?, validity: validity? })
}

fn nutation(value: &Value<'_>) -> Option<f64> {
    let angle = value.positive(Dimension::ANGLE)?;
    if angle <= PI {
        return Some(angle);
    }
    let message = format!("`nutation` is {angle} rad, but must be at most half a turn");
    value.refuse(message, "out of range", "write for example nutation = \"45 deg\"")
}

fn verify(value: &Value<'_>) -> Option<Verify> {
    let table = value.table("`verify`", &VERIFY)?;
    let rotations = optional(table.get("rotations"), |value| value.positive(Dimension::NUMBER));
    let orders = optional(table.get("orders"), |value| {
        let help = "write for example [1, 2, 3]";
        distinct(&value, "a list of orders", help, |item| item.integer(1..=HIGHEST_ORDER))
    });
    let halvings = optional(table.get("halvings"), |value| value.integer(1..=MOST_HALVINGS));
    Some(Verify { rotations: rotations?, orders: orders?, halvings: halvings? })
}

/// Reads a list of one or more values, each of them once.
fn distinct<T: PartialEq + Copy>(
    value: &Value<'_>,
    expected: &str,
    help: &str,
    read: impl Fn(Value<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let Some(items) = value.items().filter(|items| !items.is_empty()) else {
        return value.mismatch(expected, help);
    };
    let mut values = Vec::new();
    let mut wrong = false;
    for item in items {
        match read(item) {
            Some(value) if values.contains(&value) => {
                let message = format!("`{}` has a duplicate entry", item.key());
                item.refuse::<T>(message, "given before", "leave it out");
                wrong = true;
            }
            Some(value) => values.push(value),
            None => wrong = true,
        }
    }
    (!wrong).then_some(values)
}
