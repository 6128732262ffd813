//! Tables of histories in every format: read back bit for bit, or refused by name; long ones keep their extremes.

use std::fs;

use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid_io::record::{
    Column, Extremes, MOST_ROWS, RecordError, RowLog, RowTable, RunRecord, TableFormat,
};
use tempfile::tempdir;

use super::record::sample;

fn bits(columns: &[Column]) -> Vec<(String, Vec<u64>)> {
    let bits = |column: &Column| column.values.iter().map(|value| value.to_bits()).collect();
    columns.iter().map(|column| (column.name.clone(), bits(column))).collect()
}

fn with_values(values: [Vec<f64>; 2]) -> RunRecord {
    let mut record = sample();
    for (column, values) in record.histories[0].columns.iter_mut().zip(values) {
        column.values = values;
    }
    record
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn every_format_reads_back_bit_for_bit(values in vec(any::<[f64; 2]>(), 0..50)) {
        let column = |place: usize| values.iter().map(|row| row[place]).collect::<Vec<f64>>();
        let record = with_values([column(0), column(1)]);
        for format in TableFormat::ALL {
            let dir = tempdir().unwrap();
            record.write(dir.path(), &[format]).unwrap();
            let read = RunRecord::read(dir.path()).unwrap();
            let canonical = |columns: &[Column]| match format {
                // text does not tell one NaN from another
                TableFormat::Csv => bits(&columns.iter().map(|column| Column {
                    values: column.values.iter().map(|v| if v.is_nan() { f64::NAN } else { *v }).collect(),
                    ..column.clone()
                }).collect::<Vec<_>>()),
                _ => bits(columns),
            };
            prop_assert_eq!(canonical(&read.histories[0].columns), canonical(&record.histories[0].columns));
        }
    }
}

#[test]
fn record_in_several_formats_is_the_same_record() {
    let (dir, record) = (tempdir().unwrap(), sample());
    record.write(dir.path(), &TableFormat::ALL).unwrap();
    for removed in ["history-reduced.parquet", "history-reduced.csv"] {
        assert_eq!(
            bits(&RunRecord::read(dir.path()).unwrap().histories[0].columns),
            bits(&record.histories[0].columns)
        );
        fs::remove_file(dir.path().join(removed)).unwrap();
    }
    fs::remove_file(dir.path().join("history-reduced.npz")).unwrap();
    let missing = RunRecord::read(dir.path()).unwrap_err().to_string();
    assert!(
        missing
            .contains("there is no file history-reduced.csv, history-reduced.parquet, history-reduced.npz")
            || missing.contains(
                "there is no file history-reduced.parquet, history-reduced.csv, history-reduced.npz"
            ),
        "{missing}"
    );
}

#[test]
fn damaged_tables_are_refused_by_name() {
    for format in [TableFormat::Parquet, TableFormat::Npz] {
        let (dir, record) = (tempdir().unwrap(), sample());
        record.write(dir.path(), &[format]).unwrap();
        let file = dir.path().join(format!("history-reduced.{}", format.ending()));
        let whole = fs::read(&file).unwrap();
        for cut in (0..whole.len()).step_by(7) {
            fs::write(&file, &whole[..cut]).unwrap();
            let refused = RunRecord::read(dir.path()).unwrap_err();
            assert!(
                matches!(&refused, RecordError::Table { file: named, .. } if *named == file),
                "{cut}: {refused}"
            );
        }
        // a changed byte is refused, or changes a number, but never panics
        for place in 0..whole.len() {
            let mut changed = whole.clone();
            changed[place] ^= 0x55;
            fs::write(&file, &changed).unwrap();
            let _ = RunRecord::read(dir.path());
        }
    }
}

