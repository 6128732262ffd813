//! Limits of the response, and laws that it keeps.

use nalgebra::Vector3;
use proptest::prelude::*;
use quasirigid::averaging::{Evolution, FreeRotation, HillError, HillResponse, MeanPower, Response};
use quasirigid::elements::{Assembly, Cavity, CavityShape, Regime, Wheel, WheelSpeed};
use quasirigid::model::{Mode, Principal, Rheology};
use quasirigid::problems::ring_of_points;
use quasirigid_math::rotation::ALIGNED;

use super::bodies::{motion, skew};
use crate::support::rotors::{ball, flywheel};
use crate::support::transform::{rescaled, rotated};
use crate::support::{assemblies, cases, direction, rotation, units};

/// Far below the elastic frequencies the couplings add the square of spin over frequency.
#[test]
fn slow_spins_take_the_uncoupled_power() {
    for (mode, xi) in [(Mode::ShortAxis, 0.7), (Mode::LongAxis, -1.0)] {
        let gaps = [0.1, 0.05, 0.025].map(|epsilon| {
            let body = skew([1.1, 0.7], [90.0, 70.0], 0.3).body().unwrap().stiffened(epsilon).unwrap();
            let motion = motion(&body, 0.9, mode, xi);
            let [coupled, alone] = [
                HillResponse::compute(&body).unwrap().mean_power(&motion),
                Response::compute(&body).unwrap().mean_power(&motion),
            ];
            coupled / alone - 1.0
        });
        let orders = [gaps[0] / gaps[1], gaps[1] / gaps[2]].map(f64::log2);
        println!("{mode:?}: gaps {gaps:?}, orders {orders:?}");
        assert!((orders[1] - 2.0).abs() < 0.05 && gaps[2].abs() < 0.01, "{gaps:?} {orders:?}");
    }
}

/// Materials with a modulus at every frequency have the same limit, harmonic by harmonic.
#[test]
fn slow_spins_take_the_uncoupled_power_of_materials() {
    let laws = [
        Rheology::QualityFactor { factor: 40.0 },
        Rheology::StandardLinear { time: 0.4, strength: 0.7 },
        Rheology::Maxwell { time: 30.0 },
    ];
    for law in laws {
        let gaps = [0.1, 0.05].map(|epsilon: f64| {
            let mut assembly = skew([1.1, 0.7], [90.0 / epsilon.powi(2), 70.0 / epsilon.powi(2)], 0.0);
            assembly.springs.iter_mut().for_each(|spring| spring.rheology = law.clone());
            let body = assembly.body().unwrap();
            let motion = motion(&body, 0.9, Mode::ShortAxis, 0.7);
            let [coupled, alone] = [
                HillResponse::compute(&body).unwrap().mean_power(&motion),
                Response::compute(&body).unwrap().mean_power(&motion),
            ];
            coupled / alone - 1.0
        });
        println!("{law:?}: {gaps:?}");
        assert!(((gaps[0] / gaps[1]).log2() - 2.0).abs() < 0.1 && gaps[1].abs() < 0.05, "{law:?}: {gaps:?}");
    }
}

