//! Matrices of single distorted cells beside those of CalculiX 2.20.
//!
//! The input has the nodes of [`nodes`] with six decimals, `*ELASTIC` 3, 0.3 and `*DENSITY` 2.5; `*FREQUENCY, SOLVER=MATRIXSTORAGE` writes
//! the matrices with 14 digits. `calculix.csv` has their products with the vectors of [`pattern`], in which every entry takes part. CalculiX
//! integrates the mass by the points of the stiffness, which is not exact; ours is, so the rule is named. Its C3D8 has no displacements of
//! its own, its C3D20 no smoothed dilatation, and its C3D6 two points, which leave one motion more than the rigid ones free of strain.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::finite::elasticity::isotropic;
use crate::finite::solid::slopes::Slopes;
use crate::finite::solid::{mass, stiffness};
use quasirigid_mesh::{Rule, Shape};

/// A line for each cell and product: its name, `stiffness` or `mass` of one component, and the entries.
const PRODUCTS: &str = include_str!("calculix.csv");
const CELLS: [(&str, Shape); 7] = [
    ("C3D4", Shape::Tet4),
    ("C3D10", Shape::Tet10),
    ("C3D6", Shape::Wedge6),
    ("C3D15", Shape::Wedge15),
    ("C3D8", Shape::Hex8),
    ("C3D20", Shape::Hex20),
    ("C3D20R", Shape::Hex20),
];

fn product(cell: &str, matrix: &str) -> DVector<f64> {
    let head = format!("{cell},{matrix},");
    let line = PRODUCTS.lines().find_map(|line| line.strip_prefix(&head)).unwrap();
    DVector::from_vec(line.split(',').map(|entry| entry.parse().unwrap()).collect())
}

/// The reference cell sheared, off the origin, every node moved a little.
fn nodes(shape: Shape) -> Vec<Vector3<f64>> {
    let place = |(node, [x, y, z]): (usize, [f64; 3])| {
        let away = Vector3::from_fn(|axis, _| 0.06 * (3.7 * node as f64 + 1.9 * axis as f64).sin());
        let sheared = Vector3::new(1.3 * x + 0.2 * y, 0.8 * y + 0.1 * z, 0.6 * z - 0.1 * x);
        (sheared + away + Vector3::new(4.0, -3.0, 2.0)).map(|x| (1e6 * x).round() / 1e6)
    };
    shape.reference().into_iter().enumerate().map(place).collect()
}

/// Seven whole numbers over and over.
fn pattern(size: usize, from: f64) -> DVector<f64> {
    DVector::from_fn(size, |row, _| (5 * row % 7) as f64 + from)
}

/// Our stiffness with the points and the strains of CalculiX.
fn plain(shape: Shape, rule: Rule) -> DMatrix<f64> {
    let D = isotropic(3.0, 0.3).unwrap();
    let Slopes { gradients, volumes, .. } = Slopes::new(shape, &nodes(shape), rule);
    let gradients = gradients.rows(0, 3 * shape.nodes()).into_owned();
    stiffness::full(&Slopes { gradients, volumes, dilatation: None }, &D)
}

#[test]
fn stiffness_and_mass_are_those_of_calculix() {
    for (name, shape) in CELLS {
        let rule = if matches!(name, "C3D20R" | "C3D6") { Rule::Reduced } else { Rule::Slopes };
        let close = |found: DVector<f64>, matrix: &str| {
            let error = (&found - product(name, matrix)).amax() / found.amax();
            assert!(error < 1e-11, "{name}: {error:e}"); // 13 digits are known, of sums that nearly cancel
        };
        close(plain(shape, rule) * pattern(3 * shape.nodes(), -3.0), "stiffness");
        let mass = mass::by_rule(shape, &nodes(shape), 2.5, rule);
        close(mass * pattern(shape.nodes(), -2.0), "mass");
    }
}

/// Cells without additional strains: the stiffness in use is CalculiX's own.
#[test]
fn plain_cells_are_used_as_they_are() {
    let D = isotropic(3.0, 0.3).unwrap();
    for shape in [Shape::Tet4, Shape::Tet10, Shape::Wedge15] {
        let K = stiffness::stiffness(shape, &nodes(shape), &D);
        assert_eq!(K, plain(shape, Rule::Slopes), "{shape}");
    }
}
