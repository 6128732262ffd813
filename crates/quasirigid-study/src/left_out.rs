//! Losses that the equations of motion leave out of a body, in words.

use quasirigid::model::Principal;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid::secular::choice::{Limits, loss_left_out};
use quasirigid_math::vec3::norm;

use crate::liquids::unanswered;
use crate::materials::flowing_at;
use crate::study::Study;
use crate::words::significant;

const LOSSLESS: &str = "Part of the body loses energy by a law of its material that is known only per frequency: `evolve` and `modes` \
                        include this loss, histories of the full and the reduced system take that part as elastic.";

/// Losses that the equations of motion leave out.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// Loss of materials that the equations take as elastic.
    pub materials: Option<&'static str>,
    /// Material that is no solid in this motion, which the equations take as elastic. (G16)
    pub flow: Option<String>,
    /// Effect of liquids that the equations get wrong.
    pub liquids: Option<String>,
}

impl LeftOut {
    /// Losses left out at an angular velocity (rad/s), with the modes about the steady spin next to it where these are known.
    pub fn at(study: &Study, omega: [f64; 3], known: Option<SpinModes>) -> Self {
        Self {
            materials: (!study.body.viscoelastic().is_empty()).then_some(LOSSLESS),
            flow: flowing_at(study, omega).map(|why| format!("NO SOLID: {why}.")),
            liquids: if study.model.assembly.cavities.is_empty() || norm(omega) == 0.0 {
                None
            } else {
                liquids(study, omega, known.or_else(|| about(study, omega)))
            },
        }
    }

    /// Notes on the losses.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.flow.iter().cloned().chain(self.losses()).collect()
    }

    /// Notes on the losses that the equations leave out, without a material that is no solid.
    pub fn losses(&self) -> impl Iterator<Item = String> {
        self.materials.map(String::from).into_iter().chain(self.liquids.clone())
    }

    /// Reason for which the equations of motion are not those of the body.
    #[must_use]
    pub fn wrong(&self) -> Option<&str> {
        self.flow.as_deref().or(self.liquids.as_deref())
    }
}

/// The modes about the axis of extreme inertia next to an angular velocity.
fn about(study: &Study, omega: [f64; 3]) -> Option<SpinModes> {
    let [mode, _] = Principal::compute(study.body.invariants().J).nearest(omega);
    let steady =
        RelativeEquilibrium::extreme_towards(&study.body, mode, SpinMagnitude::Rate(norm(omega)), omega)
            .ok()?;
    SpinModes::about(&study.body, steady).ok()
}

/// Error of the liquids about the axis of extreme inertia next to an angular velocity, in words; none if they are right.
fn liquids(study: &Study, omega: [f64; 3], modes: Option<SpinModes>) -> Option<String> {
    let (kind, nutation) = (study.model.kind, modes.as_ref().and_then(SpinModes::nutation));
    let why = "The equations of motion describe liquids by slow flow and a few relaxations, without the Coriolis force";
    let (spin, frequency) = match (&modes, nutation) {
        (Some(modes), Some(nutation)) => (modes.equilibrium.omega, nutation.frequency),
        _ => (omega, 0.0),
    };
    if unanswered(study, spin, frequency).is_some() {
        return Some(format!("{why}, which is not right at this Reynolds number."));
    }
    let Some(nutation) = nutation else {
        let slow = study.liquids.iter().all(|liquid| liquid.reynolds(norm(omega)) <= 1.0);
        return (!slow)
            .then(|| format!("{why}; there is no {} by which to judge the error.", kind.nutation()));
    };
    let share = loss_left_out(nutation);
    (share > Limits::default().losses_left_out).then(|| {
        format!(
            "{why}: with them the rate of a small {} at this spin is off by {} %. The commands modes and evolve give the rate.",
            kind.nutation(),
            significant(100.0 * share, 2)
        )
    })
}
