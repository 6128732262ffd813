use super::conserved_momentum::{inside, size};
use super::external::{Forced, Pose};
use crate::math::vec3::{add, norm, scale};
use crate::model::{MotionState, Support};

/// Scales of errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Sum of the moments of inertia (kg·m²).
    pub inertia: f64,
    /// Angular velocity (rad/s): at the start, or the one that the moments, those of motors too, on the body in its initial pose would
    /// cause within a radian, the largest over the time of the run.
    pub spin: f64,
    /// Internal angular momentum (N·m·s), body axes.
    pub inside: [f64; 3],
    /// Angular momentum (N·m·s), of the whole or of the internal part that nearly cancels the rest.
    pub angular_momentum: f64,
    /// Place (m) and velocity (m/s); infinite where the place does not matter.
    pub place: f64,
    pub velocity: f64,
}

/// Number of times at which moments are evaluated.
const LOOKS: usize = 17;

impl Scales {
    /// Sizes of a motion from a pose to a time `end` (s).
    pub fn of(system: Forced, omega: [f64; 3], K: [f64; 3], pose: Pose<f64>, end: f64) -> Self {
        let invariants = system.body.invariants();
        let [xx, yy, zz, ..] = invariants.J;
        let inertia = xx + yy + zz;
        let inside = inside(K, invariants.J, omega);
        let mut scales = Self {
            inertia,
            spin: norm(omega),
            inside,
            angular_momentum: size(K, inside),
            place: f64::INFINITY,
            velocity: f64::INFINITY,
        };
        if system.acts() {
            let still = vec![0.0; system.body.coordinates().len()];
            let moment = |look: usize| {
                let t = pose.t + (end - pose.t) * look as f64 / (LOOKS - 1) as f64;
                let loads = system.loads(&Pose { t, ..pose }, MotionState { omega, q: &still, rate: &still });
                norm(add(loads.moment, scale(-1.0, system.body.wheels().torque(t))))
            };
            let largest = (0..LOOKS).map(moment).fold(0.0, f64::max);
            scales.spin = scales.spin.max((largest / inertia).sqrt());
            scales.angular_momentum = scales.angular_momentum.max(scales.spin * inertia / 3.0);
            if !matches!(system.body.support(), Support::FixedPoint { .. }) {
                let gyration = (inertia / invariants.mass).sqrt();
                scales.place = gyration.max(norm(pose.place));
                scales.velocity = (scales.spin * gyration).max(norm(pose.velocity));
            }
        }
        scales
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::Expression;
    use crate::model::force::{Axes, Force, ForceLaw};
    use crate::problems::ring_of_points;

    /// From rest, in a moment `12 t (2 − t)` that is largest in the middle of the run: `Iω²` is that moment, and a point at the radius of
    /// gyration has `mv²` equal to it too.
    #[test]
    fn a_body_at_rest_has_the_scales_of_its_largest_moment() {
        let formula = |text: &str| {
            let names = ["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"];
            Expression::parse(text, &names).unwrap()
        };
        let torque = ["0", "12*t*(2-t)", "0"].map(formula);
        let law = ForceLaw::TorqueExpression { torque, axes: Axes::Body };
        let mut assembly = ring_of_points(1);
        assembly.forces = vec![Force { name: "motor".into(), law }];
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let pose = Pose { t: 0.0, attitude: [1.0, 0.0, 0.0, 0.0], place: [0.0; 3], velocity: [0.0; 3] };
        let found = Scales::of(Forced { body: &body, forces: &forces }, [0.0; 3], [0.0; 3], pose, 2.0);
        let [xx, yy, zz, ..] = body.invariants().J;
        let (inertia, mass) = (xx + yy + zz, body.invariants().mass);
        let close =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        close(inertia * found.spin * found.spin, 12.0);
        close(mass * found.velocity * found.velocity, 12.0);
        close(mass * found.place * found.place, inertia);
        close(3.0 * found.angular_momentum, inertia * found.spin);
    }
}
