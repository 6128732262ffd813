//! Elements between two grid points with a direction, and springs, whose words stand in another order than the fields of their cards.

use super::bulk::{Bulk, Field};
use super::entries::real;
use super::words::Words;

/// Adds the cards of a record; false for one of another kind.
pub(super) fn take(bulk: &mut Bulk, kind: [i64; 3], words: &Words) -> bool {
    type Card<'c> = (&'c str, usize, fn(&Words, usize) -> Option<Vec<Field<'static>>>);
    let (name, length, fields): Card<'_> = match kind {
        [2408, 24, 180] => ("CBAR", 16, bar),
        [5408, 54, 261] => ("CBEAM", 18, beam),
        [2608, 26, 60] => ("CBUSH", 14, bush),
        [601, 6, 73] => ("CELAS1", 6, |words, at| spring(words, at, Field::Integer(words.integer(at + 1)?))),
        [201, 2, 69] => ("CDAMP1", 6, |words, at| spring(words, at, Field::Integer(words.integer(at + 1)?))),
        [701, 7, 74] => ("CELAS2", 8, |words, at| spring(words, at, real(words, at + 1)?)),
        [301, 3, 70] => ("CDAMP2", 6, |words, at| spring(words, at, real(words, at + 1)?)),
        _ => return false,
    };
    let all = words.len() - 3;
    if !all.is_multiple_of(length) {
        return false;
    }
    for entry in 0..all / length {
        if let Some(fields) = fields(words, 3 + entry * length) {
            bulk.card(name, words.at, &fields);
        }
    }
    true
}

fn integers<const N: usize>(words: &Words, at: usize) -> Option<[Field<'static>; N]> {
    let mut fields = [Field::Blank; N];
    for (index, field) in fields.iter_mut().enumerate() {
        *field = match words.integer(at + index)? {
            0 => Field::Blank,
            value => Field::Integer(value),
        };
    }
    Some(fields)
}

fn reals<const N: usize>(words: &Words, at: usize) -> Option<[Field<'static>; N]> {
    let mut fields = [Field::Blank; N];
    for (index, field) in fields.iter_mut().enumerate() {
        *field = real(words, at + index)?;
    }
    Some(fields)
}

/// A vector, a grid point or nothing, by the lowest bits of a flag: along the axes of the basic system, of the first end, or to a point.
fn up(words: &Words, at: usize, flag: i64) -> Option<[Field<'static>; 3]> {
    match flag & 3 {
        2 => Some([Field::Integer(words.integer(at)?), Field::Blank, Field::Blank]),
        3 => Some([Field::Blank; 3]),
        _ if (0..3).all(|axis| words.real(at + axis) == Some(0.0)) => Some([Field::Blank; 3]),
        _ => reals(words, at),
    }
}

/// Which axes the direction and the offsets have.
fn axes(flag: i64) -> Field<'static> {
    if flag & 3 == 0 { Field::Word("BGG") } else { Field::Blank }
}

/// EID, PID, GA, GB, three words of the direction, its flag, released components, offsets.
fn bar(words: &Words, at: usize) -> Option<Vec<Field<'static>>> {
    let flag = words.integer(at + 7)?;
    let mut fields = integers::<4>(words, at)?.to_vec();
    fields.extend(up(words, at + 4, flag)?);
    fields.push(axes(flag));
    fields.extend(integers::<2>(words, at + 8)?);
    fields.extend(reals::<6>(words, at + 10)?);
    Some(fields)
}

/// EID, PID, GA, GB, warping at the ends, three words of the direction, its flag, released components, offsets.
fn beam(words: &Words, at: usize) -> Option<Vec<Field<'static>>> {
    let flag = words.integer(at + 9)?;
    let mut fields = integers::<4>(words, at)?.to_vec();
    fields.extend(up(words, at + 6, flag)?);
    fields.push(axes(flag));
    fields.extend(integers::<2>(words, at + 10)?);
    fields.extend(reals::<6>(words, at + 12)?);
    fields.extend(integers::<2>(words, at + 4)?);
    Some(fields)
}

/// EID, PID, GA, GB, three words of the direction, its flag, CID, S, OCID, offsets.
fn bush(words: &Words, at: usize) -> Option<Vec<Field<'static>>> {
    let mut fields = integers::<4>(words, at)?.to_vec();
    fields.extend(up(words, at + 4, words.integer(at + 7)?)?);
    fields.push(Field::Integer(words.integer(at + 8)?));
    fields.push(real(words, at + 9)?);
    fields.push(Field::Integer(words.integer(at + 10)?));
    fields.extend(reals::<3>(words, at + 11)?);
    Some(fields)
}

/// EID, property or constant, both grid points, both components.
fn spring(words: &Words, at: usize, law: Field<'static>) -> Option<Vec<Field<'static>>> {
    let [first, second, of_first, of_second] = integers(words, at + 2)?;
    Some(vec![Field::Integer(words.integer(at)?), law, first, of_first, second, of_second])
}
