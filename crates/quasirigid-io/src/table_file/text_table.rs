//! Tables in text as catalogues have them: a header, perhaps behind comments, perhaps units and a rule below it, then a line for each body.
//! Nothing is taken silently: what the reader made of the file stands in the notes of the table.

use std::io::{self, BufRead, BufReader};
use std::path::Path;

use super::TableError;
use super::bodies::{BodyTable, open};
use super::fixed::Columns;
use super::heading;
use super::layout::Layout;

/// Lines by which the layout is judged.
pub(super) const JUDGED: usize = 200;
/// Mark of a comment.
pub(super) const COMMENT: u8 = b'#';

/// A line with its number, from 1.
pub(super) type Numbered = (usize, Vec<u8>);

/// Reads a table in text.
pub(super) fn read(file: &Path) -> Result<BodyTable, TableError> {
    let mut lines = Lines::new(file)?;
    let (mut head, mut comments) = (Vec::<Numbered>::new(), Vec::<Numbered>::new());
    while head.len() <= JUDGED {
        let Some((number, line)) = lines.next()? else { break };
        match is_comment(&line) {
            true if head.is_empty() => comments.push((number, line)),
            true => {}
            false => head.push((number, line)),
        }
    }
    let Some((table, layout)) =
        heading::take(file, &mut head, &comments, |columns, from| widen(file, columns, from))?
    else {
        return Ok(BodyTable::default());
    };
    drop(comments);
    let mut table = InWork { table, layout, decimal_commas: 0 };
    head.iter().for_each(|(number, line)| table.add(*number, line));
    drop(head);
    while let Some((number, line)) = lines.next()? {
        if !is_comment(&line) {
            table.add(number, &line);
        }
    }
    Ok(table.finish())
}

/// Widens columns of fixed width by all lines of the file from one on.
fn widen(file: &Path, columns: &mut Columns, from: usize) -> Result<(), TableError> {
    let mut lines = Lines::new(file)?;
    while let Some((number, line)) = lines.next()? {
        if number >= from && !is_comment(&line) {
            columns.widen(&line);
        }
    }
    columns.settle();
    Ok(())
}

pub(super) fn is_comment(line: &[u8]) -> bool {
    line.trim_ascii_start().first() == Some(&COMMENT)
}

/// A table in work.
struct InWork {
    table: BodyTable,
    layout: Layout,
    /// Numbers with a comma before the decimals.
    decimal_commas: usize,
}

impl InWork {
    fn add(&mut self, number: usize, line: &[u8]) {
        if !self.layout.holds(line) {
            return self.table.unread(format!("line {number} of the table has a text across two columns"));
        }
        let mut fields = self.layout.fields(line);
        if self.layout == Layout::Separated(b';') {
            let commas = fields.iter_mut().flatten().filter_map(|field| decimal_comma(field));
            self.decimal_commas += commas.count();
        }
        self.table.add(number, fields);
    }

    fn finish(mut self) -> BodyTable {
        if self.decimal_commas > 0 {
            let count = self.decimal_commas;
            self.table.notes.push(format!("{count} numbers have a comma before their decimals"));
        }
        self.table
    }
}

/// Writes a point for the comma of a number such as `8,5`; one with three digits behind the comma may be thousands, and stays.
fn decimal_comma(field: &mut [u8]) -> Option<()> {
    let at = field.iter().position(|byte| *byte == b',')?;
    let behind = field[at + 1..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    if behind == 0 || behind == 3 {
        return None;
    }
    field[at] = b'.';
    let number = std::str::from_utf8(field).is_ok_and(|text| text.parse::<f64>().is_ok());
    if !number {
        field[at] = b',';
    }
    number.then_some(())
}

/// Lines of a file that are not empty, whatever ends them.
struct Lines<'f> {
    file: &'f Path,
    input: BufReader<std::fs::File>,
    number: usize,
    waiting: std::collections::VecDeque<Numbered>,
}

impl<'f> Lines<'f> {
    fn new(file: &'f Path) -> Result<Self, TableError> {
        Ok(Self { file, input: BufReader::new(open(file)?), number: 0, waiting: Default::default() })
    }

    fn next(&mut self) -> Result<Option<Numbered>, TableError> {
        let refuse = |cause: io::Error| TableError::File { file: self.file.to_owned(), kind: cause.kind() };
        while self.waiting.is_empty() {
            let mut text = Vec::new();
            if self.input.read_until(b'\n', &mut text).map_err(refuse)? == 0 {
                return Ok(None);
            }
            self.number += 1;
            let marked = if self.number == 1 { text.strip_prefix(b"\xef\xbb\xbf") } else { None };
            let lines = marked.unwrap_or(&text).split(|byte| matches!(byte, b'\r' | b'\n'));
            let lines = lines
                .filter(|line| line.iter().any(|byte| *byte != b' '))
                .map(|line| (self.number, line.to_vec()));
            self.waiting.extend(lines);
        }
        Ok(self.waiting.pop_front())
    }
}
