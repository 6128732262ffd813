//! Initial state: rotation, attitude, displacements, and the place and velocity of a free body.
//! Displacements default to the slow manifold: a body started undeformed would first vibrate, which nobody asked for.
//! Equation (Q8), docs/theory/16-methods.md, tells where the slow manifold can be used as a start.

use std::ops::Range;
use std::path::Path;

use quasirigid_body::Support;
use quasirigid_elements::Problem;

use super::body::Body;
use super::key::{Keys, QUATERNION, Shape, TEXT, any, key, named, table, vector};
use super::names::Part;
use super::rotation::{PERIODS, Rotation, WOBBLE, rotation};
use super::start_file;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const INITIAL: Keys = Keys {
    known: &[
        key(
            "angular_velocity",
            vector("rad/s"),
            "body axes; only `derive` needs neither it nor one of the next two",
        ),
        key("periods", table(&PERIODS), "observed, of a free body"),
        key("wobble", table(&WOBBLE), "of a free body"),
        key("attitude", QUATERNION.or("`[1, 0, 0, 0]`"), "from body to inertial axes"),
        key("from", TEXT, "attitude file that gives the attitude, and the angular velocity if it has one"),
        key(
            "at",
            any(&[Shape::Number, Shape::Text]).in_unit("s").or("first record"),
            "record of the file: its time, or epoch, `\"2026-01-01T00:00:00\"`",
        ),
        key(
            "displacements",
            any(&[Shape::Words(&["slow-manifold", "rest"]), Shape::Named(&MOVED)])
                .in_unit("m, rad")
                .or("`\"slow-manifold\"`"),
            "the slow manifold is deformed by the spin, without vibration",
        ),
        key(
            "displacement_rates",
            named(&MOVED).in_unit("m/s, rad/s").or("0"),
            "beside `\"rest\"` or a table",
        ),
        key("position", vector("m").or("0"), "of the centre of mass of a free body; inertial axes"),
        key("velocity", vector("m/s").or("0"), "of the same"),
    ],
};

/// Displacement of a point, along axes of the file, or angles of an appendage, about its axes, or of a liquid in a ring, about that of the ring.
const MOVED: Shape = Shape::List(&Shape::Number);

/// Largest deviation of a quaternion's norm from one that counts as rounding: three digits, as people type them.
const ROUNDED_NORM: f64 = 1e-3;
/// Largest deviation that needs no note: nine digits, as programs print them.
const PRINTED_NORM: f64 = 1e-9;

/// State of the body at time zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Initial {
    /// Rotation; none if the file does not give it.
    pub rotation: Option<Rotation>,
    /// Unit quaternion, scalar first, that turns body components into inertial ones.
    pub attitude: [f64; 4],
    /// Internal coordinates.
    pub displacements: Displacements,
    /// Place of the centre of mass of a free body (m), inertial axes.
    pub position: [f64; 3],
    /// Velocity of the centre of mass of a free body (m/s), inertial axes.
    pub velocity: [f64; 3],
}

/// Internal coordinates at time zero.
#[derive(Clone, Debug, PartialEq)]
pub enum Displacements {
    /// Displacements on the slow manifold, without vibration.
    SlowManifold,
    /// Given displacements of points, appendages and liquids in rings on a carrier, the first of the body's coordinates, in their order; the
    /// others are at rest.
    Given {
        /// Coordinates (m, rad).
        q: Vec<f64>,
        /// Rates of the coordinates (m/s, rad/s).
        rate: Vec<f64>,
    },
}

impl Default for Initial {
    fn default() -> Self {
        Self {
            rotation: None,
            attitude: [1.0, 0.0, 0.0, 0.0],
            displacements: Displacements::SlowManifold,
            position: [0.0; 3],
            velocity: [0.0; 3],
        }
    }
}

