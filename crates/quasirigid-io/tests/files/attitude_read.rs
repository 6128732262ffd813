//! Attitude files read: what was written, the same attitude in every form of the standards, and files that are refused.

use std::fs;

use quasirigid_io::attitude::{AttitudeFormat, AttitudeHistory, Epoch, Labels, TimeSystem, read_attitude};
use quasirigid_io::record::history_csv;
use tempfile::TempDir;

use super::attitude::{history, labels, written};

fn read(name: &str, text: &str) -> Result<AttitudeHistory, String> {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, text).unwrap();
    let shown = |error: quasirigid_io::attitude::AttitudeError| {
        error.to_string().replace(&format!("{}/", folder.path().display()), "")
    };
    read_attitude(&file).map_err(shown)
}

/// Rows of the history that was written: attitude and angular velocity.
fn rows() -> Vec<([f64; 4], [f64; 3])> {
    let columns = history();
    let at = |row: usize, place: usize| columns[place].values[row];
    (0..2)
        .map(|row| ([4, 5, 6, 7].map(|place| at(row, place)), [1, 2, 3].map(|place| at(row, place))))
        .collect()
}

fn near(found: &AttitudeHistory, tolerance: f64) {
    assert_eq!(found.t, [0.0, 1e-6]);
    for (row, (attitude, omega)) in rows().into_iter().enumerate() {
        let same: f64 = found.attitude[row].iter().zip(attitude).map(|(a, b)| a * b).sum();
        assert!(1.0 - same.abs() < tolerance, "{:?} is not {attitude:?}", found.attitude[row]);
        if !found.angular_velocity.is_empty() {
            let off = found.angular_velocity[row].iter().zip(omega).map(|(a, b)| (a - b).abs());
            assert!(
                off.fold(0.0, f64::max) < tolerance.max(1e-15),
                "{:?} is not {omega:?}",
                found.angular_velocity[row]
            );
        }
    }
}

#[test]
fn what_is_written_is_read_back_to_the_digits_written() {
    for format in [AttitudeFormat::Aem, AttitudeFormat::Aem1, AttitudeFormat::Stk] {
        for rates in [true, false] {
            let found = read("spin", &written(format, &Labels { rates, ..labels() })).unwrap();
            near(&found, 4e-16);
            assert_eq!(found.angular_velocity.len(), if rates { 2 } else { 0 });
            assert_eq!(found.frame, "ICRF");
            assert_eq!(found.epoch, labels().epoch);
            assert_eq!(found.time_system, Some(TimeSystem::Utc));
        }
    }
    let mut csv = Vec::new();
    history_csv(&history(), &mut csv).unwrap();
    let found = read("history.csv", &String::from_utf8(csv).unwrap()).unwrap();
    near(&found, 4e-16);
    assert_eq!(found.angular_velocity.len(), 2);
}

const VERSION_1: &str = "CCSDS_AEM_VERS = 1.0
CREATION_DATE = 2026-01-02T00:00:00
ORIGINATOR = NOBODY
META_START
OBJECT_NAME = SPINNER
OBJECT_ID = 2026-001A
REF_FRAME_A = EME2000
REF_FRAME_B = SC_BODY_1
ATTITUDE_DIR = A2B
TIME_SYSTEM = TAI
START_TIME = 2026-001T00:00:00
STOP_TIME = 2026-001T00:00:00.000001
ATTITUDE_TYPE = QUATERNION/RATE
QUATERNION_TYPE = FIRST
RATE_FRAME = REF_FRAME_B
META_STOP
COMMENT records
DATA_START
";

