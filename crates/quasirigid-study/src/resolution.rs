//! Resolution of the shape of a solid, in words and numbers.

use quasirigid::elements::{Approximation, Resolution};
use quasirigid_io::record::ResolutionRecord;

use crate::words::significant;

/// Relative error of the dissipation from which a note is given.
const NOTABLE: f64 = 0.05;
/// Error from which no answer holds.
pub const NOTHING: f64 = 0.5;

/// For a record, and for machines.
pub fn record(name: &str, resolution: &Resolution) -> ResolutionRecord {
    let (degree, cells) = match resolution.approximation {
        Approximation::Polynomials { degree } => (Some(degree), None),
        Approximation::Elements { cells, .. } => (None, Some(cells)),
    };
    let error = Some(resolution.error).filter(|error| error.is_finite());
    ResolutionRecord { degree, cells, error, sentence: sentence(name, resolution) }
}

/// Approximation of the solid, and its error.
fn sentence(name: &str, resolution: &Resolution) -> String {
    let by = match resolution.approximation {
        Approximation::Polynomials { degree } => format!("polynomials of degree {degree}"),
        Approximation::Elements { cells, .. } => format!("finite elements in {cells} cells"),
    };
    format!("{name:?}: {by}; {}.", known(resolution.error))
}

/// Note to read before the numbers; none where the shape is well resolved.
pub fn note(name: &str, resolution: &Resolution) -> Option<String> {
    let advice = match resolution.approximation {
        Approximation::Polynomials { .. } => "leave `degree` out, or describe the body by a [[solid]]",
        Approximation::Elements { .. } => {
            "raise `cells`, or describe the body by a [[solid]] with a finer mesh at its neck"
        }
    };
    let notable = !(resolution.error <= NOTABLE);
    notable
        .then(|| format!("The shape of {name:?} is hard to resolve: {}; {advice}.", known(resolution.error)))
}

/// Error of the dissipation, in words.
pub fn known(error: f64) -> String {
    if error.is_finite() {
        format!("its dissipation, and times with it, are known to about {} %", significant(100.0 * error, 2))
    } else {
        "nothing bounds the error of its dissipation".into()
    }
}
