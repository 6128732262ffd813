/// A Kepler orbit about a centre of attraction, which is the origin of the inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Gravitational parameter of the centre (m³/s²).
    pub parameter: f64,
    /// Semi-major axis (m).
    pub semi_major_axis: f64,
    /// Eccentricity, 0 to below 1.
    pub eccentricity: f64,
    /// Inclination (rad).
    pub inclination: f64,
    /// Longitude of the ascending node (rad).
    pub node: f64,
    /// Argument of the periapsis (rad).
    pub periapsis: f64,
    /// Mean anomaly at time zero (rad).
    pub mean_anomaly: f64,
}
