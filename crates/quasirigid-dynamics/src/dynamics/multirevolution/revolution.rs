//! Revolution of the nutation: the motion from one passage of the section to the next, with the azimuth about the steady spin for the
//! independent variable, so that it ends on the section exactly.
//! The change of the energy is integrated by itself and gives that of the angle; as a difference of two energies it would be rounding.
//! Equation (P10), docs/theory/05-propagation.md; the change of variable `[@henon1982]`.

use std::cell::Cell;
use std::f64::consts::TAU;
use std::marker::PhantomData;

use super::section::Section;
use crate::dynamics::form::{self, AngularMomentumForm, Equations};
use crate::math::ode::{Dop853, Solver, System, Work};
use crate::math::rotation::{self, ALIGNED, Attitude};
use crate::math::simd::{Arithmetic, Task};
use crate::math::vec3::{dot, norm, scale};

/// Equations of the motion in the axes of a section or of the body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<'a, A> {
    pub equations: &'a AngularMomentumForm,
    pub work: &'a Cell<Work>,
    pub arithmetic: PhantomData<A>,
}

/// What a stretch of the motion adds up.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    /// Time (s).
    pub time: f64,
    /// Energy taken by the dashpots (J).
    pub dissipated: f64,
    /// Change of energy along the field (J).
    pub energy_change: f64,
    /// Angle turned, `∫|ω| dt`, and that about the angular momentum (rad).
    pub angle: f64,
    pub about: f64,
}

/// End of a stretch that began with the attitude [`ALIGNED`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage {
    pub K: [f64; 3],
    pub attitude: Attitude,
    pub sums: Sums,
}

/// Change over a revolution. (P10)
#[derive(Clone, Copy, Debug)]
pub(super) struct Revolution {
    /// Change of the logarithm of the angle `ψ`.
    pub growth: f64,
    /// Rotation about the angular momentum (rad), known but for whole turns.
    pub precession: f64,
    pub sums: Sums,
}

/// Numbers of [`Revolution::changes`].
pub(super) const ROWS: usize = 6;

impl Revolution {
    /// Changes of `ln ψ` and the time (s), precession (rad), energy taken and energy changed (J), angle turned (rad).
    pub fn changes(&self) -> [f64; ROWS] {
        let Sums { time, dissipated, energy_change, angle, .. } = self.sums;
        [self.growth, time, self.precession, dissipated, energy_change, angle]
    }
}

/// Error allowed per step, relative to the size of the circuit.
const TOLERANCE: f64 = 1e-15;
/// Limit of the steps of a revolution.
const STEPS: usize = 4_000;
/// Newton steps for the change of the angle.
const NEWTON_STEPS: usize = 4;
/// Places and weights of Gauss' rule on the unit interval, exact to degree 5.
pub(super) const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 0.277_777_777_777_777_8),
    (0.5, 0.444_444_444_444_444_4),
    (0.887_298_334_620_741_7, 0.277_777_777_777_777_8),
];

