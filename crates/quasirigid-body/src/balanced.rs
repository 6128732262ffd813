//! Displacements in balance with a steady angular velocity.
//! Where appendages turn far on their hinges the balance is followed from rest as the spin rises, so that its branch is that of the body.
//! Equations (M1) and (M10), docs/theory/15-modes.md.

use nalgebra::{Cholesky, DMatrix, Dyn};

use super::softened::Softened;
use super::{CurvedPaths, FlexibleBody, Follower, Invariants, SpinCoefficients, SpinMatrix};
use crate::math::sparse::SparseRows;
use crate::math::sym3::{self, times};
use crate::math::vec3::dot;

/// Displacements in balance with a steady angular velocity, and the derivative of the angular momentum.
#[derive(Clone, Debug)]
pub struct BalancedSpin {
    /// Displacements of all coordinates.
    pub q: Vec<f64>,
    /// Angular momentum without that of wheels (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Derivative of the angular momentum by the angular velocity (kg·m²), rows.
    pub slope: [[f64; 3]; 3],
}

/// Limit of Newton steps for displacements on curved paths, and the change relative to the displacements that is rounding; one accepted
/// where rounding ends the progress.
const NEWTON_STEPS: usize = 30;
const NEWTON_ROUNDING: f64 = 1e-14;
const ACCEPTED_NEWTON_STEP: f64 = 1e-9;

/// Angle (rad) below which the balance of a hinge is known as a share of this angle.
const SMALL_HINGE_ANGLE: f64 = 1e-3;
/// Angle (rad) from a guess beyond which the balance of a hinge may be another one.
const OTHER_BALANCE_ANGLE: f64 = 0.1;
/// Shortest step of the square of the spin, as a share of it, and longest one over which the balance may cease to be firm: a longer one may
/// lead to another branch.
const SHORTEST_SPIN_STEP: f64 = 1e-12;
const FINE: f64 = 1e-3;

impl FlexibleBody {
    /// Displacements in balance with a steady angular velocity, `C q = ½ ωᵀ(∂J/∂q)ω`, cyclic coordinates at zero; none where `C − N` is
    /// singular, or the displacements on curved paths are not found. (M1), (M10)
    #[must_use]
    pub fn balanced(&self, omega: [f64; 3]) -> Option<BalancedSpin> {
        BalancedSpin::of(self, omega)
    }

    /// Whether a balance withstands small displacements: `C − N` is positive definite at a centrifugal stiffness. (M1)
    #[must_use]
    pub fn withstands(&self, centrifugal: &SpinMatrix) -> bool {
        let elastic = self.elastic();
        let mut left = DMatrix::from_fn(elastic, elastic, |j, k| -centrifugal.at(j, k));
        let springs = self.stiffness().iter().filter(|(j, k, _)| *j < elastic && *k < elastic);
        springs.for_each(|(j, k, stiffness)| left[(j, k)] += stiffness);
        Cholesky::<f64, Dyn>::new(left).is_some()
    }
}

impl BalancedSpin {
    fn of(body: &FlexibleBody, omega: [f64; 3]) -> Option<Self> {
        let elastic = body.elastic();
        let mut q = vec![0.0; body.coordinates().len()];
        let Invariants { J, J1, .. } = body.invariants();
        if elastic == 0 {
            return Some(Self { q, angular_momentum: times(*J, omega), slope: sym3::rows(*J) });
        }
        let load: Vec<f64> = J1[..elastic].iter().map(|J1| 0.5 * dot(omega, times(*J1, omega))).collect();
        let straight = Softened::of(body, &body.centrifugal_stiffness(omega)).and_then(|factor| {
            q[..elastic].copy_from_slice(&factor.solve(&load, 1)?);
            Some(factor)
        });
        let (coefficients, factor) = match (body.paths(), straight) {
            (None, straight) => (body.about_spin(omega, &q), straight?),
            (Some(paths), straight) => {
                let straight = straight.is_some().then_some(q.as_slice());
                let (found, coefficients, factor) = Balance::new(body, paths).at(omega, straight)?;
                q = found;
                (coefficients, factor)
            }
        };
        let mut slope = sym3::rows(coefficients.inertia);
        let answers = factor.solve(coefficients.slopes[..elastic].as_flattened(), 3)?;
        for (left, answer) in coefficients.slopes.iter().zip(answers.as_chunks::<3>().0) {
            for (row, left) in slope.iter_mut().zip(left) {
                row.iter_mut().zip(answer).for_each(|(entry, right)| *entry += left * right);
            }
        }
        Some(Self { q, angular_momentum: times(coefficients.inertia, omega), slope })
    }
}

