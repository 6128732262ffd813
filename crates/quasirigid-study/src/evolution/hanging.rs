//! Evolution of bodies in which the spin alone restores some coordinates.
//! Equation (I13), docs/theory/02-invariants.md.

use quasirigid::dynamics::Start;
use quasirigid::modes::SpinMagnitude;
use quasirigid_math::vec3::norm;

use crate::error::StudyError;
use crate::steady::beside;
use crate::study::Study;

/// Angular velocity, in units of the spin, whose centrifugal force measures the springs that stand in for none: a share of 1e-8 of the stiffness.
const VANISHING: f64 = 1e-4;
/// Least stiffness of the spin, in units of that of a centrifugal force on the coordinate's own inertia, beside which such springs are nothing.
const RESTORED: f64 = 1e-4;

/// The study with next to no springs where the spin of a start alone restores a coordinate, which averages need; none where springs hold everything,
/// and where the steady spin beside the start hardly restores it.
pub fn sprung(study: &Study, start: Start) -> Result<Option<Study>, StudyError> {
    if study.body.hung().is_none() || !study.body.frictions().is_empty() {
        return Ok(None);
    }
    let spin = norm(start.omega);
    let steady = beside(study, start.omega, SpinMagnitude::Rate(spin));
    if !steady.is_ok_and(|steady| steady.restoration(&study.body) >= RESTORED) {
        return Ok(None);
    }
    let Ok(body) = study.body.sprung(VANISHING * spin) else { return Ok(None) };
    let mut sprung = Study::new(study.model.clone(), Some(study.order))?;
    sprung.body = body;
    sprung.order_given = study.order_given;
    Ok(Some(sprung))
}

/// Note on the springs that stand in for none.
pub fn note(study: &Study) -> Option<String> {
    let hung = study.body.hung()?;
    Some(format!(
        "No spring restores {}: the averages are those with a spring of 1e-8 of the centrifugal stiffness, which changes no digit shown.",
        hung.names()
    ))
}
