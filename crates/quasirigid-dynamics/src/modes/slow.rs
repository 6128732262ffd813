//! Slow motion of the direction of spin: the steady spins that lie side by side, and the pair of eigenvalues beside them.
//! The eigenvalues of the equations of motion are known to the rounding of the fastest one; those of the direction follow from the second
//! variation of the energy, whose rounding is that of the moments of inertia.
//! Equations (M12) to (M15), docs/theory/15-modes.md.

use nalgebra::{Complex, DMatrix, Matrix2, Matrix3, SymmetricEigen, Vector2, Vector3};

use super::displacements::WHOLE;
use super::driven::{Driven, Tilt};
use super::equilibrium::RelativeEquilibrium;
use super::iteration::Pair;
use super::lag::{Lag, Lagging};
use super::spectrum::Eigenmotion;
use crate::math::sym3;
use crate::model::{FlexibleBody, SpinCoefficients};

type C = Complex<f64>;

/// Steady spins beside a steady spin, and the slow motion of its direction. (M12), (M13)
pub(super) struct SlowDirection {
    /// Changes of the angular velocity (rad/s) to the steady spins beside this one: of the size of the spin, then of the directions that
    /// are neutral to rounding.
    pub steady: Vec<[f64; 3]>,
    /// Frequency of the direction without the lag of the internal coordinates, or its rate of growth (rad/s).
    pub frequency: f64,
    /// Turns of the axis that rounding leaves open, towards the directions that are not neutral.
    pub tilts: Vec<Tilt>,
    spin: f64,
    /// `Λ` (kg·m²).
    ratio: f64,
    /// The axis and two directions across it, one per column.
    frame: Matrix3<f64>,
    /// `∂K/∂ω` (kg·m²) with the displacements in balance.
    slope: Matrix3<f64>,
    /// `1 − Λ (∂K/∂ω)⁻¹` across the axis, neutral directions at zero.
    variation: Matrix2<f64>,
}

/// Rounding of the second variation over the energy: of moments of inertia, of their inverse, and of the static response.
const MOMENTS: f64 = 1e-12;
const INVERSE: f64 = 1e-14;
const RESPONSE: f64 = 1e-10;
/// Share of the lag in any direction below which that of one is rounding.
const LOST: f64 = 1e-11;
/// Share of an eigenvalue below which an imaginary part is rounding.
const IMAGINARY_ROUNDING: f64 = 1e-12;
/// First eigenvalue of the iteration, over the spin: slow enough for the static lag.
const FIRST: f64 = 1e-9;
/// Limit of steps of the iteration, the relative change that is rounding, and the one accepted where rounding ends the progress.
const MAX_ITERATIONS: usize = 40;
const ITERATION_ROUNDING: f64 = 1e-15;
const ACCEPTED_CHANGE: f64 = 1e-10;

impl SlowDirection {
    /// Second variation about a steady spin; none where the displacements in balance are not found again.
    pub fn of(
        body: &FlexibleBody,
        equilibrium: &RelativeEquilibrium,
        coefficients: &SpinCoefficients,
    ) -> Option<Self> {
        let omega = Vector3::from(equilibrium.omega);
        let (spin, ratio) = (omega.norm(), equilibrium.ratio);
        let slope = slope(body, equilibrium, coefficients)?;
        let inverse = slope.try_inverse()?;
        let frame = across(omega / spin);
        let whole = frame.transpose() * (Matrix3::identity() - ratio * inverse) * frame;
        let frozen = Matrix3::from(sym3::rows(coefficients.inertia));
        let share = (slope - frozen).norm() / frozen.norm();
        let rounding = MOMENTS + INVERSE * (ratio * inverse).norm() + RESPONSE * share;
        let variation = whole.fixed_view::<2, 2>(1, 1).into_owned();
        let mut eigen = SymmetricEigen::new(variation);
        let neutral: Vec<usize> = (0..2).filter(|i| eigen.eigenvalues[*i].abs() <= rounding).collect();
        neutral.iter().for_each(|i| eigen.eigenvalues[*i] = 0.0);
        let tilts = (0..2).filter(|i| eigen.eigenvalues[*i] != 0.0).map(|i| {
            let beside = frame.fixed_view::<3, 2>(0, 1) * eigen.eigenvectors.column(i);
            let plane = [frame.column(0).into_owned(), beside].map(Into::into);
            Tilt { plane, apart: eigen.eigenvalues[i].abs() }
        });
        let tilts = tilts.collect();
        let kept = |value: f64| if value == 0.0 { 0.0 } else { value.recip() };
        let tilt = eigen.eigenvectors
            * Matrix2::from_diagonal(&eigen.eigenvalues.map(kept))
            * eigen.eigenvectors.transpose()
            * Vector2::new(whole[(1, 0)], whole[(2, 0)]);
        let lifted = |axis: f64, plane: Vector2<f64>| -> [f64; 3] {
            (inverse * frame * Vector3::new(axis, plane[0], plane[1])).into()
        };
        let mut steady = vec![lifted(1.0, -tilt)];
        steady.extend(neutral.iter().map(|i| lifted(0.0, eigen.eigenvectors.column(*i).into_owned())));
        let frequency = spin * eigen.eigenvalues.product().abs().sqrt();
        Some(Self { steady, frequency, tilts, spin, ratio, frame, slope, variation: eigen.recompose() })
    }

