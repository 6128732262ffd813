//! Principal axes of an inertia tensor, modes of rotation, and frequency and nome of the polhode.
//! Axes of equal moments are not determined, and callers must ask; signs of axes are fixed, so that results do not depend on the eigenvalue
//! solver.
//! Equation (V8), docs/theory/04-validity.md.

use nalgebra::Matrix3;

use crate::math::elliptic;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{add, cross, dot, norm, scale, unit};

/// Principal moments and axes of an inertia tensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principal {
    /// Moments (kg·m²), ascending.
    pub moments: [f64; 3],
    /// Unit vectors of the axes in the order of the moments, right-handed; each axis has its largest component
    /// positive, but for the last one.
    pub axes: [[f64; 3]; 3],
}

/// Polhode: periodic motion of the angular velocity of the frozen body in the body frame. (V8)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polhode {
    /// Frequency `Ω_p` (rad/s).
    pub frequency: f64,
    /// Nome: harmonic `n` of the loads is weaker by about the power `n/2` of the nome.
    pub nome: f64,
}

/// Mode of rotation: axis that the angular momentum circles in the body.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Short-axis mode, about the axis of greatest inertia: `|K|² > 2 E I₂`.
    ShortAxis,
    /// Long-axis mode, about the axis of least inertia: `|K|² < 2 E I₂`.
    LongAxis,
}

impl Mode {
    /// Index of the axis that the angular momentum circles.
    #[must_use]
    pub fn circled(self) -> usize {
        match self {
            Self::ShortAxis => 2,
            Self::LongAxis => 0,
        }
    }

    /// Other mode.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::ShortAxis => Self::LongAxis,
            Self::LongAxis => Self::ShortAxis,
        }
    }

    /// True if a body with these principal moments (kg·m²), ascending, can wobble about the axis of this mode: false where that moment
    /// equals the middle one.
    #[must_use]
    pub fn exists(self, [I1, I2, I3]: [f64; 3]) -> bool {
        let gap = match self {
            Self::ShortAxis => I3 - I2,
            Self::LongAxis => I2 - I1,
        };
        gap > DISTINCT * I3
    }

    /// True if a body with these principal moments (kg·m²), ascending, can wobble about some axis: false of three equal ones.
    #[must_use]
    pub fn any_exists(moments: [f64; 3]) -> bool {
        [Self::LongAxis, Self::ShortAxis].iter().any(|mode| mode.exists(moments))
    }
}

/// Difference of moments, relative to the largest, below which they are those of a body of revolution.
const DISTINCT: f64 = 1e-9;
/// Difference of moments, relative to the largest, that is rounding.
const SAME: f64 = 1e-12;
/// Part of a vector along an axis, relative to its length, that rounding may leave of none, and difference of two parts that it may leave of
/// equal ones.
const ACROSS: f64 = 1e-9;

impl Principal {
    /// The axes in both senses.
    #[must_use]
    pub fn senses(&self) -> [[f64; 3]; 6] {
        let [a, b, c] = self.axes;
        let [minus_a, minus_b, minus_c] = self.axes.map(|axis| scale(-1.0, axis));
        [a, b, c, minus_a, minus_b, minus_c]
    }

    /// Axis next to a vector, on its side: of equal moments the part of the vector in their plane, of three the vector itself. Of two that are
    /// as near, the one of the greater moment.
    #[must_use]
    pub fn axis_beside(&self, vector: [f64; 3]) -> [f64; 3] {
        let parts = [2, 1, 0].map(|k| self.part(k, vector, DISTINCT));
        let nearer = |best: [f64; 3], next: [f64; 3]| {
            if norm(next) > norm(best) + ACROSS * norm(vector) { next } else { best }
        };
        let nearest = parts.into_iter().fold([0.0; 3], nearer);
        if norm(nearest) > 0.0 { unit(nearest) } else { vector }
    }

