//! Energy range at a given angular momentum: effective moments, equivalent polhode, and states of the deformed body.
//! Energies of the deformed steady spins take the place of frozen moments, so that axes and separatrix are those of the deformed body.
//! Equations (Q1) and (Q2), docs/theory/16-methods.md; (M1), docs/theory/15-modes.md.

use crate::averaging::{FreeRotation, RotationState};
use crate::dynamics::FullState;
use crate::math::sym3::{self, times};
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::{FlexibleBody, Mode, Principal};
use crate::modes::{EquilibriumError, RelativeEquilibrium, SpinMagnitude};

/// Range of the energy at a given angular momentum, from the steady spins of the deformed body. (Q1)
///
/// The effective moments of inertia `I_k = G²/2E_k` take the place of those of the frozen body: with them the axes and the separatrix of
/// the equivalent polhode are those of the deformed body.
#[derive(Clone, Debug)]
pub struct EnergyRange {
    angular_momentum: f64,
    moments: [f64; 3],
    /// Steady spins about the axes of least, middle and greatest effective moment.
    equilibria: [Option<RelativeEquilibrium>; 3],
}

impl EnergyRange {
    /// The range at an angular momentum (N·m·s).
    ///
    /// # Errors
    /// [`EquilibriumError`] if there is no steady spin about the axis of greatest inertia, where every dissipation leads to.
    pub fn compute(body: &FlexibleBody, angular_momentum: f64) -> Result<Self, EquilibriumError> {
        let frozen = Principal::compute(body.invariants().J).moments;
        let given = SpinMagnitude::AngularMomentum(angular_momentum);
        let least = RelativeEquilibrium::extreme(body, Mode::LongAxis, given);
        let greatest = RelativeEquilibrium::extreme(body, Mode::ShortAxis, given);
        let [_, middle, _] = RelativeEquilibrium::all(body, given);
        let mut all: Vec<(f64, Option<RelativeEquilibrium>)> = [least.ok(), middle.ok(), Some(greatest?)]
            .into_iter()
            .zip(frozen)
            .map(|(found, frozen)| match found {
                Some(found) => (0.5 * angular_momentum * angular_momentum / found.energy, Some(found)),
                None => (frozen, None),
            })
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let moments = distinct([all[0].0, all[1].0, all[2].0]);
        let mut spins = all.into_iter().map(|(_, spin)| spin);
        let equilibria = std::array::from_fn(|_| spins.next().flatten());
        Ok(Self { angular_momentum, moments, equilibria })
    }

    /// Angular momentum `G` (N·m·s).
    #[must_use]
    pub fn angular_momentum(&self) -> f64 {
        self.angular_momentum
    }

    /// Effective moments of inertia (kg·m²), ascending.
    #[must_use]
    pub fn moments(&self) -> [f64; 3] {
        self.moments
    }

    /// Steady spin that a mode circles; none if not found.
    #[must_use]
    pub fn equilibrium(&self, mode: Mode) -> Option<&RelativeEquilibrium> {
        self.equilibria[mode.circled()].as_ref()
    }

    /// Equivalent polhode at an energy (J): that of the rigid body with the effective moments. Energies beyond those of the steady spins
    /// are clamped.
    #[must_use]
    pub fn polhode(&self, energy: f64) -> FreeRotation {
        let [least, greatest] = self.ratios();
        FreeRotation::at_ratio(self.moments, self.angular_momentum, self.ratio(energy).clamp(least, greatest))
    }

    /// Rotation state at an energy (J); none at a steady spin or beyond those of the body.
    #[must_use]
    pub fn rotation_state(&self, energy: f64) -> Option<RotationState> {
        let ([least, greatest], ratio) = (self.ratios(), self.ratio(energy));
        let within = least < ratio && ratio < greatest;
        RotationState::from_motion(&self.polhode(energy)).filter(|_| within)
    }

    /// `D/I3` at an energy (J), and at the steady spins about the axes of least and of greatest inertia.
    fn ratio(&self, energy: f64) -> f64 {
        0.5 * self.angular_momentum * self.angular_momentum / (energy * self.moments[2])
    }

    fn ratios(&self) -> [f64; 2] {
        [self.moments[0] / self.moments[2], 1.0]
    }

    /// Rotation state of a body with an angular momentum `K` (N·m·s, body axes) after its vibrations have died out: that of the rigid body
    /// with the effective moments about the steady spins. The bulge has followed the spin by then, so that the energy is not that of a body
    /// with the bulge of the steady spin. (Q2)
    ///
    /// None at a steady spin, or if no steady spin was found.
    #[must_use]
    pub fn settled(&self, K: [f64; 3]) -> Option<RotationState> {
        let along = |mode: &Mode| self.equilibrium(*mode).map(|spin| dot(spin.angular_momentum, K).abs());
        let poles = [Mode::ShortAxis, Mode::LongAxis].into_iter().filter(|mode| along(mode).is_some());
        let nearest = poles.max_by(|a, b| along(a).unwrap_or(0.0).total_cmp(&along(b).unwrap_or(0.0)))?;
        let axes = self.frame(nearest)?;
        let components = axes.map(|axis| dot(axis, K));
        let away = (0..3).filter(|axis| *axis != nearest.circled()).map(|axis| components[axis].abs());
        if away.fold(0.0, f64::max) < STEADY * norm(K) {
            return None;
        }
        let omega = [0, 1, 2].map(|axis| components[axis] / self.moments[axis]);
        RotationState::from_motion(&FreeRotation::through(self.moments, omega).ok()?)
    }

