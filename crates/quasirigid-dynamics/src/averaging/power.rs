//! Mean power dissipated on a torque-free rotation: the trait, and its two implementations by harmonics and by polynomial.
//! Only monomials with even powers of every principal component have a mean; the mean over equal steps of a quarter period converges
//! exponentially.
//! Equations (A5), docs/theory/10-torque-free.md; (G7) and (D2), docs/theory/11-materials.md.

use std::fmt::Debug;
use std::sync::Arc;

use super::poinsot::FreeRotation;
use super::response::Response;
use crate::math::elliptic::{first_of_complement, jacobi};
use crate::math::polynomial::{Homogeneous, Series};
use crate::model::{Principal, ReducedBody};

/// Mean power that a body dissipates on a free rotation (W).
pub trait MeanPower: Debug + Send + Sync {
    /// Principal moments of the body (kg·m²), ascending.
    fn moments(&self) -> [f64; 3];

    /// Mean over a period of the polhode; zero on the separatrix, where the period is infinite.
    fn mean_power(&self, motion: &FreeRotation) -> f64;

    /// Bound of the relative rounding of that mean, where terms that nearly cancel leave it; zero where none do.
    fn rounding(&self, _motion: &FreeRotation) -> f64 {
        0.0
    }

    /// Mean power (W) that each dissipator takes, by name, mean of both senses of the motion; empty where the shares are not known. (D2)
    fn budget(&self, _motion: &FreeRotation) -> Vec<(String, f64)> {
        Vec::new()
    }
}

/// Implements [`MeanPower`] for pointers to one.
macro_rules! mean_power_behind {
    ($($pointer:ty),*) => {$(
        impl<P: MeanPower + ?Sized> MeanPower for $pointer {
            fn moments(&self) -> [f64; 3] {
                (**self).moments()
            }

            fn mean_power(&self, motion: &FreeRotation) -> f64 {
                (**self).mean_power(motion)
            }

            fn rounding(&self, motion: &FreeRotation) -> f64 {
                (**self).rounding(motion)
            }

            fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
                (**self).budget(motion)
            }
        }
    )*};
}

mean_power_behind!(&P, Box<P>, Arc<P>);

impl MeanPower for Response {
    fn moments(&self) -> [f64; 3] {
        self.principal().moments
    }

    /// The sum over the harmonics. (G7)
    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        self.harmonic_powers(motion).fold(0.0, |sum, (_, power)| sum + power)
    }

    fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
        Self::budget(self, motion)
    }
}

impl Response {
    /// Mean power of each harmonic (W), with its frequency (rad/s): harmonic 1 first. (G7)
    pub fn harmonic_powers(&self, motion: &FreeRotation) -> impl Iterator<Item = (f64, f64)> {
        let mean_spin = motion.mean_spin();
        motion.harmonics().map(move |harmonic| (harmonic.frequency, self.power(&harmonic, mean_spin)))
    }
}

/// Power of the reduced equations, a polynomial, prepared for averaging. (A5)
///
/// Only monomials with even powers in every principal component have a mean; the rest is a polynomial in the squares.
#[derive(Clone, Debug)]
pub struct PolynomialPower {
    moments: [f64; 3],
    degree: usize,
    terms: Terms,
    /// Bound of the rounding of the terms, those among them that vanish in other axes.
    rounding: Terms,
    /// Terms of each dissipator, by name.
    shares: Vec<(String, Terms)>,
}

/// Terms of a polynomial in the squares of the components: exponents and coefficient.
type Terms = Vec<([usize; 3], f64)>;

/// Points of the mean per quarter period and `K/K′`: harmonic `2n` falls as the power `n` of the nome, to 1e-17.
const POINTS: f64 = 6.5;
/// Rounding of a term, relative to the largest of its degree: of the reduction and of the turn to principal axes.
const TERM_ROUNDING: f64 = 1e-15;

