//! Comparison of series degree by degree, each relative to the largest value of its degree on the unit sphere.

use nalgebra::{Matrix3, Vector3};
use quasirigid::model::{FlexibleBody, ReducedBody};
use quasirigid_math::polynomial::{Homogeneous, Series};

/// Directions at which polynomials are compared: more than the 55 monomials of degree nine need.
const DIRECTIONS: u32 = 61;

/// Unit vectors spread over the sphere.
pub fn directions() -> impl Iterator<Item = [f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..DIRECTIONS).map(move |i| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(DIRECTIONS);
        let (sin, cos) = (golden * f64::from(i) + 0.3).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        [radius * cos, radius * sin, z]
    })
}

/// Value of one degree.
pub fn value(part: &Homogeneous, x: [f64; 3]) -> Vec<f64> {
    let mut value = vec![0.0; part.rows()];
    part.add_value(x, &mut value);
    value
}

/// Largest value of one degree on the unit sphere.
pub fn size(part: &Homogeneous) -> f64 {
    directions().flat_map(|u| value(part, u)).fold(0.0, |size, x| size.max(x.abs()))
}

/// Largest difference between two functions of degree and direction, relative to the largest value of the degree; the
/// worst of the degrees. Infinite if anything is not a number.
pub fn difference(
    degrees: impl IntoIterator<Item = usize>,
    found: impl Fn(usize, [f64; 3]) -> Vec<f64>,
    expected: impl Fn(usize, [f64; 3]) -> Vec<f64>,
) -> f64 {
    let mut worst: f64 = 0.0;
    for degree in degrees {
        let (mut gap, mut size): (f64, f64) = (0.0, 0.0);
        for u in directions() {
            let (left, right) = (found(degree, u), expected(degree, u));
            assert_eq!(left.len(), right.len(), "rows of degree {degree}");
            for (a, b) in left.iter().zip(&right) {
                if !(a - b).is_finite() {
                    return f64::INFINITY;
                }
                gap = gap.max((a - b).abs());
                size = size.max(a.abs()).max(b.abs());
            }
        }
        if size > 0.0 {
            worst = worst.max(gap / size);
        }
    }
    worst
}

/// [`difference`] of two series.
pub fn gap(found: &Series, expected: &Series) -> f64 {
    assert_eq!(found.degree(), expected.degree());
    scaled_gap(found, expected, |_| 1.0)
}

/// [`difference`] of a series from another one whose degrees are multiplied by numbers.
pub fn scaled_gap(found: &Series, expected: &Series, factor: impl Fn(i32) -> f64) -> f64 {
    let scaled = |d: usize, u: [f64; 3]| -> Vec<f64> {
        let factor = factor(d as i32);
        value(expected.part(d), u).iter().map(|x| factor * x).collect()
    };
    let degrees = found.degree().min(expected.degree());
    difference(0..=degrees, |d, u| value(found.part(d), u), scaled)
}

/// Largest difference of two lists of numbers, relative to the largest number.
pub fn list_gap(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let gaps = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / size);
    gaps.fold(0.0, |worst, gap| {
        if gap <= worst {
            worst
        } else if gap.is_nan() {
            f64::INFINITY
        } else {
            gap
        }
    })
}

/// Worst difference of two bodies in quantities that do not depend on the choice of coordinates: `J`, `f`, `K`, `Ω`, energy in both
/// variables, power and force on the pole.
pub fn motion_gap(found: &ReducedBody, expected: &ReducedBody) -> f64 {
    [
        list_gap(&found.J, &expected.J),
        gap(&found.f, &expected.f),
        gap(&found.K, &expected.K),
        gap(&found.Omega, &expected.Omega),
        gap(&found.energy, &expected.energy),
        gap(&found.energy_of_momentum, &expected.energy_of_momentum),
        gap(&found.power, &expected.power),
        gap(&found.phi, &expected.phi),
    ]
    .into_iter()
    .fold(0.0, f64::max)
}

/// Displacements of the points at one degree of `q`, in the order of the points; they do not depend on the directions
/// chosen for the coordinates.
pub fn displacements(body: &FlexibleBody, q: &[f64], turn: &Matrix3<f64>) -> Vec<f64> {
    let metric = |j: usize| body.coordinates()[j].unit == "m";
    let points = body.markers().iter().filter(|marker| marker.shapes.iter().all(|(j, _)| metric(*j)));
    points
        .flat_map(|marker| {
            let r: Vector3<f64> = marker.shapes.iter().map(|(j, H)| q[*j] * Vector3::from(*H)).sum();
            let turned: [f64; 3] = (turn * r).into();
            turned
        })
        .collect()
}

/// Hinge angles among the coordinates.
pub fn angles(body: &FlexibleBody, q: &[f64]) -> Vec<f64> {
    let angle = body.coordinates().iter().map(|coordinate| coordinate.unit == "rad");
    angle.zip(q).filter(|(angle, _)| *angle).map(|(_, q)| *q).collect()
}
