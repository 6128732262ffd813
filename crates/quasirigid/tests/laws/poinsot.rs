//! Torque-free rotation in closed form against its own equations, its constants, and quadrature.

use std::f64::consts::TAU;

use nalgebra::{Rotation3, Vector3};
use proptest::prelude::*;
use quasirigid::averaging::{EulerAngles, FreeRotation, ObservedError, ObservedPeriods};
use quasirigid::model::Mode;
use quasirigid_math::vec3::{add, cross, norm, scale};

fn moments() -> impl Strategy<Value = [f64; 3]> {
    (0.05..1.0_f64, 0.0..1.0_f64, 0.5..2.0_f64).prop_map(|(gap, share, scale)| {
        // I1 ≤ I2 ≤ I3 with I1 + I2 ≥ I3
        let third = 1.0;
        let first = 1.0 - 0.5 * gap;
        let second = (third - first).max(first) + share * (third - (third - first).max(first));
        [first * scale, second.max(first) * scale, third * scale]
    })
}

fn angular_momentum(moments: [f64; 3], omega: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| moments[axis] * omega[axis])
}

/// `ω̇` by Euler's equations.
fn euler(moments: [f64; 3], omega: [f64; 3]) -> [f64; 3] {
    let torque = cross(angular_momentum(moments, omega), omega);
    [0, 1, 2].map(|axis| torque[axis] / moments[axis])
}

fn gap(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm(add(a, scale(-1.0, b)))
}

proptest! {
    /// The angular velocity starts at the given value, keeps energy and angular momentum, and obeys Euler's equations.
    #[test]
    fn closed_form_satisfies_eulers_equations(
        moments in moments(), omega in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64], t in -30.0..30.0_f64,
    ) {
        let spin = norm(omega);
        prop_assume!(spin > 1e-3);
        let motion = FreeRotation::through(moments, omega).unwrap();
        prop_assert!(gap(motion.omega(0.0), omega) < 1e-13 * spin, "{:?}", motion.omega(0.0));
        let later = motion.omega(t);
        let G = norm(angular_momentum(moments, omega));
        prop_assert!((norm(angular_momentum(moments, later)) / G - 1.0).abs() < 1e-13);
        let energy = |omega: [f64; 3]| 0.5 * (0..3).map(|axis| moments[axis] * omega[axis].powi(2)).sum::<f64>();
        prop_assert!((energy(later) / energy(omega) - 1.0).abs() < 1e-13);
        prop_assert!((motion.energy() / energy(omega) - 1.0).abs() < 1e-13);
        let h = 2e-3 / spin;
        let slope = scale(0.5 / h, add(motion.omega(t + h), scale(-1.0, motion.omega(t - h))));
        prop_assert!(gap(slope, euler(moments, later)) < 1e-5 * spin * spin, "{slope:?}");
    }

    /// The attitude rotates at the angular velocity and keeps the direction of the angular momentum.
    #[test]
    fn attitude_turns_at_the_spin(
        moments in moments(), omega in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64], t in -30.0..30.0_f64,
    ) {
        let spin = norm(omega);
        prop_assume!(spin > 1e-3);
        let motion = FreeRotation::through(moments, omega).unwrap();
        let h = 1e-3 / spin;
        let [before, now, after] = [t - h, t, t + h].map(|t| motion.attitude(t));
        let K = angular_momentum(moments, motion.omega(t));
        let turned = now.map(|row| (0..3).map(|axis| row[axis] * K[axis]).sum::<f64>());
        prop_assert!(gap(turned, [0.0, 0.0, norm(K)]) < 1e-13 * norm(K));
        for row in 0..3 {
            // dR/dt = R [ω×]: each row moves as its cross product with ω.
            let slope = scale(0.5 / h, add(after[row], scale(-1.0, before[row])));
            let expected = cross(now[row], motion.omega(t));
            prop_assert!(gap(slope, expected) < 1e-5 * spin, "row {row}: {slope:?} {expected:?}");
        }
    }

    /// A period of the polhode brings the spin back, and half of one does not.
    #[test]
    fn polhode_closes_after_its_period(
        moments in moments(), omega in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
    ) {
        let spin = norm(omega);
        prop_assume!(spin > 1e-2);
        let motion = FreeRotation::through(moments, omega).unwrap();
        let period = motion.polhode_period();
        prop_assume!(period.is_finite() && period * spin < 300.0);
        prop_assert!(gap(motion.omega(period), omega) < 1e-11 * spin);
        let turned = motion.precession(period) / period;
        prop_assert!((turned / motion.precession_rate() - 1.0).abs() < 1e-11, "{turned} {}", motion.precession_rate());
    }
}

