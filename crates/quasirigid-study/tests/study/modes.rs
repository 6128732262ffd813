//! Modes about steady spins and steady states under forces: closed forms, names, words, and what has none.

use std::collections::BTreeSet;

use quasirigid_io::model::Named;
use quasirigid_io::record::SteadySpinRecord;
use quasirigid_study::modes::{Modes, PrincipalAxis, SteadySpinSettings};

use crate::support::{
    MODEL, carrier, close, ellipsoid, evolved, example, expression, fixed, gravity, hinged, mode, modes,
    modes_about, nutation, of_order, one_line, point, spinning, study,
};

/// A body that hangs from a point, 0.5 m below it; its moments about that point are 10.25, 14 and 16 kg m2.
fn pendulum() -> String {
    carrier(40.0, [9.0, 13.0, 16.0]) + &fixed([0.0, 0.0, 0.5]) + &gravity([0.0, 0.0, -9.81])
}

/// Modes about a spin asked for (rad/s).
fn modes_at(model: &str, omega: [f64; 3]) -> Modes {
    study(model).modes(SteadySpinSettings { omega: Some(omega), ..SteadySpinSettings::default() }).unwrap()
}

fn text(found: &Modes) -> String {
    one_line(&found.text("model", false))
}

fn names(spin: &SteadySpinRecord) -> Vec<&str> {
    spin.modes.iter().map(|mode| &*mode.name).collect()
}

#[test]
fn a_pendulum_at_rest_has_its_two_frequencies() {
    let found = modes(&study(&pendulum()));
    let spin = &found.spins[0];
    assert!(spin.stable && spin.modes.len() == 2, "{spin:#?}");
    for (mode, I) in spin.modes.iter().zip([23.0, 19.0]) {
        close(mode.frequency, f64::sqrt(40.0 * 9.81 * 0.5 / I), 1e-12);
    }
    assert!(text(&found).contains("neither decays nor grows. The body rests."), "{}", text(&found));
    assert_eq!(found.state.unwrap().rate, 0.0);
}

#[test]
fn a_body_that_is_turned_over_is_said_to_be_unstable_first() {
    let over = pendulum() + &spinning([0.0; 3]) + "attitude = [0.0, 1.0, 0.0, 0.0]\n";
    let text = text(&modes(&study(&over)));
    let (_, told) = text.split_once(": ").unwrap();
    assert!(told.starts_with("The steady state under the forces is UNSTABLE"), "{told}");
}

#[test]
fn the_angular_velocity_asked_for_is_the_rate() {
    let rate = modes_at(&pendulum(), [0.0, 0.0, 0.3]).state.unwrap().rate;
    assert!((rate - 0.3).abs() < 1e-12, "{rate}");
}

#[test]
fn what_has_no_steady_state_is_told_in_words() {
    let eccentric = example("gravity-gradient");
    let circular = eccentric.replace("eccentricity = 0.072, ", "");
    let timed =
        MODEL.to_owned() + &expression("name = \"shaker\"\non = \"tip\"\nforce = [\"0\", \"0\", \"sin(t)\"]");
    let wheel =
        "[[wheel]]\nname = \"w\"\naxis = [0.0, 0.0, 1.0]\ninertia = 0.1\nspeed = { formula = \"10*t\" }\n";
    for (model, omega, message) in [
        (&eccentric, None, "is eccentric (0.072)"),
        (&circular, Some([0.0, 0.0, 1.0]), "sets the rate and the axis"),
        (&timed, None, "the force \"shaker\" changes with time"),
        (&(pendulum() + wheel), None, "a momentum wheel changes its speed"),
        (&(MODEL.to_owned() + wheel), None, "a momentum wheel changes its speed"),
    ] {
        let found =
            study(model).modes(SteadySpinSettings { omega, ..SteadySpinSettings::default() }).unwrap();
        assert!(!found.found() && text(&found).contains(message), "{}", text(&found));
    }
    let found = modes(&study(&circular));
    let names = names(&found.spins[0]);
    assert!(found.found() && names.contains(&"pitch") && names.contains(&"roll-yaw"), "{names:?}");
}

