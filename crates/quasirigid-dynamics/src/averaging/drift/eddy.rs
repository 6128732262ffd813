//! Eddy currents averaged over a free rotation in a field that turns slowly: the angular momentum falls and turns, the wobble changes.
//! Equations (A14) and (A15), docs/theory/10-torque-free.md.

use std::f64::consts::{PI, TAU};

use crate::averaging::eddy_torque::EddyTorque;
use crate::averaging::poinsot::FreeRotation;
use crate::math::vec3::{add, dot, scale};
use crate::model::Principal;
use crate::model::force::MagneticField;

/// Averaged eddy currents of a body with known principal axes.
#[derive(Clone, Debug)]
pub(super) struct MeanEddy {
    /// Diagonal of the magnetic tensor in principal axes (S·m⁴).
    tensor: [f64; 3],
    means: MeansInTime,
}

/// Means of a field in the course of the precession of its orbit. (F20)
#[derive(Clone, Debug)]
enum MeansInTime {
    /// The same at all times: nothing precesses, or so fast that the means are those over the precession, too.
    Constant(Means),
    /// Of a field that turns about the pole, or is symmetric about it: at even places of the periapsis, and turned with the node.
    Turned { node_rate: f64, periapsis_rate: f64, places: Vec<Means> },
    /// Of any other field: computed anew.
    Anew(MagneticField),
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
            let (square, turned) = field.means();
            let sums = products.iter_mut().flatten().zip(square.iter().flatten());
            sums.for_each(|(sum, entry)| *sum += share * entry);
            twist = add(twist, scale(share, turned));
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

    /// Means at an angle (rad) from the first of an odd number of even places, by the trigonometric polynomial through them.
    fn between(places: &[Self], angle: f64) -> Self {
        let count = places.len() as f64;
        let mut sum = Self { square: 0.0, across: [[0.0; 3]; 3], twist: [0.0; 3] };
        for (i, place) in places.iter().enumerate() {
            let away = 0.5 * (angle - TAU * i as f64 / count);
            let away = away - PI * (away / PI).round(); // near a multiple of π the quotient below has no digits
            let share = if away.sin() == 0.0 { 1.0 } else { (count * away).sin() / (count * away.sin()) };
            sum.square += share * place.square;
            sum.across = [0, 1, 2].map(|i| add(sum.across[i], scale(share, place.across[i])));
            sum.twist = add(sum.twist, scale(share, place.twist));
        }
        sum
    }
}

impl MeansInTime {
    /// Means of the field of a torque, for a body with this least moment of inertia (kg·m²).
    fn of(torque: &EddyTorque, least_moment: f64) -> Self {
        let field = torque.field;
        let precession = field.slowest_precession();
        if !precession.is_finite() {
            return Self::Constant(Means::of(&[field]));
        }
        if precession > FAST * torque.greatest_rate(least_moment) {
            return Self::Constant(Means::of(&field.over_precession()));
        }
        match field.orbit().filter(|_| field.turns_with_node()) {
            Some(orbit) => Self::Turned {
                node_rate: orbit.node_rate,
                periapsis_rate: orbit.periapsis_rate,
                places: field.over_periapsis().iter().map(|place| Means::of(&[*place])).collect(),
            },
            None => Self::Anew(field),
        }
    }

    /// Means at a time (s).
    fn at(&self, t: f64) -> Means {
        match self {
            Self::Constant(means) => *means,
            Self::Turned { node_rate, periapsis_rate, places } => {
                Means::between(places, periapsis_rate * t).turned(node_rate * t)
            }
            Self::Anew(field) => Means::of(&[field.precessed(t)]),
        }
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
        let means = MeansInTime::of(torque, principal.moments[0]);
        Self { tensor: torque.along(principal.axes), means }
    }

