//! Guesses of a relative equilibrium: Newton's method, and a continuation from the frozen body as its parts yield.
//! Springs that are `1/s²` as stiff are those of the whole body at `s` times the spin and the angular momentum of wheels: on this way the
//! frozen gyrostat stays as it is.
//! Equation (M1), docs/theory/15-modes.md.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use super::equilibrium::{RelativeEquilibrium, SpinMagnitude};
use crate::math::vec3::{add, dot};
use crate::model::{BalancedSpin, FlexibleBody};

/// Limit of Newton steps from one spin to the next.
const NEWTON_STEPS: usize = 40;
/// Shortest step of the continuation, as a share of the spin of the body.
const SHORTEST_SPIN_STEP: f64 = 1e-3;
/// Residual at which an equilibrium is found, relative to the angular momentum.
const CONVERGED: f64 = 1e-13;
/// Residual accepted where rounding ends the progress.
const ACCEPTED_RESIDUAL: f64 = 1e-9;
/// Sine of the angle from the starting axis beyond which the axis belongs to another equilibrium.
pub(super) const ASTRAY: f64 = 0.75;

impl SpinMagnitude {
    fn times(self, share: f64) -> Self {
        match self {
            Self::Rate(rate) => Self::Rate(share * rate),
            Self::AngularMomentum(angular_momentum) => Self::AngularMomentum(share * angular_momentum),
        }
    }
}

/// Guess of an equilibrium: an angular velocity and the ratio of the angular momentum to it, `K(ω) = ratio · ω` at an equilibrium.
#[derive(Clone, Copy, Debug)]
pub(super) struct Guess {
    omega: Vector3<f64>,
    ratio: f64,
}

/// Share of the largest singular value below which a direction of Newton's step is neutral: steady spins lie side by side along it.
const NEUTRAL: f64 = 1e-12;

/// Shortest step of Newton's method, in units of the spin (rad/s) and of the ratio (kg·m²), rows in units of the angular momentum and one:
/// none along a neutral direction, where every spin is steady.
fn shortest(system: Matrix4<f64>, right: Vector4<f64>, spin: f64, ratio: f64) -> Option<Vector4<f64>> {
    let unit = Vector4::new(spin, spin, spin, ratio.abs());
    let row = Vector4::new(1.0, 1.0, 1.0, spin * ratio.abs()) / (spin * ratio.abs());
    let scaled = Matrix4::from_diagonal(&row) * system * Matrix4::from_diagonal(&unit);
    let factors = scaled.svd(true, true);
    let step = factors.solve(&row.component_mul(&right), NEUTRAL * factors.singular_values.max()).ok()?;
    Some(step.component_mul(&unit))
}

impl Guess {
    /// Guess from the spin of the frozen body about an axis.
    pub fn rigid(body: &FlexibleBody, axis: [f64; 3], given: SpinMagnitude) -> Self {
        let J = body.inertia().map(|row| dot(row, axis));
        let along = dot(J, axis);
        let wheels = dot(body.wheels().angular_momentum(0.0), axis);
        let rate = match given {
            SpinMagnitude::Rate(rate) => rate,
            SpinMagnitude::AngularMomentum(angular_momentum) => (angular_momentum - wheels) / along,
        };
        Self { omega: rate * Vector3::from(axis), ratio: along + wheels / rate }
    }

    /// Guess from the body in balance with an angular velocity (rad/s); none where there is no balance.
    pub fn deformed(body: &FlexibleBody, omega: [f64; 3]) -> Option<Self> {
        let own = body.balanced(omega)?.angular_momentum;
        Some(Self::of(omega, add(own, body.wheels().angular_momentum(0.0))))
    }

    /// Guess from an angular velocity (rad/s) and the angular momentum (N·m·s) that goes with it.
    pub fn of(omega: [f64; 3], K: [f64; 3]) -> Self {
        Self { omega: omega.into(), ratio: dot(K, omega) / dot(omega, omega) }
    }

