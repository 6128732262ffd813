use crate::math::polynomial::Series;
use crate::math::sym::norm;
use crate::model::ReducedBody;

/// Size of one degree of the reduced equations at the actual spin. (R14)
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DegreeSize {
    /// Degree in `ω`.
    pub degree: usize,
    /// Largest `|f_d|` over the directions of the spin (rad/s²).
    pub size: f64,
}

/// Directions over which sizes are taken.
const DIRECTIONS: usize = 400;

/// Size of each degree of `f`, from 2 to `p + 2`, at the length of a spin (rad/s). (R14)
#[must_use]
pub fn degree_sizes(body: &ReducedBody, omega: [f64; 3]) -> Vec<DegreeSize> {
    (2..=body.f.degree())
        .map(|degree| DegreeSize { degree, size: size(&body.f, degree, norm(omega)) })
        .collect()
}

/// The order at which the terms left out are smallest, from sizes that reach two degrees beyond every order tried. (R14)
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
/// The directions are those of `K`; `momentum` is its length (N·m·s).
#[must_use]
pub(super) fn momentum_ratio(body: &ReducedBody, momentum: f64, [from, to]: [usize; 2]) -> f64 {
    let below = size(&body.Omega, from, momentum);
    if below > 0.0 { size(&body.Omega, to, momentum) / below } else { 0.0 }
}

/// Largest value of one degree of a map of three rows over the sphere of a radius.
fn size(map: &Series, degree: usize, radius: f64) -> f64 {
    let part = map.part(degree);
    // Coefficients may lie beyond the range where they can be squared, the values do not.
    let values = directions().map(|direction| {
        let mut value = [0.0; 3];
        part.add_value(direction.map(|u| radius * u), &mut value);
        norm(value)
    });
    values.fold(0.0, f64::max)
}

/// Unit vectors spread evenly over the sphere: a spiral that turns by the golden angle.
fn directions() -> impl Iterator<Item = [f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..DIRECTIONS).map(move |i| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / DIRECTIONS as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        [radius * cos, radius * sin, z]
    })
}
