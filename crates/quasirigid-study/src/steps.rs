//! Bodies that other programs move step by step, from the start of a model.

use quasirigid::dynamics::{Form, FullStepper, Options, ReducedStepper, Start};
use quasirigid_io::model::System;
use quasirigid_math::rotation::ALIGNED;

use crate::error::StudyError;
use crate::export::{range, refuse};
use crate::histories::Doubts;
use crate::motion::Motion;
use crate::study::Study;

/// Reduced body for steps, with what is to be read before its numbers.
#[derive(Clone, Debug)]
pub struct ReducedSteps {
    /// The body; where `wrong` has a reason, its equations hold at no spin.
    pub stepper: ReducedStepper,
    /// Order of the equations.
    pub order: usize,
    /// Spins (rad/s) below which they hold, and from which they fail, in the direction of the start.
    pub range: [f64; 2],
    /// Reason for which the equations are not those of the body at its start.
    pub wrong: Option<String>,
    /// Notes.
    pub notes: Vec<String>,
}

impl Study {
    /// Reduced equations for steps under a torque, with an error allowed per step (1e-15 to 1e-2). (R22)
    ///
    /// # Errors
    /// [`StudyError::NotExported`] for a body whose equations have more than a torque in them, [`StudyError`] for an invalid start, and
    /// where the reduction fails.
    pub fn reduced_steps(&self, tolerance: f64) -> Result<ReducedSteps, StudyError> {
        self.left_alone("stepper")?;
        self.without_slugs("reduced equations")?;
        refuse(self)?;
        let motion = Motion::new(self, self.start_or_rest()?);
        let (order, doubts) = Doubts::before(&motion, System::Reduced, Form::AngularMomentum)?;
        let reduced = self.reduced(order)?;
        let start = motion.of_order(order).reduced_start(&reduced)?;
        let range = range(self, &reduced, start.omega)?;
        let holds = if doubts.wrong.is_some() { [0.0; 2] } else { range };
        let stepper = ReducedStepper::new(&reduced, start, tolerance)?.within(holds);
        let notes = doubts.remarks.iter().chain(&self.model.notes).cloned().collect();
        Ok(ReducedSteps { stepper, order, range, wrong: doubts.wrong, notes })
    }

    /// The full system for steps under a torque, with an error allowed per step (1e-15 to 1e-2).
    ///
    /// # Errors
    /// [`StudyError::Step`] for forces that change at given times, [`StudyError`] for an invalid start.
    pub fn full_stepper(&self, tolerance: f64) -> Result<FullStepper<'_>, StudyError> {
        self.uncontrolled("stepper")?;
        let motion = Motion::new(self, self.start_or_rest()?);
        let options = Options { tolerance, ..Options::default() };
        FullStepper::new(motion.system(), &motion.full()?, options).map_err(StudyError::Step)
    }

    /// Rotation of the start; rest where the model has none.
    pub(crate) fn start_or_rest(&self) -> Result<Start, StudyError> {
        match self.initial() {
            Err(StudyError::NoSpin { .. }) => Ok(Start::new([0.0; 3], ALIGNED)),
            found => found,
        }
    }
}