    /// Axes of the effective moments: along the steady spin of a mode, towards the other pole, and across both.
    fn frame(&self, mode: Mode) -> Option<[[f64; 3]; 3]> {
        let spin = self.equilibrium(mode)?.angular_momentum;
        let along = scale(norm(spin).recip(), spin);
        let across = self.across(mode, along);
        let mut axes = [[0.0; 3]; 3];
        (axes[mode.circled()], axes[2 - mode.circled()]) = (along, across);
        axes[1] = cross(axes[2], axes[0]);
        Some(axes)
    }

    /// State of the full system near a rotation state: the body in balance with its angular velocity, on its way from the circled axis to
    /// the other pole; where that balance is not found, as the circled steady spin deforms it. (Q2)
    ///
    /// None if the steady spin was not found.
    #[must_use]
    pub fn state(&self, body: &FlexibleBody, rotation_state: RotationState) -> Option<FullState> {
        let RotationState { mode, xi } = rotation_state;
        let spin = self.equilibrium(mode)?;
        let axes = self.frame(mode)?;
        let turning = FreeRotation::at_logit(self.moments, self.angular_momentum, mode, xi).omega(0.0);
        let parts = [0, 1, 2].map(|axis| scale(self.moments[axis] * turning[axis], axes[axis]));
        let K = parts.into_iter().fold([0.0; 3], add);
        let frozen = || (times(sym3::inverse(body.full_inertia_at(&spin.q)), K), spin.q.clone());
        let (omega, q) = balanced(body, K).unwrap_or_else(frozen);
        Some(FullState { q, ..FullState::at_rest(body, omega, [1.0, 0.0, 0.0, 0.0]) })
    }

    /// Direction across an axis, towards the other pole where its steady spin is known, otherwise towards that of the middle moment.
    fn across(&self, mode: Mode, along: [f64; 3]) -> [f64; 3] {
        let other = self.equilibria[2 - mode.circled()].as_ref().or(self.equilibria[1].as_ref());
        let mut towards = other.map_or([0.0; 3], |spin| spin.angular_momentum);
        towards = add(towards, scale(-dot(towards, along), along));
        if norm(towards) < ALONG * self.angular_momentum {
            let mut unit = [0.0; 3];
            unit[(0..3).min_by(|a, b| along[*a].abs().total_cmp(&along[*b].abs())).unwrap_or(0)] = 1.0;
            towards = cross(along, unit);
        }
        scale(norm(towards).recip(), towards)
    }
}

/// Angular velocity (rad/s) and displacements of a body in balance with it, of an angular momentum (N·m·s); none where they are not found, or
/// are far from those of the frozen body. (Q2)
fn balanced(body: &FlexibleBody, K: [f64; 3]) -> Option<([f64; 3], Vec<f64>)> {
    if body.paths().is_some() || body.hung().is_some() || !body.cyclic().is_empty() {
        return None;
    }
    let frozen = times(sym3::inverse(body.invariants().J), K);
    let (mut omega, mut last) = (frozen, f64::INFINITY);
    for _ in 0..BALANCE_STEPS {
        let q = body.balanced(omega)?.q;
        let next = times(sym3::inverse(body.full_inertia_at(&q)), K);
        let change = norm(add(next, scale(-1.0, omega))) / norm(next);
        if !(change < last) {
            return (change < BALANCED).then_some((next, q));
        }
        (omega, last) = (next, change);
    }
    None
}

/// Moments, ascending, of which any two that a body of revolution has equal are exactly so: their difference is rounding. (Q13)
fn distinct([least, middle, greatest]: [f64; 3]) -> [f64; 3] {
    let given = [least, middle, greatest];
    let middle = if Mode::ShortAxis.exists(given) { middle } else { greatest };
    if Mode::LongAxis.exists(given) { [least, middle, greatest] } else { [middle, middle, greatest] }
}

/// Share of the angular momentum across an axis below which the spin is the steady one, to rounding.
const STEADY: f64 = 1e-13;
/// Steps of the balance of displacements and angular velocity at most, and the relative change that is accepted where rounding ends them.
const BALANCE_STEPS: usize = 60;
const BALANCED: f64 = 1e-12;
/// Share of `G` below which the part of a steady spin across an axis gives no direction.
const ALONG: f64 = 1e-3;
