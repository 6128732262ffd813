//! External loads: force, moment and generalised forces of all laws on a body in motion.
//! Generic over the scalar, so that the same code gives values, Taylor series in time and first variations; each law acts on the displaced
//! place, curvature included.
//! Equations (F1), (F2), (F5), (F6), (F9), (F11) to (F15), (F22) and (F27), docs/theory/07-forces.md; (S1), docs/theory/01-system.md.

use std::cell::OnceCell;

use super::gravity::FirstMoment;
use super::{Axes, Force, ForceLaw, VARIABLES, Wave, eddy};
use crate::math::rotation::Turn;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, dot, scale};
use crate::{FlexibleBody, Marker, MotionState, Support};

/// Kinematic state of a body for the evaluation of external forces: time, attitude, pole and motion.
#[derive(Clone, Copy, Debug)]
pub struct KinematicState<'a, T> {
    /// Time (s).
    pub t: T,
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [T; 4],
    /// Place of the pole `R₀` (m), inertial axes.
    pub pole: [T; 3],
    /// Velocity of the pole `Ṙ₀` (m/s), inertial axes.
    pub pole_velocity: [T; 3],
    /// Angular velocity and internal coordinates.
    pub motion: MotionState<'a, T>,
}

/// Loads of external forces on a body. (F1)
#[derive(Clone, Debug, PartialEq)]
pub struct Loads<T> {
    /// Sum of the forces (N), body axes.
    pub force: [T; 3],
    /// Moment of the forces about the pole (N·m), body axes.
    pub moment: [T; 3],
    /// Generalised force on each coordinate, `Q_j = Σ ∂u/∂q_j · F`.
    pub generalized: Vec<T>,
}

impl FlexibleBody {
    /// Loads of external forces on the body, with the inertial force of a driven pole. (F1), (F2)
    ///
    /// The acceleration of a driven pole is that of the support, independent of the velocity in `kinematics`.
    #[must_use]
    pub fn loads<T: Smooth>(&self, forces: &[Force<Marker>], kinematics: &KinematicState<T>) -> Loads<T> {
        let mut loads = Loads::none(self.coordinates().len());
        let context = LoadContext { body: self, kinematics, turn: OnceCell::new() };
        if let Support::Prescribed { acceleration, .. } = self.support() {
            let inertial = acceleration.each_ref().map(|component| -component.value(&[kinematics.t]));
            loads.add_uniform(self, kinematics.motion.q, context.turn().to_body(inertial));
        }
        for force in forces {
            context.add(&force.law, &mut loads);
        }
        loads
    }
}

/// Values of the variables of a formula, in their order. (F9)
pub type Felt = [f64; VARIABLES];

impl FlexibleBody {
    /// What the formulas of a law feel at a state. (F9)
    #[doc(hidden)]
    pub fn felt(&self, law: &ForceLaw<Marker>, kinematics: &KinematicState<f64>) -> Felt {
        let context = LoadContext { body: self, kinematics, turn: OnceCell::new() };
        let Some(at) = law.place() else { return context.felt(kinematics.pole, kinematics.pole_velocity) };
        let (place, velocity) = context.passing(at);
        context.felt_at(&place, velocity)
    }
}

impl<T: Smooth> Loads<T> {
    /// No load on a body with this many coordinates.
    #[must_use]
    pub fn none(coordinates: usize) -> Self {
        let zero = T::from(0.0);
        Self { force: [zero; 3], moment: [zero; 3], generalized: vec![zero; coordinates] }
    }

    /// Loads on a free body about its true centre of mass, with the translation eliminated; unchanged for a constrained body. (F11)
    #[must_use]
    pub fn about_center(&self, body: &FlexibleBody, q: &[T]) -> Self {
        let mut loads = self.clone();
        if let Some(per_mass) = body.translation() {
            let FirstMoment { s, slopes } = FirstMoment::of(body, q);
            let recoil = scale(T::from(-per_mass), self.force);
            loads.add_torque(cross(s, recoil));
            for (Q, slope) in loads.generalized.iter_mut().zip(slopes) {
                *Q = *Q + dot(slope, recoil);
            }
        }
        loads
    }

    /// Rate of work (W), `F·V + M·ω + Q·q̇`, with the velocity `V` (m/s, body axes) of the point of reference of the moment. (F12)
    #[must_use]
    pub fn power(&self, motion: MotionState<T>, velocity: [T; 3]) -> T {
        let rigid = dot(self.force, velocity) + dot(self.moment, motion.omega);
        self.generalized.iter().zip(motion.rate).fold(rigid, |power, (Q, rate)| power + *Q * *rate)
    }

    /// Adds a torque on the carrier (N·m, body axes).
    pub(super) fn add_torque(&mut self, torque: [T; 3]) {
        self.moment = add(self.moment, torque);
    }

    /// Adds a force (N, body axes) at a place with the position `u` (m) from the pole and the slopes `∂u/∂q_j`. (F1)
    fn add_force(&mut self, (u, slopes): &DisplacedPlace<T>, force: [T; 3]) {
        self.force = add(self.force, force);
        self.add_torque(cross(*u, force));
        for (j, slope) in slopes {
            self.generalized[*j] = self.generalized[*j] + dot(*slope, force);
        }
    }
}

/// Place from the pole (m), with the slopes of its displacement by coordinate.
type DisplacedPlace<T> = ([T; 3], Vec<(usize, [T; 3])>);

/// Body and kinematic state for the evaluation of laws.
struct LoadContext<'a, T> {
    body: &'a FlexibleBody,
    kinematics: &'a KinematicState<'a, T>,
    turn: OnceCell<Turn<T>>,
}

