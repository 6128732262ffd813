//! Interface of a propagation: start, options, samples, observer, outcome and errors, for full and reduced systems alike.
//! Errors are refusals before the first step; everything later is an [`Outcome`] with the last state, so that a long run never loses its
//! samples.
//! Equations (P3) to (P7), docs/theory/05-propagation.md; (F12), docs/theory/07-forces.md.

use std::fmt;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use thiserror::Error;

use super::event::Event;
use super::slow::{MAX_FORCED_ORDER, Ringing};
use super::timing::Missed;
use crate::math::ode::{Checkpoint, StepError, StopReason, Work};
use crate::math::simd::Rounding;
use crate::model::force::Force;
use crate::model::{Displaced, DriveFault, Form, Marker, Method};

/// Start of a propagation. States of the full system from a start: [`settled`](Self::settled) on the slow manifold or
/// [`at_rest`](Self::at_rest). Starts from other data: [`matched`](Self::matched) or [`wobbling`](Self::wobbling).
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [f64; 3],
    /// Velocity of that point (m/s).
    pub velocity: [f64; 3],
}

impl Start {
    /// Start at rest in the origin of the inertial axes.
    #[must_use]
    pub fn new(omega: [f64; 3], attitude: [f64; 4]) -> Self {
        Self { omega, attitude, place: [0.0; 3], velocity: [0.0; 3] }
    }
}

/// Options of a propagation.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Form of a reduced system.
    pub form: Form,
    /// Method of integration of a full system.
    pub method: Method,
    /// Error allowed per step, relative to `|K|` or `|ω|` (1e-15 to 1e-2); the same number in radians for the attitude; for internal
    /// coordinates of a full system by their share of the energy.
    pub tolerance: f64,
    /// Limit of the number of steps.
    pub most_steps: u64,
    /// Events that end the propagation.
    pub events: Vec<Event>,
    /// Bits of a reduced motion, and of a full one whose stages are evaluated side by side: as fast as the processor allows, or the same on
    /// every processor.
    pub rounding: Rounding,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            form: Form::AngularMomentum,
            method: Method::Automatic,
            tolerance: 1e-12,
            most_steps: 1_000_000_000,
            events: Vec::new(),
            rounding: Rounding::Fastest,
        }
    }
}

/// State of the body at one time.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub t: f64,
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, `R_NB`, scalar first.
    pub attitude: [f64; 4],
    /// Angular momentum (N·m·s), body axes.
    pub angular_momentum: [f64; 3],
    /// Energy of the system integrated (J).
    pub energy: f64,
    /// Energy taken by the dashpots since the start (J). (P4)
    pub dissipated: f64,
    /// Work of the external forces and of drives since the start (J). (F12), (T9)
    pub work: f64,
    /// Energy drift (J): change by errors of the integrator; of a reduced system under external forces also by the truncation. (P4)
    pub energy_drift: f64,
    /// Relative drift of `|K|`: in the angular-momentum form and the full system the error of the integrator before its projection (P6),
    /// in the angular-velocity form the whole change, most of it from the truncation of the series. Where internal rotors nearly cancel
    /// the angular momentum: the whole change relative to the internal one. Under external forces: the change of the inertial angular
    /// momentum beyond the impulse of the forces.
    pub momentum_drift: f64,
    /// Revolutions, `∫|ω| dt / 2π`.
    pub revolutions: f64,
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a constrained one.
    pub place: [f64; 3],
    /// Velocity of that point (m/s).
    pub velocity: [f64; 3],
    /// Place of the pole `R₀` (m), inertial axes. (P7)
    pub pole: [f64; 3],
}

/// Receives the results of a propagation while it runs.
pub trait Observer {
    /// Receives the sample at an output time.
    fn sample(&mut self, sample: &Sample);

    /// True if [`coordinates`](Self::coordinates) is to be called where that has a cost.
    fn keeps_coordinates(&self) -> bool {
        false
    }

    /// Receives the internal coordinates and their rates, just before the sample that they belong to. A full motion has its own; of a
    /// reduced one they follow the angular velocity, and values of cyclic ones are zero. (R4), (E2)
    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        let _ = (q, rate);
    }

    /// True if [`controls`](Self::controls) is to be called.
    fn keeps_controls(&self) -> bool {
        false
    }

    /// Receives the numbers of [`Controls::channels`](crate::model::control::Controls::channels) of a body under controllers, just before the
    /// sample that they belong to.
    fn controls(&mut self, values: &[f64]) {
        let _ = values;
    }

    /// Receives the energy (J) taken by each dissipator since the start, by name, once at the end; not called for forced reduced motions.
    /// (D4)
    fn budget(&mut self, energies: &[(String, f64)]) {
        let _ = energies;
    }

    /// State to go on from in place of the start, of a propagation of the same system from the same start.
    fn resumes(&mut self) -> Option<Checkpoint> {
        None
    }

    /// True if [`checkpoint`](Self::checkpoint) is to be called now; asked after each [`progress`](Self::progress).
    fn wants_checkpoint(&self) -> bool {
        false
    }

    /// Receives the state of the propagation between two steps; one that [`resumes`](Self::resumes) it gives the same bits.
    fn checkpoint(&mut self, checkpoint: Checkpoint) {
        let _ = checkpoint;
    }

    /// Called from moment to moment, and after the first step; `Break` ends the propagation.
    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        let _ = t;
        ControlFlow::Continue(())
    }
}

