//! Catalogues as the table of a study: `[columns]` maps them, what is missing or left out is told, uncertain values give percentiles of each body.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{folder_with, one_line, ran_in};

const MODEL: &str = "\
[material.rock]
density = \"2 g/cm^3\"
mu_Q = \"4e9 Pa\"
poisson = 0.25
rheology = { kind = \"quality-factor\", Q = 100 }
[[ellipsoid]]
semi_axes = [300, 200, 150]
material = \"rock\"
[initial]
wobble = { angle = \"20 deg\", rate = \"1 rpm\", mode = \"short-axis\" }
[run]
evolve = { until = \"5 deg\" }
";

const HEAD: &str = "model = \"model.toml\"\n[answer]\nquantities = [\"evolve.time\"]\n";

/// Light curves: period (h), absolute magnitude, albedo, flags, missing values.
const CATALOGUE: &str = "\
Number|Name     |H    |pV   |P [h] |P_err|U |a/b
    1|one      |20.0 |0.20 |5.27  |0.05 |3 |1.5
    2|two      |-9.99|0.20 |5.27  |0.05 |2-|1.5
    3|three    |20.0 |     |>20   |     |1 |1.5
    4|four     |20.0 |0.05 |130:  |-    |3 |NaN
    5|five     |18.5 |     |12.0  |0.5  |3 |1.2
";

const COLUMNS: &str = "\
[columns]
\"initial.wobble.rate\" = { formula = \"2*pi/`P [h]`\", unit = \"rad/h\", marks = [\":\"] }
\"ellipsoid.1.semi_axes.1\" = { formula = \"1329/sqrt(pV)*10^(-H/5)/2*(`a/b`)^(2/3)\", unit = \"km\", default = 0.3 }
\"body.name\" = \"Name\"
";

fn swept(folder: &Path, table: &str, study: &str) -> Value {
    fs::write(folder.join("bodies.txt"), table).unwrap();
    fs::write(folder.join("study.toml"), study).unwrap();
    let ran = ran_in(folder, "sweep study.toml -o out --json");
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    ran.json()
}

fn rows(folder: &Path, file: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("out").join(file)).unwrap();
    text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_catalogue_is_taken_as_it_is() {
    let folder = folder_with(MODEL);
    let table = "[table]\nfile = \"bodies.txt\"\nmissing = [\"-9.99\"]\nkeep = [\"U\"]\n";
    let summary = swept(folder.path(), CATALOGUE, &format!("{HEAD}{table}{COLUMNS}"));
    assert_eq!(
        (&summary["status"]["answered"], &summary["status"]["invalid"]),
        (&4.into(), &1.into()),
        "{summary:#}"
    );
    let reason = &summary["reasons"][0];
    assert_eq!((&reason["first_row"], &reason["count"]), (&3.into(), &1.into()));
    assert!(reason["example"].as_str().unwrap().contains("\">20\" is not a finite number"), "{reason}");
    let notes = one_line(&summary["notes"].to_string());
    for told in [
        "values between '|'",
        "columns left out: \\\"Number\\\", \\\"P_err\\\"",
        "4 rows have no value for `ellipsoid.1.semi_axes.1`, and take \\\"0.3 km\\\"",
    ] {
        assert!(notes.contains(told), "{told}: {notes}");
    }
    let rows = rows(folder.path(), "rows.csv");
    assert_eq!(
        rows[0][..5],
        ["row", "initial.wobble.rate [rad/h]", "ellipsoid.1.semi_axes.1 [km]", "Name", "U"]
    );
    assert_eq!(rows[0][5], "evolve.time [s]");
    // by hand: D = 1329 km/sqrt(0.2)·10^(−20/5) = 0.29717 km, a = D/2·1.5^(2/3)
    let a: f64 = rows[1][2].parse().unwrap();
    assert!((a / (0.297_173_434 / 2.0 * 1.310_370_697) - 1.0).abs() < 1e-8, "{a}");
    // by hand: 2π/5.27 rad/h
    let rate: f64 = rows[1][1].parse().unwrap();
    assert!((rate / 1.192_255_276 - 1.0).abs() < 1e-8, "{rate}");
    let rate: f64 = rows[4][1].parse().unwrap();
    assert!((rate / 0.048_332_195 - 1.0).abs() < 1e-7, "the mark behind 130 is taken away: {rate}");
    let files: Vec<_> =
        summary["files"].as_array().unwrap().iter().map(|file| file["name"].clone()).collect();
    assert_eq!(files, ["study.toml", "model.toml", "bodies.txt"]);
    assert!(
        fs::read_to_string(folder.path().join("out/report.html"))
            .unwrap()
            .contains("Time against size and rotation")
    );
}

#[test]
fn uncertain_values_give_percentiles_of_each_body() {
    let folder = folder_with(MODEL);
    let table = "name,w [rad/h],w_err\nsure,1.0,\nunsure,1.0,0.05\n";
    let study = format!(
        "samples = 40\nsampling = \"latin-hypercube\"\n{HEAD}[table]\nfile = \"bodies.txt\"\nkeep = [\"name\"]\n\
         [columns]\n\"initial.wobble.rate\" = {{ name = \"w\", sigma = \"w_err\" }}\n"
    );
    let summary = swept(folder.path(), table, &study);
    assert_eq!(summary["status"]["answered"], 80, "{summary:#}");
    assert!(summary["notes"].to_string().contains("1 rows have no uncertainty of `initial.wobble.rate`"));
    let bodies = rows(folder.path(), "bodies.csv");
    assert_eq!(
        bodies[0],
        [
            "body",
            "name",
            "answered",
            "evolve.time at 16.0 % [s]",
            "evolve.time at 50.0 % [s]",
            "evolve.time at 84.0 % [s]"
        ]
        .map(|name| name.replace(".0 %", " %"))
    );
    let times = |row: usize| [3, 4, 5].map(|column| bodies[row][column].parse::<f64>().unwrap());
    let ([low, middle, high], [least, median, greatest]) = (times(1), times(2));
    assert!(low == middle && middle == high, "{bodies:?}");
    // the time goes as the rate to the power −3: ±5 % of the rate are about ∓15 % of the time
    assert!((median / middle - 1.0).abs() < 0.02, "{median} {middle}");
    assert!((greatest / least / (1.05_f64 / 0.95).powi(3) - 1.0).abs() < 0.06, "{least} {greatest}");
}

#[test]
fn units_and_columns_that_contradict_are_refused() {
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("bodies.txt"), "D [km],w\n0.3,1\n").unwrap();
    for (columns, said) in [
        (
            "\"ellipsoid.1.semi_axes.1\" = { name = \"D\", unit = \"m\" }",
            "the study gives m as the unit of the column, the table km",
        ),
        ("\"ellipsoid.1.semi_axes.1\" = \"diameter\"", "the table has no column \"diameter\""),
        ("\"ellipsoid.1.semi_axis\" = \"D\"", "unknown key \"semi_axis\" in [[ellipsoid]]"),
        ("\"ellipsoid.1.semi_axes.1\" = { formula = \"D*(\" }", "`formula`: "),
        (
            "\"ellipsoid.1.semi_axes.1\" = { formula = \"D/2\", sigma = \"w\" }",
            "of a formula each column has its own standard deviation",
        ),
        (
            "\"ellipsoid.1.semi_axes.1\" = { name = \"D\", sigma = \"w\" }",
            "has an uncertainty, but the study has no `samples`",
        ),
    ] {
        let study = format!("{HEAD}[table]\nfile = \"bodies.txt\"\n[columns]\n{columns}\n");
        fs::write(folder.path().join("study.toml"), study).unwrap();
        let ran = ran_in(folder.path(), "sweep study.toml -o out");
        assert_eq!(ran.code, Some(2), "{columns}");
        assert!(one_line(&ran.stderr).contains(said), "{said}: {}", ran.stderr);
    }
}
