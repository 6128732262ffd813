//! Vibrations that forces excite, followed in modes beside a reduced motion: by how much its angular velocity is off, and when.
//! The reduced equations place the parts where the present force would hold them; where the force changes as fast as the parts vibrate they are
//! elsewhere, and the carrier turns by the difference.
//! Equations (E8) and (E9), docs/theory/09-forced-reduction.md.

use super::flow::SlowPoint;
use super::oscillator::Oscillator;
use crate::dynamics::damped::undamped;
use crate::dynamics::external::{Forced, Pose};
use crate::math::ode::Checkpoint;
use crate::math::sym3::{inverse, times};
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::MotionState;

/// Error of the angular velocity of a reduced motion by vibrations that forces excite. (E8)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ringing {
    /// First time (s) at which the error is above [`Ringing::TOLD`] of the largest angular velocity so far.
    pub from: f64,
    /// Last such time (s).
    pub to: f64,
    /// Largest error (rad/s).
    pub omega: f64,
    /// That relative to the largest angular velocity of the run.
    pub share: f64,
}

impl Ringing {
    /// Error of the angular velocity, relative to the largest so far, that counts.
    pub const TOLD: f64 = 0.05;

    fn joined(self, other: &Self) -> Self {
        Self {
            from: self.from.min(other.from),
            to: self.to.max(other.to),
            omega: self.omega.max(other.omega),
            ..self
        }
    }
}

/// Most coordinates of a body whose modes are found.
const MOST_COORDINATES: usize = 256;
/// Parts of a step in each of which loads are taken as linear.
const PARTS: usize = 8;
/// Angular velocity relative to the largest of the run below which its errors do not count.
const NEGLIGIBLE: f64 = 1e-3;

/// Mode with what takes loads and motions into it, `x` and `M x`, and the angular velocity (rad/s) of the carrier per unit of its rate.
#[derive(Clone, Debug)]
struct Mode {
    oscillator: Oscillator,
    shape: Vec<f64>,
    row: Vec<f64>,
    recoil: [f64; 3],
}

/// Vibrations beside a reduced motion.
#[derive(Clone, Debug)]
pub(super) struct Vibrations {
    modes: Vec<Mode>,
    /// Loads on the modes at the last time.
    loads: Vec<f64>,
    /// Largest angular velocity (rad/s) of the rigid motion so far.
    largest: f64,
    /// Errors above the limit, of each decade of the largest angular velocity, ascending, which is that of time too.
    told: Vec<(i32, Ringing)>,
}

impl Vibrations {
    /// Modes of a body under forces; none without forces or parts, and of a body with more coordinates than can be followed.
    pub fn of(system: Forced) -> Option<Self> {
        let body = system.body;
        let n = body.coordinates().len();
        if !system.acts() || !(1..=MOST_COORDINATES).contains(&n) {
            return None;
        }
        let mass = body.recoiling_mass_matrix();
        let found = undamped(body, &mass).ok()?;
        let turned = inverse(body.invariants().J);
        let mode = |(k, shape): (usize, Vec<f64>)| {
            let damping = body.damping().quadratic(&shape);
            let frequency = found.frequencies.get(k).copied().unwrap_or(0.0);
            let momentum =
                body.invariants().h.iter().zip(&shape).fold([0.0; 3], |sum, (h, x)| add(sum, scale(*x, *h)));
            let oscillator = Oscillator { frequency, damping, value: 0.0, rate: 0.0 };
            Mode { oscillator, row: mass.times(&shape), recoil: times(turned, momentum), shape }
        };
        let moving = |mode: &Mode| mode.oscillator.frequency.is_finite();
        let modes: Vec<Mode> = found.shapes.into_iter().enumerate().map(mode).filter(moving).collect();
        Some(Self { loads: vec![0.0; modes.len()], modes, largest: 0.0, told: Vec::new() })
    }

    /// Begins with the parts where the slow motion has them.
    pub fn begin(&mut self, system: Forced, K: [f64; 3], pose: &Pose<f64>, point: &SlowPoint) {
        for Mode { oscillator, row, .. } in &mut self.modes {
            (oscillator.value, oscillator.rate) = (product(row, &point.q), product(row, &point.rate));
        }
        self.meet(system, K, pose);
    }

    /// Takes the loads at a state without a lapse of time: at the start, and after a breakpoint. (Z1)
    pub fn meet(&mut self, system: Forced, K: [f64; 3], pose: &Pose<f64>) {
        self.loads = self.loads_at(system, K, pose);
    }

    /// Follows the modes over a step between two states, with the time of each part of it inside its stretch. (E9)
    pub fn follow(
        &mut self,
        system: Forced,
        [from, to]: [([f64; 3], Pose<f64>); 2],
        within: impl Fn(f64) -> f64,
    ) {
        let length = (to.1.t - from.1.t) / PARTS as f64;
        for part in 1..=PARTS {
            let (K, mut pose) = between(&from, &to, part as f64 / PARTS as f64);
            pose.t = within(pose.t);
            let loads = self.loads_at(system, K, &pose);
            for ((mode, before), now) in self.modes.iter_mut().zip(&self.loads).zip(&loads) {
                mode.oscillator.follow(length, [*before, *now]);
            }
            self.loads = loads;
        }
    }

