//! Settings of the secular evolution: target, duration, method.

use insta::assert_snapshot;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use quasirigid_io::model::{EvolveMethod, PartialEvolve, Power, Target};

use super::{CARRIER, read, refusal_of};

fn evolve(text: &str) -> Option<PartialEvolve> {
    read(&format!("{CARRIER}[run]\nevolve = {text}\n")).run.evolve
}

/// Refusal of an `evolve`, which is in line 10, from column 10.
fn refused(text: &str) -> String {
    refusal_of(&format!("[run]\nevolve = {text}\n"))
}

/// Refusal of a text on the command line: message, then advice.
fn refused_alone(text: &str) -> String {
    let error = text.parse::<Target>().expect_err(text);
    format!("{error}; {}", error.advice())
}

#[test]
fn an_evolution_is_read() {
    assert_eq!(read(CARRIER).run.evolve, None);
    assert_eq!(evolve("{}"), Some(PartialEvolve::default()));
    let all = evolve(
        "{ start = \"20 deg\", until = \"98% of I3\", duration = \"10 Gyr\", samples = 201, power = \"harmonics\", method = \"micro-runs\" }",
    );
    let expected = PartialEvolve {
        start: Some(Target::Wobble(20f64.to_radians())),
        until: Some(Target::Ratio(0.98)),
        duration: Some(31_557_600e10),
        samples: Some(201),
        power: Some(Power::Harmonics),
        method: Some(EvolveMethod::MicroRuns),
    };
    assert_eq!(all, Some(expected));
}

#[test]
fn a_target_is_read_in_each_of_its_forms() {
    let until = |text: &str| evolve(&format!("{{ until = {text} }}")).and_then(|evolve| evolve.until);
    assert_eq!(until("0.98"), Some(Target::Ratio(0.98)));
    assert_eq!(until("\"0.1\""), Some(Target::Ratio(0.1)));
    assert_eq!(until("\"5 deg\""), Some(Target::Wobble(5f64.to_radians())));
    for text in ["98% of I3", "98 % of I3", " 98%of  I3 ", "9.8e1\t%  of I3", "0.98", " +98e-2 "] {
        assert_eq!(text.parse(), Ok(Target::Ratio(0.98)), "{text}");
    }
    assert_eq!("300 arcmin".parse(), Ok(Target::Wobble(5f64.to_radians())));
    assert_eq!("0.1 rad".parse(), Ok(Target::Wobble(0.1)));
}

#[test]
fn what_is_not_a_target_is_refused() {
    assert_snapshot!(refused("{ until = 1.2 }"), @r#"
    model.toml:10:20: `until`: the ratio D/I3 is 1.2, but must be between 0 and 1
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = 1 }"), @r#"
    model.toml:10:20: `until`: the ratio D/I3 is 1, but must be between 0 and 1
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = 0 }"), @r#"
    model.toml:10:20: `until`: the ratio D/I3 is 0, but must be between 0 and 1
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = nan }"), @"
    model.toml:10:20: `until` is nan, which is not a finite number
      write a number
    ");
    assert_snapshot!(refused("{ until = [0.98] }"), @r#"
    model.toml:10:20: `until`: found an array of 1 value, expected a part of I3 or an angle
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = \"90 deg\" }"), @r#"
    model.toml:10:20: `until`: the angle is 1.5707963267948966 rad, but must be between 0 and 90 deg
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = \"0 deg\" }"), @r#"
    model.toml:10:20: `until`: the angle is 0 rad, but must be between 0 and 90 deg
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = \"98%\" }"), @r#"
    model.toml:10:20: `until`: "98%" is neither a part of I3 nor an angle
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused("{ until = \"100% of I3\" }"), @r#"
    model.toml:10:20: `until`: the ratio D/I3 is 1, but must be between 0 and 1
      write for example "98% of I3", 0.98 or "5 deg"
    "#);
    assert_snapshot!(refused_alone("98% of I2"), @r#""98% of I2" is neither a part of I3 nor an angle; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("most% of I3"), @r#""most% of I3" is neither a part of I3 nor an angle; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("-5% of I3"), @r#"the ratio D/I3 is -0.05, but must be between 0 and 1; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone(""), @r#""" is neither a part of I3 nor an angle; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("nan"), @r#"the ratio D/I3 is NaN, but must be between 0 and 1; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("soon"), @r#""soon" is neither a part of I3 nor an angle; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("5 degrees"), @r#"there is no unit "degrees"; did you mean "deg"?"#);
    assert_snapshot!(refused_alone("5 Myr"), @r#""5 Myr" is a time, but an angle is needed; write for example "98% of I3", 0.98 or "5 deg""#);
    assert_snapshot!(refused_alone("-5 deg"), @r#"the angle is -0.08726646259971647 rad, but must be between 0 and 90 deg; write for example "98% of I3", 0.98 or "5 deg""#);
}

#[test]
fn an_evolution_of_another_form_is_refused() {
    assert_snapshot!(refused("{ til = 0.9, duration = -1, samples = 1 }"), @r#"
    model.toml:10:12: unknown key "til" in `evolve`
      did you mean `until`? the keys are start, until, duration, samples, power, method
    model.toml:10:34: `duration` is -1 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:10:48: `samples` is 1, but must be an integer from 2 to 10000000
      write an integer from 2 to 10000000
    "#);
    assert_snapshot!(refused("{ untl = 0.9, duration = nan, samples = \"many\" }"), @r#"
    model.toml:10:12: unknown key "untl" in `evolve`
      did you mean `until`? the keys are start, until, duration, samples, power, method
    model.toml:10:35: `duration` is nan, which is not a finite number
      write a number in s, or a text with its unit such as "2 h"
    model.toml:10:50: `samples`: found a text, expected an integer from 2 to 10000000
      write an integer from 2 to 10000000
    "#);
    assert_snapshot!(refused("true"), @"
    model.toml:10:10: `evolve`: found true, expected a table
      write `evolve` with its keys
    ");
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

    #[test]
    fn no_text_makes_it_panic(text in "\\PC*|[ 0-9.e%-]{0,6}(%| of|I3| deg|°| ){0,4}") {
        let _ = text.parse::<Target>();
    }

    /// Every text that is read gives a rotation state.
    #[test]
    fn what_is_read_is_a_state(text in "-?[0-9]{0,3}(\\.[0-9]{0,3})?(e-?[0-9])? ?(% of I3| deg| rad|)") {
        match text.parse() {
            Ok(Target::Ratio(ratio)) => prop_assert!(ratio > 0.0 && ratio < 1.0),
            Ok(Target::Wobble(angle)) => prop_assert!(angle > 0.0 && angle < std::f64::consts::FRAC_PI_2),
            Err(_) => {}
        }
    }
}
