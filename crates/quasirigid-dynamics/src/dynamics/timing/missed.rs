//! Forces that the steps of a run did not see or could not follow. (Z3), (Z4), (Z7)

use std::fmt;

/// Force that a run could not follow, which ends the run.
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
    /// The motion slides along the places where a formula switches. (Z7)
    Slides {
        /// Index of the force.
        force: usize,
        /// Time (s) at which the body was held there.
        t: f64,
        /// Mean of the last steps (s).
        step: f64,
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
            Self::Slides { force, t, step } => write!(
                f,
                "at t = {t} s the body slides along a switch of force {}: the force turns it back at once from either side, so that it \
                 switches in every step and the steps fell to {step:.1e} s; give the switch a width, `0.5*(1 + tanh(x/width))` for \
                 `step(x)`, or a band in which the force is zero",
                force + 1
            ),
        }
    }
}
