//! External forces as elements: checks of their laws.

use crate::element::{AttachmentPoint, Element};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::kinds::coefficient::matrix;
use crate::model::force::{
    Conic, EarthField, Force, ForceLaw, MagneticField, Orbit, SunPath, Trajectory, Wave,
};
use crate::number;
use crate::{ApplicationPoint, Assembly, Coefficient};

impl Element for Force<ApplicationPoint> {
    fn check(&self, id: ElementId, body: &Assembly) -> Vec<ElementError> {
        check(id, self, body).err().into_iter().collect()
    }

    fn attachment_points(&self) -> Vec<AttachmentPoint> {
        let moment = self.law.turns_with_place();
        let place = self.law.place().map(|at| AttachmentPoint { field: Field::ON, end: at.on, moment });
        place.into_iter().collect()
    }
}

/// Accepts a force on a body.
pub(crate) fn check(
    place: ElementId,
    force: &Force<ApplicationPoint>,
    body: &Assembly,
) -> Result<(), ElementError> {
    if let Some(application_point) = force.law.place() {
        application_point.check(place, body)?;
    }
    lawful(place, &force.law, body.magnetic_field.as_ref())
}

/// Accepts a law; a field that is that of the body is accepted with the body.
fn lawful(
    place: ElementId,
    law: &ForceLaw<ApplicationPoint>,
    common: Option<&MagneticField>,
) -> Result<(), ElementError> {
    let magnetic = |field| if Some(field) == common { Ok(()) } else { magnetic(place, field) };
    let finite = |field: Field, values: &[f64; 3]| number::finite(values).map_err(at(place, field));
    match law {
        ForceLaw::UniformGravity { acceleration } => finite(Field::ACCELERATION, acceleration),
        ForceLaw::CentralGravity { orbit } => on_trajectory(place, orbit),
        ForceLaw::Drag { coefficient, .. } | ForceLaw::SpinDrag { coefficient } => {
            not_driving(*coefficient).map_err(at(place, Field::COEFFICIENT))
        }
        ForceLaw::Torque { torque, wave, .. } => {
            finite(Field::TORQUE, torque)?;
            varying(place, wave)
        }
        ForceLaw::Thrust { force, wave, .. } => {
            finite(Field::FORCE, force)?;
            varying(place, wave)
        }
        ForceLaw::MagneticDipole { moment, field } => {
            finite(Field::MOMENT, moment)?;
            magnetic(field)
        }
        ForceLaw::EddyCurrent { tensor, decay_time, field } => {
            number::finite(&[*decay_time]).map_err(at(place, Field::CONDUCTIVITY))?;
            matrix(Coefficient::Full(*tensor)).map_err(conducting).map_err(at(place, Field::TENSOR))?;
            magnetic(field)
        }
        ForceLaw::Sunlight { sun, .. } => in_sunlight(place, sun),
        ForceLaw::Expression { .. }
        | ForceLaw::TorqueExpression { .. }
        | ForceLaw::TorqueTable { .. }
        | ForceLaw::ForceTable { .. } => Ok(()),
        ForceLaw::During { law, .. } => lawful(place, law, common),
    }
}

/// Accepts a magnetic field.
pub(crate) fn magnetic(place: ElementId, field: &MagneticField) -> Result<(), ElementError> {
    let finite = |field: Field, values: &[f64]| number::finite(values).map_err(at(place, field));
    match field {
        MagneticField::Uniform(field) => finite(Field::MAGNETIC_FIELD, field),
        MagneticField::Dipole { strength, rate, orbit } => {
            finite(Field::DIPOLE, strength)?;
            finite(Field::DIPOLE_RATE, &[*rate])?;
            on_orbit(place, orbit)
        }
        MagneticField::Earth { field: EarthField { year, degree, sidereal }, orbit } => {
            finite(Field::IGRF, &[*year, *sidereal])?;
            let [first, last] = EarthField::YEARS;
            if !(first..=last).contains(year) || !(1..=EarthField::MAX_DEGREE).contains(degree) {
                return Err(at(place, Field::IGRF)(Problem::NoMainField { year: *year, degree: *degree }));
            }
            on_orbit(place, orbit)?;
            above_the_earth(orbit).map_err(at(place, Field::IGRF))
        }
    }
}