impl Observer for Vec<Sample> {
    fn sample(&mut self, sample: &Sample) {
        self.push(*sample);
    }
}

/// Result of a propagation: its outcome and the last state reached, up to which the samples are valid.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Reason of the end.
    pub outcome: Outcome,
    /// Last state reached.
    pub last: Sample,
    /// Work done.
    pub work: Work,
    /// Formulas of the time, as far as they were followed.
    pub scan: Scan,
    /// Energy (J) of vibrations that the forces excite, as far as reduced equations leave them out, and of what their series leaves out of the
    /// dissipated energy: an estimate, zero of other systems. (E5)
    pub left_out: f64,
    /// Largest change of the loads by displacements, beside the stiffness that resists these: the ratio in which the series of reduced
    /// equations has converged, which has no meaning from 1 on; zero of other systems. (E7)
    #[cfg_attr(feature = "serde", serde(default))]
    pub load_ratio: f64,
    /// Error of the angular velocity of reduced equations by vibrations that forces excite; none where it is small, and of other systems. (E8)
    #[cfg_attr(feature = "serde", serde(default))]
    pub ringing: Option<Ringing>,
}

/// Cost and result of following the formulas of the time through a run. (Z3)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Scan {
    /// Evaluations of the formulas.
    pub evaluations: u64,
    /// Breakpoints of formulas, windows and tables, at which the steps begin anew.
    pub breakpoints: u64,
    /// Stops that no step passes: the breakpoints, and ends of the intervals in which formulas change.
    pub stops: u64,
}

/// Reason why a propagation ended.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The last output time was reached.
    Finished,
    /// The observer asked for an end.
    Interrupted,
    /// An event happened.
    Event(Event),
    /// The steps allowed were used up.
    StepLimit,
    /// A part was displaced beyond the range of the equations; its index is one of [`CurvedPaths`](crate::model::CurvedPaths). (K14)
    LeftRange(Displaced),
    /// The steps did not see the impulse of a force that is given in time. (Z4)
    Missed(Missed),
    /// No step could be made.
    Failed(StepError),
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finished => f.write_str("the last time was reached"),
            Self::Interrupted => f.write_str("interrupted"),
            Self::Event(_) => f.write_str("an event that was to end it happened"),
            Self::StepLimit => f.write_str("the step limit was reached; loosen the tolerance"),
            Self::LeftRange(_) => f.write_str("a part was displaced beyond the range of the equations"),
            Self::Missed(missed) => missed.fmt(f),
            Self::Failed(error) => error.fmt(f),
        }
    }
}

impl Outcome {
    pub(super) fn of(reason: StopReason, triggered: Option<Event>) -> Self {
        match (reason, triggered) {
            (StopReason::Event, Some(event)) => Self::Event(event),
            (StopReason::Finished | StopReason::Event, _) => Self::Finished,
            (StopReason::Interrupted, _) => Self::Interrupted,
            (StopReason::StepLimit, _) => Self::StepLimit,
            (StopReason::Failed(error), _) => Self::Failed(error),
        }
    }
}