    /// The axes with that of a mode next to a vector, where its moment equals others to rounding so that it may lie anywhere among their axes;
    /// as they are where the vector is across these.
    #[must_use]
    pub fn beside(self, mode: Mode, vector: [f64; 3]) -> Self {
        let (own, third) = (mode.circled(), 2 - mode.circled());
        let part = self.part(own, vector, SAME);
        let apart = (self.moments[1] - self.moments[own]).abs() > SAME * self.moments[2];
        if apart || !(norm(part) > ACROSS * norm(vector)) {
            return self;
        }
        let mut axes = self.axes;
        axes[own] = unit(part);
        let across = |k: usize| add(self.axes[k], scale(-dot(self.axes[k], axes[own]), axes[own]));
        let widest = [third, 1, own].into_iter().find(|k| norm(across(*k)) > 0.5).unwrap_or(third);
        axes[third] = unit(across(widest));
        axes[1] = cross(axes[2], axes[0]);
        Self { axes, ..self }
    }

    /// Part of a vector along an axis and those of moments equal to its own, within a share of the largest.
    fn part(&self, k: usize, vector: [f64; 3], equal: f64) -> [f64; 3] {
        let gaps = [self.moments[1] - self.moments[0], self.moments[2] - self.moments[1]];
        let alike =
            |other: usize| (k.min(other)..k.max(other)).all(|gap| !(gaps[gap] > equal * self.moments[2]));
        let along = |other: usize| scale(dot(self.axes[other], vector), self.axes[other]);
        (0..3).filter(|other| alike(*other)).fold([0.0; 3], |sum, other| add(sum, along(other)))
    }

    /// Principal axes of a tensor.
    #[must_use]
    pub fn compute(J: Sym) -> Self {
        let eigen = Matrix3::from(sym3::rows(J)).symmetric_eigen();
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let axis = |i: usize| {
            let column = eigen.eigenvectors.column(order[i]);
            let sign = column[column.iamax()].signum();
            [sign * column[0], sign * column[1], sign * column[2]]
        };
        let (first, second) = (axis(0), axis(1));
        Self { moments: order.map(|i| eigen.eigenvalues[i]), axes: [first, second, cross(first, second)] }
    }

    /// True for each axis that is determined: false for axes of equal moments.
    #[must_use]
    pub fn determined(&self) -> [bool; 3] {
        let [lower, upper] = [Mode::LongAxis, Mode::ShortAxis].map(|mode| mode.exists(self.moments));
        [lower, lower && upper, upper]
    }

    /// Modes in the order of nearness of their axes to a vector, with those of equal moments; the short-axis mode first where both are as near.
    #[must_use]
    pub fn nearest(&self, vector: [f64; 3]) -> [Mode; 2] {
        let [least, greatest] = [0, 2].map(|k| norm(self.part(k, vector, DISTINCT)));
        let long = least > greatest + ACROSS * norm(vector);
        if long { [Mode::LongAxis, Mode::ShortAxis] } else { [Mode::ShortAxis, Mode::LongAxis] }
    }

