//! One execution of a target: a panic, and memory above the limit, become failures with a place.

use std::panic::{self, AssertUnwindSafe};
use std::sync::Mutex;

use crate::heap;
use crate::targets::Target;

/// A broken promise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// File and line of the panic, or `memory`.
    pub place: String,
    /// Message of the panic, or the memory used.
    pub message: String,
}

/// The last panic of the process.
static LAST: Mutex<Option<Failure>> = Mutex::new(None);

/// Notes panics in place of printing them.
pub fn catch_panics() {
    panic::set_hook(Box::new(|info| {
        let place = info.location().map_or_else(|| "?".to_owned(), ToString::to_string);
        let place = place.rsplit_once(':').map_or(place.as_str(), |(line, _)| line);
        let place = place.split_once("/registry/src/").map_or(place, |(_, library)| library);
        let place = place.trim_start_matches("index.crates.io-").to_owned();
        let message = info.payload_as_str().unwrap_or("a panic without words").to_owned();
        if let Ok(mut last) = LAST.lock() {
            *last = Some(Failure { place, message });
        }
    }));
}

/// Executes a target on an input.
///
/// # Errors
/// [`Failure`] for a panic, and for more memory than the target may use.
pub fn execute(target: &Target, input: &[u8]) -> Result<(), Failure> {
    let before = heap::begin();
    if panic::catch_unwind(AssertUnwindSafe(|| target.run(input))).is_err() {
        let last = LAST.lock().ok().and_then(|mut last| last.take());
        return Err(last.unwrap_or(Failure { place: "?".to_owned(), message: "a panic".to_owned() }));
    }
    let used = heap::peak().saturating_sub(before);
    if used <= target.memory {
        return Ok(());
    }
    let message =
        format!("{used} bytes for an input of {}; at most {} are allowed", input.len(), target.memory);
    Err(Failure { place: "memory".to_owned(), message })
}
