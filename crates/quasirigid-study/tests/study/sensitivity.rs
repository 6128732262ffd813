//! Sensitivities: closed forms, the law of units over all numbers of a file, corners, and what has no derivative. (O1), (O3)

use std::collections::BTreeMap;

use quasirigid_io::model::{KeyPath, changed};
use quasirigid_study::StudyError;
use quasirigid_study::sensitivity::Sensitivity;

use crate::support::{MODEL, close, example, modes, nutation, one_line, study};

fn sensitivity(model: &str, of: &str, keys: &[&str]) -> Result<Sensitivity, StudyError> {
    let keys: Vec<KeyPath> = keys.iter().map(|key| key.parse().unwrap()).collect();
    study(model).sensitivity(&of.parse().unwrap(), &keys, &mut ())
}

fn relative(model: &str, of: &str, keys: &[&str]) -> BTreeMap<String, f64> {
    let found = sensitivity(model, of, keys).unwrap();
    assert!(found.not_known.is_empty(), "{:?}", found.not_known);
    found.derivatives.into_iter().map(|each| (each.key, each.relative.unwrap())).collect()
}

/// A mass on a spring on a held carrier.
const OSCILLATOR: &str = r#"
[carrier]
mass = 100.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [10.0, 12.0, 16.0]
[[point]]
name = "bob"
mass = "250 g"
position = [0.4, 0.0, 0.2]
motion = { line = [0, 0, 1] }
[[spring]]
name = "coil"
from = "bob"
to = "carrier"
stiffness = "0.8 N/m"
damping = 0.02
[support]
kind = "fixed-point"
point = [0.0, 0.0, 0.0]
[initial]
angular_velocity = [0.0, 0.0, 0.5]
"#;

/// `ω = √(k/m)` of the undamped vibration, whatever unit a key has, and named by name or by number.
#[test]
fn an_oscillator_has_its_closed_form() {
    let found =
        sensitivity(OSCILLATOR, "check.frequencies.1", &["spring.1.stiffness", "point.bob.mass"]).unwrap();
    let held = relative(OSCILLATOR, "check.frequencies.1", &["spring.coil.stiffness"]);
    close(held["spring.coil.stiffness"], 0.5, 1e-9);
    let [first, second] = &found.derivatives[..] else { panic!("{found:?}") };
    let (stiffness, mass) =
        if first.key == "spring.coil.stiffness" { (first, second) } else { (second, first) };
    assert_eq!((stiffness.unit.as_str(), mass.unit.as_str(), mass.value), ("N/m", "g", 250.0));
    close(stiffness.derivative, found.value / (2.0 * 0.8), 1e-9);
    assert!(mass.derivative < 0.0 && mass.error < 1e-9 * mass.derivative.abs());
}

/// Exponents of metre, kilogram and second in a key.
fn dimension(key: &str) -> [f64; 3] {
    let table: [(&str, [f64; 3]); 8] = [
        (".mass", [0.0, 1.0, 0.0]),
        ("inertia", [2.0, 1.0, 0.0]),
        ("position", [1.0, 0.0, 0.0]),
        ("center_of_mass", [1.0, 0.0, 0.0]),
        ("stiffness", [0.0, 1.0, -2.0]),
        ("damping", [0.0, 1.0, -1.0]),
        ("line", [0.0, 0.0, 0.0]),
        ("wobble", [0.0, 0.0, 0.0]),
    ];
    if key.contains("angular_velocity") || key.ends_with("rate") {
        return [0.0, 0.0, -1.0];
    }
    table.iter().find(|(word, _)| key.contains(word)).unwrap_or_else(|| panic!("{key}")).1
}

