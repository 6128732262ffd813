//! Polhodes of the rigid body: curves of constant energy on the sphere of the angular momentum.

use super::vector::Vector;

/// A closed curve on the unit sphere, in principal axes.
pub struct Polhode {
    /// Points, the first repeated at the end.
    pub points: Vec<Vector>,
    /// Whether the curve passes through the middle axis.
    pub separatrix: bool,
}

/// Angles of the drawn polhodes from their axis, towards the middle axis.
const ANGLES: [f64; 4] = [18.0, 36.0, 54.0, 72.0];
const POINTS: usize = 120;

/// Polhodes about the axes of least and greatest moment, and the separatrix between them.
///
/// On the sphere `k² = 1` they are the curves `Σ kᵢ²/Jᵢ = const`. About axis `a`, with `b` the middle axis and `c` the
/// other, `k_b² |1/J_b − 1/J_a| + k_c² |1/J_c − 1/J_a|` is constant. A body with two equal moments has circles
/// about the third axis only; one with three has none.
pub fn polhodes(moments: [f64; 3]) -> Vec<Polhode> {
    let inverse = moments.map(|moment| moments[2] / moment);
    let gap = |a: usize, b: usize| (inverse[a] - inverse[b]).abs();
    let smallest = 1e-9 * inverse[0];
    if !inverse.iter().all(|x| x.is_finite() && *x > 0.0) {
        return vec![];
    }
    let mut curves = vec![];
    for (axis, other) in [(0, 2), (2, 0)] {
        if gap(1, axis) > smallest {
            let squeeze = (gap(1, axis) / gap(other, axis)).sqrt();
            curves.extend(ANGLES.iter().flat_map(|angle| about(axis, angle.to_radians().sin(), squeeze)));
        }
    }
    if gap(1, 0) > smallest && gap(2, 1) > smallest {
        curves.extend(separatrices((gap(1, 2) / gap(0, 2)).sqrt(), (gap(1, 0) / gap(0, 2)).sqrt()));
    }
    curves
}

/// The two polhodes about an axis that reach `widest` along the middle axis, and `squeeze` times that along the other.
fn about(axis: usize, widest: f64, squeeze: f64) -> [Polhode; 2] {
    [1.0, -1.0].map(|side| {
        let point = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / POINTS as f64;
            let [middle, other] = [widest * angle.cos(), widest * squeeze * angle.sin()];
            let mut k = [0.0, middle, 0.0];
            k[axis] = side * (1.0 - middle * middle - other * other).max(0.0).sqrt();
            k[2 - axis] = other;
            k
        };
        Polhode { points: (0..=POINTS).map(point).collect(), separatrix: false }
    })
}

/// The two great circles through the middle axis, `k₁ : k₃ = ± along_1 : along_3`.
fn separatrices(along_1: f64, along_3: f64) -> [Polhode; 2] {
    [1.0, -1.0].map(|side| {
        let point = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / POINTS as f64).sin_cos();
            [side * along_1 * sin, cos, along_3 * sin]
        };
        Polhode { points: (0..=POINTS).map(point).collect(), separatrix: true }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polhodes_keep_momentum_and_energy() {
        let moments = [9.0, 13.0, 16.0];
        let curves = polhodes(moments);
        assert_eq!(curves.len(), 18);
        for curve in &curves {
            let energy = |k: &Vector| k.iter().zip(moments).map(|(k, moment)| k * k / moment).sum::<f64>();
            let first = energy(&curve.points[0]);
            for k in &curve.points {
                assert!((k.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12);
                assert!((energy(k) - first).abs() < 1e-12);
            }
            assert_eq!(curve.separatrix, (first - 1.0 / 13.0).abs() < 1e-12);
        }
    }

    #[test]
    fn equal_moments_leave_only_the_curves_that_exist() {
        assert_eq!(polhodes([2.0, 2.0, 3.0]).len(), 8);
        assert_eq!(polhodes([2.0, 2.0 + 1e-14, 3.0]).len(), 8);
        assert_eq!(polhodes([2.0, 3.0, 3.0]).len(), 8);
        assert_eq!(polhodes([2.0, 2.0, 2.0]).len(), 0);
        assert_eq!(polhodes([0.0, 2.0, f64::NAN]).len(), 0);
        assert!(
            polhodes([1e-300, 2e-300, 1e300]).iter().flat_map(|c| &c.points).flatten().all(|x| x.is_finite())
        );
    }
}
