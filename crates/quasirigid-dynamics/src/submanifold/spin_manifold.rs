//! Spin manifold: expansion of the full equations about a steady spin, and of what is observed along it.

use std::ops::ControlFlow;

use crate::math::submanifold::{InvariantManifold, NearResonance, Plan, Style, Truncated, expand};
use crate::math::vec3::{dot, norm, scale};
use crate::model::{ExpandedMotion, FlexibleBody, MAX_DEGREE, Mode, Support};
use crate::modes::{RelativeEquilibrium, SpinMagnitude};

use super::error::SubmanifoldError;
use super::masters::{Chosen, MasterMode, Masters, OuterMode, choose};
use super::observables::Observables;
use super::steady::SteadySpin;

/// Plan of reduced equations about a steady spin.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinManifoldPlan {
    /// Principal axis that the nutation circles.
    pub mode: Mode,
    /// Angular momentum (N·m·s) of a state, body axes, that of wheels included: its size, and the side of the axis that it circles.
    pub angular_momentum: [f64; 3],
    /// Masters beside the nutation.
    pub masters: Masters,
    /// Highest degree in the amplitude.
    pub degree: usize,
    /// Style of the parametrisation.
    pub style: Style,
}

/// Reduced equations about a steady spin, `ż = R(z)`, with the motion of the body along them. (W3), (W9)
///
/// The amplitude `|z₁|` of the nutation is the greatest tilt of the angular momentum from the axis of the spin (rad), to first order.
#[derive(Clone, Debug)]
pub struct SpinManifold<'a> {
    /// Body.
    pub body: &'a FlexibleBody,
    /// Principal axis that the nutation circles.
    pub mode: Mode,
    /// Steady spin.
    pub spin: SteadySpin,
    /// Masters: the nutation first.
    pub masters: Vec<MasterMode>,
    /// Modes left out, by ascending size.
    pub outer: Vec<OuterMode>,
    /// Style.
    pub style: Style,
    pub(super) manifold: InvariantManifold,
    pub(super) observables: Observables,
}

/// Largest number of internal coordinates.
const MAX_COORDINATES: usize = 600;
/// Growth of a mode relative to its size that is rounding.
const GROWTH_ROUNDING: f64 = 1e-10;
/// Relative distance below which a resonance with a mode left out is told.
const RESONANT: f64 = 0.1;

