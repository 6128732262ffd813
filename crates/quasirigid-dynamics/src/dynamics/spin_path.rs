//! Angular velocity alone along a reduced motion: the fast method for ensembles.
//! Without attitude and accounts the state is one vector register of four components.
//! Equations (P1) and (P2), docs/theory/05-propagation.md.

use super::form::error_scale;
use std::ops::ControlFlow;

use super::conserved_momentum::inside;
use super::form::{AngularMomentumForm, AngularVelocityForm, Equations, Rates, vector};
use super::momentum_sphere::MomentumSpheres;
use super::run::{ALIGNED, Options, Outcome, PropagateError, check};
use super::spin::SpinOnly;
use super::start::start;
use crate::math::ode::{Dop853, Solver, StepObserver, Work, integrate};
use crate::math::simd::{Arithmetic, Task, dispatch};
use crate::math::vec3::norm;
use crate::model::{Form, ReducedBody};

/// Angular velocity (rad/s, body axes) at the output times, without attitude and accounts: the fast method for ensembles.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct SpinPath {
    /// Angular velocity per time reached.
    pub omega: Vec<[f64; 3]>,
    /// Reason of the end.
    pub outcome: Outcome,
    /// Work done.
    pub work: Work,
}

/// Integrates the angular velocity of a reduced body from `t = 0` to the last of the times (s). (P1), (P2)
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 3)?;
/// let path = spin_path(&reduced, [0.1, 0.0, 1.0], &[1.0, 2.0], &Options::default())?;
/// assert_eq!(path.omega.len(), 2);
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// # Errors
/// [`PropagateError`], as for [`propagate`](super::propagate).
pub fn spin_path(
    body: &ReducedBody,
    omega: [f64; 3],
    times: &[f64],
    options: &Options,
) -> Result<SpinPath, PropagateError> {
    check(norm(omega), ALIGNED, times, options)?;
    let x = start(body, omega, options.form).ok_or(PropagateError::NoAngularMomentum)?;
    let error =
        options.tolerance * error_scale(options.form, x, inside(body.angular_momentum(omega), body.J, omega));
    Ok(match options.form {
        Form::AngularMomentum => {
            let (equations, rates) =
                (&AngularMomentumForm::new(body), &MomentumSpheres::new(body).through(x));
            dispatch(options.rounding, Path { equations, rates, x, error, times, options })
        }
        Form::AngularVelocity => {
            let equations = &AngularVelocityForm::new(body);
            dispatch(options.rounding, Path { equations, rates: equations, x, error, times, options })
        }
    })
}

struct Path<'a, E, R> {
    equations: &'a E,
    rates: &'a R,
    x: [f64; 3],
    error: f64,
    times: &'a [f64],
    options: &'a Options,
}

impl<E: Equations, R: Rates<f64>> Task for Path<'_, E, R> {
    type Output = SpinPath;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> SpinPath {
        let Self { equations, rates, x: [x, y, z], error, times, options } = self;
        let system = SpinOnly(rates);
        let allowed = [error, error, error, f64::INFINITY];
        let mut solver = Dop853::<_, _, A>::new(system, 0.0, [x, y, z, 0.0], allowed);
        let mut collector = Collector { equations, omega: Vec::with_capacity(times.len()) };
        let reason = integrate(&mut solver, times, 0, options.most_steps, &mut collector);
        SpinPath { omega: collector.omega, outcome: Outcome::of(reason, None), work: solver.work() }
    }
}

struct Collector<'a, E> {
    equations: &'a E,
    omega: Vec<[f64; 3]>,
}

impl<E: Equations, M: Solver<State = [f64; 4]>> StepObserver<M> for Collector<'_, E> {
    fn output(&mut self, _: f64, y: &[f64; 4]) {
        self.omega.push(self.equations.omega(vector(*y)));
    }

    #[inline(always)]
    fn stepped(&mut self, _: &mut M) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