    /// Components of a vector along the principal axes.
    #[must_use]
    pub fn components(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, vector))
    }

    /// Vector with these components along the principal axes.
    #[must_use]
    pub fn vector(&self, components: [f64; 3]) -> [f64; 3] {
        let parts = self.axes.iter().zip(components);
        parts.fold([0.0; 3], |sum, (axis, component)| add(sum, scale(component, *axis)))
    }

    /// Polhode through `omega` (rad/s); none if the angular velocity is constant in the body or its period infinite, as in a sphere and
    /// on the separatrix.
    #[must_use]
    pub fn polhode(&self, omega: [f64; 3]) -> Option<Polhode> {
        let [I1, I2, I3] = self.moments;
        let w = self.components(omega).map(|rate| rate * rate);
        let above = I2 * (I2 - I1) * w[1] + I3 * (I3 - I1) * w[2]; // G² − 2E I₁
        let below = I1 * (I3 - I1) * w[0] + I2 * (I3 - I2) * w[1]; // 2E I₃ − G²
        let (short, long) = ((I3 - I2) * above, (I2 - I1) * below);
        let (fast, slow) = (short.max(long), short.min(long));
        let m = slow / fast;
        let nu = (fast / (I1 * I2 * I3)).sqrt();
        let frequency = std::f64::consts::PI * nu / (2.0 * elliptic::complete_first(m));
        (frequency > 0.0).then(|| Polhode { frequency, nome: elliptic::nome(m) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In the axes of any file, the order of the modes and the axis beside a vector are those of the body: of two equal moments by the part in
    /// their plane, of three by the vector, and about a middle axis by a rule.
    #[test]
    fn equal_moments_are_asked_as_one() {
        use nalgebra::{Rotation3, Vector3};
        for (moments, vector, first, beside) in [
            ([2.0, 4.0, 4.0], [0.5, 0.6, 0.2], Mode::ShortAxis, [0.0, 0.6, 0.2]),
            ([2.0, 4.0, 4.0], [0.7, 0.6, 0.2], Mode::LongAxis, [0.7, 0.0, 0.0]),
            ([4.0, 4.0, 6.0], [0.4, 0.5, 0.6], Mode::LongAxis, [0.4, 0.5, 0.0]),
            ([4.0, 4.0, 4.0], [0.4, 0.5, 0.6], Mode::ShortAxis, [0.4, 0.5, 0.6]),
            ([2.0, 4.0, 6.0], [0.0, 1.0, 0.0], Mode::ShortAxis, [0.0, 1.0, 0.0]),
            ([2.0, 4.0, 6.0], [1.0, 0.0, 1.0], Mode::ShortAxis, [0.0, 0.0, 1.0]),
        ] {
            for turn in 0..20 {
                let R = Rotation3::new(Vector3::new(0.3, 1.1, -0.7) * f64::from(turn));
                let J = R * Matrix3::from_diagonal(&Vector3::from(moments)) * R.transpose();
                let own = Principal::compute([J.m11, J.m22, J.m33, J.m23, J.m13, J.m12]);
                let given: [f64; 3] = (R * Vector3::from(vector)).into();
                assert_eq!(own.nearest(given)[0], first, "{moments:?}");
                let expected = R * Vector3::from(beside).normalize();
                let gap = Vector3::from(own.axis_beside(given)) - expected;
                assert!(gap.norm() < 1e-14, "{moments:?} {gap}");
                if !first.exists(moments) {
                    let axes = own.beside(first, given).axes.map(Vector3::from);
                    assert!((axes[first.circled()] - expected).norm() < 1e-14);
                    assert!((axes[0].cross(&axes[1]) - axes[2]).norm() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn small_wobble_has_the_textbook_frequency() {
        let [a, b, c] = [2.0, 3.0, 4.0];
        let turned = Principal::compute([a, b, c, 0.0, 0.0, 0.0]);
        let polhode = turned.polhode([1e-6, 1e-6, 0.7]).unwrap();
        let expected = 0.7 * ((c - a) * (c - b) / (a * b)).sqrt();
        assert!((polhode.frequency / expected - 1.0).abs() < 1e-10);
        assert!(polhode.nome < 1e-11);
    }

    #[test]
    fn period_is_that_of_the_integrated_motion() {
        let J = [2.0, 3.0, 4.0];
        let euler = |w: [f64; 3]| {
            [
                (J[1] - J[2]) / J[0] * w[1] * w[2],
                (J[2] - J[0]) / J[1] * w[2] * w[0],
                (J[0] - J[1]) / J[2] * w[0] * w[1],
            ]
        };
        for start in [[0.4, 0.0, 0.9], [0.9, 0.0, 0.4]] {
            let polhode = Principal::compute([2.0, 3.0, 4.0, 0.0, 0.0, 0.0]).polhode(start).unwrap();
            let steps = 20_000;
            let h = std::f64::consts::TAU / polhode.frequency / f64::from(steps);
            let mut w = start;
            for _ in 0..steps {
                let add = |w: [f64; 3], k: [f64; 3], s: f64| -> [f64; 3] {
                    std::array::from_fn(|i| w[i] + s * k[i])
                };
                let k1 = euler(w);
                let k2 = euler(add(w, k1, h / 2.0));
                let k3 = euler(add(w, k2, h / 2.0));
                let k4 = euler(add(w, k3, h));
                w = std::array::from_fn(|i| w[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
            }
            assert!((0..3).all(|i| (w[i] - start[i]).abs() < 1e-11), "{w:?}");
        }
    }
}
