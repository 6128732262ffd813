//! Expansion of an invariant manifold, degree by degree: `D(P∘W)·R = F∘W`.
//! The unknowns of a degree enter linearly; everything else is arithmetic of truncated polynomials with those unknowns at zero.

use std::ops::ControlFlow;

use nalgebra::Complex;
use thiserror::Error;

use super::eigenpair::{Eigenpair, Vector, complex};
use super::homological::{Border, solve};
use super::linear_part::LinearPart;
use super::manifold::{InvariantManifold, Master};
use super::ring::{Ring, Truncated};
use super::system::{Equations, PolynomialSystem};

/// Style of the parametrisation. (W5)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Normal form: the motion keeps only monomials that turn with their master, and amplitudes separate from phases.
    #[default]
    NormalForm,
    /// Graph: the manifold has no higher coefficient along the masters, the motion keeps every monomial.
    Graph,
}

/// Plan of an expansion.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Master modes: complex ones as pairs, each before its conjugate.
    pub masters: Vec<Master>,
    /// Style.
    pub style: Style,
    /// Highest degree, from 1.
    pub degree: usize,
}

/// Error of an expansion.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ExpansionError {
    /// The homological equation of a monomial is singular.
    #[error(
        "the expansion has no coefficient of the monomial with exponents {exponents:?}: a multiple of the frequencies of the masters meets that of a mode left out"
    )]
    Singular {
        /// Exponents of the masters.
        exponents: Vec<u8>,
    },
    /// The change of the conserved quantity is no mode of the equilibrium.
    #[error("the change of the conserved quantity was not found among the modes of the equilibrium")]
    Level,
    /// The caller asked for an end.
    #[error("the expansion was interrupted")]
    Interrupted,
}

/// Expands the manifold through an equilibrium that is tangent to the masters. (W3), (W4)
///
/// `watch` is called with the share of the work done; `Break` ends the expansion.
///
/// # Errors
/// [`ExpansionError`].
pub fn expand(
    system: &dyn PolynomialSystem,
    linear: &LinearPart,
    plan: Plan,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<InvariantManifold, ExpansionError> {
    let Plan { masters, style, degree } = plan;
    let ring = Ring::new(masters.len(), degree);
    let mut expansion = Expansion::new(linear, masters, style, &ring)?;
    for degree in 2..=degree {
        expansion.add_degree(system, degree, &ring, watch)?;
    }
    let Expansion { masters, W, R, .. } = expansion;
    Ok(InvariantManifold { ring, masters, state: W, rates: R })
}

struct Expansion<'a> {
    linear: &'a LinearPart,
    masters: Vec<Master>,
    style: Style,
    borders: Vec<Border>,
    conserved: Option<Border>,
    W: Vec<Truncated>,
    R: Vec<Truncated>,
}

/// Rates of masters at a monomial, with the index of each.
type Rates = Vec<(usize, Complex<f64>)>;

impl<'a> Expansion<'a> {
    /// Equilibrium and tangent.
    fn new(
        linear: &'a LinearPart,
        masters: Vec<Master>,
        style: Style,
        ring: &Ring,
    ) -> Result<Self, ExpansionError> {
        let mut W: Vec<Truncated> = linear.state.iter().map(|x| ring.constant(*x)).collect();
        let mut R = vec![ring.zero(); masters.len()];
        for (k, master) in masters.iter().enumerate() {
            for (row, entry) in W.iter_mut().zip(complex(&master.mode.right)) {
                row.set(1 + k, entry);
            }
            R[k].set(1 + k, master.lambda());
        }
        let borders = masters
            .iter()
            .map(|master| Border::of_mode(linear, &master.mode.right, &master.mode.left))
            .collect();
        let conserved = match &linear.conserved {
            Some(gradient) => Some(level_border(linear, gradient).ok_or(ExpansionError::Level)?),
            None => None,
        };
        Ok(Self { linear, style, borders, conserved, masters, W, R })
    }

