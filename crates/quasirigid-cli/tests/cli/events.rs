//! Forces in time, however short, and starts from rest: the angular momentum at the end against `∫ torque dt` in closed form.
//!
//! A torque about the axis `x` of [`AXIAL`], whose one point lies on `z`, turns it about that axis alone, also while the point moves: its
//! angular momentum is the impulse, in every system. (Z1) to (Z4), (F13), (F14)

use std::f64::consts::PI;
use std::fs;

use serde_json::Value;

use crate::support::{Ran, Table, folder_with, one_line, ran_in, ran_with};

const AXIAL: &str = "\
[carrier]
mass = 600.0
center_of_mass = [0, 0, 0]
inertia = [300, 320, 420]
[[point]]
name = \"d\"
mass = 1
position = [0, 0, 0.5]
[[spring]]
from = \"d\"
to = \"carrier\"
stiffness = 400
damping = 2
[initial]
angular_velocity = [0, 0, 0]
displacements = \"rest\"
";
const SYSTEMS: [&str; 3] = ["full", "reduced", "rigid"];

fn with_torque(formula: &str) -> String {
    format!("{AXIAL}[[force]]\nkind = \"expression\"\ntorque = [\"{formula}\", \"0\", \"0\"]\n")
}

#[track_caller]
fn finished(ran: &Ran) -> Value {
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let object = ran.json();
    assert_eq!(object["status"], "finished");
    object
}

fn vector(object: &Value, key: &str) -> [f64; 3] {
    std::array::from_fn(|i| object[key][i].as_f64().unwrap())
}

/// The angular momentum at the end is this impulse about `x`, in every system.
#[track_caller]
fn assert_impulse(model: &str, files: &[(&str, &str)], duration: f64, expected: f64) {
    let folder = folder_with(model);
    files.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
    for system in SYSTEMS {
        let line = format!("simulate model.toml --system {system} --duration {duration} --samples 3 --json");
        let object = finished(&ran_in(folder.path(), &line));
        let [x, y, z] = vector(&object, "momentum");
        assert!((x / expected - 1.0).abs() < 1e-9, "{system}: {x} for {expected}, {model}");
        assert!(y.hypot(z) < 1e-9 * expected.abs(), "{system}: {y} {z}");
        if system == "rigid" {
            let J = 300.0 + 0.25 * 600.0 / 601.0;
            let rate = vector(&object, "omega")[0];
            assert!((rate * J / expected - 1.0).abs() < 1e-9, "{rate}");
        }
    }
}

/// Pulses from 1e-6 of the run to all of it, of every shape, from rest.
#[test]
fn pulses_of_formulas_are_not_stepped_over() {
    let root = PI.sqrt();
    for (formula, duration, impulse) in [
        ("15*(max(0,min(1,(t-1000)*1e4))-max(0,min(1,(t-1000.1)*1e4)))", 2000.0, 1.5),
        ("0.1*exp(-((t-500)/0.05)^2)", 1000.0, 0.1 * 0.05 * root),
        ("exp(-((t-500)/0.001)^2)", 1000.0, 0.001 * root),
        ("exp(-((t-500)/0.01)^2)", 1000.0, 0.01 * root),
        ("0.001*0.5*(tanh((t-500)*20)-tanh((t-510)*20))", 1000.0, 0.01),
        ("step(t-700)-step(t-700.001)", 1000.0, 1e-3),
        ("2*step(t-999.999)", 1000.0, 2e-3),
        ("min(max(t-3,0), max(5-t,0))", 1e5, 1.0),
        ("max(0, 1-abs(t-400)/0.001)", 1000.0, 1e-3),
        ("3e-4", 1000.0, 0.3),
    ] {
        assert_impulse(&with_torque(formula), &[], duration, impulse);
    }
}

/// Angular velocity about `z` at the end, from 0.5 rad/s, under a torque by a formula of the motion, in every system and by both integrators.
#[track_caller]
fn assert_spin(formula: &str, duration: f64, expected: f64, error: f64) {
    let spinning = AXIAL.replace("angular_velocity = [0, 0, 0]", "angular_velocity = [0, 0, 0.5]");
    let force = format!("[[force]]\nkind = \"expression\"\ntorque = [\"0\", \"0\", \"{formula}\"]\n");
    let folder = folder_with(&format!("{spinning}{force}"));
    for system in [
        "full --integrator explicit",
        "full --integrator implicit",
        "reduced",
        "rigid",
        "rigid --tolerance 1e-9",
    ] {
        let line = format!("simulate model.toml --system {system} --duration {duration} --samples 2 --json");
        let rate = vector(&finished(&ran_in(folder.path(), &line)), "omega")[2];
        assert!((rate - expected).abs() < error, "{system}: {rate} for {expected}, {formula}");
    }
}

