//! Rheology of a viscoelastic material: complex modulus at a real frequency, and its continuation to complex ones.
//! Relative to the elastic modulus, so that one stiffness matrix serves every law; only a Kelvin–Voigt law has an equation of motion, the
//! others act in averages and modes.
//! Equation (G1), docs/theory/11-materials.md; Andrade's law `[@andrade1910]`.

use std::f64::consts::FRAC_PI_2;

use nalgebra::Complex;

use thiserror::Error;

/// Rheology: response of a material to a strain that varies with time. (G1)
///
/// A strain `e^{iνt}` causes [`modulus`](Self::modulus) times the elastic stress.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Rheology {
    /// Elastic: no loss.
    #[default]
    Elastic,
    /// Dashpot parallel to the spring, `1 + iντ`: the only law that equations of motion can contain.
    KelvinVoigt {
        /// Time `τ` (s).
        time: f64,
    },
    /// Constant loss at every frequency, `1 + i/Q`.
    QualityFactor {
        /// Quality factor `Q`, at least 1.
        factor: f64,
    },
    /// Dashpot in series with the spring, `iντ/(1 + iντ)`: the modulus is that of fast strain, and slow strain flows.
    Maxwell {
        /// Time `τ` (s), viscosity over modulus.
        time: f64,
    },
    /// Spring parallel to a Maxwell element, `1 + Δ iντ/(1 + iντ)`: the modulus is that of slow strain.
    StandardLinear {
        /// Time `τ` (s) of the Maxwell element.
        time: f64,
        /// Relaxation strength `Δ`: relative excess of the modulus of fast strain over that of slow strain.
        strength: f64,
    },
    /// Transient creep in series with a Maxwell element, `1/[1 + Γ(1+α)(iντ_A)^{−α} − i/ντ]` `[@andrade1910]`.
    Andrade {
        /// Time `τ` (s) of the Maxwell element, viscosity over modulus.
        time: f64,
        /// Time `τ_A` (s) of the creep.
        creep_time: f64,
        /// Exponent `α`, between 0 and 1.
        exponent: f64,
    },
    /// Measured values.
    Table(Measured),
}

/// Measured modulus and loss, interpolated linearly in the logarithms between rows, constant beyond them.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Vec<[f64; 3]>", into = "Vec<[f64; 3]>"))]
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    rows: Vec<[f64; 3]>,
}

/// Error of a law that no material has.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum RheologyError {
    /// A time, a factor or a strength is not a positive number.
    #[error("{value} is not a positive number")]
    NotPositive {
        /// Number given.
        value: f64,
    },
    /// A quality factor below 1: more is lost in a radian than the material stores.
    #[error("a quality factor is at least 1, not {value}")]
    Quality {
        /// Number given.
        value: f64,
    },
    /// The exponent is outside of 0 to 1.
    #[error("an exponent lies between 0 and 1, not at {value}")]
    Exponent {
        /// Number given.
        value: f64,
    },
    /// The table has no rows.
    #[error("a table needs at least one row of frequency, modulus and loss")]
    NoRows,
    /// The frequencies do not ascend.
    #[error("frequencies must ascend, but {next} rad/s follows {previous} rad/s")]
    NotAscending {
        /// Frequency (rad/s).
        previous: f64,
        /// Next frequency (rad/s).
        next: f64,
    },
}

impl Rheology {
    /// Refuses a law that no material has.
    ///
    /// # Errors
    /// [`RheologyError`] for a parameter out of range.
    pub fn check(&self) -> Result<(), RheologyError> {
        let positive = |value: f64| {
            if value > 0.0 && value.is_finite() { Ok(()) } else { Err(RheologyError::NotPositive { value }) }
        };
        match *self {
            Self::Elastic | Self::Table(_) => Ok(()),
            Self::KelvinVoigt { time } | Self::Maxwell { time } => positive(time),
            Self::QualityFactor { factor } if factor > 0.0 && factor < 1.0 => {
                Err(RheologyError::Quality { value: factor })
            }
            Self::QualityFactor { factor } => positive(factor),
            Self::StandardLinear { time, strength } => positive(time).and(positive(strength)),
            Self::Andrade { time, creep_time, exponent } => {
                positive(time).and(positive(creep_time))?;
                let inside = exponent > 0.0 && exponent < 1.0;
                if inside { Ok(()) } else { Err(RheologyError::Exponent { value: exponent }) }
            }
        }
    }

    /// Complex modulus at a frequency `ν > 0` (rad/s), relative to the modulus of the material: real and imaginary part.
    #[must_use]
    pub fn modulus(&self, frequency: f64) -> [f64; 2] {
        match self {
            Self::Elastic => [1.0, 0.0],
            Self::KelvinVoigt { time } => [1.0, frequency * time],
            Self::QualityFactor { factor } => [1.0, factor.recip()],
            Self::Maxwell { time } => maxwell(frequency * time),
            Self::StandardLinear { time, strength } => {
                let [fast, lost] = maxwell(frequency * time);
                [1.0 + strength * fast, strength * lost]
            }
            Self::Andrade { time, creep_time, exponent } => {
                let creep = libm::tgamma(1.0 + exponent) * (frequency * creep_time).powf(-exponent);
                let (sine, cosine) = (exponent * FRAC_PI_2).sin_cos();
                let compliance = [1.0 + creep * cosine, -creep * sine - 1.0 / (frequency * time)];
                let square = compliance[0].powi(2) + compliance[1].powi(2);
                [compliance[0] / square, -compliance[1] / square]
            }
            Self::Table(measured) => measured.at(frequency),
        }
    }

