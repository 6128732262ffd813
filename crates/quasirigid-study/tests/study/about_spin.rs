//! Reduced equations about the spin: range, coefficients, histories, evolutions, and the order of their errors.

use std::sync::LazyLock;

use quasirigid_io::model::{BodyKind, EvolveMethod, System};
use quasirigid_math::rotation::{normalized, to_inertial};
use quasirigid_study::Study;
use quasirigid_study::about_spin::{AboutSpin, verification_text};
use quasirigid_study::histories::Table;
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::settings::{PartialRun, PartialSpinManifold, PartialSpinVerify};
use serde_json::Value;

use crate::support::{
    SPIN, carrier, close, column, evolved, example, finished, follow, mode, modes, modes_about, numbers,
    one_line, point, spinning, study, study_of, table, target, told_history, vector, wobbling,
};

/// Satellite with a tuned damper on a spring.
const DAMPER: &str = "nutation-damper";
/// Explorer 1 as it flew, and its equations of the ninth degree.
static EXPLORER: LazyLock<Study> = LazyLock::new(|| study_of("explorer1"));
static NINTH: LazyLock<AboutSpin<'static>> = LazyLock::new(|| about(&EXPLORER, 9));

fn of_degree(degree: usize) -> PartialSpinManifold {
    PartialSpinManifold { degree: Some(degree), ..PartialSpinManifold::default() }
}

fn about(study: &Study, degree: usize) -> AboutSpin<'_> {
    study.about_spin(of_degree(degree), None).unwrap()
}

#[test]
fn explorer_1_as_it_flew_has_equations_about_its_spin() {
    let found = &*NINTH;
    assert!(found.holds());
    // The rate of a small nutation at this |K|, from an independent linearisation of the satellite, printed to four digits.
    let rate = found.manifold.masters[0].decay_rate;
    assert!((rate + 0.087_64).abs() < 1e-5, "{rate}");
    let range = found.range.nutation.to_degrees();
    assert!((38.0..42.0).contains(&range), "{range}");
    assert!(found.backbone.points.len() > 20);
    assert!(one_line(&found.text()).contains("hold to a nutation of 39.5 degrees within 1 %"));
}

/// At a low degree the start is outside the range: said first.
#[test]
fn a_start_outside_the_range_is_told_first() {
    let found = about(&EXPLORER, 3);
    let text = one_line(&found.text());
    let first = "Explorer 1: The reduced equations about the spin DO NOT HOLD at the start";
    assert!(!found.holds() && text.starts_with(first), "{text}");
}

#[test]
fn check_says_which_reduction_holds() {
    for (example, holds, reduction) in
        [("explorer1-stiff", true, "rest"), (DAMPER, false, "spin"), ("duende", true, "rest")]
    {
        let study = study_of(example);
        let found = study.check().unwrap();
        assert_eq!((found.holds(), found.reduction()), (holds, reduction), "{example}");
        let text = one_line(&found.text());
        let words = "+ The reduced equations about the spin hold to a nutation of";
        assert_eq!(text.contains(words), reduction == "spin", "{text}");
    }
}

#[test]
fn a_history_on_the_manifold_is_that_of_the_full_system() {
    let study = study_of(DAMPER);
    let [full, reduced] = [System::Full, System::SpinManifold]
        .map(|system| finished(&study, system, &[0.0, 40.0]).run.last.omega);
    for (full, reduced) in full.iter().zip(&reduced) {
        assert!((full - reduced).abs() < 1e-4, "{full} {reduced}");
    }
}

#[test]
fn verify_measures_the_order_in_the_amplitude() {
    let asked = PartialSpinVerify::default();
    let found = study_of(DAMPER).verify_about_spin(&asked, &mut ()).unwrap().unwrap();
    assert!(found.reached() && found.rows.iter().map(|row| row.degree).eq([1, 2, 3]));
    for row in &found.rows {
        assert!((row.order.unwrap() - (row.degree + 1) as f64).abs() < 0.35, "{row:?}");
    }
    let text = verification_text("damper", BodyKind::Spacecraft, &found);
    assert!(text.contains("Every order is reached."), "{text}");
}

/// A boom on a spring so soft that the mass falls outwards: the steady spin is unstable, and no slow motion about it lasts.
fn buckled() -> Study {
    let soft = point("soft", 0.0162, [-0.534, 0.061, -0.371], [0.00097, 6.28e-5])
        .replace("[[spring]]", "motion = { line = [0, 0, 1] }\n[[spring]]");
    study(
        &(carrier(100.0, [16.1, 19.2, 18.0]).replace("[0, 0, 0]", "[0.02, -0.05, 0.1]")
            + &soft
            + &wobbling("10 deg", "1 rad/s", "short-axis")),
    )
}

