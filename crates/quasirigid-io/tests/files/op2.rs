//! OUTPUT2 files written here, as the guide to the module has them: words, records with keys between them, blocks.

/// A word, or letters in words of four.
#[derive(Clone, Copy)]
pub enum Word {
    Integer(i64),
    Real(f64),
    Letters(&'static str),
}

impl From<i64> for Word {
    fn from(value: i64) -> Self {
        Self::Integer(value)
    }
}

impl From<f64> for Word {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

impl From<&'static str> for Word {
    fn from(letters: &'static str) -> Self {
        Self::Letters(letters)
    }
}

macro_rules! words {
    ($($word:expr),* $(,)?) => { vec![$($crate::files::op2::Word::from($word)),*] };
}
pub(crate) use words;

/// Words of one record on the tape; longer records are split, as NASTRAN splits those above its buffer.
const PIECE: usize = 24;

/// A file in one of the four layouts.
pub struct Tape {
    pub big_endian: bool,
    pub long: bool,
    pub bytes: Vec<u8>,
}

impl Tape {
    pub fn new(big_endian: bool, long: bool) -> Self {
        let mut tape = Self { big_endian, long, bytes: Vec::new() };
        tape.pieces(&[words![1, 2, 3], words!["NASTRAN FORT TAPE ID CODE - "], words!["XXXXXXXX"]]);
        tape.key(-1);
        tape.key(0);
        tape
    }

    /// All layouts.
    pub fn each() -> [Self; 4] {
        [(false, false), (true, false), (false, true), (true, true)].map(|(big, long)| Self::new(big, long))
    }

    fn width(&self) -> usize {
        if self.long { 8 } else { 4 }
    }

    fn put(&mut self, mut bytes: Vec<u8>) {
        if self.big_endian {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    fn physical(&mut self, words: &[Word], double: bool) {
        let mut inner = Self { big_endian: self.big_endian, long: self.long, bytes: Vec::new() };
        for word in words {
            match *word {
                Word::Integer(value) if self.long => inner.put(value.to_le_bytes().into()),
                Word::Integer(value) => inner.put((value as i32).to_le_bytes().into()),
                Word::Real(value) if self.long || double => inner.put(value.to_le_bytes().into()),
                Word::Real(value) => inner.put((value as f32).to_le_bytes().into()),
                Word::Letters(letters) => {
                    for four in letters.as_bytes().chunks(4) {
                        inner.bytes.extend(four);
                        inner.bytes.extend(vec![b' '; self.width() - four.len()]);
                    }
                }
            }
        }
        let length = (inner.bytes.len() as u32).to_le_bytes();
        self.put(length.into());
        self.bytes.extend(inner.bytes);
        self.put(length.into());
    }

    fn key(&mut self, key: i64) {
        self.physical(&[Word::Integer(key)], false);
    }

    fn logical(&mut self, pieces: &[Vec<Word>], end: i64) {
        self.pieces(pieces);
        self.key(end);
    }

    fn pieces(&mut self, pieces: &[Vec<Word>]) {
        for piece in pieces {
            let before = self.bytes.len();
            self.physical(piece, false);
            let record = self.bytes.split_off(before);
            self.key(((record.len() - 8) / self.width()) as i64);
            self.bytes.extend(record);
        }
    }

    fn head(&mut self, name: &'static str, trailer: [i64; 7]) {
        self.logical(&[words![name]], -1);
        self.logical(&[trailer.map(Word::Integer).to_vec()], -2);
        self.key(1);
        self.key(0);
        self.logical(&[words![name]], -3);
    }

    /// A table.
    pub fn table(&mut self, name: &'static str, records: &[Vec<Word>]) {
        self.head(name, [101, 0, 0, 0, 0, 0, 0]);
        for (index, record) in records.iter().enumerate() {
            self.key(1);
            self.key(0);
            let pieces: Vec<Vec<Word>> = record.chunks(PIECE).map(<[Word]>::to_vec).collect();
            self.logical(&pieces, -4 - index as i64);
        }
        self.key(1);
        self.key(0);
        self.key(0);
    }

    /// A matrix: rows, and for each column its strings, each with its first row from 1.
    pub fn matrix(&mut self, name: &'static str, rows: i64, double: bool, columns: &[Vec<(i64, Vec<f64>)>]) {
        let kind = if double { 2 } else { 1 };
        self.head(name, [101, columns.len() as i64, rows, 1, kind, 0, 0]);
        for (index, strings) in columns.iter().enumerate() {
            self.key(1);
            self.key(1);
            for (row, values) in strings {
                let each = if double && !self.long { 2 } else { 1 };
                self.key(values.len() as i64 * each);
                let values = values.iter().map(|value| Word::Real(*value));
                let string: Vec<Word> = [Word::Integer(*row)].into_iter().chain(values).collect();
                self.physical(&string, double);
            }
            self.key(-4 - index as i64);
        }
        self.key(1);
        self.key(0);
        self.key(0);
    }

    /// The bytes of the whole file.
    pub fn end(mut self) -> Vec<u8> {
        self.key(0);
        self.bytes
    }
}
