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
                let rate = self.rotation();
                let passage = orbit.at(t);
                if rate == 0.0 {
                    return of_dipole(strength.map(T::from), &passage);
                }
                of_dipole(turning_dipole(*strength, T::from(rate) * t, rate)[0], &passage)
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
        let rate = self.rotation();
        dipole_with_rate(turning_dipole(*strength, T::from(rate) * t, rate), &orbit.at(t))
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

/// A dipole (T·m³) that has turned by an angle (rad) about the third axis, and its rate (T·m³/s) where it turns at a rate (rad/s).
pub(super) fn turning_dipole<T: Smooth>(strength: [f64; 3], angle: T, rate: f64) -> [[T; 3]; 2] {
    let (sin, cos) = angle.sin_cos();
    let [x, y, z] = strength.map(T::from);
    let m = [cos * x - sin * y, sin * x + cos * y, z];
    let rate = T::from(rate);
    [m, [-rate * m[1], rate * m[0], T::from(0.0)]]
}

/// Field (T) of a dipole (T·m³) at the place on an orbit. (F8)
fn of_dipole<T: Smooth>(m: [T; 3], passage: &OrbitPoint<T>) -> [T; 3] {
    let per_radius = T::from(1.0) / passage.radius;
    scale(per_radius * per_radius * per_radius, dipole_shape(m, scale(per_radius, passage.place)))
}

/// `3(m·n)n − m`.
fn dipole_shape<T: Smooth>(m: [T; 3], n: [T; 3]) -> [T; 3] {
    add(scale(T::from(3.0) * dot(m, n), n), m.map(|entry| -entry))
}

/// Field (T) of a dipole (T·m³) that turns at a rate (T·m³/s), and its rate (T/s) at a place that moves. (F18)
pub(super) fn dipole_with_rate<T: Smooth>([m, turning]: [[T; 3]; 2], passage: &OrbitPoint<T>) -> [[T; 3]; 2] {
    let per_radius = T::from(1.0) / passage.radius;
    let [n, v] = [passage.place, passage.velocity].map(|vector| scale(per_radius, vector));
    let (along, rising, crossing) = (dot(m, n), dot(v, n), dot(m, v));
    let moved =
        add(scale(crossing - T::from(5.0) * along * rising, n), add(scale(along, v), scale(rising, m)));
    let cube = per_radius * per_radius * per_radius;
    let change = add(dipole_shape(turning, n), scale(T::from(3.0), moved));
    [scale(cube, dipole_shape(m, n)), scale(cube, change)]
}
