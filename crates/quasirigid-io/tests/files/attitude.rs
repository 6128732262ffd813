//! Attitude files written: what each format says of a body that turns about no axis of its own, by the formulas of its own documents.

use std::io::Cursor;

use quasirigid_io::attitude::{AttitudeFormat, InertialFrame, Labels, TimeSystem, Unwritten};
use quasirigid_io::record::Column;

/// Axis and angle that the body has turned from the inertial axes, and its angular velocity (rad/s), body axes.
const AXIS: [f64; 3] = [1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0];
const ANGLE: f64 = 0.7;
const OMEGA: [f64; 3] = [0.3, -0.2, 0.5];
/// Step between the two rows (s), so small that the mean rate is the rate to six digits.
const STEP: f64 = 1e-6;

pub fn labels() -> Labels {
    Labels {
        object: "boom satellite".into(),
        epoch: Some("2026-01-01T00:00:00".parse().unwrap()),
        time_system: TimeSystem::Utc,
        frame: InertialFrame::Icrf,
        rates: true,
        created: "2026-01-02T03:04:05".parse().unwrap(),
    }
}

/// A vector turned about an axis (Rodrigues).
fn turned(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let [a, b, c] = axis;
    let cross = [b * v[2] - c * v[1], c * v[0] - a * v[2], a * v[1] - b * v[0]];
    let along = a * v[0] + b * v[1] + c * v[2];
    let (sin, cos) = angle.sin_cos();
    std::array::from_fn(|i| v[i] * cos + cross[i] * sin + axis[i] * along * (1.0 - cos))
}

/// Hamilton's product.
fn product(p: [f64; 4], q: [f64; 4]) -> [f64; 4] {
    let ([a, b, c, d], [e, f, g, h]) = (p, q);
    [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]
}

fn about(axis: [f64; 3], angle: f64) -> [f64; 4] {
    let (sin, cos) = (0.5 * angle).sin_cos();
    [cos, sin * axis[0], sin * axis[1], sin * axis[2]]
}

/// A history of two rows: the body turned, and turned on in its own axes for a step.
pub fn history() -> Vec<Column> {
    let first = about(AXIS, ANGLE);
    let rate = OMEGA.iter().map(|part| part * part).sum::<f64>().sqrt();
    let second = product(first, about(OMEGA.map(|part| part / rate), rate * STEP));
    let column = |name: &str, values: [f64; 2]| Column {
        name: name.into(),
        unit: "1".into(),
        values: values.to_vec(),
    };
    let mut columns = vec![column("t", [0.0, STEP])];
    columns.extend(["wx", "wy", "wz"].iter().zip(OMEGA).map(|(name, part)| column(name, [part; 2])));
    columns.extend(
        ["qw", "qx", "qy", "qz"].iter().enumerate().map(|(i, name)| column(name, [first[i], second[i]])),
    );
    columns
}

pub fn written(format: AttitudeFormat, labels: &Labels) -> String {
    String::from_utf8(bytes(format, labels, &history()).unwrap()).unwrap()
}

pub fn bytes(format: AttitudeFormat, labels: &Labels, columns: &Vec<Column>) -> Result<Vec<u8>, Unwritten> {
    let mut out = Cursor::new(Vec::new());
    format.write(&mut out, (labels, Some("{}")), (columns, None))?;
    Ok(out.into_inner())
}

type Matrix = [[f64; 3]; 3];

/// Whether a matrix takes inertial components to those of the body: each axis of the body, turned as a vector, to its own unit vector.
fn takes_to_body(matrix: Matrix) {
    for axis in 0..3 {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        let inertial = turned(unit, AXIS, ANGLE);
        for (i, row) in matrix.iter().enumerate() {
            let found: f64 = row.iter().zip(inertial).map(|(a, b)| a * b).sum();
            assert!((found - unit[i]).abs() < 1e-14, "axis {axis}: {found} is not {}", unit[i]); // rounding of ten terms
        }
    }
}