/// A few bytes of Parquet stand for any number of equal rows: the room in memory goes by the rows that the record says.
#[test]
fn tables_with_other_rows_than_the_record_says_are_refused() {
    for format in TableFormat::ALL {
        for (rows, told) in [(3_000_000, 100), (7, 100), (2, 1)] {
            let dir = tempdir().unwrap();
            let mut record = with_values([vec![0.0; rows], vec![0.0; rows]]);
            record.histories[0].columns.truncate(2);
            record.histories[0].rows = rows as u64;
            record.write(dir.path(), &[format]).unwrap();
            let path = dir.path().join("record.json");
            let text = fs::read_to_string(&path).unwrap();
            fs::write(&path, text.replace(&format!("\"rows\": {rows}"), &format!("\"rows\": {told}")))
                .unwrap();
            let refused = RunRecord::read(dir.path()).unwrap_err();
            let found = (rows as u64).min(told + 1);
            assert!(
                matches!(refused, RecordError::Rows { found: f, expected, .. } if f == found && expected == told),
                "{refused}"
            );
        }
    }
}

fn column(name: &str) -> Column {
    Column { name: name.into(), unit: "1".into(), values: Vec::new() }
}

#[test]
fn long_tables_keep_every_extreme_of_every_column() {
    let rows = 3 * MOST_ROWS;
    let spike = 123_457;
    let mut extremes = Extremes::new(&[column("t"), column("x"), column("gap")], rows);
    let value =
        |row: u64| [row as f64, (0.01 * row as f64).sin() + if row == spike { 9.0 } else { 0.0 }, f64::NAN];
    (0..rows).for_each(|row| extremes.push(&value(row)));
    assert_eq!(extremes.rows(), rows);
    let [t, x, gap] = extremes.into_columns().try_into().unwrap();
    assert!(t.values.len() <= 6_000 && t.values.is_sorted(), "{}", t.values.len());
    assert_eq!((t.values[0], *t.values.last().unwrap()), (0.0, (rows - 1) as f64));
    let place = t.values.iter().position(|t| *t == spike as f64).expect("the spike is kept");
    assert!(x.values[place] > 8.0 && gap.values.iter().all(|value| value.is_nan()));
    for (t, x) in t.values.iter().zip(&x.values) {
        assert_eq!(*x, value(*t as u64)[1], "rows are rows of the table");
    }
}

/// A record that was read without all its rows does not pass for a whole one.
#[test]
fn record_with_extremes_alone_is_not_written_again() {
    let mut record = sample();
    record.histories[0].rows = 1_000_000;
    let dir = tempdir().unwrap();
    let refused = record.write(dir.path(), &[TableFormat::Csv]).unwrap_err();
    assert!(matches!(refused, RecordError::Thinned { .. }), "{refused}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}

#[test]
fn log_goes_on_from_rows_with_their_checksum_and_drops_the_others() {
    let dir = tempdir().unwrap();
    let path = dir.path().join("log");
    let mut log = RowLog::create(&path, 2).unwrap();
    (0..3).for_each(|row| log.push(&[f64::from(row), -1.0]).unwrap());
    log.settle().unwrap();
    let checksum = log.checksum();
    (3..5).for_each(|row| log.push(&[f64::from(row), -1.0]).unwrap());
    log.settle().unwrap();
    drop(log);
    let whole = fs::read(&path).unwrap();
    for damaged in (0..48).step_by(7) {
        let mut bytes = whole.clone();
        bytes[damaged] ^= 1;
        fs::write(&path, bytes).unwrap();
        assert_eq!(
            RowLog::resume(&path, 2, 3, checksum).unwrap_err().kind(),
            std::io::ErrorKind::InvalidData
        );
        assert_eq!(fs::metadata(&path).unwrap().len(), 5 * 16, "a log that is refused stays");
    }
    fs::write(&path, [whole, vec![1, 2, 3]].concat()).unwrap();
    assert_eq!(RowTable::open(&path, 2).unwrap().rows(), 5, "a torn row is none");
    let mut again = RowLog::resume(&path, 2, 3, checksum).unwrap();
    again.push(&[7.0, 8.0]).unwrap();
    assert_eq!((again.rows(), again.into_table().unwrap().rows()), (4, 4));
    assert_eq!(fs::metadata(&path).unwrap().len(), 4 * 16);
    assert!(RowLog::resume(&path, 2, 9, checksum).is_err(), "rows that are not there");
}
