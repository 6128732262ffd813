//! Entries of any length: rigid elements, layers, sections of the library, tapered beams and parameters.

use super::bulk::{Bulk, Field};
use super::entries::real;
use super::words::Words;

/// Order of the records of a table by the first word of their kind: sections of the library, then what NASTRAN made of them, then layers.
pub(super) fn rank(kind: i64) -> u8 {
    match kind {
        9102 | 9202 => 0,
        2706 | 15006 => 2,
        _ => 1,
    }
}

/// Adds the cards of a record; false for one of another kind.
pub(super) fn take(bulk: &mut Bulk, kind: [i64; 3], words: &Words) -> bool {
    match kind {
        [6901, 69, 295] => follow(bulk, words),
        [7101, 71, 187] => mean(bulk, words),
        [2706, 27, 287] => layers(bulk, words),
        [15006, 150, 604] => numbered_layers(bulk, words),
        [9102, 91, 52] => library(bulk, words, "PBARL"),
        [9202, 92, 53] => library(bulk, words, "PBEAML"),
        [5402, 54, 262] => beams(bulk, words),
        [16006, 160, 903] => solid_layers(bulk, words),
        [4901, 49, 17] => equations(bulk, words),
        [4891, 60, 83] => sets(bulk, words),
        _ => return false,
    }
    true
}

/// The mass factor among the parameters: name in two words, 2 for a real number, the number.
pub(super) fn parameters(bulk: &mut Bulk, words: &Words) {
    for at in 0..words.len() {
        let real_follows = words.letters(at, 2) == "WTMASS" && words.integer(at + 2) == Some(2);
        if let (true, Some(factor)) = (real_follows, real(words, at + 3)) {
            bulk.card("PARAM", words.at, &[Field::Word("WTMASS"), factor]);
        }
    }
}

/// Words behind the last word of this value, as each entry has them behind its own.
fn behind(words: &Words, end: i64) -> usize {
    (3..words.len()).rev().take_while(|place| words.integer(*place) != Some(end)).count()
}

/// EID, GN, CM, grid points, -1.
fn follow(bulk: &mut Bulk, words: &Words) {
    let (mut at, extra) = (3, behind(words, -1));
    while at + 3 < words.len() {
        let end = (at..words.len()).find(|place| words.integer(*place) == Some(-1)).unwrap_or(words.len());
        let fields: Vec<Field<'_>> =
            (at..end).filter_map(|place| words.integer(place)).map(Field::Integer).collect();
        bulk.card("RBE2", words.at, &fields);
        at = end + 1 + extra;
    }
}

/// EID, REFG, REFC, then weight, components, grid points and -1 up to -2, then dependent components up to -3.
fn mean(bulk: &mut Bulk, words: &Words) {
    let (mut at, extra) = (3, behind(words, -3));
    while at + 3 < words.len() {
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let mut fields = vec![integer(at), Field::Blank, integer(at + 1), integer(at + 2)];
        at += 3;
        let (mut first, mut dependent) = (true, false);
        while let Some(word) = words.integer(at) {
            match word {
                -3 => break,
                -2 if matches!(words.integer(at + 1), Some(1..)) => {
                    dependent = true;
                    fields.push(Field::Word("UM"));
                }
                -2 => {}
                -1 => first = true,
                _ if dependent => fields.push(Field::Integer(word)),
                _ if first => {
                    fields.extend(real(words, at));
                    first = false;
                }
                _ => fields.push(Field::Integer(word)),
            }
            at += 1;
        }
        bulk.card("RBE3", words.at, &fields);
        at += 1 + extra;
    }
}

/// PID, number of layers, less than 0 where their mirror image follows, Z0, NSM, SB, FT, TREF, GE; of each layer MID, T, THETA, SOUT.
fn layers(bulk: &mut Bulk, words: &Words) {
    let mut at = 3;
    while let (Some(label), Some(count)) = (words.integer(at), words.integer(at + 1)) {
        let half = if count < 0 { Field::Word("SYM") } else { Field::Blank };
        let number = |place: usize| real(words, place).unwrap_or(Field::Blank);
        let mut fields = vec![Field::Integer(label), number(at + 2), number(at + 3)];
        fields.extend([Field::Blank; 4]);
        fields.push(half);
        at += 8;
        for _ in 0..count.unsigned_abs() {
            let Some(material) = words.integer(at) else { return };
            fields.extend([Field::Integer(material), number(at + 1), number(at + 2), Field::Blank]);
            at += 4;
        }
        bulk.card("PCOMP", words.at, &fields);
    }
}

