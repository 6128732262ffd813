//! Slosh of an ideal liquid in a tank of revolution whose axis is along the effective gravity: the potential `f(r, z) cos θ`.
//! The interior is eliminated by one factor; the eigenproblem is over the nodes of the free surface.
//! Equations (U1) to (U6), docs/theory/21-slosh.md.

mod pool;
#[cfg(test)]
mod tests;
mod wall;

use std::f64::consts::PI;
use std::sync::Arc;

use nalgebra::DMatrix;

pub(crate) use self::wall::{Moments, Wall, WallPiece};

use self::pool::Pool;
use super::grid::{Grid, Patch, Point};
use crate::math::eigen::{self, Dense};
use crate::math::factor::{Factor, Method};
use crate::math::krylov::dot;
use crate::math::symmetric::{Pattern, Symmetric};

/// Modes and moments of an ideal liquid under a free surface, of unit density, heights from the origin of the wall.
#[derive(Clone, Debug)]
pub(crate) struct Slosh {
    /// Lowest modes, ascending.
    pub modes: Vec<SloshMode>,
    /// Moment of the liquid under a rigid lid about an axis across, `∫|∇Φ|² dV` (m⁵). (U6)
    pub lid: f64,
    /// Mass of the bobs of all modes (m³), and their first and second moments along the axis (m⁴, m⁵). (U5)
    pub all: [f64; 3],
}

/// A slosh mode of a liquid of unit density.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SloshMode {
    /// `λ = ω²/g` (1/m).
    pub wavenumber: f64,
    /// Mass of the bob (m³). (U3)
    pub mass: f64,
    /// Height of the bob (m). (U3)
    pub height: f64,
    /// `∮|∇φ|² dS` over the wall, over `∫|∇φ|² dV` (1/m). (U7)
    pub wall: f64,
    /// The same over the free surface, of the velocity along it (1/m). (U7)
    pub surface: f64,
    /// Inertia of the mode by the rise of the surface at the wall (m³): twice the kinetic energy over the square of its rate. (U17)
    pub inertia: f64,
    /// Along the wall, upwards: distance from the axis, height, and velocity upwards over that of the surface at the wall. (U17)
    pub rise: Vec<[f64; 3]>,
}

/// The nodes off the axis, numbered, and what stands over them.
struct Unknowns {
    numbers: Vec<Option<u32>>,
    count: usize,
    /// Those on the free surface.
    surface: Vec<usize>,
}

