//! Newton's method for steady states: unknowns are the attitude or the angular velocity, and the displacements. (M6)

use nalgebra::{DMatrix, DVector, Matrix3x2, Vector3};

use super::error::SteadyError;
use super::reduced::{Reduced, least_squares};
use super::slopes::{Instant, Slopes};
use super::state::SteadyStateGuess;
use super::system::{System, length};
use crate::math::rotation::{self, Attitude, Turn};
use crate::math::vec3::norm;
use crate::model::force::{Force, Loads};
use crate::model::{FlexibleBody, Marker};

type V = Vector3<f64>;

/// Limit of Newton steps.
const NEWTON_STEPS: usize = 60;
/// Longest step (rad).
const LONGEST_STEP: f64 = 0.3;
/// Relative step that is rounding.
const NEWTON_ROUNDING: f64 = 1e-13;
/// Relative step accepted where rounding ends the progress.
const ACCEPTED_NEWTON_STEP: f64 = 1e-9;
/// Share of their terms below which the sum of loads counts as balanced.
const BALANCED: f64 = 1e-9;
/// Share of `|ω||K|`, and of all moments about the axis, that rounding may leave.
const ROUNDED: f64 = 1e-13;
/// Share of the angular velocity below which a component counts as zero.
const NONE: f64 = 1e-9;
/// Share of the terms of the start below which terms count as zero.
const FLOOR: f64 = 1e-3;
/// Share of the strain energy of loads as large as the moments below which a strain energy is negligible.
const SLIGHT: f64 = 1e-6;
/// Share of the rate of the start below which a state of rest is tried.
const REST_RATIO: f64 = 1e-4;

/// Unknowns of Newton's method beside the displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Unknowns {
    /// Attitude; the axis and the rate are given.
    Attitude,
    /// Attitude across the axis: a rotation about the axis changes nothing.
    Across,
    /// Attitude across the axis, and the rate.
    AcrossAndRate,
    /// Angular velocity.
    Spin,
    /// Direction of the angular velocity, at this rate (rad/s).
    SpinOfRate(f64),
}

impl Unknowns {
    fn own(self) -> bool {
        matches!(self, Self::Spin | Self::SpinOfRate(_))
    }
}

/// Body with its forces, and the start of the search.
#[derive(Clone, Copy)]
pub(super) struct Problem<'a> {
    pub body: &'a FlexibleBody,
    pub forces: &'a [Force<Marker>],
    pub followed: bool,
    pub near: SteadyStateGuess,
}

/// Guess of a state, with the axis (inertial axes) and the rate at which the axes of the forces rotate.
#[derive(Clone)]
struct Guess {
    at: Instant,
    axis: V,
    rate: f64,
}

/// A step of Newton's method.
struct Step {
    turn: V,
    rate: f64,
    spin: V,
    q: Vec<f64>,
    velocity: V,
}

