use crate::dynamics::Sample;
use crate::math::rotation::angle_between;
use crate::math::vec3::{add, norm, scale};

/// Largest differences between a reduced history and the full one over all output times.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Difference in angular velocity, relative to the largest angular velocity.
    pub omega: f64,
    /// Difference in attitude (rad).
    pub attitude: f64,
    /// Difference in the energy taken by the dashpots (J).
    pub dissipated: f64,
    /// Energy taken by the dashpots (J) at the end of the full history.
    pub dissipation: f64,
}

impl Difference {
    /// Compares two histories at the same times.
    #[must_use]
    pub fn between(full: &[Sample], reduced: &[Sample]) -> Self {
        let spin = full.iter().map(|sample| norm(sample.omega)).fold(0.0, f64::max);
        let mut difference =
            Self { dissipation: full.last().map_or(0.0, |last| last.dissipated), ..Self::default() };
        if full.len() != reduced.len() {
            return Self { omega: f64::NAN, attitude: f64::NAN, dissipated: f64::NAN, ..difference };
        }
        for (full, reduced) in full.iter().zip(reduced) {
            let gap = norm(add(full.omega, scale(-1.0, reduced.omega))) / spin;
            let turned = angle_between(full.attitude, reduced.attitude);
            let taken = (full.dissipated - reduced.dissipated).abs();
            for (largest, value) in [
                (&mut difference.omega, gap),
                (&mut difference.attitude, turned),
                (&mut difference.dissipated, taken),
            ] {
                if !(value <= *largest) {
                    *largest = value;
                }
            }
        }
        difference
    }
}
