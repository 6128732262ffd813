//! Buckling of a simply supported square plate under compression along one axis: `N = 4 π² D / b²` (Bryan).

use std::f64::consts::PI;

use nalgebra::DVector;

use super::grid::{Grid, SHAPES, name};
use super::structure::{Structure, section};
use quasirigid_mesh::Shape;

fn coefficient(shape: Shape, n: usize) -> f64 {
    let (young, poisson, thickness) = (7e10, 0.3, 1e-3);
    let grid = Grid::new(shape, [n, n], &|x, y| [x, y, 0.0]);
    let mut plate = Structure::new(grid, section(young, poisson, thickness), [1.0, 0.0, 0.0]);
    let edge = |value: f64| value.abs() < 1e-9 || (value - 1.0).abs() < 1e-9;
    plate.hold(&[0, 1, 5], &|_| true);
    plate.hold(&[2, 3], &|p| edge(p.x));
    plate.hold(&[2, 4], &|p| edge(p.y));
    // a compression of 1 N/m along x, free across
    let strain = 1.0 / (young * thickness);
    let pressed =
        plate.grid.nodes.iter().flat_map(|p| [-strain * p.x, poisson * strain * p.y, 0.0, 0.0, 0.0, 0.0]);
    let u = DVector::from_iterator(plate.load.len(), pressed);
    plate.buckling(&u) * 12.0 * (1.0 - poisson * poisson) / (young * thickness.powi(3) * PI * PI)
}

#[test]
fn a_plate_buckles_at_bryans_load() {
    for shape in SHAPES {
        let ratios = [4, 8, 16].map(|n| coefficient(shape, n) / 4.0);
        println!("buckling {:9}: {ratios:.4?}", name(shape));
        assert!((ratios[2] - 1.0).abs() < 0.01);
    }
}
