//! Events that end a propagation: functions that change their sign, located by bisection of the dense output.
//! The bisection goes to the rounding of time, so that an end does not depend on the steps; a function that crosses twice within one step
//! is not seen.
//! "Events", docs/theory/08-full-system.md; the limit of validity is (V4), docs/theory/04-validity.md.

use std::f64::consts::PI;

use super::Sample;
use crate::math::ode::Checkpoint;
use crate::math::rotation::angle;
use crate::math::vec3::norm;

/// Event that ends a propagation.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// The energy passes this value (J).
    Energy(f64),
    /// The angle between the angular momentum and an axis of the body passes this value.
    Nutation {
        /// Axis, body axes.
        axis: [f64; 3],
        /// Angle (rad).
        angle: f64,
    },
    /// The angular velocity leaves the range of validity.
    Validity {
        /// Slowest elastic frequency (rad/s).
        slowest: f64,
        /// Largest `|ω|/Ω_min`.
        limit: f64,
    },
}

impl Event {
    /// True if the event can happen at all.
    pub(super) fn possible(&self) -> bool {
        match *self {
            Self::Energy(energy) => energy.is_finite(),
            Self::Nutation { axis, angle } => {
                let size = norm(axis);
                size > 0.0 && size.is_finite() && (0.0..=PI).contains(&angle)
            }
            Self::Validity { slowest, limit } => slowest > 0.0 && limit > 0.0 && limit.is_finite(),
        }
    }

    /// Event function: changes its sign when the event happens.
    fn level(&self, sample: &Sample) -> f64 {
        match self {
            Self::Energy(energy) => sample.energy - energy,
            Self::Nutation { axis, angle: wanted } => angle(sample.angular_momentum, *axis) - wanted,
            Self::Validity { slowest, limit } => norm(sample.omega) / slowest - limit,
        }
    }
}

/// Detector of events from step to step.
#[derive(Clone, Debug, Default)]
pub(super) struct EventDetector {
    events: Vec<Event>,
    levels: Vec<f64>,
    /// Time that the levels belong to.
    t: f64,
    /// Event that ended the propagation.
    pub triggered: Option<Event>,
}

/// Halvings of a step that contains an event: to the rounding of its time.
const HALVINGS: usize = 52;

impl EventDetector {
    pub fn new(events: &[Event]) -> Self {
        Self { events: events.to_vec(), ..Self::default() }
    }

    /// Saves the levels at the last step.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save(self.t);
        checkpoint.save_list(&self.levels);
    }

    /// Loads saved levels; none of other events.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.t = checkpoint.load()?;
        checkpoint.load_into(&mut self.levels)
    }

    /// True if no event is watched for.
    pub fn idle(&self) -> bool {
        self.events.is_empty()
    }

    /// Takes the levels at the start.
    pub fn set(&mut self, start: &Sample) {
        self.t = start.t;
        self.levels = self.events.iter().map(|event| event.level(start)).collect();
    }

    /// Time of the first event in the step that ends with this sample. `at` is asked for samples within the step only if an event
    /// happened.
    pub fn check(&mut self, end: &Sample, mut at: impl FnMut(f64) -> Sample) -> Option<f64> {
        let mut first: Option<(f64, Event)> = None;
        for (event, before) in self.events.iter().zip(&mut self.levels) {
            let after = event.level(end);
            if *before != 0.0 && (after > 0.0) != (*before > 0.0) {
                let (mut low, mut high) = (self.t, end.t);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    let same = (event.level(&at(middle)) > 0.0) == (*before > 0.0);
                    if same { low = middle } else { high = middle }
                }
                if first.is_none_or(|(t, _)| high < t) {
                    first = Some((high, *event));
                }
            }
            *before = after;
        }
        self.t = end.t;
        self.triggered = first.map(|(_, event)| event);
        first.map(|(t, _)| t)
    }
}
