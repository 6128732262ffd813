//! Limit of stiff springs: the reduced equations about a spin and those about rest are pieces of one surface. (W13)

use std::ops::ControlFlow;

use quasirigid::model::ReducedBody;
use quasirigid::prelude::{FlexibleBody, reduce};
use quasirigid_math::submanifold::{
    Equations, LinearPart, Master, Plan, PolynomialSystem, Ring, Style, Truncated, expand,
};
use quasirigid_math::vec3::{dot, norm, scale};

use super::{bodies, body_of, cubic, derived, plan};

/// Equations of the reduction about rest in the angular momentum, `K̇ = K × Ω(K)`. (P1)
struct AboutRest(ReducedBody);

impl PolynomialSystem for AboutRest {
    fn size(&self) -> usize {
        3
    }

    fn equations(&self, ring: &Ring, K: &[Truncated]) -> Equations {
        let mut omega = vec![ring.zero(); 3];
        for degree in 0..=self.0.Omega.degree() {
            for (exponents, coefficients) in self.0.Omega.part(degree).terms() {
                let mut power = ring.constant(1.0);
                for (axis, exponent) in exponents.into_iter().enumerate() {
                    (0..exponent).for_each(|_| power = ring.product(&power, &K[axis]));
                }
                omega.iter_mut().zip(coefficients).for_each(|(omega, c)| omega.add_scaled(c, &power));
            }
        }
        let force = |axis: usize| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut force = ring.zero();
            ring.add_product(&mut force, 1.0, &K[next], &omega[last]);
            ring.add_product(&mut force, -1.0, &K[last], &omega[next]);
            force
        };
        Equations { momenta: K.to_vec(), forces: (0..3).map(force).collect() }
    }

    fn scales(&self) -> Vec<f64> {
        vec![1.0; 3]
    }

    fn conserved(&self, ring: &Ring, K: &[Truncated]) -> Option<Truncated> {
        let mut square = ring.zero();
        K.iter().for_each(|K| ring.add_product(&mut square, 0.5, K, K));
        Some(square)
    }
}

/// Eigenvalue of the nutation and its cubic coefficient by the reduction about rest, the unit of the amplitude as about the spin.
fn about_rest(body: &FlexibleBody, order: usize, near: [f64; 3]) -> [[f64; 2]; 2] {
    let system = AboutRest(reduce(body, order).unwrap());
    let mut K = near;
    for _ in 0..400 {
        // The steady spin about the axis of greatest inertia attracts `K ← K(ω ∥ K)`, as a power iteration.
        let omega: [f64; 3] = system.0.Omega.vector(K);
        let inverse = |omega: [f64; 3]| system.0.angular_momentum(omega);
        let along = scale(norm(omega) / norm(K), K);
        let next = inverse(along);
        K = scale(norm(near) / norm(next), next);
    }
    let linear = LinearPart::at(&system, &K);
    let (lambda, vector) =
        linear.spectrum().unwrap().into_iter().find(|(lambda, _)| lambda[1] > 0.0).unwrap();
    let pair = linear.refined(lambda, &vector).unwrap();
    let part = |i: usize| -> [f64; 3] { std::array::from_fn(|row| pair.right[row][i] / norm(near)) };
    let (a, b) = (part(0), part(1));
    let square = dot(a, a) + dot(b, b);
    let turned = (dot(a, a) - dot(b, b)).hypot(2.0 * dot(a, b));
    let pair = pair.scaled([(2.0 * (square + turned)).sqrt().recip(), 0.0]);
    let masters = vec![
        Master { mode: pair.clone(), partner: 1, weight: vec![1] },
        Master { mode: pair.conjugate(), partner: 0, weight: vec![-1] },
    ];
    let plan = Plan { masters, style: Style::NormalForm, degree: 3 };
    let found = expand(&system, &linear, plan, &mut |_| ControlFlow::Continue(())).unwrap();
    [pair.lambda, found.rates[0].coefficient(found.ring.index(&[2, 1]).unwrap())]
}

/// Difference of two complex numbers relative to the second.
fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]) / b[0].hypot(b[1])
}

#[test]
fn rates_and_cubic_coefficients_agree_with_the_order_of_the_theory() {
    let soft = body_of(&bodies::two_masses());
    for order in [2, 3, 5] {
        let gaps: Vec<[f64; 2]> = [0.3, 0.15, 0.075]
            .into_iter()
            .map(|epsilon| {
                let body = soft.stiffened(epsilon).unwrap();
                let manifold = derived(&body, &plan(&body, 1.0, 3));
                let [lambda, rest] = about_rest(&body, order, manifold.spin.angular_momentum);
                let spin = [-manifold.masters[0].decay_rate, manifold.masters[0].frequency];
                [apart(spin, lambda), apart(cubic(&manifold), rest)]
            })
            .collect();
        println!("order {order}: {gaps:?}");
        for which in 0..2 {
            let slope = (gaps[1][which] / gaps[2][which]).log2();
            assert!(slope > order as f64 + 0.7, "order {order}, {which}: {gaps:?}");
        }
    }
}
