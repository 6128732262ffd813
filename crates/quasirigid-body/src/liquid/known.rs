use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Complex;

use super::galerkin::Fields;

/// Key of cached fields: the parameters that they depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    /// Harmonic.
    pub m: usize,
    /// Numbers of functions.
    pub numbers: [usize; 2],
    /// Shape: cylinder or not, and the bits of its ratio of lengths.
    pub shape: (bool, u64),
}

/// Limit of the number of cached fields.
const KEPT: usize = 64;

/// Force per rate `1/(bᵀ(…)⁻¹b)` of fields at a frequency and a spin, in their units. NaN where the fields have no finite solution, and
/// for a frequency that is not finite, for which the number of functions is undefined.
pub(super) fn drag(key: Key, make: impl FnOnce() -> Fields, sigma: Complex<f64>, tau: f64) -> Complex<f64> {
    let finite = sigma.is_finite() && tau.is_finite();
    let answer = finite.then(|| known(key, make).answer(sigma, tau)).flatten();
    answer.map_or(Complex::new(f64::NAN, f64::NAN), |answer| answer.inv())
}

/// Fields from the cache, made on first use.
fn known(key: Key, make: impl FnOnce() -> Fields) -> Arc<Fields> {
    static KNOWN: Mutex<Option<HashMap<Key, Arc<Fields>>>> = Mutex::new(None);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_default();
    if known.len() >= KEPT && !known.contains_key(&key) {
        known.clear();
    }
    Arc::clone(known.entry(key).or_insert_with(|| Arc::new(make())))
}