/// A change of units changes no physics: over all numbers of a file, `Σ n_k ∂ln q/∂ln k` is the exponent of `q`.
#[test]
fn all_numbers_of_a_file_obey_the_law_of_units() {
    let plain = [
        (example("nutation-damper"), "modes.nutation.time_constant"),
        (example("boom-satellite"), "modes.nutation.time_constant"),
        (example("boom-satellite"), "check.T1"),
    ];
    for (text, of) in plain {
        let found = sensitivity(&text, of, &[]).unwrap();
        let unknown: Vec<_> =
            found.not_known.iter().filter(|none| !none.reason.contains("it is zero")).collect();
        assert!(unknown.is_empty(), "{of}: {unknown:?}");
        let mut sums = [0.0; 3];
        let mut size = 0.0;
        for each in &found.derivatives {
            let relative = each.relative.unwrap();
            size += relative.abs();
            for (sum, exponent) in sums.iter_mut().zip(dimension(&each.key)) {
                *sum += exponent * relative;
            }
        }
        for (sum, known) in sums.iter().zip([0.0, 0.0, 1.0]) {
            assert!((sum - known).abs() < 1e-7 * size, "{of}: {sums:?} {found:#?}");
        }
    }
}

/// The time of an averaged wobble goes as `μQ/(ρR²Ω³)`, (A11): exact exponents, whatever the shape, in the units of the file.
#[test]
fn times_of_small_bodies_have_the_exponents_of_their_closed_form() {
    let found = relative(&example("apophis"), "evolve.time", &[]);
    let sum =
        |word: &str| found.iter().filter(|(key, _)| key.contains(word)).map(|(_, value)| value).sum::<f64>();
    for (word, known) in
        [("shear", 1.0), ("density", -1.0), ("rheology.Q", 1.0), ("semi_axes", -2.0), ("periods", 3.0)]
    {
        close(sum(word), known, 1e-5);
    }
}

/// The derivative is the slope between two neighbours, each a whole answer.
#[test]
fn a_time_constant_changes_as_its_derivative_says() {
    let text = example("nutation-damper");
    let of = "modes.nutation.time_constant";
    let found = sensitivity(&text, of, &["spring.1.damping"]).unwrap();
    let at = |damping: f64| {
        let text = changed(&text, &[("spring.1.damping", damping.into())]).unwrap();
        nutation(&modes(&study(&text)))
    };
    let step = 1e-5;
    let slope = (at(0.0562 + step) - at(0.0562 - step)) / (2.0 * step);
    close(found.derivatives[0].derivative, slope, 1e-5);
    close(found.value, at(0.0562), 1e-12);
}

/// Two equal springs on two axes: the lower of two crossing frequencies has a corner, and a central difference that means nothing.
#[test]
fn crossing_frequencies_have_no_derivative() {
    let twin = r#"
[carrier]
mass = 1e6
center_of_mass = [0.0, 0.0, 0.0]
inertia = [1e6, 1e6, 1.1e6]
[[point]]
name = "bob"
mass = 1.0
position = [0.0, 0.0, 0.0]
[[spring]]
from = "bob"
to = "carrier"
stiffness = [100.0, 100.0, 400.0]
damping = 0.1
[initial]
angular_velocity = [0.0, 0.0, 0.5]
"#;
    let found = sensitivity(twin, "check.frequencies.1", &["spring.1.stiffness.1"]).unwrap();
    assert!(found.derivatives.is_empty(), "{found:?}");
    assert!(found.not_known[0].reason.contains("corner"), "{found:?}");
    let text = one_line(&found.text(false));
    assert!(text.contains("NOT KNOWN for spring.1.stiffness.1: the quantity has a corner"), "{text}");
}

#[test]
fn what_has_no_derivative_is_told() {
    let no = |of: &str, keys: &[&str]| sensitivity(MODEL, of, keys).unwrap_err().to_string();
    assert!(no("check.nothing", &[]).contains("there is no `nothing`"));
    assert!(no("check.valid", &[]).contains("is no number"));
    assert!(no("check.T1", &["carrier.weight"]).contains("is no number of the model"));
    assert!(no("check.T1", &["carriage.mass"]).contains("there is no `carriage`"));
    assert!("T1".parse::<quasirigid_io::study_file::Quantity>().is_err());
    let text = example("nutation-damper");
    let integer =
        sensitivity(&text, "modes.nutation.time_constant", &["point.damper.motion.line.3"]).unwrap();
    assert!(integer.derivatives.iter().all(|each| each.relative.unwrap().abs() < 1e-9), "{integer:?}");
    let idle = sensitivity(&text, "modes.nutation.time_constant", &["initial.wobble.angle"]).unwrap();
    assert!(
        one_line(&idle.text(false)).contains("no number of the model changes it"),
        "{}",
        idle.text(false)
    );
}
