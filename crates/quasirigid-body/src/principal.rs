//! Principal axes of an inertia tensor, modes of rotation, and frequency and nome of the polhode.
//! Axes of equal moments are not determined, and callers must ask; signs of axes are fixed, so that results do not depend on the eigenvalue
//! solver.
//! Equation (V8), docs/theory/04-validity.md.

use nalgebra::Matrix3;

use crate::math::elliptic;
use crate::math::sym3::{self, Sym};
use crate::math::vec3::{self, dot, scale};

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

impl Principal {
    /// Axis next to a vector, on its side; the vector itself where none is.
    #[must_use]
    pub fn axis_beside(&self, vector: [f64; 3]) -> [f64; 3] {
        let along = |axis: &[f64; 3]| dot(*axis, vector);
        let nearest = self.axes.into_iter().max_by(|a, b| along(a).abs().total_cmp(&along(b).abs()));
        let axis = nearest.unwrap_or(vector);
        scale(along(&axis).signum(), axis)
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
        Self {
            moments: order.map(|i| eigen.eigenvalues[i]),
            axes: [first, second, vec3::cross(first, second)],
        }
    }

    /// True for each axis that is determined: false for axes of equal moments.
    #[must_use]
    pub fn determined(&self) -> [bool; 3] {
        let [I1, I2, I3] = self.moments;
        let (lower, upper) = (I2 - I1 > DISTINCT * I3, I3 - I2 > DISTINCT * I3);
        [lower, lower && upper, upper]
    }

    /// Modes in the order of nearness of their axes to a vector.
    #[must_use]
    pub fn nearest(&self, vector: [f64; 3]) -> [Mode; 2] {
        let [least, _, greatest] = self.components(vector).map(f64::abs);
        if least > greatest { [Mode::LongAxis, Mode::ShortAxis] } else { [Mode::ShortAxis, Mode::LongAxis] }
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
        parts.fold([0.0; 3], |sum, (axis, component)| vec3::add(sum, vec3::scale(component, *axis)))
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
