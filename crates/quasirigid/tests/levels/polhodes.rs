//! Where moments differ much, a level is nearly a rigid polhode.

use nalgebra::{Matrix3, Vector3};
use quasirigid::averaging::{Evolution, LevelEvolution, PolynomialPower, Stage, Until};
use quasirigid::elements::Assembly;
use quasirigid::math::sym::norm;
use quasirigid::model::Mode;
use quasirigid::reduction::reduce;

use crate::bodies::with_tensor;
use crate::transform::stiffened;

fn body(epsilon: f64) -> Assembly {
    let distinct = with_tensor(Matrix3::from_diagonal(&Vector3::new(1.5, 2.0, 2.5)));
    stiffened(&distinct, epsilon.powi(-2), epsilon.powi(-1))
}

/// Time between two wobbles about the axis of greatest inertia, along levels and along polhodes: they close up as `ε²`.
#[test]
fn ageing_along_levels_tends_to_that_along_polhodes() {
    let gap = |epsilon: f64| {
        let reduced = reduce(&body(epsilon).body().unwrap(), 3).unwrap();
        let omega = [0.5, 0.1, 0.9];
        let K = reduced.momentum(omega);
        let power = PolynomialPower::of(&reduced);
        let evolution = Evolution::new(&power, norm(K));
        let moments = [1.5, 2.0, 2.5];
        let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
        let passage = levels.follow(K, Until::Wobble(0.1), 3).unwrap();
        let [first, .., last] = &passage.rows[..] else { panic!("{passage:?}") };
        let stage = |wobble: f64| {
            let motion =
                quasirigid::averaging::FreeRotation::at_nutation(moments, norm(K), Mode::ShortAxis, wobble)
                    .unwrap();
            Stage::of(&motion).unwrap()
        };
        let along = evolution.passage(stage(first.nutation[1]), stage(0.1));
        assert!((last.nutation[1] - 0.1).abs() < 1e-9, "{last:?}");
        [last.time / along.time - 1.0, last.turns / along.turns - 1.0].map(f64::abs)
    };
    let [coarse, fine, finest] = [0.5, 0.25, 0.125].map(gap);
    println!("{coarse:?} {fine:?} {finest:?}");
    for i in 0..2 {
        let orders = [coarse[i] / fine[i], fine[i] / finest[i]].map(f64::log2);
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.4), "{orders:?}");
        assert!(finest[i] < 1e-3, "{finest:?}");
    }
}

/// From the axis of least inertia through the separatrix, time and turns as along polhodes.
#[test]
fn the_way_leads_through_the_separatrix() {
    let reduced = reduce(&body(0.05).body().unwrap(), 3).unwrap();
    let omega = [1.0, 0.3, 0.1];
    let K = reduced.momentum(omega);
    let power = PolynomialPower::of(&reduced);
    let evolution = Evolution::new(&power, norm(K));
    let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
    let passage = levels.follow(K, Until::EnergyLeft(0.01), 12).unwrap();
    let start = evolution.stage(norm(K).powi(2) / (2.0 * reduced.energy(omega) * 2.5)).unwrap();
    let end = evolution.faded(start, 0.01).unwrap();
    let along = evolution.passage(start, end);
    let last = passage.rows.last().unwrap();
    println!("{} {}, {} {}", last.time, along.time, last.turns, along.turns);
    assert!((last.time / along.time - 1.0).abs() < 1e-3);
    assert!((last.turns / along.turns - 1.0).abs() < 1e-3);
    let [separatrix] = &passage.separatrices[..] else { panic!("{:?}", passage.separatrices) };
    assert!(separatrix.alike && separatrix.ways.len() == 2);
    assert!(separatrix.ways.iter().all(|way| (way.share - 0.5).abs() < 1e-6));
    let known = evolution.separatrix_time(start, end).unwrap();
    assert!((separatrix.time / known - 1.0).abs() < 1e-3, "{} {known}", separatrix.time);
}
