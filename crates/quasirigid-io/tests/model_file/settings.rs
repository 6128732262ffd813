//! Settings of a run: ranges of numbers, lists of systems and orders, conditions to stop, verification.
//! Each limit is tried on both sides; the tolerance has the limits of the command line.

use insta::assert_snapshot;
use quasirigid::dynamics::{Form, Method};
use quasirigid_io::model::{EvolveMethod, PartialVerify, Stop, System};

use super::{CARRIER, read, refusal_of};

#[test]
fn an_attitude_is_a_unit_quaternion() {
    assert_snapshot!(refusal_of("[initial]\nattitude = [1, 0, 0, 1]\n"), @r#"
    model.toml:10:12: `attitude` has the norm 1.4142135623730951, but an attitude is a unit quaternion
      write four numbers, scalar first, whose squares add up to 1
    "#);
    assert_snapshot!(refusal_of("[initial]\nattitude = [0, 0, 0, 0]\n"), @r#"
    model.toml:10:12: `attitude` has the norm 0, but an attitude is a unit quaternion
      write four numbers, scalar first, whose squares add up to 1
    "#);
    assert_snapshot!(refusal_of("[initial]\nattitude = [1, 0, 0]\n"), @r#"
    model.toml:10:12: `attitude`: found an array of 3 values, expected an array of 4 numbers
      write 4 numbers in brackets, with commas between them
    "#);
}

#[test]
fn settings_out_of_range_are_refused() {
    assert_snapshot!(refusal_of("[run]\norder = 13\nduration = 0\ntolerance = 0.5\nsamples = 1\nform = \"quick\"\n"), @r#"
    model.toml:10:9: `order` is 13, but must be an integer from 0 to 12
      write an integer from 0 to 12
    model.toml:11:12: `duration` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:12:13: `tolerance` is 5e-1, but must lie from 1e-15 to 1e-2
      write for example tolerance = 1e-9
    model.toml:13:11: `samples` is 1, but must be an integer from 2 to 10000000
      write an integer from 2 to 10000000
    model.toml:14:8: `form` cannot be "quick"
      write "angular-momentum" or "angular-velocity"
    "#);
    assert_snapshot!(refusal_of("[run]\norder = 3.0\ntolerance = 0.9e-15\nsamples = 10_000_001\n"), @"
    model.toml:10:9: `order`: found a decimal number, expected an integer from 0 to 12
      write an integer from 0 to 12
    model.toml:11:13: `tolerance` is 9e-16, but must lie from 1e-15 to 1e-2
      write for example tolerance = 1e-9
    model.toml:12:11: `samples` is 10000001, but must be an integer from 2 to 10000000
      write an integer from 2 to 10000000
    ");
    let run = read(&format!(
        "{CARRIER}[run]\norder = 12\ntolerance = 1.1e-15\nsamples = 10_000_000\nform = \"angular-velocity\"\n"
    ))
    .run;
    let histories = run.histories;
    assert_eq!(
        (run.order, histories.samples, histories.form),
        (12, Some(10_000_000), Some(Form::AngularVelocity))
    );
}

#[test]
fn the_tolerance_is_that_of_the_command_line() {
    let tolerance =
        |text: &str| read(&format!("{CARRIER}[run]\ntolerance = {text}\n")).run.histories.tolerance;
    assert_eq!([tolerance("1e-15"), tolerance("1e-2")], [Some(1e-15), Some(1e-2)]);
    assert_snapshot!(refusal_of("[run]\ntolerance = 0.9999e-15\n"), @"
    model.toml:10:13: `tolerance` is 9.999e-16, but must lie from 1e-15 to 1e-2
      write for example tolerance = 1e-9
    ");
    assert_snapshot!(refusal_of("[run]\ntolerance = 1.0001e-2\n"), @"
    model.toml:10:13: `tolerance` is 1.0001e-2, but must lie from 1e-15 to 1e-2
      write for example tolerance = 1e-9
    ");
}

#[test]
fn systems_and_methods_are_read() {
    let run = |lines: &str| read(&format!("{CARRIER}[run]\n{lines}\n")).run;
    let plain = run("");
    let integrator = plain.histories.integrator;
    assert_eq!((plain.systems, integrator, plain.stop, plain.verify), (None, None, Stop::default(), None));
    let all = run("systems = [\"full\", \"reduced\", \"rigid\"]").systems;
    assert_eq!(all, Some(vec![System::Full, System::Reduced, System::Rigid]));
    let integrators = ["automatic", "explicit", "implicit"]
        .map(|word| run(&format!("integrator = {word:?}")).histories.integrator);
    assert_eq!(integrators, [Some(Method::Automatic), Some(Method::Explicit), Some(Method::Implicit)]);
    assert_snapshot!(refusal_of("[run]\nsystems = [\"full\", \"ful\", \"full\", 3]\nintegrator = \"implict\"\n"), @r#"
    model.toml:10:20: `systems` cannot be "ful"
      did you mean "full"? write "full", "reduced", "rigid" or "spin-manifold"
    model.toml:10:27: `systems` has a duplicate entry
      leave it out
    model.toml:10:35: `systems`: found an integer, expected a text
      write the systems in quotes
    model.toml:11:14: `integrator` cannot be "implict"
      did you mean "implicit"? write "automatic", "explicit" or "implicit"
    "#);
    assert_snapshot!(refusal_of("[run]\nsystems = []\n"), @r#"
    model.toml:10:11: `systems`: found an array of 0 values, expected a list of systems
      write for example ["reduced", "rigid", "full"]
    "#);
    assert_snapshot!(refusal_of("[run]\nsystems = \"full\"\n"), @r#"
    model.toml:10:11: `systems`: found a text, expected a list of systems
      write for example ["reduced", "rigid", "full"]
    "#);
}

#[test]
fn conditions_to_stop_are_read() {
    let stop = |text: &str| read(&format!("{CARRIER}[run]\nstop = {text}\n")).run.stop;
    assert_eq!(stop("{}"), Stop { energy: None, nutation: None, validity: false });
    let all = stop("{ energy = \"12 J\", nutation = \"180 deg\", validity = true }");
    assert_eq!(all, Stop { energy: Some(12.0), nutation: Some(std::f64::consts::PI), validity: true });
    let text = "[run]\nstop = { energy = \"12 N\", nutation = \"181 deg\", validity = 1, momentum = 3 }\n";
    assert_snapshot!(refusal_of(text), @r#"
    model.toml:10:19: `energy`: "12 N" is a force, but an energy is needed
      write for example "12 kJ", or a plain number in J
    model.toml:10:38: `nutation` is 3.159045946109736 rad, but must be at most half a turn
      write for example nutation = "45 deg"
    model.toml:10:60: `validity`: found an integer, expected true or false
      write true or false, without quotes
    model.toml:10:63: unknown key "momentum" in `stop`
      the keys are energy, nutation, validity
    "#);
    assert_snapshot!(refusal_of("[run]\nstop = { energy = 0, nutation = -1 }\n"), @r#"
    model.toml:10:19: `energy` is 0 J, but must be positive
      write a number in J, or a text with its unit such as "12 kJ"
    model.toml:10:33: `nutation` is -1 rad, but must be positive
      write a number in rad, or a text with its unit such as "30 deg"
    "#);
    assert_snapshot!(refusal_of("[run]\nstop = true\n"), @"
    model.toml:10:8: `stop`: found true, expected a table
      write `stop` with its keys
    ");
}

#[test]
fn a_verification_is_read() {
    let verify = |text: &str| read(&format!("{CARRIER}[run]\nverify = {text}\n")).run.verify;
    assert_eq!(verify("{}"), Some(PartialVerify::default()));
    let all = verify("{ revolutions = 2.5, orders = [0, 12, 3], halvings = 10 }");
    let orders = Some(vec![0, 12, 3]);
    assert_eq!(all, Some(PartialVerify { revolutions: Some(2.5), orders, halvings: Some(10) }));
    let text = "[run]\nverify = { revolutions = 0, orders = [1, -1, 13, 1], halvings = 11, order = 2 }\n";
    assert_snapshot!(refusal_of(text), @r#"
    model.toml:10:26: `revolutions` is 0, but must be positive
      write a number
    model.toml:10:42: `orders` is -1, but must be an integer from 0 to 12
      write an integer from 0 to 12
    model.toml:10:46: `orders` is 13, but must be an integer from 0 to 12
      write an integer from 0 to 12
    model.toml:10:50: `orders` has a duplicate entry
      leave it out
    model.toml:10:65: `halvings` is 11, but must be an integer from 1 to 10
      write an integer from 1 to 10
    model.toml:10:69: unknown key "order" in `verify`
      did you mean `orders`? the keys are revolutions, orders, halvings
    "#);
    assert_snapshot!(refusal_of("[run]\nverify = { orders = [], halvings = 0 }\n"), @"
    model.toml:10:21: `orders`: found an array of 0 values, expected a list of orders
      write for example [1, 2, 3]
    model.toml:10:36: `halvings` is 0, but must be an integer from 1 to 10
      write an integer from 1 to 10
    ");
}

#[test]
fn former_names_are_taken_and_noted_with_those_of_today() {
    let former = "[run]\nform = \"paper\"\nmethod = \"implicit\"\nsystems = [\"full\", \"manifold\"]\n\
                  verify = { rotations = 2 }\nevolve = { method = \"direct\" }\nmanifold = { degree = 3 }\n";
    let today = "[run]\nform = \"angular-velocity\"\nintegrator = \"implicit\"\n\
                 systems = [\"full\", \"spin-manifold\"]\nverify = { revolutions = 2 }\n\
                 evolve = { method = \"full\" }\nspin_manifold = { degree = 3 }\n";
    let [former, today] = [former, today].map(|text| read(&format!("{CARRIER}{text}")));
    assert_eq!(former.run, today.run);
    assert_eq!(today.former_names, [""; 0]);
    assert_eq!(today.run.evolve.and_then(|evolve| evolve.method), Some(EvolveMethod::Full));
    let noted = |note: &str| {
        let last = "this version takes the former name for the last time";
        let note = format!("{note}; {last}");
        assert!(former.former_names.contains(&note), "{note}: {:#?}", former.former_names);
    };
    noted("line 6: form = \"paper\" is now called \"angular-velocity\"");
    noted("line 7: `method` in [run] is now called `integrator`");
    noted("line 8: systems = \"manifold\" is now called \"spin-manifold\"");
    noted("line 9: `rotations` in `verify` is now called `revolutions`");
    noted("line 10: method = \"direct\" is now called \"full\"");
    noted("line 11: `manifold` in [run] is now called `spin_manifold`");
    assert_eq!(former.former_names.len(), 6);
}

#[test]
fn former_name_beside_that_of_today_is_refused() {
    assert_snapshot!(refusal_of("[run]\nverify = { rotations = 2, revolutions = 3 }\n"), @"
    model.toml:10:12: `rotations` is the former name of `revolutions`, which is there too
      leave `rotations` out
    ");
}