/// Uniform gravity does nothing to a free body: its modes are those without.
#[test]
fn a_free_body_that_falls_has_the_modes_of_one_that_does_not() {
    let falling = MODEL.to_owned() + &gravity([0.0, 0.0, -9.81]);
    assert_eq!(text(&modes(&study(MODEL))), text(&modes(&study(&falling))));
}

#[test]
fn check_tells_of_the_steady_state_in_a_sentence() {
    let study = study(&(pendulum() + &spinning([0.0, 0.0, 0.3])));
    let text = one_line(&study.check().unwrap().text());
    assert!(text.contains("Steady state under the forces No small motion"), "{text}");
}

/// A pendulum with a ball of liquid, `(J + 5 I i₂(κ)/κ i₁(κ)) s² + mgl = 0` with `κ² = a²s/ν` and modified spherical Bessel functions: roots
/// found by Newton's method elsewhere.
#[test]
fn a_pendulum_with_a_ball_of_liquid_swings_and_decays_as_its_closed_form() {
    for (viscosity, decay, frequency) in [
        ("1e-6", 0.004673209354067821, 10.023330122176924),
        ("1e-3", 0.0681782851932305, 9.886670776729476),
        ("0.1", 0.0014054615611081192, 9.82139232540962),
    ] {
        let tank = format!(
            "[[cavity]]\nname = \"tank\"\nshape = \"sphere\"\nradius = 0.05\ncenter = [0.0, 0.0, -0.05]\n\
             density = 1000.0\nkinematic_viscosity = {viscosity}\n"
        );
        let body = carrier(2.0, [0.006, 0.006, 0.01]).replace("[0, 0, 0]", "[0, 0, -0.05]");
        let found = modes(&study(&(body + &fixed([0.0; 3]) + &gravity([0.0, 0.0, -9.81]) + &tank)));
        let swing = mode(&found.spins[0].modes, "rotation");
        close(swing.decay_rate, decay, 1e-8);
        close(swing.frequency, frequency, 1e-10);
    }
}

/// Flat spin of an ellipsoid of revolution with a rheology of its material.
fn flat_spin(semi_axes: &str, rheology: &str) -> String {
    ellipsoid(semi_axes, [2000.0, 0.25], "shear = \"1 GPa\"", rheology) + &spinning([1e-5, 0.0, 3e-4])
}

/// The time of a wobble about flat spin at the angular velocity of the start, `−1/τω⁴K₄₄(1/C − 1/A)`: found elsewhere.
#[test]
fn a_prolate_body_in_flat_spin_decays_in_the_time_of_its_material() {
    let model = flat_spin("[200, 100, 100]", "kind = \"kelvin-voigt\", time = 5.0");
    let found = modes_at(&model, [0.0, 0.0, 3.001666e-4]);
    close(nutation(&found) / (1e6 * 365.25 * 86400.0), 461.6, 3e-4); // 4 digits known
    assert!(found.spins[0].stable && found.spins[0].modes[0].name == "nutation", "{found:#?}");
}

#[test]
fn a_nutation_without_a_rate_is_neutral_and_no_instability() {
    for (rheology, semi_axes) in [
        ("kind = \"quality-factor\", Q = 100", "[200, 100, 100]"),
        ("kind = \"maxwell\", time = 1000", "[200, 100, 100]"),
        ("kind = \"quality-factor\", Q = 100", "[200, 100.00000000001, 100]"),
    ] {
        let found = modes_about(&study(&flat_spin(semi_axes, rheology)), PrincipalAxis::Greatest);
        let nutation = &found.spins[0].modes[0];
        assert!(nutation.neutral && nutation.time_constant.is_none(), "{nutation:#?}");
        assert!(found.spins[0].stable, "{found:#?}");
        assert!(text(&found).contains("the wobble is neutral to rounding"), "{}", text(&found));
    }
}

/// Energy is least in the spin about the greatest inertia of a solid of springs and dashpots beside its stiffness at rest: it is stable, though not
/// every one of its relaxations is found.
#[test]
fn a_standard_linear_solid_about_its_greatest_inertia_is_stable() {
    for strength in ["0.2", "2.0"] {
        let rheology = format!("kind = \"standard-linear\", time = \"1 h\", strength = {strength}");
        let found = modes_about(&study(&flat_spin("[400, 300, 200]", &rheology)), PrincipalAxis::Greatest);
        assert!(found.spins[0].stable, "{}", text(&found));
        let least = modes_about(&study(&flat_spin("[400, 300, 200]", &rheology)), PrincipalAxis::Least);
        assert!(!least.spins[0].stable, "{}", text(&least));
    }
}

