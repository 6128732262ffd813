//! Units of inputs and outputs in which responses are alike, so that an error is a share of the largest response of its kind.

use super::poles::Poles;
use super::response::{Response, gain};
use super::{C, Matrix, System};
use crate::eigen::NoConvergence;

/// Scale of each input and output: a transfer between scaled channels is at most about one.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    pub inputs: Vec<f64>,
    pub outputs: Vec<f64>,
}

/// Frequencies to a decade, and the ratio of the slowest rate to the first and of the last to the fastest.
const DECADE: f64 = 24.0;
const BEYOND: f64 = 10.0;
/// Damping ratio with which responses are taken for a scale, so that undamped modes have one.
const DAMPED: f64 = 1e-3;

/// Frequencies (rad/s) at which responses are compared, ascending: to a grid those of the modes.
pub(super) fn frequencies(poles: &Poles) -> Vec<f64> {
    let decaying = || (0..poles.values.len()).filter(|k| !poles.rigid[*k]).map(|k| poles.values[k]);
    let slowest = decaying().map(|value| value.norm()).fold(f64::INFINITY, f64::min) / BEYOND;
    let fastest = decaying().map(|value| value.norm()).fold(0.0, f64::max) * BEYOND;
    if !(slowest.is_finite() && slowest > 0.0) {
        return Vec::new();
    }
    let count = (DECADE * (fastest / slowest).log10()).ceil();
    let grid = (0..=count as usize).map(|k| slowest * (fastest / slowest).powf(k as f64 / count));
    let own = decaying().map(|value| value.im).filter(|frequency| *frequency >= slowest);
    let mut all: Vec<f64> = grid.chain(own).collect();
    all.sort_by(f64::total_cmp);
    all
}

impl Scales {
    /// From the largest responses between channels of each kind.
    pub fn of(part: &System, frequencies: &[f64], kinds: [&[usize]; 2]) -> Result<Self, NoConvergence> {
        let part = Response::of(part)?;
        let [inputs, outputs] = kinds;
        let count = |kinds: &[usize]| kinds.iter().max().map_or(0, |last| last + 1);
        let mut largest = vec![vec![0.0_f64; count(inputs)]; count(outputs)];
        for frequency in frequencies {
            let response = part.at(*frequency * C::new(DAMPED, 1.0));
            for (output, row) in largest.iter_mut().enumerate() {
                for (input, entry) in row.iter_mut().enumerate() {
                    let own = block(&response, [(inputs, input), (outputs, output)]);
                    *entry = entry.max(gain(&own));
                }
            }
        }
        let or_one = |size: f64| if size > 0.0 && size.is_finite() { size } else { 1.0 };
        let by_output: Vec<f64> =
            largest.iter().map(|row| or_one(row.iter().copied().fold(0.0, f64::max))).collect();
        let by_input: Vec<f64> = (0..count(inputs))
            .map(|input| {
                or_one(largest.iter().zip(&by_output).map(|(row, own)| row[input] / own).fold(0.0, f64::max))
            })
            .collect();
        Ok(Self {
            inputs: inputs.iter().map(|kind| by_input[*kind]).collect(),
            outputs: outputs.iter().map(|kind| by_output[*kind]).collect(),
        })
    }

    /// A system between scaled channels.
    pub fn scaled(&self, system: &System) -> System {
        let mut own = system.clone();
        for (k, scale) in self.inputs.iter().enumerate() {
            own.B.column_mut(k).unscale_mut(*scale);
            own.D.column_mut(k).unscale_mut(*scale);
        }
        for (k, scale) in self.outputs.iter().enumerate() {
            own.C.row_mut(k).unscale_mut(*scale);
            own.D.row_mut(k).unscale_mut(*scale);
        }
        own
    }

    /// A system between the channels themselves, from one between scaled ones.
    pub fn unscaled(&self, system: &System) -> System {
        let inverse = |scales: &[f64]| scales.iter().map(|scale| scale.recip()).collect();
        Self { inputs: inverse(&self.inputs), outputs: inverse(&self.outputs) }.scaled(system)
    }
}

/// Part of a transfer matrix between channels of one kind.
fn block(response: &Matrix, [(inputs, input), (outputs, output)]: [(&[usize], usize); 2]) -> Matrix {
    let of =
        |kinds: &[usize], kind: usize| (0..kinds.len()).filter(|k| kinds[*k] == kind).collect::<Vec<_>>();
    response.select_rows(&of(outputs, output)).select_columns(&of(inputs, input))
}
