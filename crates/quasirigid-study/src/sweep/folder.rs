//! Folder of a study: its text, its model, parts of a fixed number of rows, and at the end one table and a summary.
//! Every file appears whole or not at all; a folder of another study is left alone.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use quasirigid_io::disk::{self, is_temporary, read_regular, replace, settle_folder};
use quasirigid_io::table_file::{CellColumn, CellKind, Cells, TableError, read_parquet, write_parquet};
use serde_json::{Value, json};

use super::cell::{Cell, cells};
use super::row::RowAnswer;
use super::{Sweep, SweepError, plan};

/// Files of the folder.
const HEAD_FILE: &str = "sweep.json";
const STUDY_FILE: &str = "study.toml";
const MODEL_FILE: &str = "model.toml";
const PARTS_FOLDER: &str = "parts";
pub(super) const REPORT_FILE: &str = "report.html";
pub(super) const ROWS_FILE: &str = "rows.csv";
pub(super) const BODIES_FILE: &str = "bodies.csv";
pub(super) const SUMMARY: &str = "summary.json";

/// Folder of the results of a study.
#[derive(Debug)]
pub(super) struct Folder<'s> {
    pub(super) path: PathBuf,
    sweep: &'s Sweep,
}

impl<'s> Folder<'s> {
    /// The folder of a study, which is open.
    pub(super) fn at(path: &Path, sweep: &'s Sweep) -> Self {
        Self { path: path.to_owned(), sweep }
    }

    /// Opens the folder of a study, or makes it; one with results is opened only to go on.
    pub(super) fn open(path: &Path, sweep: &'s Sweep, go_on: bool) -> Result<Self, SweepError> {
        let folder = Self::at(path, sweep);
        let head = path.join(HEAD_FILE);
        if head.is_file() {
            let text = read_regular(&head).map_err(SweepError::io(&head))?;
            let known: Option<Value> = serde_json::from_slice(&text).ok();
            if known.is_none_or(|known| known["sha256"] != sweep.sha256.as_str()) {
                return Err(SweepError::OtherStudy { folder: path.to_owned() });
            }
            if !go_on {
                return Err(SweepError::Exists { folder: path.to_owned() });
            }
            return Ok(folder);
        }
        if path.exists() && !is_begun(path) {
            return Err(SweepError::Foreign { folder: path.to_owned() });
        }
        let above = disk::parent(path);
        if !above.is_dir() {
            return Err(SweepError::NoFolder { folder: path.to_owned(), above: above.to_owned() });
        }
        if path.is_symlink() && !path.exists() {
            return Err(SweepError::Foreign { folder: path.to_owned() }); // it would be made where the link leads to
        }
        let parts = path.join(PARTS_FOLDER);
        fs::create_dir_all(&parts).map_err(SweepError::io(&parts))?;
        settle_folder(above).map_err(SweepError::io(path))?;
        folder.put(STUDY_FILE, |out| out.write_all(sweep.study.source.text.as_bytes()))?;
        folder.put(MODEL_FILE, |out| out.write_all(sweep.model.text.as_bytes()))?;
        let head = json!({
            "sha256": sweep.sha256, "version": env!("CARGO_PKG_VERSION"), "rows": sweep.rows,
            "part": sweep.study.part, "study_sha256": sweep.study.source.sha256, "model_sha256": sweep.model.sha256,
            "study_file": file_name(&sweep.study.source.file), "model_file": file_name(&sweep.model.file),
        });
        folder.put(HEAD_FILE, |out| writeln!(out, "{head:#}"))?;
        Ok(folder)
    }

    /// Number of parts.
    pub(super) fn parts(&self) -> u64 {
        self.sweep.rows.div_ceil(self.sweep.study.part as u64)
    }

    /// Part of a row.
    pub(super) fn part_of(&self, row: u64) -> u64 {
        row / self.sweep.study.part as u64
    }

    /// Rows of a part.
    pub(super) fn rows_of(&self, part: u64) -> std::ops::Range<u64> {
        let size = self.sweep.study.part as u64;
        part * size..((part + 1) * size).min(self.sweep.rows)
    }

    /// File of a part.
    pub(super) fn part(&self, part: u64) -> PathBuf {
        part_file(&self.path, part)
    }

    /// Journal of a part.
    pub(super) fn journal(&self, part: u64) -> PathBuf {
        self.path.join(PARTS_FOLDER).join(format!("part-{part:05}.journal"))
    }

    /// Removes the journal of a part that is there, which a run left that was killed between the two.
    pub(super) fn drop_journal(&self, part: u64) {
        let _ = fs::remove_file(self.journal(part)); // there is none as a rule
    }

    /// Writes a part from its rows, in the order of the study.
    pub(super) fn write_part(&self, part: u64, rows: &[RowAnswer]) -> Result<(), SweepError> {
        let path = self.part(part);
        let bytes = self.bytes(part, &columns(self.sweep, rows))?;
        replace(&path, |out| out.write_all(&bytes)).map_err(SweepError::io(&path))
    }

    /// The file of a part with these columns, byte for byte.
    fn bytes(&self, part: u64, columns: &[CellColumn]) -> Result<Vec<u8>, SweepError> {
        let metadata = [
            ("quasirigid.study", self.sweep.sha256.clone()),
            ("quasirigid.version", env!("CARGO_PKG_VERSION").to_owned()),
            ("quasirigid.part", part.to_string()),
            ("quasirigid.inputs", json!({ "files": self.sweep.files }).to_string()),
        ];
        let mut bytes = Vec::new();
        write_parquet(&self.part(part), &mut bytes, columns, &metadata)?;
        Ok(bytes)
    }

