//! Relative equilibrium: steady spin of a body without external moments, with its deformation.
//! Displacements are eliminated, since the balance is linear in them at a given angular velocity; Newton's method then has four unknowns,
//! and a continuation from the frozen body where it fails.
//! Equation (M1), docs/theory/15-modes.md.

use nalgebra::DMatrix;
use thiserror::Error;

use super::frozen_spins::frozen_spins;
use super::guess::{ASTRAY, Guess};
use crate::math::vec3::{add, cross, dot, norm, scale, unit};
use crate::model::{FlexibleBody, Mode, Principal, SpinCoefficients};

/// Relative equilibrium: a steady spin and the displacements that it causes. (M1)
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeEquilibrium {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Displacements of the internal coordinates; zero of cyclic ones.
    pub q: Vec<f64>,
    /// Angular momentum with that of wheels (N·m·s), body axes: `angular_momentum = ratio · omega`.
    pub angular_momentum: [f64; 3],
    /// `K·ω/|ω|²` (kg·m²): the moment of inertia about the axis of the spin, in a body without momentum wheels.
    pub ratio: f64,
    /// Energy (J), without that of wheels.
    pub energy: f64,
}

/// Quantity that a relative equilibrium is given by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpinMagnitude {
    /// Angular velocity `|ω|` (rad/s).
    Rate(f64),
    /// Angular momentum `|K|` (N·m·s).
    AngularMomentum(f64),
}

/// Error of a relative equilibrium that was not found.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum EquilibriumError {
    /// The given value is not a finite number above zero.
    #[error("a steady spin needs an angular velocity that is finite and not zero, not {value}")]
    NoSpin {
        /// Given value, rad/s or N·m·s.
        value: f64,
    },
    /// The iteration leads to another axis or does not converge.
    #[error(
        "no steady spin was found near the axis [{:.4}, {:.4}, {:.4}] at {reached:.4} of the spin asked for: a spring may be too soft for the centrifugal load{}", axis[0], axis[1], axis[2], if *wheels { ", or a momentum wheel turns the spin away" } else { "" }
    )]
    NotFound {
        /// Axis, body axes.
        axis: [f64; 3],
        /// Share of the spin up to which a steady spin was followed.
        reached: f64,
        /// Whether the body has momentum wheels.
        wheels: bool,
    },
    /// No steady spin in which the spin restores the coordinates that no spring restores. (I13)
    #[error(
        "no spring restores {coordinates}, and no steady spin about the axis [{:.4}, {:.4}, {:.4}] was found that does; place the appendage where the spin holds it, away from the axis, or give its hinge a `stiffness`", axis[0], axis[1], axis[2]
    )]
    Unrestored {
        /// Names of the coordinates.
        coordinates: String,
        /// Axis, body axes.
        axis: [f64; 3],
    },
    /// Drives move some coordinates. (T7)
    #[error(
        "{coordinates} follows a law over time, and a body that it moves has no steady spin: follow it with the full system, or give the part a constant place"
    )]
    Driven {
        /// Names of the coordinates.
        coordinates: String,
    },
}

/// Difference of moments, as a share of the largest, below which they count as nearly equal: loads may turn a steady spin to anywhere between
/// their axes.
pub const NEARLY_EQUAL: f64 = 0.05;
/// Starting directions among the axes of nearly equal moments, the own axis first: in the plane of two, then those beside it of three.
const IN_PLANE: [[f64; 3]; 3] = [[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]];
const IN_SPACE: [[f64; 3]; 9] = [
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [1.0, -1.0, -1.0],
];
/// Least stiffness of a coordinate without a spring, in units of that of a centrifugal force on its own inertia, that is not rounding.
const RESTORED: f64 = 1e-10;
/// Most coordinates of a body whose springs are looked at.
const MOST_COORDINATES: usize = 512;
/// Relative difference below which the ratios of two steady spins are equal: the rounding of moments of inertia.
const EQUAL: f64 = 1e-12;
/// Cosine of the angle from a direction below which an axis is across it.
const ACROSS: f64 = 1e-9;