    /// Compares the modes with the slow motion at the state reached. (E8)
    pub fn compare(&mut self, system: Forced, K: [f64; 3], t: f64, point: &SlowPoint) {
        let body = system.body;
        let own = add(K, scale(-1.0, body.wheels().angular_momentum(t)));
        self.largest = self.largest.max(norm(times(inverse(body.invariants().J), own)));
        let mut error = [0.0_f64; 3];
        for Mode { oscillator, row, recoil, .. } in &self.modes {
            let value = oscillator.frequency * (oscillator.value - product(row, &point.q));
            let size = value.hypot(oscillator.rate - product(row, &point.rate));
            error.iter_mut().zip(recoil).for_each(|(error, recoil)| *error += size * recoil.abs());
        }
        let omega = norm(error);
        if !(omega <= Ringing::TOLD * self.largest) && self.largest > 0.0 {
            let now = Ringing { from: t, to: t, omega, share: f64::NAN };
            let decade = self.largest.log10().floor() as i32;
            match self.told.last_mut() {
                Some((last, told)) if *last == decade => *told = told.joined(&now),
                _ => self.told.push((decade, now)),
            }
        }
    }

    /// Error of the angular velocity over the run; none where it is nowhere above the limit. (E8)
    pub fn told(&self) -> Option<Ringing> {
        let least = (NEGLIGIBLE * self.largest).log10().floor() as i32;
        let counts = self.told.iter().filter(|(decade, _)| *decade >= least).map(|(_, told)| *told);
        let sum = counts.reduce(|sum, told| sum.joined(&told))?;
        Some(Ringing { share: sum.omega / self.largest, ..sum })
    }

    /// Load of inertia and of forces on each mode, of the body without displacements. (E3)
    fn loads_at(&self, system: Forced, K: [f64; 3], pose: &Pose<f64>) -> Vec<f64> {
        let body = system.body;
        let J = body.invariants().J;
        let own = add(K, scale(-1.0, body.wheels().angular_momentum(pose.t)));
        let omega = times(inverse(J), own);
        let still = vec![0.0; body.coordinates().len()];
        let motion = MotionState { omega, q: &still, rate: &still };
        let external = system.loads(pose, motion);
        let motors = body.wheels().torque(pose.t);
        let moment = add(external.moment, add(cross(K, omega), scale(-1.0, motors)));
        let turning = times(inverse(J), moment);
        let inertial = body.load(motion);
        let load: Vec<f64> = (0..still.len())
            .map(|j| external.generalized[j] + inertial[j] - dot(body.invariants().h[j], turning))
            .collect();
        self.modes.iter().map(|mode| product(&mode.shape, &load)).collect()
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save(self.largest);
        checkpoint.save_list(&self.loads);
        for Mode { oscillator, .. } in &self.modes {
            [oscillator.value, oscillator.rate].iter().for_each(|number| checkpoint.save(*number));
        }
        checkpoint.save_count(self.told.len() as u64);
        for (decade, Ringing { from, to, omega, .. }) in &self.told {
            [f64::from(*decade), *from, *to, *omega].iter().for_each(|number| checkpoint.save(*number));
        }
    }

    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.largest = checkpoint.load()?;
        checkpoint.load_into(&mut self.loads)?;
        for Mode { oscillator, .. } in &mut self.modes {
            oscillator.value = checkpoint.load()?;
            oscillator.rate = checkpoint.load()?;
        }
        let count = checkpoint.load_count()?;
        let mut told = || {
            let decade: f64 = checkpoint.load()?;
            let [from, to] = [checkpoint.load()?, checkpoint.load()?];
            let omega = checkpoint.load()?;
            Some((decade as i32, Ringing { from, to, omega, share: f64::NAN }))
        };
        self.told = (0..count).map(|_| told()).collect::<Option<_>>()?;
        Some(())
    }
}

fn product(row: &[f64], x: &[f64]) -> f64 {
    row.iter().zip(x).map(|(row, x)| row * x).sum()
}

/// State between two, on the chord.
fn between(
    (K0, from): &([f64; 3], Pose<f64>),
    (K1, to): &([f64; 3], Pose<f64>),
    share: f64,
) -> ([f64; 3], Pose<f64>) {
    fn mixed<const N: usize>(a: [f64; N], b: [f64; N], share: f64) -> [f64; N] {
        std::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
    }
    let attitude = mixed(from.attitude, to.attitude, share);
    let size = attitude.iter().map(|part| part * part).sum::<f64>().sqrt();
    let pose = Pose {
        t: from.t + share * (to.t - from.t),
        attitude: attitude.map(|part| part / size),
        place: mixed(from.place, to.place, share),
        velocity: mixed(from.velocity, to.velocity, share),
    };
    (mixed(*K0, *K1, share), pose)
}
