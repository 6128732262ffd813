//! Forces that the steps of a run did not see, or that could not be followed in time. (Z3), (Z4)

use std::fmt;

/// Force in time that a run missed, which ends the run.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Missed {
    /// The steps did not see the impulse of a force. (Z4)
    Impulse {
        /// Index of the force.
        force: usize,
        /// Begin and end of the interval in which the difference passed its limit (s).
        interval: [f64; 2],
        /// Size of the difference since the start (N·m·s of a torque, N·s of a force).
        difference: f64,
        /// Size of what the force gives since the start, whatever its direction (the same unit).
        whole: f64,
    },
    /// Formulas change too often to be followed. (Z3)
    Unfollowed {
        /// Time from which they could not be followed (s).
        t: f64,
        /// Evaluations spent.
        evaluations: u64,
    },
}

impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Impulse { force, interval: [from, to], difference, whole } => write!(
                f,
                "the steps from t = {from} s to {to} s did not see what force {} gives: its impulse is off by \
                 {difference:.3e} of {whole:.3e} (N m s of a torque, N s of a force); tighten the tolerance, or give the force as windows or a table",
                force + 1
            ),
            Self::Unfollowed { t, evaluations } => write!(
                f,
                "a formula of t changes too often after t = {t} s to be followed: {evaluations} \
                 evaluations did not suffice; smooth it, give it as windows or a table, or shorten the run"
            ),
        }
    }
}
