//! Settings of the reduced equations about a steady spin.

use quasirigid::submanifold::{Masters, Style};
use quasirigid_io::model::{ManifoldMasters, ManifoldStyle, PartialSpinManifold};

use super::{Setting, SettingError, count};
use crate::modes::PrincipalAxis;
use crate::study::Study;

/// Degree without a given one.
pub(crate) const DEGREE: usize = 5;

/// Settings of the reduced equations about a steady spin.
#[derive(Clone, Debug, PartialEq)]
pub struct SpinManifoldSettings {
    /// Highest degree in the amplitude.
    pub degree: usize,
    /// Modes that the equations follow.
    pub masters: Masters,
    /// Style of the parametrisation.
    pub style: Style,
    /// Principal axis to spin about; none for the one that the start circles.
    pub axis: Option<PrincipalAxis>,
}

impl SpinManifoldSettings {
    /// Settings asked for, else those of the file, else the defaults.
    ///
    /// # Errors
    /// [`SettingError`] for a degree out of range.
    pub fn resolve(
        asked: PartialSpinManifold,
        axis: Option<PrincipalAxis>,
        study: &Study,
    ) -> Result<Self, SettingError> {
        let file = study.model.run.spin_manifold.clone().unwrap_or_default();
        let PartialSpinManifold { degree, masters, style } = asked.or(file);
        Ok(Self {
            degree: count(Setting::Degree, degree)?.unwrap_or(DEGREE),
            masters: match masters {
                None | Some(ManifoldMasters::Automatic) => Masters::Automatic,
                Some(ManifoldMasters::Nutation) => Masters::Nutation,
                Some(ManifoldMasters::With(frequencies)) => Masters::With(frequencies),
            },
            style: match style {
                None | Some(ManifoldStyle::NormalForm) => Style::NormalForm,
                Some(ManifoldStyle::Graph) => Style::Graph,
            },
            axis,
        })
    }
}
