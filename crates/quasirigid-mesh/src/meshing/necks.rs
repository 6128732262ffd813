//! Necks: narrow places of a body between thicker parts.

use super::MeshingError;
use crate::surface::{ClosedSurface, Proximity};
use quasirigid_math::vec3::{add, norm, scale};
use quasirigid_math::watch;

/// Neck: a place where a body is narrower than on both sides, a saddle of the distance to its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neck {
    /// Place of the neck.
    pub center: [f64; 3],
    /// Radius of the largest ball in the body about that place.
    pub radius: f64,
}

/// Cells of the grid along the longest side of the box around a body, and of that around a neck.
const CELLS: [usize; 2] = [32, 24];
/// Distances after which the work looks whether it is cancelled.
const ASKED: usize = 1_000;
/// Least ratio of the smaller of the largest balls on both sides to the ball of the neck.
const NECK_RATIO: f64 = 1.15;
/// Least ratio of that ball to the largest one in the body: a smaller part beyond a neck does not count.
const LOBE: f64 = 0.2;

/// Most necks that are found again on a finer grid, the narrowest: with it a body costs at most 33³ + 64 · 25³ ≈ 10⁶ distances to its surface,
/// however many holes it has, and each of those about the logarithm of the number of its triangles.
const REFINED: usize = 64;

/// Necks of a body, the narrowest first, found on a grid and then on a finer one around each; of a body with more than 64 the wider ones are
/// as on the first grid, which makes them narrower by up to a cell of it.
///
/// # Errors
/// [`MeshingError::Severed`] if a neck is thinner than the grid: about a thirtieth of the body's length.
pub fn necks(surface: &ClosedSurface) -> Result<Vec<Neck>, MeshingError> {
    let [low, high] = surface.bounds();
    let proximity = Proximity::new(surface, |at| at);
    watch::stage("looking for necks");
    let whole = Grid::new(low, high, CELLS[0]).depths(&proximity);
    let deepest = whole.depths.iter().copied().fold(0.0, f64::max);
    let (saddles, parts) = whole.saddles(LOBE * deepest);
    if parts > 1 {
        return Err(MeshingError::Severed { parts, bodies: 1, resolution: 2 * CELLS[0] });
    }
    let mut found = saddles;
    let narrowest_first = |a: &Neck, b: &Neck| a.radius.total_cmp(&b.radius);
    found.sort_by(narrowest_first);
    let refined = found.len().min(REFINED);
    for (number, neck) in found[..refined].iter_mut().enumerate() {
        watch::progress(number as f64 / refined as f64);
        *neck = whole.nearer(*neck, &proximity);
    }
    found.sort_by(narrowest_first);
    Ok(found)
}

/// Points at the middles of equal cubes.
struct Grid {
    low: [f64; 3],
    side: f64,
    counts: [usize; 3],
    /// Distance of each point to the surface, negative from outside.
    depths: Vec<f64>,
}

impl Grid {
    fn new(low: [f64; 3], high: [f64; 3], cells: usize) -> Self {
        let sides: [f64; 3] = std::array::from_fn(|axis| high[axis] - low[axis]);
        let side = sides.into_iter().fold(0.0, f64::max) / cells as f64;
        // An odd number, so that a point is on the middle of a straight body.
        let counts = sides.map(|length| (length / side).ceil() as usize | 1);
        let low = std::array::from_fn(|axis| {
            low[axis] + 0.5 * sides[axis] - 0.5 * (counts[axis] as f64 - 1.0) * side
        });
        Self { low, side, counts, depths: Vec::new() }
    }

    fn depths(mut self, proximity: &Proximity) -> Self {
        let size = self.counts.into_iter().product();
        let depth = |index: usize| {
            if index.is_multiple_of(ASKED) {
                watch::ask();
            }
            -proximity.nearest(self.place(index)).distance
        };
        self.depths = (0..size).map(depth).collect();
        self
    }

    fn place(&self, index: usize) -> [f64; 3] {
        let [across, deep, _] = self.counts;
        let steps = [index % across, index / across % deep, index / across / deep];
        std::array::from_fn(|axis| self.low[axis] + self.side * steps[axis] as f64)
    }

