//! Slowest motions about a steady spin of a body of many coordinates, with the rate up to which they were counted.
//! The nutation starts from the second variation of the energy, the others from a Krylov basis; inverse iteration gives them their digits, and
//! the argument principle says whether one is missing.
//! Equation (M24), docs/theory/15-modes.md.

use nalgebra::Complex;

use super::blocks::BlockPencil;
use super::count::Count;
use super::definite::{positive_energy, positive_masses};
use super::equilibrium::RelativeEquilibrium;
use super::error::ModesError;
use super::iteration::{Nonlinear, Pair, belongs, inverse_iteration, polished, product};
use super::krylov::Krylov;
use super::range::SlowModes;
use super::slow::SlowDirection;
use super::spectrum::{Eigenmotion, ZERO};
use super::unknowns::Unknowns;
use crate::math::eigen::NoConvergence;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Motions that are looked for, at least.
const WANTED: usize = 16;
/// Motions beyond those, among which the rate up to which they are told is chosen.
const SPARE: usize = 6;
/// Vectors of the first Krylov basis, by how many it grows, and the most.
const FIRST_VECTORS: usize = 50;
const MORE_VECTORS: usize = 25;
const MAX_VECTORS: usize = 200;
/// Krylov bases that are tried where motions are missing.
const BASES: u64 = 3;
/// Shift over the slowest of the coordinates by themselves.
const SHIFT: f64 = 0.3;
/// Relative difference of eigenvalues, and share of a motion outside those of the same eigenvalue, from which it is another one.
const SAME_EIGENVALUE: f64 = 1e-7;
const INDEPENDENT: f64 = 1e-3;
/// Share of an eigenvalue below which its imaginary part is rounding.
const REAL: f64 = 1e-12;
/// Ratio of the rate up to which motions are told to the fastest, where there are no others.
const BEYOND: f64 = 2.0;

/// Slowest motions in the equations of motion, `Im λ ≥ 0`, without the zeros of the steady spins beside this one, and which they are. (M24)
///
/// # Errors
/// [`ModesError`] if the mass matrix is not positive, or no motion is found.
pub(super) fn slowest(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
    slow: Option<&SlowDirection>,
) -> Result<(Vec<Eigenmotion>, SlowModes), ModesError> {
    if positive_masses(body, coefficients) != Some(true) {
        return Err(ModesError::BeyondRange);
    }
    let pencil = BlockPencil::new(Unknowns::of_motion(body), equilibrium, coefficients);
    // zeros that rounding splits are not counted
    let count = if slow.is_some_and(|slow| slow.neutral() == 0) { Count::new(&pencil) } else { None };
    let mut search = Search { pencil: &pencil, spin: norm(equilibrium.omega), found: Vec::new() };
    let starts = slow.into_iter().flat_map(|slow| slow.starts(pencil.unknowns.size));
    starts.for_each(|start| search.add(start.0, inverse_iteration(&pencil, start)));
    let directions = search.found.len();
    let zeros = 1 + body.cyclic().len();
    let mut rate = 0.0;
    let mut missing = None;
    for seed in 1..=BASES {
        let exhausted = search.krylov(seed)?;
        rate = search.rate(directions, count.as_ref(), exhausted);
        let own: usize = search.slower(rate).map(|(lambda, _)| if lambda.im > 0.0 { 2 } else { 1 }).sum();
        missing = count.as_ref().and_then(|count| count.below(rate)?.checked_sub(own + zeros));
        if missing.is_none_or(|missing| missing == 0) {
            break;
        }
    }
    if search.found.is_empty() {
        return Err(NoConvergence { size: pencil.unknowns.size }.into());
    }
    let positive_energy = positive_energy(body, coefficients, slow);
    let range = SlowModes { rate, missing, positive_energy };
    let told = |(place, pair): &(usize, &Pair)| *place < directions || pair.0.norm() < rate;
    let pairs = search.found.iter().enumerate().filter(told);
    Ok((pairs.map(|(_, pair)| pencil.unknowns.motion(pair)).collect(), range))
}

/// Search for motions of a body.
struct Search<'a> {
    pencil: &'a BlockPencil<'a>,
    /// Spin (rad/s).
    spin: f64,
    found: Vec<Pair>,
}

