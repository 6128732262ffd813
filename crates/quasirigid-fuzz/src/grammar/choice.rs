//! Choices of a grammar. Where the bytes of the input are used up, the first choice is taken.

use arbitrary::Unstructured;

/// A number below `most`.
pub fn below(u: &mut Unstructured<'_>, most: usize) -> usize {
    u.int_in_range(0..=most.saturating_sub(1) as u16 as usize).unwrap_or(0)
}

/// True so many times in 256.
pub fn chance(u: &mut Unstructured<'_>, share: u8) -> bool {
    u.arbitrary::<u8>().is_ok_and(|byte| byte > 255 - share)
}

/// One of several words.
pub fn pick<'w>(u: &mut Unstructured<'_>, words: &[&'w str]) -> &'w str {
    words[below(u, words.len())]
}
