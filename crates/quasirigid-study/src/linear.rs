//! Linear models that a user asks for: the steady state, inputs and outputs by name, and the matrices between them.
//! Equations (M16), (M17) and (M21), docs/theory/15-modes.md.

use std::collections::BTreeMap;

use quasirigid::model::control::Controls;
use quasirigid::model::force::Force;
use quasirigid::model::{Marker, Principal};
use quasirigid::modes::{
    LinearAccuracy, LinearInput, LinearModel, LinearOutput, LinearState, RelativeEquilibrium, SpinMagnitude,
    SteadyState, acts,
};
use quasirigid_io::array_file::{ArrayValue, NamedArray};
use quasirigid_io::record::InputsRecord;
use quasirigid_math::vec3::{add, norm, scale};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::closed_loop::{Loop, poles};
use crate::error::StudyError;
use crate::left_out::LeftOut;
use crate::modes::of_start;
use crate::steady_state;
use crate::study::Study;
use crate::words::significant;

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
}

/// Linear model with the names of its rows and columns; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct LinearObject {
    /// Title of the model.
    pub name: String,
    /// What the model is about, in words.
    pub sentence: String,
    /// The steady state.
    pub equilibrium: EquilibriumObject,
    /// States, in the order of the rows of `A`.
    pub states: Vec<Channel>,
    /// Inputs, in the order of the columns of `B`.
    pub inputs: Vec<Channel>,
    /// Outputs, in the order of the rows of `C`.
    pub outputs: Vec<Channel>,
    /// Poles of the closed loop (1/s), real and imaginary part, the least damped first; only of a model with controllers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub poles: Vec<[f64; 2]>,
    /// Rows of the matrix of the states.
    pub A: Vec<Vec<f64>>,
    /// Rows of the matrix of the inputs.
    pub B: Vec<Vec<f64>>,
    /// Rows of the matrix of the outputs.
    pub C: Vec<Vec<f64>>,
    /// Rows of the matrix from inputs to outputs.
    pub D: Vec<Vec<f64>>,
    /// Error by the states of materials and liquids with a memory; null where nothing has one.
    pub accuracy: Option<AccuracyObject>,
    /// Reason for which the equations of motion are not those of the body in this state; null where there is none.
    pub wrong: Option<String>,
    /// Liquids whose exact response is not known, so that the error does not contain theirs.
    pub not_compared: Vec<String>,
    /// What went in, as `inputs` of every other answer.
    pub source: InputsRecord,
}

/// Steady state of a linear model.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct EquilibriumObject {
    /// Angular velocity (rad/s), body axes.
    pub spin: [f64; 3],
    /// Angular momentum (N·m·s), body axes.
    pub momentum: [f64; 3],
    /// Quaternion from body to inertial axes, scalar first.
    pub attitude: [f64; 4],
    /// Displacements of the elastic coordinates, by name (m, rad).
    pub displacements: BTreeMap<String, f64>,
}

/// Error of a linear model.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct AccuracyObject {
    /// First and last frequency (rad/s) that it is told for.
    pub band: [f64; 2],
    /// Largest relative error of the angular velocities that torques on the carrier cause; null where the exact response is not known.
    pub error: Option<f64>,
    /// Frequency (rad/s) of that error.
    pub frequency: f64,
}

/// State, input or output of a linear model.
#[derive(Clone, Debug, Deserialize, PartialEq, Eq, Serialize)]
pub struct Channel {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: String,
}

const AXES: [&str; 3] = ["x", "y", "z"];

impl LinearObject {
    /// For a terminal: the state, and what goes in and out.
    #[must_use]
    pub fn text(&self) -> String {
        let list = |channels: &[Channel]| {
            let line = |channel: &Channel| format!("    {} ({})\n", channel.name, channel.unit);
            channels.iter().map(line).collect::<String>()
        };
        let doubts: String = self.doubts().iter().map(|doubt| format!("  {doubt}\n\n")).collect();
        format!(
            "{}: linear model\n\n{doubts}  {}\n\n  Inputs\n{}  Outputs\n{}{}  {} states; the matrices A, B, C, D: --json\n",
            self.name,
            self.sentence,
            list(&self.inputs),
            list(&self.outputs),
            self.pole_lines(),
            self.states.len()
        )
    }

    /// Lines of the poles of the closed loop, one of each pair.
    fn pole_lines(&self) -> String {
        if self.poles.is_empty() {
            return String::new();
        }
        let upper = self.poles.iter().filter(|[_, frequency]| *frequency >= 0.0);
        let line = |[rate, frequency]: &[f64; 2]| {
            format!("    {} ± {}i\n", significant(*rate, 5), significant(*frequency, 5))
        };
        format!("  Poles of the closed loop (1/s)\n{}", upper.map(line).collect::<String>())
    }

