//! Evolutions for a time: they end there, whatever the method, and say so.

use quasirigid_study::Study;

use crate::support::{carrier, evolved, hinged, rotor, study, study_of, until, wobbling};

/// Two lightly damped panels on hinges, whose vibrations at the start last for minutes.
const PANELS: &str = r#"
carrier = { mass = 60.608, center_of_mass = [-0.0063, 0.0069, 0.009], inertia = [4.3906, 3.6313, 6.449] }
initial = { wobble = { angle = "6.12 deg", rate = 2.8766, mode = "short-axis" } }
[[hinged]]
name = "panel +y"
mass = 1.5596
center_of_mass = [0, 1.0791, 0.05]
inertia = [0.27365, 0.032485, 0.30583]
hinge = [0, 0.35352, 0.05]
axes = [[1, 0, 0]]
stiffness = "5.89513 N m/rad"
damping = "0.019467 N m s/rad"
[[hinged]]
name = "panel -y"
mass = 1.5596
center_of_mass = [0, -1.0791, 0.05]
inertia = [0.27365, 0.032485, 0.30583]
hinge = [0, -0.35352, 0.05]
axes = [[1, 0, 0]]
stiffness = "5.89513 N m/rad"
damping = "0.019467 N m s/rad"
"#;

/// Status, time (s) and message of an evolution for a time (s).
fn lasting(study: &Study, duration: f64) -> (String, f64, String) {
    let found = evolved(study, |asked| asked.duration = Some(duration)).record;
    (found.status, found.time, found.message)
}

/// A duration that ends within the vibrations of the start is kept.
#[test]
fn a_duration_within_the_vibrations_of_the_start_is_kept() {
    let panels = study(PANELS);
    for duration in [10.0, 60.0] {
        let (status, time, message) = lasting(&panels, duration);
        assert!((time / duration - 1.0).abs() < 1e-9, "{duration}: {time} {message}");
        assert!(status == "finished" && message.contains("as asked"), "{message}");
    }
}

/// A wobble about the axis of least inertia is followed for a time in which it stays small, though its end lies behind the separatrix.
#[test]
fn a_duration_before_the_separatrix_is_answered() {
    let oil = carrier(260.0, [150.0, 155.0, 220.0]).replace("[0, 0, 0]", "[0, 0, 0.1]")
        + &rotor("wheel", [1.0, 0.2, 0.0], 0.02, 0.5)
        + "[[cavity]]\nname = \"oil\"\nshape = \"sphere\"\nradius = \"0.25 m\"\ncenter = [0.0, 0.0, -0.4]\n\
           density = \"1 g/cm^3\"\ndynamic_viscosity = \"100 mPa s\"\n"
        + &wobbling("1 deg", "30 rpm", "long-axis")
        + &until("3 deg");
    let (status, time, message) = lasting(&study(&oil), 5.0);
    assert!(status == "finished" && (time / 5.0 - 1.0).abs() < 1e-9, "{time} s: {message}");
}

/// An evolution for a time is said to be followed as asked where it lasts that long, and nowhere else.
#[test]
fn what_lasts_as_asked_is_told_as_such() {
    for (example, duration) in [("boom-satellite", 3000.0), ("boom-satellite", 1e9), ("nutation-damper", 1e6)]
    {
        let (_, time, message) = lasting(&study_of(example), duration);
        let as_asked = (time / duration - 1.0).abs() < 1e-8;
        assert_eq!(message.contains("as asked"), as_asked, "{example}, {duration} s: {time} s, {message}");
    }
}

/// A long-axis spin whose whole way takes minutes of the full system, and a short part of it a moment.
const LONG_WAY: &str = r#"
carrier = { mass = 376.988, center_of_mass = [0.0341073, 0.0442016, -0.0211842], inertia = [69.5531, 109.655, 121.159] }
point = [{ name = "tip", mass = 1.84867, position = [-1.59215, -0.818163, -1.77954] }]
spring = [{ from = "tip", to = "carrier", stiffness = [245.458, 260.417, 185.32], damping = [2.56181, 2.63871, 2.22596] }]
rotor = [{ name = "ball", shape = "sphere", inertia = 0.387699, friction = 29.2778 }]
initial = { wobble = { angle = "1.246 deg", rate = 1.54047, mode = "long-axis" } }
[[hinged]]
name = "flap"
mass = 3.44238
center_of_mass = [-0.345888, -1.79756, -0.603811]
inertia = [0.834808, 0.743706, 0.812044]
hinge = [-0.192809, -1.12091, 0.693939]
axes = [[-0.779786, -0.51268, 0.359296]]
stiffness = [371.328]
damping = [0.246435]
"#;

/// A short part of a long way is followed, and not refused for the time that the whole way takes: 9.3 revolutions of the full system.
#[test]
fn a_short_part_of_a_long_way_is_followed() {
    let (status, time, message) = lasting(&study(LONG_WAY), 38.0);
    assert!(status == "finished" && (time / 38.0 - 1.0).abs() < 1e-9, "{time} {message}");
}

/// A wobble that dies out before the time asked for is told to; one that lasts as long is not.
#[test]
fn an_answer_that_ends_before_its_time_says_so() {
    let flap = hinged(
        "flap",
        [0.318885, 0.005],
        [[0.285087, 0.121586, 0.300099], [0.0349185, 0.373605, 0.435345]],
        "[[-0.384493, -0.702844, 0.598477]]",
        [0.0409745, 0.000810074],
    );
    let start = wobbling("0.8616 deg", "0.203596 rad/s", "short-axis");
    let study = study(&(carrier(11.2618, [0.90198, 1.49393, 1.09203]) + &flap + &start));
    for (duration, ends) in [(1e6, false), (1e12, true)] {
        let found = evolved(&study, |asked| asked.duration = Some(duration));
        let said = found.notes.iter().any(|note| note.contains("The answer ends after"));
        assert_eq!(
            [found.record.time < 0.99 * duration, said],
            [ends; 2],
            "{duration}: {}",
            found.record.time
        );
    }
}
