//! Phase functions: how the brightness falls with the angle between Sun and observer, beside what the shape and the law make of it.

use crate::error::PhotometryError;
use crate::scattering::Scattering;

/// Greatest phase angle (degrees) of the H,G system, that of the observations it was made from `[@bowell1989]`.
const HG_MOST: f64 = 120.0;

/// Factor of the light of every facet that depends on the phase angle alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// One at every angle.
    Flat,
    /// `a exp(−α/d) + k α + 1`, an opposition surge and a slope. (O10)
    ExponentialLinear {
        /// Height of the surge.
        amplitude: f64,
        /// Width of the surge (rad).
        width: f64,
        /// Slope (1/rad).
        slope: f64,
    },
    /// The factor with which a sphere follows the H,G system. (O11)
    HG {
        /// Slope parameter.
        G: f64,
    },
}

impl Phase {
    /// Refuses parameters that make no phase function.
    pub(crate) fn check(self) -> Result<(), PhotometryError> {
        let refuse = |name, value, range| Err(PhotometryError::Parameter { name, value, range });
        match self {
            Self::Flat => Ok(()),
            Self::ExponentialLinear { amplitude, .. } if !(amplitude >= 0.0 && amplitude.is_finite()) => {
                refuse("the amplitude of the surge", amplitude, "zero or a positive number")
            }
            Self::ExponentialLinear { width, .. } if !(width > 0.0 && width.is_finite()) => {
                refuse("the width of the surge", width, "a positive angle")
            }
            Self::ExponentialLinear { slope, .. } if !slope.is_finite() => {
                refuse("the slope", slope, "a finite number")
            }
            Self::HG { G } if !(-0.5..=1.0).contains(&G) => refuse("G", G, "a number from -0.5 to 1"),
            Self::ExponentialLinear { .. } | Self::HG { .. } => Ok(()),
        }
    }

    /// The factor at a phase angle (rad), for a law of scattering.
    pub(crate) fn factor(self, scattering: &Scattering, alpha: f64) -> Result<f64, PhotometryError> {
        let value = match self {
            Self::Flat => 1.0,
            Self::ExponentialLinear { amplitude, width, slope } => {
                amplitude * (-alpha / width).exp() + slope * alpha + 1.0 // (O10)
            }
            Self::HG { .. } if alpha.to_degrees() > HG_MOST => {
                return Err(PhotometryError::PhaseRange { law: "the H,G system", alpha, most: HG_MOST });
            }
            Self::HG { G } => hg(G, alpha) / scattering.sphere(alpha), // (O11)
        };
        if value > 0.0 && value.is_finite() {
            Ok(value)
        } else {
            Err(PhotometryError::NoLight { alpha, value })
        }
    }
}

/// Phase function of the H,G system `[@bowell1989]`.
fn hg(G: f64, alpha: f64) -> f64 {
    let part = |a: f64, b: f64| (-a * (0.5 * alpha).tan().powf(b)).exp();
    (1.0 - G) * part(3.33, 0.63) + G * part(1.87, 1.22)
}
