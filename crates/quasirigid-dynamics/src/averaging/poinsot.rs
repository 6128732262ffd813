//! Torque-free rotation of a rigid body in closed form (Euler–Poinsot): angular velocity, attitude, periods and means.
//! Differences of `G²` and `2EI` are kept as numbers of their own and the modulus by its complement: digits are lost neither at an axis nor
//! at the separatrix. Never form them by subtraction.
//! Equations (A1) to (A6), docs/theory/10-torque-free.md; elliptic functions `[@bulirsch1965]`.

use std::f64::consts::{FRAC_PI_2, TAU};

use thiserror::Error;

use crate::math::elliptic::{complete_third_excess, first_of_complement, first_to, jacobi, third_excess_to};
use crate::math::sym3::Sym;
use crate::math::vec3::{cross, norm, scale};
use crate::model::Mode;

/// Torque-free rotation of a rigid body, exactly (Euler–Poinsot). (A1)–(A4)
///
/// ```
/// use quasirigid::prelude::*;
///
/// let motion = FreeRotation::at_nutation([2.0, 3.0, 4.0], 4.0, Mode::ShortAxis, 0.3)?;
/// let later = motion.omega(motion.polhode_period());
/// assert!((later[2] - motion.omega(0.0)[2]).abs() < 1e-12);
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// Vectors are in principal axes, right-handed, moments ascending. Differences that vanish at an axis or at the separatrix are
/// kept as numbers of their own, so that no digits are lost near them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeRotation {
    moments: [f64; 3],
    G: f64,
    mode: Mode,
    /// `G² − 2 E I₁` and `2 E I₃ − G²`, not negative, and `|G² − 2 E I₂|` (kg²·m⁴/s²).
    from_long: f64,
    from_short: f64,
    from_middle: f64,
    /// Side of the circled axis that the angular momentum is on, ±1.
    side: f64,
    /// Argument of the elliptic functions at `t = 0`.
    phase: f64,
    /// Angular velocity of a sphere, which has no axis to circle.
    steady: Option<[f64; 3]>,
}

/// Error of a rotation that no rigid body makes.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum FreeRotationError {
    /// The moments are not those of a body in ascending order.
    #[error(
        "{moments:?} kg·m² are not principal moments of inertia; give three positive ones in ascending order"
    )]
    Moments {
        /// Moments asked for (kg·m²).
        moments: [f64; 3],
    },
    /// The angular velocity is no number.
    #[error("{omega:?} rad/s is not an angular velocity; give finite numbers")]
    Omega {
        /// Angular velocity asked for (rad/s).
        omega: [f64; 3],
    },
    /// The angular momentum is negative or no number.
    #[error(
        "{angular_momentum} N·m·s is not the size of an angular momentum; give one that is finite and not negative"
    )]
    AngularMomentum {
        /// Angular momentum asked for (N·m·s).
        angular_momentum: f64,
    },
    /// The angle is out of the range of a mode.
    #[error(
        "{nutation} rad is not a nutation angle; give an angle above 0 and below pi/2, and name the other mode for a wider one"
    )]
    Nutation {
        /// Angle asked for (rad).
        nutation: f64,
    },
    /// The body has no axis that the mode circles.
    #[error(
        "a body with the moments {moments:?} kg·m² has no axis of its own for the {mode:?} mode: two of them are equal"
    )]
    Mode {
        /// Principal moments (kg·m²).
        moments: [f64; 3],
        /// Mode asked for.
        mode: Mode,
    },
}

/// Refuses moments that are not principal moments in ascending order.
fn check(moments: [f64; 3]) -> Result<(), FreeRotationError> {
    let [I1, I2, I3] = moments;
    let possible = 0.0 < I1 && I1 <= I2 && I2 <= I3 && I3.is_finite();
    if possible { Ok(()) } else { Err(FreeRotationError::Moments { moments }) }
}

