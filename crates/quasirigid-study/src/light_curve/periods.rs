//! Frequencies of a light curve, and the periods of the rotation in them.

use quasirigid_photometry::{
    FrequencyPair, Spectrum, explained, frequency_pairs, numbers_of, spectral_lines, tells_numbers,
};
use serde::Serialize;

use super::epochs::Epoch;
use super::refused;
use crate::error::StudyError;
use crate::histories::History;
use crate::words::time;

/// Most lines of a light curve.
const MOST_LINES: usize = 12;
/// Multiple of the fastest frequency of a model that its light curve has strong lines at.
const STRONG: f64 = 2.0;
/// Share of the highest frequency above which the strongest line has few times in a period: eight.
const FEW_TIMES: f64 = 0.25;
/// Rivals that are named.
const NAMED: usize = 3;

/// Frequencies of a light curve.
#[derive(Clone, Debug, Serialize)]
pub struct PeriodsObject {
    /// Whether they are those of the `measured` or of the `computed` curve.
    pub of: &'static str,
    /// Lines, the strongest first.
    pub lines: Vec<LineObject>,
    /// Why the periods may not hold; `null` where the times tell them.
    pub doubt: Option<String>,
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
    /// Of a computed curve, whose brightness has a relative error by the facets, lines above that error alone.
    pub fn of(
        epochs: &[Epoch],
        brightness: &[f64],
        error: f64,
        history: &History,
    ) -> Result<Self, StudyError> {
        let measured = epochs.iter().map(|epoch| epoch.measured).collect::<Option<Vec<f64>>>();
        let of = if measured.is_some() { "measured" } else { "computed" };
        let values = measured.as_deref().unwrap_or(brightness);
        let t: Vec<f64> = epochs.iter().map(|epoch| epoch.t).collect();
        let blocks: Vec<usize> = epochs.iter().map(|epoch| epoch.block).collect();
        let mut spectrum = spectral_lines(&t, &relative(values, &blocks), &blocks, MOST_LINES).ok_or_else(|| {
            refused("frequencies are not found in fewer than eight times, or in times that are all the same; give more".to_owned())
        })?;
        if measured.is_none() {
            spectrum.lines.retain(|line| line.amplitude > error);
        }
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
            doubt: doubt(&spectrum, frequencies, measured.is_some()),
            highest: spectrum.highest,
            rest: spectrum.rest / spectrum.whole,
            pairs: frequency_pairs(&spectrum).iter().map(pair).collect(),
            model,
        })
    }
}

/// Why the times do not tell the periods. (O16)
fn doubt(spectrum: &Spectrum, model: Option<(f64, Option<f64>)>, is_measured: bool) -> Option<String> {
    let fastest = model.map(|(first, second)| STRONG * (first.abs() + second.unwrap_or(0.0).abs()));
    let strongest = spectrum.lines.first().map(|line| line.frequency);
    let looked = time(spectrum.highest.recip());
    if let Some(fastest) = fastest.filter(|fastest| !is_measured && *fastest > spectrum.highest) {
        return Some(format!(
            "the curve of this model has lines of {}, and the times tell none below {looked}: give more times, as --samples does",
            time(fastest.recip())
        ));
    }
    let slowest = model.map(|(first, _)| first.abs());
    if let Some(slowest) = slowest.filter(|slowest| !is_measured && *slowest < spectrum.resolution) {
        return Some(format!(
            "the curve covers {}, less than the period of {} of this model: give a longer one",
            time(spectrum.resolution.recip()),
            time(slowest.recip())
        ));
    }
    if spectrum.is_cut {
        return Some(format!(
            "so many times over so long were looked through for periods above {looked} only, and a shorter one shows as another: give a part of the curve"
        ));
    }
    let rivals: Vec<String> = spectrum.rivals.iter().take(NAMED).map(|rival| time(rival.recip())).collect();
    let strongest = strongest?;
    if !rivals.is_empty() {
        return Some(format!(
            "the gaps between the times leave open whether the strongest line has a period of {} or {}",
            time(strongest.recip()),
            rivals.join(" or ")
        ));
    }
    (fastest.is_none_or(|_| is_measured) && strongest > FEW_TIMES * spectrum.highest).then(|| {
        format!(
            "the steps between the times, {}, are not short beside the period of the strongest line, {}: that of a faster rotation would look the same",
            time(0.5 * spectrum.highest.recip()),
            time(strongest.recip())
        )
    })
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
    let explained = explained(spectrum, &numbers);
    let found = tells_numbers(spectrum, first, second)
        .then(|| FrequencyPair::of_numbers(spectrum, numbers, second.is_some()))
        .flatten()
        .map(|found| pair(&found));
    ModelPeriodsObject {
        precession_period: precession,
        rotation_period: rotation,
        found: found.as_ref().and_then(|found| Some([found.first, found.second?])),
        deviations: found.as_ref().and_then(|found| found.second.map(|_| found.deviations)),
        explained: if explained.is_finite() { explained } else { 0.0 },
    }
}
