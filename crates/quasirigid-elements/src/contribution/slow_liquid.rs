/// Effect of a liquid on a slow rotation.
#[derive(Clone, Debug, PartialEq)]
pub struct SlowLiquid {
    /// Mass (kg).
    pub mass: f64,
    /// Radius of the ball of liquid that would follow as slowly, `√(35 P/I)` for the axis about which this is most (m).
    pub radius: f64,
    /// Tensor `P` (m⁷), in the file's axes. (L5)
    pub tensor: [[f64; 3]; 3],
    /// Estimate of the relative error of finite elements in `P` about each axis of the shape; none of exact flows.
    pub errors: Option<[f64; 3]>,
    /// Inertia tensor of the body that the liquid is equivalent to at high Reynolds numbers (kg m²), in the file's axes; none of a liquid
    /// that is viscous throughout. (L12)
    pub equivalent: Option<[[f64; 3]; 3]>,
    /// Kinematic viscosity (m²/s).
    pub viscosity: f64,
}
