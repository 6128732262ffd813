use crate::model::Motion;

/// Where the body is and how it moves, as external forces see it.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a, T> {
    /// Time (s).
    pub t: T,
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [T; 4],
    /// Place of the pole `R₀` (m), inertial axes.
    pub pole: [T; 3],
    /// Velocity of the pole `Ṙ₀` (m/s), inertial axes.
    pub pole_velocity: [T; 3],
    /// Spin and internal coordinates.
    pub motion: Motion<'a, T>,
}

/// What external forces do to a body. (F1)
#[derive(Clone, Debug, PartialEq)]
pub struct Loads<T> {
    /// Sum of the forces (N), body axes.
    pub force: [T; 3],
    /// Their moment about the pole (N·m), body axes.
    pub moment: [T; 3],
    /// Generalised force on each coordinate, `Q_j = Σ ∂u/∂q_j · F`.
    pub generalized: Vec<T>,
}