/// Reads `[initial]`; suspect but usable values go into `notes`.
pub(super) fn initial(
    table: &Table<'_>,
    (body, folder): (&Body<'_>, &Path),
    notes: &mut Vec<String>,
) -> Option<Initial> {
    let record = start_file::record(table, folder, notes);
    let told = record.flatten().and_then(|record| record.angular_velocity).map(Rotation::Spin);
    let rotation = rotation(table).map(|given| given.or(told));
    let attitude = match record? {
        Some(record) => Some(record.attitude),
        None => {
            table.read_or("attitude", Initial::default().attitude, |value| unit_quaternion(&value, notes))
        }
    };
    let displacements = displacements(table, body);
    let position = of_free_body(table, "position", Dimension::LENGTH, body);
    let velocity = of_free_body(table, "velocity", Dimension::VELOCITY, body);
    Some(Initial {
        rotation: rotation?,
        attitude: attitude?,
        displacements: displacements?,
        position: position?,
        velocity: velocity?,
    })
}

/// Reads an attitude and normalises it; a norm that differs from one by more than printed digits is noted, or refused.
pub(super) fn unit_quaternion(value: &Value<'_>, notes: &mut Vec<String>) -> Option<[f64; 4]> {
    let quaternion: [f64; 4] = value.numbers(Dimension::NUMBER)?;
    let norm = quaternion.iter().fold(0.0, |norm: f64, component| norm.hypot(*component));
    let deviation = (norm - 1.0).abs();
    if deviation > ROUNDED_NORM {
        let message = format!("`attitude` has the norm {norm}, but an attitude is a unit quaternion");
        let help = "write four numbers, scalar first, whose squares add up to 1";
        return value.refuse(message, "not a unit quaternion", help);
    }
    if deviation > PRINTED_NORM {
        notes.push(format!("the initial attitude has the norm {norm}; it was divided by it"));
    }
    Some(quaternion.map(|component| component / norm))
}

/// Reads a vector that only a body that moves freely has.
fn of_free_body(
    table: &Table<'_>,
    key: &'static str,
    dimension: Dimension,
    body: &Body<'_>,
) -> Option<[f64; 3]> {
    let vector = table.vector_or_zero(key, dimension);
    let help = match body.assembly().map(|assembly| &assembly.support) {
        Some(Support::FixedPoint { .. }) => {
            "leave it out; the fixed point is the origin of the inertial axes".to_owned()
        }
        Some(Support::Prescribed { .. }) => format!("write `{key}` in [support], for the driven point"),
        _ => return vector,
    };
    let Some(value) = table.get(key) else { return vector };
    let message = format!("`{key}` is that of the centre of mass of a free body, and this body is held");
    value.refuse(message, "not for this body", help)
}

/// Displacements as a file gives them.
enum Said<'a> {
    SlowManifold,
    Rest,
    Table(Value<'a>),
}

fn said<'a>(value: Option<Value<'a>>) -> Option<Said<'a>> {
    let Some(value) = value else { return Some(Said::SlowManifold) };
    if value.is_table() {
        return Some(Said::Table(value));
    }
    if value.words().is_none() {
        let help = "write \"slow-manifold\", \"rest\", or a table such as { tip = [0.01, 0, 0] }";
        return value.mismatch("\"slow-manifold\", \"rest\" or a table of names", help);
    }
    let slow = value.choice(&[("slow-manifold", true), ("rest", false)])?;
    Some(if slow { Said::SlowManifold } else { Said::Rest })
}

fn displacements(table: &Table<'_>, body: &Body<'_>) -> Option<Displacements> {
    let rates = table.get("displacement_rates");
    let rate = match &rates {
        Some(rates) => amounts(rates, body, Dimension::VELOCITY, Dimension::ANGULAR_VELOCITY),
        None => Some(at_rest(body).concat()),
    };
    let q = match said(table.get("displacements"))? {
        Said::SlowManifold => {
            let Some(rates) = rates else { return Some(Displacements::SlowManifold) };
            let message =
                "`displacement_rates` without given `displacements`: the slow manifold has its own rates";
            let help = "write displacements = \"rest\" or a table of them, too";
            return rates.refuse(message, "not on the slow manifold", help);
        }
        Said::Rest => Some(at_rest(body).concat()),
        Said::Table(table) => amounts(&table, body, Dimension::LENGTH, Dimension::ANGLE),
    };
    Some(Displacements::Given { q: q?, rate: rate? })
}

/// Coordinates of the points, appendages and liquids in rings on a carrier, in this order, all zero.
fn at_rest(body: &Body<'_>) -> Vec<Vec<f64>> {
    let Some(assembly) = body.assembly().filter(|assembly| assembly.carrier.is_some()) else {
        return Vec::new();
    };
    // A `motion` without a direction is refused by the laws of mechanics, with the rest of the body.
    let points = assembly.points.iter().map(|point| point.coordinates_of([0.0; 3]).unwrap_or_default());
    let hinged = assembly.hinged.iter().map(|part| vec![0.0; if part.turns() { part.axes.len() } else { 0 }]);
    let booms = assembly.booms.iter().map(|boom| vec![0.0; usize::from(boom.length.law().is_some())]);
    points.chain(hinged).chain(booms).chain(assembly.tubes.iter().map(|_| vec![0.0])).collect()
}

