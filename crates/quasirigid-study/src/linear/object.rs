//! Linear model as an answer: words, JSON, arrays.

use std::collections::BTreeMap;

use quasirigid::modes::LinearAccuracy;
use quasirigid_io::array_file::{ArrayValue, NamedArray};
use quasirigid_io::record::InputsRecord;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::truncation::TruncationObject;
use crate::words::significant;

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
    /// What a truncation left out; null without one.
    pub truncation: Option<TruncationObject>,
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
        let truncated = self.truncation.iter().map(TruncationObject::sentence);
        truncated.chain(wrong).chain(accuracy).chain(unknown).collect()
    }

    /// The state, after the reason for which the model does not hold.
    #[must_use]
    pub fn verdict(&self) -> String {
        let doubts = if self.holds() { Vec::new() } else { self.doubts() };
        doubts.into_iter().chain([self.sentence.clone()]).collect::<Vec<_>>().join(" ")
    }

    /// False where materials or liquids are missed by more than a tenth, what was left out may be as much, or the equations are not those
    /// of a liquid that spins.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.wrong.is_none()
            && self.accuracy.as_ref().is_none_or(AccuracyObject::holds)
            && self.truncation.as_ref().is_none_or(TruncationObject::holds)
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
pub(super) const LARGE: f64 = 0.1;
pub(super) const FAILS: &str = "DOES NOT HOLD";

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
