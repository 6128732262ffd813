//! Invariant manifold of a polynomial system: state, motion and defect at its coordinates.

use nalgebra::Complex;

use super::eigenpair::{Eigenpair, complex, pairs};
use super::expansion::turning;
use super::ring::{Ring, Truncated, total};
use super::system::{Equations, PolynomialSystem};

/// Invariant manifold `x = W(z)` with its motion `ż = R(z)`, tangent to the masters of an equilibrium. (W3)
#[derive(Clone, Debug)]
pub struct InvariantManifold {
    /// Monomials of the coordinates.
    pub ring: Ring,
    /// Masters, one for each coordinate.
    pub masters: Vec<Master>,
    /// `W`, a polynomial for each component of the state.
    pub state: Vec<Truncated>,
    /// `R`, a polynomial for each coordinate.
    pub rates: Vec<Truncated>,
}

/// Master mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Master {
    /// Eigenvalue and vectors; the right vector sets the unit of the coordinate.
    pub mode: Eigenpair,
    /// Index of the master with the conjugate eigenvalue; its own of a real one.
    pub partner: usize,
    /// Whole numbers of turns with each phase that turns alone: resonant masters share a phase. (W5)
    pub weight: Vec<i32>,
}

/// Monomial whose rate comes near an eigenvalue that the motion does not keep there. (W6)
#[derive(Clone, Debug, PartialEq)]
pub struct NearResonance {
    /// Exponents of the masters.
    pub exponents: Vec<u8>,
    /// Index of the eigenvalue in the list given.
    pub other: usize,
    /// Distance of the rate from the eigenvalue, over the larger of their sizes.
    pub distance: f64,
}

/// Defect of the manifold at a point: what the motion `R` leaves of the equations. (W7)
#[derive(Clone, Debug)]
pub struct Residual {
    /// State.
    pub state: Vec<f64>,
    /// Rate of the state by the motion on the manifold.
    pub rate: Vec<f64>,
    /// `d/dt P(W) − F(W)`.
    pub defect: Vec<f64>,
    /// Forces `F(W)`.
    pub forces: Vec<f64>,
}

impl Master {
    pub(super) fn lambda(&self) -> Complex<f64> {
        Complex::new(self.mode.lambda[0], self.mode.lambda[1])
    }
}

impl InvariantManifold {
    /// Number of coordinates that a real motion has: one of each pair of conjugates.
    #[must_use]
    pub fn free(&self) -> usize {
        self.masters.iter().enumerate().filter(|(k, master)| master.partner >= *k).count()
    }

    /// All coordinates of a real motion, from one of each pair.
    pub(super) fn coordinates(&self, free: &[[f64; 2]]) -> Vec<Complex<f64>> {
        let mut given = complex(free);
        let mut z = vec![Complex::default(); self.masters.len()];
        for (k, master) in self.masters.iter().enumerate() {
            if master.partner >= k {
                z[k] = given.next().unwrap_or_default();
                z[master.partner] = z[k].conj();
            }
        }
        z
    }

    /// Values of the monomials at coordinates, one of each pair of conjugates, for [`Monomials::value`].
    #[must_use]
    pub fn monomials(&self, free: &[[f64; 2]]) -> Monomials {
        Monomials(self.ring.values(&self.coordinates(free)))
    }

    /// State at coordinates.
    #[must_use]
    pub fn state_at(&self, free: &[[f64; 2]]) -> Vec<f64> {
        let monomials = self.monomials(free);
        self.state.iter().map(|row| monomials.value(row)[0]).collect()
    }

    /// Rates of the coordinates, one of each pair of conjugates.
    #[must_use]
    pub fn rates_at(&self, free: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let monomials = self.monomials(free);
        let own = self.masters.iter().enumerate().filter(|(k, master)| master.partner >= *k);
        own.map(|(k, _)| monomials.value(&self.rates[k])).collect()
    }

