//! Maps over fill and spin from the command line: files, exit codes, units, refusals.

use std::fs;

use serde_json::Value;

use crate::support::{folder_with, ran_in, ran_with};

/// A small tank under thrust in a body that a wheel steadies: its slosh meets the nutation, and every point holds.
const BIASED: &str = "[carrier]\nmass = 260.0\ncenter_of_mass = [0, 0, 0]\ninertia = [150.0, 160.0, 220.0]\n\
    [[wheel]]\nname = \"bias\"\naxis = [0, 0, 1]\nmomentum = 350.0\n\
    [[tank]]\nname = \"fuel\"\nshape = \"sphere\"\nradius = \"15 cm\"\ncenter = [0, 0, 0.6]\nfill = 0.4\ndensity = 1008.0\n\
    kinematic_viscosity = \"0.96 cSt\"\nsurface_tension = \"10 mN/m\"\nsettled_by = { acceleration = [0, 0, -0.5] }\n\
    [[force]]\nname = \"engine\"\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, -0.8]\nforce = [0, 0, 132.85]\n\
    [initial]\nangular_velocity = [0, 0, 0.002]\n";

#[test]
fn maps_are_printed_and_written() {
    let folder = folder_with(BIASED);
    let ran = ran_in(
        folder.path(),
        "fills model.toml --spin 0.02rpm --points 6,1 --fill 0.2,0.8 -o map.csv -o map.svg",
    );
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.contains("fills at which the time constant dips"), "{}", ran.stdout);
    assert!(ran.stdout.lines().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
    let table = fs::read_to_string(folder.path().join("map.csv")).unwrap();
    assert_eq!(table.lines().count(), 7);
    let figure = fs::read_to_string(folder.path().join("map.svg")).unwrap();
    assert!(figure.contains("0.02 rpm") && figure.contains("worst fill"), "{figure}");
    let again = ran_in(folder.path(), "fills model.toml --points 6,1 -o map.csv");
    assert_eq!(again.code, Some(2), "{}", again.stderr);
}

/// A point that may not hold, or has no answer, is told by the exit code.
#[test]
fn maps_that_may_not_hold_end_with_1() {
    let doubtful = BIASED.replace("132.85", "140.0");
    let ran = ran_with(&doubtful, "fills model.toml --spin 0.002 --points 3,1 --json");
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    let object: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(object["holds"], false);
    assert_eq!(object["points"][0]["status"], "doubtful");
    assert!(object["inputs"]["values"].is_array());
}

#[test]
fn mistakes_in_maps_are_refused() {
    let told = |options: &str, words: &str| {
        let ran = ran_with(BIASED, &format!("fills model.toml {options}"));
        assert!(ran.code == Some(2) && ran.stderr.contains(words), "{options}: {}", ran.stderr);
    };
    told("--fill 0.1", "fills are two numbers");
    told("--fill 0,0.5", "fills from 0 to 0.5");
    told("--points 20", "a number of fills and one of spins");
    told("--spin 1,2,3", "a first and a last spin");
    told("--spin 3kg", "kg");
    told("--tank oil", "there is no [[tank]] \"oil\"");
    told("-o map.txt", "a map of fills is a .csv, .svg or .png file");
}
