//! The same body along other axes and in other units has the same reduced equations.
//!
//! A body of moderate numbers is drawn and written as two model files: one in SI units along its own axes, one with every vector turned
//! and every number in units of another length, mass and time.

use std::path::Path;

use arbitrary::Unstructured;
use quasirigid::model::ReducedBody;
use quasirigid::reduction::reduce;
use quasirigid_io::model::Model;
use quasirigid_math::polynomial::Series;
use quasirigid_math::rotation;

use super::DIRECTIONS;
use super::sketch::{Sketch, View};

/// Order of the reduction.
const ORDER: usize = 4;
/// Rounding of some thousand operations, grown by the conditions of the inertia tensor and the stiffness of a drawn body.
const ROUNDING: f64 = 1e-8;

/// Draws a body, and compares its two descriptions.
///
/// # Panics
/// Where the descriptions differ.
pub fn check(u: &mut Unstructured<'_>) {
    let sketch = Sketch::drawn(u);
    let view = View::drawn(u);
    let (before, after) = (built(&sketch.text(&View::default())), built(&sketch.text(&view)));
    let (Some(old), Some(new)) = (&before, &after) else {
        assert_eq!(before.is_some(), after.is_some(), "one description is a body:\n{}\n{}", sketch.text(&View::default()), sketch.text(&view));
        return;
    };
    let of = |length: i32, mass: i32, time: i32| view.factor([length, mass, time]);
    let momentum = of(2, 1, -1);
    vectors("f", &new.f, &old.f, &view, |d| of(0, 0, d - 2));
    vectors("K", &new.K, &old.K, &view, |d| of(2, 1, d - 1));
    vectors("spin of momentum", &new.Omega, &old.Omega, &view, |d| of(0, 0, -1) * momentum.powi(-d));
    vectors("force", &new.phi, &old.phi, &view, |d| of(1, 1, d - 2));
    scalars("energy", &new.energy, &old.energy, &view, |d| of(2, 1, d - 2));
    scalars("power", &new.power, &old.power, &view, |d| of(2, 1, d - 3));
}

fn built(text: &str) -> Option<ReducedBody> {
    let model = Model::parse(Path::new("sketch.toml"), text);
    let model = model.unwrap_or_else(|error| panic!("the sketch is a model: {error}\n{text}"));
    reduce(&model.assembly.body().ok()?, ORDER).ok()
}

/// Compares vector fields degree by degree, at directions seen along the axes of each.
fn vectors(name: &str, new: &Series, old: &Series, view: &View, factor: impl Fn(i32) -> f64) {
    compare(name, new, old, view, |degree, value| {
        rotation::to_inertial(view.attitude, [value[0], value[1], value[2]]).map(|x| factor(degree) * x).to_vec()
    });
}

fn scalars(name: &str, new: &Series, old: &Series, view: &View, factor: impl Fn(i32) -> f64) {
    compare(name, new, old, view, |degree, value| vec![factor(degree) * value[0]]);
}

fn compare(name: &str, new: &Series, old: &Series, view: &View, seen: impl Fn(i32, Vec<f64>) -> Vec<f64>) {
    for degree in 0..=old.degree() {
        let pairs = DIRECTIONS.map(|omega| {
            let turned = rotation::to_inertial(view.attitude, omega);
            (new.part(degree).value(turned), seen(degree as i32, old.part(degree).value(omega)))
        });
        let scale = pairs.iter().flat_map(|(_, expected)| expected).fold(0.0, |size: f64, x| size.max(x.abs()));
        let gap = pairs.iter().flat_map(|(found, expected)| found.iter().zip(expected).map(|(a, b)| (a - b).abs()));
        let gap = gap.fold(0.0, f64::max);
        let floor = ROUNDING * new.part(degree).amax().max(scale);
        assert!(gap <= floor, "{name} of degree {degree} differs by {gap:e} of {scale:e} in {view:?}");
    }
}