/// Torques that act where the motion is in a short part of its range, at times that nobody knows before: a jump at `wz = 0.6` that is passed in
/// 2 ms, a Gaussian of the time at which `t - 10 wz` is 50 s, and one of the attitude. (Z5)
#[test]
fn pulses_that_depend_on_the_motion_are_not_stepped_over() {
    let J = 420.0;
    let jump = 0.6001 + 0.001 * (200.0 - 99.9 - 2e-3);
    assert_spin("0.42 + 41.58*step(1e-4 - abs(wz - 0.6))", 200.0, jump, 1e-8);

    // With s = t - 50 - 10 wz and g = exp(-(s/0.01)²): dwz/ds = 0.02 g/(1 - 0.2 g).
    let slope = |s: f64| {
        let g = (-(s / 0.01).powi(2)).exp();
        0.02 * g / (1.0 - 0.2 * g)
    };
    let kick: f64 = (-800..800).map(|i| 1e-4 * slope(1e-4 * f64::from(i))).sum();
    assert_spin("8.4*exp(-((t - 50 - 10*wz)/0.01)^2)", 200.0, 0.5 + kick, 1e-6 * kick);

    // Where qz = sin(θ/2) is a half its rate is 0.5 wz cos(π/6).
    let kick = 84.0 * 1e-5 * PI.sqrt() / (0.25 * (PI / 6.0).cos()) / J;
    assert_spin("84*exp(-((qz - 0.5)/1e-5)^2)", 3.0, 0.5 + kick, 1e-4 * kick);
}

/// A force that acts in a tenth of a millimetre of the way gives `m v²/2 = F σ √π` beside what was there. (Z5)
#[test]
fn a_force_in_a_narrow_place_is_not_stepped_over() {
    let moving = AXIAL.replace("angular_velocity", "velocity = [0.2, 0, 0]\nangular_velocity");
    let at = 0.5 / 601.0;
    let force = format!("[[force]]\nkind = \"expression\"\non = \"carrier\"\nat = [0, 0, {at}]\n");
    let model = format!("{moving}{force}force = [\"1000*exp(-((x - 3)/1e-4)^2)\", \"0\", \"0\"]\n");
    let object =
        finished(&ran_with(&model, "simulate model.toml --system rigid --duration 60 --samples 2 --json"));
    let expected = (0.04 + 2.0 * 1000.0 * 1e-4 * PI.sqrt() / 601.0).sqrt();
    let speed = vector(&object, "velocity")[0];
    assert!((speed / expected - 1.0).abs() < 1e-9, "{speed} for {expected}");
}

/// Two hundred peaks of a sine above a level: `∫(sin θ − c) dθ = 2 cos θ₀ − c(π − 2θ₀)`, `sin θ₀ = c`.
#[test]
fn trains_are_followed_pulse_by_pulse() {
    let level = 0.999_f64;
    let start = level.asin();
    let each = (2.0 * start.cos() - level * (PI - 2.0 * start)) / (0.4 * PI);
    assert_impulse(&with_torque("max(0, sin(0.4*pi*t)-0.999)"), &[], 1000.0, 200.0 * each);
}

/// Spin up and stop: what is left is zero, beside the 1.5 N m s that came and went.
#[test]
fn opposite_pulses_leave_the_body_at_rest() {
    let model = with_torque("15*(step(t-1000)-step(t-1000.1)-step(t-2000)+step(t-2000.1))");
    for system in SYSTEMS {
        let ran = ran_with(&model, &format!("simulate model.toml --system {system} --duration 3000 --json"));
        let object = finished(&ran);
        let [x, y, z] = vector(&object, "momentum");
        assert!(x.abs().max(y.abs()).max(z.abs()) < 1e-9, "{system}: {x} {y} {z}");
        assert_eq!(object["scan"]["breakpoints"], 4);
    }
}

