//! Light curves: closed forms of rotating ellipsoids, measured blocks, periods found back, refusals.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use quasirigid_io::light_curve::{LightCurveFile, light_curve_of};
use quasirigid_io::model::System;
use quasirigid_study::light_curve::{Hapke, LightCurve, LightCurveSettings, Phase, Scale, Scattering, View};
use quasirigid_study::settings::PartialRun;
use quasirigid_study::{Study, StudyError};

use crate::support::{carrier, close, spinning, study};

const ROCK: &str = "[material.rock]\ndensity = 2500\nshear = 1e9\npoisson = 0.25\n[[ellipsoid]]\nname = \"rock\"\nmaterial = \"rock\"\n";

/// Rock with semi-axes (m) and a start.
fn ellipsoid(semi_axes: [f64; 3], start: &str) -> Study {
    study(&format!("{ROCK}semi_axes = {semi_axes:?}\n[initial]\n{start}\n"))
}

fn settings(view: View) -> LightCurveSettings {
    LightCurveSettings {
        system: System::Reduced,
        view,
        epoch: None,
        scattering: Scattering::LommelSeeliger,
        phase: Phase::Flat,
        scale: Scale::Relative,
        periods: false,
    }
}

fn fixed(sun: [f64; 3], observer: [f64; 3]) -> LightCurveSettings {
    settings(View::Fixed { sun, observer })
}

fn run(duration: f64, samples: usize) -> PartialRun {
    PartialRun { duration: Some(duration), samples: Some(samples), ..PartialRun::default() }
}

