//! Settings that a model file names: limits of the reduced equations, and variable and method of an integration.

/// Highest order of the reduced equations about rest. The series is asymptotic: long before this its terms stop falling.
pub const MAX_ORDER: usize = 12;

/// Highest degree of the reduced equations about a steady spin, in the amplitude.
pub const MAX_DEGREE: usize = 11;

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
