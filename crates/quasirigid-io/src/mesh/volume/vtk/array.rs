//! Arrays of VTK files: types of numbers, values as whole or real numbers, and the place of each value in the file.
//! Places are computed on demand, by reading the words again: keeping one per value would double the memory of a large grid.

use super::{Fault, MeshProblem, Part, Place, Row, VolumeProblem};

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Bit,
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float32,
    Float64,
}

impl Scalar {
    /// Type by the name that legacy and XML files use, where capitals do not matter.
    pub(super) fn named(name: &str) -> Result<Self, MeshProblem> {
        let lower = name.to_ascii_lowercase();
        Ok(match lower.strip_prefix("vtktype").unwrap_or(&lower) {
            "bit" => Self::Bit,
            "char" | "signed_char" | "int8" => Self::Int8,
            "unsigned_char" | "uint8" => Self::UInt8,
            "short" | "int16" => Self::Int16,
            "unsigned_short" | "uint16" => Self::UInt16,
            "int" | "int32" | "vtkidtype" => Self::Int32, // legacy files have identifiers of 4 bytes under this name
            "unsigned_int" | "uint32" => Self::UInt32,
            "long" | "int64" => Self::Int64,
            "unsigned_long" | "uint64" => Self::UInt64,
            "float" | "float32" => Self::Float32,
            "double" | "float64" => Self::Float64,
            _ => return Err(VolumeProblem::Scalar { found: name.into() }.into()),
        })
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Self::Float32 | Self::Float64)
    }

    /// Bytes of one number; bits share theirs.
    pub(super) fn width(self) -> usize {
        match self {
            Self::Bit | Self::Int8 | Self::UInt8 => 1,
            Self::Int16 | Self::UInt16 => 2,
            Self::Int32 | Self::UInt32 | Self::Float32 => 4,
            Self::Int64 | Self::UInt64 | Self::Float64 => 8,
        }
    }

    /// Bytes of so many numbers.
    pub(super) fn size(self, count: u64) -> Option<usize> {
        let size =
            if self == Self::Bit { Some(count.div_ceil(8)) } else { count.checked_mul(self.width() as u64) };
        size.and_then(|size| usize::try_from(size).ok())
    }
}

/// Numbers, all of one type.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    Whole(Vec<i64>),
    Real(Vec<f64>),
}

impl Values {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Real(values) => values.len(),
        }
    }

    pub(super) fn into_reals(self) -> Vec<f64> {
        match self {
            Self::Whole(values) => values.into_iter().map(|value| value as f64).collect(),
            Self::Real(values) => values,
        }
    }

    /// Numbers from their bytes. Whole numbers above 2⁶³ count nothing that fits into a file and come out negative.
    pub(super) fn from_bytes(bytes: &[u8], scalar: Scalar, big_endian: bool) -> Self {
        macro_rules! numbers {
            ($kind:ident, $number:ty, $into:ty) => {
                Self::$kind(
                    bytes
                        .as_chunks()
                        .0
                        .iter()
                        .map(|chunk| match big_endian {
                            true => <$number>::from_be_bytes(*chunk) as $into,
                            false => <$number>::from_le_bytes(*chunk) as $into,
                        })
                        .collect(),
                )
            };
        }
        match scalar {
            Scalar::Bit => {
                let bits =
                    |byte: &u8| (0..8).rev().map(|place| i64::from(byte >> place & 1)).collect::<Vec<_>>();
                Self::Whole(bytes.iter().flat_map(bits).collect())
            }
            Scalar::Int8 => numbers!(Whole, i8, i64),
            Scalar::UInt8 => numbers!(Whole, u8, i64),
            Scalar::Int16 => numbers!(Whole, i16, i64),
            Scalar::UInt16 => numbers!(Whole, u16, i64),
            Scalar::Int32 => numbers!(Whole, i32, i64),
            Scalar::UInt32 => numbers!(Whole, u32, i64),
            Scalar::Int64 => numbers!(Whole, i64, i64),
            Scalar::UInt64 => numbers!(Whole, u64, i64),
            Scalar::Float32 => numbers!(Real, f32, f64),
            Scalar::Float64 => numbers!(Real, f64, f64),
        }
    }

    /// Numbers from words, at most `count` of them, up to the next keyword.
    pub(super) fn from_words(words: &mut Words, scalar: Scalar, count: u64) -> Result<Self, Fault> {
        if scalar.is_whole() {
            words.numbers(count).map(Self::Whole)
        } else {
            words.numbers(count).map(Self::Real)
        }
    }
}

