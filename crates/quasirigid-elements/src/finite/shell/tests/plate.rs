//! Thin square plates under uniform pressure `[@timoshenko1959]`.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::super::{Ply, ShellSection};
use super::grid::{Grid, SHAPES, name};
use super::structure::{Structure, isotropic, section};
use quasirigid_mesh::Shape;

/// Deflection of the middle in units of `q a⁴ / D`, from a quarter of the plate.
fn middle(shape: Shape, n: usize, thickness: f64, clamped: bool) -> f64 {
    // Corners of elements are moved off the lines of a regular grid, except at the rim.
    let shift = |x: f64, y: f64| 0.4 * x * (1.0 - x) * (y - 0.3);
    let grid = Grid::new(shape, [n, n], &|x, y| [0.5 * (x + shift(x, y)), 0.5 * (y - shift(y, x)), 0.0]);
    let mut plate = Structure::new(grid, section(7e10, 0.3, thickness), [1.0, 0.0, 0.0]);
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    plate.hold(&[0, 4, 5], &|p| near(p.x, 0.0));
    plate.hold(&[1, 3, 5], &|p| near(p.y, 0.0));
    let rim: &[usize] = if clamped { &[2, 3, 4] } else { &[2] };
    plate.hold(rim, &|p| near(p.x, 0.5) || near(p.y, 0.5));
    plate.hold(&[3], &|p| near(p.x, 0.5));
    plate.hold(&[4], &|p| near(p.y, 0.5));
    plate.press(&|_| Vector3::z());
    plate.answer()[2] * 7e10 * thickness.powi(3) / (12.0 * (1.0 - 0.09))
}

/// No locking: equal deflection at every thickness, down to where rounding begins (1e-5 of the side).
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

/// Mindlin's plate under a sinusoidal pressure deflects by `q/(D k⁴) (1 + D k²/S)`, `k² = 2 π²/a²`: bending and shear in
/// series. With a soft core four fifths of it are shear.
#[test]
fn thick_plates_shear_as_mindlin_says() {
    let ply = isotropic(7e10, 0.3, 0.1);
    let core = Ply { shear: [ply.shear[0], 2e8, 2e8], ..ply };
    for ply in [ply, core] {
        let section = ShellSection::laminate(&[ply], 0.0).unwrap();
        let k2 = 2.0 * PI * PI;
        let D = section.D[(0, 0)];
        let exact = (1.0 + D * k2 / (5.0 / 6.0 * ply.shear[1] * 0.1)) / (D * k2 * k2);
        let mut plate =
            Structure::new(Grid::new(Shape::Quad4, [16, 16], &|x, y| [x, y, 0.0]), section, [1.0, 0.0, 0.0]);
        let edge = |value: f64| value.abs() < 1e-9 || (value - 1.0).abs() < 1e-9;
        plate.hold(&[0, 1], &|_| true);
        plate.hold(&[2, 3], &|p| edge(p.x));
        plate.hold(&[2, 4], &|p| edge(p.y));
        plate.press(&|p| (PI * p.x).sin() * (PI * p.y).sin() * Vector3::z());
        let ratio = plate.answer()[6 * plate.grid.node(8, 8) + 2] / exact;
        assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    }
}
