//! What controllers measure on a body. (Y2)

use super::{SensedField, SensedOrbit};
use crate::math::rotation::{product, rotation_vector};
use crate::math::vec3::{add, scale};
use crate::{Marker, MotionState};

/// Quantity that a controller measures. (Y2)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement<P, C, W> {
    /// Time (s).
    Time,
    /// Angular velocity of the carrier about a body axis (rad/s).
    Rate {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Component of the attitude quaternion, scalar first.
    Quaternion {
        /// Component, 0 to 3.
        component: usize,
    },
    /// Attitude error (rad): component of the rotation vector, of length 0 to π, that turns the target to the attitude; body axes.
    Attitude {
        /// Target attitude, unit quaternion, scalar first, from body to inertial axes.
        target: [f64; 4],
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Displacement of a place relative to the carrier along a body axis (m).
    Displacement {
        /// Place.
        at: P,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Velocity of a place relative to the carrier along a body axis (m/s).
    Velocity {
        /// Place.
        at: P,
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Internal coordinate, such as the angle of a hinge (m, rad).
    Coordinate {
        /// Coordinate.
        coordinate: C,
    },
    /// Rate of an internal coordinate (m/s, rad/s).
    Speed {
        /// Coordinate.
        coordinate: C,
    },
    /// Angular momentum of a wheel relative to the carrier about its axis (N·m·s).
    Wheel {
        /// Wheel.
        wheel: W,
    },
    /// Magnetic field along a body axis (T). (Y8)
    Field {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Rate of the magnetic field as the body sees it, along a body axis (T/s). (Y8)
    FieldRate {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Component of the rotation vector (rad), of length 0 to π, from the orbital frame to the attitude; body axes. (Y12)
    OrbitAttitude {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Angular velocity relative to the orbital frame about a body axis (rad/s). (Y12)
    OrbitRate {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Component of the unit vector to the centre of the orbit along a body axis. (Y12)
    Nadir {
        /// Body axis, 0 to 2.
        axis: usize,
    },
    /// Component of the unit vector to the Sun along a body axis. (Y12)
    Sun {
        /// Body axis, 0 to 2.
        axis: usize,
    },
}

/// State of a body that controllers measure.
#[derive(Clone, Copy, Debug)]
pub struct ControlState<'a> {
    /// Time (s).
    pub t: f64,
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Angular velocity and internal coordinates; a rigid body has none, and zero is measured in their place.
    pub motion: MotionState<'a, f64>,
    /// Angular momenta of the wheels of the controls relative to the carrier (N·m·s).
    pub wheels: &'a [f64],
    /// Magnetic field; zero where no controller senses one.
    pub field: SensedField,
    /// Motion relative to the orbital frame; zero where no controller senses it.
    pub orbit: SensedOrbit,
    /// Unit vector to the Sun, body axes; zero where no controller senses it.
    pub sun: [f64; 3],
}

impl<P, C, W> Measurement<P, C, W> {
    /// Measurement with its places, coordinates and wheels mapped to another description.
    ///
    /// # Errors
    /// The error of a map.
    pub(super) fn try_map<Q, D, V, E>(
        &self,
        place: impl Fn(&P) -> Result<Q, E>,
        coordinate: impl Fn(&C) -> Result<D, E>,
        wheel: impl Fn(&W) -> Result<V, E>,
    ) -> Result<Measurement<Q, D, V>, E> {
        Ok(match self {
            Self::Time => Measurement::Time,
            Self::Rate { axis } => Measurement::Rate { axis: *axis },
            Self::Quaternion { component } => Measurement::Quaternion { component: *component },
            Self::Attitude { target, axis } => Measurement::Attitude { target: *target, axis: *axis },
            Self::Displacement { at, axis } => Measurement::Displacement { at: place(at)?, axis: *axis },
            Self::Velocity { at, axis } => Measurement::Velocity { at: place(at)?, axis: *axis },
            Self::Coordinate { coordinate: own } => Measurement::Coordinate { coordinate: coordinate(own)? },
            Self::Speed { coordinate: own } => Measurement::Speed { coordinate: coordinate(own)? },
            Self::Wheel { wheel: own } => Measurement::Wheel { wheel: wheel(own)? },
            Self::Field { axis } => Measurement::Field { axis: *axis },
            Self::FieldRate { axis } => Measurement::FieldRate { axis: *axis },
            Self::OrbitAttitude { axis } => Measurement::OrbitAttitude { axis: *axis },
            Self::OrbitRate { axis } => Measurement::OrbitRate { axis: *axis },
            Self::Nadir { axis } => Measurement::Nadir { axis: *axis },
            Self::Sun { axis } => Measurement::Sun { axis: *axis },
        })
    }

    /// Whether it is of the magnetic field.
    pub(super) fn is_of_field(&self) -> bool {
        matches!(self, Self::Field { .. } | Self::FieldRate { .. })
    }

    /// Whether it is of the Sun.
    pub(super) fn is_of_sun(&self) -> bool {
        matches!(self, Self::Sun { .. })
    }

    /// Whether it is relative to an orbit.
    pub(super) fn is_of_orbit(&self) -> bool {
        matches!(self, Self::OrbitAttitude { .. } | Self::OrbitRate { .. } | Self::Nadir { .. })
    }
}

impl Measurement<Marker, usize, usize> {
    /// Value at a state, without the errors of a sensor.
    #[must_use]
    pub fn value(&self, state: &ControlState) -> f64 {
        let MotionState { omega, q, rate } = state.motion;
        match self {
            Self::Time => state.t,
            Self::Rate { axis } => omega[*axis],
            Self::Quaternion { component } => state.attitude[*component],
            Self::Attitude { target, axis } => attitude_error(*target, state.attitude)[*axis],
            Self::Displacement { at, axis } if !q.is_empty() => at.displacement(q)[*axis],
            Self::Velocity { at, axis } if !q.is_empty() => {
                let slopes = at.displacement_slopes(q);
                slopes.iter().zip(rate).fold([0.0; 3], |v, (slope, rate)| add(v, scale(*rate, *slope)))[*axis]
            }
            Self::Displacement { .. } | Self::Velocity { .. } => 0.0,
            Self::Coordinate { coordinate } => q.get(*coordinate).copied().unwrap_or(0.0),
            Self::Speed { coordinate } => rate.get(*coordinate).copied().unwrap_or(0.0),
            Self::Wheel { wheel } => state.wheels[*wheel],
            Self::Field { axis } => state.field.field[*axis],
            Self::FieldRate { axis } => state.field.rate[*axis],
            Self::OrbitAttitude { axis } => state.orbit.attitude[*axis],
            Self::OrbitRate { axis } => state.orbit.rate[*axis],
            Self::Nadir { axis } => state.orbit.nadir[*axis],
            Self::Sun { axis } => state.sun[*axis],
        }
    }
}

/// Rotation vector (rad) from a target to an attitude, of length 0 to π, body axes. (Y2)
pub(super) fn attitude_error([s, x, y, z]: [f64; 4], attitude: [f64; 4]) -> [f64; 3] {
    rotation_vector(product([s, -x, -y, -z], attitude))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rotation::turned;

    /// Turned about an oblique axis by any angle up to π, from a target off every axis; the sign of the quaternion does not matter.
    #[test]
    fn the_attitude_error_is_the_rotation_vector_from_the_target() {
        let target = turned([1.0, 0.0, 0.0, 0.0], [0.7, -1.1, 0.4]);
        for size in [1e-9, 0.3, 2.0, 3.1] {
            let vector = scale(size / 3.0, [2.0, -1.0, 2.0]);
            let attitude = product(target, turned([1.0, 0.0, 0.0, 0.0], vector));
            for sign in [1.0, -1.0] {
                let found = attitude_error(target, attitude.map(|part| sign * part));
                let gap = add(found, scale(-1.0, vector));
                assert!(gap.iter().all(|part| part.abs() < 1e-15 + 1e-14 * size), "{size} {gap:?}");
            }
        }
    }
}
