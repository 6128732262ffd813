//! Matrices in MAT files of MATLAB, version 5 (`-v6` and `-v7`): numeric or sparse, of either byte order, compressed or not.
//! Other variables (structures, cells, texts) are passed over. Unpacking is bounded by the size of the file.
//! Format: MathWorks, MAT-File Format, Level 5.

use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::MatrixFile;
use super::error::{Fault, MatrixProblem, Place};
use super::listed::{Listed, LocatedProblem};
use crate::text_file::unpacked_limit;

/// Length of the header, and the place of its version and its mark of the byte order.
const HEADER: usize = 128;
const VERSION: usize = 124;
/// Beginning of a MAT file of version 7.3, which is an HDF5 file behind it.
const NEWER: &[u8] = b"MATLAB 7.3 MAT-file";

/// Types of data elements.
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
/// Classes of arrays: the first and the last of numbers, and the sparse one.
const DOUBLE_CLASS: u8 = 6;
const LAST_CLASS: u8 = 15;
const SPARSE_CLASS: u8 = 5;
/// Flag of a complex array.
const COMPLEX: u32 = 0x0800;

/// Order of the bytes of a MAT file, by its header; none of another file.
fn big_endian(bytes: &[u8]) -> Option<bool> {
    match bytes.get(VERSION..HEADER)? {
        [_, 1 | 2, b'I', b'M'] => Some(false),
        [1 | 2, _, b'M', b'I'] => Some(true),
        _ => None,
    }
}

/// Whether a file begins as one of MATLAB.
pub(super) fn is_mat(bytes: &[u8]) -> bool {
    big_endian(bytes).is_some()
}

/// The matrix of a name, or the only one.
pub(super) fn read(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, Fault> {
    if bytes.starts_with(NEWER) {
        return Err((Place::File, MatrixProblem::NewerMat));
    }
    let order = Order { big_endian: big_endian(bytes).unwrap_or(false) };
    let mut left = unpacked_limit(bytes.len() as u64) as usize;
    let (mut names, mut only, mut at) = (Vec::new(), None, HEADER);
    while at < bytes.len() {
        let outer = order.element(&bytes[at..]).map_err(|(_, problem)| (Place::Byte(at), problem))?;
        let compressed = outer.kind == COMPRESSED;
        // what is wrong in a compressed variable has the place of the variable
        let placed =
            |(byte, problem): LocatedProblem| (Place::Byte(if compressed { at } else { at + byte }), problem);
        let (unpacked, next) = match compressed {
            true => (
                inflated(outer.data, &mut left).map_err(|problem| placed((0, problem)))?,
                at + 8 + outer.data.len(),
            ),
            false => (Vec::new(), at + outer.length),
        };
        let element = if compressed { order.element(&unpacked).map_err(placed)? } else { outer };
        if element.kind == MATRIX
            && let Some(found) = Variable::of(order, element.data).map_err(placed)?
        {
            if name.is_none_or(|name| name == found.name) {
                only = Some(found.matrix(order).map_err(placed));
            }
            names.push(found.name.to_owned());
        }
        at = next;
    }
    match (name, only) {
        (None, _) if names.len() > 1 => Err((Place::File, MatrixProblem::WhichMatrix { names })),
        (_, Some(matrix)) => matrix,
        (Some(name), None) => {
            Err((Place::File, MatrixProblem::NoSuchMatrix { name: name.to_owned(), names }))
        }
        (None, None) => Err((Place::File, MatrixProblem::NoMatMatrix)),
    }
}

/// The data of a compressed element, of which so many bytes are left.
fn inflated(data: &[u8], left: &mut usize) -> Result<Vec<u8>, MatrixProblem> {
    let limit = *left as u64;
    let unpacked = decompress_to_vec_zlib_with_limit(data, *left).map_err(|error| match error.status {
        miniz_oxide::inflate::TINFLStatus::HasMoreOutput => MatrixProblem::Inflated { limit },
        _ => MatrixProblem::CutMatrix,
    })?;
    *left -= unpacked.len();
    Ok(unpacked)
}

/// Order of bytes.
#[derive(Clone, Copy)]
struct Order {
    big_endian: bool,
}

/// Data element: its type, its data, and its length with the tag and what fills it up.
struct Element<'a> {
    kind: u32,
    data: &'a [u8],
    length: usize,
}

impl Order {
    fn word(self, bytes: [u8; 4]) -> u32 {
        if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
    }

    /// The first element; one of at most four bytes has them in its tag.
    fn element(self, bytes: &[u8]) -> Result<Element<'_>, LocatedProblem> {
        let cut = (0, MatrixProblem::CutMatrix);
        let word = |at: usize| {
            bytes.get(at..at + 4).and_then(|word| word.first_chunk()).map(|word| self.word(*word))
        };
        let (Some(first), Some(second)) = (word(0), word(4)) else { return Err(cut) };
        let small = (first >> 16) as usize;
        if small > 0 {
            let data = bytes.get(4..4 + small).filter(|_| small <= 4).ok_or(cut)?;
            return Ok(Element { kind: first & 0xFFFF, data, length: 8 });
        }
        let length = second as usize;
        let data = bytes.get(8..8usize.saturating_add(length)).ok_or(cut)?;
        Ok(Element { kind: first, data, length: 8 + length.next_multiple_of(8) })
    }
}

/// A numeric or sparse variable of two dimensions.
struct Variable<'a> {
    name: &'a str,
    sparse: bool,
    complex: bool,
    rows: usize,
    columns: usize,
    /// What follows the name.
    parts: &'a [u8],
    /// Place of the parts.
    at: usize,
}