/// PID, options, Z0, NSM, SB, FT, TREF, GE; of each layer its number, MID, T, THETA, SOUT up to five times -1.
fn numbered_layers(bulk: &mut Bulk, words: &Words) {
    let mut at = 3;
    while at + 8 < words.len() {
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let number = |place: usize| real(words, place).unwrap_or(Field::Blank);
        let mut fields = vec![integer(at), number(at + 2), number(at + 3)];
        fields.extend([Field::Blank; 5]);
        at += 8;
        while words.integer(at).is_some_and(|layer| layer != -1) {
            fields.extend([integer(at), integer(at + 1), number(at + 2), number(at + 3)]);
            fields.extend([Field::Blank; 4]);
            at += 5;
        }
        bulk.card("PCOMPG", words.at, &fields);
        at += 5;
    }
}

/// PID, CORDM, PSDIR, SB, NB, TREF, GE and a word without meaning; of each layer its number, MID, T, THETA and four more up to eight times -1.
/// pyNastran, `op2/tables/geom/ept.py`.
fn solid_layers(bulk: &mut Bulk, words: &Words) {
    let mut at = 3;
    while at + 8 < words.len() {
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let number = |place: usize| real(words, place).unwrap_or(Field::Blank);
        let mut fields = vec![integer(at), integer(at + 1), integer(at + 2)];
        fields.extend([Field::Blank; 5]);
        at += 8;
        while words.integer(at).is_some_and(|layer| layer != -1) {
            fields.extend([integer(at), integer(at + 1), number(at + 2), number(at + 3)]);
            fields.extend([Field::Blank; 4]);
            at += 8;
        }
        bulk.card("PCOMPS", words.at, &fields);
        at += 8;
    }
}

/// SID, then grid point, component and factor of each term up to three times -1. pyNastran, `op2/tables/geom/geom4.py`.
fn equations(bulk: &mut Bulk, words: &Words) {
    let mut at = 3;
    while at + 3 < words.len() {
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let mut fields = vec![integer(at)];
        at += 1;
        while words.integer(at).is_some_and(|point| point != -1) {
            let number = real(words, at + 2).unwrap_or(Field::Blank);
            fields.extend([integer(at), integer(at + 1), number]);
            // two terms to a line, between blank fields
            if fields.len() % 8 == 7 {
                fields.extend([Field::Blank; 2]);
            }
            at += 3;
        }
        bulk.card("MPC", words.at, &fields);
        at += 3;
    }
}

/// SID, then sets up to -1.
fn sets(bulk: &mut Bulk, words: &Words) {
    let all: Vec<i64> = (3..words.len()).filter_map(|place| words.integer(place)).collect();
    for sets in all.split(|set| *set == -1).filter(|sets| !sets.is_empty()) {
        let fields: Vec<Field<'_>> = sets.iter().map(|set| Field::Integer(*set)).collect();
        bulk.card("MPCADD", words.at, &fields);
    }
}

/// PID, MID, group and type of two words each, sizes and extra mass, -1; of tapered beams the sizes at each place.
fn library(bulk: &mut Bulk, words: &Words, name: &str) {
    let mut at = 3;
    while at + 6 < words.len() {
        let end = (at..words.len()).find(|place| words.integer(*place) == Some(-1)).unwrap_or(words.len());
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let kind = words.letters(at + 4, 2);
        let mut fields = vec![integer(at), integer(at + 1), Field::Blank, Field::Word(&kind)];
        fields.extend([Field::Blank; 4]);
        // the first place of a beam begins with its share of the length and a flag
        let first = if name == "PBEAML" { at + 8 } else { at + 6 };
        fields.extend((first..end).filter_map(|place| real(words, place)));
        bulk.card(name, words.at, &fields);
        at = end + 1;
    }
}

/// Words before the places of a beam, of each of its eleven places, and behind them.
const BEAM: [usize; 3] = [5, 16, 16];

/// PID, MID, number of places, whether all are alike, a share; of each place SO, its share of the length, A, I1, I2, I12, J, NSM and four
/// points; then K1, K2 and fourteen more.
fn beams(bulk: &mut Bulk, words: &Words) {
    let [before, place, behind] = BEAM;
    let length = before + 11 * place + behind;
    for entry in 0..(words.len() - 3) / length {
        let at = 3 + entry * length;
        let integer = |place: usize| words.integer(place).map_or(Field::Blank, Field::Integer);
        let numbers = |first: usize, count: usize| {
            (first..first + count).map(|place| real(words, place).unwrap_or(Field::Blank))
        };
        let of_place = |index: usize| at + before + index * place;
        let mut fields = vec![integer(at), integer(at + 1)];
        fields.extend(numbers(of_place(0) + 2, 14));
        for index in (1..11).filter(|index| words.real(of_place(*index) + 1).is_some_and(|at| at > 0.0)) {
            fields.push(Field::Word("YES"));
            fields.extend(numbers(of_place(index) + 1, 15));
        }
        fields.extend(numbers(of_place(11), behind));
        bulk.card("PBEAM", words.at, &fields);
    }
}