/// A force that acts later than the start is left out, by name and in the first line.
#[test]
fn forces_that_sleep_at_the_start_are_named() {
    let later = MODEL.to_owned() + &expression("name = \"burn\"\ntorque = [\"0.1*step(t-3)\", \"0\", \"0\"]");
    let found = modes(&study(&later));
    let told = one_line(&text(&found));
    assert!(
        told.starts_with("The force \"burn\" does not act at the start: this is the body without."),
        "{told}"
    );
    assert_eq!(found.json("")["sleeping_forces"], serde_json::json!(["burn"]));
    assert!(told.ends_with(&one_line(&text(&modes(&study(MODEL))))), "{told}");
}

#[test]
fn a_sphere_has_no_nutation() {
    let model = flat_spin("[100, 100, 100]", "kind = \"kelvin-voigt\", time = 5.0");
    let text = text(&modes_about(&study(&model), PrincipalAxis::Greatest));
    assert!(text.contains("there is no wobble"), "{text}");
}

/// A tip mass on each side of a hub.
fn tips(damping: f64) -> String {
    carrier(40.0, [9.0, 13.0, 16.0])
        + &point("tip 1", 5.0, [0.4, 1.0, 0.5], [500.0, damping])
        + &point("tip 2", 5.0, [-0.4, 1.0, -0.5], [500.0, damping])
        + &spinning(["-1.6 rpm", "11.88 rpm", "-0.48 rpm"])
}

#[test]
fn every_mode_has_a_name_of_its_own_and_rounding_is_zero() {
    let found = modes(&study(&tips(50.0)));
    for spin in &found.spins {
        let names = names(spin);
        assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{names:?}");
    }
    let [x, _, z] = found.spins[0].spin.unwrap();
    assert_eq!((x, z), (0.0, 0.0));
}

#[test]
fn about_the_middle_axis_it_is_the_nutation_that_grows() {
    let text = text(&modes_about(&study(&tips(50.0)), PrincipalAxis::Middle));
    assert!(text.contains("the spin is UNSTABLE: the nutation, which does not oscillate, GROWS"), "{text}");
}

#[test]
fn overdamped_motions_come_last_and_in_a_line() {
    let found = modes_about(&study(&tips(500.0)), PrincipalAxis::Least);
    let [text, all] = [false, true].map(|all| found.text("model", all));
    assert!(one_line(&text).contains("overdamped motions, of"), "{text}");
    assert!(!all.contains("overdamped") && all.lines().count() > text.lines().count(), "{all}");
    let overdamped: Vec<bool> = found.spins[0].modes.iter().map(|mode| mode.overdamped).collect();
    assert!(overdamped.contains(&true) && overdamped.is_sorted(), "{overdamped:?}");
}

/// A spinner with two pendulums of liquid, and a controller of a rate.
fn spinner(torque: &str) -> String {
    let slosh = |name: &str, side: f64| {
        let places = [[0.75 * side, 0.0, 0.3], [0.5 * side, 0.0, 0.3]];
        hinged(name, [40.0, 0.0], places, "[[0, 0, 1], [0, 1, 0]]", [1e-6, 0.1])
    };
    carrier(600.0, [300.0, 320.0, 420.0])
        + &slosh("left", 1.0)
        + &slosh("right", -1.0)
        + "[initial]\nangular_velocity = [0, 0, \"15 rpm\"]\n"
        + &expression(&format!("name = \"controller\"\ntorque = [\"{torque}\", \"0\", \"0\"]"))
}

