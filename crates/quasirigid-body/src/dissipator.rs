//! Dissipators: dashpots, and viscoelastic materials. (D1)

use std::ops::Range;

use super::Rheology;
use crate::math::sparse::SparseRows;

/// Dissipator: a component that takes energy from the motion of the coordinates, such as a spring with its dashpot, a hinge, a
/// part of finite elements, a rotor or a liquid. (D1)
#[derive(Clone, Debug, PartialEq)]
pub struct Dissipator {
    /// Name, as in the model file.
    pub name: String,
    /// Part of the damping matrix `B`.
    pub damping: SparseRows<f64>,
    /// Part of the stiffness with the loss of a material, which is not in `B`.
    pub loss: Option<Viscoelastic>,
    /// Longest time `τ` (s) of its Kelvin–Voigt materials, whose loss `τ C` is in `B`; none without one.
    pub kelvin_voigt: Option<f64>,
}

impl Dissipator {
    /// Power (W) that the damping takes at rates of the coordinates. (D1)
    #[must_use]
    pub fn power(&self, rate: &[f64]) -> f64 {
        self.damping.times(rate).iter().zip(rate).map(|(force, rate)| force * rate).sum()
    }

    /// Dissipator of the body with `C → C/ε²`, `B → B/ε`.
    pub(super) fn stiffened(&self, epsilon: f64) -> Self {
        Self {
            name: self.name.clone(),
            damping: self.damping.scaled(epsilon.recip()),
            loss: self.loss.as_ref().map(|loss| loss.scaled(epsilon.powi(-2))),
            kelvin_voigt: self.kelvin_voigt.map(|time| epsilon * time),
        }
    }

    /// Dissipator with all coordinates but those kept locked; none if nothing is left to dissipate.
    pub(super) fn block(&self, kept: Range<usize>) -> Option<Self> {
        let damping = self.damping.block(kept.clone());
        let loss = self.loss.as_ref().map(|loss| loss.block(kept));
        let loss = loss.filter(|loss| loss.stiffness.iter().next().is_some());
        let dissipates = loss.is_some() || damping.iter().next().is_some();
        dissipates.then(|| Self { name: self.name.clone(), damping, loss, ..*self })
    }
}

/// Viscoelastic part of the stiffness: a material whose rheology has no equation of motion.
///
/// Elastic in the equations of motion; the response to a periodic load, on which averages rest, has the [`modulus`](Rheology::modulus) of
/// the material at every frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Viscoelastic {
    /// Rheology: response to periodic strain.
    pub rheology: Rheology,
    /// Part of `C`.
    pub stiffness: SparseRows<f64>,
}

impl Viscoelastic {
    pub(super) fn block(&self, kept: Range<usize>) -> Self {
        Self { stiffness: self.stiffness.block(kept), ..self.clone() }
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { stiffness: self.stiffness.scaled(factor), ..self.clone() }
    }
}
