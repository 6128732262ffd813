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
const PART_ROUNDING: f64 = 1e-8;
/// Rounding where a coefficient vanishes by symmetry, relative to the size that it may have.
const FLOOR: f64 = 1e-13;

/// Draws a body, and compares its two descriptions.
///
/// # Panics
/// Where the descriptions differ.
pub fn check(u: &mut Unstructured<'_>) {
    let sketch = Sketch::drawn(u);
    let view = View::drawn(u);
    let (before, after) = (built(&sketch.text(&View::default())), built(&sketch.text(&view)));
    let (Some(old), Some(new)) = (&before, &after) else {
        assert_eq!(
            before.is_some(),
            after.is_some(),
            "one description is a body:\n{}\n{}",
            sketch.text(&View::default()),
            sketch.text(&view)
        );
        return;
    };
    let of = |length: i32, mass: i32, time: i32| view.factor([length, mass, time]);
    let momentum = of(2, 1, -1);
    let J = old.J[0].max(old.J[1]).max(old.J[2]);
    vectors("f", [&new.f, &old.f], &view, 1.0, |d| of(0, 0, d - 2));
    vectors("K", [&new.K, &old.K], &view, J, |d| of(2, 1, d - 1));
    vectors("spin of momentum", [&new.Omega, &old.Omega], &view, 1.0 / J, |d| {
        of(0, 0, -1) * momentum.powi(-d)
    });
    vectors("force", [&new.phi, &old.phi], &view, old.mass, |d| of(1, 1, d - 2));
    scalars("energy", [&new.energy, &old.energy], &view, J, |d| of(2, 1, d - 2));
    scalars("power", [&new.power, &old.power], &view, J, |d| of(2, 1, d - 3));
}

fn built(text: &str) -> Option<ReducedBody> {
    let model = Model::parse(Path::new("sketch.toml"), text);
    let model = model.unwrap_or_else(|error| panic!("the sketch is a model: {error}\n{text}"));
    reduce(&model.assembly.body().ok()?, ORDER).ok()
}

/// Compares vector fields degree by degree, at directions seen along the axes of each; `size` is what a coefficient may have in SI units.
fn vectors(name: &str, fields: [&Series; 2], view: &View, size: f64, factor: impl Fn(i32) -> f64) {
    compare(name, fields, view, size, factor, |value| {
        rotation::to_inertial(view.attitude, [value[0], value[1], value[2]]).to_vec()
    });
}

fn scalars(name: &str, fields: [&Series; 2], view: &View, size: f64, factor: impl Fn(i32) -> f64) {
    compare(name, fields, view, size, factor, <[f64]>::to_vec);
}

fn compare(
    name: &str,
    [new, old]: [&Series; 2],
    view: &View,
    size: f64,
    factor: impl Fn(i32) -> f64,
    turned: impl Fn(&[f64]) -> Vec<f64>,
) {
    for degree in 0..=old.degree() {
        let factor = factor(degree as i32);
        let (mut gap, mut scale) = (0.0_f64, 0.0_f64);
        for omega in DIRECTIONS {
            let found = new.part(degree).value(rotation::to_inertial(view.attitude, omega));
            for (found, expected) in found.iter().zip(turned(&old.part(degree).value(omega))) {
                gap = gap.max((found - factor * expected).abs());
                scale = scale.max(factor * expected.abs());
            }
        }
        let allowed = PART_ROUNDING * scale.max(new.part(degree).amax()) + FLOOR * factor * size;
        assert!(gap <= allowed, "{name} of degree {degree} differs by {gap:e} of {scale:e} in {view:?}");
    }
}
