//! Gradient descent of the slow energy on the sphere `|K| = G`, to a minimum or up to a maximum.
//! Every level of a component is met once on such a path, which gives a start on each; shares count from the lower end, where a wobble may
//! be small beside the digits of a place.
//! Equations (N1) and (N5), docs/theory/17-levels.md.

use super::energy::SlowEnergy;
use crate::math::rotation::angle;
use crate::math::sphere::{StationaryKind, StationaryPoint};
use crate::math::vec3::{add, norm, scale, unit};

/// Path of falling slow energy to one of its minima, along which every level of a component is met once.
#[derive(Clone, Debug)]
pub(super) struct Descent {
    /// Unit vectors with falling energy, the minimum last.
    places: Vec<[f64; 3]>,
    /// `h` at each place (1/s).
    energies: Vec<f64>,
}

/// Longest and shortest step (rad), and the limit of the number of steps.
const STRIDE: f64 = 0.02;
const SHORTEST: f64 = 1e-12;
const MAX_STEPS: usize = 100_000;
/// Slope, as a share of the largest, that counts as zero; and that below which energies beside a family of minima differ by rounding alone.
const AT_REST: f64 = 1e-8;
const ROUNDED: f64 = 1e-6;
/// Angle (rad) from a minimum within which the straight path is tried, checked at `STRAIGHT_PATH_CHECKS` places.
const STRAIGHT_PATH_ANGLE: f64 = 0.1;
const STRAIGHT_PATH_CHECKS: usize = 24;
const HALVINGS: usize = 200;

impl Descent {
    /// Follows the negative gradient to a minimum, with its number if it is isolated; `downhill` is −1 to climb to a maximum instead.
    /// None if the path ends elsewhere.
    pub fn from(
        energy: &SlowEnergy,
        points: &[StationaryPoint],
        start: [f64; 3],
        downhill: f64,
    ) -> Option<(Self, Option<usize>)> {
        let wanted = if downhill > 0.0 { StationaryKind::Minimum } else { StationaryKind::Maximum };
        let mut way = Self { places: vec![start], energies: vec![energy.energy(start)] };
        let mut u = start;
        let mut stride = STRIDE;
        for _ in 0..MAX_STEPS {
            for (i, point) in points.iter().enumerate().filter(|(_, point)| point.kind == wanted) {
                if angle(u, point.place) < STRAIGHT_PATH_ANGLE && falls(energy, u, point.place, downhill) {
                    way.push(energy, point.place);
                    return Some((way, Some(i)));
                }
            }
            let slope = energy.slope(u);
            let steepness = norm(slope);
            let lost = stride < SHORTEST && steepness <= ROUNDED * energy.fastest;
            if lost || steepness <= AT_REST * energy.fastest {
                let saddle = |point: &StationaryPoint| angle(u, point.place) < STRAIGHT_PATH_ANGLE;
                return (!points.iter().any(saddle)).then_some((way, None));
            }
            let next = unit(add(u, scale(-downhill * stride / steepness, slope)));
            if downhill * (energy.energy(next) - energy.energy(u)) < 0.0 {
                way.push(energy, next);
                u = next;
                stride = (1.5 * stride).min(STRIDE);
            } else {
                if stride < SHORTEST {
                    return None;
                }
                stride *= 0.5;
            }
        }
        None
    }

    fn push(&mut self, energy: &SlowEnergy, u: [f64; 3]) {
        self.places.push(u);
        self.energies.push(energy.energy(u));
    }

    /// The minimum.
    pub fn end(&self) -> [f64; 3] {
        self.places[self.places.len() - 1]
    }

    /// Place on the path with this `h`, between those of its ends.
    pub fn at(&self, energy: &SlowEnergy, h: f64) -> [f64; 3] {
        let after = self.energies.partition_point(|energy| *energy > h).clamp(1, self.energies.len() - 1);
        let (from, to) = (self.places[after - 1], self.places[after]);
        // Shares count from the lower end, where a wobble may be small beside the digits of a place.
        let [mut low, mut high] = [0.0, 1.0];
        let on = |share: f64| unit(add(to, scale(share, add(from, scale(-1.0, to)))));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            if energy.energy(on(middle)) < h {
                low = middle;
            } else {
                high = middle;
            }
        }
        on(0.5 * (low + high))
    }
}

/// Tells whether the energy falls (or rises) all along the straight path to a place.
fn falls(energy: &SlowEnergy, from: [f64; 3], to: [f64; 3], downhill: f64) -> bool {
    let place = |i: usize| {
        let share = i as f64 / STRAIGHT_PATH_CHECKS as f64;
        unit(add(from, scale(share, add(to, scale(-1.0, from)))))
    };
    let heights: Vec<f64> = (0..=STRAIGHT_PATH_CHECKS).map(|i| downhill * energy.energy(place(i))).collect();
    heights.array_windows().all(|[before, after]| after < before)
}