impl<'a> Variable<'a> {
    /// Reads what stands before the numbers; none of a variable that is no matrix.
    fn of(order: Order, data: &'a [u8]) -> Result<Option<Self>, LocatedProblem> {
        let mut at = 0;
        let mut part = || {
            let element =
                order.element(data.get(at..).unwrap_or_default()).map_err(|(_, problem)| (at, problem))?;
            at += element.length;
            Ok::<_, LocatedProblem>(element)
        };
        let (flags, lengths, name) = (part()?, part()?, part()?);
        let flags = flags.data.first_chunk().map(|word| order.word(*word)).unwrap_or_default();
        let lengths: Vec<usize> = lengths
            .data
            .chunks_exact(4)
            .filter_map(|word| word.first_chunk())
            .map(|word| order.word(*word) as usize)
            .collect();
        let class = (flags & 0xFF) as u8;
        let sparse = class == SPARSE_CLASS;
        let numbers = sparse || (DOUBLE_CLASS..=LAST_CLASS).contains(&class);
        let (&[rows, columns], Ok(name), true) = (&lengths[..], std::str::from_utf8(name.data), numbers)
        else {
            return Ok(None);
        };
        let complex = flags & COMPLEX != 0;
        Ok(Some(Self { name, sparse, complex, rows, columns, parts: data.get(at..).unwrap_or_default(), at }))
    }

    fn matrix(&self, order: Order) -> Result<MatrixFile, LocatedProblem> {
        if self.complex {
            return Err((self.at, MatrixProblem::Complex));
        }
        let mut listed = Listed::new(self.rows, self.columns).map_err(|problem| (self.at, problem))?;
        let (first, first_length) = self.numbers(order, 0)?;
        if !self.sparse {
            let announced = (self.rows as u64).saturating_mul(self.columns as u64);
            if first.len() as u64 != announced {
                return Err((self.at, MatrixProblem::Cut { announced, found: first.len() as u64 }));
            }
            for (index, value) in first.into_iter().enumerate().filter(|(_, value)| *value != 0.0) {
                listed.add(index % self.rows, index / self.rows, self.finite(value)?, self.at)?;
            }
            return Ok(listed.sum());
        }
        let (starts, starts_length) = self.numbers(order, first_length)?;
        let (values, _) = self.numbers(order, first_length + starts_length)?;
        let entries = starts.get(self.columns).map_or(0, |end| *end as usize);
        if starts.len() != self.columns.saturating_add(1) || values.len() < entries || first.len() < entries {
            let found = values.len().min(first.len()) as u64;
            return Err((self.at, MatrixProblem::Cut { announced: entries as u64, found }));
        }
        for (column, ends) in starts.windows(2).enumerate() {
            if !(ends[0] >= 0.0 && ends[0] <= ends[1] && ends[1] as usize <= entries) {
                return Err((self.at, MatrixProblem::SparsePointer { found: ends[1] as i64, entries }));
            }
            for entry in ends[0] as usize..ends[1] as usize {
                if first[entry] < 0.0 {
                    return Err((self.at, MatrixProblem::SparseIndex { found: first[entry] as i64 }));
                }
                let value = self.finite(values[entry])?;
                if value != 0.0 {
                    listed.add(first[entry] as usize, column, value, self.at)?;
                }
            }
        }
        Ok(listed.sum())
    }

    fn finite(&self, value: f64) -> Result<f64, LocatedProblem> {
        let refused = || (self.at, MatrixProblem::NotFinite { found: value.to_string().as_str().into() });
        if value.is_finite() { Ok(value) } else { Err(refused()) }
    }

    /// The numbers of a part, in whatever type they are kept, and its length.
    fn numbers(&self, order: Order, from: usize) -> Result<(Vec<f64>, usize), LocatedProblem> {
        let at = self.at + from;
        let part = order
            .element(self.parts.get(from..).unwrap_or_default())
            .map_err(|(_, problem)| (at, problem))?;
        let numbers = match part.kind {
            1 => read_all(order, part.data, |[byte]: [u8; 1]| f64::from(byte as i8)),
            2 => read_all(order, part.data, |[byte]: [u8; 1]| f64::from(byte)),
            3 => read_all(order, part.data, |bytes| f64::from(i16::from_le_bytes(bytes))),
            4 => read_all(order, part.data, |bytes| f64::from(u16::from_le_bytes(bytes))),
            5 => read_all(order, part.data, |bytes| f64::from(i32::from_le_bytes(bytes))),
            6 => read_all(order, part.data, |bytes| f64::from(u32::from_le_bytes(bytes))),
            7 => read_all(order, part.data, |bytes| f64::from(f32::from_le_bytes(bytes))),
            9 => read_all(order, part.data, f64::from_le_bytes),
            12 => read_all(order, part.data, |bytes| i64::from_le_bytes(bytes) as f64),
            13 => read_all(order, part.data, |bytes| u64::from_le_bytes(bytes) as f64),
            other => return Err((at, MatrixProblem::MatType { found: other })),
        };
        Ok((numbers, part.length))
    }
}

/// Numbers of `N` bytes each.
fn read_all<const N: usize>(order: Order, data: &[u8], number: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    let one = |bytes: &[u8]| {
        let mut bytes = *bytes.first_chunk::<N>()?;
        if order.big_endian {
            bytes.reverse();
        }
        Some(number(bytes))
    };
    data.chunks_exact(N).filter_map(one).collect()
}
