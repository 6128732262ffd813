//! Thin square plates under uniform pressure (Timoshenko & Woinowsky-Krieger 1959, tables 8 and 35).

use nalgebra::Vector3;

use super::grid::{Grid, SHAPES, name};
use super::structure::{Structure, section};
use crate::math::mesh::Shape;

/// Deflection of the middle in units of `q a⁴ / D`, from a quarter of the plate.
fn middle(shape: Shape, n: usize, thickness: f64, clamped: bool) -> f64 {
    // Corners of elements are moved off the lines of a regular grid, except at the rim.
    let shift = |x: f64, y: f64| 0.4 * x * (1.0 - x) * (y - 0.3);
    let grid = Grid::new(shape, [n, n], |x, y| [0.5 * (x + shift(x, y)), 0.5 * (y - shift(y, x)), 0.0]);
    let mut plate = Structure::new(grid, section(7e10, 0.3, thickness), [1.0, 0.0, 0.0]);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    plate.hold(&[0, 4, 5], |p| near(p.x, 0.0));
    plate.hold(&[1, 3, 5], |p| near(p.y, 0.0));
    let rim: &[usize] = if clamped { &[2, 3, 4] } else { &[2] };
    plate.hold(rim, |p| near(p.x, 0.5) || near(p.y, 0.5));
    plate.hold(&[3], |p| near(p.x, 0.5));
    plate.hold(&[4], |p| near(p.y, 0.5));
    plate.press(|_| Vector3::z());
    plate.answer()[2] * 7e10 * thickness.powi(3) / (12.0 * (1.0 - 0.09))
}

/// Without locking: the same at every thickness, down to where rounding begins (1e-5 of the side).
#[test]
fn thin_plates_bend_as_kirchhoff_says() {
    for shape in SHAPES {
        // 0.00126532 and 0.00406235 to more digits than the tables print
        for (clamped, exact) in [(true, 0.001_265_32), (false, 0.004_062_35)] {
            for thickness in [1e-3, 1e-5] {
                let ratios = [4, 8, 16].map(|n| middle(shape, n, thickness, clamped) / exact);
                println!("plate clamped {clamped:5} {:9} t/a {thickness:e}: {ratios:.4?}", name(shape));
                assert!((ratios[2] - 1.0).abs() < 0.01);
            }
        }
    }
}
