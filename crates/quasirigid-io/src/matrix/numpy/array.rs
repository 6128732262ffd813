//! `.npy` arrays: numbers of four types and either byte order, by rows or by columns.
//! The bytes are read in place and each number by its index, so an array is not copied before it becomes a matrix.
//! Format: NumPy Enhancement Proposal 1.

use super::header::Header;
use crate::matrix::MatrixFile;
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::{Listed, LocatedProblem};

/// The numbers of an array in the bytes of a `.npy` file.
pub(crate) struct Array<'a> {
    pub shape: Vec<usize>,
    fortran_order: bool,
    scalar: Scalar,
    big_endian: bool,
    numbers: &'a [u8],
    /// First byte of the numbers.
    start: usize,
}

/// A type of number, or of text for the name of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    Float32,
    Float64,
    Int32,
    Int64,
    /// Whole numbers of so many bytes, also those of `bool`.
    Whole {
        size: usize,
        signed: bool,
    },
    /// Letters of so many bytes each.
    Text {
        letter: usize,
        length: usize,
    },
}

impl<'a> Array<'a> {
    pub fn new(bytes: &'a [u8]) -> Result<Self, LocatedProblem> {
        let Header { descr, fortran_order, shape, size: start } = Header::of(bytes)?;
        let (scalar, big_endian) = Scalar::of(&descr).ok_or_else(|| {
            let problem = match descr.trim_start_matches(['<', '>', '=', '|']).starts_with('c') {
                true => MatrixProblem::Complex,
                false => MatrixProblem::NumpyType { found: descr.into() },
            };
            (start, problem)
        })?;
        let numbers = &bytes[start..];
        let count = shape.iter().fold(1_u64, |count, length| count.saturating_mul(*length as u64));
        let announced = count.saturating_mul(scalar.size() as u64);
        if announced != numbers.len() as u64 {
            return Err((start, MatrixProblem::NumpyLength { announced, found: numbers.len() as u64 }));
        }
        Ok(Self { shape, fortran_order, scalar, big_endian, numbers, start })
    }

    /// Number of numbers in the array.
    pub fn len(&self) -> usize {
        self.numbers.len() / self.scalar.size().max(1)
    }

    /// Whether the numbers have single precision.
    pub fn is_single(&self) -> bool {
        self.scalar == Scalar::Float32
    }

    /// Whether the numbers are whole by their type.
    pub fn is_whole(&self) -> bool {
        !matches!(self.scalar, Scalar::Float32 | Scalar::Float64 | Scalar::Text { .. })
    }

    /// The byte of a number.
    pub fn byte(&self, index: usize) -> usize {
        self.start + index * self.scalar.size()
    }

    /// A number in the order of the file, which must be finite.
    pub fn real(&self, index: usize) -> Result<f64, LocatedProblem> {
        let value = match self.scalar {
            Scalar::Float32 => f32::from_le_bytes(self.bytes(index)?).into(),
            Scalar::Float64 => f64::from_le_bytes(self.bytes(index)?),
            _ => self.integer(index)? as f64,
        };
        if value.is_finite() {
            return Ok(value);
        }
        Err((self.byte(index), MatrixProblem::NotFinite { found: value.to_string().into() }))
    }

    /// An integer in the order of the file.
    pub fn integer(&self, index: usize) -> Result<i64, LocatedProblem> {
        match self.scalar {
            Scalar::Int32 => Ok(i32::from_le_bytes(self.bytes(index)?).into()),
            Scalar::Int64 => Ok(i64::from_le_bytes(self.bytes(index)?)),
            Scalar::Whole { size: 1, signed } => {
                let [byte] = self.bytes::<1>(index)?;
                Ok(if signed { i64::from(byte as i8) } else { i64::from(byte) })
            }
            Scalar::Whole { size: 2, signed } => {
                let bytes = self.bytes::<2>(index)?;
                let unsigned = u16::from_le_bytes(bytes);
                Ok(if signed { i64::from(unsigned as i16) } else { i64::from(unsigned) })
            }
            Scalar::Whole { size: 4, .. } => Ok(u32::from_le_bytes(self.bytes(index)?).into()),
            Scalar::Whole { .. } => {
                let value = u64::from_le_bytes(self.bytes(index)?);
                let problem = || MatrixProblem::NotFinite { found: value.to_string().into() };
                i64::try_from(value).map_err(|_| (self.byte(index), problem()))
            }
            _ => Err((self.start, MatrixProblem::NumpyType { found: self.scalar.name().into() })),
        }
    }

