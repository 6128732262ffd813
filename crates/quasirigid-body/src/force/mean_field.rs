//! Means of a magnetic field over an orbit and over the turn of its dipole: its products, its twist, and the rates that must keep apart for
//! them.
//! Equations (F17) and (F19), docs/theory/07-forces.md.

use std::f64::consts::TAU;

use super::field::{dipole_with_rate, turning_dipole};
use super::{EarthField, MagneticField, Orbit, OrbitPoint};
use crate::math::vec3::{add, cross, dot, scale};

/// Points of the mean: in the true anomaly the products are a trigonometric polynomial of degree 8, whose mean 9 points give exactly.
const POINTS: usize = 16;
/// Phases of a dipole that turns, whose products hold its second harmonic.
const PHASES: usize = 4;
/// Places of a node or a periapsis that precesses; of a node under a field that turns with the Earth, whose means turn with it.
const ANGLES: usize = 10;
const NODES_OF_TURNING: usize = 3;
/// Harmonics of the orbit and of the turn of the dipole whose differences are slow where the two are in resonance: the products hold the
/// second harmonic of the dipole, and the fourth of a circular orbit.
const ORBIT_HARMONICS: u32 = 8;
const DIPOLE_HARMONICS: u32 = 2;
/// The same of the main field of the Earth: in a resonance with a higher harmonic of its turn the products change by less than 2e-4.
const EARTH_HARMONICS: u32 = 4;
/// Harmonics of node and periapsis that the products of a dipole hold.
const PRECESSION_HARMONICS: i32 = 4;

impl MagneticField {
    /// Mean `⟨BBᵀ⟩` (T²), inertial axes, over the orbit and over all phases of the dipole. (F17)
    #[must_use]
    pub fn mean_square(&self) -> [[f64; 3]; 3] {
        match self {
            Self::Uniform(field) => outer(*field),
            Self::Dipole { strength: [x, y, z], orbit, .. } if self.rotation() != 0.0 => {
                let across = 0.5 * (x * x + y * y);
                over_orbit([[across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, z * z]], orbit)
            }
            Self::Dipole { strength, orbit, .. } => over_orbit(outer(*strength), orbit),
            Self::Earth { field, orbit } => earth_means(field, orbit).0,
        }
    }

    /// [Mean square](Self::mean_square) and [mean twist](Self::mean_twist) at once. (F17), (F19)
    #[must_use]
    pub fn means(&self) -> ([[f64; 3]; 3], [f64; 3]) {
        match self {
            Self::Earth { field, orbit } => earth_means(field, orbit),
            Self::Uniform(_) | Self::Dipole { .. } => (self.mean_square(), self.mean_twist()),
        }
    }

    /// Mean twist `⟨B×Ḃ⟩` (T²/s), inertial axes, over the orbit and over all phases of the dipole: twice the rate at which the vector of the
    /// field sweeps out an area. (F19)
    #[must_use]
    pub fn mean_twist(&self) -> [f64; 3] {
        let mut sum = [0.0; 3];
        let (strength, orbit) = match *self {
            Self::Uniform(_) => return sum,
            Self::Dipole { strength, orbit, .. } => (strength, orbit),
            Self::Earth { field, orbit } => return earth_means(&field, &orbit).1,
        };
        let rate = self.rotation();
        let phases = if rate == 0.0 { 1 } else { PHASES };
        for phase in 0..phases {
            let dipole = turning_dipole(strength, TAU * phase as f64 / phases as f64, rate);
            for (passage, share) in passages(&orbit, POINTS) {
                let [B, change] = dipole_with_rate(dipole, &passage);
                sum = add(sum, scale(share / phases as f64, cross(B, change)));
            }
        }
        sum
    }

    /// The field with node and periapsis of its orbit where they are at a time (s). (F20)
    #[must_use]
    pub fn precessed(&self, t: f64) -> Self {
        self.orbit().map_or(*self, |orbit| self.on(orbit.precessed(t)))
    }