impl<A: Arithmetic> Motion<'_, A> {
    /// The motion from an angular momentum to the azimuth of a full turn; none if it does not circle the axis. `at` receives the time since the
    /// start and the angular momentum after each step.
    pub fn end_on_section(
        &self,
        section: &Section,
        K: [f64; 3],
        azimuth: f64,
        at: impl FnMut(f64, [f64; 3]),
    ) -> Option<Passage> {
        A::call(Stretch { motion: self, section, K, azimuth, at })
    }

    /// Counts revolutions passed in a leap.
    pub fn add_leaped(&self, revolutions: u64) {
        self.work.set(self.work.get() + Work { leaped: revolutions, ..Work::default() });
    }

    /// The change over a revolution from an angle `ψ` (rad); none where the motion does not come back to the section. `at` as in
    /// [`end_on_section`](Self::end_on_section). (P10)
    pub fn revolution(
        &self,
        section: &Section,
        psi: f64,
        at: impl FnMut(f64, [f64; 3]),
    ) -> Option<Revolution> {
        let K = section.at(psi);
        let Passage { K: after, attitude, sums } = self.end_on_section(section, K, 0.0, at)?;
        let growth = (self.nutation_of(section, psi, sums.energy_change)? / psi).ln_1p();
        let still = Section::moved(ALIGNED, psi, Section::angle(after));
        let [s, vector @ ..] = rotation::between(still, attitude);
        let precession = 2.0 * dot(vector, scale(section.G.recip(), K)).atan2(s);
        Some(Revolution { growth, precession, sums })
    }

    /// Change of the angle in the half-plane that changes the energy by so much. (P10)
    fn nutation_of(&self, section: &Section, psi: f64, energy_change: f64) -> Option<f64> {
        let slope = |psi: f64| dot(self.equations.slope(section.at(psi)), section.slope(psi));
        let mut change = energy_change / slope(psi);
        for _ in 0..NEWTON_STEPS {
            let gained: f64 = GAUSS.iter().map(|(x, weight)| weight * slope(psi + x * change)).sum();
            change += (energy_change - gained * change) / slope(psi + change);
        }
        change.is_finite().then_some(change)
    }
}

/// Stretch of the motion to the azimuth of a full turn.
struct Stretch<'a, A, F> {
    motion: &'a Motion<'a, A>,
    section: &'a Section,
    K: [f64; 3],
    azimuth: f64,
    at: F,
}

impl<A: Arithmetic, F: FnMut(f64, [f64; 3])> Task for Stretch<'_, A, F> {
    type Output = Option<Passage>;

    #[inline(always)]
    fn run<R: Arithmetic>(self) -> Option<Passage> {
        let Self { motion, section, K, azimuth, mut at } = self;
        let circuit = K[0].hypot(K[1]);
        let error = (TOLERANCE * circuit).max(0.1 * f64::EPSILON * section.G);
        let (turn, free) = (TOLERANCE, f64::INFINITY);
        let allowed = [error, error, error, turn, turn, turn, turn, free, free, free, free, free];
        let ([x, y, z], [s, i, j, k]) = (K, ALIGNED);
        let start = [x, y, z, s, i, j, k, 0.0, 0.0, 0.0, 0.0, 0.0];
        let mut solver = Dop853::<_, _, R>::new(Round { motion: *motion, section }, azimuth, start, allowed);
        for _ in 0..STEPS {
            let [x, y, z, s, i, j, k, time, dissipated, energy_change, angle, about] = *solver.y();
            at(time, [x, y, z]);
            if solver.t() >= TAU {
                motion.work.set(motion.work.get() + solver.work());
                let sums = Sums { time, dissipated, energy_change, angle, about };
                return Some(Passage { K: [x, y, z], attitude: [s, i, j, k], sums });
            }
            solver.step(TAU).ok()?;
        }
        None
    }
}

/// Motion with the azimuth for the independent variable.
struct Round<'a, A> {
    motion: Motion<'a, A>,
    section: &'a Section,
}

impl<A: Arithmetic> System<[f64; 12]> for Round<'_, A> {
    #[inline(always)]
    fn rate<R: Arithmetic>(&mut self, _: f64, y: &[f64; 12], rate: &mut [f64; 12]) {
        let Motion { equations, .. } = self.motion;
        let (K, attitude) = ([y[0], y[1], y[2]], [y[3], y[4], y[5], y[6]]);
        let form::Motion { omega, rate: moved, power, energy_rate } = equations.motion::<R>(K);
        let azimuth = self.section.azimuth_rate(K, moved);
        let pace = if azimuth > 0.0 { azimuth.recip() } else { f64::NAN };
        let [x, y, z] = moved;
        let [s, i, j, k] = rotation::rate(attitude, omega);
        let about = dot(omega, K) / self.section.G;
        *rate = [x, y, z, s, i, j, k, 1.0, power, energy_rate, norm(omega), about].map(|r| pace * r);
    }
}
