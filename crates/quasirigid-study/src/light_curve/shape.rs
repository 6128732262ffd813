//! Outer surface of a model, with facets as fine as a light curve needs.

use quasirigid_mesh::surface::ClosedSurface;
use quasirigid_photometry::{Facets, LawAt};
use rayon::prelude::*;

use super::refused;
use crate::error::StudyError;
use crate::study::Study;

/// Level of the facets of an ellipsoid.
const LEVEL: usize = 6;
/// Relative change of the brightness at which facets are fine enough.
const STILL: f64 = 1e-3;
/// Times at which facets are tried.
const PROBES: usize = 24;
/// Products of facets and times that the brightness may cost.
const MOST_WORK: usize = 60_000_000;

/// The outer surface.
pub enum Shape<'a> {
    Ellipsoid([f64; 3]),
    Surface(&'a ClosedSurface),
}

/// Law, and directions to Sun and observer in the axes of the body.
pub type Lit = (LawAt, [f64; 3], [f64; 3]);

impl<'a> Shape<'a> {
    pub fn of(study: &'a Study) -> Result<Self, StudyError> {
        let assembly = &study.model.assembly;
        match (&assembly.ellipsoids[..], &assembly.surfaces[..]) {
            ([ellipsoid], []) => Ok(Self::Ellipsoid(ellipsoid.semi_axes)),
            ([], [surface]) => Ok(Self::Surface(&surface.surface)),
            ([], []) => Err(refused(
                "the model has no outer surface to see: brightness is that of an [[ellipsoid]], or of a [[surface]] from a file; describe the body by one of them".to_owned(),
            )),
            _ => Err(refused("the model has several outer surfaces; keep one [[ellipsoid]] or one [[surface]]".to_owned())),
        }
    }

    pub fn kind(&self) -> &'static str {
        match self {
            Self::Ellipsoid(_) => "ellipsoid",
            Self::Surface(_) => "surface",
        }
    }

    /// Mean cross-section (m²) of a convex body of this surface.
    pub fn cross_section(&self) -> f64 {
        match self {
            Self::Ellipsoid(semi_axes) => Facets::of_ellipsoid(*semi_axes, LEVEL).mean_cross_section(),
            Self::Surface(surface) => Facets::of_surface(surface).mean_cross_section(),
        }
    }

    /// Facets, with their relative error: the change by a refinement, of an ellipsoid a third of it, as it falls by four. (O15)
    pub fn resolved(&self, lit: &[Lit]) -> (Facets, f64) {
        let step = lit.len().div_ceil(PROBES).max(1);
        let probes: Vec<&Lit> = lit.iter().step_by(step).collect();
        match self {
            Self::Ellipsoid(semi_axes) => {
                let [coarse, fine] = [LEVEL - 1, LEVEL].map(|level| Facets::of_ellipsoid(*semi_axes, level));
                let error = change(&seen(&coarse, &probes), &seen(&fine, &probes)) / 3.0;
                (fine, error)
            }
            Self::Surface(surface) => {
                let mut facets = Facets::of_surface(surface);
                if facets.is_convex() {
                    return (facets, 0.0);
                }
                facets = facets.refined(surface, 0);
                let mut known = seen(&facets, &probes);
                let mut error = f64::INFINITY;
                for level in 1.. {
                    let finer = facets.refined(surface, level);
                    let next = seen(&finer, &probes);
                    error = change(&known, &next);
                    if finer.count() * lit.len().max(PROBES) > MOST_WORK {
                        break; // the coarser facets stay, whose error this is
                    }
                    (facets, known) = (finer, next);
                    if error <= STILL {
                        break;
                    }
                }
                (facets, error)
            }
        }
    }
}

fn seen(facets: &Facets, probes: &[&Lit]) -> Vec<f64> {
    probes.par_iter().map(|(law, sun, observer)| facets.brightness(law, *sun, *observer)).collect()
}

/// Greatest change over the mean.
fn change(before: &[f64], after: &[f64]) -> f64 {
    let mean = after.iter().sum::<f64>() / after.len() as f64;
    let most = before.iter().zip(after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if mean > 0.0 { most / mean } else { f64::INFINITY }
}