impl PolynomialPower {
    /// The power of a reduced body.
    #[must_use]
    pub fn from_reduced(body: &ReducedBody) -> Self {
        let Principal { moments, axes } = Principal::compute(body.J);
        let own = |(name, power): &(String, Series)| (name.clone(), squares(&even_parts(power, axes)));
        let parts = even_parts(&body.power, axes);
        Self {
            moments,
            degree: body.power.degree(),
            terms: squares(&parts),
            rounding: roundings(&parts),
            shares: body.power_shares.iter().map(own).collect(),
        }
    }

    /// Mean of polynomials over a period of the polhode.
    fn means<'t>(&self, motion: &FreeRotation, polynomials: impl Iterator<Item = &'t Terms>) -> Vec<f64> {
        let complement = motion.complement();
        let quarter = first_of_complement(complement);
        if !quarter.is_finite() {
            return polynomials.map(|_| 0.0).collect();
        }
        let stretch = quarter / first_of_complement(motion.parameter());
        let points = self.degree / 4 + 2 + (POINTS * stretch).ceil() as usize;
        let sample = |i: usize| {
            let u = quarter * (i as f64 + 0.5) / points as f64;
            motion.at_argument(jacobi(u, complement)).map(|rate| rate * rate)
        };
        let samples: Vec<[f64; 3]> = (0..points).map(sample).collect();
        let mean = |terms: &Terms| samples.iter().map(|at| value(terms, *at)).sum::<f64>() / points as f64;
        polynomials.map(mean).collect()
    }
}

/// Parts of even degree of a power, in principal axes.
fn even_parts(power: &Series, axes: [[f64; 3]; 3]) -> Vec<Homogeneous> {
    (2..=power.degree()).step_by(2).map(|degree| power.part(degree).in_axes(axes)).collect()
}

/// Terms with a nonzero mean.
fn squares(parts: &[Homogeneous]) -> Terms {
    let mut terms = Vec::new();
    for part in parts {
        for (exponents, coefficient) in part.terms() {
            let even = exponents.iter().all(|power| power % 2 == 0);
            let on_an_axis = exponents.contains(&part.degree());
            if even && !on_an_axis && coefficient[0] != 0.0 {
                terms.push((exponents.map(|power| power / 2), coefficient[0]));
            }
        }
    }
    terms
}

/// Every term that may have a mean, with the rounding of the largest coefficient of its degree.
fn roundings(parts: &[Homogeneous]) -> Terms {
    let mut terms = Vec::new();
    for part in parts {
        let largest = part.terms().map(|(_, coefficient)| coefficient[0].abs()).fold(0.0, f64::max);
        let half = part.degree() / 2;
        let all = (0..=half).flat_map(|i| (0..=half - i).map(move |j| [i, j, half - i - j]));
        let off_the_axes = all.filter(|exponents| !exponents.contains(&half));
        terms.extend(off_the_axes.map(|exponents| (exponents, TERM_ROUNDING * largest)));
    }
    terms
}

fn value(terms: &Terms, squares: [f64; 3]) -> f64 {
    let power = |axis: usize, exponent: usize| squares[axis].powi(exponent as i32);
    let term = |([i, j, k], value): &([usize; 3], f64)| value * power(0, *i) * power(1, *j) * power(2, *k);
    terms.iter().map(term).fold(0.0, |sum, term| sum + term) // the sum of no terms is +0, not -0
}

impl MeanPower for PolynomialPower {
    fn moments(&self) -> [f64; 3] {
        self.moments
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        self.means(motion, std::iter::once(&self.terms))[0]
    }

    /// Beside a plane of steady spins the largest terms are the rounding of zeros in turned axes.
    fn rounding(&self, motion: &FreeRotation) -> f64 {
        let means = self.means(motion, [&self.terms, &self.rounding].into_iter());
        if means[1] > 0.0 { means[1] / means[0].abs() } else { 0.0 }
    }

    fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
        let means = self.means(motion, self.shares.iter().map(|(_, terms)| terms));
        self.shares.iter().map(|(name, _)| name.clone()).zip(means).collect()
    }
}