    /// What is to be read before the matrices, the gravest first: how far materials and liquids are met.
    fn doubts(&self) -> Vec<String> {
        let wrong = self.wrong.iter().map(|why| format!("{FAILS}: {why}"));
        let accuracy = self.accuracy.iter().map(AccuracyObject::sentence);
        let unknown = (!self.not_compared.is_empty()).then(|| {
            format!(
                "Liquids are in the model by slow flow and a few relaxations; how far that is from the response of {} is not known.",
                self.not_compared.join(", ")
            )
        });
        wrong.chain(accuracy).chain(unknown).collect()
    }

    /// The state, after the reason for which the model does not hold.
    #[must_use]
    pub fn verdict(&self) -> String {
        let doubts = if self.holds() { Vec::new() } else { self.doubts() };
        doubts.into_iter().chain([self.sentence.clone()]).collect::<Vec<_>>().join(" ")
    }

    /// False where materials or liquids are missed by more than a tenth, or the equations are not those of a liquid that spins.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.wrong.is_none() && self.accuracy.as_ref().is_none_or(AccuracyObject::holds)
    }

    /// Matrices, names and units for a file of arrays.
    #[must_use]
    pub fn arrays(&self) -> Vec<NamedArray> {
        let matrix = |rows: &[Vec<f64>], columns: usize| ArrayValue::Matrix {
            size: [rows.len(), columns],
            entries: rows.concat(),
        };
        let row = |entries: &[f64]| matrix(&[entries.to_vec()], entries.len());
        let names = |channels: &[Channel]| channels.iter().map(|channel| channel.name.clone()).collect();
        let units = |channels: &[Channel]| channels.iter().map(|channel| channel.unit.clone()).collect();
        let (states, inputs) = (self.states.len(), self.inputs.len());
        let numbers = [
            ("A", matrix(&self.A, states)),
            ("B", matrix(&self.B, inputs)),
            ("C", matrix(&self.C, states)),
            ("D", matrix(&self.D, inputs)),
            ("spin", row(&self.equilibrium.spin)),
            ("momentum", row(&self.equilibrium.momentum)),
            ("attitude", row(&self.equilibrium.attitude)),
            ("poles", matrix(&self.poles.iter().map(|pole| pole.to_vec()).collect::<Vec<_>>(), 2)),
        ];
        let numbers = numbers.into_iter().filter(|(name, _)| *name != "poles" || !self.poles.is_empty());
        let channels = [("states", &self.states), ("inputs", &self.inputs), ("outputs", &self.outputs)];
        let named = |(name, channels): (&str, &Vec<Channel>)| {
            let of = |name: String, texts| NamedArray { name, value: ArrayValue::Texts(texts) };
            [of(name.to_owned(), names(channels)), of(format!("{name}_units"), units(channels))]
        };
        let texts = [
            ("name", self.name.clone()),
            ("sentence", self.sentence.clone()),
            ("source", json!(self.source).to_string()),
        ];
        numbers
            .chain(texts.into_iter().map(|(name, text)| (name, ArrayValue::Text(text))))
            .map(|(name, value)| NamedArray { name: name.to_owned(), value })
            .chain(channels.into_iter().flat_map(named))
            .collect()
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}

/// Error from which a linear model does not hold, and the words for that.
const LARGE: f64 = 0.1;
const FAILS: &str = "DOES NOT HOLD";

impl AccuracyObject {
    fn holds(&self) -> bool {
        self.error.is_some_and(|error| error < LARGE)
    }

    fn sentence(&self) -> String {
        let [low, high, at] = [self.band[0], self.band[1], self.frequency].map(|x| significant(x, 3));
        let Some(error) = self.error else {
            return format!(
                "{FAILS}: at {at} rad/s the exact response of materials and liquids is not known."
            );
        };
        let told = if self.holds() { "The".into() } else { format!("{FAILS}: the") };
        let share = significant(100.0 * error, 3);
        format!(
            "{told} response to torques is within {share} % of the exact one of materials and liquids between {low} and {high} rad/s, worst at \
             {at} rad/s."
        )
    }
}

