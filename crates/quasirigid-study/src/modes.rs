//! Steady spins that a user asks for, with the modes about them.

use quasirigid::modes::{SpinMagnitude, SpinModes, acts};
use quasirigid_io::model::{BodyKind, Named, Rotation};
use quasirigid_io::record::SteadySpinRecord;
use quasirigid_math::vec3::norm;
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::layout::paragraph;
use crate::materials::flowing_at;
use crate::motion::Motion;
use crate::steady::Poles;
pub use crate::steady_state::SteadyStateObject;
use crate::study::Study;
use crate::{steady, steady_state};

/// A principal axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrincipalAxis {
    /// Axis of least inertia.
    Least,
    /// Axis of middle inertia.
    Middle,
    /// Axis of greatest inertia.
    Greatest,
}

impl PrincipalAxis {
    /// All of them, by ascending inertia.
    pub const ALL: [Self; 3] = [Self::Least, Self::Middle, Self::Greatest];
}

impl Named for PrincipalAxis {
    const VALUES: &'static [(&'static str, Self, &'static str)] =
        &[("least", Self::Least, ""), ("middle", Self::Middle, ""), ("greatest", Self::Greatest, "")];
}

/// Settings of steady spins; both poles with the angular momentum of the start by default.
#[derive(Clone, Copy, Debug, Default)]
pub struct SteadySpinSettings {
    /// An angular velocity (rad/s): the steady spin nearest to its direction, with its size.
    pub omega: Option<[f64; 3]>,
    /// The principal axis to spin about.
    pub axis: Option<PrincipalAxis>,
    /// Whether every mode of a body of many coordinates is found, not the slowest alone.
    pub all: bool,
}

/// Steady spins with their modes.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Kind of the body, for the words.
    pub(crate) kind: BodyKind,
    /// One record for each.
    pub spins: Vec<SteadySpinRecord>,
    /// Modes of each as they were solved; none under forces.
    pub(crate) solved: Vec<Option<SpinModes>>,
    /// Further results of the steady state under forces.
    pub state: Option<SteadyStateObject>,
    /// Whether the result is a steady state under forces.
    pub under_forces: bool,
    /// Material that is no solid in the rotation of the start, in words; none if every one is. (G16)
    pub no_solid: Option<String>,
    /// Names of the forces that do not act at the start, which the modes leave out.
    pub sleeping: Vec<String>,
}

/// Modes for machines; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Serialize)]
struct ModesObject<'a> {
    /// The first steady spin.
    #[serde(flatten)]
    spin: Option<&'a SteadySpinRecord>,
    /// Title of the model.
    name: &'a str,
    /// All of them.
    steady_spins: &'a [SteadySpinRecord],
    /// Under forces, or `null`.
    #[serde(skip_serializing_if = "Option::is_none")]
    steady_state: Option<Option<SteadyStateObject>>,
    /// Material that is no solid in the rotation of the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_solid: Option<&'a str>,
    /// Names of the forces that do not act at the start, and are left out.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    sleeping_forces: &'a [String],
}

impl Modes {
    /// For a terminal of 80 columns: every mode if asked for `all`, else the first dozen with overdamped ones folded into a line.
    #[must_use]
    pub fn text(&self, name: &str, all: bool) -> String {
        let warning = self
            .no_solid
            .as_ref()
            .map(|why| paragraph(&format!("{name}: NO SOLID: {why}."), "", "  ") + "\n");
        let asleep = steady_state::asleep(&self.sleeping).map(|said| paragraph(&said, "", "  ") + "\n");
        warning.unwrap_or_default()
            + &asleep.unwrap_or_default()
            + &steady::text(name, self.kind, &self.spins, all)
    }

    /// For machines.
    #[must_use]
    pub fn json(&self, name: &str) -> Value {
        json!(ModesObject {
            spin: self.spins.first(),
            name,
            steady_spins: &self.spins,
            steady_state: self.under_forces.then_some(self.state),
            no_solid: self.no_solid.as_deref(),
            sleeping_forces: &self.sleeping,
        })
    }

    /// Reason for which there is no steady spin next to the start; none if there is one.
    #[must_use]
    pub fn unfound(&self) -> Option<&str> {
        self.spins.first().filter(|spin| spin.spin.is_none()).map(|spin| spin.sentence.as_str())
    }

    /// Whether every steady spin was found, of a body whose materials are solids.
    #[must_use]
    pub fn found(&self) -> bool {
        self.no_solid.is_none() && self.spins.iter().all(|spin| spin.spin.is_some())
    }
}

impl Study {
    /// Finds steady spins, or the steady state under the forces, and the small motions about them.
    ///
    /// # Errors
    /// [`StudyError::AxisUnderForces`], and those of a start that is none.
    pub fn modes(&self, asked: SteadySpinSettings) -> Result<Modes, StudyError> {
        self.left_alone("modes")?;
        let body = &self.body;
        let (acting, sleeping) = steady_state::at_start(self);
        let under_forces = acts(body, &acting);
        let rests = asked.axis.is_none()
            && (asked.omega == Some([0.0; 3]) || asked.omega.is_none() && starts_from_rest(self));
        if under_forces && asked.axis.is_some() {
            return Err(StudyError::AxisUnderForces);
        }
        if under_forces || rests {
            let near = steady_state::near(self, asked.omega)?;
            let steady_state::Told { record, state } = steady_state::told(self, &acting, near);
            return Ok(Modes {
                kind: self.model.kind,
                spins: vec![record],
                solved: Vec::new(),
                state,
                under_forces: true,
                no_solid: None,
                sleeping,
            });
        }
        let (omega, given) = match asked.omega {
            Some(omega) => (omega, SpinMagnitude::Rate(norm(omega))),
            None => of_start(self)?,
        };
        let Poles { records: spins, modes: solved } = match (asked.axis, asked.omega) {
            (Some(axis), _) => steady::about_axis(self, axis, omega, given, asked.all),
            (None, Some(_)) => steady::spin(self, "asked", omega, given, asked.all),
            (None, None) => steady::poles(self, omega, given, asked.all),
        };
        let no_solid = flowing_at(self, omega);
        Ok(Modes {
            kind: self.model.kind,
            spins,
            solved,
            state: None,
            under_forces: false,
            no_solid,
            sleeping,
        })
    }
}

/// True if the file gives a body the angular velocity zero.
fn starts_from_rest(study: &Study) -> bool {
    matches!(study.model.initial.rotation, Some(Rotation::Spin(omega)) if omega == [0.0; 3])
}

/// The angular velocity (rad/s) of the start, and its angular momentum, or its rate if internal rotors and liquids take that up.
pub(crate) fn of_start(study: &Study) -> Result<([f64; 3], SpinMagnitude), StudyError> {
    let spin = study.initial()?;
    let angular_momentum = Motion::new(study, spin).angular_momentum()?;
    let given = if angular_momentum > 0.0 {
        SpinMagnitude::AngularMomentum(angular_momentum)
    } else {
        SpinMagnitude::Rate(norm(spin.omega))
    };
    Ok((spin.omega, given))
}
