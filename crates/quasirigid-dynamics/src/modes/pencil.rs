//! Nonlinear eigenproblem of the spinning body, `P(λ)x = 0`, and its refinement by inverse iteration.
//! Materials and liquids with an impedance have no finite number of coordinates, so that only the nonlinear problem has their modes; it
//! starts from those with dashpots.
//! Equation (M3), docs/theory/15-modes.md; (L15), docs/theory/13-inside.md.

use nalgebra::{Complex, Matrix3, Vector3};

use super::equilibrium::RelativeEquilibrium;
use super::iteration::{Nonlinear, Solution, times};
use super::unknowns::{Unknowns, modulus, turning};
use crate::math::eigen::Dense;
use crate::math::lu::ComplexDense;
use crate::math::sym3;
use crate::model::{FlexibleBody, SpinCoefficients, Viscoelastic};

/// Dynamic stiffness of the spinning body, `P(λ)(δω, δq) = 0`: a nonlinear eigenproblem where a material or a liquid depends on the
/// frequency. (M3)
pub(super) struct Pencil<'a> {
    pub unknowns: Unknowns<'a>,
    omega: Vector3<f64>,
    angular_momentum: Vector3<f64>,
    coefficients: &'a SpinCoefficients,
    /// `A`, `B + G` and `C − N` of the kept coordinates.
    mass: Dense,
    velocity: Dense,
    stiffness: Dense,
    viscoelastic: Vec<(&'a Viscoelastic, Dense)>,
}

impl<'a> Pencil<'a> {
    pub fn new(
        body: &'a FlexibleBody,
        equilibrium: &RelativeEquilibrium,
        coefficients: &'a SpinCoefficients,
    ) -> Self {
        let unknowns = Unknowns::exact(body);
        let kept = &unknowns.kept;
        let (B, C) = (Dense::of(body.damping()), Dense::of(body.stiffness()));
        let part = |entry: &dyn Fn(usize, usize) -> f64| {
            let mut part = Dense::zero(kept.len());
            for (row, j) in kept.iter().enumerate() {
                kept.iter().enumerate().for_each(|(column, k)| part.add(row, column, entry(*j, *k)));
            }
            part
        };
        let SpinCoefficients { mass: A, gyroscopic, centrifugal, .. } = coefficients;
        let viscoelastic = |viscoelastic: &'a Viscoelastic| {
            let whole = Dense::of(&viscoelastic.stiffness);
            (viscoelastic, part(&|j, k| whole.at(j, k)))
        };
        Self {
            omega: equilibrium.omega.into(),
            angular_momentum: equilibrium.angular_momentum.into(),
            coefficients,
            mass: part(&|j, k| A.at(j, k)),
            velocity: part(&|j, k| B.at(j, k) + gyroscopic.at(j, k)),
            stiffness: part(&|j, k| C.at(j, k) - centrifugal.at(j, k)),
            viscoelastic: body.viscoelastic().iter().map(viscoelastic).collect(),
            unknowns,
        }
    }

    /// `P(λ)`.
    fn at(&self, lambda: Complex<f64>) -> ComplexDense {
        let mut P = ComplexDense::zero(self.unknowns.size);
        let pair = |value: Complex<f64>| [value.re, value.im];
        let turning = turning(lambda, self.omega);
        let J = Matrix3::from(sym3::rows(self.coefficients.inertia)).map(Complex::from);
        let body = turning * J - self.angular_momentum.cross_matrix().map(Complex::from);
        for row in 0..3 {
            (0..3).for_each(|column| P.add(row, column, pair(body[(row, column)])));
        }
        for (place, (h, u)) in self.unknowns.couplings(self.coefficients).enumerate() {
            let [h, u] = [h, u].map(|vector| Vector3::from(vector).map(Complex::from));
            let column = turning * (h * lambda + u);
            let row = h * lambda - u;
            for axis in 0..3 {
                P.add(axis, 3 + place, pair(column[axis]));
                P.add(3 + place, axis, pair(row[axis]));
            }
        }
        let factors: Vec<_> =
            self.viscoelastic.iter().map(|(material, _)| modulus(material, lambda)).collect();
        let count = self.unknowns.kept.len();
        let square = lambda * lambda;
        for j in 0..count {
            for k in 0..count {
                let mut sum = square * self.mass.at(j, k)
                    + lambda * self.velocity.at(j, k)
                    + Complex::from(self.stiffness.at(j, k));
                for ((_, stiffness), factor) in self.viscoelastic.iter().zip(&factors) {
                    sum += factor * stiffness.at(j, k);
                }
                P.add(3 + j, 3 + k, pair(sum));
            }
        }
        for (i, j, entry) in self.unknowns.impedances(lambda, self.omega) {
            P.add(3 + i, 3 + j, pair(entry));
        }
        P
    }
}

impl Nonlinear for Pencil<'_> {
    fn times(&self, lambda: Complex<f64>, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
        times(&self.at(lambda), x)
    }

    fn solve(&self, lambda: Complex<f64>, right: &[Complex<f64>]) -> Solution {
        Solution::dense(&self.at(lambda), right)
    }

    fn weights(&self, lambda: Complex<f64>) -> Vec<f64> {
        let [xx, yy, zz, ..] = self.coefficients.inertia;
        let square = lambda.norm_sqr();
        let coordinates = (0..self.unknowns.kept.len()).map(|j| square * self.mass.at(j, j));
        let liquids = self
            .unknowns
            .memories
            .iter()
            .flat_map(|(_, memory)| memory.axes.iter().map(move |_| square * memory.inertia));
        [xx, yy, zz].into_iter().chain(coordinates).chain(liquids).collect()
    }
}
