//! Ageing along the levels of the slow energy, for moments that are nearly equal, against integrations and laws.

use quasirigid::averaging::{LevelEvolution, Until};
use quasirigid::dynamics::{Options, Sample, SpinState, all_steady_spins, propagate};
use quasirigid::elements::{Assembly, Carrier};
use quasirigid::math::rotation::ALIGNED;
use quasirigid::math::sym::norm;
use quasirigid::reduction::reduce;

#[path = "../laws/support.rs"]
#[allow(dead_code)]
mod support;
#[path = "../laws/transform.rs"]
#[allow(dead_code)]
mod transform;

use crate::support::{Sprung, sprung_body};

/// A mass off every axis on a carrier with which the whole has nearly equal moments, 2, 2.00008 and 2.0002 kg·m².
fn near_sphere() -> Assembly {
    let inertia = [
        [1.940909090909091, 0.05454545454545454, -0.08181818181818182],
        [0.05454545454545454, 1.7955345454545455, -0.02727272727272727],
        [-0.08181818181818182, -0.02727272727272727, 1.818381818181818],
    ];
    let carrier = Carrier { mass: 5.0, center_of_mass: [0.0; 3], inertia };
    let mass = Sprung { mass: 0.5, position: [0.6, 0.2, -0.3], stiffness: [200.0; 3], damping: [6.0; 3] };
    sprung_body(carrier, &[mass])
}

const SPIN: [f64; 3] = [0.9, 0.5, 1.2];

#[test]
fn explore() {
    let body = near_sphere().body().unwrap();
    for order in [3, 5, 7] {
        let reduced = reduce(&body, order).unwrap();
        let K = reduced.momentum(SPIN);
        let t = std::time::Instant::now();
        let all = all_steady_spins(&reduced, norm(K));
        println!(
            "order {order}: {} {} {}  {:?}",
            all.isolated.len(),
            all.families,
            all.complete,
            t.elapsed()
        );
        for one in &all.isolated {
            println!("   {:?} {:?} {:?}", one.kind, one.spin, one.momentum.map(|k| k / norm(K)));
        }
        let t = std::time::Instant::now();
        let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
        let level = levels.level(K).unwrap();
        println!("  {level:?} {:?}", t.elapsed());
        for (K, kind) in levels.steady() {
            println!("     {kind:?} {K:?} {}", levels.slow_energy(K));
        }
        let turns = (22200.0 / level.period).round().max(1.0);
        let mut samples: Vec<Sample> = Vec::new();
        let start = SpinState { omega: SPIN, attitude: ALIGNED };
        propagate(&reduced, start, &[turns * level.period], Options::default(), &mut samples).unwrap();
        let last = samples.last().unwrap();
        println!("  integrated {} W over {} s ({turns} turns)", last.dissipated / last.t, last.t);
        let t = std::time::Instant::now();
        let passage = levels.follow(K, Until::EnergyLeft(0.01), 11);
        match passage {
            Ok(p) => {
                println!("{:?} {:?} {:?}", p.ending, p.separatrices, t.elapsed());
                for row in p.rows {
                    println!(
                        "  {:.6e} {:.3e} {:.3e} {:?} {:.2} {:.3e}",
                        row.time, row.turns, row.energy, row.nutation, row.period, row.power
                    );
                }
            }
            Err(e) => println!("{e:?}"),
        }
    }
}
