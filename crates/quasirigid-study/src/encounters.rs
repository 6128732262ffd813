//! Limits of the gravity gradient past a planet, in words: the size of the body against the distance, and the rows of a table.
//! (F4), (F26), docs/theory/07-forces.md.

use quasirigid::model::force::{Ephemeris, Force, ForceLaw, Trajectory};
use quasirigid::model::{FlexibleBody, Marker, Principal};

use crate::error::StudyError;
use crate::words::{MAY_NOT_HOLD, significant};

/// Ratio of size and distance from which the first terms left out are told.
const NOTABLE: f64 = 0.01;
/// Error of the places of a table, relative to the distance, that is told.
const LARGEST_ERROR: f64 = 1e-6;
/// Ratio of the acceleration in a table to the attraction, or its inverse, from which units and centre are doubted.
const OTHER_ACCELERATION: f64 = 2.0;

/// Refuses paths through the body itself, and notes where the gradient alone does not tell the torque to a percent, or a table the path.
pub fn notes(body: &FlexibleBody, forces: &[Force<Marker>]) -> Result<Vec<String>, StudyError> {
    let mut notes = Vec::new();
    let size = size(body);
    for Force { name, law } in forces {
        let (ForceLaw::CentralGravity { orbit }, _) = law.timed() else { continue };
        let nearest = orbit.nearest();
        if nearest <= size {
            return Err(StudyError::Engulfed { name: name.clone(), size, nearest });
        }
        let ratio = size / nearest;
        if ratio > NOTABLE {
            notes.push(format!(
                "{MAY_NOT_HOLD}: the force {name:?} is the gradient of gravity at the centre of mass, and the next terms are smaller by about the size of the body over the distance, {} m over {} m at the nearest, {} %",
                significant(size, 3),
                significant(nearest, 4),
                significant(100.0 * ratio, 2)
            ));
        }
        if let Trajectory::Table(table) = orbit {
            notes.extend(of_table(name, table));
        }
    }
    Ok(notes)
}

/// What is to be known of a table of places.
fn of_table(name: &str, table: &Ephemeris) -> Vec<String> {
    let mut notes = Vec::new();
    let (nearest, attracted) = table.nearest();
    if !(OTHER_ACCELERATION.recip()..OTHER_ACCELERATION).contains(&attracted) {
        notes.push(format!(
            "{MAY_NOT_HOLD}: at its nearest, {} m from the centre, the path in the table of the force {name:?} falls {} times as fast as the centre attracts it; check the units of t, x, y and z (s and m), and that the places are from the centre of attraction",
            significant(nearest, 4),
            significant(attracted, 3)
        ));
    }
    if table.error() > LARGEST_ERROR {
        notes.push(format!(
            "the path of the force {name:?} between the rows of its table is good to about {} of the distance, the torque to three times that",
            significant(table.error(), 2)
        ));
    }
    notes
}

/// Largest semi-axis (m) of the homogeneous ellipsoid with the mass and the moments of a body.
fn size(body: &FlexibleBody) -> f64 {
    let invariants = body.invariants();
    let [least, middle, greatest] = Principal::compute(invariants.J).moments;
    (2.5 * (middle + greatest - least) / invariants.mass).sqrt()
}
