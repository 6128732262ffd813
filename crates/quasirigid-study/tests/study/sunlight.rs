//! Sunlight on a body: histories of every system against the torque in plain vectors, and who refuses it.

use quasirigid_io::model::System;
use quasirigid_math::rotation::Turn;
use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};
use quasirigid_study::Study;

use crate::support::{carrier, column, difference, finished, point, spinning};

pub const CORNERS: [[f64; 3]; 4] = [[1.3, 0.2, -0.1], [-0.4, 1.1, 0.3], [-0.7, -0.9, 0.1], [0.2, 0.3, 1.7]];
pub const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
const SUN: [f64; 3] = [0.48, 0.64, 0.6];

/// A small satellite with a sprung mass inside a tetrahedron, a tenth of an astronomical unit from the Sun.
fn satellite(kind: &str) -> (tempfile::TempDir, Study) {
    let folder = tempfile::tempdir().unwrap();
    let shape = CORNERS.map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat()
        + &FACES.map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1)).concat();
    std::fs::write(folder.path().join("shape.obj"), shape).unwrap();
    let model = carrier(2.0, [0.5, 0.6, 0.8])
        + &point("tip", 0.1, [0.3, 0.1, 0.2], [2e3, 4.0])
        + &spinning([0.02, 0.03, 0.2])
        + "[[force]]\nkind = \"sunlight\"\nfile = \"shape.obj\"\nunit = \"m\"\ntolerance = 0.02\n"
        + kind;
    let study = Study::read_from(&folder.path().join("model.toml"), model.as_bytes(), None).unwrap();
    (folder, study)
}

/// The angular momentum in inertial axes gains the integral of the torque about the centre of mass, face by face at the attitudes of the
/// history, in full, reduced and rigid.
#[test]
fn histories_gain_the_integral_of_the_torque() {
    let (_folder, study) = satellite("direction = [4.8, 6.4, 6]\ndistance = \"0.1 au\"\n");
    let center = study.body.center_of_mass();
    let pressure = 1361.0 / 299_792_458.0 * 100.0;
    let times: Vec<f64> = (0..=400).map(|k| 0.5 * f64::from(k)).collect();
    let mut ends = Vec::new();
    for system in [System::Full, System::Reduced, System::Rigid] {
        let run = finished(&study, system, &times);
        let columns = ["wx", "wy", "wz", "qw", "qx", "qy", "qz"].map(|name| column(&run.columns, name));
        let turns: Vec<Turn<f64>> =
            (0..times.len()).map(|k| Turn::of([3, 4, 5, 6].map(|i: usize| columns[i][k]))).collect();
        let torque = |turn: &Turn<f64>| {
            let sun = turn.to_body(SUN);
            let sum = FACES.iter().fold([0.0; 3], |sum, face| {
                let [a, b, c] = face.map(|k| CORNERS[k]);
                let area = scale(0.5, cross(minus(b, a), minus(c, a)));
                let push = scale(-dot(area, sun).max(0.0), add(sun, scale(2.0 / 3.0, unit(area))));
                add(sum, cross(minus(scale(1.0 / 3.0, add(a, add(b, c))), center), push))
            });
            turn.to_inertial(scale(pressure, sum))
        };
        let simpson = |k: usize| {
            let weight = if k == 0 || k == times.len() - 1 { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
            scale(0.5 / 3.0 * weight, torque(&turns[k]))
        };
        let gained = (0..times.len()).map(simpson).fold([0.0; 3], add);
        // at the start to five millionths of what is gained
        let start = finished(&study, system, &[0.0, 1e-3]).run.last;
        let [from, to] =
            [&start, &run.run.last].map(|at| Turn::of(at.attitude).to_inertial(at.angular_momentum));
        let found = minus(to, from);
        println!("{system:?}: gained {gained:?}, found {found:?}");
        // Simpson's rule meets corners where faces come into the light; the harmonics are off by a few thousandths.
        assert!(difference(found, gained) < 5e-3, "{system:?}: {found:?} {gained:?}");
        assert!(norm(gained) > 1e-4 * norm(from));
        ends.push(found);
    }
    assert!(difference(ends[1], ends[0]) < 2e-3 && difference(ends[2], ends[0]) < 0.1, "{ends:?}");
}

/// An average over free rotations does not know the Sun; modes know one that stands still along the spin, and refuse an orbit.
#[test]
fn evolution_refuses_sunlight_in_words() {
    let (_folder, study) = satellite("orbit = { body = \"Sun\", semi_major_axis = \"1 au\" }\n");
    let Err(error) = crate::support::try_evolve(&study, |_| {}) else { panic!("a refusal") };
    assert!(error.contains("averaged"), "{error}");
}