/// What holds is right: the method of its own is that of the full system, and is refused where the spin is unstable.
#[test]
fn evolve_on_the_manifold_agrees_with_the_full_system_or_refuses() {
    let study = study_of(DAMPER);
    let [reduced, full] = [EvolveMethod::SpinManifold, EvolveMethod::Full]
        .map(|method| evolved(&study, |asked| asked.method = Some(method)).record);
    assert_eq!((&*reduced.road, &*full.road), ("manifold", "direct"));
    let error = reduced.time_error.unwrap();
    assert!((reduced.time / full.time - 1.0).abs() <= error && error < 0.01, "{reduced:?}");
    let buckled = buckled();
    let refused = evolved(&buckled, |asked| {
        (asked.method, asked.until) = (Some(EvolveMethod::SpinManifold), target("0.9990"));
    });
    assert_eq!(refused.record.status, "refused");
    let told = one_line(&buckled.about_spin(PartialSpinManifold::default(), None).unwrap().text());
    assert!(told.contains("DO NOT HOLD: the steady spin is unstable"), "{told}");
}

/// The value of `R` at `z = 0.1` from the printed coefficients is the decay rate and frequency of the backbone.
#[test]
fn json_has_coefficients_that_give_the_backbone() {
    let object = about(&EXPLORER, 7).json();
    let masters = object["masters"].as_array().unwrap();
    assert_eq!((masters.len(), &masters[0]["name"]), (1, &Value::from("nutation")));
    // the eigenvalue of (M2), which another solver finds
    let least = modes_about(&EXPLORER, PrincipalAxis::Least);
    let [rate, expected] =
        [masters[0]["decay_rate"].as_f64().unwrap(), mode(&least.spins[0].modes, "nutation").decay_rate];
    assert!((rate / expected - 1.0).abs() < 1e-9, "{rate}");
    let backbone = object["backbone"].as_array().unwrap();
    for point in backbone.iter().step_by(8) {
        let of = |name: &str| point[name].as_f64().unwrap();
        let rho = of("amplitude");
        let (mut re, mut im) = (0.0, 0.0);
        for term in object["R"].as_array().unwrap() {
            let [a, b] = [0, 1].map(|k| term["exponents"][k].as_f64().unwrap());
            assert_eq!(
                (&term["master"], a),
                (&Value::from(0), b + 1.0),
                "a normal form keeps z (z z*)^k alone"
            );
            let value = numbers(&term["value"]);
            re += value[0] * rho.powf(a + b - 1.0);
            im += value[1] * rho.powf(a + b - 1.0);
        }
        assert!(
            (re / -of("decay_rate") - 1.0).abs() < 1e-9 && (im / of("frequency") - 1.0).abs() < 1e-12,
            "{point}"
        );
        assert!((of("decay_rate") * of("time_constant") - 1.0).abs() < 1e-12, "{point}");
        let shares: f64 =
            point["dissipation"].as_object().unwrap().values().map(|x| x.as_f64().unwrap()).sum();
        assert!((shares - 1.0).abs() < 1e-12, "{point}");
    }
    let border = object["range"]["amplitude"].as_f64().unwrap();
    assert!((backbone[32]["amplitude"].as_f64().unwrap() / border - 1.0).abs() < 1e-12);
    assert!((backbone[32]["defect"]["power"].as_f64().unwrap() / 0.01 - 1.0).abs() < 0.01);
}

/// `W` at the coordinates of the start has the angular momentum of the steady spin in the printed direction, of unit length.
#[test]
fn json_has_the_manifold() {
    let object = NINTH.json();
    let z = numbers(&object["start"]["coordinates"][0]);
    let (rho, theta) = (z[0].hypot(z[1]), z[1].atan2(z[0]));
    let mut direction = [0.0; 3];
    let mut omega = [0.0; 3];
    for term in object["W"].as_array().unwrap() {
        let [a, b] = [0, 1].map(|k| term["exponents"][k].as_f64().unwrap());
        let (size, phase) = (rho.powf(a + b), (a - b) * theta);
        for (name, sum) in [("direction", &mut direction), ("omega", &mut omega)] {
            for axis in 0..3 {
                let value = numbers(&term[name][axis]);
                sum[axis] += size * (value[0] * phase.cos() - value[1] * phase.sin());
            }
        }
        assert_eq!(term["rates"].as_array().unwrap().len(), 8);
        assert_eq!(term["coordinates"].as_array().unwrap().len(), 8);
    }
    let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
    assert!((length - 1.0).abs() < 1e-5, "{direction:?}"); // truncated beyond degree 9 at 0.4
    let asked = Table { manifold: of_degree(9), ..table(System::SpinManifold, &[0.0]) };
    let history = EXPLORER.simulate(&PartialRun::default(), &asked, &mut ()).unwrap();
    let start = vector(&history.columns, SPIN, 0);
    for axis in 0..3 {
        assert!((omega[axis] - start[axis]).abs() < 1e-9 * start[2], "{omega:?} {start:?}");
    }
}

