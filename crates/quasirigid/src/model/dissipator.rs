//! What takes energy from the motion of the coordinates: dashpots, and materials with a loss of their own. (D1)

use std::ops::Range;

use super::Rheology;
use crate::math::sparse::SparseRows;

/// Dissipator: a component that takes energy from the motion of the coordinates, such as a spring with its dashpot, a hinge, a
/// part of finite elements, a rotor or a liquid. (D1)
#[derive(Clone, Debug, PartialEq)]
pub struct Dissipator {
    /// Name, as the model file has it.
    pub name: String,
    /// Its part of the damping matrix `B`.
    pub damping: SparseRows<f64>,
    /// Its part of the stiffness whose loss is a material's, none in `B`.
    pub loss: Option<Viscoelastic>,
}

impl Dissipator {
    /// The same in a body with `C → C/ε²`, `B → B/ε`.
    pub(super) fn stiffened(&self, epsilon: f64) -> Self {
        Self {
            name: self.name.clone(),
            damping: self.damping.scaled(epsilon.recip()),
            loss: self.loss.as_ref().map(|loss| loss.scaled(epsilon.powi(-2))),
        }
    }

    /// The same with all coordinates but some locked; none if it dissipates no more.
    pub(super) fn block(&self, kept: Range<usize>) -> Option<Self> {
        let damping = self.damping.block(kept.clone());
        let loss = self.loss.as_ref().map(|loss| loss.block(kept));
        let loss = loss.filter(|loss| loss.stiffness.iter().next().is_some());
        let dissipates = loss.is_some() || damping.iter().next().is_some();
        dissipates.then(|| Self { name: self.name.clone(), damping, loss })
    }
}

/// Part of the stiffness whose loss no equation of motion holds: a material with a rheology of its own.
///
/// The equations of motion take it as elastic; the response to a periodic load, which is what averaging asks for, has
/// its [`modulus`](Rheology::modulus) at every frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Viscoelastic {
    /// How it answers periodic strain.
    pub rheology: Rheology,
    /// Its part of `C`.
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
