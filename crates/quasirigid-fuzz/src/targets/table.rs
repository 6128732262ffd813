//! Tables of bodies and of answers, and the folder of a study.

use quasirigid_io::table_file::{read_bodies, read_parquet};
use quasirigid_study::sweep;

use super::disk::{with_file, with_files};

/// A part of the results of a study.
const PART: &[u8] = include_bytes!("../../fixtures/study/part-00000.parquet");

pub fn bodies(name: &str, bytes: &[u8]) {
    with_file(name, bytes, |path| match read_bodies(path) {
        Ok(table) => {
            assert!(table.rows() > 0, "a table has rows");
            assert_eq!(table.names.len(), table.columns.len());
            assert!(
                table.columns.iter().all(|column| column.len() == table.rows()),
                "columns are equally long"
            );
            assert!(table.unread.keys().all(|row| *row < table.rows()), "unread rows exist");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}

pub fn cells_parquet(bytes: &[u8]) {
    with_file("cells.parquet", bytes, |path| match read_parquet(path, None) {
        Ok(columns) => {
            let rows = columns.first().map_or(0, |column| column.len());
            assert!(columns.iter().all(|column| column.len() == rows), "columns are equally long");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}

/// The summary of a study beside one part.
pub fn sweep_results(bytes: &[u8]) {
    with_files(&[("summary.json", bytes), ("parts/part-00000.parquet", PART)], |folder| {
        match sweep::read(folder) {
            Ok(results) => drop(quasirigid_report::study_page(&results.summary, &[])),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    });
}
