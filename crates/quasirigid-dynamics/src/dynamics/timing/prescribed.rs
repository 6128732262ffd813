//! Forces and torques that are functions of time alone, in their own axes.

use crate::dynamics::external::Forced;
use crate::math::expression::Expression;
use crate::math::vec3::scale;
use crate::model::Marker;
use crate::model::force::{ForceLaw, TIME, VARIABLES, Windows};

/// Force or torque that depends on time alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prescribed<'a> {
    /// Index of the force.
    pub force: usize,
    law: &'a ForceLaw<Marker>,
    windows: Option<&'a Windows>,
}

/// True if a formula depends on the time.
pub(super) fn varies(formulas: &[Expression; 3]) -> bool {
    formulas.iter().any(|formula| formula.uses(TIME))
}

/// True if a formula depends on nothing but the time.
fn alone(formulas: &[Expression; 3]) -> bool {
    let others = |formula: &Expression| (0..VARIABLES).any(|i| i != TIME && formula.uses(i));
    varies(formulas) && !formulas.iter().any(others)
}

/// The forces on a body that vary and depend on time alone.
pub(super) fn prescribed(system: Forced<'_>) -> Vec<Prescribed<'_>> {
    let parts = system.forces.iter().enumerate().filter_map(|(force, given)| {
        let (law, windows) = given.law.timed();
        let is_prescribed = match law {
            ForceLaw::Torque { wave, .. } | ForceLaw::Thrust { wave, .. } => {
                windows.is_some() || wave.frequency != 0.0
            }
            ForceLaw::TorqueTable { .. } | ForceLaw::ForceTable { .. } => true,
            ForceLaw::Expression { force: formulas, .. }
            | ForceLaw::TorqueExpression { torque: formulas, .. } => {
                alone(formulas) || (windows.is_some() && constant(formulas))
            }
            _ => false,
        };
        is_prescribed.then_some(Prescribed { force, law, windows })
    });
    parts.collect()
}

fn constant(formulas: &[Expression; 3]) -> bool {
    formulas.iter().all(|formula| (0..VARIABLES).all(|i| !formula.uses(i)))
}

impl<'a> Prescribed<'a> {
    /// Components at a time (N or N·m).
    pub fn at(&self, t: f64) -> [f64; 3] {
        if self.windows.is_some_and(|windows| !windows.contains(t)) {
            return [0.0; 3];
        }
        match self.law {
            ForceLaw::Torque { torque: amplitude, wave, .. }
            | ForceLaw::Thrust { force: amplitude, wave, .. } => {
                scale((wave.frequency * t + wave.phase).cos(), *amplitude)
            }
            ForceLaw::TorqueTable { table, .. } | ForceLaw::ForceTable { table, .. } => table.at(t),
            ForceLaw::Expression { force: formulas, .. }
            | ForceLaw::TorqueExpression { torque: formulas, .. } => {
                let mut variables = [0.0; VARIABLES];
                variables[TIME] = t;
                formulas.each_ref().map(|formula| formula.value(&variables))
            }
            _ => [0.0; 3],
        }
    }

    /// Place of action of a force; none of a torque.
    pub fn place(&self) -> Option<&'a Marker> {
        self.law.place()
    }
}
