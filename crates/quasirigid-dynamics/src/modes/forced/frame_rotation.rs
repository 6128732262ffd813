//! Axes in which the forces on a body are constant: their rotation, set or free. (M6)

use nalgebra::Vector3;

use super::error::SteadyError;
use super::state::SteadyStateGuess;
use super::timed::{Pace, pace};
use crate::math::taylor::Taylor;
use crate::model::force::{Axes, Force, ForceLaw, MagneticField, Orbit, PLACE, SunPath, TIME, Trajectory};
use crate::model::{FlexibleBody, Marker, Support};

type V = Vector3<f64>;

/// Rotation of the axes in which the forces can be constant.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FrameRotation {
    /// Rotation at this angular velocity (rad/s, inertial axes), set by a force or the support.
    Set { rate: V, what: String, orbit: bool },
    /// Rotation about this unit vector (inertial axes) at any rate.
    About(V),
    /// No rotation: different directions are fixed in space, and the body rests.
    Still,
    /// Rotation about an unknown axis, because of a formula.
    Unknown,
    /// Rotation of the body itself: no force depends on the attitude.
    Own,
}

/// Forces that act on the state, and whether the velocity is followed. Uniform gravity does not affect a free body unless a force depends
/// on the velocity.
pub(super) fn effective(body: &FlexibleBody, forces: &[Force<Marker>]) -> (Vec<Force<Marker>>, bool) {
    let free = body.translation().is_some();
    let at_rest = |law: &ForceLaw<Marker>| match law {
        ForceLaw::Drag { coefficient, .. } | ForceLaw::SpinDrag { coefficient } => *coefficient == 0.0,
        ForceLaw::Torque { torque: a, .. } | ForceLaw::Thrust { force: a, .. } => *a == [0.0; 3],
        ForceLaw::UniformGravity { acceleration } => *acceleration == [0.0; 3],
        ForceLaw::MagneticDipole { moment, field } => *moment == [0.0; 3] || field.is_zero(),
        ForceLaw::EddyCurrent { tensor, field, .. } => *tensor == [[0.0; 3]; 3] || field.is_zero(),
        _ => false,
    };
    let acting: Vec<_> = forces.iter().filter(|force| !at_rest(&force.law)).cloned().collect();
    let followed = free && acting.iter().any(|force| force.law.feels_velocity());
    let felt =
        |law: &ForceLaw<Marker>| !(free && !followed && matches!(law, ForceLaw::UniformGravity { .. }));
    (acting.into_iter().filter(|force| felt(&force.law)).collect(), followed)
}

/// True if the support has no acceleration.
pub(super) fn rests(body: &FlexibleBody) -> bool {
    match body.support() {
        Support::Prescribed { acceleration, .. } => {
            acceleration.iter().all(|component| !component.uses(0) && component.value(&[0.0]) == 0.0)
        }
        _ => true,
    }
}

/// Rotations and directions found in the forces examined so far.
#[derive(Default)]
struct ForceDirections {
    set: Option<(V, String, bool)>,
    /// Directions fixed in space, each with its force or support in words.
    directions: Vec<(V, String)>,
    unknown: bool,
}

/// Relative difference of rates and directions that is rounding.
const SAME_ROTATION: f64 = 1e-9;

impl FrameRotation {
    /// From the laws of the acting forces and the support.
    pub fn of(
        body: &FlexibleBody,
        forces: &[Force<Marker>],
        near: &SteadyStateGuess,
    ) -> Result<Self, SteadyError> {
        if body.wheels().driven.iter().any(|wheel| wheel.speed.uses(0)) {
            return Err(SteadyError::Wheel);
        }
        if let Some(coordinates) = body.driven() {
            return Err(SteadyError::Changes { what: format!("what drives {coordinates}"), part: None });
        }
        let mut found = ForceDirections::default();
        let mut acceleration = V::zeros();
        let driven = matches!(body.support(), Support::Prescribed { .. });
        let placed = forces.iter().any(|force| force.law.feels_path());
        if driven {
            acceleration = -found.support(body)?;
            if placed && !rests(body) && found.set.is_none() {
                return Err(SteadyError::Changes {
                    what: "the velocity of the support, which a force feels,".into(),
                    part: None,
                });
            }
            let velocity = near.velocity;
            if placed && velocity != [0.0; 3] && found.set.is_none() {
                found.directions.push((velocity.into(), "the velocity of the support".into()));
            }
        }
        for force in forces {
            found.force(body, force, near, &mut acceleration)?;
        }
        if acceleration != V::zeros() {
            found.directions.push((acceleration, "the weight, or the acceleration of the support,".into()));
        }
        found.turning()
    }
}

impl ForceDirections {
    /// Acceleration of the support (m/s²) where constant; otherwise zero, with its rotation noted.
    fn support(&mut self, body: &FlexibleBody) -> Result<V, SteadyError> {
        let Support::Prescribed { acceleration, .. } = body.support() else { return Ok(V::zeros()) };
        let series = acceleration
            .each_ref()
            .map(|component| component.value(&[Taylor::<8>::variable(0.0)]).derivatives());
        let a = |k: usize| V::from([0, 1, 2].map(|axis| series[axis][k]));
        if !acceleration.iter().any(|component| component.uses(0)) {
            return Ok(a(0));
        }
        let rate = a(1).cross(&a(2)) / a(1).norm_squared();
        let follows = |k: usize| {
            let expected = rate.cross(&a(k));
            (a(k + 1) - expected).norm() <= SAME_ROTATION * (rate.norm() * a(k).norm() + a(k + 1).norm())
        };
        if !(rate.norm() > 0.0 && rate.norm().is_finite() && (0..7).all(follows)) {
            return Err(SteadyError::Changes { what: "the acceleration of the support".into(), part: None });
        }
        self.set(rate, "the support".into(), false)?;
        Ok(V::zeros())
    }