    /// Rates at a time (s) in a free rotation with its angular momentum along `u`, inertial axes; `axis` is the circled one. (A14), (A15)
    pub fn rates(&self, t: f64, motion: &FreeRotation, axis: usize, u: [f64; 3]) -> EddyRates {
        let Means { square, across, twist } = self.means.at(t);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::norm;
    use crate::model::force::{EarthField, Orbit};

    /// Means that turn with the node, and lie between those at places of the periapsis, are those of the orbit where it is.
    #[test]
    fn means_in_the_course_of_a_precession_are_those_computed_anew() {
        let orbit = Orbit {
            mu: Orbit::EARTH_PARAMETER,
            semi_major_axis: 9.1e6,
            eccentricity: 0.2,
            inclination: 1.1,
            raan: 0.4,
            argument_of_periapsis: 0.8,
            mean_anomaly: 0.3,
            node_rate: -1.3e-6,
            periapsis_rate: 2.1e-6,
        };
        let strength = [1.2e15, -0.7e15, -7.6e15];
        let [axial, turning] = [([0.0, 0.0, strength[2]], 0.0), (strength, 7e-5)]
            .map(|(strength, rate)| MagneticField::Dipole { strength, rate, orbit });
        let level = Orbit { eccentricity: 0.0, ..orbit };
        let earth = |degree, orbit| {
            let field = EarthField { year: 2024.0, degree, sidereal: 0.3 };
            MagneticField::Earth { field, orbit }
        };
        for field in [axial, turning, earth(3, orbit), earth(5, level)] {
            let torque = EddyTorque { tensor: [[1e3, 0.0, 0.0], [0.0, 1e3, 0.0], [0.0, 0.0, 1e3]], field };
            let means = MeansInTime::of(&torque, 1.0);
            assert!(matches!(means, MeansInTime::Turned { .. }));
            let places = TAU / 2.1e-6 / 11.0;
            for t in [0.0, 1.0, 3e5, 1.7e6, places, 4.0 * places, 11.0 * places] {
                let [found, anew] = [means.at(t), Means::of(&[field.precessed(t)])];
                let size = norm(anew.across.map(norm));
                for i in 0..3 {
                    let gap = add(found.across[i], scale(-1.0, anew.across[i]));
                    assert!(norm(gap) < 1e-12 * size, "{t}: {found:?} {anew:?}");
                }
                let gap = add(found.twist, scale(-1.0, anew.twist));
                assert!(norm(gap) < 1e-11 * norm(anew.twist), "{t}: {found:?} {anew:?}");
                assert!((found.square / anew.square - 1.0).abs() < 1e-12);
            }
        }
    }

    /// A fast precession is averaged over, unless node and periapsis are in resonance; a tilted dipole that keeps its place is computed anew.
    #[test]
    fn a_resonance_of_node_and_periapsis_is_followed() {
        let kind = |[node_rate, periapsis_rate]: [f64; 2], eccentricity, tensor: f64, strength| {
            let orbit = Orbit {
                mu: Orbit::EARTH_PARAMETER,
                semi_major_axis: 9.1e6,
                eccentricity,
                inclination: 1.1,
                raan: 0.4,
                argument_of_periapsis: 0.8,
                mean_anomaly: 0.3,
                node_rate,
                periapsis_rate,
            };
            let field = MagneticField::Dipole { strength, rate: 0.0, orbit };
            let torque = EddyTorque { tensor: [[tensor, 0.0, 0.0]; 3], field };
            match MeansInTime::of(&torque, 1.0) {
                MeansInTime::Constant(_) => "constant",
                MeansInTime::Turned { .. } => "turned",
                MeansInTime::Anew(_) => "anew",
            }
        };
        let (axial, tilted) = ([0.0, 0.0, 7.6e15], [2e15, 0.0, 7.6e15]);
        assert_eq!(kind([-1e-6, 3.7e-6], 0.2, 1e-6, axial), "constant");
        assert_eq!(kind([-1e-6, 2e-6], 0.2, 1e-6, axial), "turned");
        assert_eq!(kind([-1e-6, 2e-6], 0.0, 1e-6, axial), "constant");
        assert_eq!(kind([-1e-6, 3.7e-6], 0.2, 1e3, axial), "turned");
        assert_eq!(kind([-1e-6, 3.7e-6], 0.2, 1e3, tilted), "anew");
        assert_eq!(kind([0.0; 2], 0.2, 1e3, tilted), "constant");
    }
}
