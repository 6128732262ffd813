//! Error estimate of a flow: distance of its gradient from one recovered by local polynomial fits.
//! Fits over patches of cells, not means at nodes: means of a quadratic velocity carry the same error on both sides of a node.
//! Superconvergent patch recovery `[@zienkiewicz1992]`.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::cell::{CORNERS, NODES, Point, points, points_at};
use super::grid::Grid;
use quasirigid_mesh::{Rule, Shape};

/// Monomials up to the second degree in three coordinates.
const MONOMIALS: usize = 10;
/// Least number of cells of a patch, if the cavity has so many.
const ENOUGH: usize = 12;
/// Share of the largest direction of the normal equations below which the samples do not determine a direction.
const UNTOLD: f64 = 1e-6;

/// Entries of a gradient, row by row.
type Entries = SVector<f64, 9>;

/// Error energy `∫ |G − ∇u|² dV` with the recovered gradient `G`: around each vertex a quadratic polynomial for each entry, fitted to the
/// gradients at points of the cells there `[@zienkiewicz1992]`; in a cell those of its corners, by their shares. `field` is the velocity of
/// each node.
///
/// Means of the gradients at each node would not do: the errors of those of a quadratic velocity are much the same on both sides of a node.
pub(super) fn error_energy(grid: &Grid, field: impl Fn(usize) -> [f64; 3]) -> f64 {
    let patches = patches(grid, &field);
    let mut energy = 0.0;
    for cell in &grid.cells {
        let u = cell.map(&field);
        for point in points(&cell.map(|node| grid.places[node])) {
            let mut gap = -entries(&point, &u);
            for (corner, share) in cell[..CORNERS].iter().zip(point.shares) {
                if let Some(patch) = &patches[*corner] {
                    gap += share * patch.value(point.place);
                }
            }
            energy += point.volume * gap.norm_squared();
        }
    }
    energy
}

/// Polynomials for a gradient near a vertex.
struct Patch {
    middle: Vector3<f64>,
    /// Scaling to coordinates whose mean squares are one, so that a patch may be thin.
    scale: Matrix3<f64>,
    coefficients: SMatrix<f64, 9, MONOMIALS>,
}

impl Patch {
    /// Polynomials that are nearest to samples, places with gradients.
    fn new(middle: [f64; 3], samples: &[([f64; 3], Entries)]) -> Self {
        let middle = Vector3::from(middle);
        let squares = samples.iter().map(|(place, _)| Vector3::from(*place) - middle);
        let squares =
            squares.map(|away| away * away.transpose()).sum::<Matrix3<f64>>() / samples.len() as f64;
        let scale = squares.cholesky().and_then(|root| root.l().try_inverse()).unwrap_or_default();
        let mut patch = Self { middle, scale, coefficients: SMatrix::zeros() };
        let mut normal = SMatrix::<f64, MONOMIALS, MONOMIALS>::zeros();
        let mut right = SMatrix::<f64, 9, MONOMIALS>::zeros();
        for (place, gradient) in samples {
            let monomials = patch.monomials(*place);
            normal += monomials * monomials.transpose();
            right += gradient * monomials.transpose();
        }
        let eigen = normal.symmetric_eigen();
        let told = UNTOLD * eigen.eigenvalues.max();
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > told {
                patch.coefficients += right * vector * vector.transpose() / *value;
            }
        }
        patch
    }

    fn monomials(&self, place: [f64; 3]) -> SVector<f64, MONOMIALS> {
        let [x, y, z] = (self.scale * (Vector3::from(place) - self.middle)).into();
        SVector::from([1.0, x, y, z, x * x, y * y, z * z, y * z, z * x, x * y])
    }

    fn value(&self, place: [f64; 3]) -> Entries {
        self.coefficients * self.monomials(place)
    }
}

/// Patch of each node that is a vertex.
fn patches(grid: &Grid, field: impl Fn(usize) -> [f64; 3]) -> Vec<Option<Patch>> {
    let sampled = |cell: &[usize; NODES]| -> Vec<([f64; 3], Entries)> {
        let (u, places) = (cell.map(&field), cell.map(|node| grid.places[node]));
        let points = points_at(&places, Shape::Tet10.samples(Rule::Slopes));
        points.map(|point| (point.place, entries(&point, &u))).collect()
    };
    let samples: Vec<_> = grid.cells.iter().map(sampled).collect();
    let mut around = vec![Vec::new(); grid.places.len()];
    for (number, cell) in grid.cells.iter().enumerate() {
        cell[..CORNERS].iter().for_each(|corner| around[*corner].push(number));
    }
    let patch = |vertex: usize| {
        let cells = grown(grid, &around, vertex);
        let samples: Vec<_> = cells.iter().flat_map(|cell| samples[*cell].iter().copied()).collect();
        Patch::new(grid.places[vertex], &samples)
    };
    (0..around.len()).map(|node| (!around[node].is_empty()).then(|| patch(node))).collect()
}

/// Cells around a vertex, and around their corners while they are too few.
fn grown(grid: &Grid, around: &[Vec<usize>], vertex: usize) -> Vec<usize> {
    let mut cells = around[vertex].clone();
    while cells.len() < ENOUGH.min(grid.cells.len()) {
        let corners = cells.iter().flat_map(|cell| &grid.cells[*cell][..CORNERS]);
        cells = corners.flat_map(|corner| &around[*corner]).copied().collect();
        cells.sort_unstable();
        cells.dedup();
    }
    cells
}

fn entries(point: &Point, field: &[[f64; 3]; NODES]) -> Entries {
    Entries::from_row_slice(point.gradient(field).as_flattened())
}
