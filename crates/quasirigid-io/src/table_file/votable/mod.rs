//! VOTable, the XML of the Virtual Observatory (IVOA Recommendation 1.4): fields with units and null values, rows as elements or in binary
//! form. Rows in FITS are refused in words; every service also gives another form.

mod binary;
mod pieces;

use std::io::Read;
use std::ops::Range;
use std::path::Path;

use quasirigid_math::memory;
use roxmltree::{Document, Node, ParsingOptions};

use super::TableError;
use super::bodies::{BodyTable, open};
use super::names::unit;

/// Bytes in memory for each byte of the file: a node of the tree takes 96 bytes, and the shortest element seven.
pub(super) const IN_MEMORY: f64 = 24.0;
/// The same where rows are read piece by piece: the text, and the values of the table.
const PIECEWISE: f64 = 8.0;

/// Whether a file begins as a VOTable does.
pub(super) fn begins(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    text.trim_start_matches('\u{feff}').trim_start().starts_with('<') && text.contains("VOTABLE")
}

/// Reads the first table of a file that has rows.
pub(super) fn read(file: &Path) -> Result<BodyTable, TableError> {
    let refuse = |problem: String| TableError::Form { file: file.to_owned(), problem };
    let unread = |cause: std::io::Error| TableError::File { file: file.to_owned(), kind: cause.kind() };
    let mut input = open(file)?;
    let mut text = String::new();
    input.read_to_string(&mut text).map_err(unread)?;
    // files of version 1.0 name a DTD; one that defines entities could grow without bound
    if text.contains("<!ENTITY") {
        return Err(refuse("it defines entities of its own; save the VOTable anew, or as CSV".to_owned()));
    }
    let whole = || of_document(&text, None);
    let read =
        pieces::place(&text).map_or_else(whole, |rows| of_document(&text, Some(rows)).or_else(|_| whole()));
    read.map_err(refuse)
}

/// The first table with rows of a document. Rows at a place of the text are read piece by piece, since a tree of all would take twenty times the
/// file.
fn of_document(text: &str, apart: Option<Range<usize>>) -> Result<BodyTable, String> {
    let tree = text.len() - apart.as_ref().map_or(0, Range::len);
    memory::ask(IN_MEMORY * tree as f64 + PIECEWISE * text.len() as f64)
        .map_err(|cause| cause.to_string())?;
    let around = apart.as_ref().map(|rows| [&text[..rows.start], &text[rows.end..]].concat());
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(around.as_deref().unwrap_or(text), options)
        .map_err(|cause| format!("this is not valid XML: {cause}"))?;
    let tables: Vec<Node<'_, '_>> = all(document.root(), "TABLE").collect();
    let Some((table, rows)) = tables.iter().find_map(|table| Some((table, Rows::of(*table)?))) else {
        let is_fits = all(document.root(), "FITS").next().is_some();
        let what = if is_fits { "its rows are in FITS" } else { "it has no rows" };
        return Err(format!("{what}; save the VOTable as TABLEDATA, or as CSV"));
    };
    let mut read = of_table(*table, &rows, text, apart)?;
    if tables.len() > 1 {
        read.notes.push(format!("the file has {} tables; the first with rows is taken", tables.len()));
    }
    Ok(read)
}

/// Rows of a table.
enum Rows<'a, 'i> {
    /// As elements.
    Elements,
    /// In a stream, each perhaps behind the marks of its missing values.
    Stream { stream: Node<'a, 'i>, flagged: bool },
}

impl<'a, 'i> Rows<'a, 'i> {
    fn of(table: Node<'a, 'i>) -> Option<Self> {
        if all(table, "TABLEDATA").next().is_some() {
            return Some(Self::Elements);
        }
        let binary = table.descendants().find(|node| is(node, "BINARY") || is(node, "BINARY2"))?;
        Some(Self::Stream { stream: all(binary, "STREAM").next()?, flagged: is(&binary, "BINARY2") })
    }
}

fn of_table(
    table: Node<'_, '_>,
    rows: &Rows<'_, '_>,
    text: &str,
    apart: Option<Range<usize>>,
) -> Result<BodyTable, String> {
    let fields: Vec<Node<'_, '_>> = table.children().filter(|node| is(node, "FIELD")).collect();
    let name = |field: &Node<'_, '_>| {
        field.attribute("name").or(field.attribute("ID")).unwrap_or_default().trim().to_owned()
    };
    let mut read = BodyTable::of(fields.iter().map(name));
    for (unit, field) in read.units.iter_mut().zip(&fields) {
        if let Some(given) = field.attribute("unit").and_then(self::unit) {
            *unit = Some(given);
        }
    }
    let nulls: Vec<Option<&str>> = fields
        .iter()
        .map(|field| field.children().find(|node| is(node, "VALUES")).and_then(|node| node.attribute("null")))
        .collect();
    if let Rows::Stream { stream, flagged } = rows {
        binary::rows(stream, &fields, &nulls, *flagged, &mut read)?;
        return Ok(read);
    }
    let (mut line, mut counted) = (1, 0);
    let mut add = |row: Node<'_, '_>, start: usize| {
        let mut values: Vec<Vec<u8>> = Vec::new();
        for cell in row.children().filter(|node| is(node, "TD")) {
            let value = cell.text().unwrap_or_default().trim();
            let null = nulls.get(values.len()).copied().flatten();
            values.push(if null == Some(value) { Vec::new() } else { value.as_bytes().to_vec() });
        }
        line += text[counted..start].bytes().filter(|byte| *byte == b'\n').count();
        counted = start;
        read.add(line, Some(values));
    };
    match apart {
        Some(rows) => {
            let here = |node: Node<'_, '_>| node.range().contains(&rows.start) && !node.has_children();
            if !all(table, "TABLEDATA").next().is_some_and(here) {
                return Err("its rows are not where they seem to be".to_owned());
            }
            pieces::each(text, rows, &mut add)?;
        }
        None => all(table, "TR").for_each(|row| add(row, row.range().start)),
    }
    Ok(read)
}

fn all<'a, 'i>(node: Node<'a, 'i>, name: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.descendants().filter(move |node| is(node, name))
}

/// Whether a node is an element of this name, in whatever namespace.
fn is(node: &Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}