/// Eigenvalues of an own Lagrangian, found elsewhere; the direction of the angular momentum in space is none of them.
#[test]
fn under_a_rate_controller_the_direction_in_space_is_no_mode() {
    let found = modes(&study(&spinner("-20*wx")));
    let modes = &found.spins[0].modes;
    let expected = [[0.0322, 0.5345], [0.0221, 2.3373], [0.0244, 2.4992], [0.0226, 2.8395], [0.0227, 2.8963]];
    assert_eq!(modes.len(), expected.len(), "{modes:#?}");
    for (mode, [decay, frequency]) in modes.iter().zip(expected) {
        let gaps = [mode.decay_rate - decay, mode.frequency - frequency];
        assert!(gaps.iter().all(|gap| gap.abs() < 6e-5), "{mode:#?}"); // 4 decimals known
    }
    let nutation = &modes[0];
    assert!(nutation.name == "nutation" && nutation.nutation, "{nutation:#?}");
    assert!(nutation.dissipation["force \"controller\""] > 0.5, "{nutation:#?}");
}

/// A law that knows the attitude about the spin alone: the direction of the spin in space is no mode, and the nutation keeps its name.
#[test]
fn under_a_controller_of_the_angle_of_spin_the_nutation_keeps_its_name() {
    for n in [0.001, 0.3] {
        let turned = format!("cos({h}*t)*qw+sin({h}*t)*qz)*(cos({h}*t)*qz-sin({h}*t)*qw", h = 0.5 * n);
        let law = format!("-1*2*({turned})-10*(wz-{n})");
        let model = |law: &str| {
            carrier(100.0, [30.0, 36.0, 10.0])
                + &point("p", 1.0, [0.0, 0.0, 1.0], [10.0, 0.1])
                + law
                + &spinning([0.0, 0.0, n])
        };
        let free = modes(&study(&model("")));
        let free = free
            .spins
            .iter()
            .flat_map(|spin| &spin.modes)
            .find(|mode| mode.nutation && mode.decay_rate <= 0.0);
        let law = expression(&format!("name = \"PD\"\ntorque = [\"0\", \"0\", \"{law}\"]"));
        let found = modes(&study(&model(&law)));
        let held = &found.spins[0].modes;
        assert_eq!(held.len(), 6, "{held:#?}");
        let nutation = mode(held, "nutation");
        assert!(nutation.nutation && held.iter().filter(|mode| mode.nutation).count() == 1);
        assert!((nutation.frequency / free.unwrap().frequency - 1.0).abs() < 1e-6, "{nutation:#?} {free:#?}");
        assert!(held.iter().all(|mode| (mode.frequency / n - 1.0).abs() > 1e-6), "{held:#?}");
        let growth = free.unwrap().decay_rate;
        match nutation.rate_bound {
            Some(bound) => {
                assert!(nutation.decay_rate == 0.0 && bound > growth.abs(), "{bound} {growth}");
                let said = text(&found);
                assert!(
                    said.contains("is seen to grow: that of nutation decays or grows, which rounding hides"),
                    "{said}"
                );
            }
            None => assert!((nutation.decay_rate / growth - 1.0).abs() < 1e-3, "{nutation:#?} {growth}"),
        }
        assert_eq!(nutation.rate_bound.is_some(), n < 0.01);
    }
}

#[test]
fn a_controller_that_gives_energy_has_a_share_below_zero() {
    let found = modes(&study(&spinner("1*wx")));
    assert!(found.spins[0].modes[0].dissipation["force \"controller\""] < 0.0, "{found:#?}");
}

/// A proportional-derivative law beside a pendulum whose damper is weak: the controller takes what the rotation loses.
#[test]
fn a_controller_of_attitude_has_its_share_of_the_dissipation() {
    let places = [[0.0, 0.0, 0.2], [0.0, 0.0, 0.6]];
    let thrust = "[[force]]\nname = \"LAE\"\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, -1.0]\nforce = [0, 0, 400.0]\n";
    let law = ["x", "y", "z"].map(|axis| format!("-60*2*qw*q{axis}-900*w{axis}"));
    let model = carrier(1500.0, [1800.0, 1500.0, 2000.0])
        + &hinged("slosh", [500.0, 0.0], places, "[[1, 0, 0], [0, 1, 0]]", [1e-6, 0.5])
        + thrust
        + &spinning([0.0; 3])
        + &expression(&format!("name = \"PD\"\ntorque = {law:?}"));
    let found = modes(&study(&model));
    let of_rotation = |mode: &&quasirigid_io::record::ModeRecord| mode.name.starts_with("rotation");
    let rotations: Vec<_> = found.spins[0].modes.iter().filter(of_rotation).collect();
    assert_eq!(rotations.len(), 6, "{found:#?}");
    for mode in rotations {
        assert!(mode.dissipation["force \"PD\""] > 0.99, "{mode:#?}");
    }
}

