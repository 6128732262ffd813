use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Complex;

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

/// Force per rate `1/(bᵀ(…)⁻¹b)` of fields at a frequency and a spin, in their units. Not a number where floating point finds none, nor of a
/// frequency that is none, for which there is no number of functions.
pub(super) fn drag(key: Key, make: impl FnOnce() -> Fields, sigma: Complex<f64>, tau: f64) -> Complex<f64> {
    let finite = sigma.is_finite() && tau.is_finite();
    let answer = finite.then(|| known(key, make).answer(sigma, tau)).flatten();
    answer.map_or(Complex::new(f64::NAN, f64::NAN), |answer| answer.inv())
}

/// Fields, which are made once.
fn known(key: Key, make: impl FnOnce() -> Fields) -> Arc<Fields> {
    static KNOWN: Mutex<Option<HashMap<Key, Arc<Fields>>>> = Mutex::new(None);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_default();
    if known.len() >= KEPT && !known.contains_key(&key) {
        known.clear();
    }
    Arc::clone(known.entry(key).or_insert_with(|| Arc::new(make())))
}