impl Slosh {
    /// The `count` lowest modes of the liquid inside a wall that ends at the level, with polynomials of a degree and so many layers of patches
    /// at corners; none if floating point does not resolve them. (U2)
    pub fn new(wall: &Wall, count: usize, [degree, layers]: [usize; 2]) -> Option<Self> {
        let pool = Pool(wall);
        if !pool.is_resolved() {
            return None;
        }
        let grid = Grid::new(&pool, degree, layers);
        let unknowns = Unknowns::of(&grid);
        let factor = Factor::new(&unknowns.stiffness(&grid)?, Method::default()).ok()?;
        let (size, width) = (unknowns.surface.len(), unknowns.surface.len() + 1);
        let load = unknowns.load(&grid);
        let mut responses = vec![0.0; unknowns.count * width];
        unknowns.surface.iter().enumerate().for_each(|(column, row)| responses[row * width + column] = 1.0);
        load.iter().enumerate().for_each(|(row, value)| responses[row * width + size] = *value);
        factor.solve(&mut responses, width);
        let at = |row: usize, column: usize| responses[row * width + column];
        let [mass, radial] = unknowns.surface_integrals(&grid);
        let G = DMatrix::from_fn(size, size, |row, column| at(unknowns.surface[row], column));
        let lid: Vec<f64> = (0..unknowns.count).map(|row| at(row, size)).collect();
        let lid_there = nalgebra::DVector::from_fn(size, |row, _| lid[unknowns.surface[row]]);
        let found = eigen::modes(&dense(&(&mass * &G * &mass)), &dense(&mass)).ok()?;
        let lid_load = &mass * lid_there;
        let mut all = [0.0; 3];
        let mut modes = Vec::new();
        for (column, root) in found.frequencies.iter().enumerate() {
            let x = nalgebra::DVector::from_fn(size, |row, _| found.shapes.at(row, column));
            let (lambda, Mx) = (root * root, &mass * &x);
            let (b, c, norm) = (radial.dot(&x), lid_load.dot(&x), x.dot(&Mx));
            let share = PI * lambda / norm;
            let bob = share * b * b;
            all = [all[0] + bob, all[1] + share * b * c, all[2] + share * c * c];
            if modes.len() < count {
                let own =
                    |row: usize| lambda * (0..size).map(|column| at(row, column) * Mx[column]).sum::<f64>();
                let f: Vec<f64> = (0..unknowns.count).map(own).collect();
                let wall = unknowns.rubbed(&grid.edges, &f, true) / (lambda * norm);
                let surface = unknowns.rubbed(&grid.surfaces, &f, false) / (lambda * norm);
                let contact = x[unknowns.contact(&grid)];
                let inertia = PI * norm / (lambda * contact * contact);
                let rise = unknowns.rise(&grid, &f, lambda * contact);
                modes.push(SloshMode {
                    wavenumber: lambda,
                    mass: bob,
                    height: c / b,
                    wall,
                    surface,
                    inertia,
                    rise,
                });
            }
        }
        let lid = PI * dot(&load, &lid);
        let finite = modes.len() == count && modes.iter().all(SloshMode::is_finite) && lid.is_finite();
        finite.then_some(Self { modes, lid, all })
    }
}

impl SloshMode {
    fn is_finite(&self) -> bool {
        [self.wavenumber, self.mass, self.height, self.wall].iter().all(|value| value.is_finite())
    }
}

impl Unknowns {
    fn of(grid: &Grid) -> Self {
        let mut numbers = vec![None; grid.places.len()];
        let nodes: Vec<usize> = (0..grid.places.len()).filter(|node| !grid.axis[*node]).collect();
        nodes.iter().zip(0..).for_each(|(node, number)| numbers[*node] = Some(number));
        let surface = nodes.iter().enumerate().filter(|(_, node)| grid.surface[**node]);
        let surface = surface.map(|(number, _)| number).collect();
        Self { numbers, count: nodes.len(), surface }
    }

    fn of_patch(&self, patch: &Patch) -> Vec<Option<u32>> {
        patch.nodes.iter().map(|node| self.numbers[*node]).collect()
    }

    /// `∫ (f_r g_r + f_z g_z + f g/r²) r dr dz`. (U1)
    fn stiffness(&self, grid: &Grid) -> Option<Symmetric> {
        let lists: Vec<Vec<u32>> =
            grid.patches.iter().map(|patch| self.of_patch(patch).into_iter().flatten().collect()).collect();
        let ends: Vec<u32> = (0..=self.count as u32).collect();
        let pattern = Pattern::new(&ends, lists.iter().map(Vec::as_slice)).ok()?;
        let mut sum = Symmetric::zero(Arc::new(pattern));
        for patch in &grid.patches {
            let part = |row: usize, node: usize| {
                let point = &patch.points[row / 3];
                let [r, _] = point.at;
                let [value, by_r, by_z] = point.functions[node];
                (point.share * r).sqrt() * [by_r, by_z, value / r][row % 3]
            };
            let roots = DMatrix::from_fn(3 * patch.points.len(), patch.nodes.len(), part);
            let own = roots.transpose() * roots;
            sum.add(&self.of_patch(patch), own.as_slice()).ok()?;
        }
        Some(sum)
    }

