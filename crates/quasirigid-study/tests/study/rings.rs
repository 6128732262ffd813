//! Partly full rings of a model: what `check` tells, what is told first, what is refused, and the decay of a nutation. (U10)–(U14)

use quasirigid_io::model::System;
use quasirigid_study::Study;
use quasirigid_study::histories::History;
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::settings::{PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify};

use crate::support::{
    carrier, close, column, finished, history, modes, modes_about, point, spinning, study, table, whole_table,
};

/// A ring of mercury about the axis of greatest inertia, off the centre of mass.
fn ring(lines: &str) -> String {
    format!(
        "[[tank]]\nname = \"damper\"\nshape = \"tube\"\nradius = 0.127\ntube_radius = 0.0046\ncenter = [0, 0, 0.1]\n\
         liquid_mass = 0.12\ndensity = 13530\nkinematic_viscosity = 1.13e-7\nsurface_tension = 0.485\n{lines}"
    )
}

const INERTIA: [f64; 3] = [1.1111, 1.1111, 1.5];
const WOBBLE: &str = "[initial]\nwobble = { angle = \"5 deg\", rate = \"2 rev/s\", mode = \"short-axis\" }\n";

fn damped() -> String {
    carrier(50.0, INERTIA) + &ring("") + WOBBLE
}

/// Reynolds number and friction by Itō's factor, from the nutation of the rigid body with the liquid at rest.
#[test]
fn check_tells_the_slug_of_a_ring() {
    let study = study(&damped());
    let answer = study.check().unwrap().json();
    assert_eq!(answer["valid"], false);
    assert_eq!(answer["reduction"], "none");
    assert!(answer["reasons"][0].as_str().unwrap().contains("slides along its ring"));
    let tank = &answer["tanks"][0];
    let number = |key: &str| tank["slug"][key].as_f64().unwrap();
    close(tank["liquid_mass"].as_f64().unwrap(), 0.12, 1e-12);
    let volume = 2.0 * std::f64::consts::PI.powi(2) * 0.127 * 0.0046 * 0.0046;
    let fill = 0.12 / 13_530.0 / volume;
    close(tank["fill"].as_f64().unwrap(), fill, 1e-12);
    close(number("arc"), 2.0 * std::f64::consts::PI * fill, 1e-12);
    assert_eq!(tank["slosh"].as_array().unwrap().len(), 0);
    let rate = number("nutation_rate");
    // the liquid at rest changes the moments of inertia by a few per mille
    close(rate, 0.35 * 4.0 * std::f64::consts::PI, 1e-2);
    let v = 0.127 * rate;
    let reynolds = 2.0 * 0.0046 * v / 1.13e-7;
    close(number("reynolds"), reynolds, 1e-12);
    close(number("womersley"), 0.0046 * (rate / 1.13e-7).sqrt(), 1e-12);
    assert_eq!(tank["slug"]["flow"], "turbulent");
    let f = 0.304 * reynolds.powf(-0.25) + 0.029 * (0.0046_f64 / 0.127).sqrt();
    let wall = 2.0 * std::f64::consts::PI * 0.0046 * number("arc") * 0.127;
    close(number("friction"), f * 13_530.0 * v * v / 8.0 * wall * 0.127, 1e-12);
    let text = study.check().unwrap().text();
    assert!(text.contains("NO ANSWER for the body as it is") && text.contains("Sliding around"), "{text}");
}

/// The Bond number of mercury in this spin is 11, and small motions are no developed flow: both are told before the numbers.
#[test]
fn what_may_not_hold_is_told_first() {
    let notes = study(&damped()).model.notes;
    assert!(notes[0].starts_with("MAY NOT HOLD: the Bond number") && notes[0].contains(" is 1"), "{notes:?}");
    assert!(notes[1].starts_with("MAY NOT HOLD for small motions"), "{notes:?}");
    assert!(notes[2].contains("Reynolds number") && notes[2].contains("turbulent"), "{notes:?}");
    let slow = ring("").replace("1.13e-7", "1e-3").replace("0.485", "50");
    let notes = study(&(carrier(50.0, INERTIA) + &slow + WOBBLE)).model.notes;
    assert!(!notes.iter().any(|note| note.starts_with("MAY NOT HOLD")), "{notes:?}");
}

/// Every answer that needs the reduced equations, in words that name the way out.
#[test]
fn what_has_no_reduced_equations_is_refused() {
    let study = study(&damped());
    let table = |system| table(system, &[0.0, 1.0]);
    let refusals = [
        study.derive().err(),
        study.evolve(PartialEvolve::default(), &mut ()).err(),
        study.simulate(&PartialRun::default(), &table(System::Reduced), &mut ()).err(),
        study.simulate(&PartialRun::default(), &table(System::SpinManifold), &mut ()).err(),
        study.run(&PartialRun::default(), &mut ()).err(),
        study.about_spin(PartialSpinManifold::default(), None).err(),
        study.verify(&study.verification_plan(PartialVerify::default()), &mut ()).err(),
    ];
    for refusal in refusals {
        let told = refusal.expect("a refusal").told(&|_| "--system");
        assert!(
            told.contains("slides along the ring of tank \"damper\"") && told.contains("--system full"),
            "{told}"
        );
    }
}

