//! Corners merged within a distance.

use std::collections::HashMap;

use super::super::geometry::{bounds, is_flat, normalised};
use super::super::topology::sides;
use super::Draft;
use quasirigid_math::vec3::{minus, norm};

/// Distances within which corners are merged, as shares of the size, until the surface is closed: the same place, rounding of binary
/// numbers of 8 and of 4 bytes, of five digits of a text.
const STEPS: [f64; 6] = [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5];
/// Share of the size below which an edge of a facet without area has no length.
const NEEDLE: f64 = 1e-9;

impl Draft {
    /// Merges corners on open edges, and corners of facets without area, within the least of the distances that closes the surface.
    pub(super) fn weld(&mut self) {
        let size = self.size();
        for step in STEPS {
            if self.open_edges() == 0 && self.needles(size).is_empty() {
                return;
            }
            let near = self.loose(size);
            self.merge(near, step * size);
            self.drop_collapsed();
            self.drop_repeats();
        }
    }

    /// Merges facets back to back: those of parts that touch. Whether there were any.
    pub(super) fn join(&mut self) -> bool {
        let mut all: Vec<usize> = self.triangles.iter().flatten().copied().collect();
        all.sort_unstable();
        all.dedup();
        let before = self.repairs.walls;
        self.merge(all, NEEDLE * self.size());
        self.drop_collapsed();
        self.drop_repeats();
        self.repairs.walls > before
    }

    /// Larger of the diagonal of the box around the facets and their largest coordinate.
    fn size(&self) -> f64 {
        let [low, high] = bounds(self.triangles.iter().flatten().map(|corner| self.vertices[*corner]));
        let far = low.iter().chain(&high).fold(0.0, |far: f64, x| far.max(x.abs()));
        norm(minus(high, low)).max(far)
    }

    /// Facets without area that have an edge without length.
    fn needles(&self, size: f64) -> Vec<usize> {
        let corners = normalised(&self.vertices, &self.triangles);
        let short = |triangle: usize| {
            let [a, b, c] = self.triangles[triangle].map(|corner| self.vertices[corner]);
            [minus(a, b), minus(b, c), minus(c, a)].map(norm).into_iter().fold(f64::INFINITY, f64::min)
                <= NEEDLE * size
        };
        (0..corners.len()).filter(|triangle| is_flat(&corners[*triangle]) && short(*triangle)).collect()
    }

    /// Corners of open edges and of needles, ascending.
    fn loose(&self, size: f64) -> Vec<usize> {
        let mut loose: Vec<usize> = sides(&self.triangles)
            .chunk_by(|a, b| a.edge == b.edge)
            .filter(|group| group.len() == 1)
            .flat_map(|group| group[0].edge)
            .collect();
        loose.extend(self.needles(size).into_iter().flat_map(|triangle| self.triangles[triangle]));
        loose.sort_unstable();
        loose.dedup();
        loose
    }

    /// Merges each of these corners with the first of them within reach.
    fn merge(&mut self, among: Vec<usize>, reach: f64) {
        let (mut twins, mut merged) = (HashMap::new(), 0);
        let mut boxes: HashMap<[i64; 3], Vec<usize>> = HashMap::with_capacity(among.len());
        for corner in among {
            // Places at no distance differ in the sign of zero at most.
            let place = self.vertices[corner].map(|x| x + 0.0);
            let bucket = |away: f64, axis: usize| match reach {
                0.0 => place[axis].to_bits() as i64,
                _ => ((place[axis] + away) / (2.0 * reach)).floor() as i64,
            };
            let near = (0..8).map(|corner| {
                std::array::from_fn(|axis| bucket(if corner >> axis & 1 == 0 { -reach } else { reach }, axis))
            });
            let same = |other: &usize| norm(minus(self.vertices[*other], place)) <= reach;
            match near.filter_map(|bucket| boxes.get(&bucket)).flatten().copied().find(same) {
                Some(twin) => {
                    twins.insert(corner, twin);
                    merged += 1;
                }
                None => boxes.entry(std::array::from_fn(|axis| bucket(0.0, axis))).or_default().push(corner),
            }
        }
        if merged > 0 {
            self.triangles
                .iter_mut()
                .flatten()
                .for_each(|corner| *corner = *twins.get(corner).unwrap_or(corner));
            self.repairs.merged += merged;
            self.repairs.within = reach;
        }
    }
}
