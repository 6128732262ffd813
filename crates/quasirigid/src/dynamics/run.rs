use std::fmt;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use thiserror::Error;

use super::event::Event;
use super::form::Form;
use super::slow::MAX_FORCED_ORDER;
use crate::math::ode::{StepError, StopReason, Work};
use crate::model::Displaced;

/// Start of a propagation; what it becomes in the full system is [`settled`](Self::settled) on the slow manifold or
/// [`at_rest`](Self::at_rest), and where another state leads is [`matched`](Self::matched) or [`wobbling`](Self::wobbling).
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a held one.
    pub place: [f64; 3],
    /// Its velocity (m/s).
    pub velocity: [f64; 3],
}

impl Start {
    /// A body that stays where the inertial axes have their origin.
    #[must_use]
    pub fn new(omega: [f64; 3], attitude: [f64; 4]) -> Self {
        Self { omega, attitude, place: [0.0; 3], velocity: [0.0; 3] }
    }
}

/// How a propagation is made.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Variable of a reduced system that is integrated.
    pub form: Form,
    /// How a full system is integrated.
    pub method: Method,
    /// Error allowed per step, relative to `|K|` or `|ω|` (1e-15 to 1e-2); the attitude is held to it in radians, and the
    /// internal coordinates of a full system to the part of it that their share of the energy allows.
    pub tolerance: f64,
    /// Steps allowed.
    pub most_steps: u64,
    /// What ends the propagation.
    pub events: Vec<Event>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            form: Form::Momentum,
            method: Method::Automatic,
            tolerance: 1e-12,
            most_steps: 1_000_000_000,
            events: Vec::new(),
        }
    }
}

/// How a full system is integrated.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Explicit while vibrations have to be followed, implicit while the step is many times their period.
    #[default]
    Automatic,
    /// Explicit, of order 8: cheap steps, but none longer than the fastest vibration.
    Explicit,
    /// Implicit, of order 13: dear steps, as long as the motion allows.
    Implicit,
}

/// The body at one time.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub t: f64,
    /// Spin (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, `R_NB`, scalar first.
    pub attitude: [f64; 4],
    /// Momentum (N·m·s), body axes.
    pub momentum: [f64; 3],
    /// Energy of the system integrated (J).
    pub energy: f64,
    /// Energy taken by the dashpots since the start (J). (P4)
    pub dissipated: f64,
    /// Work of the external forces since the start (J). (F12)
    pub work: f64,
    /// Change of energy that the integrator made by itself (J), of a reduced system under external forces that of the
    /// truncation too. (P4)
    pub energy_drift: f64,
    /// Relative change of `|K|`: in the momentum form and the full system what the integrator made before it was
    /// projected away (P6), in the paper's form the whole change, most of it the truncation of the series; where what
    /// turns inside takes the momentum up, the whole change relative to its own. Under external forces the change of the
    /// inertial momentum beyond their impulse.
    pub momentum_drift: f64,
    /// Turns made, `∫|ω| dt / 2π`.
    pub turns: f64,
    /// Place (m), inertial axes: of the centre of mass of a free body, of the pole of a held one.
    pub place: [f64; 3],
    /// Its velocity (m/s).
    pub velocity: [f64; 3],
    /// Place of the pole `R₀` (m), inertial axes. (P7)
    pub pole: [f64; 3],
}

/// Receives what a propagation produces while it runs.
pub trait Observer {
    /// A sample at a time asked for.
    fn sample(&mut self, sample: &Sample);

    /// Whether [`coordinates`](Self::coordinates) is to be called where that costs something.
    fn keeps_coordinates(&self) -> bool {
        false
    }

    /// The internal coordinates and their rates, just before the sample they belong to: of a full motion its own, of a reduced
    /// one those that follow the spin, where values of cyclic ones are zero. (R4), (E2)
    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        let _ = (q, rate);
    }

    /// Energy (J) that each dissipator has taken since the start, by name, once at the end; not of forced reduced motions. (D4)
    fn budget(&mut self, energies: &[(String, f64)]) {
        let _ = energies;
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

/// How a propagation ended, with the last state reached; what was observed is valid up to there.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// Why it ended.
    pub outcome: Outcome,
    /// The last state reached.
    pub last: Sample,
    /// Work done.
    pub work: Work,
}