#[track_caller]
fn curve(study: &Study, run: &PartialRun, asked: &LightCurveSettings) -> LightCurve {
    study.light_curve(run, asked, &mut ()).unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(study: &Study, asked: &LightCurveSettings) -> String {
    match study.light_curve(&run(1e4, 10), asked, &mut ()) {
        Err(error @ StudyError::LightCurve { .. }) => error.to_string(),
        other => panic!("{other:?}"),
    }
}

fn table(text: &str) -> LightCurveFile {
    light_curve_of(Path::new("view.csv"), text.as_bytes()).unwrap()
}

/// At opposition the brightness by the law of Lommel and Seeliger is the projected area, here of an ellipsoid that turns about z and is seen
/// aslant: `π √(b²c² x² + c²a² y² + a²b² z²)` of the view in the axes of the body. (O15)
#[test]
fn a_rotating_ellipsoid_has_its_projected_area_at_opposition() {
    let [a, b, c] = [900.0, 500.0, 400.0];
    let period = 4.0 * 3600.0;
    let body = ellipsoid([a, b, c], &format!("angular_velocity = [0, 0, {}]", TAU / period));
    let view = [3.0, 1.0, 1.5];
    let found = curve(
        &body,
        &run(period, 101),
        &LightCurveSettings { scale: Scale::Albedo(0.2), ..fixed(view, view) },
    );
    let size = (9.0 + 1.0 + 2.25_f64).sqrt();
    for (t, brightness) in found.t.iter().zip(&found.brightness) {
        let (sin, cos) = (TAU * t / period).sin_cos();
        let [x, y, z] = [(3.0 * cos + sin) / size, (cos - 3.0 * sin) / size, 1.5 / size];
        let area = PI * ((b * c * x).powi(2) + (c * a * y).powi(2) + (a * b * z).powi(2)).sqrt();
        assert!((brightness / (0.2 * area) - 1.0).abs() < 5e-4, "{t}: {brightness} {area}");
    }
    assert!(found.holds && found.surface.convex && found.surface.error < 5e-4);
    assert!(found.phase_angle.iter().all(|angle| *angle < 1e-7));
    // H of this body by hand from the standard relation, at the mean area
    let mean = found.brightness.iter().sum::<f64>() / (0.2 * found.brightness.len() as f64);
    let diameter = 2.0 * (mean / PI).sqrt();
    let H = 5.0 * (1329e3 / (diameter * 0.2_f64.sqrt())).log10();
    let middle = 0.5
        * (found.magnitude.iter().copied().fold(f64::INFINITY, f64::min)
            + found.magnitude.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    assert!((middle - H).abs() < 0.05, "{middle} {H}");
}

/// A body that turns about its short axis has one frequency, twice that of its rotation.
#[test]
fn a_steady_rotation_has_one_frequency() {
    let period = 7e4;
    let body = ellipsoid([900.0, 500.0, 400.0], &format!("angular_velocity = [0, 0, {}]", TAU / period));
    let asked = LightCurveSettings { periods: true, ..fixed([1.0, 0.2, 0.1], [0.6, 0.9, 0.2]) };
    let found = curve(&body, &run(11.3 * period, 700), &asked).periods.unwrap();
    let best = &found.pairs[0];
    assert!(best.second.is_none() && best.explained > 0.999, "{best:?}");
    close(best.first, 0.5 * period, 1e-4);
    assert_eq!(found.of, "computed");
}

/// The two periods of a tumbling body are found back from its light curve, in both modes and in odd units of time.
#[test]
fn the_periods_of_tumblers_are_found_back() {
    for (mode, rotation, precession, unit) in
        [("long-axis", 5.41_f64, 7.35, 86_400.0), ("short-axis", 262.0, 27.38, 3600.0)]
    {
        let start = format!(
            "periods = {{ rotation = {}, precession = {}, mode = \"{mode}\" }}",
            rotation * unit,
            precession * unit
        );
        let semi_axes = if mode == "long-axis" { [2300.0, 1063.0, 929.0] } else { [206.0, 146.0, 130.0] };
        let body = ellipsoid(semi_axes, &start);
        let asked = LightCurveSettings { periods: true, ..fixed([1.0, 0.3, 0.2], [0.7, 0.9, 0.4]) };
        let longest = rotation.max(precession) * unit;
        let found = curve(&body, &run(14.7 * longest, 3001), &asked).periods.unwrap();
        let model = found.model.as_ref().unwrap();
        close(model.precession_period, precession * unit, 1e-3);
        close(model.rotation_period, rotation * unit, 1e-3);
        let [first, second] = model.found.unwrap_or_else(|| panic!("{mode}: {found:#?}"));
        close(first, precession * unit, 2e-3);
        close(second, rotation * unit, 1e-2);
        assert!(model.explained > 0.97, "{mode}: {found:#?}");
        let best = &found.pairs[0];
        assert!(best.second.is_some() && best.explained > 0.95, "{mode}: {best:?}");
    }
}

/// Measured brightness in blocks of free scale: the scales come out, and the residuals are those that were put in.
#[test]
fn measured_blocks_have_their_scales_and_residuals() {
    let period = 2e4;
    let body = ellipsoid([900.0, 500.0, 400.0], &format!("angular_velocity = [0, 0, {}]", TAU / period));
    let heading = "jd,sun_x,sun_y,sun_z,observer_x,observer_y,observer_z,brightness,block\n";
    let row = |k: usize, brightness: f64| {
        format!("{},1.5,0.3,0.2,0.7,0.9,0.4,{brightness},{}\n", 2_450_000.5 + 0.01 * k as f64, k / 20)
    };
    let rows = |value: &dyn Fn(usize) -> f64| -> String { (0..40).map(|k| row(k, value(k))).collect() };
    let asked =
        |text: &str| LightCurveSettings { epoch: Some(2_450_000.0), ..settings(View::File(table(text))) };
    let first = curve(&body, &PartialRun::default(), &asked(&(heading.to_owned() + &rows(&|_| 1.0))));
    assert!((first.t[1] - 0.51 * 86_400.0).abs() < 1e-3 && first.t.len() == 40);
    let measured = |k: usize| {
        let wave = if k.is_multiple_of(2) { 1.01 } else { 0.99 };
        first.brightness[k] * wave * if k < 20 { 1e-3 } else { 7e4 }
    };
    let found = curve(&body, &PartialRun::default(), &asked(&(heading.to_owned() + &rows(&measured))));
    let residuals = found.residuals.as_ref().unwrap();
    close(residuals.rms, 0.01 * (40.0_f64 / 38.0).sqrt(), 1e-3);
    let scales: Vec<f64> = residuals.blocks.iter().map(|block| block.scale).collect();
    close(scales[0], 1e3, 1e-3);
    close(scales[1], 1.0 / 7e4, 1e-3);
    let columns = found.columns();
    assert!(columns.iter().any(|column| column.name == "apparent_relative_magnitude"));
    // written for DAMIT and read again, the curve is its own
    let again = light_curve_of(Path::new("lc.txt"), found.damit().unwrap().as_bytes()).unwrap();
    let again = LightCurveSettings { epoch: Some(2_450_000.0), ..settings(View::File(again)) };
    let own = curve(&body, &PartialRun::default(), &again);
    assert!(own.residuals.unwrap().rms < 1e-6);
    let alcdef = found.alcdef().unwrap();
    assert!(alcdef.contains("SESSIONDATE=1995-10-10") && alcdef.contains("DIFFERMAGS=TRUE"), "{alcdef}");
    let of_albedo =
        LightCurveSettings { scale: Scale::Albedo(0.1), ..asked(&(heading.to_owned() + &rows(&|_| 1.0))) };
    let of_albedo = curve(&body, &PartialRun::default(), &of_albedo).alcdef().unwrap();
    assert!(of_albedo.contains("DIFFERMAGS=FALSE") && !of_albedo.contains("inf"), "{of_albedo}");
    // two telescopes at once: blocks are told by their labels
    let turns = (heading.to_owned() + &rows(&measured)).replace(",0\n", ",3\n").replace(",1\n", ",-2\n");
    let mut lines: Vec<&str> = turns.lines().skip(1).collect();
    lines.sort_by_key(|line| line.len());
    lines.rotate_left(7);
    let mixed = curve(&body, &PartialRun::default(), &asked(&(heading.to_owned() + &lines.join("\n"))));
    let mixed = mixed.residuals.unwrap();
    close(mixed.rms, residuals.rms, 1e-9);
    assert_eq!(mixed.blocks.iter().map(|block| block.points).collect::<Vec<_>>(), [20, 20]);
    // as many scales as points compare nothing
    let single = turns.replace(",3\n", ",0\n");
    let single: String =
        single
            .lines()
            .take(9)
            .enumerate()
            .map(|(k, line)| {
                if k == 0 {
                    format!("{line}\n")
                } else {
                    format!("{},{k}\n", line.rsplit_once(',').unwrap().0)
                }
            })
            .collect();
    let single = curve(&body, &PartialRun::default(), &asked(&single));
    assert!(single.residuals.as_ref().unwrap().rms.is_nan());
    assert!(single.sentence.contains("nothing is compared"), "{}", single.sentence);
}

/// Lines of the model that are faster than the times tell, and a strongest line of few times in a period, are told first.
#[test]
fn periods_that_the_times_leave_open_are_told_so() {
    let period = 7e4;
    let body = ellipsoid([900.0, 500.0, 400.0], &format!("angular_velocity = [0, 0, {}]", TAU / period));
    let asked = LightCurveSettings { periods: true, ..fixed([1.0, 0.2, 0.1], [0.6, 0.9, 0.2]) };
    let coarse = curve(&body, &run(101.3 * period, 151), &asked);
    assert!(!coarse.holds && coarse.sentence.starts_with("MAY NOT HOLD"), "{}", coarse.sentence);
    assert!(coarse.sentence.contains("the times tell none below"), "{}", coarse.sentence);
    let fine = curve(&body, &run(101.3 * period, 2001), &asked);
    assert!(fine.holds && fine.periods.unwrap().doubt.is_none());
}

/// Files of light curves hold no dark body.
#[test]
fn a_dark_body_is_not_written_into_files_of_light_curves() {
    let body = ellipsoid([900.0, 500.0, 400.0], "angular_velocity = [0, 0, 1e-3]");
    let text = "t,sun_x,sun_y,sun_z,observer_x,observer_y,observer_z\n0,1,0,0,0,1,0\n9,1,0,0,-1,0,0\n";
    let asked = LightCurveSettings { epoch: Some(2_450_000.0), ..settings(View::File(table(text))) };
    let found = curve(&body, &PartialRun::default(), &asked);
    for told in [found.damit(), found.alcdef()] {
        assert!(told.unwrap_err().to_string().contains("hold no dark body"));
    }
}

#[test]
fn what_gives_no_light_curve_is_refused_in_words() {
    let body = ellipsoid([900.0, 500.0, 400.0], "angular_velocity = [0, 0, 1e-3]");
    let told = |asked: LightCurveSettings, words: &str| {
        let found = refusal(&body, &asked);
        assert!(found.contains(words), "{words}: {found}");
    };
    let known = || fixed([1.0, 0.0, 0.0], [0.8, 0.6, 0.0]);
    told(fixed([0.0; 3], [1.0, 0.0, 0.0]), "direction to the Sun");
    told(fixed([1.0, 0.0, 0.0], [f64::NAN, 0.0, 0.0]), "direction to the observer");
    told(fixed([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), "no facet of the body is lit and seen");
    told(LightCurveSettings { phase: Phase::HG { G: 3.0 }, ..known() }, "G of the law of scattering is 3");
    let far = fixed([1.0, 0.0, 0.0], [-0.9, 0.3, 0.0]);
    told(LightCurveSettings { phase: Phase::HG { G: 0.1 }, ..far }, "holds up to 120 degrees");
    told(LightCurveSettings { scale: Scale::Albedo(-0.1), ..known() }, "geometric albedo is -0.1");
    told(
        LightCurveSettings { scale: Scale::AbsoluteMagnitude(5.0), ..known() },
        "is the unit of the shape right?",
    );
    let hapke = Scattering::Hapke(Hapke { w: 0.2, g: -0.3, B0: 1.0, h: 0.05, roughness: 0.3 });
    told(LightCurveSettings { scattering: hapke, scale: Scale::Albedo(0.1), ..known() }, "albedo of its own");
    told(
        LightCurveSettings { scattering: hapke, phase: Phase::HG { G: 0.1 }, ..known() },
        "phase function and an albedo of its own",
    );
    let text = "jd,sun_x,sun_y,sun_z,observer_x,observer_y,observer_z\n2450000.5,1,0,0,0,1,0\n";
    told(settings(View::File(table(text))), "give that date, the epoch");
    let late = LightCurveSettings { epoch: Some(2_450_001.0), ..settings(View::File(table(text))) };
    told(late, "row 1 of the view is 4.320000e4 s before the start");
    let behind = text.replace("observer_z\n", "observer_z,brightness\n").replace("0,1,0\n", "-1,0,0,1\n")
        + "2450000.6,1,0,0,0,1,0,1\n";
    let behind = LightCurveSettings { epoch: Some(2_450_000.0), ..settings(View::File(table(&behind))) };
    told(behind, "brightness was measured at 43200 s, and no facet");
    let few =
        LightCurveSettings { epoch: Some(2_450_000.0), periods: true, ..settings(View::File(table(text))) };
    told(few, "fewer than eight times");
    let satellite = study(&(carrier(40.0, [9.0, 13.0, 16.0]) + &spinning([0.0, 0.0, 0.1])));
    let found = refusal(&satellite, &known());
    assert!(found.contains("no outer surface to see"), "{found}");
    let undated = curve(&body, &run(1e4, 10), &known());
    assert!(undated.damit().unwrap_err().to_string().contains("Julian dates"));
}