#[test]
fn windows_are_exact() {
    let force = |torque: f64, windows: &str| {
        format!("{AXIAL}[[force]]\nkind = \"torque\"\ntorque = [{torque}, 0, 0]\nduring = [{windows}]\n")
    };
    assert_impulse(&force(15.0, "[\"1000 s\", \"1000.1 s\"], [1500, 1500.1]"), &[], 2000.0, 3.0);
    assert_impulse(&force(15.0, "[999.999, 1000]"), &[], 1000.0, 0.015);
    assert_impulse(&force(0.2, "[-5, 1.5], [999, 2000]"), &[], 1000.0, 0.2 * 2.5);
    let many: Vec<String> = (0..200).map(|i| format!("[{0}, {0}.002]", 5 * i + 1)).collect();
    assert_impulse(&force(3.0, &many.join(", ")), &[], 1000.0, 200.0 * 3.0 * 0.002);
    let varying = format!(
        "{AXIAL}[[force]]\nkind = \"expression\"\ntorque = [\"t\", \"0\", \"0\"]\nduring = [[500, 500.01]]\n"
    );
    assert_impulse(&varying, &[], 1000.0, 500.005 * 0.01);
}

#[test]
fn timetables_are_exact() {
    let model =
        |more: &str| format!("{AXIAL}[[force]]\nkind = \"expression\"\ntimetable = \"burns.csv\"\n{more}");
    let table = "t,x,y,z\n10,2,0,0\n10.001,0,0,0\n700,-1,0,0\n700.5,0.5,0,0\n701,0,0,0\n";
    let held = 2.0 * 0.001 - 1.0 * 0.5 + 0.5 * 0.5;
    assert_impulse(&model(""), &[("burns.csv", table)], 1000.0, held);
    let linear = 0.5 * 2.0 * 0.001 - 0.5 * (700.0 - 10.001) - 0.25 * 0.5 + 0.25 * 0.5;
    assert_impulse(&model("interpolation = \"linear\"\n"), &[("burns.csv", table)], 1000.0, linear);
    let windowed = 2.0 * 0.0005 - 1.0 * 0.25;
    let during = "during = [[10, 10.0005], [700, 700.25]]\n";
    assert_impulse(&model(during), &[("burns.csv", table)], 1000.0, windowed);
}

/// A burn through the centre of mass: `F Δt/m`.
#[test]
fn a_short_thrust_moves_the_centre_of_mass() {
    let model = format!(
        "{AXIAL}[[force]]\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, 0]\nforce = [0, 0, 7]\nduring = [[300, 300.02]]\n"
    );
    for system in SYSTEMS {
        let ran = ran_with(&model, &format!("simulate model.toml --system {system} --duration 600 --json"));
        let [x, y, z] = vector(&finished(&ran), "velocity");
        let expected = 7.0 * 0.02 / 601.0;
        assert!((z / expected - 1.0).abs() < 1e-9 && x.hypot(y) < 1e-9 * expected, "{system}: {x} {y} {z}");
    }
}

/// A pulse on a spinning body: the full history does not depend on where rows and steps lie.
#[test]
fn a_pulse_on_a_spinning_body_is_seen_by_both_integrators() {
    let model =
        with_torque("15*(step(t-1000)-step(t-1000.1))").replace("[0, 0, 0]\ndisp", "[0, 0, 7.292e-5]\ndisp");
    let end = |integrator: &str| {
        let line =
            format!("simulate model.toml --system full --integrator {integrator} --duration 1100 --json");
        vector(&finished(&ran_with(&model, &line)), "momentum")
    };
    let [explicit, implicit] = ["explicit", "implicit"].map(end);
    for (a, b) in explicit.iter().zip(implicit) {
        assert!((a - b).abs() < 1e-8 * 1.5, "{explicit:?} {implicit:?}");
    }
    assert!((explicit[0] / 1.5 - 1.0).abs() < 1e-3, "{explicit:?}");
}

