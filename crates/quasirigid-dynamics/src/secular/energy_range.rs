//! Energy range at a given angular momentum: effective moments, equivalent polhode, and states of the deformed body.
//! Energies of the deformed steady spins take the place of frozen moments, so that axes and separatrix are those of the deformed body.
//! Equations (Q1) and (Q2), docs/theory/16-methods.md; (M1), docs/theory/15-modes.md.

use crate::averaging::{FreeRotation, RotationState, is_turning_steadily};
use crate::dynamics::FullState;
use crate::math::sym3::{self, times};
use crate::math::vec3::{add, cross, dot, norm, scale, unit};
use crate::model::{BalancedSpin, FlexibleBody, Mode, Principal};
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
                Some(found) => (effective_moment(&found), Some(found)),
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

    /// Rotation state of a body with an angular momentum `K` (N·m·s, body axes) after its vibrations have died out: the energy is that of the
    /// body in balance with its angular velocity, whose bulge has followed the spin, and the greatest wobble that at which the body has this
    /// energy on its way to the middle axis. (Q2)
    ///
    /// None at a steady spin, or if no steady spin was found.
    #[must_use]
    pub fn settled(&self, body: &FlexibleBody, K: [f64; 3]) -> Option<RotationState> {
        let nearest = self.nearest(K)?;
        let axis = unit(self.equilibrium(nearest)?.angular_momentum);
        let parallel = scale(dot(axis, K), axis);
        let across = add(K, scale(-1.0, parallel));
        let tangent = norm(across) / norm(parallel);
        if !(tangent > STEADY) {
            return None;
        }
        let wider = add(unit(parallel), scale(RESOLVED, unit(across)));
        let wider = (tangent < RESOLVED).then(|| self.at(body, nearest, wider)).flatten();
        let (state, share) = match wider.filter(|state| state.mode == nearest) {
            Some(state) => (state, tangent / RESOLVED),
            None => (self.at(body, nearest, K)?, 1.0),
        };
        let greatest = self.greatest(state);
        let middle = if is_balanced(body) {
            self.tangent(body, state, self.frame(state.mode)?[1], greatest)
        } else {
            greatest
        };
        Some(RotationState { mode: state.mode, xi: self.logit(state.mode, share * middle) })
    }

    /// Whether the body in balance with its angular velocity turns steadily with an angular momentum `K` (N·m·s, body axes), about an axis of
    /// whichever moment: `K × ω` is zero to rounding. (Q2)
    #[must_use]
    pub fn is_steady(&self, body: &FlexibleBody, K: [f64; 3]) -> bool {
        let deformed = self.nearest(K).and_then(|mode| self.deformed(body, mode, K));
        deformed.is_some_and(|(state, _)| is_turning_steadily(K, state.omega))
    }

    /// Mode whose steady spin is nearest in direction to an angular momentum; none if no steady spin was found.
    fn nearest(&self, K: [f64; 3]) -> Option<Mode> {
        let along = |mode: &Mode| self.equilibrium(*mode).map(|spin| dot(spin.angular_momentum, K).abs());
        let poles = [Mode::ShortAxis, Mode::LongAxis].into_iter().filter(|mode| along(mode).is_some());
        poles.max_by(|a, b| along(a).unwrap_or(0.0).total_cmp(&along(b).unwrap_or(0.0)))
    }

    /// State of the full system at a rotation state: the body in balance with its angular velocity, on its way from the circled axis to the
    /// other pole; where that balance is not found, as the circled steady spin deforms it. (Q2)
    ///
    /// None if the steady spin was not found.
    #[must_use]
    pub fn state(&self, body: &FlexibleBody, rotation_state: RotationState) -> Option<FullState> {
        let RotationState { mode, xi } = rotation_state;
        let axes = self.frame(mode)?;
        let (axis, other) = (axes[mode.circled()], axes[2 - mode.circled()]);
        let greatest = self.greatest(rotation_state);
        let share = (greatest / RESOLVED).min(1.0);
        let middle = if is_balanced(body) {
            self.at(body, mode, add(axis, scale(greatest / share, axes[1])))
        } else {
            Some(RotationState { mode, xi: self.logit(mode, greatest / share) })
        };
        let polhode = FreeRotation::at_logit(self.moments, self.angular_momentum, mode, xi);
        let least = polhode.nutation()[0].tan();
        let tangent = match middle.filter(|state| state.mode == mode) {
            Some(state) => share * self.tangent(body, state, other, least / share),
            None => least,
        };
        let (state, _) = self.deformed(body, mode, add(axis, scale(tangent, other)))?;
        Some(state)
    }

    /// Displacements of the body in balance with an angular velocity (rad/s); none where the balance is not known. (Q2)
    pub(super) fn balance(body: &FlexibleBody, omega: [f64; 3]) -> Option<Vec<f64>> {
        is_balanced(body).then(|| body.balanced(omega)).flatten().map(|balanced| balanced.q)
    }

    /// Tangent of the angle from the circled axis to a direction across it at which the deformed body has a rotation state by its energy,
    /// near a guess; the guess where it is not found, next to a separatrix.
    fn tangent(
        &self,
        body: &FlexibleBody,
        RotationState { mode, xi }: RotationState,
        direction: [f64; 3],
        guess: f64,
    ) -> f64 {
        let Some(spin) = self.equilibrium(mode) else { return guess };
        let axis = unit(spin.angular_momentum);
        let beyond = |logarithm: f64| {
            let found = self.at(body, mode, add(axis, scale(logarithm.exp(), direction)));
            found.filter(|found| found.mode == mode).map_or(f64::NAN, |found| found.xi - xi)
        };
        crossing(&beyond, guess.ln()).map_or(guess, f64::exp)
    }

    /// Tangent of the greatest wobble of a rotation state, towards the middle axis: `tan²θ = (I₂/I) e^{−ξ}`.
    fn greatest(&self, RotationState { mode, xi }: RotationState) -> f64 {
        (self.moments[1] / self.moments[mode.circled()] * (-xi).exp()).sqrt()
    }

    /// Place `ξ` of a greatest wobble, as the tangent of its angle.
    fn logit(&self, mode: Mode, tangent: f64) -> f64 {
        (self.moments[1] / self.moments[mode.circled()]).ln() - 2.0 * tangent.ln()
    }

    /// Axes of the effective moments: along the steady spin of a mode, towards the other pole, and across both.
    pub(super) fn frame(&self, mode: Mode) -> Option<[[f64; 3]; 3]> {
        let along = unit(self.equilibrium(mode)?.angular_momentum);
        let mut axes = [[0.0; 3]; 3];
        (axes[mode.circled()], axes[2 - mode.circled()]) = (along, self.across(mode, along));
        axes[1] = cross(axes[2], axes[0]);
        Some(axes)
    }

    /// Rotation state of the deformed body with its angular momentum along a direction.
    fn at(&self, body: &FlexibleBody, mode: Mode, direction: [f64; 3]) -> Option<RotationState> {
        let (_, energy) = self.deformed(body, mode, direction)?;
        self.rotation_state(energy)
    }

    /// The body in balance with an angular velocity that has its angular momentum along a direction, and its energy (J); where it is not
    /// found, the body as the steady spin of a mode deforms it. (Q2)
    fn deformed(&self, body: &FlexibleBody, mode: Mode, direction: [f64; 3]) -> Option<(FullState, f64)> {
        let K = scale(self.angular_momentum, unit(direction));
        if let Some((omega, q)) = balanced(body, K) {
            let state = FullState { q, ..FullState::at_rest(body, omega, [1.0, 0.0, 0.0, 0.0]) };
            let energy = state.energy(body);
            return Some((state, energy));
        }
        let spin = self.equilibrium(mode)?;
        let inverse = sym3::inverse(body.full_inertia_at(&spin.q));
        let turning = |K: [f64; 3]| 0.5 * dot(K, times(inverse, K));
        let energy = spin.energy + (turning(K) - turning(spin.angular_momentum));
        let omega = times(inverse, K);
        let state = FullState { q: spin.q.clone(), ..FullState::at_rest(body, omega, [1.0, 0.0, 0.0, 0.0]) };
        Some((state, energy))
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
        unit(towards)
    }
}

