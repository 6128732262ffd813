//! Triangles of simple shapes: boxes, sheets of two parameters, bodies of revolution.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

/// Places and the triangles between them.
pub(crate) type Triangulated = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// Steps around an axis.
const AROUND: usize = 24;
/// Least thickness of a box over its greatest side: a rod has none, and would not be seen.
const THIN: f64 = 0.02;

/// Box with a mass, a centre and an inertia tensor about it; none of a body without extent.
pub(crate) fn cuboid_of(mass: f64, center: Vector3<f64>, second: Matrix3<f64>) -> Option<Triangulated> {
    let eigen = second.symmetric_eigen();
    let half = eigen.eigenvalues.map(|moment| (3.0 * moment.max(0.0) / mass).sqrt());
    let least = THIN * half.amax();
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let axes = eigen.eigenvectors;
    let axes = axes * Matrix3::from_diagonal(&[1.0, 1.0, axes.determinant().signum()].into());
    Some(cuboid(center, axes, half.map(|side| side.max(least))))
}

/// Box with a centre, right-handed axes and half its sides (m).
pub(crate) fn cuboid(center: Vector3<f64>, axes: Matrix3<f64>, half: Vector3<f64>) -> Triangulated {
    let corner = |index: usize| {
        let sign = |axis: usize| if index >> axis & 1 == 0 { -half[axis] } else { half[axis] };
        (center + axes * Vector3::new(sign(0), sign(1), sign(2))).into()
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), halves.collect())
}

/// Ellipsoid with a centre, right-handed axes and semi-axes (m).
pub(crate) fn ellipsoid(center: Vector3<f64>, axes: Matrix3<f64>, semi: Vector3<f64>) -> Triangulated {
    sheet([AROUND, AROUND / 2], [true, false], |around, up| {
        let ((sin, cos), (height, cosine)) = ((TAU * around).sin_cos(), (PI * (up - 0.5)).sin_cos());
        let radius = if up == 0.0 || up == 1.0 { 0.0 } else { cosine };
        center + axes * semi.component_mul(&Vector3::new(radius * cos, radius * sin, height))
    })
}

/// Sheet over a grid of two parameters in [0, 1], of so many steps each; a closed parameter returns to its start.
pub(crate) fn sheet(
    [columns, rows]: [usize; 2],
    [column_closes, row_closes]: [bool; 2],
    place: impl Fn(f64, f64) -> Vector3<f64>,
) -> Triangulated {
    let count = |steps: usize, closes: bool| if closes { steps } else { steps + 1 };
    let [across, down] = [count(columns, column_closes), count(rows, row_closes)];
    let at = |column: usize, row: usize| (row % down) * across + column % across;
    let share = |step: usize, steps: usize| step as f64 / steps as f64;
    let places = (0..down).flat_map(|row| (0..across).map(move |column| (column, row)));
    let places = places.map(|(column, row)| place(share(column, columns), share(row, rows)).into()).collect();
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let halves = cells.flat_map(|(column, row)| {
        let [a, b, c, d] =
            [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
        [[a, b, c], [a, c, d]]
    });
    welded((places, halves.collect()))
}

/// The triangles with one vertex for each place, as at a pole, and without those that have no area.
fn welded((places, triangles): Triangulated) -> Triangulated {
    let mut numbers: HashMap<[u64; 3], usize> = HashMap::new();
    let mut kept: Vec<[f64; 3]> = Vec::new();
    let mut number = |place: &[f64; 3]| {
        let key = place.map(|entry| (entry + 0.0).to_bits());
        *numbers.entry(key).or_insert_with(|| {
            kept.push(*place);
            kept.len() - 1
        })
    };
    let numbers: Vec<usize> = places.iter().map(&mut number).collect();
    let moved = triangles.into_iter().map(|triangle| triangle.map(|vertex| numbers[vertex]));
    let triangles = moved.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    (kept, triangles)
}

/// Body of revolution about the third of some axes: the meridian runs through places of a radius and a height (m), upwards along its outside.
pub(crate) fn revolved(
    center: Vector3<f64>,
    axes: Matrix3<f64>,
    meridian: &[[f64; 2]],
    closes: bool,
) -> Triangulated {
    let rows = if closes { meridian.len() } else { meridian.len() - 1 };
    sheet([AROUND, rows], [true, closes], |around, along| {
        let [radius, height] = meridian[(along * rows as f64).round() as usize % meridian.len()];
        let (sin, cos) = (TAU * around).sin_cos();
        center + axes * Vector3::new(radius * cos, radius * sin, height)
    })
}

/// Axes whose third has a direction.
pub(crate) fn rod(direction: Vector3<f64>) -> Matrix3<f64> {
    let third = direction.normalize();
    let first = Vector3::ith(third.iamin(), 1.0).cross(&third).normalize();
    Matrix3::from_columns(&[first, third.cross(&first), third])
}