/// Panels with a viscoelastic core on hinges: their rotations in the plane have stiffness and loss and no mass.
fn array() -> String {
    let core = "[material.skin]\ndensity = 1600\nyoung = [\"130 GPa\", \"9 GPa\", \"9 GPa\"]\npoisson = [0.3, 0.3, 0.45]\n\
                shear = [\"5 GPa\", \"5 GPa\", \"3 GPa\"]\n[material.core]\ndensity = 50\nyoung = \"70 MPa\"\npoisson = 0.2\n\
                rheology = { kind = \"kelvin-voigt\", time = \"20 ms\" }\n";
    let panel = |name: &str, x: f64, angle: i32| {
        let skin = format!("{{ material = \"skin\", thickness = \"0.3 mm\", angle = \"{angle} deg\" }}");
        format!(
            "[[panel]]\nname = \"{name}\"\nrectangle = {{ sides = [[1.5, 0, 0], [0, 2, 0]], cells = [3, 4] }}\n\
             position = [{x}, -1.0, 0.0]\nlayers = [{skin}, {{ material = \"core\", thickness = \"15 mm\" }}, {skin}]\n"
        )
    };
    let line = |from: &str, to: &str, stiffness: f64| {
        format!(
            "[[connection]]\nfrom = {from}\nto = {{ part = \"{to}\", set = \"left\" }}\nhinge = [0, 1, 0]\n\
             stiffness = {stiffness}\ndamping = 4.0\n"
        )
    };
    carrier(300.0, [60.0, 80.0, 90.0])
        + core
        + &panel("inner", 0.6, 45)
        + &panel("outer", 2.1, -45)
        + &line("\"carrier\"", "inner", 800.0)
        + &line("{ part = \"inner\", set = \"right\" }", "outer", 500.0)
        + &spinning([0.002, 0.0, 0.05])
}

/// At order 5 the few coordinates hold motions without mass: `T2` was infinite, and no modes were found.
#[test]
fn motions_without_mass_leave_the_slow_ones_their_digits() {
    let [plain, fourth, fifth] = [3, 4, 5].map(|order| of_order(&array(), order));
    let validity = plain.check().unwrap().validity;
    for study in [&fourth, &fifth] {
        let found = study.check().unwrap().validity;
        close(found.T2, validity.T2, 1e-5);
        for mode in 0..6 {
            close(found.vibrations.decay_rates[mode], validity.vibrations.decay_rates[mode], 2e-3);
        }
        assert!(found.vibrations.decay_rates.iter().all(|rate| *rate > 0.0));
        assert!(found.vibrations.frequencies.iter().all(|frequency| *frequency < 1e8));
    }
    let constant =
        |study| modes_about(study, PrincipalAxis::Greatest).spins[0].modes[0].time_constant.unwrap();
    close(constant(&fifth), constant(&plain), 1e-3);
}

/// Floating beams with an isotropic spring between nodes apart, which resists a rotation of the whole.
const BEAMS: &str = r#"
material.al = { density = 2700, young = "70 GPa", poisson = 0.33 }
section.strap = { shape = "I", width = "20 mm", height = "30 mm", web = "2 mm", flange = "3 mm" }
section.c = { shape = "box", width = "20 mm", height = "30 mm", thickness = "2 mm" }
reduction.modes = 2
[[beam]]
name = "whip"
nodes = { root = [0, 0.4, 0], tip = [0, 1.4, 0], side = [0.5,1.4,0.2] }
lines = [["root", "tip"], ["tip","side"]]
section = "strap"
material = "al"
up = [0, 0, 1]
elements = 3
rayleigh = { mass = "0.01 1/s", stiffness = "0.3 ms" }
masses = [{ node = "tip", mass = 1.5, inertia = [0.1,0.1,0.1] }]
[[beam]]
name = "b2"
nodes = { root = [0, 0.4, 0], tip = [1, 0.4, 0.3] }
lines = [["root", "tip"]]
section = "c"
material = "al"
elements = 3
[[connection]]
from = { part = "whip", node = "root" }
to = { part = "b2", node = "root" }
hinge = [0, 0, 1]
stiffness = 40.0
damping = 1.0
[[spring]]
from = { part = "whip", node = "tip" }
to = { part = "b2", node = "tip" }
stiffness = 15.0
[[force]]
kind = "expression"
on = { part = "b2", node = "tip" }
force = ["-0.1*vx", "0", 0]
[initial]
angular_velocity = [0.3, 0.1, 1.0]
"#;

