//! Inertial waves of a cylinder of liquid in Stewartson's top `[@stewartson1959]`, with their boundary layers, against the poles of the
//! response. (L22)

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};

use super::{C, SpinningCylinder};

/// `J_0` and `J_1` by their series.
fn bessel(n: i32, x: f64) -> f64 {
    let mut term = (0.5 * x).powi(n) / (1..=n).map(f64::from).product::<f64>();
    let mut sum = term;
    for k in 1..80_i32 {
        term *= -0.25 * x * x / f64::from(k * (k + n));
        sum += term;
    }
    sum
}

fn slope(x: f64) -> f64 {
    bessel(0, x) - if x > 0.0 { bessel(1, x) / x } else { 0.5 }
}

/// Inertial wave `J₁(ξr) sin kz e^{i(θ + λt)}` in a cylinder of radius 1 that spins at the rate 1.
#[derive(Clone, Copy, Debug)]
struct Wave {
    half: f64,
    k: f64,
    xi: f64,
    rate: f64,
}

impl Wave {
    /// Wave with `2j + 1` half waves along the axis, at the first root of `λξJ₁′(ξ) + 2J₁(ξ) = 0`, `λ = ±2/√(1 + ξ²/k²)`.
    fn new(half: f64, j: usize, sign: f64) -> Self {
        let k = (2 * j + 1) as f64 * PI / (2.0 * half);
        let rate = |xi: f64| sign * 2.0 / (1.0 + (xi / k).powi(2)).sqrt();
        let gap = |xi: f64| rate(xi) * xi * slope(xi) + 2.0 * bessel(1, xi);
        let mut low = 0.5;
        while gap(low) * gap(low + 0.02) > 0.0 {
            low += 0.02;
        }
        let mut high = low + 0.02;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if gap(low) * gap(middle) > 0.0 { low = middle } else { high = middle }
        }
        Self { half, k, xi: low, rate: rate(low) }
    }

    /// `u_r` and `u_θ` where `sin kz` is 1, and `u_z` where `cos kz` is.
    fn flow(&self, r: f64) -> [C; 3] {
        let Self { k, xi, rate, .. } = *self;
        let (p, p_r, p_over_r) = (bessel(1, xi * r), xi * slope(xi * r), bessel(1, xi * r) / r);
        let determinant = 4.0 - rate * rate;
        let u_r = C::new(0.0, -(rate * p_r + 2.0 * p_over_r) / determinant);
        [u_r, C::from((rate * p_over_r + 2.0 * p_r) / determinant), C::new(0.0, k * p / rate)]
    }

    /// Eigenvalue over the spin at a Reynolds number, with the boundary layer and the friction in the core. (L22)
    fn damped(&self, tau: f64) -> C {
        let Self { half, k, xi, rate } = *self;
        let s = C::new(0.0, rate);
        let i = C::i();
        let steps = 400;
        let middles = (0..steps).map(|step| (f64::from(step) + 0.5) / f64::from(steps));
        let (mut energy, mut ends) = (0.0, C::from(0.0));
        for r in middles {
            let [u_r, u_t, u_z] = self.flow(r);
            let area = TAU * r / f64::from(steps);
            energy += area * half * (u_r.norm_sqr() + u_t.norm_sqr() + u_z.norm_sqr());
            let sides = (s + 2.0 * i).sqrt() * (u_r + i * u_t).norm_sqr()
                + (s - 2.0 * i).sqrt() * (u_r - i * u_t).norm_sqr();
            ends += sides * area;
        }
        let [_, u_t, u_z] = self.flow(1.0);
        let mantle = s.sqrt() * (TAU * half * (u_t.norm_sqr() + u_z.norm_sqr()));
        s - (ends + mantle) / (energy * tau.sqrt()) - (xi * xi + k * k) / tau
    }
}

/// Free mode of the liquid nearest to a starting value, over the spin: zero of `D` by quotients `(s − s₀)/(α + βs)` through three points,
/// since a wave that a rotation hardly drives has a pole next to its zero.
fn pole(half: f64, tau: f64, near: C) -> C {
    let at = |s: C| (s, SpinningCylinder { half, tau }.drag(1, s * tau));
    let mut points = [C::from(1.0), C::new(1.0, 3e-3), C::new(1.003, 0.0)].map(|factor| at(near * factor));
    for _ in 0..8 {
        let rows = Matrix3::from_fn(|row, column| {
            let (s, D) = points[row];
            [C::from(1.0), D, D * s][column]
        });
        let right = Vector3::from(points.map(|(s, _)| s));
        let found = rows.lu().solve(&right).unwrap()[0];
        let step = (found - points[2].0).norm();
        points = [points[1], points[2], at(found)];
        if step < 1e-8 {
            break;
        }
    }
    points[2].0
}

/// Flat and high cylinders, one to five half waves along them, both senses: the frequency to 0.2 % of itself, the decay to 5 %. The
/// remainder is of the order `1/τ`.
#[test]
fn free_modes_are_the_waves_with_their_layers_in_flat_and_high_cylinders() {
    let mut gaps = [0.0; 2];
    for (half, most) in [(0.5_f64, 1), (1.0, 2), (2.0, 2), (3.0, 2)] {
        let tau = (2.4e4 / half.powi(2)).min(2.4e4);
        for (j, sign) in (0..=most).flat_map(|j| [(j, 1.0), (j, -1.0)]) {
            let wave = Wave::new(half, j, sign);
            let found = [tau / 4.0, tau].map(|tau| {
                let expected = wave.damped(tau);
                (pole(half, tau, expected), expected)
            });
            let gap = found.map(|(found, expected)| (found - expected).norm());
            let [_, (found, expected)] = found;
            assert!((found.im - expected.im).abs() < 0.002 * wave.rate.abs(), "{wave:?} {found} {expected}");
            assert!((found.re / expected.re - 1.0).abs() < 0.05, "{wave:?} {found} {expected}");
            gaps[0] += gap[0];
            gaps[1] += gap[1];
        }
    }
    let order = (gaps[0] / gaps[1]).log(4.0);
    assert!((0.8..1.3).contains(&order), "{order}");
}
