//! Bodies with parts that drives move: the system that carries them, what refuses them, and the body with these parts locked.
//! Equations (T7) to (T11), docs/theory/08-full-system.md.

use quasirigid::dynamics::PropagateError;
use quasirigid::elements::PrescribedMotion;
use quasirigid_io::model::{Model, System};

use crate::error::StudyError;
use crate::study::Study;

impl Study {
    /// Refuses an answer about a body at rest or in a steady spin, which drives do not leave alone.
    pub(crate) fn undriven(&self, what: &'static str) -> Result<(), StudyError> {
        if self.body.drives().is_empty() {
            return Ok(());
        }
        let names = self.body.drives().iter().map(|drive| drive.name.clone()).collect();
        Err(StudyError::Driven { names, what })
    }

    /// Refuses an answer in which neither controllers nor drives take part.
    pub(crate) fn left_alone(&self, what: &'static str) -> Result<(), StudyError> {
        self.uncontrolled(what)?;
        self.undriven(what)
    }

    /// System of a history without a given one: the reduced, of a body with driven parts the full.
    #[must_use]
    pub fn usual_system(&self) -> System {
        if self.body.drives().is_empty() { System::Reduced } else { System::Full }
    }

    /// Error of a propagation, with the name of the part whose law is at fault.
    pub(crate) fn told_of(&self, error: PropagateError) -> StudyError {
        let PropagateError::Drive { coordinate, fault } = error else { return error.into() };
        let drive = self.body.drives().iter().find(|drive| drive.coordinate == coordinate);
        drive.map_or(error.into(), |drive| StudyError::Drive { name: drive.name.clone(), fault })
    }
}

/// Accepts a system that carries the driven parts of a study.
pub fn carries(study: &Study, system: System) -> Result<(), StudyError> {
    match system {
        System::Full => Ok(()),
        System::Reduced => study.undriven("the reduced system"),
        System::SpinManifold => study.undriven("the system about a spin"),
        System::Rigid => study.undriven("the rigid system"),
    }
}

/// Locks the driven parts of a model where they are at the start.
pub fn lock(model: &mut Model) {
    let lock = |motion: &mut PrescribedMotion| *motion = PrescribedMotion::Constant(motion.at_start());
    let assembly = &mut model.assembly;
    assembly.hinged.iter_mut().filter_map(|part| part.angle.as_mut()).for_each(lock);
    assembly.booms.iter_mut().for_each(|boom| lock(&mut boom.length));
}