/// Accepts a place of the Sun.
fn in_sunlight(place: ElementId, sun: &SunPath) -> Result<(), ElementError> {
    match sun {
        SunPath::Fixed { direction, distance } => {
            number::unit(*direction).map_err(at(place, Field::DIRECTION))?;
            number::positive(*distance).map_err(at(place, Field::DISTANCE))
        }
        SunPath::Orbit(path) => {
            on_trajectory(place, path)?;
            if (path.mu() / SUN_PARAMETER - 1.0).abs() > OTHER_CENTRE {
                return Err(at(place, Field::GRAVITATIONAL_PARAMETER)(Problem::NotTheSun { mu: path.mu() }));
            }
            Ok(())
        }
    }
}

/// Gravitational parameter of the Sun (m³/s²), DE440.
const SUN_PARAMETER: f64 = 1.327_124_400_41e20;

/// Problem of a matrix in the words of a conductor.
fn conducting(problem: Problem) -> Problem {
    match problem {
        Problem::Indefinite { eigenvalue } => Problem::Powered { eigenvalue },
        other => other,
    }
}

fn on_trajectory(place: ElementId, path: &Trajectory) -> Result<(), ElementError> {
    match path {
        Trajectory::Orbit(orbit) => on_orbit(place, orbit),
        Trajectory::Conic(conic) => on_conic(place, conic),
        Trajectory::Table(table) => {
            number::positive(table.mu()).map_err(at(place, Field::GRAVITATIONAL_PARAMETER))
        }
    }
}

fn on_conic(place: ElementId, conic: &Conic) -> Result<(), ElementError> {
    number::positive(conic.mu).map_err(at(place, Field::GRAVITATIONAL_PARAMETER))?;
    number::positive(conic.periapsis_distance).map_err(at(place, Field::PERIAPSIS_DISTANCE))?;
    of_conic(conic.eccentricity).map_err(at(place, Field::ECCENTRICITY))?;
    let others = [
        (Field::INCLINATION, conic.inclination),
        (Field::NODE, conic.raan),
        (Field::PERIAPSIS, conic.argument_of_periapsis),
        (Field::TIME_OF_PERIAPSIS, conic.time_of_periapsis),
    ];
    others.into_iter().try_for_each(|(field, value)| number::finite(&[value]).map_err(at(place, field)))
}

fn on_orbit(place: ElementId, orbit: &Orbit) -> Result<(), ElementError> {
    number::positive(orbit.mu).map_err(at(place, Field::GRAVITATIONAL_PARAMETER))?;
    number::positive(orbit.semi_major_axis).map_err(at(place, Field::SEMI_MAJOR_AXIS))?;
    elliptic(orbit.eccentricity).map_err(at(place, Field::ECCENTRICITY))?;
    let angles = [
        (Field::INCLINATION, orbit.inclination),
        (Field::NODE, orbit.raan),
        (Field::PERIAPSIS, orbit.argument_of_periapsis),
        (Field::MEAN_ANOMALY, orbit.mean_anomaly),
    ];
    angles.into_iter().try_for_each(|(field, angle)| number::finite(&[angle]).map_err(at(place, field)))?;
    number::finite(&[orbit.node_rate, orbit.periapsis_rate]).map_err(at(place, Field::PRECESSION))
}

/// Difference of gravitational parameters, relative, from which a centre is not the Earth, or the Sun.
const OTHER_CENTRE: f64 = 0.01;

/// Accepts an orbit about the Earth that stays above its surface.
fn above_the_earth(orbit: &Orbit) -> Result<(), Problem> {
    if (orbit.mu / Orbit::EARTH_PARAMETER - 1.0).abs() > OTHER_CENTRE {
        return Err(Problem::NotTheEarth { mu: orbit.mu });
    }
    let nearest = orbit.semi_major_axis * (1.0 - orbit.eccentricity);
    if nearest < EarthField::LEAST_RADIUS { Err(Problem::Underground { nearest }) } else { Ok(()) }
}

fn varying(place: ElementId, wave: &Wave) -> Result<(), ElementError> {
    number::finite(&[wave.frequency]).map_err(at(place, Field::FREQUENCY))?;
    number::finite(&[wave.phase]).map_err(at(place, Field::PHASE))
}

fn not_driving(value: f64) -> Result<(), Problem> {
    number::finite(&[value])?;
    if value >= 0.0 { Ok(()) } else { Err(Problem::Driving { value }) }
}

fn elliptic(value: f64) -> Result<(), Problem> {
    number::finite(&[value])?;
    if (0.0..1.0).contains(&value) { Ok(()) } else { Err(Problem::NotElliptic { value }) }
}

fn of_conic(value: f64) -> Result<(), Problem> {
    number::finite(&[value])?;
    if value >= 0.0 { Ok(()) } else { Err(Problem::NoConic { value }) }
}