/// About an axis a ball and a ball of liquid respond to one mean rotation, which the uncoupled response has too; in a large wobble the
/// uncoupled response lacks it.
#[test]
fn balls_about_an_axis_take_the_uncoupled_power() {
    let tank = Cavity {
        name: "tank".into(),
        shape: CavityShape::Ellipsoid { semi_axes: [0.2; 3] },
        center: [0.1, -0.3, 0.2],
        attitude: ALIGNED,
        density: 900.0,
        viscosity: 1e-3,
        resolution: 4,
        regime: Regime::default(),
        modes: 0,
    };
    let base = Assembly { points: Vec::new(), springs: Vec::new(), ..skew([0.2, 0.1], [40.0, 30.0], 0.1) };
    let inside = [
        Assembly { rotors: vec![ball(0.4, 0.3)], ..base.clone() },
        Assembly { cavities: vec![tank], ..base },
    ];
    for assembly in inside {
        let body = assembly.body().unwrap();
        let (hill, response) = (HillResponse::compute(&body).unwrap(), Response::compute(&body).unwrap());
        let gaps = [30.0, 1.0].map(|xi| {
            let motion = motion(&body, 2.0, Mode::ShortAxis, xi);
            (hill.mean_power(&motion) / response.mean_power(&motion) - 1.0).abs()
        });
        println!("{gaps:?}");
        assert!(gaps[0] < 1e-9, "{gaps:?}");
        let tumbling = motion(&body, 2.0, Mode::ShortAxis, 1.0);
        let (_, rate) = hill.state(&tumbling, 0.3).unwrap();
        assert!(rate.iter().all(|rate| *rate != 0.0), "liquids have rates in their coordinates");
    }
}

/// A wobble of 1e-8 has the rate of one of 1e-3; on the way the power falls as its square.
#[test]
fn a_small_wobble_loses_no_digits() {
    let body = skew([0.2, 0.1], [40.0, 30.0], 0.1).body().unwrap();
    let hill = HillResponse::compute(&body).unwrap();
    let rates = [14.0, 20.0, 36.0].map(|xi| {
        let motion = motion(&body, 5.0, Mode::ShortAxis, xi);
        hill.mean_power(&motion) / (2.0 * motion.energy_from_axis())
    });
    assert!((rates[1] / rates[2] - 1.0).abs() < 1e-7, "{rates:?}");
    assert!((rates[0] / rates[2] - 1.0).abs() < 1e-4, "{rates:?}");
    let G = motion(&body, 5.0, Mode::ShortAxis, 1.0).angular_momentum();
    let rate = Evolution::new(&hill, G).wobble_rate(Mode::ShortAxis);
    assert!((rate / rates[2] - 1.0).abs() < 1e-8, "{rate} {rates:?}");
}

/// Next to the separatrix the harmonics suffice, on it there is no power, and a spin about an axis has none.
#[test]
fn ends_of_the_range() {
    let body = skew([0.2, 0.1], [40.0, 30.0], 0.1).body().unwrap();
    let hill = HillResponse::compute(&body).unwrap();
    let moments = hill.principal().moments;
    for mode in [Mode::ShortAxis, Mode::LongAxis] {
        let powers = [-10.0, -20.0, -30.0].map(|xi| {
            let motion = motion(&body, 2.0, mode, xi);
            let response = hill.periodic(&motion).unwrap();
            println!("{mode:?} {xi}: {} harmonics, {:e}", response.harmonics(), response.truncation());
            assert!(response.truncation() < 1e-10 && response.residual() < 1e-10);
            response.power() * motion.polhode_period()
        });
        // Each crossing of the middle axis takes the same energy.
        assert!((powers[1] / powers[2] - 1.0).abs() < 1e-3, "{powers:?}");
    }
    let separatrix = FreeRotation::at_ratio(moments, 3.0, moments[1] / moments[2]);
    if !separatrix.polhode_period().is_finite() {
        assert_eq!(hill.mean_power(&separatrix), 0.0);
        assert_eq!(hill.periodic(&separatrix).unwrap_err(), HillError::NoPeriod);
    }
    let steady = FreeRotation::through(moments, [0.0, 0.0, 2.0]).unwrap();
    let response = hill.periodic(&steady).unwrap();
    assert_eq!((response.power(), response.share()), (0.0, 0.0));
    let (q, rate) = hill.state(&steady, 1.0).unwrap();
    assert!(q.iter().any(|q| *q != 0.0) && rate.iter().all(|rate| *rate == 0.0), "stretched and at rest");
}

