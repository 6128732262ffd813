//! What the equations of motion leave out of a body, in words.

use quasirigid::model::Principal;
use quasirigid::modes::{Given, RelativeEquilibrium, SpinMode, SpinModes};
use quasirigid::secular::apart;
use quasirigid_math::vec3::norm;

use crate::liquids::unanswered;
use crate::study::Study;
use crate::words::significant;

/// Share of a decay that what no equation of motion holds may have.
pub const LEFT_OUT: f64 = 0.02;

const LOSSLESS: &str = "Part of the body loses energy by a law of its material that no equation of motion holds: the full and the \
                        reduced system take it as elastic, and `evolve` alone counts its loss.";

/// What the equations of motion leave out.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// Of materials, which they take as elastic.
    pub materials: Option<&'static str>,
    /// Of liquids, whose part in what the spin does they get wrong.
    pub liquids: Option<String>,
}

impl LeftOut {
    /// At an angular velocity (rad/s), with the modes about the steady spin next to it where they are known.
    pub fn at(study: &Study, omega: [f64; 3], known: Option<SpinModes>) -> Self {
        Self {
            materials: (!study.body.lossy().is_empty()).then_some(LOSSLESS),
            liquids: if study.model.assembly.cavities.is_empty() || norm(omega) == 0.0 {
                None
            } else {
                liquids(study, omega, known.or_else(|| about(study, omega)))
            },
        }
    }

    /// In words.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.materials.map(String::from).into_iter().chain(self.liquids.clone()).collect()
    }
}

/// Share of the decay of a nutation that the equations of motion leave out; infinite where it is not known.
pub fn of_nutation(nutation: &SpinMode) -> f64 {
    let [decay, _] = nutation.of_motion;
    apart(decay, nutation.decay_rate)
}

/// The modes about the axis of extreme inertia next to an angular velocity.
fn about(study: &Study, omega: [f64; 3]) -> Option<SpinModes> {
    let [mode, _] = Principal::compute(study.body.invariants().J).nearest(omega);
    let steady = RelativeEquilibrium::extreme(&study.body, mode, Given::Rate(norm(omega))).ok()?;
    SpinModes::about(&study.body, steady).ok()
}

/// What is wrong with the liquids about the axis of extreme inertia next to an angular velocity; none if they are right.
fn liquids(study: &Study, omega: [f64; 3], modes: Option<SpinModes>) -> Option<String> {
    let nutation = modes.as_ref().and_then(SpinModes::nutation);
    let why = "The equations of motion hold liquids by their slow flow and a few relaxations, without the Coriolis force";
    let (spin, frequency) = match (&modes, nutation) {
        (Some(modes), Some(nutation)) => (modes.equilibrium.omega, nutation.frequency),
        _ => (omega, 0.0),
    };
    if unanswered(study, spin, frequency).is_some() {
        return Some(format!("{why}, which is not right at this Reynolds number."));
    }
    let Some(nutation) = nutation else {
        let slow = study.liquids.iter().all(|liquid| liquid.reynolds(norm(omega)) <= 1.0);
        return (!slow).then(|| format!("{why}, and there is no nutation to tell how much that is."));
    };
    let share = of_nutation(nutation);
    (share > LEFT_OUT).then(|| {
        format!("{why}: by them a small wobble at this spin changes at a rate that is {} % off. The commands modes and evolve have the rate.", significant(100.0 * share, 2))
    })
}
