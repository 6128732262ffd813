//! Driven parts of a model: the system that follows them, their columns, what is refused, and the body with these parts locked. (T7)–(T11)

use quasirigid_io::model::System;
use quasirigid_study::Study;
use quasirigid_study::histories::Table;
use quasirigid_study::linear::LinearSettings;
use quasirigid_study::modes::SteadySpinSettings;
use quasirigid_study::settings::{PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify};

use crate::support::{carrier, close, column, finished, history, spinning, study, table, whole_table};

const BOOM: &str = "[[boom]]\nname = \"boom\"\nposition = [0.3, 0, 0.1]\ndirection = [1, 0, 0]\nmass = 2\ntip_mass = 1.5\n\
                    length = { formula = \"0.4 + 0.05*t\" }\n";
const PANEL: &str = "[[hinged]]\nname = \"panel\"\nmass = 3\ncenter_of_mass = [0, 1.2, 0]\ninertia = [0.5, 0.1, 0.6]\n\
                     hinge = [0, 0.5, 0]\naxes = [[1, 0, 0]]\nangle = { formula = \"0.02*t\" }\n";

fn deploying(lines: &str) -> String {
    carrier(50.0, [3.0, 4.0, 5.0]) + BOOM + lines + &spinning([0.1, 0.2, 1.0])
}

/// Without a given system the full one; lengths and angles are columns.
#[test]
fn the_full_system_follows_driven_parts() {
    let study = study(&deploying(PANEL));
    let times = [0.0, 4.0, 10.0];
    let asked = Table { system: None, ..whole_table(System::Full, &times) };
    let found = history(&study, &asked, PartialRun::default());
    assert_eq!((found.system, found.status), (System::Full, "finished"));
    assert!(found.holds());
    let value = |name: &str| column(&found.columns, name);
    for (at, t) in times.iter().enumerate() {
        close(value("panel about axis 1")[at] + 1.0, 0.02 * t + 1.0, 1e-14);
        close(value("boom length")[at], 0.4 + 0.05 * t, 1e-14);
        // the place of the tip, from the root
        close(value("boom along x")[at], 0.4 + 0.05 * t, 1e-14);
    }
    let drift = column(&found.columns, "energy_drift");
    let energy = column(&found.columns, "energy");
    assert!(drift.iter().all(|drift| drift.abs() < 1e-10 * energy[0]), "{drift:?}");
    let usual = Table { system: None, ..table(System::Full, &times) };
    let still = self::study(&(carrier(50.0, [3.0, 4.0, 5.0]) + &spinning([0.0, 0.0, 1.0])));
    assert_eq!(history(&still, &usual, PartialRun::default()).system, System::Reduced);
}

/// Each in words that name the part and the way out.
#[test]
fn what_needs_rest_or_a_steady_spin_is_refused() {
    let study = study(&deploying(PANEL));
    let simulated =
        |system| study.simulate(&PartialRun::default(), &table(system, &[0.0, 1.0]), &mut ()).err();
    let refusals = [
        study.derive().err(),
        study.evolve(PartialEvolve::default(), &mut ()).err(),
        study.modes(SteadySpinSettings::default()).err(),
        study.linear(&LinearSettings::default()).err(),
        study.effective_masses(None).err(),
        study.verify(&study.verification_plan(PartialVerify::default()), &mut ()).err(),
        study.about_spin(PartialSpinManifold::default(), None).err(),
        study.run(&PartialRun::default(), &mut ()).err(),
        study.reduced_steps(1e-9).err(),
        simulated(System::Reduced),
        simulated(System::Rigid),
        simulated(System::SpinManifold),
    ];
    for refusal in refusals {
        let told = refusal.expect("a refusal").told(&|_| "--system");
        assert!(told.contains("\"panel\", \"boom\" follow a law over time"), "{told}");
        assert!(told.contains("--system full") && told.contains("lock the part"), "{told}");
    }
    let check = study.check().unwrap();
    assert!(!check.holds());
    let text = check.text();
    assert!(text.contains("NO ANSWER for the body as it is: a law over time moves"), "{text}");
}

/// A law that jumps or has no rate, with the name of the part.
#[test]
fn laws_that_no_drive_follows_are_refused() {
    for (formula, told) in [
        ("0.4 + step(t - 3)", "the law that drives \"boom\" jumps from 0.4 to 1.4 at t = 3"),
        ("0.4 + sqrt(t)", "the law that drives \"boom\" has no value, rate or acceleration at t = 0 s"),
    ] {
        let study = study(&deploying("").replace("0.4 + 0.05*t", formula));
        let refused = study.simulate(&PartialRun::default(), &table(System::Full, &[0.0, 10.0]), &mut ());
        let message = refused.unwrap_err().told(&|_| "--system");
        assert!(message.contains(told), "{message}");
    }
}

/// Locked by a number, or by a formula that does not depend on the time, every answer is there; and a drive that starts slowly starts as that
/// body.
#[test]
fn parts_at_constant_places_have_every_answer() {
    let answers = |length: &str| {
        let study = study(&deploying("").replace("{ formula = \"0.4 + 0.05*t\" }", length));
        assert!(study.check().unwrap().holds() && study.derive().is_ok());
        let spin = finished(&study, System::Reduced, &[0.0, 20.0]);
        [0, 1, 2].map(|axis| column(&spin.columns, ["wx", "wy", "wz"][axis])[1])
    };
    assert_eq!(answers("0.4"), answers("{ formula = \"2/5\" }"));
    let slow = study(&deploying("").replace("0.4 + 0.05*t", "0.4 + 1e-12*t"));
    let spin = finished(&slow, System::Full, &[0.0, 20.0]);
    for (axis, known) in answers("0.4").into_iter().enumerate() {
        close(column(&spin.columns, ["wx", "wy", "wz"][axis])[1], known, 1e-8);
    }
}

/// A wobble is that of the body with its parts locked where they start.
#[test]
fn a_wobble_starts_with_the_parts_as_they_are() {
    let wobbling = "[initial]\nwobble = { angle = \"5 deg\", rate = \"2 rad/s\", mode = \"short-axis\" }\n";
    let text = carrier(50.0, [3.0, 4.0, 5.0]) + BOOM + wobbling;
    let locked = text.replace("{ formula = \"0.4 + 0.05*t\" }", "0.4");
    let [moving, locked] = [text, locked].map(|text| study(&text).initial().unwrap().omega);
    assert_eq!(moving, locked);
}

/// Under a sampled controller and a force: momentum and energy keep their balances through every sample.
#[test]
fn drives_stand_beside_controllers() {
    let more = "[[controller]]\nname = \"acs\"\nkind = \"pid\"\non = \"rate\"\ntarget = [0, 0, 0.5]\nproportional = [2, 2, 2]\n\
                outputs = [\"torque.x\", \"torque.y\", \"torque.z\"]\nperiod = 0.7\n";
    let with =
        |lines: &str| Study::read_from(std::path::Path::new("model.toml"), deploying(lines).as_bytes(), None);
    let study = with(&format!("{PANEL}{more}")).unwrap_or_else(|error| panic!("{error}"));
    let found = finished(&study, System::Full, &[0.0, 5.0, 12.0]);
    let energy = column(&found.columns, "energy");
    let drift =
        [column(&found.columns, "energy_drift")[2] / energy[0], column(&found.columns, "momentum_drift")[2]];
    assert!(drift.iter().all(|drift| drift.abs() < 1e-9), "{drift:?}");
}
