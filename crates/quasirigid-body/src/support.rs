use crate::math::expression::Expression;

/// Support of the body, which determines the pole `O`.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a body has one")]
pub enum Support {
    /// Free in space: `O` is the centre of mass of the frozen body `S*` and the translation is eliminated.
    #[default]
    Free,
    /// One point of the carrier is fixed in space and is the pole `O`.
    FixedPoint {
        /// Point (m), in the frame of the model file.
        point: [f64; 3],
    },
    /// One point of the carrier is driven on a given path and is the pole `O`. (F2)
    Prescribed {
        /// Point (m), in the frame of the model file.
        point: [f64; 3],
        /// Acceleration `R̈₀(t)` of the pole (m/s²), inertial axes: expressions of the single variable `t`.
        acceleration: [Expression; 3],
        /// Velocity of the pole at `t = 0` (m/s), inertial axes.
        velocity: [f64; 3],
        /// Place of the pole at `t = 0` (m), inertial axes.
        position: [f64; 3],
    },
}
