//! `evolve`, and its part of the record of `run`.

use std::fs;

use insta::assert_snapshot;

use crate::support::{MODEL, ROOT, Table, folder_of, folder_with, one_line, ran, ran_in, ran_with};

/// The ellipsoid of `data/published/ellipsoid`, with |K| = I3 * 1e-4.
const ASTEROID: &str = "\
[body]
name = \"asteroid\"
[material.rock]
density = 2500
young = 1e9
poisson = 0.25
rheology = { kind = \"kelvin-voigt\", time = 100 }
[[ellipsoid]]
semi_axes = [2300, 1200, 950]
material = \"rock\"
[initial]
wobble = { angle = \"20 deg\", rate = 1e-4, mode = \"short-axis\" }
";

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{found:e} {expected:e}");
}

#[test]
fn table_and_words_agree_with_the_object() {
    let folder = folder_with(ASTEROID);
    let object = ran_in(folder.path(), "evolve model.toml --until 5deg --json").json();
    let csv = ran_in(folder.path(), "evolve model.toml --until 5deg --format csv --samples 33");
    let table = Table::of(&csv.stdout);
    assert_eq!((csv.code, table.rows.len()), (Some(0), 33));
    for (name, key) in [("t", "time"), ("turns", "turns"), ("D_over_I3", "ratio_end")] {
        close(*table.column(name).last().unwrap(), object[key].as_f64().unwrap(), 1e-9);
    }
    let wobble = table.column("nutation_max");
    close(wobble[0].to_degrees(), 20.0, 1e-10);
    close(wobble[32].to_degrees(), 5.0, 1e-12);
    assert!(table.column("power").is_sorted_by(|a, b| a > b));
    let text = ran_in(folder.path(), "evolve model.toml --until 5deg").stdout;
    assert!(
        text.starts_with("asteroid: The wobble about the axis of greatest inertia falls from 20.0 to 5.00"),
        "{text}"
    );
    let file = ran_in(folder.path(), "evolve model.toml --until 5deg --samples 33 --out table.csv --json");
    assert_eq!(file.code, Some(0));
    assert_eq!(fs::read_to_string(folder.path().join("table.csv")).unwrap(), csv.stdout);
    let again = ran_in(folder.path(), "evolve model.toml --out table.csv");
    assert!(again.refusal().contains("--overwrite"));
}

/// A drag without a time, and a torque under which no average exists.
#[test]
fn torques_without_an_end_or_an_average_are_refused() {
    let dragged = format!("{ASTEROID}[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e3\n");
    assert_snapshot!(ran_with(&dragged, "evolve model.toml").refusal(), @r#"
    quasirigid: under a torque the rotation need not reach any target; say how long
    to follow it, with --duration or with evolve = { duration = "10 yr" } in [run]
    "#);
    let pushed = format!(
        "{ASTEROID}[[force]]\nname = \"push\"\nkind = \"torque\"\ntorque = [0, 0, 1e3]\naxes = \"inertial\"\n"
    );
    assert_snapshot!(ran_with(&pushed, "evolve model.toml").refusal(), @r#"
    quasirigid: the force "push" cannot be averaged over free rotations; those that
    can are a drag torque, a constant torque in body axes, and eddy currents, all
    of them in one field (kinds "spin-drag", "torque" and "eddy-current")
    "#);
}

/// The model file and Python call the ends of the way `until` and `start`.
#[test]
fn ends_of_the_way_have_the_names_of_the_file_too() {
    let rows = |line: &str| ran_with(ASTEROID, &format!("evolve model.toml --format csv {line}")).stdout;
    let known = rows("--start 0.95 --until 0.99");
    assert!(known.lines().count() > 2);
    assert_eq!(rows("--start 0.95 --until 0.99"), known);
}

/// A former name does what the name of today does, and says that name once.
#[test]
fn former_names_are_taken_with_a_note() {
    let folder = folder_with(ASTEROID);
    let [former, today] = ["--from 0.95 --to 0.99", "--start 0.95 --until 0.99"]
        .map(|line| ran_in(folder.path(), &format!("evolve model.toml {line}")));
    assert_eq!(former.stdout, today.stdout);
    assert!(!today.stderr.contains("is now called"), "{}", today.stderr);
    for name in ["--from is now called --start", "--to is now called --until"] {
        assert_eq!(crate::support::one_line(&former.stderr).matches(name).count(), 1, "{}", former.stderr);
    }
    let quiet = ran_in(folder.path(), "evolve model.toml --start 0.95 --until 0.99 --quiet");
    assert!(!quiet.stderr.contains("is now called"), "{}", quiet.stderr);
}

/// A start that the file gives is that of the flag.
#[test]
fn start_of_the_file_is_that_of_the_command() {
    let model = format!("{ASTEROID}\n[run]\nevolve = {{ start = 0.95, until = 0.99 }}\n");
    let told = |model: &str, line: &str| {
        let ran = ran_with(model, &format!("evolve model.toml --json {line}"));
        (ran.json()["start"].clone(), ran.json()["time"].clone())
    };
    assert_eq!(told(&model, ""), told(ASTEROID, "--start 0.95 --until 0.99"));
}

#[test]
fn what_cannot_be_is_refused() {
    let refusal = |line: &str| ran_with(ASTEROID, &format!("evolve model.toml {line}")).refusal().to_owned();
    assert_snapshot!(refusal("--until 0.2"), @r#"
    quasirigid: no rotation of this body has D/I3 = 0.2: it lies between 0.348068,
    a spin about the axis of least inertia, and 1, one about that of greatest, and
    both limits are steady spins
    "#);
    assert_snapshot!(refusal("--start 0.99 --until 0.95"), @r#"
    quasirigid: dissipation only raises D/I3, and the target 0.95 lies below the
    start, 0.99; choose a higher one with --until, or an earlier start with --start
    "#);
    assert_snapshot!(refusal("--until 5%"), @r#"
    quasirigid: --until: "5%" is neither a part of I3 nor an angle; write for
    example "98% of I3", 0.98 or "5 deg"
    "#);
    let too_many = refusal("--samples 10000001");
    assert_eq!(too_many.trim_end(), "quasirigid: --samples 10000001 is out of range; give 2 to 10000000");
    let steady = MODEL.replace("[0.12, 0.035, 0.02]", "[0.0, 0.0, 0.0]");
    assert_eq!(ran_with(&steady, "evolve model.toml").code, Some(2));
    let periods = ASTEROID.replace(
        "wobble = { angle = \"20 deg\", rate = 1e-4, mode = \"short-axis\" }",
        "periods = { rotation = \"20 h\", precession = \"19 h\", mode = \"short-axis\" }",
    );
    assert_snapshot!(ran_with(&periods, "evolve model.toml").refusal(), @r#"
    quasirigid: model.toml: [initial] periods: no motion in this mode has a period
    of rotation 1.0526 times that of precession; with these moments the ratio lies
    between 2.4801 and 26.4596
    "#);
}

#[test]
fn run_keeps_the_evolution_and_its_report_shows_it() {
    let folder = folder_of("apophis");
    let ran = ran_in(folder.path(), "run model.toml -o out --duration 100h --samples 50");
    assert_eq!(ran.code, Some(0), "{ran:?}");
    assert!(
        ran.stdout.contains("\nOver many revolutions: The wobble about the axis of greatest inertia"),
        "{}",
        ran.stdout
    );
    let table = Table::of(&fs::read_to_string(folder.path().join("out/evolution.csv")).unwrap());
    assert_eq!(table.rows.len(), 201);
    let report = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(report.contains("Over many revolutions") && report.contains("known only per frequency"));
}

#[test]
fn shares_of_dissipators_stand_in_a_line() {
    let text = ran("evolve examples/friction-wheel/model.toml").stdout;
    let line = text.lines().find(|line| line.contains("dissipation shares")).unwrap();
    assert_snapshot!(line, @"  dissipation shares: damper wheel 100.0 %, spring instrument-carrier 0.00370 %");
}

/// An end that was not asked for is told on standard error, after the object, with exit code 1.
#[test]
fn an_end_that_was_not_asked_for_fails() {
    let text = fs::read_to_string(format!("{ROOT}/examples/boom-satellite/model.toml")).unwrap();
    let dragged = format!("{text}\n[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e-4\n");
    let ran = ran_with(&dragged, "evolve model.toml --duration 10yr --json");
    assert_eq!((ran.code, &ran.json()["status"]), (Some(1), &"rest".into()));
    assert!(one_line(&ran.stderr).contains(ran.json()["message"].as_str().unwrap()), "{}", ran.stderr);
}

/// An average that is asked for where it does not hold says so first, and in the exit code.
#[test]
fn a_forced_average_says_that_it_does_not_hold() {
    let ran = ran("evolve examples/nutation-damper/model.toml --method average");
    assert_eq!(ran.code, Some(1));
    assert!(ran.stdout.starts_with("nutation damper: THE AVERAGE DOES NOT HOLD"), "{}", ran.stdout);
    let said = |text: &str| text.matches("THE AVERAGE DOES NOT HOLD").count();
    assert_eq!((said(&ran.stdout), said(&ran.stderr)), (1, 0), "{}{}", ran.stdout, ran.stderr);
}
