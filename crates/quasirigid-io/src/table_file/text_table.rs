//! Tables in text as catalogues have them: a header, perhaps behind comments, perhaps units and a rule below it, then a line for each body.
//! Nothing is taken silently: what the reader made of the file stands in the notes of the table.

use std::io::{self, BufRead, BufReader};
use std::path::Path;

use super::TableError;
use super::bodies::{BodyTable, open};
use super::formula::unguarded;
use super::layout::{Layout, is_rule};
use super::names::unit;

/// Lines by which the layout is judged.
const JUDGED: usize = 200;
/// Mark of a comment.
const COMMENT: u8 = b'#';

/// A line with its number, from 1.
type Numbered = (usize, Vec<u8>);

/// Reads a table in text.
pub(super) fn read(file: &Path) -> Result<BodyTable, TableError> {
    let mut lines = Lines::new(file)?;
    let (mut head, mut comment) = (Vec::<Numbered>::new(), None);
    while head.len() <= JUDGED {
        let Some((number, line)) = lines.next()? else { break };
        if line.starts_with(b"#") {
            comment = Some((number, line)).filter(|_| head.is_empty()).or(comment);
        } else {
            head.push((number, line));
        }
    }
    let Some(mut table) = start(file, &mut head, comment)? else { return Ok(BodyTable::default()) };
    head.iter().for_each(|(number, line)| table.add(*number, line));
    while let Some((number, line)) = lines.next()? {
        if line.first() != Some(&COMMENT) {
            table.add(number, &line);
        }
    }
    Ok(table.finish())
}

/// The table of a header, which is taken from the first lines with what belongs to it.
fn start(
    file: &Path,
    head: &mut Vec<Numbered>,
    comment: Option<Numbered>,
) -> Result<Option<InWork>, TableError> {
    let Some((_, first)) = head.first() else { return Ok(None) };
    let rows: Vec<Vec<u8>> = head.iter().skip(1).map(|(_, line)| line.clone()).collect();
    let layout = Layout::of(first, &rows);
    let mut notes = Vec::new();
    let titles = match comment.and_then(|(_, comment)| titles_in_comment(&layout, first, &comment)) {
        Some(titles) => {
            notes.push("the names of the columns stand in the comment above the rows".to_owned());
            titles
        }
        None => {
            let titles = layout.fields(first).ok_or_else(|| TableError::Names { file: file.to_owned() })?;
            head.remove(0);
            titles
        }
    };
    notes.splice(0..0, layout.words().map(|words| format!("the table has {words}")));
    let titles: Vec<String> =
        titles.iter().map(|title| unguarded(&String::from_utf8_lossy(title)).into_owned()).collect();
    let mut table = BodyTable::of(titles.into_iter());
    head.drain(..head.iter().take_while(|(_, line)| is_rule(line)).count());
    if let Some(units) = units_below(&layout, table.names.len(), head) {
        notes.push("the row below the names of the columns holds their units".to_owned());
        table.units.iter_mut().zip(units).for_each(|(unit, found)| *unit = unit.take().or(found));
        head.remove(0);
        head.drain(..head.iter().take_while(|(_, line)| is_rule(line)).count());
    }
    table.notes = notes;
    Ok(Some(InWork { table, layout, decimal_commas: 0 }))
}

/// Names of the columns in the comment above a first line of numbers.
fn titles_in_comment(layout: &Layout, first: &[u8], comment: &[u8]) -> Option<Vec<Vec<u8>>> {
    let values = layout.fields(first)?;
    let is_number =
        |value: &Vec<u8>| std::str::from_utf8(value).is_ok_and(|text| text.parse::<f64>().is_ok());
    let numbers = values.iter().filter(|value| is_number(value)).count();
    let text = comment.iter().position(|byte| *byte != COMMENT).map(|start| &comment[start..])?;
    let titles = layout.fields(text)?;
    let names = titles.iter().all(|title| !title.is_empty() && !is_number(title));
    (2 * numbers >= values.len() && names && titles.len() == values.len()).then_some(titles)
}

/// Units of the columns, where the first row has nothing but units and the second has numbers below them.
fn units_below(layout: &Layout, columns: usize, head: &[Numbered]) -> Option<Vec<Option<String>>> {
    let texts = |line: &Numbered| -> Option<Vec<String>> {
        let fields = layout.fields(&line.1)?;
        fields.into_iter().map(|field| String::from_utf8(field).ok()).collect()
    };
    let first = texts(head.first()?)?;
    let bare = |text: &String| text.trim_matches(['[', ']', '(', ')']).to_owned();
    let units: Vec<Option<String>> = first
        .iter()
        .map(|text| if text.is_empty() { Some(String::new()) } else { unit(&bare(text)) })
        .collect();
    let below: Vec<Vec<String>> = head.iter().skip(1).take(JUDGED).filter_map(texts).collect();
    let numeric = |column: usize| {
        below.iter().any(|row| row.get(column).is_some_and(|text| text.parse::<f64>().is_ok()))
    };
    let named =
        (0..first.len()).filter(|column| units[*column].as_ref().is_some_and(|unit| !unit.is_empty()));
    let named: Vec<usize> = named.collect();
    let sound = first.len() == columns && units.iter().all(Option::is_some) && !named.is_empty();
    (sound && named.into_iter().all(numeric)).then_some(units)
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