/// Whether the balance of a body is known off its steady spins: without curved paths, rotors and liquids. (Q2)
fn is_balanced(body: &FlexibleBody) -> bool {
    body.paths().is_none() && body.hung().is_none() && body.cyclic().is_empty()
}

/// Angular velocity (rad/s) and displacements of a body in balance with it, of an angular momentum (N·m·s), by Newton's method; none where
/// they are not found. (Q2)
fn balanced(body: &FlexibleBody, K: [f64; 3]) -> Option<([f64; 3], Vec<f64>)> {
    if !is_balanced(body) {
        return None;
    }
    let (mut omega, mut last) = (times(sym3::inverse(body.invariants().J), K), f64::INFINITY);
    for _ in 0..BALANCE_STEPS {
        let BalancedSpin { q, angular_momentum, slope } = body.balanced(omega)?;
        let left = add(K, scale(-1.0, angular_momentum));
        let gap = norm(left) / norm(K);
        if gap <= f64::EPSILON || !(gap < last) {
            return (gap < BALANCED).then_some((omega, q));
        }
        let [x, y, z] = slope;
        let inverse = sym3::inverse([x[0], y[1], z[2], y[2], z[0], x[1]]);
        (omega, last) = (add(omega, times(inverse, left)), gap);
    }
    None
}

