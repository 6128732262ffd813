//! Values of the wrong kind, not finite, not positive, or with the wrong unit; columns counted in characters.
//! Messages name what was found and what was expected; a plain number is always in SI units, so a bare text number is refused.

use insta::assert_snapshot;

use super::{CARRIER, POINT, carrier, read, refusal, refusal_of, refusal_of_spring};

#[test]
fn a_value_of_another_kind_is_refused() {
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "[40.0]")), @r#"
    model.toml:2:8: `mass`: found an array of 1 value, expected a mass
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "\"0.1 m\"")), @r#"
    model.toml:3:18: `center_of_mass`: found a text, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "[0, 0.1]")), @r#"
    model.toml:3:18: `center_of_mass`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("[0, 0.1, 0]", "[0, true, 1979-05-27]")), @r#"
    model.toml:3:22: `center_of_mass`: found true, expected a length
      write a number in m, or a text with its unit such as "22 in"
    model.toml:3:28: `center_of_mass`: found a date or time, expected a length
      write a number in m, or a text with its unit such as "22 in"
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("[9.0, 13.0, 16.0]", "[9.0, [13.0], 16.0]")), @r#"
    model.toml:4:12: `inertia`: found a decimal number, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:4:17: `inertia`: found an array of 1 value, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:4:25: `inertia`: found a decimal number, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("[9.0, 13.0, 16.0]", "[9.0, 13.0]")), @r#"
    model.toml:4:11: `inertia`: found an array of 2 values, expected 3 principal values or a 3x3 matrix
      write [Jx, Jy, Jz] in kg m^2, or three rows of a symmetric matrix
    "#);
    assert_snapshot!(refusal(&POINT.replace("\"tip\"", "7")), @"
    model.toml:1:1: the file has no [carrier] and no part that is elastic throughout
      add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]
    model.toml:2:8: `name`: found an integer, expected a text
      write the name in quotes
    ");
    assert_snapshot!(refusal(&POINT.replace("\"tip\"", "\"\"")), @"
    model.toml:1:1: the file has no [carrier] and no part that is elastic throughout
      add [carrier] with mass, center_of_mass and inertia: the rigid body that carries everything else; or a body that is elastic throughout: [[ellipsoid]], [[surface]], [[beam]], [[panel]], [[solid]]
    model.toml:2:8: `name` is empty
      write the name in quotes
    ");
    assert_snapshot!(refusal_of_spring("stiffness = 600\naxial = \"yes\"\n"), @r#"
    model.toml:13:9: `axial`: found a text, expected true or false
      write true or false, without quotes
    "#);
    assert_snapshot!(refusal_of("[body]\nname = { first = 1 }\n"), @r#"
    model.toml:10:8: `name`: found a table, expected a text
      write the name in quotes
    "#);
}

#[test]
fn a_number_that_is_not_finite_is_refused() {
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "nan")), @r#"
    model.toml:2:8: `mass` is nan, which is not a finite number
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "-inf")), @r#"
    model.toml:2:8: `mass` is -inf, which is not a finite number
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "1e999")), @r#"
    model.toml:2:8: `mass` is 1e999, which is not a finite number
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "\"inf kg\"")), @r#"
    model.toml:2:8: `mass`: "inf kg" is not a finite number
      write a finite number
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("40.0", &format!("0x{}", "f".repeat(40)))), @r#"
    model.toml:2:8: `mass` is 0xffffffffffffffffffffffffffffffffffffffff, which is not a finite number
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_eq!(carrier(&read(&CARRIER.replace("40.0", &"9".repeat(60))).assembly).mass, 1e60);
    assert_snapshot!(refusal(&CARRIER.replace("0.1", "nan")), @r#"
    model.toml:3:22: `center_of_mass` is nan, which is not a finite number
      write a number in m, or a text with its unit such as "22 in"
    "#);
}

#[test]
fn a_mass_that_is_not_positive_is_refused() {
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "0")), @r#"
    model.toml:2:8: `mass` is 0 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
    assert_snapshot!(refusal_of("[[point]]\nmass = \"-2 lb\"\nposition = [0, 0, 1]\n"), @r#"
    model.toml:10:8: `mass` is -0.90718474 kg, but must be positive
      write a number in kg, or a text with its unit such as "12 lb"
    "#);
}

#[test]
fn a_wrong_unit_is_refused() {
    assert_snapshot!(refusal(&CARRIER.replace("40.0", "\"40 in\"")), @r#"
    model.toml:2:8: `mass`: "40 in" is a length, but a mass is needed
      write for example "12 lb", or a plain number in kg
    "#);
    assert_snapshot!(refusal(&CARRIER.replace("0.1", "\"0.1 metres\"")), @r#"
    model.toml:3:22: `center_of_mass`: there is no unit "metres"
      did you mean "m"?
    "#);
    assert_snapshot!(refusal_of_spring("stiffness = \"12.5 lb/in\"\n"), @r#"
    model.toml:12:13: `stiffness`: "12.5 lb/in" is a quantity in kg m^-1, but a stiffness is needed
      lb is the mass, lbf the force; write for example "12.5 lbf/in", or a plain number in N/m
    "#);
    assert_snapshot!(refusal_of("[initial]\nangular_velocity = [\"3 Hz\", 0, \"12\"]\n"), @r#"
    model.toml:10:21: `angular_velocity`: "3 Hz" may mean revolutions or radians per second
      write rev/s or rad/s
    model.toml:10:32: `angular_velocity`: "12" is a text without a unit
      add the unit, or write 12 without the quotes for 12 rad/s
    "#);
    assert_snapshot!(refusal_of("[run]\nduration = \"2 days ago\"\n"), @r#"
    model.toml:10:12: `duration`: there is no unit "days"
      did you mean "d"?
    "#);
}

#[test]
fn columns_are_counted_in_characters() {
    assert_snapshot!(refusal("carrier = { \"größe\" = 1, mass = \"ω kg\" }\n"), @r#"
    model.toml:1:11: [carrier] has no `center_of_mass`
      add a line such as: center_of_mass = [0.0, 0.0, 0.0]
    model.toml:1:11: [carrier] has no `inertia`
      add a line such as: inertia = [9.0, 13.0, 16.0]
    model.toml:1:13: unknown key "größe" in [carrier]
      the keys are mass, center_of_mass, inertia
    model.toml:1:33: `mass`: "ω kg" is not a decimal number with a unit
      write for example "12 lb", or a plain number in kg
    "#);
}
