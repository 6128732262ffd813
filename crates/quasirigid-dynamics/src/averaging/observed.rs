//! Periods of a tumbling body as observers report them, and the torque-free motion that has them.
//! The ratio of the two periods depends on `D` alone and is monotonic within a mode, so bisection finds `D` and either period then `|K|`; a
//! ratio out of range is refused with the range.
//! "Observed periods" and equations (A2), (A3), docs/theory/10-torque-free.md.

use std::f64::consts::TAU;

use thiserror::Error;

use super::poinsot::FreeRotation;
use crate::math::bisection::bisected;
use crate::model::Mode;

/// A tumbling body as observers describe it: two periods and a mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObservedPeriods {
    /// Period of the angular velocity in body axes, that of the rotation about the long axis (s); `P_ψ`.
    pub rotation: f64,
    /// Mean period in which the long axis goes round the angular momentum (s); `P_φ`.
    pub precession: f64,
    /// Axis that the angular momentum circles.
    pub mode: Mode,
}

/// Error of periods that no motion of the body has.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ObservedError {
    /// Period that is not positive, or not finite.
    #[error("periods of {rotation} s and {precession} s are out of range; give two that are positive")]
    Period {
        /// Period of rotation (s).
        rotation: f64,
        /// Period of precession (s).
        precession: f64,
    },
    /// Ratio outside of the range of these moments.
    #[error(
        "no motion in this mode has a period of rotation {ratio:.4} times that of precession; with these moments the ratio lies between {least:.4} and {greatest:.4}"
    )]
    Ratio {
        /// Ratio asked for.
        ratio: f64,
        /// Least ratio that exists.
        least: f64,
        /// Greatest ratio that exists.
        greatest: f64,
    },
}

/// Nearest approach to the axis and to the separatrix in the search, relative to their distance.
const NEAREST_END: f64 = 1e-12;

impl ObservedPeriods {
    /// The periods of a motion.
    #[must_use]
    pub fn from_motion(motion: &FreeRotation) -> Self {
        let precession = TAU / motion.long_axis_precession_rate();
        Self { rotation: motion.polhode_period(), precession, mode: motion.mode() }
    }

    /// The motion with these periods of a body with these principal moments (kg·m²), ascending.
    ///
    /// # Errors
    /// [`ObservedError`].
    pub fn motion(&self, moments: [f64; 3]) -> Result<FreeRotation, ObservedError> {
        let Self { rotation, precession, mode } = *self;
        if !(rotation > 0.0 && precession > 0.0 && rotation.is_finite() && precession.is_finite()) {
            return Err(ObservedError::Period { rotation, precession });
        }
        let [I1, I2, I3] = moments;
        let (axis, separatrix) = match mode {
            Mode::ShortAxis => (1.0, I2 / I3),
            Mode::LongAxis => (I1 / I3, I2 / I3),
        };
        let at = |share: f64| FreeRotation::at_ratio(moments, I3, axis + share * (separatrix - axis));
        let ratio_at = |share: f64| {
            let Self { rotation, precession, .. } = Self::from_motion(&at(share));
            rotation / precession
        };
        let ratio = rotation / precession;
        let shares = [NEAREST_END, 1.0 - NEAREST_END];
        let ends = shares.map(ratio_at);
        let rising = ends[1] > ends[0];
        let [least, greatest] = if rising { ends } else { [ends[1], ends[0]] };
        if !(least..=greatest).contains(&ratio) {
            return Err(ObservedError::Ratio { ratio, least, greatest });
        }
        let unit = at(bisected(shares, ratio_at, ratio, rising));
        let G = unit.angular_momentum() * unit.polhode_period() / rotation;
        Ok(FreeRotation::at_ratio(moments, G, unit.ratio()))
    }
}
