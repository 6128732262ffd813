//! One line of comma-separated values.
//!
//! CSV at large lets a quoted text go on over lines, so that one lone mark takes every row up to the next mark. A table of bodies has a line
//! for each body; a mark that is not closed on its line spoils that line and no other.

/// The fields of a line, without the blanks around them; none where a quotation mark is not closed.
///
/// A mark opens a text at the start of a field alone, and a double one in a text stands for itself.
pub(super) fn fields(line: &[u8], separator: u8) -> Option<Vec<Vec<u8>>> {
    let (mut fields, mut field) = (Vec::new(), Vec::new());
    let (mut quoted, mut starts) = (false, true);
    let mut bytes = line.iter().peekable();
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' if quoted => match bytes.next_if_eq(&&b'"') {
                Some(_) => field.push(b'"'),
                None => quoted = false,
            },
            b'"' if starts => quoted = true,
            _ if *byte == separator && !quoted => fields.push(std::mem::take(&mut field)),
            _ => field.push(*byte),
        }
        starts = *byte == separator && !quoted;
    }
    fields.push(field);
    (!quoted).then(|| fields.iter().map(|field| field.trim_ascii().to_vec()).collect())
}

/// The words of a line between blanks; none where a quotation mark is not closed. A mark opens a text at the start of a word alone, and
/// closes it at the end of one.
pub(super) fn words(line: &[u8]) -> Option<Vec<Vec<u8>>> {
    let (mut words, mut rest) = (Vec::new(), line.trim_ascii());
    while let Some(first) = rest.first() {
        let quoted = *first == b'"';
        let ends = |k: usize| rest.get(k).is_none_or(u8::is_ascii_whitespace);
        let end = match quoted {
            true => (1..rest.len()).find(|k| rest[*k] == b'"' && ends(k + 1))?,
            false => (0..=rest.len()).find(|k| ends(*k))?,
        };
        words.push(rest[usize::from(quoted)..end].to_vec());
        rest = rest[end + usize::from(quoted)..].trim_ascii_start();
    }
    Some(words)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_mark_without_its_partner_spoils_the_line() {
        for line in ["\"", "a,\"b", "\"a\"\"", "\"a\",\"b,c", "\"\"\""] {
            assert_eq!(fields(line.as_bytes(), b','), None, "{line}");
        }
    }

    #[test]
    fn words_may_be_quoted() {
        let found = words(b" \"test 1a\"  5\"x \"\" \"a \"b\" ").expect("closed");
        assert_eq!(found, [&b"test 1a"[..], b"5\"x", b"", b"a \"b"]);
        assert_eq!(words(b"a \"b c"), None);
    }

    proptest! {
        /// The fields are those of the reader of CSV; where a mark is not closed, that reader goes on into the next line.
        #[test]
        fn fields_are_those_of_the_reader_of_csv(line in "[a\", ]{1,12}") {
            let text = format!("{line}\nnext\n");
            let mut reader = csv::ReaderBuilder::new()
                .has_headers(false)
                .flexible(true)
                .trim(csv::Trim::All)
                .from_reader(text.as_bytes());
            let rows: Vec<_> = reader.byte_records().filter_map(Result::ok).collect();
            let expected = (rows.len() == 2).then(|| rows[0].iter().map(<[u8]>::to_vec).collect());
            prop_assert_eq!(fields(line.as_bytes(), b','), expected, "{:?}", line);
        }
    }
}
