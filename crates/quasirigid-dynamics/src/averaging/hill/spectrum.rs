//! Fourier amplitudes of the angular velocity and of its six products along a polhode.
//! Mean products are sums of squares of the amplitudes, so that they are consistent with the truncated series; a steady spin is a series
//! of one term.
//! Equations (H4), docs/theory/14-spinning-frame.md, and (G5), docs/theory/11-materials.md.

use nalgebra::Complex;

use crate::averaging::harmonics::{Harmonic, Series};
use crate::averaging::poinsot::FreeRotation;

/// Fourier amplitudes of the angular velocity and of its six products along a polhode, from the mean on. (H4)
#[derive(Clone, Debug)]
pub(super) struct Spectrum {
    /// Frequency `Ω_p` of the polhode (rad/s); zero of a steady spin.
    pub frequency: f64,
    /// Number of harmonics of the products that stand out of rounding.
    pub count: usize,
    /// Amplitudes of the angular velocity (rad/s), principal axes.
    pub spin: Vec<[Complex<f64>; 3]>,
    /// Amplitudes of xx, yy, zz, yz, zx, xy (rad²/s²).
    pub products: Vec<[Complex<f64>; 6]>,
    /// First harmonic of the angular velocity over its mean, at most 1.
    pub wobble: f64,
    /// Time (s) from phase zero to `t = 0`.
    pub origin: f64,
}

/// Relative amplitude below which harmonics are left out.
const WEAK: f64 = 1e-17;

impl Spectrum {
    /// The amplitudes along a motion; none on the separatrix, which has no period.
    pub fn of(motion: &FreeRotation) -> Option<Self> {
        if let Some(omega) = motion.steady() {
            return Some(Self::constant(omega));
        }
        let series = Series::of(motion);
        if !motion.polhode_period().is_finite() {
            return None;
        }
        if series.count() == 0 {
            return Some(Self::constant(series.spin(0).map(|rate| rate.re)));
        }
        let reach = series.reach(WEAK);
        let spin: Vec<_> = (0..=reach).map(|number| series.spin(number)).collect();
        let mut mean = [Complex::from(0.0); 6];
        for (number, amplitudes) in spin.iter().enumerate() {
            let weight = if number == 0 { 1.0 } else { 2.0 };
            for axis in 0..3 {
                mean[axis] += weight * amplitudes[axis].norm_sqr();
            }
        }
        let [yz, zx, xy] = series.signs();
        let signs = [1.0, 1.0, 1.0, yz, zx, xy];
        let product = |number: usize| {
            let Harmonic { products: [real, imaginary], .. } = series.harmonic(number);
            [0, 1, 2, 3, 4, 5].map(|i| signs[i] * Complex::new(real[i], imaginary[i]))
        };
        let size =
            |amplitudes: [Complex<f64>; 3]| amplitudes.map(|c| c.norm_sqr()).iter().sum::<f64>().sqrt();
        Some(Self {
            frequency: series.harmonic(1).frequency,
            count: series.count(),
            wobble: (size(spin[1]) / size(spin[0])).min(1.0),
            products: std::iter::once(mean).chain((1..=reach).map(product)).collect(),
            spin,
            origin: motion.time_from_origin(),
        })
    }

    fn constant(omega: [f64; 3]) -> Self {
        let [x, y, z] = omega;
        Self {
            frequency: 0.0,
            count: 0,
            spin: vec![omega.map(Complex::from)],
            products: vec![[x * x, y * y, z * z, y * z, z * x, x * y].map(Complex::from)],
            wobble: 1.0,
            origin: 0.0,
        }
    }

    /// Mean angular velocity (rad/s), principal axes.
    pub fn mean_spin(&self) -> [f64; 3] {
        self.spin[0].map(|rate| rate.re)
    }

    /// Amplitudes of one component of the angular velocity, from the first harmonic on.
    pub fn component(&self, axis: usize) -> Vec<Complex<f64>> {
        self.spin[1..].iter().map(|amplitudes| amplitudes[axis]).collect()
    }

    /// Amplitudes of one product, from the first harmonic on.
    pub fn product(&self, index: usize) -> Vec<Complex<f64>> {
        self.products[1..].iter().map(|amplitudes| amplitudes[index]).collect()
    }
}
