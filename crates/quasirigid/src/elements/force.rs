//! What the laws of external forces may say.

use super::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use super::{Assembly, Station, coefficient};
use crate::model::force::{Force, Law, MagneticField, Orbit, Wave};

/// Accepts a force on a body.
pub(super) fn check(index: usize, force: &Force<Station>, body: &Assembly) -> Result<(), ElementError> {
    let place = ElementKind::Force.at(index);
    let finite = |field: Field, values: &[f64; 3]| coefficient::finite(values).map_err(at(place, field));
    if let Some(station) = force.law.place() {
        station.check(place, body)?;
    }
    match &force.law {
        Law::UniformGravity { acceleration } => finite(Field::Acceleration, acceleration),
        Law::CentralGravity { orbit } => on_orbit(place, orbit),
        Law::Drag { coefficient, .. } | Law::SpinDrag { coefficient } => {
            not_driving(*coefficient).map_err(at(place, Field::Coefficient))
        }
        Law::Torque { torque, wave, .. } => {
            finite(Field::Torque, torque)?;
            varying(place, wave)
        }
        Law::Thrust { force, wave, .. } => {
            finite(Field::Force, force)?;
            varying(place, wave)
        }
        Law::MagneticDipole { moment, field } => {
            finite(Field::Moment, moment)?;
            match field {
                MagneticField::Uniform(field) => finite(Field::MagneticField, field),
                MagneticField::Dipole { strength, orbit } => {
                    finite(Field::Dipole, strength)?;
                    on_orbit(place, orbit)
                }
            }
        }
        Law::Expression { .. } | Law::TorqueExpression { .. } => Ok(()),
    }
}

fn on_orbit(place: ElementId, orbit: &Orbit) -> Result<(), ElementError> {
    coefficient::positive(orbit.parameter).map_err(at(place, Field::GravitationalParameter))?;
    coefficient::positive(orbit.semi_major_axis).map_err(at(place, Field::SemiMajorAxis))?;
    elliptic(orbit.eccentricity).map_err(at(place, Field::Eccentricity))?;
    let angles = [
        (Field::Inclination, orbit.inclination),
        (Field::Node, orbit.node),
        (Field::Periapsis, orbit.periapsis),
        (Field::MeanAnomaly, orbit.mean_anomaly),
    ];
    angles.into_iter().try_for_each(|(field, angle)| coefficient::finite(&[angle]).map_err(at(place, field)))
}

fn varying(place: ElementId, wave: &Wave) -> Result<(), ElementError> {
    coefficient::finite(&[wave.frequency]).map_err(at(place, Field::Frequency))?;
    coefficient::finite(&[wave.phase]).map_err(at(place, Field::Phase))
}

fn not_driving(value: f64) -> Result<(), Problem> {
    coefficient::finite(&[value])?;
    if value >= 0.0 { Ok(()) } else { Err(Problem::Driving { value }) }
}

fn elliptic(value: f64) -> Result<(), Problem> {
    coefficient::finite(&[value])?;
    if (0.0..1.0).contains(&value) { Ok(()) } else { Err(Problem::NotElliptic { value }) }
}
