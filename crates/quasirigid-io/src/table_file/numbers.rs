//! Columns of numbers of a table in text with many rows: only the columns that are wanted are read, in one pass over the bytes of the file.

use std::path::Path;

use super::TableError;
use super::bodies::BodyTable;
use super::heading;
use super::layout::Layout;
use super::text_table::{JUDGED, Numbered, is_comment};

/// Column of numbers, and how finely they are written.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct NumberColumn {
    /// Numbers, one for each row.
    pub values: Vec<f64>,
    /// Most places behind the decimal point of any number.
    pub decimals: i32,
    /// Most significant digits of any number.
    pub significant: i32,
}

/// Line of a table that has no numbers where some are wanted.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BadLine {
    /// Number of the line, from 1.
    pub line: usize,
    /// Index of the wanted column; none where the line has another number of values than the heading.
    pub column: Option<usize>,
    /// Text found there, or the number of values.
    pub found: String,
}

/// Table whose columns of numbers cannot be read.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Unnumbered<E> {
    /// A heading that cannot be read.
    Table(TableError),
    /// A heading without the columns that are wanted.
    Unwanted(E),
    /// A line without its numbers.
    Line(BadLine),
}

/// Reads the columns that `wanted` names by their indices, in its order; it sees the names and units of the table alone. Returns them with the
/// notes on the form of the table.
pub(crate) fn read_numbers<E>(
    file: &Path,
    bytes: &[u8],
    wanted: impl FnOnce(&BodyTable) -> Result<Vec<usize>, E>,
) -> Result<(Vec<NumberColumn>, Vec<String>), Unnumbered<E>> {
    let mut lines = lines(bytes).filter(|(_, line)| !is_comment(line));
    let mut head: Vec<Numbered> =
        lines.by_ref().take(JUDGED + 1).map(|(number, line)| (number, line.to_vec())).collect();
    let first = head.first().map_or(0, |(number, _)| *number);
    let comments: Vec<Numbered> = self::lines(bytes)
        .take_while(|(number, _)| *number < first)
        .map(|(number, line)| (number, line.to_vec()))
        .collect();
    let widen = |columns: &mut super::fixed::Columns, from: usize| {
        let below = self::lines(bytes).filter(|(number, line)| *number >= from && !is_comment(line));
        below.for_each(|(_, line)| columns.widen(line));
        columns.settle();
        Ok(())
    };
    let (table, layout) = heading::take(file, &mut head, &comments, widen)
        .map_err(Unnumbered::Table)?
        .ok_or_else(|| Unnumbered::Table(TableError::Empty { file: file.to_owned() }))?;
    let indices = wanted(&table).map_err(Unnumbered::Unwanted)?;
    let mut rows = Rows::new(&indices, table.names.len(), layout);
    for (number, line) in &head {
        rows.add(*number, line).map_err(Unnumbered::Line)?;
    }
    for (number, line) in lines {
        rows.add(number, line).map_err(Unnumbered::Line)?;
    }
    Ok((rows.columns, table.notes))
}

/// Lines that are not blank, with their numbers from 1.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let lines = (1..).zip(bytes.split(|byte| *byte == b'\n'));
    lines.map(|(number, line)| (number, line.trim_ascii_end())).filter(|(_, line)| !line.is_empty())
}

/// The columns that are wanted, up to a line.
struct Rows {
    columns: Vec<NumberColumn>,
    /// For each column of the table its place among those wanted.
    places: Vec<Option<usize>>,
    layout: Layout,
}

impl Rows {
    fn new(indices: &[usize], width: usize, layout: Layout) -> Self {
        let mut places = vec![None; width];
        for (place, index) in indices.iter().enumerate() {
            if let Some(slot) = places.get_mut(*index) {
                *slot = Some(place);
            }
        }
        Self { columns: vec![NumberColumn::default(); indices.len()], places, layout }
    }

    fn add(&mut self, line: usize, text: &[u8]) -> Result<(), BadLine> {
        let quoted = text.contains(&b'"');
        match self.layout {
            Layout::Separated(separator) if !quoted => {
                let fields = text.split(|byte| *byte == separator).map(<[u8]>::trim_ascii);
                self.fields(line, fields, separator == b';')
            }
            Layout::Blanks if !quoted => {
                let words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
                self.fields(line, words, false)
            }
            _ => {
                let fields = self.layout.fields(text).unwrap_or_default();
                let semicolons = self.layout == Layout::Separated(b';');
                self.fields(line, fields.iter().map(Vec::as_slice), semicolons)
            }
        }
    }

