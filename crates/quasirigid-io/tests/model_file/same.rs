//! Comparison of the bodies of two model files, by quantities that do not depend on their coordinates.

use quasirigid::model::{FlexibleBody, ReducedBody};
use quasirigid::reduction::{frequencies, reduce};
use quasirigid_io::model::Model;
use quasirigid_math::polynomial::{Homogeneous, Series};

/// Vibrations that are compared, the lowest; those of a few coordinates depend on rounding at the other end.
const LOWEST: usize = 6;

/// Fails unless two bodies and their reduced equations are the same to a relative tolerance.
pub fn assert_same(found: &Model, expected: &Model, tolerance: f64) {
    for (name, difference) in differences(found, expected) {
        assert!(difference <= tolerance, "{name}: {difference:e}");
    }
}

/// Relative differences of two bodies and of their reduced equations, degree by degree, with their names.
pub fn differences(found: &Model, expected: &Model) -> Vec<(String, f64)> {
    let [(body, reduced), (other_body, other)] = [found, expected].map(reduction);
    let mut differences = vec![
        ("mass".to_owned(), difference(&[reduced.mass], &[other.mass])),
        ("centre of mass".to_owned(), difference(&body.center_of_mass(), &other_body.center_of_mass())),
        ("inertia".to_owned(), difference(&reduced.J, &other.J)),
        ("frequencies".to_owned(), difference(&lowest(&body), &lowest(&other_body))),
    ];
    let mut add = |name: &str, found: &Series, expected: &Series, from: usize| {
        for degree in from..=expected.degree() {
            let error = difference(&coefficients(found.part(degree)), &coefficients(expected.part(degree)));
            differences.push((format!("{name} of degree {degree}"), error));
        }
    };
    add("spin rate", &reduced.f, &other.f, 2);
    add("momentum", &reduced.K, &other.K, 1);
    add("energy", &reduced.energy, &other.energy, 2);
    add("power", &reduced.power, &other.power, 6);
    differences
}

fn reduction(model: &Model) -> (FlexibleBody, ReducedBody) {
    let body = model.assembly.body().unwrap_or_else(|error| panic!("{}", model.diagnose(&error)));
    let reduced = reduce(&body, 3).expect("a reduced body");
    (body, reduced)
}

fn lowest(body: &FlexibleBody) -> Vec<f64> {
    let mut all = frequencies(body).expect("frequencies");
    all.truncate(LOWEST);
    all
}

fn coefficients(part: &Homogeneous) -> Vec<f64> {
    part.terms().flat_map(|(_, coefficients)| coefficients).collect()
}

/// Largest difference of two lists over the largest entry of the second.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let off = found.iter().zip(expected).map(|(x, y)| (x - y).abs());
    let off = off.fold(0.0, |most: f64, x| if x > most || x.is_nan() { x } else { most });
    if size > 0.0 { off / size } else { off }
}