/// Precession rate of an axis about the angular momentum, from the spin: `G (2E − Iω²)/(G² − I²ω²)`, averaged over the polhode.
#[test]
fn mean_precession_of_the_long_axis_is_the_quadrature() {
    let moments = [0.61, 0.965, 1.0];
    for ratio in [0.62, 0.8, 0.95, 0.9651, 0.97, 0.99, 0.9999] {
        let motion = FreeRotation::at_ratio(moments, 1.3, ratio);
        assert_eq!(motion.mode(), if ratio > 0.965 { Mode::ShortAxis } else { Mode::LongAxis });
        let (G, twice_energy) = (motion.angular_momentum(), 2.0 * motion.energy());
        let points = 4000;
        let mean = (0..points).map(|i| {
            let omega = motion.omega(motion.polhode_period() * f64::from(i) / f64::from(points))[0];
            G * (twice_energy - moments[0] * omega * omega) / (G * G - (moments[0] * omega).powi(2))
        });
        let mean = mean.sum::<f64>() / f64::from(points);
        let found = motion.long_axis_precession_rate();
        assert!((found / mean - 1.0).abs() < 1e-11, "{ratio}: {found}, by quadrature {mean}");
    }
}

/// Near an axis and near the separatrix no digits are lost: the small numbers are exact limits.
#[test]
fn limits_lose_no_digits() {
    let [I1, I2, I3] = [0.7, 0.9, 1.2];
    for small in [1e-3, 1e-8, 1e-60, 1e-150] {
        let motion = FreeRotation::through([I1, I2, I3], [small, 0.0, 1.0]).unwrap();
        assert!((motion.omega(0.0)[0] / small - 1.0).abs() < 1e-14);
        let sigma = ((I3 - I1) * (I3 - I2) / (I1 * I2)).sqrt();
        let period = motion.polhode_period();
        assert!((period / (TAU / sigma) - 1.0).abs() < 1e-14 + small * small, "{period}");
        let quarter = motion.omega(0.25 * period);
        let expected = small * (I1 * (I3 - I1) / (I2 * (I3 - I2))).sqrt();
        assert!((quarter[1] / expected - 1.0).abs() < 1e-13 + small * small, "{quarter:?}");
    }
    // On the separatrix ω₁ and ω₃ decay as 1/cosh.
    let third = 1.0;
    let first = third * (I3 * (I3 - I2) / (I1 * (I2 - I1))).sqrt();
    let motion = FreeRotation::through([I1, I2, I3], [first, 0.0, third]).unwrap();
    assert!(motion.polhode_period() > 60.0);
    let rate = ((I3 - I2) * (I3 - I1) / (I1 * I2)).sqrt() * third;
    let later = motion.omega(5.0 / rate);
    assert!((later[2] * 5f64.cosh() - third).abs() < 1e-10, "{later:?}");
}

/// Bodies of revolution precess uniformly, spheres do not at all.
#[test]
fn symmetric_bodies_are_no_exceptions() {
    let omega = [0.3, -0.4, 1.1];
    for moments in [[1.0, 1.0, 1.5], [0.5, 1.2, 1.2]] {
        let motion = FreeRotation::through(moments, omega).unwrap();
        let axis = motion.mode().circled();
        for t in [0.7, 12.0] {
            let later = motion.omega(t);
            assert!((later[axis] - omega[axis]).abs() < 1e-14);
            let turn =
                (moments[2] - moments[0]) / if axis == 2 { moments[0] } else { moments[2] } * omega[axis] * t;
            let (a, b) = (omega[(axis + 1) % 3], omega[(axis + 2) % 3]);
            let sign = if axis == 2 { 1.0 } else { -1.0 };
            let expected = a * turn.cos() - sign * b * turn.sin();
            assert!((later[(axis + 1) % 3] - expected).abs() < 1e-13, "{later:?} {expected}");
        }
    }
    let sphere = FreeRotation::through([2.0; 3], omega).unwrap();
    assert!(gap(sphere.omega(7.0), omega) < 1e-15, "{:?}", sphere.omega(7.0));
    let [before, after] = [3.0, 3.002].map(|t| sphere.attitude(t)[0]);
    let slope = scale(1.0 / 0.002, add(after, scale(-1.0, before)));
    assert!(gap(slope, cross(sphere.attitude(3.001)[0], omega)) < 1e-5, "{slope:?}");
}

