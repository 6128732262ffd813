use crate::math::eigen::{Dense, NoConvergence, modes};
use crate::math::span::largest;
use crate::model::FlexibleBody;

/// Relaxation of rotors and liquids relative to the body: decay of its cyclic coordinates. (C7)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Relaxation {
    /// Relaxation times with the attitude fixed (s), descending: `τ` of `A x = τ B x`.
    pub times: Vec<f64>,
    /// Coordinate that moves most in the slowest relaxation.
    pub slowest: Option<String>,
}

impl Relaxation {
    /// Relaxations of a body; none without cyclic coordinates.
    ///
    /// # Errors
    /// [`NoConvergence`] if the eigenvalue solver fails.
    pub fn compute(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        let cyclic = body.cyclic();
        if cyclic.is_empty() {
            return Ok(Self::default());
        }
        let found = modes(&body.cyclic_mass(), &Dense::of(&body.damping().block(cyclic.clone())))?;
        let slowest: Vec<f64> = (0..cyclic.len()).map(|row| found.shapes.at(row, 0)).collect();
        let name = |row: usize| body.coordinates()[cyclic.start + row].name.clone();
        Ok(Self {
            times: found.frequencies.iter().map(|frequency| frequency.powi(-2)).collect(),
            slowest: largest(&slowest).map(name),
        })
    }

    /// Longest relaxation time (s); zero if there is none.
    #[must_use]
    pub fn longest(&self) -> f64 {
        self.times.first().copied().unwrap_or(0.0)
    }
}
