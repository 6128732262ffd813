//! Attitude files of other programs.

use std::io::Cursor;

use quasirigid_io::attitude::{AttitudeFormat, Epoch, InertialFrame, Labels, TimeSystem, read_attitude};
use quasirigid_io::record::Column;

use super::disk::with_file;

pub const AEM: &[&str] = &[
    "CCSDS_AEM_VERS = ",
    "META_START\n",
    "META_STOP\n",
    "DATA_START\n",
    "DATA_STOP\n",
    "REF_FRAME_A = ",
    "ATTITUDE_DIR = B2A\n",
    "QUATERNION/DERIVATIVE",
    "2026-001T00:00:00.5Z",
    "COMMENT ",
];
pub const STK: &[&str] = &[
    "stk.v.11.0\n",
    "BEGIN Attitude\n",
    "END Attitude",
    "ScenarioEpoch 1 Jan 2026 00:00:00.0\n",
    "AttitudeTimeQuatAngVels\n",
    "BEGIN ",
];

/// Reads a file; what it has is found again, and can be written.
pub fn read(name: &str, bytes: &[u8]) {
    with_file(name, bytes, |path| match read_attitude(path) {
        Ok(history) => {
            let rows = history.t.len();
            assert!(rows > 0 && history.attitude.len() == rows, "every time has an attitude");
            assert!([0, rows].contains(&history.angular_velocity.len()), "all records have rates, or none");
            assert!(history.t.is_sorted(), "times ascend");
            assert!(
                history.attitude.iter().flatten().all(|part| part.abs() <= 1.0 + 1e-12),
                "unit quaternions"
            );
            assert_eq!(history.at(history.t[0]).map(|record| record.t), Ok(history.t[0]));
            write(&history.t, &history.attitude);
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}

fn write(t: &[f64], attitude: &[[f64; 4]]) {
    let column = |name: &str, values| Column { name: name.into(), unit: "1".into(), values };
    let mut columns = vec![column("t", t.to_vec())];
    for (part, name) in ["qw", "qx", "qy", "qz"].into_iter().enumerate() {
        columns.push(column(name, attitude.iter().map(|four| four[part]).collect()));
    }
    let labels = Labels {
        object: "é".into(),
        epoch: None,
        time_system: TimeSystem::TDB,
        frame: InertialFrame::Icrf,
        rates: true,
        created: Epoch::J2000,
    };
    let written = AttitudeFormat::Aem.write(&mut Cursor::new(Vec::new()), (&labels, None), (&columns, None));
    if let Err(error) = written {
        assert!(!error.to_string().is_empty()); // times closer than a picosecond, or beyond the calendar
    }
}
