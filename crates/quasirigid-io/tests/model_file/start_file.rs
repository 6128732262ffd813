//! The start of a model from an attitude file.

use std::fs;

use insta::assert_snapshot;
use quasirigid_io::model::{Model, Rotation};
use tempfile::TempDir;

use super::{CARRIER, POINT};

/// A quarter turn about z, then one about x, of a body that spins off its axes at rates in deg/s.
const AEM: &str = "CCSDS_AEM_VERS = 2.0
CREATION_DATE = 2026-01-02T00:00:00
ORIGINATOR = NOBODY
META_START
OBJECT_NAME = SPINNER
OBJECT_ID = UNKNOWN
REF_FRAME_A = EME2000
REF_FRAME_B = SC_BODY_1
TIME_SYSTEM = UTC
START_TIME = 2026-01-01T00:00:00
STOP_TIME = 2026-01-01T00:00:10
ATTITUDE_TYPE = QUATERNION/ANGVEL
ANGVEL_FRAME = SC_BODY_1
META_STOP
DATA_START
2026-01-01T00:00:00 0 0 0.7071067811865476 0.7071067811865476 180 -90 45
2026-01-01T00:00:10 0.7071067811865476 0 0 0.7071067811865476 90 18 -36
DATA_STOP
";
const STK: &str = "stk.v.11.0
BEGIN Attitude
ScenarioEpoch 1 Jan 2026 00:00:00.0
CoordinateAxes ICRF
AttitudeTimeQuaternions
5 0 0 0.6 0.8
END Attitude
";

/// The model with these lines of `[initial]`, beside the files.
fn started(lines: &str, changes: &[(&str, &str)]) -> Result<Model, String> {
    let folder = TempDir::new().unwrap();
    let changed = changes.iter().fold(AEM.to_owned(), |text, (from, to)| text.replace(from, to));
    fs::write(folder.path().join("spin.aem"), changed).unwrap();
    fs::write(folder.path().join("spin.a"), STK).unwrap();
    fs::write(folder.path().join("spin.csv"), "t,qw,qx,qy,qz,wx,wy,wz\n2,0.8,0,0.6,0,1,2,3\n").unwrap();
    let file = folder.path().join("model.toml");
    fs::write(&file, format!("{CARRIER}{POINT}[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600\n[initial]\n{lines}")).unwrap();
    Model::read(&file)
        .map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

fn refused(lines: &str) -> String {
    started(lines, &[]).expect_err("a refusal")
}

fn spin(model: &Model) -> [f64; 3] {
    match model.initial.rotation {
        Some(Rotation::Spin(omega)) => omega,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_model_starts_from_a_record_of_a_file() {
    use std::f64::consts::{FRAC_1_SQRT_2, PI};
    let near = |found: &[f64], expected: &[f64]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?} {expected:?}"); // rounding
    };
    let first = started("from = \"spin.aem\"\n", &[]).unwrap();
    near(&first.initial.attitude, &[FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2]);
    near(&spin(&first), &[PI, -0.5 * PI, 0.25 * PI]);
    assert!(first.notes.is_empty(), "{:?}", first.notes);
    assert!(first.files.iter().any(|file| file.path.ends_with("spin.aem") && file.bytes == AEM.len() as u64));
    for at in ["\"2026-01-01T00:00:10\"", "10", "\"10 s\"", "\"2026-001T00:00:10Z\""] {
        let later = started(&format!("from = \"spin.aem\"\nat = {at}\n"), &[]).unwrap();
        near(&later.initial.attitude, &[FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0, 0.0]);
        near(&spin(&later), &[0.5 * PI, 0.1 * PI, -0.2 * PI]);
    }
    let stk = started("from = \"spin.a\"\nangular_velocity = [1, 2, 3]\nat = \"2026-01-01T00:00:05\"\n", &[])
        .unwrap();
    near(&stk.initial.attitude, &[0.8, 0.0, 0.0, 0.6]);
    near(&spin(&stk), &[1.0, 2.0, 3.0]);
    let table = started("from = \"spin.csv\"\nat = 2\n", &[]).unwrap();
    near(&table.initial.attitude, &[0.8, 0.0, 0.6, 0.0]);
    near(&spin(&table), &[1.0, 2.0, 3.0]);
}

#[test]
fn axes_that_are_not_known_are_noted() {
    let model = started("from = \"spin.aem\"\n", &[("EME2000", "MY_AXES")]).unwrap();
    assert_eq!(model.notes, ["the axes MY_AXES of the attitude file are taken as inertial"]);
}

#[test]
fn starts_that_are_told_twice_or_not_at_all_are_refused() {
    assert_snapshot!(refused("at = 3\n"), @r#"
    model.toml:14:6: `at` is a time of a file, and there is none
      add from = "spin.aem"
    "#);
    assert_snapshot!(refused("from = \"spin.aem\"\nattitude = [1, 0, 0, 0]\n"), @r"
    model.toml:15:12: `from` and `attitude` both give the attitude
      leave out one of the two
    ");
    assert_snapshot!(refused("from = \"spin.aem\"\nangular_velocity = [1, 0, 0]\n"), @r"
    model.toml:15:20: `from` and `angular_velocity` both give the rotation
      leave it out, or give a file without angular velocities
    ");
    assert_snapshot!(refused("from = \"spin.a\"\n"), @r"
    model.toml:14:8: `from`: the file has no angular velocities
      write angular_velocity, periods or wobble, too
    ");
    assert_snapshot!(refused("from = \"none.aem\"\n"), @r"
    model.toml:14:8: `from`: none.aem: entity not found; is the name right, and is the file readable?
      the file is looked for beside the model: an AEM, an attitude file of STK, or a table of a history
    ");
    assert_snapshot!(refused("from = \"spin.aem\"\nat = 4\n"), @r"
    model.toml:15:6: `at`: the file has no record at this time, and none is made between two
      the records beside it are at 0 s and 10 s
    ");
    assert_snapshot!(refused("from = \"spin.aem\"\nat = \"2026-01-01T00:00:04\"\n"), @r"
    model.toml:15:6: `at`: the file has no record at this time, and none is made between two
      the records beside it are at 2026-01-01T00:00:00.000 and 2026-01-01T00:00:10.000
    ");
    assert_snapshot!(refused("from = \"spin.aem\"\nat = \"2016-01-01T00:00:04\"\n"), @r"
    model.toml:15:6: `at`: a leap second ends at 2017-01-01T00:00:00.000 UTC, between the start of the file and this epoch
      write the seconds since the start of the file
    ");
    assert_snapshot!(refused("from = \"spin.csv\"\nat = \"2026-01-01T00:00:04\"\n"), @r"
    model.toml:15:6: `at` is an epoch, and the file has none
      write the time of the row in seconds
    ");
    let rotating = started("from = \"spin.aem\"\n", &[("EME2000", "ITRF-93")]).unwrap_err();
    assert_snapshot!(rotating, @r"
    model.toml:14:8: `from`: the attitudes are against ITRF-93, which rotate
      write the file against inertial axes, such as ICRF
    ");
}