/// Reads the coordinates, or their rates, of the parts that a table names; the others are at rest.
fn amounts(value: &Value<'_>, body: &Body<'_>, along: Dimension, about: Dimension) -> Option<Vec<f64>> {
    let Some(entries) = value.entries() else {
        return value.mismatch("a table of names", "write for example { tip = [0.01, 0, 0] }");
    };
    let mut parts = at_rest(body);
    let mut good = true;
    let floats = body.assembly().is_some_and(|assembly| assembly.carrier.is_none());
    for (key, value) in entries {
        let amount = match body.names.part(key.clone(), &value) {
            Some(Part::Point(_)) if floats => value.refuse_at(
                key,
                format!("{:?} moves with the shapes of a body without a carrier", value.key()),
                "no coordinate of its own",
                "write displacements = \"slow-manifold\" or \"rest\"",
            ),
            Some(Part::Point(index)) => of_point(&value, body, index, along).map(|q| (index, q)),
            Some(Part::Hinged(index)) => {
                let points = body.assembly().map_or(0, |assembly| assembly.points.len());
                let part = &body.assembly()?.hinged[index];
                match part.angle {
                    Some(_) => driven(&value, key, "`angle`"),
                    None => {
                        of_hinge(&value, ("the hinge", part.axes.len()), about).map(|q| (points + index, q))
                    }
                }
            }
            Some(Part::Boom) => driven(&value, key, "`length`"),
            Some(Part::Slug(index)) => {
                let first = body.assembly().map_or(0, |assembly| {
                    assembly.points.len() + assembly.hinged.len() + assembly.booms.len()
                });
                of_hinge(&value, ("the ring", 1), about).map(|q| (first + index, q))
            }
            Some(Part::Throughout | Part::Flexible(_)) => value.refuse_at(
                key,
                format!("{:?} is elastic throughout, and its displacements have no names", value.key()),
                "elastic throughout",
                "write displacements = \"slow-manifold\" or \"rest\"",
            ),
            Some(Part::Link(word)) => value.refuse_at(
                key,
                format!("{:?} is a {word}, and has no coordinates of its own", value.key()),
                "not a point",
                "displace what its ends are fixed to",
            ),
            Some(Part::Inside) => value.refuse_at(
                key,
                format!("{:?} turns inside the carrier; only its speed matters", value.key()),
                "turns inside",
                "write `speed` in its [[rotor]]",
            ),
            Some(Part::Modal) => value.refuse_at(
                key,
                format!("{:?} is known by its modes alone, and its displacements have no names", value.key()),
                "no shapes",
                "write displacements = \"slow-manifold\" or \"rest\"",
            ),
            None => None,
        };
        good &= amount.is_some();
        if let Some((index, q)) = amount
            && let Some(part) = parts.get_mut(index)
        {
            *part = q;
        }
    }
    good.then(|| parts.concat())
}

/// Refuses the coordinate of a part that a drive holds.
fn driven<T>(value: &Value<'_>, key: Range<usize>, law: &str) -> Option<T> {
    value.refuse_at(
        key,
        format!("{:?} has the place that its {law} gives at t = 0", value.key()),
        "driven",
        format!("leave it out, and change {law}"),
    )
}

fn of_point(value: &Value<'_>, body: &Body<'_>, index: usize, along: Dimension) -> Option<Vec<f64>> {
    let vector = value.vector(along)?;
    match body.assembly()?.points[index].coordinates_of(vector) {
        Err(Problem::Barred { left }) => {
            let left = left.map(|entry| format!("{entry:.3e}").parse().unwrap_or(entry) + 0.0);
            let message = format!("`{}`: its `motion` does not leave the point this way", value.key());
            let help = format!("of this vector it leaves {left:?}");
            value.refuse(message, "barred", help)
        }
        other => Some(other.unwrap_or_default()),
    }
}

fn of_hinge(value: &Value<'_>, (what, axes): (&str, usize), about: Dimension) -> Option<Vec<f64>> {
    let angles = value.list("an array with a value per axis", |item| item.quantity(about))?;
    if angles.len() == axes {
        return Some(angles);
    }
    let message = format!(
        "`{}` has {}, but {what} has {}",
        value.key(),
        counted(angles.len(), "value", "values"),
        counted(axes, "axis", "axes")
    );
    value.refuse(message, "one value per axis", "write one value for each axis, in their order")
}

fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}
