//! Shapes and moments observed in rotation: the same relaxed body in every answer, and the wobble given is the wobble found. (G17)–(G20)

use std::f64::consts::TAU;
use std::path::Path;

use quasirigid_io::model::System;
use quasirigid_math::vec3::{add, norm, scale};
use quasirigid_study::Study;

use crate::support::{ROOT, close, evolved, finished, mode, modes, of_order, study};

const SOFT: &str = "[material.soft]\ndensity = 2000\nyoung = 2e6\npoisson = 0.25\nrheology = { kind = \"quality-factor\", Q = 100 }\n\
     [[ellipsoid]]\nname = \"body\"\nmaterial = \"soft\"\n";

fn soft(shape: &str, initial: &str) -> String {
    format!("{SOFT}{shape}\n[initial]\n{initial}\n")
}

fn wobble(rate: f64) -> String {
    format!("wobble = {{ angle = \"10 deg\", rate = {rate}, mode = \"short-axis\" }}")
}

const AXES: &str = "semi_axes = [101.0, 100.5, 99.0]";
const OBSERVED: &str = "\nshape = \"as-observed\"";

fn refused(model: &str) -> String {
    let opened = Study::read_from(Path::new("model.toml"), model.as_bytes(), None);
    let error = match opened {
        Ok(study) => study.initial().unwrap_err(),
        Err(error) => error,
    };
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The Earth as an elastic ball with the moments observed: Euler's 304 d become 417 d by the bulge of (G20), a quarter of the difference of
/// the moments. Its share of second order is the bulge over the moments, a thousandth.
#[test]
fn the_chandler_wobble_is_slower_than_eulers() {
    let file = format!("{ROOT}/data/published/measured/chandler-wobble/model.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let observed = if text.contains("as-observed") {
        text.clone()
    } else {
        text.replace("moment_ratios", "shape = \"as-observed\"\nmoment_ratios")
    };
    let earth = study(&observed);
    let (R, rho, mu, poisson, spin) = (6.371e6_f64, 5514.0, 1.76e11, 0.29, 7.292115e-5);
    let lambda = 2.0 * mu * poisson / (1.0 - 2.0 * poisson);
    let (a, b) = (4.0 * lambda + 14.0 * mu, 5.0 * lambda + 7.0 * mu);
    let (c, d) = (4.0 * (lambda + mu), 5.0 * lambda + 4.0 * mu);
    let (beta, gamma) = (-rho * d / (a * d - b * c), rho * c / (a * d - b * c));
    let alpha = -0.5 * (4.0 * beta + gamma);
    let bulge = 8.0
        * std::f64::consts::PI
        * rho
        * spin
        * spin
        * R.powi(7)
        * ((alpha / 5.0 + beta / 7.0) / 3.0 + gamma / 105.0);
    let moment = 0.4 * rho * 4.0 / 3.0 * std::f64::consts::PI * R.powi(5);
    let euler = TAU / (0.0032845 * spin);
    let expected = euler / (1.0 - bulge / (0.0032845 * moment));
    let found = TAU / mode(&modes(&earth).spins[0].modes, "nutation").frequency;
    println!("{} d, after (G20) {} d", found / 86_400.0, expected / 86_400.0);
    close(found, expected, 3e-3);
    let record = evolved(&earth, |_| {}).record;
    let start = record.start.unwrap();
    close(start.rotation_period, expected, 3e-3);
    // the bulge that goes round in the body has an angular momentum of its own: its share of the moment, times the rate of the wobble over the spin
    let internal = bulge / moment * TAU / (found * spin);
    close(start.nutation_greatest, (0.2f64 / 3600.0).to_radians(), internal);
    // the rate given is that of the body in rotation, whose moments are those given; the series of order 3 leaves out the square of the bulge
    let finer = evolved(&of_order(&observed, 5), |_| {}).record.start.unwrap();
    close(finer.precession_period, TAU / spin, 1e-6);
    let notes = earth.model.notes.join(" ");
    assert!(
        notes.contains("Its moments of inertia as observed") && notes.contains("bulge is 27.2"),
        "{notes}"
    );
}

/// Ten degrees in the file are ten degrees at the start, of soft bodies as of stiff ones, and the angular momentum is that of the rate.
#[test]
fn a_wobble_given_is_the_wobble_found() {
    for shape in [
        AXES.to_owned(),
        AXES.to_owned() + OBSERVED,
        format!("diameter = 200.0\nmoment_ratios = [1.0, 1.006, 1.02]{OBSERVED}"),
    ] {
        for rate in [0.001, 0.03, 0.05] {
            let model = soft(&shape, &wobble(rate));
            let body = study(&model);
            let record = evolved(&body, |asked| asked.until = Some("5 deg".parse().unwrap())).record;
            let start = record.start.unwrap();
            println!("{rate}: {}", start.nutation_greatest.to_degrees());
            // the moments of the polhode are the effective ones, which the bulge changes by half a per cent
            close(start.nutation_greatest, 10f64.to_radians(), 2e-3);
        }
    }
}

/// After the period of the polhode the angular velocity of the full system is back; after that of the rigid body with the moments
/// observed it is not.
#[test]
fn periods_given_are_those_of_the_motion() {
    let periods = "periods = { rotation = \"4.5 h\", precession = \"3.5 min\", mode = \"short-axis\" }";
    let body = study(&soft(&(AXES.to_owned() + OBSERVED), periods));
    let start = evolved(&body, |asked| asked.until = Some("1 deg".parse().unwrap())).record.start.unwrap();
    close(start.rotation_period, 4.5 * 3600.0, 3e-3);
    close(start.precession_period, 3.5 * 60.0, 3e-3);
    let away = |t: f64| {
        let history = finished(&body, System::Reduced, &[0.0, t]);
        let omega = history.run.last.omega;
        let first = body.initial().unwrap().omega;
        norm(add(omega, scale(-1.0, first))) / norm([first[0], first[1], 0.0])
    };
    let (back, early) = (away(4.5 * 3600.0), away(0.8 * 4.5 * 3600.0));
    println!("{back} {early}");
    assert!(back < 0.05 && early > 0.5, "{back} {early}");
}

/// The steady spin of the modes has the shape observed again, and a surface behaves as the ellipsoid.
#[test]
fn every_answer_uses_the_relaxed_body() {
    let spin = "angular_velocity = [0, 0, 0.05]";
    let body = study(&soft(&(AXES.to_owned() + OBSERVED), spin));
    let semi = body.model.assembly.ellipsoids[0].semi_axes;
    assert!(semi[0] < 100.9 && semi[2] > 99.2, "{semi:?}");
    assert!(body.model.assembly.as_observed.is_none());
    let still = study(&soft(AXES, spin));
    close(body.body.invariants().mass, still.body.invariants().mass, 1e-14);
    let ends = soft(&(AXES.to_owned() + OBSERVED), spin).replace("Q = 100", "Q = 100, range = [50, 200]");
    let ranged = study(&ends);
    for end in ranged.model.extremes.as_ref().unwrap().iter() {
        assert_eq!(end.ellipsoids[0].semi_axes, semi);
        assert!(end.body().is_ok());
    }
}

/// What cannot be is told: no rotation, a start of another shape, a bulge larger than the difference of the moments, a body too soft.
#[test]
fn shapes_that_cannot_have_been_observed_are_refused() {
    let observed = AXES.to_owned() + OBSERVED;
    let none = refused(&format!("{SOFT}{observed}\n"));
    assert!(none.contains("the file gives no rotation"), "{none}");
    let rest = refused(&soft(&observed, "angular_velocity = [0, 0, 0]"));
    assert!(rest.contains("this body is at rest"), "{rest}");
    let other = refused(&soft(&observed, "angular_velocity = [0, 0, 0.01]\ndisplacements = \"rest\""));
    assert!(other.contains("deformed by its spin"), "{other}");
    let fast = refused(&soft(&observed, "angular_velocity = [0, 0, 0.5]"));
    assert!(fast.contains("elasticity is linear here"), "{fast}");
    let word = refused(&soft(&format!("{AXES}\nshape = \"observed\""), "angular_velocity = [0, 0, 0.01]"));
    assert!(word.contains("as-observed"), "{word}");

    let bulging = refused(&soft(&observed, &wobble(0.08)));
    assert!(
        bulging.contains("the bulge of the spin is larger than the difference of the moments"),
        "{bulging}"
    );
    let spinning = study(&soft(&observed, "angular_velocity = [0, 0, 0.08]"));
    let notes = spinning.model.notes.join(" ");
    assert!(notes.contains("ANOTHER AXIS HAS THE GREATEST MOMENT"), "{notes}");
}
