//! Modes of a spinning body with two sprung masses, from an independent code: `data/published/spin_modes`.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use quasirigid::elements::{Assembly, End, Point, PointMotion, Spring};
use quasirigid::model::Rheology;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_math::vec3::norm;

use crate::support::parts;

const MODES: &str = include_str!("../../../../data/published/spin_modes/modes.csv");
const EQUILIBRIA: &str = include_str!("../../../../data/published/spin_modes/equilibria.csv");

/// Relative tolerance; the table is good to 1e-9 of the largest eigenvalue of a case.
const TOLERANCE: f64 = 1e-8;

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').map(|field| field.parse().unwrap()).collect()
}

fn body() -> Assembly {
    let masses = [(2.0, [0.8, 0.3, 0.5]), (1.5, [-0.6, 0.5, -0.2])];
    let springs = [([60.0, 90.0, 70.0], [3.0, 2.0, 4.0]), ([50.0, 80.0, 65.0], [2.0, 3.0, 1.0])];
    let point = |(i, (mass, position)): (usize, &(f64, [f64; 3]))| Point {
        name: format!("mass {i}"),
        mass: *mass,
        position: *position,
        motion: PointMotion::Free,
    };
    let spring = |(i, (stiffness, damping)): (usize, &([f64; 3], [f64; 3]))| Spring {
        name: ["first", "second"][i].into(),
        from: End::Point(i),
        to: End::Carrier,
        law: parts::diagonal(*stiffness, *damping),
        rheology: Rheology::Elastic,
    };
    Assembly {
        carrier: Some(parts::carrier(40.0, [0.0; 3], parts::diag([9.0, 13.0, 16.0]))),
        points: masses.iter().enumerate().map(point).collect(),
        springs: springs.iter().enumerate().map(spring).collect(),
        ..Assembly::default()
    }
}

#[test]
fn modes_of_a_spinning_body_are_those_of_an_independent_code() {
    let body = body().body().unwrap();
    for (case, line) in EQUILIBRIA.lines().skip(1).enumerate() {
        let row = numbers(line);
        let published: [f64; 3] = [row[1], row[2], row[3]];
        let spin = norm(published);
        let found = RelativeEquilibrium::near(&body, published, SpinMagnitude::Rate(spin)).unwrap();
        for axis in 0..3 {
            assert!((found.omega[axis] - published[axis]).abs() < TOLERANCE * spin, "{:?}", found.omega);
        }
        let largest = row[4..].iter().fold(0.0_f64, |largest, q| largest.max(q.abs()));
        for (found, published) in found.q.iter().zip(&row[4..]) {
            assert!(
                (found - published).abs() < TOLERANCE * largest,
                "case {}: {found} {published}",
                case + 1
            );
        }
        let modes = SpinModes::about(&body, found).unwrap();
        let rows: Vec<Vec<f64>> = MODES.lines().skip(1).map(numbers).collect();
        let rows: Vec<_> = rows.iter().filter(|row| row[0] as usize == case + 1).collect();
        let oscillating: Vec<_> = modes.modes.iter().filter(|mode| mode.frequency > 0.0).collect();
        assert_eq!(oscillating.len(), rows.len());
        assert!(modes.modes[0].nutation);
        for row in rows {
            let [decay, frequency] = [row[1], row[2]];
            let mode = oscillating
                .iter()
                .min_by(|a, b| (a.frequency - frequency).abs().total_cmp(&(b.frequency - frequency).abs()))
                .unwrap();
            let errors = [mode.decay_rate / decay - 1.0, mode.frequency / frequency - 1.0];
            println!("case {} {frequency:.6} rad/s: errors {:.1e} {:.1e}", case + 1, errors[0], errors[1]);
            assert!(errors.iter().all(|error| error.abs() < TOLERANCE), "{mode:?}");
            for (name, share) in [("first", row[3]), ("second", row[4])] {
                let found = mode.dissipation.iter().find(|(known, _)| known == name);
                let found = found.map_or(0.0, |(_, share)| *share);
                assert!((found - share).abs() < 1e-7, "{name}: {found} {share}");
            }
        }
    }
}