/// Balance `C q = ½ ω·U(q)` along curved paths. (M10)
struct Balance<'a> {
    body: &'a FlexibleBody,
    stiffness: SparseRows<f64>,
    /// Stiffness by which displacements are measured.
    measure: SparseRows<f64>,
    /// Angles of hinges among the coordinates.
    angles: Vec<usize>,
}

/// Displacements in balance, the coefficients there, and the factors of `C − N`.
type Balanced = (Vec<f64>, SpinCoefficients, Softened);

impl<'a> Balance<'a> {
    fn new(body: &'a FlexibleBody, paths: &CurvedPaths) -> Self {
        let turning = paths.followers.iter().filter(|follower| matches!(follower, Follower::Rotation { .. }));
        let angles = turning.flat_map(Follower::coordinates).collect();
        Self {
            body,
            stiffness: body.stiffness().block(0..body.elastic()),
            measure: body.grounded_stiffness(),
            angles,
        }
    }

    /// Root of twice the elastic energy.
    fn size(&self, x: &[f64]) -> f64 {
        self.measure.quadratic(x).sqrt()
    }

    /// Displacements in balance that Newton's method finds from a guess, with no hinge far from it; none otherwise.
    fn near(&self, omega: [f64; 3], guess: &[f64]) -> Option<Balanced> {
        let elastic = self.body.elastic();
        let mut q = guess.to_vec();
        let diagonal = self.measure.diagonal();
        let small: f64 =
            self.angles.iter().map(|j| SMALL_HINGE_ANGLE * SMALL_HINGE_ANGLE * diagonal[*j]).sum();
        let mut best = f64::INFINITY;
        for _ in 0..NEWTON_STEPS {
            if self.angles.iter().any(|j| !((q[*j] - guess[*j]).abs() <= OTHER_BALANCE_ANGLE)) {
                return None;
            }
            let coefficients = self.body.about_spin_on_paths(omega, &q);
            let factor = Softened::of(self.body, &coefficients.centrifugal)?;
            let held = self.stiffness.times(&q[..elastic]);
            let slopes = coefficients.slopes.iter().zip(&held);
            let excess = slopes.map(|(slope, held)| 0.5 * dot(omega, *slope) - held);
            let step = factor.solve(&excess.collect::<Vec<f64>>(), 1)?;
            let size = self.size(&q[..elastic]) + small.sqrt();
            let change = self.size(&step) / size.max(f64::MIN_POSITIVE);
            if change <= NEWTON_ROUNDING || (change >= 0.5 * best && best <= ACCEPTED_NEWTON_STEP) {
                return Some((q, coefficients, factor));
            }
            best = best.min(change);
            q.iter_mut().zip(&step).for_each(|(q, step)| *q += step);
        }
        None
    }

    /// Displacements in balance on the branch from rest: those that Newton's method finds from straight paths, and of appendages on hinges those
    /// followed as the spin rises, where the balance may have ceased to be firm on the way.
    fn at(&self, omega: [f64; 3], straight: Option<&[f64]>) -> Option<Balanced> {
        let direct = || straight.and_then(|q| self.near(omega, q));
        if self.angles.is_empty() {
            return direct();
        }
        let firm = self.body.withstands(&self.body.centrifugal_stiffness(omega));
        let direct = if firm { direct() } else { None };
        let direct = direct.filter(|(_, coefficients, _)| self.body.withstands(&coefficients.centrifugal));
        direct.or_else(|| self.followed(omega))
    }

    /// Displacements in balance followed from rest as the square of the spin rises.
    fn followed(&self, omega: [f64; 3]) -> Option<Balanced> {
        let n = self.body.coordinates().len();
        let (mut last, mut now) = ((0.0, vec![0.0; n]), (0.0, vec![0.0; n]));
        let (mut step, mut firm) = (1.0, true);
        while step > SHORTEST_SPIN_STEP {
            let share = f64::min(now.0 + step, 1.0);
            let ahead = if now.0 > 0.0 { (share - now.0) / (now.0 - last.0) } else { 0.0 };
            let guess: Vec<f64> = now.1.iter().zip(&last.1).map(|(q, last)| q + ahead * (q - last)).collect();
            let found = self.near(omega.map(|entry| share.sqrt() * entry), &guess);
            let stays = found
                .as_ref()
                .is_some_and(|(_, coefficients, _)| self.body.withstands(&coefficients.centrifugal));
            match found.filter(|_| stays || !firm || step <= FINE) {
                Some(found) if share >= 1.0 => return Some(found),
                Some((q, ..)) => {
                    last = std::mem::replace(&mut now, (share, q));
                    (step, firm) = (2.0 * step, stays);
                }
                None => step *= 0.25,
            }
        }
        None
    }
}