/// Why a propagation ended.
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
    /// A part was displaced beyond the range of the equations; its place is one of those of [`CurvedPaths`](crate::model::CurvedPaths).
    /// (K14)
    LeftRange(Displaced),
    /// No step could be made.
    Failed(StepError),
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finished => f.write_str("the last time was reached"),
            Self::Interrupted => f.write_str("interrupted"),
            Self::Event(_) => f.write_str("an event that was to end it happened"),
            Self::StepLimit => f.write_str("the steps allowed were used up; loosen the tolerance"),
            Self::LeftRange(_) => f.write_str("a part was displaced beyond the range of the equations"),
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

/// A propagation that cannot start.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum PropagateError {
    /// The body does not turn, or its spin is no number.
    #[error("{spin} rad/s is not a spin; give an angular velocity that is finite and not zero")]
    NoSpin {
        /// Size of the spin asked for (rad/s).
        spin: f64,
    },
    /// The attitude is no rotation.
    #[error("{attitude:?} is no attitude; give a unit quaternion, scalar first")]
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
        "the state at the start holds what is no finite number; give finite coordinates, rates, place and velocity"
    )]
    NotFinite,
    /// The tolerance cannot be met, or means nothing.
    #[error("the tolerance {tolerance:e} is out of range; choose one from 1e-15 to 1e-2")]
    Tolerance {
        /// Tolerance asked for.
        tolerance: f64,
    },
    /// The times do not ascend from zero.
    #[error("the output times must be finite, ascend and not be negative; {t} s follows {before} s")]
    Times {
        /// The time at fault (s).
        t: f64,
        /// The time before it (s).
        before: f64,
    },
    /// No momentum belongs to the spin: the series does not hold there.
    #[error(
        "the truncated series has no momentum for this spin; the theory does not hold here: lower the spin, stiffen the springs, or use order 1"
    )]
    NoMomentum,
    /// The order is beyond the reduction of a forced body.
    #[error(
        "order {order} is out of range for a body with external forces; choose one from 0 to {MAX_FORCED_ORDER}, in the paper's form to 3"
    )]
    Order {
        /// Order asked for.
        order: usize,
    },
    /// The paper's form under forces is written for elastic coordinates alone.
    #[error(
        "with forces the paper's form takes no rotors, liquids and momentum wheels; use the momentum form, which is the default"
    )]
    PaperForm,
    /// The state is that of another body.
    #[error("the state has {coordinates} internal coordinates and {rates} rates; the body has {needed}")]
    Coordinates {
        /// Coordinates of the state.
        coordinates: usize,
        /// Rates of the state.
        rates: usize,
        /// Coordinates of the body.
        needed: usize,
    },
    /// The forces have no value at the start.
    #[error(
        "the forces are not finite numbers at the start: look for a square root, logarithm or division in a force that fails there"
    )]
    NoForce,
    /// The mass matrix is not positive: what carries is too light beside what moves on it.
    #[error(
        "the mass that is not on springs is lost in rounding beside the mass that is: less than 1e-13 of it; give the carrier a mass, or leave it out"
    )]
    LightCarrier,
    /// The free vibrations cannot be told apart.
    #[error("the damped modes of the body could not be found; the damping matrix may be defective")]
    NoModes,
}

/// When [`Observer::progress`] is called: after a moment, whatever a step costs, but not so often that the clock does.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pace {
    /// Steps between two looks at the clock.
    stride: u64,
    next: u64,
    looked: Instant,
}

/// A moment, and most steps in it.
const MOMENT: Duration = Duration::from_millis(50);
const MOST_STEPS: u64 = 4096;

impl Pace {
    pub fn new() -> Self {
        Self { stride: 1, next: 1, looked: Instant::now() }
    }

    /// Whether it is time after so many steps.
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

/// A unit quaternion, for a motion whose attitude nobody asks for.
pub(super) const ALIGNED: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

/// Largest difference of the norm of an attitude from one: single precision, and digits that a file prints.
const NORM: f64 = 1e-6;

/// Refuses what no propagation can start from.
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
    let tolerance = options.tolerance;
    if !(spin.is_finite() && spin > 0.0) {
        return Err(PropagateError::NoSpin { spin });
    }
    if !(1e-15..=1e-2).contains(&tolerance) {
        return Err(PropagateError::Tolerance { tolerance });
    }
    let befores = std::iter::once(&0.0).chain(times);
    match befores.zip(times).find(|(before, t)| !(*t >= *before && t.is_finite())) {
        Some((&before, &t)) => Err(PropagateError::Times { t, before }),
        None => Ok(()),
    }
}