    /// Load of a rotation about y, `∫ ∇N·(e_y × r) dV/π`. (U6)
    fn load(&self, grid: &Grid) -> Vec<f64> {
        let mut load = vec![0.0; self.count];
        for patch in &grid.patches {
            for point in &patch.points {
                let [r, z] = point.at;
                for (node, [value, by_r, by_z]) in patch.nodes.iter().zip(&point.functions) {
                    if let Some(number) = self.numbers[*node] {
                        load[number as usize] += point.share * (z * (r * by_r + value) - r * r * by_z);
                    }
                }
            }
        }
        load
    }

    /// `∫ N_a N_b r dr` and `∫ N_a r² dr` over the free surface.
    fn surface_integrals(&self, grid: &Grid) -> [DMatrix<f64>; 2] {
        let size = self.surface.len();
        let place = |node: usize| {
            let number = self.numbers[node]? as usize;
            self.surface.binary_search(&number).ok()
        };
        let [mut mass, mut radial] = [DMatrix::zeros(size, size), DMatrix::zeros(size, 1)];
        for edge in &grid.surfaces {
            let places: Vec<Option<usize>> = edge.nodes.iter().map(|node| place(*node)).collect();
            for point in &edge.points {
                let r = point.at[0];
                let values =
                    || places.iter().zip(&point.functions).filter_map(|(place, f)| Some(((*place)?, f[0])));
                for (row, value) in values() {
                    radial[(row, 0)] += point.share * r * r * value;
                    values()
                        .for_each(|(column, other)| mass[(row, column)] += point.share * r * value * other);
                }
            }
        }
        [mass, radial]
    }

    /// `∮|∇φ|² dS/π` over edges, with the velocity across them or without.
    fn rubbed(&self, edges: &[Patch], f: &[f64], across: bool) -> f64 {
        let mut sum = 0.0;
        for (point, [value, by_r, by_z]) in edges.iter().flat_map(|edge| self.flow(edge, f)) {
            let r = point.at[0];
            let upwards = if across { by_z * by_z } else { 0.0 };
            sum += point.share * r * (by_r * by_r + upwards + (value / r).powi(2));
        }
        sum
    }

    /// Number among those of the free surface of the node at the wall.
    fn contact(&self, grid: &Grid) -> usize {
        let mut radii = vec![0.0; self.count];
        for (node, number) in self.numbers.iter().enumerate() {
            if let Some(number) = number {
                radii[*number as usize] = grid.places[node][0];
            }
        }
        let radius = |place: &usize| radii[self.surface[*place]];
        (0..self.surface.len()).max_by(|a, b| radius(a).total_cmp(&radius(b))).unwrap_or(0)
    }

    /// Distance from the axis, height, and velocity upwards over a velocity, along the wall, upwards.
    fn rise(&self, grid: &Grid, f: &[f64], over: f64) -> Vec<[f64; 3]> {
        let points = grid.edges.iter().flat_map(|edge| self.flow(edge, f));
        let mut rise: Vec<[f64; 3]> =
            points.map(|(point, [_, _, by_z])| [point.at[0], point.at[1], by_z / over]).collect();
        rise.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
        rise
    }

    /// Quadrature points of an edge with `f`, `∂f/∂r` and `∂f/∂z` there.
    fn flow<'a>(&self, edge: &'a Patch, f: &[f64]) -> Vec<(&'a Point, [f64; 3])> {
        let own: Vec<f64> = edge
            .nodes
            .iter()
            .map(|node| self.numbers[*node].map_or(0.0, |number| f[number as usize]))
            .collect();
        let there = |point: &'a Point| {
            let parts = own.iter().zip(&point.functions).fold([0.0; 3], |sum, (value, functions)| {
                std::array::from_fn(|kind| sum[kind] + value * functions[kind])
            });
            (point, parts)
        };
        edge.points.iter().map(there).collect()
    }
}

fn dense(matrix: &DMatrix<f64>) -> Dense {
    let mut dense = Dense::zero(matrix.nrows());
    for row in 0..matrix.nrows() {
        (0..matrix.ncols())
            .for_each(|column| dense.add(row, column, 0.5 * (matrix[(row, column)] + matrix[(column, row)])));
    }
    dense
}