/// The full system after 5 s, 59 revolutions: the nutation has grown by half; phases differ by the vibrations of the start.
#[test]
fn a_history_follows_the_full_system() {
    let full = finished(&EXPLORER, System::Full, &[0.0, 5.0]).run.last.energy;
    let asked = Table { manifold: of_degree(9), ..table(System::SpinManifold, &[0.0, 5.0]) };
    let (found, told) = told_history(&EXPLORER, &asked, PartialRun::default());
    assert!(found.holds(), "{}", found.message);
    assert!(told.contains("0.63 % is in vibrations off the spin manifold, which are left out"), "{told}");
    let manifold = column(&found.columns, "energy");
    assert!((manifold[1] / full - 1.0).abs() < 2e-3, "{manifold:?} {full}"); // 0.6 % of the start's 100 J is left out
    assert!((manifold[1] - manifold[0]).abs() > 80.0);
}

#[test]
fn a_history_that_leaves_the_range_says_so() {
    let found = follow(&EXPLORER, System::SpinManifold, &[0.0, 5.0, 30.0]);
    assert!(!found.holds() && found.status == "left-validity", "{}", found.message);
    assert_eq!(found.columns[0].values.len(), 3);
    let verdict = found.manifold.unwrap();
    assert!(verdict.sentence().starts_with("The history LEFT THE RANGE"), "{}", verdict.sentence());
    assert_eq!((verdict.holds(), verdict.worst_time), (false, 30.0));
}

/// The verdict on a history that does not hold.
fn does_not_hold(model: &str, times: [f64; 2]) -> String {
    let found = follow(&study(model), System::SpinManifold, &times);
    assert!(!found.holds());
    found.manifold.unwrap().sentence()
}

/// A damper too heavy for its spring, which the spin throws out.
#[test]
fn a_history_that_the_motion_leaves_by_itself_says_so() {
    let heavy = example(DAMPER).replace("mass = 0.1\n", "mass = 4.17431\n");
    let told = does_not_hold(&heavy, [0.0, 25.0]);
    let first = "The history DOES NOT HOLD: a motion of \"damper\" along its line grows e-fold in 0.5459 s";
    assert!(told.starts_with(first), "{told}");
}

/// Whips that vibrate much more than the satellite nutates.
#[test]
fn a_history_of_vibrations_says_so() {
    let start = "angular_velocity = [0.002, 0.002, \"750 rpm\"]\ndisplacements = { \"whip +x\" = [0, \"5 deg\"], \"whip -x\" = [0, \"5 deg\"] }";
    let model = example("explorer1").replace("angular_velocity = [0.75, 0.75, \"750 rpm\"]", start);
    let told = does_not_hold(&model, [0.0, 1.0]);
    assert!(told.starts_with("The history DOES NOT HOLD: the vibrations of the start"), "{told}");
    assert!(told.contains("have 228 times the energy of the motion that they follow"), "{told}");
}

/// A body with a bias wheel off its axes, in axes turned by an attitude.
fn biased(attitude: [f64; 4]) -> String {
    let turn = |vector: [f64; 3]| to_inertial(normalized(attitude), vector);
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(turn);
    let moments = [10.0, 14.0, 18.0];
    let entry = |i: usize, j: usize| (0..3).map(|k| moments[k] * axes[k][i] * axes[k][j]).sum::<f64>();
    let inertia: [[f64; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (entry(i, j) + entry(j, i))));
    let isotropic = point("m", 1.0, turn([0.5, 0.3, 0.4]), [100.0, 1.0]);
    format!(
        "[carrier]\nmass = 100.0\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia:?}\n{isotropic}[[wheel]]\nname = \"w\"\naxis = {:?}\n\
         momentum = 20.0\n{}",
        turn([1.0, 0.3, 0.5]),
        spinning(turn([0.001, 0.002, 0.001]))
    )
}

/// Where a momentum wheel turns the spin away from the axes, the equations are about the spin that `modes` and `evolve` find, in any axes: of
/// least energy about the start, of greatest energy where that of least inertia is asked for.
#[test]
fn a_bias_wheel_off_the_axes_has_equations_about_its_steady_spin() {
    for attitude in [[1.0, 0.0, 0.0, 0.0], [0.3, -0.7, 0.5, 0.4]] {
        let study = study(&biased(attitude));
        let spins = modes(&study).spins;
        for (axis, of_energy) in [(None, "least energy"), (Some(PrincipalAxis::Least), "greatest energy")] {
            let found = study.about_spin(of_degree(3), axis).unwrap();
            let known = spins.iter().find(|spin| spin.axis == of_energy).unwrap();
            let nutation = mode(&known.modes, "nutation");
            let master = &found.manifold.masters[0];
            close(master.decay_rate, nutation.decay_rate, 1e-6);
            close(master.frequency, nutation.frequency, 1e-9);
            assert_eq!((found.name, found.start.is_some()), (of_energy, axis.is_none()));
            assert!(found.text().contains(&format!("Steady spin of {of_energy}\n")), "{}", found.text());
        }
    }
}