#[test]
fn momentum_wheels_are_refused() {
    let wheel = Wheel {
        name: "wheel".into(),
        axis: [0.0, 0.3, 1.0],
        speed: WheelSpeed::Constant { angular_momentum: 2.0 },
    };
    let body = Assembly { wheels: vec![wheel], ..skew([0.2, 0.1], [40.0, 30.0], 0.1) }.body().unwrap();
    assert_eq!(HillResponse::compute(&body).unwrap_err(), HillError::Wheels);
}

/// A steady mean rate of a rotor is driven by a wobble, and its friction is part of the power.
#[test]
fn powers_of_harmonics_add_up() {
    let rotors = vec![flywheel([0.3, -0.5, 0.8], 0.6, 0.4)];
    let body = Assembly { rotors, ..skew([0.2, 0.1], [40.0, 30.0], 0.1) }.body().unwrap();
    let hill = HillResponse::compute(&body).unwrap();
    let motion = motion(&body, 3.0, Mode::ShortAxis, 0.4);
    let response = hill.periodic(&motion).unwrap();
    let sum: f64 = response.harmonic_powers().map(|(_, power)| power).sum();
    assert!((sum / response.power() - 1.0).abs() < 1e-13);
    assert!(response.harmonic_powers().all(|(_, power)| power >= 0.0));
}

/// A body of forty coordinates, at a spin near the lowest frequencies.
#[test]
fn many_coordinates() {
    let body = ring_of_points(13).body().unwrap();
    let hill = HillResponse::compute(&body).unwrap();
    let lowest = Response::compute(&body).unwrap().frequencies().next().unwrap().0;
    for (share, xi) in [(0.1, 0.5), (0.5, 0.5), (0.8, 2.0)] {
        let motion = motion(&body, share * lowest, Mode::ShortAxis, xi);
        let clock = std::time::Instant::now();
        let response = hill.periodic(&motion).unwrap();
        println!("{share}: {} harmonics, {:?}", response.harmonics(), clock.elapsed());
        assert!(response.residual() < 1e-12 && response.truncation() < 1e-10);
    }
}

proptest! {
    #![proptest_config(cases(12))]

    /// Axes and units change nothing: power, share and multipliers.
    #[test]
    fn axes_and_units_change_nothing(
        assembly in assemblies(), R in rotation(), units in units(), direction in direction()
    ) {
        let answers = |assembly: &Assembly, direction: Vector3<f64>, time: f64| {
            let body = assembly.body().unwrap();
            let principal = Principal::compute(body.invariants().J);
            let omega = principal.components((direction * 3.0 / time).into());
            let motion = FreeRotation::through(principal.moments, omega).unwrap();
            let hill = HillResponse::compute(&body).unwrap();
            let floquet = hill.floquet(&motion).unwrap();
            let [re, im] = floquet.multipliers.first().copied().unwrap_or_default();
            (hill.mean_power(&motion), hill.share(&motion).unwrap(), re.hypot(im))
        };
        let direction = Vector3::from(direction);
        let (power, share, multiplier) = answers(&assembly, direction, 1.0);
        let turned = rotated(&assembly, &R);
        let (power_turned, share_turned, multiplier_turned) = answers(&turned, R * direction, 1.0);
        prop_assert!((power_turned / power - 1.0).abs() < 1e-8, "{power_turned:e} {power:e}");
        prop_assert!((share_turned / share - 1.0).abs() < 1e-8, "{share_turned:e} {share:e}");
        prop_assert!((multiplier_turned - multiplier).abs() < 1e-8, "{multiplier_turned} {multiplier}");
        let (power_other, share_other, multiplier_other) = answers(&rescaled(&assembly, units), direction, units.time);
        let expected = power * units.factor([2, 1, -3]);
        prop_assert!((power_other / expected - 1.0).abs() < 1e-8, "{power_other:e} {expected:e}");
        prop_assert!((share_other / share - 1.0).abs() < 1e-8, "{share_other:e} {share:e}");
        prop_assert!((multiplier_other - multiplier).abs() < 1e-8, "{multiplier_other} {multiplier}");
    }
}
