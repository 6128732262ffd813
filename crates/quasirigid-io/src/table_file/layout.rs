//! Layout of a table in text: values between separators, between blanks, or at fixed places of the line.
//! The header and some rows show which; a table of fixed width shows its columns by what is blank in every line, or by a line of dashes.

use std::ops::Range;

use super::line::fields;

/// Separators that are looked for, in this order.
const SEPARATORS: [u8; 4] = [b',', b'\t', b';', b'|'];
/// Share of the rows that have as many words as the header in a table whose values stand between blanks.
const MOST_ROWS: f64 = 0.9;

/// Layout of the lines of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Values between separators, with quotation marks.
    Separated(u8),
    /// Values between blanks.
    Blanks,
    /// Values at places of the line, in characters; the last goes on to the end of the line.
    Fixed(Vec<Range<usize>>),
}

impl Layout {
    /// The layout of a header and of the lines below it.
    pub(super) fn of(header: &[u8], rows: &[Vec<u8>]) -> Self {
        let found = SEPARATORS.into_iter().filter_map(|separator| {
            let columns = fields(header, separator)?.len();
            let fits = rows.iter().any(|row| fields(row, separator).is_some_and(|row| row.len() == columns));
            (columns > 1).then_some((fits, columns, separator))
        });
        let best = found.reduce(|a, b| if (b.0, b.1) > (a.0, a.1) { b } else { a });
        if let Some((_, _, separator)) = best {
            return Self::Separated(separator);
        }
        let words = words(header).len();
        let rows: Vec<&Vec<u8>> = rows.iter().collect();
        let dashes = rows.first().filter(|row| is_rule(row));
        let alike = rows.iter().filter(|row| self::words(row).len() == words).count();
        match dashes {
            _ if words < 2 || rows.is_empty() => Self::Separated(b','),
            Some(row) if runs(row).len() > 1 => Self::Fixed(runs(row)),
            _ if alike as f64 >= MOST_ROWS * rows.len() as f64 => Self::Blanks,
            _ => Self::fixed(header, &rows).unwrap_or(Self::Separated(b',')),
        }
    }

    /// Columns by the places that are blank in every line: a run without a name is the second word of the values before it. None where a
    /// column would have a name alone.
    fn fixed(header: &[u8], rows: &[&Vec<u8>]) -> Option<Self> {
        let lines = std::iter::once(header).chain(rows.iter().map(|row| row.as_slice()));
        let mut filled: Vec<bool> = Vec::new();
        for line in lines {
            for (place, letter) in String::from_utf8_lossy(line).chars().enumerate() {
                if filled.len() <= place {
                    filled.resize(place + 1, false);
                }
                filled[place] |= !letter.is_whitespace();
            }
        }
        let mut columns: Vec<Range<usize>> = Vec::new();
        for run in runs_where(&filled) {
            match columns.last_mut() {
                Some(before) if cut(header, &run, false).is_empty() => before.end = run.end,
                _ => columns.push(run),
            }
        }
        let whole = |column: &Range<usize>| rows.iter().any(|row| !cut(row, column, false).is_empty());
        let named = columns.first().is_some_and(|column| !cut(header, column, false).is_empty());
        (columns.len() > 1 && named && columns.iter().all(whole)).then_some(Self::Fixed(columns))
    }

    /// The values of a line, without the blanks around them; none where a quotation mark is not closed.
    pub(super) fn fields(&self, line: &[u8]) -> Option<Vec<Vec<u8>>> {
        match self {
            Self::Separated(separator) => fields(line, *separator),
            Self::Blanks => Some(words(line)),
            Self::Fixed(columns) => {
                let last = columns.len() - 1;
                let cut = |(i, column): (usize, &Range<usize>)| cut(line, column, i == last).into_bytes();
                Some(columns.iter().enumerate().map(cut).collect())
            }
        }
    }

    /// The layout in words; none of values between commas.
    pub(super) fn words(&self) -> Option<String> {
        Some(match self {
            Self::Separated(b',') => return None,
            Self::Separated(b'\t') => "values between tabs".to_owned(),
            Self::Separated(separator) => format!("values between {:?}", char::from(*separator)),
            Self::Blanks => "values between blanks".to_owned(),
            Self::Fixed(columns) => format!("{} columns of fixed width", columns.len()),
        })
    }
}

/// Whether a line is a rule, as programs draw below the header.
pub(super) fn is_rule(line: &[u8]) -> bool {
    let drawn = line.iter().filter(|byte| matches!(byte, b'-' | b'=')).count();
    drawn > 2
        && line
            .iter()
            .all(|byte| matches!(byte, b'-' | b'=' | b'+' | b'|' | b',' | b';' | b'\t' | b' ' | b'\r'))
}

fn words(line: &[u8]) -> Vec<Vec<u8>> {
    let words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
    words.map(<[u8]>::to_vec).collect()
}

/// Runs of characters that are not blank.
fn runs(line: &[u8]) -> Vec<Range<usize>> {
    runs_where(
        &String::from_utf8_lossy(line).chars().map(|letter| !letter.is_whitespace()).collect::<Vec<_>>(),
    )
}

fn runs_where(filled: &[bool]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for place in (0..filled.len()).filter(|place| filled[*place]) {
        match runs.last_mut().filter(|run| run.end == place) {
            Some(run) => run.end = place + 1,
            None => runs.push(place..place + 1),
        }
    }
    runs
}

/// Characters of a line, without the blanks around them; `open` takes the rest of the line.
fn cut(line: &[u8], column: &Range<usize>, open: bool) -> String {
    let text = String::from_utf8_lossy(line);
    let rest = text.chars().skip(column.start);
    let cut: String = if open { rest.collect() } else { rest.take(column.len()).collect() };
    cut.trim().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> (Vec<u8>, Vec<Vec<u8>>) {
        let mut lines = text.lines().map(|line| line.as_bytes().to_vec());
        (lines.next().unwrap_or_default(), lines.collect())
    }

    fn layout(text: &str) -> Layout {
        let (header, rows) = rows(text);
        Layout::of(&header, &rows)
    }

    #[test]
    fn header_and_rows_show_the_layout() {
        for (text, expected) in [
            ("a,b\n1,2", Layout::Separated(b',')),
            ("a\tb\n1,5\t2", Layout::Separated(b'\t')),
            ("a;b (x,y)\n1,5;2,5", Layout::Separated(b';')),
            ("a|b\n1|2", Layout::Separated(b'|')),
            ("a  b\n1 2\n30   4", Layout::Blanks),
            ("alone\n1", Layout::Separated(b',')),
            ("spin rate\n1", Layout::Separated(b',')),
            ("name    P\n2004 FH 0.05\nEros    5.27", Layout::Fixed(vec![0..7, 8..12])),
            ("name      P [h]\n--------- -----\nToutatis   130 ", Layout::Fixed(vec![0..9, 10..15])),
        ] {
            assert_eq!(layout(text), expected, "{text:?}");
        }
    }

    #[test]
    fn a_value_that_is_missing_at_its_place_is_empty() {
        let (header, rows) = rows("name      P   D\n2004 FH  0.05  30\nEros          17");
        let layout = Layout::of(&header, &rows);
        let texts = |line: &[u8]| {
            layout
                .fields(line)
                .map(|all| all.iter().map(|text| String::from_utf8_lossy(text).into_owned()).collect())
        };
        assert_eq!(texts(&rows[1]), Some(vec!["Eros".to_owned(), String::new(), "17".to_owned()]));
    }
}