    /// Complex modulus at a complex frequency `s` (1/s), real and imaginary part: analytic continuation of the law from the imaginary
    /// axis, where the value is [`modulus`](Self::modulus). A quality factor and a table are taken at the imaginary part of `s`.
    #[must_use]
    pub fn continued(&self, [re, im]: [f64; 2]) -> [f64; 2] {
        let s = Complex::new(re, im);
        let one = Complex::from(1.0);
        let relaxed = |time: f64| s * time / (one + s * time);
        let value = match self {
            Self::Elastic => one,
            Self::KelvinVoigt { time } => one + s * *time,
            Self::Maxwell { time } => relaxed(*time),
            Self::StandardLinear { time, strength } => one + relaxed(*time) * *strength,
            Self::Andrade { time, creep_time, exponent } => {
                let creep = (s * *creep_time).powf(-exponent) * libm::tgamma(1.0 + exponent);
                (one + creep + (s * *time).inv()).inv()
            }
            Self::QualityFactor { .. } | Self::Table(_) if im == 0.0 => one,
            Self::QualityFactor { .. } | Self::Table(_) => {
                let [real, lost] = self.modulus(im.abs());
                Complex::new(real, lost.copysign(im))
            }
        };
        [value.re, value.im]
    }

    /// Time `τ` (s) of the dashpot in series by which a constant stress strains the material without end; none of a law that holds it.
    #[must_use]
    pub fn viscous_time(&self) -> Option<f64> {
        match *self {
            Self::Maxwell { time } | Self::Andrade { time, .. } => Some(time),
            Self::Elastic
            | Self::KelvinVoigt { .. }
            | Self::QualityFactor { .. }
            | Self::StandardLinear { .. }
            | Self::Table(_) => None,
        }
    }

    /// Whether the modulus given is that at rest, with springs and dashpots alone beside it, which take energy from faster strain and store none
    /// below zero.
    #[must_use]
    pub fn given_at_rest(&self) -> bool {
        matches!(self, Self::Elastic | Self::KelvinVoigt { .. } | Self::StandardLinear { .. })
    }

    /// First and last frequency (rad/s) of a measured law; none for a formula.
    #[must_use]
    pub fn measured_between(&self) -> Option<[f64; 2]> {
        match self {
            Self::Table(Measured { rows }) => Some([rows[0][0], rows[rows.len() - 1][0]]),
            _ => None,
        }
    }
}

/// `ix/(1 + ix)`.
fn maxwell(x: f64) -> [f64; 2] {
    let lost = x / (1.0 + x * x);
    [x * lost, lost]
}

impl TryFrom<Vec<[f64; 3]>> for Measured {
    type Error = RheologyError;

    fn try_from(rows: Vec<[f64; 3]>) -> Result<Self, RheologyError> {
        Self::new(rows)
    }
}

impl From<Measured> for Vec<[f64; 3]> {
    fn from(measured: Measured) -> Self {
        measured.rows
    }
}

impl Measured {
    /// Law from rows of frequency (rad/s, ascending), modulus relative to that of the material, and loss: the tangent of the loss angle,
    /// `1/Q`.
    ///
    /// # Errors
    /// [`RheologyError`] for no rows, for a number that is not positive, and for frequencies that do not ascend.
    pub fn new(rows: Vec<[f64; 3]>) -> Result<Self, RheologyError> {
        if rows.is_empty() {
            return Err(RheologyError::NoRows);
        }
        if let Some(&value) = rows.as_flattened().iter().find(|value| !(**value > 0.0 && value.is_finite())) {
            return Err(RheologyError::NotPositive { value });
        }
        if let Some([previous, next]) = rows.array_windows().find(|[a, b]| a[0] >= b[0]) {
            return Err(RheologyError::NotAscending { previous: previous[0], next: next[0] });
        }
        Ok(Self { rows })
    }

    fn at(&self, frequency: f64) -> [f64; 2] {
        let above = self.rows.partition_point(|row| row[0] <= frequency);
        let (low, high) = (&self.rows[above.saturating_sub(1)], &self.rows[above.min(self.rows.len() - 1)]);
        let share = if low[0] < high[0] { (frequency / low[0]).ln() / (high[0] / low[0]).ln() } else { 0.0 };
        let share = share.max(0.0);
        let [modulus, loss] = [1, 2].map(|i| low[i] * (high[i] / low[i]).powf(share));
        [modulus, modulus * loss]
    }
}
