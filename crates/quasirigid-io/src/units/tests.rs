//! Tests of units: defined values, wrong dimensions, ambiguous and damaged texts, and random ones.
//! Factors come from the definitions or from NIST SP 811, not from the table under test; messages are fixed by snapshots.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::{Dimension, UnitError, quantity};

/// Text of a refusal: message, then advice.
fn refusal(text: &str, dimension: Dimension) -> String {
    let error = quantity(text, dimension).expect_err(text);
    format!("{error}; {}", error.advice())
}

#[test]
fn units_have_their_defined_values() {
    let cases = [
        ("22 in", Dimension::LENGTH, 0.5588),
        ("3 ft", Dimension::LENGTH, 0.9144),
        ("1 mi", Dimension::LENGTH, 1609.344),
        ("3 um", Dimension::LENGTH, 3e-6),
        ("3 µm", Dimension::LENGTH, 3e-6), // the micro sign
        ("3 μm", Dimension::LENGTH, 3e-6), // the Greek letter
        ("2 AU", Dimension::LENGTH, 299_195_741_400.0),
        ("12 lb", Dimension::MASS, 12.0 * 0.453_592_37),
        ("8 oz", Dimension::MASS, 0.5 * 0.453_592_37),
        ("1 slug", Dimension::MASS, 14.593_902_937_206_364), // NIST SP 811, Appendix B.8
        ("2.5 t", Dimension::MASS, 2500.0),
        ("2 h", Dimension::TIME, 7200.0),
        ("27.38 h", Dimension::TIME, 98_568.0),
        ("3 d", Dimension::TIME, 259_200.0),
        ("2 yr", Dimension::TIME, 2.0 * 365.25 * 86400.0),
        ("5 kyr", Dimension::TIME, 5e3 * 365.25 * 86400.0),
        ("10 Gyr", Dimension::TIME, 10e9 * 365.25 * 86400.0),
        ("10 Myr", Dimension::TIME, 10e6 * 365.25 * 86400.0),
        ("750 rpm", Dimension::ANGULAR_VELOCITY, 750.0 * TAU / 60.0),
        ("2 rev/s", Dimension::ANGULAR_VELOCITY, 2.0 * TAU),
        ("15 deg/h", Dimension::ANGULAR_VELOCITY, 15.0 * PI / 180.0 / 3600.0),
        ("-3°/s", Dimension::ANGULAR_VELOCITY, -3.0 * PI / 180.0),
        ("1 arcsec/s", Dimension::ANGULAR_VELOCITY, PI / 648_000.0),
        ("3 1/s", Dimension::ANGULAR_VELOCITY, 3.0),
        ("3 s^-1", Dimension::ANGULAR_VELOCITY, 3.0),
        ("3 s⁻¹", Dimension::ANGULAR_VELOCITY, 3.0),
        ("1 lb ft^2", Dimension::INERTIA, 0.453_592_37 * 0.3048 * 0.3048),
        ("1e-3 kg m^2", Dimension::INERTIA, 1e-3),
        ("1e-3 kg·m²", Dimension::INERTIA, 1e-3),
        ("7 g cm**2", Dimension::INERTIA, 7e-7),
        ("12.5 lbf/in", Dimension::STIFFNESS, 12.5 * 175.126_835_246_476_3), // NIST SP 811, Appendix B.8
        ("2 kN/mm", Dimension::STIFFNESS, 2e6),
        ("4 N s/m", Dimension::DAMPING, 4.0),
        ("4 N/(m/s)", Dimension::DAMPING, 4.0),
        ("0.565 N m/rad", Dimension::ROTATIONAL_STIFFNESS, 0.565),
        ("0.565 N m", Dimension::ROTATIONAL_STIFFNESS, 0.565),
        ("1 N m/deg", Dimension::ROTATIONAL_STIFFNESS, 180.0 / PI),
        ("5lbf ft", Dimension::ROTATIONAL_STIFFNESS, 5.0 * 1.355_817_948_331_400_4), // NIST SP 811
        ("3 N*m*s/rad", Dimension::ROTATIONAL_DAMPING, 3.0),
        ("3 N m/(rad/s)", Dimension::ROTATIONAL_DAMPING, 3.0),
        ("51.6 deg", Dimension::ANGLE, 51.6 * PI / 180.0),
        ("3 km/s", Dimension::VELOCITY, 3000.0),
        ("9.81 m/s^2", Dimension::ACCELERATION, 9.81),
        ("5 mN", Dimension::FORCE, 5e-3),
        ("0.05 N m", Dimension::TORQUE, 0.05),
        ("12 J", Dimension::ENERGY, 12.0),
        ("2.5 g/cm^3", Dimension::DENSITY, 2500.0),
        ("0.1 lb/in^3", Dimension::DENSITY, 0.1 * 27_679.904_710_203_12), // NIST SP 811, Appendix B.8, to 7 digits
        ("70 GPa", Dimension::PRESSURE, 7e10),
        ("10 ksi", Dimension::PRESSURE, 10.0 * 6_894_757.293_168_361), // NIST SP 811, Appendix B.8
        ("398600.4418 km^3/s^2", Dimension::GRAVITATIONAL_PARAMETER, 3.986_004_418e14),
        ("200 mA m^2", Dimension::MAGNETIC_MOMENT, 0.2),
        ("31000 nT", Dimension::MAGNETIC_FIELD, 3.1e-5),
        ("5 N/(A m)", Dimension::MAGNETIC_FIELD, 5.0),
        ("7.8e15 T m^3", Dimension::DIPOLE_STRENGTH, 7.8e15),
        ("7.8 TT km^3/1", Dimension::DIPOLE_STRENGTH, 7.8e21),
        ("15 MS/m", Dimension::CONDUCTIVITY, 1.5e7),
        ("5.662 kS m^4", Dimension::MAGNETIC_TENSOR, 5662.0),
        ("2 Hz", Dimension::FREQUENCY, 2.0 * TAU),
        ("1 mHz", Dimension::FREQUENCY, 1e-3 * TAU),
        ("1 rad Hz", Dimension::FREQUENCY, 1.0),
        ("1 rev Hz", Dimension::FREQUENCY, TAU),
        ("3 rad/s", Dimension::FREQUENCY, 3.0),
        ("3 1/s", Dimension::FREQUENCY, 3.0),
        ("60 rpm", Dimension::FREQUENCY, TAU),
    ];
    for (text, dimension, expected) in cases {
        let value = quantity(text, dimension).unwrap_or_else(|error| panic!("{text}: {error}"));
        // a handful of multiplications and divisions, each rounded
        assert!((value - expected).abs() <= 1e-15 * expected.abs(), "{text}: {value:e} is not {expected:e}");
    }
}

