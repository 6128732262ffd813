//! Parts of a structure that move in a mode, whose coordinates are displacements of all of it. (M5)

use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_math::vec3::dot;

use super::whirl::booms;

/// Two unlike booms on one hub: each bends at frequencies of its own, the longer one at the lower.
#[test]
fn modes_name_the_boom_that_bends() {
    let body = booms(1e-3);
    let axis = quasirigid::model::Principal::compute(body.invariants().J).axes[2];
    let steady = RelativeEquilibrium::near(&body, axis, SpinMagnitude::Rate(0.05)).unwrap();
    let modes = SpinModes::about(&body, steady).unwrap().modes;
    let share = |mode: &quasirigid::modes::SpinMode, part: &str| {
        mode.moves.iter().find(|(name, _)| name == part).map_or(0.0, |(_, share)| *share)
    };
    let bent: Vec<_> = modes.iter().filter(|mode| !mode.nutation && mode.frequency > 0.0).take(8).collect();
    for mode in &bent {
        let [long, short] = ["long", "short"].map(|part| share(mode, part));
        let sum: f64 = mode.moves.iter().map(|(_, share)| share).sum();
        assert!((sum - 1.0).abs() < 0.01, "{:?}", mode.moves);
        let (most, least, name) = if long > short { (long, short, "long") } else { (short, long, "short") };
        let together = "\"long\" and \"short\"".to_owned();
        let expected = if least >= 0.5 * most { together } else { format!("{name:?}") };
        let name = mode.name.split_once(", ").map_or(mode.name.as_str(), |(name, _)| name);
        assert_eq!(name, expected, "{:?}", mode.moves);
    }
    assert!(share(bent[0], "long") > 0.99, "{:?}", bent[0].moves);
    assert!(bent.iter().any(|mode| share(mode, "short") > 0.9), "{bent:?}");
    assert!(modes.iter().all(|mode| !mode.name.starts_with("shape")), "{modes:?}");
}

/// The masses of the parts add up to that of all coordinates.
#[test]
fn masses_of_parts_add_up() {
    let body = booms(0.0);
    let n = body.coordinates().len();
    for j in 0..n {
        let mut unit = vec![0.0; n];
        unit[j] = 1.0;
        // The mass matrix of a free body is without the motion of its centre of mass.
        let (S, mass) = (&body.invariants().S, body.invariants().mass);
        let mut whole = body.mass_times(&unit);
        whole.iter_mut().zip(S).for_each(|(entry, own)| *entry += dot(*own, S[j]) / mass);
        let mut sum = vec![0.0; n];
        for part in body.part_masses() {
            sum.iter_mut().zip(part.mass.times(&unit)).for_each(|(sum, own)| *sum += own);
        }
        let scale = whole.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        assert!(whole.iter().zip(&sum).all(|(a, b)| (a - b).abs() < 1e-9 * scale), "{j}: {whole:?} {sum:?}");
    }
}
