//! Mean power of wobbling ellipsoids from the harmonics of the polhode, in lanes.
//! Axes are named by their part in the motion: the circled one, the middle one and the other; so both modes have one formula.
//! Equations (A1), (A2), docs/theory/10-torque-free.md; (G5), (G7) and (G15), docs/theory/11-materials.md.

use std::f64::consts::PI;

use crate::math::elliptic::{SMALL_PARAMETER, nome_over_parameter};
use crate::math::lanes::{Lanes, Mask};

/// Loss of a material, by the numbers of its law in each lane: `tan δ = ν · time + 1/Q` of a unit modulus.
#[derive(Clone, Copy, Debug)]
pub(super) struct Losses {
    /// Time of a Kelvin–Voigt material (s), or zero.
    pub time: Lanes,
    /// Inverse of a quality factor, or zero.
    pub inverse_quality: Lanes,
}

/// Rotations about an axis of extreme inertia, in lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wobbles {
    /// Moments of inertia (kg·m²): of the circled axis, the middle one, the other.
    pub moments: [Lanes; 3],
    /// Angular momentum (N·m·s).
    pub angular_momentum: Lanes,
    /// Static compliance on the squares about these axes.
    pub squares: [[Lanes; 3]; 3],
    /// Compliance on the products of middle and other, other and circled, circled and middle.
    pub products: [Lanes; 3],
    pub losses: Losses,
}

/// State of the wobble at a place `ξ`.
#[derive(Clone, Copy, Debug)]
pub(super) struct WobbleState {
    /// Mean power (W).
    pub power: Lanes,
    /// `|dE/dξ|` (J).
    pub energy_slope: Lanes,
    /// `2E/G` (rad/s), the mean rate of revolution about the angular momentum.
    pub revolution: Lanes,
    /// Frequency of the polhode (rad/s).
    pub polhode: Lanes,
    /// Energy above that of the steady spin about the circled axis, without its sign (J).
    pub from_axis: Lanes,
}

/// Steps of the arithmetic-geometric mean, which bring any ratio of this module to rounding.
const MEANS: usize = 7;
/// Power, relative to the first harmonics, below which harmonics are left out.
const WEAK: f64 = 1e-12;
/// Limit of the harmonics.
const HARMONICS: usize = 2000;

impl Wobbles {
    /// The wobble at a place, with its mean power. (G7), (G15)
    #[inline(always)]
    pub fn at(&self, xi: Lanes) -> WobbleState {
        let one = Lanes::splat(1.0);
        let [circled, middle, other] = self.moments;
        let exponential = xi.map(libm::exp);
        let to_axis = one / (one + exponential);
        let to_separatrix = exponential / (one + exponential);
        let away = (circled - middle).abs();
        let wide = (circled - other).abs();
        let equivalent = circled + (middle - circled) * to_axis;
        let twice_energy = self.angular_momentum * self.angular_momentum / equivalent;
        let near = twice_energy * away * to_axis;
        let far = twice_energy * away * to_separatrix;
        let from_other = twice_energy * (equivalent - other).abs();
        let haste = away * from_other;
        let parameter = (middle - other).abs() * near / haste;
        let complement = wide * far / haste;
        let series = Nome::of(parameter, complement);
        let rate = (haste / (circled * middle * other)).sqrt();
        let polhode = Lanes::splat(0.5 * PI) * rate / series.quarter;
        let amplitudes = [from_other / (circled * wide), near / (middle * away), near / (other * wide)];
        let energy = Lanes::splat(0.5) * twice_energy;
        let square = self.angular_momentum * self.angular_momentum;
        WobbleState {
            power: self.power(&series, amplitudes, polhode),
            energy_slope: energy * near / square * to_separatrix,
            revolution: twice_energy / self.angular_momentum,
            polhode,
            from_axis: Lanes::splat(0.5) * near / circled,
        }
    }

