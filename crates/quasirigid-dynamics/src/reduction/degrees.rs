//! Sizes of the degrees of the reduced equations at the actual spin: optimal order, convergence, nearly equal moments, power.
//! Sizes are maxima over directions, since a degree may vanish at the axis of the actual angular velocity; even and odd degrees have
//! different physics and are compared apart.
//! Equations (R14), docs/theory/03-reduction.md; (V7), (V10) and (V11), docs/theory/04-validity.md.

use crate::math::polynomial::Series;
use crate::math::sphere::{directions, greatest};
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
    let spin = norm(omega);
    (2..=body.f.degree()).map(|degree| DegreeSize { degree, size: size(&body.f, degree, spin) }).collect()
}

/// Sizes of the degrees of a vector field at a radius, from which those at any other follow by powers. Parts with a constant, as of a wheel,
/// are measured anew.
#[derive(Clone, Debug)]
pub(super) struct Sizes {
    map: Series,
    radius: f64,
    at_radius: Vec<f64>,
}

impl Sizes {
    /// Measures the degrees at a radius where they lie in the range of numbers.
    pub fn new(map: Series, radius: f64) -> Self {
        let at_radius = (0..=map.degree()).map(|degree| size(&map, degree, radius)).collect();
        Self { map, radius, at_radius }
    }

    /// Largest length of one degree over the sphere of a radius.
    pub fn of(&self, degree: usize, radius: f64) -> f64 {
        if self.map.part(degree).is_pure() {
            self.at_radius[degree] * (radius / self.radius).powi(degree as i32)
        } else {
            size(&self.map, degree, radius)
        }
    }

    /// Size of each degree from 2 on.
    pub fn degrees(&self, radius: f64) -> Vec<DegreeSize> {
        (2..=self.map.degree()).map(|degree| DegreeSize { degree, size: self.of(degree, radius) }).collect()
    }
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
pub(super) fn momentum_ratio(Omega: &Sizes, angular_momentum: f64, [from, to]: [usize; 2]) -> f64 {
    let below = Omega.of(from, angular_momentum);
    if below > 0.0 { Omega.of(to, angular_momentum) / below } else { 0.0 }
}

/// Largest length of one degree of a vector field over the sphere of a radius.
fn size(map: &Series, degree: usize, radius: f64) -> f64 {
    let part = map.part(degree);
    // Coefficients may lie beyond the range where they can be squared, the values do not.
    greatest(DIRECTIONS, |direction| {
        let mut value = [0.0; 3];
        part.add_value(direction.map(|u| radius * u), &mut value);
        norm(value)
    })
}

/// Sizes of the rigid torque and of the elastic one of degree 4 on circles between two principal axes, with the components across them: two
/// moments may be nearly equal where the third is not.
#[derive(Clone, Debug)]
pub(super) struct Circles {
    radius: f64,
    /// Axes, and the number of the one across each circle. Rigid spins in the plane of equal moments are all steady: only motions that start
    /// there are bent.
    axes: [[f64; 3]; 3],
    across: Vec<usize>,
    at_radius: Vec<[f64; 2]>,
}

/// Degrees of the rigid torque and of the elastic one that bends the levels.
const BENDING: [usize; 2] = [2, 4];

impl Circles {
    /// Measures the torques of a body with a rate `f(ω)` and an inertia tensor.
    pub fn new(f: &Series, J: Sym, radius: f64) -> Self {
        let Principal { moments, axes } = Principal::compute(J);
        let distinct = |across: &usize| {
            let [a, b] = [(across + 1) % 3, (across + 2) % 3].map(|i| moments[i]);
            (a - b).abs() > EQUAL * moments[2]
        };
        let across: Vec<usize> = (0..3).filter(distinct).collect();
        let sizes = |across: &usize| BENDING.map(|degree| across_size(f, degree, radius, axes, *across));
        let at_radius = if f.degree() >= 4 { across.iter().map(sizes).collect() } else { Vec::new() };
        Self { radius, axes, across, at_radius }
    }

