//! Audits of histories that the tests integrate by methods whose damping has a closed form, in any units, axes and digits.

use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use quasirigid_study::audit::{Audit, AuditBody, AuditSettings, audit, inertia};
use tempfile::TempDir;

use crate::support::free_body::{
    Free, OWN, Step, csv, dissipative, dot, explicit_euler, implicit_euler, implicit_midpoint, lie_euler,
    plus, rows, runge_kutta, significant, times, turned,
};
use crate::support::{carrier, close, column, finished, point, spinning, study};
use quasirigid_io::model::System;

struct Files(TempDir);

impl Files {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn put(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.path().join(name);
        fs::write(&path, text).unwrap();
        path
    }
}

fn asked(text: &str, entries: &[f64], settings: &AuditSettings) -> Result<Audit, String> {
    let folder = Files::new();
    let file = folder.put("spin.csv", text);
    let body = AuditBody::Inertia(inertia(entries).map_err(|error| error.to_string())?);
    audit(&[file], body, settings).map_err(|error| error.to_string())
}

#[track_caller]
pub fn audited(text: &str, entries: &[f64]) -> Audit {
    asked(text, entries, &AuditSettings::default()).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
pub fn refused(text: &str, entries: &[f64]) -> String {
    match asked(text, entries, &AuditSettings::default()) {
        Err(error) => error,
        Ok(found) => panic!("{}", found.sentence),
    }
}

pub const MOMENTS: [f64; 3] = [10.0, 14.0, 17.0];

/// Logarithm of the amplitude after a step, by the angle of the wobble in it.
type Amplitude = fn(f64) -> f64;

/// Square of the rate of a small wobble about an axis, for a spin of 1 rad/s.
fn wobble_square(moments: [f64; 3], about: usize) -> f64 {
    let own = moments[about];
    let [a, b] = [(about + 1) % 3, (about + 2) % 3].map(|k| moments[k]);
    (own - a) * (own - b) / (a * b)
}

/// Amplitudes of `z' = iλz` by each method: `|1 + ihλ|`, its inverse, and `1 − (hλ)⁶/144` of Runge and Kutta; about both axes, in turned axes.
#[test]
fn time_constants_are_those_of_the_linear_wobble() {
    let cases: [(Step, f64, f64, Amplitude); 3] = [
        (explicit_euler, 0.002, 600.0, |z| 0.5 * (z * z).ln_1p()),
        (implicit_euler, 0.002, 600.0, |z| -0.5 * (z * z).ln_1p()),
        (runge_kutta, 0.5, 4000.0, |z| -z.powi(6) / 144.0),
    ];
    let axes = turned(0.7, -0.4);
    let body = Free::new(MOMENTS, &axes);
    for about in [0, 2] {
        let start = plus(axes[about], 0.004, axes[1]);
        for (step, h, duration, amplitude) in cases {
            let found = audited(
                &csv("t,wx,wy,wz", &rows(&body, start, step, [h, duration], 20), significant(17)),
                &body.entries(),
            );
            let expected = -h / amplitude(h * wobble_square(MOMENTS, about).sqrt());
            println!("{about} h = {h}: {:?} s, expected {expected} s", found.invented_time_constant);
            close(found.invented_time_constant.unwrap(), expected, 0.01);
            assert_eq!(found.mode, Some(if about == 0 { "long-axis" } else { "short-axis" }));
            assert!(
                found.sentence.contains(if expected > 0.0 { "decays" } else { "GROWS" }),
                "{}",
                found.sentence
            );
            let damps = (expected > 0.0) == (about == 2);
            assert!(found.sentence.contains(if damps { "INVENTS damping" } else { "INVENTS driving" }));
            assert!(found.holds && found.within_limits.is_none());
        }
    }
}

/// The sums of what each step of the explicit method adds to the quadratic invariants, `h² f·Jf` and `h² |Jf|²`, at a large wobble.
#[test]
fn a_large_wobble_has_the_constant_of_its_energy() {
    let axes = turned(-0.3, 1.1);
    let body = Free::new(MOMENTS, &axes);
    let start = plus(plus(axes[2], 0.35, axes[0]), -0.1, axes[1]);
    let (h, duration) = (0.002, 300.0);
    let [mut energy, mut square] = body.invariants(start);
    let excess = |energy: f64, square: f64| energy * MOMENTS[2] / square - 1.0;
    let first = excess(energy, square);
    let mut w = start;
    for _ in 0..150_000 {
        let f = body.rate(w);
        let change = times(&body.tensor, f);
        energy += h * h * dot(f, change);
        square += h * h * dot(change, change);
        w = explicit_euler(&body, w, h);
    }
    let expected = -2.0 * duration / (excess(energy, square) / first).ln();
    let text = csv("t,wx,wy,wz", &rows(&body, start, explicit_euler, [h, duration], 50), significant(12));
    let found = audited(&text, &body.entries());
    println!("{:?} s, expected {expected} s", found.invented_time_constant);
    close(found.invented_time_constant.unwrap(), expected, 0.05);
    close(found.energy_drift, energy / body.invariants(start)[0] - 1.0, 1e-6);
    close(found.momentum_drift, (square / body.invariants(start)[1]).sqrt() - 1.0, 1e-6);
    assert!(found.sentence.contains("presumes that no torque acts"), "{}", found.sentence);
    assert!(found.notes.iter().any(|note| note.contains("the wobble is large")), "{:?}", found.notes);
}

/// The case of MuJoCo's explicit integrator in `tumble.py` of the survey: −6850 s at 2 ms, in any digits from four on.
#[test]
fn digits_of_the_file_limit_what_is_told() {
    let body = Free::new(MOMENTS, &OWN);
    let history = rows(&body, [0.15, 0.0, 1.0], explicit_euler, [0.002, 600.0], 100);
    for digits in [4, 6, 9, 17] {
        let found = audited(&csv("t,wx,wy,wz", &history, significant(digits)), &MOMENTS);
        close(found.invented_time_constant.unwrap(), -6850.0, 0.03);
        let worst = found.worst_interval.unwrap();
        assert!(worst[0] >= 500.0 || digits == 4, "{worst:?}"); // the energy grows exponentially
    }
    let kept = rows(&body, [0.15, 0.0, 1.0], runge_kutta, [0.01, 600.0], 20);
    for digits in [4, 6, 9, 12] {
        let found = audited(&csv("t,wx,wy,wz", &kept, significant(digits)), &MOMENTS);
        assert_eq!(found.invented_time_constant, None, "{digits}: {}", found.sentence);
        assert!(
            found.sentence.starts_with("The history keeps energy and angular momentum"),
            "{}",
            found.sentence
        );
        assert!(found.longest_time_constant.unwrap() > 1e3, "{found:?}");
        assert_eq!(found.worst_interval, None);
    }
    for step in [runge_kutta as Step, implicit_midpoint] {
        let found = audited(
            &csv("t,wx,wy,wz", &rows(&body, [0.15, 0.0, 1.0], step, [0.01, 600.0], 20), significant(17)),
            &MOMENTS,
        );
        assert!(
            found.invented_time_constant.is_none_or(|constant| constant.abs() > 1e13),
            "{}",
            found.sentence
        );
    }
}

/// Fixed places behind the point, and numbers whose trailing zeros their writer leaves out.
#[test]
fn digits_are_judged_by_the_column() {
    let body = Free::new(MOMENTS, &OWN);
    let kept = rows(&body, [0.15, 0.0, 1.0], runge_kutta, [0.01, 200.0], 20);
    let short = |value: f64| format!("{:?}", (value * 1e5).round() / 1e5);
    for text in [csv("t,wx,wy,wz", &kept, |value| format!("{value:.5}")), csv("t,wx,wy,wz", &kept, short)] {
        let found = audited(&text, &MOMENTS);
        assert_eq!(found.invented_time_constant, None, "{}", found.sentence);
        assert!(found.rounding.energy > 1e-5 && found.rounding.energy < 3e-4, "{:?}", found.rounding);
    }
    let single = |value: f64| format!("{:?}", f64::from(value as f32));
    let found = audited(&csv("t,wx,wy,wz", &kept, single), &MOMENTS);
    assert_eq!(found.rounding.digits, "single precision");
    assert_eq!(found.invented_time_constant, None, "{}", found.sentence);
}

/// Units are found by the motion, or taken from the heading; the time constant is in seconds.
#[test]
fn units_are_found_by_the_motion() {
    let axes = turned(0.5, 0.9);
    let body = Free::new([3.0, 4.5, 5.0], &axes);
    let start = plus(axes[2], 0.1, axes[0]);
    let history = rows(&body, start, explicit_euler, [0.002, 400.0], 50);
    let plain = audited(&csv("t,wx,wy,wz", &history, significant(12)), &body.entries());
    let expected = plain.invented_time_constant.unwrap();
    for (name, unit) in [
        ("rad/s", 1.0),
        ("deg/s", 1_f64.to_radians()),
        ("rpm", std::f64::consts::TAU / 60.0),
        ("rev/s", std::f64::consts::TAU),
    ] {
        for (time, second) in [("s", 1.0), ("ms", 1e-3)] {
            let written: Vec<_> =
                history.iter().map(|[t, x, y, z]| [t / second, x / unit, y / unit, z / unit]).collect();
            let named = format!("t [{time}],wx [{name}],wy [{name}],wz [{name}]");
            for heading in ["t,wx,wy,wz", &named] {
                let found = audited(&csv(heading, &written, significant(12)), &body.entries());
                close(found.invented_time_constant.unwrap(), expected, 1e-5); // twelve digits of other numbers
                assert_eq!((found.units.rates.as_str(), found.units.times.as_str()), (name, time));
                assert_eq!(found.units.source, if heading == named { "heading" } else { "motion" });
                let told = found.notes.iter().any(|note| note.contains("by Euler's equations"));
                assert_eq!(told, heading != named && (name, time) != ("rad/s", "s"), "{:?}", found.notes);
            }
            if name != "rad/s" {
                let wrong = named.replace(name, "rad/s");
                let message = refused(&csv(&wrong, &written, significant(12)), &body.entries());
                assert!(
                    message.contains("do not fit the history")
                        && message.contains("the heading names a unit"),
                    "{message}"
                );
            }
        }
    }
}

#[test]
fn an_inertia_that_does_not_fit_is_refused() {
    let body = Free::new(MOMENTS, &OWN);
    let text =
        csv("t,wx,wy,wz", &rows(&body, [0.15, 0.0, 1.0], runge_kutta, [0.01, 200.0], 10), significant(9));
    for entries in [[14.0, 10.0, 17.0], [10.0, 17.0, 14.0], [11.0, 14.0, 17.0]] {
        assert!(refused(&text, &entries).contains("this inertia or these units do not fit"), "{entries:?}");
    }
    for (entries, words) in [
        (&[1.0, 2.0, 4.0][..], "none may be negative, or exceed the sum of the other two"),
        (&[-1.0, 2.0, 2.0], "none may be negative"),
        (&[0.0, 2.0, 2.0], "every moment of a body that turns freely is positive"),
        (&[1.0, 2.0], "three moments XX,YY,ZZ or six entries"),
        (&[f64::NAN, 1.0, 1.0], "not a finite number"),
    ] {
        let message = refused(&text, entries);
        assert!(message.contains(words), "{message}");
    }
    // the unit of the tensor has no effect
    let [one, other] = [1.0, 1e-9].map(|unit| audited(&text, &MOMENTS.map(|moment| unit * moment)));
    assert_eq!(one.sentence, other.sentence);
}

/// Torque about the spin axis, spins without wobble, three equal moments, a short run.
#[test]
fn motions_without_a_time_constant_say_why() {
    let line = |w: &dyn Fn(f64) -> [f64; 3], until: f64| {
        let rows: Vec<_> =
            (0..=200).map(|k| f64::from(k) / 200.0 * until).map(|t| [t, w(t)[0], w(t)[1], w(t)[2]]).collect();
        csv("t,wx,wy,wz", &rows, significant(9))
    };
    let pure = audited(&line(&|_| [0.0, 0.0, 1.0], 100.0), &MOMENTS);
    assert_eq!((pure.energy_drift, pure.invented_time_constant, pure.worst_interval), (0.0, None, None));
    assert!(pure.notes.iter().any(|note| note.contains("rad/s and s are taken")), "{:?}", pure.notes);
    let driven = audited(&line(&|t| [0.0, 0.0, 1.0 + 1e-3 * t], 100.0), &MOMENTS);
    close(driven.momentum_drift, 0.1, 1e-9);
    assert!(driven.sentence.contains("no wobble above the digits"), "{}", driven.sentence);
    let sphere = audited(&line(&|t| [0.0, 0.1, 1.0 - 1e-3 * t], 100.0), &[2.0; 3]);
    assert!(sphere.sentence.contains("three equal moments") && sphere.mode.is_none(), "{}", sphere.sentence);
    let body = Free::new(MOMENTS, &OWN);
    let short =
        csv("t,wx,wy,wz", &rows(&body, [0.15, 0.0, 1.0], explicit_euler, [0.01, 4.0], 1), significant(12));
    let found = audited(&short, &MOMENTS);
    assert!(
        found.invented_time_constant.is_none() && found.sentence.contains("revolutions"),
        "{}",
        found.sentence
    );
}

/// A body of revolution of either kind, and a motion across the separatrix.
#[test]
fn bodies_of_revolution_and_the_separatrix_are_told() {
    for (moments, about, mode) in [([2.0, 2.0, 3.0], 2, "short-axis"), ([2.0, 3.0, 3.0], 0, "long-axis")] {
        let body = Free::new(moments, &OWN);
        let mut start = [0.02; 3];
        start[about] = 1.0;
        let text = csv("t,wx,wy,wz", &rows(&body, start, explicit_euler, [0.01, 300.0], 10), significant(12));
        let found = audited(&text, &moments);
        let expected = -2.0 / (0.01 * wobble_square(moments, about));
        close(found.invented_time_constant.unwrap(), expected, 0.02);
        assert_eq!(found.mode, Some(mode));
    }
    let body = Free::new(MOMENTS, &OWN);
    let text =
        csv("t,wx,wy,wz", &rows(&body, [0.9, 0.1, 0.5], dissipative, [0.02, 2000.0], 10), significant(12));
    let found = audited(&text, &MOMENTS);
    assert!(found.crossing.is_some() && found.invented_time_constant.is_none(), "{found:?}");
    assert!(found.sentence.contains("crosses the separatrix"), "{}", found.sentence);
}

/// A method that keeps the angular momentum to rounding, not the energy: damping without a torque.
#[test]
fn kept_angular_momentum_is_told_from_a_torque() {
    let body = Free::new(MOMENTS, &OWN);
    let text =
        csv("t,wx,wy,wz", &rows(&body, [0.05, 0.0, 1.0], lie_euler, [0.01, 400.0], 10), significant(12));
    let found = audited(&text, &MOMENTS);
    assert!(found.momentum_excursion < 1e-10 && found.energy_excursion > 1e-6, "{found:?}");
    assert!(
        found.invented_time_constant.is_some() && !found.sentence.contains("torque"),
        "{}",
        found.sentence
    );
}

#[test]
fn limits_are_kept_or_not() {
    let body = Free::new(MOMENTS, &OWN);
    let text = csv(
        "t,wx,wy,wz",
        &rows(&body, [0.15, 0.0, 1.0], explicit_euler, [0.002, 600.0], 100),
        significant(9),
    );
    let within = |limit: Option<f64>, min_time_constant: Option<f64>| {
        let asked = asked(&text, &MOMENTS, &AuditSettings { limit, min_time_constant, steps: Vec::new() });
        asked.unwrap().within_limits
    };
    assert_eq!(within(Some(1e-2), None), Some(true));
    assert_eq!(within(Some(1e-3), None), Some(false));
    assert_eq!(within(None, Some(6000.0)), Some(true));
    assert_eq!(within(None, Some(7000.0)), Some(false));
    assert_eq!(within(Some(1e-2), Some(7000.0)), Some(false));
    // what the digits cannot show is not kept either
    let kept =
        csv("t,wx,wy,wz", &rows(&body, [0.15, 0.0, 1.0], runge_kutta, [0.01, 600.0], 20), significant(4));
    let strict = AuditSettings { limit: Some(1e-9), ..AuditSettings::default() };
    assert_eq!(asked(&kept, &MOMENTS, &strict).unwrap().within_limits, Some(false));
}

/// Two steps show the first order of the explicit method, and the fifth of the damping by Runge and Kutta.
#[test]
fn histories_at_two_steps_show_the_order() {
    let body = Free::new(MOMENTS, &OWN);
    for (step, steps, duration, power) in
        [(explicit_euler as Step, [0.004, 0.002], 400.0, 1.0), (runge_kutta, [0.5, 0.25], 4000.0, 5.0)]
    {
        let folder = Files::new();
        let files = steps.map(|h| {
            let text =
                csv("t,wx,wy,wz", &rows(&body, [0.02, 0.0, 1.0], step, [h, duration], 1), significant(17));
            folder.put(&format!("{h}.csv"), &text)
        });
        let entries = AuditBody::Inertia(inertia(&MOMENTS).unwrap());
        let least = AuditSettings { min_time_constant: Some(1e9), ..AuditSettings::default() };
        let found = audit(&files, entries, &least).unwrap();
        let order = found.order.as_ref().unwrap();
        close(order.order.unwrap(), power, 0.03);
        let (h, rate) = (steps[1], order.drifts[1]);
        close(order.enough_step.unwrap(), h * (rate * 1e9).powf(-1.0 / power), 0.15);
        let same = AuditSettings { steps: vec![0.1, 0.1], ..AuditSettings::default() };
        let message = audit(&files, entries, &same).unwrap_err().to_string();
        assert!(message.contains("give the step of each"), "{message}");
    }
}

/// The history of a body with a damper, by its own full system: what the model explains is not invented.
#[test]
fn the_model_explains_its_own_damping() {
    let tip = |damping: f64| {
        carrier(40.0, [9.0, 13.0, 16.0])
            + &point("tip", 1.0, [0.8, 0.3, 0.5], [600.0, damping])
            + &spinning([0.03, 0.01, 0.4])
    };
    let model = study(&tip(30.0));
    let times: Vec<f64> = (0..=4000).map(|k| 0.5 * f64::from(k)).collect();
    let history = finished(&model, System::Full, &times);
    let mut text = "t,wx,wy,wz\n".to_owned();
    let columns = ["t", "wx", "wy", "wz"].map(|name| column(&history.columns, name));
    for row in 0..times.len() {
        writeln!(text, "{}", columns.map(|values| format!("{:?}", values[row])).join(",")).unwrap();
    }
    let folder = Files::new();
    let file = folder.put("spin.csv", &text);
    let found =
        audit(std::slice::from_ref(&file), AuditBody::Model(&model), &AuditSettings::default()).unwrap();
    println!("{}", found.sentence);
    close(found.explained.unwrap(), 1.0, 0.05);
    assert_eq!(found.invented_time_constant, None, "{}", found.sentence);
    // the same history of a model without dampers
    let rigid = study(&(carrier(40.0, [9.0, 13.0, 16.0]) + &spinning([0.03, 0.01, 0.4])));
    let body = Free::new([9.0, 13.0, 16.0], &OWN);
    let plain = csv(
        "t,wx,wy,wz",
        &rows(&body, [0.03, 0.01, 0.4], explicit_euler, [0.01, 400.0], 20),
        significant(12),
    );
    let file = folder.put("rigid.csv", &plain);
    let found = audit(&[file], AuditBody::Model(&rigid), &AuditSettings::default()).unwrap();
    assert_eq!(found.explained, Some(0.0));
    assert!(found.invented_time_constant.is_some_and(|constant| constant < 0.0), "{}", found.sentence);
}