/// The two lowest modes are the same however many are kept.
#[test]
fn modes_of_floating_beams_with_a_spring_are_found() {
    let [two, many] = [2, 40].map(|kept| {
        let study = study(&BEAMS.replace("modes = 2", &format!("modes = {kept}")));
        study.check().unwrap().validity.vibrations.frequencies
    });
    for mode in 0..2 {
        close(two[mode], many[mode], 1e-6);
    }
}

/// An axis means nothing under forces, and has a name.
#[test]
fn an_axis_under_forces_is_refused() {
    for axis in PrincipalAxis::ALL {
        let asked = SteadySpinSettings { axis: Some(axis), ..SteadySpinSettings::default() };
        let refused = study(&pendulum()).modes(asked).unwrap_err().to_string();
        assert!(refused.contains("axis names a principal axis"), "{}: {refused}", axis.name());
    }
}

/// Sixty damped points on a carrier, spinning about an axis (rad/s).
fn many_points(omega: [f64; 3]) -> String {
    let part = |k: usize| {
        let (name, angle, stiffness) = (format!("p{k}"), 0.7 * k as f64, 150.0 + 13.0 * k as f64);
        let [x, y, z] = [1.2 * angle.cos(), 0.9 * angle.sin(), 0.3 * (2.0 * angle).sin()];
        format!(
            "[[point]]\nname = {name:?}\nmass = 0.2\nposition = [{x}, {y}, {z}]\n[[spring]]\nfrom = {name:?}\nto = \"carrier\"\n\
             stiffness = {stiffness}\ndamping = 0.3\n"
        )
    };
    let start = format!("[initial]\nangular_velocity = {omega:?}\n");
    carrier(40.0, [9.0, 13.0, 16.0]) + &(0..60).map(part).collect::<String>() + &start
}

#[test]
fn a_body_of_many_coordinates_says_which_modes_it_shows_and_what_of_the_others() {
    let about = |omega: [f64; 3]| modes_at(&many_points(omega), omega);
    let greatest = about([0.0, 0.0, 0.4]);
    let told = text(&greatest);
    assert!(told.contains("by a count; no other grows, since the energy is least in this spin."), "{told}");
    assert!(told.contains("and others, faster (--all finds every mode of up to 1500 coordinates)"), "{told}");
    let spin = &greatest.spins[0];
    assert!(spin.stable && spin.slowest.as_ref().is_some_and(|slow| slow.missing == Some(0)), "{spin:?}");
    let asked = SteadySpinSettings { omega: Some([0.0, 0.0, 0.4]), axis: None, all: true };
    let all = &study(&many_points([0.0, 0.0, 0.4])).modes(asked).unwrap().spins[0];
    assert!(all.stable && all.slowest.is_none() && all.modes.len() == 181, "{}", all.modes.len());
    let least = about([0.4, 0.0, 0.0]);
    assert!(text(&least).contains("the spin is UNSTABLE") && !least.spins[0].stable, "{}", text(&least));
    assert!(!text(&least).contains("no other grows"), "{}", text(&least));
}

/// The energy shows nothing of materials that lose by their quality factor; with dashpots it shows that nothing grows.
#[test]
fn an_evolution_says_where_it_is_not_known_whether_a_vibration_grows() {
    let dashpots = many_points([0.05, 0.02, 0.4]);
    let lossy = dashpots.replace("damping = 0.3", "rheology = { kind = \"quality-factor\", Q = 40 }");
    for (model, unknown) in [(dashpots, false), (lossy, true)] {
        let found = evolved(&study(&model), |_| {});
        assert!(found.holds(), "{}", found.record.message);
        assert_eq!(found.notes.join(" ").contains("is NOT KNOWN"), unknown, "{:?}", found.notes);
    }
}