impl Search<'_> {
    /// Adds the motion that a start with this eigenvalue led to, if it is new.
    fn add(&mut self, near: Complex<f64>, refined: Option<Pair>) {
        let Some((mut lambda, x)) = refined.filter(|(lambda, _)| belongs(*lambda, near)) else { return };
        if lambda.im.abs() <= REAL * lambda.norm() {
            lambda.im = 0.0;
        }
        if lambda.norm() > ZERO * self.spin && self.is_new(lambda, &x) {
            self.found.push((lambda, x));
        }
    }

    /// Whether a motion is outside the span of those found with its eigenvalue.
    fn is_new(&self, lambda: Complex<f64>, x: &[Complex<f64>]) -> bool {
        let weights = self.pencil.weights(lambda);
        let mut rest = x.to_vec();
        let mut known: Vec<Vec<Complex<f64>>> = Vec::new();
        let less = |x: &mut Vec<Complex<f64>>, known: &[Vec<Complex<f64>>]| {
            for other in known {
                let share = product(&weights, other, x) / product(&weights, other, other);
                x.iter_mut().zip(other).for_each(|(x, other)| *x -= share * other);
            }
        };
        for (other, motion) in &self.found {
            if (other - lambda).norm() <= SAME_EIGENVALUE * lambda.norm() {
                let mut own = motion.clone();
                less(&mut own, &known);
                known.push(own);
            }
        }
        less(&mut rest, &known);
        let [left, whole] = [&rest[..], x].map(|x| product(&weights, x, x).re.sqrt());
        left > INDEPENDENT * whole
    }

    /// Adds the motions of a Krylov basis; true where it spans those of the whole body.
    fn krylov(&mut self, seed: u64) -> Result<bool, ModesError> {
        let size = self.pencil.unknowns.size;
        let Some(mut krylov) = Krylov::new(self.pencil, self.shift(), seed) else {
            return Err(NoConvergence { size }.into());
        };
        let mut vectors = FIRST_VECTORS;
        let (motions, exhausted) = loop {
            let more = krylov.extend(vectors);
            let motions = krylov.motions()?;
            if more != Some(true) || vectors >= MAX_VECTORS || motions.len() >= WANTED + SPARE {
                break (motions, more == Some(false));
            }
            vectors += MORE_VECTORS;
        };
        let least = ZERO * self.spin;
        for pair in motions.into_iter().filter(|(lambda, _)| lambda.norm() > least) {
            self.add(pair.0, polished(self.pencil, pair));
        }
        Ok(exhausted)
    }

    /// Real shift (1/s) of the order of the slowest motions.
    fn shift(&self) -> f64 {
        let own = self
            .pencil
            .block_entries()
            .filter(|(j, k, [mass, _, stiffness])| j == k && *mass > 0.0 && *stiffness > 0.0);
        let slowest =
            own.map(|(.., [mass, _, stiffness])| (stiffness / mass).sqrt()).fold(f64::INFINITY, f64::min);
        self.spin.max(if slowest.is_finite() { SHIFT * slowest } else { 0.0 })
    }

    /// Motions slower than a rate (1/s).
    fn slower(&self, rate: f64) -> impl Iterator<Item = &Pair> {
        self.found.iter().filter(move |(lambda, _)| lambda.norm() < rate)
    }

    /// Rate (1/s) up to which motions are told: beyond those wanted and those of the direction of spin, in the widest gap between eigenvalues.
    fn rate(&self, directions: usize, count: Option<&Count>, exhausted: bool) -> f64 {
        let mut own: Vec<f64> = self.found.iter().map(|(lambda, _)| lambda.norm()).collect();
        let least = own[..directions].iter().fold(0.0_f64, |least, size| least.max(*size));
        own.sort_by(f64::total_cmp);
        let (Some(wanted), Some(last)) = (own.get(WANTED.min(own.len().max(1)) - 1), own.last()) else {
            return 0.0;
        };
        let (from, to) = (wanted.max(least), if exhausted { BEYOND * last } else { *last });
        let blocks = count.into_iter().flat_map(Count::sizes);
        let mut all: Vec<f64> = own.iter().copied().chain(blocks).filter(|size| *size < to).collect();
        all.push(to);
        all.sort_by(f64::total_cmp);
        let gaps = all.windows(2).filter(|gap| gap[0] >= from);
        let widest = gaps.max_by(|a, b| (a[1] / a[0]).total_cmp(&(b[1] / b[0])));
        widest.map_or(to, |gap| (gap[0] * gap[1]).sqrt())
    }
}

#[cfg(test)]
#[path = "slowest_tests.rs"]
mod tests;
