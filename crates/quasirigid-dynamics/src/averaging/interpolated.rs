//! Chebyshev interpolation of a mean power over `ξ`: a costly source is asked at few places.
//! The power is divided by `⟨|ω̇|²⟩` first, since the ratio is smooth up to the axis and the separatrix; pieces are fitted on demand and
//! halved at resonances.
//! Equations (A6), docs/theory/10-torque-free.md, and (Q4), docs/theory/16-methods.md.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::{FreeRotation, MeanPower, constant_beyond};
use crate::math::chebyshev::Chebyshev;
use crate::model::Mode;

/// Mean power interpolated over `ξ`, for a source that is costly at each place: `ln(P/⟨|ω̇|²⟩)` by Chebyshev's polynomials on pieces of
/// `ξ`, fitted on demand. (A6)
///
/// A resonance narrower than the distance of the nodes may be missed; the relative error of a time is then at most the width of the
/// resonance.
#[derive(Debug)]
pub struct InterpolatedPower {
    source: Arc<dyn MeanPower>,
    angular_momentum: f64,
    pieces: Mutex<BTreeMap<Key, Piece>>,
}

/// Key of a piece: short-axis mode or not, number of halvings, index of the piece.
type Key = (bool, u32, i64);

#[derive(Debug)]
enum Piece {
    Fit(Box<Chebyshev<1>>),
    Halved,
    /// Piece without a fit: the source is asked at each place.
    Rough,
}

/// Length of a piece that was not halved, as `ξ`.
const WIDTH: f64 = 2.0;
/// Halvings allowed.
const DEEPEST: u32 = 6;
/// Share of the last polynomials below which a piece fits.
const FITS: f64 = 1e-5;
/// Place next to the separatrix, as `ξ`, beyond which the ratio is taken as constant, between moments of like differences: a share `e^ξ` of
/// the energies lies there.
const NEAREST_SEPARATRIX: f64 = -8.0;

impl InterpolatedPower {
    /// Interpolates a power at an angular momentum (N·m·s).
    #[must_use]
    pub fn new(source: impl MeanPower + 'static, angular_momentum: f64) -> Self {
        Self { source: Arc::new(source), angular_momentum, pieces: Mutex::new(BTreeMap::new()) }
    }

    /// Logarithm of the ratio at a place; none where no polynomial fits.
    fn ratio(&self, mode: Mode, xi: f64) -> Option<f64> {
        let mut pieces = self.pieces.lock().unwrap_or_else(PoisonError::into_inner);
        for depth in 0..=DEEPEST {
            let width = WIDTH / f64::from(1 << depth);
            let index = (xi / width).floor();
            let key = (mode == Mode::ShortAxis, depth, index as i64);
            let ends = [index * width, (index + 1.0) * width];
            match pieces.entry(key).or_insert_with(|| self.piece(mode, depth, ends)) {
                Piece::Fit(fit) => return Some(fit.at(xi)[0]),
                Piece::Halved => {}
                Piece::Rough => return None,
            }
        }
        None
    }

    fn piece(&self, mode: Mode, depth: u32, ends: [f64; 2]) -> Piece {
        let fit = Chebyshev::fit(ends, |xi| {
            let motion = FreeRotation::at_logit(self.moments(), self.angular_momentum, mode, xi);
            let ratio = (self.source.mean_power(&motion) / motion.mean_square_acceleration()).ln();
            ratio.is_finite().then_some([ratio])
        });
        match fit {
            Some(fit) if fit.tail() < FITS => Piece::Fit(Box::new(fit)),
            _ if depth < DEEPEST => Piece::Halved,
            _ => Piece::Rough,
        }
    }
}

impl MeanPower for InterpolatedPower {
    fn moments(&self) -> [f64; 3] {
        self.source.moments()
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        let here = (motion.angular_momentum() / self.angular_momentum - 1.0).abs() < 1e-12;
        let xi = motion.logit();
        let nearest = constant_beyond(self.moments(), motion.mode(), NEAREST_SEPARATRIX);
        let ratio = if here && xi.is_finite() { self.ratio(motion.mode(), xi.max(nearest)) } else { None };
        match ratio {
            Some(ratio) => ratio.exp() * motion.mean_square_acceleration(),
            None => self.source.mean_power(motion),
        }
    }

    fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
        self.source.budget(motion)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;
    use crate::averaging::{Evolution, Response, RotationState};
    use crate::problems::ring_of_points;

    #[derive(Debug)]
    struct Counted(Response, Arc<AtomicUsize>);