impl From<LinearAccuracy> for AccuracyObject {
    fn from(LinearAccuracy { band, error, frequency }: LinearAccuracy) -> Self {
        Self { band, error: error.is_finite().then_some(error), frequency }
    }
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
        let inputs: Vec<_> = ins.iter().map(|name| self.input(name)).collect::<Result<_, _>>()?;
        let outputs: Vec<_> = outs.iter().map(|name| self.output(name, &ins)).collect::<Result<_, _>>()?;
        let forces = steady_state::acting_at_start(self);
        let state = self.state_of(asked.at, &forces)?;
        let feedback = Loop::new(&self.controls, &state, &inputs, outputs.len())?;
        let all = [&*inputs, &*feedback.inputs].concat();
        let seen = [&*outputs, &*feedback.outputs].concat();
        let found = LinearModel::about(&self.body, &forces, state, &all, &seen, asked.band);
        let mut model = found.map_err(StudyError::Linear)?;
        let of_controllers = feedback.close(&mut model, [inputs.len(), outputs.len()]);
        let poles = if self.controls.is_empty() { Vec::new() } else { poles(&model.A)? };
        let LinearModel { equilibrium, states, A, B, C, D, accuracy } = model;
        let of_controllers = of_controllers.into_iter().map(|name| Channel { name, unit: String::new() });
        let channels = |names: Vec<String>, units: Vec<&'static str>| {
            names.into_iter().zip(units).map(|(name, unit)| Channel { name, unit: unit.to_owned() }).collect()
        };
        Ok(LinearObject {
            name: self.model.name.clone(),
            sentence: sentence(&equilibrium, &self.controls),
            states: states.iter().map(|state| self.named(*state, &ins)).chain(of_controllers).collect(),
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
            source: self.inputs(),
        })
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
            let axis = Principal::compute(body.invariants().J).axis_beside(omega);
            let near = RelativeEquilibrium::near(body, axis, given);
            near.map(|spin| SteadyState::of_spin(&spin)).map_err(StudyError::NoStart)
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

    fn named(&self, state: LinearState, inputs: &[String]) -> Channel {
        let coordinates = self.body.coordinates();
        let rate = |j: usize| if coordinates[j].unit == "m" { "m/s" } else { "rad/s" };
        let (name, unit) = match state {
            LinearState::Attitude(axis) => (format!("attitude.{}", AXES[axis]), "rad"),
            LinearState::Coordinate(j) => {
                (format!("coordinate.{}", plain(&coordinates[j].name)), coordinates[j].unit)
            }
            LinearState::Rate(axis) => (format!("rate.{}", AXES[axis]), "rad/s"),
            LinearState::Speed(j) => (format!("speed.{}", plain(&coordinates[j].name)), rate(j)),
            LinearState::Velocity(axis) => (format!("velocity.{}", AXES[axis]), "m/s"),
            LinearState::Lag { material, element, direction } => {
                (format!("lag.{}.{}.{}", material + 1, element + 1, direction + 1), "J^1/2")
            }
            LinearState::Wheel(input) => match inputs.get(input) {
                Some(name) => (name.replace(".torque", ".momentum"), "N m s"),
                None => ("wheel.momentum".to_owned(), "N m s"),
            },
        };
        Channel { name, unit: unit.to_owned() }
    }

    fn input(&self, name: &str) -> Result<LinearInput, StudyError> {
        let unknown = || no_channel(name, "torque.x, force.x, force.NODE.x or wheel.NAME.torque");
        if let Some(rotor) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".torque")) {
            return match self.wheel(rotor) {
                Some(axis) => Ok(LinearInput::Wheel { axis }),
                None => Ok(LinearInput::Motor { coordinate: self.rotor(name, rotor)? }),
            };
        }
        let (path, axis) = with_axis(name).ok_or_else(unknown)?;
        match path.split_once('.') {
            None if path == "torque" => Ok(LinearInput::Torque { axis }),
            None if path == "force" => Ok(LinearInput::Force { at: self.carrier(name)?, axis }),
            Some(("force", node)) => Ok(LinearInput::Force { at: self.place(name, node)?, axis }),
            _ => Err(unknown()),
        }
    }

    fn output(&self, name: &str, inputs: &[String]) -> Result<LinearOutput, StudyError> {
        let unknown = || {
            no_channel(
                name,
                "rate.x, attitude.x, momentum.x, acceleration.NODE.x, displacement.NODE.x, wheel.NAME.speed, wheel.NAME.momentum or coordinate.NAME",
            )
        };
        if let Some(rotor) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".speed")) {
            return Ok(LinearOutput::Speed { coordinate: self.rotor(name, rotor)? });
        }
        if let Some(wheel) = name.strip_prefix("wheel.").and_then(|rest| rest.strip_suffix(".momentum")) {
            let torque = format!("wheel.{wheel}.torque");
            let input = inputs.iter().position(|input| *input == torque && self.wheel(wheel).is_some());
            let expected = format!("a [[wheel]] whose torque, {torque}, is an input");
            return input
                .map(|input| LinearOutput::Wheel { input })
                .ok_or_else(|| no_channel(name, &expected));
        }
        if let Some(wanted) = name.strip_prefix("coordinate.") {
            let elastic = self.body.coordinates().iter().take(self.body.elastic());
            let found = elastic.enumerate().find(|(_, coordinate)| plain(&coordinate.name) == plain(wanted));
            let (coordinate, _) =
                found.ok_or_else(|| no_channel(name, "a coordinate that `quasirigid modes` lists"))?;
            return Ok(LinearOutput::Coordinate { coordinate });
        }
        let (path, axis) = with_axis(name).ok_or_else(unknown)?;
        match path.split_once('.') {
            None if path == "rate" => Ok(LinearOutput::Rate { axis }),
            None if path == "attitude" => Ok(LinearOutput::Attitude { axis }),
            None if path == "momentum" => Ok(LinearOutput::Momentum { axis }),
            None if path == "acceleration" => {
                Ok(LinearOutput::Acceleration { at: self.carrier(name)?, axis })
            }
            Some(("acceleration", node)) => {
                Ok(LinearOutput::Acceleration { at: self.place(name, node)?, axis })
            }
            Some(("displacement", node)) => {
                Ok(LinearOutput::Displacement { at: self.place(name, node)?, axis })
            }
            _ => Err(unknown()),
        }
    }

    /// Centre of mass of the carrier.
    fn carrier(&self, channel: &str) -> Result<Marker, StudyError> {
        let Some(carrier) = &self.model.assembly.carrier else {
            return Err(no_channel(channel, "the name of a node, as the body has no carrier"));
        };
        let position = add(carrier.center_of_mass, scale(-1.0, self.body.pole()));
        Ok(Marker {
            name: "carrier".into(),
            position,
            shapes: Vec::new(),
            curvature: Vec::new(),
            carried: None,
        })
    }

    fn place(&self, channel: &str, node: &str) -> Result<Marker, StudyError> {
        let mut named = self.body.markers().iter().filter(|marker| plain(&marker.name) == plain(node));
        match (named.next(), named.next()) {
            (Some(marker), None) => Ok(marker.clone()),
            (Some(_), Some(_)) => Err(no_channel(channel, "a node whose name no other has")),
            (None, _) => {
                let some: Vec<_> =
                    self.body.markers().iter().take(LISTED).map(|marker| &*marker.name).collect();
                Err(no_channel(channel, &format!("one of the nodes, such as {}", some.join(", "))))
            }
        }
    }

    /// Axis of a momentum wheel, a unit vector.
    fn wheel(&self, name: &str) -> Option<[f64; 3]> {
        let wheel = self.model.assembly.wheels.iter().find(|wheel| plain(&wheel.name) == plain(name))?;
        Some(scale(norm(wheel.axis).recip(), wheel.axis))
    }

    /// Coordinate of a rotor.
    fn rotor(&self, channel: &str, name: &str) -> Result<usize, StudyError> {
        let mut cyclic = self.body.cyclic();
        let found = cyclic.find(|j| plain(&self.body.coordinates()[*j].name) == plain(name));
        found.ok_or_else(|| {
            no_channel(
                channel,
                "the name of a [[rotor]] about one axis, or for a torque that of a [[wheel]], whose angular momentum is wheel.NAME.momentum",
            )
        })
    }

    fn unit_of_output(&self, output: &LinearOutput) -> &'static str {
        let coordinates = self.body.coordinates();
        match output {
            LinearOutput::Rate { .. } => "rad/s",
            LinearOutput::Attitude { .. } => "rad",
            LinearOutput::Momentum { .. } | LinearOutput::Wheel { .. } => "N m s",
            LinearOutput::Displacement { .. } => "m",
            LinearOutput::Acceleration { .. } => "m/s^2",
            LinearOutput::Coordinate { coordinate } => coordinates[*coordinate].unit,
            LinearOutput::Speed { coordinate } if coordinates[*coordinate].unit == "m" => "m/s",
            LinearOutput::Speed { .. } => "rad/s",
        }
    }
}

/// Nodes listed where one asked for is not there.
const LISTED: usize = 6;

fn unit_of_input(input: &LinearInput) -> &'static str {
    match input {
        LinearInput::Torque { .. } | LinearInput::Motor { .. } | LinearInput::Wheel { .. } => "N m",
        LinearInput::Force { .. } => "N",
    }
}

/// Name without quotes.
fn plain(name: &str) -> String {
    name.replace('"', "")
}

/// A path before an axis.
fn with_axis(name: &str) -> Option<(&str, usize)> {
    let (path, axis) = name.rsplit_once('.')?;
    Some((path, AXES.iter().position(|known| *known == axis)?))
}

fn no_channel(name: &str, expected: &str) -> StudyError {
    StudyError::NoChannel { name: name.into(), expected: expected.into() }
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
    let [x, y, z] = state.omega.map(|entry| entry / spin + 0.0);
    let size = significant(spin, 4);
    format!("About the steady spin of {size} rad/s about [{x:.4}, {y:.4}, {z:.4}].{closed}")
}
