//! Histories of other programs: spellings, units and digits in text, the same numbers in other formats, and what is refused.

use std::fs;

use quasirigid_io::array_file::{ArrayFormat, ArrayValue, NamedArray};
use quasirigid_io::history_file::{HistoryFile, QuaternionOrder, Resolution, read_history};
use quasirigid_io::table_file::{CellColumn, Cells, write_parquet};
use tempfile::TempDir;

fn read(name: &str, bytes: impl AsRef<[u8]>) -> Result<HistoryFile, String> {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, bytes).unwrap();
    let place = folder.path().display().to_string() + "/";
    read_history(&file).map_err(|error| error.to_string().replace(&place, ""))
}

#[track_caller]
fn of(text: &str) -> HistoryFile {
    read("spin.csv", text).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn headings_name_columns_and_units() {
    let found =
        of("note;Time (ms);gyro_x [deg/s];gyro_y [deg/s];gyro_z [deg/s]\na;0;90,5;0;0\nb;500;90,25;-1,5;0\n");
    assert_eq!(found.t, [0.0, 0.5]);
    assert!((found.rates[1][1] + 1.5_f64.to_radians()).abs() < 1e-15);
    assert_eq!((found.time_unit.as_deref(), found.rate_unit.as_deref()), (Some("ms"), Some("deg/s")));
    assert_eq!(found.resolution, Resolution::Decimal { decimals: 2, significant: 4 });
    assert!((found.rounding(0)[0] - 0.005_f64.to_radians()).abs() < 1e-12, "{:?}", found.rounding(0));
    let blanks = of("# t wx wy wz q0 q1 q2 q3\n0 0.1 0.2 0.3 1 0 0 0\n1 0.1 0.2 0.3 0.8 0.6 0 0\n");
    assert_eq!((blanks.order, blanks.attitude.len()), (QuaternionOrder::Unknown, 2));
    let named = of("t,qx,qy,qz,qw,wx,wy,wz\n0,0,0,0.6,0.8,1,2,3\n");
    assert_eq!(
        (named.order, named.attitude[0], named.rates[0]),
        (QuaternionOrder::ScalarFirst, [0.8, 0.0, 0.0, 0.6], [1.0, 2.0, 3.0])
    );
    // a half turn about z: tan(π/4)
    let rodrigues = of("t,wx,wy,wz,sigma_1,sigma_2,sigma_3\n0,0,0,1,0,0,0.5\n").attitude[0];
    assert!((rodrigues[0] - 0.6).abs() < 1e-15 && (rodrigues[3] - 0.8).abs() < 1e-15);
}

#[test]
fn parquet_and_arrays_hold_the_same_history() {
    let t = [0.0, 0.1, 0.2];
    let rates = [[0.1, 0.2, 0.3], [0.11, 0.19, 0.3], [0.12, 0.18, 0.3]];
    let column = |name: &str, values: Vec<f64>| CellColumn {
        name: name.into(),
        unit: String::new(),
        cells: Cells::Numbers(values.into_iter().map(Some).collect()),
    };
    let axis = |axis: usize| rates.iter().map(|rate| rate[axis]).collect::<Vec<_>>();
    let columns =
        [column("t", t.to_vec()), column("wx", axis(0)), column("wy", axis(1)), column("wz", axis(2))];
    let mut parquet = Vec::new();
    write_parquet("spin.parquet".as_ref(), &mut parquet, &columns, &[]).unwrap();
    let matrix = |size, entries: Vec<f64>| ArrayValue::Matrix { size, entries };
    let arrays = [
        NamedArray { name: "t".into(), value: matrix([3, 1], t.to_vec()) },
        NamedArray { name: "omega".into(), value: matrix([3, 3], rates.concat()) },
        NamedArray { name: "note".into(), value: ArrayValue::Text("x".into()) },
    ];
    let arrays = ArrayFormat::Npz.bytes(&arrays).unwrap();
    for (name, bytes) in [("spin.parquet", parquet), ("spin.npz", arrays)] {
        let found = read(name, bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((found.t.as_slice(), found.rates.as_slice()), (&t[..], &rates[..]), "{name}");
        assert_eq!(found.resolution, Resolution::Double);
    }
}

#[test]
fn an_attitude_file_with_rates_is_a_history() {
    let stk = "stk.v.11.0\nBEGIN Attitude\nNumberOfAttitudePoints 2\nScenarioEpoch 1 Jan 2026 00:00:00.0\n\
               CoordinateAxes ICRF\nAttitudeTimeQuatAngVels\n0 0 0 0 1 1.5 0.25 30\n1 0 0 0.6 0.8 1.5 0.25 30\nEND Attitude\n";
    let found = read("spin.a", stk).unwrap();
    assert!((found.rates[0][2] - 30_f64.to_radians()).abs() < 1e-15);
    assert_eq!(found.resolution, Resolution::Decimal { decimals: 2, significant: 16 });
    let without =
        stk.replace("AttitudeTimeQuatAngVels", "AttitudeTimeQuaternions").replace(" 1.5 0.25 30", "");
    let alone = read("spin.a", without).unwrap();
    assert_eq!((alone.rates.len(), alone.rate_unit, alone.attitude.len()), (0, None, 2));
    assert_eq!(alone.attitude[1], [0.8, 0.0, 0.0, 0.6]);
}

#[test]
fn a_table_of_attitudes_alone_is_a_history() {
    let alone = of("t [ms],qw,qx,qy,qz\n0,1,0,0,0\n500,0.96,0,0,0.28\n");
    assert_eq!((alone.t.as_slice(), alone.rates.len()), (&[0.0, 0.5][..], 0));
    assert_eq!(alone.attitude, [[1.0, 0.0, 0.0, 0.0], [0.96, 0.0, 0.0, 0.28]]);
    assert!((alone.attitude_rounding - 0.05).abs() < 1e-15, "{}", alone.attitude_rounding);
    // rates of which a part is missing are no attitude alone, and nothing at all asks for rates
    let whole = "t,wx,wy,qw,qx,qy,qz\n0,1,2,1,0,0,0\n";
    assert!(read("spin.csv", whole).unwrap_err().contains("no column is the z component"));
    assert!(read("spin.csv", "t,qw,qx,qy\n0,1,0,0\n").unwrap_err().contains("or t, qw, qx, qy, qz"));
}

#[test]
fn what_is_no_history_is_refused_with_its_line() {
    for (text, words) in [
        ("t,wx,wy,wz\n0,1,2,3\n1,1,nan,3\n", "spin.csv:3: wy: \"nan\" is not a finite number"),
        (
            "t,wx,wy,wz\n0,1,2,3\n1,1,2\n",
            "spin.csv:3: 3 values where the heading has 4; was the file cut off",
        ),
        ("t,wx,wy,wz\n", "spin.csv: the table has no rows"),
        ("t,wx,wy,wz\n1,1,2,3\n1,1,2,3\n", "row 2: the time 1 does not follow 1"),
        ("t,wx,wy,wz\n1,1,2,3\n0,1,2,3\n", "row 2: the time 0 does not follow 1"),
        ("t,wx,wy\n0,1,2\n", "no column is the z component of the angular velocity"),
        ("x,wx,wy,wz\n0,1,2,3\n", "no column is the time; there are \"x\", \"wx\""),
        (
            "t,wx,wy,wz,gyro_x\n0,1,2,3,4\n",
            "\"wx\" and \"gyro_x\" are both a component of the angular velocity",
        ),
        ("t,wx [m/s],wy [m/s],wz [m/s]\n0,1,2,3\n", "\"m/s\" is no unit of an angular velocity"),
        ("t,wx [deg/s],wy [rad/s],wz [rad/s]\n0,1,2,3\n", "write them in one unit"),
        ("t,wx,wy,wz,qw,qx,qy,qz\n0,1,2,3,1,1,0,0\n", "row 1: the quaternion has the norm 1.414"),
        ("0,1,2,3\n1,1,2,3\n", "no column is the time"),
        ("", "spin.csv: "),
        ("<!doctype html><p>t,wx</p>\n", "this is a web page"),
    ] {
        let message = read("spin.csv", text).expect_err(text);
        assert!(message.contains(words), "{text}: {message}");
    }
    assert!(
        read_history("/no/such/file.csv".as_ref()).unwrap_err().to_string().contains("is the name right")
    );
}
