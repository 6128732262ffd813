//! Texts in CSV that no spreadsheet takes for a formula.
//!
//! A spreadsheet computes a cell that begins with `=`, `+`, `-` or `@`. A cell begins where a text does; by the settings of some countries also
//! behind a semicolon, and where quotes are not understood behind a tab or a line break; blanks and apostrophes before the sign do not count.
//! There an apostrophe is written directly before the sign, and taken away by the reader, so that what is read is what was written. A text
//! that is a number as a whole is left alone.

use std::borrow::Cow;

/// Signs that begin a formula, with the wide ones of East Asian keyboards.
const SIGNS: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];
/// Characters that may end a cell.
const ENDS: [char; 4] = [';', '\t', '\n', '\r'];
const GUARD: char = '\'';

/// A text as it is written in a cell.
pub(crate) fn guarded(text: &str) -> Cow<'_, str> {
    let signs = signs(text);
    if signs.is_empty() || text.parse::<f64>().is_ok() {
        return Cow::Borrowed(text);
    }
    let mut cell = text.to_owned();
    signs.iter().rev().for_each(|sign| cell.insert(*sign, GUARD));
    Cow::Owned(cell)
}

/// The text that stands in a cell.
pub(crate) fn unguarded(cell: &str) -> Cow<'_, str> {
    let mut signs = signs(cell);
    signs.retain(|sign| cell[..*sign].ends_with(GUARD));
    if signs.is_empty() {
        return Cow::Borrowed(cell);
    }
    let mut text = cell.to_owned();
    signs.iter().rev().for_each(|sign| text.replace_range(sign - GUARD.len_utf8()..*sign, ""));
    Cow::Owned(text)
}

/// Places of the signs that would begin a formula.
fn signs(text: &str) -> Vec<usize> {
    let mut places = Vec::new();
    let mut begins = true;
    for (place, letter) in text.char_indices() {
        if begins && SIGNS.contains(&letter) {
            places.push(place);
        }
        begins = ENDS.contains(&letter) || begins && (letter == GUARD || letter.is_whitespace());
    }
    places
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn formulas_get_an_apostrophe_and_lose_it_again() {
        for (text, cell) in [
            ("=HYPERLINK(\"a\")", "'=HYPERLINK(\"a\")"),
            ("+1+cmd|' /C calc'!A0", "'+1+cmd|' /C calc'!A0"),
            ("@SUM(1)", "'@SUM(1)"),
            ("-2+3", "'-2+3"),
            ("＝1+1", "'＝1+1"),
            ("\t=1", "\t'=1"),
            ("\u{a0} =1", "\u{a0} '=1"),
            ("a;=1;\r\n-b", "a;'=1;\r\n'-b"),
            ("'=1", "''=1"),
            ("'-1", "''-1"),
        ] {
            assert_eq!(guarded(text), cell);
            assert_eq!(unguarded(cell), text);
        }
    }

    #[test]
    fn numbers_and_other_texts_stay_as_they_are() {
        for text in ["", "-3", "-3.5e-7", "+1", "-inf", "boom -x", "a=b", "it's", "'quoted'", "1 - 2; 3 = 3"]
        {
            assert_eq!(guarded(text), text);
            assert_eq!(unguarded(text), text);
        }
        assert_eq!(unguarded("'-3"), "-3", "as a spreadsheet reads it");
    }

    proptest! {
        #[test]
        fn every_text_comes_back(text in "[-=+@＝;'1a\t\r\n\u{a0} ]{0,12}") {
            let cell = guarded(&text);
            prop_assert_eq!(&*unguarded(&cell), &*text);
        }

        /// Read as a spreadsheet would, in every country's settings: no cell begins with a sign, unless the whole is a number.
        #[test]
        fn no_cell_begins_with_a_sign(text in "[-=+@＝;'1a\t\r\n\u{a0} ]{0,12}") {
            let cell = guarded(&text);
            let begins = |part: &str| part.trim_start().starts_with(SIGNS);
            prop_assert!(cell.parse::<f64>().is_ok() || !cell.split(ENDS).any(begins), "{:?}", cell);
        }
    }
}
