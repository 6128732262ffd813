use super::conserved_momentum::{inside, size};
use super::control::ControlTimes;
use super::external::{Forced, Pose};
use super::run::Start;
use super::timing::{Allowed, Timing};
use crate::math::sym3::{inverse, times};
use crate::math::vec3::{add, norm, scale};
use crate::model::{MotionState, Principal, Support};

/// Scales of errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Sum of the moments of inertia (kg·m²).
    pub inertia: f64,
    /// Angular velocity (rad/s): at the start, or the one that the moments, those of motors too, on the body in its initial pose would
    /// cause within a radian, or that their impulse would give, the smaller of the two, the largest over the time of the run; of a body at
    /// rest on which nothing acts, a radian over the run.
    pub spin: f64,
    /// Internal angular momentum (N·m·s), body axes.
    pub inside: [f64; 3],
    /// Angular momentum (N·m·s), of the whole or of the internal part that nearly cancels the rest.
    pub angular_momentum: f64,
    /// Place (m) and velocity (m/s); infinite where the place does not matter.
    pub place: f64,
    pub velocity: f64,
}

/// Number of times at which moments are evaluated, and the least in an interval in which forces change.
const MOMENT_SAMPLES: usize = 17;
const LEAST_LOOKS: usize = 3;
/// Most intervals in which moments are evaluated.
const MOST_INTERVALS: usize = 4096;

impl Scales {
    /// Sizes of a motion from a pose to a time `end` (s), and the timing of what acts on it, whose intervals they look at.
    pub fn timed<'a>(
        system: Forced<'a>,
        omega: [f64; 3],
        K: [f64; 3],
        pose: Pose<f64>,
        end: f64,
    ) -> (Self, Option<Timing<'a>>) {
        Self::controlled(system, (0.0, ControlTimes::default()), (omega, K), pose, end)
    }

    /// The same under controllers, with the size of their torque at the start (N·m) and what of them depends on the time.
    pub fn controlled<'a>(
        system: Forced<'a>,
        (torque, times): (f64, ControlTimes),
        (omega, K): ([f64; 3], [f64; 3]),
        pose: Pose<f64>,
        end: f64,
    ) -> (Self, Option<Timing<'a>>) {
        let timing = Timing::of(system, omega, &pose, end, times);
        let intervals = timing.as_ref().map_or_else(Vec::new, Timing::intervals);
        (Self::of(system, torque, (omega, K), pose, end, &intervals), timing)
    }

    /// Errors that a step may have at a tolerance, for the limits of the impulse. (Z4)
    pub fn allowed(&self, tolerance: f64) -> Allowed {
        Allowed { angular_momentum: tolerance * self.angular_momentum, velocity: tolerance * self.velocity }
    }

    /// Sizes of a motion from a pose to a time `end` (s); `intervals` are middles and lengths of those in which forces change.
    fn of(
        system: Forced,
        torque: f64,
        (omega, K): ([f64; 3], [f64; 3]),
        pose: Pose<f64>,
        end: f64,
        intervals: &[[f64; 2]],
    ) -> Self {
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
        let mut caused = (torque / inertia).sqrt();
        if system.acts() {
            let still = vec![0.0; system.body.coordinates().len()];
            let moment = |t: f64| norm(moment(system, &Pose { t, ..pose }, omega, &still));
            caused = spin_caused(moment, inertia, [pose.t, end], intervals).max(caused);
        }
        scales.spin = scales.spin.max(caused);
        if scales.spin == 0.0 && scales.angular_momentum == 0.0 {
            scales.spin = if end > 0.0 { end.recip() } else { 1.0 };
            caused = scales.spin;
        }
        if caused > 0.0 || system.acts() {
            scales.moved(system, pose);
        }
        scales
    }

    /// Sizes of a body at rest whose parts move: the angular velocity with their energy (J).
    pub fn stir(&mut self, energy: f64) {
        if energy > 0.0 {
            let spin = (2.0 * energy / self.inertia).sqrt();
            self.velocity *= spin.max(self.spin) / self.spin;
            self.spin = self.spin.max(spin);
            self.angular_momentum = self.angular_momentum.max(self.spin * self.inertia / 3.0);
        }
    }

    /// Sizes of the angular momentum, the place and the velocity that belong to the spin.
    fn moved(&mut self, system: Forced, pose: Pose<f64>) {
        self.angular_momentum = self.angular_momentum.max(self.spin * self.inertia / 3.0);
        if system.acts() && !matches!(system.body.support(), Support::FixedPoint { .. }) {
            let gyration = (self.inertia / system.body.invariants().mass).sqrt();
            self.place = gyration.max(norm(pose.place));
            self.velocity = (self.spin * gyration).max(norm(pose.velocity));
        }
    }
}

