//! Which eigenvalues of a system do not decay.

use super::C;
use super::schur::Schur;

/// Eigenvalues by what becomes of their motions.
#[derive(Clone, Debug)]
pub(super) struct Poles {
    pub values: Vec<C>,
    /// Zero, or at a rate that rigid motions have by nature.
    pub rigid: Vec<bool>,
    /// Growing, or not decaying beyond rounding; the rigid ones too.
    pub lasting: Vec<bool>,
    /// Growing beyond rounding.
    pub growing: Vec<bool>,
}

/// Rounding of an eigenvalue, and the square of that of a double one, in roundings of the norm of its group.
const SIMPLE: f64 = 1e3;
const DOUBLE: f64 = 1e2;
/// Share of an imaginary part from which an eigenvalue is complex.
const COMPLEX: f64 = 1e-10;

impl Poles {
    /// Rigid motions have the eigenvalues zero and `±i rate`.
    pub fn of(schur: &Schur, rate: f64) -> Self {
        let values = schur.eigenvalues();
        let roundings = |k: usize, factor: f64| {
            let (norm, size) = schur.groups[schur.group[k]];
            (factor * size as f64 * f64::EPSILON, norm)
        };
        let simple = |k: usize| {
            let (share, norm) = roundings(k, SIMPLE);
            share * norm
        };
        let slow = |k: usize| {
            let (share, norm) = roundings(k, DOUBLE);
            values[k].norm() <= share.sqrt() * norm
        };
        let marginal = |k: usize| values[k].re >= -simple(k);
        // a double zero comes apart by the root of the rounding, to either side
        let zero = |k: usize| {
            let apart = |other: usize| {
                schur.group[other] == schur.group[k]
                    && slow(other)
                    && marginal(other)
                    && values[other].norm() > simple(other)
            };
            values[k].norm() <= simple(k) || slow(k) && (0..values.len()).any(apart)
        };
        let spinning = |k: usize| {
            values[k].re.abs() <= simple(k) && (values[k].norm() - rate).abs() <= simple(k).max(1e-12 * rate)
        };
        let all = 0..values.len();
        let rigid: Vec<_> = all.clone().map(|k| zero(k) || rate > 0.0 && spinning(k)).collect();
        let lasting = all.clone().map(|k| rigid[k] || marginal(k)).collect();
        let growing = all.map(|k| !rigid[k] && values[k].re > simple(k)).collect();
        let complex = |k: usize| values[k].im.abs() > simple(k).max(COMPLEX * values[k].norm());
        let complex: Vec<_> = (0..values.len()).map(complex).collect();
        let mut poles = Self { values, rigid, lasting, growing };
        let [rigid, lasting, growing] = [&poles.rigid, &poles.lasting, &poles.growing]
            .map(|flags| poles.with_conjugates(flags, &complex));
        (poles.rigid, poles.lasting, poles.growing) = (rigid, lasting, growing);
        poles
    }

    /// Flags with those of the conjugates, each of one complex eigenvalue.
    fn with_conjugates(&self, flags: &[bool], complex: &[bool]) -> Vec<bool> {
        let side = |sign: f64| {
            let on = |k: &usize| complex[*k] && sign * self.values[*k].im > 0.0;
            (0..flags.len()).filter(on).collect::<Vec<_>>()
        };
        let (mut both, mut below) = (flags.to_vec(), side(-1.0));
        for k in side(1.0) {
            let gap = |other: &usize| (self.values[*other] - self.values[k].conj()).norm();
            let nearest = (0..below.len()).min_by(|a, b| gap(&below[*a]).total_cmp(&gap(&below[*b])));
            let Some(twin) = nearest.map(|place| below.swap_remove(place)) else { continue };
            let either = flags[k] || flags[twin];
            (both[k], both[twin]) = (either, either);
        }
        both
    }
}