/// A tuned damper on a Maxwell spring: from the modes with dashpots both iterations lead to the nutation. The damper's own mode is that of its mass
/// on the spring, `τs² + s + τk/m = 0`, but for the small share of the body in it.
#[test]
fn a_damper_beside_the_nutation_keeps_its_mode_when_its_spring_flows() {
    let (time, square): (f64, f64) = (0.4, 0.789 / 0.1);
    let model = example("nutation-damper")
        .replace("damping = 0.0562", &format!("rheology = {{ kind = \"maxwell\", time = {time} }}"));
    let found = study(&model)
        .modes(SteadySpinSettings { axis: Some(PrincipalAxis::Greatest), ..SteadySpinSettings::default() });
    let found = found.unwrap();
    let modes = &found.spins[0].modes;
    assert_eq!(modes.len(), 2);
    assert!(modes[0].nutation && modes[0].frequency < 2.83 && found.spins[0].stable);
    close(modes[1].decay_rate, 0.5 / time, 0.02);
    close(modes[1].frequency, (square - (0.5 / time).powi(2)).sqrt(), 0.02);
    assert!(!text(&found).contains("MISSING"));
    let torque = "[[force]]\nkind = \"expression\"\ntorque = [\"-1e-9*wx\", \"0\", \"0\"]\n";
    let forced = study(&(model + torque)).modes(SteadySpinSettings::default()).unwrap();
    let forced = &forced.spins[0].modes;
    for mode in modes {
        let other = forced.iter().find(|other| other.nutation == mode.nutation).unwrap();
        close(other.decay_rate, mode.decay_rate, 2e-2);
        close(other.frequency, mode.frequency, 2e-3);
    }
}

/// A law that knows the angle of spin and, through a spin that leans by 0.04 degrees, next to nothing of its direction: that motion is a precession,
/// and the two damped motions across the axis are the nutation, at the eigenvalues of an own matrix, whatever a part does that swings.
#[test]
fn beside_a_slow_precession_the_nutation_keeps_its_name() {
    let turned = "2*(qz*cos(0.02602245*t)-qw*sin(0.02602245*t))*(qw*cos(0.02602245*t)+qz*sin(0.02602245*t))";
    let law =
        format!("torque = [\"-5.58615*wx\", \"-12.5548*wy\", \"-13.0171*(wz-0.0520449)-7.0975*{turned}\"]");
    let model = "carrier = { mass = 200, center_of_mass = [0, 0, 0], inertia = [54.9866, 86.889, 95.7457] }\n\
        point = [{ name = \"p0\", mass = 5.67405, position = [1.43017, -1.0133, -0.00958604] }]\n\
        spring = [{ from = \"p0\", to = \"carrier\", stiffness = [46.2965, 67.1847, 40.4432], damping = [0.556299, 0.670146, 0.519945] }]\n";
    let found = modes(&study(&format!("{model}{}{}", expression(&law), spinning([0.0, 0.0, 0.0520449]))));
    let modes = &found.spins[0].modes;
    for (name, decay) in [("nutation", 0.0860763), ("nutation, second", 0.1362943)] {
        close(mode(modes, name).decay_rate, decay, 1e-3); // the matrix is of the rigid body
    }
    assert!(mode(modes, "nutation").nutation && modes.iter().filter(|mode| mode.nutation).count() == 1);
    let precession = mode(modes, "precession");
    assert!(
        (precession.frequency / 0.0520449 - 1.0).abs() < 1e-6 && precession.decay_rate < 0.0,
        "{precession:#?}"
    );
}

/// A free body has a steady spin in either sense: the one of the start is told.
#[test]
fn the_steady_spin_is_told_in_the_sense_of_the_start() {
    for sense in [1.0, -1.0] {
        let model = carrier(100.0, [21.8439, 21.8256, 32.3445])
            + &point("tip", 0.756315, [0.0, 0.0, 0.318721], [3.2, 0.05])
            + &spinning([0.0, 0.0, sense * 0.277734]);
        let found = modes_about(&study(&model), PrincipalAxis::Greatest);
        close(found.spins[0].spin.unwrap()[2], sense * 0.277734, 1e-9);
    }
}
