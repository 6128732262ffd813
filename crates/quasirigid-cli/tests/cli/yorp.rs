//! YORP from the command line: text, files, the same numbers in each, refusals.

use std::fs;

use crate::support::{ROOT, Table, folder_with, ran, ran_in, ran_with};

const ROCK: &str = "yorp examples/sunlit-rock/model.toml";

#[test]
fn torques_are_printed_and_written() {
    let model = fs::read_to_string(format!("{ROOT}/examples/sunlit-rock/model.toml")).unwrap();
    let folder = folder_with(&model);
    fs::copy(format!("{ROOT}/examples/sunlit-rock/rock.obj"), folder.path().join("rock.obj")).unwrap();
    let line = "yorp model.toml --thermal-inertia 200 -o curve.csv -o curve.svg";
    let ran = ran_in(folder.path(), line);
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.lines().all(|line| line.chars().count() <= 80), "{}", ran.stdout);
    let table = Table::of(&fs::read_to_string(folder.path().join("curve.csv")).unwrap());
    assert_eq!(table.rows.len(), 37);
    let object = ran_in(folder.path(), "yorp model.toml --thermal-inertia 200 --json").json();
    let spins: Vec<f64> =
        object["curve"].as_array().unwrap().iter().map(|at| at["spin_torque"].as_f64().unwrap()).collect();
    assert_eq!(table.column("spin_torque"), spins);
    // from the normal of the orbit, (0, -sin 35, cos 35) degrees, to the axis, less the wobble of a degree
    let axis: Vec<f64> = object["axis"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let (sin, cos) = 35_f64.to_radians().sin_cos();
    let known = (cos * axis[2] - sin * axis[1]).acos().to_degrees();
    assert!((object["now"]["obliquity"].as_f64().unwrap().to_degrees() - known).abs() < 1.1, "{object}");
    assert!(fs::read_to_string(folder.path().join("curve.svg")).unwrap().contains("along the spin"));
    assert_eq!(ran_in(folder.path(), line).code, Some(2));
}

#[test]
fn what_has_no_yorp_is_refused() {
    let none = ran_with(crate::support::MODEL, "yorp model.toml");
    assert_eq!(none.code, Some(2));
    assert!(none.stderr.contains("no sunlight"), "{}", none.stderr);
    for (options, words) in
        [("--albedo 1.5", "albedo"), ("-o curve.pdf", ".svg"), ("--thermal-inertia=-1", "inertia")]
    {
        let refused = ran(&format!("{ROCK} {options}"));
        assert_eq!(refused.code, Some(2), "{options}");
        assert!(refused.stderr.contains(words), "{options}: {}", refused.stderr);
    }
}

/// The mean torque is not that of an evolution, which refuses the force.
#[test]
fn other_commands_take_sunlight_or_refuse_it() {
    for (command, code) in [("check", 0), ("evolve", 2)] {
        let line = format!("{command} examples/sunlit-rock/model.toml");
        let answer = ran(&line);
        assert_eq!(answer.code, Some(code), "{line}: {answer:?}");
        let all = answer.stdout + &answer.stderr;
        assert!(all.lines().all(|line| line.chars().count() <= 80), "{all}");
    }
}
