//! Workbooks of Excel (XLSX, ECMA-376): the first sheet, its first row with names.
//! A workbook is an archive of XML, both of which other formats read already; `calamine` would bring two more readers of them. Dates, styles
//! and formulas are not read: of a formula the value that Excel last computed is.

use std::io::{Read, Seek};
use std::path::Path;

use quasirigid_math::memory;
use roxmltree::{Document, Node};
use zip::ZipArchive;

use super::TableError;
use super::bodies::{BodyTable, open};
use super::votable::IN_MEMORY;
use crate::text_file::unpacked_limit;

/// Most columns of a sheet, as in Excel.
const MOST_COLUMNS: usize = 16_384;
const SHEET: &str = "xl/worksheets/sheet1.xml";
const TEXTS: &str = "xl/sharedStrings.xml";

/// Reads the first sheet of a workbook.
pub(super) fn read(file: &Path) -> Result<BodyTable, TableError> {
    let refuse = |problem: String| TableError::Form { file: file.to_owned(), problem };
    let opened = open(file)?;
    let mut left = unpacked_limit(opened.metadata().map_or(0, |metadata| metadata.len()));
    let mut archive = ZipArchive::new(opened).map_err(|cause| refuse(cause.to_string()))?;
    let sheet = member(&mut archive, SHEET, &mut left).map_err(refuse)?.ok_or_else(|| {
        refuse("this archive is not a workbook of Excel (.xlsx); save the table as CSV".to_owned())
    })?;
    let texts = member(&mut archive, TEXTS, &mut left).map_err(refuse)?.unwrap_or_default();
    memory::ask(IN_MEMORY * (sheet.len() + texts.len()) as f64).map_err(|cause| refuse(cause.to_string()))?;
    let sheets =
        archive.file_names().flatten().filter(|name| name.starts_with("xl/worksheets/sheet")).count();
    let mut table = of_sheet(&sheet, &texts).map_err(refuse)?;
    table.notes.push("the first sheet of a workbook".to_owned());
    if sheets > 1 {
        table.notes.push(format!("{} further sheets are left out", sheets - 1));
    }
    Ok(table)
}

/// Text of a file in the archive, which is counted against what is left.
fn member(
    archive: &mut ZipArchive<impl Read + Seek>,
    name: &str,
    left: &mut u64,
) -> Result<Option<String>, String> {
    let input = match archive.by_name(name) {
        Ok(input) => input,
        Err(zip::result::ZipError::FileNotFound) => return Ok(None),
        Err(cause) => return Err(cause.to_string()),
    };
    let mut bytes = Vec::new();
    input.take(*left + 1).read_to_end(&mut bytes).map_err(|cause| cause.to_string())?;
    *left = left
        .checked_sub(bytes.len() as u64)
        .ok_or_else(|| "the workbook unpacks to too much; save the table as CSV".to_owned())?;
    String::from_utf8(bytes).map(Some).map_err(|_| format!("{name} is not UTF-8 text"))
}

fn of_sheet(sheet: &str, texts: &str) -> Result<BodyTable, String> {
    let damaged = |cause: roxmltree::Error| format!("the workbook is damaged: {cause}");
    let texts = match texts {
        "" => Vec::new(),
        texts => shared(&Document::parse(texts).map_err(damaged)?),
    };
    let document = Document::parse(sheet).map_err(damaged)?;
    let mut rows = document.descendants().filter(|node| node.has_tag_name_of("row"));
    let Some(header) = rows.next() else { return Ok(BodyTable::default()) };
    let names = cells(header, &texts)?;
    let width = names.len();
    let mut table = BodyTable::of(names.into_iter());
    for (number, row) in (2..).zip(rows) {
        let mut values = cells(row, &texts)?;
        if values.iter().all(String::is_empty) {
            continue; // a row that has a style alone
        }
        values.resize(values.len().max(width), String::new());
        let number = row.attribute("r").and_then(|number| number.parse().ok()).unwrap_or(number);
        table.add(number, Some(values.into_iter().map(String::into_bytes).collect()));
    }
    Ok(table)
}

/// Texts that cells share.
fn shared(document: &Document<'_>) -> Vec<String> {
    document.descendants().filter(|node| node.has_tag_name_of("si")).map(words).collect()
}

/// Values of a row, each at the place that its reference names.
fn cells(row: Node<'_, '_>, texts: &[String]) -> Result<Vec<String>, String> {
    let mut values = Vec::new();
    for cell in row.children().filter(|node| node.has_tag_name_of("c")) {
        let column = cell.attribute("r").and_then(column).unwrap_or(values.len());
        if column >= MOST_COLUMNS {
            return Err("a cell of the workbook stands beyond the last column".to_owned());
        }
        values.resize(values.len().max(column + 1), String::new());
        values[column] = value(cell, texts);
    }
    Ok(values)
}

fn value(cell: Node<'_, '_>, texts: &[String]) -> String {
    let inner = |name: &str| cell.children().find(|node| node.has_tag_name_of(name));
    let plain = inner("v").map(|node| words_of(node)).unwrap_or_default();
    match cell.attribute("t") {
        Some("s") => {
            plain.parse::<usize>().ok().and_then(|index| texts.get(index).cloned()).unwrap_or_default()
        }
        Some("inlineStr") => inner("is").map(words).unwrap_or_default(),
        Some("b") => if plain == "1" { "true" } else { "false" }.to_owned(),
        Some("e") => String::new(),
        _ => plain,
    }
    .trim()
    .to_owned()
}

/// Texts of the runs in a node.
fn words(node: Node<'_, '_>) -> String {
    node.descendants().filter(|node| node.has_tag_name_of("t")).map(words_of).collect()
}

fn words_of(node: Node<'_, '_>) -> String {
    node.text().unwrap_or_default().to_owned()
}

/// Number of the column that a reference such as `B12` names, from 0.
fn column(reference: &str) -> Option<usize> {
    let letters = reference.bytes().take_while(u8::is_ascii_alphabetic);
    let number = letters.fold(0_usize, |number, letter| {
        number.saturating_mul(26).saturating_add(usize::from(letter.to_ascii_uppercase() - b'A') + 1)
    });
    number.checked_sub(1)
}

/// Names of elements, in whatever namespace.
trait Named {
    fn has_tag_name_of(&self, name: &str) -> bool;
}

impl Named for Node<'_, '_> {
    fn has_tag_name_of(&self, name: &str) -> bool {
        self.is_element() && self.tag_name().name() == name
    }
}
