/// A material point with its equilibrium position and the motion that ideal constraints leave it (paper, §1).
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Unique name.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Equilibrium position (m), in the file's frame.
    pub position: [f64; 3],
    /// Directions in which the point can be displaced from it.
    pub motion: Motion,
}

/// Directions in which a point can move relative to the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// Every direction: three coordinates.
    Free,
    /// Along a line with this direction (any length but zero): one coordinate.
    Line([f64; 3]),
    /// In a plane with this normal (any length but zero): two coordinates.
    Plane([f64; 3]),
}