    /// Sum over the harmonics, from the squares of the amplitudes of the angular velocity about the circled, middle and other axis. (G15)
    #[inline(always)]
    fn power(&self, series: &Nome, [circled, middle, other]: [Lanes; 3], polhode: Lanes) -> Lanes {
        let one = Lanes::splat(1.0);
        // relative amplitudes of the squares are those of dn², −sn² and cn²
        let shape = [series.parameter * circled, Lanes::splat(0.0) - middle, other];
        let mut on_squares = Lanes::splat(0.0);
        for i in 0..3 {
            for j in 0..3 {
                on_squares = on_squares + self.squares[i][j] * shape[i] * shape[j];
            }
        }
        let even = [on_squares, self.products[0] * middle * other];
        let odd = [self.products[1] * other * circled, self.products[2] * circled * middle];
        let nome = series.nome;
        let mut weights = [series.over_square, series.over_square * series.over_square];
        let mut powers = [nome, nome * nome];
        let step = powers[1];
        let mut sum = Lanes::splat(0.0);
        let mut largest = sum;
        // a lane ends its own sum, so that it does not depend on the others
        let (mut open, mut weak_before) = (!Mask::NONE, Mask::NONE);
        for number in 1..HARMONICS {
            let parity = (number + 1) % 2;
            let [dull, bright] = if parity == 1 { even } else { odd };
            let power = powers[parity];
            let (minus, plus) = (one - power, one + power);
            let frequency = Lanes::splat(number as f64) * polhode;
            let both = minus * plus;
            let tangent = self.losses.tangent(frequency);
            let energy = weights[parity] * (plus * plus * dull + minus * minus * bright);
            let factor = Lanes::splat(0.5 * (number as f64).powi(2)) * frequency * tangent;
            let taken = factor * energy / (both * both * (one + tangent * tangent));
            sum = (sum + taken).select(open, sum);
            largest = largest.max(taken);
            weights[parity] = weights[parity] * step;
            powers[parity] = power * step;
            let weak = taken.at_most(Lanes::splat(WEAK) * largest);
            open = open & !(weak & weak_before);
            weak_before = weak;
            if open == Mask::NONE {
                break;
            }
        }
        series.scale * series.scale * sum
    }
}

impl Losses {
    /// Tangent of the loss angle at a frequency (rad/s): `tan δ/(1 + tan² δ)` is minus the imaginary part of the inverse modulus. (G6)
    #[inline(always)]
    fn tangent(&self, frequency: Lanes) -> Lanes {
        frequency * self.time + self.inverse_quality
    }
}

/// Nome of the elliptic functions and what the harmonics take of it. (G5)
struct Nome {
    /// `K`, the quarter of the period.
    quarter: Lanes,
    /// `k²`.
    parameter: Lanes,
    /// `q`, and `q/k²`, which stays finite for small `k`.
    nome: Lanes,
    over_square: Lanes,
    /// `π²/K²`.
    scale: Lanes,
}

impl Nome {
    /// From `k²` and `1 − k²`, neither of which has lost digits.
    #[inline(always)]
    fn of(parameter: Lanes, complement: Lanes) -> Self {
        let quarter = first_of_complement(complement);
        let ratio = nome_over_parameter(parameter);
        let small = parameter.at_most(Lanes::splat(SMALL_PARAMETER));
        let exponent =
            Lanes::splat(-PI) * first_of_complement(parameter.max(Lanes::splat(SMALL_PARAMETER))) / quarter;
        let whole = exponent.map(libm::exp);
        let scale = Lanes::splat(PI) / quarter;
        Self {
            quarter,
            parameter,
            nome: (parameter * ratio).select(small, whole),
            over_square: ratio.select(small, whole / parameter),
            scale: scale * scale,
        }
    }
}

/// `K(1 − m)` by the arithmetic-geometric mean of 1 and `√m`.
#[inline(always)]
fn first_of_complement(m: Lanes) -> Lanes {
    let half = Lanes::splat(0.5);
    let (mut arithmetic, mut geometric) = (Lanes::splat(1.0), m.sqrt());
    for _ in 0..MEANS {
        let mean = half * (arithmetic + geometric);
        geometric = (arithmetic * geometric).sqrt();
        arithmetic = mean;
    }
    Lanes::splat(0.5 * PI) / arithmetic
}
