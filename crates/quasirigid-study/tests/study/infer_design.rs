//! Plans of measurements against closed forms and against fits of simulated measurements. (O21)

use quasirigid_io::model::{System, changed};
use quasirigid_study::Study;
use quasirigid_study::infer::InferSettings;
use quasirigid_study::infer::design::{Design, DesignSettings, Flown};

use super::infer::{RATES, STONE, measured, times};
use crate::support::{close, one_line, study};

const A: f64 = 10.0;
const B: f64 = 14.0;
const C: f64 = 17.0;
const KEY: &str = "carrier.inertia.1";
const FREQUENCY: &str = "modes.nutation.frequency";

fn settings(keys: &[&str], sensors: &[&str], manoeuvres: &[&str]) -> DesignSettings {
    DesignSettings {
        vary: keys.iter().map(|key| key.parse().unwrap()).collect(),
        priors: Vec::new(),
        sensors: sensors.iter().map(|sensor| sensor.parse().unwrap()).collect(),
        manoeuvres: manoeuvres.iter().map(|text| Flown::Changed(text.parse().unwrap())).collect(),
        duration: Some(60.0),
        samples: 121,
        system: System::Rigid,
    }
}

fn design(model: &str, asked: &DesignSettings) -> Design {
    study(model).design(asked, &mut ()).unwrap()
}

/// The spin of the stone about its axis, with a wobble of this rate.
fn wobbling(rate: f64) -> String {
    changed(STONE, &[("initial.angular_velocity", vec![rate, 0.0, 0.9].into())]).unwrap()
}

/// ν = ω √((C−A)(C−B)/AB) alone tells one ratio of the moments, with the deviation σ 2A(C−A)/(Cν), and not two moments.
#[test]
fn a_frequency_tells_one_ratio_of_the_moments() {
    let asked = settings(&[KEY], &[&format!("{FREQUENCY} +- 1e-4 rad/s")], &[]);
    let found = design(&wobbling(1e-3), &asked);
    let frequency = 0.9 * ((C - A) * (C - B) / (A * B)).sqrt();
    close(found.plans[0].sigma[0].unwrap(), 1e-4 * 2.0 * A * (C - A) / (C * frequency), 1e-4);
    assert!(found.holds() && found.plans.len() == 1);
    let two = settings(&[KEY, "carrier.inertia.2"], &[&format!("{FREQUENCY} +- 1 %")], &[]);
    let found = design(&wobbling(1e-3), &two);
    assert!(!found.holds() && found.plans[0].sigma == [None, None], "{found:?}");
    assert!(found.sentence.starts_with("No plan tells every key"), "{}", found.sentence);
}

/// A sine of amplitude a seen N times over T tells its frequency to σ √6 / (a T √N) with the start known; a small wobble is one.
#[test]
fn a_wobble_tells_the_frequency_by_its_phase() {
    let (rate, sigma, samples) = (1e-3, 1e-5, 1001);
    let long = |keys: &[&str]| DesignSettings {
        duration: Some(600.0),
        samples,
        ..settings(keys, &[&format!("wx +- {sigma} rad/s")], &[])
    };
    let found = design(&wobbling(rate), &long(&[KEY]));
    let frequency = 0.9 * ((C - A) * (C - B) / (A * B)).sqrt();
    let told = sigma * (6.0 / samples as f64).sqrt() / (rate * 600.0);
    close(found.plans[0].sigma[0].unwrap(), told * 2.0 * A * (C - A) / (C * frequency), 1e-2);
}

/// Deviations of a plan are those of a fit to what it would measure.
#[test]
fn plans_keep_what_they_promise() {
    let keys = [KEY, "initial.angular_velocity.2"];
    let found = design(STONE, &settings(&keys, &["wx,wy,wz +- 1 mrad/s"], &[]));
    let data = measured(STONE, System::Rigid, &times(60.0, 121), &RATES, [1e-3, 9.0]);
    let vary = keys.iter().map(|key| key.parse().unwrap()).collect();
    let asked = InferSettings { vary, system: System::Rigid, ..InferSettings::default() };
    let fit = study(STONE).infer(Some(&data), &asked, &mut ()).unwrap();
    for (planned, fitted) in found.plans[0].sigma.iter().zip(&fit.parameters) {
        close(planned.unwrap(), fitted.sigma.unwrap(), 0.02);
    }
}

