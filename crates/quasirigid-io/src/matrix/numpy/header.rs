//! Header of a `.npy` file: the magic bytes, a version, and a Python dictionary as text.
//! The dictionary is parsed by hand, for the three keys that the format has; anything else is refused rather than guessed.
//! Format: NumPy Enhancement Proposal 1.

use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Header: everything before the numbers of an array.
pub(super) struct Header {
    /// Type of the numbers, such as `<f8`.
    pub descr: String,
    /// Whether the first index runs fastest.
    pub fortran_order: bool,
    pub shape: Vec<usize>,
    /// First byte of the numbers.
    pub size: usize,
}

/// Bytes before the length of the header.
const MAGIC: usize = 8;

impl Header {
    pub fn of(bytes: &[u8]) -> Result<Self, LocatedProblem> {
        let not_numpy = || MatrixProblem::NumpyHeader {
            found: String::from_utf8_lossy(&bytes[..bytes.len().min(MAGIC)]).into(),
        };
        let rest = bytes.strip_prefix(b"\x93NUMPY").ok_or_else(|| (0, not_numpy()))?;
        let (start, length) = match *rest {
            [1, _, a, b, ..] => (MAGIC + 2, usize::from(u16::from_le_bytes([a, b]))),
            [2 | 3, _, a, b, c, d, ..] => (MAGIC + 4, u32::from_le_bytes([a, b, c, d]) as usize),
            [major, ..] if !(1..=3).contains(&major) => {
                return Err((6, MatrixProblem::NumpyVersion { major }));
            }
            _ => return Err((0, not_numpy())),
        };
        let end = start.saturating_add(length);
        let (announced, found) = (length as u64, (bytes.len() - start) as u64);
        let header = bytes.get(start..end).ok_or((start, MatrixProblem::NumpyLength { announced, found }))?;
        let text = String::from_utf8_lossy(header);
        let refused = || (start, MatrixProblem::NumpyHeader { found: text.trim().into() });
        let [descr, fortran_order, shape] = Literal(&text).fields().ok_or_else(refused)?;
        let descr = match descr.strip_prefix(['\'', '"']).and_then(|text| text.strip_suffix(['\'', '"'])) {
            Some(descr) => descr.to_owned(),
            None => return Err((start, MatrixProblem::NumpyType { found: descr.into() })),
        };
        let fortran_order = match fortran_order {
            "True" => true,
            "False" => false,
            _ => return Err(refused()),
        };
        let shape = lengths(shape).ok_or_else(refused)?;
        Ok(Self { descr, fortran_order, shape, size: end })
    }
}

/// The lengths in a tuple such as `(3, 4)`, `(3,)` or `()`.
fn lengths(tuple: &str) -> Option<Vec<usize>> {
    let inside = tuple.strip_prefix('(')?.strip_suffix(')')?.trim();
    let inside = inside.strip_suffix(',').unwrap_or(inside);
    if inside.is_empty() {
        return Some(Vec::new());
    }
    inside.split(',').map(|length| length.trim().parse().ok()).collect()
}

/// A dictionary of Python as text.
struct Literal<'a>(&'a str);

impl<'a> Literal<'a> {
    /// The texts of the values of `descr`, `fortran_order` and `shape`, if these three are all there is.
    fn fields(&self) -> Option<[&'a str; 3]> {
        let mut rest = self.0.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
        let mut fields = [None; 3];
        while !rest.is_empty() {
            let quote = rest.chars().next().filter(|c| matches!(c, '\'' | '"'))?;
            let (key, after) = rest[1..].split_once(quote)?;
            let value = after.trim_start().strip_prefix(':')?.trim_start();
            let (value, after) = value.split_at(length(value)?);
            let index = ["descr", "fortran_order", "shape"].iter().position(|known| *known == key)?;
            if fields[index].replace(value.trim()).is_some() {
                return None;
            }
            rest = after.strip_prefix(',').unwrap_or(after).trim();
        }
        let [Some(descr), Some(fortran_order), Some(shape)] = fields else { return None };
        Some([descr, fortran_order, shape])
    }
}

/// Bytes up to the comma that ends a value: one outside of quotes and brackets.
fn length(value: &str) -> Option<usize> {
    let (mut depth, mut quote) = (0_i32, None);
    for (at, c) in value.char_indices() {
        match (quote, c) {
            (Some(open), c) if open == c => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') => quote = Some(c),
            (None, '(' | '[') => depth += 1,
            (None, ')' | ']') => depth -= 1,
            (None, ',') if depth == 0 => return Some(at),
            _ => {}
        }
    }
    (depth == 0 && quote.is_none()).then_some(value.len())
}
