//! Errors of a study in words.

use quasirigid::averaging::Unaveraged;
use quasirigid::dynamics::PropagateError;
use quasirigid::reduction::{ReductionError, ValidityError};
use quasirigid::verification::VerificationError;
use quasirigid_io::model::{ChangeError, ModelError};
use quasirigid_io::record::RecordError;
use quasirigid_math::eigen::NoConvergence;

use super::StudyError;
use crate::settings::{Setting, SettingError};
use crate::words::{significant, time};

/// Modes listed where one asked for is not there.
const LISTED_MODES: usize = 6;

impl StudyError {
    /// The text, with the names that an interface has for settings.
    #[must_use]
    pub fn told(&self, name: &dyn Fn(Setting) -> &'static str) -> String {
        match self {
            Self::Model(cause) => cause.to_string(),
            Self::Reduction(ReductionError::Hung { coordinates }) => format!(
                "no spring restores {coordinates}: without stiffness at rest there is no slow manifold in powers of the angular velocity, and no reduced equations; follow the body with {} full, ask for the modes or for the reduced equations about a steady spin, or give the hinge a `stiffness`",
                name(Setting::System)
            ),
            Self::Reduction(cause) => cause.to_string(),
            Self::Validity(cause) => cause.to_string(),
            Self::Vibration(cause) => cause.to_string(),
            Self::Propagate(cause) => cause.to_string(),
            Self::Verification(VerificationError::NoSlowManifold { spin }) => format!(
                "there is no slow manifold to start on at {} rad/s: the truncated series is not small there; lower the spin, or raise the stiffness of springs and the friction of rotors and liquids",
                significant(*spin, 3)
            ),
            Self::Verification(cause) => cause.to_string(),
            Self::Record(cause) => cause.to_string(),
            Self::FreeRotation(cause) => cause.to_string(),
            Self::Unaveraged(cause) => format!("{cause} (kinds \"spin-drag\", \"torque\" and \"eddy-current\")"),
            Self::NoSpin { file } => format!(
                "{}: the model has no initial spin; add a table such as\n\n    [initial]\n    angular_velocity = [0.0, 0.1, 1.0]   # rad/s, body axes\n",
                file.display()
            ),
            Self::Observed { file, cause } => format!("{}: [initial] periods: {cause}", file.display()),
            Self::Turned { file, cause } => format!("{}: [initial]: {cause}", file.display()),
            Self::NoWobble { file, cause } => format!("{}: [initial] `wobble`: {cause}", file.display()),
            Self::NoStart(cause) => format!(
                "the start: {cause}; there is no slow manifold at this spin; give [initial] displacements = \"rest\", or numbers"
            ),
            Self::Linear(cause) => cause.to_string(),
            Self::Cantilever(cause) => cause.to_string(),
            Self::NothingHeld => {
                "the body has no carrier that could be held: it has free modes alone, those of `modes`".into()
            }
            Self::NoChannel { name, expected } => {
                format!("{name:?} is no input or output here; give {expected}")
            }
            Self::Change(cause) => cause.to_string(),
            Self::NoNumber { key } => {
                format!("`{key}` is no number of the model; name a key whose value is a number, with a unit or without")
            }
            Self::NoQuantity { name, reason } => format!("there is no value of `{name}` to differentiate: {reason}"),
            Self::Uncertified { reason } => format!("this answer has no certificate: {reason}"),
            Self::Infer { problem } | Self::FillMap { problem } | Self::LightCurve { problem } | Self::Yorp { problem } => {
                problem.clone()
            }
            Self::Threads { threads, cause } => format!("{threads} threads cannot be started: {cause}"),
            Self::Truncation(cause) => cause.to_string(),
            Self::Step(cause) => cause.to_string(),
            Self::TruncatedAgain => {
                "the model is truncated already, and its bound is that from the whole one; truncate the whole model".into()
            }
            Self::NoBand { low, high } => {
                format!(
                    "{low} to {high} rad/s is no band of frequencies; give two positive numbers, the smaller first"
                )
            }
            Self::NotExported { what } => what.clone(),
            Self::Controlled { names, what } => format!(
                "{what} leaves out the controllers of the model ({}); follow it by `simulate` with {} full or rigid, ask `linear` for the closed loop and its poles, or take [[controller]] out",
                names.join(", "),
                name(Setting::System)
            ),
            Self::Remembering { names, what } => format!(
                "{what} leaves out the hysteresis rods of the model ({}), whose magnetisation depends on the past; follow it by `simulate` with {} full or rigid, or take [[rod]] out",
                names.join(", "),
                name(Setting::System)
            ),
            Self::Sliding { names, what } => format!(
                "{what}: no spring restores the liquid that slides along the ring of tank {}, and its friction is not linear, so that there is no such answer; follow the body with {} full, or ask `modes` for small motions about a steady spin",
                names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", "),
                name(Setting::System)
            ),
            Self::Driven { names, what } => format!(
                "{what}: {} a law over time, and such a body has no state of rest and no steady spin to answer for; follow it by `simulate` with {} full, or lock the part: `angle` or `length` = a number",
                match names.as_slice() {
                    [name] => format!("{name:?} follows"),
                    names => format!("{} follow", names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")),
                },
                name(Setting::System)
            ),
            Self::Drive { name, fault } => format!("the law that drives {name:?} {fault}"),
            Self::NotLinear { name, what } => format!("controller {name:?}: {what}"),
            Self::NoSlowSeries { spin } => format!(
                "rotors and liquids do not follow the spin, {} rad/s: friction or stiffness is too small, the slow series does not hold, and the reduced equations do not hold; follow the body with {} full, where they start at rest in it, or a rotor at the `speed` given in [[rotor]]",
                significant(*spin, 3),
                name(Setting::System)
            ),
            Self::Nutation { angle } => format!(
                "the angle of nutation (wobble) must lie between 0 and 90 degrees, not {}",
                significant(angle.to_degrees(), 6)
            ),
            Self::Extreme { cause } => format!("at one end of the ranges of the materials: {cause}"),
            Self::AxisUnderForces => format!(
                "{} names a principal axis of a body that no moment acts on; under forces give {}, or nothing",
                name(Setting::Axis),
                name(Setting::Spin)
            ),
            Self::Write { path, cause } => format!("cannot write {}: {cause}", path.display()),
            Self::KeptRun { folder, problem } => {
                format!("{}: {}", folder.display(), problem.replace("{resume}", name(Setting::Resume)))
            }
            Self::Interrupted => "interrupted; the table is incomplete".into(),
            Self::Setting(cause) => cause.told(name),
            _ => {
                let others = self.of_histories(name).or_else(|| self.about_spin(name));
                others.unwrap_or_else(|| self.of_evolutions(name))
            }
        }
    }

