//! The reduced equations, for people and machines.

use std::borrow::Cow;
use std::sync::Arc;

use quasirigid::dynamics::{Forced, Form, RigidState, Start, forced_torque, takes};
use quasirigid::model::{FlexibleBody, ReducedBody, Support};
use quasirigid::reduction::{ReductionError, degree_sizes, frequencies, reduce};
use quasirigid_io::export::{Derived, DisplacedLoads, Forces, Mechanism, StartLoads};

use crate::error::StudyError;
use crate::motion::Motion;
use crate::study::Study;

/// The reduced equations of a study.
#[derive(Debug)]
pub struct Equations<'a> {
    study: &'a Study,
    reduced: Arc<ReducedBody>,
    frequencies: Cow<'a, [f64]>,
    mechanisms: Vec<Mechanism>,
    forces: Option<Forces>,
}

impl Equations<'_> {
    /// The polynomials.
    #[must_use]
    pub fn reduced(&self) -> &ReducedBody {
        &self.reduced
    }

    /// Tables for people.
    #[must_use]
    pub fn text(&self) -> String {
        self.derived().text()
    }

    /// One JSON object with every coefficient.
    #[must_use]
    pub fn json(&self) -> String {
        self.derived().json()
    }

    /// Displays for a document that loads amsmath.
    #[must_use]
    pub fn latex(&self) -> String {
        self.derived().latex()
    }

    fn derived(&self) -> Derived<'_> {
        Derived {
            name: &self.study.model.name,
            body: &self.study.body,
            reduced: &self.reduced,
            frequencies: &self.frequencies,
            mechanisms: &self.mechanisms,
            forces: self.forces.as_ref(),
        }
    }
}

impl Study {
    /// Derives the reduced equations.
    ///
    /// # Errors
    /// [`StudyError::Reduction`] and [`StudyError::Vibration`].
    pub fn derive(&self) -> Result<Equations<'_>, StudyError> {
        self.undriven("derive")?;
        self.without_slugs("derive")?;
        let Study { body, order, .. } = self;
        Ok(Equations {
            study: self,
            reduced: self.reduced(*order)?,
            frequencies: Cow::Owned(frequencies(body)?),
            mechanisms: mechanisms(body, *order)?,
            forces: acting(self, self.initial().ok()),
        })
    }
}

/// Equations of a known reduction, without the comparison of the mechanisms.
pub(crate) fn of_reduced<'a>(
    study: &'a Study,
    reduced: Arc<ReducedBody>,
    frequencies: &'a [f64],
    start: Option<Start>,
) -> Equations<'a> {
    Equations {
        study,
        reduced,
        frequencies: Cow::Borrowed(frequencies),
        mechanisms: Vec::new(),
        forces: acting(study, start),
    }
}

/// Forces on the body, and their loads at the start; none where nothing acts.
pub(crate) fn acting(study: &Study, start: Option<Start>) -> Option<Forces> {
    let Study { body, forces, order, .. } = study;
    let system = Forced { body, forces };
    let driven = matches!(body.support(), Support::Prescribed { .. }).then(|| "a driven pole".to_owned());
    let motors = (!body.wheels().driven.is_empty()).then(|| "the motors of wheels".to_owned());
    let names = forces.iter().map(|force| force.name.clone()).chain(driven).chain(motors).collect();
    system.acts().then(|| Forces { names, start: start.map(|spin| at_start(system, study, spin, *order)) })
}

fn at_start(system: Forced, study: &Study, spin: Start, order: usize) -> StartLoads {
    let Start { omega, attitude, place, velocity } = Motion::new(study, spin).start;
    let state = RigidState { t: 0.0, omega, attitude, pole: place, pole_velocity: velocity };
    let torque = forced_torque(system, order, &state);
    let displaced = takes(system, Form::AngularVelocity, order.min(3)).then_some(DisplacedLoads {
        moment_variation: torque.moment_variation,
        mu: torque.mu,
        force_variation: torque.force_variation,
        phi: torque.phi,
        displacements: torque.q,
    });
    StartLoads { angular_velocity: omega, moment: torque.moment, force: torque.force, displaced }
}

/// Mechanisms, inside and elastic, each with the other locked, of a body that has both.
fn mechanisms(body: &FlexibleBody, order: usize) -> Result<Vec<Mechanism>, ReductionError> {
    if body.elastic() == 0 || body.cyclic().is_empty() {
        return Ok(Vec::new());
    }
    let alone = |name, part: &FlexibleBody| {
        let sizes = degree_sizes(&reduce(part, order)?, [1.0, 0.0, 0.0]);
        Ok(Mechanism { name, sizes: sizes.iter().map(|each| (each.degree, each.size)).collect() })
    };
    Ok(vec![
        alone("liquids and rotors", &body.stiff_outside())?,
        alone("springs and dashpots", &body.locked_inside())?,
    ])
}