/// Words of a text from some byte on.
pub(super) struct Words<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
    /// Line of the first byte.
    pub(super) first_line: usize,
}

impl<'a> Words<'a> {
    fn numbers<T: std::str::FromStr>(&mut self, count: u64) -> Result<Vec<T>, Fault> {
        let mut numbers = Vec::new();
        for _ in 0..count {
            let before = self.at;
            let Some((start, word)) = self.next() else { break };
            match std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()) {
                Some(number) => numbers.push(number),
                None if is_keyword(word) => {
                    self.at = before;
                    break;
                }
                None => {
                    let found = String::from_utf8_lossy(word).into();
                    return Err((self.line(start), MeshProblem::NotANumber { found, row: Row::VtkValue }));
                }
            }
        }
        Ok(numbers)
    }

    /// The next word and where it starts.
    fn next(&mut self) -> Option<(usize, &'a [u8])> {
        let space = self.bytes[self.at..].iter().position(|byte| !byte.is_ascii_whitespace())?;
        let start = self.at + space;
        let length = self.bytes[start..].iter().position(u8::is_ascii_whitespace);
        self.at = length.map_or(self.bytes.len(), |length| start + length);
        Some((start, &self.bytes[start..self.at]))
    }

    /// The line of a byte.
    pub(super) fn line(&self, at: usize) -> Place {
        Place::Line(self.first_line + self.bytes[..at].iter().filter(|byte| **byte == b'\n').count())
    }
}

/// Whether a word is one like `CELL_TYPES`.
fn is_keyword(word: &[u8]) -> bool {
    word.len() > 3 && word.iter().all(|byte| byte.is_ascii_uppercase() || *byte == b'_')
}

/// Origin of an array: the place of its values.
#[derive(Clone, Debug)]
pub(super) enum Origin<'a> {
    /// Words of a text from this byte on, and the line of its first byte.
    Words { bytes: &'a [u8], start: usize, first_line: usize },
    /// Bytes from this one on, so many for each.
    Bytes { start: usize, width: usize },
    /// Somewhere at this place.
    Somewhere(Place),
}

impl Origin<'_> {
    /// Place of a value.
    pub(super) fn place(&self, value: usize) -> Place {
        match self {
            &Self::Words { bytes, start, first_line } => {
                let mut words = Words { bytes, at: start, first_line };
                let start = (0..=value).map_while(|_| words.next().map(|(start, _)| start)).last();
                words.line(start.unwrap_or(bytes.len()))
            }
            Self::Bytes { start, width } => Place::Byte(start + width * value),
            Self::Somewhere(place) => place.clone(),
        }
    }
}

/// Named values.
#[derive(Clone, Debug)]
pub(super) struct Array<'a> {
    pub(super) name: String,
    pub(super) values: Values,
    pub(super) origin: Origin<'a>,
}

impl Array<'_> {
    /// The values as whole numbers.
    pub(super) fn whole(&self) -> Result<&[i64], Fault> {
        match &self.values {
            Values::Whole(values) => Ok(values),
            Values::Real(_) => {
                Err((self.origin.place(0), VolumeProblem::Scalar { found: "float".into() }.into()))
            }
        }
    }

    /// Refuses another number of values.
    pub(super) fn has(self, expected: u64) -> Result<Self, Fault> {
        let found = self.values.len() as u64;
        if found == expected {
            return Ok(self);
        }
        let array = self.name.clone();
        Err((self.origin.place(0), VolumeProblem::ArrayLength { array, found, expected }.into()))
    }
}

/// Problem of a file that ends within an array.
pub(super) fn cut(name: &str, announced: u64, found: u64) -> MeshProblem {
    MeshProblem::Cut { part: Part::Values(name.to_owned()), announced, found }
}