    /// Slowest rate (rad/s) at which the means change by the precession of the orbit: of the node, of the periapsis of an ellipse, and of the
    /// differences of their harmonics, zero in a resonance of the two; infinite where nothing precesses. (F20)
    #[must_use]
    pub fn slowest_precession(&self) -> f64 {
        let Some(orbit) = self.orbit() else { return f64::INFINITY };
        let periapsis = if orbit.eccentricity == 0.0 { 0.0 } else { orbit.periapsis_rate };
        let most = |rate: f64| if rate == 0.0 { 0 } else { PRECESSION_HARMONICS };
        let (nodes, periapses) = (most(orbit.node_rate), most(periapsis));
        let pairs = (0..=nodes).flat_map(|i| (-periapses..=periapses).map(move |k| (i, k)));
        let beats = pairs
            .filter(|pair| *pair != (0, 0))
            .map(|(i, k)| (f64::from(i) * orbit.node_rate + f64::from(k) * periapsis).abs());
        beats.fold(f64::INFINITY, f64::min)
    }

    /// Whether the means of the field turn with the node, as those of a field that turns about the pole, or is symmetric about it, do. (F20)
    #[must_use]
    pub fn turns_with_node(&self) -> bool {
        match self {
            Self::Dipole { strength: [x, y, _], .. } => self.rotation() != 0.0 || [*x, *y] == [0.0; 2],
            Self::Uniform(_) | Self::Earth { .. } => true,
        }
    }

    /// Fields at even places of the periapsis, from where it is at time zero, of an odd number: their means, joined by a trigonometric
    /// polynomial, are those at any place. One where the periapsis keeps its place, or has none. (F20)
    #[must_use]
    pub fn over_periapsis(&self) -> Vec<Self> {
        let Some(orbit) = self.orbit().filter(|orbit| orbit.periapsis_rate * orbit.eccentricity != 0.0)
        else {
            return vec![*self];
        };
        let places = match self {
            Self::Earth { field, .. } => points_of(field),
            _ => ANGLES + 1,
        };
        let at = |i: usize| TAU * i as f64 / places as f64 + orbit.argument_of_periapsis;
        (0..places).map(|i| self.on(Orbit { argument_of_periapsis: at(i), ..*orbit })).collect()
    }

    /// Fields at even places of node and periapsis, whose means are those over the precession: of a dipole products hold the fourth
    /// harmonic of either angle. (F20)
    #[must_use]
    pub fn over_precession(&self) -> Vec<Self> {
        let Some(orbit) = self.orbit() else { return vec![*self] };
        let places = |rate: f64, count: usize| if rate == 0.0 { 1 } else { count };
        let [most_nodes, most_periapses] = match self {
            Self::Earth { field, .. } => [NODES_OF_TURNING, points_of(field)],
            _ => [ANGLES; 2],
        };
        let (nodes, periapses) =
            (places(orbit.node_rate, most_nodes), places(orbit.periapsis_rate, most_periapses));
        let angle = |i: usize, count: usize| TAU * i as f64 / count as f64;
        let at = |i: usize| Orbit {
            raan: orbit.raan + angle(i % nodes, nodes),
            argument_of_periapsis: orbit.argument_of_periapsis + angle(i / nodes, periapses),
            ..*orbit
        };
        (0..nodes * periapses).map(|i| self.on(at(i))).collect()
    }

    /// The field along another orbit.
    fn on(&self, orbit: Orbit) -> Self {
        match *self {
            Self::Uniform(field) => Self::Uniform(field),
            Self::Dipole { strength, rate, .. } => Self::Dipole { strength, rate, orbit },
            Self::Earth { field, .. } => Self::Earth { field, orbit },
        }
    }

    /// Fastest rate (rad/s) at which the direction from the dipole turns, plus that of the dipole; zero in a uniform field. The average
    /// over a rotation supposes a body that rotates much faster.
    #[must_use]
    pub fn fastest_rate(&self) -> f64 {
        self.orbit().map_or(0.0, |orbit| {
            let nearest = 1.0 - orbit.eccentricity;
            let passing = ((1.0 + orbit.eccentricity) / nearest).sqrt() / nearest;
            orbit.mean_motion() * passing + self.rotation().abs()
        })
    }

