//! Light curves from the command line: files, exit codes, shadows, refusals.

use std::fs;

use crate::support::{Table, folder_with, ran, ran_in, ran_with};

const TOUTATIS: &str = "lightcurve examples/toutatis/model.toml --sun 1,0,0 --observer 0.8,0.6,0";

/// An L of three cubes, in metres, that turns about its high axis once in 100 s.
const CORNER: &str = "[material.rock]\ndensity = 2000\nshear = 1e9\npoisson = 0.25\n\
    [[surface]]\nname = \"corner\"\nfile = \"corner.obj\"\nunit = \"m\"\nmaterial = \"rock\"\ndegree = 2\n\
    [initial]\nangular_velocity = [0, 0, 0.06283185307179587]\n";

fn corner() -> String {
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let vertices = [0, 1].map(|z| outline.map(|[x, y]| format!("v {x} {y} {z}\n")).concat()).concat();
    let filling = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let caps = filling
        .map(|[a, b, c]| format!("f {} {} {}\nf {} {} {}\n", a + 1, c + 1, b + 1, a + 7, b + 7, c + 7));
    let sides = [0, 1, 2, 3, 4, 5].map(|k| {
        let n = (k + 1) % 6;
        format!("f {} {} {}\nf {} {} {}\n", k + 1, n + 1, n + 7, k + 1, n + 7, k + 7)
    });
    vertices + &caps.concat() + &sides.concat()
}

#[test]
fn curves_are_printed_and_written() {
    let folder = folder_with(
        &fs::read_to_string(format!("{}/examples/toutatis/model.toml", crate::support::ROOT)).unwrap(),
    );
    let line = "lightcurve model.toml --sun 1,0,0 --observer 0.8,0.6,0 --samples 501 --periods -o curve.csv -o curve.svg -o curve.npz -o curve.parquet";
    let ran = ran_in(folder.path(), line);
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(
        ran.stdout.contains("mag") && ran.stdout.lines().all(|line| line.chars().count() <= 80),
        "{}",
        ran.stdout
    );
    let table = Table::of(&fs::read_to_string(folder.path().join("curve.csv")).unwrap());
    assert_eq!(table.header, ["t", "brightness", "magnitude", "phase_angle"]);
    assert_eq!(table.rows.len(), 501);
    let alpha = 0.6_f64.atan2(0.8);
    assert!(table.column("phase_angle").iter().all(|angle| (angle / alpha - 1.0).abs() < 1e-12));
    assert!(fs::read_to_string(folder.path().join("curve.svg")).unwrap().contains("computed"));
    assert!(folder.path().join("curve.csv.inputs.json").is_file());
    assert_eq!(ran_in(folder.path(), line).code, Some(2));
}

/// An L seen and lit along its diagonals has the area of its outline, by the law of Lommel and Seeliger: `2√2` into the corner and onto the
/// back, `3/√2` from the sides, where one arm hides a part of the other.
#[test]
fn a_body_that_is_not_convex_hides_itself() {
    let folder = folder_with(CORNER);
    fs::write(folder.path().join("corner.obj"), corner()).unwrap();
    let asked = "lightcurve model.toml --sun 1,1,0 --observer 1,1,0 --duration 100 --samples 5 --json";
    let ran = ran_in(folder.path(), asked);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let object = ran.json();
    assert_eq!(object["surface"]["convex"], false);
    let brightness = crate::support::numbers(&object["brightness"]);
    // from the front, the side, the back, the side
    for (at, found) in brightness.iter().enumerate() {
        let known = if at.is_multiple_of(2) { 2.0 * f64::sqrt(2.0) } else { 3.0 / f64::sqrt(2.0) };
        assert!((found / known - 1.0).abs() < 5e-3, "{at}: {brightness:?}");
    }
}

#[test]
fn mistakes_in_light_curves_are_refused() {
    let told = |options: &str, words: &str| {
        let ran = ran(&format!("lightcurve examples/toutatis/model.toml {options}"));
        assert!(ran.code == Some(2) && ran.stderr.contains(words), "{options}: {}", ran.stderr);
    };
    told("", "--sun 1,0,0 --observer");
    told("--sun 1,0 --observer 1,0,0", "a direction has three components");
    told("--sun 0,0,0 --observer 1,0,0", "direction to the Sun");
    told("--sun 1,0,0 --observer 1,0,0 --law moon", "give lommel-seeliger");
    told("--sun 1,0,0 --observer 1,0,0 --phase hg", "give flat");
    told("--sun 1,0,0 --observer 1,0,0 -o curve.pdf", "a light curve is a .csv");
    told("--view nowhere.csv", "nowhere.csv");
    let empty = ran_with(crate::support::MODEL, "lightcurve model.toml --sun 1,0,0 --observer 1,0,0");
    assert!(empty.refusal().contains("no outer surface"), "{}", empty.stderr);
    assert_eq!(ran(&format!("{TOUTATIS} --samples 20")).code, Some(0));
}