/// A message of version 1 with changes, whose records are made of the rows.
fn message(changes: &[(&str, &str)], record: impl Fn(usize) -> Vec<f64>) -> String {
    let head = changes.iter().fold(VERSION_1.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let line = |row: usize| {
        let numbers: Vec<String> = record(row).iter().map(|number| format!("{number:.17e}")).collect();
        format!("2026-001T00:00:00.00000{row}Z {}\n", numbers.join("  "))
    };
    format!("{head}{}{}DATA_STOP\n", line(0), line(1))
}

/// Components of a vector of the body in the inertial axes, by the matrix of the attitude.
fn inertial([w, x, y, z]: [f64; 4], [a, b, c]: [f64; 3]) -> [f64; 3] {
    [
        (1.0 - 2.0 * (y * y + z * z)) * a + 2.0 * (x * y - w * z) * b + 2.0 * (x * z + w * y) * c,
        2.0 * (x * y + w * z) * a + (1.0 - 2.0 * (x * x + z * z)) * b + 2.0 * (y * z - w * x) * c,
        2.0 * (x * z - w * y) * a + 2.0 * (y * z + w * x) * b + (1.0 - 2.0 * (x * x + y * y)) * c,
    ]
}

/// Order of the numbers, direction, side of the body and axes of the rates do not change what a message says.
#[test]
fn every_form_of_a_message_gives_the_same_attitude() {
    let rates = |row: usize, sign: f64| rows()[row].1.map(|rate| sign * rate.to_degrees());
    let first = |row: usize| rows()[row].0;
    let back = |row: usize| {
        let [w, x, y, z] = first(row);
        [w, -x, -y, -z]
    };
    let last = |[w, x, y, z]: [f64; 4]| [x, y, z, w];
    let swapped = [("A = EME2000", "A = SC_BODY_1"), ("B = SC_BODY_1", "B = EME2000")];
    let last_type = ("TYPE = FIRST", "TYPE = LAST");
    let alone = [("QUATERNION/RATE", "QUATERNION"), ("RATE_FRAME = REF_FRAME_B\n", "")];
    let of = |a: &[f64], b: &[f64]| [a, b].concat();
    let texts = [
        message(&[], |row| of(&first(row), &rates(row, 1.0))),
        message(&[last_type], |row| of(&last(first(row)), &rates(row, 1.0))),
        message(&[("RATE_FRAME = REF_FRAME_B", "RATE_FRAME = EME2000")], |row| {
            of(&first(row), &inertial(first(row), rates(row, 1.0)))
        }),
        message(&[("A2B", "B2A"), alone[0], alone[1]], |row| back(row).to_vec()),
        message(&[("A2B", "B2A"), alone[0], alone[1], swapped[0], swapped[1]], |row| first(row).to_vec()),
        // the rates of frame B, now inertial, against frame A, the body, in axes of B
        message(&swapped, |row| of(&back(row), &inertial(first(row), rates(row, -1.0)))),
        message(
            &[
                ("VERS = 1.0", "VERS = 2.0"),
                ("ATTITUDE_DIR = A2B\n", ""),
                ("QUATERNION_TYPE = FIRST\n", ""),
                ("QUATERNION/RATE", "QUATERNION/ANGVEL"),
                ("RATE_FRAME = REF_FRAME_B", "ANGVEL_FRAME = SC_BODY_1"),
            ],
            |row| of(&last(first(row)), &rates(row, 1.0)),
        ),
    ];
    for text in texts {
        let found = read("spin.aem", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        near(&found, 1e-14);
        assert_eq!((found.object.as_str(), found.frame.as_str()), ("SPINNER", "EME2000"));
        assert_eq!(found.epoch, Some("2026-01-01".parse().unwrap()));
    }
    let step = |row: usize| {
        let [a, b] = [first(0), first(1)];
        of(&first(row), &std::array::from_fn::<f64, 4, _>(|i| (b[i] - a[i]) / 1e-6))
    };
    let found = read("spin.aem", &message(&[("QUATERNION/RATE", "QUATERNION/DERIVATIVE")], step)).unwrap();
    near(&found, 2e-6); // the difference over a step of 1e-6 s
}

/// Segments of one object follow each other; others are refused.
#[test]
fn segments_follow_each_other() {
    let one = message(&[], |row| [&rows()[row].0[..], &rows()[row].1.map(f64::to_degrees)].concat());
    let other = one[one.find("META_START").unwrap()..]
        .replace("001T00:00:00", "002T00:00:00")
        .replace("SPINNER", "spinner");
    let found = read("spin.aem", &format!("{one}{other}")).unwrap();
    assert_eq!(found.t, [0.0, 1e-6, 86_400.0, 86_400.000_001]);
    let refusals = [
        read("spin.aem", &format!("{one}{}", other.replace("spinner", "other"))),
        read("spin.aem", &format!("{one}{}", other.replace("EME2000", "ICRF"))),
        read("spin.aem", &format!("{one}{}", other.replace("TAI", "TDB"))),
        read("spin.aem", &format!("{one}{one}")),
        read("spin.aem", &format!("{one}{}", other.replace("002T00:00:00", "001T00:00:00"))),
    ];
    insta::assert_snapshot!(refusals.map(Result::unwrap_err).join("\n"), @r"
    spin.aem:34: OBJECT_NAME differs from that of the segment before; give each segment a file of its own
    spin.aem:34: REF_FRAME_A differs from that of the segment before; give each segment a file of its own
    spin.aem:34: TIME_SYSTEM differs from that of the segment before; give each segment a file of its own
    spin.aem:40: the time 0 s does not follow 0.000001 s; sort the records, and give each time once
    spin.aem:37: the time 0 s does not follow 0.000001 s; sort the records, and give each time once
    ");
}

#[test]
fn a_record_is_found_by_its_time_and_none_is_made() {
    let found = read("spin.a", &written(AttitudeFormat::Stk, &labels())).unwrap();
    assert_eq!(found.at(1e-6).unwrap().t, 0.0, "within a microsecond");
    assert_eq!(found.at(2e-6).unwrap().t, 1e-6);
    assert_eq!(found.at(0.5), Err([Some(1e-6), None]));
    assert_eq!(found.at(-0.5), Err([None, Some(0.0)]));
}

const STK: &str = "stk.v.12.2

# WrittenBy    somebody
BEGIN Attitude
   NumberOfAttitudePoints\t2
   ScenarioEpoch   1 Jun 2002 12:00:00.5
   BEGIN SegmentBoundaryTimes
      0.0
   END SegmentBoundaryTimes
   BlockingFactor 20
   CentralBody Earth
   CoordinateAxes Custom TopoCentric Facility/Here
   AttitudeTimeQuatScalarFirst
   0.0  0.6 0.0 0.8 0.0
   10.0  0.8 0.0 0.0 -0.6
END Attitude
";

#[test]
fn files_of_stk_are_read_with_other_blocks_and_comments() {
    let found = read("spin.a", STK).unwrap();
    assert_eq!(found.attitude, [[0.6, 0.0, 0.8, 0.0], [0.8, 0.0, 0.0, -0.6]]);
    assert_eq!(found.frame, "Custom TopoCentric Facility/Here");
    assert_eq!(found.epoch, Some("2002-06-01T12:00:00.5".parse::<Epoch>().unwrap()));
}

/// The body of an example in the help of STK 12 (AttitudeTimeQuatAngVels Format) spins at 6 deg/s about z from the axes J2000: after ten
/// seconds its quaternion is sin 30° along z. Quaternion and rate tell the same sense only as they are read here.
#[test]
fn a_spin_of_the_help_of_stk_has_the_sense_of_its_rate() {
    let text = "stk.v.5.0\nBEGIN Attitude\nCoordinateAxes J2000\nAttitudeTimeQuatAngVels\n\
                0 0 0 0 1 0 0 6\n1.000000000000e+001 0 0 5.000000000000e-001 8.660254037844e-001 0 0 6\nEND Attitude\n";
    let found = read("spin.a", text).unwrap();
    let [x, y, z] = inertial(found.attitude[1], [1.0, 0.0, 0.0]);
    let angle = y.atan2(x) / 10.0; // of the axis x of the body, in the plane across z
    assert!((angle - found.angular_velocity[1][2]).abs() < 1e-12 && z.abs() < 1e-12, "{angle}"); // 12 digits printed
}

#[test]
fn bad_files_are_refused_at_their_line() {
    let aem = message(&[], |row| [&rows()[row].0[..], &[0.0; 3]].concat());
    let aem = |from: &str, to: &str| {
        assert!(aem.contains(from), "{from}");
        read("a.aem", &aem.replacen(from, to, 1))
    };
    let stk = |from: &str, to: &str| {
        assert!(STK.contains(from), "{from}");
        read("a.a", &STK.replacen(from, to, 1))
    };
    let csv = |text: &str| read("a.csv", text);
    let told = [
        read("a.aem", ""),
        read("a.aem", "<?xml version=\"1.0\"?>"),
        read("a.aem", "CCSDS_AEM_VERS = 3.0\n"),
        read("a.aem", "CCSDS_AEM_VERS = 1.0\n"),
        aem("ORIGINATOR", "AUTHOR"),
        aem("OBJECT_NAME = SPINNER\n", ""),
        aem("REF_FRAME_B = SC_BODY_1\n", ""),
        aem("ATTITUDE_DIR = A2B\n", ""),
        aem("A2B", "A2C"),
        aem("A2B", "B2A"),
        aem("= TAI", "= SCLK"),
        aem("QUATERNION/RATE", "SPIN/NUTATION"),
        aem("RATE_FRAME = REF_FRAME_B", "RATE_FRAME = ICRF"),
        aem("RATE_FRAME = REF_FRAME_B\n", ""),
        aem("OBJECT_ID", "NAME_OF_OBJECT"),
        aem("DATA_START\n", ""),
        aem("DATA_STOP\n", ""),
        aem("2026-001T00:00:00.000001Z", "2026-400T00:00:00"),
        aem("2026-001T00:00:00.000001Z", "2026-001T00:00:00"),
        aem("2026-001T00:00:00.000001Z", "2026-001T00:00:00.000001 1.0"),
        aem("2026-001T00:00:00.000001Z", "2026-001T00:00:00.000001 inf"),
        aem("2026-001T00:00:00.000001Z ", "2026-001T00:00:00.000001 5"),
        stk("Points\t2", "Points 3"),
        stk("Points\t2", "Points two"),
        stk("1 Jun", "1 Jum"),
        stk("AttitudeTimeQuatScalarFirst", "AttitudeTimeYPRAngles"),
        stk("   BlockingFactor 20", "   TimeFormat UTCG"),
        stk("   BlockingFactor 20", "   20"),
        stk("10.0  0.8", "10.0  0.8 0.1"),
        stk("END Attitude\n", ""),
        stk("   END SegmentBoundaryTimes\n", ""),
        csv("t,qw,qx,qy\n0,1,0,0\n"),
        csv("t,qw,qx,qy,qz,wx\n0,1,0,0,0,1\n"),
        csv("t,qw,qx,qy,qz\n0,1,0,0,x\n"),
        csv("t,qw,qx,qy,qz\n"),
        csv("t,qw,qx,qy,qz\n0,1,0,0\n"),
        csv("t,qw,qx,qy,qz\n1,1,0,0,0\n0,1,0,0,0\n"),
    ];
    insta::assert_snapshot!(told.map(Result::unwrap_err).join("\n"), @r#"
    a.aem: this begins neither as an AEM (CCSDS_AEM_VERS) nor as an attitude file of STK (stk.v.), and is no table; give one of these
    a.aem: this begins neither as an AEM (CCSDS_AEM_VERS) nor as an attitude file of STK (stk.v.), and is no table; save the message as keywords and values (KVN), not as XML
    a.aem:1: CCSDS_AEM_VERS = "3.0" is not read; the versions are 1.0 and 2.0
    a.aem:1: the file ends here; a segment begins with META_START; was it cut off in writing or copying?
    a.aem:3: "AUTHOR = NOBODY" is not allowed here; a segment begins with META_START
    a.aem:15: OBJECT_NAME is missing before this line; add it
    a.aem:15: REF_FRAME_B is missing before this line; add it
    a.aem:15: ATTITUDE_DIR is missing before this line; add it
    a.aem:9: ATTITUDE_DIR = "A2C" is not read; write A2B or B2A
    a.aem:16: ATTITUDE_DIR = "B2A" is not read; the standard does not say which frame turns at these rates; write A2B, or leave the rates out
    a.aem:10: TIME_SYSTEM = "SCLK" is not read; epochs of a calendar are: UTC, TAI, TT, TDB, GPS, TCB, TCG or UT1
    a.aem:13: ATTITUDE_TYPE = "SPIN/NUTATION" is not read; write quaternions: QUATERNION, QUATERNION/DERIVATIVE or QUATERNION/ANGVEL
    a.aem:16: RATE_FRAME = "ICRF" is not read; name one of the two frames of the segment
    a.aem:15: RATE_FRAME is missing before this line; add it
    a.aem:6: "NAME_OF_OBJECT" is not allowed here; a line is KEYWORD = value, COMMENT text, META_STOP or DATA_STOP
    a.aem:18: "2026-001T00:00:00.000000Z 9.39372712847378888e-1  1.14299269151817109e-1  -2.28598538303634219e-1  2.28598538303634219e-…" is not allowed here; a line is KEYWORD = value, COMMENT text, META_STOP or DATA_STOP
    a.aem:20: the file ends here; a line is KEYWORD = value, COMMENT text, META_STOP or DATA_STOP; was it cut off in writing or copying?
    a.aem:20: "2026-400T00:00:00": no epoch; write 2026-01-01T00:00:00, or in STK 1 Jan 2026 00:00:00.0, with a second below 60
    a.aem:20: the time 0 s does not follow 0 s; sort the records, and give each time once
    a.aem:20: 8 values; a record is the epoch and QC Q1 Q2 Q3 with the three rates in deg/s
    a.aem:20: "inf" is not a finite number; a record is the epoch and QC Q1 Q2 Q3 with the three rates in deg/s
    a.aem:20: the quaternion has the norm 5.9492626565759865, but an attitude is a unit quaternion; is the order of the columns right?
    a.a: 2 records, but NumberOfAttitudePoints is 3; was the file cut off?
    a.a:5: NumberOfAttitudePoints = "two" is not read; write their number
    a.a:6: "1 Jum 2002 12:00:00.5": no epoch; write 2026-01-01T00:00:00, or in STK 1 Jan 2026 00:00:00.0, with a second below 60
    a.a:13: the format = "AttitudeTimeYPRAngles" is not read; write AttitudeTimeQuaternions or AttitudeTimeQuatAngVels
    a.a:10: TimeFormat = "UTCG" is not read; write the times as seconds since ScenarioEpoch, EpSec
    a.a:10: "20" is not allowed here; a line is a keyword of STK and its value
    a.a:15: 6 values; a record is the time in seconds and q4 q1 q2 q3, scalar first
    a.a:15: the file ends here; a line is a keyword of STK and its value; was it cut off in writing or copying?
    a.a:15: the file ends here; a line is a keyword of STK and its value; was it cut off in writing or copying?
    a.csv: there is no column "qz"; a history has t, qw, qx, qy and qz, and perhaps wx, wy and wz
    a.csv: there is no column "wy"; a history has t, qw, qx, qy and qz, and perhaps wx, wy and wz
    a.csv: row 1, column "qz": "x" is not a finite number
    a.csv: the file has no records; was it cut off in writing or copying?
    a.csv: line 2 of the table has 4 values, but the header has 5; mend the line
    a.csv: the time 0 s does not follow 1 s; sort the records, and give each time once
    "#);
}

#[test]
fn epochs_of_utc_on_both_sides_of_a_leap_second_are_refused() {
    let utc = message(
        &[("TAI", "UTC"), ("QUATERNION/RATE", "QUATERNION"), ("RATE_FRAME = REF_FRAME_B\n", "")],
        |row| rows()[row].0.to_vec(),
    );
    let text = utc
        .replace("2026-001T00:00:00.000000", "2016-366T00:00:00")
        .replace("2026-001T00:00:00.000001", "2017-001T00:00:00");
    let error = read("a.aem", &text).unwrap_err();
    assert_eq!(
        error,
        "a.aem:19: a leap second ends at 2017-01-01T00:00:00.000 UTC, within the history; give the epochs in TAI"
    );
}
