//! Power near the poles from the reduced equations about their steady spins, and its difference from a short run where it is handed over.
//! Equation (Q11), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::energy_range::EnergyRange;
use super::measure::{MeasureError, MeasuredBy, Measurement};
use crate::averaging::{FreeRotation, RotationState};
use crate::model::{FlexibleBody, Mode};
use crate::submanifold::{AmplitudeRange, Masters, SpinManifold, SpinManifoldPlan, Style};

/// Boundary between the reduced equations about a spin and short runs of the full system. (Q11)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ManifoldBoundary {
    /// Pole about which the reduced equations hold.
    pub mode: Mode,
    /// Greatest nutation (rad) at the boundary.
    pub nutation: f64,
    /// Relative difference of both powers there; zero where the evolution stays within the range of the reduced equations.
    pub mismatch: f64,
}

/// Reduced equations about the steady spin that a mode circles, with their range.
pub(super) struct LocalManifold<'b> {
    manifold: SpinManifold<'b>,
    range: AmplitudeRange,
}

/// Degree of the equations, and number of coordinates up to which they are cheaper than short runs.
const DEGREE: usize = 9;
const MAX_COORDINATES: usize = 60;
/// Share of the defects that defines the range, and the least nutation (rad) for which the equations are used.
const RANGE_DEFECT: f64 = 2e-3;
const MIN_NUTATION: f64 = 0.02;
/// Share of the range up to which power is taken: its edge is known to a few per cent.
const RANGE_SHARE: f64 = 0.95;

impl<'b> LocalManifold<'b> {
    /// Equations about a pole; none where there are no such equations, or their range is too small to be of use.
    pub fn about(body: &'b FlexibleBody, energies: &EnergyRange, mode: Mode) -> Option<Self> {
        if body.coordinates().len() > MAX_COORDINATES {
            return None;
        }
        let angular_momentum = energies.equilibrium(mode)?.angular_momentum;
        let (masters, style) = (Masters::Nutation, Style::NormalForm);
        let plan = SpinManifoldPlan { mode, angular_momentum, masters, degree: DEGREE, style };
        let manifold = SpinManifold::derive(body, &plan, &mut |_| ControlFlow::Continue(())).ok()?;
        let range = manifold.range(RANGE_DEFECT);
        (range.nutation >= MIN_NUTATION && manifold.unstable().is_none()).then_some(Self { manifold, range })
    }

    /// Mean power near a rotation state of an energy range; none outside the range of the equations.
    pub fn measurement(&self, energies: &EnergyRange, state: RotationState) -> Option<Measurement> {
        let RotationState { mode, xi } = state;
        let wanted =
            FreeRotation::at_logit(energies.moments(), energies.angular_momentum(), mode, xi).energy();
        let amplitude = self.manifold.amplitude_at(wanted, RANGE_SHARE * self.range.amplitude)?;
        let means = self.manifold.power_at(amplitude);
        let rotation_state =
            energies.rotation_state(means.energy).filter(|rotation_state| rotation_state.mode == mode)?;
        Some(Measurement {
            rotation_state,
            power: means.power,
            error: self.manifold.defect(amplitude).power,
            budget: means.budget,
            revolutions: 0.0,
            steps: 0,
            by: MeasuredBy::SpinManifold,
        })
    }

    /// Widest rotation state within the range.
    pub fn edge(&self, energies: &EnergyRange, mode: Mode) -> Option<RotationState> {
        let energy = self.manifold.power_at(0.9 * self.range.amplitude).energy;
        energies.rotation_state(energy).filter(|rotation_state| rotation_state.mode == mode)
    }

    /// Boundary to a short run at the edge.
    pub fn boundary(
        &self,
        energies: &EnergyRange,
        run: &Measurement,
    ) -> Result<ManifoldBoundary, MeasureError> {
        let own = self.measurement(energies, run.rotation_state).ok_or(MeasureError::LeftMode)?;
        let mismatch = (own.power / run.power - 1.0).abs();
        Ok(ManifoldBoundary { mode: run.rotation_state.mode, nutation: self.range.nutation, mismatch })
    }

    /// Boundary that an evolution does not come to.
    pub fn inside(&self, mode: Mode) -> ManifoldBoundary {
        ManifoldBoundary { mode, nutation: self.range.nutation, mismatch: 0.0 }
    }
}
