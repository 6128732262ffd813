//! Reading position in a gmsh file: lines of sections, and records of numbers in text or binary.
//! A binary file mixes lines of text with raw bytes, so both are read from one position; it also counts, to report files cut off.

use super::{Fault, MeshProblem, Part, Place, Row, VolumeProblem};
use crate::mesh::file::Encoding;

/// Size of a whole number in a binary file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// 4 bytes.
    Int,
    /// 8 bytes.
    Size,
}

/// A gmsh file while it is read: lines, and records of numbers that are lines in a text and bytes without gaps in a
/// binary file.
pub(super) struct Source<'a> {
    bytes: &'a [u8],
    at: usize,
    pub(super) encoding: Encoding,
    /// Number of the last line of a text.
    line: usize,
    /// First byte of the last number of a binary file.
    last: usize,
    /// The line of the record, and the part of the line not yet read.
    record: &'a [u8],
    rest: &'a [u8],
    row: Row,
    part: Part,
    announced: u64,
    found: u64,
}

impl<'a> Source<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let (record, rest): (&[u8], &[u8]) = (&[], &[]);
        let (row, part) = (Row::GmshFormat, Part::Nodes);
        let encoding = Encoding::Text;
        Self { bytes, at: 0, encoding, line: 0, last: 0, record, rest, row, part, announced: 0, found: 0 }
    }

    /// The next line that is not blank.
    pub(super) fn line(&mut self) -> Option<&'a [u8]> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let length = rest.iter().position(|byte| *byte == b'\n');
            self.last = self.at;
            self.at += length.map_or(rest.len(), |length| length + 1);
            self.line += 1;
            let line = rest[..length.unwrap_or(rest.len())].trim_ascii();
            if !line.is_empty() {
                return Some(line);
            }
        }
        None
    }

    /// Skips a section up to the line `$EndName`.
    pub(super) fn skip(&mut self, section: &str) -> Result<(), Fault> {
        let end = format!("$End{section}");
        let start = self.place();
        let found = self.bytes[self.at..].windows(end.len()).position(|window| window == end.as_bytes());
        let length =
            found.ok_or((start, VolumeProblem::NoSectionEnd { section: section.to_owned() }.into()))?;
        self.line += self.bytes[self.at..self.at + length].iter().filter(|byte| **byte == b'\n').count();
        self.at += length + end.len();
        Ok(())
    }

    /// Takes the line that ends a section.
    pub(super) fn close(&mut self, section: &str) -> Result<(), Fault> {
        let before = self.place();
        let (part, announced) = (self.part.clone(), self.announced);
        match self.line() {
            Some(line) if line.strip_prefix(b"$End") == Some(section.as_bytes()) => Ok(()),
            Some(_) => Err((self.place(), MeshProblem::Surplus { part, announced })),
            None => Err((before, VolumeProblem::NoSectionEnd { section: section.to_owned() }.into())),
        }
    }

    /// Place of the last line or number.
    pub(super) fn place(&self) -> Place {
        match self.encoding {
            Encoding::Text => Place::Line(self.line.max(1)),
            _ => Place::Byte(self.last),
        }
    }

    /// Announces the next records: the part, and how many of them the file has.
    pub(super) fn announce(&mut self, part: Part, announced: u64) {
        (self.part, self.announced, self.found) = (part, announced, 0);
    }

    /// Counts one more of the announced part.
    pub(super) fn count(&mut self) {
        self.found += 1;
    }

    /// Starts a record.
    pub(super) fn start(&mut self, row: Row) -> Result<(), Fault> {
        self.row = row;
        if self.encoding == Encoding::Text { self.start_line() } else { Ok(()) }
    }

    /// Starts a record that is a line of text even in a binary file.
    pub(super) fn start_text(&mut self, row: Row) -> Result<(), Fault> {
        self.row = row;
        self.start_line()
    }

    fn start_line(&mut self) -> Result<(), Fault> {
        let Some(line) = self.line() else { return Err(self.cut()) };
        if line.starts_with(b"$End") {
            let (part, announced, found) = (self.part.clone(), self.announced, self.found);
            return Err((self.place(), VolumeProblem::Short { part, announced, found }.into()));
        }
        (self.record, self.rest) = (line, line);
        Ok(())
    }

    /// The next word of the record.
    pub(super) fn word(&mut self) -> Result<&'a str, Fault> {
        let rest = self.rest.trim_ascii_start();
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(length);
        if word.is_empty() {
            return Err(self.wrong_count());
        }
        self.rest = rest;
        self.text(word)
    }

    /// Rest of the record.
    pub(super) fn remainder(&mut self) -> Result<&'a str, Fault> {
        let rest = std::mem::take(&mut self.rest);
        self.text(rest.trim_ascii())
    }

    fn text(&self, bytes: &'a [u8]) -> Result<&'a str, Fault> {
        let wrong = |error: std::str::Utf8Error| MeshProblem::NotText { byte: bytes[error.valid_up_to()] };
        std::str::from_utf8(bytes).map_err(|error| (self.place(), wrong(error)))
    }

    /// A word of the record as a number.
    pub(super) fn parsed<T: std::str::FromStr>(&mut self) -> Result<T, Fault> {
        let word = self.word()?;
        word.parse().map_err(|_| self.no_number(word))
    }

    fn no_number(&self, word: &str) -> Fault {
        let found = word.into();
        (self.place(), MeshProblem::NotANumber { found, row: self.row })
    }

    /// A whole number of either sign, of 4 bytes.
    pub(super) fn int(&mut self) -> Result<i64, Fault> {
        match self.encoding {
            Encoding::Text => self.parsed(),
            _ => Ok(i32::from_le_bytes(self.take()?).into()),
        }
    }

    /// A number of a node, of a cell, or a count.
    pub(super) fn label(&mut self, width: Width) -> Result<u64, Fault> {
        match (self.encoding, width) {
            (Encoding::Text, _) => self.parsed(),
            (_, Width::Size) => Ok(u64::from_le_bytes(self.take()?)),
            (_, Width::Int) => {
                let found = self.int()?;
                u64::try_from(found).map_err(|_| (self.place(), VolumeProblem::Label { found }.into()))
            }
        }
    }

    /// A real number.
    pub(super) fn real(&mut self) -> Result<f64, Fault> {
        match self.encoding {
            Encoding::Text => self.parsed(),
            _ => Ok(f64::from_le_bytes(self.take()?)),
        }
    }

    /// Three real numbers.
    pub(super) fn point(&mut self) -> Result<[f64; 3], Fault> {
        Ok([self.real()?, self.real()?, self.real()?])
    }

    /// Ends the record.
    pub(super) fn finish(&mut self) -> Result<(), Fault> {
        if self.encoding == Encoding::Text { self.finish_text() } else { Ok(()) }
    }

    /// Ends a record that is a line of text even in a binary file.
    pub(super) fn finish_text(&mut self) -> Result<(), Fault> {
        if self.rest.trim_ascii().is_empty() { Ok(()) } else { Err(self.wrong_count()) }
    }

    fn wrong_count(&self) -> Fault {
        let words = self.record.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        (self.place(), MeshProblem::Values { found: words.count(), row: self.row })
    }

    /// The next bytes, the highest last.
    pub(super) fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else {
            self.last = self.bytes.len();
            return Err(self.cut());
        };
        let mut bytes = *bytes;
        (self.last, self.at) = (self.at, self.at + N);
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn cut(&self) -> Fault {
        let (part, announced, found) = (self.part.clone(), self.announced, self.found);
        (self.place(), MeshProblem::Cut { part, announced, found })
    }
}
