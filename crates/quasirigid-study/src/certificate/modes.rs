//! Certificate of modes: the matrices of the small motions, eigenvalues and shapes.
//! Equations (M1) to (M4), docs/theory/15-modes.md.

use quasirigid::model::Rheology;
use quasirigid::modes::{Entries, ModeRange, SpinMatrices, SpinMode, SpinModes};
use serde::Serialize;
use serde_json::{Value, json};

use super::{Certificate, Content, refused};
use crate::error::StudyError;
use crate::modes::Modes;
use crate::study::Study;

/// Coordinates up to which matrices are stated: a checker in Python takes a minute.
const MOST: usize = 150;
/// Error of an eigenvalue, as a share of its size.
const EIGENVALUE: f64 = 1e-9;
/// Error of a decay rate, as a share of it.
const DECAY: f64 = 1e-6;
/// Error of a decay rate, as a share of it, of a body with materials: a light one follows from the balance of energy, (M4), in which the
/// frequency stands for the eigenvalue.
const LIGHT_DECAY: f64 = 2e-5;
/// Error of a shape, as a share of its length with every unknown in units of equal energy.
const SHAPE: f64 = 1e-8;
/// Error of the balances of the steady spin, as a share of their largest term.
const STEADY: f64 = 1e-9;

/// A steady spin with its matrices and modes.
#[derive(Serialize)]
struct Spin {
    about: String,
    omega: [f64; 3],
    angular_momentum: [f64; 3],
    wheels: [f64; 3],
    energy: f64,
    stable: bool,
    /// Whether the modes are all that there are.
    complete: bool,
    displacements: Vec<f64>,
    unknowns: Vec<String>,
    inertia: [[f64; 3]; 3],
    h: Vec<[f64; 3]>,
    slopes: Vec<[f64; 3]>,
    mass: Entries,
    damping: Entries,
    gyroscopic: Entries,
    stiffness: Entries,
    centrifugal: Entries,
    materials: Vec<Material>,
    modes: Vec<Mode>,
}

/// Law of a material and its part of the stiffness.
#[derive(Serialize)]
struct Material {
    law: Value,
    stiffness: Entries,
}

/// A mode, with the shape that the equations multiply.
#[derive(Serialize)]
struct Mode {
    name: String,
    neutral: bool,
    decay_rate: f64,
    frequency: f64,
    time_constant: Option<f64>,
    omega: [[f64; 2]; 3],
    shape: Vec<[f64; 2]>,
    /// Entries `λ a·Z b` of liquids at this eigenvalue: row, column, real and imaginary part.
    liquids: Vec<(usize, usize, f64, f64)>,
}

impl Study {
    /// Certificate of modes that were found.
    ///
    /// # Errors
    /// [`StudyError::Uncertified`] under forces, where a steady spin was not found, and of a body of many coordinates.
    pub fn certify_modes(&self, modes: &Modes) -> Result<Certificate, StudyError> {
        if modes.under_forces {
            return Err(refused(
                "a steady state under forces has none: its equations hold derivatives of the forces, which a checker cannot rebuild",
            ));
        }
        let coordinates = self.body.coordinates().len();
        if coordinates > MOST {
            return Err(refused(format!(
                "it states whole matrices, of up to {MOST} coordinates, and this body has {coordinates}"
            )));
        }
        if self.body.advections().iter().next().is_some() {
            return Err(refused(
                "matter that flows through the body is in its equations, which a checker does not know",
            ));
        }
        let found: Option<Vec<&SpinModes>> = modes.solved.iter().map(Option::as_ref).collect();
        let (true, Some(found)) = (modes.found(), found) else {
            return Err(refused(
                "a steady spin was not found, and of nothing there is no certificate; ask for the other with --axis",
            ));
        };
        let spins: Vec<Spin> = found
            .iter()
            .zip(&modes.spins)
            .map(|(found, record)| self.stated(found, &record.axis, record.stable))
            .collect();
        let complete = spins.iter().all(|spin| spin.complete);
        let liquids = spins.iter().any(|spin| spin.modes.iter().any(|mode| !mode.liquids.is_empty()));
        self.certified(Content {
            of: "modes",
            claims: claims(complete),
            not_claimed: not_claimed(complete, liquids),
            tolerances: json!({ "eigenvalue": EIGENVALUE, "decay": DECAY, "light_decay": LIGHT_DECAY, "shape": SHAPE, "steady": STEADY }),
            witness: ("spins", spins),
        })
    }

