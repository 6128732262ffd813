//! Frequencies by which slosh and nutation meet: each with the other held. Equations (U15) and (U16), docs/theory/21-slosh.md.

use quasirigid::elements::SettledTank;
use quasirigid_math::sphere::tangents;
use quasirigid_math::sym3;
use quasirigid_math::vec3::{dot, norm, unit};

/// Frequencies (rad/s) of a slosh mode in a body held in a spin (rad/s), slower and faster; none of a motion that does not oscillate. (U15)
pub(super) fn slosh_frequencies(tank: &SettledTank, frequency: f64, spin: [f64; 3]) -> [Option<f64>; 2] {
    let up = unit(tank.gravity);
    let along = dot(spin, up).powi(2);
    let [first, second] = [along, dot(spin, spin)].map(|square| frequency * frequency - square);
    let half = 0.5 * (first + second + 4.0 * along);
    let product = first * second;
    let root = (half * half - product).max(0.0).sqrt();
    let large = half + root.copysign(half);
    let squares = if large == 0.0 { [0.0; 2] } else { [large, product / large] };
    let mut squares = squares.map(|square| (square > 0.0).then(|| square.sqrt()));
    squares.sort_by(|a, b| a.unwrap_or(0.0).total_cmp(&b.unwrap_or(0.0)));
    squares
}

/// Rate (rad/s) of the nutation in the body with everything inside held, at a spin (rad/s) with an angular momentum (N·m·s) and an inertia
/// tensor (kg·m²); none where the motion does not oscillate. (U16)
pub(super) fn nutation_rate(inertia: [f64; 6], spin: [f64; 3], angular_momentum: [f64; 3]) -> Option<f64> {
    let rate = norm(spin);
    let axis = unit(spin);
    let [first, second] = tangents(axis);
    let rows = sym3::rows(inertia);
    let form = |a: [f64; 3], b: [f64; 3]| dot(a, rows.map(|row| dot(row, b)));
    let [a, b, c] = [form(first, first), form(second, second), form(first, second)];
    let (middle, apart) = (0.5 * (a + b), (0.5 * (a - b)).hypot(c));
    let along = dot(angular_momentum, axis);
    let [low, high] = [middle - apart, middle + apart];
    let square = (along - low * rate) * (along - high * rate) / (low * high);
    (square > 0.0 && square.is_finite()).then(|| square.sqrt())
}

#[cfg(test)]
mod tests {
    use quasirigid_math::vec3::{add, cross, scale};

    use super::*;

    type Complex = [f64; 2];

    fn product(a: Complex, b: Complex) -> Complex {
        [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
    }

    fn tank(gravity: [f64; 3]) -> SettledTank {
        SettledTank {
            name: "fuel".into(),
            fill: 0.5,
            liquid_mass: 1.0,
            center_of_mass: [0.0; 3],
            slosh: Vec::new(),
            gravity,
            settled_by: quasirigid::elements::Settling::Acceleration(gravity),
            tilt: 0.0,
            error: 0.0,
            surface_radius: 1.0,
            bond: (1e9, false),
            spin_share: 0.0,
            drag: [0.0; 2],
            inertia_share: 0.0,
            drag_time: None,
            layer: 0.0,
            baffles: None,
        }
    }

    /// Determinant of the equation of a bob across `up` in a frame that turns, written with cross products.
    fn determinant(up: [f64; 3], spin: [f64; 3], own: f64, rate: f64) -> f64 {
        let first = cross(up, [0.3, 0.5, -0.7]);
        let first = unit(first);
        let axes = [first, cross(up, first)];
        let entry = |row: usize, column: usize| {
            let x = axes[column];
            let still = add(scale(own * own - rate * rate, x), cross(spin, cross(spin, x)));
            [dot(axes[row], still), 2.0 * rate * dot(axes[row], cross(spin, x))]
        };
        let [diagonal, other] = [product(entry(0, 0), entry(1, 1)), product(entry(0, 1), entry(1, 0))];
        assert!((diagonal[1] - other[1]).abs() < 1e-12 * own.powi(4));
        diagonal[0] - other[0]
    }

    /// (U15) in any direction, above and below the spin, in any unit of time.
    #[test]
    fn frequencies_of_a_bob_solve_its_equation() {
        for (spin, own) in [([0.3, -0.4, 0.8], 2.0), ([2.0, 1.0, -3.0], 4.1), ([0.0, 0.0, 1.5], 1.0)] {
            for unit in [1.0, 1e-4, 1e5] {
                let up = [0.6, 0.0, 0.8];
                let (spin, own) = (scale(unit, spin), unit * own);
                let found = slosh_frequencies(&tank(scale(-3.0, up)), own, spin);
                assert!(found.iter().flatten().count() > 0);
                for rate in found.into_iter().flatten() {
                    let beside = determinant(up, spin, own, 1.01 * rate).abs();
                    assert!(determinant(up, spin, own, rate).abs() < 1e-9 * beside);
                }
            }
        }
    }

    /// Along the spin the bob swings in inertial axes as it does at rest; across it, the centrifugal force takes from one direction.
    #[test]
    fn bobs_along_and_across_the_spin() {
        let along = slosh_frequencies(&tank([0.0, 0.0, -2.0]), 3.0, [0.0, 0.0, 0.5]);
        for (found, known) in along.into_iter().zip([2.5, 3.5]) {
            assert!((found.unwrap() - known).abs() < 1e-14);
        }
        let across = slosh_frequencies(&tank([2.0, 0.0, 0.0]), 3.0, [0.0, 0.0, 1.0]);
        for (found, known) in across.into_iter().zip([8f64.sqrt(), 3.0]) {
            assert!((found.unwrap() - known).abs() < 1e-14);
        }
        let flung = slosh_frequencies(&tank([2.0, 0.0, 0.0]), 3.0, [0.0, 0.0, 4.0]);
        assert_eq!((flung[0], flung[1]), (None, Some(3.0)));
    }

    /// (U16) of Euler's equations about axes that are turned, and with a wheel in a body that hardly turns.
    #[test]
    fn nutation_rates_of_a_body_with_a_wheel() {
        let (moments, spin) = ([3.0, 5.0, 7.0], 0.4);
        let (sin, cos) = 0.7f64.sin_cos();
        let axes = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let entry = |i: usize, j: usize| (0..3).map(|k| moments[k] * axes[k][i] * axes[k][j]).sum::<f64>();
        let inertia = [entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(2, 0), entry(0, 1)];
        let omega = scale(spin, axes[2]);
        let free = nutation_rate(inertia, omega, scale(7.0 * spin, axes[2])).unwrap();
        assert!((free / spin - (4.0 * 2.0 / 15.0f64).sqrt()).abs() < 1e-14);
        let slow = scale(1e-9, axes[2]);
        let biased = nutation_rate(inertia, slow, scale(12.0, axes[2])).unwrap();
        assert!((biased - 12.0 / 15f64.sqrt()).abs() < 1e-8);
        let middle = scale(spin, axes[1]);
        assert_eq!(nutation_rate(inertia, middle, scale(5.0 * spin, axes[1])), None);
    }
}
