//! Eddy currents averaged over a free rotation in a field that turns slowly: the angular momentum falls and turns, the wobble changes.
//! Equations (A14) and (A15), docs/theory/10-torque-free.md.

use crate::averaging::eddy_torque::EddyTorque;
use crate::averaging::poinsot::FreeRotation;
use crate::math::vec3::{add, dot, scale};
use crate::model::Principal;
use crate::model::force::MagneticField;

/// Averaged eddy currents of a body with known principal axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeanEddy {
    /// Diagonal of the magnetic tensor in principal axes (S·m⁴).
    tensor: [f64; 3],
    /// Means of the field, or of that at time zero whose orbit precesses.
    means: Means,
    /// Field whose orbit precesses about as slowly as the angular momentum changes: its means change with time. (F20)
    precessing: Option<MagneticField>,
}

/// Means of a magnetic field over its orbit and the turn of its dipole. (F17), (F19)
#[derive(Clone, Copy, Debug)]
struct Means {
    /// Mean square of the field (T²).
    square: f64,
    /// `N = ⟨B²⟩ − ⟨BBᵀ⟩` (T²), inertial axes.
    across: [[f64; 3]; 3],
    /// `L = ⟨B×Ḃ⟩` (T²/s), inertial axes.
    twist: [f64; 3],
}

/// Ratio of the rates of a precession and of the torque from which the mean is taken over the precession, too; the error is about its
/// inverse.
const FAST: f64 = 1000.0;

impl Means {
    fn of(fields: &[MagneticField]) -> Self {
        let (mut products, mut twist) = ([[0.0; 3]; 3], [0.0; 3]);
        let share = (fields.len() as f64).recip();
        for field in fields {
            let B = field.mean_square();
            let sums = products.iter_mut().flatten().zip(B.iter().flatten());
            sums.for_each(|(sum, entry)| *sum += share * entry);
            twist = add(twist, scale(share, field.mean_twist()));
        }
        let square = products[0][0] + products[1][1] + products[2][2];
        let own = |i: usize, j: usize| if i == j { square } else { 0.0 };
        let across = [0, 1, 2].map(|i| [0, 1, 2].map(|j| own(i, j) - products[i][j]));
        Self { square, across, twist }
    }

    /// The means with the node of the orbit turned by an angle (rad).
    fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let rows = self.across.map(|row| turn.map(|axis| dot(axis, row)));
        let across = turn.map(|axis| [0, 1, 2].map(|j| (0..3).map(|i| axis[i] * rows[i][j]).sum()));
        Self { square: self.square, across, twist: turn.map(|axis| dot(axis, self.twist)) }
    }
}

/// Averaged rates of eddy currents.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EddyRates {
    /// Rate (1/s) of the logarithm of the angular momentum.
    pub growth: f64,
    /// Work (W) on the wobble of a short-axis mode, `⟨M·(ω − K/I)⟩`; of a long-axis mode with the other sign.
    pub work: f64,
    /// Rate (1/s) of the direction of the angular momentum, inertial axes.
    pub turning: [f64; 3],
}

impl MeanEddy {
    pub fn new(torque: &EddyTorque, principal: &Principal) -> Self {
        let (field, tensor) = (torque.field, torque.along(principal.axes));
        let precession = field.slowest_precession();
        if !precession.is_finite() {
            return Self { tensor, means: Means::of(&[field]), precessing: None };
        }
        let fast = precession > FAST * torque.greatest_rate(principal.moments[0]);
        let fields = if fast { field.over_precession() } else { vec![field] };
        Self { tensor, means: Means::of(&fields), precessing: (!fast).then_some(field) }
    }

    /// Rates at a time (s) in a free rotation with its angular momentum along `u`, inertial axes; `axis` is the circled one. (A14), (A15)
    pub fn rates(&self, t: f64, motion: &FreeRotation, axis: usize, u: [f64; 3]) -> EddyRates {
        let Means { square, across, twist } = match self.precessing {
            None => self.means,
            Some(field) if field.turns_with_node() => {
                let rate = field.orbit().map_or(0.0, |orbit| orbit.node_rate);
                self.means.turned(rate * t)
            }
            Some(field) => Means::of(&[field.precessed(t)]),
        };
        let (I, G, M) = (motion.moments(), motion.angular_momentum(), self.tensor);
        let trace: f64 = M.iter().sum();
        let braked = across.map(|row| dot(row, u));
        let across = dot(braked, u);
        let along = (square - across).max(0.0);
        let twisted = dot(twist, u);
        let others = [0, 1, 2].map(|i| trace - M[i]);
        let away = I.map(|moment| 1.0 - moment / I[axis]);
        let quadratic = |weights: [f64; 3]| {
            motion.mean(2, |omega| (0..3).map(|i| weights[i] * omega[i] * omega[i]).sum())
        };
        let m = 0.5 * quadratic([0, 1, 2].map(|i| others[i] * I[i])) / G;
        let parallel = quadratic([0, 1, 2].map(|i| M[i] * I[i] * I[i])) / (G * G);
        let transverse = 0.5 * (trace - parallel);
        let straight = quadratic([0, 1, 2].map(|i| others[i] * away[i]));
        let driven = 0.5 * quadratic([0, 1, 2].map(|i| others[i] * I[i] * away[i])) / G;
        let nodding = motion.mean(4, |omega| {
            let tilt = |i: usize, j: usize| (I[j] - I[i]) / G * omega[i] * omega[j];
            M[0] * tilt(1, 2).powi(2) + M[1] * tilt(2, 0).powi(2) + M[2] * tilt(0, 1).powi(2)
        });
        let aside = |vector: [f64; 3], along: f64| add(vector, scale(-along, u));
        EddyRates {
            growth: (transverse * twisted - m * across) / G,
            work: -nodding * along + 0.5 * across * (nodding - straight) + driven * twisted,
            turning: add(
                scale(-m / G, aside(braked, across)),
                scale(0.5 * (parallel + transverse) / G, aside(twist, twisted)),
            ),
        }
    }
}
