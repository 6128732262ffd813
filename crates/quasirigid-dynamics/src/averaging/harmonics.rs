//! Fourier series of the six products of the angular velocity along a polhode, in closed form.
//! Powers of the nome instead of a transform of samples: amplitudes keep all digits for a wobble of any size and next to the separatrix.
//! Equations (G5), docs/theory/11-materials.md, and (H4), docs/theory/14-spinning-frame.md.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;

use super::poinsot::FreeRotation;
use crate::math::elliptic::{SMALL_PARAMETER, first_of_complement, nome_over_parameter};
use crate::model::Mode;

/// Harmonic of the six products of the angular velocity along the polhode. (G5)
///
/// The products are `Re Σ 2 mₙ e^{inΩ_p t}` beside their means, in principal axes; the motion starts at the phase zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Number `n`, from 1.
    pub number: usize,
    /// Frequency `nΩ_p` (rad/s).
    pub frequency: f64,
    /// Amplitudes of xx, yy, zz, yz, zx, xy (rad²/s²): real parts, and imaginary parts.
    pub products: [[f64; 6]; 2],
}

/// Square of the relative amplitude below which harmonics are left out.
const WEAK: f64 = 1e-18;

impl FreeRotation {
    /// Harmonics of the products of the angular velocity, from the first to the last above rounding; none of a motion that is steady, and
    /// none on the separatrix, which has no period. (G5)
    pub fn harmonics(&self) -> impl Iterator<Item = Harmonic> {
        let series = Series::of(self);
        (1..=series.count).map(move |number| series.harmonic(number))
    }
}

/// Common data of the harmonics of a motion: nome, amplitudes, frequency.
pub(super) struct Series {
    mode: Mode,
    side: f64,
    amplitudes: [f64; 3],
    polhode: f64,
    /// Nome `q`, and `q/k²` and `√q/k`, which stay finite for small `k`.
    nome: f64,
    over_square: f64,
    over_root: f64,
    /// `π²/K²`.
    scale: f64,
    count: usize,
}

impl Series {
    pub(super) fn of(motion: &FreeRotation) -> Self {
        let (m, complement) = (motion.parameter(), motion.complement());
        let quarter = first_of_complement(complement);
        let (nome, over_square) = if m < SMALL_PARAMETER {
            let ratio = nome_over_parameter(m);
            (m * ratio, ratio)
        } else {
            let nome = (-PI * first_of_complement(m) / quarter).exp();
            (nome, nome / m)
        };
        let significant = WEAK.ln() / nome.ln();
        let period = motion.polhode_period();
        let moves = period.is_finite() && motion.amplitudes().iter().filter(|rate| **rate > 0.0).count() > 1;
        Self {
            mode: motion.mode(),
            side: motion.side(),
            amplitudes: motion.amplitudes(),
            polhode: TAU / period,
            nome,
            over_square,
            over_root: over_square.sqrt(),
            scale: (PI / quarter).powi(2),
            count: if moves { 2 + significant.ceil() as usize } else { 0 },
        }
    }

    /// Amplitudes of a harmonic. Of the products of the elliptic functions squares and `sn cn` have the even harmonics, the others the
    /// odd ones; cosines have real amplitudes, sines imaginary ones.
    pub(super) fn harmonic(&self, number: usize) -> Harmonic {
        let [a, b, c] = self.amplitudes;
        let [mut real, mut imaginary] = [[0.0; 6]; 2];
        let power = self.nome.powi(number as i32);
        let half = number as f64 / 2.0;
        let (dull, bright) = (self.scale * half / (1.0 - power), self.scale * half / (1.0 + power));
        let round = self.mode == Mode::ShortAxis;
        if number.is_multiple_of(2) {
            let near = self.over_square * self.nome.powi(number as i32 / 2 - 1);
            let far = self.nome.powi(number as i32 / 2);
            let (cn, sn, dn) = (near * dull, -near * dull, far * dull);
            let sn_cn = -near * bright;
            [real[0], real[1], real[2]] = if round {
                [a * a * cn, b * b * sn, c * c * dn]
            } else {
                [a * a * dn, b * b * sn, c * c * cn]
            };
            if round {
                imaginary[5] = a * b * sn_cn;
            } else {
                imaginary[3] = b * c * sn_cn;
            }
        } else {
            let near = self.over_root * self.nome.powi(number as i32 / 2);
            let (cn_dn, sn_dn) = (near * dull, -near * bright);
            real[4] = a * c * cn_dn;
            if round {
                imaginary[3] = b * c * sn_dn;
            } else {
                imaginary[5] = a * b * sn_dn;
            }
        }
        Harmonic { number, frequency: number as f64 * self.polhode, products: [real, imaginary] }
    }

    /// Number of the harmonic that [`FreeRotation::harmonics`] ends with: the squares of those beyond are below rounding.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Number of the harmonic beyond which amplitudes are weaker than `weak` of the first ones.
    pub(super) fn reach(&self, weak: f64) -> usize {
        if self.count == 0 { 0 } else { 2 + (2.0 * weak.ln() / self.nome.ln()).ceil() as usize }
    }

    /// Amplitude of `e^{inΩ_p t}` in the angular velocity (rad/s), principal axes, on the side the motion is on; the mean for `n = 0`.
    /// (H4)
    pub(super) fn spin(&self, number: usize) -> [Complex<f64>; 3] {
        let [a, b, c] = self.amplitudes;
        let side = Complex::from(self.side);
        let root = self.scale.sqrt();
        let power = self.nome.powi(number as i32);
        let zero = Complex::from(0.0);
        let [sn, cn, dn] = if number.is_multiple_of(2) {
            let half = if number == 0 { 0.5 } else { self.nome.powi(number as i32 / 2) / (1.0 + power) };
            [zero, zero, Complex::from(root * half)]
        } else {
            let near = root * self.over_root * self.nome.powi(number as i32 / 2);
            [Complex::new(0.0, -near / (1.0 - power)), Complex::from(near / (1.0 + power)), zero]
        };
        match self.mode {
            Mode::ShortAxis => [a * cn, side * b * sn, side * c * dn],
            Mode::LongAxis => [side * a * dn, side * b * sn, c * cn],
        }
    }

    /// Signs of the products yz, zx, xy on the side the motion is on, beside those on the positive side.
    pub(super) fn signs(&self) -> [f64; 3] {
        match self.mode {
            Mode::ShortAxis => [1.0, self.side, self.side],
            Mode::LongAxis => [self.side, self.side, 1.0],
        }
    }
}
