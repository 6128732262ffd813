//! Tests of the spinning ball and spheroid of liquid: closed forms at rest and for slow motions, the spin-over mode, convergence.
//! Limits at both ends of the Reynolds number, and the transition from the fields to the scaled boundary layer without a step.
//! Equations (C11), (L8), (L16) and (L17), docs/theory/13-inside.md; spin-over mode `[@greenspan1968]`.

use std::f64::consts::PI;

use super::*;
use crate::liquid::{self, LiquidFlow};

fn drag(m: i32, sigma: C, tau: f64) -> C {
    liquid::drag(LiquidFlow::Spheroid { axis: [0.0, 0.0, 1.0], stretch: 1.0 }, m, sigma, tau)
}

/// `χ = (5/z²)(z i₁′/i₁ − 1)` of a ball at rest, with hyperbolic functions. (C11)
fn share(z: C) -> C {
    let tanh = (C::from(1.0) - (-2.0 * z).exp()) / (C::from(1.0) + (-2.0 * z).exp());
    let slope = (z * z * tanh - 2.0 * z + 2.0 * tanh) / (z - tanh);
    5.0 / (z * z) * (slope - 1.0)
}

#[test]
fn a_ball_at_rest_follows_its_wall_as_the_hyperbolic_functions_have_it() {
    for frequency in [3.0, 40.0, 900.0, 1.0e4, 1.0e5, 1.0e6] {
        for sigma in [C::new(0.0, frequency), C::new(0.3 * frequency, -frequency)] {
            let expected = sigma / (1.0 - share(sigma.sqrt()));
            for m in [-1, 0, 1] {
                let found = drag(m, sigma, 0.0);
                // The dissipation is a share `σ^{-1/2}` of the response: the error is measured against it.
                let gap = (found - expected).norm() / (expected - sigma).norm();
                assert!(gap < 2e-3, "{sigma} {m}: {gap:e}");
            }
        }
    }
}

/// Slow motions follow the series `1 − χ = z²/35 − 2z⁴/1575 + …` (C11).
#[test]
fn a_slow_ball_begins_as_its_series() {
    let sigma = C::new(0.0, 1e-3);
    let series = sigma / 35.0 - 2.0 * sigma.powi(2) / 1575.0 + 37.0 * sigma.powi(3) / 606_375.0;
    for m in [-1, 0, 1] {
        assert!((sigma / drag(m, sigma, 0.0) / series - 1.0).norm() < 1e-9);
    }
    // The Coriolis force rotates shells with the body: to the first order the frequency is that in inertial axes.
    let tau = 1e-4;
    let turned = drag(1, sigma, tau) / drag(1, sigma - C::new(0.0, tau), 0.0);
    assert!((turned - 1.0).norm() < 1e-8, "{turned}");
}

fn layer_of(stretch: f64, sigma: C, tau: f64) -> C {
    spinning_boundary_layer::drag(SpinningSpheroid { stretch, tau }, 1, sigma).iter().sum()
}

/// Converged drag: more functions and degrees change nothing.
#[test]
fn what_is_resolved_is_settled() {
    for tau in [0.01, 1.0, 30.0, 1e3, 1e4, 1e5] {
        for frequency in [-3.0, -0.9, -0.3, 0.05, 0.6, 0.95, 1.3, 1.9] {
            let sigma = C::new(0.0, frequency * tau);
            for m in [0, 1] {
                let inviscid = sigma - C::new(0.0, f64::from(m) * tau);
                let found = drag(m, sigma, tau);
                let size = sigma.norm() + 2.0 * tau;
                let count = 10 + (2.0 * size.sqrt().sqrt()) as usize;
                let degrees = 12 + (1.5 * tau.sqrt().sqrt()) as usize;
                let fine = fields(m as usize, degrees, count, 1.0).answer(sigma, tau).unwrap().inv();
                let gap = (found - fine).norm() / (fine - inviscid).norm();
                assert!(gap < 3e-3, "tau {tau} frequency {frequency} m {m}: {gap:e}");
            }
        }
    }
}

/// Root of a drag near the spin-over mode, less its ideal frequency, per `√τ`.
fn spin_over(drag: &dyn Fn(C) -> C, tau: f64, frequency: f64) -> C {
    let mut sigma = C::new(-2.62 * tau.sqrt(), frequency * tau);
    for _ in 0..20 {
        let step = C::from(1e-5 * tau);
        let slope = (drag(sigma + step) - drag(sigma - step)) / (2.0 * step);
        sigma -= drag(sigma) / slope;
    }
    (sigma - C::new(0.0, frequency * tau)) / tau.sqrt()
}