    impl MeanPower for Counted {
        fn moments(&self) -> [f64; 3] {
            self.0.moments()
        }

        fn mean_power(&self, motion: &FreeRotation) -> f64 {
            self.1.fetch_add(1, Ordering::Relaxed);
            self.0.mean_power(motion)
        }
    }

    /// Times and powers equal those of the source, with a fraction of the calls; at another angular momentum they are computed by the
    /// source itself.
    #[test]
    fn times_are_those_of_the_source() {
        let response = Response::compute(&ring_of_points(4).body().unwrap()).unwrap();
        let asked = Arc::new(AtomicUsize::new(0));
        let angular_momentum = 0.5 * response.moments()[2];
        let source = Counted(response.clone(), Arc::clone(&asked));
        let interpolated = InterpolatedPower::new(source, angular_momentum);
        let [slow, fast] =
            [&response as &dyn MeanPower, &interpolated].map(|power| Evolution::new(power, angular_momentum));
        let rotation_states = [3.0, -6.0].map(|xi| RotationState { mode: Mode::LongAxis, xi });
        let end = RotationState { mode: Mode::ShortAxis, xi: 5.0 };
        for from in rotation_states {
            let [expected, found] = [&slow, &fast].map(|evolution| evolution.time(from, end));
            assert!((found / expected - 1.0).abs() < 1e-5, "{found:e} {expected:e}");
        }
        let once = asked.load(Ordering::Relaxed);
        let rows = (0..200)
            .map(|i| fast.time(rotation_states[0], RotationState { xi: -4.0 + 0.045 * f64::from(i), ..end }));
        assert!(rows.sum::<f64>() > 0.0);
        assert!(asked.load(Ordering::Relaxed) - once < 30, "{asked:?} {once}");
        let other = FreeRotation::at_logit(response.moments(), 1.1 * angular_momentum, Mode::ShortAxis, 0.3);
        assert_eq!(interpolated.mean_power(&other), response.mean_power(&other));
        assert!(interpolated.budget(&other).is_empty(), "the source names no dissipators");
        let named = InterpolatedPower::new(response.clone(), angular_momentum).budget(&other);
        let whole: f64 = named.iter().map(|(_, power)| power).sum();
        assert!((whole / response.mean_power(&other) - 1.0).abs() < 1e-12, "{named:?}");
    }

    /// Power with a resonance of a width and a height at a place `ξ`.
    #[derive(Debug)]
    struct Peaked {
        width: f64,
        height: f64,
        place: f64,
    }

    impl MeanPower for Peaked {
        fn moments(&self) -> [f64; 3] {
            [1.0, 1.7, 2.0]
        }

        fn mean_power(&self, motion: &FreeRotation) -> f64 {
            let off = (motion.logit() - self.place) / self.width;
            1e-6 * motion.mean_square_acceleration() * (1.0 + self.height / (1.0 + off * off))
        }
    }

    /// Times over a resonance, wide or narrow, high or low, at several places, against sums over cells.
    #[test]
    fn times_over_a_resonance() {
        let rotation_state = |xi: f64| RotationState { mode: Mode::ShortAxis, xi };
        let (cells, ends) = (10_000, [-2.0, 3.0]);
        let at = |i: f64| ends[0] + (ends[1] - ends[0]) * i / f64::from(cells);
        let smooth = Peaked { width: 1.0, height: 0.0, place: 0.0 };
        let smooth = Evolution::new(&smooth, 2.0);
        let plain: Vec<f64> = (0..cells)
            .map(|i| smooth.time(rotation_state(at(f64::from(i))), rotation_state(at(f64::from(i + 1)))))
            .collect();
        for width in [2e-3, 0.01, 0.03, 0.1, 0.3] {
            for height in [1.0, 10.0, 100.0, 1e4] {
                for place in [-1.31, 0.217, 0.5, 1.04, 1.993] {
                    let slower = |i: usize| {
                        let off = (at(i as f64 + 0.5) - place) / width;
                        1.0 / (1.0 + height / (1.0 + off * off))
                    };
                    let expected: f64 = plain.iter().enumerate().map(|(i, time)| time * slower(i)).sum();
                    let power = InterpolatedPower::new(Peaked { width, height, place }, 2.0);
                    let found =
                        Evolution::new(&power, 2.0).time(rotation_state(ends[0]), rotation_state(ends[1]));
                    let allowed = if width < 0.01 { width } else { 1e-5 };
                    assert!((found / expected - 1.0).abs() < allowed, "{width} {height} {place}");
                }
            }
        }
    }
}
