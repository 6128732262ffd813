//! Settings of a user's questions: one name in the model file, on the command line and in Python, and one place where sources merge.
//!
//! Whoever asks gives partial settings, whose every field may be absent. What is absent is that of the model file; what the file lacks too
//! is the default. Interfaces parse and pass on; ranges are checked here.

mod evolve;
mod run;
mod spin_manifold;
mod table;
mod verify;

use std::fmt::{self, Display, Formatter};

pub use quasirigid_io::model::{MAX_ROWS, PartialEvolve, PartialRun, PartialSpinManifold, PartialVerify};

pub use evolve::EvolveSettings;
pub use run::RunSettings;
pub(crate) use spin_manifold::DEGREE;
pub use spin_manifold::SpinManifoldSettings;
pub use table::{Range, Setting};
pub use verify::PartialSpinVerify;

/// Setting out of its range. The text names it by its key; [`told`](Self::told) has other names.
#[derive(Clone, Debug, PartialEq)]
pub struct SettingError {
    /// The setting.
    pub setting: Setting,
    /// Its value, with its unit.
    pub value: String,
}

impl SettingError {
    /// The text, with the names that an interface has for settings.
    #[must_use]
    pub fn told(&self, name: &dyn Fn(Setting) -> &'static str) -> String {
        let Self { setting, value } = self;
        match setting {
            Setting::Duration => format!(
                "{} {value} is not a duration; give one above zero, such as \"2 h\"",
                name(Setting::Duration)
            ),
            Setting::EvolutionDuration => format!(
                "an evolution cannot be followed for {value}; give a time above zero with {}",
                Setting::EvolutionDuration.or_in_file(name)
            ),
            other => format!("{} {value} is out of range; give {}", name(*other), other.range()),
        }
    }
}

impl Display for SettingError {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.told(&Setting::key))
    }
}

impl std::error::Error for SettingError {}

/// A time (s) above zero, where one is given.
fn time(setting: Setting, seconds: Option<f64>) -> Result<Option<f64>, SettingError> {
    match seconds {
        Some(seconds) if !(seconds > 0.0 && seconds.is_finite()) => {
            Err(SettingError { setting, value: format!("{seconds} s") })
        }
        given => Ok(given),
    }
}

/// A count in the range of its setting, where one is given.
pub(crate) fn count(setting: Setting, count: Option<usize>) -> Result<Option<usize>, SettingError> {
    match (count, setting.range()) {
        (Some(count), Range::Count(least, most)) if !(least..=most).contains(&count) => {
            Err(SettingError { setting, value: count.to_string() })
        }
        (given, _) => Ok(given),
    }
}
