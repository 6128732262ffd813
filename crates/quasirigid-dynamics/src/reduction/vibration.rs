use super::decay::decay_rates;
use super::projection::Projection;
use crate::math::eigen::{NoConvergence, modes};
use crate::model::FlexibleBody;

/// Free vibrations of a body without spin: all of them, or for a body of many coordinates the slow ones.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibrations {
    /// Undamped natural frequencies with the attitude fixed (rad/s), ascending. (V2)
    pub frequencies: Vec<f64>,
    /// Undamped natural frequencies with the body free to recoil in rotation (rad/s), ascending; not below
    /// [`frequencies`](Self::frequencies).
    pub free_frequencies: Vec<f64>,
    /// Decay rates of the damped vibrations with the attitude fixed (1/s), ascending, two to a coordinate. (V3)
    pub decay_rates: Vec<f64>,
    /// Largest `β` of `B x = β C x` (s). (V5)
    pub damping_time: f64,
    /// Coordinate that moves most in the slowest vibration.
    pub softest: Option<String>,
}

/// Undamped natural frequencies with the attitude fixed (rad/s), ascending: all, or the slow ones of a body of many coordinates. (V2)
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails.
pub fn frequencies(body: &FlexibleBody) -> Result<Vec<f64>, NoConvergence> {
    let projection = Projection::compute(body)?;
    let held = modes(&projection.A, &projection.C)?;
    Ok(slow(held.frequencies, projection.trusted))
}

impl Vibrations {
    /// Free vibrations of a body.
    ///
    /// # Errors
    /// [`NoConvergence`] if an eigenvalue solver fails.
    pub fn compute(body: &FlexibleBody) -> Result<Self, NoConvergence> {
        let projection = Projection::compute(body)?;
        let Projection { A, recoiling, B, C, trusted, .. } = &projection;
        let held = modes(A, C)?;
        let softest = projection.largest_share(&held).map(|row| body.coordinates()[row].name.clone());
        Ok(Self {
            decay_rates: slow(decay_rates(&held, B)?, 2 * trusted),
            damping_time: modes(B, C)?.frequencies.first().map_or(0.0, |lowest| lowest.powi(-2)),
            free_frequencies: slow(modes(recoiling, C)?.frequencies, *trusted),
            frequencies: slow(held.frequencies, *trusted),
            softest,
        })
    }
}

/// Converged finite values: the infinite ones are of coordinates whose mass is lost in rounding.
fn slow(mut ascending: Vec<f64>, trusted: usize) -> Vec<f64> {
    ascending.truncate(trusted);
    ascending.retain(|value| value.is_finite());
    ascending
}