    /// Number of neutral directions of the spin: none, one for two equal moments, two for a body like a sphere.
    pub fn neutral(&self) -> usize {
        self.steady.len() - 1
    }

    /// Eigenvalues without the lag, `Im λ ≥ 0`, with motions of the rigid body to start from; none beside neutral directions.
    pub fn starts(&self, unknowns: usize) -> Vec<Pair> {
        let determinant = self.determinant();
        if determinant == 0.0 {
            return Vec::new();
        }
        let values = match determinant > 0.0 {
            true => vec![C::new(0.0, self.frequency)],
            false => vec![C::from(self.frequency), C::from(-self.frequency)],
        };
        let tilted = |plane: Vector2<C>| -> Vec<C> {
            let momentum = self.frame.map(C::from) * Vector3::new(C::from(0.0), plane[0], plane[1]);
            let spin = self.slope.map(C::from).try_inverse().map_or(momentum, |inverse| inverse * momentum);
            let mut x = spin.as_slice().to_vec();
            x.resize(unknowns, C::from(0.0));
            x
        };
        let start = |lambda: C| {
            let rate = Matrix2::new(0.0, 1.0, -1.0, 0.0).map(C::from) * lambda;
            let whole = rate + self.variation.map(C::from) * C::from(self.spin);
            let row = if whole.row(0).norm() >= whole.row(1).norm() { whole.row(0) } else { whole.row(1) };
            (lambda, tilted(Vector2::new(row[1], -row[0])))
        };
        values.into_iter().map(start).collect()
    }

    /// Whether every other direction of the angular momentum has more energy, beyond rounding.
    pub fn is_least(&self) -> bool {
        self.neutral() == 0 && SymmetricEigen::new(-self.variation / self.ratio).eigenvalues.min() > 0.0
    }

    /// Motions of the direction, `Im λ ≥ 0`, without the zero of a neutral direction; none where the lag has no limit for a slow motion, or
    /// the motion is not slow beside the internal ones. (M13)
    ///
    /// Eigenvalues of the plane across the axis whose lag is that of the eigenvalue itself, by iteration.
    pub fn motions(&self, body: &FlexibleBody, coefficients: &SpinCoefficients) -> Option<Vec<Eigenmotion>> {
        if self.neutral() == 2 {
            return Some(Vec::new());
        }
        let lag = Lag::of(body, coefficients, self.frame.column(0) * self.spin)?;
        let first = match self.determinant() {
            _ if !lag.has_memory() => C::from(-FIRST * self.spin),
            determinant if determinant > 0.0 => C::new(0.0, self.frequency),
            determinant if determinant < 0.0 => C::from(self.frequency),
            _ => C::from(-FIRST * self.spin),
        };
        let driven = Driven::of(body, coefficients, &self.tilts);
        let starts = self.eigenvalues(&lag.at(first)?);
        let starts = starts.into_iter().filter(|lambda| lambda.im >= 0.0);
        starts.map(|start| self.settled(&lag, &driven, start)).collect()
    }

