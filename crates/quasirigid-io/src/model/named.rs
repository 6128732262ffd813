//! Settings that are one of a few: their names, once for the model file, the command line and the record.

use quasirigid_body::{Form, Method};

use super::evolve::{EvolveMethod, Power};
use super::manifold::ManifoldStyle;
use super::settings::System;

/// A setting that is one of a few.
///
/// ```
/// use quasirigid_io::model::{Named, System};
///
/// assert_eq!(System::Reduced.name(), "reduced");
/// assert_eq!(System::of("full"), Some(System::Full));
/// ```
pub trait Named: Copy + PartialEq + Send + Sync + 'static {
    /// Every value: its name, the value, and its meaning where the name does not tell.
    const VALUES: &'static [(&'static str, Self, &'static str)];

    /// The name of a value.
    #[must_use]
    fn name(self) -> &'static str {
        Self::VALUES.iter().find(|(_, value, _)| *value == self).map_or("", |(name, ..)| name)
    }

    /// The value of a name.
    #[must_use]
    fn of(name: &str) -> Option<Self> {
        Self::VALUES.iter().find(|(known, ..)| *known == name).map(|(_, value, _)| *value)
    }
}

impl Named for Form {
    const VALUES: &'static [(&'static str, Self, &'static str)] =
        &[("momentum", Self::AngularMomentum, ""), ("paper", Self::AngularVelocity, "")];
}

impl Named for Method {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        (
            "automatic",
            Self::Automatic,
            "Explicit while vibrations have to be followed, implicit once they have died out",
        ),
        ("explicit", Self::Explicit, ""),
        ("implicit", Self::Implicit, ""),
    ];
}

impl Named for System {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("full", Self::Full, "The stiff equations with every internal coordinate"),
        ("reduced", Self::Reduced, "The reduced equations of the nearly rigid body"),
        ("rigid", Self::Rigid, "The body frozen in its equilibrium shape"),
        ("manifold", Self::Manifold, "The reduced equations about the steady spin"),
    ];
}

impl Named for ManifoldStyle {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("normal-form", Self::NormalForm, "Amplitudes separate from phases"),
        ("graph", Self::Graph, "Every monomial of the motion is kept"),
    ];
}

impl Named for Power {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("polynomial", Self::Polynomial, "The reduced equations, along the polhode"),
        (
            "harmonics",
            Self::Harmonics,
            "Every elastic mode and material, harmonic by harmonic: any law of loss, resonance too",
        ),
    ];
}

impl Named for EvolveMethod {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("average", Self::Average, "The mean power along the polhode of the frozen body"),
        ("micro-runs", Self::MicroRuns, "The mean power measured by short runs of the full system"),
        ("direct", Self::Direct, "The full system from start to end"),
        ("modes", Self::Modes, "The average at the rates of the modes about the steady spins"),
        ("manifold", Self::Manifold, "The reduced equations about the spin from start to end"),
    ];
}
