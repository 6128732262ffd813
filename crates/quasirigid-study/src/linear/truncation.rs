//! Linear models with fewer states, and the words for what that costs.
//! Equations (M22) and (M23), docs/theory/15-modes.md.

use quasirigid::modes::{StateSpace, Truncation, TruncationMethod, TruncationRequest};
use quasirigid_math::vec3::norm;
use serde::{Deserialize, Serialize};

use super::channels::truncated;
use super::closed_loop::poles;
use super::object::{Channel, FAILS, LARGE, LinearObject};
use crate::error::StudyError;
use crate::words::significant;

/// Truncation that is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinearTruncation {
    /// Method.
    pub method: TruncationMethod,
    /// Number of states to keep.
    pub states: usize,
}

/// Method of a word, `balanced` or `modal`.
#[must_use]
pub fn truncation_method(word: &str) -> Option<TruncationMethod> {
    [TruncationMethod::Balanced, TruncationMethod::Modal].into_iter().find(|method| name(*method) == word)
}

fn name(method: TruncationMethod) -> &'static str {
    match method {
        TruncationMethod::Balanced => "balanced",
        TruncationMethod::Modal => "modal",
    }
}

/// What a truncation left out. Errors are those of responses, largest singular value, with inputs and outputs divided by their scales: 1
/// is the largest response of the vibrations between channels of one unit.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct TruncationObject {
    /// Method, `balanced` or `modal`.
    pub method: String,
    /// Number of states of the whole model.
    pub whole: usize,
    /// Number of states kept that do not decay.
    pub lasting: usize,
    /// Hankel singular values of the states that decay, descending; empty of `modal`.
    pub hankel_singular_values: Vec<f64>,
    /// Bound on the error; null where there is none.
    pub bound: Option<f64>,
    /// Frequency (rad/s) up to which the bound holds; null where it holds at all frequencies.
    pub up_to: Option<f64>,
    /// Largest error found at the frequencies that were compared.
    pub found: f64,
    /// Frequency (rad/s) of that error.
    pub frequency: f64,
    /// Whether rounding spoils the model: an error beyond the bound was found.
    pub spoiled: bool,
    /// Scale of each input.
    pub input_scales: Vec<f64>,
    /// Scale of each output.
    pub output_scales: Vec<f64>,
}

impl TruncationObject {
    fn of(method: TruncationMethod, whole: usize, found: Truncation) -> Self {
        let [input_scales, output_scales] = found.scales;
        Self {
            method: name(method).into(),
            whole,
            lasting: found.lasting,
            hankel_singular_values: found.singular_values,
            bound: found.bound.is_finite().then_some(found.bound),
            up_to: found.up_to,
            found: found.found,
            frequency: found.frequency,
            spoiled: found.spoiled,
            input_scales,
            output_scales,
        }
    }

    /// False where the bound is a tenth or more, or rounding spoils the model.
    pub(super) fn holds(&self) -> bool {
        !self.spoiled && self.bound.is_some_and(|bound| bound < LARGE)
    }

    /// The bound in words.
    pub(super) fn sentence(&self) -> String {
        let percent = |share: f64| significant(100.0 * share, 3);
        let [found, at] = [percent(self.found), significant(self.frequency, 3)];
        if self.spoiled {
            return format!(
                "{FAILS}: rounding spoils the truncated model, which misses the whole one by {found} % at {at} rad/s; keep fewer states."
            );
        }
        let reach = self.up_to.map_or_else(
            || "at all frequencies".to_owned(),
            |last| format!("up to {} rad/s", significant(last, 3)),
        );
        let Some(bound) = self.bound else {
            return format!(
                "{FAILS}: the modes left out have no bound {reach}; {found} % was found at {at} rad/s."
            );
        };
        let told = if self.holds() { "The".into() } else { format!("{FAILS}: the") };
        format!(
            "{told} response is within {} % of the largest one of the vibrations {reach}, by the bound of {} truncation; the error found is \
             {found} %, at {at} rad/s.",
            percent(bound),
            self.method
        )
    }
}

impl LinearObject {
    /// The model with fewer states. (M22), (M23)
    ///
    /// # Errors
    /// [`StudyError::Truncation`] says which numbers of states are possible; a truncated model is not truncated again.
    pub fn truncated(
        &self,
        LinearTruncation { method, states }: LinearTruncation,
    ) -> Result<Self, StudyError> {
        if self.truncation.is_some() {
            return Err(StudyError::TruncatedAgain);
        }
        let space = StateSpace { A: self.A.clone(), B: self.B.clone(), C: self.C.clone(), D: self.D.clone() };
        let request = TruncationRequest {
            method,
            states,
            rate: norm(self.equilibrium.spin),
            inputs: &kinds(&self.inputs),
            outputs: &kinds(&self.outputs),
        };
        let found = space.truncated(&request).map_err(StudyError::Truncation)?;
        let StateSpace { A, B, C, D } = found.system.clone();
        let channel = |number| {
            let (name, unit) = truncated(number);
            Channel { name, unit: unit.into() }
        };
        let states = (0..A.len()).map(channel).collect();
        let truncation = Some(TruncationObject::of(method, self.states.len(), found));
        let poles = if self.poles.is_empty() { Vec::new() } else { poles(&A)? };
        Ok(Self { states, poles, A, B, C, D, truncation, ..self.clone() })
    }
}

/// Kind of each channel: channels of one unit are of one kind.
fn kinds(channels: &[Channel]) -> Vec<usize> {
    let mut units: Vec<&str> = Vec::new();
    let mut kinds = Vec::new();
    for channel in channels {
        let known = units.iter().position(|unit| *unit == channel.unit);
        kinds.push(known.unwrap_or_else(|| {
            units.push(&channel.unit);
            units.len() - 1
        }));
    }
    kinds
}
