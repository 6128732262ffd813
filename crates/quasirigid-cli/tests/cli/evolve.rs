//! `evolve`, and its part of the record of `run`.

use std::fs;

use insta::assert_snapshot;
use serde_json::Value;

use crate::support::{MODEL, ROOT, Table, folder_of, folder_with, ran, ran_in, ran_with};

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

fn published(file: &str) -> Vec<Vec<f64>> {
    let text = fs::read_to_string(format!("{ROOT}/data/published/ellipsoid/{file}")).unwrap();
    Table::of(&text).rows
}

fn number(object: &Value, key: &str) -> f64 {
    object[key].as_f64().unwrap_or_else(|| panic!("{key} of {object}"))
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{found:e} {expected:e}");
}

#[test]
fn powers_and_times_are_the_published_ones() {
    let folder = folder_with(ASTEROID);
    let json = |from: f64, to: f64| {
        ran_in(folder.path(), &format!("evolve model.toml --start {from:.17} --until {to:.17} --json")).json()
    };
    for row in published("kelvin_voigt.csv") {
        let found = json(row[0], 0.999);
        close(number(&found, "power"), row[1], 1e-9);
        let separatrix = 3.400_613_826_285_618e19 / 3.695_782_164_053_647e19;
        let mode = if row[0] > separatrix { "short-axis" } else { "long-axis" };
        assert_eq!((&found["mode"]["start"], &found["mode"]["end"]), (&mode.into(), &"short-axis".into()));
        assert_eq!(found["separatrix_time"].is_null(), row[0] > separatrix);
    }
    let I3 = 3.695_782_164_053_647e19;
    for row in published("times.csv") {
        close(number(&json(row[0] / I3, row[1] / I3), "time"), row[2], 1e-6);
    }
}

