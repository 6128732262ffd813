//! Torque-free rigid body: its invariants along a history, the excess that measures the wobble, and the rounding of each.
//! Equations (A2) and (A6), docs/theory/10-torque-free.md; the excess (J1), docs/theory/22-audit.md.

use quasirigid::model::{Mode, Principal};
use quasirigid_math::sym3::{Sym, inverse, times};
use quasirigid_math::vec3::{cross, norm};

/// Rigid body by its inertia tensor (kg·m²) in the axes of the rates.
#[derive(Clone, Copy, Debug)]
pub struct Rigid {
    tensor: Sym,
    inverse: Sym,
    /// Principal moments and axes.
    pub principal: Principal,
}

/// Invariants at a row of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invariants {
    /// Twice the kinetic energy, `ω·Jω`.
    pub energy: f64,
    /// Magnitude of the angular momentum, `|Jω|`.
    pub momentum: f64,
    /// Excess about the axis of greatest moment, `2EI₃/G² − 1`, and about that of least, `1 − 2EI₁/G²`: in the square of a small wobble. (J1)
    excess: [f64; 2],
    /// Positive in the long-axis mode, negative in the short-axis mode.
    side: f64,
    /// Most by which rounding of the rates changes energy and angular momentum, relative, and the two excesses.
    pub rounding: Rounding,
}

/// Most by which rounding changes the invariants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// Of the energy, relative.
    pub energy: f64,
    /// Of the angular momentum, relative.
    pub momentum: f64,
    excess: [f64; 2],
}

/// Rounding errors of the arithmetic in units of the last place.
const ARITHMETIC: f64 = 4.0 * f64::EPSILON;

impl Rigid {
    /// The body with this tensor, which is positive definite.
    pub fn new(tensor: Sym) -> Self {
        Self { tensor, inverse: inverse(tensor), principal: Principal::compute(tensor) }
    }

    /// Whether some wobble exists: not of three equal moments.
    pub fn wobbles(&self) -> bool {
        Mode::any_exists(self.principal.moments)
    }

    /// Angular momentum (kg·m²·rad/s), body axes.
    pub fn momentum(&self, omega: [f64; 3]) -> [f64; 3] {
        times(self.tensor, omega)
    }

    /// Rate of the angular velocity of the free body, `J⁻¹ (Jω × ω)`. (P1)
    pub fn acceleration(&self, omega: [f64; 3]) -> [f64; 3] {
        times(self.inverse, cross(self.momentum(omega), omega))
    }

    /// Invariants at an angular velocity that is not zero, each component of which may be off by `error`.
    pub fn invariants(&self, omega: [f64; 3], error: [f64; 3]) -> Invariants {
        let moments = self.principal.moments;
        let [least, middle, greatest] = moments;
        let w = self.principal.components(omega);
        let off = self.principal.axes.map(|axis| {
            let turned: f64 = axis.iter().zip(error).map(|(part, error)| part.abs() * error).sum();
            turned + ARITHMETIC * norm(omega)
        });
        let sum = |weight: &dyn Fn(f64) -> f64| (0..3).map(|i| weight(moments[i]) * w[i] * w[i]).sum::<f64>();
        let shift = |weight: &dyn Fn(f64) -> f64| {
            (0..3).map(|i| weight(moments[i]).abs() * (2.0 * w[i].abs() + off[i]) * off[i]).sum::<f64>()
        };
        let (energy, square) = (sum(&|moment| moment), sum(&|moment| moment * moment));
        let of_square = shift(&|moment| moment * moment) / square;
        let over = |weight: &dyn Fn(f64) -> f64| {
            let excess = sum(weight) / square;
            (excess, shift(weight) / square + excess.abs() * of_square)
        };
        let short = over(&|moment| moment * (greatest - moment));
        let long = over(&|moment| moment * (moment - least));
        Invariants {
            energy,
            momentum: square.sqrt(),
            excess: [short.0, long.0],
            side: sum(&|moment| moment * (middle - moment)),
            rounding: Rounding {
                energy: shift(&|moment| moment) / energy + ARITHMETIC,
                momentum: 0.5 * of_square + ARITHMETIC,
                excess: [short.1, long.1],
            },
        }
    }

    /// Wobble (rad): the largest angle in a period between the angular momentum and the axis that it circles. (P8)
    pub fn wobble(&self, mode: Mode, excess: f64) -> f64 {
        let [least, middle, greatest] = self.principal.moments;
        let square = match mode {
            Mode::ShortAxis => excess * middle / (greatest - middle),
            Mode::LongAxis => excess * middle / (middle - least),
        };
        square.clamp(0.0, 1.0).sqrt().asin()
    }
}

impl Invariants {
    /// The mode, of a body of these moments.
    pub fn mode(&self, moments: [f64; 3]) -> Mode {
        let mode = if self.side > 0.0 { Mode::LongAxis } else { Mode::ShortAxis };
        if mode.exists(moments) { mode } else { mode.other() }
    }

    /// The excess of a mode, and the most by which rounding changes it.
    pub fn excess(&self, mode: Mode) -> (f64, f64) {
        let place = usize::from(mode == Mode::LongAxis);
        (self.excess[place], self.rounding.excess[place])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tensor in turned axes, against the same sums by the tensor itself.
    #[test]
    fn excess_is_that_of_energy_and_angular_momentum() {
        let tensor = [3.0, 4.0, 5.0, 0.4, -0.3, 0.2];
        let body = Rigid::new(tensor);
        let [least, middle, greatest] = body.principal.moments;
        for omega in [[0.3, -0.2, 0.9], [0.9, 0.1, -0.2]] {
            let found = body.invariants(omega, [0.0; 3]);
            let momentum = body.momentum(omega);
            let energy: f64 = momentum.iter().zip(omega).map(|(a, b)| a * b).sum();
            let square: f64 = momentum.iter().map(|part| part * part).sum();
            let x = energy / square;
            assert!((found.excess(Mode::ShortAxis).0 - (x * greatest - 1.0)).abs() < 1e-14);
            assert!((found.excess(Mode::LongAxis).0 - (1.0 - x * least)).abs() < 1e-14);
            let expected = if x * middle > 1.0 { Mode::LongAxis } else { Mode::ShortAxis };
            assert_eq!(found.mode(body.principal.moments), expected);
        }
    }

    /// Where the angular momentum leans farthest, in the plane of the middle axis. (P8)
    #[test]
    fn wobble_is_the_largest_angle_of_the_angular_momentum() {
        let body = Rigid::new([2.0, 3.0, 4.0, 0.0, 0.0, 0.0]);
        for (mode, axis) in [(Mode::ShortAxis, 2), (Mode::LongAxis, 0)] {
            let mut direction = [0.0; 3];
            (direction[1], direction[axis]) = (0.3_f64.sin(), 0.3_f64.cos());
            let omega = [direction[0] / 2.0, direction[1] / 3.0, direction[2] / 4.0];
            let (excess, _) = body.invariants(omega, [0.0; 3]).excess(mode);
            assert!((body.wobble(mode, excess) - 0.3).abs() < 1e-14);
        }
    }
}