    fn scaled(self, factor: f64) -> Self {
        Self { omega: factor * self.omega, ..self }
    }

    /// Equilibrium that the frozen one becomes as its parts yield, about an axis or about any; the share of the spin up to which it was
    /// followed if it is lost.
    pub fn followed(
        self,
        body: &FlexibleBody,
        given: SpinMagnitude,
        axis: Option<[f64; 3]>,
    ) -> Result<(Self, BalancedSpin), f64> {
        let mut guess = self.scaled(SHORTEST_SPIN_STEP);
        let (mut reached, mut step) = (SHORTEST_SPIN_STEP, 0.25);
        loop {
            let next = f64::min(reached + step, 1.0);
            let axis = axis.unwrap_or_else(|| guess.omega.normalize().into());
            match guess.scaled(next / reached).newton(body, next, given, axis) {
                Some(found) if next >= 1.0 => return Ok(found),
                Some((found, _)) => {
                    (guess, reached) = (found, next);
                    step *= 2.0;
                }
                None if step > SHORTEST_SPIN_STEP => step *= 0.25,
                None => return Err(reached),
            }
        }
    }

    /// Solves `K(ω) = ratio · ω` at a share of the spin and of the wheels, with the given quantity, by Newton's method; with the displacements in
    /// balance.
    pub fn newton(
        self,
        body: &FlexibleBody,
        share: f64,
        given: SpinMagnitude,
        axis: [f64; 3],
    ) -> Option<(Self, BalancedSpin)> {
        let (wheels, given) =
            (share * Vector3::from(body.wheels().angular_momentum(0.0)), given.times(share));
        let Self { mut omega, mut ratio } = self;
        let mut best = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            let balanced = body.balanced(omega.into())?;
            let K = Vector3::from(balanced.angular_momentum) + wheels;
            let slope = Matrix3::from(balanced.slope).transpose();
            let gap = K - ratio * omega;
            let (excess, gradient) = match given {
                SpinMagnitude::Rate(rate) => {
                    (0.5 * (omega.norm_squared() / (rate * rate) - 1.0), omega / (rate * rate))
                }
                SpinMagnitude::AngularMomentum(G) => {
                    (0.5 * (K.norm_squared() / (G * G) - 1.0), slope.transpose() * K / (G * G))
                }
            };
            let residual = gap.norm() / K.norm() + excess.abs();
            if residual <= CONVERGED || (residual >= 0.5 * best && best <= ACCEPTED_RESIDUAL) {
                return Some((Self { omega, ratio }, balanced));
            }
            best = best.min(residual);
            let mut system = Matrix4::zeros();
            system.fixed_view_mut::<3, 3>(0, 0).copy_from(&(slope - ratio * Matrix3::identity()));
            system.fixed_view_mut::<3, 1>(0, 3).copy_from(&-omega);
            system.fixed_view_mut::<1, 3>(3, 0).copy_from(&gradient.transpose());
            let step =
                shortest(system, Vector4::new(-gap[0], -gap[1], -gap[2], -excess), omega.norm(), ratio)?;
            omega += step.fixed_rows::<3>(0);
            ratio += step[3];
            let sine = omega.cross(&Vector3::from(axis)).norm() / omega.norm();
            let along = omega.dot(&Vector3::from(axis));
            if !(sine <= ASTRAY && along > 0.0) {
                return None;
            }
        }
        None
    }

    pub fn finish(self, body: &FlexibleBody, balanced: BalancedSpin) -> RelativeEquilibrium {
        let omega: [f64; 3] = self.omega.into();
        let BalancedSpin { q, angular_momentum: own, .. } = balanced;
        let angular_momentum = add(own, body.wheels().angular_momentum(0.0));
        let elastic = body.stiffness().quadratic(&q);
        let energy = 0.5 * (dot(own, omega) + elastic);
        RelativeEquilibrium { omega, angular_momentum, ratio: self.ratio, energy, q }
    }
}
