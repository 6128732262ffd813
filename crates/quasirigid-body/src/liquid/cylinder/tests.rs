//! Tests of the spinning cylinder of liquid: slow motions, series at rest, coupling of heights, convergence, inertial waves.
//! Expected values come from another method or from closed forms; the coupling test guards the elimination of groups of heights.
//! Equation (L20), docs/theory/13-inside.md; inertial waves `[@greenspan1968]`.

use std::f64::consts::PI;

use super::fields::beyond_neighbours;
use super::*;

/// Slow motions against `P` from polynomials of degree 12 in the meridian, by `check` of a cylinder of radius 1 m and height 4 m of unit
/// density: 0.354646 across the axis and 0.229563 about the axis, with errors of 1e-7.
#[test]
fn a_slow_cylinder_is_that_of_the_meridian() {
    let half = 2.0_f64;
    let mass = 2.0 * PI * half;
    let liquid = SpinningCylinder { half, tau: 0.0 };
    for (m, inertia, P) in [(1, mass * (0.25 + half * half / 3.0), 0.354_646), (0, 0.5 * mass, 0.229_563)] {
        let found = inertia / liquid.drag(m, C::from(0.0));
        assert!((found / P - 1.0).norm() < 2e-5, "{m}: {found}");
    }
}

/// Unsteady rotation about the axis at rest, against the series of sines `∫r×u = −s Σ …`.
#[test]
fn a_cylinder_at_rest_lags_as_its_series() {
    // I_1(x) and I_2(x) by the power series.
    let bessel = |n: i32, x: C| {
        let mut term = (x / 2.0).powi(n) / (1..=n).map(f64::from).product::<f64>();
        let mut sum = term;
        for k in 1..200_i32 {
            term *= x * x / 4.0 / f64::from(k * (k + n));
            sum += term;
        }
        sum
    };
    let half = 0.7;
    for frequency in [3.0, 40.0, 300.0] {
        let sigma = C::new(0.0, frequency);
        let term = |k: i32| {
            let n = f64::from(2 * k + 1) * PI / (2.0 * half);
            let x = (sigma + n * n).sqrt();
            let ratio = if x.norm() > 80.0 { C::from(1.0) - 1.5 / x } else { bessel(2, x) / bessel(1, x) };
            2.0 * 4.0 * PI / (half * n * n * x * x) * (0.25 - ratio / x)
        };
        // Response to the velocity r in each slice: ∫u_θ r dV per unit of inertia.
        let found = (0..4000).map(term).sum::<C>() / (PI * half);
        let answer = SpinningCylinder { half, tau: 0.0 }.drag(0, sigma).inv();
        assert!((answer / found - 1.0).norm() < 2e-3, "{frequency}: {answer} {found}");
    }
}

/// Coupling: groups of heights couple to their neighbours alone, and the rigid rotation loads the first groups.
#[test]
fn heights_know_their_neighbours() {
    for (m, half) in [(0, 1.0), (1, 1.0), (1, 0.3)] {
        let beyond = beyond_neighbours(m, half, [8, 9]);
        assert!(beyond < 1e-12, "{m} {half}: {beyond:e}");
    }
}

/// Converged drag: more functions change nothing.
#[test]
fn what_is_resolved_is_settled() {
    for (half, tau) in [(1.0, 0.1), (1.0, 100.0), (0.3, 3e3), (3.0, 1e3), (0.8, 2e4)] {
        for frequency in [-1.0, -0.4, 0.2, 0.5, 0.9, 1.4] {
            let sigma = C::new(0.0, frequency * tau);
            for m in [0, 1] {
                let found = SpinningCylinder { half, tau }.drag(m, sigma);
                let size = (sigma.norm() + 2.0 * tau).sqrt().sqrt();
                let count = |long: f64| 8 + (1.5 * size * long) as usize;
                let numbers = [count(1.0), count(half.sqrt().max(0.5))];
                let fine = fields(m, half, numbers).answer(sigma, tau).unwrap().inv();
                let gap = (found - fine).norm() / fine.re;
                assert!(gap < 5e-3, "half {half} tau {tau} frequency {frequency} m {m}: {gap:e}");
            }
        }
    }
}

/// Free modes of the first harmonic, `D = 0`, tend to the inertial waves `λξJ₁′(ξ) + 2J₁(ξ) = 0`, `λ = 2/√(1 + ξ²/k²)`, `k = (2j+1)π/2h`
/// `[@greenspan1968]`, with a remainder `τ^{-1/2}` from the boundary layer.
#[test]
fn free_modes_come_to_inertial_waves() {
    let bessel = |n: i32, x: f64| {
        let mut term = (x / 2.0).powi(n) / (1..=n).map(f64::from).product::<f64>();
        let mut sum = term;
        for k in 1..60_i32 {
            term *= -x * x / 4.0 / f64::from(k * (k + n));
            sum += term;
        }
        sum
    };
    for half in [0.7, 1.0, 1.6] {
        let k = PI / (2.0 * half);
        let rate = |xi: f64| 2.0 / (1.0 + (xi / k).powi(2)).sqrt();
        let slope = |xi: f64| bessel(0, xi) - bessel(1, xi) / xi;
        let gap = |xi: f64| rate(xi) * xi * slope(xi) + 2.0 * bessel(1, xi);
        // First zero: the pressure has no node but the axis.
        let (mut low, mut high) = (0.5, 0.5);
        while gap(high) > 0.0 {
            low = high;
            high += 0.05;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if gap(middle) > 0.0 { low = middle } else { high = middle }
        }
        let expected = rate(low);
        let found = [2.5e3, 1e4].map(|tau: f64| {
            let liquid = SpinningCylinder { half, tau };
            let mut sigma = C::new(-3.0 * tau.sqrt(), expected * tau);
            for _ in 0..12 {
                let step = C::from(1e-5 * tau);
                let slope = (liquid.drag(1, sigma + step) - liquid.drag(1, sigma - step)) / (2.0 * step);
                sigma -= liquid.drag(1, sigma) / slope;
            }
            sigma / tau
        });
        // The change by the boundary layer halves.
        let limit = 2.0 * found[1] - found[0];
        assert!((limit - C::new(0.0, expected)).norm() < 0.01 * expected, "{half}: {expected} {found:?}");
        assert!(found[1].re < 0.0 && (found[0].re / found[1].re - 2.0).abs() < 0.5, "{half}: {found:?}");
    }
}
