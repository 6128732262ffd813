//! Attitude quaternions, scalar first: `R_NB` takes body components of a vector to inertial ones. The only place
//! that defines the convention.

use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};

use super::scalar::{Scalar, Smooth};
use super::vec3::{add, dot, scale};

/// Unit quaternion, scalar first.
pub type Attitude = [f64; 4];

/// Body and inertial axes coincide.
pub const ALIGNED: Attitude = [1.0, 0.0, 0.0, 0.0];

/// Rotation matrix `R_NB`, for numbers that may be series in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn<T> {
    rows: [[T; 3]; 3],
}

impl<T: Smooth> Turn<T> {
    /// Rotation of an attitude; the length of the quaternion does not matter.
    #[must_use]
    pub fn of([s, x, y, z]: [T; 4]) -> Self {
        let two = T::from(2.0) / (s * s + x * x + y * y + z * z);
        let one = T::from(1.0);
        let rows = [
            [one - two * (y * y + z * z), two * (x * y - s * z), two * (x * z + s * y)],
            [two * (x * y + s * z), one - two * (x * x + z * z), two * (y * z - s * x)],
            [two * (x * z - s * y), two * (y * z + s * x), one - two * (x * x + y * y)],
        ];
        Self { rows }
    }
}

impl<T: Scalar> Turn<T> {
    /// Inertial components of a vector given in body components.
    #[must_use]
    pub fn to_inertial(&self, vector: [T; 3]) -> [T; 3] {
        self.rows.map(|row| dot(row, vector))
    }

    /// Body components of a vector given in inertial components.
    #[must_use]
    pub fn to_body(&self, [x, y, z]: [T; 3]) -> [T; 3] {
        let [first, second, third] = self.rows;
        add(add(scale(x, first), scale(y, second)), scale(z, third))
    }
}

/// Inertial components of a vector given in body components.
#[inline]
#[must_use]
pub fn to_inertial(attitude: Attitude, vector: [f64; 3]) -> [f64; 3] {
    unit(attitude).transform_vector(&Vector3::from(vector)).into()
}

/// Rate of the attitude at an angular velocity in body axes, `½ q ⊗ (0, ω)`. (P3)
#[inline(always)]
#[must_use]
pub fn rate<T: Scalar>([s, x, y, z]: [T; 4], [wx, wy, wz]: [T; 3]) -> [T; 4] {
    let half = T::from(0.5);
    [
        T::from(-0.5) * (x * wx + y * wy + z * wz),
        half * (s * wx + y * wz - z * wy),
        half * (s * wy + z * wx - x * wz),
        half * (s * wz + x * wy - y * wx),
    ]
}

/// Attitude after the smallest rotation that gives `body` the inertial direction of `inertial`, which it must nearly have already. (P3)
#[must_use]
pub fn aligned(attitude: Attitude, body: [f64; 3], inertial: [f64; 3]) -> Attitude {
    let attitude = unit(attitude);
    let now = attitude.transform_vector(&Vector3::from(body)).normalize();
    let then = Vector3::from(inertial).normalize();
    let turn = Unit::new_normalize(Quaternion::from_parts(1.0 + now.dot(&then), now.cross(&then)));
    let q = turn * attitude;
    [q.w, q.i, q.j, q.k]
}

/// The attitude as a unit quaternion, which it must nearly be already.
#[inline(always)]
#[must_use]
pub fn normalized(attitude: Attitude) -> Attitude {
    let size = attitude.iter().map(|part| part * part).sum::<f64>().sqrt();
    attitude.map(|part| part / size)
}

/// The attitude reached from `attitude` by a rotation vector in inertial axes (rad).
#[must_use]
pub fn turned(attitude: Attitude, rotation: [f64; 3]) -> Attitude {
    let q = UnitQuaternion::from_scaled_axis(Vector3::from(rotation)) * unit(attitude);
    [q.w, q.i, q.j, q.k]
}

/// Attitude after one that is relative to another: `first ⊗ second`.
#[must_use]
pub fn product(first: Attitude, second: Attitude) -> Attitude {
    let q = unit(first) * unit(second);
    [q.w, q.i, q.j, q.k]
}

/// Rotation vector (rad) of a unit quaternion, of length 0 to π: that of its negative too.
#[must_use]
pub fn rotation_vector([c, x, y, z]: Attitude) -> [f64; 3] {
    let sine = x.hypot(y).hypot(z);
    let factor = if sine > 0.0 { 2.0 * sine.atan2(c.abs()) / sine } else { 2.0 };
    [x, y, z].map(|part| factor.copysign(c) * part)
}

/// Rotation in inertial axes, as a unit quaternion, that takes one attitude to another.
#[must_use]
pub fn between(from: Attitude, to: Attitude) -> Attitude {
    let q = unit(to) / unit(from);
    [q.w, q.i, q.j, q.k]
}

/// Angle (rad) of the rotation from one attitude to another.
#[must_use]
pub fn angle_between(a: Attitude, b: Attitude) -> f64 {
    unit(a).rotation_to(&unit(b)).angle()
}

/// Angle (rad) between two directions, without loss of digits near 0 and π.
#[must_use]
pub fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (a, b) = (Vector3::from(a), Vector3::from(b));
    a.cross(&b).norm().atan2(a.dot(&b))
}

fn unit([s, x, y, z]: Attitude) -> UnitQuaternion<f64> {
    Unit::new_normalize(Quaternion::new(s, x, y, z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_is_the_derivative_of_a_turn() {
        let start = turned(ALIGNED, [0.3, -0.7, 0.2]);
        let omega = [0.4, 1.1, -0.6];
        let h = 1e-5;
        let turn = to_inertial(start, omega).map(|w| w * h);
        let (ahead, behind) = (turned(start, turn), turned(start, turn.map(|w| -w)));
        let expected = rate(start, omega);
        for i in 0..4 {
            assert!(((ahead[i] - behind[i]) / (2.0 * h) - expected[i]).abs() < 1e-9);
        }
    }

    #[test]
    fn the_rotation_vector_is_that_of_the_turn_whatever_the_sign() {
        for size in [1e-9, 0.3, 2.0, 3.1] {
            let vector = [2.0, -1.0, 2.0].map(|part| size / 3.0 * part);
            let q = turned(ALIGNED, vector);
            for q in [q, q.map(|part| -part)] {
                for (found, expected) in rotation_vector(q).iter().zip(vector) {
                    assert!((found - expected).abs() < 1e-14 * size, "{size}");
                }
            }
        }
        assert_eq!(rotation_vector(ALIGNED), [0.0; 3]);
    }

    #[test]
    fn the_matrix_turns_as_the_quaternion_does_whatever_its_length() {
        let attitude = turned(ALIGNED, [0.3, -0.7, 0.2]);
        let turn = Turn::of(attitude.map(|entry| 3.0 * entry));
        let vector = [0.4, 1.1, -0.6];
        let expected = to_inertial(attitude, vector);
        let back = turn.to_body(expected);
        for i in 0..3 {
            assert!((turn.to_inertial(vector)[i] - expected[i]).abs() < 1e-15);
            assert!((back[i] - vector[i]).abs() < 1e-15);
        }
    }

    #[test]
    fn alignment_moves_one_direction_onto_another() {
        let attitude = turned(ALIGNED, [0.3, -0.7, 0.2]);
        let aligned = aligned(attitude, [1.0, 2.0, 3.0], [-1.0, 2.5, 1.0]);
        assert!(angle(to_inertial(aligned, [1.0, 2.0, 3.0]), [-1.0, 2.5, 1.0]) < 1e-15);
    }
}
