//! Orbit as sensors on a body have it: attitude and rotation relative to the orbital frame, and the direction of the nadir. (Y12)

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use super::measurement::attitude_error;
use crate::force::{OrbitPoint, Trajectory};
use crate::math::rotation::Turn;
use crate::math::scalar::Smooth;
use crate::math::taylor::Taylor;
use crate::math::vec3::{add, cross, dot, scale};

/// Motion relative to the orbital frame (LVLH): `z` to the centre of the orbit, `y` against its angular momentum, `x` ahead. (Y12)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SensedOrbit {
    /// Rotation vector (rad), of length 0 to π, that turns the frame to the attitude; body axes.
    pub attitude: [f64; 3],
    /// Angular velocity of the carrier relative to the frame (rad/s), body axes.
    pub rate: [f64; 3],
    /// Unit vector to the centre, body axes.
    pub nadir: [f64; 3],
}

type Series = Taylor<2>;

impl SensedOrbit {
    /// Motion at a time (s), in an attitude (unit quaternion, scalar first, from body to inertial axes) and at an angular velocity of the
    /// carrier (rad/s, body axes). (Y12)
    #[must_use]
    pub fn of(path: &Trajectory, t: f64, attitude: [f64; 4], omega: [f64; 3]) -> Self {
        let axes = frame(&path.at(Series::variable(t)));
        let value = |axis: [Series; 3]| axis.map(Smooth::value);
        let slope = |axis: [Series; 3]| axis.map(|part| part.coefficient(1));
        let turning =
            axes.iter().fold([0.0; 3], |sum, axis| add(sum, scale(0.5, cross(value(*axis), slope(*axis)))));
        let turn = Turn::of(attitude);
        let rate = add(omega, scale(-1.0, turn.to_body(turning)));
        let target = quaternion(axes.map(value));
        Self { attitude: attitude_error(target, attitude), rate, nadir: turn.to_body(value(axes[2])) }
    }
}

/// Axes of the orbital frame, inertial axes. (Y12)
fn frame(point: &OrbitPoint<Series>) -> [[Series; 3]; 3] {
    let down = scale(Series::from(-1.0) / point.radius, point.place);
    let momentum = cross(point.place, point.velocity);
    let against = scale(Series::from(-1.0) / dot(momentum, momentum).sqrt(), momentum);
    [cross(against, down), against, down]
}

/// Unit quaternion, scalar first, from axes to those that they are given in.
fn quaternion(axes: [[f64; 3]; 3]) -> [f64; 4] {
    let rotation = Rotation3::from_basis_unchecked(&axes.map(Vector3::from));
    let turned = UnitQuaternion::from_rotation_matrix(&rotation);
    [turned.w, turned.i, turned.j, turned.k]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::Orbit;
    use crate::math::rotation::{product, turned};
    use crate::math::vec3::norm;

    fn path(eccentricity: f64, node_rate: f64) -> Trajectory {
        Orbit {
            mu: 3.986e14,
            semi_major_axis: 7.2e6,
            eccentricity,
            inclination: 1.1,
            raan: 0.4,
            argument_of_periapsis: -0.7,
            mean_anomaly: 2.0,
            node_rate,
            periapsis_rate: -0.5 * node_rate,
        }
        .into()
    }

    /// On a circle the frame turns by the mean motion about its second axis, backwards; a body in it has no attitude and no rate.
    #[test]
    fn a_body_that_keeps_to_the_frame_measures_nothing() {
        let circle = path(0.0, 0.0);
        let Trajectory::Orbit(orbit) = circle else { unreachable!() };
        for t in [0.0, 900.0, 4000.0] {
            let point = circle.at(Series::variable(t));
            let axes = frame(&point).map(|axis| axis.map(Smooth::value));
            let attitude = quaternion(axes);
            let found = SensedOrbit::of(&circle, t, attitude, [0.0, -orbit.mean_motion(), 0.0]);
            assert!(norm(found.attitude) < 1e-14, "{found:?}");
            assert!(norm(found.rate) < 1e-14 * orbit.mean_motion() + 1e-18, "{found:?}");
            assert!(norm(add(found.nadir, [0.0, 0.0, -1.0])) < 1e-14, "{found:?}");
            let ahead = point.velocity.map(Smooth::value);
            assert!((dot(axes[0], ahead) / norm(ahead) - 1.0).abs() < 1e-14);
        }
    }

    /// The rotation vector from the frame grows by the rate relative to it, on an ellipse that precesses: by differences of the attitude.
    #[test]
    fn the_rate_is_the_slope_of_the_attitude() {
        let ellipse = path(0.3, 2e-4);
        let (t, step, omega) = (700.0, 1e-2, [0.003, -0.002, 0.001]);
        let axes = frame(&ellipse.at(Series::variable(t))).map(|axis| axis.map(Smooth::value));
        let start = quaternion(axes);
        let at = |after: f64| {
            SensedOrbit::of(
                &ellipse,
                t + after,
                product(start, turned([1.0, 0.0, 0.0, 0.0], scale(after, omega))),
                omega,
            )
        };
        let slope = scale(0.5 / step, add(at(step).attitude, scale(-1.0, at(-step).attitude)));
        let gap = add(slope, scale(-1.0, at(0.0).rate));
        assert!(norm(gap) < 1e-9 * norm(slope), "{slope:?} {gap:?}");
    }
}
