//! Kepler orbit: place and velocity at any time, also as Taylor series.
//! Kepler's equation is solved from above its root, where Newton's method descends without overshoot at any eccentricity; Newton's steps in
//! series arithmetic then give the derivatives.
//! Equations (F10) and (F20), docs/theory/07-forces.md.

use std::f64::consts::{PI, TAU};

use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, scale};

/// Kepler orbit about a centre of attraction, the origin of the inertial axes. (F10)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Gravitational parameter `μ₀` of the centre (m³/s²).
    pub mu: f64,
    /// Semi-major axis (m).
    pub semi_major_axis: f64,
    /// Eccentricity, 0 to below 1.
    pub eccentricity: f64,
    /// Inclination (rad).
    pub inclination: f64,
    /// Right ascension of the ascending node (rad).
    pub raan: f64,
    /// Argument of the periapsis (rad).
    pub argument_of_periapsis: f64,
    /// Mean anomaly at time zero (rad).
    pub mean_anomaly: f64,
    /// Rate (rad/s) at which the node precesses.
    pub node_rate: f64,
    /// Rate (rad/s) at which the argument of the periapsis precesses.
    pub periapsis_rate: f64,
}

/// Oblateness of a centre of attraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oblateness {
    /// `J₂`, of second degree and unnormalised.
    pub j2: f64,
    /// Radius (m) that it goes with.
    pub radius: f64,
}

/// Point of an orbit, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitPoint<T> {
    /// Place from the centre (m).
    pub place: [T; 3],
    /// Velocity (m/s).
    pub velocity: [T; 3],
    /// Distance from the centre `r` (m).
    pub radius: T,
}

impl Oblateness {
    /// That of the Earth, after EGM2008.
    pub const EARTH: Self = Self { j2: 1.082_635_5e-3, radius: 6_378_136.3 };
    /// That of Mars, after GMM-3.
    pub const MARS: Self = Self { j2: 1.956_61e-3, radius: 3.396e6 };
}

impl Orbit {
    /// Gravitational parameter of the Earth (m³/s²), as recommended by the IAU (2009), in TCG.
    pub const EARTH_PARAMETER: f64 = 3.986_004_418e14;

    /// Mean motion (rad/s).
    #[must_use]
    pub fn mean_motion(&self) -> f64 {
        (self.mu / self.semi_major_axis).sqrt() / self.semi_major_axis
    }

    /// Period (s).
    #[must_use]
    pub fn period(&self) -> f64 {
        TAU / self.mean_motion()
    }

    /// The orbit with the secular precession of node and periapsis by an oblate centre. (F20)
    #[must_use]
    pub fn about(self, Oblateness { j2, radius }: Oblateness) -> Self {
        let p = self.semi_major_axis * (1.0 - self.eccentricity) * (1.0 + self.eccentricity);
        let unit = 1.5 * self.mean_motion() * j2 * (radius / p).powi(2);
        let cosine = self.inclination.cos();
        Self { node_rate: -unit * cosine, periapsis_rate: 0.5 * unit * (5.0 * cosine * cosine - 1.0), ..self }
    }

    /// The orbit with node and periapsis where they are at a time (s): the angles that precess, not the place of the body.
    #[must_use]
    pub fn precessed(&self, t: f64) -> Self {
        Self {
            raan: self.raan + self.node_rate * t,
            argument_of_periapsis: self.argument_of_periapsis + self.periapsis_rate * t,
            ..*self
        }
    }

    /// Whether node or periapsis precess.
    #[must_use]
    pub fn precesses(&self) -> bool {
        self.node_rate != 0.0 || self.periapsis_rate != 0.0
    }

