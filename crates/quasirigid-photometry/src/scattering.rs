//! Laws of scattering: the light that a facet sends to the observer, as a function of the cosines of incidence and emission.

use std::f64::consts::PI;

use crate::error::PhotometryError;
use crate::hapke::Hapke;
use crate::phase::Phase;

/// Law of scattering, without its phase function. Each is scaled so that a sphere at opposition is as bright as its cross-section, but
/// for Hapke's, whose albedo is its own. (O8)
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scattering {
    /// Single scattering in a dark porous surface, `µ µ₀/(µ + µ₀)`.
    LommelSeeliger,
    /// A surface as bright from every side, `µ µ₀`.
    Lambert,
    /// The sum of Lommel and Seeliger's and of Lambert's law with a weight, `µ µ₀ (1/(µ + µ₀) + c)`.
    Mixed {
        /// Weight `c` of Lambert's law.
        lambert: f64,
    },
    /// Hapke's law with five parameters.
    Hapke(Hapke),
}

/// Law of scattering with its phase function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Law {
    scattering: Scattering,
    phase: Phase,
}

/// Law of scattering at a phase angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LawAt {
    scattering: Scattering,
    /// Phase angle (rad), and the value of the phase function there.
    alpha: f64,
    factor: f64,
}

impl Scattering {
    /// Shares of Lommel and Seeliger's and of Lambert's law, each scaled for itself; none of Hapke's law.
    fn shares(&self) -> Option<[f64; 2]> {
        match *self {
            Self::LommelSeeliger => Some([1.0, 0.0]),
            Self::Lambert => Some([0.0, 1.0]),
            Self::Mixed { lambert } => {
                let [a, b] = [0.5, 2.0 / 3.0 * lambert]; // of a sphere at opposition, over its cross-section
                Some([a / (a + b), b / (a + b)])
            }
            Self::Hapke(_) => None,
        }
    }

    /// Brightness of a sphere at a phase angle (rad) over that at opposition, in closed form. (O9)
    #[must_use]
    pub fn sphere(&self, alpha: f64) -> f64 {
        let [single, lambert] = self.shares().unwrap_or([1.0, 0.0]);
        let half = 0.5 * alpha;
        let seeliger =
            if alpha > 0.0 { 1.0 - half.sin() * half.tan() * (0.5 * half).tan().recip().ln() } else { 1.0 };
        single * seeliger + lambert * (alpha.sin() + (PI - alpha) * alpha.cos()) / PI
    }
}

impl Law {
    /// A law with its phase function.
    ///
    /// # Errors
    /// [`PhotometryError`] for a parameter out of its range, and for a phase function beside Hapke's own.
    pub fn new(scattering: Scattering, phase: Phase) -> Result<Self, PhotometryError> {
        phase.check()?;
        match scattering {
            Scattering::Mixed { lambert } if !(lambert >= 0.0 && lambert.is_finite()) => {
                let range = "zero or a positive number";
                return Err(PhotometryError::Parameter {
                    name: "the weight of Lambert's law",
                    value: lambert,
                    range,
                });
            }
            Scattering::Hapke(_) if phase != Phase::Flat => return Err(PhotometryError::OwnPhase),
            Scattering::Hapke(hapke) => hapke.check()?,
            _ => {}
        }
        Ok(Self { scattering, phase })
    }

    /// Whether the law has an albedo of its own.
    #[must_use]
    pub fn has_albedo(&self) -> bool {
        matches!(self.scattering, Scattering::Hapke(_))
    }

    /// The law at a phase angle (rad).
    ///
    /// # Errors
    /// [`PhotometryError`] for a phase angle at which the phase function does not hold.
    pub fn at(&self, alpha: f64) -> Result<LawAt, PhotometryError> {
        let factor = self.phase.factor(&self.scattering, alpha)?;
        Ok(LawAt { scattering: self.scattering, alpha, factor })
    }
}

impl LawAt {
    /// Light of a facet per area, over that of a white sphere at opposition per cross-section, from the cosines of emission and incidence,
    /// both positive. (O8)
    #[must_use]
    pub fn light(&self, emission: f64, incidence: f64) -> f64 {
        let both = emission * incidence;
        match self.scattering {
            Scattering::LommelSeeliger => self.factor * 2.0 * both / (emission + incidence),
            Scattering::Lambert => self.factor * 1.5 * both,
            Scattering::Hapke(hapke) => hapke.light(emission, incidence, self.alpha),
            Scattering::Mixed { .. } => {
                let [single, lambert] = self.scattering.shares().unwrap_or([1.0, 0.0]);
                self.factor * both * (2.0 * single / (emission + incidence) + 1.5 * lambert)
            }
        }
    }
}