/// Refuses a body whose parts follow laws over time.
fn undriven(body: &FlexibleBody) -> Result<(), EquilibriumError> {
    body.driven().map_or(Ok(()), |coordinates| Err(EquilibriumError::Driven { coordinates }))
}

impl RelativeEquilibrium {
    /// Relative equilibrium whose axis continues a direction as the spin rises from zero. (M1)
    ///
    /// # Errors
    /// [`EquilibriumError`] if there is none, or the continuation loses it.
    pub fn near(body: &FlexibleBody, axis: [f64; 3], given: SpinMagnitude) -> Result<Self, EquilibriumError> {
        undriven(body)?;
        let (SpinMagnitude::Rate(value) | SpinMagnitude::AngularMomentum(value)) = given;
        let length = norm(axis);
        if !(value > 0.0 && value.is_finite() && length > 0.0 && length.is_finite()) {
            return Err(EquilibriumError::NoSpin { value });
        }
        let axis = axis.map(|entry| entry / length);
        let start = Guess::rigid(body, axis, given);
        let found =
            start.newton(body, 1.0, given, axis).map_or_else(|| start.followed(body, given, Some(axis)), Ok);
        match found {
            Ok((found, balanced)) => found.finish(body, balanced).restored(body),
            Err(reached) => Err(unfound(body, axis, reached)),
        }
    }

    /// Relative equilibrium of the frozen body with an angular velocity (rad/s), as its parts yield. (M1)
    ///
    /// # Errors
    /// [`EquilibriumError`] if the continuation loses it.
    pub fn next_to(
        body: &FlexibleBody,
        omega: [f64; 3],
        given: SpinMagnitude,
    ) -> Result<Self, EquilibriumError> {
        undriven(body)?;
        let (SpinMagnitude::Rate(value) | SpinMagnitude::AngularMomentum(value)) = given;
        let rate = norm(omega);
        if !(value > 0.0 && value.is_finite() && rate > 0.0 && rate.is_finite()) {
            return Err(EquilibriumError::NoSpin { value });
        }
        let K = add(body.inertia().map(|row| dot(row, omega)), body.wheels().angular_momentum(0.0));
        let guess = Guess::of(omega, K);
        let axis = scale(rate.recip(), omega);
        let found =
            guess.newton(body, 1.0, given, axis).map_or_else(|| guess.followed(body, given, None), Ok);
        let (found, balanced) = found.map_err(|reached| unfound(body, axis, reached))?;
        found.finish(body, balanced).restored(body)
    }

    /// Relative equilibrium of a body with momentum wheels whose axis is nearest to an angular velocity (rad/s): of those that the frozen
    /// body's become as its parts yield, and the one that Newton's method leads to from the body in balance. (M27)
    ///
    /// # Errors
    /// [`EquilibriumError`] if there is none.
    pub fn beside(
        body: &FlexibleBody,
        omega: [f64; 3],
        given: SpinMagnitude,
    ) -> Result<Self, EquilibriumError> {
        undriven(body)?;
        let axis = unit(omega);
        let led = Guess::deformed(body, omega).and_then(|guess| guess.newton(body, 1.0, given, axis));
        let led = led.and_then(|(found, balanced)| found.finish(body, balanced).restored(body).ok());
        let frozen = frozen_spins(body, given).into_iter();
        let followed = frozen.filter_map(|spin| Self::next_to(body, spin.omega, given).ok());
        let found = led.into_iter().chain(followed);
        let along = |spin: &Self| dot(unit(spin.omega), axis);
        let nearer = |best: Self, next: Self| {
            let nearer = along(&next) - along(&best);
            let lower = nearer > -EQUAL && next.energy < best.energy;
            if nearer > EQUAL || lower { next } else { best }
        };
        found.reduce(nearer).ok_or_else(|| unfound(body, axis, 0.0))
    }

