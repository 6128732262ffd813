//! Simply supported laminates under a sinusoidal pressure, against Navier's solution of classical lamination theory
//! `[@reddy2004]`.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::super::{Ply, ShellSection};
use super::grid::{Grid, SHAPES, name};
use super::structure::Structure;
use quasirigid_mesh::Shape;

const SIDES: [f64; 2] = [1.0, 0.8];

fn section(angles: &[f64]) -> ShellSection {
    let ply = |angle: &f64| Ply {
        young: [175e9, 7e9],
        poisson: 0.25,
        shear: [3.5e9, 3.5e9, 1.4e9],
        density: 1500.0,
        thickness: 1e-3 / angles.len() as f64,
        angle: angle.to_radians(),
    };
    let plies: Vec<Ply> = angles.iter().map(ply).collect();
    ShellSection::laminate(&plies, 0.0).unwrap()
}

/// Amplitudes of the displacement under a unit pressure in the middle. Layers across (`cross`) move as `cos sin`,
/// `sin cos` in the plane, those at opposite angles as `sin cos`, `cos sin`.
fn navier(section: &ShellSection, cross: bool) -> Vector3<f64> {
    let ShellSection { A, B, D, .. } = section;
    let [a, b] = SIDES.map(|side| PI / side);
    let coupling = if cross {
        let both = B[(0, 1)] + 2.0 * B[(2, 2)];
        [-(B[(0, 0)] * a.powi(3) + both * a * b * b), -(both * a * a * b + B[(1, 1)] * b.powi(3))]
    } else {
        let (B16, B26) = (B[(0, 2)], B[(1, 2)]);
        [-(3.0 * B16 * a * a * b + B26 * b.powi(3)), -(B16 * a.powi(3) + 3.0 * B26 * a * b * b)]
    };
    let mixed = (A[(0, 1)] + A[(2, 2)]) * a * b;
    let bending =
        D[(0, 0)] * a.powi(4) + 2.0 * (D[(0, 1)] + 2.0 * D[(2, 2)]) * (a * b).powi(2) + D[(1, 1)] * b.powi(4);
    let operator = Matrix3::new(
        A[(0, 0)] * a * a + A[(2, 2)] * b * b,
        mixed,
        coupling[0],
        mixed,
        A[(2, 2)] * a * a + A[(1, 1)] * b * b,
        coupling[1],
        coupling[0],
        coupling[1],
        bending,
    );
    operator.lu().solve(&Vector3::z()).unwrap()
}

/// Amplitudes of the displacement under a unit pressure in the middle, by elements.
fn found(section: ShellSection, cross: bool, shape: Shape, n: usize) -> Vector3<f64> {
    let grid = Grid::new(shape, [n, n], &|x, y| [SIDES[0] * x, SIDES[1] * y, 0.0]);
    let mut plate = Structure::new(grid, section, [1.0, 0.0, 0.0]);
    let edge = |value: f64, side: f64| value.abs() < 1e-9 || (value - side).abs() < 1e-9;
    let (held_x, held_y) = if cross { (1, 0) } else { (0, 1) };
    plate.hold(&[held_x, 2, 3], &|p| edge(p.x, SIDES[0]));
    plate.hold(&[held_y, 2, 4], &|p| edge(p.y, SIDES[1]));
    plate.press(&|p| (PI * p.x / SIDES[0]).sin() * (PI * p.y / SIDES[1]).sin() * Vector3::z());
    let answer = plate.answer();
    // where cos sin, sin cos and sin sin are ±1
    let [along_x, along_y] = if cross { [[0, n / 2], [n / 2, 0]] } else { [[n / 2, 0], [0, n / 2]] };
    let at = |[column, row]: [usize; 2], axis: usize| answer[6 * plate.grid.node(column, row) + axis];
    Vector3::new(at(along_x, 0), at(along_y, 1), at([n / 2, n / 2], 2))
}

#[test]
fn laminates_bend_as_navier_says() {
    let cases: [(&str, &[f64], bool); 4] = [
        ("cross-ply 0/90/0", &[0.0, 90.0, 0.0], true),
        ("unsymmetric 0/90", &[0.0, 90.0], true),
        ("angle-ply 45/-45", &[45.0, -45.0], false),
        ("angle-ply 30/-30/30/-30", &[30.0, -30.0, 30.0, -30.0], false),
    ];
    for (case, angles, cross) in cases {
        let section = section(angles);
        let exact = navier(&section, cross);
        assert_eq!(section.B.amax() > 1e-6 * section.A.amax() * 1e-3, angles.len() % 2 == 0);
        for shape in SHAPES {
            let errors =
                [8, 16].map(|n| (found(section, cross, shape, n) - exact).component_div(&exact.abs()));
            let deflection = errors.map(|error| error.z);
            println!("{case:24} {:9}: {:.4?}", name(shape), deflection);
            assert!(deflection[1].abs() < 0.01);
            if angles.len() == 2 {
                println!("    in the plane {:.4?} of {:.3e}", errors[1].xy(), exact.xy());
                assert!(errors[1].xy().amax() < 0.02, "{}", errors[1]);
            }
        }
    }
}
