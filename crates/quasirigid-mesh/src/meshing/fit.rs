//! A lattice fitted to a surface.

use std::collections::HashMap;

use super::lattice::{LONG_EDGE, Lattice};
use crate::surface::Proximity;
use quasirigid_math::vec3::{add, norm, scale};
use quasirigid_math::watch;

/// Distance to the surface, in sides of a cube, below which points are on it.
const ON: f64 = 1e-9;
/// Distance to the surface below which cuts are on it.
const CUT: f64 = 1e-13;
/// Most steps towards a cut: many times the number that a polyhedron needs.
const MAX_STEPS: usize = 100;
/// Shares of a long and of a short edge within which a cut draws the end of the edge to it `[@labelle2007]`.
const DRAWN: [f64; 2] = [0.249_99, 0.411_89];

/// Side of the surface on which a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Inside,
    On,
    Outside,
}

/// Fit: points of a lattice, some of them moved to a surface, and the cuts of the surface through edges between the others.
pub(super) struct Fit {
    places: Vec<[f64; 3]>,
    pub sides: Vec<Side>,
    cuts: HashMap<[usize; 2], [f64; 3]>,
}

impl Fit {
    /// Fits a lattice, in its units. Of several cuts of an edge one is found; an edge with both ends on one side has none.
    pub fn new(lattice: &Lattice, surface: &Proximity) -> Self {
        let mut fit = Self { places: Vec::new(), sides: Vec::new(), cuts: HashMap::new() };
        let mut distances = Vec::with_capacity(lattice.size());
        watch::stage("meshing");
        for index in 0..lattice.size() {
            watch::progress(index as f64 / lattice.size() as f64);
            // Indices of no point stay outside.
            let (place, distance) = lattice.point(index).map_or(([0.0; 3], f64::INFINITY), |point| {
                let place = Lattice::place(point);
                let nearest = surface.nearest(place);
                (if nearest.distance.abs() < ON { nearest.at } else { place }, nearest.distance)
            });
            fit.places.push(place);
            fit.sides.push(side(distance));
            distances.push(distance);
        }
        for index in 0..lattice.size() {
            for (other, _) in lattice.point(index).into_iter().flat_map(|point| lattice.neighbours(point)) {
                if fit.sides[index] == Side::Inside && fit.sides[other] == Side::Outside {
                    let cut = cut(
                        surface,
                        [index, other].map(|end| fit.places[end]),
                        [index, other].map(|end| distances[end]),
                    );
                    fit.cuts.insert(ends(index, other), cut);
                }
            }
        }
        (0..lattice.size()).for_each(|index| fit.draw(lattice, index));
        fit
    }

    /// Place of a point of the lattice, given twice, or of the cut of an edge.
    pub fn place(&self, a: usize, b: usize) -> [f64; 3] {
        self.cuts.get(&ends(a, b)).copied().unwrap_or(self.places[a])
    }

    /// Moves a point to the nearest of the cuts that are near, after which its edges have none.
    fn draw(&mut self, lattice: &Lattice, index: usize) {
        let Some(point) = lattice.point(index) else { return };
        let edges = || lattice.neighbours(point);
        let from = scale(-1.0, self.places[index]);
        let near = edges().filter_map(|(other, length)| {
            let cut = *self.cuts.get(&ends(index, other))?;
            let away = norm(add(cut, from));
            let share = if length == LONG_EDGE { DRAWN[0] } else { DRAWN[1] };
            (away < share * length).then_some((away, cut))
        });
        if let Some((_, cut)) = near.min_by(|a, b| a.0.total_cmp(&b.0)) {
            self.places[index] = cut;
            self.sides[index] = Side::On;
            for (other, _) in edges() {
                self.cuts.remove(&ends(index, other));
            }
        }
    }
}

fn side(distance: f64) -> Side {
    if distance.abs() < ON {
        Side::On
    } else if distance < 0.0 {
        Side::Inside
    } else {
        Side::Outside
    }
}

fn ends(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Cut of an edge by a surface, from the distances of its ends: false position, with the weight of an end that stays halved (the Illinois
/// rule).
fn cut(surface: &Proximity, [inner, outer]: [[f64; 3]; 2], [mut low, mut high]: [f64; 2]) -> [f64; 3] {
    let along = add(outer, scale(-1.0, inner));
    let [mut from, mut to] = [0.0, 1.0];
    let mut place = inner;
    let mut last = Side::On;
    for _ in 0..MAX_STEPS {
        let share = (from * high - to * low) / (high - low);
        let nearest = surface.nearest(add(inner, scale(share, along)));
        place = nearest.at;
        if nearest.distance.abs() < CUT {
            break;
        }
        if nearest.distance < 0.0 {
            (from, low) = (share, nearest.distance);
            high *= if last == Side::Inside { 0.5 } else { 1.0 };
            last = Side::Inside;
        } else {
            (to, high) = (share, nearest.distance);
            low *= if last == Side::Outside { 0.5 } else { 1.0 };
            last = Side::Outside;
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::testing::ball;

    #[test]
    fn cuts_are_on_the_surface_and_none_stays_near_a_point() {
        let surface = Proximity::new(&ball(3, |at| at.map(|x| 2.3 * x + 4.1)), |at| at);
        let lattice = Lattice::new([8; 3]);
        let fit = Fit::new(&lattice, &surface);
        let (mut cuts, mut drawn) = (0, 0);
        for index in 0..lattice.size() {
            let Some(point) = lattice.point(index) else { continue };
            let exact = surface.nearest(Lattice::place(point));
            let moved = norm(add(fit.places[index], Lattice::place(point).map(|x| -x)));
            match fit.sides[index] {
                Side::On => {
                    drawn += 1;
                    assert!(surface.nearest(fit.places[index]).distance.abs() < 1e-12 && moved < 0.36);
                }
                side => assert_eq!((moved, side == Side::Inside), (0.0, exact.distance < 0.0)),
            }
            for (other, length) in lattice.neighbours(point) {
                let between = [index, other].map(|end| fit.sides[end]);
                let cut = fit.cuts.get(&ends(index, other));
                let across = !between.contains(&Side::On) && between[0] != between[1];
                assert_eq!(cut.is_some(), across);
                let Some(cut) = cut else { continue };
                cuts += 1;
                let [a, b] = [index, other].map(|end| norm(add(fit.places[end], scale(-1.0, *cut))));
                let share = if length == LONG_EDGE { 0.249_99 } else { 0.411_89 };
                assert!((a + b - length).abs() < 1e-12 && a.min(b) >= share * length, "{a} {b} {length}");
                assert!(surface.nearest(*cut).distance.abs() < 1e-12);
            }
        }
        assert!(cuts > 100 && drawn > 50, "{cuts} {drawn}");
    }
}
