//! Paths past a centre of attraction: `orbit` of central gravity, an ellipse, a flyby by its periapsis, or a table of places.
//! Equations (F10), (F23) and (F26), docs/theory/07-forces.md.

use std::path::Path;

use quasirigid_body::force::{Conic, Ephemeris, Orbit, Trajectory};

use super::orbit::{FLYBY, ORBIT, ellipse, gravitational_parameter};
use super::table::Table;
use super::timing::rows;
use super::value::Value;
use crate::units::Dimension;

/// Metres in a kilometre.
const KILO: f64 = 1e3;
/// Eccentricity up to which an ellipse is followed by its semi-major axis: beyond, that axis loses digits.
const NARROW: f64 = 0.99;

/// Mean radii (m) of centres known by name: Archinal et al. (2018) of the planets and the Moon, the nominal one of the IAU (2015) of the Sun.
const RADII: [(&str, f64); 4] =
    [("Earth", 6_371_008.4), ("Moon", 1_737_400.0), ("Mars", 3_389_500.0), ("Sun", 6.957e8)];

/// Reads the path of a force that needs one.
pub(super) fn trajectory(table: &Table<'_>, folder: &Path) -> Option<Trajectory> {
    let example = "orbit = { body = \"Earth\", semi_major_axis = \"6778 km\", inclination = \"51.6 deg\" }";
    let value = table.required("orbit", example)?;
    let table = value.table("`orbit`", &ORBIT)?;
    let negative = |value: Value<'_>| value.quantity(Dimension::LENGTH).is_some_and(|a| a < 0.0);
    let path = if let Some(file) = table.get("file") {
        Trajectory::Table(places(&file, &table, folder)?)
    } else if FLYBY.iter().any(|key| table.get(key).is_some())
        || table.get("semi_major_axis").is_some_and(negative)
    {
        if let Some(precession) = table.get("precession") {
            return precession.refuse(
                "`precession` is that of an ellipse, averaged over its revolutions, and this orbit is given by its periapsis",
                "not for a flyby",
                "leave it out, or give the ellipse by `semi_major_axis` and `mean_anomaly`",
            );
        }
        own_axis(conic(&table)?)
    } else {
        Trajectory::Orbit(ellipse(&table)?)
    };
    above_the_surface(&value, &table, &path)?;
    Some(path)
}

/// An ellipse by its semi-major axis, unless it is narrow.
fn own_axis(conic: Conic) -> Trajectory {
    if !(0.0..=NARROW).contains(&conic.eccentricity) {
        return conic.into();
    }
    let Conic { mu, eccentricity, inclination, raan, argument_of_periapsis, .. } = conic;
    let semi_major_axis = conic.periapsis_distance / (1.0 - eccentricity);
    let mean_anomaly = -conic.time_of_periapsis * (mu / semi_major_axis).sqrt() / semi_major_axis;
    let (node_rate, periapsis_rate) = (0.0, 0.0);
    Orbit {
        mu,
        semi_major_axis,
        eccentricity,
        inclination,
        raan,
        argument_of_periapsis,
        mean_anomaly,
        node_rate,
        periapsis_rate,
    }
    .into()
}

/// Reads a conic by its periapsis: distance, or semi-major axis; eccentricity, or excess speed; time of the passage, or mean anomaly.
fn conic(table: &Table<'_>) -> Option<Conic> {
    let mu = gravitational_parameter(table);
    let angle = |key| table.read_or(key, 0.0, |value| value.quantity(Dimension::ANGLE));
    let [inclination, raan, argument_of_periapsis] = ["inclination", "node", "periapsis"].map(angle);
    let mu = mu?;
    let (periapsis_distance, eccentricity) = shape(table, mu)?;
    let time_of_periapsis = passage(table, mu, periapsis_distance, eccentricity)?;
    Some(Conic {
        mu,
        periapsis_distance,
        eccentricity,
        inclination: inclination?,
        raan: raan?,
        argument_of_periapsis: argument_of_periapsis?,
        time_of_periapsis,
    })
}