impl<T: Smooth> LoadContext<'_, T> {
    fn add(&self, law: &ForceLaw<Marker>, loads: &mut Loads<T>) {
        let KinematicState { t, motion, .. } = *self.kinematics;
        match law {
            ForceLaw::UniformGravity { acceleration } => {
                loads.add_uniform(self.body, motion.q, self.turn().to_body(acceleration.map(T::from)));
            }
            ForceLaw::CentralGravity { orbit } => {
                let passage = orbit.at(t);
                let per_radius = T::from(1.0) / passage.radius;
                let n = self.turn().to_body(scale(per_radius, passage.place));
                let kappa = T::from(orbit.mu()) * per_radius * per_radius * per_radius;
                loads.add_gradient(self.body, motion.q, n, kappa);
            }
            ForceLaw::Drag { at, coefficient } => {
                let (place, velocity) = self.passing(at);
                loads.add_force(&place, scale(T::from(-coefficient), velocity));
            }
            ForceLaw::SpinDrag { coefficient } => {
                loads.add_torque(scale(T::from(-coefficient), motion.omega))
            }
            ForceLaw::Torque { torque, axes, wave } => {
                loads.add_torque(self.turned(self.varying(*torque, *wave), *axes, None));
            }
            ForceLaw::Thrust { at, force, axes, wave } => {
                loads.add_force(&self.place(at), self.turned(self.varying(*force, *wave), *axes, Some(at)));
            }
            ForceLaw::MagneticDipole { moment, field } => {
                loads.add_torque(cross(moment.map(T::from), self.turn().to_body(field.at(t))));
            }
            ForceLaw::EddyCurrent { tensor, field, .. } => {
                let fields = field.with_rate(t).map(|vector| self.turn().to_body(vector));
                loads.add_torque(eddy::torque(tensor, motion.omega, fields));
            }
            ForceLaw::Sunlight { loads: of_sun, sun } => {
                let (toward, pressure) = sun.at(t);
                let [force, torque] = of_sun.about(self.body.pole(), self.turn().to_body(toward));
                loads.force = add(loads.force, scale(pressure, force));
                loads.add_torque(scale(pressure, torque));
            }
            ForceLaw::Expression { at, force } => {
                let (at, velocity) = self.passing(at);
                let felt = self.felt_at(&at, velocity);
                let force = force.each_ref().map(|component| component.value(&felt));
                loads.add_force(&at, self.turn().to_body(force));
            }
            ForceLaw::TorqueExpression { torque, axes } => {
                let felt = self.felt(self.kinematics.pole, self.kinematics.pole_velocity);
                let torque = torque.each_ref().map(|component| component.value(&felt));
                loads.add_torque(self.turned(torque, *axes, None));
            }
            ForceLaw::TorqueTable { table, axes } => {
                loads.add_torque(self.turned(table.at(t), *axes, None));
            }
            ForceLaw::ForceTable { at, table, axes } => {
                loads.add_force(&self.place(at), self.turned(table.at(t), *axes, Some(at)));
            }
            ForceLaw::During { windows, law } => {
                if windows.contains(t.value()) {
                    self.add(law, loads);
                }
            }
        }
    }

    fn turn(&self) -> &Turn<T> {
        self.turn.get_or_init(|| Turn::of(self.kinematics.attitude))
    }

    /// Values of the variables of a formula at a displaced place with its velocity (m/s), body axes. (F9)
    fn felt_at(&self, (u, _): &DisplacedPlace<T>, velocity: [T; 3]) -> [T; VARIABLES] {
        let place = add(self.kinematics.pole, self.turn().to_inertial(*u));
        self.felt(place, self.turn().to_inertial(velocity))
    }

    /// Values of the variables of a formula, in their order. (F9)
    fn felt(&self, [x, y, z]: [T; 3], [vx, vy, vz]: [T; 3]) -> [T; VARIABLES] {
        let KinematicState { t, attitude: [qw, qx, qy, qz], motion, .. } = *self.kinematics;
        let [wx, wy, wz] = motion.omega;
        [x, y, z, vx, vy, vz, t, wx, wy, wz, qw, qx, qy, qz]
    }

    /// Displaced place from the pole (m), body axes, and its slopes by coordinate. (S1), (I12)
    fn place(&self, at: &Marker) -> DisplacedPlace<T> {
        let (displacement, slopes) = at.displaced(self.kinematics.motion.q);
        (add(at.position.map(T::from), displacement), slopes)
    }

    /// Displaced place from the pole (m), with its slopes, and its inertial velocity (m/s), body axes. (F5)
    fn passing(&self, at: &Marker) -> (DisplacedPlace<T>, [T; 3]) {
        let KinematicState { pole_velocity, motion: MotionState { omega, rate, .. }, .. } = *self.kinematics;
        let (u, slopes) = self.place(at);
        let carried = add(self.turn().to_body(pole_velocity), cross(omega, u));
        let velocity = slopes.iter().fold(carried, |v, (j, slope)| add(v, scale(rate[*j], *slope)));
        ((u, slopes), velocity)
    }

    /// Value of a varying amplitude at the time of the state, in its own axes. (F6)
    fn varying(&self, amplitude: [f64; 3], wave: Wave) -> [T; 3] {
        let phase = T::from(wave.frequency) * self.kinematics.t + T::from(wave.phase);
        scale(phase.cos(), amplitude.map(T::from))
    }

    /// Vector in body axes; torques, which act on the carrier, have no place. (F22)
    fn turned(&self, vector: [T; 3], axes: Axes, at: Option<&Marker>) -> [T; 3] {
        match (axes, at) {
            (Axes::Inertial, _) => self.turn().to_body(vector),
            (Axes::Place, Some(at)) => at.turned(self.kinematics.motion.q, vector),
            (Axes::Body | Axes::Place, _) => vector,
        }
    }
}
