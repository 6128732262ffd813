//! Settings of a run: ranges of numbers, lists of systems and orders, conditions to stop, verification.
//! Each limit is tried on both sides; the tolerance has the limits of the command line.

use insta::assert_snapshot;
use quasirigid::dynamics::{Form, Method};
use quasirigid_io::model::{Stop, System, Verify};

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
      write "momentum" or "paper"
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
        "{CARRIER}[run]\norder = 12\ntolerance = 1.1e-15\nsamples = 10_000_000\nform = \"paper\"\n"
    ))
    .run;
    assert_eq!((run.order, run.samples, run.form), (12, Some(10_000_000), Some(Form::AngularVelocity)));
}

#[test]
fn the_tolerance_is_that_of_the_command_line() {
    let tolerance = |text: &str| read(&format!("{CARRIER}[run]\ntolerance = {text}\n")).run.tolerance;
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
    assert_eq!((plain.systems, plain.method, plain.stop, plain.verify), (None, None, Stop::default(), None));
    let all = run("systems = [\"full\", \"reduced\", \"rigid\"]").systems;
    assert_eq!(all, Some(vec![System::Full, System::Reduced, System::Rigid]));
    let methods = ["automatic", "explicit", "implicit"].map(|word| run(&format!("method = {word:?}")).method);
    assert_eq!(methods, [Some(Method::Automatic), Some(Method::Explicit), Some(Method::Implicit)]);
    assert_snapshot!(refusal_of("[run]\nsystems = [\"full\", \"ful\", \"full\", 3]\nmethod = \"implict\"\n"), @r#"
    model.toml:10:20: `systems` cannot be "ful"
      did you mean "full"? write "full", "reduced", "rigid" or "manifold"
    model.toml:10:27: `systems` has a duplicate entry
      leave it out
    model.toml:10:35: `systems`: found an integer, expected a text
      write the systems in quotes
    model.toml:11:10: `method` cannot be "implict"
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
    assert_eq!(verify("{}"), Some(Verify { rotations: None, orders: None, halvings: None }));
    let all = verify("{ rotations = 2.5, orders = [1, 12, 3], halvings = 10 }");
    assert_eq!(all, Some(Verify { rotations: Some(2.5), orders: Some(vec![1, 12, 3]), halvings: Some(10) }));
    let text = "[run]\nverify = { rotations = 0, orders = [1, 0, 13, 1], halvings = 11, order = 2 }\n";
    assert_snapshot!(refusal_of(text), @r#"
    model.toml:10:24: `rotations` is 0, but must be positive
      write a number
    model.toml:10:40: `orders` is 0, but must be an integer from 1 to 12
      write an integer from 1 to 12
    model.toml:10:43: `orders` is 13, but must be an integer from 1 to 12
      write an integer from 1 to 12
    model.toml:10:47: `orders` has a duplicate entry
      leave it out
    model.toml:10:62: `halvings` is 11, but must be an integer from 1 to 10
      write an integer from 1 to 10
    model.toml:10:66: unknown key "order" in `verify`
      did you mean `orders`? the keys are rotations, orders, halvings
    "#);
    assert_snapshot!(refusal_of("[run]\nverify = { orders = [], halvings = 0 }\n"), @"
    model.toml:10:21: `orders`: found an array of 0 values, expected a list of orders
      write for example [1, 2, 3]
    model.toml:10:36: `halvings` is 0, but must be an integer from 1 to 10
      write an integer from 1 to 10
    ");
}