    /// Relative equilibria next to the principal axes of the frozen body, in the order of ascending moments. (M1)
    pub fn all(body: &FlexibleBody, given: SpinMagnitude) -> [Result<Self, EquilibriumError>; 3] {
        Principal::compute(body.invariants().J).axes.map(|axis| Self::near(body, axis, given))
    }

    /// Relative equilibrium about the axis that a mode circles; with momentum wheels in the sense of their angular momentum. Where two moments
    /// are nearly equal its axis may lie anywhere between theirs; of the equilibria found the one with extreme `K·ω/|ω|²` is taken. (M1)
    ///
    /// # Errors
    /// As [`near`](Self::near).
    pub fn extreme(body: &FlexibleBody, mode: Mode, given: SpinMagnitude) -> Result<Self, EquilibriumError> {
        Self::extreme_towards(body, mode, given, body.wheels().angular_momentum(0.0))
    }

    /// The same next to a direction: in its sense, and next to it among the
    /// axes of equal moments, where every spin is as steady. (M1)
    ///
    /// # Errors
    /// As [`near`](Self::near).
    pub fn extreme_towards(
        body: &FlexibleBody,
        mode: Mode,
        given: SpinMagnitude,
        towards: [f64; 3],
    ) -> Result<Self, EquilibriumError> {
        let Principal { moments, axes } = Principal::compute(body.invariants().J).beside(mode, towards);
        let sense = |axis| sense_towards(body, axis, towards);
        let axes = axes.map(sense);
        let (own, third, sign) = match mode {
            Mode::ShortAxis => (2, 0, 1.0),
            Mode::LongAxis => (0, 2, -1.0),
        };
        let found = Self::near(body, axes[own], given);
        let alike = |other: usize| (moments[other] - moments[own]).abs() <= NEARLY_EQUAL * moments[2];
        if !alike(1) {
            return found;
        }
        let between = directions(axes, [own, 1, third], alike(third));
        let between = between.into_iter().filter_map(|axis| Self::near(body, axis, given).ok());
        let extreme = |candidates: Vec<Self>| {
            let beyond = |best: Self, next: Self| {
                if sign * (next.ratio - best.ratio) > EQUAL * best.ratio.abs() { next } else { best }
            };
            candidates.into_iter().reduce(beyond)
        };
        let Some(best) = extreme(found.clone().ok().into_iter().chain(between).collect()) else {
            return found;
        };
        // every start may lead to the steady spin of the lesser extreme, which is across the greater one
        let across = Self::near(body, sense(cross(axes[third], best.omega)), given).ok();
        Ok(extreme([best.clone()].into_iter().chain(across).collect()).unwrap_or(best))
    }

    /// Relative equilibrium about the axis of the middle moment next to a direction: across those of the extremes next to it, where both are
    /// found. (M1)
    ///
    /// # Errors
    /// As [`near`](Self::near).
    pub fn middle_towards(
        body: &FlexibleBody,
        given: SpinMagnitude,
        towards: [f64; 3],
    ) -> Result<Self, EquilibriumError> {
        let extreme = |mode| Self::extreme_towards(body, mode, given, towards).ok();
        let across = extreme(Mode::ShortAxis)
            .zip(extreme(Mode::LongAxis))
            .map(|(short, long)| cross(unit(short.omega), unit(long.omega)))
            .filter(|across| norm(*across) > ASTRAY);
        let frozen = || {
            let principal = Principal::compute(body.invariants().J);
            principal.beside(Mode::LongAxis, towards).beside(Mode::ShortAxis, towards).axes[1]
        };
        Self::near(body, sense_towards(body, across.unwrap_or_else(frozen), towards), given)
    }

    /// Coefficients of small motions about the equilibrium. (M2)
    #[must_use]
    pub fn coefficients(&self, body: &FlexibleBody) -> SpinCoefficients {
        body.about_spin_on_paths(self.omega, &self.q)
    }

