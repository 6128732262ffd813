//! Slow energy of a reduced body on the sphere `|K| = G`, with gradient, velocity along levels and power.
//! The part that is constant on the sphere is subtracted, or nearly equal moments lose their digits; the ratio of the two speeds is fitted,
//! because the quotient fails where both vanish.
//! Equations (N1) and (N3), docs/theory/17-levels.md.

use nalgebra::{DMatrix, DVector};

use crate::math::polynomial::monomial::exponents;
use crate::math::polynomial::{Homogeneous, Kernel, Series};
use crate::math::simd::Plain;
use crate::math::sphere::{deviator, directions};
use crate::math::sym3;
use crate::math::vec3::{cross, dot, norm};
use crate::model::{Principal, ReducedBody};

/// Slow energy on the sphere `|K| = G`, and the velocity of the angular momentum along its levels. (N1), (N3)
///
/// Places are unit vectors `u = K/G`; `h = (H − λ̄K²/2)/G` (1/s) is the slow energy without its part that is constant on the sphere, so
/// that no digits are lost to that part.
#[derive(Clone, Debug)]
pub(super) struct SlowEnergy {
    /// Angular momentum (N·m·s).
    pub G: f64,
    /// Axis of least inertia at rest, a unit vector.
    pub long_axis: [f64; 3],
    /// `∇h`, as a series.
    pub gradient: Series,
    /// Share of `G²` that `h` leaves out of the energy, `λ̄/2` (1/kg·m²).
    half_mean: f64,
    energy: Kernel,
    /// `∇h`, and the ratio `s − 1` of the two speeds in the fourth row.
    field: Kernel,
    Omega: Kernel,
    power: Kernel,
    /// Largest speed along a level over the sphere (1/s).
    pub fastest: f64,
    /// Largest power (W), and largest spin along the angular momentum (rad/s), over the sphere.
    pub largest_power: f64,
    pub fastest_turning: f64,
}

/// Directions in which the ratio of speeds is fitted.
const FITTED: usize = 300;
/// Relative singular value below which a combination of monomials counts as linearly dependent on the sphere.
const UNDETERMINED: f64 = 1e-10;

impl SlowEnergy {
    pub fn of(body: &ReducedBody, G: f64) -> Self {
        let even = body.energy_of_momentum.even();
        let gradient = deviator(&even.gradient(), G);
        let half_mean = 0.5 * sym3::inverse(body.J)[..3].iter().sum::<f64>() / 3.0;
        let ratio = speed_ratio(body, &gradient, G);
        let mut field = Series::zero(gradient.degree().max(ratio.degree()), 4);
        for degree in 0..=field.degree() {
            let mut part = Homogeneous::zero(degree, 4);
            if degree <= gradient.degree() {
                (0..3).for_each(|row| part.add_row(row, 1.0, (gradient.part(degree), row)));
            }
            if degree <= ratio.degree() {
                part.add_row(3, 1.0, (ratio.part(degree), 0));
            }
            field.set(part);
        }
        let mut slow = Self {
            G,
            long_axis: Principal::compute(body.J).axes[0],
            half_mean,
            energy: Kernel::new(&potential(&even, half_mean, G)),
            field: Kernel::new(&field),
            gradient,
            Omega: Kernel::new(&body.Omega.odd().stretched(G)),
            power: Kernel::new(&body.power.even()),
            fastest: 0.0,
            largest_power: 0.0,
            fastest_turning: 0.0,
        };
        for u in directions(FITTED) {
            let [power, turning] = slow.power(u);
            slow.fastest = slow.fastest.max(norm(slow.velocity(u).0));
            slow.largest_power = slow.largest_power.max(power);
            slow.fastest_turning = slow.fastest_turning.max(turning.abs());
        }
        slow
    }

    /// `h` (1/s).
    pub fn energy(&self, u: [f64; 3]) -> f64 {
        self.energy.value::<Plain>(u)[0]
    }