/// A body that spins about an axis tells nothing; ten times the wobble tells ten times as much, by the better gyro above all.
#[test]
fn plans_are_ranked_by_what_they_tell() {
    let sensors = ["wx +- 1e-4 rad/s", "wz +- 0.1 rad/s", &format!("{FREQUENCY} +- 50 %")];
    let asked = settings(&[KEY], &sensors, &["initial.angular_velocity = [0.01, 0, 0.9]"]);
    let found = design(&wobbling(1e-3), &asked);
    assert_eq!(found.plans.len(), 2 * 7);
    let of = |manoeuvre: &str, sensors: usize| {
        let plan = |plan: &&quasirigid_study::infer::design::Plan| {
            plan.manoeuvre.contains(manoeuvre) && plan.sensors.len() == sensors
        };
        found.plans.iter().find(plan).unwrap()
    };
    let ratio = of("as it stands", 3).worst.unwrap() / of("0.01", 3).worst.unwrap();
    close(ratio, 10.0, 0.02);
    assert_eq!(of("0.01", 1).sensors, ["wx"]);
    assert!(found.plans.iter().map(|plan| plan.worst.unwrap_or(f64::MAX)).is_sorted());
    let text = one_line(&found.text());
    assert!(text.contains("by the motion of \"initial.angular_velocity = [0.01, 0, 0.9]\""), "{text}");
    assert!(text.contains("wx alone would tell most") && text.contains("adds next to nothing"), "{text}");
}

/// What is known beforehand counts; a manoeuvre that is none is told and does not stop the others; another model is one.
#[test]
fn priors_count_and_other_models_are_manoeuvres() {
    let sensor = format!("{FREQUENCY} +- 1e-3 rad/s");
    let alone = design(&wobbling(1e-3), &settings(&[KEY], &[&sensor], &[])).plans[0].sigma[0].unwrap();
    let mut asked = settings(&[KEY], &[&sensor], &["carrier.mass = -3"]);
    asked.priors = vec![format!("{KEY} = 3 +- {alone}").parse().unwrap()];
    asked.manoeuvres.push(Flown::Other("fast.toml".into(), Box::new(fast())));
    let found = design(&wobbling(1e-3), &asked);
    let sigma =
        |name: &str| found.plans.iter().find(|plan| plan.manoeuvre == name).unwrap().sigma[0].unwrap();
    close(sigma("as it stands"), alone / 2f64.sqrt(), 1e-6);
    // twice the frequency has twice the derivative
    close(sigma("fast.toml"), alone / 5f64.sqrt(), 1e-4);
    assert!(!found.holds() && found.not_answered[0].manoeuvre == "carrier.mass = -3", "{found:?}");
}

fn fast() -> Study {
    let model = changed(STONE, &[("initial.angular_velocity", vec![0.0, 0.0, 1.8].into())]).unwrap();
    study(&model)
}

#[test]
fn sensors_that_are_none_are_refused_in_words() {
    let no = |sensor: &str| {
        study(STONE).design(&settings(&[KEY], &[sensor], &[]), &mut ()).unwrap_err().to_string()
    };
    assert!(no("speed +- 1").contains("is no column of a history"));
    assert!(no("wx +- 5 %").contains("passes through zero") || no("wx +- 5 %").contains("pass through zero"));
    assert!(no("wx +- 1 kg").contains("is something else"));
    assert!(no("spin.x +- 1").contains("begins with a command"));
    assert!(no("modes.nutation.frequency +- 1 kg").contains("its deviation is something else"));
}
