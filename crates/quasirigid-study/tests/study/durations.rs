//! Evolutions for a time: they end there, whatever the method, and say so.

use quasirigid_study::Study;

use crate::support::{carrier, evolved, rotor, study, study_of, until, wobbling};

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
