//! Projection of a large body on its slow vibrations, for frequencies, decay rates and damping times.
//! Three Krylov spaces are joined, with the attitude fixed, with the body free to recoil and for the dashpots, because the slowest vectors
//! of each decide another criterion.
//! Equations (V2), (V3) and (V5), docs/theory/04-validity.md.

use crate::math::eigen::{Dense, Eigenmodes, NoConvergence};
use crate::math::krylov::Pencil;
use crate::math::span::{Span, largest};
use crate::model::FlexibleBody;

/// Mass, damping and stiffness of the elastic coordinates as dense matrices: those of the body itself, or of a body of many
/// coordinates on the space of its slowest vibrations and its slowest dashpots.
pub(super) struct Projection {
    /// Mass with the attitude fixed. (V2)
    pub A: Dense,
    /// Mass with the body free to recoil in rotation, `A − h J⁻¹ hᵀ`. (V2)
    pub recoiling: Dense,
    pub B: Dense,
    pub C: Dense,
    /// Number of the slowest vibrations that are converged.
    pub trusted: usize,
    /// Vectors that span the space; none for the whole space.
    span: Option<Span>,
}

/// Number of coordinates up to which the whole matrices are used.
const WHOLE: usize = 600;
/// Number of vibrations found for a body of more coordinates.
const MAX_VIBRATIONS: usize = 12;

impl Projection {
    pub fn compute(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        let size = body.elastic();
        if size <= WHOLE { Ok(Self::whole(body)) } else { Self::slow(body, MAX_VIBRATIONS) }
    }

    fn whole(body: &FlexibleBody) -> Self {
        let elastic = 0..body.elastic();
        Self {
            A: body.mass_matrix().block(elastic.clone()),
            recoiling: body.recoiling_mass_matrix().block(elastic.clone()),
            B: Dense::of(&body.damping().block(elastic.clone())),
            C: Dense::of(&body.stiffness().block(elastic.clone())),
            trusted: elastic.len(),
            span: None,
        }
    }

    fn slow(body: &FlexibleBody, count: usize) -> Result<Self, NoConvergence> {
        let size = body.elastic();
        let mass = |x: &[f64]| held(body, x, |x| body.mass_times(x));
        let free = |x: &[f64]| held(body, x, |x| body.recoiling_mass_times(x));
        let damping = |x: &[f64]| held(body, x, |x| body.damping().times(x));
        let stiffness = |x: &[f64]| held(body, x, |x| body.stiffness().times(x));
        let solve = |x: &mut [f64]| body.solve_stiffness(x, 1);
        let softest = |mass: &dyn Fn(&[f64]) -> Vec<f64>, count: usize| {
            Pencil { size, stiffness: &stiffness, solve: &solve, mass }.largest(count)
        };
        let mut span = softest(&mass, count)?;
        span.extend(softest(&free, count)?);
        if body.damping().iter().any(|(row, _, entry)| row < size && *entry != 0.0) {
            span.extend(softest(&damping, 1)?);
        }
        let span = Span::orthonormal(span, stiffness);
        Ok(Self {
            A: span.projected(mass),
            recoiling: span.projected(free),
            B: span.projected(damping),
            C: span.projected(stiffness),
            trusted: count,
            span: Some(span),
        })
    }

    /// Coordinate with the largest share in the slowest mode.
    pub fn largest_share(&self, modes: &Eigenmodes) -> Option<usize> {
        let slowest: Vec<f64> = (0..modes.shapes.size()).map(|row| modes.shapes.at(row, 0)).collect();
        largest(&self.span.as_ref().map_or(slowest.clone(), |span| span.combined(&slowest)))
    }
}

/// Product on the elastic coordinates, the cyclic ones fixed.
fn held(body: &FlexibleBody, x: &[f64], times: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut all = x.to_vec();
    all.resize(body.coordinates().len(), 0.0);
    let mut product = times(&all);
    product.truncate(body.elastic());
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::eigen::modes;
    use crate::problems::ring_of_points;

    #[test]
    fn slow_vibrations_of_the_projection_are_those_of_the_whole() {
        let body = ring_of_points(60).body().unwrap();
        let (whole, slow) = (Projection::whole(&body), Projection::slow(&body, 12).unwrap());
        for (all, few) in [(&whole.A, &slow.A), (&whole.recoiling, &slow.recoiling)] {
            let (all, few) = (modes(all, &whole.C).unwrap(), modes(few, &slow.C).unwrap());
            for i in 0..12 {
                let error = (few.frequencies[i] / all.frequencies[i] - 1.0).abs();
                assert!(error < 1e-7, "{i}: {error:e}");
            }
        }
        let stiffest = |matrix: &Projection| modes(&matrix.B, &matrix.C).unwrap().frequencies[0];
        assert!((stiffest(&slow) / stiffest(&whole) - 1.0).abs() < 1e-7);
        let share = |matrix: &Projection| matrix.largest_share(&modes(&matrix.A, &matrix.C).unwrap());
        assert_eq!(share(&slow), share(&whole));
    }
}
