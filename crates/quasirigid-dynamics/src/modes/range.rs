//! Modes of a spin that were looked for: all, or of a body of many coordinates the slowest.

/// Modes of a spin that were looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeRange {
    /// All of them.
    All,
    /// The slowest, of a body of many coordinates. (M24)
    Slowest(SlowModes),
}

/// Slowest modes of a body of many coordinates. (M24)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowModes {
    /// Size `|λ|` (1/s) up to which modes were looked for, in the equations of motion.
    pub rate: f64,
    /// Number of eigenvalues below that rate, counted by the argument principle, that were not found, each of a pair by itself; none where they
    /// could not be counted.
    pub missing: Option<usize>,
    /// Whether the second variation of the energy is positive, so that no motion grows, found or not. (M4)
    pub positive_energy: bool,
}

impl ModeRange {
    /// Rate (1/s) below which no motion in the equations of motion is left out; none where that is not known.
    #[must_use]
    pub fn complete_below(&self) -> Option<f64> {
        match self {
            Self::All => Some(f64::INFINITY),
            Self::Slowest(slowest) => (slowest.missing == Some(0)).then_some(slowest.rate),
        }
    }

    /// Whether a spin without a growing mode among those found is stable.
    #[must_use]
    pub fn shows_stability(&self) -> bool {
        match self {
            Self::All => true,
            Self::Slowest(slowest) => slowest.positive_energy,
        }
    }
}