/// Spin-over mode `D = 0`, which circles as a vector at rest in inertial space: `2.6205 + 0.2585i` times `√(νΩ)/a` in the limit
/// `[@greenspan1968]`, and at finite Reynolds numbers above this limit by an amount that falls as `E^{0.3}`.
#[test]
fn spin_over_decays_as_greenspan_has_it() {
    let tau = 1e10;
    let layer = spin_over(&|sigma| layer_of(1.0, sigma, tau), tau, 1.0);
    assert!((layer - C::new(-2.6205, 0.2585)).norm() < 3e-4, "{layer}");
    let gaps =
        [1e3, 1e4, 1e5].map(|tau| -spin_over(&|sigma| drag(1, sigma, tau), tau, 1.0).re / 2.6205 - 1.0);
    assert!(gaps[0] < 0.2 && gaps[1] < 0.05 && gaps[2] < 0.025 && gaps[2] > 0.0, "{gaps:?}");
}

/// Spin-over mode of a spheroid: at `2/(1 + c²/a²)` of the spin `[@greenspan1968]`; fields and boundary layer, two methods, converge to
/// each other as the spin grows.
#[test]
fn spin_over_of_a_spheroid_is_that_of_poincare() {
    for stretch in [0.25, 0.64, 2.56] {
        let frequency = 2.0 / (1.0 + stretch);
        let both = |tau: f64| {
            let exact = spin_over(&|sigma| SpinningSpheroid { stretch, tau }.drag(1, sigma), tau, frequency);
            let layer = spin_over(&|sigma| layer_of(stretch, sigma, tau), tau, frequency);
            (exact - layer).norm() / layer.norm()
        };
        let gaps = [1e3, 1e4, 6e4].map(both);
        assert!(gaps[2] < 0.12 && gaps[2] < 0.7 * gaps[0], "{stretch}: {gaps:?}");
    }
}

/// Slow motions: (L8) of the ellipsoid, about the axis and across the axis.
#[test]
fn a_slow_spheroid_is_that_of_polynomials() {
    for stretch in [0.04_f64, 0.5, 3.0] {
        let c = stretch.sqrt();
        let about_x = |[a, b, c]: [f64; 3]| {
            let [a2, b2, c2] = [a * a, b * b, c * c];
            let sum =
                3.0 * a2 * b2 * b2 + 2.0 * a2 * b2 * c2 + 3.0 * a2 * c2 * c2 + b2 * b2 * c2 + b2 * c2 * c2;
            16.0 * PI * a.powi(3) * b.powi(5) * c.powi(5) / (105.0 * sum)
        };
        let unit = 8.0 * PI / 15.0 * c;
        let liquid = SpinningSpheroid { stretch, tau: 0.0 };
        for (m, load, P) in [(0, unit, about_x([c, 1.0, 1.0])), (1, unit * stretch, about_x([1.0, 1.0, c]))] {
            let found = load / liquid.drag(m, C::from(0.0));
            assert!((found / P - 1.0).norm() < 1e-9, "{stretch} {m}: {found} {P}");
        }
    }
}

/// Response of a nearly spherical spheroid: equal to that of the ball, whose degrees are coupled in another way.
#[test]
fn a_spheroid_becomes_a_ball() {
    for m in [0_usize, 1] {
        let sigma = C::new(30.0, 700.0);
        let near = SpinningSpheroid { stretch: 1.0 + 1e-7, tau: 1e3 }.drag(m, sigma);
        assert!((near / drag(m as i32, sigma, 1e3) - 1.0).norm() < 1e-6);
    }
}

/// Dissipation: a ball of liquid takes energy from every motion.
#[test]
fn every_motion_is_braked() {
    for tau in [0.1, 10.0, 1e3, 1e5, 1e6, 1e8] {
        for frequency in [-5.0, -1.7, -0.4, 0.2, 0.7, 1.0, 1.5, 2.5] {
            for m in [-1, 0, 1] {
                let found = drag(m, C::new(0.0, frequency * tau), tau);
                assert!(found.re > 0.0, "{tau} {frequency} {m}: {found}");
            }
        }
    }
}

/// Transition from the fields to the scaled boundary layer: without a step.
#[test]
fn the_ratio_joins_the_fields() {
    for frequency in [-1.1, 0.3, 0.9] {
        let at = |size: f64| {
            let tau = size / (2.0 + f64::abs(frequency));
            let sigma = C::new(0.0, frequency * tau);
            let [core, layer] =
                spinning_boundary_layer::drag(SpinningSpheroid { stretch: 1.0, tau }, 1, sigma);
            (drag(1, sigma, tau) - core) / layer
        };
        let [below, above] = [0.999, 1.001]
            .map(|share| share * SpinningSpheroid { stretch: 1.0, tau: 1.0 }.resolved())
            .map(at);
        assert!((above / below - 1.0).norm() < 2e-3, "{below} {above}");
    }
}