/// Error of a propagation that cannot start.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PropagateError {
    /// The angular velocity is no number, or zero where a spin is needed.
    #[error("{spin} rad/s is not a spin; give an angular velocity that is finite and not zero")]
    NoSpin {
        /// Size of the angular velocity asked for (rad/s).
        spin: f64,
    },
    /// The attitude is no rotation.
    #[error("{attitude:?} is not a unit quaternion; give one of norm 1, scalar first")]
    Attitude {
        /// Attitude asked for.
        attitude: [f64; 4],
    },
    /// The event can never happen.
    #[error(
        "{event:?} can never happen; give an axis that is not zero, an angle from 0 to pi, and finite positive values"
    )]
    Event {
        /// Event asked for.
        event: Event,
    },
    /// Coordinates, their rates, the place or its velocity are no numbers.
    #[error(
        "the state at the start contains a non-finite number; give finite coordinates, rates, place and velocity"
    )]
    NotFinite,
    /// The tolerance is below rounding or above any accuracy.
    #[error("the tolerance {tolerance:e} is out of range; choose one from 1e-15 to 1e-2")]
    Tolerance {
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The times do not ascend from zero.
    #[error("the output times must be finite, ascend and not be negative; {t} s follows {before} s")]
    Times {
        /// Time at fault (s).
        t: f64,
        /// Time before the one at fault (s).
        before: f64,
    },
    /// No angular momentum belongs to the angular velocity: the series does not hold there.
    #[error(
        "the truncated series has no angular momentum for this angular velocity; the theory does not hold here: lower the spin, stiffen the springs, or use order 1"
    )]
    NoAngularMomentum,
    /// The order is beyond the reduction of a forced body.
    #[error(
        "order {order} is out of range for a body with external forces; choose one from 0 to {MAX_FORCED_ORDER}, in the paper's form to 3"
    )]
    Order {
        /// Order asked for.
        order: usize,
    },
    /// The angular-velocity form under forces is written for elastic coordinates alone.
    #[error(
        "with forces the angular-velocity form (`paper`) takes no rotors, liquids and momentum wheels; use the angular-momentum form (`momentum`), which is the default"
    )]
    AngularVelocityForm,
    /// The state belongs to another body.
    #[error("the state has {coordinates} internal coordinates and {rates} rates; the body has {needed}")]
    Coordinates {
        /// Coordinates of the state.
        coordinates: usize,
        /// Rates of the state.
        rates: usize,
        /// Coordinates of the body.
        needed: usize,
    },
    /// The checkpoint is not one of this propagation.
    #[error("the checkpoint is not one of this propagation; start it anew")]
    Checkpoint,
    /// The forces have no value at the start.
    #[error(
        "the forces are not finite numbers at the start: look for a square root, logarithm or division in a force that fails there"
    )]
    NoForce,
    /// A path past a centre of attraction is a table that is too short.
    #[error(
        "the table of an orbit has rows from {from} s to {to} s, and the run is from 0 s to {end} s; give a longer table, a shorter duration, or `during` for the force"
    )]
    Uncovered {
        /// First time of the table (s).
        from: f64,
        /// Last time of the table (s).
        to: f64,
        /// End of the run (s).
        end: f64,
    },
    /// No drive follows the law of a coordinate. (T10)
    #[error("the law that drives coordinate {} {fault}", coordinate + 1)]
    Drive {
        /// Index of the coordinate.
        coordinate: usize,
        /// Fault of the law.
        fault: DriveFault,
    },
    /// Coordinates are driven, which reduced equations do not have.
    #[error(
        "a part of the body is driven over time, which reduced equations and slow manifolds leave out; follow the body with the full system"
    )]
    Driven,
    /// The mass matrix is not positive: the carrier is too light beside the masses that move on it.
    #[error("the carrier's mass is below 1e-13 of the sprung mass; give the carrier a mass, or leave it out")]
    LightCarrier,
    /// The free vibrations are linearly dependent, to rounding.
    #[error("the damped modes of the body could not be found; the damping matrix may be defective")]
    NoModes,
}

/// Pace of the calls of [`Observer::progress`]: one per moment, however long a step takes, with few readings of the clock.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Steps between two readings of the clock.
    stride: u64,
    next: u64,
    looked: Instant,
}

/// Time between two calls, and limit of the steps between them.
const MOMENT: Duration = Duration::from_millis(50);
const MOST_STEPS: u64 = 4096;

impl Pace {
    pub fn new() -> Self {
        Self { stride: 1, next: 1, looked: Instant::now() }
    }

    /// True if a call is due after so many steps.
    #[inline]
    pub fn due(&mut self, steps: u64) -> bool {
        steps >= self.next && self.passed(steps)
    }

    fn passed(&mut self, steps: u64) -> bool {
        let moment = std::mem::replace(&mut self.looked, Instant::now()).elapsed();
        self.stride =
            if moment < MOMENT { (2 * self.stride).min(MOST_STEPS) } else { self.stride.div_ceil(2) };
        self.next = steps + self.stride;
        true
    }
}

/// Unit quaternion, for a motion whose attitude is not needed.
pub(super) const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Largest difference of the norm of an attitude from one: single precision, and digits that a file prints.
const NORM: f64 = 1e-6;

/// Refuses arguments that no propagation can start from.
pub(super) fn check(
    spin: f64,
    attitude: [f64; 4],
    times: &[f64],
    options: &Options,
) -> Result<(), PropagateError> {
    let norm = attitude.iter().map(|part| part * part).sum::<f64>().sqrt();
    if !((norm - 1.0).abs() <= NORM) {
        return Err(PropagateError::Attitude { attitude });
    }
    if let Some(event) = options.events.iter().find(|event| !event.possible()) {
        return Err(PropagateError::Event { event: *event });
    }
    if !(spin.is_finite() && spin >= 0.0) {
        return Err(PropagateError::NoSpin { spin });
    }
    check_times(times, options.tolerance)
}

/// Refuses forces that are not known up to the end of a run (s).
pub(super) fn check_covered(forces: &[Force<Marker>], end: f64) -> Result<(), PropagateError> {
    match forces.iter().find_map(|force| force.law.uncovered(end)) {
        Some([from, to]) => Err(PropagateError::Uncovered { from, to, end }),
        None => Ok(()),
    }
}

/// Refuses times and tolerances that no propagation takes.
pub(crate) fn check_times(times: &[f64], tolerance: f64) -> Result<(), PropagateError> {
    if !(1e-15..=1e-2).contains(&tolerance) {
        return Err(PropagateError::Tolerance { tolerance });
    }
    let befores = std::iter::once(&0.0).chain(times);
    match befores.zip(times).find(|(before, t)| !(*t >= *before && t.is_finite())) {
        Some((&before, &t)) => Err(PropagateError::Times { t, before }),
        None => Ok(()),
    }
}
