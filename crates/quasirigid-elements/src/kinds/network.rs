//! Random network of masses and springs that fills an ellipsoid, as simulations of rubble piles use it.
//! Points and springs are ordinary elements; the random numbers are our own, so a seed gives the same network on every machine.
//! Random-spring networks `[@quillen2019]`, generator SplitMix64 `[@steele2014]`.

use std::collections::HashMap;
use std::f64::consts::PI;

use crate::PointMotion;
use crate::math::random::Random;
use crate::model::Rheology;
use crate::{End, Point, Prestress, Spring, SpringLaw};

/// A random network of equal masses and springs that fills an ellipsoid: the rubble of N-body simulations
/// `[@quillen2019]`.
///
/// Points are thrown evenly into the ellipsoid, and kept where they are farther than `spacing` from all before, until forty
/// throws fall on each cube of that side. Springs join all pairs that are nearer than `reach`. The same seed gives the same
/// network.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    /// Beginning of the names of its points.
    pub name: String,
    /// Mass of all points together (kg).
    pub mass: f64,
    /// Semi-axes of the ellipsoid (m), along the axes of the file's frame.
    pub semi_axes: [f64; 3],
    /// Centre of the ellipsoid (m), in the file's frame.
    pub center: [f64; 3],
    /// Least distance of two points (m).
    pub spacing: f64,
    /// Length of the longest springs (m).
    pub reach: f64,
    /// Stiffness of each spring (N/m).
    pub stiffness: f64,
    /// Rheology of each spring: response to periodic strain.
    pub rheology: Rheology,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Throws on each cube of the least distance.
const THROWS: f64 = 40.0;

impl Network {
    /// Upper estimate of the number of points: as many spheres of the least distance as a random packing has.
    #[must_use]
    pub fn expected(&self) -> f64 {
        0.8 * self.volume() / self.spacing.powi(3)
    }

    /// Upper estimate of the number of springs: every pair of the expected points that is near, as if none were at the surface.
    #[must_use]
    pub fn expected_springs(&self) -> f64 {
        let near = 0.8 * 4.0 / 3.0 * PI * (self.reach / self.spacing).powi(3);
        0.5 * self.expected() * near
    }

    /// The points, and the springs between them as pairs of their indices.
    #[must_use]
    pub fn layout(&self) -> (Vec<[f64; 3]>, Vec<[usize; 2]>) {
        let mut random = Random::new(self.seed);
        let mut near = CellList { side: self.spacing, cells: HashMap::new() };
        let mut places: Vec<[f64; 3]> = Vec::new();
        for _ in 0..(THROWS * self.volume() / self.spacing.powi(3)) as usize {
            let unit = in_ball(&mut random);
            let place = [0, 1, 2].map(|axis| self.center[axis] + self.semi_axes[axis] * unit[axis]);
            if near.around(place, 1).all(|other| distance(places[other], place) > self.spacing) {
                near.cells.entry(near.cell(place)).or_default().push(places.len());
                places.push(place);
            }
        }
        let cells = (self.reach / self.spacing).ceil() as i64;
        let partners = |(index, place): (usize, &[f64; 3])| {
            let mut others: Vec<usize> = near
                .around(*place, cells)
                .filter(|other| *other > index && distance(places[*other], *place) < self.reach)
                .collect();
            others.sort_unstable();
            others.into_iter().map(move |other| [index, other]).collect::<Vec<_>>()
        };
        let pairs = places.iter().enumerate().flat_map(partners).collect();
        (places, pairs)
    }

    /// Points and springs of the network; the points come after as many others as `before`.
    #[must_use]
    pub fn parts(&self, before: usize) -> (Vec<Point>, Vec<Spring>) {
        let (places, pairs) = self.layout();
        let mass = self.mass / places.len() as f64;
        let point = |(index, position): (usize, &[f64; 3])| Point {
            name: format!("{} {}", self.name, index + 1),
            mass,
            position: *position,
            motion: PointMotion::Free,
        };
        let spring = |[from, to]: &[usize; 2]| Spring {
            name: self.name.clone(),
            from: End::Point(before + from),
            to: End::Point(before + to),
            law: SpringLaw::Axial {
                stiffness: self.stiffness,
                damping: 0.0,
                anchor: None,
                prestress: Prestress::Relaxed,
            },
            rheology: self.rheology.clone(),
        };
        (places.iter().enumerate().map(point).collect(), pairs.iter().map(spring).collect())
    }

    fn volume(&self) -> f64 {
        4.0 / 3.0 * PI * self.semi_axes.iter().product::<f64>()
    }
}

/// Indices of places by the cube they are in.
struct CellList {
    side: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
}

impl CellList {
    fn cell(&self, place: [f64; 3]) -> [i64; 3] {
        place.map(|entry| (entry / self.side).floor() as i64)
    }

    /// Places in the cubes up to so many away.
    fn around(&self, place: [f64; 3], cells: i64) -> impl Iterator<Item = usize> + '_ {
        let [x, y, z] = self.cell(place);
        let range = -cells..=cells;
        let cubes = range.clone().flat_map(move |i| {
            let range = range.clone();
            range.clone().flat_map(move |j| range.clone().map(move |k| [x + i, y + j, z + k]))
        });
        cubes.filter_map(|cube| self.cells.get(&cube)).flatten().copied()
    }
}

/// A random place in the unit ball.
fn in_ball(random: &mut Random) -> [f64; 3] {
    loop {
        let place: [f64; 3] = std::array::from_fn(|_| 2.0 * random.unit() - 1.0);
        if place.iter().map(|entry| entry * entry).sum::<f64>() <= 1.0 {
            return place;
        }
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn network(seed: u64) -> Network {
        Network {
            name: "rubble".to_owned(),
            mass: 3.0,
            semi_axes: [1.7, 1.1, 0.8],
            center: [0.3, -2.0, 0.7],
            spacing: 0.25,
            reach: 0.55,
            stiffness: 0.08,
            rheology: Rheology::Elastic,
            seed,
        }
    }

    #[test]
    fn points_keep_their_distance_and_springs_join_all_that_are_near() {
        let network = network(7);
        let (places, pairs) = network.layout();
        assert!(places.len() as f64 > 0.6 * network.expected() && (places.len() as f64) < network.expected());
        let mut near = Vec::new();
        for i in 0..places.len() {
            let inside: f64 =
                (0..3).map(|k| ((places[i][k] - network.center[k]) / network.semi_axes[k]).powi(2)).sum();
            assert!(inside <= 1.0);
            for j in i + 1..places.len() {
                let distance = distance(places[i], places[j]);
                assert!(distance > network.spacing);
                if distance < network.reach {
                    near.push([i, j]);
                }
            }
        }
        assert_eq!(pairs, near);
        let expected = network.expected_springs();
        assert!(near.len() as f64 > 0.3 * expected && (near.len() as f64) < expected);
    }

    #[test]
    fn a_seed_is_a_network() {
        assert_eq!(network(3).layout(), network(3).layout());
        assert_ne!(network(3).layout().0, network(4).layout().0);
    }
}
