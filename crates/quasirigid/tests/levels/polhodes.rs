//! Limit of different moments: a level is nearly a rigid polhode.

use nalgebra::{Matrix3, Vector3};
use quasirigid::averaging::{Evolution, FreeRotation, LevelEvolution, PolynomialPower, RotationState, Until};
use quasirigid::dynamics::{Options, Sample, Start, propagate};
use quasirigid::elements::Assembly;
use quasirigid::model::{Mode, Principal};
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::{ALIGNED, to_inertial};
use quasirigid_math::vec3::norm;

use super::bodies::with_tensor;
use crate::support::transform::stiffened;

fn body(epsilon: f64) -> Assembly {
    let distinct = with_tensor(Matrix3::from_diagonal(&Vector3::new(1.5, 2.0, 2.5)));
    stiffened(&distinct, epsilon.powi(-2), epsilon.powi(-1))
}

/// Time between two wobbles about the axis of greatest inertia, along levels and along polhodes: they converge as `ε²`.
#[test]
fn ageing_along_levels_tends_to_that_along_polhodes() {
    let gap = |epsilon: f64| {
        let reduced = reduce(&body(epsilon).body().unwrap(), 3).unwrap();
        let omega = [0.5, 0.1, 0.9];
        let K = reduced.angular_momentum(omega);
        let power = PolynomialPower::from_reduced(&reduced);
        let evolution = Evolution::new(&power, norm(K));
        let moments = [1.5, 2.0, 2.5];
        let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
        let passage = levels.follow(K, Until::Wobble(0.1), 3).unwrap();
        let [first, .., last] = &passage.rows[..] else { panic!("{passage:?}") };
        let rotation_state = |wobble: f64| {
            let motion = FreeRotation::at_nutation(moments, norm(K), Mode::ShortAxis, wobble).unwrap();
            RotationState::from_motion(&motion).unwrap()
        };
        let along = evolution.passage(rotation_state(first.nutation[1]), rotation_state(0.1));
        assert!((last.nutation[1] - 0.1).abs() < 1e-9, "{last:?}");
        [last.time / along.time - 1.0, last.revolutions / along.revolutions - 1.0].map(f64::abs)
    };
    let [coarse, fine, finest] = [0.5, 0.25, 0.125].map(gap);
    println!("{coarse:?} {fine:?} {finest:?}");
    for i in 0..2 {
        let orders = [coarse[i] / fine[i], fine[i] / finest[i]].map(f64::log2);
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.4), "{orders:?}");
        assert!(finest[i] < 1e-3, "{finest:?}");
    }
}

/// From the axis of least inertia through the separatrix, time and revolutions as along polhodes.
#[test]
fn the_way_leads_through_the_separatrix() {
    let reduced = reduce(&body(0.05).body().unwrap(), 3).unwrap();
    let omega = [1.0, 0.3, 0.1];
    let K = reduced.angular_momentum(omega);
    let power = PolynomialPower::from_reduced(&reduced);
    let evolution = Evolution::new(&power, norm(K));
    let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
    let passage = levels.follow(K, Until::EnergyLeft(0.01), 12).unwrap();
    let start = evolution.rotation_state(norm(K).powi(2) / (2.0 * reduced.energy(omega) * 2.5)).unwrap();
    let end = evolution.faded(start, 0.01).unwrap();
    let along = evolution.passage(start, end);
    let last = passage.rows.last().unwrap();
    println!("{} {}, {} {}", last.time, along.time, last.revolutions, along.revolutions);
    assert!((last.time / along.time - 1.0).abs() < 1e-3);
    assert!((last.revolutions / along.revolutions - 1.0).abs() < 1e-3);
    let [separatrix] = &passage.separatrices[..] else { panic!("{:?}", passage.separatrices) };
    assert!(separatrix.alike && separatrix.ways.len() == 2);
    assert!(separatrix.ways.iter().all(|way| (way.share - 0.5).abs() < 1e-6));
    let known = evolution.separatrix_time(start, end).unwrap();
    assert!((separatrix.time / known - 1.0).abs() < 1e-3, "{} {known}", separatrix.time);
}

/// Mean precession of the axis of least inertia in both modes: as `ε²` to that of rigid polhodes.
#[test]
fn precession_on_a_level_tends_to_that_on_a_polhode() {
    for (omega, mode) in [([0.5, 0.1, 0.9], Mode::ShortAxis), ([-1.0, 0.3, 0.1], Mode::LongAxis)] {
        let gap = |epsilon: f64| {
            let reduced = reduce(&body(epsilon).body().unwrap(), 3).unwrap();
            let K = reduced.angular_momentum(omega);
            let level = LevelEvolution::new(&reduced, norm(K)).unwrap().level(K).unwrap();
            let motion = FreeRotation::through([1.5, 2.0, 2.5], reduced.Omega.vector(K)).unwrap();
            assert_eq!(motion.mode(), mode);
            (level.long_axis_precession_rate / motion.long_axis_precession_rate() - 1.0).abs()
        };
        let [coarse, fine, finest] = [0.4, 0.2, 0.1].map(gap);
        let orders = [coarse / fine, fine / finest].map(f64::log2);
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.4), "{mode:?} {orders:?}");
    }
}

/// The axis of least inertia followed through many revolutions of a level by the attitude of a history, where elasticity matters. (N7)
#[test]
fn precession_on_a_level_is_that_of_a_history() {
    for omega in [[0.5, 0.1, 0.9], [1.0, 0.3, -0.1], [0.2, 0.9, -0.5]] {
        let lossless = with_tensor(Matrix3::from_diagonal(&Vector3::new(1.5, 2.0, 2.5)));
        let reduced = reduce(&stiffened(&lossless, 40.0, 1e-9).body().unwrap(), 4).unwrap();
        let K = reduced.angular_momentum(omega);
        let level = LevelEvolution::new(&reduced, norm(K)).unwrap().level(K).unwrap();
        let axis = Principal::compute(reduced.J).axes[0];
        let revolutions = 20_u32;
        let times: Vec<f64> = (0..=revolutions * 400).map(|i| level.period * f64::from(i) / 400.0).collect();
        let start = Start::new(omega, ALIGNED);
        let mut samples: Vec<Sample> = Vec::new();
        propagate(&reduced, start, &times, &Options { tolerance: 1e-11, ..Options::default() }, &mut samples)
            .unwrap();
        let azimuth = |sample: &Sample| {
            let [along, axis] =
                [sample.angular_momentum, axis].map(|x| Vector3::from(to_inertial(sample.attitude, x)));
            let pole = along.normalize();
            axis - pole * axis.dot(&pole)
        };
        let pole = Vector3::from(K).normalize();
        let gone: f64 = samples
            .windows(2)
            .map(|pair| {
                let [a, b] = [azimuth(&pair[0]), azimuth(&pair[1])];
                pole.dot(&a.cross(&b)).atan2(a.dot(&b))
            })
            .sum();
        let expected = level.long_axis_precession_rate * level.period * f64::from(revolutions);
        assert!((gone / expected - 1.0).abs() < 1e-8, "{gone} {expected}");
    }
}
