//! Windows and timetables of forces: values that are read, and refusals of mistakes. (F13), (F14)

use quasirigid::elements::{ApplicationPoint, End};
use quasirigid::model::force::{Axes, ForceLaw, Interpolation, Timetable, Windows};
use quasirigid_io::model::Model;
use tempfile::TempDir;

use super::{CARRIER, POINT, read, refusal_of};

fn text(kind: &str, lines: &str) -> String {
    format!("[[force]]\nkind = \"{kind}\"\n{lines}")
}

/// The law of a force beside a table `burns.csv`, or the refusal.
fn tabled(csv: &str, kind: &str, lines: &str) -> Result<ForceLaw<ApplicationPoint>, String> {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("burns.csv"), csv).unwrap();
    let model = format!("{CARRIER}{POINT}{}", text(kind, &format!("timetable = \"burns.csv\"\n{lines}")));
    let found = Model::parse(&folder.path().join("model.toml"), &model);
    let place = folder.path().display().to_string();
    found.map(|model| model.assembly.forces[0].law.clone()).map_err(|error| {
        error.to_string().replace(&format!("{place}/"), "").replace(&format!("{place}\\"), "")
    })
}

const BURNS: &str = "t,x,y,z\n1,0.5,0,-2\n3.5,0,1e-3,0\n";

#[test]
fn windows_of_every_kind_are_read() {
    let read = |kind: &str, lines: &str| {
        let model = read(&format!("{CARRIER}{POINT}{}", text(kind, lines)));
        model.assembly.forces[0].law.clone()
    };
    let kinds = [
        ("uniform-gravity", "acceleration = [0, 0, -9.81]\n"),
        ("drag", "on = \"tip\"\ncoefficient = 1\n"),
        ("spin-drag", "coefficient = 1\n"),
        ("torque", "torque = [0, 0, 1]\n"),
        ("thrust", "on = \"tip\"\nforce = [0, 0, 1]\n"),
        ("magnetic-dipole", "moment = [0, 0, 1]\nfield = [1e-5, 0, 0]\n"),
        ("expression", "torque = [\"wx\", 0, 1]\n"),
    ];
    for (kind, lines) in kinds {
        let law = read(kind, &format!("{lines}during = [[\"1 min\", 60.5], [\"2 h\", \"3 h\"]]\n"));
        let windows = Windows::new(vec![[60.0, 60.5], [7200.0, 10800.0]]).unwrap();
        assert_eq!(law, ForceLaw::During { windows, law: Box::new(read(kind, lines)) }, "{kind}");
    }
}

#[test]
fn windows_that_mean_nothing_are_refused_in_their_place() {
    let refused =
        |windows: &str| refusal_of(&text("torque", &format!("torque = [0, 0, 1]\nduring = {windows}\n")));
    for (windows, message) in [
        ("[[1, 2], [5, 4]]", "window 2 ends at 4 s, which is not after its start at 5 s"),
        ("[[1, 3], [2, 4]]", "window 2 begins at 2 s, before window 1 ends at 3 s"),
        ("[]", "it is empty: the force would never act"),
        ("[1, 2]", ""),
    ] {
        let told = refused(windows);
        assert!(told.starts_with("model.toml:12:1") && told.contains(message), "{windows}: {told}");
    }
}

#[test]
fn timetables_are_read() {
    let rows = [(1.0, [0.5, 0.0, -2.0]), (3.5, [0.0, 1e-3, 0.0])];
    let table = |way| Timetable::new(&rows, way).unwrap();
    let [held, linear] = [Interpolation::Held, Interpolation::Linear].map(table);
    let found = |kind: &str, lines: &str| tabled(BURNS, kind, lines).unwrap();
    let body = ForceLaw::TorqueTable { table: held.clone(), axes: Axes::Body };
    assert_eq!(found("torque", ""), body);
    assert_eq!(found("expression", "interpolation = \"held\"\n"), body);
    let inertial = ForceLaw::TorqueTable { table: linear.clone(), axes: Axes::Inertial };
    assert_eq!(found("torque", "interpolation = \"linear\"\naxes = \"inertial\"\n"), inertial);
    let at = ApplicationPoint { on: End::Point(0), at: None };
    let thrust = ForceLaw::ForceTable { at, table: held.clone(), axes: Axes::Body };
    assert_eq!(found("thrust", "on = \"tip\"\n"), thrust);
    let force = ForceLaw::ForceTable { at, table: held, axes: Axes::Inertial };
    assert_eq!(found("expression", "on = \"tip\"\n"), force);
}

#[test]
fn timetables_that_mean_nothing_are_refused() {
    let refused = |csv: &str, lines: &str| tabled(csv, "torque", lines).unwrap_err();
    for (csv, lines, message) in [
        (BURNS, "torque = [0, 0, 1]\n", "`torque` beside a `timetable`"),
        (BURNS, "period = 3\n", "`period` beside a `timetable`"),
        (BURNS, "interpolation = \"cubic\"\n", "cubic"),
        ("t,x,y\n1,2,3\n", "", "the table has 3 columns, and 4 are needed"),
        ("time,x,y,z\n1,2,3,4\n", "", "the first column is named \"time\", and must be named \"t\""),
        ("t,x,y,z\n1,2,3,nan\n", "", "row 1 has \"nan\" where a finite number is needed"),
        ("t,x,y,z\n1,0,0,0\n1,0,0,1\n", "", "row 2 is at 1 s, which is not after 1 s in the row before"),
    ] {
        let told = refused(csv, lines);
        assert!(told.contains("model.toml:1") && told.contains(message), "{csv:?} {lines:?}: {told}");
    }
    let lone = refusal_of(&text("torque", "torque = [0, 0, 1]\ninterpolation = \"held\"\n"));
    assert!(lone.contains("`interpolation` is that of a `timetable`, and there is none"), "{lone}");
    let missing = refusal_of(&text("torque", "timetable = \"none.csv\"\n"));
    assert!(missing.contains("none.csv"), "{missing}");
}
