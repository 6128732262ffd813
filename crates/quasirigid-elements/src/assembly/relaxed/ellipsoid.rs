//! Relaxed ellipsoid: semi-axes and density at which the body in rotation has the semi-axes, or the moments, given.

use super::{ObservedShape, displaced, small};
use crate::error::{ElementError, ElementKind, Field, Problem, at};
use crate::math::sym3::Sym;
use crate::model::FlexibleBody;
use crate::{Assembly, Ellipsoid};

/// Steps of the search, each smaller than the one before by the strain.
const MOST_STEPS: usize = 60;
/// Relative change of the semi-axes that is rounding, and that which is accepted where rounding hides it.
const ROUNDING: f64 = f64::EPSILON;
const STALLED: f64 = 1e-12;
/// Products of the spin about two axes, relative to its square, from which it is aslant.
const ASLANT: f64 = 1e-9;

/// The ellipsoid without its spin, and the inertia tensor of that in rotation. (G18)
pub(super) fn relaxed<E: From<ElementError>>(
    given: &Ellipsoid,
    shape: ObservedShape,
    products: &impl Fn([Sym; 2]) -> Result<Sym, E>,
) -> Result<(Ellipsoid, Sym), E> {
    let place = ElementKind::Ellipsoid.at(0);
    let body = body_of(given)?;
    let (mass, mut inertia) = (body.invariants().mass, body.invariants().J);
    let wanted = given.semi_axes;
    let (mut found, mut last) = (given.clone(), f64::INFINITY);
    for _ in 0..MOST_STEPS {
        let body = body_of(&found)?;
        let spun = Spun::of(&body, along_axes(products([body.invariants().J, inertia])?)?)?;
        inertia = spun.inertia;
        let next = match shape {
            ObservedShape::Surface => [0, 1, 2].map(|i| wanted[i] - spun.growth[i]),
            ObservedShape::Moments => [0, 1, 2].map(|i| {
                let square = 5.0 * (0.5 * (inertia[0] + inertia[1] + inertia[2]) - inertia[i]) / mass;
                (found.semi_axes[i].powi(2) + wanted[i].powi(2) - square).sqrt()
            }),
        };
        let most =
            |from: [f64; 3]| (0..3).fold(0.0, |most: f64, i| most.max((next[i] / from[i] - 1.0).abs()));
        let finite = next.iter().all(|axis| *axis > 0.0);
        small(if finite { most(wanted) } else { f64::NAN }, place)?;
        let change = most(found.semi_axes);
        if change <= ROUNDING || (change >= last && change <= STALLED) {
            return Ok((found, inertia));
        }
        (found, last) = (with_axes(given, next), change);
    }
    Err(at(place, Field::SHAPE)(Problem::TooSoft { strain: f64::NAN }).into())
}

/// What a rotation makes of an ellipsoid.
struct Spun {
    /// Growth of the semi-axes (m).
    growth: [f64; 3],
    inertia: Sym,
}

impl Spun {
    fn of(body: &FlexibleBody, products: Sym) -> Result<Self, ElementError> {
        let q = displaced(body, products, ElementKind::Ellipsoid.at(0))?;
        let mut growth = [0.0; 3];
        for (axis, tip) in body.markers().iter().enumerate().take(3) {
            growth[axis] = tip.displacement(&q)[axis];
        }
        let [xx, yy, zz, ..] = body.full_inertia_at(&q);
        Ok(Self { growth, inertia: [xx, yy, zz, 0.0, 0.0, 0.0] })
    }
}

fn body_of(ellipsoid: &Ellipsoid) -> Result<FlexibleBody, ElementError> {
    Assembly { ellipsoids: vec![ellipsoid.clone()], ..Assembly::default() }.body()
}

/// The ellipsoid with other semi-axes (m), of the same mass.
fn with_axes(given: &Ellipsoid, semi_axes: [f64; 3]) -> Ellipsoid {
    let grown: f64 = (0..3).map(|i| semi_axes[i] / given.semi_axes[i]).product();
    let mut found = Ellipsoid { semi_axes, ..given.clone() };
    found.material.density /= grown;
    found
}

/// Products of a spin along the axes of the ellipsoid. Aslant, which a body with three equal moments alone can keep, it leaves none with
/// these axes.
fn along_axes(products: Sym) -> Result<Sym, ElementError> {
    let [xx, yy, zz, yz, zx, xy] = products;
    if [yz, zx, xy].iter().any(|product| product.abs() > ASLANT * (xx + yy + zz)) {
        return Err(at(ElementKind::Ellipsoid.at(0), Field::SHAPE)(Problem::Aslant));
    }
    Ok([xx, yy, zz, 0.0, 0.0, 0.0])
}
