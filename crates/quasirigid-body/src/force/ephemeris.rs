//! Places of a body at given times, joined smoothly: an orbit that another program computed.
//! Each interval has the polynomial of fifth degree with place, velocity and acceleration of its two rows, which are those of the
//! polynomial through the rows about it.
//! Equation (F26), docs/theory/07-forces.md.

use thiserror::Error;

use super::OrbitPoint;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, dot, norm, scale};

/// Places of a body from a centre of attraction, the origin of the inertial axes, at ascending times. (F26)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Ephemeris {
    mu: f64,
    times: Vec<f64>,
    /// Place (m), velocity (m/s) and acceleration (m/s²) at each time.
    rows: Vec<[[f64; 3]; 3]>,
    error: f64,
}

/// Problem of a table of places.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum EphemerisProblem {
    /// Too few rows for polynomials, and for others without every second row.
    #[error("it has {rows} rows, and {} or more are needed", Ephemeris::FEWEST)]
    Few {
        /// Number of rows.
        rows: usize,
    },
    /// A number is not finite, or the place is the centre itself.
    #[error("row {index} has no finite place apart from the centre")]
    NoPlace {
        /// Number of the row, from 1.
        index: usize,
    },
    /// Times do not ascend.
    #[error("row {index} is at {t} s, which is not after {before} s in the row before")]
    Unsorted {
        /// Number of the row, from 1.
        index: usize,
        /// Time (s).
        t: f64,
        /// Time of the row before (s).
        before: f64,
    },
    /// The rows are too far apart to be joined.
    #[error(
        "the rows are too far apart: joined through every second row they miss the others by up to {:.3} % of the distance",
        100.0 * missed
    )]
    Coarse {
        /// Greatest miss of a row left out, relative to its distance.
        missed: f64,
    },
}

/// Rows of the polynomial that gives velocity and acceleration of a row.
const ABOUT: usize = 7;
/// Greatest miss of rows left out, relative to their distance.
const MOST_MISSED: f64 = 0.05;
/// Share of an interval beyond the rows that is rounding.
const BEYOND: f64 = 1e-9;
/// Ratio of the error through every second row to that through all of them, at the least order of the polynomials.
const HALVED: f64 = 16.0;

impl Ephemeris {
    /// Fewest rows.
    pub const FEWEST: usize = 8;

    /// From the gravitational parameter of the centre (m³/s²) and rows of time (s) and place (m, inertial axes).
    ///
    /// # Errors
    /// [`EphemerisProblem`] for rows that are too few, out of order, too far apart, or no places.
    pub fn new(mu: f64, rows: &[(f64, [f64; 3])]) -> Result<Self, EphemerisProblem> {
        if rows.len() < Self::FEWEST {
            return Err(EphemerisProblem::Few { rows: rows.len() });
        }
        let lies =
            |(t, place): &(f64, [f64; 3])| t.is_finite() && norm(*place).is_finite() && norm(*place) > 0.0;
        if let Some(index) = rows.iter().position(|row| !lies(row)) {
            return Err(EphemerisProblem::NoPlace { index: index + 1 });
        }
        if let Some(index) = rows.windows(2).position(|pair| !(pair[1].0 > pair[0].0)) {
            let (t, before) = (rows[index + 1].0, rows[index].0);
            return Err(EphemerisProblem::Unsorted { index: index + 2, t, before });
        }
        let second: Vec<_> = rows.iter().copied().step_by(2).collect();
        let coarse = Self::joined(mu, &second);
        let left_out = rows.iter().skip(1).step_by(2).filter(|(t, _)| *t < coarse.span()[1]);
        let missed = left_out.map(|(t, place)| {
            let found: OrbitPoint<f64> = coarse.at(*t);
            norm(add(found.place, scale(-1.0, *place))) / norm(*place)
        });
        let missed = missed.fold(0.0, f64::max);
        if !(missed <= MOST_MISSED) {
            return Err(EphemerisProblem::Coarse { missed });
        }
        Ok(Self { error: missed / HALVED, ..Self::joined(mu, rows) })
    }