    /// Slowest rate (rad/s) that the mean is taken over: of the orbit, of the dipole, and of the differences of their harmonics; infinite
    /// in a uniform field. What the mean drives must change more slowly.
    #[must_use]
    pub fn slowest_rate(&self) -> f64 {
        let Some(orbit) = self.orbit() else { return f64::INFINITY };
        let (n, turn) = (orbit.mean_motion(), self.rotation().abs());
        if turn == 0.0 {
            return n;
        }
        let turns = match self {
            Self::Earth { field, .. } => EARTH_HARMONICS.min(2 * field.degree as u32),
            _ => DIPOLE_HARMONICS,
        };
        let harmonics = (1..=ORBIT_HARMONICS).flat_map(|l| (1..=turns).map(move |k| (l, k)));
        let beats = harmonics.map(|(l, k)| (f64::from(l) * n - f64::from(k) * turn).abs());
        beats.fold(n.min(turn), f64::min)
    }
}

/// Even points in the true anomaly, and turns of the Earth, that give the means of a field of some degree `n` exactly: in the anomaly the
/// weighted products are trigonometric polynomials of degree `4n + 8` at most, in the turn of degree `2n`.
fn points_of(field: &EarthField) -> usize {
    4 * field.degree + 9
}

/// Mean square and mean twist of the main field over all points of an orbit and all turns of the Earth. (F17), (F19)
fn earth_means(field: &EarthField, orbit: &Orbit) -> ([[f64; 3]; 3], [f64; 3]) {
    let turns = 2 * field.degree + 1;
    let (mut square, mut twist) = ([[0.0; 3]; 3], [0.0; 3]);
    for (passage, share) in passages(orbit, points_of(field)) {
        let share = share / turns as f64;
        for turn in 0..turns {
            let [B, change] = field.with_rate(TAU * turn as f64 / turns as f64, &passage);
            let products = outer(B);
            (0..9).for_each(|i| square[i / 3][i % 3] += share * products[i / 3][i % 3]);
            twist = add(twist, scale(share, cross(B, change)));
        }
    }
    (square, twist)
}

/// Points of an orbit, even in the true anomaly, each with its share of the time. Products of the field of a dipole and its rate are
/// trigonometric polynomials of degree 10 there once they are weighted.
fn passages(orbit: &Orbit, points: usize) -> impl Iterator<Item = (OrbitPoint<f64>, f64)> + use<> {
    let e = orbit.eccentricity;
    let p = orbit.semi_major_axis * (1.0 - e) * (1.0 + e);
    let speed = (orbit.mu / p).sqrt();
    let (area, mean_motion) = (speed * p, orbit.mean_motion());
    let [along, across] = orbit.axes();
    let turning = orbit.turning([along, across]);
    let joined = move |x: f64, y: f64| add(scale(x, along), scale(y, across));
    (0..points).map(move |point| {
        let (sin, cos) = (TAU * point as f64 / points as f64).sin_cos();
        let radius = p / (1.0 + e * cos);
        let place = joined(radius * cos, radius * sin);
        let velocity = add(joined(-speed * sin, speed * (e + cos)), cross(turning, place));
        let share = mean_motion * radius * radius / (area * points as f64);
        (OrbitPoint { place, velocity, radius }, share)
    })
}