    /// Place and velocity at a time (s), which may be a series. (F10), (F20)
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> OrbitPoint<T> {
        let (a, e) = (self.semi_major_axis, self.eccentricity);
        let b = a * ((1.0 - e) * (1.0 + e)).sqrt();
        let n = self.mean_motion();
        let E = eccentric_anomaly(e, T::from(self.mean_anomaly) + T::from(n) * t);
        let (sin, cos) = E.sin_cos();
        let shortened = T::from(1.0) - T::from(e) * cos; // r/a
        let rate = T::from(n) / shortened; // dE/dt
        let [along, across] = self.axes_at(t);
        let at = |x: T, y: T| add(scale(T::from(a) * x, along), scale(T::from(b) * y, across));
        let (place, velocity) = (at(cos - T::from(e), sin), at(-sin * rate, cos * rate));
        let radius = T::from(a) * shortened;
        if !self.precesses() {
            return OrbitPoint { place, velocity, radius };
        }
        let turning = self.turning([along, across]);
        OrbitPoint { place, velocity: add(velocity, cross(turning, place)), radius }
    }

    /// Angular velocity (rad/s) of the axes of the orbit. (F20)
    pub(super) fn turning<T: Smooth>(&self, [along, across]: [[T; 3]; 2]) -> [T; 3] {
        let [x, y, z] = scale(T::from(self.periapsis_rate), cross(along, across));
        [x, y, z + T::from(self.node_rate)]
    }

    /// Unit vectors towards the periapsis and along the motion there at a time (s).
    fn axes_at<T: Smooth>(&self, t: T) -> [[T; 3]; 2] {
        if !self.precesses() {
            return self.axes().map(|axis| axis.map(T::from));
        }
        let turned = |angle: f64, rate: f64| (T::from(angle) + T::from(rate) * t).sin_cos();
        let (sn, cn) = turned(self.raan, self.node_rate);
        let (sp, cp) = turned(self.argument_of_periapsis, self.periapsis_rate);
        let (si, ci) = self.inclination.sin_cos();
        let (si, ci) = (T::from(si), T::from(ci));
        [
            [cn * cp - sn * sp * ci, sn * cp + cn * sp * ci, sp * si],
            [-cn * sp - sn * cp * ci, -sn * sp + cn * cp * ci, cp * si],
        ]
    }

    /// Unit vectors towards the periapsis and along the motion there, a quarter of a revolution ahead.
    pub(super) fn axes(&self) -> [[f64; 3]; 2] {
        axes(self.inclination, self.raan, self.argument_of_periapsis)
    }
}

/// Unit vectors towards the periapsis and along the motion there, from inclination, node and argument of the periapsis (rad).
pub(super) fn axes(inclination: f64, raan: f64, argument_of_periapsis: f64) -> [[f64; 3]; 2] {
    let [(si, ci), (sn, cn), (sp, cp)] =
        [inclination, raan, argument_of_periapsis].map(|angle: f64| angle.sin_cos());
    [
        [cn * cp - sn * sp * ci, sn * cp + cn * sp * ci, sp * si],
        [-cn * sp - sn * cp * ci, -sn * sp + cn * cp * ci, cp * si],
    ]
}

/// Root `E` of Kepler's equation `E − e sin E = M` (rad), less whole revolutions. (F10)
fn eccentric_anomaly<T: Smooth>(e: f64, M: T) -> T {
    let M = M - T::from(TAU * (M.value() / TAU).round());
    let mut E = T::from(kepler_root(e, M.value()));
    // Each step doubles the number of terms that are exact.
    let doublings = T::TERMS.next_power_of_two().ilog2();
    for _ in 0..doublings {
        let (sin, cos) = E.sin_cos();
        E = E - (E - T::from(e) * sin - M) / (T::from(1.0) - T::from(e) * cos);
    }
    E
}

/// Root of Kepler's equation for `|M| ≤ π`.
///
/// For positive `M` the equation is convex up to π, so Newton's steps from above the root descend to it; the steps end where rounding
/// stops the descent. The start is the least of three bounds: `sin E ≤ 1`, `sin E ≤ E` and `E − sin E ≥ E³/π²`.
fn kepler_root(e: f64, M: f64) -> f64 {
    let height = M.abs();
    let mut E = (height + e).min(height / (1.0 - e)).min((PI * PI * height).cbrt());
    loop {
        let next = E - (E - e * E.sin() - height) / (1.0 - e * E.cos());
        if !(next < E) {
            return E.copysign(M);
        }
        E = next;
    }
}
