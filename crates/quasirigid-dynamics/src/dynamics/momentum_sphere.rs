//! Energy form on the sphere of a constant angular momentum: what a free motion needs at each of its many rates, compiled once for each motion.
//! Equations (R16), docs/theory/03-reduction.md, and (P9), (P10), docs/theory/05-propagation.md.

use super::form::Rates;
use crate::math::lanes::Lanes;
use crate::math::polynomial::{
    Homogeneous, Number, Series, SphereKernel, SphereMap, TangentKernel, TangentMap,
};
use crate::math::simd::Arithmetic;
use crate::math::vec3::dot;
use crate::model::{ReducedBody, momentum_rate};

/// Energy form of a body, from which those on spheres are compiled.
#[derive(Clone, Debug)]
pub(super) struct MomentumSpheres {
    /// Rows of `∇E`, then `K·c`.
    vectors: SphereMap,
    T: TangentMap,
}

/// Energy form on one sphere, or on one for each lane.
#[derive(Clone, Debug)]
pub(super) struct MomentumSphere<N: Number> {
    vectors: SphereKernel<N, 4>,
    T: TangentKernel<N>,
}

impl MomentumSpheres {
    pub fn new(body: &ReducedBody) -> Self {
        let gradient = body.energy_of_momentum.gradient();
        let mut variables = Series::zero(1, 3);
        variables.set(Homogeneous::identity());
        let mut vectors = Series::zero(gradient.degree().max(body.c.degree() + 1), 4);
        for degree in 0..=vectors.degree() {
            if degree <= gradient.degree() {
                (0..3).for_each(|row| vectors.add_row(degree, row, 1.0, (gradient.part(degree), row)));
            }
            vectors.add_row(degree, 3, 1.0, (&variables.dot(&body.c, degree), 0));
        }
        Self { vectors: SphereMap::new(&vectors), T: TangentMap::new(&body.T) }
    }

    /// Energy form on the sphere through an angular momentum.
    pub fn through(&self, K: [f64; 3]) -> MomentumSphere<f64> {
        let squared = dot(K, K);
        MomentumSphere { vectors: self.vectors.on_sphere(squared), T: self.T.on_sphere(squared) }
    }
}

impl MomentumSphere<Lanes> {
    /// The same sphere in every lane.
    pub fn splat(sphere: &MomentumSphere<f64>) -> Self {
        Self {
            vectors: SphereKernel::<Lanes, 4>::splat(&sphere.vectors),
            T: TangentKernel::<Lanes>::splat(&sphere.T),
        }
    }

    /// Puts another sphere of the same body into a lane.
    pub fn load(&mut self, lane: usize, sphere: &MomentumSphere<f64>) {
        self.vectors.load(lane, &sphere.vectors);
        self.T.load(lane, &sphere.T);
    }
}

impl<N: Number> Rates<N> for MomentumSphere<N> {
    #[inline(always)]
    fn rate<A: Arithmetic>(&self, K: [N; 3]) -> [N; 3] {
        let [x, y, z, along] = self.vectors.value::<A>(K);
        momentum_rate(K, [x, y, z], N::from(1.0) + along, self.T.value::<A>(K))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::{Assembly, Wheel, WheelSpeed};
    use crate::math::lanes::LANES;
    use crate::math::simd::{Rounding, Task, dispatch};
    use crate::math::sym3::smooth_times;
    use crate::math::vec3::{cross, norm, scale};
    use crate::problems::ring_of_points;
    use crate::reduction::{Vibrations, reduce};

    struct At<'a, N: Number>(&'a MomentumSphere<N>, [N; 3]);

    impl<N: Number> Task for At<'_, N> {
        type Output = [N; 3];

        #[inline(always)]
        fn run<A: Arithmetic>(self) -> [N; 3] {
            self.0.rate::<A>(self.1)
        }
    }

    /// Some hundred operations, some on coefficients that binomials enlarge to a hundred times their size.
    const ROUNDING: f64 = 1e-12;

    /// Reduced bodies of every order without symmetry, one of them with a wheel, and angular momenta from slow spins to the lowest frequency.
    fn cases() -> impl Iterator<Item = (ReducedBody, [f64; 3])> {
        let bodies = [ring_of_points(3), with_wheel(ring_of_points(2))];
        bodies.into_iter().flat_map(|assembly| {
            let body = assembly.body().unwrap();
            let lowest = Vibrations::compute(&body).unwrap().frequencies[0];
            (0..8).flat_map(move |order| {
                let reduced = reduce(&body, order).unwrap();
                [1e-3, 0.1, 1.0].into_iter().flat_map(move |share| {
                    let reduced = reduced.clone();
                    [[0.7, -1.3, 0.4], [1.0, 0.02, 0.0], [-0.1, 0.3, 0.9]].into_iter().map(move |u| {
                        let K = reduced.K.truncated(1).vector(scale(share * lowest / norm(u), u));
                        (reduced.clone(), K)
                    })
                })
            })
        })
    }

    fn with_wheel(mut assembly: Assembly) -> Assembly {
        let speed = WheelSpeed::Constant { angular_momentum: 0.4 };
        assembly.wheels = vec![Wheel { name: "wheel".into(), axis: [0.2, -0.1, 0.4], speed }];
        assembly
    }

    #[test]
    fn rates_are_those_of_the_polynomials_in_full() {
        for (body, K) in cases() {
            let sphere = MomentumSpheres::new(&body).through(K);
            let expected = body.motion(K).rate;
            let size = norm(expected) + norm(cross(K, body.energy_of_momentum.gradient().vector(K)));
            for rounding in [Rounding::Fastest, Rounding::Reproducible] {
                let found = dispatch(rounding, At(&sphere, K));
                let gap = norm([0, 1, 2].map(|axis| found[axis] - expected[axis]));
                assert!(gap <= ROUNDING * size, "{K:?}: {gap:e} of {size:e}");
            }
        }
    }

    /// `K·K̇ = 0` and `∇E·K̇ + K̇·T K̇ = 0` with the polynomials in full. (R16)
    #[test]
    fn both_laws_hold() {
        for (body, K) in cases() {
            let rate = dispatch(Rounding::Fastest, At(&MomentumSpheres::new(&body).through(K), K));
            let gradient = body.energy_of_momentum.gradient().vector(K);
            let power = dot(rate, smooth_times(body.T.tensor(K), rate));
            let size = norm(rate) + norm(cross(K, gradient));
            assert!(dot(K, rate).abs() <= ROUNDING * norm(K) * size);
            assert!((dot(gradient, rate) + power).abs() <= ROUNDING * norm(gradient) * size, "{K:?}");
        }
    }

    #[test]
    fn lanes_have_the_bits_of_their_own_spheres() {
        let body = reduce(&ring_of_points(2).body().unwrap(), 4).unwrap();
        let spheres = MomentumSpheres::new(&body);
        let K: [[f64; 3]; LANES] =
            std::array::from_fn(|lane| scale(0.1 + 0.2 * lane as f64, [0.3, -0.2 * lane as f64, 0.7]));
        let alone = K.map(|K| spheres.through(K));
        let mut together = MomentumSphere::<Lanes>::splat(&alone[0]);
        alone.iter().enumerate().for_each(|(lane, sphere)| together.load(lane, sphere));
        let found =
            dispatch(Rounding::Fastest, At(&together, [0, 1, 2].map(|axis| Lanes(K.map(|K| K[axis])))));
        for (lane, sphere) in alone.iter().enumerate() {
            assert_eq!(found.map(|rate| rate.0[lane]), dispatch(Rounding::Fastest, At(sphere, K[lane])));
        }
    }
}
