//! Binary `OUTPUT4`: Fortran records of words of 32 or 64 bits in either byte order.
//! Both lengths of each record are compared, so that a file changed by a text transfer is refused where the damage is.
//! Format: NX Nastran DMAP Programmer's Guide, OUTPUT4.

use super::{Header, Records};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Fortran records: the length in bytes, so many bytes, and the length again.
pub(super) struct Binary<'a> {
    bytes: &'a [u8],
    big_endian: bool,
    /// The next byte.
    next: usize,
    /// First byte of the value read last.
    at: usize,
    /// First byte and end of the record, without its lengths.
    record: (usize, usize),
    double: bool,
    /// Whether words have 64 bits; then each number is one word.
    long: bool,
}

/// Bytes of a header in words of 32 bits, and of 64.
const HEADER: u32 = 24;
const LONG_HEADER: u32 = 48;

/// Whether the highest byte comes first, if a file begins with the record of a header.
pub(in crate::matrix) fn byte_order(bytes: &[u8]) -> Option<bool> {
    let first = bytes.first_chunk::<4>()?;
    [true, false].into_iter().find(|big_endian| {
        let length = if *big_endian { u32::from_be_bytes(*first) } else { u32::from_le_bytes(*first) };
        let again = bytes.get(4 + length as usize..).and_then(|rest| rest.first_chunk::<4>());
        matches!(length, HEADER | LONG_HEADER) && again == Some(first)
    })
}

/// Name of a matrix: eight letters, which words of 64 bits have together or four to a word.
fn name(bytes: &[u8]) -> String {
    let blank = |part: &[u8]| part.iter().all(|byte| matches!(byte, b' ' | 0));
    let letters = match bytes.split_at_checked(8) {
        Some((first, second)) if !blank(second) && blank(&first[4..]) => {
            [&first[..4], &second[..4.min(second.len())]].concat()
        }
        Some((first, _)) => first.to_vec(),
        None => bytes.to_vec(),
    };
    String::from_utf8_lossy(&letters).trim_matches(['\0', ' ']).to_owned()
}

impl<'a> Binary<'a> {
    pub fn new(bytes: &'a [u8], big_endian: bool) -> Self {
        Self { bytes, big_endian, next: 0, at: 0, record: (0, 0), double: false, long: false }
    }

    /// The next bytes before an end, the lowest first.
    fn take<const N: usize>(&mut self, end: usize) -> Result<[u8; N], LocatedProblem> {
        let rest = self.bytes.get(self.next..end).and_then(|rest| rest.first_chunk::<N>());
        let found = end.saturating_sub(self.next) as u64;
        let mut bytes = *rest.ok_or((self.next, MatrixProblem::Record { announced: N as u64, found }))?;
        (self.at, self.next) = (self.next, self.next + N);
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn integer(&mut self) -> Result<i64, LocatedProblem> {
        if self.long {
            return self.take(self.record.1).map(i64::from_le_bytes);
        }
        self.take(self.record.1).map(|bytes| i32::from_le_bytes(bytes).into())
    }

    /// Begins a record.
    fn open(&mut self) -> Result<(), LocatedProblem> {
        let length = u32::from_le_bytes(self.take(self.bytes.len())?) as usize;
        let found = (self.bytes.len() - self.next).saturating_sub(4);
        if length > found {
            return Err((self.at, MatrixProblem::Record { announced: length as u64, found: found as u64 }));
        }
        self.record = (self.next, self.next + length);
        Ok(())
    }

    /// Ends a record at its second length.
    fn close(&mut self) -> Result<(), LocatedProblem> {
        let (start, end) = self.record;
        let (announced, found) = ((end - start) as u64, (self.next - start) as u64);
        if found != announced {
            return Err((self.next, MatrixProblem::Record { announced, found }));
        }
        let again = u32::from_le_bytes(self.take(self.bytes.len())?).into();
        if again != announced {
            return Err((self.at, MatrixProblem::Record { announced, found: again }));
        }
        Ok(())
    }
}

impl Records for Binary<'_> {
    const COUNTS_NUMBERS: bool = false;

    fn header(&mut self) -> Result<Option<Header>, LocatedProblem> {
        if self.next == self.bytes.len() {
            return Ok(None);
        }
        self.open()?;
        let (start, end) = self.record;
        match (end - start) as u32 {
            HEADER => self.long = false,
            LONG_HEADER => self.long = true,
            found => {
                let (announced, found) = (HEADER.into(), found.into());
                return Err((start, MatrixProblem::Record { announced, found }));
            }
        }
        let mut sizes = [0; 4];
        for size in &mut sizes {
            *size = self.integer()?;
        }
        let name = name(&self.bytes[self.next..end]);
        self.next = end;
        self.close()?;
        self.double = self.long || sizes[3] % 2 == 0;
        Ok(Some(Header { long: self.long, ..Header::new(sizes, &name, start)? }))
    }

    fn column(&mut self) -> Result<[i64; 3], LocatedProblem> {
        self.open()?;
        self.integers()
    }

    fn integers<const N: usize>(&mut self) -> Result<[i64; N], LocatedProblem> {
        let mut integers = [0; N];
        for integer in &mut integers {
            *integer = self.integer()?;
        }
        Ok(integers)
    }

    fn run(&mut self) {}

    fn value(&mut self) -> Result<f64, LocatedProblem> {
        let value = if self.double {
            f64::from_le_bytes(self.take(self.record.1)?)
        } else {
            f32::from_le_bytes(self.take(self.record.1)?).into()
        };
        if value.is_finite() {
            return Ok(value);
        }
        Err((self.at, MatrixProblem::NotFinite { found: value.to_string().into() }))
    }

    fn end(&mut self) -> Result<(), LocatedProblem> {
        self.close()
    }

    fn skip(&mut self) -> Result<(), LocatedProblem> {
        self.next = self.record.1;
        self.close()
    }

    fn at(&self) -> usize {
        self.at
    }
}
