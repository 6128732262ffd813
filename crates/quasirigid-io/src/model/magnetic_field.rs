//! Magnetic fields, of the model or of a force: uniform, of a dipole at the centre of an orbit, or the main field of the Earth. (F8), (F21)

use quasirigid_body::control::Controller;
use quasirigid_body::force::{EarthField, ForceLaw, MagneticField, Orbit};
use quasirigid_elements::Assembly;

use super::key::{Key, Keys, Shape, TEXT, integer, key, of, quantity, shared, table};
use super::orbit::orbit;
use super::table::Table;
use super::value::Value;
use crate::attitude::Epoch;
use crate::units::Dimension;

/// Keys of the main field of the Earth.
pub(super) const IGRF: Keys = Keys {
    known: &[
        key("epoch", TEXT, "of time zero, UT, `\"2024-03-01T12:00:00\"`; from 1900 to 2030"),
        key("degree", integer(1, EarthField::MAX_DEGREE as u64).or("13"), "highest one"),
    ],
};

pub(super) const FIELD: Key = key("field", of(Shape::Vector).in_unit("T"), "uniform; inertial axes");
pub(super) const DIPOLE: Key = key(
    "dipole",
    of(Shape::Vector).in_unit("T m³"),
    "instead, at the centre of the `orbit`: μ0/4π times its moment",
);
pub(super) const DIPOLE_RATE: Key =
    key("dipole_rate", quantity("rad/s").or("0"), "of the dipole about the inertial z");
pub(super) const MAIN_FIELD: Key =
    key("igrf", table(&IGRF), "instead, the main field of the Earth (F21), which turns with it");

/// Keys of the field of a model.
pub(super) const TABLE: Keys = Keys {
    known: &[FIELD, DIPOLE, DIPOLE_RATE, MAIN_FIELD, key("orbit", shared("orbit"), "through the field")],
};

/// Field of a model, for forces without one of their own.
#[derive(Clone, Copy)]
pub(super) enum CommonField {
    /// The file gives none.
    Absent,
    /// The file gives one that is wrong, which is reported.
    Wrong,
    /// The field.
    Given(MagneticField),
}

/// Reads the field of a force, or takes that of the model where the force has none.
pub(super) fn field_of_force(table: &Table<'_>, common: CommonField) -> Option<MagneticField> {
    let own = TABLE.known.iter().any(|key| table.get(key.name).is_some());
    match common {
        CommonField::Given(field) if !own => Some(field),
        CommonField::Wrong if !own => None,
        _ => magnetic_field(table),
    }
}

/// Reads a field.
pub(super) fn magnetic_field(table: &Table<'_>) -> Option<MagneticField> {
    if let Some(earth) = table.get("igrf") {
        if let Some(other) = ["field", "dipole", "dipole_rate"].iter().find_map(|key| table.get(key)) {
            return other.refuse(
                "the magnetic field is given by `igrf` already",
                "given twice",
                "leave out one of the two",
            );
        }
        let (field, orbit) = (earth_field(&earth), required_orbit(table));
        return Some(MagneticField::Earth { field: field?, orbit: orbit? });
    }
    match (table.get("field"), table.get("dipole")) {
        (None, Some(dipole)) => {
            let strength = dipole.vector(Dimension::DIPOLE_STRENGTH);
            let rate = table.read_or("dipole_rate", 0.0, |value| value.quantity(Dimension::ANGULAR_VELOCITY));
            let orbit = required_orbit(table);
            Some(MagneticField::Dipole { strength: strength?, rate: rate?, orbit: orbit? })
        }
        (Some(_), Some(dipole)) => dipole.refuse(
            "the magnetic field is given by `field` already",
            "given twice",
            "leave out one of the two",
        ),
        (_, None) => uniform_field(table),
    }
}

/// Reads the main field of the Earth: the year and the sidereal time of an epoch.
fn earth_field(value: &Value<'_>) -> Option<EarthField> {
    let table = value.table("`igrf`", &IGRF)?;
    let degree =
        table.read_or("degree", EarthField::MAX_DEGREE, |value| value.integer(1..=EarthField::MAX_DEGREE));
    let epoch = table.required("epoch", "epoch = \"2024-03-01T12:00:00\"")?;
    let text = epoch.text()?;
    let refuse = |message: String, label| {
        epoch.refuse(message, label, "write a date from 1900 to 2030, such as \"2024-03-01T12:00:00\"")
    };
    let at: Epoch = match text.parse() {
        Ok(at) => at,
        Err(error) => return refuse(format!("`epoch`: {error}"), "no epoch"),
    };
    let year = at.decimal_year();
    let [first, last] = EarthField::YEARS;
    if !(first..=last).contains(&year) {
        return refuse(
            format!("`epoch`: the main field of the Earth is known from {first} to {last}, not in {year:.1}"),
            "out of range",
        );
    }
    Some(EarthField { year, degree: degree?, sidereal: at.sidereal_angle() })
}

fn uniform_field(table: &Table<'_>) -> Option<MagneticField> {
    let help = "field = [0, 0, \"30 uT\"], or dipole = [0, 0, 7.8e15] and an orbit, or igrf = { epoch = \"2024-03-01\" } and an orbit";
    let field = table.required("field", help)?.vector(Dimension::MAGNETIC_FIELD);
    for key in ["orbit", "dipole_rate"] {
        if let Some(value) = table.get(key) {
            let message = format!("`{key}` goes with `dipole`, and this `field` is the same everywhere");
            return value.refuse(message, "not for this field", "leave out one of the two");
        }
    }
    Some(MagneticField::Uniform(field?))
}

/// Reads the orbit of a force that needs one.
fn required_orbit(table: &Table<'_>) -> Option<Orbit> {
    let example = "orbit = { body = \"Earth\", semi_major_axis = \"6778 km\", inclination = \"51.6 deg\" }";
    orbit(&table.required("orbit", example)?)
}

/// Note on the field of a model that nothing uses.
pub(super) fn unused(assembly: &Assembly) -> Option<String> {
    let common = assembly.magnetic_field.as_ref()?;
    let of_force = assembly.forces.iter().any(|force| match force.law.timed().0 {
        ForceLaw::MagneticDipole { field, .. } | ForceLaw::EddyCurrent { field, .. } => field == common,
        _ => false,
    });
    let used =
        of_force || !assembly.rods.is_empty() || assembly.controllers.iter().any(Controller::is_magnetic);
    (!used).then(|| {
        "[magnetic_field] acts on nothing: no force takes it, there is no rod, and no controller senses a field or commands a moment."
            .to_owned()
    })
}
