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

/// Number of draws of uncertain keys, where one is given.
///
/// # Errors
/// [`SettingError`] for a number out of range.
pub fn uncertainty_samples(asked: Option<usize>) -> Result<Option<usize>, SettingError> {
    count(Setting::UncertaintySamples, asked)
}

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
fn count(setting: Setting, count: Option<usize>) -> Result<Option<usize>, SettingError> {
    match (count, setting.range()) {
        (Some(count), Range::Count(least, most)) if !(least..=most).contains(&count) => {
            Err(SettingError { setting, value: count.to_string() })
        }
        (given, _) => Ok(given),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use quasirigid::dynamics::{Form, Method};
    use quasirigid_io::model::{EvolveMethod, Target};

    use super::*;
    use crate::study::Study;

    const MODEL: &str = "[carrier]\nmass = 40.0\ncenter_of_mass = [0, 0, 0]\ninertia = [9, 13, 16]\n\
                         [[point]]\nname = \"tip\"\nmass = 1.0\nposition = [0.8, 0.3, 0.5]\n\
                         [[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 600.0\ndamping = 30.0\n\
                         [initial]\nangular_velocity = [1.2, 0.35, 0.2]\n";
    const RUN: &str = "[run]\nduration = 60\nform = \"angular-velocity\"\nverify = { revolutions = 2, orders = [0, 2] }\n\
                       evolve = { start = 0.9, samples = 7, method = \"levels\" }\nspin_manifold = { degree = 3 }\n";

    fn study(run: &str) -> Study {
        Study::read_from(Path::new("model.toml"), format!("{MODEL}{run}").as_bytes(), None).expect("a model")
    }

    #[test]
    fn what_is_asked_goes_before_the_file_and_the_file_before_the_default() {
        let (plain, study) = (study(""), study(RUN));
        let asked =
            PartialRun { duration: Some(5.0), integrator: Some(Method::Implicit), ..PartialRun::default() };
        let run = RunSettings::resolve(&asked, &study).expect("settings");
        assert_eq!(
            (run.duration, run.form, run.integrator),
            (Some(5.0), Form::AngularVelocity, Method::Implicit)
        );
        let run = RunSettings::resolve(&PartialRun::default(), &plain).expect("settings");
        assert_eq!(
            (run.duration, run.form, run.integrator),
            (None, Form::AngularMomentum, Method::Automatic)
        );

        let asked = PartialEvolve { samples: Some(9), ..PartialEvolve::default() };
        let evolve = EvolveSettings::resolve(asked, &study).expect("settings");
        assert_eq!((evolve.start, evolve.samples), (Some(Target::Ratio(0.9)), 9));
        assert_eq!(evolve.method, Some(EvolveMethod::Levels));
        let evolve = EvolveSettings::resolve(PartialEvolve::default(), &plain).expect("settings");
        assert_eq!((evolve.start, evolve.samples, evolve.method), (None, 201, None));

        let degree = |degree, study| {
            let asked = PartialSpinManifold { degree, ..PartialSpinManifold::default() };
            SpinManifoldSettings::resolve(asked, None, study).map(|settings| settings.degree)
        };
        assert_eq!(
            [degree(Some(7), &study), degree(None, &study), degree(None, &plain)],
            [Ok(7), Ok(3), Ok(5)]
        );

        let asked = PartialVerify { halvings: Some(2), ..PartialVerify::default() };
        let plan = study.verification_plan(asked);
        assert_eq!((plan.rotations, plan.orders, plan.halvings), (2.0, vec![0, 2], 2));
    }

    #[test]
    fn a_setting_out_of_range_is_told_by_the_name_of_the_interface() {
        let study = study("");
        let rows = |samples| PartialEvolve { samples: Some(samples), ..PartialEvolve::default() };
        assert!(EvolveSettings::resolve(rows(MAX_ROWS), &study).is_ok());
        let error = EvolveSettings::resolve(rows(MAX_ROWS + 1), &study).expect_err("one row too many");
        assert_eq!(error.told(&Setting::flag), "--samples 10000001 is out of range; give 2 to 10000000");
        assert_eq!(error.to_string(), "evolve.samples 10000001 is out of range; give 2 to 10000000");
        let error = uncertainty_samples(Some(1)).expect_err("one draw");
        assert_eq!(error.told(&Setting::name), "uncertainty_samples 1 is out of range; give 2 to 10000000");
        let endless = PartialRun { duration: Some(f64::INFINITY), ..PartialRun::default() };
        let error = RunSettings::resolve(&endless, &study).expect_err("an endless history");
        assert_eq!(
            error.to_string(),
            "[run] duration inf s is not a duration; give one above zero, such as \"2 h\""
        );
    }
}