#[test]
fn units_of_other_fields_are_known() {
    for (text, described) in [
        ("2 g/cm^3", "a density"),
        ("2 psi", "a pressure"),
        ("2 GPa", "a pressure"),
        ("2 J", "a torque or an energy"),
        ("2 W", "a quantity in kg m^2 s^-3"),
        ("2 cSt", "a kinematic viscosity"),
        ("2 cP", "a dynamic viscosity"),
        ("2 rev", "an angle"),
        ("2 Hz", "a quantity in s^-1"),
        ("2 mA", "a quantity in A"),
        ("2 m/in", "a plain number"),
    ] {
        let Err(UnitError::WrongDimension { found, .. }) = quantity(text, Dimension::MASS) else {
            panic!("{text} is not a mass");
        };
        assert_eq!(found, described, "{text}");
    }
}

#[test]
fn another_dimension_is_refused() {
    insta::assert_snapshot!(refusal("12 kg", Dimension::LENGTH), @r#""12 kg" is a mass, but a length is needed; write for example "22 in", or a plain number in m"#);
    insta::assert_snapshot!(refusal("12.5 lb/in", Dimension::STIFFNESS), @r#""12.5 lb/in" is a quantity in kg m^-1, but a stiffness is needed; lb is the mass, lbf the force; write for example "12.5 lbf/in", or a plain number in N/m"#);
    insta::assert_snapshot!(refusal("3 deg", Dimension::NUMBER), @r#""3 deg" is an angle, but a plain number is needed; write a number without quotes"#);
    insta::assert_snapshot!(refusal("3 N m rad", Dimension::ROTATIONAL_STIFFNESS), @r#""3 N m rad" is a quantity in kg m^2 s^-2 rad, but a rotational stiffness is needed; write for example "0.565 N m/rad", or a plain number in N m/rad"#);
    insta::assert_snapshot!(refusal("3 kg m^2/rad", Dimension::INERTIA), @r#""3 kg m^2/rad" is a quantity in kg m^2 rad^-1, but a moment of inertia is needed; write for example "3.2 lb ft^2", or a plain number in kg m^2"#);
}

#[test]
fn hertz_is_refused_only_for_an_angular_velocity() {
    insta::assert_snapshot!(refusal("3 Hz", Dimension::ANGULAR_VELOCITY), @r#""3 Hz" may mean revolutions or radians per second; write rev/s or rad/s"#);
    assert!(quantity("3 rad Hz", Dimension::ANGULAR_VELOCITY).is_err());
    assert!(quantity("3 Hz rad", Dimension::ANGULAR_VELOCITY).is_err());
    insta::assert_snapshot!(refusal("3 kHz", Dimension::ANGULAR_VELOCITY), @r#""3 kHz" may mean revolutions or radians per second; write rev/s or rad/s"#);
    assert_eq!(quantity("3 kg Hz", Dimension::DAMPING), Ok(3.0));
}

#[test]
fn what_is_not_a_quantity_is_refused() {
    insta::assert_snapshot!(refusal("", Dimension::MASS), @r#"an empty text, where a mass is needed; write for example "12 lb", or a plain number in kg"#);
    insta::assert_snapshot!(refusal("heavy", Dimension::MASS), @r#""heavy" is not a decimal number with a unit; write for example "12 lb", or a plain number in kg"#);
    insta::assert_snapshot!(refusal("1,5 kg", Dimension::MASS), @r#""1,5 kg" is not a decimal number with a unit; write for example "12 lb", or a plain number in kg"#);
    insta::assert_snapshot!(refusal("NaN kg", Dimension::MASS), @r#""NaN kg" is not a finite number; write a finite number"#);
    insta::assert_snapshot!(refusal("-inf kg", Dimension::MASS), @r#""-inf kg" is not a finite number; write a finite number"#);
    insta::assert_snapshot!(refusal("1e999 kg", Dimension::MASS), @r#""1e999 kg" is too large or too small to compute with; check the exponent"#);
    insta::assert_snapshot!(refusal("1e-323 g", Dimension::MASS), @r#""1e-323 g" is too large or too small to compute with; check the exponent"#);
    insta::assert_snapshot!(refusal("40", Dimension::MASS), @r#""40" is a text without a unit; add the unit, or write 40 without the quotes for 40 kg"#);
    insta::assert_snapshot!(refusal("0.5", Dimension::NUMBER), @r#""0.5" is a text without a unit; write 0.5 without the quotes"#);
}

#[test]
fn what_is_not_a_unit_is_refused() {
    insta::assert_snapshot!(refusal("3 kq", Dimension::MASS), @r#"there is no unit "kq"; did you mean "kg"?"#);
    insta::assert_snapshot!(refusal("3 inches", Dimension::LENGTH), @r#"there is no unit "inches"; did you mean "in"?"#);
    insta::assert_snapshot!(refusal("3 degrees/s", Dimension::ANGULAR_VELOCITY), @r#"there is no unit "degrees"; did you mean "deg"?"#);
    insta::assert_snapshot!(refusal("3 furlong", Dimension::LENGTH), @r#"there is no unit "furlong"; units are symbols, for example kg, lb, m, in, s, h, rad, deg, rpm, N, lbf"#);
    insta::assert_snapshot!(refusal("3 N/m s", Dimension::DAMPING), @r#"in the unit "N/m s" it is not clear what is divided by what; write the quotient last or use parentheses: "N s/m" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("3 N/", Dimension::STIFFNESS), @r#"the unit "N/" cannot be read: it ends too early; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("3 N/(m s", Dimension::STIFFNESS), @r#"the unit "N/(m s" cannot be read: it ends too early; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("3 000 kg", Dimension::MASS), @r#"the unit "000 kg" cannot be read: '0' is not allowed there; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("3 kg m^", Dimension::INERTIA), @r#"the unit "kg m^" cannot be read: it ends too early; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("3 kg m^2.5", Dimension::INERTIA), @r#"the power 2.5 in a unit is not an integer from -9 to 9; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
}

#[test]
fn monstrous_units_are_refused() {
    insta::assert_snapshot!(refusal("1 m^1000000000", Dimension::LENGTH), @r#"the power 1000000000 in a unit is not an integer from -9 to 9; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal("1 m^99999999999999999999", Dimension::LENGTH), @r#"the power 99999999999999999999 in a unit is not an integer from -9 to 9; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal(&format!("1 {}", "(".repeat(150)), Dimension::LENGTH), @r#"the parentheses of the unit are nested too deeply; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    insta::assert_snapshot!(refusal(&"m ".repeat(1_000_000), Dimension::LENGTH), @r#"a text of 2000000 bytes is too long for a number with a unit; write for example "N m/rad", "kg*m^2" or "N/(m s)""#);
    let tower = format!("1 {}km{}", "(".repeat(8), "^9)".repeat(8));
    insta::assert_snapshot!(refusal(&tower, Dimension::LENGTH), @r#""1 ((((((((km^9)^9)^9)^9)^9)^9)^9)^9)" is a quantity in m^43046721, but a length is needed; write for example "22 in", or a plain number in m"#);
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

    #[test]
    fn no_text_makes_it_panic(text in "\\PC*") {
        let _ = quantity(&text, Dimension::MASS);
    }

    #[test]
    fn no_unit_makes_it_panic(text in "-?[0-9.]{0,3}(e-?[0-9]{1,4})? ?([kmM]?(g|m|s|rad|lbf|Hz|N|yr)|[ */^()·²⁻0-9-]){0,12}") {
        let _ = quantity(&text, Dimension::ROTATIONAL_STIFFNESS);
    }

    /// Decimal units lose nothing: an integer with a unit is the same number as its digits shifted to SI. A decimal
    /// number was rounded once before its unit is applied, so it may be off by the last bit.
    #[test]
    fn decimal_units_equal_the_si_number(digits in -99_999i64..=99_999, exponent in -30..30) {
        let si = |shift: i32| format!("{digits}e{shift}").parse::<f64>().expect("a decimal number");
        for (unit, dimension, shift) in [
            ("kg", Dimension::MASS, 0),
            ("g", Dimension::MASS, -3),
            ("t", Dimension::MASS, 3),
            ("mm", Dimension::LENGTH, -3),
            ("um", Dimension::LENGTH, -6),
            ("N/mm", Dimension::STIFFNESS, 3),
            ("g cm^2", Dimension::INERTIA, -7),
            ("kN·m/rad", Dimension::ROTATIONAL_STIFFNESS, 3),
            ("rad/s", Dimension::ANGULAR_VELOCITY, 0),
        ] {
            prop_assert_eq!(quantity(&format!("{digits} {unit}"), dimension), Ok(si(shift)), "{}", unit);
            let value = quantity(&format!("{digits}e{exponent} {unit}"), dimension).expect("a quantity");
            let expected = si(exponent + shift);
            prop_assert!((value - expected).abs() <= f64::EPSILON * expected.abs(), "{value:e} {expected:e} {unit}");
        }
    }
}
