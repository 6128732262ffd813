//! Free vibration of a free square plate in its plane with `ν = 0.3` `[@bardell1996]`: membrane, drilling
//! and mass together; a mechanism that the mesh hides would be the lowest mode.

use nalgebra::DMatrix;

use super::super::{mass, stiffness};
use super::grid::{Grid, SHAPES, name};
use super::structure::section;
use quasirigid_mesh::Shape;

/// The entries between some degrees of freedom of all nodes.
fn between(matrix: &DMatrix<f64>, rows: &[usize], columns: &[usize]) -> DMatrix<f64> {
    let place = |i: usize, dofs: &[usize]| 6 * (i / dofs.len()) + dofs[i % dofs.len()];
    let nodes = matrix.nrows() / 6;
    DMatrix::from_fn(nodes * rows.len(), nodes * columns.len(), |i, j| {
        matrix[(place(i, rows), place(j, columns))]
    })
}

/// `ω a √(ρ (1 − ν²) / E)` of the modes in the plane, ascending, without those of a rigid body.
fn frequencies(shape: Shape, n: usize) -> Vec<f64> {
    let (poisson, thickness) = (0.3, 0.01);
    let section = section(1.0 - poisson * poisson, poisson, thickness);
    let shift = |x: f64, y: f64| x + 0.3 * x * (1.0 - x) * (y - 0.4);
    let grid = Grid::new(shape, [n, n], &|x, y| [shift(x, y), shift(y, 1.0 - x), 0.0]);
    let mut K = DMatrix::zeros(6 * grid.nodes.len(), 6 * grid.nodes.len());
    let mut M = K.clone();
    for cell in &grid.cells {
        let places = grid.places(cell);
        let parts =
            [stiffness(shape, &places, [1.0, 0.3, 0.0].into(), &section), mass(shape, &places, &section)];
        for (whole, part) in [&mut K, &mut M].into_iter().zip(parts) {
            let part = part.unwrap();
            for (i, a) in cell.iter().enumerate() {
                for (j, b) in cell.iter().enumerate() {
                    let mut block = whole.fixed_view_mut::<6, 6>(6 * a, 6 * b);
                    block += part.fixed_view::<6, 6>(6 * i, 6 * j);
                }
            }
        }
    }
    // Drilling has no mass: the rotation follows statically.
    let tie = between(&K, &[5], &[0, 1]);
    let follow = between(&K, &[5], &[5]).cholesky().unwrap().solve(&tie);
    let K = between(&K, &[0, 1], &[0, 1]) - tie.tr_mul(&follow);
    let factor = between(&M, &[0, 1], &[0, 1]).cholesky().unwrap();
    let half = factor.l_dirty().solve_lower_triangular(&K).unwrap();
    let whole = factor.l_dirty().solve_lower_triangular(&half.transpose()).unwrap();
    let mut squares: Vec<f64> = whole.symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares[3..].iter().map(|square| square.sqrt()).collect()
}

#[test]
fn a_free_plate_vibrates_in_its_plane_as_published() {
    let published = [2.321, 2.472, 2.472, 2.628, 2.987, 3.452];
    for shape in SHAPES {
        for n in [4, 8] {
            let found = frequencies(shape, n);
            let ratios: Vec<f64> =
                found.iter().zip(published).map(|(found, published)| found / published).collect();
            println!("in-plane modes {:9} {n}: {ratios:.4?}", name(shape));
            // the mesh is coarse: the error falls with the square of the elements
            let allowed = if n == 4 { 0.12 } else { 0.025 };
            assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < allowed), "{ratios:?}");
        }
    }
}