/// Whether the matrices of two rows are a step of the angular velocity apart, which turns the axes of the body: dM/dt = -[ω×] M.
fn turns_at(matrices: [Matrix; 2], omega: [f64; 3]) {
    let [x, y, z] = omega;
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    for i in 0..3 {
        for j in 0..3 {
            let expected: f64 = -(0..3).map(|k| cross[i][k] * matrices[0][k][j]).sum::<f64>();
            let found = (matrices[1][i][j] - matrices[0][i][j]) / STEP;
            assert!((found - expected).abs() < 2e-6, "{found} is not {expected}"); // a step of 1e-6 s
        }
    }
}

/// Direction cosine matrix of a quaternion, scalar last: 504.0-B-1, annex on conventions; Wertz 1978, (12-13a). STK documents the same.
fn of_scalar_last([q1, q2, q3, q4]: [f64; 4]) -> Matrix {
    [
        [q1 * q1 - q2 * q2 - q3 * q3 + q4 * q4, 2.0 * (q1 * q2 + q3 * q4), 2.0 * (q1 * q3 - q2 * q4)],
        [2.0 * (q1 * q2 - q3 * q4), -q1 * q1 + q2 * q2 - q3 * q3 + q4 * q4, 2.0 * (q2 * q3 + q1 * q4)],
        [2.0 * (q1 * q3 + q2 * q4), 2.0 * (q2 * q3 - q1 * q4), -q1 * q1 - q2 * q2 + q3 * q3 + q4 * q4],
    ]
}

/// C-matrix of a quaternion of SPICE: Q2M of the toolkit.
fn of_spice([q0, q1, q2, q3]: [f64; 4]) -> Matrix {
    [
        [1.0 - 2.0 * (q2 * q2 + q3 * q3), 2.0 * (q1 * q2 - q0 * q3), 2.0 * (q1 * q3 + q0 * q2)],
        [2.0 * (q1 * q2 + q0 * q3), 1.0 - 2.0 * (q1 * q1 + q3 * q3), 2.0 * (q2 * q3 - q0 * q1)],
        [2.0 * (q1 * q3 - q0 * q2), 2.0 * (q2 * q3 + q0 * q1), 1.0 - 2.0 * (q1 * q1 + q2 * q2)],
    ]
}

/// [BN] of modified Rodrigues parameters: Schaub and Junkins, Analytical Mechanics of Space Systems, (3.147).
fn of_rodrigues(sigma: [f64; 3]) -> Matrix {
    let [x, y, z] = sigma;
    let cross = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let square: f64 = sigma.iter().map(|part| part * part).sum();
    let whole = (1.0 + square) * (1.0 + square);
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let twice: f64 = (0..3).map(|k| cross[i][k] * cross[k][j]).sum();
            f64::from(u8::from(i == j)) + (8.0 * twice - 4.0 * (1.0 - square) * cross[i][j]) / whole
        })
    })
}

/// Numbers of the lines that have some behind their first word.
fn numbers(text: &str) -> Vec<Vec<f64>> {
    let line =
        |line: &str| -> Option<Vec<f64>> { line.split(' ').skip(1).map(|word| word.parse().ok()).collect() };
    text.lines().filter_map(line).filter(|row| row.len() == 7).collect()
}

/// Attitude and rate of both rows by a matrix and a unit of the rates.
fn shows(rows: &[Vec<f64>], matrix: fn([f64; 4]) -> Matrix, rate: f64) {
    let [first, second] = [0, 1].map(|row| matrix(std::array::from_fn(|i| rows[row][i])));
    takes_to_body(first);
    turns_at([first, second], std::array::from_fn(|i| rows[0][4 + i] * rate));
}

#[test]
fn quaternions_turn_as_the_documents_of_each_format_say() {
    let degree = std::f64::consts::PI / 180.0;
    for format in [AttitudeFormat::Aem, AttitudeFormat::Aem1, AttitudeFormat::Stk] {
        shows(&numbers(&written(format, &labels())), of_scalar_last, degree);
    }
    shows(&numbers(&written(AttitudeFormat::Msopck, &labels())), of_spice, 1.0);
}

