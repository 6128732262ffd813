use quasirigid_body::force::{Oblateness, Orbit};

use super::key::{Keys, NUMBER, Shape, TEXT, any, key, quantity, words};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

pub(super) const ORBIT: Keys = Keys {
    known: &[
        key(
            "body",
            words(&["Earth", "Moon", "Mars", "Sun"]),
            "3.986004418e14 (IAU 2009), or after DE440 4.902800118e12, 4.282837362e13, 1.32712440041e20 m³/s²",
        ),
        key("gravitational_parameter", quantity("m³/s²"), "instead of `body`"),
        key("semi_major_axis", quantity("m"), "negative of a hyperbola"),
        key(
            "periapsis_distance",
            quantity("m"),
            "instead, of an orbit of any eccentricity (F23), under central gravity",
        ),
        key(
            "eccentricity",
            NUMBER.or("0 of an ellipse"),
            "required beside `periapsis_distance`; 1 of a parabola, above 1 of a hyperbola",
        ),
        key("excess_speed", quantity("m/s"), "instead, of a hyperbola, far away"),
        key("inclination", quantity("rad").or("0 without `file`"), ""),
        key("node", quantity("rad").or("0 without `file`"), "right ascension of the ascending node"),
        key("periapsis", quantity("rad").or("0 without `file`"), "its argument"),
        key("mean_anomaly", quantity("rad").or("0 of an ellipse"), "at time zero"),
        key("time_of_periapsis", quantity("s"), "instead, required of a flyby"),
        key(
            "file",
            TEXT,
            "instead of elements, under central gravity: CSV of places from the centre, `t,x,y,z` in s and m (F26)",
        ),
        key(
            "planet_radius",
            quantity("m").or("that of `body`"),
            "an orbit below it is refused, under central gravity",
        ),
        key(
            "precession",
            any(&[Shape::Words(&["J2"]), Shape::Table(&PRECESSION)]).or("none"),
            "secular, of node and periapsis: by the oblateness of the Earth or Mars, (F20), or its rates",
        ),
    ],
};

const PRECESSION: Keys = Keys {
    known: &[
        key("node", quantity("rad/s").or("0"), "rate of the ascending node"),
        key("periapsis", quantity("rad/s").or("0"), "rate of the argument of the periapsis"),
    ],
};

/// Keys of paths that are no ellipse by its semi-major axis.
pub(super) const FLYBY: [&str; 4] = ["periapsis_distance", "excess_speed", "time_of_periapsis", "file"];

/// Metres in a kilometre.
const KILO: f64 = 1e3;

/// Centres whose oblateness is known.
const OBLATE: [(&str, Oblateness); 2] = [("Earth", Oblateness::EARTH), ("Mars", Oblateness::MARS)];

/// Gravitational parameters (m³/s²): of the Earth as recommended by the IAU (2009), in TCG; of the others as in the
/// ephemeris DE440, in TDB.
const BODIES: [(&str, f64); 4] = [
    ("Earth", Orbit::EARTH_PARAMETER),
    ("Moon", 4.902_800_118e12),
    ("Mars", 4.282_837_362e13),
    ("Sun", 1.327_124_400_41e20),
];

/// Reads an orbit through a field: an ellipse.
pub(super) fn orbit(value: &Value<'_>) -> Option<Orbit> {
    let table = value.table("`orbit`", &ORBIT)?;
    if let Some(other) = FLYBY.iter().chain(&["planet_radius"]).find_map(|key| table.get(key)) {
        return other.refuse(
            format!(
                "`{}` is that of an orbit under central gravity, and this one is through a magnetic field",
                other.key()
            ),
            "not for this orbit",
            "give an ellipse by `semi_major_axis`, `eccentricity` and `mean_anomaly`",
        );
    }
    ellipse(&table)
}

/// Reads an ellipse.
pub(super) fn ellipse(table: &Table<'_>) -> Option<Orbit> {
    let mu = gravitational_parameter(table);
    let semi_major_axis = table
        .read("semi_major_axis", "semi_major_axis = \"6778 km\"", |value| value.positive(Dimension::LENGTH));
    let number = |key, dimension| table.read_or(key, 0.0, |value| value.quantity(dimension));
    let eccentricity = number("eccentricity", Dimension::NUMBER);
    let inclination = number("inclination", Dimension::ANGLE);
    let raan = number("node", Dimension::ANGLE);
    let argument_of_periapsis = number("periapsis", Dimension::ANGLE);
    let mean_anomaly = number("mean_anomaly", Dimension::ANGLE);
    let orbit = Orbit {
        mu: mu?,
        semi_major_axis: semi_major_axis?,
        eccentricity: eccentricity?,
        inclination: inclination?,
        raan: raan?,
        argument_of_periapsis: argument_of_periapsis?,
        mean_anomaly: mean_anomaly?,
        node_rate: 0.0,
        periapsis_rate: 0.0,
    };
    match table.get("precession") {
        Some(value) => precession(&value, table, orbit),
        None => Some(orbit),
    }
}

/// Reads the precession of an orbit: by the oblateness of its centre, or given rates.
fn precession(value: &Value<'_>, table: &Table<'_>, orbit: Orbit) -> Option<Orbit> {
    if value.is_table() {
        let rates = value.table("`precession`", &PRECESSION)?;
        let rate = |key| rates.read_or(key, 0.0, |value| value.quantity(Dimension::ANGULAR_VELOCITY));
        let (node, periapsis) = (rate("node"), rate("periapsis"));
        return Some(Orbit { node_rate: node?, periapsis_rate: periapsis?, ..orbit });
    }
    value.choice(&[("J2", ())])?;
    let body = table.get("body").and_then(|body| body.words());
    match OBLATE.iter().find(|(name, _)| body == Some(*name)) {
        Some((_, oblateness)) => {
            let nearest = orbit.semi_major_axis * (1.0 - orbit.eccentricity);
            if orbit.eccentricity < 1.0 && nearest < oblateness.radius {
                return value.refuse(
                    format!(
                        "`precession`: the orbit comes to {:.0} km from the centre, inside the body, whose radius is {:.0} km",
                        nearest / KILO,
                        oblateness.radius / KILO
                    ),
                    "no such orbit",
                    "check the semi-major axis, from the centre of the body, and the eccentricity",
                );
            }
            Some(orbit.about(*oblateness))
        }
        None => value.refuse(
            "`precession`: the oblateness of this centre is not known here",
            "no J2",
            "write body = \"Earth\" or \"Mars\", or precession = { node = \"-5 deg/d\", periapsis = \"3 deg/d\" }",
        ),
    }
}

/// Reads the gravitational parameter of the centre, or takes that of a body known by name.
pub(super) fn gravitational_parameter(table: &Table<'_>) -> Option<f64> {
    match (table.get("body"), table.get("gravitational_parameter")) {
        (Some(body), None) => body.choice(&BODIES),
        (Some(_), Some(parameter)) => parameter.refuse(
            "`gravitational_parameter` is that of the `body` already",
            "given twice",
            "leave out one of the two",
        ),
        (None, _) => table
            .required("gravitational_parameter", "body = \"Earth\", or gravitational_parameter = 3.986e14")?
            .positive(Dimension::GRAVITATIONAL_PARAMETER),
    }
}
