//! Solids inside closed surfaces: polynomials without a mesh.

use nalgebra::{Rotation3, Vector3};
use quasirigid::averaging::{FreeRotation, MeanPower, PolynomialPower, Response};
use quasirigid::elements::{
    Approximation, Assembly, ElementKind, Ellipsoid, Field, Material, Problem, Surface,
};
use quasirigid::model::{FlexibleBody, Mode, Rheology};
use quasirigid::reduction::reduce;
use quasirigid_mesh::surface::ClosedSurface;

fn rock() -> Material {
    Material { density: 3.0, young: 7e3, poisson: 0.2, rheology: Rheology::KelvinVoigt { time: 0.01 } }
}

/// An octahedron whose triangles are cut in four so many times, its vertices on the unit sphere.
fn sphere(cuts: usize) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let mut vertices: Vec<Vector3<f64>> =
        (0..3).flat_map(|axis| [1.0, -1.0].map(|sign| sign * Vector3::ith(axis, 1.0))).collect();
    let mut triangles = Vec::new();
    for [x, y, z] in [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    {
        triangles.push([x, y, z]);
    }
    for _ in 0..cuts {
        let mut middles = std::collections::HashMap::new();
        let mut finer = Vec::new();
        for [a, b, c] in triangles {
            let mut middle = |i: usize, j: usize| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    vertices.push((vertices[i] + vertices[j]).normalize());
                    vertices.len() - 1
                })
            };
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    (vertices.into_iter().map(Into::into).collect(), triangles)
}

fn solid(vertices: Vec<[f64; 3]>, triangles: Vec<[usize; 3]>, degree: Option<usize>) -> FlexibleBody {
    body(Surface {
        name: "rock".into(),
        surface: ClosedSurface::new(vertices, triangles).unwrap(),
        material: rock(),
        degree,
        cells: None,
    })
}

fn body(surface: Surface) -> FlexibleBody {
    Assembly { surfaces: vec![surface], ..Assembly::default() }.body().unwrap()
}

const AXES: [f64; 3] = [1.4, 1.0, 0.7];

fn stretched([x, y, z]: [f64; 3]) -> [f64; 3] {
    [AXES[0] * x + 2.0, AXES[1] * y - 1.0, AXES[2] * z + 0.5]
}

fn power(body: &FlexibleBody) -> f64 {
    let response = Response::compute(body).unwrap();
    let [I1, .., I3] = response.moments();
    let motion = FreeRotation::at_logit(response.moments(), 0.3 * I3, Mode::ShortAxis, 0.4);
    assert!(I1 > 0.0);
    response.mean_power(&motion)
}

/// Facets cut corners: their error falls with the square of their size, towards the ellipsoid itself.
#[test]
fn faceted_ellipsoid_converges_to_the_ellipsoid() {
    let exact =
        Ellipsoid { name: "rock".into(), semi_axes: AXES, center: [2.0, -1.0, 0.5], material: rock() };
    let exact = Assembly { ellipsoids: vec![exact], ..Assembly::default() }.body().unwrap();
    let errors = [2, 3, 4].map(|cuts| {
        let (vertices, triangles) = sphere(cuts);
        let faceted = solid(vertices.into_iter().map(stretched).collect(), triangles, Some(5));
        (0..3).for_each(|i| assert!((faceted.center_of_mass()[i] - [2.0, -1.0, 0.5][i]).abs() < 1e-12));
        [power(&faceted) / power(&exact) - 1.0, faceted.invariants().J[2] / exact.invariants().J[2] - 1.0]
    });
    for quantity in 0..2 {
        let order = (errors[1][quantity] / errors[2][quantity]).log2();
        println!("{errors:?} order {order}");
        assert!((order - 2.0).abs() < 0.05 && errors[2][quantity].abs() < 0.05, "{errors:?}");
    }
}

/// A brick: axes rotated, corners renumbered, units changed, and the same power.
#[test]
fn power_does_not_know_axes_or_units() {
    let corners: Vec<Vector3<f64>> = (0..8)
        .map(|i| Vector3::new(f64::from(i & 1), f64::from(i >> 1 & 1) * 0.8, f64::from(i >> 2 & 1) * 0.5))
        .collect();
    let triangles = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    let turn = Rotation3::from_euler_angles(0.4, -1.1, 2.3);
    let straight = solid(corners.iter().map(|corner| (*corner).into()).collect(), triangles.clone(), Some(7));
    let turned = solid(
        corners.iter().map(|corner| (turn * corner + Vector3::new(5.0, 4.0, -3.0)).into()).collect(),
        triangles.iter().map(|[a, b, c]| [*b, *c, *a]).collect(),
        Some(7),
    );
    let (one, other) = (power(&straight), power(&turned));
    assert!((one / other - 1.0).abs() < 1e-8, "{one} {other}");
    // The reduced equations, at low frequency, take the same power from the same body.
    let polynomial = PolynomialPower::from_reduced(&reduce(&straight, 3).unwrap());
    let response = Response::compute(&straight).unwrap();
    let motion =
        FreeRotation::at_logit(response.moments(), 1e-3 * response.moments()[2], Mode::LongAxis, 0.4);
    let ratio = response.mean_power(&motion) / polynomial.mean_power(&motion);
    assert!((ratio - 1.0).abs() < 1e-6, "{ratio}");
}

/// Each degree adds to the compliance, ever less, and the default choice stops where the compliance has converged.
#[test]
fn degrees_are_raised_until_the_compliance_has_converged() {
    let (vertices, triangles) = sphere(2);
    let lump = |[x, y, z]: [f64; 3]| {
        let bump = 1.0 + 0.25 * (3.0 * x + 1.0).sin() * (2.0 * y).cos() + 0.1 * z * z * z;
        [1.3 * bump * x, bump * y, 0.8 * bump * z]
    };
    let surface = ClosedSurface::new(vertices.into_iter().map(lump).collect(), triangles).unwrap();
    let lumpy = |degree| Surface {
        name: "lump".into(),
        surface: surface.clone(),
        material: rock(),
        degree,
        cells: None,
    };
    let powers = [2, 4, 6, 8, 10].map(|degree| power(&body(lumpy(Some(degree)))));
    println!("{powers:?}");
    assert!(
        powers.is_sorted_by(|a, b| a < b),
        "a Ritz method approaches the compliance from below: {powers:?}"
    );
    let left = Assembly { surfaces: vec![lumpy(None)], ..Assembly::default() }.build().unwrap();
    let resolution = left.resolution.unwrap();
    println!("{resolution:?}");
    assert!(
        matches!(resolution.approximation, Approximation::Polynomials { degree } if degree < 12),
        "{resolution:?}"
    );
    assert!(resolution.error < 0.03 && (power(&left.body) / powers[4] - 1.0).abs() < resolution.error);
}

#[test]
fn a_degree_that_is_not_offered_is_refused() {
    let (vertices, triangles) = sphere(1);
    let surface = ClosedSurface::new(vertices, triangles).unwrap();
    for degree in [0, 13] {
        let surface = Surface {
            name: "rock".into(),
            surface: surface.clone(),
            material: rock(),
            degree: Some(degree),
            cells: None,
        };
        let error = Assembly { surfaces: vec![surface], ..Assembly::default() }.body().unwrap_err();
        assert_eq!((error.element, error.field), (ElementKind::Surface.at(0), Field::DEGREE));
        assert!(matches!(error.problem, Problem::Degree { .. }), "{error}");
    }
}