    /// The equilibrium, if every coordinate without a spring has a stiffness of the spin in it. (I13)
    fn restored(self, body: &FlexibleBody) -> Result<Self, EquilibriumError> {
        let Some(hung) = body.hung().filter(|_| self.restoration(body) <= RESTORED) else { return Ok(self) };
        Err(EquilibriumError::Unrestored {
            coordinates: hung.names().into(),
            axis: scale(norm(self.omega).recip(), self.omega),
        })
    }

    /// Least stiffness in this spin, in units of that of a centrifugal force on each coordinate's own inertia; infinite where springs hold
    /// everything. (I13)
    #[must_use]
    pub fn restoration(&self, body: &FlexibleBody) -> f64 {
        if body.hung().is_none() {
            return f64::INFINITY;
        }
        let SpinCoefficients { centrifugal, mass, .. } = self.coefficients(body);
        let (held, spin) = (body.stiffness(), norm(self.omega));
        let own = held.diagonal();
        let unit = |j: usize| f64::max(own[j], spin * spin * mass.at(j, j)).sqrt();
        let elastic = body.elastic();
        let mut left = DMatrix::from_fn(elastic, elastic, |j, k| -centrifugal.at(j, k) / (unit(j) * unit(k)));
        let springs = held.iter().filter(|(j, k, _)| *j < elastic && *k < elastic);
        springs.for_each(|(j, k, C)| left[(j, k)] += C / (unit(j) * unit(k)));
        left.symmetric_eigenvalues().iter().fold(f64::INFINITY, |least, own| own.abs().min(least))
    }

    /// Whether the springs withstand small displacements at this spin: `C − N` is positive definite. True of a body with more coordinates than are
    /// looked at, 512. (M1)
    #[must_use]
    pub fn is_firm(&self, body: &FlexibleBody) -> bool {
        body.elastic() > MOST_COORDINATES || body.withstands(&self.coefficients(body).centrifugal)
    }

    /// Largest displacement of a watched place, with its name (m); none for a body without watched places.
    #[must_use]
    pub fn displacement(&self, body: &FlexibleBody) -> Option<(String, f64)> {
        let moved =
            body.markers().iter().map(|marker| (marker.name.clone(), norm(marker.displacement(&self.q))));
        moved.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Starting directions among axes of nearly equal moments, in their order.
fn directions(axes: [[f64; 3]; 3], order: [usize; 3], in_space: bool) -> Vec<[f64; 3]> {
    let of = |shares: &[f64; 3]| {
        let parts = order.iter().zip(shares).map(|(k, share)| scale(*share, axes[*k]));
        parts.fold([0.0; 3], add)
    };
    let more: &[[f64; 3]] = if in_space { &IN_SPACE } else { &[] };
    IN_PLANE.iter().chain(more).map(of).collect()
}

/// An axis in the sense of a direction, or of the momentum wheels across it, or of the vector across both; as it is without any of these.
fn sense_towards(body: &FlexibleBody, axis: [f64; 3], towards: [f64; 3]) -> [f64; 3] {
    let wheels = body.wheels().angular_momentum(0.0);
    sensed(axis, [towards, wheels, cross(towards, wheels)])
}

/// A direction in the sense of the first of some others that is not across it.
fn sensed(axis: [f64; 3], towards: [[f64; 3]; 3]) -> [f64; 3] {
    let along = towards.map(|towards| dot(axis, towards) / (norm(axis) * norm(towards)));
    let sense = along.into_iter().find(|along| along.abs() > ACROSS).unwrap_or(1.0);
    scale(sense.signum(), axis)
}

/// Reason for which the continuation ends at a share of the spin.
fn unfound(body: &FlexibleBody, axis: [f64; 3], reached: f64) -> EquilibriumError {
    match body.hung() {
        Some(hung) => EquilibriumError::Unrestored { coordinates: hung.names().into(), axis },
        None => EquilibriumError::NotFound { axis, reached, wheels: !body.wheels().is_empty() },
    }
}
