use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::galerkin::Fields;

/// What fields depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    /// The harmonic.
    pub m: usize,
    /// Numbers of functions.
    pub numbers: [usize; 2],
    /// Whether the shape is a cylinder, and the bits of its ratio of lengths.
    pub shape: (bool, u64),
}

/// Fields that are kept.
const KEPT: usize = 64;

/// Fields, which are made once.
pub(super) fn known(key: Key, make: impl FnOnce() -> Fields) -> Arc<Fields> {
    static KNOWN: Mutex<Option<HashMap<Key, Arc<Fields>>>> = Mutex::new(None);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_default();
    if known.len() >= KEPT && !known.contains_key(&key) {
        known.clear();
    }
    Arc::clone(known.entry(key).or_insert_with(|| Arc::new(make())))
}
