//! Sizes of the degrees of the reduced equations at the actual spin: optimal order, convergence, nearly equal moments, power.
//! Sizes are maxima over directions, since a degree may vanish at the axis of the actual angular velocity; even and odd degrees have
//! different physics and are compared apart.
//! Equations (R14), docs/theory/03-reduction.md; (V7), (V10) and (V11), docs/theory/04-validity.md.

use crate::math::polynomial::Series;
use crate::math::sphere::directions;
use crate::math::sym3::Sym;
use crate::math::vec3::{add, dot, norm, scale};
use crate::model::{Principal, ReducedBody};

/// Size of one degree of the reduced equations at the actual spin. (R14)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegreeSize {
    /// Degree in `ω`.
    pub degree: usize,
    /// Largest `|f_d|` over the directions of the angular velocity (rad/s²).
    pub size: f64,
}

/// Number of directions over which sizes are taken.
const DIRECTIONS: usize = 400;

/// Size of each degree of `f`, from 2 to `p + 2`, at the length of a spin (rad/s). (R14)
#[must_use]
pub fn degree_sizes(body: &ReducedBody, omega: [f64; 3]) -> Vec<DegreeSize> {
    sizes(&body.f, norm(omega))
}

/// Size of each degree of the rate `f(ω)` at the length of a spin (rad/s).
pub(super) fn sizes(f: &Series, spin: f64) -> Vec<DegreeSize> {
    (2..=f.degree()).map(|degree| DegreeSize { degree, size: size(f, degree, spin) }).collect()
}

/// Optimal order: the one whose dropped terms are smallest, from sizes that reach two degrees beyond every order tried. (R14)
#[must_use]
pub fn optimal_order(sizes: &[DegreeSize]) -> usize {
    let left_out = |p: usize| -> f64 {
        sizes.iter().filter(|size| size.degree == p + 3 || size.degree == p + 4).map(|size| size.size).sum()
    };
    let highest = sizes.last().map_or(0, |size| size.degree).saturating_sub(4).max(1);
    (1..=highest).min_by(|a, b| left_out(*a).total_cmp(&left_out(*b))).unwrap_or(1)
}

/// Ratio of the sizes of two degrees of `Ω(K)`, in units of the spin `w = J⁻¹K`. (V7)
///
/// The directions are those of `K`; `angular_momentum` is the length of `K` (N·m·s).
#[must_use]
pub(super) fn momentum_ratio(Omega: &Series, angular_momentum: f64, [from, to]: [usize; 2]) -> f64 {
    let below = size(Omega, from, angular_momentum);
    if below > 0.0 { size(Omega, to, angular_momentum) / below } else { 0.0 }
}

/// Largest length of one degree of a vector field over the sphere of a radius.
fn size(map: &Series, degree: usize, radius: f64) -> f64 {
    let part = map.part(degree);
    // Coefficients may lie beyond the range where they can be squared, the values do not.
    let values = directions(DIRECTIONS).map(|direction| {
        let mut value = [0.0; 3];
        part.add_value(direction.map(|u| radius * u), &mut value);
        norm(value)
    });
    values.fold(0.0, f64::max)
}

/// Ratio of the elastic torque of degree 4 to that of the rigid body, `max|f₄|/max|f₂|`, at the length of a spin (rad/s). (V10)
///
/// Over the sphere of all directions, and over each circle between two principal axes with the components across it: two
/// moments may be nearly equal where the third is not.
#[must_use]
pub(super) fn levels_ratio(f: &Series, J: Sym, omega: [f64; 3]) -> f64 {
    let spin = norm(omega);
    let Some([rigid, elastic]) = (f.degree() >= 4).then(|| [2, 4].map(|degree| size(f, degree, spin))) else {
        return 0.0;
    };
    let nothing = ROUNDING * spin * spin;
    let ratio = |rigid: f64, elastic: f64| if elastic > nothing { elastic / rigid.max(nothing) } else { 0.0 };
    let principal = Principal::compute(J);
    let axes = principal.axes;
    // Rigid spins in the plane of equal moments are all steady: only motions that start there are bent.
    let distinct = |across: &usize| {
        let [a, b] = [(across + 1) % 3, (across + 2) % 3].map(|i| principal.moments[i]);
        (a - b).abs() > EQUAL * principal.moments[2]
    };
    let circles = (0..3).filter(distinct).map(|across| {
        let [rigid, elastic] = [2, 4].map(|degree| across_size(f, degree, spin, axes, across));
        ratio(rigid, elastic)
    });
    circles.fold(ratio(rigid, elastic), f64::max)
}

/// Relative difference below which two moments are equal.
const EQUAL: f64 = 1e-9;
/// Share of `|ω|²` below which a rate of the spin is rounding.
const ROUNDING: f64 = 1e-13;
/// Number of places on a circle.
const PLACES: usize = 48;

/// Largest component along a principal axis of one degree of a map, over the circle between the two other axes.
fn across_size(map: &Series, degree: usize, radius: f64, axes: [[f64; 3]; 3], across: usize) -> f64 {
    let (first, second) = (axes[(across + 1) % 3], axes[(across + 2) % 3]);
    let component = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / PLACES as f64).sin_cos();
        let mut value = [0.0; 3];
        let place = add(scale(radius * cos, first), scale(radius * sin, second));
        map.part(degree).add_value(place, &mut value);
        dot(value, axes[across]).abs()
    };
    (0..PLACES).map(component).fold(0.0, f64::max)
}

/// Change of the power (W) from a lower to a higher order at the length of a spin (rad/s): largest change over the directions, relative
/// to the largest power; zero where the lower one keeps no power. Odd degrees have no mean along a closed motion and are left out. (V11)
#[must_use]
pub(super) fn power_change(lower: &Series, higher: &Series, omega: [f64; 3]) -> f64 {
    let spin = norm(omega);
    let mean = |power: &Series, u: [f64; 3]| {
        let mut value = [0.0];
        for degree in (2..=power.degree()).step_by(2) {
            power.part(degree).add_value(scale(spin, u), &mut value);
        }
        value[0]
    };
    let (mut change, mut whole) = (0.0_f64, 0.0_f64);
    for u in directions(DIRECTIONS) {
        let [before, after] = [lower, higher].map(|power| mean(power, u));
        change = change.max((after - before).abs());
        whole = whole.max(before.abs());
    }
    if whole > 0.0 { change / whole } else { 0.0 }
}