/// Numbers of an array of the archive, whose header ends with a line.
fn array(archive: &[u8], name: &str) -> (String, Vec<[u8; 8]>) {
    let mut zip = zip::ZipArchive::new(Cursor::new(archive)).unwrap();
    let mut bytes = Vec::new();
    std::io::copy(&mut zip.by_name(name).unwrap(), &mut bytes).unwrap();
    let end = bytes.iter().position(|byte| *byte == b'\n').unwrap();
    let header = String::from_utf8_lossy(&bytes[10..end]).into_owned();
    (header, bytes[end + 1..].as_chunks().0.to_vec())
}

#[test]
fn basilisk_has_nanoseconds_and_modified_rodrigues_parameters() {
    let mut columns = history();
    let longer = |columns: &mut Vec<Column>| columns[4..].iter_mut().for_each(|part| part.values[1] *= -1.0);
    longer(&mut columns); // the other quaternion of the same attitude
    let archive = bytes(AttitudeFormat::Basilisk, &labels(), &columns).unwrap();
    let (header, times) = array(&archive, "times.npy");
    assert!(header.contains("'descr': '<i8'") && header.contains("'shape': (2,)"), "{header}");
    assert_eq!(times.map_each(i64::from_le_bytes), [0, 1000]);
    let (header, sigma) = array(&archive, "sigma_BN.npy");
    assert!(header.contains("'descr': '<f8'") && header.contains("'shape': (2, 3)"), "{header}");
    let sigma = sigma.map_each(f64::from_le_bytes);
    let size: f64 = sigma[3..].iter().map(|part| part * part).sum();
    assert!(size < 1.0, "{size}: of the shorter rotation");
    let [first, second] = [0, 3].map(|at| of_rodrigues([sigma[at], sigma[at + 1], sigma[at + 2]]));
    takes_to_body(first);
    turns_at([first, second], OMEGA);
    let (_, omega) = array(&archive, "omega_BN_B.npy");
    assert_eq!(omega.map_each(f64::from_le_bytes)[..3], OMEGA);
    let (_, inputs) = array(&archive, "inputs.npy");
    assert_eq!(inputs.len(), 1, "two letters in UTF-32");
}

/// Numbers of chunks.
trait Mapped {
    fn map_each<T>(&self, number: fn([u8; 8]) -> T) -> Vec<T>;
}

impl Mapped for Vec<[u8; 8]> {
    fn map_each<T>(&self, number: fn([u8; 8]) -> T) -> Vec<T> {
        self.iter().map(|bytes| number(*bytes)).collect()
    }
}

/// Everything of a text but the numbers.
fn frame(text: &str) -> String {
    let is_record =
        |line: &str| line.split(' ').count() >= 5 && line.starts_with(|letter: char| letter.is_ascii_digit());
    text.lines().map(|line| if is_record(line) { "RECORD\n".into() } else { format!("{line}\n") }).collect()
}

