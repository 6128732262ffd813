//! Smaller inputs with the same failure: ranges are removed as long as the target fails at the same place.

use std::time::{Duration, Instant};

use crate::execution::execute;
use crate::targets::Target;

/// Time for one input.
const TIME: Duration = Duration::from_secs(20);

/// The smallest input found that fails at this place; the input itself if none is smaller.
#[must_use]
pub fn minimized(target: &Target, input: &[u8], place: &str) -> Vec<u8> {
    let fails = |bytes: &[u8]| execute(target, bytes).is_err_and(|failure| failure.place == place);
    let start = Instant::now();
    let mut best = input.to_vec();
    let mut size = best.len().div_ceil(2);
    while size > 0 && start.elapsed() < TIME {
        let mut at = 0;
        while at < best.len() && start.elapsed() < TIME {
            let mut shorter = best.clone();
            shorter.drain(at..(at + size).min(best.len()));
            if fails(&shorter) {
                best = shorter;
            } else {
                at += size;
            }
        }
        size /= 2;
    }
    best
}
