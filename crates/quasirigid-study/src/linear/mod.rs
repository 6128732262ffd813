//! Linear models that a user asks for: the steady state, inputs and outputs by name, and the matrices between them.
//! Equations (M16), (M17) and (M21) to (M23), docs/theory/15-modes.md.

mod channels;
mod closed_loop;
mod object;
mod steady_field;
mod truncation;

use quasirigid::model::Marker;
use quasirigid::model::control::Controls;
use quasirigid::model::force::Force;
use quasirigid::modes::{LinearModel, SpinMagnitude, SteadyState, acts};
use quasirigid_math::vec3::norm;

pub use object::{AccuracyObject, Channel, EquilibriumObject, LinearObject};
pub use truncation::{LinearTruncation, TruncationObject, truncation_method};

use self::channels::{AXES, no_channel, unit_of_input};
use self::closed_loop::{Asked, Loop, poles};
use crate::error::StudyError;
use crate::left_out::LeftOut;
use crate::modes::of_start;
use crate::study::Study;
use crate::words::{plain, significant};
use crate::{steady, steady_state};

/// Steady state that a linear model is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinearAt {
    /// Rest, or the state of rest under the forces.
    Rest,
    /// The steady spin next to the start, or the steady state under the forces.
    Spin,
    /// The steady spin next to an angular velocity (rad/s, body axes), with its size.
    Rate([f64; 3]),
}

impl LinearAt {
    /// The state of a word, `rest` or `spin`.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        match word {
            "rest" => Some(Self::Rest),
            "spin" => Some(Self::Spin),
            _ => None,
        }
    }
}

/// Settings of a linear model.
#[derive(Clone, Debug, Default)]
pub struct LinearSettings {
    /// Steady state; that next to the start by default, rest where the start has no spin.
    pub at: Option<LinearAt>,
    /// Names of the inputs; torques on the carrier if empty.
    pub inputs: Vec<String>,
    /// Names of the outputs; angular velocities of the carrier if empty.
    pub outputs: Vec<String>,
    /// Frequencies (rad/s) between which materials and liquids are met; those of the body's own rates by default.
    pub band: Option<[f64; 2]>,
    /// Truncation; all states are kept by default.
    pub truncation: Option<LinearTruncation>,
}