/// Keywords that 504.0-B-2 (tables 4-2 and 4-3) makes mandatory, in its order, and those of a type with angular velocities.
#[test]
fn a_message_of_version_2_has_the_keywords_of_the_standard() {
    insta::assert_snapshot!(frame(&written(AttitudeFormat::Aem, &labels())), @r"
    CCSDS_AEM_VERS = 2.0
    COMMENT Written by quasirigid 0.1.0
    COMMENT Inertial axes of the model: ICRF; its time 0: 2026-01-01T00:00:00.000 UTC
    CREATION_DATE = 2026-01-02T03:04:05.000
    ORIGINATOR = QUASIRIGID

    META_START
    COMMENT Q1 Q2 Q3 QC, scalar last, turn the axes of REF_FRAME_A into those of REF_FRAME_B
    COMMENT Rates: REF_FRAME_B against REF_FRAME_A, in axes of REF_FRAME_B, deg/s
    OBJECT_NAME = boom satellite
    OBJECT_ID = UNKNOWN
    REF_FRAME_A = ICRF
    REF_FRAME_B = SC_BODY_1
    TIME_SYSTEM = UTC
    START_TIME = 2026-01-01T00:00:00.000
    STOP_TIME = 2026-01-01T00:00:00.000001
    ATTITUDE_TYPE = QUATERNION/ANGVEL
    ANGVEL_FRAME = SC_BODY_1
    META_STOP

    DATA_START
    RECORD
    RECORD
    DATA_STOP
    ");
    let plain = frame(&written(AttitudeFormat::Aem, &Labels { rates: false, epoch: None, ..labels() }));
    assert!(plain.contains("ATTITUDE_TYPE = QUATERNION\nMETA_STOP") && !plain.contains("ANGVEL"), "{plain}");
    assert!(plain.contains("its time 0: 2000-01-01T12:00:00.000 UTC by default"), "{plain}");
}

/// Keywords that 504.0-B-1 (tables 4-2 and 4-3) makes mandatory, in its order.
#[test]
fn a_message_of_version_1_has_the_keywords_of_the_standard() {
    insta::assert_snapshot!(frame(&written(AttitudeFormat::Aem1, &labels())), @r"
    CCSDS_AEM_VERS = 1.0
    COMMENT Written by quasirigid 0.1.0
    COMMENT Inertial axes of the model: ICRF; its time 0: 2026-01-01T00:00:00.000 UTC
    CREATION_DATE = 2026-01-02T03:04:05.000
    ORIGINATOR = QUASIRIGID

    META_START
    COMMENT Q1 Q2 Q3 QC, scalar last, turn the axes of REF_FRAME_A into those of REF_FRAME_B
    COMMENT Rates: REF_FRAME_B against REF_FRAME_A, in axes of REF_FRAME_B, deg/s
    OBJECT_NAME = boom satellite
    OBJECT_ID = UNKNOWN
    REF_FRAME_A = ICRF
    REF_FRAME_B = SC_BODY_1
    ATTITUDE_DIR = A2B
    TIME_SYSTEM = UTC
    START_TIME = 2026-01-01T00:00:00.000
    STOP_TIME = 2026-01-01T00:00:00.000001
    ATTITUDE_TYPE = QUATERNION/RATE
    QUATERNION_TYPE = LAST
    RATE_FRAME = REF_FRAME_B
    META_STOP

    DATA_START
    RECORD
    RECORD
    DATA_STOP
    ");
}

#[test]
fn a_file_of_stk_has_its_keywords() {
    insta::assert_snapshot!(frame(&written(AttitudeFormat::Stk, &labels())), @r"
    stk.v.11.0
    # Written by quasirigid 0.1.0
    # Inertial axes of the model: ICRF; its time 0: 2026-01-01T00:00:00.000 UTC
    # q1 q2 q3 q4, scalar last, turn the coordinate axes into those of the body
    # Rates: body against the coordinate axes, in body axes, deg/s
    BEGIN Attitude
    NumberOfAttitudePoints 2
    ScenarioEpoch 1 Jan 2026 00:00:00.000
    BlockingFactor 20
    InterpolationOrder 1
    CentralBody Earth
    CoordinateAxes ICRF
    AttitudeTimeQuatAngVels
    RECORD
    RECORD
    END Attitude
    ");
}

/// Keywords that msopck requires (its user's guide, "setup file"), for seconds of TDB and for UTC.
#[test]
fn the_setup_of_msopck_says_what_the_data_are() {
    let tdb = Labels { time_system: TimeSystem::TDB, ..labels() };
    // 9496 days and a half after noon of 2000-01-01
    assert!(
        written(AttitudeFormat::Msopck, &tdb).starts_with("820497600.0 "),
        "{}",
        written(AttitudeFormat::Msopck, &tdb)
    );
    assert!(written(AttitudeFormat::Msopck, &labels()).starts_with("2026-01-01T00:00:00.000 "));
    let setup = AttitudeFormat::Msopck.setup(&tdb, &history(), "spin.msopck").unwrap();
    insta::assert_snapshot!(setup, @r"
    Written by quasirigid 0.1.0: setup file of msopck, a program of NAIF's SPICE toolkit.
    Inertial axes of the model: J2000 of SPICE; its time 0: 2026-01-01T00:00:00.000 TDB.

    Data: time, q0 q1 q2 q3, wx wy wz. The quaternion is SPICE's, scalar first:
    that of the C-matrix, which takes J2000 components to body components.
    The angular velocity is in body axes, rad/s.

    Set the names of the kernels and INSTRUMENT_ID to those of your mission, then
    run: msopck SETUP spin.msopck OUTPUT.bc

    \begindata

       LSK_FILE_NAME        = 'naif0012.tls'
       MAKE_FAKE_SCLK       = 'quasirigid.tsc'
       INSTRUMENT_ID        = -999000
       CK_TYPE              = 3
       CK_SEGMENT_ID        = 'boom satellite'
       REFERENCE_FRAME_NAME = 'J2000'
       INPUT_DATA_TYPE      = 'SPICE QUATERNIONS'
       INPUT_TIME_TYPE      = 'ET'
       ANGULAR_RATE_PRESENT = 'YES'
       ANGULAR_RATE_FRAME   = 'INSTRUMENT'
       PRODUCER_ID          = 'quasirigid'

    \begintext
    ");
    assert!(
        AttitudeFormat::Msopck
            .setup(&labels(), &history(), "a")
            .unwrap()
            .contains("INPUT_TIME_TYPE      = 'UTC'")
    );
    let made_up = AttitudeFormat::Msopck.setup(&labels(), &history()[4..], "a").unwrap();
    assert!(made_up.contains("ANGULAR_RATE_PRESENT = 'MAKE UP'"), "{made_up}");
    assert_eq!(AttitudeFormat::Aem.setup(&labels(), &history(), "a"), None);
}

fn refused(format: AttitudeFormat, labels: &Labels, change: impl Fn(&mut Vec<Column>)) -> String {
    let mut columns = history();
    change(&mut columns);
    bytes(format, labels, &columns).expect_err("a refusal").to_string()
}

#[test]
fn what_a_format_cannot_say_is_refused() {
    let aem = AttitudeFormat::Aem;
    let none = |_: &mut Vec<Column>| {};
    let at = |epoch: &str| Labels { epoch: Some(epoch.parse().unwrap()), ..labels() };
    let tai = Labels { time_system: TimeSystem::named("tai").unwrap(), ..labels() };
    let told = [
        refused(aem, &labels(), |columns| drop(columns.remove(4))),
        refused(aem, &labels(), |columns| columns.iter_mut().for_each(|column| column.values.clear())),
        refused(aem, &labels(), |columns| columns[5].values[1] = f64::NAN),
        refused(aem, &labels(), |columns| columns[0].values[1] = 1e-13),
        refused(aem, &at("9999-12-31T23:59:59"), |columns| columns[0].values[1] = 2.0),
        refused(aem, &at("2016-12-31T23:59:59"), |columns| columns[0].values[1] = 2.0),
        refused(AttitudeFormat::Stk, &tai, none),
        refused(AttitudeFormat::Msopck, &tai, none),
    ];
    insta::assert_snapshot!(told.join("\n"), @r"
    the table has no column qw, and an attitude file needs t, qw, qx, qy and qz
    the table has no rows, and an attitude file has one at least
    the row at t = 0.000001 s has a number that is not finite, which an attitude file cannot say; end the history before
    the times 0 s and 0.0000000000001 s are the same epoch or out of order, and an attitude file needs ascending ones
    t = 2 s after 9999-12-31T23:59:59.000 is outside the years 1 to 9999; give an earlier epoch, or a shorter history
    a leap second ends at 2017-01-01T00:00:00.000 UTC, within the history; give the time system TAI or TDB, or another epoch
    the format has no time system TAI; it takes UTC
    the format has no time system TAI; it takes UTC and TDB
    ");
    let across = Labels { epoch: at("2016-12-31T23:59:59").epoch, ..tai };
    let mut columns = history();
    columns[0].values[1] = 2.0;
    let text = String::from_utf8(bytes(aem, &across, &columns).unwrap()).unwrap();
    assert!(text.contains("STOP_TIME = 2017-01-01T00:00:01.000"), "{text}");
}
