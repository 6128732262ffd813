use std::sync::Arc;

use nalgebra::Vector3;

use super::StokesError;
use super::cell::{NODES, Point, points, points_at};
use super::grid::{FACES, Grid};
use super::moments::Moments;
use crate::elements::slip::Slip;
use crate::math::factor::{Factor, Method};
use crate::math::mesh::{Mesh, Rule, Sample, Shape};
use crate::math::sym::{add, cross, dot, norm, scale};
use crate::math::symmetric::{Pattern, Symmetric};

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Corners of the reference cell.
const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Share of the mass in the Laplacian, which alone would leave the constant free.
const ANCHOR: f64 = 1e-9;

/// An ideal liquid in the cavity that the tetrahedra of a mesh fill, by quadratic potentials, and what they fill. (L12)
///
/// # Errors
/// [`StokesError`] if the tetrahedra are no single cavity.
pub(in crate::elements) fn slip(mesh: &Mesh) -> Result<(Moments, Slip), StokesError> {
    let grid = Grid::new(mesh)?;
    let moments = Moments::of(&grid);
    if !moments.in_range() {
        return Err(StokesError::OutOfRange { volume: moments.volume });
    }
    let center = scale(-1.0, moments.center);
    let potentials = potentials(&grid, center)?;
    let past = |point: &Point, cell: &[usize; NODES]| {
        let from_center = add(point.place, center);
        [0, 1, 2].map(|axis| {
            let parts = cell.iter().zip(&point.slopes);
            let slope =
                parts.map(|(node, slope)| scale(potentials[3 * node + axis], *slope)).fold([0.0; 3], add);
            Vector3::from(slope) - Vector3::from(cross(AXES[axis], from_center))
        })
    };
    let mut slip = Slip::default();
    for cell in &grid.cells {
        for point in points(&cell.map(|node| grid.places[node])) {
            slip.add_volume(point.volume, &past(&point, cell));
        }
    }
    for (cell, face) in &grid.faces {
        let cell = &grid.cells[*cell];
        let places = cell.map(|node| grid.places[node]);
        for (sample, area) in on_face(*face, &places) {
            for point in points_at(&places, &[sample]) {
                slip.add_surface(area, &past(&point, cell));
            }
        }
    }
    Ok((moments, slip))
}

/// The potentials about the axes at each node, three to a node.
fn potentials(grid: &Grid, center: [f64; 3]) -> Result<Vec<f64>, StokesError> {
    let count = grid.places.len();
    let lists: Vec<Vec<u32>> = grid.cells.iter().map(|cell| cell.map(|node| node as u32).to_vec()).collect();
    let ends: Vec<u32> = (0..=count as u32).collect();
    let pattern = Pattern::new(&ends, lists.iter().map(Vec::as_slice));
    let mut matrix =
        Symmetric::zero(Arc::new(pattern.expect("numbers ascend and each list holds some of them")));
    let mut loads = vec![0.0; 3 * count];
    for (cell, list) in grid.cells.iter().zip(&lists) {
        let mut own = [[0.0; NODES]; NODES];
        for point in points(&cell.map(|node| grid.places[node])) {
            let size = ANCHOR * point.slopes.iter().map(|slope| dot(*slope, *slope)).sum::<f64>();
            for a in 0..NODES {
                for b in 0..NODES {
                    let stiffness = dot(point.slopes[a], point.slopes[b]);
                    own[a][b] += point.volume * (stiffness + size * point.functions[a] * point.functions[b]);
                }
                for axis in 0..3 {
                    let turn = cross(AXES[axis], add(point.place, center));
                    loads[3 * cell[a] + axis] += point.volume * dot(point.slopes[a], turn);
                }
            }
        }
        let unknowns: Vec<Option<u32>> = list.iter().copied().map(Some).collect();
        matrix.add(&unknowns, own.as_flattened()).expect("the pattern has the places of every cell");
    }
    let factor = Factor::new(&matrix, Method::default())
        .map_err(|_| StokesError::Singular { at: scale(-1.0, center) })?;
    factor.solve(&mut loads, 3);
    Ok(loads)
}

/// Samples of a cell on one of its faces, with their shares of the area (m²).
fn on_face(face: usize, places: &[[f64; 3]; NODES]) -> impl Iterator<Item = (Sample, f64)> {
    let [a, b, c] = [0, 1, 2].map(|corner| CORNERS[FACES[face][corner]]);
    let [along, across] = [b, c].map(|end| add(end, scale(-1.0, a)));
    Shape::Triangle6.samples(Rule::Products).iter().map(move |flat| {
        let at = add(a, add(scale(flat.at[0], along), scale(flat.at[1], across)));
        let (functions, gradients) = (Shape::Tet10.functions(at), Shape::Tet10.gradients(at));
        let tangent = |direction: [f64; 3]| {
            let parts = places.iter().zip(&gradients);
            parts.map(|(place, gradient)| scale(dot(*gradient, direction), *place)).fold([0.0; 3], add)
        };
        let area = flat.weight * norm(cross(tangent(along), tangent(across)));
        (Sample { at, weight: 0.0, functions, gradients }, area)
    })
}