    /// Motion with the eigenvalue that the iteration leads to.
    fn settled(&self, lag: &Lag<'_>, driven: &Driven, mut lambda: C) -> Option<Eigenmotion> {
        let mut best = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            if lambda.norm() == 0.0 {
                return self.motion(lag, &lag.at(C::from(-FIRST * self.spin))?.standing());
            }
            let lagging = lag.at(lambda)?;
            let gap = |other: &C| (other - lambda).norm();
            let next = self.eigenvalues(&lagging).into_iter().min_by(|a, b| gap(a).total_cmp(&gap(b)))?;
            let moved = gap(&next) / next.norm();
            if moved <= ITERATION_ROUNDING || (moved >= 0.5 * best && best <= ACCEPTED_CHANGE) {
                let mut motion = self.motion(lag, &lagging)?;
                driven.clear(&mut motion);
                return Some(self.balanced(lag, &lagging, motion));
            }
            best = best.min(moved);
            lambda = next;
        }
        None
    }

    /// The motion with the decay rate that balances its energy: of a body whose dashpots alone dissipate that has every digit, where the
    /// eigenvalue has those of its own rounding. (M4), (M15)
    fn balanced(&self, lag: &Lag<'_>, lagging: &Lagging, mut motion: Eigenmotion) -> Eigenmotion {
        let Some(inverse) = self.slope.try_inverse() else { return motion };
        if lag.has_memory() || !(motion.lambda.im.abs() > motion.lambda.re.abs()) {
            return motion;
        }
        let momentum =
            self.frame.map(C::from).transpose() * self.slope_of(lagging) * Vector3::from(motion.delta);
        let plane = Vector2::new(momentum[1], momentum[2]);
        let own = (plane.adjoint() * self.variation.map(C::from) * plane)[(0, 0)].re / self.ratio;
        let [beside, power] = lag.energy_and_power(lagging, &motion, &inverse);
        let energy = beside - 0.5 * own;
        if energy != 0.0 {
            motion.lambda.re = -power / (2.0 * energy);
        }
        motion
    }

    /// `|ω|Λ(∂K/∂ω)⁻¹L(∂K/∂ω + λL)⁻¹` across the axis, and its size in every direction. (M13)
    fn turned(&self, lagging: &Lagging) -> Option<(Matrix2<C>, f64)> {
        let late = self.slope_of(lagging).try_inverse()?;
        let frame = self.frame.map(C::from);
        let slope = self.slope.map(C::from).try_inverse()?;
        let whole = frame.transpose() * slope * lagging.momentum * late * frame;
        let whole = whole * C::from(self.spin * self.ratio);
        Some((whole.fixed_view::<2, 2>(1, 1).into_owned(), whole.norm()))
    }

    /// `∂K/∂ω + λL`.
    fn slope_of(&self, lagging: &Lagging) -> Matrix3<C> {
        self.slope.map(C::from) + lagging.momentum * lagging.lambda
    }

    /// Eigenvalues of the plane with a given lag, real ones without the imaginary part that rounding leaves them. (M13)
    fn eigenvalues(&self, lagging: &Lagging) -> Vec<C> {
        let real = |lambda: C| {
            let rounding = IMAGINARY_ROUNDING * lambda.norm();
            if lambda.im.abs() <= rounding { C::from(lambda.re) } else { lambda }
        };
        self.roots(lagging).into_iter().map(real).collect()
    }

    fn roots(&self, lagging: &Lagging) -> Vec<C> {
        let Some((turned, size)) = self.turned(lagging) else { return Vec::new() };
        let V = &self.variation;
        let one = C::from(1.0);
        let below = turned[(0, 0)] * turned[(1, 1)] + (one + turned[(0, 1)]) * (one - turned[(1, 0)]);
        let sum = turned[(1, 1)] * V[(0, 0)] - (turned[(0, 1)] + turned[(1, 0)]) * V[(0, 1)]
            + turned[(0, 0)] * V[(1, 1)];
        let sum = if sum.norm() > LOST * size * V.norm() { sum } else { C::from(0.0) };
        let half = -sum * (0.5 * self.spin) / below;
        let determinant = self.determinant();
        if determinant == 0.0 {
            return vec![half * 2.0];
        }
        let product = C::from(self.spin * self.spin * determinant) / below;
        let root = (half * half - product).sqrt();
        let larger = if (half + root).norm() >= (half - root).norm() { half + root } else { half - root };
        vec![larger, product / larger]
    }

    /// Determinant of the second variation, zero where one of its eigenvalues is.
    fn determinant(&self) -> f64 {
        if self.neutral() > 0 { 0.0 } else { self.variation.determinant() }
    }

    /// Motion with the eigenvalue of its lag.
    fn motion(&self, lag: &Lag<'_>, lagging: &Lagging) -> Option<Eigenmotion> {
        let (turned, _) = self.turned(lagging)?;
        let rate = turned + Matrix2::new(0.0, 1.0, -1.0, 0.0).map(C::from);
        let whole = rate * lagging.lambda + self.variation.map(C::from) * C::from(self.spin);
        let row = if whole.row(0).norm() >= whole.row(1).norm() { whole.row(0) } else { whole.row(1) };
        let plane = Vector2::new(row[1], -row[0]);
        let plane = plane / C::from(plane.norm());
        let momentum = self.frame.map(C::from) * Vector3::new(C::from(0.0), plane[0], plane[1]);
        Some(lagging.motion(lag, self.slope_of(lagging).try_inverse()? * momentum))
    }
}

/// `∂K/∂ω = J_s + U(C − N)⁻¹Uᵀ` (kg·m²) with the displacements in balance, of the coefficients of the equations of motion; of large bodies
/// that of the balance. (M12)
fn slope(
    body: &FlexibleBody,
    equilibrium: &RelativeEquilibrium,
    coefficients: &SpinCoefficients,
) -> Option<Matrix3<f64>> {
    let elastic = body.elastic();
    let slope = if elastic > WHOLE {
        Matrix3::from(body.balanced(equilibrium.omega)?.slope)
    } else {
        let mut stiffness = DMatrix::from_fn(elastic, elastic, |j, k| -coefficients.centrifugal.at(j, k));
        for (j, k, C) in body.stiffness().iter().filter(|(j, k, _)| *j < elastic && *k < elastic) {
            stiffness[(j, k)] += C;
        }
        let U = DMatrix::from_fn(elastic, 3, |j, axis| coefficients.slopes[j][axis]);
        let inertia = Matrix3::from(sym3::rows(coefficients.inertia));
        if elastic == 0 {
            inertia
        } else {
            inertia + (U.transpose() * stiffness.lu().solve(&U)?).fixed_view::<3, 3>(0, 0)
        }
    };
    Some(0.5 * (slope + slope.transpose()))
}

/// Right-handed frame with an axis as its first column.
fn across(axis: Vector3<f64>) -> Matrix3<f64> {
    let first = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    Matrix3::from_columns(&[axis, first, axis.cross(&first)])
}