/// Angular velocity (rad/s, body axes) by which a body that starts from rest is judged: the one that what acts on it can cause until `end`
/// (s), about the axis that the largest moment turns it about; where nothing acts, a radian in that time about the axis of greatest inertia.
#[must_use]
pub fn spin_from_rest(system: Forced, start: Start, end: f64) -> [f64; 3] {
    let pose = Pose { t: 0.0, attitude: start.attitude, place: start.place, velocity: start.velocity };
    let (Scales { spin, .. }, timing) = Scales::timed(system, [0.0; 3], [0.0; 3], pose, end);
    let intervals = timing.as_ref().map_or_else(Vec::new, Timing::intervals);
    let J = system.body.invariants().J;
    let still = vec![0.0; system.body.coordinates().len()];
    let looks = (0..MOMENT_SAMPLES).map(|look| end * look as f64 / (MOMENT_SAMPLES - 1) as f64);
    let moments = looks
        .chain(intervals.iter().map(|[t, _]| *t))
        .map(|t| moment(system, &Pose { t, ..pose }, [0.0; 3], &still));
    let largest = moments.max_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or_default();
    let turned = times(inverse(J), largest);
    let axis = if norm(turned) > 0.0 { turned } else { Principal::compute(J).axes[2] };
    scale(spin / norm(axis), axis)
}

/// Moment (N·m) of what acts from outside, and of motors, on a body without displacements.
fn moment(system: Forced, pose: &Pose<f64>, omega: [f64; 3], still: &[f64]) -> [f64; 3] {
    let loads = system.loads(pose, MotionState { omega, q: still, rate: still });
    add(loads.moment, scale(-1.0, system.body.wheels().torque(pose.t)))
}

/// Angular velocity (rad/s) that moments cause: within a radian, or by their impulse where that is less, because they act shortly.
fn spin_caused(
    moment: impl Fn(f64) -> f64,
    inertia: f64,
    [from, to]: [f64; 2],
    intervals: &[[f64; 2]],
) -> f64 {
    let of = |[most, impulse]: [f64; 2]| (most / inertia).sqrt().min(impulse / inertia);
    let add = |[most, sum]: [f64; 2], now: f64, length: f64| [most.max(now), sum + now * length];
    if intervals.is_empty() {
        let step = (to - from) / (MOMENT_SAMPLES - 1) as f64;
        return of(
            (0..MOMENT_SAMPLES).fold([0.0; 2], |sum, look| add(sum, moment(from + step * look as f64), step))
        );
    }
    let stride = intervals.len().div_ceil(MOST_INTERVALS);
    let looks = MOMENT_SAMPLES.div_ceil(intervals.len()).max(LEAST_LOOKS);
    let share = |look: usize| (look as f64 + 0.5) / looks as f64 - 0.5;
    of(intervals.iter().step_by(stride).fold([0.0; 2], |sum, [middle, length]| {
        let each = length * stride as f64 / looks as f64;
        (0..looks).fold(sum, |sum, look| add(sum, moment(middle + share(look) * length), each))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::Expression;
    use crate::model::force::{Axes, Force, ForceLaw};
    use crate::problems::ring_of_points;

    /// From rest, in a moment `1.2e5 t (2 − t)` that is largest in the middle of the run: `Iω²` is that moment, and a point at the radius of
    /// gyration has `mv²` equal to it too.
    #[test]
    fn a_body_at_rest_has_the_scales_of_its_largest_moment() {
        let formula = |text: &str| {
            let names = ["x", "y", "z", "vx", "vy", "vz", "t", "wx", "wy", "wz", "qw", "qx", "qy", "qz"];
            Expression::parse(text, &names).unwrap()
        };
        let torque = ["0", "1.2e5*t*(2-t)", "0"].map(formula);
        let law = ForceLaw::TorqueExpression { torque, axes: Axes::Body };
        let mut assembly = ring_of_points(1);
        assembly.forces = vec![Force { name: "motor".into(), law }];
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let pose = Pose { t: 0.0, attitude: [1.0, 0.0, 0.0, 0.0], place: [0.0; 3], velocity: [0.0; 3] };
        let system = Forced { body: &body, forces: &forces };
        let found = Scales::of(system, 0.0, ([0.0; 3], [0.0; 3]), pose, 2.0, &[]);
        let [xx, yy, zz, ..] = body.invariants().J;
        let (inertia, mass) = (xx + yy + zz, body.invariants().mass);
        let close =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        close(inertia * found.spin * found.spin, 1.2e5);
        close(mass * found.velocity * found.velocity, 1.2e5);
        close(mass * found.place * found.place, inertia);
        close(3.0 * found.angular_momentum, inertia * found.spin);
    }

    /// A moment too short to turn the body by a radian gives its impulse.
    #[test]
    fn a_short_moment_has_the_scale_of_its_impulse() {
        let intervals: Vec<[f64; 2]> = (0..50).map(|i| [0.04 * f64::from(i) + 0.02, 0.04]).collect();
        for cells in [&[][..], &intervals] {
            let spin = spin_caused(|t| 3.0 * t * (2.0 - t), 40.0, [0.0, 2.0], cells);
            assert!((40.0 * spin / 4.0 - 1.0).abs() < 5e-3, "{spin}");
        }
    }
}
