//! `simulate` to attitude files, and a start from one: the same history in each format.

use std::fs;

use insta::assert_snapshot;

use crate::support::{Table, folder_of, names, ran_in};

const LINE: &str = "simulate model.toml --times 0,0.5,2";

/// Numbers of the rows of a text behind their first word.
fn rows(text: &str, width: usize) -> Vec<Vec<f64>> {
    let row =
        |line: &str| -> Option<Vec<f64>> { line.split(' ').skip(1).map(|word| word.parse().ok()).collect() };
    text.lines().filter_map(row).filter(|row| row.len() == width).collect()
}

#[test]
fn a_format_follows_the_ending_of_the_file_and_has_the_rows_of_the_table() {
    let folder = folder_of("three-masses");
    let ran = |line: &str| {
        let ran = ran_in(folder.path(), line);
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
        ran.stdout
    };
    let table = Table::of(&ran(LINE));
    let attitude = |row: usize| ["qx", "qy", "qz", "qw"].map(|name| table.column(name)[row]);
    let spin = |row: usize| ["wx", "wy", "wz"].map(|name| table.column(name)[row].to_degrees());
    ran(&format!("{LINE} --out spin.aem --epoch 2026-01-01T00:00:00"));
    ran(&format!("{LINE} --out spin.a --epoch 2026-01-01T00:00:00 --frame eme2000"));
    let texts = [
        fs::read_to_string(folder.path().join("spin.aem")).unwrap(),
        fs::read_to_string(folder.path().join("spin.a")).unwrap(),
        ran(&format!("{LINE} --format aem1")),
    ];
    for text in &texts {
        let found = rows(text, 7);
        assert_eq!(found.len(), 3, "{text}");
        for (row, found) in found.iter().enumerate() {
            let expected = [&attitude(row)[..], &spin(row)].concat();
            let off = found.iter().zip(&expected).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-13, "{found:?} {expected:?}"); // degrees, rounded at 16 digits
        }
    }
    assert!(texts[0].contains("OBJECT_NAME = three masses\n"), "{}", texts[0]);
    assert!(texts[0].contains("\n2026-01-01T00:00:00.500 "), "{}", texts[0]);
    assert!(texts[1].contains("CoordinateAxes J2000\n"), "{}", texts[1]);
    assert!(texts[2].contains("REF_FRAME_A = ICRF\n"), "{}", texts[2]);
    let plain = ran(&format!("{LINE} --format stk --without-rates"));
    assert_eq!(rows(&plain, 4).len(), 3, "{plain}");
    assert!(folder.path().join("spin.aem.inputs.json").is_file());
}

#[test]
fn the_data_of_msopck_have_their_setup_beside_them() {
    let folder = folder_of("three-masses");
    let ran = ran_in(folder.path(), &format!("{LINE} --out spin.msopck --time-system tdb"));
    assert_eq!((ran.code, &*ran.stderr), (Some(0), ""));
    let setup = fs::read_to_string(folder.path().join("spin.msopck.setup")).unwrap();
    assert!(
        setup.contains("INPUT_TIME_TYPE      = 'ET'") && setup.contains("msopck SETUP spin.msopck"),
        "{setup}"
    );
    let data = fs::read_to_string(folder.path().join("spin.msopck")).unwrap();
    assert!(data.starts_with("0.0 ") && data.lines().count() == 3, "{data}");
}

#[test]
fn a_history_goes_on_from_a_file_that_it_wrote() {
    let folder = folder_of("three-masses");
    let ran = |line: &str| {
        let ran = ran_in(folder.path(), line);
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
        Table::of(&ran.stdout)
    };
    let whole = ran("simulate model.toml --times 0,20,30 --system rigid");
    ran_in(folder.path(), "simulate model.toml --times 0,20 --system rigid --out half.aem");
    let text = fs::read_to_string(folder.path().join("model.toml")).unwrap();
    let (head, initial) = text.split_once("[initial]").unwrap();
    let rest = initial.find("\n[").map_or("", |end| &initial[end..]);
    let start = "[initial]\nfrom = \"half.aem\"\nat = \"2000-01-01T12:00:20\"\n";
    fs::write(folder.path().join("model.toml"), format!("{head}{start}{rest}")).unwrap();
    let second = ran("simulate model.toml --times 0,10 --system rigid");
    for name in ["wx", "wy", "wz", "qw", "qx", "qy", "qz"] {
        let (a, b) = (whole.column(name)[2], second.column(name)[1]);
        assert!((a - b).abs() < 1e-10, "{name}: {a} {b}"); // tolerance of the integrator over 30 s
    }
}

#[test]
fn options_without_an_attitude_file_are_refused_before_the_work() {
    let folder = folder_of("three-masses");
    let refusal = |options: &str| ran_in(folder.path(), &format!("{LINE} {options}")).refusal().to_owned();
    assert_snapshot!(refusal("--epoch 2026-01-01"), @r"
    quasirigid: --epoch, --time-system, --frame and --without-rates belong to
    attitude files; add --format aem, aem1, stk, msopck or basilisk
    ");
    assert_snapshot!(refusal("--format aem --epoch 2026-02-30"), @r"
    error: invalid value '2026-02-30' for '--epoch <EPOCH>': no epoch; write 2026-01-01T00:00:00, or in STK 1 Jan 2026 00:00:00.0, with a second below 60

    For more information, try '--help'.
    ");
    assert_snapshot!(refusal("--format stk --time-system tai"), @"quasirigid: the format has no time system TAI; it takes UTC");
    assert_snapshot!(refusal("--format aem --epoch 2016-12-31T23:59:59"), @r"
    quasirigid: a leap second ends at 2017-01-01T00:00:00.000 UTC, within the
    history; give the time system TAI or TDB, or another epoch
    ");
    assert_eq!(names(folder.path()), ["model.toml"]);
}

#[test]
fn a_record_gives_its_histories_as_attitude_files() {
    let folder = folder_of("three-masses");
    let ran = |line: &str| ran_in(folder.path(), line);
    assert_eq!(ran("run model.toml --duration 2 --samples 3 -o spin").code, Some(0));
    ran("simulate model.toml --duration 2 --samples 3 --system rigid --out rigid.a");
    assert_eq!(ran("report spin --attitude spin.a --system rigid --quiet").code, Some(0));
    let [direct, of_record] =
        ["rigid.a", "spin.a"].map(|name| fs::read_to_string(folder.path().join(name)).unwrap());
    assert_eq!(rows(&of_record, 7), rows(&direct, 7));
    assert_eq!(ran("report spin --attitude spin.npz --quiet").code, Some(0));
    assert!(folder.path().join("spin.a.inputs.json").is_file());
    assert_snapshot!(ran("report spin --attitude spin.txt").refusal(), @r"
    quasirigid: spin.txt: the endings of attitude files are aem, a, msopck and npz;
    name the format with --format
    ");
    assert_snapshot!(ran("report spin --attitude b.a --system full").refusal(), @r#"quasirigid: spin: the record has no history "full"; it has reduced, rigid"#);
    assert_snapshot!(ran("report spin --frame icrf").refusal(), @r"
    quasirigid: --epoch, --time-system, --frame and --without-rates belong to
    attitude files; add --attitude FILE
    ");
}
