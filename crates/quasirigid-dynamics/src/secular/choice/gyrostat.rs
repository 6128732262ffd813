//! Choice of the method for a body with momentum wheels. (Q15), (Q16)

use super::decision::{Decision, Method};
use super::limits::Limits;
use super::reason::Reason;

/// Criteria of a choice for a body with momentum wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GyrostatCriteria {
    /// Bound of the ratio of any spin at the energy of the start to the slowest elastic frequency.
    pub spin_ratio: f64,
    /// Whether the body has rotors or liquids that turn without a spring.
    pub internal_rotation: bool,
    /// Whether a material loses energy by a law that the reduced equations leave out.
    pub viscoelastic: bool,
    /// Losses that the equations of motion leave out, as a share of the rate of a small wobble; infinite where it is not known.
    pub left_out: f64,
    /// Whether the start is below the separatrix, so that it stays about the steady spin that attracts.
    pub settled: bool,
    /// Number of internal coordinates.
    pub coordinates: usize,
}

/// Decides which methods are tried for a body with momentum wheels.
#[must_use]
pub fn choose_for_gyrostat(criteria: &GyrostatCriteria, asked: Option<Method>, limits: &Limits) -> Decision {
    let complete = criteria.left_out <= limits.losses_left_out;
    match asked {
        Some(Method::PeriodicMotions | Method::MicroRuns) => Decision::refused(Reason::ShortRunsWithWheels),
        Some(Method::Average(_) | Method::SpinningFrame | Method::LevelCurves) => {
            Decision::asked(Method::LevelCurves)
        }
        _ if !complete => Decision::asked(Method::ModalRates),
        Some(Method::SpinManifold) if !criteria.settled => {
            Decision::refused(Reason::ManifoldThroughSeparatrix)
        }
        Some(method) => Decision::asked(method),
        None => {
            let stiff = !criteria.internal_rotation
                && !criteria.viscoelastic
                && criteria.spin_ratio < limits.spin_ratio_of_gyrostat_levels;
            let near = criteria.settled && criteria.coordinates <= limits.coordinates_of_manifold;
            let levels = stiff.then_some(Method::LevelCurves);
            let manifold = near.then_some(Method::SpinManifold);
            Decision::unasked(levels.into_iter().chain(manifold).collect(), Method::FullSystem)
        }
    }
}