/// Distance of the periapsis (m) and eccentricity.
fn shape(table: &Table<'_>, mu: f64) -> Option<(f64, f64)> {
    if let (Some(_), Some(axis)) = (table.get("periapsis_distance"), table.get("semi_major_axis")) {
        return twice(&axis, "`periapsis_distance` and the eccentricity give the semi-major axis already");
    }
    if let (Some(eccentricity), Some(_)) = (table.get("eccentricity"), table.get("excess_speed")) {
        return twice(&eccentricity, "`excess_speed` gives the eccentricity already");
    }
    if let Some(axis) = table.get("semi_major_axis") {
        if let Some(speed) = table.get("excess_speed") {
            return twice(&speed, "`semi_major_axis` gives the excess speed already");
        }
        let a = axis.quantity(Dimension::LENGTH)?;
        let e =
            table.read("eccentricity", "eccentricity = 4.25", |value| value.quantity(Dimension::NUMBER))?;
        if !(a * (1.0 - e) > 0.0) {
            return axis.refuse(
                format!("`semi_major_axis` is {:.6} km, and no orbit of the eccentricity {e} has it", a / KILO),
                "no such orbit",
                "it is positive below the eccentricity 1, negative above, and infinite at 1: a `periapsis_distance` suits all",
            );
        }
        return Some((a * (1.0 - e), e));
    }
    let distance = table.read("periapsis_distance", "periapsis_distance = \"38012 km\"", |value| {
        value.positive(Dimension::LENGTH)
    })?;
    if let Some(speed) = table.get("excess_speed") {
        let speed = speed.non_negative(Dimension::VELOCITY)?;
        return Some((distance, 1.0 + distance * speed * speed / mu));
    }
    let help = "eccentricity = 4.25, or excess_speed = \"5.84 km/s\"";
    Some((distance, table.read("eccentricity", help, |value| value.quantity(Dimension::NUMBER))?))
}

/// Time of the passage of the periapsis (s).
fn passage(table: &Table<'_>, mu: f64, distance: f64, eccentricity: f64) -> Option<f64> {
    let Some(anomaly) = table.get("mean_anomaly") else {
        let read = |value: Value<'_>| value.quantity(Dimension::TIME);
        return table.read(
            "time_of_periapsis",
            "time_of_periapsis = \"5 d\", from the start of the run",
            read,
        );
    };
    if table.get("time_of_periapsis").is_some() {
        return twice(&anomaly, "`time_of_periapsis` gives the mean anomaly already");
    }
    let M = anomaly.quantity(Dimension::ANGLE)?;
    let rate = (mu / distance).sqrt() / distance * (1.0 - eccentricity).abs().powf(1.5);
    if !(rate > 0.0) {
        return anomaly.refuse(
            "a parabola has no mean anomaly",
            "of what mean motion?",
            "write time_of_periapsis = \"5 d\"",
        );
    }
    Some(-M / rate)
}

fn twice<T>(value: &Value<'_>, message: &str) -> Option<T> {
    value.refuse(message, "given twice", "leave out one of the two")
}

/// Reads a table of places.
fn places(file: &Value<'_>, table: &Table<'_>, folder: &Path) -> Option<Ephemeris> {
    const OF_ELEMENTS: [&str; 6] =
        ["semi_major_axis", "eccentricity", "inclination", "node", "periapsis", "mean_anomaly"];
    let mut others = OF_ELEMENTS.iter().chain(&FLYBY).chain(&["precession"]).filter(|key| **key != "file");
    if let Some(other) = others.find_map(|key| table.get(key)) {
        let message = format!("`{}` beside the `file`, which has the place at each time", other.key());
        return twice(&other, &message);
    }
    let mu = gravitational_parameter(table)?;
    let found = rows(&folder.join(file.text()?));
    match found.and_then(|rows| Ephemeris::new(mu, &rows).map_err(|problem| problem.to_string())) {
        Ok(table) => Some(table),
        Err(message) => file.refuse(
            format!("`file`: {message}"),
            "cannot be used",
            "the table is looked for beside the model: CSV with the columns t, x, y, z in this order, t in seconds from the start of the run and \
             ascending, places of the body from the centre of attraction in metres, inertial axes",
        ),
    }
}

/// Refuses a path below the surface of its centre, whose radius is given or known by name.
fn above_the_surface(value: &Value<'_>, table: &Table<'_>, path: &Trajectory) -> Option<()> {
    let body = table.get("body").and_then(|body| body.words());
    let known = RADII.iter().find(|(name, _)| body == Some(*name)).map(|(_, radius)| *radius);
    let given = table.get("planet_radius");
    let radius = match &given {
        Some(given) => Some(given.non_negative(Dimension::LENGTH)?),
        None => known,
    };
    let nearest = path.nearest();
    match radius.filter(|radius| nearest > 0.0 && nearest < *radius) {
        Some(radius) => given.as_ref().unwrap_or(value).refuse(
            format!(
                "the orbit comes to {:.6} km from the centre, below the surface, whose radius is {:.6} km",
                nearest / KILO,
                radius / KILO
            ),
            "below the surface",
            "distances are from the centre, in metres without a unit; `planet_radius` is the radius of another surface, 0 of none",
        ),
        None => Some(()),
    }
}