    fn about_spin(&self, name: &dyn Fn(Setting) -> &'static str) -> Option<String> {
        Some(match self {
            Self::Submanifold(cause) => cause.to_string(),
            Self::ForcesAboutSpin { names } => {
                let which =
                    if names.is_empty() { "a support or a motor moves it".into() } else { names.join(", ") };
                format!(
                    "reduced equations about a spin are for a body without external forces ({which}); follow it with {} full",
                    name(Setting::System)
                )
            }
            Self::MiddleAxis { kind } => format!(
                "a spin about the axis of middle inertia has no {} to follow; take {} least or greatest",
                kind.nutation(),
                name(Setting::Axis)
            ),
            Self::EventsAboutSpin => format!(
                "the reduced equations about a spin support no events; leave out [run] stop, or take {} full",
                name(Setting::System)
            ),
            Self::SteadySpinBeyond { what } => format!(
                "no reduced equations about the spin, since in the steady spin {}",
                what.trim_end_matches(',')
            ),
            Self::NoMaster { frequency, modes, kind } => {
                let list = modes.iter().take(LISTED_MODES);
                let list = list.map(|(name, frequency)| format!("{name} {}", significant(*frequency, 5)));
                let list = list.collect::<Vec<_>>().join(", ");
                let known = if list.is_empty() {
                    "there are none".to_owned()
                } else {
                    format!("the next are {list}")
                };
                format!(
                    "no mode about this spin beside the {} has a frequency near {} rad/s; {known}",
                    kind.nutation(),
                    significant(*frequency, 5)
                )
            }
            _ => return None,
        })
    }

    fn of_histories(&self, name: &dyn Fn(Setting) -> &'static str) -> Option<String> {
        let (duration, samples) = (name(Setting::Duration), name(Setting::Samples));
        Some(match self {
            Self::RestWithoutDuration => format!(
                "the body starts from rest, so there are no revolutions to count the time by; give {duration}, such as \"2 h\""
            ),
            Self::WithinARevolution { duration, revolution } => format!(
                "{} {} s ends within the first revolution, {}, and a secular evolution is a mean over revolutions; ask for more, or \
                 follow the motion itself with simulate",
                name(Setting::EvolutionDuration),
                significant(*duration, 4),
                time(*revolution)
            ),
            Self::History { samples: rows, cause } => {
                format!("{rows} rows: {cause}; ask for fewer with {samples}")
            }
            Self::NoCoordinates { setting } => {
                let (asked, system) = (name(*setting), name(Setting::System));
                format!(
                    "{asked}: the rigid body has no internal coordinates; take {system} reduced or {system} full"
                )
            }
            Self::SpinsAlone { forces: true } => {
                "forces act on the body, which need its attitude; follow its histories by simulate".into()
            }
            Self::SpinsAlone { forces: false } => {
                "the file ends its histories at an event (stop in [run]); follow them by simulate, or take the key out".into()
            }
            _ => return None,
        })
    }