/// Sine of the angle between angular momentum and angular velocity that is the rounding of both.
const STEADY_TURN: f64 = 4e-15;

/// Whether an angular momentum (N·m·s) keeps its direction in a body that turns at an angular velocity (rad/s), to rounding.
pub(crate) fn is_turning_steadily(K: [f64; 3], omega: [f64; 3]) -> bool {
    let largest = norm(K) * norm(omega);
    largest > 0.0 && largest.is_finite() && norm(cross(K, omega)) <= STEADY_TURN * largest
}

/// Points of the mean per `K/K′`: harmonic `n` of the angular velocity falls as the power `n/2` of the nome, to 1e-17 with a margin.
const POINTS: f64 = 32.0;

impl FreeRotation {
    /// Motion through an angular velocity (rad/s) at `t = 0` of a body with these principal moments (kg·m²), ascending.
    ///
    /// # Errors
    /// [`FreeRotationError`] if the moments are not positive or do not ascend, or the angular velocity is not finite.
    pub fn through(moments: [f64; 3], omega: [f64; 3]) -> Result<Self, FreeRotationError> {
        check(moments)?;
        if !omega.iter().all(|rate| rate.is_finite()) {
            return Err(FreeRotationError::Omega { omega });
        }
        Ok(Self::passing(moments, omega))
    }

    /// Motion through an angular velocity (rad/s) that was checked.
    pub(super) fn passing(moments: [f64; 3], omega: [f64; 3]) -> Self {
        let [I1, I2, I3] = moments;
        let squares = omega.map(|rate| rate * rate);
        let from_long = I2 * (I2 - I1) * squares[1] + I3 * (I3 - I1) * squares[2];
        let from_short = I1 * (I3 - I1) * squares[0] + I2 * (I3 - I2) * squares[1];
        let above = I3 * (I3 - I2) * squares[2] - I1 * (I2 - I1) * squares[0];
        let mode = if above >= 0.0 { Mode::ShortAxis } else { Mode::LongAxis };
        let G = norm([I1 * omega[0], I2 * omega[1], I3 * omega[2]]);
        let circled = omega[mode.circled()];
        let side = if circled < 0.0 { -1.0 } else { 1.0 };
        let steady = (I1 == I3).then_some(omega);
        let from_middle = above.abs();
        let rest = Self { moments, G, mode, from_long, from_short, from_middle, side, phase: 0.0, steady };
        let [one, two] = [omega[2 - mode.circled()], side * omega[1]];
        let [a, b] = [rest.amplitudes()[2 - mode.circled()], rest.amplitudes()[1]];
        let angle = if a > 0.0 && b > 0.0 { (two / b).atan2(one / a) } else { 0.0 };
        Self { phase: first_to(angle, rest.complement()), ..rest }
    }

    /// The motion with this angular momentum (N·m·s) and `D/I₃ = |K|²/2EI₃`, from `I₁/I₃` to 1: starts where the angular momentum is
    /// nearest to the long axis, or farthest from it, on the positive side.
    #[must_use]
    pub fn at_ratio(moments: [f64; 3], G: f64, ratio: f64) -> Self {
        let [I1, I2, I3] = moments;
        let twice_energy = G * G / (ratio * I3);
        let above = twice_energy * (ratio * I3 - I2);
        Self {
            moments,
            G,
            mode: if above >= 0.0 { Mode::ShortAxis } else { Mode::LongAxis },
            from_long: (twice_energy * (ratio * I3 - I1)).max(0.0),
            from_short: (twice_energy * I3 * (1.0 - ratio)).max(0.0),
            from_middle: above.abs(),
            side: 1.0,
            phase: 0.0,
            steady: (I1 == I3).then_some([0.0, 0.0, G / I3]),
        }
    }

