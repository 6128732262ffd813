//! Attitudes between the rows of a history: cubic in the rotation vector, with the angular velocities of both rows.

use crate::sphere::vector::{Vector, cross, dot};

/// Unit quaternion from body to inertial axes, scalar first.
pub type Quaternion = [f64; 4];

/// Attitude and angular velocity (rad/s, body axes) of a row.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// Time (s).
    pub t: f64,
    /// Attitude.
    pub attitude: Quaternion,
    /// Angular velocity.
    pub omega: Vector,
}

/// Attitude at a part, from 0 to 1, of the time between two rows that turn by less than half a revolution.
///
/// The rotation vector `φ` since the first row is the cubic with `φ = 0`, `φ' = ω` there, and at the second row with the `φ` between both
/// attitudes and `φ' = ω + φ×ω/2 + φ×(φ×ω)(1 − (θ/2) cot(θ/2))/θ²`, `θ = |φ|`, the inverse of the differential of the exponential map.
pub fn between(from: &Pose, to: &Pose, part: f64) -> Quaternion {
    let h = to.t - from.t;
    let phi = rotation_vector(product(conjugate(from.attitude), to.attitude));
    let slope = rate_of_vector(phi, to.omega);
    let (s, s2, s3) = (part, part * part, part.powi(3));
    let weights = [s3 - 2.0 * s2 + s, 3.0 * s2 - 2.0 * s3, s3 - s2];
    let vector =
        [0, 1, 2].map(|i| h * weights[0] * from.omega[i] + weights[1] * phi[i] + h * weights[2] * slope[i]);
    product(from.attitude, of_vector(vector))
}

/// A vector of body axes in inertial axes.
pub fn turned([w, x, y, z]: Quaternion, v: Vector) -> Vector {
    let u = [x, y, z];
    let twice = cross(u, v).map(|part| 2.0 * part);
    let again = cross(u, twice);
    [0, 1, 2].map(|i| v[i] + w * twice[i] + again[i])
}

fn product([a, b, c, d]: Quaternion, [e, f, g, h]: Quaternion) -> Quaternion {
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

fn conjugate([w, x, y, z]: Quaternion) -> Quaternion {
    [w, -x, -y, -z]
}

fn rotation_vector([w, x, y, z]: Quaternion) -> Vector {
    let [w, x, y, z] = if w < 0.0 { [-w, -x, -y, -z] } else { [w, x, y, z] };
    let sine = x.hypot(y).hypot(z);
    let scale = if sine < 1e-9 { 2.0 } else { 2.0 * sine.atan2(w) / sine };
    [x, y, z].map(|part| scale * part)
}

fn of_vector(vector: Vector) -> Quaternion {
    let angle = dot(vector, vector).sqrt();
    let scale = if angle < 1e-9 { 0.5 } else { (0.5 * angle).sin() / angle };
    let [x, y, z] = vector.map(|part| scale * part);
    [(0.5 * angle).cos(), x, y, z]
}

fn rate_of_vector(phi: Vector, omega: Vector) -> Vector {
    let square = dot(phi, phi);
    let half = 0.5 * square.sqrt();
    let third = if square < 1e-6 { 1.0 / 12.0 } else { (1.0 - half / half.tan()) / square };
    let once = cross(phi, omega);
    let twice = cross(phi, once);
    [0, 1, 2].map(|i| omega[i] + 0.5 * once[i] + third * twice[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steady precession, in closed form: a turn about the inertial z by `a t`, then about the body's z by `b t`, tilted by 0.4 rad.
    fn precessing(t: f64) -> Pose {
        let (a, b, tilt) = (1.0, 0.6, 0.4_f64);
        let attitude = product(
            product(of_vector([0.0, 0.0, a * t]), of_vector([tilt, 0.0, 0.0])),
            of_vector([0.0, 0.0, b * t]),
        );
        let [sin, cos] = [(b * t).sin(), (b * t).cos()].map(|part| a * tilt.sin() * part);
        Pose { t, attitude, omega: [sin, cos, a * tilt.cos() + b] }
    }

    /// Angle between two attitudes.
    fn apart(a: Quaternion, b: Quaternion) -> f64 {
        let phi = rotation_vector(product(conjugate(a), b));
        dot(phi, phi).sqrt()
    }

    #[test]
    fn rows_are_met_and_the_error_between_falls_as_the_fourth_power() {
        let error = |h: f64| {
            let (from, to) = (precessing(0.3), precessing(0.3 + h));
            assert!(apart(between(&from, &to, 0.0), from.attitude) < 1e-7);
            assert!(apart(between(&from, &to, 1.0), to.attitude) < 1e-7);
            let parts = (1..20).map(|i| f64::from(i) / 20.0);
            parts.map(|s| apart(between(&from, &to, s), precessing(0.3 + s * h).attitude)).fold(0.0, f64::max)
        };
        let (coarse, fine) = (error(0.8), error(0.4));
        // 1.2 rad of turn and half of it; less than a third of a pixel in a picture of 300
        assert!(coarse < 2e-3 && coarse / fine > 11.0, "{coarse} {fine}");
    }

    /// A quarter turn about an axis, by hand; q and −q are one attitude.
    #[test]
    fn vectors_turn_as_by_hand() {
        let half = 0.5_f64.sqrt();
        for sign in [1.0, -1.0] {
            let turned = turned([half, 0.0, 0.0, half].map(|part| sign * part), [1.0, 2.0, 3.0]);
            assert!(turned.iter().zip([-2.0, 1.0, 3.0]).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-14));
        }
    }
}