    /// Defect at coordinates. (W7)
    #[must_use]
    pub fn residual(&self, system: &dyn PolynomialSystem, free: &[[f64; 2]]) -> Residual {
        let z = self.coordinates(free);
        let values = self.ring.values(&z);
        let rates: Vec<Complex<f64>> = self.rates.iter().map(|row| row.value(&values)).collect();
        let changes = self.ring.changes(&values, &z, &rates);
        let state: Vec<f64> = self.state.iter().map(|row| row.value(&values).re).collect();
        let rate: Vec<f64> = self.state.iter().map(|row| row.value(&changes).re).collect();
        let line = Ring::new(1, 1);
        let x: Vec<Truncated> = state.iter().zip(&rate).map(|(x, rate)| line.shifted(*x, 0, *rate)).collect();
        let Equations { momenta, forces } = system.equations(&line, &x);
        let forces: Vec<f64> = forces.iter().map(|force| force.at(0).re).collect();
        let change = momenta.iter().map(|momentum| momentum.at(1).re);
        let defect = change.zip(&forces).map(|(change, force)| change - force).collect();
        Residual { state, rate, defect, forces }
    }

    /// Polynomial `G` of the coordinates and mean `ḡ` with `DG·R + ḡ = g`: the integral of `g` along the motion less that of its mean,
    /// which keeps the monomials that do not turn. (W8)
    #[must_use]
    pub fn integral(&self, g: &Truncated) -> (Truncated, Truncated) {
        let (mut integral, mut mean) = (self.ring.zero(), self.ring.zero());
        for degree in 0..=self.ring.degree() {
            let mut left = self.ring.resized(g);
            for (k, rate) in self.rates.iter().enumerate() {
                self.ring.add_product(&mut left, -1.0, &self.ring.derivative(&integral, k), rate);
            }
            for monomial in self.ring.of_degree(degree) {
                let exponents = &self.ring.exponents()[monomial];
                let s: Complex<f64> = exponents
                    .iter()
                    .zip(&self.masters)
                    .map(|(power, master)| master.lambda() * f64::from(*power))
                    .sum();
                if turning(&self.masters, exponents).iter().all(|weight| *weight == 0) {
                    mean.set(monomial, left.at(monomial));
                } else {
                    integral.set(monomial, left.at(monomial) / s);
                }
            }
        }
        (integral, mean)
    }

    /// Monomials from degree 2 to a degree whose rates come within a distance of eigenvalues that the motion does not keep: of `others`,
    /// real and imaginary part. Nearest first. (W6)
    #[must_use]
    pub fn near_resonances(&self, others: &[[f64; 2]], degree: usize, within: f64) -> Vec<NearResonance> {
        let mut found = Vec::new();
        for exponents in self.ring.exponents().iter().filter(|m| (2..=degree).contains(&total(m))) {
            let s: Complex<f64> = exponents
                .iter()
                .zip(&self.masters)
                .map(|(power, master)| master.lambda() * f64::from(*power))
                .sum();
            for (other, lambda) in complex(others).enumerate() {
                let distance = (s - lambda).norm() / s.norm().max(lambda.norm());
                if distance <= within {
                    found.push(NearResonance { exponents: exponents.clone(), other, distance });
                }
            }
        }
        found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        found
    }

    /// Right vector of a master, for those who scale.
    #[must_use]
    pub fn tangent(&self, master: usize) -> Vec<[f64; 2]> {
        let column: Vec<Complex<f64>> = self.state.iter().map(|row| row.at(1 + master)).collect();
        pairs(&column)
    }
}

/// Values of the monomials at a point.
#[derive(Clone, Debug)]
pub struct Monomials(Vec<Complex<f64>>);

impl Monomials {
    /// Value of a polynomial, real and imaginary part.
    #[must_use]
    pub fn value(&self, polynomial: &Truncated) -> [f64; 2] {
        let value = polynomial.value(&self.0);
        [value.re, value.im]
    }
}
