//! Motions of a spectrum, with those of the direction of spin that its rounding hides replaced by the ones that the second variation of
//! the energy gives. (M12), (M13)

use nalgebra::Complex;

use super::slow::SlowDirection;
use super::spectrum::{Eigenmotion, ZERO};
use crate::model::{FlexibleBody, SpinCoefficients};

/// Motion of a spectrum, and where its eigenvalue comes from.
pub(super) type Candidate = (Source, Eigenmotion);

/// Source of an eigenvalue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// Equations of motion.
    Spectrum,
    /// Second variation of the energy and the lag of the internal coordinates: a slow motion of the direction of spin.
    Direction,
    /// None: the direction of spin is neutral to rounding.
    Neutral,
}

/// Rounding of an eigenvalue over the fastest one.
const ROUNDED: f64 = 1e-15;
/// Relative error by rounding from which the second variation replaces an eigenvalue, and from which an eigenvalue is none.
const LOST: f64 = 1e-9;
const UNKNOWN: f64 = 1e-4;
/// Ratio of a motion of the direction to the internal motions and to the spin up to which it counts as slow.
pub(super) const SLOW_DIRECTION_RATIO: f64 = 1e-3;

/// Motions about a steady spin (rad/s) but for the zeros.
pub(super) fn candidates(
    found: Vec<Eigenmotion>,
    slow: Option<&SlowDirection>,
    (body, coefficients, spin): (&FlexibleBody, &SpinCoefficients, f64),
) -> Vec<Candidate> {
    let slots = slots(&found, slow.map_or(0, |slow| 2 - slow.neutral()));
    let replaced = slow.and_then(|slow| replacement(&found, slow, &slots, (body, coefficients, spin)));
    let taken = if replaced.is_some() { &slots[..] } else { &[] };
    let kept = |(i, motion): (usize, Eigenmotion)| {
        (!taken.contains(&i) && motion.lambda.norm() > ZERO * spin).then_some((Source::Spectrum, motion))
    };
    let others: Vec<Candidate> = found.into_iter().enumerate().filter_map(kept).collect();
    replaced.into_iter().flatten().chain(others).collect()
}

/// Motions of the direction in place of those at these indices of the spectrum; none where the spectrum has them as well.
fn replacement(
    found: &[Eigenmotion],
    slow: &SlowDirection,
    slots: &[usize],
    (body, coefficients, spin): (&FlexibleBody, &SpinCoefficients, f64),
) -> Option<Vec<Candidate>> {
    let sizes = |inside: bool| {
        let own = found.iter().enumerate().filter(move |(i, _)| slots.contains(i) != inside);
        own.map(|(_, motion)| motion.lambda.norm())
    };
    let fastest = sizes(true).chain(sizes(false)).fold(0.0, f64::max);
    let pair = slow.neutral() == 0;
    // a pair near the double zero of equal moments is known to a root of the rounding
    let error = |size: f64| ROUNDED * if pair { fastest * spin / (size * size) } else { fastest / size };
    let least = sizes(false).fold(f64::INFINITY, f64::min);
    let least = if pair { least.min(slow.frequency) } else { least };
    if slots.is_empty() || error(least) <= LOST {
        return None;
    }
    let Some(motions) = slow.motions(body, coefficients) else {
        return (error(least) > UNKNOWN).then(|| vec![neutral(found[0].q.len(), slow)]);
    };
    let size = motions.iter().fold(0.0_f64, |size, motion| size.max(motion.lambda.norm()));
    let internal = sizes(true).fold(f64::INFINITY, f64::min);
    if size >= SLOW_DIRECTION_RATIO * spin.min(internal) {
        return None;
    }
    let direction = |motion| (Source::Direction, motion);
    Some(if size > 0.0 {
        motions.into_iter().map(direction).collect()
    } else {
        vec![neutral(found[0].q.len(), slow)]
    })
}

/// Motion from a steady spin to those beside it, without a rate.
pub(super) fn neutral(coordinates: usize, slow: &SlowDirection) -> Candidate {
    let delta = slow.steady[slow.steady.len() - 1].map(Complex::from);
    let still = vec![Complex::from(0.0); coordinates];
    let rate = still.clone();
    let motion = Eigenmotion { lambda: Complex::from(0.0), delta, rate, q: still, angles: Vec::new() };
    (Source::Neutral, motion)
}

/// Indices of the motions with the smallest eigenvalues that stand for so many of them, a pair for two.
fn slots(found: &[Eigenmotion], count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..found.len()).collect();
    order.sort_by(|a, b| found[*a].lambda.norm().total_cmp(&found[*b].lambda.norm()));
    let mut left = count;
    order.retain(|i| {
        let taken = left > 0;
        left = left.saturating_sub(if found[*i].lambda.im > 0.0 { 2 } else { 1 });
        taken
    });
    order
}