#[test]
fn table_and_words_agree_with_the_object() {
    let folder = folder_with(ASTEROID);
    let object = ran_in(folder.path(), "evolve model.toml --until 5deg --json").json();
    let csv = ran_in(folder.path(), "evolve model.toml --until 5deg --format csv --samples 33");
    let table = Table::of(&csv.stdout);
    assert_eq!((csv.code, table.rows.len()), (Some(0), 33));
    for (name, key) in [("t", "time"), ("turns", "turns"), ("D_over_I3", "ratio_end")] {
        close(*table.column(name).last().unwrap(), number(&object, key), 1e-9);
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

/// Both methods to the power: by default that of the reduced equations, whose small frequencies the harmonics correct.
#[test]
fn power_is_that_of_the_road_asked_for() {
    let folder = folder_with(ASTEROID);
    let power = |options: &str| {
        number(&ran_in(folder.path(), &format!("evolve model.toml --json {options}")).json(), "power")
    };
    let [own, polynomial, harmonics] = ["", "--power polynomial", "--power harmonics"].map(power);
    assert!(own == polynomial && harmonics != polynomial);
    close(harmonics, polynomial, 1e-3);
    let text = ASTEROID.replace("kelvin-voigt\", time = 100", "quality-factor\", Q = 100");
    let other = folder_with(&text);
    let none = ran_in(other.path(), "evolve model.toml --power polynomial");
    assert!(none.stdout.contains("Nothing is dissipated"), "{none:?}");
    assert!(none.stderr.contains("take it from the harmonics"), "{none:?}");
}

/// A time in between: the state after it is where the time to it ends.
#[test]
fn duration_ends_the_evolution() {
    let folder = folder_with(ASTEROID);
    let half = ran_in(folder.path(), "evolve model.toml --json --duration 1e14").json();
    close(number(&half, "time"), 1e14, 1e-9);
    let to = number(&half, "ratio_end");
    let back = ran_in(folder.path(), &format!("evolve model.toml --json --until {to:.17}")).json();
    close(number(&back, "time"), 1e14, 1e-6);
}

#[test]
fn uncertain_material_gives_a_range() {
    let range = "\"quality-factor\", Q = 100, range = [10, 1000] }";
    let text = ASTEROID.replace("\"kelvin-voigt\", time = 100 }", range);
    let found = ran_with(&text, "evolve model.toml --json").json();
    let time = number(&found, "time");
    let [least, greatest] = [0, 1].map(|i| found["time_range"][i].as_f64().unwrap());
    // constant loss: the time goes with Q + 1/Q
    close(least / time, 10.1 / 100.01, 1e-9);
    close(greatest / time, 1000.001 / 100.01, 1e-9);
}

/// A drag that takes angular momentum too, and a torque under which no average exists.
#[test]
fn slow_torques_are_averaged_and_others_refused() {
    let force = "[[force]]\nkind = \"spin-drag\"\ncoefficient = 1e3\n";
    let dragged = format!("{ASTEROID}{force}");
    let found = ran_with(&dragged, "evolve model.toml --duration 1e13 --format csv");
    let angular_momentum = Table::of(&found.stdout).column("momentum");
    assert!(angular_momentum.is_sorted_by(|a, b| a > b), "{angular_momentum:?}");
    assert_snapshot!(ran_with(&dragged, "evolve model.toml").refusal(), @r#"
    quasirigid: under a torque the rotation need not reach any target; say how long
    to follow it, with --duration or with evolve = { duration = "10 yr" } in [run]
    "#);
    let gravity = format!(
        "{ASTEROID}[[force]]\nname = \"pull\"\nkind = \"uniform-gravity\"\nacceleration = [0, 0, -1]\n"
    );
    assert_snapshot!(ran_with(&gravity, "evolve model.toml").refusal(), @r#"
    quasirigid: the force "pull" cannot be averaged over free rotations; those that
    can are a drag torque and a constant torque in body axes (kinds "spin-drag"
    and "torque")
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
    let quiet = ran_in(folder.path(), "evolve model.toml --from 0.95 --to 0.99 --quiet");
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
    quasirigid: --until: "5%" is neither a part of I3 nor an angle; write for example
    "98% of I3", 0.98 or "5 deg"
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

/// Observed periods are those of the motion that `simulate` starts.
#[test]
fn observed_periods_start_every_command() {
    let columns = ran("simulate examples/apophis/model.toml --times 0,946800 --quiet").stdout;
    let table = Table::of(&columns);
    let [start, after] = [0, 1].map(|row| table.vector(["wx", "wy", "wz"], row));
    for axis in 0..3 {
        assert!((start[axis] - after[axis]).abs() < 1e-8 * 6.4e-5, "{start:?} {after:?}"); // 263 h later
    }
}

/// The object, the text and the record have the same shares; a body with one dissipator has none.
#[test]
fn shares_of_dissipators_sum_to_one() {
    let file = "examples/friction-wheel/model.toml";
    for power in ["polynomial", "harmonics"] {
        let object = ran(&format!("evolve {file} --power {power} --json")).json();
        let shares = object["dissipation"].as_object().unwrap();
        let names: Vec<_> = shares.keys().map(String::as_str).collect();
        assert_eq!(names, ["damper wheel", "spring instrument-carrier"]);
        close(shares.values().map(|share| share.as_f64().unwrap()).sum(), 1.0, 1e-12);
        assert!(shares["damper wheel"].as_f64().unwrap() > 0.99, "{shares:?}");
    }
    let text = ran(&format!("evolve {file}")).stdout;
    let line = text.lines().find(|line| line.contains("what dissipates")).unwrap();
    assert_snapshot!(line, @"  what dissipates: damper wheel 100.0 %, spring instrument-carrier 0.00370 %");
    let folder = folder_with(ASTEROID);
    let object = ran_in(folder.path(), "evolve model.toml --json").json();
    assert_eq!(object["dissipation"], serde_json::json!({ "ellipsoid 1": 1.0 }));
    assert!(!ran_in(folder.path(), "evolve model.toml").stdout.contains("what dissipates"));
}

/// The wobble at the start and at the end is the same by every method: a long-axis and a short-axis mode. The remaining differences are
/// of the second order in the deformation, and of the polhode that stands for the level.
#[test]
fn run_and_evolve_tell_the_same_wobble() {
    for (name, duration, tolerance) in [("boom-satellite", 600, 5e-3), ("three-masses", 600, 2e-3)] {
        let folder = folder_of(name);
        let told = |line: &str| ran_in(folder.path(), &format!("{line} --duration {duration} --json"));
        let evolve = told("evolve model.toml").json();
        told("run model.toml --out spin");
        let table = Table::of(&fs::read_to_string(folder.path().join("spin/history-reduced.csv")).unwrap());
        for (column, observed) in [("nutation_min", "nutation_least"), ("nutation_max", "nutation_greatest")]
        {
            let values = table.column(column);
            for (row, end) in [(0, "start"), (values.len() - 1, "end")] {
                close(values[row], number(&evolve[end], observed), tolerance);
            }
        }
    }
}

/// A target wobble that is lost in rounding is called too small, not a separatrix.
#[test]
fn a_wobble_lost_in_rounding_is_called_too_small() {
    let ran = ran("evolve examples/boom-satellite/model.toml --until 1e-6deg");
    assert!(ran.stderr.replace('\n', " ").contains("is too small to be followed"), "{}", ran.stderr);
    assert!(!ran.stderr.contains("separatrix"), "{}", ran.stderr);
}

/// The separatrix is passed at one time, however few rows are asked for.
#[test]
fn rows_do_not_move_the_separatrix() {
    let [few, many] = ["2", "40"].map(|samples| {
        let line = format!("evolve examples/boom-satellite/model.toml --samples {samples} --json --quiet");
        ran(&line).json()
    });
    assert_eq!(few["separatrix_time"], many["separatrix_time"]);
    let [crossed, end] = ["separatrix_time", "time"].map(|key| few[key].as_f64().unwrap());
    assert!(0.3 < crossed / end && crossed / end < 0.32, "{crossed} of {end}");
}

/// A satellite whose mast changes the difference of its greatest moments, so that it is followed along levels of the slow energy.
const MAST: &str = "\
[carrier]
mass = 305.52
center_of_mass = [0.0172, 0.0123, -0.0065]
inertia = [96.998, 52.585, 54.064]
[[point]]
name = \"tip\"
mass = 3.5303
position = [-0.1582, 1.8961, 1.0941]
[[spring]]
from = \"tip\"
to = \"carrier\"
stiffness = 9220.4
damping = 2.006
[initial]
wobble = { angle = \"20.145 deg\", rate = 3.626, mode = \"short-axis\" }
";

/// Along levels of the slow energy the ratios of a record are those of its rows, and tell what the full system loses.
#[test]
fn ratios_on_levels_are_those_of_the_energy() {
    let record = ran_with(MAST, "evolve model.toml --duration 260 --json --quiet").json();
    assert_eq!(record["road"], "levels");
    let [start, end] = ["ratio_start", "ratio_end"].map(|key| number(&record, key));
    close(start, number(&record["start"], "energy_ratio").recip(), 1e-14);
    close(end, number(&record["end"], "energy_ratio").recip(), 1e-14);
    let line = "simulate model.toml --system full --duration 260 --samples 2 --json --quiet";
    let full = ran_with(MAST, line).json();
    let lost = number(&full, "dissipated");
    close((number(&full, "energy") + lost) * (1.0 - start / end), lost, 5e-3);
}
