//! Bytes of the arrays of a `.vtu` file: raw or base64, plain or in compressed blocks.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

use super::{MeshProblem, VolumeProblem};

/// Layout of the bytes of the arrays of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) big_endian: bool,
    /// Whether lengths have 8 bytes instead of 4.
    pub(super) wide: bool,
    pub(super) compressed: bool,
}

/// Bytes as a file has them, from the beginning of an array on.
#[derive(Clone, Debug)]
pub(super) enum Encoded<'a> {
    Raw(&'a [u8]),
    Base64(Cow<'a, [u8]>),
}

impl Encoded<'_> {
    /// So many bytes, which were encoded together, after `skipped` bytes or characters; and where they end.
    fn bytes(&self, skipped: usize, size: u64) -> Option<(Cow<'_, [u8]>, usize)> {
        let size = usize::try_from(size).ok()?;
        match self {
            Self::Raw(bytes) => {
                let end = skipped.checked_add(size)?;
                Some((Cow::Borrowed(bytes.get(skipped..end)?), end))
            }
            Self::Base64(text) => {
                let end = skipped.checked_add(size.div_ceil(3).checked_mul(4)?)?;
                let bytes = STANDARD.decode(text.get(skipped..end)?).ok()?;
                (bytes.len() >= size).then_some((Cow::Owned(bytes), end))
            }
        }
    }
}

impl Layout {
    /// Bytes of an array, of which no more than a limit are decompressed.
    pub(super) fn decoded<'a>(
        &self,
        encoded: &'a Encoded,
        array: &str,
        limit: u64,
    ) -> Result<Cow<'a, [u8]>, MeshProblem> {
        if self.compressed {
            return self.decompressed(encoded, array, limit).map(Cow::Owned);
        }
        self.plain(encoded).ok_or_else(|| wrong_text(array))
    }

    fn width(&self) -> usize {
        if self.wide { 8 } else { 4 }
    }

    fn length(&self, bytes: &[u8]) -> u64 {
        let high_first = |sum, byte: &u8| sum << 8 | u64::from(*byte);
        if self.big_endian {
            bytes.iter().fold(0, high_first)
        } else {
            bytes.iter().rev().fold(0, high_first)
        }
    }

    /// Length, then bytes; in base64 either encoded together or each for itself.
    fn plain<'a>(&self, encoded: &'a Encoded) -> Option<Cow<'a, [u8]>> {
        let (head, end) = encoded.bytes(0, self.width() as u64)?;
        let length = self.length(&head[..self.width()]);
        if head.len() == self.width() {
            return Some(encoded.bytes(end, length)?.0);
        }
        let (mut bytes, _) = encoded.bytes(0, length.checked_add(self.width() as u64)?)?;
        Some(bytes.to_mut().drain(self.width()..).take(length as usize).collect::<Vec<_>>().into())
    }

    /// Number of blocks, size of a block, size of the last if it is smaller, size of each when compressed;
    /// then blocks.
    fn decompressed(&self, encoded: &Encoded, array: &str, limit: u64) -> Result<Vec<u8>, MeshProblem> {
        let width = self.width() as u64;
        let (head, _) = encoded.bytes(0, 3 * width).ok_or_else(|| wrong_text(array))?;
        let number =
            |bytes: &[u8], place: usize| self.length(&bytes[place * width as usize..][..width as usize]);
        let [blocks, size, last] = [0, 1, 2].map(|place| number(&head, place));
        let header = blocks.checked_add(3).and_then(|numbers| numbers.checked_mul(width));
        let (head, start) =
            header.and_then(|size| encoded.bytes(0, size)).ok_or_else(|| wrong_text(array))?;
        let sizes: Vec<u64> = (0..blocks as usize).map(|block| number(&head, 3 + block)).collect();
        let total = sizes.iter().try_fold(0u64, |sum, size| sum.checked_add(*size));
        let (bytes, _) =
            total.and_then(|total| encoded.bytes(start, total)).ok_or_else(|| wrong_text(array))?;

        let (mut rest, mut decompressed) = (&*bytes, Vec::new());
        for (block, compressed) in (0u64..).zip(sizes) {
            let expected = if block + 1 == blocks && last > 0 { last } else { size };
            if expected.saturating_add(decompressed.len() as u64) > limit {
                let array = array.to_owned();
                return Err(VolumeProblem::Inflated { array, limit }.into());
            }
            let (here, after) = rest.split_at(compressed as usize); // the total is there
            rest = after;
            let bytes = decompress_to_vec_zlib_with_limit(here, expected as usize).ok();
            let wrong = VolumeProblem::Compressed { array: array.to_owned(), block };
            decompressed.extend(bytes.filter(|bytes| bytes.len() as u64 == expected).ok_or(wrong)?);
        }
        Ok(decompressed)
    }
}

fn wrong_text(array: &str) -> MeshProblem {
    VolumeProblem::Base64 { array: array.to_owned() }.into()
}
