//! Rheology of materials, springs and hinges, and its ranges.

use std::f64::consts::TAU;

use insta::assert_snapshot;
use quasirigid::elements::Assembly;
use quasirigid::model::{Measured, Rheology};

use super::{CARRIER, HINGED, POINT, ROCK, made_of, read, refusal};

/// Rheology of an ellipsoid of rock, read from this text; Young's modulus is 1 GPa.
fn rheology(text: &str) -> Rheology {
    rheology_of(&format!("{ROCK}rheology = {text}\n"))
}

/// The rheology of an ellipsoid that is made of a material with these lines.
fn rheology_of(lines: &str) -> Rheology {
    read(&made_of(lines)).assembly.ellipsoids[0].material.rheology.clone()
}

/// Refusal of a rheology of rock, which is in line 8, from column 12.
fn refused(text: &str) -> String {
    refusal(&made_of(&format!("{ROCK}rheology = {text}\n")))
}

#[test]
fn every_rheology_is_read() {
    assert_eq!(
        rheology("{ kind = \"kelvin-voigt\", time = \"2 min\" }"),
        Rheology::KelvinVoigt { time: 120.0 }
    );
    assert_eq!(rheology("{ kind = \"quality-factor\", Q = 30 }"), Rheology::QualityFactor { factor: 30.0 });
    assert_eq!(
        rheology("{ kind = \"maxwell\", time = \"1 kyr\" }"),
        Rheology::Maxwell { time: 31_557_600e3 }
    );
    assert_eq!(
        rheology("{ kind = \"standard-linear\", time = 3, strength = 0.2 }"),
        Rheology::StandardLinear { time: 3.0, strength: 0.2 }
    );
    assert_eq!(
        rheology("{ kind = \"andrade\", time = 3 }"),
        Rheology::Andrade { time: 3.0, creep_time: 3.0, exponent: 1.0 / 3.0 }
    );
    assert_eq!(
        rheology("{ kind = \"andrade\", time = 3, creep_time = \"1 h\", exponent = 0.2 }"),
        Rheology::Andrade { time: 3.0, creep_time: 3600.0, exponent: 0.2 }
    );
}

/// Moduli are relative to the modulus of the material, however that is given.
#[test]
fn a_measured_rheology_is_read() {
    let measured = |rows: Vec<[f64; 3]>| Rheology::Table(Measured::new(rows).expect("a table"));
    let rows = "{ kind = \"table\", rows = [[\"0.5 Hz\", \"0.5 GPa\", 0.01], [20, 2e9, 0.5]] }";
    let expected = vec![[0.5 * TAU, 0.5, 0.01], [20.0, 2.0, 0.5]];
    assert_eq!(rheology(rows), measured(expected));
    let soft =
        rheology_of(&format!("density = 2500\nshear = \"0.2 GPa\"\npoisson = 0.25\nrheology = {rows}\n"));
    assert_eq!(soft, measured(vec![[0.5 * TAU, 1.0, 0.01], [20.0, 4.0, 0.5]]));
}

#[test]
fn a_rheology_can_be_a_table_of_its_own() {
    let text = format!("{}[material.rock.rheology]\nkind = \"maxwell\"\ntime = 2\n", made_of(ROCK));
    assert_eq!(read(&text).assembly.ellipsoids[0].material.rheology, Rheology::Maxwell { time: 2.0 });
}

