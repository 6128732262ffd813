//! Frequencies of a light curve, and the periods of the rotation in them.

use quasirigid_photometry::{FrequencyPair, Spectrum, frequency_pairs, numbers_of, spectral_lines};
use serde::Serialize;

use super::epochs::Epoch;
use super::refused;
use crate::error::StudyError;
use crate::histories::History;

/// Most lines of a light curve.
const MOST_LINES: usize = 12;

/// Frequencies of a light curve.
#[derive(Clone, Debug, Serialize)]
pub struct PeriodsObject {
    /// Whether they are those of the `measured` or of the `computed` curve.
    pub of: &'static str,
    /// Lines, the strongest first.
    pub lines: Vec<LineObject>,
    /// Greatest frequency (Hz) that was looked at.
    pub highest: f64,
    /// Root mean square of what the lines leave, over that of the curve.
    pub rest: f64,
    /// Pairs of frequencies of which the lines are sums of multiples, or single ones, the best first; the others are aliases.
    pub pairs: Vec<PairObject>,
    /// Periods of the free rotation of the model, and what the curve makes of them; `null` where it is not free.
    pub model: Option<ModelPeriodsObject>,
}

/// Line of a light curve.
#[derive(Clone, Debug, Serialize)]
pub struct LineObject {
    /// Frequency (Hz).
    pub frequency: f64,
    /// Standard deviation of the frequency (Hz), if what the lines leave is noise.
    pub deviation: f64,
    /// Amplitude, over the mean brightness.
    pub amplitude: f64,
    /// Multiples of the precession and of the rotation frequency of the model whose sum is the line; `null` of others.
    pub of_model: Option<[i32; 2]>,
}

/// Two frequencies of a light curve, or one.
#[derive(Clone, Debug, Serialize)]
pub struct PairObject {
    /// First period (s).
    pub first: f64,
    /// Second period (s); `null` of one frequency.
    pub second: Option<f64>,
    /// Standard deviations of both (s).
    pub deviations: [f64; 2],
    /// Share of the power of the lines that are sums of multiples.
    pub explained: f64,
    /// Multiples of each line; `null` of those that are no such sum.
    pub numbers: Vec<Option<[i32; 2]>>,
}

/// Periods of the model's rotation, and the same from the light curve.
#[derive(Clone, Debug, Serialize)]
pub struct ModelPeriodsObject {
    /// Mean period (s) of the long axis about the angular momentum, `P_phi`.
    pub precession_period: f64,
    /// Period (s) about the long axis, `P_psi`.
    pub rotation_period: f64,
    /// Both from the lines of the curve by their multiples in the model; `null` where these do not tell.
    pub found: Option<[f64; 2]>,
    /// Standard deviations of those (s).
    pub deviations: Option<[f64; 2]>,
    /// Share of the power in lines that belong to the model.
    pub explained: f64,
}

impl PeriodsObject {
    pub fn of(epochs: &[Epoch], brightness: &[f64], history: &History) -> Result<Self, StudyError> {
        let measured = epochs.iter().map(|epoch| epoch.measured).collect::<Option<Vec<f64>>>();
        let of = if measured.is_some() { "measured" } else { "computed" };
        let values = measured.as_deref().unwrap_or(brightness);
        let t: Vec<f64> = epochs.iter().map(|epoch| epoch.t).collect();
        let blocks: Vec<usize> = epochs.iter().map(|epoch| epoch.block).collect();
        let spectrum = spectral_lines(&t, &relative(values, &blocks), &blocks, MOST_LINES).ok_or_else(|| {
            refused("frequencies are not found in fewer than eight times, or in times that are all the same; give more".to_owned())
        })?;
        let periods = history.free_rotation.as_ref().map(|free| free.periods());
        let frequencies = periods.map(|[precession, rotation]| {
            (precession.recip(), Some(rotation.recip()).filter(|rate| rate.is_finite() && *rate > 0.0))
        });
        let known = frequencies.map(|(first, second)| numbers_of(&spectrum, first, second));
        let line = |(at, line): (usize, &quasirigid_photometry::Line)| LineObject {
            frequency: line.frequency,
            deviation: line.deviation,
            amplitude: line.amplitude,
            of_model: known.as_ref().and_then(|known| known[at]),
        };
        let lines = spectrum.lines.iter().enumerate().map(line).collect();
        let model =
            periods.zip(frequencies).map(|(periods, frequencies)| of_model(&spectrum, periods, frequencies));
        Ok(Self {
            of,
            lines,
            highest: spectrum.highest,
            rest: spectrum.rest / spectrum.whole,
            pairs: frequency_pairs(&spectrum).iter().map(pair).collect(),
            model,
        })
    }
}

/// Values over the mean of their block.
fn relative(values: &[f64], blocks: &[usize]) -> Vec<f64> {
    let count = blocks.iter().max().map_or(0, |last| last + 1);
    let (mut sums, mut counts) = (vec![0.0; count], vec![0.0; count]);
    for (value, block) in values.iter().zip(blocks) {
        sums[*block] += value;
        counts[*block] += 1.0;
    }
    values.iter().zip(blocks).map(|(value, block)| value * counts[*block] / sums[*block]).collect()
}

fn pair(found: &FrequencyPair) -> PairObject {
    let [first, second] = found.deviations;
    let period = |frequency: f64| frequency.abs().recip();
    PairObject {
        first: period(found.first),
        second: found.second.map(period),
        deviations: [
            first * period(found.first).powi(2),
            second * found.second.map_or(0.0, |f| period(f).powi(2)),
        ],
        explained: found.explained,
        numbers: found.numbers.clone(),
    }
}

fn of_model(
    spectrum: &Spectrum,
    [precession, rotation]: [f64; 2],
    (first, second): (f64, Option<f64>),
) -> ModelPeriodsObject {
    let numbers = numbers_of(spectrum, first, second);
    let power = |line: &quasirigid_photometry::Line| line.amplitude * line.amplitude;
    let whole: f64 = spectrum.lines.iter().map(power).sum();
    let belonging = spectrum.lines.iter().zip(&numbers).filter(|(_, numbers)| numbers.is_some());
    let explained = belonging.map(|(line, _)| power(line)).sum::<f64>() / whole;
    let found = FrequencyPair::of_numbers(spectrum, numbers, second.is_some()).map(|found| pair(&found));
    ModelPeriodsObject {
        precession_period: precession,
        rotation_period: rotation,
        found: found.as_ref().and_then(|found| Some([found.first, found.second?])),
        deviations: found.as_ref().and_then(|found| found.second.map(|_| found.deviations)),
        explained: if explained.is_finite() { explained } else { 0.0 },
    }
}
