use super::gravity::FirstMoment;
use super::{Force, KinematicState, Loads};
use crate::math::rotation::Turn;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, scale};
use crate::{FlexibleBody, Marker, MotionState};

/// Pose of a body: time, attitude, place and velocity, without the angular velocity.
#[derive(Clone, Copy, Debug)]
pub struct Pose<T> {
    /// Time (s).
    pub t: T,
    /// Attitude, `R_NB`.
    pub attitude: [T; 4],
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [T; 3],
    /// Velocity of that point (m/s).
    pub velocity: [T; 3],
}

impl FlexibleBody {
    /// Place of the pole of a free body from its centre of mass (m), `−s/m*` with the curvature of the paths, and its inertial
    /// rate (m/s), body axes; zero where a point is fixed or driven. (P7)
    #[must_use]
    pub fn pole_from_center<T: Smooth>(&self, motion: MotionState<T>) -> ([T; 3], [T; 3]) {
        let Some(per_mass) = self.translation() else { return ([T::from(0.0); 3], [T::from(0.0); 3]) };
        let MotionState { omega, q, rate } = motion;
        let FirstMoment { s, slopes } = FirstMoment::of(self, q);
        let stretched =
            rate.iter().zip(slopes).fold(cross(omega, s), |u, (rate, slope)| add(u, scale(*rate, slope)));
        let back = T::from(-per_mass);
        (scale(back, s), scale(back, stretched))
    }

    /// Position of a place (m, body axes) from the centre of mass of a free body, from the pole of any other, with its slopes by the
    /// coordinates. (F1), (P7)
    #[must_use]
    pub fn position_of(&self, at: &Marker, q: &[f64]) -> ([f64; 3], Vec<[f64; 3]>) {
        let position = add(at.position, at.displacement(q));
        let slopes = at.displacement_slopes(q);
        let Some(per_mass) = self.translation() else { return (position, slopes) };
        let FirstMoment { s, slopes: center } = FirstMoment::of(self, q);
        let from_center = |slope: &[f64; 3], center: [f64; 3]| add(*slope, scale(-per_mass, center));
        (
            from_center(&position, s),
            slopes.iter().zip(center).map(|(slope, center)| from_center(slope, center)).collect(),
        )
    }

    /// Loads about the centre of mass of a free body, about the pole of a constrained one. (F1), (F11)
    #[must_use]
    pub fn loads_at<T: Smooth>(
        &self,
        forces: &[Force<Marker>],
        pose: &Pose<T>,
        motion: MotionState<T>,
    ) -> Loads<T> {
        let Pose { t, attitude, place, velocity } = *pose;
        let (mut pole, mut pole_velocity) = (place, velocity);
        if self.translation().is_some() && forces.iter().any(|force| force.law.feels_path()) {
            let (offset, rate) = self.pole_from_center(motion);
            let turn = Turn::of(attitude);
            pole = add(pole, turn.to_inertial(offset));
            pole_velocity = add(pole_velocity, turn.to_inertial(rate));
        }
        let kinematics = KinematicState { t, attitude, pole, pole_velocity, motion };
        let loads = self.loads(forces, &kinematics);
        let pushed = !forces.iter().all(|force| force.law.is_torque());
        if pushed { loads.about_center(self, motion.q) } else { loads }
    }
}