/// Extremes: all rheologies at their least together, and all at their greatest; derived parameters follow.
#[test]
fn ranges_give_the_extremes_of_the_body() {
    let text = made_of(&format!(
        "{ROCK}rheology = {{ kind = \"andrade\", time = \"2 h\", range = [3600, \"3 h\"] }}\n"
    ));
    let model = read(&text);
    let extremes = model.extremes.expect("a range");
    let andrade = |time| Rheology::Andrade { time, creep_time: time, exponent: 1.0 / 3.0 };
    assert_eq!(model.assembly.ellipsoids[0].material.rheology, andrade(7200.0));
    assert_eq!(
        extremes.each_ref().map(|body| body.ellipsoids[0].material.rheology.clone()),
        [3600.0, 10_800.0].map(andrade)
    );

    let spring = |rheology: &str| {
        format!("[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600\ndamping = 2\n{rheology}")
    };
    let ranged = "rheology = { kind = \"quality-factor\", Q = 30, range = [20, 30] }\n";
    let hinge = "axes = [[0, 0, 1]]\nstiffness = 3\nrheology = { kind = \"kelvin-voigt\", time = 2, range = [1, 4] }\n";
    let model = read(&format!("{CARRIER}{POINT}{}{}{HINGED}{hinge}", spring(""), spring(ranged)));
    let [least, greatest] = *model.extremes.expect("two ranges");
    let of = |body: &Assembly| {
        let springs = body.springs.iter().map(|spring| spring.rheology.clone());
        springs.chain(body.hinged.iter().map(|hinged| hinged.rheology.clone())).collect::<Vec<_>>()
    };
    let all = |factor, time| {
        vec![Rheology::Elastic, Rheology::QualityFactor { factor }, Rheology::KelvinVoigt { time }]
    };
    assert_eq!(of(&model.assembly), all(30.0, 2.0));
    assert_eq!((of(&least), of(&greatest)), (all(20.0, 1.0), all(30.0, 4.0)));
    assert_eq!(
        (&least.points, &least.springs[1].law),
        (&model.assembly.points, &model.assembly.springs[1].law)
    );
}

