//! Angular velocities along many reduced motions of one body at once: eight trajectories in the lanes of the processor's vectors.
//! Equations (P1) and (P2), docs/theory/05-propagation.md.

use super::conserved_momentum::inside;
use super::form::error_scale;
use super::form::{AngularMomentumForm, AngularVelocityForm, Equations, Rates, vector};
use super::momentum_sphere::{MomentumSphere, MomentumSpheres};
use super::run::{ALIGNED, Options, Outcome, PropagateError, check};
use super::spin::SpinOnly;
use super::spin_path::SpinPath;
use super::start::start;
use crate::math::lanes::Lanes;
use crate::math::ode::{Dop853, LaneRun, LaneStart, LaneSystem, Work, integrate_lanes};
use crate::math::simd::{Arithmetic, Task, dispatch_lanes};
use crate::math::vec3::norm;
use crate::model::{Form, ReducedBody};

/// Integrates the angular velocity of a reduced body from many starts at `t = 0` to the last of the times (s), eight trajectories at a time.
/// Each has a step size of its own, and the bits that [`spin_path`](super::spin_path) gives from its start. (P1), (P2)
///
/// `goes_on` is asked from moment to moment with the number of trajectories that have ended; `false` interrupts the others.
///
/// ```
/// use quasirigid::prelude::*;
/// use quasirigid::problems::ring_of_points;
///
/// let reduced = reduce(&ring_of_points(4).body()?, 3)?;
/// let starts = [[0.1, 0.0, 1.0], [0.2, 0.0, 1.0]];
/// let paths = spin_paths(&reduced, &starts, &[1.0, 2.0], &Options::default(), &mut |_| true);
/// assert_eq!(paths[1], spin_path(&reduced, starts[1], &[1.0, 2.0], &Options::default()));
/// # Ok::<(), quasirigid::Error>(())
/// ```
///
/// # Errors
/// [`PropagateError`] in place of a path, as for [`propagate`](super::propagate).
pub fn spin_paths(
    body: &ReducedBody,
    omega: &[[f64; 3]],
    times: &[f64],
    options: &Options,
    goes_on: &mut dyn FnMut(usize) -> bool,
) -> Vec<Result<SpinPath, PropagateError>> {
    let starts: Vec<_> = omega.iter().map(|omega| begin(body, *omega, times, options)).collect();
    let good: Vec<Begun> = starts.iter().filter_map(|start| start.as_ref().ok().copied()).collect();
    let mut paths = match options.form {
        Form::AngularMomentum => {
            let equations = &AngularMomentumForm::new(body);
            let rates = OwnSpheres::new(body);
            dispatch_lanes(
                options.rounding,
                Paths { equations, rates, starts: &good, times, options, goes_on },
            )
        }
        Form::AngularVelocity => {
            let equations = &AngularVelocityForm::new(body);
            let rates = Shared(equations);
            dispatch_lanes(
                options.rounding,
                Paths { equations, rates, starts: &good, times, options, goes_on },
            )
        }
    }
    .into_iter();
    starts.into_iter().map(|start| start.map(|_| paths.next().expect("a path for each good start"))).collect()
}

/// State of a form at the start, and the error allowed per step.
#[derive(Clone, Copy)]
struct Begun {
    x: [f64; 3],
    error: f64,
}

fn begin(
    body: &ReducedBody,
    omega: [f64; 3],
    times: &[f64],
    options: &Options,
) -> Result<Begun, PropagateError> {
    check(norm(omega), ALIGNED, times, options)?;
    let x = start(body, omega, options.form).ok_or(PropagateError::NoAngularMomentum)?;
    let inside = inside(body.angular_momentum(omega), body.J, omega);
    Ok(Begun { x, error: options.tolerance * error_scale(options.form, x, inside) })
}

struct Paths<'a, E, R> {
    equations: &'a E,
    rates: R,
    starts: &'a [Begun],
    times: &'a [f64],
    options: &'a Options,
    goes_on: &'a mut dyn FnMut(usize) -> bool,
}

