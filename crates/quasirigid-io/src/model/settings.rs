//! Run settings: `[run]` with its tables `stop`, `verify` and `evolve`.
//! Absent settings stay absent where the command line may give them; defaults are chosen in the study.

use std::f64::consts::PI;

use quasirigid_body::{Form, MAX_ORDER, Method};

use super::evolve::{EVOLVE, PartialEvolve, evolve};
use super::key::{BOOLEAN, Keys, NUMBER, Shape, TEXT, integer, key, list, quantity, table, words};
use super::partial::partial;
use super::spin_manifold::{PartialSpinManifold, SPIN_MANIFOLD, spin_manifold};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const BODY: Keys = Keys {
    known: &[
        key("name", TEXT.or("file's name"), "title of results"),
        key(
            "kind",
            words(&["spacecraft", "small-body"]).or("by its parts"),
            "whose word results take: nutation or wobble",
        ),
    ],
};
pub(super) const RUN: Keys = Keys {
    known: &[
        key(
            "order",
            integer(0, MAX_ORDER as u64).or("lowest from 3 that holds"),
            "of the reduced equations, 0 for the rigid body",
        ),
        key("duration", quantity("s").or("100 revolutions"), "of the histories"),
        key("tolerance", NUMBER.or("1e-12"), "relative error per step, 1e-15 to 1e-2"),
        key(
            "samples",
            integer(2, MAX_ROWS as u64).or("`run`: 24 a revolution, 2001 to 50 001; `simulate`: 1001"),
            "rows",
        ),
        key(
            "form",
            words(&["angular-momentum", "angular-velocity"]).or("`\"angular-momentum\"`"),
            "variable that is integrated",
        ),
        key(
            "systems",
            list(&Shape::Words(&["full", "reduced", "rigid", "spin-manifold"]))
                .or("`[\"reduced\", \"rigid\"]`"),
            "`\"spin-manifold\"`: reduced about the spin",
        ),
        key(
            "integrator",
            words(&["automatic", "explicit", "implicit"]).or("`\"automatic\"`"),
            "for the full system",
        ),
        key("stop", table(&STOP), "ends a run early"),
        key("verify", table(&VERIFY), "compares with the full system"),
        key("evolve", table(&EVOLVE), "secular evolution"),
        key(
            "spin_manifold",
            table(&SPIN_MANIFOLD),
            "reduced equations about the spin; `run` then keeps the backbone",
        ),
    ],
};
const STOP: Keys = Keys {
    known: &[
        key("energy", quantity("J"), "at this energy"),
        key("nutation", quantity("rad"), "at this angle"),
        key("validity", BOOLEAN.or("false"), "where the reduced equations cease to hold"),
    ],
};
const VERIFY: Keys = Keys {
    known: &[
        key("revolutions", NUMBER.or("5"), "revolutions of each run"),
        key("orders", list(&Shape::Integer(0, 12)).or("1 to `order`"), ""),
        key("halvings", integer(1, 10).or("4"), "how often ε is halved"),
    ],
};

/// Order of the reduced equations unless the file chooses another.
const ORDER: usize = 3;
/// Most rows of a history, of an evolution, and draws of uncertain keys.
pub const MAX_ROWS: usize = 10_000_000;
/// Most halvings of the spin: the last is a thousandth of the first, and its run a thousand times as long.
const MOST_HALVINGS: usize = 10;

partial! {
    /// Settings of histories, as far as a source gives them.
    PartialRun {
        /// Length of the history (s).
        duration: f64,
        /// Relative tolerance of the integrator.
        tolerance: f64,
        /// Number of rows.
        samples: usize,
        /// Variable that is integrated.
        form: Form,
        /// Integrator of the full system.
        integrator: Method,
    }
}

/// Table `[run]`.
#[derive(Clone, Debug, PartialEq)]
pub struct RunTable {
    /// Order of the reduced equations, from 0 to 12.
    pub order: usize,
    /// Whether the file gives the order.
    pub order_given: bool,
    /// Settings of the histories.
    pub histories: PartialRun,
    /// Systems of equations to integrate.
    pub systems: Option<Vec<System>>,
    /// Events that end a run before its time.
    pub stop: Stop,
    /// Comparison of the reduced equations with the full ones; none if the file does not ask for it.
    pub verify: Option<PartialVerify>,
    /// Secular evolution of the rotation; none if the file does not ask for it.
    pub evolve: Option<PartialEvolve>,
    /// Reduced equations about the steady spin; none if the file does not ask for them.
    pub spin_manifold: Option<PartialSpinManifold>,
}

impl Default for RunTable {
    fn default() -> Self {
        Self {
            order: ORDER,
            order_given: false,
            histories: PartialRun::default(),
            systems: None,
            stop: Stop::default(),
            verify: None,
            evolve: None,
            spin_manifold: None,
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
    SpinManifold,
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

partial! {
    /// Comparison of the reduced equations with the full ones, as far as a source gives its settings.
    PartialVerify {
        /// Length of each run in revolutions.
        revolutions: f64,
        /// Orders of the reduced equations.
        orders: Vec<usize>,
        /// Number of halvings of `ε`.
        halvings: usize,
    }
}

/// Reads `[run]`.
pub(super) fn run(table: &Table<'_>) -> Option<RunTable> {
    let order = optional(table.get("order"), |value| value.integer(0..=MAX_ORDER));
    let duration = optional(table.get("duration"), |value| value.positive(Dimension::TIME));
    let tolerance = optional(table.get("tolerance"), |value| tolerance(&value));
    let samples = optional(table.get("samples"), |value| value.integer(2..=MAX_ROWS));
    let form = optional(table.get("form"), |value| value.named());
    let systems = optional(table.get("systems"), |value| systems(&value));
    let integrator = optional(table.get("integrator"), |value| value.named());
    let stop = table.read_or("stop", Stop::default(), |value| stop(&value));
    let verify = optional(table.get("verify"), |value| verify(&value));
    let evolve = optional(table.get("evolve"), |value| evolve(&value));
    let spin_manifold = optional(table.get("spin_manifold"), |value| spin_manifold(&value));
    Some(RunTable {
        order: order?.unwrap_or(ORDER),
        order_given: table.get("order").is_some(),
        histories: PartialRun {
            duration: duration?,
            tolerance: tolerance?,
            samples: samples?,
            form: form?,
            integrator: integrator?,
        },
        systems: systems?,
        stop: stop?,
        verify: verify?,
        evolve: evolve?,
        spin_manifold: spin_manifold?,
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

fn verify(value: &Value<'_>) -> Option<PartialVerify> {
    let table = value.table("`verify`", &VERIFY)?;
    let revolutions = optional(table.get("revolutions"), |value| value.positive(Dimension::NUMBER));
    let orders = optional(table.get("orders"), |value| {
        let help = "write for example [1, 2, 3]";
        distinct(&value, "a list of orders", help, |item| item.integer(0..=MAX_ORDER))
    });
    let halvings = optional(table.get("halvings"), |value| value.integer(1..=MOST_HALVINGS));
    Some(PartialVerify { revolutions: revolutions?, orders: orders?, halvings: halvings? })
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
