//! `check`: times, verdicts, shares and steady spins, by hand calculations and closed forms.
//! Criteria: (V1) to (V11), docs/theory/04-validity.md.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use crate::support::{MODEL, close, examples, one_line, study, study_of};

#[test]
fn every_example_but_the_soft_ones_holds() {
    let soft = [
        "explorer1",
        "inferred-damping",
        "mercury-ring",
        "nutation-damper",
        "ring-damper",
        "spherical-tank",
        "two-tanks",
    ];
    for example in examples().filter(|name| !soft.contains(&name.as_str())) {
        let study = study_of(&example);
        let checked = study.check().unwrap();
        let text = checked.text();
        assert!(checked.holds() && !text.contains("FAILS"), "{example}: {text}");
        assert!(text.lines().next().unwrap().ends_with("The reduced equations hold at this spin."), "{text}");
    }
}

/// By hand: m = 0.1 kg on k = 40 N/m and c = 0.4 N s/m, carrier of 7 kg. Along the axis the reduced mass is
/// 0.1·7/7.1 kg; with the attitude fixed it is the same in every direction.
#[test]
fn the_times_are_those_of_the_theory() {
    let study = study_of("axial-mass");
    let checked = study.check().unwrap();
    let validity = &checked.validity;
    let reduced_mass: f64 = 0.1 * 7.0 / 7.1;
    let held = (40.0 / reduced_mass).sqrt();
    let frequencies = &validity.vibrations.frequencies;
    assert_eq!(frequencies.len(), 3);
    frequencies.iter().for_each(|frequency| close(*frequency, held, 1e-12)); // rounding only
    close(validity.T3, 1.0 / 1.16_f64.sqrt(), 1e-9);
    close(validity.T2, 2.0 * reduced_mass / 0.4, 1e-9);
    let damped = (held * held - (0.2 / reduced_mass).powi(2)).sqrt();
    let period = validity.T1;
    assert!(period >= TAU / held * (1.0 - 1e-12) && period <= TAU / damped * (1.0 + 1e-12), "{period}");
    assert!(checked.holds());
    assert!(checked.json()["reasons"].as_array().unwrap().is_empty());
}

#[test]
fn json_and_text_give_the_same_verdict_and_reasons() {
    let study = study_of("explorer1");
    let checked = study.check().unwrap();
    let (object, text) = (checked.json(), one_line(&checked.text()));
    assert!(!checked.holds() && object["valid"] == false);
    let reasons = object["reasons"].as_array().unwrap();
    assert_eq!(reasons.len(), 5);
    for reason in reasons {
        assert!(text.contains(reason.as_str().unwrap()), "{reason}");
    }
}

#[test]
fn undamped_body_has_no_decay_time() {
    let study = study(&MODEL.replace("damping = 30.0\n", ""));
    let checked = study.check().unwrap();
    assert!(checked.json()["T2"].is_null() && checked.validity.T1 > 0.0);
    assert!(checked.text().contains("  T2  infinite "), "{}", checked.text());
}

#[test]
fn shares_of_dissipators_stand_where_the_equations_hold() {
    let masses = study_of("three-masses");
    let shares = masses.check().unwrap().budget;
    assert!(shares.len() == 6 && (shares.values().sum::<f64>() - 1.0).abs() < 1e-12, "{shares:?}");
    for name in ["explorer1", "apophis"] {
        assert_eq!(study_of(name).check().unwrap().budget, BTreeMap::new(), "{name}");
    }
}

#[test]
fn steady_spins_without_the_losses_of_materials_say_so() {
    let study = study_of("apophis");
    let said = one_line(&study.check().unwrap().text());
    let (_, rest) = said.split_once("after the reduced equations").unwrap();
    assert!(rest.starts_with(" WITHOUT the losses of materials about "), "{said}");
    assert!(rest.contains("GROWS e-fold in 3.513 Gyr"), "{said}");
}