impl Problem<'_> {
    /// Steady state in axes that rotate about an axis (inertial axes) at a given rate.
    pub fn turned(&self, axis: V, rate: f64) -> Result<Instant, SteadyError> {
        self.newton(self.start(self.near.attitude, axis, rate), Unknowns::Attitude).map(|(found, _)| found.at)
    }

    /// Steady state about an axis (inertial axes), at the rate of the start; where a moment would change that rate, at a rate without
    /// such a moment.
    pub fn about(&self, axis: V, omega_N: V) -> Result<Instant, SteadyError> {
        let SteadyStateGuess { attitude, omega, asked, .. } = self.near;
        let along = omega_N.dot(&axis);
        let (rate, attitude) = if asked && omega_N.norm() > 0.0 {
            let side = if along < 0.0 { -1.0 } else { 1.0 };
            (side * omega_N.norm(), rotation::aligned(attitude, omega, (side * axis).into()))
        } else {
            (if along.abs() <= NONE * omega_N.norm() { 0.0 } else { along }, attitude)
        };
        let (found, system) = self.newton(self.start(attitude, axis, rate), Unknowns::Across)?;
        let moment = -body_axis(&found).dot(&moments(&system));
        if moment.abs() <= ROUNDED * system.terms {
            return Ok(found.at);
        }
        self.newton(found, Unknowns::AcrossAndRate)
            .map(|(found, _)| found.at)
            .map_err(|_| SteadyError::Driven { moment, rate })
    }

    /// Steady state where no force depends on the attitude: at the rate of the start if free, otherwise where the moments balance.
    pub fn own(&self) -> Result<Instant, SteadyError> {
        let rate = norm(self.near.omega);
        let mut start = self.start(self.near.attitude, V::zeros(), 0.0);
        start.at.omega = self.near.omega;
        if rate > 0.0
            && let Ok((found, _)) = self.newton(start.clone(), Unknowns::SpinOfRate(rate))
        {
            return Ok(found.at);
        }
        let mut rest = start.clone();
        let (found, _) = self.newton(start, Unknowns::Spin).map_err(|_| SteadyError::Unbalanced)?;
        // Newton's method approaches rest without end where the moments grow with the square of the rate.
        if norm(found.at.omega) <= REST_RATIO * rate {
            (rest.at.omega, rest.at.velocity) = ([0.0; 3], found.at.velocity);
            if norm(found.at.velocity) <= REST_RATIO * (length(self.body) * rate + norm(self.near.velocity)) {
                rest.at.velocity = [0.0; 3];
            }
            if let Ok((rest, _)) = self.newton(rest, Unknowns::Spin)
                && norm(rest.at.omega) <= NONE * rate
            {
                return Ok(Instant { omega: [0.0; 3], ..rest.at });
            }
        }
        Ok(found.at)
    }

    fn start(&self, attitude: Attitude, axis: V, rate: f64) -> Guess {
        let turn = Turn::of(attitude);
        let SteadyStateGuess { place, velocity, .. } = self.near;
        let velocity = match (self.body.translation(), self.followed) {
            (Some(_), true) => turn.to_body(velocity),
            (Some(_), false) => [0.0; 3],
            (None, _) => velocity,
        };
        let omega = turn.to_body((rate * axis).into());
        let q = vec![0.0; self.body.coordinates().len()];
        Guess { at: Instant { t: 0.0, attitude, omega, q, place, velocity }, axis, rate }
    }

    fn system(&self, at: &Instant) -> Result<System, SteadyError> {
        let slopes = Slopes::of(self.body, self.forces, at);
        let mut system = System::about(self.body, slopes, at, self.followed);
        if self.forces.len() > 1 {
            system.terms += self.forces.iter().map(|force| self.load(force, at)).sum::<f64>();
        }
        if system.residual.iter().chain(system.slopes.by.iter()).all(|entry| entry.is_finite()) {
            return Ok(system);
        }
        let formula = self.forces.iter().find(|force| force.law.formulas().is_some());
        Err(formula.map_or(self.unfound(), |force| SteadyError::NotANumber { name: force.name.clone() }))
    }

    /// Size of the loads of a force (N·m).
    fn load(&self, force: &Force<Marker>, at: &Instant) -> f64 {
        let Loads { force, moment, .. } = at.loads(self.body, std::slice::from_ref(force));
        norm(moment) + length(self.body) * norm(force)
    }

    /// Newton's method; returns the solution and the system there.
    fn newton(&self, mut guess: Guess, unknowns: Unknowns) -> Result<(Guess, System), SteadyError> {
        let mut best = f64::INFINITY;
        let mut floor = 0.0;
        for _ in 0..NEWTON_STEPS {
            let mut system = self.system(&guess.at)?;
            // At rest every term vanishes: the residual is measured by the terms of the start.
            floor = if floor > 0.0 { floor } else { FLOOR * (system.terms - system.turned) };
            system.terms = system.terms.max(floor + system.turned);
            let step = self.step(&guess, &system, unknowns).ok_or_else(|| self.unfound())?;
            let short = (LONGEST_STEP / step.turn.norm()).min(1.0);
            guess.moved(&step, short, unknowns);
            let moved = self.size(&guess, &step, system.terms);
            if !moved.is_finite() {
                return Err(self.unfound());
            }
            if moved <= NEWTON_ROUNDING || (moved <= ACCEPTED_NEWTON_STEP && moved >= 0.5 * best) {
                let mut system = self.system(&guess.at)?;
                system.terms = system.terms.max(floor + system.turned);
                let balanced = self.balanced(&guess, &system, unknowns);
                return if balanced { Ok((guess, system)) } else { Err(self.unfound()) };
            }
            best = best.min(moved);
        }
        Err(self.unfound())
    }

    fn unfound(&self) -> SteadyError {
        let hung = self.body.hung();
        hung.map_or(SteadyError::NotFound, |hung| SteadyError::Unrestored {
            coordinates: hung.names().into(),
        })
    }

    /// Size of a step, relative to the quantities that it changes.
    fn size(&self, guess: &Guess, step: &Step, terms: f64) -> f64 {
        let grounded = self.body.grounded_stiffness();
        let energy = |q: &[f64]| grounded.quadratic(&q[..self.body.elastic()]);
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let spin = norm(guess.at.omega).max(norm(self.near.omega));
        let speed = norm(guess.at.velocity).max(norm(self.near.velocity)).max(length(self.body) * spin);
        step.turn
            .norm()
            .max(share(step.rate.abs().max(step.spin.norm()), spin))
            .max(share(energy(&step.q), energy(&guess.at.q) + self.slight(terms)).sqrt())
            .max(share(step.velocity.norm(), speed))
    }

    /// Strain energy (J) that is negligible beside that of loads as large as the moments that balance.
    fn slight(&self, terms: f64) -> f64 {
        let J = self.body.invariants().J;
        let held = self.body.grounded_stiffness().diagonal();
        let square = |j: usize| self.body.invariants().modal_mass(j) / held[j];
        let softest = (0..self.body.elastic()).map(square).fold(0.0, f64::max);
        SLIGHT * terms * terms * softest / (J[0] + J[1] + J[2])
    }

    /// True if the loads balance, but for a moment about the axis where the rate is given.
    fn balanced(&self, guess: &Guess, system: &System, unknowns: Unknowns) -> bool {
        let n = guess.at.q.len();
        let mut left = moments(system);
        if unknowns == Unknowns::Across {
            let axis = body_axis(guess);
            left -= left.dot(&axis) * axis;
        }
        let force = if self.followed { V::from_column_slice(&system.residual[3 + n..]).norm() } else { 0.0 };
        let rate = match unknowns {
            Unknowns::SpinOfRate(rate) => (norm(guess.at.omega) / rate - 1.0).abs(),
            _ => 0.0,
        };
        let work = |x: &[f64]| {
            let mut y = x.to_vec();
            self.body.solve_stiffness(&mut y, 1);
            y.iter().zip(x).map(|(a, b)| a * b).sum::<f64>()
        };
        let held = work(&self.body.stiffness().times(&guess.at.q));
        let rounding = BALANCED * (system.terms - system.turned) + ROUNDED * system.turned;
        left.norm() + length(self.body) * force <= rounding
            && work(&system.residual[3..3 + n]) <= BALANCED * BALANCED * (held + self.slight(system.terms))
            && rate <= BALANCED
    }

    /// Step from a state: displacements are eliminated, the rest is solved in the sense of least squares.
    fn step(&self, guess: &Guess, system: &System, unknowns: Unknowns) -> Option<Step> {
        let n = guess.at.q.len();
        let axis = body_axis(guess);
        let basis = across(axis);
        let mut columns = columns(system, axis, &basis, unknowns);
        let own = columns.ncols();
        if self.followed {
            columns = columns.insert_columns(own, 3, 0.0);
            columns.columns_mut(own, 3).copy_from(&system.rate.columns(3 + n, 3));
        }
        let Reduced { mut left, mut right, load, answers } =
            Reduced::of(system, &columns, n, self.body.elastic())?;
        if self.followed {
            left.rows_mut(3, 3).scale_mut(length(self.body));
            right.rows_mut(3, 3).scale_mut(length(self.body));
        }
        if unknowns == Unknowns::Across {
            let kept = basis.transpose();
            let (first, second) = (kept * left.rows(0, 3), kept * right.rows(0, 3));
            (left, right) = (left.remove_row(0), right.remove_row(0));
            left.rows_mut(0, 2).copy_from(&first);
            right.rows_mut(0, 2).copy_from(&second);
        }
        if let Unknowns::SpinOfRate(wanted) = unknowns {
            let omega = V::from(system.omega);
            let row = left.nrows();
            (left, right) = (left.insert_row(row, 0.0), right.insert_row(row, 0.0));
            right[row] = 0.5 * system.terms * (omega.norm_squared() / (wanted * wanted) - 1.0);
            (0..3).for_each(|i| left[(row, i)] = system.terms * omega[i] / (wanted * wanted));
        }
        let turning = if unknowns == Unknowns::AcrossAndRate { 2 } else { own };
        let x = -least_squares(left, &right, turning)?;
        let mut q: Vec<f64> = (-(load + answers * &x)).iter().copied().collect();
        q.resize(n, 0.0);
        let zero = V::zeros();
        let vector = |from: usize| V::new(x[from], x[from + 1], x[from + 2]);
        let (turn, rate, spin) = match unknowns {
            Unknowns::Attitude => (vector(0), 0.0, zero),
            Unknowns::Across => (basis * x.fixed_rows::<2>(0), 0.0, zero),
            Unknowns::AcrossAndRate => (basis * x.fixed_rows::<2>(0), x[2], zero),
            Unknowns::Spin | Unknowns::SpinOfRate(_) => (zero, 0.0, vector(0)),
        };
        let velocity = if self.followed { vector(own) } else { zero };
        Some(Step { turn, rate, spin, q, velocity })
    }
}

