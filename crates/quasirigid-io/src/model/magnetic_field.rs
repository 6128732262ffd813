//! Magnetic fields of forces: uniform, or of a dipole at the centre of an orbit. (F8)

use quasirigid_body::force::{MagneticField, Orbit};

use super::orbit::orbit;
use super::table::Table;
use crate::units::Dimension;

/// Reads the field of a force.
pub(super) fn magnetic_field(table: &Table<'_>) -> Option<MagneticField> {
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

fn uniform_field(table: &Table<'_>) -> Option<MagneticField> {
    let help = "field = [0, 0, \"30 uT\"], or dipole = [0, 0, 7.8e15] and an orbit";
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
pub(super) fn required_orbit(table: &Table<'_>) -> Option<Orbit> {
    let example = "orbit = { body = \"Earth\", semi_major_axis = \"6778 km\", inclination = \"51.6 deg\" }";
    orbit(&table.required("orbit", example)?)
}