/// Root of a falling function of the logarithm of a tangent, whose slope is −2 next to an axis, by the secant method; none where it does not
/// close.
fn crossing(function: &impl Fn(f64) -> f64, guess: f64) -> Option<f64> {
    let (mut x, mut slope) = (guess, -2.0);
    let mut value = function(x);
    if value.abs() <= CLOSED {
        return Some(x);
    }
    for _ in 0..SECANTS {
        let step = -value / slope;
        let next = x + step;
        let there = function(next);
        if !there.is_finite() {
            return None;
        }
        if there.abs() <= CLOSED {
            return Some(next);
        }
        if there.abs() >= value.abs() && value.abs() < ROUNDING {
            return Some(x);
        }
        slope = (there - value) / step;
        (x, value) = (next, there);
    }
    None
}

/// Effective moment `|K|²/2E` (kg·m²) of a steady spin, with the angular momentum that it was found to have: that is the given one to the
/// tolerance of the search, which is more than the difference of two nearly equal moments.
fn effective_moment(spin: &RelativeEquilibrium) -> f64 {
    let K = spin.angular_momentum;
    0.5 * dot(K, K) / spin.energy
}

/// Moments, ascending, of which any two that a body of revolution has equal are exactly so: their difference is rounding. (Q13)
fn distinct([least, middle, greatest]: [f64; 3]) -> [f64; 3] {
    let given = [least, middle, greatest];
    let middle = if Mode::ShortAxis.exists(given) { middle } else { greatest };
    if Mode::LongAxis.exists(given) { [least, middle, greatest] } else { [middle, middle, greatest] }
}

/// Tangent of the angle from an axis below which a spin is the steady one, to rounding.
const STEADY: f64 = 1e-13;
/// Tangent of the angle below which the energy has too few digits of a wobble: next to an axis `ξ` changes by twice its logarithm.
pub(super) const RESOLVED: f64 = 3e-3;
/// Newton's steps to a balance at most, and the relative difference that is accepted where rounding ends them.
const BALANCE_STEPS: usize = 30;
const BALANCED: f64 = 1e-12;
/// Secants to a rotation state at most, the difference of `ξ` at which they close, and that which rounding of the energy of a small wobble may
/// leave.
const SECANTS: usize = 20;
const CLOSED: f64 = 1e-11;
const ROUNDING: f64 = 1e-5;
/// Share of `G` below which the part of a steady spin across an axis gives no direction.
const ALONG: f64 = 1e-3;
