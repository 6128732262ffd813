//! One mass on a spring: exact rationals of the reduced torque for a triaxial body (derived by hand from (4.4)).

use quasirigid::elements::{Assembly, Carrier, Coefficient, End, Law, Motion, Point, Spring};
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::reduction::{reduce, residual};

/// A body whose frozen inertia about the fixed pole is `J`, with one mass on an isotropic spring.
fn body(J: [f64; 3], mass: f64, rho: [f64; 3], stiffness: f64, damping: f64) -> FlexibleBody {
    let square: f64 = rho.iter().map(|x| x * x).sum();
    let inertia = std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let diagonal = if i == k { J[i] - mass * square } else { 0.0 };
            diagonal + mass * rho[i] * rho[k]
        })
    });
    Assembly {
        carrier: Carrier { mass: 5.0, center_of_mass: [0.0; 3], inertia },
        points: vec![Point { name: "mass".into(), mass, position: rho, motion: Motion::Free }],
        springs: vec![Spring {
            from: End::Point(0),
            to: End::Carrier,
            law: Law::Spatial {
                stiffness: Coefficient::Isotropic(stiffness),
                damping: Coefficient::Isotropic(damping),
            },
        }],
        hinged: vec![],
        support: Support::FixedPoint { point: [0.0; 3] },
    }
    .body()
    .unwrap()
}

fn assert_close(name: &str, found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for axis in 0..3 {
        let error = (found[axis] - expected[axis]).abs() / size;
        assert!(error < tolerance, "{name}[{axis}]: found {}, expected {}", found[axis], expected[axis]);
    }
}

#[test]
fn triaxial_body_has_the_rational_torque() {
    let body = body([2.0, 3.0, 4.0], 0.1, [0.5, -0.3, 0.8], 1000.0, 2.0);
    let omega = [0.3, -0.2, 0.5];
    let reduced = reduce(&body, 3).unwrap();
    let part = |series: &quasirigid::math::polynomial::Series, degree: usize| {
        let mut value = [0.0; 3];
        series.part(degree).add_value(omega, &mut value);
        value
    };
    let mu = |degree: usize| {
        let mut value = [0.0; 3];
        reduced.mu(degree).add_value(omega, &mut value);
        value
    };
    println!("{:?}", residual(&body, &reduced, omega));
    assert_close("r0", part(&reduced.q, 2), [-7.75e-6, 4.05e-6, 6.4e-6], 1e-12);
    assert_close("r1", part(&reduced.q, 3), [133.0 / 15e9, 1.548e-8, 17.6 / 15e9], 1e-12);
    assert_close("mu4", mu(4), [-8.63206666666667e-7, -1.49860666666667e-6, -2.24733333333333e-8], 1e-12);
    assert_close("mu5", mu(5), [-9.52412666666667e-10, 6.33701555555556e-10, 1.072416e-9], 1e-12);
    let power = reduced.dissipated_power(omega);
    assert!((power / 1.598_124_444_444_44e-10 - 1.0).abs() < 1e-12, "{power}");
}
#[test]
fn residual_falls() {
    let body = body([2.0, 3.0, 4.0], 0.1, [0.5, -0.3, 0.8], 1000.0, 2.0);
    for order in 1..=7 {
        let reduced = reduce(&body, order).unwrap();
        let at = |scale: f64| residual(&body, &reduced, [0.3 * scale, -0.2 * scale, 0.5 * scale]);
        let (a, b) = (at(8.0), at(4.0));
        println!("{order} {a:?} {} {}", (a.elastic / b.elastic).log2(), (a.torque / b.torque).log2());
    }
}
