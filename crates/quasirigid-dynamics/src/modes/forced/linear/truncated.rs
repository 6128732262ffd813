//! Linear models with fewer states.
//! Equations (M22) and (M23), docs/theory/15-modes.md.

use super::{LinearError, LinearModel, LinearState};
use crate::math::state_space::{StateSpace, Truncation, TruncationMethod, TruncationRequest};
use crate::math::vec3::norm;

/// Linear model with fewer states, and the error by those left out.
///
/// Errors are gains between inputs and outputs divided by their scales, so that one is about the largest response of the vibrations.
#[derive(Clone, Debug, PartialEq)]
pub struct TruncatedLinearModel {
    /// The model.
    pub model: LinearModel,
    /// What was left out, and the bound on the error.
    pub truncation: Truncation,
}

impl LinearModel {
    /// The model with so many states; rigid motions are kept. Inputs and outputs of one kind, numbered from 0, share a scale. (M22), (M23)
    ///
    /// # Errors
    /// [`LinearError::Truncation`] says which numbers of states are possible.
    pub fn truncated(
        &self,
        method: TruncationMethod,
        states: usize,
        [inputs, outputs]: [&[usize]; 2],
    ) -> Result<TruncatedLinearModel, LinearError> {
        let space = StateSpace { A: self.A.clone(), B: self.B.clone(), C: self.C.clone(), D: self.D.clone() };
        let rate = norm(self.equilibrium.omega);
        let truncation = space.truncated(&TruncationRequest { method, states, rate, inputs, outputs })?;
        let StateSpace { A, B, C, D } = truncation.system.clone();
        let model = Self {
            equilibrium: self.equilibrium.clone(),
            states: (0..A.len()).map(LinearState::Truncated).collect(),
            A,
            B,
            C,
            D,
            accuracy: self.accuracy,
        };
        Ok(TruncatedLinearModel { model, truncation })
    }
}