/// By default the liquid lies at rest in the body, where the file says, beside parts that the spin has deformed.
#[test]
fn a_liquid_starts_at_rest_in_the_body() {
    let soft = point("tip", 1.0, [0.8, 0.1, 0.3], [4e4, 30.0]);
    let body = |lines: &str| carrier(50.0, INERTIA) + &ring("") + &soft + lines;
    let free = study(&body(&spinning([0.3, 0.1, 12.0])));
    let mut model = free.model.clone();
    model.assembly.tubes[0].held = true;
    let held = Study::new(model, None).unwrap();
    let whole =
        |study: &Study| history(study, &whole_table(System::Full, &[0.0, 1e-3]), PartialRun::default());
    let [with, without] = [whole(&free), whole(&held)];
    let start = |history: &History, name: &str| column(&history.columns, name)[0];
    let names: Vec<&str> =
        without.columns.iter().map(|column| &*column.name).filter(|name| name.contains("tip")).collect();
    assert!(names.len() >= 3, "{names:?}");
    for name in names {
        // rates are found from momenta
        assert!((start(&with, name) - start(&without, name)).abs() < 1e-13, "{name}");
    }
    let slug = with.columns.iter().find(|column| column.name.contains("along the ring"));
    assert_eq!(slug.expect("a column of the slug").values[0], 0.0);
}

/// Angles (rad) between the axis of the ring and the angular momentum of the start.
fn nutations(study: &Study, found: &History) -> Vec<f64> {
    let rows = |name: &str| column(&found.columns, name);
    let omega = ["wx", "wy", "wz"].map(|name| rows(name)[0]);
    let still = vec![0.0; study.body.coordinates().len()];
    let K = quasirigid_math::sym3::times(study.body.full_inertia_at(&still), omega);
    let size = quasirigid_math::vec3::norm(K);
    let quaternion = ["qw", "qx", "qy", "qz"].map(rows);
    (0..found.columns[0].values.len())
        .map(|row| {
            let attitude = quaternion.map(|entries| entries[row]);
            let axis = quasirigid_math::rotation::to_inertial(attitude, [0.0, 0.0, 1.0]);
            (quasirigid_math::vec3::dot(axis, K) / size).clamp(-1.0, 1.0).acos()
        })
        .collect()
}

/// A wobble of so many degrees is one of the body with the liquid at rest. The slug is caught by it and runs around, and the square of the sine
/// falls by `2Q/G` in a second. (U14)
#[test]
fn a_ring_damps_a_nutation() {
    let study = study(&damped());
    let times: Vec<f64> = (0..=6).map(f64::from).collect();
    let found = finished(&study, System::Full, &times);
    let last = found.run.last;
    let energy = column(&found.columns, "energy")[0];
    assert!(((last.energy + last.dissipated) / energy - 1.0).abs() < 1e-9);
    let angles = nutations(&study, &found);
    close(angles[0], 5f64.to_radians(), 0.06);
    let slug = &study.check().unwrap().json()["tanks"][0]["slug"];
    let G = column(&found.columns, "momentum")[0];
    let fall = 2.0 * slug["friction"].as_f64().unwrap() / G;
    let slope = (angles[1].sin().powi(2) - angles[6].sin().powi(2)) / 5.0;
    // the slug is 6 % of the difference of the moments
    close(slope, fall, 0.1);
}

/// Across the spin the slug has a mode of its own, and about it, off the centre of mass, one that slides to another place and stays there. In the
/// plane of the centre of mass nothing tells its places apart: no modes, in words.
#[test]
fn modes_of_a_ring() {
    let across = ring("axis = [0, 1, 0]\n").replace("0, 0, 0.1", "0, 0.1, 0");
    let found = modes(&study(&(carrier(50.0, [1.1, 1.2, 1.5]) + &across + &spinning([0.0, 0.0, 12.0]))));
    let named = format!("{found:?}");
    assert!(named.contains("along the ring"), "{named}");
    let about = modes_about(&study(&damped()), PrincipalAxis::Greatest);
    let slides = about.spins[0].modes.iter().find(|mode| mode.name.contains("along the ring"));
    let slides = slides.expect("a mode of the slug");
    // friction stops the slug in a²/8ν, but for the recoil of the body
    assert!(about.spins[0].sentence.starts_with("MAY NOT HOLD, since small motions"));
    close(slides.decay_rate, 8.0 * 1.13e-7 / (0.0046 * 0.0046), 0.1);
    assert_eq!(slides.frequency, 0.0);
    let level = damped().replace("center = [0, 0, 0.1]", "center = [0, 0, 0]");
    let told = &modes_about(&study(&level), PrincipalAxis::Greatest).spins[0];
    assert!(told.modes.is_empty() && told.sentence.contains("free to lie at any place"), "{}", told.sentence);
}
