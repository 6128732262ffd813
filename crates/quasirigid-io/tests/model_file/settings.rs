use insta::assert_snapshot;
use quasirigid_io::model::Form;

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
    model.toml:10:9: `order` is 13, but must be an integer from 1 to 12
      write an integer from 1 to 12
    model.toml:11:12: `duration` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:12:13: `tolerance` is 5e-1, but must lie between 1e-15 and 1e-2
      write for example tolerance = 1e-9
    model.toml:13:11: `samples` is 1, but must be an integer from 2 to 10000000
      write an integer from 2 to 10000000
    model.toml:14:8: `form` cannot be "quick"
      write "momentum" or "paper"
    "#);
    assert_snapshot!(refusal_of("[run]\norder = 3.0\ntolerance = 1e-15\nsamples = 10_000_001\n"), @r#"
    model.toml:10:9: `order`: found a decimal number, expected an integer from 1 to 12
      write an integer from 1 to 12
    model.toml:11:13: `tolerance` is 1e-15, but must lie between 1e-15 and 1e-2
      write for example tolerance = 1e-9
    model.toml:12:11: `samples` is 10000001, but must be an integer from 2 to 10000000
      write an integer from 2 to 10000000
    "#);
    let run = read(&format!(
        "{CARRIER}[run]\norder = 12\ntolerance = 1.1e-15\nsamples = 10_000_000\nform = \"paper\"\n"
    ))
    .run;
    assert_eq!((run.order, run.samples, run.form), (12, Some(10_000_000), Some(Form::Paper)));
}