    /// Rows with velocities and accelerations, without an estimate of the error.
    fn joined(mu: f64, rows: &[(f64, [f64; 3])]) -> Self {
        let times = rows.iter().map(|(t, _)| *t).collect();
        let about = ABOUT.min(rows.len());
        let row = |index: usize| {
            let first = index.saturating_sub(about / 2).min(rows.len() - about);
            let [velocity, acceleration] = slopes(&rows[first..first + about], rows[index].0);
            [rows[index].1, velocity, acceleration]
        };
        Self { mu, times, rows: (0..rows.len()).map(row).collect(), error: 0.0 }
    }

    /// Gravitational parameter of the centre (m³/s²).
    #[must_use]
    pub fn mu(&self) -> f64 {
        self.mu
    }

    /// Times of the rows (s).
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// First and last time (s).
    #[must_use]
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// Estimated greatest error of the places between the rows, relative to the distance. (F26)
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Distance (m) of the row nearest to the centre, and its acceleration over that of the attraction alone.
    #[must_use]
    pub fn nearest(&self) -> (f64, f64) {
        let near = |row: &&[[f64; 3]; 3]| norm(row[0]);
        let nearest = self.rows.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
        nearest.map_or((f64::INFINITY, 1.0), |[place, _, acceleration]| {
            let r = norm(*place);
            (r, -dot(*acceleration, *place) * r / self.mu)
        })
    }

    /// Place and velocity at a time (s), which may be a series: those of the interval that its value lies in, not a number before the first
    /// row and after the last. (F26)
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> OrbitPoint<T> {
        let after = self.times.partition_point(|time| *time <= t.value()).clamp(1, self.times.len() - 1);
        let (from, to) = (self.times[after - 1], self.times[after]);
        let h = to - from;
        let beyond = (from - t.value()).max(t.value() - to) > BEYOND * h;
        let h = if beyond { f64::NAN } else { h };
        let x = (t - T::from(from)) * T::from(1.0 / h);
        let polynomial = |axis: usize| {
            let [[p, v, a], [p1, v1, a1]] =
                [after - 1, after].map(|row| self.rows[row].map(|part| part[axis]));
            let (v, v1, a, a1) = (h * v, h * v1, h * h * a, h * h * a1);
            let gap = p1 - p - v - 0.5 * a;
            let slope = v1 - v - a;
            let bend = a1 - a;
            let c = [
                p,
                v,
                0.5 * a,
                10.0 * gap - 4.0 * slope + 0.5 * bend,
                -15.0 * gap + 7.0 * slope - bend,
                6.0 * gap - 3.0 * slope + 0.5 * bend,
            ];
            let place = c.iter().rev().fold(T::from(0.0), |sum, part| sum * x + T::from(*part));
            let rate = (1..6).rev().fold(T::from(0.0), |sum, k| sum * x + T::from(k as f64 * c[k]));
            [place, rate * T::from(1.0 / h)]
        };
        let [x, y, z] = [0, 1, 2].map(polynomial);
        let place = [x[0], y[0], z[0]];
        OrbitPoint { place, velocity: [x[1], y[1], z[1]], radius: dot(place, place).sqrt() }
    }
}

/// First and second derivative at a time of the polynomial through rows, by Lagrange's form in the time from there.
fn slopes(rows: &[(f64, [f64; 3])], t: f64) -> [[f64; 3]; 2] {
    let unit = rows[rows.len() - 1].0 - rows[0].0;
    let mut found = [[0.0; 3]; 2];
    for (i, (own, place)) in rows.iter().enumerate() {
        // coefficients of the product of (x − x_j)/(x_i − x_j), up to the second
        let mut c = [1.0, 0.0, 0.0];
        for (_, (other, _)) in rows.iter().enumerate().filter(|(j, _)| *j != i) {
            let (root, gap) = ((other - t) / unit, (own - other) / unit);
            c = [-root * c[0] / gap, (c[0] - root * c[1]) / gap, (c[1] - root * c[2]) / gap];
        }
        found[0] = add(found[0], scale(c[1] / unit, *place));
        found[1] = add(found[1], scale(2.0 * c[2] / (unit * unit), *place));
    }
    found
}