/// Periods give a motion, and the motion gives the periods.
#[test]
fn observed_periods_are_those_of_the_motion_found() {
    let moments = [2.1, 3.3, 3.5];
    for (ratio, G) in [(0.999, 2.0), (0.96, 3.0), (0.9, 0.1), (0.65, 5.0)] {
        let motion = FreeRotation::at_ratio(moments, G, ratio);
        let observed = ObservedPeriods::from_motion(&motion);
        let found = observed.motion(moments).unwrap();
        assert!((found.angular_momentum() / G - 1.0).abs() < 1e-9, "{} {G}", found.angular_momentum());
        assert!((found.energy() / motion.energy() - 1.0).abs() < 1e-9);
        assert_eq!(found.mode(), motion.mode());
    }
    let none = ObservedPeriods { rotation: 1.0, precession: 100.0, mode: Mode::ShortAxis };
    assert!(matches!(none.motion(moments), Err(ObservedError::Ratio { .. })));
}

/// 99942 Apophis, 263 h and 27.38 h in the short-axis mode: with the moments and the energy of the published model the ratio
/// of the periods is 8.7.
#[test]
fn apophis_has_the_published_ratio_of_periods() {
    let motion = FreeRotation::at_ratio([0.61, 0.965, 1.0], 1.0, 1.0 / 1.024);
    let ObservedPeriods { rotation, precession, mode } = ObservedPeriods::from_motion(&motion);
    assert_eq!(mode, Mode::ShortAxis);
    assert!((rotation / precession - 8.7).abs() < 0.05, "{}", rotation / precession);
}

/// 4179 Toutatis, long-axis mode, 5.41 and 7.35 days, moments 3.22 and 3.09: the energy over the least one is 1.9.
#[test]
fn toutatis_has_the_published_energy() {
    let moments = [1.0, 3.085, 3.2275];
    let day = 86_400.0;
    let observed = ObservedPeriods { rotation: 5.41 * day, precession: 7.35 * day, mode: Mode::LongAxis };
    let motion = observed.motion(moments).unwrap();
    let over = 2.0 * motion.energy() * moments[2] / motion.angular_momentum().powi(2);
    assert!((1.895..1.905).contains(&over), "{over}");
}

/// The three angles give the attitude again, `R_z(φ) R_x(θ) R_z(ψ)`, and so do the angles of the motion through them.
#[test]
fn euler_angles_are_those_of_the_attitude() {
    for (mode, xi, t) in
        [(Mode::ShortAxis, 0.3, 1.7), (Mode::LongAxis, 1.0, 4.4), (Mode::LongAxis, -3.0, 0.2)]
    {
        let motion = FreeRotation::at_logit([0.31, 0.96, 1.0], 1.3, mode, xi);
        let angles = EulerAngles::from_motion(&motion, t);
        let about = |angle: f64, axis: Vector3<f64>| *Rotation3::new(angle * axis).matrix();
        let (z, x) = (Vector3::z(), Vector3::x());
        let R = about(angles.precession, z) * about(angles.nutation, x) * about(angles.rotation, z);
        let attitude = motion.attitude(t);
        for (row, expected) in attitude.iter().enumerate() {
            let in_order = [expected[1], expected[2], expected[0]]; // intermediate, short, long
            for (column, expected) in in_order.iter().enumerate() {
                assert!((R[(row, column)] - expected).abs() < 1e-14, "{row} {column}");
            }
        }
        let again = angles.motion([0.31, 0.96, 1.0], 1.3).unwrap();
        for (found, expected) in again.omega(0.0).iter().zip(motion.omega(t)) {
            assert!((found - expected).abs() < 1e-14);
        }
    }
}

#[test]
fn greatest_nutation_is_the_one_asked_for() {
    for (mode, degrees) in [(Mode::ShortAxis, 5.0), (Mode::ShortAxis, 89.0), (Mode::LongAxis, 40.0)] {
        let motion =
            FreeRotation::at_nutation([0.31, 0.76, 1.0], 2.0, mode, f64::to_radians(degrees)).unwrap();
        assert_eq!(motion.mode(), mode);
        assert!((motion.nutation()[1].to_degrees() / degrees - 1.0).abs() < 1e-12);
    }
}
