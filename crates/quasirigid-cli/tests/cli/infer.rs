//! Inference, its design and its figures from the command line: files, exit codes, refusals.

use std::fs;

use crate::support::{folder_with, ran_in};

const STONE: &str = "[carrier]\nmass = 100\ncenter_of_mass = [0, 0, 0]\ninertia = [10, 14, 17]\n\
    [initial]\nangular_velocity = [0.15, 0.02, 0.9]\n";
const MEASURED: &str = "t,wx,sigma_wx\n0,0.151,0.002\n2,0.131,0.002\n4,0.077,0.002\n6,0.005,0.002\n";

#[test]
fn measurements_are_fitted_and_drawn() {
    let folder = folder_with(STONE);
    fs::write(folder.path().join("measured.csv"), MEASURED).unwrap();
    fs::write(folder.path().join("answers.txt"), "modes.nutation.frequency = 0.253 rad/s +- 5 %\n").unwrap();
    let line = "infer model.toml --data measured.csv --measured answers.txt --vary carrier.inertia.1 --system rigid \
        --prior carrier.inertia.1=10+-20% --range carrier.inertia.1=2..13 --starts 1 --figure fit.svg";
    let ran = ran_in(folder.path(), line);
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.contains("off by") && ran.stdout.contains("rad/s"), "{}", ran.stdout);
    assert!(ran.stdout.lines().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
    let figure = fs::read_to_string(folder.path().join("fit.svg")).unwrap();
    assert!(figure.contains("wx [rad/s]") && figure.contains("modes.nutation.frequency"), "{figure}");
    assert_eq!(ran_in(folder.path(), line).code, Some(2), "the figure is there already");
}

#[test]
fn plans_are_ranked() {
    let folder = folder_with(STONE);
    fs::write(folder.path().join("fast.toml"), STONE.replace("0.9]", "1.8]")).unwrap();
    let ran = ran_in(
        folder.path(),
        "infer model.toml --design --vary carrier.inertia.1 --system rigid --duration 20s --samples 21 \
         --sensor wx,wy+-1mrad/s --sensor modes.nutation.frequency+-1% --manoeuvre fast.toml",
    );
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.contains("Most would be told by the motion of \"fast.toml\""), "{}", ran.stdout);
    assert!(ran.stdout.lines().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
}

#[test]
fn sensitivities_are_drawn() {
    let folder = folder_with(STONE);
    let ran =
        ran_in(folder.path(), "sensitivity model.toml --of modes.nutation.frequency --figure tornado.svg");
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    let figure = fs::read_to_string(folder.path().join("tornado.svg")).unwrap();
    assert!(figure.contains("carrier.inertia.3") && figure.contains("1 % more of the key"), "{figure}");
}

#[test]
fn mistakes_in_inferences_are_refused() {
    let folder = folder_with(STONE);
    fs::write(folder.path().join("measured.csv"), MEASURED).unwrap();
    let told = |options: &str, words: &str| {
        let ran = ran_in(folder.path(), &format!("infer model.toml --vary carrier.inertia.1 {options}"));
        assert!(ran.code == Some(2) && ran.stderr.contains(words), "{options}: {}", ran.stderr);
    };
    told("", "--data");
    told("--measured nothing.txt", "is the name right");
    told("--measured check.T1=3", "has no deviation");
    told("--data measured.csv --loss huber --loss-scale 0", "--loss-scale");
    told("--data measured.csv --figure fit.pdf", "a figure is an .svg or .png file");
    told("--data measured.csv --prior carrier.mass=1+-1", "add it to --vary");
    told("--design", "--sensor");
    told("--design --sensor wx", "is no sensor such as");
    told("--design --sensor wx+-1 --manoeuvre nothing.toml", "nothing.toml");
}
