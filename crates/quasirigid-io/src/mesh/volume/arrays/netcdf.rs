//! Classic netCDF: a header of dimensions, attributes and variables, then the values, highest byte first.
//! Versions 1, 2 (64-bit offsets) and 5 (64-bit data). Variables that grow with the time, of which a mesh has none, are left where they are.
//! NetCDF User's Guide, *File Format Specifications*.

use std::collections::HashMap;

use super::{Arrays, rows};
use crate::mesh::error::{Fault, MeshProblem, Part, Place};

const DIMENSIONS: u64 = 10;
const VARIABLES: u64 = 11;
const ATTRIBUTES: u64 = 12;
/// Type of letters.
const LETTERS: u64 = 2;

/// A variable: lengths, type, first byte, and the texts beside it.
struct Variable {
    lengths: Vec<usize>,
    kind: u64,
    begin: usize,
    texts: HashMap<String, String>,
}

/// A file by its header.
pub(in crate::mesh::volume) struct NetCdf<'a> {
    bytes: &'a [u8],
    variables: HashMap<String, Variable>,
}

impl<'a> NetCdf<'a> {
    pub(in crate::mesh::volume) fn read(bytes: &'a [u8]) -> Result<Self, Fault> {
        let version = bytes.get(3).copied().unwrap_or(0);
        let mut header = Header { bytes, next: 4, long: version == 5, far: version != 1 };
        header.count()?; // steps of the time
        let mut dimensions = Vec::new();
        for _ in 0..header.list(DIMENSIONS)? {
            header.name()?;
            dimensions.push(header.count()?);
        }
        header.attributes()?;
        let mut variables = HashMap::new();
        for _ in 0..header.list(VARIABLES)? {
            let (name, variable) = header.variable(&dimensions)?;
            if let Some(variable) = variable {
                variables.insert(name, variable);
            }
        }
        Ok(Self { bytes, variables })
    }

    /// The bytes of a variable.
    fn bytes_of(&self, variable: &Variable) -> Result<&'a [u8], Fault> {
        let count = variable.lengths.iter().try_fold(1usize, |count, length| count.checked_mul(*length));
        let size = count.and_then(|count| count.checked_mul(width(variable.kind)));
        let end = size.and_then(|size| variable.begin.checked_add(size));
        let bytes = end.and_then(|end| self.bytes.get(variable.begin..end));
        let announced = size.unwrap_or(usize::MAX) as u64;
        let found = self.bytes.len().saturating_sub(variable.begin) as u64;
        bytes.ok_or_else(|| cut(variable.begin, announced, found))
    }

    fn numbers<T>(&self, name: &str, of: fn(u64, &[u8]) -> T) -> Result<Option<Vec<T>>, Fault> {
        let Some(variable) = self.variables.get(name) else { return Ok(None) };
        let width = width(variable.kind).max(1);
        Ok(Some(self.bytes_of(variable)?.chunks_exact(width).map(|bytes| of(variable.kind, bytes)).collect()))
    }
}

impl Arrays for NetCdf<'_> {
    fn lengths(&self, name: &str) -> Option<Vec<usize>> {
        self.variables.get(name).map(|variable| variable.lengths.clone())
    }

    fn reals(&self, name: &str) -> Result<Option<Vec<f64>>, Fault> {
        self.numbers(name, |kind, bytes| match (kind, bytes.len()) {
            (5, 4) => f32::from_bits(bits(bytes) as u32).into(),
            (6, 8) => f64::from_bits(bits(bytes)),
            _ => whole(kind, bytes) as f64,
        })
    }

    fn integers(&self, name: &str) -> Result<Option<Vec<i64>>, Fault> {
        self.numbers(name, whole)
    }

    fn texts(&self, name: &str) -> Result<Option<Vec<String>>, Fault> {
        let Some(variable) = self.variables.get(name) else { return Ok(None) };
        if variable.kind != LETTERS {
            return Ok(None);
        }
        Ok(Some(rows(self.bytes_of(variable)?, variable.lengths.last().copied().unwrap_or(0))))
    }

    fn attribute(&self, name: &str, key: &str) -> Option<String> {
        self.variables.get(name)?.texts.get(key).cloned()
    }
}

