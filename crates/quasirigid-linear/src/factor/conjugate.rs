//! Refinement of solutions by conjugate gradients, several right-hand sides at a time.

use crate::watch;

/// `A x = b` with an inverse that may be rough, for vectors stored row by row, `width` to a row.
pub(super) struct System<'a> {
    pub width: usize,
    /// `S` that scales the unknowns to a unit diagonal; residuals are measured as `|S r|`.
    pub scale: &'a [f64],
    /// `A x`.
    pub times: &'a dyn Fn(&[f64]) -> Vec<f64>,
    /// Whether `precondition` is right to rounding, so that conjugate gradients have nothing to add.
    pub exact: bool,
    /// `A⁻¹ r`, in place.
    pub precondition: &'a dyn Fn(&mut [f64]),
}

/// Result of a refinement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// Products with the approximate inverse after the first.
    pub iterations: usize,
    /// Largest `|S (b − A x)| / |S b|` of a right-hand side.
    pub residual: f64,
}

/// Largest gain of one run of conjugate gradients, before the true residual is computed anew.
const GAIN: f64 = 1e-7;
/// A step that leaves more than this of the residual is the last.
const STALLED: f64 = 0.5;
/// Residuals below this share of the solution, for a unit diagonal, are rounding: that of the product `A x` comes to
/// about one epsilon, that of a solution by a factor in double precision to two or three.
const RESIDUAL_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl System<'_> {
    /// Solves from zero: `right` becomes the solution, to rounding or until so many iterations are spent.
    pub fn solve(&self, right: &mut [f64], target: f64, most: usize) -> Refinement {
        let goal = self.norms(right);
        let b = right.to_vec();
        let mut residual = b.clone();
        let mut best = Refinement { iterations: 0, residual: f64::INFINITY };
        right.fill(0.0);
        let (mut spent, mut gain) = (0, GAIN);
        loop {
            watch::ask();
            let mut step = residual.clone();
            if self.exact {
                (self.precondition)(&mut step);
            } else {
                spent += self.descend(&mut step, gain, most.saturating_sub(spent));
            }
            step.iter_mut().zip(right.iter()).for_each(|(new, old)| *new += old);
            residual.iter_mut().zip((self.times)(&step)).zip(&b).for_each(|((r, Ax), b)| *r = b - Ax);
            let left = largest_ratio(&self.norms(&residual), &goal);
            if !(left < best.residual) {
                return Refinement { iterations: spent, ..best };
            }
            let stalled = left > STALLED * best.residual;
            best.residual = left;
            right.copy_from_slice(&step);
            let rounding = RESIDUAL_ROUNDING * largest_ratio(&self.lengths(right), &goal);
            let enough = target.max(rounding);
            if stalled || left <= enough || spent >= most {
                return Refinement { iterations: spent, ..best };
            }
            gain = GAIN.max(0.5 * enough / left);
        }
    }

    /// Conjugate gradients from zero until each residual has fallen to the share `gain`; returns the iterations.
    fn descend(&self, right: &mut [f64], gain: f64, most: usize) -> usize {
        let start = self.norms(right);
        let mut residual = right.to_vec();
        let mut direction = residual.clone();
        (self.precondition)(&mut direction);
        let mut energy = self.dots(&residual, &direction);
        right.fill(0.0);
        for iteration in 0.. {
            watch::ask();
            let force = (self.times)(&direction);
            let length = ratios(&energy, &self.dots(&direction, &force));
            self.step(right, &length, &direction);
            self.step(&mut residual, &length.iter().map(|length| -length).collect::<Vec<_>>(), &force);
            if largest_ratio(&self.norms(&residual), &start) <= gain || iteration >= most {
                return iteration;
            }
            let mut next = residual.clone();
            (self.precondition)(&mut next);
            let old = std::mem::replace(&mut energy, self.dots(&residual, &next));
            self.step(&mut next, &ratios(&energy, &old), &direction);
            direction = next;
        }
        most
    }

    /// `x + a d` with one factor `a` for each vector.
    fn step(&self, x: &mut [f64], lengths: &[f64], direction: &[f64]) {
        for (x, d) in x.chunks_exact_mut(self.width).zip(direction.chunks_exact(self.width)) {
            x.iter_mut().zip(d).zip(lengths).for_each(|((x, d), length)| *x += length * d);
        }
    }

    fn dots(&self, a: &[f64], b: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.width];
        for (a, b) in a.chunks_exact(self.width).zip(b.chunks_exact(self.width)) {
            sums.iter_mut().zip(a).zip(b).for_each(|((sum, a), b)| *sum += a * b);
        }
        sums
    }

    /// `|S r|` of each vector.
    fn norms(&self, r: &[f64]) -> Vec<f64> {
        self.root_sums(r, |r, scale| r * scale)
    }

    /// `|S⁻¹ x|` of each vector.
    fn lengths(&self, x: &[f64]) -> Vec<f64> {
        self.root_sums(x, |x, scale| x / scale)
    }

    fn root_sums(&self, x: &[f64], scaled: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let mut squares = vec![0.0; self.width];
        for (x, scale) in x.chunks_exact(self.width).zip(self.scale) {
            squares.iter_mut().zip(x).for_each(|(square, x)| *square += scaled(*x, *scale).powi(2));
        }
        squares.into_iter().map(f64::sqrt).collect()
    }
}

/// Quotients, zero where there is nothing to divide.
fn ratios(above: &[f64], below: &[f64]) -> Vec<f64> {
    above.iter().zip(below).map(|(a, b)| if *a == 0.0 { 0.0 } else { a / b }).collect()
}

fn largest_ratio(above: &[f64], below: &[f64]) -> f64 {
    ratios(above, below)
        .into_iter()
        .fold(0.0, |largest, ratio| if ratio > largest || ratio.is_nan() { ratio } else { largest })
}
