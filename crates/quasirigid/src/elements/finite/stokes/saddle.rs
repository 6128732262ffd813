use super::StokesError;
use super::divergence::Divergence;
use crate::math::factor::Factor;

/// The equations of the flow: `A u + Bᵀ p = f`, `B u = 0`. (L4)
///
/// With walls that hold all three components, `A` is the same scalar Laplacian for each of them.
pub(super) struct Saddle {
    /// Of `∫ ∇N_a·∇N_b dV` over the nodes that move.
    pub laplacian: Factor,
    pub divergence: Divergence,
    /// Of the pressure's mass matrix, which `B A⁻¹ Bᵀ` is close to.
    pub pressure: Factor,
}

/// Divergence that counts as none, beside the gradient of the flow without pressure, in the mean square.
const SOLENOIDAL: f64 = 1e-13;
/// Divergence that is accepted if it falls no more, by rounding.
const ACCEPTED: f64 = 1e-10;
/// Iterations without a new least divergence after which it falls no more.
const PATIENCE: usize = 20;
/// Most iterations.
const MOST: usize = 2000;

/// Squares of the divergence of each flow, as the iterations go.
struct Progress {
    /// Of the gradient without pressure.
    gradient: Vec<f64>,
    now: Vec<f64>,
    least: Vec<f64>,
    /// Iterations since the least.
    since: Vec<usize>,
}

impl Saddle {
    /// Flows under forces stored row by row, `width` to a row, in place.
    ///
    /// Conjugate gradients on `B A⁻¹ Bᵀ p = B A⁻¹ f`, whose residual is the divergence of the flow. Pressures that no
    /// flow feels, the constant among them, take no part, for the right-hand side has none of them.
    ///
    /// # Errors
    /// [`StokesError::NoConvergence`].
    pub fn solve(&self, forces: &mut [f64], width: usize) -> Result<(), StokesError> {
        let f = forces.to_vec();
        let u = forces;
        self.laplacian.solve(u, 3 * width);
        let mut progress = Progress::new(dots(&f, u, width));
        let mut direction = vec![0.0; self.divergence.vertices * width];
        for iterations in 0.. {
            let (residual, weighted) = self.residual(u, width);
            let before = progress.advance(dots(&residual, &weighted, width));
            let active: Vec<bool> = (0..width).map(|column| progress.is_active(column)).collect();
            if !active.contains(&true) {
                break;
            }
            if iterations == MOST || progress.is_lost() {
                return Err(StokesError::NoConvergence { iterations, divergence: progress.worst() });
            }
            let shares = ratios(&progress.now, &before, &active);
            direction = sum(&weighted, &shares, &direction);
            let mut push = self.divergence.transposed_times(&direction, width);
            self.laplacian.solve(&mut push, 3 * width);
            let curvature = dots(&direction, &self.divergence.times(&push, width), width);
            let lengths = ratios(&progress.now, &curvature, &active);
            for (u, push) in u.chunks_exact_mut(width).zip(push.chunks_exact(width)) {
                u.iter_mut().zip(push).zip(&lengths).for_each(|((u, push), length)| *u -= length * push);
            }
        }
        Ok(())
    }

    /// `B u`, and its pressure `M⁻¹ B u`.
    fn residual(&self, u: &[f64], width: usize) -> (Vec<f64>, Vec<f64>) {
        let residual = self.divergence.times(u, width);
        let mut weighted = residual.clone();
        self.pressure.solve(&mut weighted, width);
        (residual, weighted)
    }

    /// `√∫|d|² dV` of the discrete divergence `d` of a flow.
    #[cfg(test)]
    pub fn divergence_of(&self, u: &[f64]) -> f64 {
        let (residual, weighted) = self.residual(u, 1);
        dots(&residual, &weighted, 1)[0].max(0.0).sqrt()
    }
}

impl Progress {
    fn new(gradient: Vec<f64>) -> Self {
        let width = gradient.len();
        let least = vec![f64::INFINITY; width];
        Self { gradient, now: least.clone(), least, since: vec![0; width] }
    }

    /// Takes the next squares; returns those before.
    fn advance(&mut self, next: Vec<f64>) -> Vec<f64> {
        for (column, square) in next.iter().enumerate() {
            let better = *square < self.least[column];
            self.since[column] = if better { 0 } else { self.since[column] + 1 };
            self.least[column] = self.least[column].min(*square);
        }
        std::mem::replace(&mut self.now, next)
    }

    /// Whether a flow still has a divergence that falls.
    fn is_active(&self, column: usize) -> bool {
        let below = |share: f64| self.now[column] <= share.powi(2) * self.gradient[column];
        !(below(SOLENOIDAL) || below(ACCEPTED) && self.since[column] >= PATIENCE)
    }

    /// Whether numbers left their range.
    fn is_lost(&self) -> bool {
        self.now.iter().chain(&self.gradient).any(|square| !square.is_finite())
    }

    /// Largest divergence of a flow beside its gradient without pressure.
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

/// Quotients, zero where nothing is asked for.
fn ratios(above: &[f64], below: &[f64], asked: &[bool]) -> Vec<f64> {
    let ratio = |((above, below), asked): ((&f64, &f64), &bool)| if *asked { above / below } else { 0.0 };
    above.iter().zip(below).zip(asked).map(ratio).collect()
}

/// `a + s b`, a factor for each vector.
fn sum(a: &[f64], shares: &[f64], b: &[f64]) -> Vec<f64> {
    let terms = a.iter().zip(b).zip(shares.iter().cycle());
    terms.map(|((a, b), share)| a + share * b).collect()
}