/// Bytes of a value of a type; 0 of an unknown one.
fn width(kind: u64) -> usize {
    match kind {
        1 | 2 | 7 => 1,
        3 | 8 => 2,
        4 | 5 | 9 => 4,
        6 | 10 | 11 => 8,
        _ => 0,
    }
}

/// Up to eight bytes, the highest first.
fn bits(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0, |sum, byte| sum << 8 | u64::from(*byte))
}

/// A whole number, which has a sign unless its type says otherwise.
fn whole(kind: u64, bytes: &[u8]) -> i64 {
    let (bits, empty) = (bits(bytes), 64 - 8 * bytes.len() as u32);
    match kind {
        7 | 8 | 9 | 11 => i64::try_from(bits).unwrap_or(i64::MAX),
        _ => (bits << empty.min(63)) as i64 >> empty.min(63),
    }
}

/// The header, from the next byte on.
struct Header<'a> {
    bytes: &'a [u8],
    next: usize,
    /// Whether counts have 64 bits.
    long: bool,
    /// Whether offsets have 64 bits.
    far: bool,
}

impl<'a> Header<'a> {
    fn take(&mut self, size: u64) -> Result<&'a [u8], Fault> {
        let end = usize::try_from(size).ok().and_then(|size| self.next.checked_add(size));
        let found = (self.bytes.len() - self.next) as u64;
        let bytes = end.and_then(|end| self.bytes.get(self.next..end));
        let bytes = bytes.ok_or_else(|| cut(self.next, size, found))?;
        self.next += bytes.len();
        Ok(bytes)
    }

    fn count(&mut self) -> Result<u64, Fault> {
        self.take(if self.long { 8 } else { 4 }).map(bits)
    }

    /// The number of entries of a list, none where it is absent.
    fn list(&mut self, tag: u64) -> Result<u64, Fault> {
        let at = self.next;
        let found = bits(self.take(4)?);
        let count = self.count()?;
        if found != tag && (found != 0 || count != 0) {
            return Err(cut(at, tag, found));
        }
        Ok(count)
    }

    /// So many bytes, filled up to a multiple of four.
    fn padded(&mut self, size: u64) -> Result<&'a [u8], Fault> {
        let bytes = self.take(size)?;
        self.take(size.next_multiple_of(4) - size)?;
        Ok(bytes)
    }

    fn name(&mut self) -> Result<String, Fault> {
        let size = self.count()?;
        self.padded(size).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    /// Attributes that are texts.
    fn attributes(&mut self) -> Result<HashMap<String, String>, Fault> {
        let mut texts = HashMap::new();
        for _ in 0..self.list(ATTRIBUTES)? {
            let name = self.name()?;
            let kind = bits(self.take(4)?);
            let count = self.count()?;
            let bytes = self.padded(count.saturating_mul(width(kind) as u64))?;
            if kind == LETTERS {
                texts.insert(name, rows(bytes, bytes.len()).concat());
            }
        }
        Ok(texts)
    }

    /// A variable; none that grows with the time, whose first dimension has no length.
    fn variable(&mut self, dimensions: &[u64]) -> Result<(String, Option<Variable>), Fault> {
        let name = self.name()?;
        let (count, mut lengths, mut grows) = (self.count()?, Vec::new(), false);
        for _ in 0..count {
            let dimension = self.count()?;
            let length = usize::try_from(dimension).ok().and_then(|dimension| dimensions.get(dimension));
            let length = *length.ok_or_else(|| cut(self.next, dimension, dimensions.len() as u64))?;
            grows |= length == 0;
            lengths.push(usize::try_from(length).unwrap_or(usize::MAX));
        }
        let texts = self.attributes()?;
        let kind = bits(self.take(4)?);
        self.count()?; // size
        let begin = usize::try_from(bits(self.take(if self.far { 8 } else { 4 })?)).unwrap_or(usize::MAX);
        let variable = Variable { lengths, kind, begin, texts };
        Ok((name, (!grows && width(variable.kind) > 0).then_some(variable)))
    }
}

fn cut(at: usize, announced: u64, found: u64) -> Fault {
    (Place::Byte(at), MeshProblem::Cut { part: Part::Values("netCDF".into()), announced, found })
}
