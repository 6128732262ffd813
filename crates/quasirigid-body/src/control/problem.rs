//! What is wrong with a controller. (Y1)

use thiserror::Error;

use super::{ControlLaw, Controller, Measurement, Output};

/// Problem of a controller.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ControlProblem {
    /// A matrix has another size.
    #[error(
        "`{matrix}` must have {rows} rows of {columns} numbers, for the states, inputs and outputs of this controller"
    )]
    Size {
        /// The matrix.
        matrix: &'static str,
        /// Rows needed.
        rows: usize,
        /// Columns needed.
        columns: usize,
    },
    /// A matrix has an entry that is not finite.
    #[error("`{matrix}` has an entry that is not finite")]
    NotFinite {
        /// The matrix.
        matrix: &'static str,
    },
    /// A controller commands nothing.
    #[error("the controller commands nothing")]
    NoOutput,
    /// A value is negative or not finite.
    #[error("`{key}` is {value}; it must be finite and not negative")]
    Negative {
        /// Key of the value.
        key: &'static str,
        /// The value.
        value: f64,
    },
    /// A period or a limit is not positive.
    #[error("`{key}` is {value}; it must be positive")]
    NotPositive {
        /// Key of the value.
        key: &'static str,
        /// The value.
        value: f64,
    },
    /// A continuous controller has something that needs samples.
    #[error("`{key}` needs samples, and this controller is continuous")]
    Continuous {
        /// Key of the value.
        key: &'static str,
    },
    /// The delay holds too many samples.
    #[error("the delay of {delay} s holds more than {MOST_WAITING} periods of {period} s")]
    Waiting {
        /// Delay (s).
        delay: f64,
        /// Period (s).
        period: f64,
    },
    /// The target is no rotation.
    #[error("the target {target:?} is not a unit quaternion")]
    Target {
        /// Target.
        target: [f64; 4],
    },
    /// Two outputs command the same.
    #[error("the outputs command the same twice, and would add up")]
    Repeated,
    /// A controller or a rod senses a magnetic field, or acts by one, where there is none.
    #[error("it needs a magnetic field, and the model has none")]
    NoField,
    /// A controller measures relative to an orbit, and the model has none.
    #[error("it measures relative to an orbit, and the model has none")]
    NoOrbit,
    /// A controller measures relative to an orbit, and the model has several.
    #[error("it measures relative to an orbit, and the model has {count} that differ")]
    SeveralOrbits {
        /// Orbits that differ.
        count: usize,
    },
    /// A controller senses the Sun, and no force has one.
    #[error("it senses the Sun, and the model has none")]
    NoSun,
    /// Nothing has this name.
    #[error("there is no {what} {name:?}; there are {}", if known.is_empty() { "none" } else { known })]
    Unknown {
        /// Key that names it.
        key: &'static str,
        /// Kind of what is named.
        what: &'static str,
        /// Name.
        name: String,
        /// Some of the names that there are.
        known: String,
    },
}

/// Most samples that wait for their commands.
const MOST_WAITING: usize = 10_000;
/// Error of the size of a quaternion that is rounding of what a user writes.
const UNIT: f64 = 1e-6;

impl ControlProblem {
    /// Key of the model file that the problem is about.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Size { matrix, .. } | Self::NotFinite { matrix } => matrix,
            Self::NoOutput | Self::Repeated => "outputs",
            Self::NoField => "kind",
            Self::NoOrbit | Self::SeveralOrbits { .. } | Self::NoSun => "inputs",
            Self::Negative { key, .. } | Self::NotPositive { key, .. } | Self::Continuous { key } => key,
            Self::Waiting { .. } => "delay",
            Self::Target { .. } => "target",
            Self::Unknown { key, .. } => key,
        }
    }

    /// What to try, in the words of the model file; empty where the problem says it.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::NoOutput => "write outputs = [\"torque.x\"], or a torque",
            Self::Repeated => "name each torque, each wheel and each moment once",
            Self::NoField => {
                "add [magnetic_field] with field = [0, 0, \"30 uT\"], or with dipole or igrf and an orbit"
            }
            Self::NoOrbit => "add a force of central gravity, or [magnetic_field], with an `orbit`",
            Self::NoSun => "add a force of kind \"sunlight\"",
            Self::SeveralOrbits { .. } => "give every force and [magnetic_field] the same `orbit`",
            Self::Continuous { .. } => "give the controller a `period`, or leave the key out",
            Self::Waiting { .. } => "shorten the delay, or lengthen the period",
            Self::Target { .. } => "write a quaternion of norm 1, scalar first",
            Self::Negative { .. } | Self::NotPositive { .. } | Self::NotFinite { .. } => {
                "write a number that is"
            }
            Self::Size { .. } | Self::Unknown { .. } => "",
        }
    }
}

impl<P, C, W: PartialEq> Controller<P, C, W> {
    /// What is wrong with the controller by itself; none of one that can be.
    #[must_use]
    pub fn problem(&self) -> Option<ControlProblem> {
        if self.outputs.is_empty() {
            return Some(ControlProblem::NoOutput);
        }
        let earlier = |place: usize| self.outputs[..place].iter();
        let repeated =
            |(place, output): (usize, &Output<W>)| earlier(place).any(|other| other.to == output.to);
        if self.outputs.iter().enumerate().any(repeated) {
            return Some(ControlProblem::Repeated);
        }
        let law = || self.law.problem(self.inputs.len(), self.outputs.len());
        self.problem_of_sampling().or_else(|| self.problem_of_channels()).or_else(law)
    }

    fn problem_of_sampling(&self) -> Option<ControlProblem> {
        let Some(sampling) = self.sampling else {
            let of_samples = [
                ("kind", matches!(self.law, ControlLaw::Relay(_))),
                ("quantum", self.inputs.iter().any(|input| input.quantum != 0.0)),
                ("noise", self.inputs.iter().any(|input| input.noise != 0.0)),
            ];
            let found = of_samples.into_iter().find(|(_, given)| *given);
            return found.map(|(key, _)| ControlProblem::Continuous { key });
        };
        let super::Sampling { period, delay, .. } = sampling;
        if !(period > 0.0 && period.is_finite()) {
            return Some(ControlProblem::NotPositive { key: "period", value: period });
        }
        if !(delay >= 0.0 && delay.is_finite()) {
            return Some(ControlProblem::Negative { key: "delay", value: delay });
        }
        (delay > period * MOST_WAITING as f64).then_some(ControlProblem::Waiting { delay, period })
    }

    fn problem_of_channels(&self) -> Option<ControlProblem> {
        let wrong = |(key, value): (&'static str, f64)| {
            (!(value >= 0.0 && value.is_finite())).then_some(ControlProblem::Negative { key, value })
        };
        let targets = self.inputs.iter().find_map(|input| {
            let Measurement::Attitude { target, .. } = input.of else { return None };
            let size = target.iter().map(|part| part * part).sum::<f64>();
            (!((size - 1.0).abs() <= UNIT)).then_some(ControlProblem::Target { target })
        });
        let mut limits = self.outputs.iter().filter_map(|output| output.limit);
        let limit = limits.find(|limit| !(*limit > 0.0 && limit.is_finite()));
        targets.or(limit.map(|value| ControlProblem::NotPositive { key: "saturation", value })).or_else(
            || {
                let mut own = self.inputs.iter().flat_map(|input| {
                    [("deadband", input.deadband), ("quantum", input.quantum), ("noise", input.noise)]
                });
                own.find_map(wrong)
            },
        )
    }
}
