//! Hapke's law of scattering with five parameters `[@hapke1993]`.

use std::f64::consts::PI;

use crate::error::PhotometryError;

/// Roughness (rad) below which a surface is smooth: the correction is then less than rounding.
const SMOOTH: f64 = 1e-8;

/// Parameters of Hapke's law. (O12)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hapke {
    /// Single-scattering albedo.
    pub w: f64,
    /// Asymmetry of single scattering, negative of one that scatters back.
    pub g: f64,
    /// Height of the opposition surge.
    pub B0: f64,
    /// Width of the opposition surge.
    pub h: f64,
    /// Mean slope of the unresolved relief (rad).
    pub roughness: f64,
}

impl Hapke {
    /// Refuses parameters that no surface has.
    pub(crate) fn check(&self) -> Result<(), PhotometryError> {
        let most = PI / 3.0;
        for (name, value, known, range) in [
            ("w", self.w, self.w > 0.0 && self.w <= 1.0, "more than 0 and at most 1"),
            ("g", self.g, self.g.abs() < 1.0, "a number between -1 and 1"),
            ("B0", self.B0, self.B0 >= 0.0 && self.B0.is_finite(), "zero or a positive number"),
            ("h", self.h, self.h > 0.0 && self.h.is_finite(), "a positive number"),
            (
                "the roughness (rad)",
                self.roughness,
                (0.0..=most).contains(&self.roughness),
                "an angle from 0 to 60 degrees",
            ),
        ] {
            if !known {
                return Err(PhotometryError::Parameter { name, value, range });
            }
        }
        Ok(())
    }

    /// Light of a facet per area, `π r µ` with the bidirectional reflectance `r`, from the cosines of emission and incidence and the phase
    /// angle (rad). (O12)
    pub(crate) fn light(&self, emission: f64, incidence: f64, alpha: f64) -> f64 {
        let Tilted { emission: mu, incidence: mu0, shadow } = self.tilted(emission, incidence, alpha);
        let surge = self.B0 / (1.0 + (0.5 * alpha).tan() / self.h);
        let single = (1.0 - self.g * self.g) / (1.0 + 2.0 * self.g * alpha.cos() + self.g * self.g).powf(1.5);
        let chandrasekhar = |x: f64| (1.0 + 2.0 * x) / (1.0 + 2.0 * x * (1.0 - self.w).sqrt());
        let multiple = chandrasekhar(mu) * chandrasekhar(mu0) - 1.0;
        0.25 * self.w * emission * mu0 / (mu + mu0) * ((1.0 + surge) * single + multiple) * shadow
    }

    /// Effective cosines and the shadows of the relief. (O13)
    fn tilted(&self, emission: f64, incidence: f64, alpha: f64) -> Tilted {
        if self.roughness < SMOOTH {
            return Tilted { emission, incidence, shadow: 1.0 };
        }
        let tangent = self.roughness.tan();
        let chi = (1.0 + PI * tangent * tangent).sqrt().recip();
        let [e, i] = [emission, incidence].map(|cosine| Angle::of(cosine, tangent));
        let psi = azimuth(&e, &i, alpha);
        let (half, share) = ((0.5 * psi).sin().powi(2), psi / PI);
        // the flatter of the two directions has most of the relief before it
        let (low, high) = if i.cosine >= e.cosine { (&e, &i) } else { (&i, &e) };
        let below = 2.0 - low.E1 - share * high.E1;
        let of_low = chi * (low.cosine + low.sine * tangent * (low.E2 - half * high.E2) / below);
        let of_high =
            chi * (high.cosine + high.sine * tangent * (psi.cos() * low.E2 + half * high.E2) / below);
        let flat = |angle: &Angle| chi * (angle.cosine + angle.sine * tangent * angle.E2 / (2.0 - angle.E1));
        let f = (-2.0 * (0.5 * psi).tan()).exp();
        let [mu, mu0] = if i.cosine >= e.cosine { [of_low, of_high] } else { [of_high, of_low] };
        let ratio = high.cosine / flat(high);
        let shadow = mu / flat(&e) * i.cosine / flat(&i) * chi / (1.0 - f + f * chi * ratio);
        Tilted { emission: mu, incidence: mu0, shadow }
    }
}

/// Cosines as the relief tilts them, and the share of the surface that it leaves in light and in view.
struct Tilted {
    emission: f64,
    incidence: f64,
    shadow: f64,
}

/// Angle from the normal, and its functions of the roughness.
struct Angle {
    cosine: f64,
    sine: f64,
    E1: f64,
    E2: f64,
}

impl Angle {
    fn of(cosine: f64, tangent: f64) -> Self {
        let cosine = cosine.min(1.0);
        let sine = (1.0 - cosine * cosine).sqrt();
        let both = cosine / sine / tangent; // infinite along the normal, where both functions are zero
        Self { cosine, sine, E1: (-2.0 / PI * both).exp(), E2: (-both * both / PI).exp() }
    }
}

/// Angle (rad) between the planes of incidence and emission.
fn azimuth(e: &Angle, i: &Angle, alpha: f64) -> f64 {
    let sines = e.sine * i.sine;
    if sines == 0.0 {
        return 0.0;
    }
    ((alpha.cos() - e.cosine * i.cosine) / sines).clamp(-1.0, 1.0).acos()
}
