//! Settings that are one of a few: their names, once for the model file, the command line and the record.

use quasirigid_body::{Form, Method};

use super::evolve::{EvolveMethod, Power};
use super::settings::System;
use super::spin_manifold::ManifoldStyle;

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
    /// Former names: records keep them, and this version still takes them in place of those of today.
    const FORMER: &'static [(&'static str, Self)] = &[];

    /// The name of a value.
    #[must_use]
    fn name(self) -> &'static str {
        Self::VALUES.iter().find(|(_, value, _)| *value == self).map_or("", |(name, ..)| name)
    }

    /// The value of a name, of today or former.
    #[must_use]
    fn of(name: &str) -> Option<Self> {
        let today = Self::VALUES.iter().find(|(known, ..)| *known == name).map(|(_, value, _)| *value);
        today.or_else(|| former(name))
    }

    /// The name of today for a former one; none for a name of today.
    #[must_use]
    fn renamed(name: &str) -> Option<&'static str> {
        former::<Self>(name).map(Self::name)
    }

    /// The name of a value in records, a contract.
    #[must_use]
    fn recorded(self) -> &'static str {
        Self::FORMER.iter().find(|(_, value)| *value == self).map_or_else(|| self.name(), |(name, _)| name)
    }
}

fn former<T: Named>(name: &str) -> Option<T> {
    T::FORMER.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

/// Note on a former name that is used, which says the name of today.
#[must_use]
pub fn former_name(former: &str, today: &str) -> String {
    format!("{former} is now called {today}; this version takes the former name for the last time")
}

impl Named for Form {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("angular-momentum", Self::AngularMomentum, "Keeps |K| exactly"),
        ("angular-velocity", Self::AngularVelocity, "As in the paper"),
    ];
    const FORMER: &'static [(&'static str, Self)] =
        &[("momentum", Self::AngularMomentum), ("paper", Self::AngularVelocity)];
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
        ("spin-manifold", Self::SpinManifold, "The reduced equations about the steady spin"),
    ];
    const FORMER: &'static [(&'static str, Self)] = &[("manifold", Self::SpinManifold)];
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
        (
            "periodic-motions",
            Self::PeriodicMotions,
            "The mean power of periodic motions of the full system in body axes",
        ),
        ("micro-runs", Self::MicroRuns, "The mean power measured by short runs of the full system"),
        ("full", Self::Full, "The full system from start to end"),
        ("levels", Self::Levels, "The mean power along level curves of the slow energy of the deformed body"),
        ("modal-rates", Self::ModalRates, "The average at the rates of the modes about the steady spins"),
        ("spin-manifold", Self::SpinManifold, "The reduced equations about the spin from start to end"),
    ];
    const FORMER: &'static [(&'static str, Self)] =
        &[("direct", Self::Full), ("modes", Self::ModalRates), ("manifold", Self::SpinManifold)];
}