impl<E: Equations, R: LaneRates> Task for Paths<'_, E, R> {
    type Output = Vec<SpinPath>;

    #[inline(always)]
    fn run<A: Arithmetic>(self) -> Vec<SpinPath> {
        let Self { equations, mut rates, starts, times, options, goes_on } = self;
        let starts: Vec<_> = starts.iter().map(|start| first_step::<R, A>(&rates, *start)).collect();
        let runs = integrate_lanes::<_, A, 3>(&mut rates, &starts, times, options.most_steps, goes_on);
        runs.into_iter().map(|run| path(equations, run)).collect()
    }
}

/// Rates in lanes, and those of one trajectory alone.
trait LaneRates: LaneSystem<3> {
    /// Rates alone.
    type Alone: Rates<f64>;

    /// Rates of the trajectory that starts at `x`, handed on.
    fn with_alone<T>(&self, x: [f64; 3], then: impl FnOnce(&Self::Alone) -> T) -> T;
}

/// One angular-velocity form for all trajectories.
struct Shared<'a>(&'a AngularVelocityForm);

impl LaneSystem<3> for Shared<'_> {
    #[inline(always)]
    fn rate<A: Arithmetic>(&self, omega: &[Lanes; 3]) -> [Lanes; 3] {
        Rates::<Lanes>::rate::<A>(self.0, *omega)
    }
}

impl LaneRates for Shared<'_> {
    type Alone = AngularVelocityForm;

    #[inline(always)]
    fn with_alone<T>(&self, _: [f64; 3], then: impl FnOnce(&AngularVelocityForm) -> T) -> T {
        then(self.0)
    }
}

/// An energy form for each trajectory, on the sphere of its own angular momentum.
struct OwnSpheres {
    spheres: MomentumSpheres,
    lanes: MomentumSphere<Lanes>,
}

impl OwnSpheres {
    fn new(body: &ReducedBody) -> Self {
        let spheres = MomentumSpheres::new(body);
        let lanes = MomentumSphere::<Lanes>::splat(&spheres.through([0.0; 3]));
        Self { spheres, lanes }
    }
}

impl LaneSystem<3> for OwnSpheres {
    fn begin(&mut self, lane: usize, K: &[f64; 3]) {
        self.lanes.load(lane, &self.spheres.through(*K));
    }

    #[inline(always)]
    fn rate<A: Arithmetic>(&self, K: &[Lanes; 3]) -> [Lanes; 3] {
        self.lanes.rate::<A>(*K)
    }
}

impl LaneRates for OwnSpheres {
    type Alone = MomentumSphere<f64>;

    #[inline(always)]
    fn with_alone<T>(&self, K: [f64; 3], then: impl FnOnce(&MomentumSphere<f64>) -> T) -> T {
        then(&self.spheres.through(K))
    }
}

/// First step of a trajectory, as the method chooses it for one alone.
#[inline(always)]
fn first_step<R: LaneRates, A: Arithmetic>(rates: &R, Begun { x: [x, y, z], error }: Begun) -> LaneStart<3> {
    rates.with_alone([x, y, z], |alone| {
        let solver = Dop853::<_, _, A>::new(
            SpinOnly(alone),
            0.0,
            [x, y, z, 0.0],
            [error, error, error, f64::INFINITY],
        );
        LaneStart { y: [x, y, z], rate: vector(*solver.rate()), h: solver.h(), allowed: [error; 3] }
    })
}

/// Evaluations of the rate before the first step.
const FIRST: u64 = 2;

fn path<E: Equations>(equations: &E, LaneRun { outputs, reason, work }: LaneRun<3>) -> SpinPath {
    let omega = outputs.into_iter().map(|x| equations.omega(x)).collect();
    let work = Work { evaluations: work.evaluations + FIRST, ..work };
    SpinPath { omega, outcome: Outcome::of(reason, None), work }
}
