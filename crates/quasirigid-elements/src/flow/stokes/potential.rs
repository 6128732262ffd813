//! Potential flow in a mesh: slip of an ideal liquid past a rotating cavity, by quadratic elements.
//! A Laplacian with given normal derivative leaves a constant free; a small mass fixes it, and no gradient sees it.
//! Equation (L12), docs/theory/13-inside.md.

use nalgebra::Vector3;

use super::StokesError;
use super::assembly::{Numbering, add, anchor};
use super::cell::{Matrices, NODES, Point, points, points_at};
use super::grid::{FACES, Grid};
use super::moments::Moments;
use crate::flow::potential_flow::PotentialFlowMoments;
use crate::math::factor::{Factor, Method};
use crate::math::symmetric::Symmetric;
use crate::math::vec3::{add as sum, cross, dot, norm, scale};
use quasirigid_mesh::{CellSample, Mesh, Rule, Shape};

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Corners of the reference cell.
const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// Share of the mass in the Laplacian, which fixes the constant of the potential.
const ANCHOR: f64 = 1e-9;

/// Slip of an ideal liquid in the cavity of a mesh, by quadratic potentials, with the moments of the mesh. (L12)
///
/// # Errors
/// [`StokesError`] if the tetrahedra are no single cavity.
pub(crate) fn slip(mesh: &Mesh) -> Result<(Moments, PotentialFlowMoments), StokesError> {
    let grid = Grid::new(mesh)?;
    let moments = Moments::of(&grid);
    if !moments.in_range() {
        return Err(StokesError::OutOfRange { volume: moments.volume });
    }
    let center = scale(-1.0, moments.center);
    let potentials = potentials(&grid, center)?;
    let past = |point: &Point, cell: &[usize; NODES]| {
        let from_center = sum(point.place, center);
        [0, 1, 2].map(|axis| {
            let parts = cell.iter().zip(&point.slopes);
            let slope =
                parts.map(|(node, slope)| scale(potentials[3 * node + axis], *slope)).fold([0.0; 3], sum);
            Vector3::from(slope) - Vector3::from(cross(AXES[axis], from_center))
        })
    };
    let mut slip = PotentialFlowMoments::default();
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
    let all = Numbering::new(grid, grid.cells.iter().flatten().copied());
    let mut stiffness = Symmetric::zero(all.pattern(grid, NODES));
    let mut mass = stiffness.clone();
    let mut loads = vec![0.0; 3 * all.size()];
    let number = |node: usize| all.of[node].map_or(0, |number| number as usize);
    for cell in &grid.cells {
        let places = cell.map(|node| grid.places[node]);
        let (matrices, unknowns) = (Matrices::new(&places), cell.map(|node| all.of[node]));
        add(&mut stiffness, &unknowns, matrices.stiffness.as_flattened());
        add(&mut mass, &unknowns, matrices.mass.as_flattened());
        for point in points(&places) {
            for (axis, e) in AXES.into_iter().enumerate() {
                let turn = cross(e, sum(point.place, center));
                for (node, slope) in cell.iter().zip(point.slopes) {
                    loads[3 * number(*node) + axis] += point.volume * dot(slope, turn);
                }
            }
        }
    }
    let anchored = stiffness.plus(anchor(ANCHOR, &stiffness, &mass), &mass);
    let anchored = anchored.expect("both stand on one pattern");
    let factor = Factor::new(&anchored, Method::default()).map_err(|soft| all.singular(grid, &soft))?;
    factor.solve(&mut loads, 3);
    let of_node = |node: usize| loads[3 * number(node)..][..3].to_vec();
    Ok((0..grid.places.len()).flat_map(of_node).collect())
}

/// Samples of a cell on one of its faces, with their shares of the area (m²).
fn on_face(face: usize, places: &[[f64; 3]; NODES]) -> impl Iterator<Item = (CellSample, f64)> {
    let [a, b, c] = [0, 1, 2].map(|corner| CORNERS[FACES[face][corner]]);
    let [along, across] = [b, c].map(|end| sum(end, scale(-1.0, a)));
    Shape::Triangle6.samples(Rule::Products).iter().map(move |flat| {
        let at = sum(a, sum(scale(flat.at[0], along), scale(flat.at[1], across)));
        let (functions, gradients) = (Shape::Tet10.functions(at), Shape::Tet10.gradients(at));
        let tangent = |direction: [f64; 3]| {
            let parts = places.iter().zip(&gradients);
            parts.map(|(place, gradient)| scale(dot(*gradient, direction), *place)).fold([0.0; 3], sum)
        };
        let area = flat.weight * norm(cross(tangent(along), tangent(across)));
        (CellSample { at, weight: 0.0, functions, gradients }, area)
    })
}