    /// The slow energy itself (J) of a value of `h`.
    pub fn joules(&self, h: f64) -> f64 {
        self.G * h + self.half_mean * self.G * self.G
    }

    /// Tangential part of `∇h` (1/s).
    pub fn slope(&self, u: [f64; 3]) -> [f64; 3] {
        let [x, y, z, _] = self.field.value::<Plain>(u);
        let along = dot([x, y, z], u);
        [x - along * u[0], y - along * u[1], z - along * u[2]]
    }

    /// Velocity `u × ∇h` along the level (1/s), and the factor `s` by which the angular momentum is faster. (N3)
    #[inline(always)]
    pub fn velocity(&self, u: [f64; 3]) -> ([f64; 3], f64) {
        let [x, y, z, over] = self.field.value::<Plain>(u);
        (cross(u, [x, y, z]), 1.0 + over)
    }

    /// Power dissipated (W), and the component of the angular velocity along the angular momentum (rad/s).
    #[inline(always)]
    pub fn power(&self, u: [f64; 3]) -> [f64; 2] {
        let [x, y, z, _] = self.Omega.value::<Plain>(u);
        [self.power.value::<Plain>([x, y, z])[0], dot([x, y, z], u)]
    }
}

/// `h` on the unit sphere.
fn potential(even: &Series, half_mean: f64, G: f64) -> Series {
    let mut centred = even.clone();
    let mut part = even.part(2).clone();
    let isotropic = [-2.0 * half_mean, -2.0 * half_mean, -2.0 * half_mean, 0.0, 0.0, 0.0];
    part.add_scaled(1.0, &Homogeneous::half_quadratic(&[isotropic]));
    centred.set(part);
    let mut potential = centred.stretched(G);
    for degree in 0..=potential.degree() {
        let mut part = potential.part(degree).clone();
        part.scale(G.recip());
        potential.set(part);
    }
    potential
}

/// `s − 1` as a polynomial on the unit sphere, so that `K × Ω = s K × ∇H` but for terms beyond the order: `K` is not a canonical variable
/// of the slow motion. A least-squares fit over the sphere, since a quotient fails where both sides vanish. (N3)
fn speed_ratio(body: &ReducedBody, gradient: &Series, G: f64) -> Series {
    let highest = body.order.saturating_sub(1) / 2 * 2;
    let lowest = if body.has_wheels() { highest.saturating_sub(1) } else { highest };
    let mut ratio = Series::zero(highest, 1);
    if highest == 0 {
        return ratio;
    }
    let conservative = deviator(&body.Omega.odd(), G);
    let monomials: Vec<[usize; 3]> = (lowest..=highest).flat_map(exponents).collect();
    let (mut rows, mut gap) = (DMatrix::zeros(3 * FITTED, monomials.len()), DVector::zeros(3 * FITTED));
    for (i, u) in directions(FITTED).enumerate() {
        let velocity = cross(u, gradient.vector(u));
        let real = cross(u, conservative.vector(u));
        for axis in 0..3 {
            gap[3 * i + axis] = real[axis] - velocity[axis];
            for (j, powers) in monomials.iter().enumerate() {
                let value: f64 = (0..3).map(|axis| u[axis].powi(powers[axis] as i32)).product();
                rows[(3 * i + axis, j)] = value * velocity[axis];
            }
        }
    }
    let size = rows.amax();
    let solved =
        if size > 0.0 { (rows / size).svd(true, true).solve(&(gap / size), UNDETERMINED).ok() } else { None };
    let Some(coefficients) = solved else { return ratio };
    for (powers, coefficient) in monomials.iter().zip(coefficients.iter()) {
        let degree = powers.iter().sum();
        let mut part = ratio.part(degree).clone();
        part.row_mut(0)[crate::math::polynomial::monomial::index(*powers)] = *coefficient;
        ratio.set(part);
    }
    ratio
}
