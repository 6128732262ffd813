//! Layout of a table in text: values between separators, between blanks, or at fixed places of the line.
//! The header and some rows show which.

use super::fixed::Columns;
use super::line::{fields, words};

/// Separators that are looked for, in this order.
const SEPARATORS: [u8; 4] = [b',', b'\t', b';', b'|'];
/// Share of the rows that have as many words as the header in a table whose values stand between blanks.
const MOST_ROWS: f64 = 0.9;

/// Layout of the lines of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Layout {
    /// Values between separators, with quotation marks.
    Separated(u8),
    /// Values between blanks, with quotation marks.
    Blanks,
    /// Values at places of the line.
    Fixed(Columns),
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
        let count = |line: &[u8]| words(line).map(|words| words.len());
        let names = count(header).unwrap_or(0);
        let counts: Vec<usize> = rows.iter().filter_map(|row| count(row)).collect();
        let alike = counts.iter().filter(|count| **count == names).count();
        let rule = rows.first().filter(|row| is_rule(row));
        if names < 2 || rows.is_empty() {
            Self::Separated(b',')
        } else if let Some(columns) = rule.and_then(|rule| Columns::of_rule(rule)) {
            Self::Fixed(columns)
        } else if alike as f64 >= MOST_ROWS * counts.len() as f64 {
            Self::Blanks
        } else {
            Columns::of_rows(header, rows).map_or(Self::Separated(b','), Self::Fixed)
        }
    }

    /// The values of a line, without the blanks around them; none where a quotation mark is not closed.
    pub(super) fn fields(&self, line: &[u8]) -> Option<Vec<Vec<u8>>> {
        match self {
            Self::Separated(separator) => fields(line, *separator),
            Self::Blanks => words(line),
            Self::Fixed(columns) => Some(columns.values(line)),
        }
    }

    /// Whether each text of the line stands in one column.
    pub(super) fn holds(&self, line: &[u8]) -> bool {
        match self {
            Self::Fixed(columns) => columns.holds(line),
            Self::Separated(_) | Self::Blanks => true,
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
            ("a \"b c\"\n1 2", Layout::Blanks),
        ] {
            assert_eq!(layout(text), expected, "{text:?}");
        }
    }

    #[test]
    fn columns_of_fixed_width_show_by_their_blanks_or_by_a_rule() {
        for text in ["name    P\n2004 FH 0.05\nEros    5.27", "name    P   \n------- ----\n2004 FH 0.05"] {
            let Layout::Fixed(columns) = layout(text) else { panic!("{text:?}") };
            assert_eq!(columns.values(b"2004 FH 0.05"), [b"2004 FH".to_vec(), b"0.05".to_vec()], "{text:?}");
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