    /// Refuses a part that is there and is not, to the byte, what this study wrote: the checksums of its values are among the bytes.
    pub(super) fn check_part(&self, part: u64) -> Result<(), SweepError> {
        let path = self.part(part);
        let columns = read_part(&path, None)?;
        let found = read_regular(&path).map_err(SweepError::io(&path))?;
        if found == self.bytes(part, &columns)? {
            return Ok(());
        }
        Err(SweepError::Part { path, problem: "it is damaged, or holds other rows".into() })
    }

    /// Columns of these names over all parts, in the order of the file.
    pub(super) fn read(&self, wanted: &[&str]) -> Result<Vec<CellColumn>, SweepError> {
        read_parts(&self.path, Some(wanted))
    }

    /// Writes a file of the folder.
    pub(super) fn put(
        &self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), SweepError> {
        let path = self.path.join(name);
        replace(&path, write).map_err(SweepError::io(path))
    }
}

fn part_file(folder: &Path, part: u64) -> PathBuf {
    folder.join(PARTS_FOLDER).join(format!("part-{part:05}.parquet"))
}

/// Columns of these names, or all, over the parts of a folder in which every part is there, in the order of the file.
pub(super) fn read_parts(folder: &Path, wanted: Option<&[&str]>) -> Result<Vec<CellColumn>, SweepError> {
    let mut all: Vec<CellColumn> = Vec::new();
    let parts = (0..).map(|part| part_file(folder, part)).take_while(|path| path.is_file());
    for path in parts {
        let columns = read_part(&path, wanted)?;
        if all.is_empty() {
            all = columns;
            continue;
        }
        for (column, more) in all.iter_mut().zip(columns) {
            append(&mut column.cells, more.cells);
        }
    }
    Ok(all)
}

/// Columns of a part, of these names or all.
pub(super) fn read_part(path: &Path, wanted: Option<&[&str]>) -> Result<Vec<CellColumn>, SweepError> {
    read_parquet(path, wanted).map_err(|error| match error {
        TableError::Parquet { file, cause } => SweepError::Part { path: file, problem: cause },
        other => other.into(),
    })
}

/// Columns of a part: row, inputs, answers, status, reason, note.
pub(super) fn columns(sweep: &Sweep, rows: &[RowAnswer]) -> Vec<CellColumn> {
    let inputs: Vec<Vec<Cell>> = rows.iter().map(|row| plan::cells(sweep, row.row)).collect();
    let column =
        |name: &str, unit: &str, cells: Cells| CellColumn { name: name.into(), unit: unit.into(), cells };
    let texts = |text: &dyn Fn(&RowAnswer) -> &str| {
        Cells::Texts(
            rows.iter()
                .map(|row| Some(text(row)).filter(|text| !text.is_empty()).map(str::to_owned))
                .collect(),
        )
    };
    let mut columns =
        vec![column("row", "", Cells::Counts(rows.iter().map(|row| row.row as i64 + 1).collect()))];
    columns.extend(sweep.inputs.iter().enumerate().map(|(i, input)| {
        column(&input.name, &input.unit, cells(input.kind, inputs.iter().map(|row| &row[i])))
    }));
    columns.extend(sweep.outputs.iter().enumerate().map(|(i, output)| {
        column(&output.name, &output.unit, cells(output.kind, rows.iter().map(|row| &row.outputs[i])))
    }));
    columns.push(column("status", "", texts(&|row| row.status.word())));
    columns.push(column("reason", "", texts(&|row| &row.reason)));
    columns.push(column("note", "", texts(&|row| &row.note)));
    columns
}

/// Word of a kind in the summary.
pub(super) fn kind_word(kind: CellKind) -> &'static str {
    match kind {
        CellKind::Number => "number",
        CellKind::Boolean => "boolean",
        CellKind::Text => "text",
    }
}

fn append(cells: &mut Cells, more: Cells) {
    match (cells, more) {
        (Cells::Counts(all), Cells::Counts(more)) => all.extend(more),
        (Cells::Numbers(all), Cells::Numbers(more)) => all.extend(more),
        (Cells::Booleans(all), Cells::Booleans(more)) => all.extend(more),
        (Cells::Texts(all), Cells::Texts(more)) => all.extend(more),
        _ => {}
    }
}

/// Whether a folder holds nothing, or nothing but what the start of a study writes before its head.
fn is_begun(path: &Path) -> bool {
    let Ok(entries) = fs::read_dir(path) else { return false };
    let ours = |name: &str| [STUDY_FILE, MODEL_FILE, PARTS_FOLDER].contains(&name) || is_temporary(name);
    let mut names = entries.map(|entry| entry.map(|entry| entry.file_name()));
    let begun = names.all(|name| name.is_ok_and(|name| name.to_str().is_some_and(ours)));
    begun && fs::read_dir(path.join(PARTS_FOLDER)).map_or(true, |mut parts| parts.next().is_none())
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Removes the temporary files that killed runs left in a folder of parts.
pub(super) fn tidy(folder: &Path) {
    disk::tidy(folder);
    disk::tidy(&folder.join(PARTS_FOLDER));
}
