//! Slow energy of a reduced body on the sphere `|K| = G`, with gradient, velocity along levels and power.
//! The part that is constant on the sphere is subtracted, or nearly equal moments lose their digits.
//! Equations (N1) and (N3), docs/theory/17-levels.md.

use crate::math::polynomial::{Homogeneous, Kernel, Series, TensorKernel};
use crate::math::sphere::{deviator, directions};
use crate::math::sym3;
use crate::math::vec3::{cross, dot, norm, scale};
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
    /// `∇h`, and `K·c` in the fourth row.
    field: Kernel,
    Omega: Kernel,
    T: TensorKernel,
    /// Largest speed along a level over the sphere (1/s).
    pub fastest: f64,
    /// Largest power (W), and largest spin along the angular momentum (rad/s), over the sphere.
    pub largest_power: f64,
    pub fastest_turning: f64,
}

/// Directions in which the largest values over the sphere are sought.
const DIRECTIONS: usize = 300;

impl SlowEnergy {
    pub fn of(body: &ReducedBody, G: f64) -> Self {
        let even = body.energy_of_momentum.even();
        let gradient = deviator(&even.gradient(), G);
        let half_mean = 0.5 * sym3::inverse(body.J)[..3].iter().sum::<f64>() / 3.0;
        let slowing = slowing(body, G);
        let mut field = Series::zero(gradient.degree().max(slowing.degree()), 4);
        for degree in 0..=field.degree() {
            let mut part = Homogeneous::zero(degree, 4);
            if degree <= gradient.degree() {
                (0..3).for_each(|row| part.add_row(row, 1.0, (gradient.part(degree), row)));
            }
            if degree <= slowing.degree() {
                part.add_row(3, 1.0, (slowing.part(degree), 0));
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
            T: TensorKernel::new(&body.T.even().stretched(G)),
            fastest: 0.0,
            largest_power: 0.0,
            fastest_turning: 0.0,
        };
        for u in directions(DIRECTIONS) {
            let (velocity, ratio) = slow.velocity(u);
            let [power, turning] = slow.power(u, scale(ratio, velocity));
            slow.fastest = slow.fastest.max(norm(velocity));
            slow.largest_power = slow.largest_power.max(power);
            slow.fastest_turning = slow.fastest_turning.max(turning.abs());
        }
        slow
    }

    /// `h` (1/s).
    pub fn energy(&self, u: [f64; 3]) -> f64 {
        self.energy.at(u)[0]
    }

    /// The slow energy itself (J) of a value of `h`.
    pub fn joules(&self, h: f64) -> f64 {
        self.G * h + self.half_mean * self.G * self.G
    }

    /// Tangential part of `∇h` (1/s).
    pub fn slope(&self, u: [f64; 3]) -> [f64; 3] {
        let [x, y, z, _] = self.field.at(u);
        let along = dot([x, y, z], u);
        [x - along * u[0], y - along * u[1], z - along * u[2]]
    }

    /// Velocity `u × ∇h` along the level (1/s), and the factor `s` by which the angular momentum is faster. (N3)
    #[inline(always)]
    pub fn velocity(&self, u: [f64; 3]) -> ([f64; 3], f64) {
        let [x, y, z, slowing] = self.field.at(u);
        (cross(u, [x, y, z]), (1.0 + slowing).recip())
    }

    /// Power dissipated at a velocity (1/s) of the place (W), and the component of the angular velocity along the angular momentum
    /// (rad/s). (N4), (R16)
    #[inline(always)]
    pub fn power(&self, u: [f64; 3], velocity: [f64; 3]) -> [f64; 2] {
        let rate = scale(self.G, velocity);
        let power = dot(rate, sym3::times(self.T.at(u), rate));
        let [x, y, z, _] = self.Omega.at(u);
        [power, dot([x, y, z], u)]
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

/// `K·c` without its dissipative part, on the unit sphere: without dissipation the angular momentum moves at `K̇ = s K × ∇H` with
/// `s = 1/(1 + K·c)`. (N3), (R16)
fn slowing(body: &ReducedBody, G: f64) -> Series {
    let c = body.c.odd();
    let mut slowing = Series::zero(c.degree() + 1, 1);
    for degree in 0..=c.degree() {
        slowing.set(Homogeneous::identity().dot(c.part(degree)));
    }
    slowing.stretched(G)
}