    /// Neighbours along edges and diagonals.
    fn neighbours(&self, index: usize) -> impl Iterator<Item = usize> + '_ {
        let [across, deep, high] = self.counts;
        let steps = [index % across, index / across % deep, index / across / deep];
        (0..27).filter(|k| *k != 13).filter_map(move |k: usize| {
            let shift = [k % 3, k / 3 % 3, k / 9];
            let moved: [usize; 3] = std::array::from_fn(|axis| (steps[axis] + shift[axis]).wrapping_sub(1));
            let within = moved[0] < across && moved[1] < deep && moved[2] < high;
            within.then(|| (moved[2] * deep + moved[1]) * across + moved[0])
        })
    }

    /// Saddles, at which parts that are deep enough merge as the depth falls, and the number of parts that never do.
    fn saddles(&self, least: f64) -> (Vec<Neck>, usize) {
        let mut order: Vec<usize> =
            (0..self.depths.len()).filter(|index| self.depths[*index] > 0.0).collect();
        order.sort_by(|a, b| self.depths[*b].total_cmp(&self.depths[*a]));
        let mut parent = vec![usize::MAX; self.depths.len()];
        let mut found = Vec::new();
        for index in &order {
            parent[*index] = *index;
            for other in self.neighbours(*index) {
                if parent[other] == usize::MAX {
                    continue;
                }
                let [a, b] = [root(&mut parent, *index), root(&mut parent, other)];
                if a == b {
                    continue;
                }
                // The root of a part is its deepest point.
                let [upper, lower] = if self.depths[a] >= self.depths[b] { [a, b] } else { [b, a] };
                let (lobe, saddle) = (self.depths[lower], self.depths[*index]);
                if lobe >= least && lobe >= NECK_RATIO * saddle && lower != *index {
                    found.push(Neck { center: self.place(*index), radius: saddle });
                }
                parent[lower] = upper;
            }
        }
        let tops = order.iter().filter(|index| parent[**index] == **index && self.depths[**index] >= least);
        (found, tops.count())
    }

    /// Neck refined on a finer grid around it.
    fn nearer(&self, neck: Neck, proximity: &Proximity) -> Neck {
        let half = 1.5 * neck.radius + 2.0 * self.side;
        let corner = |sign: f64| neck.center.map(|x| x + sign * half);
        let fine = Grid::new(corner(-1.0), corner(1.0), CELLS[1]).depths(proximity);
        let deeper = fine.saddles(0.0).0.into_iter().filter(|found| found.radius >= neck.radius);
        let away = |found: &Neck| norm(add(found.center, scale(-1.0, neck.center)));
        deeper.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(neck)
    }
}

fn root(parent: &mut [usize], mut index: usize) -> usize {
    while parent[index] != index {
        parent[index] = parent[parent[index]];
        index = parent[index];
    }
    index
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    use super::*;
    use crate::surface::testing::{ball, sponge, turned};

    /// A ball drawn in around a plane, to a share of its width.
    fn waisted(unit: f64, neck: f64) -> ClosedSurface {
        ball(24, |[x, y, z]| {
            let share = neck + (1.0 - neck) * (2.0 * x * x).min(1.0);
            turned(unit)([2.0 * x, share * y, share * z])
        })
    }

    #[test]
    fn a_waist_is_found_with_its_radius_in_any_unit() {
        for unit in [1e-4, 1.0, 1e4] {
            let found = necks(&waisted(unit, 0.3)).unwrap();
            assert_eq!(found.len(), 1, "{found:?}");
            let off = norm(add(found[0].center, scale(-1.0, turned(unit)([0.0; 3])))) / unit;
            // Cells are even within one and a half radii of it: two thirds of a radius off is near enough.
            assert!((found[0].radius / unit - 0.3).abs() < 0.03 && off < 0.2, "{found:?} {off}");
        }
    }

    #[test]
    fn a_ball_has_no_neck_and_a_thread_is_refused() {
        assert_eq!(necks(&ball(24, turned(1.0))), Ok(Vec::new()));
        assert!(matches!(necks(&waisted(1.0, 0.005)), Err(MeshingError::Severed { .. })));
    }

    /// Volume and inertia of a sponge of twenty of its own, to the digits; the search for its necks is bounded, and asks whether someone waits.
    #[test]
    fn a_sponge_has_its_inertia_and_the_search_for_its_necks_is_interrupted() {
        for (level, unit) in [(1, 1e-4), (2, 1e4), (3, 1.0)] {
            let surface = sponge(level, |at| at.map(|x| unit * (x + 0.3)));
            let cubes = 20_f64.powi(level as i32);
            assert!((surface.volume() / (cubes * unit.powi(3)) - 1.0).abs() < 1e-12);
            // ∫ (x − c)² of one sponge: that of twenty thirds of its size and of their centres, four of which are in its middle plane.
            let mut second = 1.0 / 12.0;
            for step in 0..level {
                let (count, side) = (20_f64.powi(step as i32), 3_f64.powi(step as i32));
                second = 20.0 * second + 16.0 * count * side * side;
            }
            let moments = surface.moments(2, surface.centroid(), [unit; 3]);
            for exponents in [[2, 0, 0], [0, 2, 0], [0, 0, 2]] {
                assert!(
                    (moments.of(exponents) / second - 1.0).abs() < 1e-11,
                    "{level}: {}",
                    moments.of(exponents)
                );
            }
        }
        let surface = sponge(3, turned(1.0));
        // distances to the surface: those of the first grid, and of finer ones around 64 necks at most
        let [low, high] = surface.bounds();
        let points = |grid: Grid| grid.counts.into_iter().product::<usize>();
        let [whole, fine] =
            [Grid::new(low, high, CELLS[0]), Grid::new([0.0; 3], [1.0; 3], CELLS[1])].map(points);
        assert!(whole + REFINED * fine < 1_100_000, "{whole} {fine}");
        let proximity = Proximity::new(&surface, |at| at);
        let cancelled = Arc::new(AtomicBool::new(true));
        let search = || Grid::new(low, high, CELLS[0]).depths(&proximity).depths.len();
        assert!(watch::cancellable(&cancelled, search).is_err() && whole > 10 * ASKED);
    }
}
