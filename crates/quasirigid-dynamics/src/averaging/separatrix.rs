//! Place beside the separatrix up to which the mean power follows `⟨|ω̇|²⟩`. (Q4)

use crate::model::Mode;

/// Place `ξ` beyond which `P/⟨|ω̇|²⟩` is that at the separatrix, where `nearest` is that place for moments of inertia (kg·m², ascending) of
/// like differences.
///
/// Towards a plane of steady spins, about which two moments are equal, the ratio falls with the energy without an end: the polhode rate does.
/// Moments that differ a little end the fall where the energy left is of the order of their difference.
#[must_use]
pub fn constant_beyond([I1, I2, I3]: [f64; 3], mode: Mode, nearest: f64) -> f64 {
    let (own, other) = match mode {
        Mode::LongAxis => (I2 - I1, I3 - I2),
        Mode::ShortAxis => (I3 - I2, I2 - I1),
    };
    nearest + (other / own).ln().min(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::averaging::{FreeRotation, MeanPower, Response};
    use crate::problems::ring_of_points;

    /// Beyond the place the ratio changes little, for any difference of the moments; of two equal ones it falls everywhere.
    #[test]
    fn the_ratio_is_constant_beyond() {
        let response = Response::compute(&ring_of_points(4).body().unwrap()).unwrap();
        let [I1, _, I3] = response.moments();
        let ratio = |moments: [f64; 3], xi: f64| {
            let motion = FreeRotation::at_logit(moments, 0.5 * I3, Mode::LongAxis, xi);
            response.mean_power(&motion) / motion.mean_square_acceleration()
        };
        for gap in [0.3, 1e-2, 1e-4] {
            let moments = [I1, I3 - gap * (I3 - I1), I3];
            let place = constant_beyond(moments, Mode::LongAxis, -8.0);
            let change = ratio(moments, place - 3.0) / ratio(moments, place) - 1.0;
            assert!(change.abs() < 5e-3, "{gap} {change}");
        }
        assert_eq!(constant_beyond([I1, I3, I3], Mode::LongAxis, -8.0), f64::NEG_INFINITY);
    }
}
