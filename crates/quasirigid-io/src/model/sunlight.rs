//! Sunlight on a body: where the Sun stands, and the surface that its light falls on. (F27) to (F29)

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;

use quasirigid_body::force::{ForceLaw, SunPath};
use quasirigid_elements::{ApplicationPoint, Assembly, SunlitShape, UNRESOLVED_SUNLIGHT};

use super::surface::{closed, told};
use super::table::Table;
use super::trajectory::trajectory;
use crate::units::Dimension;

/// Error of the torque, of its root mean square, unless one is given.
const TOLERANCE: f64 = 0.01;
/// Tolerances that may be asked for.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-4..=0.1;
/// Radius of the Sun (m), nominal of the IAU (2015).
const SUN_RADIUS: f64 = 6.957e8;

/// What a force of sunlight refers to in the rest of the file, and the notes that it leaves.
pub(super) struct Sunlit<'s> {
    pub(super) name: &'s str,
    pub(super) folder: &'s Path,
    pub(super) assembly: &'s Assembly,
    pub(super) notes: RefCell<Vec<String>>,
}

/// Reads the pressure of sunlight on a surface.
pub(super) fn sunlight(table: &Table<'_>, around: &Sunlit<'_>) -> Option<ForceLaw<ApplicationPoint>> {
    let sun = sun_path(table, around.folder);
    let shadows = table.read_or("shadows", true, |value| value.boolean());
    let tolerance = table.read_or("tolerance", TOLERANCE, |value| {
        let number = value.quantity(Dimension::NUMBER)?;
        if TOLERANCES.contains(&number) {
            return Some(number);
        }
        value.refuse(
            format!("`tolerance` is {number}; the torque is computed to between 0.0001 and 0.1 of its root mean square"),
            "out of range",
            "leave it out for 0.01",
        )
    });
    let shape = shape(table, around, shadows?);
    let (sun, tolerance, shape) = (sun?, tolerance?, shape?);
    let (loads, accuracy) = shape.harmonics(tolerance);
    let kind = if shape.has_shadows() { " with their shadows" } else { "" };
    let doubt = if accuracy.error > UNRESOLVED_SUNLIGHT {
        ": it is a small rest of what the facets add up to, and MAY NOT HOLD"
    } else {
        ""
    };
    around.notes.borrow_mut().push(format!(
        "{:?}: the torque of sunlight on {} facets{kind} is a sum of harmonics up to degree {}, off by {:.2} % in the root mean square of all directions of the Sun, by {:.2} % at most{doubt}",
        around.name,
        shape.count(),
        loads.degree(),
        100.0 * accuracy.error,
        100.0 * accuracy.greatest,
    ));
    Some(ForceLaw::Sunlight { loads: Arc::new(loads), sun })
}

/// Reads where the Sun stands: a direction and a distance, or the centre of an orbit.
fn sun_path(table: &Table<'_>, folder: &Path) -> Option<SunPath> {
    let Some(direction) = table.get("direction") else {
        if let Some(distance) = table.get("distance") {
            let help = "add direction = [1, 0, 0], towards the Sun, or give an `orbit` about it alone";
            return distance.refuse(
                "`distance` is that of the Sun in a `direction`",
                "which direction?",
                help,
            );
        }
        let example = "orbit = { body = \"Sun\", semi_major_axis = \"1.2 au\" }, or direction = [1, 0, 0] and distance = \"1 au\"";
        table.required("orbit", example)?;
        return Some(SunPath::Orbit(trajectory(table, folder)?));
    };
    if let Some(orbit) = table.get("orbit") {
        let message = "the Sun is the centre of the `orbit`, which says where it stands";
        return orbit.refuse(message, "given twice", "leave out the `orbit`, or `direction` and `distance`");
    }
    let toward = direction.vector(Dimension::NUMBER);
    let distance = table.required("distance", "distance = \"1 au\"")?;
    let length = distance.positive(Dimension::LENGTH)?;
    if length < SUN_RADIUS {
        return distance.refuse(
            format!("`distance` is {length} m, and the radius of the Sun is {SUN_RADIUS} m"),
            "inside the Sun",
            "distances are in metres without a unit; write \"1 au\"",
        );
    }
    Some(SunPath::Fixed { direction: toward?, distance: length })
}

/// The surface in the light: that of a file, or that of the body.
fn shape(table: &Table<'_>, around: &Sunlit<'_>, shadows: bool) -> Option<SunlitShape> {
    if table.get("file").is_some() {
        let (surface, file) = closed(table, around.name, around.folder, "file = \"shape.obj\"")?;
        around.notes.borrow_mut().extend(told(&file));
        return Some(SunlitShape::of_surface(&surface, shadows));
    }
    let Assembly { ellipsoids, surfaces, .. } = around.assembly;
    match (&ellipsoids[..], &surfaces[..]) {
        ([ellipsoid], []) => Some(SunlitShape::of_ellipsoid(ellipsoid.semi_axes, ellipsoid.center)),
        ([], [surface]) => Some(SunlitShape::of_surface(&surface.surface, shadows)),
        _ => {
            table.required("file", "file = \"shape.obj\": light falls on a closed surface, and the body is not one [[surface]] or one [[ellipsoid]]");
            None
        }
    }
}
