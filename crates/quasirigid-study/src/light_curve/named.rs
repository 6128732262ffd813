//! Laws of scattering and phase functions by name, with their numbers behind a colon.

use quasirigid_photometry::{Hapke, Phase, Scattering};

/// The law of scattering that a text names: `lommel-seeliger`, `lambert`, `mixed:C` or `hapke:W,G,B0,H,DEGREES`.
///
/// # Errors
/// What to give instead.
pub fn scattering(text: &str) -> Result<Scattering, String> {
    let (name, rest) = text.split_once(':').unwrap_or((text, ""));
    let found = match name {
        "lommel-seeliger" if rest.is_empty() => Some(Scattering::LommelSeeliger),
        "lambert" if rest.is_empty() => Some(Scattering::Lambert),
        "mixed" => numbers(rest).map(|[lambert]| Scattering::Mixed { lambert }),
        "hapke" => numbers(rest).map(|[w, g, surge, h, degrees]| {
            Scattering::Hapke(Hapke { w, g, B0: surge, h, roughness: degrees.to_radians() })
        }),
        _ => None,
    };
    found.ok_or_else(|| "give lommel-seeliger, lambert, mixed:0.1 or hapke:0.23,-0.27,1.6,0.08,20".to_owned())
}

/// The phase function that a text names: `flat`, `hg:G` or `surge:A,D,K`.
///
/// # Errors
/// What to give instead.
pub fn phase(text: &str) -> Result<Phase, String> {
    let (name, rest) = text.split_once(':').unwrap_or((text, ""));
    let found = match name {
        "flat" if rest.is_empty() => Some(Phase::Flat),
        "hg" => numbers(rest).map(|[slope]| Phase::HG { G: slope }),
        "surge" => numbers(rest).map(|[amplitude, width, slope]| Phase::ExponentialLinear {
            amplitude,
            width,
            slope,
        }),
        _ => None,
    };
    found.ok_or_else(|| "give flat, hg:0.15 or surge:0.5,0.1,-0.5".to_owned())
}

/// Reads so many numbers.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let found: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    <[f64; N]>::try_from(found?).ok()
}