impl Guess {
    fn moved(&mut self, step: &Step, short: f64, unknowns: Unknowns) {
        let Self { at, axis, rate } = self;
        let turn = rotation::to_inertial(at.attitude, (short * step.turn).into());
        at.attitude = rotation::normalized(rotation::turned(at.attitude, turn));
        *rate += short * step.rate;
        at.omega = if unknowns.own() {
            (V::from(at.omega) + step.spin).into()
        } else {
            Turn::of(at.attitude).to_body((*rate * *axis).into())
        };
        at.q.iter_mut().zip(&step.q).for_each(|(q, step)| *q += short * step);
        (0..3).for_each(|i| at.velocity[i] += short * step.velocity[i]);
    }
}

/// Unbalanced moments (N·m).
fn moments(system: &System) -> V {
    V::new(system.residual[0], system.residual[1], system.residual[2])
}

/// Axis of the forces in body axes.
fn body_axis(guess: &Guess) -> V {
    Turn::of(guess.at.attitude).to_body(guess.axis.into()).into()
}

/// Two unit vectors across an axis.
fn across(axis: V) -> Matrix3x2<f64> {
    let least = axis.iamin();
    let first = axis.cross(&V::ith(least, 1.0));
    let first = if first.norm() > 0.0 { first.normalize() } else { V::x() };
    Matrix3x2::from_columns(&[first, axis.cross(&first)])
}

/// Columns of the unknowns. With the axis fixed in space a rotation `θ` changes the angular velocity in body axes by `ω × θ`.
fn columns(system: &System, axis: V, basis: &Matrix3x2<f64>, unknowns: Unknowns) -> DMatrix<f64> {
    let spins = system.rate.columns(0, 3);
    let turns = system.stiffness.columns(0, 3) + spins * system.turning();
    let list = |columns: Vec<DVector<f64>>| DMatrix::from_columns(&columns);
    let each = |matrix: &DMatrix<f64>| {
        (0..matrix.ncols()).map(|k| matrix.column(k).into_owned()).collect::<Vec<_>>()
    };
    let turns: DMatrix<f64> = list((0..3).map(|k| turns.column(k).into_owned()).collect());
    match unknowns {
        Unknowns::Attitude => turns,
        Unknowns::Across => turns * basis.resize(3, 2, 0.0),
        Unknowns::AcrossAndRate => {
            let mut columns = each(&(turns * basis.resize(3, 2, 0.0)));
            columns.push(spins * axis);
            list(columns)
        }
        Unknowns::Spin | Unknowns::SpinOfRate(_) => {
            system.rate.columns(0, 3).resize(system.residual.len(), 3, 0.0)
        }
    }
}