#[test]
fn a_spring_is_measured_relative_to_its_stiffness() {
    let spring = |modulus: &str| {
        let rows = format!("rheology = {{ kind = \"table\", rows = [[\"1 Hz\", {modulus}, 0.1]] }}\n");
        format!("{CARRIER}{POINT}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600\n{rows}")
    };
    let rows = Measured::new(vec![[TAU, 1.5, 0.1]]).expect("a table");
    assert_eq!(read(&spring("1.5")).assembly.springs[0].rheology, Rheology::Table(rows));
    assert_snapshot!(refusal(&spring("\"600 N/m\"")), @r#"
    model.toml:13:47: `rows`: "600 N/m" is a stiffness, but a plain number is needed
      write a number without quotes
    "#);
}

/// Below 1 the law `1 + i/Q` loses less the smaller `Q` is, and the times were symmetric about 1.
#[test]
fn a_quality_factor_is_at_least_one() {
    assert_eq!(rheology("{ kind = \"quality-factor\", Q = 1 }"), Rheology::QualityFactor { factor: 1.0 });
    assert_snapshot!(refused("{ kind = \"quality-factor\", Q = 0.99, range = [0.5, 2] }"), @r#"
    model.toml:8:43: `Q` is 0.99, but must be at least 1
      for a material that loses more than it stores, write its kind "maxwell", "standard-linear" or "table"
    model.toml:8:58: `range` is 0.5, but must be at least 1
      for a material that loses more than it stores, write its kind "maxwell", "standard-linear" or "table"
    "#);
}

#[test]
fn a_range_contains_what_it_is_the_range_of() {
    let factor = |range: &str| format!("{{ kind = \"quality-factor\", Q = 100, range = {range} }}");
    assert_eq!(rheology(&factor("[100, 100]")), Rheology::QualityFactor { factor: 100.0 });
    assert_snapshot!(refused(&factor("[100.5, 200]")), @"
    model.toml:8:56: `range` goes from 100.5 to 200, but `Q` is 100
      write the least and the greatest value that `Q` may have
    ");
    assert_snapshot!(refused(&factor("[10, 99]")), @"
    model.toml:8:56: `range` goes from 10 to 99, but `Q` is 100
      write the least and the greatest value that `Q` may have
    ");
    assert_snapshot!(refused(&factor("[200, 50]")), @"
    model.toml:8:56: `range` goes from 200 to 50, but `Q` is 100
      write the least and the greatest value that `Q` may have
    ");
    assert_snapshot!(refused("{ kind = \"maxwell\", time = \"1 min\", range = [61, \"2 min\"] }"), @"
    model.toml:8:56: `range` goes from 61 to 120 s, but `time` is 60 s
      write the least and the greatest value that `time` may have
    ");
    assert_snapshot!(refused(&factor("[0, 200]")), @r#"
    model.toml:8:57: `range` is 0, but must be at least 1
      for a material that loses more than it stores, write its kind "maxwell", "standard-linear" or "table"
    "#);
    assert_snapshot!(refused(&factor("[nan, 200]")), @"
    model.toml:8:57: `range` is nan, which is not a finite number
      write a number
    ");
    assert_snapshot!(refused(&factor("[10, 100, 200]")), @"
    model.toml:8:56: `range`: found an array of 3 values, expected an array of 2 numbers
      write 2 numbers in brackets, with commas between them
    ");
    assert_snapshot!(refused("{ kind = \"maxwell\", time = 0, range = [\"1 m\", 2] }"), @r#"
    model.toml:8:39: `time` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:8:51: `range`: "1 m" is a length, but a time is needed
      write for example "2 h", or a plain number in s
    "#);
    assert_snapshot!(refused("{ kind = \"table\", rows = [[1, 1e9, 1]], range = [1, 2] }"), @r#"
    model.toml:8:52: `range` is not a key of `rheology` of kind "table"
      it is for kind = "kelvin-voigt", kind = "quality-factor", kind = "maxwell", kind = "standard-linear" or kind = "andrade"; the keys here are kind, rows
    "#);
}

#[test]
fn an_impossible_rheology_is_refused() {
    assert_snapshot!(refused("{ kind = \"kelvin\", time = 1 }"), @r#"
    model.toml:8:21: `kind` cannot be "kelvin"
      write "kelvin-voigt", "quality-factor", "maxwell", "standard-linear", "andrade" or "table"
    "#);
    assert_snapshot!(refused("{ time = 1, q = 3 }"), @r#"
    model.toml:8:12: `rheology` has no `kind`
      add a line such as: kind = "kelvin-voigt", "quality-factor", "maxwell", "standard-linear", "andrade" or "table"
    model.toml:8:24: unknown key "q" in `rheology`
      did you mean `Q`? the keys are kind, time, Q, strength, creep_time, exponent, range, rows
    "#);
    assert_snapshot!(refused("\"maxwell\""), @r#"
    model.toml:8:12: `rheology`: found a text, expected a table
      write for example { kind = "quality-factor", Q = 100 }
    "#);
    assert_snapshot!(refused("{ kind = \"kelvin-voigt\", time = -1 }"), @r#"
    model.toml:8:44: `time` is -1 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    "#);
    assert_snapshot!(refused("{ kind = \"quality-factor\", time = 1 }"), @r#"
    model.toml:8:12: `rheology` of kind "quality-factor" has no `Q`
      add a line such as: Q = 100
    model.toml:8:39: `time` is not a key of `rheology` of kind "quality-factor"
      it is for kind = "kelvin-voigt", kind = "maxwell", kind = "standard-linear" or kind = "andrade"; the keys here are kind, Q, range
    "#);
    assert_snapshot!(refused("{ kind = \"quality-factor\", q = 3 }"), @r#"
    model.toml:8:39: unknown key "q" in `rheology` of kind "quality-factor"
      did you mean `Q`? the keys are kind, Q, range
    "#);
    assert_snapshot!(refused("{ kind = \"standard-linear\", time = \"1 m\", strength = 0 }"), @r#"
    model.toml:8:47: `time`: "1 m" is a length, but a time is needed
      write for example "2 h", or a plain number in s
    model.toml:8:65: `strength` is 0, but must be positive
      write a number
    "#);
    assert_snapshot!(refused("{ kind = \"standard-linear\" }"), @r#"
    model.toml:8:12: `rheology` of kind "standard-linear" has no `time`
      add a line such as: time = "100 s"
    model.toml:8:12: `rheology` of kind "standard-linear" has no `strength`
      add a line such as: strength = 0.1
    "#);
    assert_snapshot!(refused("{ kind = \"andrade\", time = nan, creep_time = 0, exponent = 1 }"), @r#"
    model.toml:8:39: `time` is nan, which is not a finite number
      write a number in s, or a text with its unit such as "2 h"
    model.toml:8:57: `creep_time` is 0 s, but must be positive
      write a number in s, or a text with its unit such as "2 h"
    model.toml:8:71: `exponent` is 1, but must be between 0 and 1
      write a number
    "#);
    assert_snapshot!(refused("{ kind = \"andrade\", time = 1, exponent = 0 }"), @"
    model.toml:8:53: `exponent` is 0, but must be between 0 and 1
      write a number
    ");
}

#[test]
fn an_impossible_table_is_refused() {
    let rows = |rows: &str| refused(&format!("{{ kind = \"table\", rows = {rows} }}"));
    assert_snapshot!(rows("[]"), @"
    model.toml:8:37: `rows`: a table needs at least one row of frequency, modulus and loss
      write a row for each frequency, the lowest first
    ");
    assert_snapshot!(rows("3"), @"
    model.toml:8:37: `rows`: found an integer, expected rows of frequency, modulus and loss
      write rows of frequency, modulus and loss
    ");
    assert_snapshot!(rows("[[1, 1e9], 2]"), @"
    model.toml:8:38: `rows`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    model.toml:8:48: `rows`: found an integer, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    ");
    assert_snapshot!(rows("[[0, \"1 m\", -1], [\"1 h\", nan, 0]]"), @r#"
    model.toml:8:39: `rows` is 0 rad/s, but must be positive
      write a number in rad/s, or a text with its unit such as "2 Hz"
    model.toml:8:42: `rows`: "1 m" is a length, but a pressure is needed
      write for example "70 GPa", or a plain number in Pa
    model.toml:8:49: `rows` is -1, but must be positive
      write a number
    model.toml:8:55: `rows`: "1 h" is a time, but a frequency is needed
      write for example "2 Hz", or a plain number in rad/s
    model.toml:8:62: `rows` is nan, which is not a finite number
      write a number in Pa, or a text with its unit such as "70 GPa"
    model.toml:8:67: `rows` is 0, but must be positive
      write a number
    "#);
    assert_snapshot!(rows("[[1, 1e9, 1], [2, 1e9, 1], [2, 1e9, 1]]"), @"
    model.toml:8:64: `rows`: frequencies must ascend, but 2 rad/s follows 2 rad/s
      write a row for each frequency, the lowest first
    ");
    assert_snapshot!(rows("[[1, 1e9, 1], [\"1 mHz\", 1e9, 1], [3, 1e9, 1]]"), @"
    model.toml:8:51: `rows`: frequencies must ascend, but 0.006283185307179587 rad/s follows 1 rad/s
      write a row for each frequency, the lowest first
    ");
    assert_snapshot!(refused("{ kind = \"table\" }"), @r#"
    model.toml:8:12: `rheology` of kind "table" has no `rows`
      add a line such as: rows = [["1 Hz", "70 GPa", 0.01]]
    "#);
    assert_snapshot!(refusal(&made_of("density = 1\nyoung = 0\npoisson = 0\nrheology = { kind = \"table\", rows = [[1, 2]] }\n")), @r#"
    model.toml:6:9: `young` is 0 Pa, but must be positive
      write a number in Pa, or a text with its unit such as "70 GPa"
    model.toml:8:38: `rows`: found an array of 2 values, expected an array of 3 numbers
      write 3 numbers in brackets, with commas between them
    "#);
}
