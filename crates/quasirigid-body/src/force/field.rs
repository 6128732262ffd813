use super::{EarthField, Orbit, OrbitPoint};
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, dot, scale};

/// Magnetic field, inertial axes. (F8)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MagneticField {
    /// Uniform field (T).
    Uniform([f64; 3]),
    /// Field of a dipole at the centre of an orbit: `B = (3(m·n)n − m)/r³`, `n` from the centre to the body. It may turn about the third
    /// inertial axis, as the tilted dipole of a planet does.
    Dipole {
        /// `μ₀/4π` times the dipole moment at time zero (T·m³), inertial axes.
        strength: [f64; 3],
        /// Rate (rad/s) at which the dipole turns, positive from the first inertial axis to the second.
        rate: f64,
        /// Orbit of the body through the field.
        orbit: Orbit,
    },
    /// Main field of the Earth along an orbit about its centre.
    Earth {
        /// The field.
        field: EarthField,
        /// Orbit of the body through the field.
        orbit: Orbit,
    },
}

impl MagneticField {
    /// Field (T, inertial axes) at the place of the body at a time (s).
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> [T; 3] {
        match self {
            Self::Uniform(field) => field.map(T::from),
            Self::Dipole { strength, orbit, .. } => {
                let [x, y, z] = strength.map(T::from);
                let rate = self.rotation();
                if rate == 0.0 {
                    return of_dipole([x, y, z], orbit, t);
                }
                let (sin, cos) = (T::from(rate) * t).sin_cos();
                of_dipole([cos * x - sin * y, sin * x + cos * y, z], orbit, t)
            }
            Self::Earth { .. } => self.with_rate(t)[0],
        }
    }

    /// Field (T) and its rate (T/s) at the place of the body at a time (s), inertial axes: the body moves through the field, and the dipole
    /// may turn. (F8), (F18)
    #[must_use]
    pub fn with_rate<T: Smooth>(&self, t: T) -> [[T; 3]; 2] {
        let (strength, orbit) = match self {
            Self::Uniform(field) => return [field.map(T::from), [T::from(0.0); 3]],
            Self::Dipole { strength, orbit, .. } => (strength, orbit),
            Self::Earth { field, orbit } => return field.along(t, orbit),
        };
        let rate = T::from(self.rotation());
        let (sin, cos) = (rate * t).sin_cos();
        let [x, y, z] = strength.map(T::from);
        let m = [cos * x - sin * y, sin * x + cos * y, z];
        let turning = [-rate * m[1], rate * m[0], T::from(0.0)];
        dipole_with_rate([m, turning], &orbit.at(t))
    }

    /// True if there is no field anywhere.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        match self {
            Self::Uniform(source) | Self::Dipole { strength: source, .. } => *source == [0.0; 3],
            Self::Earth { .. } => false,
        }
    }

    /// Orbit of the body through the field; none of a uniform field.
    #[must_use]
    pub fn orbit(&self) -> Option<&Orbit> {
        match self {
            Self::Uniform(_) => None,
            Self::Dipole { orbit, .. } | Self::Earth { orbit, .. } => Some(orbit),
        }
    }

    /// Rate (rad/s) at which the dipole, or the Earth, turns; zero where it does not.
    #[must_use]
    pub fn rotation(&self) -> f64 {
        match self {
            Self::Dipole { strength: [x, y, _], rate, .. } if [*x, *y] != [0.0; 2] => *rate,
            Self::Earth { .. } => EarthField::RATE,
            _ => 0.0,
        }
    }
}

/// Field (T) of a dipole (T·m³) at the place on an orbit. (F8)
fn of_dipole<T: Smooth>(m: [T; 3], orbit: &Orbit, t: T) -> [T; 3] {
    let passage = orbit.at(t);
    let per_radius = T::from(1.0) / passage.radius;
    let n = scale(per_radius, passage.place);
    let shape = add(scale(T::from(3.0) * dot(m, n), n), m.map(|entry| -entry));
    scale(per_radius * per_radius * per_radius, shape)
}

/// Field (T) of a dipole (T·m³) that turns at a rate (T·m³/s), and its rate (T/s) at a place that moves. (F18)
pub(super) fn dipole_with_rate<T: Smooth>([m, turning]: [[T; 3]; 2], passage: &OrbitPoint<T>) -> [[T; 3]; 2] {
    let per_radius = T::from(1.0) / passage.radius;
    let [n, v] = [passage.place, passage.velocity].map(|vector| scale(per_radius, vector));
    let (along, rising, crossing) = (dot(m, n), dot(v, n), dot(m, v));
    let moved =
        add(scale(crossing - T::from(5.0) * along * rising, n), add(scale(along, v), scale(rising, m)));
    let shape = |m: [T; 3]| add(scale(T::from(3.0) * dot(m, n), n), m.map(|entry| -entry));
    let cube = per_radius * per_radius * per_radius;
    [scale(cube, shape(m)), scale(cube, add(shape(turning), scale(T::from(3.0), moved)))]
}