    /// The motion with this angular momentum (N·m·s) whose `D/I₃` lies the share `1/(1 + e^{−ξ})` of the way from the separatrix to the
    /// axis that the mode circles: no digits are lost at either end. The motion starts as [`at_ratio`] says.
    ///
    /// [`at_ratio`]: Self::at_ratio
    #[must_use]
    pub fn at_logit(moments: [f64; 3], G: f64, mode: Mode, xi: f64) -> Self {
        let [I1, I2, I3] = moments;
        let [to_axis, to_separatrix] = [xi, -xi].map(|xi| 1.0 / (1.0 + xi.exp()));
        let (away, D) = match mode {
            Mode::ShortAxis => (I3 - I2, I3 - (I3 - I2) * to_axis),
            Mode::LongAxis => (I2 - I1, I1 + (I2 - I1) * to_axis),
        };
        let twice_energy = G * G / D;
        let [near, far] = [to_axis, to_separatrix].map(|share| twice_energy * away * share);
        let (from_long, from_short) = match mode {
            Mode::ShortAxis => (twice_energy * (D - I1), near),
            Mode::LongAxis => (near, twice_energy * (I3 - D)),
        };
        Self { from_long, from_short, from_middle: far, mode, ..Self::at_ratio(moments, G, D / I3) }
    }

    /// The motion with this angular momentum (N·m·s) whose greatest angle between the angular momentum and the circled axis is `nutation`
    /// (rad). The motion starts as [`at_ratio`](Self::at_ratio) says.
    ///
    /// # Errors
    /// [`FreeRotationError`] if the moments are not positive or do not ascend, the mode has no axis, the angle is not above 0 and below
    /// a right angle, or the angular momentum is negative or no number.
    pub fn at_nutation(
        moments: [f64; 3],
        G: f64,
        mode: Mode,
        nutation: f64,
    ) -> Result<Self, FreeRotationError> {
        check(moments)?;
        if !(G >= 0.0 && G.is_finite()) {
            return Err(FreeRotationError::AngularMomentum { angular_momentum: G });
        }
        if !(nutation > 0.0 && nutation < FRAC_PI_2) {
            return Err(FreeRotationError::Nutation { nutation });
        }
        if !mode.exists(moments) {
            return Err(FreeRotationError::Mode { moments, mode });
        }
        Ok(Self::at_logit(moments, G, mode, Self::logit_of(moments, mode, nutation)))
    }

    /// Place `ξ` where the greatest angle between the angular momentum and the circled axis is `nutation` (rad), above 0 and below a
    /// right angle: `e^ξ = I₂/(I tan²θ)` with the moment `I` of that axis.
    #[must_use]
    pub fn logit_of(moments: [f64; 3], mode: Mode, nutation: f64) -> f64 {
        (moments[1] / moments[mode.circled()]).ln() - 2.0 * nutation.tan().ln()
    }

    /// Axis that the angular momentum circles.
    #[must_use]
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// Principal moments of inertia (kg·m²), ascending.
    #[must_use]
    pub fn moments(&self) -> [f64; 3] {
        self.moments
    }

    /// `|K|` (N·m·s).
    #[must_use]
    pub fn angular_momentum(&self) -> f64 {
        self.G
    }

    /// Whether the motion is a steady spin at `t = 0`, about an axis of whichever moment, to rounding.
    #[must_use]
    pub fn is_steady(&self) -> bool {
        let omega = self.omega(0.0);
        is_turning_steadily(std::array::from_fn(|axis| self.moments[axis] * omega[axis]), omega)
    }

