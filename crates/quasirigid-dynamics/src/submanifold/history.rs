//! Start of a motion on a slow manifold about a spin, and the state of the body along it.

use crate::dynamics::{FullState, Outcome, Sample};
use crate::math::ode::Work;
use crate::math::rotation::{aligned, angle, to_inertial, turned};
use crate::math::submanifold::{Monomials, PolynomialSystem, Ring, Truncated};
use crate::math::vec3::{norm, scale};
use crate::model::ExpandedMotion;

use super::range::Defect;
use super::spin_manifold::SpinManifold;

/// Start of a motion on a slow manifold: coordinates, one of each pair of conjugates, and the attitude.
#[derive(Clone, Debug, PartialEq)]
pub struct ManifoldStart {
    /// Coordinates `z`, real and imaginary part; the first is that of the nutation (rad).
    pub z: Vec<[f64; 2]>,
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place (m), inertial axes: of the centre of mass of a free body, of the fixed point of a constrained one.
    pub place: [f64; 3],
    /// Velocity of that point (m/s).
    pub velocity: [f64; 3],
    /// Share of the internal energy of the start that is off the spin manifold and is left out: its vibrations.
    pub left_out: f64,
}

/// Result of a propagation on a slow manifold.
#[derive(Clone, Debug, PartialEq)]
pub struct ManifoldRun {
    /// Reason of the end.
    pub outcome: Outcome,
    /// Last state.
    pub last: Sample,
    /// Coordinates at the end.
    pub z: Vec<[f64; 2]>,
    /// Mean power (W) of all dissipators over the phases at each output time. (W8)
    pub powers: Vec<f64>,
    /// Defect of the history, with the time (s) of its largest part in the motion: that over the output times that were examined; in the
    /// power the largest change of energy that no dissipator explains, over the energy dissipated.
    pub worst: (Defect, f64),
    /// Work done.
    pub work: Work,
}

/// Limit of iterations for the coordinates of a state, and the change at which they end.
const MAX_ITERATIONS: usize = 60;
const ITERATION_ROUNDING: f64 = 1e-14;
/// Difference of energies, relative to the whole, that is rounding.
const ENERGY_ROUNDING: f64 = 1e-14;

impl SpinManifold<'_> {
    /// Start on the spin manifold of a state of the full system: its slow coordinates, with the angular momentum kept in inertial axes. (W10)
    ///
    /// Fast vibrations of the state are projected out along their directions at the steady spin.
    #[must_use]
    pub fn start(&self, state: &FullState) -> ManifoldStart {
        let momenta = self.momenta(&self.packed(state));
        let mut z = vec![[0.0; 2]; self.manifold.free()];
        for _ in 0..MAX_ITERATIONS {
            let there = self.momenta(&self.manifold.state_at(&z));
            let leads = self.manifold.masters.iter().enumerate().filter(|(k, master)| master.partner >= *k);
            let mut moved = 0.0_f64;
            for (z, (_, master)) in z.iter_mut().zip(leads) {
                let gaps = momenta.iter().zip(&there).map(|(a, b)| a - b);
                let step = master
                    .mode
                    .left
                    .iter()
                    .zip(gaps)
                    .fold([0.0; 2], |sum, ([re, im], gap)| [sum[0] + re * gap, sum[1] + im * gap]);
                (0..2).for_each(|part| z[part] += step[part]);
                moved = moved.max(step[0].hypot(step[1]));
            }
            if !(moved > ITERATION_ROUNDING) {
                break;
            }
        }
        let there = self.full_state(&z, state.attitude);
        let fixed = to_inertial(state.attitude, state.angular_momentum(self.body));
        let attitude = aligned(state.attitude, there.angular_momentum(self.body), fixed);
        let (energy, own) = (state.energy(self.body), there.energy(self.body));
        let internal = own - self.steady_energy();
        let left_out = if (energy - own).abs() <= ENERGY_ROUNDING * energy {
            0.0
        } else {
            ((energy - own) / internal).abs()
        };
        ManifoldStart { z, attitude, place: state.place, velocity: state.velocity, left_out }
    }

    /// Full state at coordinates and an attitude.
    #[must_use]
    pub fn full_state(&self, z: &[[f64; 2]], attitude: [f64; 4]) -> FullState {
        let x = self.manifold.state_at(z);
        let n = self.body.coordinates().len();
        let mut q = x[3 + n..].to_vec();
        q.resize(n, 0.0);
        let rate = x[3..3 + n].to_vec();
        FullState { omega: [x[0], x[1], x[2]], attitude, q, rate, place: [0.0; 3], velocity: [0.0; 3] }
    }

    /// Energy (J) of the steady spin, without that of wheels.
    #[must_use]
    pub fn steady_energy(&self) -> f64 {
        self.full_state(&vec![[0.0; 2]; self.manifold.free()], [1.0, 0.0, 0.0, 0.0]).energy(self.body)
    }

    /// Tilt of the angular momentum from the axis of the steady spin (rad) at coordinates.
    #[must_use]
    pub fn tilt(&self, z: &[[f64; 2]]) -> f64 {
        angle(self.direction(&self.manifold.monomials(z)), self.axis())
    }

    pub(super) fn direction(&self, monomials: &Monomials) -> [f64; 3] {
        let u: [f64; 3] = std::array::from_fn(|i| monomials.value(&self.observables.direction[i])[0]);
        scale(norm(u).recip(), u)
    }

    /// Attitude after the body has turned by an angle about its angular momentum since a base attitude. (W10)
    pub(super) fn attitude(
        &self,
        base: [f64; 4],
        fixed: [f64; 3],
        turned_by: f64,
        monomials: &Monomials,
    ) -> [f64; 4] {
        aligned(turned(base, scale(turned_by, fixed)), self.direction(monomials), fixed)
    }

    fn packed(&self, state: &FullState) -> Vec<f64> {
        let elastic = self.body.elastic();
        state.omega.iter().chain(&state.rate).chain(&state.q[..elastic]).copied().collect()
    }

    fn momenta(&self, x: &[f64]) -> Vec<f64> {
        let point = Ring::new(0, 0);
        let x: Vec<Truncated> = x.iter().map(|x| point.constant(*x)).collect();
        let momenta = ExpandedMotion::of(self.body).equations(&point, &x).momenta;
        momenta.iter().map(|momentum| momentum.coefficient(0)[0]).collect()
    }
}