    fn stated(&self, found: &SpinModes, about: &str, stable: bool) -> Spin {
        let steady = &found.equilibrium;
        let matrices = SpinMatrices::about(&self.body, steady);
        let modes = found.modes.iter().map(|mode| of(mode, &matrices)).collect();
        let materials = matrices.materials.iter();
        Spin {
            about: about.to_owned(),
            omega: steady.omega,
            angular_momentum: steady.angular_momentum,
            wheels: self.body.wheels().angular_momentum(0.0),
            energy: steady.energy,
            stable,
            complete: found.range == ModeRange::All && !matrices.nonlinear(),
            displacements: matrices.coordinates.iter().map(|j| j.map_or(0.0, |j| steady.q[j])).collect(),
            materials: materials
                .map(|(rheology, stiffness)| Material { law: law(rheology), stiffness: stiffness.clone() })
                .collect(),
            unknowns: matrices.names,
            inertia: matrices.inertia,
            h: matrices.h,
            slopes: matrices.slopes,
            mass: matrices.mass,
            damping: matrices.damping,
            gyroscopic: matrices.gyroscopic,
            stiffness: matrices.stiffness,
            centrifugal: matrices.centrifugal,
            modes,
        }
    }
}

fn of(mode: &SpinMode, matrices: &SpinMatrices) -> Mode {
    let lambda = [-mode.decay_rate, mode.frequency];
    let liquids = matrices.impedances(lambda).into_iter().filter(|(.., entry)| *entry != [0.0; 2]);
    Mode {
        name: mode.name.clone(),
        neutral: mode.neutral,
        decay_rate: mode.decay_rate,
        frequency: mode.frequency,
        time_constant: Some(mode.time_constant()).filter(|time| time.is_finite()),
        omega: mode.omega,
        shape: matrices.coordinates.iter().map(|j| j.map_or([0.0; 2], |j| mode.shape[j])).collect(),
        liquids: liquids.map(|(row, column, [re, im])| (row, column, re, im)).collect(),
    }
}

/// Law of a material, in the words of the model file. (G1)
fn law(rheology: &Rheology) -> Value {
    match rheology {
        Rheology::Elastic => json!({ "kind": "elastic" }),
        Rheology::KelvinVoigt { time } => json!({ "kind": "kelvin-voigt", "time": time }),
        Rheology::QualityFactor { factor } => json!({ "kind": "quality-factor", "Q": factor }),
        Rheology::Maxwell { time } => json!({ "kind": "maxwell", "time": time }),
        Rheology::StandardLinear { time, strength } => {
            json!({ "kind": "standard-linear", "time": time, "strength": strength })
        }
        Rheology::Andrade { time, creep_time, exponent } => {
            json!({ "kind": "andrade", "time": time, "creep_time": creep_time, "exponent": exponent })
        }
        Rheology::Table(measured) => {
            json!({ "kind": "table", "rows": Vec::<[f64; 3]>::from(measured.clone()) })
        }
    }
}

fn claims(complete: bool) -> Vec<String> {
    let mut claims = vec![
        "each spin is steady: the angular momentum is along it, and every coordinate is in balance".to_owned(),
        "each mode that is not neutral solves the equation of small motions about its spin, with its decay rate, frequency and time constant".to_owned(),
        "a spin is stable if no mode of it that is stated grows".to_owned(),
    ];
    if complete {
        claims
            .push("of each spin every mode is stated: the neutral ones have the eigenvalue zero".to_owned());
    }
    claims
}

fn not_claimed(complete: bool, liquids: bool) -> Vec<String> {
    let mut rest = vec![
        "that the matrices are those of the model, beyond what the checker rebuilds from its text and says"
            .to_owned(),
        "that the spin has the angular momentum of the start".to_owned(),
        "which mode is the nutation, names, shares of the kinetic energy and shares of the dissipation"
            .to_owned(),
    ];
    if !complete {
        rest.push("that no mode is missing".to_owned());
    }
    if liquids {
        rest.push("the impedances of liquids, which are stated at each eigenvalue".to_owned());
    }
    rest
}