    fn fields<'t>(
        &mut self,
        line: usize,
        fields: impl Iterator<Item = &'t [u8]>,
        decimal_commas: bool,
    ) -> Result<(), BadLine> {
        let (mut found, mut ends) = (0, 0);
        for (index, field) in fields.enumerate() {
            found = index + 1;
            ends = if field.is_empty() { ends } else { found };
            let Some(Some(place)) = self.places.get(index) else { continue };
            let bad =
                || BadLine { line, column: Some(*place), found: String::from_utf8_lossy(field).into_owned() };
            let number = if decimal_commas { with_point(field) } else { number(field) };
            let (value, digits) = number.ok_or_else(bad)?;
            let column = &mut self.columns[*place];
            column.values.push(value);
            column.decimals = column.decimals.max(digits.decimals);
            column.significant = column.significant.max(digits.significant);
        }
        let width = self.places.len();
        if found == width || found > width && ends <= width {
            return Ok(()); // separators at the end of the line make empty values
        }
        Err(BadLine { line, column: None, found: format!("{ends} values where the heading has {width}") })
    }
}

/// Digits with which a number is written.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Digits {
    decimals: i32,
    significant: i32,
}

/// A number that is finite, also with the exponent that Fortran writes.
fn number(field: &[u8]) -> Option<(f64, Digits)> {
    let text = std::str::from_utf8(field).ok()?;
    let value = text.parse::<f64>().ok().or_else(|| text.replace(['D', 'd'], "e").parse().ok())?;
    value.is_finite().then(|| (value, digits(field)))
}

/// A number in whose place of the point a comma may stand.
fn with_point(field: &[u8]) -> Option<(f64, Digits)> {
    let pointed: Vec<u8> = field.iter().map(|byte| if *byte == b',' { b'.' } else { *byte }).collect();
    number(&pointed)
}

/// Digits of the text of a number: trailing zeros count, leading ones do not.
fn digits(text: &[u8]) -> Digits {
    let (mut decimals, mut significant, mut behind, mut led) = (0, 0, false, false);
    for (at, byte) in text.iter().enumerate() {
        match byte {
            b'0'..=b'9' => {
                led |= *byte != b'0';
                significant += i32::from(led);
                decimals += i32::from(behind);
            }
            b'.' => behind = true,
            b'e' | b'E' | b'd' | b'D' => {
                let exponent = std::str::from_utf8(&text[at + 1..]).ok();
                decimals -= exponent.and_then(|text| text.parse::<i32>().ok()).unwrap_or(0);
                break;
            }
            _ => {}
        }
    }
    Digits { decimals, significant }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> (f64, i32, i32) {
        let (value, Digits { decimals, significant }) = number(text.as_bytes()).unwrap();
        (value, decimals, significant)
    }

    #[test]
    fn digits_are_those_written() {
        for (text, expected) in [
            ("0.150", (0.15, 3, 3)),
            ("-12.5", (-12.5, 1, 3)),
            ("1.50e-3", (1.5e-3, 5, 3)),
            ("1.5D+2", (150.0, -1, 2)),
            ("0.000000", (0.0, 6, 0)),
            ("1000", (1000.0, 0, 4)),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
        for text in ["nan", "inf", "", "1,5", "x"] {
            assert_eq!(number(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn wanted_columns_are_read_in_their_order() {
        let text = b"# made by hand\nt, name, w\n0.0, a, 1.25\n# between\n0.5,\"b, c\", 2.5,\n";
        let (columns, _) = read_numbers(Path::new("x.csv"), text, |table| {
            assert_eq!(table.names, ["t", "name", "w"]);
            Ok::<_, ()>(vec![2, 0])
        })
        .unwrap();
        assert_eq!(columns[0].values, [1.25, 2.5]);
        assert_eq!((columns[0].decimals, columns[0].significant), (2, 3));
        assert_eq!(columns[1].values, [0.0, 0.5]);
    }

    #[test]
    fn bad_lines_are_told_by_their_number() {
        let read = |text: &str| {
            let read = read_numbers(Path::new("x.csv"), text.as_bytes(), |_| Ok::<_, ()>(vec![1]));
            let Err(Unnumbered::Line(bad)) = read else { panic!("{read:?}") };
            (bad.line, bad.column, bad.found)
        };
        assert_eq!(read("t,w\n0,1\n1,nan\n"), (3, Some(0), "nan".to_owned()));
        assert_eq!(read("t,w\n0,1\n\n1,2\n2\n"), (5, None, "1 values where the heading has 2".to_owned()));
    }
}