#[test]
fn a_formula_that_cannot_be_followed_ends_the_run() {
    let ran =
        ran_with(&with_torque("sin(1e12*t)"), "simulate model.toml --system rigid --duration 1000 --json");
    assert_eq!((ran.code, &ran.json()["status"]), (Some(1), &Value::from("missed-force")), "{}", ran.stderr);
    assert!(
        one_line(&ran.stderr).contains("changes too often after t = 0 s to be followed"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    for system in SYSTEMS {
        let ran = ran_with(AXIAL, &format!("simulate model.toml --system {system} --duration 1000 --json"));
        let object = finished(&ran);
        assert_eq!((vector(&object, "omega"), vector(&object, "momentum")), ([0.0; 3], [0.0; 3]), "{system}");
        assert_eq!(object["energy_drift"], 0.0);
    }
    let ran = ran_with(AXIAL, "simulate model.toml --system full");
    assert!(ran.refusal().contains("starts from rest") && ran.refusal().contains("--duration"), "{ran:?}");
}

/// Parts that move in a body without angular velocity: energy goes from the spring to the dashpot, the angular momentum does not change.
#[test]
fn parts_that_move_at_rest_are_followed() {
    let model = AXIAL.replace("displacements = \"rest\"", "displacements = { d = [0.01, 0.02, 0.005] }");
    let object = finished(&ran_with(&model, "simulate model.toml --system full --duration 60 --json"));
    let start = 0.5 * 400.0 * (0.01_f64.powi(2) + 0.02_f64.powi(2) + 0.005_f64.powi(2));
    let [left, taken] = ["energy", "dissipated"].map(|key| object[key].as_f64().unwrap());
    assert!(((left + taken) / start - 1.0).abs() < 1e-9 && left < 1e-9 * start, "{left} {taken} {start}");
    let K = vector(&object, "momentum");
    assert!(K.iter().all(|part| part.abs() < 1e-9), "{K:?}");
}

/// Modes about rest: the point against the carrier, `ω² = k(1/m + 1/M + r²/I)` across `z` and `k(1/m + 1/M)` along it, light damping
/// `c/k` times half of that; the three angles and their rates are neutral. With a pulse that does not act at the start, too.
#[test]
fn rest_has_modes() {
    let pulse = with_torque("15*(max(0,min(1,(t-1000)*1e4))-max(0,min(1,(t-1000.1)*1e4)))");
    for model in [AXIAL, &pulse] {
        let ran = ran_with(model, "modes model.toml --json");
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let object = ran.json();
        assert_eq!(
            (&object["spin"], &object["stable"]),
            (&serde_json::json!([0.0, 0.0, 0.0]), &Value::Bool(true))
        );
        assert_eq!(object["steady_state"]["neutral"], 6);
        let mut expected =
            [0.0, 0.25 / 320.0, 0.25 / 300.0].map(|turned| 400.0 * (1.0 + 1.0 / 600.0 + turned));
        expected.sort_by(f64::total_cmp);
        let modes = object["modes"].as_array().unwrap();
        assert_eq!(modes.len(), 3, "{object:#}");
        for (mode, square) in modes.iter().zip(expected) {
            let decay = 0.5 * 2.0 / 400.0 * square;
            let frequency = (square - decay * decay).sqrt();
            let [found, rate] = ["frequency", "decay_rate"].map(|key| mode[key].as_f64().unwrap());
            assert!((found / frequency - 1.0).abs() < 1e-9, "{found} {frequency}");
            assert!((rate / decay - 1.0).abs() < 1e-9, "{rate} {decay}");
        }
    }
    let told = one_line(&ran_with(&pulse, "modes model.toml").stdout);
    assert!(told.contains("state of rest without \"force 1\", which does not act at the start"), "{told}");
}

#[test]
fn a_run_starts_from_rest() {
    let model = with_torque("15*(step(t-1000)-step(t-1000.1))");
    let folder = folder_with(&model);
    let ran = ran_in(folder.path(), "run model.toml --duration 2000 -o out --json");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let record = ran.json();
    for history in record["histories"].as_array().unwrap() {
        assert_eq!(history["status"], "finished");
        // energy K²/2J of the rigid body about x, and of the reduced one to the small stretch
        let energy = history["work"].as_f64().unwrap();
        let expected = 1.5 * 1.5 / 2.0 / (300.0 + 0.25 * 600.0 / 601.0);
        assert!((energy / expected - 1.0).abs() < 1e-4, "{energy} {expected}");
    }
    let notes = record["notes"].to_string();
    assert!(notes.contains("starts from rest"), "{notes}");
    let still = folder_with(AXIAL);
    let ran = ran_in(still.path(), "run model.toml --duration 100 -o out --quiet");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
}

/// Systems without a place for forces say so, and do not leave them out.
#[test]
fn equations_about_a_spin_take_no_pulses() {
    let model = with_torque("step(t-5)").replace("[0, 0, 0]\ndisp", "[0, 0, 0.2]\ndisp");
    let ran = ran_with(&model, "simulate model.toml --system spin-manifold --duration 10");
    assert!(ran.refusal().contains("force 1"), "{ran:?}");
    let evolve = ran_with(&model, "evolve model.toml --method average");
    assert_ne!(evolve.code, Some(0), "{evolve:?}");
}

/// A wheel and a liquid that the spin does not slave turn with the body at the start, also where `displacements` are given: the energy is that
/// of the frozen body, `½ ω·Jω`, and not that of a series without meaning there.
#[test]
fn what_the_spin_does_not_slave_turns_with_a_displaced_body() {
    let wheel = "[carrier]\nmass = 30.0\ncenter_of_mass = [0, 0, 0]\ninertia = [12, 14, 18]\n[[rotor]]\nname = \"wheel\"\n\
                 axis = [1, 0, 0]\ninertia = 1.0\nfriction = 0.1\n[initial]\nangular_velocity = [0.2, 0.2, 0.4]\n";
    let energy = 0.5 * (12.0 * 0.04 + 14.0 * 0.04 + 18.0 * 0.16);
    let momentum = (12.0_f64 * 0.2).hypot(14.0 * 0.2).hypot(18.0 * 0.4);
    for displacements in ["\"rest\"", "\"slow-manifold\""] {
        let model = format!("{wheel}displacements = {displacements}\n");
        let ran = ran_with(&model, "simulate model.toml --system full --times 0,1");
        let table = Table::of(&ran.stdout);
        let [found, K] = ["energy", "momentum"].map(|name| table.column(name)[0]);
        assert!((found / energy - 1.0).abs() < 1e-9 && (K / momentum - 1.0).abs() < 1e-9, "{found} {K}");
    }
}

/// Carrier with a damped tip, whose slowest vibration has about 10 rad/s and dies out within seconds, in slow rotation.
const TIP: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [9.0, 13.0, 16.0]
[[point]]
name = \"tip\"
mass = 2.0
position = [0.9, 0.2, 0.4]
[[spring]]
from = \"tip\"
to = \"carrier\"
stiffness = 200.0
damping = 8.0
[initial]
angular_velocity = [0.02, 0.0, 0.1]
";

/// What the dashpots take under forces faster than the vibrations is not in the reduced equations: they say so, and by how much at most. (E5)
#[test]
fn energy_that_fast_forces_leave_in_vibrations_is_told() {
    let gaussian = |width: f64| format!("torque = [\"0\", \"0\", \"2 * exp(-((t - 12) / {width})^2)\"]\n");
    let window = |length: f64| format!("torque = [\"0\", \"2\", \"0\"]\nduring = [[7, {}]]\n", 7.0 + length);
    let wave = |rate: f64| format!("torque = [\"sin({rate} * t)\", \"0\", \"0\"]\n");
    let rise = |width: f64| format!("torque = [\"0\", \"0.2 * tanh((t - 12) / {width})\", \"0\"]\n");
    let light = TIP.replace("damping = 8.0", "damping = 0.05");
    for force in
        [gaussian(0.01), gaussian(0.1), window(0.01), window(0.3), window(10.0), wave(8.0), wave(15.0)]
    {
        assert_told(TIP, &force, true);
    }
    for force in [gaussian(3.0), wave(0.2), "torque = [\"0\", \"0\", \"0.5\"]\n".to_owned()] {
        assert_told(TIP, &force, false);
    }
    // a light damping takes what a rise leaves in vibrations long after it
    for (width, is_fast) in [(0.1, true), (0.3, true), (3.0, false)] {
        assert_told(&light, &rise(width), is_fast);
    }
}

/// The reduced system under a force says whether its dissipated energy may not hold, and is off by no more than it says.
#[track_caller]
fn assert_told(body: &str, force: &str, is_fast: bool) {
    let model = format!("{body}[[force]]\nkind = \"expression\"\n{force}");
    let ran = |system: &str| {
        let line = format!("simulate model.toml --system {system} --duration 60 --samples 3 --json");
        let ran = ran_with(&model, &line);
        (finished(&ran), one_line(&ran.stderr))
    };
    let ((full, _), (reduced, notes)) = (ran("full"), ran("reduced"));
    let [exact, found] = [&full, &reduced].map(|object| object["dissipated"].as_f64().unwrap());
    let left_out = reduced["left_out"].as_f64().unwrap();
    println!("{force}{exact:.4e} {found:.4e} {left_out:.4e} {notes}");
    assert!((exact - found).abs() < 1.5 * left_out + 2e-3 * exact, "{force}: {exact} {found} {left_out}");
    assert_eq!(notes.contains("THE DISSIPATED ENERGY MAY NOT HOLD"), is_fast, "{force}: {notes}");
}
