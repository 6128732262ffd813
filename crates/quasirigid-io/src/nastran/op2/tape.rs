//! Data blocks of an OUTPUT2 file: Fortran records, the keys between them, and the logical records that they make up.
//! A key above 0 announces so many words, one below 0 ends a logical record, 0 ends the block. Blocks keep ranges of the file alone, so that
//! nothing is copied before it is asked for.
//! Format: NX Nastran DMAP Programmer's Guide, OUTPUT2, remarks; MSC Nastran since 2014 puts its version behind each name.

use std::ops::Range;

use super::words::Words;
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;

/// How the words of a file are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    pub big_endian: bool,
    /// Whether words have 64 bits.
    pub long: bool,
}

/// A data block: a table or a matrix.
pub(crate) struct Block {
    /// Name of the block, and that in its first record, which an external superelement has alone.
    pub names: [String; 2],
    /// Seven integers; of a matrix: file, columns, rows, form, type.
    pub trailer: [i64; 7],
    pub records: Vec<Record>,
    /// First byte.
    pub at: usize,
}

/// A logical record, in pieces.
pub(crate) struct Record {
    /// Whether it is a column of a matrix, whose pieces are strings of values.
    pub column: bool,
    pub pieces: Vec<Range<usize>>,
}

/// An OUTPUT2 file.
pub(crate) struct Tape<'a> {
    bytes: &'a [u8],
    pub layout: Layout,
    pub blocks: Vec<Block>,
}

/// Keys with which a file begins: a date, or the name of the first block.
const FIRST: [i64; 2] = [3, 2];

impl Layout {
    /// The layout of a file, if it begins with a key of OUTPUT2.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let all = [true, false]
            .into_iter()
            .flat_map(|big_endian| [false, true].into_iter().map(move |long| Self { big_endian, long }));
        all.into_iter().find(|layout| {
            let mut reader = Reader { bytes, layout: *layout, next: 0 };
            reader.key().is_ok_and(|key| FIRST.contains(&key))
        })
    }

    /// Bytes of a word.
    pub fn width(self) -> usize {
        if self.long { 8 } else { 4 }
    }
}

impl<'a> Tape<'a> {
    /// Finds the blocks of a file.
    pub fn read(bytes: &'a [u8]) -> Result<Self, LocatedProblem> {
        let layout = Layout::of(bytes).ok_or((0, MatrixProblem::Empty))?;
        let mut reader = Reader { bytes, layout, next: 0 };
        let mut blocks = Vec::new();
        let mut key = reader.key()?;
        if key == FIRST[0] {
            reader.logical(key, false)?;
            let end = reader.key()?;
            if end != 0 {
                return Err(reader.unexpected(end));
            }
            key = reader.key()?;
        }
        while key > 0 {
            blocks.push(reader.block(key)?);
            // the last end may be missing
            key = if reader.next < bytes.len() { reader.key()? } else { 0 };
        }
        Ok(Self { bytes, layout, blocks })
    }

    /// The words of a logical record.
    pub fn words(&self, record: &Record) -> Words<'a> {
        Words::new(self.bytes, &record.pieces, self.layout)
    }

    /// The words of a piece.
    pub fn piece(&self, piece: &Range<usize>) -> Words<'a> {
        Words::new(self.bytes, std::slice::from_ref(piece), self.layout)
    }

    /// The first block of one of these names, the first name before the others.
    pub fn block(&self, names: &[&str]) -> Option<&Block> {
        names.iter().find_map(|name| self.blocks.iter().find(|block| block.names[0] == *name))
    }
}

struct Reader<'a> {
    bytes: &'a [u8],
    layout: Layout,
    next: usize,
}

impl Reader<'_> {
    /// A Fortran record: its length, so many bytes, and its length again.
    fn physical(&mut self) -> Result<Range<usize>, LocatedProblem> {
        let start = self.next;
        let length = self.length(start)?;
        let found = (self.bytes.len() - start).saturating_sub(8);
        if length > found {
            return Err((start, record(length, found)));
        }
        let piece = start + 4..start + 4 + length;
        let again = self.length(piece.end)?;
        if again != length {
            return Err((piece.end, record(length, again)));
        }
        self.next = piece.end + 4;
        Ok(piece)
    }

    fn length(&self, at: usize) -> Result<usize, LocatedProblem> {
        let bytes = self.bytes.get(at..).and_then(|rest| rest.first_chunk::<4>());
        let bytes = bytes.ok_or((at, record(4, self.bytes.len().saturating_sub(at))))?;
        let length = if self.layout.big_endian { u32::from_be_bytes } else { u32::from_le_bytes };
        Ok(length(*bytes) as usize)
    }

    /// A key: a record of one word.
    fn key(&mut self) -> Result<i64, LocatedProblem> {
        let at = self.next;
        let piece = self.physical()?;
        let word = Words::new(self.bytes, std::slice::from_ref(&piece), self.layout);
        match word.integer(0) {
            Some(key) if piece.len() == self.layout.width() => Ok(key),
            _ => Err((at, record(self.layout.width(), piece.len()))),
        }
    }

    /// The pieces of a logical record whose first key was read, and the key that ends it.
    fn logical(&mut self, first: i64, column: bool) -> Result<(Vec<Range<usize>>, i64), LocatedProblem> {
        let (mut pieces, mut key) = (Vec::new(), first);
        while key > 0 {
            let at = self.next;
            let piece = self.physical()?;
            // before a string stands its row, which does not count
            let words = usize::try_from(key).unwrap_or(usize::MAX).saturating_add(usize::from(column));
            if piece.len() != words.saturating_mul(self.layout.width()) {
                return Err((at, record(words.saturating_mul(self.layout.width()), piece.len())));
            }
            pieces.push(piece);
            key = self.key()?;
        }
        Ok((pieces, key))
    }

    /// A block whose first key was read.
    fn block(&mut self, first: i64) -> Result<Block, LocatedProblem> {
        let at = self.next;
        let (name, _) = self.logical(first, false)?;
        let name = self.name(name.first());
        let key = self.key()?;
        let (trailer, _) = self.logical(key, false)?;
        let trailer = Words::new(self.bytes, &trailer, self.layout);
        let trailer = std::array::from_fn(|place| trailer.integer(place).unwrap_or(0));
        let mut records = Vec::new();
        loop {
            let one = self.key()?;
            if one != 1 {
                return Err(self.unexpected(one));
            }
            let column = self.key()? != 0;
            let key = self.key()?;
            if key == 0 {
                break;
            }
            let (pieces, end) = self.logical(key, column)?;
            records.push(Record { column, pieces });
            if end == 0 {
                break;
            }
        }
        let inner = records.first().and_then(|record| record.pieces.first());
        let names = [name, self.name(inner)];
        Ok(Block { names, trailer, records, at })
    }

    /// Eight letters, four to a word.
    fn name(&self, piece: Option<&Range<usize>>) -> String {
        let words = Words::new(self.bytes, piece.map(std::slice::from_ref).unwrap_or_default(), self.layout);
        words.letters(0, 2)
    }

    fn unexpected(&self, key: i64) -> LocatedProblem {
        (self.next, MatrixProblem::Unexpected { found: key.to_string().into(), row: Row::Op2Key })
    }
}

fn record(announced: usize, found: usize) -> MatrixProblem {
    MatrixProblem::Record { announced: announced as u64, found: found as u64 }
}
