//! Materials in the motion asked for, in words. Equations (G16), (G21), docs/theory/11-materials.md.

use quasirigid::averaging::{FreeRotation, Response, RotationState};
use quasirigid::model::Viscoelastic;
use quasirigid_math::vec3::norm;

use crate::study::Study;
use crate::words::{MAY_NOT_HOLD, significant, time};

/// Tangent of the loss angle above which more is lost in a radian than is stored, as in a liquid.
const LIQUID: f64 = 1.0;

/// Time of a Kelvin–Voigt material, in units of the reciprocal of the spin, below which no harmonic of note has a loss angle above 45 degrees.
const SPRING: f64 = 0.05;

/// Reason why a material is no solid at the harmonics of a rotation; none if all are. (G16)
pub fn flowing(response: &Response, motion: &FreeRotation) -> Option<String> {
    RotationState::from_motion(motion)?;
    let driven = response.driven_materials(motion);
    let worst = driven.into_iter().max_by(|a, b| a.loss.total_cmp(&b.loss))?;
    (worst.loss > LIQUID).then(|| {
        format!(
            "the material of {} {}: at {} rad/s, a harmonic of it, its modulus is {} of the one given and \
             its loss angle {} degrees, above 45 (Q = {}, below 1)",
            worst.name,
            if worst.modulus > 1.0 {
                "resists this motion as a dashpot, not as a spring"
            } else {
                "flows in this motion like a liquid"
            },
            significant(worst.frequency, 3),
            significant(worst.modulus, 3),
            significant(worst.loss.atan().to_degrees(), 3),
            significant(worst.loss.recip(), 2)
        )
    })
}

/// The same at the free rotation of the frozen body with an angular velocity (rad/s, body axes).
pub fn flowing_at(study: &Study, omega: [f64; 3]) -> Option<String> {
    let longest = study.body.dissipators().iter().filter_map(|part| part.kelvin_voigt).fold(0.0, f64::max);
    let viscous = !(longest * norm(omega) > SPRING);
    if (study.body.viscoelastic().is_empty() && viscous) || norm(omega) == 0.0 {
        return None;
    }
    let response = Response::compute(&study.body).ok()?;
    let principal = response.principal();
    let motion = FreeRotation::through(principal.moments, principal.components(omega)).ok()?;
    flowing(&response, &motion)
}

/// Change of the inertia by flow, over the difference of its greatest and least moment, from which another body rotates.
const ANOTHER_BODY: f64 = 0.1;

/// Note on a material that flows without end under the mean load of the rotation at the start; none if none does. (G21)
pub fn flow_note(study: &Study) -> Option<String> {
    let omega = study.initial().ok()?.omega;
    let viscous = |part: &Viscoelastic| part.rheology.viscous_time().is_some();
    if norm(omega) == 0.0 || !study.body.viscoelastic().iter().any(viscous) {
        return None;
    }
    let response = Response::compute(&study.body).ok()?;
    let principal = response.principal();
    let motion = FreeRotation::through(principal.moments, principal.components(omega)).ok()?;
    let flow = response.material_flow(&motion, ANOTHER_BODY)?;
    Some(format!(
        "{MAY_NOT_HOLD} beyond {}: the mean load of this rotation strains the material of {} without end, and has then changed the inertia by {} % of the \
         difference of its greatest and least moment; no answer follows this flow.",
        time(flow.time),
        flow.name,
        significant(100.0 * ANOTHER_BODY, 2)
    ))
}