    /// The bytes of a number, the lowest first.
    fn bytes<const N: usize>(&self, index: usize) -> Result<[u8; N], LocatedProblem> {
        let bytes = self.numbers.get(index * N..).and_then(|rest| rest.first_chunk::<N>());
        let (announced, found) = ((index as u64 + 1) * N as u64, self.numbers.len() as u64);
        let mut bytes = *bytes.ok_or((self.start, MatrixProblem::NumpyLength { announced, found }))?;
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// The text of an array that is one text.
    pub fn text(&self) -> Option<String> {
        let Scalar::Text { letter, length } = self.scalar else { return None };
        let letters = self.numbers.get(..letter * length)?.chunks_exact(letter);
        let ascii =
            |letter: &[u8]| if self.big_endian { letter.last().copied() } else { letter.first().copied() };
        let text: String = letters.filter_map(ascii).map(char::from).collect();
        Some(text.trim_end_matches('\0').to_owned())
    }

    /// The array as a matrix; one dimension is a column.
    pub fn matrix(&self) -> Result<MatrixFile, LocatedProblem> {
        let (rows, columns) = match self.shape[..] {
            [rows] => (rows, 1),
            [rows, columns] => (rows, columns),
            _ => return Err(self.misshapen("one of one or two dimensions")),
        };
        let mut listed = Listed::new(rows, columns).map_err(|problem| (self.start, problem))?;
        for index in 0..self.len() {
            let value = self.real(index)?;
            let place = match self.fortran_order {
                true => (index % rows, index / rows),
                false => (index / columns, index % columns),
            };
            if value != 0.0 {
                listed.add(place.0, place.1, value, self.byte(index))?;
            }
        }
        Ok(listed.sum())
    }

    /// Problem of an array that has not the wanted shape.
    pub fn misshapen(&self, wanted: &str) -> LocatedProblem {
        (self.start, MatrixProblem::NumpyShape { found: self.shape.clone(), wanted: wanted.to_owned() })
    }

    /// Whether the last index runs fastest, as it also does in one dimension.
    pub fn by_rows(&self) -> bool {
        !self.fortran_order || self.shape.len() < 2
    }
}

impl Scalar {
    /// The type that NumPy calls so, and whether its highest byte comes first.
    fn of(descr: &str) -> Option<(Self, bool)> {
        let big_endian = descr.starts_with('>');
        let scalar = match descr.strip_prefix(['<', '>', '|'])? {
            "f4" => Self::Float32,
            "f8" => Self::Float64,
            "i4" => Self::Int32,
            "i8" => Self::Int64,
            "b1" | "u1" => Self::Whole { size: 1, signed: false },
            "i1" => Self::Whole { size: 1, signed: true },
            "u2" => Self::Whole { size: 2, signed: false },
            "i2" => Self::Whole { size: 2, signed: true },
            "u4" => Self::Whole { size: 4, signed: false },
            "u8" => Self::Whole { size: 8, signed: false },
            text => {
                let letter = if text.starts_with('S') { 1 } else { 4 };
                let length =
                    text.strip_prefix(['S', 'U'])?.parse().ok().filter(|length| (1..16).contains(length))?;
                Self::Text { letter, length }
            }
        };
        Some((scalar, big_endian))
    }

    fn size(self) -> usize {
        match self {
            Self::Float32 | Self::Int32 => 4,
            Self::Float64 | Self::Int64 => 8,
            Self::Whole { size, .. } => size,
            Self::Text { letter, length } => letter * length,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Float32 => "float32",
            Self::Float64 => "float64",
            Self::Int32 => "int32",
            Self::Int64 => "int64",
            Self::Whole { .. } => "a whole number",
            Self::Text { .. } => "text",
        }
    }
}