impl Study {
    /// Linear model of the small motions about a steady state, between inputs and outputs. (M16)
    ///
    /// # Errors
    /// [`StudyError::NoChannel`] for a name that is none, [`StudyError::Linear`] and [`StudyError::NoStart`] for bodies and states that
    /// have no linear model.
    pub fn linear(&self, asked: &LinearSettings) -> Result<LinearObject, StudyError> {
        let or = |given: &[String], usual: &str| {
            let usual = AXES.map(|axis| format!("{usual}.{axis}"));
            if given.is_empty() { usual.to_vec() } else { given.to_vec() }
        };
        let (ins, outs) = (or(&asked.inputs, "torque"), or(&asked.outputs, "rate"));
        for names in [&ins, &outs] {
            let mut places = names.iter().enumerate();
            if let Some((_, name)) = places.find(|(place, name)| names[..*place].contains(name)) {
                return Err(no_channel(name, "each name once"));
            }
        }
        if let Some([low, high]) =
            asked.band.filter(|[low, high]| !(0.0 < *low && low < high && high.is_finite()))
        {
            return Err(StudyError::NoBand { low, high });
        }
        self.without_rods("the linear model")?;
        self.undriven("the linear model")?;
        let inputs: Vec<_> = ins.iter().map(|name| self.input(name)).collect::<Result<_, _>>()?;
        let outputs: Vec<_> = outs.iter().map(|name| self.output(name, &ins)).collect::<Result<_, _>>()?;
        let (forces, sleeping) = steady_state::at_start(self);
        let mut state = self.state_of(asked.at, &forces)?;
        let (acts, in_field) = (acts(&self.body, &forces), self.controls.field.is_some());
        if in_field && !acts {
            state = state.in_attitude(self.model.initial.attitude);
        }
        let channels = Asked { names: &ins, outputs: outputs.len(), any_attitude: !acts && !in_field };
        let feedback = Loop::new(&self.controls, &state, &channels)?;
        let all = [&*inputs, &*feedback.inputs].concat();
        let seen = [&*outputs, &*feedback.outputs].concat();
        let names = [&*ins, &*feedback.names].concat();
        let found = LinearModel::about(&self.body, &forces, state, &all, &seen, asked.band);
        let mut model = found.map_err(StudyError::Linear)?;
        let of_controllers = feedback.close(&mut model, [inputs.len(), outputs.len()]);
        let poles = if self.controls.is_empty() { Vec::new() } else { poles(&model.A)? };
        let LinearModel { equilibrium, states, A, B, C, D, accuracy } = model;
        let of_controllers = of_controllers.into_iter().map(|name| Channel { name, unit: String::new() });
        let channels = |names: Vec<String>, units: Vec<&'static str>| {
            names.into_iter().zip(units).map(|(name, unit)| Channel { name, unit: unit.to_owned() }).collect()
        };
        let told: Vec<String> = [sentence(&equilibrium, &self.controls)]
            .into_iter()
            .chain(steady_state::asleep(&sleeping))
            .collect();
        let whole = LinearObject {
            name: self.model.name.clone(),
            sentence: told.join(" "),
            states: states.iter().map(|state| self.named(*state, &names)).chain(of_controllers).collect(),
            poles,
            accuracy: accuracy.map(AccuracyObject::from),
            wrong: LeftOut::at(self, equilibrium.omega, None).liquids,
            not_compared: self.not_compared(),
            inputs: channels(ins, inputs.iter().map(unit_of_input).collect()),
            outputs: channels(outs, outputs.iter().map(|output| self.unit_of_output(output)).collect()),
            equilibrium: self.equilibrium(&equilibrium),
            A,
            B,
            C,
            D,
            truncation: None,
            source: self.inputs(),
        };
        match asked.truncation {
            Some(how) => whole.truncated(how),
            None => Ok(whole),
        }
    }

    fn state_of(&self, at: Option<LinearAt>, forces: &[Force<Marker>]) -> Result<SteadyState, StudyError> {
        let body = &self.body;
        let rest = at.map_or_else(|| self.model.initial.rotation.is_none(), |at| at == LinearAt::Rest);
        if acts(body, forces) {
            let asked = match at {
                Some(LinearAt::Rate(omega)) => Some(omega),
                _ if rest => Some([0.0; 3]),
                _ => None,
            };
            let near = steady_state::near(self, asked)?;
            return SteadyState::near(body, forces, near).map_err(|cause| StudyError::Linear(cause.into()));
        }
        let spun = |omega: [f64; 3], given| {
            steady::beside(self, omega, given)
                .map(|spin| SteadyState::of_spin(&spin))
                .map_err(StudyError::NoStart)
        };
        match at {
            Some(LinearAt::Rate(omega)) if norm(omega) > 0.0 => spun(omega, SpinMagnitude::Rate(norm(omega))),
            Some(LinearAt::Rate(_)) => Ok(SteadyState::at_rest(body)),
            _ if rest => Ok(SteadyState::at_rest(body)),
            _ => {
                let (omega, given) = of_start(self)?;
                if norm(omega) > 0.0 { spun(omega, given) } else { Ok(SteadyState::at_rest(body)) }
            }
        }
    }

    /// Names of the liquids whose response is known at no frequency but the lowest.
    fn not_compared(&self) -> Vec<String> {
        let coordinates = self.body.coordinates();
        let known = |name: &str| {
            let liquids = self.body.memories().iter();
            liquids.map(|liquid| coordinates[liquid.coordinates.start].part()).any(|part| part == name)
        };
        let names = self.model.assembly.cavities.iter().map(|cavity| plain(&cavity.name));
        names.filter(|name| !known(name)).collect()
    }

    fn equilibrium(&self, state: &SteadyState) -> EquilibriumObject {
        let elastic = self.body.coordinates().iter().take(self.body.elastic());
        EquilibriumObject {
            spin: state.omega,
            momentum: state.angular_momentum,
            attitude: state.attitude,
            displacements: elastic
                .map(|coordinate| coordinate.name.clone())
                .zip(state.q.iter().copied())
                .collect(),
        }
    }
}

fn sentence(state: &SteadyState, controls: &Controls) -> String {
    let spin = norm(state.omega);
    let names: Vec<&str> = controls.controllers.iter().map(|controller| &*controller.name).collect();
    let closed = if names.is_empty() {
        String::new()
    } else {
        format!(" The loop is closed by the controllers ({}).", names.join(", "))
    };
    if spin == 0.0 {
        return format!("About rest.{closed}");
    }
    let [x, y, z] = state.omega.map(|entry| (1e4 * entry / spin).round() / 1e4 + 0.0);
    let size = significant(spin, 4);
    format!("About the steady spin of {size} rad/s about [{x:.4}, {y:.4}, {z:.4}].{closed}")
}