/// Mean of `G C G/r⁶`, `G = 3nnᵀ − 1`, of a dipole whose products are `C` (T²·m⁶).
fn over_orbit(products: [[f64; 3]; 3], orbit: &Orbit) -> [[f64; 3]; 3] {
    let e = orbit.eccentricity;
    let p = orbit.semi_major_axis * (1.0 - e) * (1.0 + e);
    let [along, across] = orbit.axes();
    let mut sum = [[0.0; 3]; 3];
    for point in 0..POINTS {
        let (sin, cos) = (TAU * point as f64 / POINTS as f64).sin_cos();
        let n: [f64; 3] = std::array::from_fn(|i| cos * along[i] + sin * across[i]);
        let per_radius = (1.0 + e * cos) / p;
        // dt goes with r² dν.
        let weight = per_radius.powi(4) / POINTS as f64;
        let turned = products.map(|row| 3.0 * dot(row, n));
        let twice = 3.0 * dot(turned, n);
        for (i, row) in sum.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let shape = products[i][j] - turned[i] * n[j] - n[i] * turned[j] + twice * n[i] * n[j];
                *entry += weight * shape;
            }
        }
    }
    let a = orbit.semi_major_axis;
    let per_area = 1.0 / (a * a * ((1.0 - e) * (1.0 + e)).sqrt()); // n₀/h
    sum.map(|row| row.map(|entry| entry * per_area))
}

