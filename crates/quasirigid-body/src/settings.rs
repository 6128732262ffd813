//! Settings of an integration that a model file names: the variable and the method.

/// Form of the reduced equations: the variable of integration.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Energy form: `K` in body axes; `|K|` is exact, and the energy falls by exactly the power. (P1), (R16)
    #[default]
    AngularMomentum,
    /// Angular-velocity form: `J ω̇ + ω × (Jω + k) = μ(ω)`, as in the paper, with the angular momentum `k` of wheels. (P2)
    AngularVelocity,
}

/// Method of integration of a full system.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Explicit while vibrations have to be followed, implicit while the step is many times their period.
    #[default]
    Automatic,
    /// Explicit, of order 8: cheap steps, but none longer than the fastest vibration.
    Explicit,
    /// Implicit, of order 13: costly steps, as long as the motion allows.
    Implicit,
}
