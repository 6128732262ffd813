//! Words of a logical record: integers, reals and letters, in words of 32 or 64 bits and either byte order.

use std::borrow::Cow;
use std::ops::Range;

use super::tape::Layout;

/// The words of a record.
pub(crate) struct Words<'a> {
    bytes: Cow<'a, [u8]>,
    layout: Layout,
    /// First byte in the file.
    pub at: usize,
}

impl<'a> Words<'a> {
    /// The words in pieces of a file, which are inside it.
    pub fn new(file: &'a [u8], pieces: &[Range<usize>], layout: Layout) -> Self {
        let of = |piece: &Range<usize>| file.get(piece.clone()).unwrap_or_default();
        let bytes = match pieces {
            [] => Cow::Borrowed(&file[..0]),
            [piece] => Cow::Borrowed(of(piece)),
            pieces => Cow::Owned(pieces.iter().flat_map(of).copied().collect()),
        };
        Self { bytes, layout, at: pieces.first().map_or(0, |piece| piece.start) }
    }

    /// Number of words.
    pub fn len(&self) -> usize {
        self.bytes.len() / self.layout.width()
    }

    /// Whether both have the same bytes.
    pub fn same(&self, other: &Words<'_>) -> bool {
        self.bytes == other.bytes
    }

    pub fn is_long(&self) -> bool {
        self.layout.long
    }

    pub fn integer(&self, place: usize) -> Option<i64> {
        if self.layout.long {
            return self.chunk(place).map(i64::from_le_bytes);
        }
        self.chunk(place).map(|bytes| i32::from_le_bytes(bytes).into())
    }

    /// A real number in one word.
    pub fn real(&self, place: usize) -> Option<f64> {
        if self.layout.long { self.double(place) } else { self.single(place).map(f64::from) }
    }

    /// A real number of 32 bits.
    pub fn single(&self, place: usize) -> Option<f32> {
        self.chunk(place).map(f32::from_le_bytes)
    }

    /// A real number of 64 bits, from this word on.
    pub fn double(&self, place: usize) -> Option<f64> {
        self.chunk(place).map(f64::from_le_bytes)
    }

    /// Letters in so many words, four to a word, without blanks around them; some files have all of a long word in the first.
    pub fn letters(&self, place: usize, count: usize) -> String {
        let width = self.layout.width();
        let part = |word: usize, length: usize| {
            self.bytes.get(word * width..word * width + length).unwrap_or_default()
        };
        let blank = |letters: &[u8]| letters.iter().all(|letter| matches!(letter, b' ' | 0));
        let together = self.layout.long
            && part(place, 8).get(4..).is_some_and(|rest| !blank(rest))
            && blank(part(place + 1, 4));
        let letters: Vec<u8> = if together {
            part(place, 8).to_vec()
        } else {
            (place..place + count).flat_map(|word| part(word, 4)).copied().collect()
        };
        String::from_utf8_lossy(&letters).trim_matches(['\0', ' ']).to_owned()
    }

    /// The bytes from a word on, the lowest first.
    fn chunk<const N: usize>(&self, place: usize) -> Option<[u8; N]> {
        let start = place.checked_mul(self.layout.width())?;
        let mut bytes = *self.bytes.get(start..)?.first_chunk::<N>()?;
        if self.layout.big_endian {
            bytes.reverse();
        }
        Some(bytes)
    }
}
