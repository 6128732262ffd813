//! Arguments of Python as the settings of the study.
//! A time is a number of seconds or a text with its unit, a target a ratio or a text, as on the command line and in the model file.

use pyo3::prelude::*;
use quasirigid_io::model::{Named, Target, former_name};
use quasirigid_io::units::{Dimension, quantity};
use quasirigid_study::Setting;

use crate::failure::Failure;

/// A number, or a text with a unit.
#[derive(FromPyObject)]
pub enum Quantity {
    /// A number in SI units.
    Number(f64),
    /// A number with its unit, or a share.
    Text(String),
}

impl Quantity {
    /// A time (s); `name` is the argument.
    pub fn seconds(&self, name: &str) -> Result<f64, Failure> {
        match self {
            Self::Number(seconds) => Ok(*seconds),
            Self::Text(text) => quantity(text, Dimension::TIME)
                .map_err(|cause| Failure::Input(format!("{name} = {text:?}: {cause}; {}", cause.advice()))),
        }
    }

    /// A rotation state: the ratio `D/I₃`, or an angle; `name` is the argument.
    pub fn target(&self, name: &str) -> Result<Target, Failure> {
        let text = match self {
            Self::Number(ratio) => ratio.to_string(),
            Self::Text(text) => text.clone(),
        };
        text.parse().map_err(|cause: quasirigid_io::model::TargetError| {
            Failure::Input(format!("{name} = {text:?}: {cause}; {}", cause.advice()))
        })
    }
}

/// Warns of a former name, at the line of the user.
pub fn deprecated(note: &str) -> PyResult<()> {
    Python::attach(|py| {
        py.import("quasirigid._arguments")?.getattr("deprecated")?.call1((note,))?;
        Ok(())
    })
}

/// Former name of an argument, by its name of today; empty where it is the same.
#[pyfunction]
pub fn former_argument(name: &str) -> String {
    let setting = Setting::ALL.iter().find(|setting| setting.name() == name);
    setting.map_or("", |setting| setting.former()).replace('-', "_")
}

/// A setting that is one of a few; `name` is the argument.
pub fn named<T: Named>(text: Option<&str>, name: &str) -> Result<Option<T>, Failure> {
    let Some(text) = text else { return Ok(None) };
    if let Some(today) = T::renamed(text) {
        deprecated(&former_name(&format!("{name} = {text:?}"), &format!("{today:?}")))?;
    }
    T::of(text).map(Some).ok_or_else(|| {
        let known: Vec<String> = T::VALUES.iter().map(|(known, ..)| format!("{known:?}")).collect();
        Failure::Input(format!("{name} = {text:?} is not one of {}", known.join(", ")))
    })
}