    /// Adds the coefficients of a degree. (W4)
    fn add_degree(
        &mut self,
        system: &dyn PolynomialSystem,
        degree: usize,
        whole: &Ring,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), ExpansionError> {
        let ring = Ring::new(self.masters.len(), degree);
        let cut =
            |rows: &[Truncated]| -> Vec<Truncated> { rows.iter().map(|row| ring.resized(row)).collect() };
        let rates = cut(&self.R);
        let Equations { momenta, forces } = system.equations(&ring, &cut(&self.W));
        let level = system.conserved(&ring, &momenta);
        let right: Vec<Truncated> = momenta
            .iter()
            .zip(forces)
            .map(|(momentum, mut right)| {
                for (k, rate) in rates.iter().enumerate() {
                    ring.add_product(&mut right, -1.0, &ring.derivative(momentum, k), rate);
                }
                right
            })
            .collect();
        for monomial in ring.of_degree(degree) {
            let exponents = &ring.exponents()[monomial];
            let twin = ring.index(&self.conjugate(exponents)).expect("conjugates have the same degree");
            if twin < monomial {
                continue;
            }
            let share = monomial as f64 / whole.size() as f64;
            if watch(share).is_break() {
                return Err(ExpansionError::Interrupted);
            }
            let load: Vector = right.iter().map(|row| row.at(monomial)).collect();
            let level = level.as_ref().map(|level| -level.at(monomial));
            let found = self.coefficient(exponents, &load, level);
            let (W, R) = found.ok_or_else(|| ExpansionError::Singular { exponents: exponents.clone() })?;
            self.store(monomial, &W, &R, |value| value, |k| k);
            if twin != monomial {
                let partners: Vec<usize> = self.masters.iter().map(|master| master.partner).collect();
                self.store(twin, &W, &R, |value| value.conj(), |k| partners[k]);
            }
        }
        Ok(())
    }

    /// Coefficients of the state and of the rates at a monomial. (W4), (W5)
    fn coefficient(
        &self,
        exponents: &[u8],
        load: &[Complex<f64>],
        level: Option<Complex<f64>>,
    ) -> Option<(Vector, Rates)> {
        let kept: Vec<usize> = (0..self.masters.len()).filter(|k| self.keeps(exponents, *k)).collect();
        let mut borders: Vec<&Border> = kept.iter().map(|k| &self.borders[*k]).collect();
        let mut levels = vec![Complex::default(); kept.len()];
        if let (Some(border), Some(level)) = (&self.conserved, level) {
            borders.push(border);
            levels.push(level);
        }
        let s: Complex<f64> = exponents
            .iter()
            .zip(&self.masters)
            .map(|(power, master)| master.lambda() * f64::from(*power))
            .sum();
        let (W, R) = solve(self.linear, s, &borders, load, &levels)?;
        Some((W, kept.into_iter().zip(R).collect()))
    }

    fn store(
        &mut self,
        monomial: usize,
        W: &[Complex<f64>],
        R: &[(usize, Complex<f64>)],
        value: impl Fn(Complex<f64>) -> Complex<f64>,
        master: impl Fn(usize) -> usize,
    ) {
        self.W.iter_mut().zip(W).for_each(|(row, entry)| row.set(monomial, value(*entry)));
        R.iter().for_each(|(k, rate)| self.R[master(*k)].set(monomial, value(*rate)));
    }

    /// True if the motion of a master keeps a monomial. (W5)
    fn keeps(&self, exponents: &[u8], k: usize) -> bool {
        self.style == Style::Graph || turning(&self.masters, exponents) == self.masters[k].weight
    }

    /// Exponents of the conjugate monomial.
    fn conjugate(&self, exponents: &[u8]) -> Vec<u8> {
        self.masters.iter().map(|master| exponents[master.partner]).collect()
    }
}

/// Weight with which a monomial turns.
pub(super) fn turning(masters: &[Master], exponents: &[u8]) -> Vec<i32> {
    let groups = masters.first().map_or(0, |master| master.weight.len());
    let mut sum = vec![0; groups];
    for (master, power) in masters.iter().zip(exponents) {
        sum.iter_mut().zip(&master.weight).for_each(|(sum, weight)| *sum += weight * i32::from(*power));
    }
    sum
}

/// Border that keeps the conserved quantity at its level; its mode is the change of level, with eigenvalue zero.
fn level_border(linear: &LinearPart, gradient: &[f64]) -> Option<Border> {
    let guess: Vec<[f64; 2]> = linear
        .scales
        .iter()
        .zip(gradient)
        .map(|(scale, slope)| [scale * (scale * slope + 0.1), 0.0])
        .collect();
    let Eigenpair { right, left, .. } = linear.refined([0.0, 0.0], &guess)?;
    let Border { column, .. } = Border::of_mode(linear, &right, &left);
    Some(Border { column, row: gradient.iter().copied().map(Complex::from).collect() })
}
