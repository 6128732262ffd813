//! Incompressible flow: conjugate gradients for the pressure of a discrete Stokes problem, many loads at once.
//! Only the velocity block is factored; the stopping rule accepts a divergence that rounding keeps from falling, but never a large one.
//! Equation (L4), docs/theory/13-inside.md.

use super::stokes::StokesError;

/// Equations of an incompressible flow: `A u + Bᵀ p = f`, `B u = 0`.
///
/// Numbers stand row by row, a row per component or per pressure, `width` numbers to a row.
pub(super) trait Incompressible {
    /// `A⁻¹ f`, in place.
    fn flow(&self, forces: &mut [f64], width: usize);
    /// `B u`.
    fn divergence(&self, u: &[f64], width: usize) -> Vec<f64>;
    /// `Bᵀ p`.
    fn push(&self, p: &[f64], width: usize) -> Vec<f64>;
    /// `M⁻¹ d` with the mass matrix of the pressure, in place.
    fn weigh(&self, divergence: &mut [f64], width: usize);
    /// Approximation of `(B A⁻¹ Bᵀ)⁻¹ d`, given `M⁻¹ d`, which is close unless inertia dominates.
    fn pressure(&self, _divergence: &[f64], weighted: &[f64], _width: usize) -> Vec<f64> {
        weighted.to_vec()
    }
}

/// Divergence that counts as zero, relative to the gradient of the flow without pressure, in the mean square.
const SOLENOIDAL: f64 = 1e-13;
/// Divergence that is accepted where rounding keeps the divergence from falling further.
const ACCEPTED_DIVERGENCE: f64 = 1e-10;
/// Iterations without a new least divergence after which the divergence has stopped falling.
const PATIENCE: usize = 20;
/// Most iterations.
const MAX_ITERATIONS: usize = 2000;

/// Flows under forces, in place.
///
/// Conjugate gradients on `B A⁻¹ Bᵀ p = B A⁻¹ f`, whose residual is the divergence of the flow. Pressures without an effect on any flow,
/// the constant among them, take no part, for the right-hand side has none of them.
///
/// # Errors
/// [`StokesError::NoConvergence`].
pub(super) fn solve(
    equations: &impl Incompressible,
    forces: &mut [f64],
    width: usize,
) -> Result<(), StokesError> {
    let f = forces.to_vec();
    let u = forces;
    equations.flow(u, width);
    let mut progress = Progress::new(dots(&f, u, width));
    let mut search: Option<(Vec<f64>, Vec<f64>)> = None;
    for iterations in 0.. {
        let residual = equations.divergence(u, width);
        let mut weighted = residual.clone();
        equations.weigh(&mut weighted, width);
        progress.advance(dots(&residual, &weighted, width));
        let active: Vec<bool> = (0..width).map(|column| progress.is_active(column)).collect();
        if !active.contains(&true) {
            break;
        }
        if iterations == MAX_ITERATIONS || progress.is_lost() {
            return Err(StokesError::NoConvergence { iterations, divergence: progress.worst() });
        }
        let corrected = equations.pressure(&residual, &weighted, width);
        let slopes = dots(&residual, &corrected, width);
        let direction = match search {
            None => corrected,
            Some((before, last)) => sum(&corrected, &ratios(&slopes, &last, &active), &before),
        };
        let mut push = equations.push(&direction, width);
        equations.flow(&mut push, width);
        let curvature = dots(&direction, &equations.divergence(&push, width), width);
        let lengths = ratios(&slopes, &curvature, &active);
        for (u, push) in u.chunks_exact_mut(width).zip(push.chunks_exact(width)) {
            u.iter_mut().zip(push).zip(&lengths).for_each(|((u, push), length)| *u -= length * push);
        }
        search = Some((direction, slopes));
    }
    Ok(())
}

/// `√∫|d|² dV` of the discrete divergence `d` of a flow.
#[cfg(test)]
pub(super) fn divergence_of(equations: &impl Incompressible, u: &[f64]) -> f64 {
    let residual = equations.divergence(u, 1);
    let mut weighted = residual.clone();
    equations.weigh(&mut weighted, 1);
    dots(&residual, &weighted, 1)[0].max(0.0).sqrt()
}

/// Squared divergence of each flow over the iterations.
struct Progress {
    /// Squared gradient without pressure.
    gradient: Vec<f64>,
    now: Vec<f64>,
    least: Vec<f64>,
    /// Iterations since the least.
    since: Vec<usize>,
}

impl Progress {
    fn new(gradient: Vec<f64>) -> Self {
        let width = gradient.len();
        let least = vec![f64::INFINITY; width];
        Self { gradient, now: least.clone(), least, since: vec![0; width] }
    }

    /// Records the next squares.
    fn advance(&mut self, next: Vec<f64>) {
        for (column, square) in next.iter().enumerate() {
            let better = *square < self.least[column];
            self.since[column] = if better { 0 } else { self.since[column] + 1 };
            self.least[column] = self.least[column].min(*square);
        }
        self.now = next;
    }

    /// Whether the divergence of a flow still falls.
    fn is_active(&self, column: usize) -> bool {
        let below = |share: f64| self.now[column] <= share.powi(2) * self.gradient[column];
        !(below(SOLENOIDAL) || below(ACCEPTED_DIVERGENCE) && self.since[column] >= PATIENCE)
    }

    /// Whether numbers are no longer finite.
    fn is_lost(&self) -> bool {
        self.now.iter().chain(&self.gradient).any(|square| !square.is_finite())
    }

    /// Largest divergence of a flow relative to its gradient without pressure.
    fn worst(&self) -> f64 {
        let shares = self.now.iter().zip(&self.gradient).map(|(now, gradient)| (now / gradient).sqrt());
        shares.fold(0.0, |worst, share| if share <= worst { worst } else { share })
    }
}

/// Scalar products of vectors stored row by row.
fn dots(a: &[f64], b: &[f64], width: usize) -> Vec<f64> {
    let mut sums = vec![0.0; width];
    for (a, b) in a.chunks_exact(width).zip(b.chunks_exact(width)) {
        sums.iter_mut().zip(a).zip(b).for_each(|((sum, a), b)| *sum += a * b);
    }
    sums
}

/// Quotients, zero for vectors that are not asked for.
fn ratios(above: &[f64], below: &[f64], asked: &[bool]) -> Vec<f64> {
    let ratio = |((above, below), asked): ((&f64, &f64), &bool)| if *asked { above / below } else { 0.0 };
    above.iter().zip(below).zip(asked).map(ratio).collect()
}

/// `a + s b`, a factor for each vector.
fn sum(a: &[f64], shares: &[f64], b: &[f64]) -> Vec<f64> {
    let terms = a.iter().zip(b).zip(shares.iter().cycle());
    terms.map(|((a, b), share)| a + share * b).collect()
}