    fn force(
        &mut self,
        body: &FlexibleBody,
        force: &Force<Marker>,
        near: &SteadyStateGuess,
        acceleration: &mut V,
    ) -> Result<(), SteadyError> {
        let named = format!("the force {:?}", force.name);
        let changes =
            || Err(SteadyError::Changes { what: format!("the force {:?}", force.name), part: None });
        match &force.law {
            ForceLaw::UniformGravity { acceleration: g } => *acceleration += V::from(*g),
            ForceLaw::CentralGravity { orbit: Trajectory::Orbit(orbit) } => self.orbit(&force.name, orbit)?,
            ForceLaw::CentralGravity { .. } => return changes(),
            ForceLaw::MagneticDipole { field, .. } | ForceLaw::EddyCurrent { field, .. } => {
                self.magnetic(&force.name, field)?;
            }
            ForceLaw::Sunlight { sun: SunPath::Fixed { direction, .. }, .. } => {
                self.directions.push(((*direction).into(), named));
            }
            ForceLaw::Sunlight { .. } => return changes(),
            ForceLaw::Drag { .. } | ForceLaw::SpinDrag { .. } => {}
            ForceLaw::Torque { torque: amplitude, axes, wave }
            | ForceLaw::Thrust { force: amplitude, axes, wave, .. } => {
                if wave.frequency != 0.0 {
                    return changes();
                }
                if *axes == Axes::Inertial {
                    self.directions.push(((*amplitude).into(), named));
                }
            }
            ForceLaw::During { .. } | ForceLaw::TorqueTable { .. } | ForceLaw::ForceTable { .. } => {
                return changes();
            }
            law @ (ForceLaw::Expression { .. } | ForceLaw::TorqueExpression { .. }) => {
                if law.uses(TIME..TIME + 1) {
                    match pace(body, force, near) {
                        Some(Pace::Constant) => {}
                        Some(Pace::FrameRotation(rate)) => self.set(rate, named, false)?,
                        None => return changes(),
                    }
                }
                if body.translation().is_some() && law.uses(PLACE) {
                    return Err(SteadyError::Placed { name: force.name.clone() });
                }
                self.unknown |= !law.turns_with_body();
            }
        }
        Ok(())
    }

    fn magnetic(&mut self, name: &str, field: &MagneticField) -> Result<(), SteadyError> {
        let named = format!("the force {name:?}");
        if let Some(orbit) = field.orbit() {
            self.orbit(name, orbit)?;
        }
        match field {
            MagneticField::Dipole { rate, .. } if field.rotation() != 0.0 => {
                self.set(*rate * V::z(), named, false)?;
            }
            MagneticField::Earth { .. } => {
                let what = format!("the field of the force {name:?}, which turns with the Earth,");
                return Err(SteadyError::Changes { what, part: None });
            }
            MagneticField::Uniform(direction) | MagneticField::Dipole { strength: direction, .. } => {
                self.directions.push(((*direction).into(), named));
            }
        }
        Ok(())
    }

    fn orbit(&mut self, name: &str, orbit: &Orbit) -> Result<(), SteadyError> {
        if orbit.eccentricity > 0.0 {
            return Err(SteadyError::Eccentric { name: name.into(), eccentricity: orbit.eccentricity });
        }
        if orbit.precesses() {
            let what = format!("the orbit of the force {name:?}, which precesses,");
            return Err(SteadyError::Changes { what, part: None });
        }
        let passage = orbit.at(0.0);
        let normal = V::from(passage.place).cross(&V::from(passage.velocity)).normalize();
        self.set(orbit.mean_motion() * normal, format!("the force {name:?}"), true)
    }

    fn set(&mut self, rate: V, what: String, orbit: bool) -> Result<(), SteadyError> {
        if let Some((other, one, _)) = &self.set {
            if (other - rate).norm() > SAME_ROTATION * rate.norm() {
                return Err(SteadyError::Apart { one: one.clone(), other: what });
            }
            return Ok(());
        }
        self.set = Some((rate, what, orbit));
        Ok(())
    }

    fn turning(self) -> Result<FrameRotation, SteadyError> {
        let across = |axis: V| {
            move |(other, _): &&(V, String)| other.cross(&axis).norm() > SAME_ROTATION * other.norm()
        };
        if let Some((rate, what, orbit)) = self.set {
            return match self.directions.iter().find(across(rate.normalize())) {
                Some((_, what)) => Err(SteadyError::Changes { what: what.clone(), part: None }),
                None => Ok(FrameRotation::Set { rate, what, orbit }),
            };
        }
        let Some(first) = self.directions.first().map(|(direction, _)| direction.normalize()) else {
            return Ok(if self.unknown { FrameRotation::Unknown } else { FrameRotation::Own });
        };
        let apart = self.directions.iter().any(|pair| across(first)(&pair));
        Ok(if apart { FrameRotation::Still } else { FrameRotation::About(first) })
    }
}