impl<'a> SpinManifold<'a> {
    /// Derives the reduced equations about the steady spin of a body next to the angular momentum. (W3), (W4)
    ///
    /// `watch` is called with the share of the work done; `Break` ends the work.
    ///
    /// # Errors
    /// [`SubmanifoldError`].
    pub fn derive(
        body: &'a FlexibleBody,
        plan: &SpinManifoldPlan,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, SubmanifoldError> {
        check(body, plan)?;
        let angular_momentum = norm(plan.angular_momentum);
        let given = SpinMagnitude::AngularMomentum(angular_momentum);
        let mut near = RelativeEquilibrium::extreme_towards(body, plan.mode, given, plan.angular_momentum)?;
        if body.wheels().is_empty() && dot(near.angular_momentum, plan.angular_momentum) < 0.0 {
            near = RelativeEquilibrium::near(body, scale(-1.0, near.omega), given)?;
        }
        Self::about(body, near, plan, watch)
    }

    /// Derives the reduced equations about a steady spin that is known, as one of a body with momentum wheels. (W3), (W4)
    ///
    /// # Errors
    /// [`SubmanifoldError`].
    pub fn about(
        body: &'a FlexibleBody,
        near: RelativeEquilibrium,
        plan: &SpinManifoldPlan,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, SubmanifoldError> {
        check(body, plan)?;
        let spin = SteadySpin::polished(body, &near, norm(plan.angular_momentum))?;
        let Chosen { masters, modes, mut outer } = choose(body, near, &spin, &plan.masters)?;
        outer.sort_by(|a, b| a.decay_rate.hypot(a.frequency).total_cmp(&b.decay_rate.hypot(b.frequency)));
        let system = ExpandedMotion::of(body);
        let wanted = Plan { masters, style: plan.style, degree: plan.degree };
        let manifold = expand(&system, &spin.linear, wanted, watch)?;
        let observables = Observables::of(body, &spin, &manifold);
        Ok(Self {
            body,
            mode: plan.mode,
            spin,
            masters: modes,
            outer,
            style: plan.style,
            manifold,
            observables,
        })
    }

    /// Degree of the expansion.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.manifold.ring.degree()
    }

    /// Steady spin rate (rad/s).
    #[must_use]
    pub fn rate(&self) -> f64 {
        norm(self.spin.omega)
    }

    /// Axis of the angular momentum of the steady spin, a unit vector, body axes.
    #[must_use]
    pub fn axis(&self) -> [f64; 3] {
        scale(norm(self.spin.angular_momentum).recip(), self.spin.angular_momentum)
    }

    /// Spin manifold and the motion on it, with their coefficients.
    #[must_use]
    pub fn expansion(&self) -> &InvariantManifold {
        &self.manifold
    }

    /// Direction of the angular momentum, body axes, as polynomials of the coordinates.
    #[must_use]
    pub fn direction_expansion(&self) -> &[Truncated; 3] {
        &self.observables.direction
    }

    /// Name and decay rate (1/s, negative) of a mode beside the nutation that grows; none if none does. The motion then leaves the nutation by
    /// itself.
    #[must_use]
    pub fn unstable(&self) -> Option<(&str, f64)> {
        let followed = self.masters[1..].iter().find(|mode| grows(mode.decay_rate, mode.frequency));
        followed.map(|mode| (mode.name.as_str(), mode.decay_rate)).or_else(|| self.growing_outside())
    }

    /// Name and decay rate (1/s, negative) of a mode left out that grows; none if none does. No history on the spin manifold then lasts.
    #[must_use]
    pub fn growing_outside(&self) -> Option<(&str, f64)> {
        let outer = self.outer.iter().find(|mode| grows(mode.decay_rate, mode.frequency));
        outer.map(|mode| (mode.name.as_str(), mode.decay_rate))
    }

    /// Modes left out that a monomial of the masters comes near, nearest first: each limits the range. (W6)
    #[must_use]
    pub fn near_resonances(&self) -> Vec<(NearResonance, &OuterMode)> {
        let upper = self.outer.iter().map(|mode| [-mode.decay_rate, mode.frequency]);
        let eigenvalues: Vec<[f64; 2]> = upper.collect();
        let found = self.manifold.near_resonances(&eigenvalues, self.degree(), RESONANT);
        found.into_iter().map(|near| (near.clone(), &self.outer[near.other])).collect()
    }
}

/// Refuses bodies and plans that have no such equations.
fn check(body: &FlexibleBody, plan: &SpinManifoldPlan) -> Result<(), SubmanifoldError> {
    if !(1..=MAX_DEGREE).contains(&plan.degree) {
        return Err(SubmanifoldError::Degree { degree: plan.degree, highest: MAX_DEGREE });
    }
    if body.coordinates().len() > MAX_COORDINATES {
        return Err(SubmanifoldError::TooLarge {
            coordinates: body.coordinates().len(),
            most: MAX_COORDINATES,
        });
    }
    if !body.wheels().driven.is_empty() {
        return Err(SubmanifoldError::External { what: "a momentum wheel has a prescribed speed" });
    }
    if matches!(body.support(), Support::Prescribed { .. }) {
        return Err(SubmanifoldError::External { what: "the support is driven" });
    }
    match body.dissipators().iter().find(|dissipator| dissipator.loss.is_some()) {
        Some(dissipator) => Err(SubmanifoldError::NoEquations { what: dissipator.name.clone() }),
        None => Ok(()),
    }
}

/// True if a mode grows, beyond rounding.
fn grows(decay_rate: f64, frequency: f64) -> bool {
    decay_rate < -GROWTH_ROUNDING * decay_rate.hypot(frequency)
}
