//! Initial rotation: angular velocity, periods, or wobble.

use insta::assert_snapshot;
use quasirigid::model::Mode;
use quasirigid_io::model::Rotation;

use super::{CARRIER, read, refusal_of};

fn rotation(lines: &str) -> Option<Rotation> {
    read(&format!("{CARRIER}[initial]\n{lines}\n")).initial.rotation
}

/// Refusal of these lines of `[initial]`, which start in line 10.
fn refused(lines: &str) -> String {
    refusal_of(&format!("[initial]\n{lines}\n"))
}

#[test]
fn a_rotation_is_read_in_each_of_its_forms() {
    assert_eq!(rotation(""), None);
    assert_eq!(rotation("angular_velocity = [1, 2, 3]"), Some(Rotation::Spin([1.0, 2.0, 3.0])));
    let periods = "periods = { rotation = \"263 h\", precession = \"27.38 h\", mode = \"short-axis\" }";
    let expected = Rotation::Periods { rotation: 946_800.0, precession: 98_568.0, mode: Mode::ShortAxis };
    assert_eq!(rotation(periods), Some(expected));
    let wobble = "wobble = { angle = 0.1, rate = \"15 rad/s\", mode = \"long-axis\" }";
    assert_eq!(rotation(wobble), Some(Rotation::Wobble { angle: 0.1, rate: 15.0, mode: Mode::LongAxis }));
}

#[test]
fn a_rotation_is_given_once() {
    let periods = "periods = { rotation = 2, precession = 1, mode = \"short-axis\" }";
    let wobble = "wobble = { angle = 0.1, rate = 1, mode = \"short-axis\" }";
    assert_snapshot!(refused(&format!("{periods}\nangular_velocity = [0, 0, 1]")), @"
    model.toml:11:20: `periods` and `angular_velocity` both give the rotation
      leave out all but one
    ");
    assert_snapshot!(refused(&format!("angular_velocity = [0, 0]\n{wobble}")), @"
    model.toml:10:20: `angular_velocity`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:11:10: `angular_velocity` and `wobble` both give the rotation
      leave out all but one
    ");
    assert_snapshot!(refused(&format!("{periods}\n{wobble}\nangular_velocity = [0, 0, 1]")), @"
    model.toml:12:20: `periods` and `angular_velocity` both give the rotation
      leave out all but one
    ");
}

#[test]
fn impossible_periods_are_refused() {
    assert_snapshot!(refused("periods = { rotation = 0, precession = -1, mode = \"short\" }"), @r#"
    model.toml:10:24: `rotation` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:10:40: `precession` is -1 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:10:51: `mode` cannot be "short"
      write "short-axis", "long-axis", "SAM" or "LAM"
    "#);
    assert_snapshot!(refused("periods = { rotation = nan, precession = \"27 deg\", mode = 3 }"), @r#"
    model.toml:10:24: `rotation` is nan, which is not a finite number
      write a number in s, or a text with its unit such as "2 h"
    model.toml:10:42: `precession`: "27 deg" is an angle, but a time is needed
      write for example "2 h", or a plain number in s
    model.toml:10:59: `mode`: found an integer, expected a text
      write the mode in quotes
    "#);
    assert_snapshot!(refused("periods = { rotatoin = 1, preccesion = 2 }"), @r#"
    model.toml:10:11: `periods` has no `mode`
      add a line such as: mode = "short-axis", or mode = "long-axis"
    model.toml:10:13: unknown key "rotatoin" in `periods`
      did you mean `rotation`? the keys are rotation, precession, mode
    model.toml:10:27: unknown key "preccesion" in `periods`
      did you mean `precession`? the keys are rotation, precession, mode
    "#);
    assert_snapshot!(refused("periods = {}"), @r#"
    model.toml:10:11: `periods` has no `rotation`
      add a line such as: rotation = "263 h"
    model.toml:10:11: `periods` has no `precession`
      add a line such as: precession = "27.38 h"
    model.toml:10:11: `periods` has no `mode`
      add a line such as: mode = "short-axis", or mode = "long-axis"
    "#);
    assert_snapshot!(refused("periods = [\"263 h\", \"27.38 h\"]"), @"
    model.toml:10:11: `periods`: found an array of 2 values, expected a table
      write `periods` with its keys
    ");
    assert_snapshot!(refused("period = 3"), @r#"
    model.toml:10:1: unknown key "period" in [initial]
      did you mean `periods`? the keys are angular_velocity, periods, wobble, attitude, from, at, displacements, displacement_rates, position, velocity
    "#);
}

#[test]
fn impossible_wobbles_are_refused() {
    assert_snapshot!(refused("wobble = { angle = \"90 deg\", rate = 0, mode = \"long_axis\" }"), @r#"
    model.toml:10:20: `angle` is 1.5707963267948966 rad, but must be between 0 and 90 deg
      write a number in rad, or a text with its unit such as "30 deg"
    model.toml:10:37: `rate` is 0 rad/s, but must be positive
      write a number in rad/s, or a text with its unit such as "750 rpm"
    model.toml:10:47: `mode` cannot be "long_axis"
      did you mean "long-axis"? write "short-axis", "long-axis", "SAM" or "LAM"
    "#);
    assert_snapshot!(refused("wobble = { angle = 0, rate = \"1 Hz\", axis = 3 }"), @r#"
    model.toml:10:10: `wobble` has no `mode`
      add a line such as: mode = "short-axis", or mode = "long-axis"
    model.toml:10:20: `angle` is 0 rad, but must be between 0 and 90 deg
      write a number in rad, or a text with its unit such as "30 deg"
    model.toml:10:30: `rate`: "1 Hz" may mean revolutions or radians per second
      write rev/s or rad/s
    model.toml:10:38: unknown key "axis" in `wobble`
      the keys are angle, rate, mode
    "#);
    assert_snapshot!(refused("wobble = { angle = -0.1, rate = -1, mode = \"short-axis\" }"), @r#"
    model.toml:10:20: `angle` is -0.1 rad, but must be between 0 and 90 deg
      write a number in rad, or a text with its unit such as "30 deg"
    model.toml:10:33: `rate` is -1 rad/s, but must be positive
      write a number in rad/s, or a text with its unit such as "750 rpm"
    "#);
    assert_snapshot!(refused("wobble = { angle = nan, rate = inf, mode = \"\" }"), @r#"
    model.toml:10:20: `angle` is nan, which is not a finite number
      write a number in rad, or a text with its unit such as "30 deg"
    model.toml:10:32: `rate` is inf, which is not a finite number
      write a number in rad/s, or a text with its unit such as "750 rpm"
    model.toml:10:44: `mode` is empty
      write the mode in quotes
    "#);
    assert_snapshot!(refused("wobble = \"5 deg\""), @"
    model.toml:10:10: `wobble`: found a text, expected a table
      write `wobble` with its keys
    ");
    // both sides of the line
    let right = rotation("wobble = { angle = \"89.999999999999 deg\", rate = 1, mode = \"short-axis\" }");
    assert!(matches!(right, Some(Rotation::Wobble { angle, .. }) if angle > 1.57));
}