    fn of(&self, f: &Series, circle: usize, spin: f64) -> [f64; 2] {
        let scaled = |i: usize| {
            let degree = BENDING[i];
            if f.part(degree).is_pure() {
                self.at_radius[circle][i] * (spin / self.radius).powi(degree as i32)
            } else {
                across_size(f, degree, spin, self.axes, self.across[circle])
            }
        };
        [scaled(0), scaled(1)]
    }
}

/// Ratio of the elastic torque of degree 4 to that of the rigid body, `max|f₄|/max|f₂|`, at the length of a spin (rad/s), over the sphere of
/// all directions and over the circles. (V10)
#[must_use]
pub(super) fn levels_ratio(f: &Sizes, circles: &Circles, spin: f64) -> f64 {
    if f.map.degree() < 4 {
        return 0.0;
    }
    let nothing = RATE_ROUNDING * spin * spin;
    let ratio =
        |[rigid, elastic]: [f64; 2]| if elastic > nothing { elastic / rigid.max(nothing) } else { 0.0 };
    let on_circles = (0..circles.across.len()).map(|circle| ratio(circles.of(&f.map, circle, spin)));
    on_circles.fold(ratio(BENDING.map(|degree| f.of(degree, spin))), f64::max)
}

/// Relative difference below which two moments are equal.
const EQUAL: f64 = 1e-9;
/// Share of `|ω|²` below which a rate of the spin is rounding.
const RATE_ROUNDING: f64 = 1e-13;
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

/// Powers (W) of a lower and a higher order over the directions, degree by degree at a radius.
#[derive(Clone, Debug)]
pub(super) struct PowerChange {
    powers: [Series; 2],
    radius: f64,
    /// For each direction the even degrees of either power from 2 on; empty where a part has a constant.
    at_radius: Vec<[Vec<f64>; 2]>,
}

impl PowerChange {
    /// Measures the powers at a radius where they lie in the range of numbers.
    pub fn new(lower: Series, higher: Series, radius: f64) -> Self {
        let powers = [lower, higher];
        let pure = powers.iter().all(|power| (2..=power.degree()).all(|degree| power.part(degree).is_pure()));
        let values = |u: [f64; 3]| powers.each_ref().map(|power| even(power, scale(radius, u)).collect());
        let at_radius = if pure { directions(DIRECTIONS).map(values).collect() } else { Vec::new() };
        Self { powers, radius, at_radius }
    }

    /// Change from the lower to the higher order at the length of a spin (rad/s): largest change over the directions, relative to the largest
    /// power; zero where the lower one keeps no power. Odd degrees have no mean along a closed motion and are left out. (V11)
    pub fn at(&self, spin: f64) -> f64 {
        let (mut change, mut whole) = (0.0_f64, 0.0_f64);
        let mut take = |before: f64, after: f64| {
            change = change.max((after - before).abs());
            whole = whole.max(before.abs());
        };
        let square = (spin / self.radius).powi(2);
        let scaled = |values: &Vec<f64>| values.iter().rev().fold(0.0, |sum, value| (sum + value) * square);
        self.at_radius.iter().for_each(|[before, after]| take(scaled(before), scaled(after)));
        if self.at_radius.is_empty() {
            for u in directions(DIRECTIONS) {
                let [before, after] = self.powers.each_ref().map(|power| even(power, scale(spin, u)).sum());
                take(before, after);
            }
        }
        if whole > 0.0 { change / whole } else { 0.0 }
    }
}

/// Even degrees of a power from 2 on at a place.
fn even(power: &Series, place: [f64; 3]) -> impl Iterator<Item = f64> {
    (2..=power.degree()).step_by(2).map(move |degree| {
        let mut value = [0.0];
        power.part(degree).add_value(place, &mut value);
        value[0]
    })
}