    /// Energy (J).
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * (self.G * self.G + self.from_short) / self.moments[2]
    }

    /// Energy (J) by which the motion differs from the steady spin about the circled axis, not negative.
    #[must_use]
    pub fn energy_from_axis(&self) -> f64 {
        match self.mode {
            Mode::ShortAxis => 0.5 * self.from_short / self.moments[2],
            Mode::LongAxis => 0.5 * self.from_long / self.moments[0],
        }
    }

    /// Energy (J) by which the motion differs from the steady spin about the middle axis, not negative.
    #[must_use]
    pub fn energy_from_separatrix(&self) -> f64 {
        0.5 * self.from_middle / self.moments[1]
    }

    /// `D/I₃ = |K|²/2EI₃`, from `I₁/I₃` to 1.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        self.G * self.G / (self.G * self.G + self.from_short)
    }

    /// Place `ξ` between the separatrix, `−∞`, and the circled axis, `∞`: the logit of [`at_logit`](Self::at_logit).
    #[must_use]
    pub fn logit(&self) -> f64 {
        let near = match self.mode {
            Mode::ShortAxis => self.from_short,
            Mode::LongAxis => self.from_long,
        };
        (self.from_middle / near).ln()
    }

    /// `|dE/dξ|` (J), where `ξ` is the logit of [`at_logit`](Self::at_logit).
    #[must_use]
    pub fn energy_slope(&self) -> f64 {
        let near = match self.mode {
            Mode::ShortAxis => self.from_short,
            Mode::LongAxis => self.from_long,
        };
        self.energy() * near / (self.G * self.G) * (self.from_middle / (near + self.from_middle))
    }

    /// Angular velocity (rad/s) at a time (s). (A1)
    #[must_use]
    pub fn omega(&self, t: f64) -> [f64; 3] {
        if let Some(omega) = self.steady {
            return omega;
        }
        self.at_argument(jacobi(self.argument(t), self.complement()))
    }

    /// Angular velocity (rad/s) at these values of the elliptic functions `sn, cn, dn`.
    pub(super) fn at_argument(&self, [sn, cn, dn]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.amplitudes();
        match self.mode {
            Mode::ShortAxis => [a * cn, self.side * b * sn, self.side * c * dn],
            Mode::LongAxis => [self.side * a * dn, self.side * b * sn, c * cn],
        }
    }

    /// Mean of `|ω̇|²` over a period of the polhode (rad²/s⁴); zero on the separatrix.
    #[must_use]
    pub fn mean_square_acceleration(&self) -> f64 {
        if !self.polhode_period().is_finite() {
            return 0.0;
        }
        let [I1, I2, I3] = self.moments();
        self.mean(4, |[x, y, z]| {
            let rates = [(I2 - I3) / I1 * y * z, (I3 - I1) / I2 * z * x, (I1 - I2) / I3 * x * y];
            rates.iter().map(|rate| rate * rate).sum()
        })
    }

    /// Mean of `ωωᵀ` (rad²/s², principal axes) over a period of the polhode. (A5)
    #[must_use]
    pub fn mean_products(&self) -> Sym {
        let pairs = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];
        pairs.map(|[i, k]| self.mean(2, |omega| omega[i] * omega[k]))
    }

    /// Mean over a period of the polhode of a polynomial in the angular velocity up to this degree; on the separatrix, where the period
    /// is infinite, its value at the middle axis. (A5)
    pub fn mean(&self, degree: usize, mut value: impl FnMut([f64; 3]) -> f64) -> f64 {
        let period = self.polhode_period();
        if !period.is_finite() {
            return value(self.omega(f64::MAX.sqrt()));
        }
        let complement = self.complement();
        let stretch = first_of_complement(complement) / first_of_complement(1.0 - complement);
        let points = 2 * degree + (POINTS * stretch).ceil() as usize;
        let sum: f64 = (0..points).map(|i| value(self.omega(period * i as f64 / points as f64))).sum();
        sum / points as f64
    }

    /// Mean of the angular velocity over a period of the polhode (rad/s), principal axes, on the positive side of the circled axis.
    #[must_use]
    pub fn mean_spin(&self) -> [f64; 3] {
        let mut mean = [0.0; 3];
        let axis = self.mode().circled();
        let quarter = first_of_complement(self.complement());
        if let Some(omega) = self.steady {
            mean[axis] = omega[axis].abs();
        } else if quarter.is_finite() {
            mean[axis] = self.amplitudes()[axis] * FRAC_PI_2 / quarter; // dn has the mean π/2K
        }
        mean
    }

    /// Period (s) of the angular velocity in body axes; that of small motions at an axis, infinite on the separatrix. (A2)
    #[must_use]
    pub fn polhode_period(&self) -> f64 {
        4.0 * first_of_complement(self.complement()) / self.rate()
    }

    /// Mean precession rate (rad/s) about the angular momentum of the axis that it does not circle, long or short. (A3)
    #[must_use]
    pub fn precession_rate(&self) -> f64 {
        let [I1, _, I3] = self.moments;
        let excess = complete_third_excess(self.characteristic(), self.complement());
        let straight = self.G / self.circled_moment();
        straight - self.direction() * self.G * (I3 - I1) / (I1 * I3) * excess
    }

    /// Mean precession rate (rad/s) of the long axis about the angular momentum: in the long-axis mode the long axis is the circled one
    /// and makes one revolution less per period of the polhode. (A3)
    #[must_use]
    pub fn long_axis_precession_rate(&self) -> f64 {
        match self.mode {
            Mode::ShortAxis => self.precession_rate(),
            Mode::LongAxis => self.precession_rate() - TAU / self.polhode_period(),
        }
    }

    /// Least and greatest angle (rad) between the angular momentum and the circled axis; zero of a sphere.
    #[must_use]
    pub fn nutation(&self) -> [f64; 2] {
        if self.steady.is_some() {
            return [0.0; 2];
        }
        let [I1, I2, I3] = self.moments;
        let square = self.G * self.G;
        let sines = match self.mode {
            Mode::ShortAxis => {
                [(I1, I3 - I1), (I2, I3 - I2)].map(|(I, gap)| self.from_short * I / (gap * square))
            }
            Mode::LongAxis => {
                [(I3, I3 - I1), (I2, I2 - I1)].map(|(I, gap)| self.from_long * I / (gap * square))
            }
        };
        sines.map(|square| if square.is_finite() { square.clamp(0.0, 1.0).sqrt().asin() } else { FRAC_PI_2 })
    }

    /// Attitude at a time: the matrix that takes principal axes to axes whose third is the angular momentum. At `t = 0` the first of
    /// these has the projection of the pole of precession. (A4)
    #[must_use]
    pub fn attitude(&self, t: f64) -> [[f64; 3]; 3] {
        let omega = self.omega(t);
        let K = [0, 1, 2].map(|axis| self.moments[axis] * omega[axis]);
        let vertical = scale(1.0 / norm(K), K);
        let least = |axis: &usize, other: &usize| K[*axis].abs().total_cmp(&K[*other].abs());
        let axis = if self.steady.is_some() { (0..3).min_by(least) } else { None };
        let mut pole = [0.0; 3];
        pole[axis.unwrap_or(2 - self.mode.circled())] = 1.0;
        let across = cross(vertical, pole);
        let second = scale(1.0 / norm(across), across);
        let first = cross(second, vertical);
        let (sine, cosine) = self.precession(t).sin_cos();
        let turned = |a: f64, b: f64| [0, 1, 2].map(|axis| a * first[axis] + b * second[axis]);
        [turned(cosine, -sine), turned(sine, cosine), vertical]
    }

    /// Precession angle (rad) of the axis not circled about the angular momentum since `t = 0`. (A3)
    #[must_use]
    pub fn precession(&self, t: f64) -> f64 {
        let [I1, _, I3] = self.moments;
        let straight = self.G * t / self.circled_moment();
        let excess = |u: f64| third_excess_to(u, self.characteristic(), self.complement());
        let bent = (excess(self.argument(t)) - excess(self.phase)) / self.rate();
        let bent = if bent.is_finite() { bent } else { 0.0 };
        straight - self.direction() * self.G * (I3 - I1) / (I1 * I3) * bent
    }

    fn argument(&self, t: f64) -> f64 {
        self.phase + self.rate() * t
    }

    /// Time (s) from argument zero of the elliptic functions to `t = 0`.
    pub(super) fn time_from_origin(&self) -> f64 {
        let time = self.phase / self.rate();
        if time.is_finite() { time } else { 0.0 }
    }

    /// Side of the circled axis that the angular momentum is on, ±1.
    pub(super) fn side(&self) -> f64 {
        self.side
    }

    /// Angular velocity of a sphere, constant in the body.
    pub(super) fn steady(&self) -> Option<[f64; 3]> {
        self.steady
    }

    /// Greatest angular velocity about each axis.
    pub(super) fn amplitudes(&self) -> [f64; 3] {
        let [I1, I2, I3] = self.moments;
        let root = |square: f64| if square.is_finite() { square.max(0.0).sqrt() } else { 0.0 };
        let [a, c] =
            [(self.from_short, I1), (self.from_long, I3)].map(|(part, I)| root(part / (I * (I3 - I1))));
        let b = match self.mode {
            Mode::ShortAxis => root(self.from_short / (I2 * (I3 - I2))),
            Mode::LongAxis => root(self.from_long / (I2 * (I2 - I1))),
        };
        [a, b, c]
    }

    /// Rate of the argument (rad/s).
    fn rate(&self) -> f64 {
        let [I1, I2, I3] = self.moments;
        (self.haste() / (I1 * I2 * I3)).sqrt()
    }

    /// Square of the rate, times the moments.
    fn haste(&self) -> f64 {
        let [I1, I2, I3] = self.moments;
        match self.mode {
            Mode::ShortAxis => (I3 - I2) * self.from_long,
            Mode::LongAxis => (I2 - I1) * self.from_short,
        }
    }

    /// `k²`.
    pub(super) fn parameter(&self) -> f64 {
        let [I1, I2, I3] = self.moments;
        let parameter = match self.mode {
            Mode::ShortAxis => (I2 - I1) * self.from_short / self.haste(),
            Mode::LongAxis => (I3 - I2) * self.from_long / self.haste(),
        };
        if parameter.is_finite() { parameter.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// `1 − k²`.
    pub(super) fn complement(&self) -> f64 {
        let [I1, _, I3] = self.moments;
        let complement = (I3 - I1) * self.from_middle / self.haste();
        if complement.is_finite() { complement.clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Characteristic of the third elliptic integral, not positive.
    fn characteristic(&self) -> f64 {
        let [I1, _, I3] = self.moments;
        let n = match self.mode {
            Mode::ShortAxis => -I1 * self.from_short / (I3 * self.from_long),
            Mode::LongAxis => -I3 * self.from_long / (I1 * self.from_short),
        };
        if n.is_finite() { n } else { 0.0 }
    }

    fn circled_moment(&self) -> f64 {
        self.moments[self.mode.circled()]
    }

    /// `+1` where the bending of the polhode hastens the precession, `−1` where it slows it.
    fn direction(&self) -> f64 {
        match self.mode {
            Mode::ShortAxis => 1.0,
            Mode::LongAxis => -1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The closed form of the mean angular velocity beside the mean of samples, from small wobbles to next to the separatrix.
    #[test]
    fn mean_spin_is_the_mean_of_the_spin() {
        let moments = [1.0, 1.6, 2.1];
        for mode in [Mode::ShortAxis, Mode::LongAxis] {
            for xi in [-7.0, -2.0, 0.0, 3.0, 20.0] {
                let motion = FreeRotation::at_logit(moments, 0.7, mode, xi);
                let sampled = [0, 1, 2].map(|axis| motion.mean(1, |omega| omega[axis]));
                let size = motion.mean_spin()[mode.circled()];
                for (closed, sampled) in motion.mean_spin().into_iter().zip(sampled) {
                    assert!(
                        (closed - sampled.abs()).abs() < 1e-12 * size,
                        "{mode:?} {xi}: {closed} {sampled}"
                    );
                }
            }
        }
    }
}