    fn of_evolutions(&self, name: &dyn Fn(Setting) -> &'static str) -> String {
        let (from, until) = (name(Setting::Start), name(Setting::Until));
        match self {
            Self::NoRotationState { ratio, least } => format!(
                "no rotation of this body has D/I3 = {ratio}: it lies between {least:.6}, a spin about the axis of least inertia, and 1, one about that of greatest, and both limits are steady spins"
            ),
            Self::Steady => format!(
                "the body starts in a steady spin, from which nothing evolves by itself; if it is unstable, as `modes` tells, the least disturbance grows: give [initial] `wobble`, or choose another start with {from}"
            ),
            Self::EqualMoments { moment } => format!(
                "the three principal moments of this body are equal, {} kg m^2: every spin is steady, and there is nothing to follow",
                significant(*moment, 6)
            ),
            Self::NoAxes { moment } => format!(
                "the three principal moments of this body are equal, {} kg m^2, so that its spin has no axis of its own, and a torque fixed in the body, or a magnetic `tensor` that differs from axis to axis, has no average; `simulate` follows it",
                significant(*moment, 6)
            ),
            Self::FastEddyCurrents { rate, against, of_field } => {
                let what = if *of_field {
                    "the slowest rate of the magnetic field: of the orbit, of the dipole, or of the difference of their harmonics, which is slow in a resonance"
                } else {
                    "the angular velocity of the body"
                };
                format!(
                    "the eddy currents change the rotation at up to {} 1/s, and an average needs that to be a tenth of {} rad/s at most, {what}; `simulate` follows them without an average",
                    significant(*rate, 3),
                    significant(*against, 3)
                )
            }
            Self::Engulfed { name, size, nearest } => format!(
                "the force {name:?}: the orbit comes to {} m from the centre of attraction, within the body itself, which reaches to {} m; distances are in metres without a unit, as \"38000 km\" with one",
                significant(*nearest, 4),
                significant(*size, 4)
            ),
            Self::SkinEffect { name, spin, share, fastest } => format!(
                "the force {name:?}: at {} rad/s the currents' own field lowers the torque by {} %, which is left out; with this `conductivity` and shape it holds up to {} rad/s; lower the spin, or give a `tensor` that was measured at it",
                significant(*spin, 3),
                significant(100.0 * share, 2),
                significant(*fastest, 3)
            ),
            Self::AtRest => {
                "the body does not turn, so there is no rotation to follow; give [initial] an angular velocity".into()
            }
            Self::BoundlessSpin => {
                "the energy of the rotation is beyond the range of numbers; give [initial] a slower spin".into()
            }
            Self::NoShortAxis { moments: [_, middle, greatest] } => format!(
                "this body has no axis of greatest inertia from which an angle could be measured: its two greatest moments are equal, {} and {} kg m^2; say how far to go by D/I3, such as {until} 0.9",
                significant(*middle, 6),
                significant(*greatest, 6)
            ),
            Self::Backwards { from: start, to } => format!(
                "dissipation only raises D/I3, and the target {to} lies below the start, {start}; choose a higher one with {until}, or an earlier start with {from}"
            ),
            Self::Calmer { from: start, to, kind } => format!(
                "dissipation only lowers the {}, and that at the start, {} degrees, is smaller than the target, {} degrees; choose a smaller one with {until}, or an earlier start with {from}",
                kind.nutation(),
                significant(start.to_degrees(), 3),
                significant(to.to_degrees(), 3)
            ),
            Self::NoEvolutionDuration => format!(
                "under a torque the rotation need not reach any target; say how long to follow it, with {}",
                Setting::EvolutionDuration.or_in_file(name)
            ),
            Self::DrivenPole => {
                "the pole of this body is driven, so its rotation is not free; evolve follows free bodies and fixed points".into()
            }
            Self::Wheels { what } => format!("the evolution of a body with momentum wheels: {what}"),
            _ => String::new(),
        }
    }
}

macro_rules! causes {
    ($($variant:ident: $cause:ty),+ $(,)?) => {
        $(impl From<$cause> for StudyError {
            fn from(cause: $cause) -> Self {
                Self::$variant(cause)
            }
        })+
    };
}

causes! {
    Model: ModelError,
    Change: ChangeError,
    Reduction: ReductionError,
    Validity: ValidityError,
    Vibration: NoConvergence,
    Propagate: PropagateError,
    Verification: VerificationError,
    Record: RecordError,
    Unaveraged: Unaveraged,
    Setting: SettingError,
}
