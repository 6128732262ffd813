//! Values of a PLY file in order, as text (a line for each element) or binary (bytes without gaps).
//! One trait for both keeps the reading of elements free of the encoding; it also keeps the place of the last number for errors.

use super::header::{Element, Header, Scalar};
use crate::mesh::error::{Fault, MeshProblem, Part, Place, Row};
use crate::text_file::{number, text};

/// The numbers of a PLY file one after the other, in text or binary.
pub(super) trait Values {
    /// The elements that come next.
    fn announce(&mut self, element: &Element);
    /// Starts the next element.
    fn start(&mut self) -> Result<(), Fault>;
    /// The next number of the element.
    fn next(&mut self, scalar: Scalar) -> Result<f64, Fault>;
    /// Ends the element.
    fn finish(&mut self) -> Result<(), Fault>;
    /// Place of the last number.
    fn place(&self) -> Place;
    /// Place of the first thing after the last element, if there is one.
    fn surplus(&mut self) -> Option<Place>;
}

/// Progress among the elements of a kind.
struct Progress {
    part: Part,
    announced: u64,
    found: u64,
}

impl Progress {
    fn new(element: &Element) -> Self {
        Self { part: element.part.clone(), announced: element.count, found: 0 }
    }

    fn cut(&self) -> MeshProblem {
        MeshProblem::Cut { part: self.part.clone(), announced: self.announced, found: self.found }
    }
}

/// One line per element.
pub(super) struct Text<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    words: std::str::SplitWhitespace<'a>,
    line: usize,
    /// Values taken from the line.
    taken: usize,
    progress: Progress,
}

impl<'a> Text<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Result<Self, Fault> {
        let mut lines = text::<MeshProblem>(bytes)?.lines().enumerate();
        lines.nth(header.lines - 1);
        let progress = Progress { part: Part::Vertices, announced: 0, found: 0 };
        Ok(Self { lines, words: "".split_whitespace(), line: header.lines, taken: 0, progress })
    }

    /// The next line that is not blank.
    fn line(&mut self) -> Option<&'a str> {
        let (index, line) = self.lines.find(|(_, line)| !line.trim().is_empty())?;
        self.line = index + 1;
        Some(line)
    }

    fn wrong_count(&self) -> Fault {
        let found = self.taken + self.words.clone().count();
        (self.place(), MeshProblem::Values { found, row: Row::PlyElement })
    }
}

impl Values for Text<'_> {
    fn announce(&mut self, element: &Element) {
        self.progress = Progress::new(element);
    }

    fn start(&mut self) -> Result<(), Fault> {
        let line = self.line().ok_or_else(|| (self.place(), self.progress.cut()))?;
        (self.words, self.taken) = (line.split_whitespace(), 0);
        Ok(())
    }

    fn next(&mut self, _: Scalar) -> Result<f64, Fault> {
        let word = self.words.next().ok_or_else(|| self.wrong_count())?;
        self.taken += 1;
        number(word, Row::PlyElement).map_err(|problem| (self.place(), problem))
    }

    fn finish(&mut self) -> Result<(), Fault> {
        self.progress.found += 1;
        if self.words.clone().next().is_some() { Err(self.wrong_count()) } else { Ok(()) }
    }

    fn place(&self) -> Place {
        Place::Line(self.line)
    }

    fn surplus(&mut self) -> Option<Place> {
        self.line().map(|_| self.place())
    }
}

/// Bytes without gaps.
pub(super) struct Binary<'a> {
    bytes: &'a [u8],
    at: usize,
    /// First byte of the last number.
    last: usize,
    big_endian: bool,
    progress: Progress,
}

impl<'a> Binary<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header, big_endian: bool) -> Self {
        let progress = Progress { part: Part::Vertices, announced: 0, found: 0 };
        Self { bytes, at: header.size, last: header.size, big_endian, progress }
    }

    /// The next bytes, the highest last.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        let rest = self.bytes[self.at..].first_chunk::<N>();
        let mut bytes = *rest.ok_or_else(|| (Place::Byte(self.bytes.len()), self.progress.cut()))?;
        (self.last, self.at) = (self.at, self.at + N);
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl Values for Binary<'_> {
    fn announce(&mut self, element: &Element) {
        self.progress = Progress::new(element);
    }

    fn start(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn next(&mut self, scalar: Scalar) -> Result<f64, Fault> {
        Ok(match scalar {
            Scalar::Int8 => i8::from_le_bytes(self.take()?).into(),
            Scalar::UInt8 => u8::from_le_bytes(self.take()?).into(),
            Scalar::Int16 => i16::from_le_bytes(self.take()?).into(),
            Scalar::UInt16 => u16::from_le_bytes(self.take()?).into(),
            Scalar::Int32 => i32::from_le_bytes(self.take()?).into(),
            Scalar::UInt32 => u32::from_le_bytes(self.take()?).into(),
            Scalar::Float32 => f32::from_le_bytes(self.take()?).into(),
            Scalar::Float64 => f64::from_le_bytes(self.take()?),
        })
    }

    fn finish(&mut self) -> Result<(), Fault> {
        self.progress.found += 1;
        Ok(())
    }

    fn place(&self) -> Place {
        Place::Byte(self.last)
    }

    fn surplus(&mut self) -> Option<Place> {
        (self.at < self.bytes.len()).then_some(Place::Byte(self.at))
    }
}
