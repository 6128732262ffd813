//! External loads with their exact derivatives, by Taylor series of two terms. (M6)

use nalgebra::{DMatrix, DVector};

use crate::math::rotation::{self, Attitude, Turn};
use crate::math::taylor::Taylor;
use crate::model::force::{Force, Loads, Pose};
use crate::model::{FlexibleBody, Marker, MotionState};

/// Body at an instant of a steady motion: its coordinates rest relative to the carrier.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    pub t: f64,
    pub attitude: Attitude,
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    pub q: Vec<f64>,
    /// Place of a constrained pole (m), inertial axes.
    pub place: [f64; 3],
    /// Velocity (m/s): of the centre of mass of a free body in body axes, of a constrained pole in inertial axes.
    pub velocity: [f64; 3],
}

impl Instant {
    /// External loads.
    pub fn loads(&self, body: &FlexibleBody, forces: &[Force<Marker>]) -> Loads<f64> {
        let free = body.translation().is_some();
        let velocity = if free { rotation::to_inertial(self.attitude, self.velocity) } else { self.velocity };
        let still = vec![0.0; self.q.len()];
        let motion = MotionState { omega: self.omega, q: &self.q, rate: &still };
        let pose = Pose { t: self.t, attitude: self.attitude, place: self.place, velocity };
        body.loads_at(forces, &pose, motion)
    }
}

/// Columns of the derivatives: rotation `θ` in body axes, angular velocity, velocity of a free body, elastic displacements, rates.
pub(super) const THETA: usize = 0;
pub(super) const OMEGA: usize = 3;
pub(super) const VELOCITY: usize = 6;
pub(super) const DISPLACED: usize = 9;

/// Column of none of them: the time.
const CLOCK: usize = usize::MAX;

/// Loads at an instant with their derivatives. (M6)
#[derive(Clone, Debug)]
pub(super) struct Slopes {
    pub value: Loads<f64>,
    /// Rows: moment, generalised forces, force; columns as above.
    pub by: DMatrix<f64>,
}

type Series = Taylor<2>;

impl Slopes {
    /// No loads.
    pub fn none(body: &FlexibleBody) -> Self {
        let n = body.coordinates().len();
        Self { value: Loads::none(n), by: DMatrix::zeros(6 + n, DISPLACED + body.elastic() + n) }
    }

    /// Derivatives of the loads by the time, in the order of the rows, at a state that stays.
    pub fn by_time(body: &FlexibleBody, forces: &[Force<Marker>], instant: &Instant) -> DVector<f64> {
        let loads = along(body, forces, instant, CLOCK);
        let rows = loads.moment.iter().chain(&loads.generalized).chain(&loads.force);
        DVector::from_vec(rows.map(|entry| entry.coefficient(1)).collect())
    }

    pub fn of(body: &FlexibleBody, forces: &[Force<Marker>], instant: &Instant) -> Self {
        let mut slopes = Self::none(body);
        for column in 0..slopes.by.ncols() {
            let loads = along(body, forces, instant, column);
            let n = loads.generalized.len();
            let rows = loads.moment.iter().chain(&loads.generalized).chain(&loads.force);
            for (row, entry) in rows.enumerate() {
                slopes.by[(row, column)] = entry.coefficient(1);
            }
            if column == 0 {
                let first = |entry: &Series| entry.coefficient(0);
                slopes.value = Loads {
                    force: loads.force.each_ref().map(first),
                    moment: loads.moment.each_ref().map(first),
                    generalized: loads.generalized[..n].iter().map(first).collect(),
                };
            }
        }
        slopes
    }
}

/// Loads along a line in one of the variables.
fn along(body: &FlexibleBody, forces: &[Force<Marker>], instant: &Instant, column: usize) -> Loads<Series> {
    let elastic = body.elastic();
    let line = |value: f64, own: usize| Series::new([value, f64::from(u8::from(column == own))]);
    let triple = |vector: [f64; 3], first: usize| [0, 1, 2].map(|i| line(vector[i], first + i));
    let turned =
        rotation::rate(instant.attitude, [0, 1, 2].map(|i| f64::from(u8::from(column == THETA + i))));
    let attitude = [0, 1, 2, 3].map(|i| Series::new([instant.attitude[i], turned[i]]));
    let velocity = triple(instant.velocity, VELOCITY);
    let velocity =
        if body.translation().is_some() { Turn::of(attitude).to_inertial(velocity) } else { velocity };
    let q: Vec<Series> = instant
        .q
        .iter()
        .enumerate()
        .map(|(j, q)| if j < elastic { line(*q, DISPLACED + j) } else { Series::from(*q) })
        .collect();
    let rate: Vec<Series> = (0..q.len()).map(|j| line(0.0, DISPLACED + elastic + j)).collect();
    let motion = MotionState { omega: triple(instant.omega, OMEGA), q: &q, rate: &rate };
    let pose = Pose { t: line(instant.t, CLOCK), attitude, place: instant.place.map(Series::from), velocity };
    body.loads_at(forces, &pose, motion)
}