fn outer(v: [f64; 3]) -> [[f64; 3]; 3] {
    v.map(|a| v.map(|b| a * b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::norm;

    const STRENGTH: [f64; 3] = [1.3e15, -0.8e15, 7.6e15];

    fn orbit(eccentricity: f64) -> Orbit {
        Orbit {
            mu: 3.986_004_418e14,
            semi_major_axis: 9.1e6,
            eccentricity,
            inclination: 1.9,
            raan: 0.7,
            argument_of_periapsis: 2.1,
            mean_anomaly: 0.4,
            node_rate: 0.0,
            periapsis_rate: 0.0,
        }
    }

    /// Largest difference from the mean over steps of time and of the phase of the dipole, over the size.
    fn gap(field: impl Fn(f64) -> MagneticField, phases: usize, steps: usize) -> f64 {
        let mut sum = [[0.0; 3]; 3];
        for phase in 0..phases {
            let field = field(TAU * phase as f64 / phases as f64);
            let period = field.orbit().unwrap().period();
            for step in 0..steps {
                let B = field.at(period * step as f64 / steps as f64);
                let products = outer(B);
                for i in 0..9 {
                    sum[i / 3][i % 3] += products[i / 3][i % 3] / (phases * steps) as f64;
                }
            }
        }
        let found = field(0.0).mean_square();
        let differences = (0..9).map(|i| (found[i / 3][i % 3] - sum[i / 3][i % 3]).abs());
        differences.fold(0.0, f64::max) / norm(sum.map(norm))
    }

    /// `⟨B×Ḃ⟩` by differences of the field in time, over phases of the dipole where it turns.
    #[test]
    fn mean_twist_is_that_over_time() {
        let [x, y, z] = STRENGTH;
        for (eccentricity, rate) in [(0.0, 0.0), (0.0137, 3e-4), (0.6, 0.0), (0.3, -7e-4)] {
            let orbit = orbit(eccentricity);
            let phases = if rate == 0.0 { 1 } else { 6 };
            let (mut sum, steps, apart) = ([0.0; 3], 4000, 1e-3);
            for phase in 0..phases {
                let (sin, cos) = (TAU * f64::from(phase) / f64::from(phases)).sin_cos();
                let strength = [cos * x - sin * y, sin * x + cos * y, z];
                for step in 0..steps {
                    let passing = orbit.period() * f64::from(step) / f64::from(steps);
                    let orbit = Orbit { mean_anomaly: orbit.mean_motion() * passing, ..orbit };
                    let field = MagneticField::Dipole { strength, rate, orbit };
                    let [before, after] = [-apart, apart].map(|t| field.at(t));
                    let change = scale(0.5 / apart, add(after, scale(-1.0, before)));
                    let [B, exact] = field.with_rate(0.0);
                    assert!(
                        norm(add(exact, scale(-1.0, change))) < 1e-8 * norm(exact),
                        "{exact:?} {change:?}"
                    );
                    sum = add(sum, scale(1.0 / f64::from(phases * steps), cross(B, change)));
                }
            }
            let found = MagneticField::Dipole { strength: STRENGTH, rate, orbit }.mean_twist();
            let gap = norm(add(found, scale(-1.0, sum))) / norm(found);
            assert!(gap < 1e-8, "{eccentricity} {rate}: {found:?} {sum:?}");
        }
    }

    /// The field of an axial dipole on a circular polar orbit is `b/a³ (3/2 sin 2ν, 0, 1/2 − 3/2 cos 2ν)`, whose mean twist is
    /// `9/2 b²n/a⁶` about the normal of the orbit.
    #[test]
    fn twist_of_a_polar_orbit_has_its_closed_form() {
        let polar = Orbit { inclination: 0.5 * std::f64::consts::PI, raan: 0.0, ..orbit(0.0) };
        let field = MagneticField::Dipole { strength: [0.0, 0.0, 7.6e15], rate: 0.0, orbit: polar };
        let unit = (7.6e15 / 9.1e6f64.powi(3)).powi(2) * polar.mean_motion();
        let [x, y, z] = field.mean_twist().map(|part| part / unit);
        assert!(x.abs() < 1e-14 && (y + 4.5).abs() < 1e-13 && z.abs() < 1e-14, "{x} {y} {z}");
        assert_eq!(MagneticField::Uniform([1.0; 3]).mean_twist(), [0.0; 3]);
    }

    #[test]
    fn mean_over_an_orbit_is_that_over_time() {
        for eccentricity in [0.0, 0.0137, 0.3, 0.7] {
            let gap = gap(
                |_| MagneticField::Dipole { strength: STRENGTH, rate: 0.0, orbit: orbit(eccentricity) },
                1,
                4000,
            );
            assert!(gap < 1e-12, "{eccentricity}: {gap}");
        }
    }

    /// A dipole at a standstill in each of its phases is a dipole that turns.
    #[test]
    fn mean_over_the_turn_of_a_dipole_is_that_over_its_phases() {
        let [x, y, z] = STRENGTH;
        let turned = |phase: f64| {
            let (sin, cos) = phase.sin_cos();
            let strength = [cos * x - sin * y, sin * x + cos * y, z];
            MagneticField::Dipole { strength, rate: 1e-300, orbit: orbit(0.2) }
        };
        let gap = gap(turned, 8, 2000);
        assert!(gap < 1e-12, "{gap}");
    }

    /// `⟨B²⟩ = (b/a³)² (1 + 3/2 sin² i)` of a dipole along the axis over a circular orbit; on an eccentric one times
    /// `(1 + 3e² + 3e⁴/8)/(1−e²)^{9/2}` over the equator.
    #[test]
    fn mean_squares_have_their_closed_forms() {
        let trace =
            |field: MagneticField| field.mean_square().iter().enumerate().map(|(i, row)| row[i]).sum::<f64>();
        let near =
            |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-14, "{found:e} {known:e}");
        let axial = |orbit| MagneticField::Dipole { strength: [0.0, 0.0, 7.6e15], rate: 0.0, orbit };
        let inner = (7.6e15 / 9.1e6f64.powi(3)).powi(2);
        near(trace(axial(orbit(0.0))), inner * (1.0 + 1.5 * 1.9f64.sin().powi(2)));
        let e: f64 = 0.4;
        let level = Orbit { inclination: 0.0, ..orbit(e) };
        let grown = (1.0 + 3.0 * e.powi(2) + 0.375 * e.powi(4)) / (1.0 - e * e).powf(4.5);
        near(trace(axial(level)), inner * grown);
    }

    /// Ten places of node and periapsis have the mean that finer ones have, and products at a time are those of the orbit there.
    #[test]
    fn means_over_the_precession_are_exact_at_ten_places() {
        let own = Orbit { node_rate: -1e-6, periapsis_rate: 6e-6, ..orbit(0.4) };
        for rate in [0.0, 7e-5] {
            let field = |orbit| MagneticField::Dipole { strength: STRENGTH, rate, orbit };
            let (places, fine) = (field(own).over_precession(), 23);
            let mut gap = [[0.0; 3]; 3];
            let mut size = 0.0;
            for other in &places {
                let B = other.mean_square();
                (0..9).for_each(|i| gap[i / 3][i % 3] += B[i / 3][i % 3] / places.len() as f64);
            }
            for step in 0..fine * fine {
                let [node, periapsis] = [step % fine, step / fine].map(|i| TAU * i as f64 / fine as f64);
                let orbit = Orbit { raan: node, argument_of_periapsis: periapsis, ..own };
                let B = field(orbit).mean_square();
                (0..9).for_each(|i| gap[i / 3][i % 3] -= B[i / 3][i % 3] / (fine * fine) as f64);
                size += (B[0][0] + B[1][1] + B[2][2]) / (fine * fine) as f64;
            }
            assert!(places.len() == 100 && norm(gap.map(norm)) < 1e-13 * size, "{gap:?}");
        }
        let later = field_at(own, 5e5);
        assert_eq!(later.orbit().map(|orbit| orbit.raan), Some(own.raan - 0.5));
        assert_eq!(later.slowest_precession(), 1e-6);
        let slowest = |orbit| field_at(orbit, 0.0).slowest_precession();
        let resonant = Orbit { periapsis_rate: 2e-6, ..own };
        assert_eq!(slowest(resonant), 0.0);
        assert_eq!(slowest(Orbit { eccentricity: 0.0, ..resonant }), 1e-6);
        assert_eq!(slowest(Orbit { node_rate: 0.0, ..own }), 6e-6);
        assert_eq!(slowest(orbit(0.4)), f64::INFINITY);
    }

    fn field_at(orbit: Orbit, t: f64) -> MagneticField {
        MagneticField::Dipole { strength: STRENGTH, rate: 0.0, orbit }.precessed(t)
    }

    /// The main field of degree one is a tilted dipole that turns with the Earth: field, rate and means.
    #[test]
    fn main_field_of_degree_one_is_the_tilted_dipole() {
        let earth = EarthField { year: 2021.3, degree: 1, sidereal: 0.8 };
        let b = earth_dipole(earth.year, earth.sidereal);
        let own = Orbit { node_rate: 1e-6, ..orbit(0.3) };
        let one = MagneticField::Earth { field: earth, orbit: own };
        let other = MagneticField::Dipole { strength: b, rate: EarthField::RATE, orbit: own };
        for t in [0.0, 1234.5, 8e4] {
            let ([B, change], [B1, change1]) = (one.with_rate(t), other.with_rate(t));
            assert!(norm(add(B, scale(-1.0, B1))) < 1e-13 * norm(B), "{B:?} {B1:?}");
            assert!(norm(add(change, scale(-1.0, change1))) < 1e-12 * norm(change), "{change:?} {change1:?}");
        }
        let (square, square1) = (one.mean_square(), other.mean_square());
        let size = norm(square.map(norm));
        (0..9).for_each(|i| assert!((square[i / 3][i % 3] - square1[i / 3][i % 3]).abs() < 1e-13 * size));
        let (twist, twist1) = (one.mean_twist(), other.mean_twist());
        assert!(norm(add(twist, scale(-1.0, twist1))) < 1e-12 * norm(twist), "{twist:?} {twist1:?}");
    }

    /// Strength (T·m³) of the dipole with the coefficients of degree one, from the table of the file, at a right ascension of Greenwich.
    fn earth_dipole(year: f64, sidereal: f64) -> [f64; 3] {
        let row = |n: &str, m: &str| -> f64 {
            let text = include_str!("igrf/coefficients.csv");
            let line = text.lines().find(|line| line.starts_with(&format!("{n},{m},"))).unwrap();
            let values: Vec<f64> = line.split(',').skip(2).map(|cell| cell.parse().unwrap()).collect();
            let along = (year - 1900.0) / 5.0;
            let k = along as usize;
            (values[k] + (along - k as f64) * (values[k + 1] - values[k])) * 1e-9 * 6.3712e6f64.powi(3)
        };
        let (g10, g11, h11) = (row("1", "0"), row("1", "1"), row("1", "-1"));
        let (sin, cos) = sidereal.sin_cos();
        [cos * g11 - sin * h11, sin * g11 + cos * h11, g10]
    }

    /// The means of the main field over all turns of the Earth are exact at the points taken: twice as many, and other ones, change nothing.
    #[test]
    fn means_of_the_main_field_have_converged() {
        for (degree, eccentricity) in [(13, 0.0), (13, 0.1), (6, 0.6)] {
            let field = EarthField { year: 2024.0, degree, sidereal: 0.3 };
            let own = Orbit { semi_major_axis: 6.9e6 / (1.0 - eccentricity), ..orbit(eccentricity) };
            let found = MagneticField::Earth { field, orbit: own };
            let (mut square, mut twist) = ([[0.0; 3]; 3], [0.0; 3]);
            let turns = 37;
            for (passage, share) in passages(&own, 131) {
                for turn in 0..turns {
                    let turn = 0.1 + TAU * f64::from(turn) / f64::from(turns);
                    let [B, change] = field.with_rate(turn, &passage);
                    let (share, products) = (share / f64::from(turns), outer(B));
                    (0..9).for_each(|i| square[i / 3][i % 3] += share * products[i / 3][i % 3]);
                    twist = add(twist, scale(share, cross(B, change)));
                }
            }
            let own = found.mean_square();
            let size = norm(own.map(norm));
            let gap = (0..9).map(|i| (own[i / 3][i % 3] - square[i / 3][i % 3]).abs()).fold(0.0, f64::max);
            assert!(gap < 1e-13 * size, "{degree} {eccentricity}: {gap:e} {size:e}");
            let apart = norm(add(found.mean_twist(), scale(-1.0, twist))) / norm(twist);
            assert!(apart < 1e-12, "{degree} {eccentricity}: {apart:e}");
        }
    }

    /// A dipole that turns with the orbit, or at half or twice its rate, is in resonance; the Earth's under a low orbit is not.
    #[test]
    fn resonances_are_slow() {
        let n = orbit(0.0).mean_motion();
        let slowest =
            |rate| MagneticField::Dipole { strength: STRENGTH, rate, orbit: orbit(0.0) }.slowest_rate();
        for rate in [n, 0.5 * n, 2.0 * n, -1.5 * n] {
            assert!(slowest(rate) < 1e-12 * n, "{rate}");
        }
        assert!((slowest(0.09 * n) / (0.09 * n) - 1.0).abs() < 1e-12);
        assert_eq!(MagneticField::Uniform([1.0; 3]).slowest_rate(), f64::INFINITY);
    }

    /// On an orbit of a third of a day the sectoral quadrupole of the Earth is in resonance with its tilted dipole, which is not alone.
    #[test]
    fn finer_fields_have_more_resonances() {
        let n = 3.0 * EarthField::RATE;
        let own = Orbit { semi_major_axis: (3.986_004_418e14 / (n * n)).cbrt(), ..orbit(0.0) };
        let slowest = |degree| {
            let field = EarthField { year: 2024.0, degree, sidereal: 0.3 };
            MagneticField::Earth { field, orbit: own }.slowest_rate() / n
        };
        assert!((slowest(1) - 1.0 / 3.0).abs() < 1e-9 && slowest(2) < 1e-9 && slowest(13) < 1e-9);
        let mean_over_days = |degree: usize| {
            let field = EarthField { year: 2024.0, degree, sidereal: 0.3 };
            let along = MagneticField::Earth { field, orbit: own };
            let (mut sum, steps) = ([[0.0; 3]; 3], 2000);
            for step in 0..steps {
                let products = outer(along.at(TAU / EarthField::RATE * f64::from(step) / f64::from(steps)));
                (0..9).for_each(|i| sum[i / 3][i % 3] += products[i / 3][i % 3] / f64::from(steps));
            }
            let found = along.mean_square();
            let gap = (0..9).map(|i| (found[i / 3][i % 3] - sum[i / 3][i % 3]).abs()).fold(0.0, f64::max);
            gap / norm(sum.map(norm))
        };
        // the mean over all turns misses what the resonance keeps
        assert!(mean_over_days(1) < 1e-12 && mean_over_days(2) > 1e-3, "{}", mean_over_days(2));
    }
}
