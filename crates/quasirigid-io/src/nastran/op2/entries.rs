//! Entries of one length: each word becomes a field as a letter of the layout says.

use super::bulk::{Bulk, Field};
use super::layouts::{COUNTED, LAYOUTS};
use super::words::Words;

/// Greatest number of anything, also of what NASTRAN makes; most real numbers are above as integers.
const LAST: i64 = 1_010_000_000;
/// A real number that stands for a blank field, within what is left of its digits.
const BLANK: [f64; 2] = [1.7368e-18, 1e-22];
/// Numbers from which on NASTRAN makes materials of its own for layers, and before which they end.
const MADE: i64 = 100_000_000;
const LAYERS: i64 = 500_000_000;

/// Adds the cards of a record; false for one of another kind.
pub(super) fn take(bulk: &mut Bulk, kind: [i64; 3], words: &Words) -> bool {
    if let Some((_, name, length)) = COUNTED.iter().find(|(known, ..)| *known == kind) {
        let count = if *length == 0 { 1 } else { (words.len() - 3) / length };
        for entry in 0..count {
            if *length == 0 || words.integer(3 + entry * length).is_some_and(|label| label < MADE) {
                bulk.card(name, words.at, &[]);
            }
        }
        return true;
    }
    let Some((_, name, layouts)) = LAYOUTS.iter().find(|(known, ..)| *known == kind) else { return false };
    let Some(layout) = layouts.iter().find(|layout| fits(layout, words)) else { return false };
    let (mut place, length) = (3, length(layout, words));
    let mut fields = Vec::with_capacity(layout.len());
    while place + length <= words.len() {
        // a plate that NASTRAN makes of layers, whose card is there too
        if *name == "PSHELL"
            && words.integer(place + 1).is_some_and(|material| (MADE..LAYERS).contains(&material))
        {
            place += length;
            continue;
        }
        fields.clear();
        let mut at = place;
        for letter in layout.chars() {
            fields.extend(field(letter, words, &mut at));
        }
        bulk.card(name, words.at, &fields);
        place += length;
    }
    true
}

/// Words of an entry.
fn length(layout: &str, words: &Words) -> usize {
    layout.chars().map(|letter| width(letter, words)).sum()
}

fn width(letter: char, words: &Words) -> usize {
    match letter {
        '_' => 0,
        'd' if !words.is_long() => 2,
        letter if letter.is_ascii_uppercase() => 0,
        _ => 1,
    }
}

/// Whether a record has whole entries of a layout, whose integers and real numbers are what they should be.
fn fits(layout: &str, words: &Words) -> bool {
    let (length, all) = (length(layout, words), words.len() - 3);
    if length == 0 || all == 0 || !all.is_multiple_of(length) {
        return false;
    }
    (0..all / length).all(|entry| {
        let mut at = 3 + entry * length;
        layout.chars().all(|letter| {
            let possible = match letter {
                'i' | 'z' => words.integer(at).is_some_and(|value| (-1..=LAST).contains(&value)),
                'r' | 't' | 'm' => words.real(at).is_some_and(ordinary),
                'd' => words.double(at).is_some_and(ordinary),
                _ => true,
            };
            at += width(letter, words);
            possible
        })
    })
}

/// Whether a number is one that a deck may have, and no integer read as one.
fn ordinary(value: f64) -> bool {
    value == 0.0 || (1e-35..1e35).contains(&value.abs())
}

/// The field of a letter, if it has one.
fn field(letter: char, words: &Words, at: &mut usize) -> Option<Field<'static>> {
    let place = *at;
    *at += width(letter, words);
    Some(match letter {
        '_' => Field::Blank,
        'x' => return None,
        'K' => Field::Word("K"),
        'B' => Field::Word("B"),
        'i' => Field::Integer(words.integer(place)?),
        'z' => match words.integer(place)? {
            0 => Field::Blank,
            value => Field::Integer(value),
        },
        'd' => Field::Double(words.double(place)?),
        't' => match real(words, place)? {
            Field::Single(value) if value <= 0.0 => Field::Blank,
            Field::Double(value) if value <= 0.0 => Field::Blank,
            value => value,
        },
        // NX Nastran DMAP Programmer's Guide, GEOM2: 512 (MCID + 1) stands for a system in place of an angle
        'm' => match words.real(place)? {
            angle if angle >= 512.0 => Field::Integer((angle / 512.0) as i64 - 1),
            _ => real(words, place)?,
        },
        _ => real(words, place)?,
    })
}

/// A real number of one word, as short as it may be written.
pub(super) fn real(words: &Words, place: usize) -> Option<Field<'static>> {
    let [blank, within] = BLANK;
    if (words.real(place)?.abs() - blank).abs() < within {
        return Some(Field::Blank);
    }
    if words.is_long() {
        return words.double(place).map(Field::Double);
    }
    words.single(place).map(Field::Single)
}
