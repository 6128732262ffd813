use super::external::{Forced, Pose};
use crate::math::sym::norm;
use crate::model::{Motion, Support};

/// Sizes that errors are measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Sum of the moments of inertia (kg·m²).
    pub inertia: f64,
    /// Spin (rad/s): at the start, or what the moments on the body as it stands there would give it within a radian, at any
    /// of its times.
    pub spin: f64,
    /// Momentum (N·m·s).
    pub momentum: f64,
    /// Place (m) and velocity (m/s); infinite where the place does not matter.
    pub place: f64,
    pub velocity: f64,
}

/// Times at which moments are looked at.
const LOOKS: usize = 17;

impl Scales {
    /// Sizes of a motion from a pose to a time `end` (s).
    pub fn of(system: Forced, omega: [f64; 3], K: [f64; 3], pose: Pose<f64>, end: f64) -> Self {
        let invariants = system.body.invariants();
        let [xx, yy, zz, ..] = invariants.J;
        let inertia = xx + yy + zz;
        let mut scales = Self {
            inertia,
            spin: norm(omega),
            momentum: norm(K),
            place: f64::INFINITY,
            velocity: f64::INFINITY,
        };
        if system.acts() {
            let still = vec![0.0; system.body.coordinates().len()];
            let moment = |look: usize| {
                let t = pose.t + (end - pose.t) * look as f64 / (LOOKS - 1) as f64;
                norm(system.loads(&Pose { t, ..pose }, Motion { omega, q: &still, rate: &still }).moment)
            };
            let largest = (0..LOOKS).map(moment).fold(0.0, f64::max);
            scales.spin = scales.spin.max((largest / inertia).sqrt());
            scales.momentum = scales.momentum.max(scales.spin * inertia / 3.0);
            if !matches!(system.body.support(), Support::FixedPoint { .. }) {
                let size = (inertia / invariants.mass).sqrt();
                scales.place = size.max(norm(pose.place));
                scales.velocity = (scales.spin * size).max(norm(pose.velocity));
            }
        }
        scales
    }
}
