//! Frequencies of a light curve: sine waves found one after the other, all fitted together after each. Equation (O16).

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector};

/// Frequencies looked at per resolution `1/T`.
const STEPS: f64 = 6.0;
/// Products of times and frequencies that a search may cost.
const MOST_WORK: f64 = 2e9;
/// Probability that the highest peak of noise is taken for a line.
const FALSE_ALARM: f64 = 1e-3;
/// Peaks of the periodogram that may stand for the strongest line, and the rise of chi-squared below which one does.
const RIVALS: usize = 12;
const UNTOLD: f64 = 25.0;
/// Amplitude over the greatest below which lines are left out.
const LEAST: f64 = 3e-3;
/// Least periods of a line in the record.
const CYCLES: f64 = 1.5;
/// Iterations of the common fit.
const ITERATIONS: usize = 8;

/// A sine wave in a light curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Frequency, per unit of time.
    pub frequency: f64,
    /// Standard deviation of the frequency, if what is left is noise.
    pub deviation: f64,
    /// Amplitude.
    pub amplitude: f64,
}

/// Sine waves of a light curve, the greatest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectrum {
    /// The waves.
    pub lines: Vec<Line>,
    /// Frequency below which two lines are one: the reciprocal of the time covered.
    pub resolution: f64,
    /// Greatest frequency that was looked at.
    pub highest: f64,
    /// Whether the times tell higher ones, which would have cost too much.
    pub is_cut: bool,
    /// Frequencies with which the strongest line leaves as little as with its own.
    pub rivals: Vec<f64>,
    /// Root mean square of what is left.
    pub rest: f64,
    /// Root mean square of the curve about its means.
    pub whole: f64,
}

/// A curve with the constant that is free in each of its blocks.
struct Curve<'a> {
    t: &'a [f64],
    y: &'a [f64],
    block: &'a [usize],
    blocks: usize,
}

/// Finds up to `most` lines in a curve `y(t)` whose blocks, numbered from 0, have a free constant each; none of fewer than eight points or
/// of no length.
#[must_use]
pub fn spectral_lines(t: &[f64], y: &[f64], block: &[usize], most: usize) -> Option<Spectrum> {
    let (first, last) = t.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| (a.min(*t), b.max(*t)));
    let span = last - first;
    if t.len() < 8 || !(span > 0.0 && span.is_finite()) {
        return None;
    }
    let from_middle: Vec<f64> = t.iter().map(|t| t - 0.5 * (first + last)).collect();
    let blocks = block.iter().max().map_or(0, |most| most + 1);
    let curve = Curve { t: &from_middle, y, block, blocks };
    let (highest, is_cut) = highest(t, span);
    let mut frequencies: Vec<f64> = Vec::new();
    let mut fitted = curve.fit(&mut frequencies)?;
    let whole = rms(&fitted.rest);
    while frequencies.len() < most && 3 * (frequencies.len() + 1) + blocks < t.len() {
        let Some(next) = curve.strongest(&fitted.rest, span, highest) else { break };
        if frequencies.iter().any(|known| (known - next).abs() * span < 1.0) {
            break; // a line that the record does not resolve
        }
        let mut longer = frequencies.clone();
        longer.push(next);
        let Some(better) = curve.fit(&mut longer) else { break };
        if longer.iter().any(|frequency| frequency * span < CYCLES) {
            break; // a trend
        }
        let amplitude = better.amplitudes.last().copied().unwrap_or(0.0);
        let greatest = better.amplitudes.iter().copied().fold(0.0, f64::max);
        let noise = rms(&better.rest) * (2.0 / t.len() as f64).sqrt() * peak_of_noise(highest * span);
        if !(amplitude > noise && amplitude > LEAST * greatest) {
            break;
        }
        (frequencies, fitted) = (longer, better);
    }
    let rest = rms(&fitted.rest);
    let line = |(frequency, amplitude): (&f64, &f64)| Line {
        frequency: *frequency,
        deviation: (6.0 / t.len() as f64).sqrt() * rest / (PI * span * amplitude), // (O16)
        amplitude: *amplitude,
    };
    let mut lines: Vec<Line> = frequencies.iter().zip(&fitted.amplitudes).map(line).collect();
    lines.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    let rivals = curve.rivals(&frequencies, &fitted, span, highest);
    Some(Spectrum { lines, resolution: span.recip(), highest, is_cut, rivals, rest, whole })
}

/// Deviations of the amplitude of the highest of so many independent peaks of noise, but for a rare one. (O16)
fn peak_of_noise(peaks: f64) -> f64 {
    (2.0 * (peaks.max(1.0) / FALSE_ALARM).ln()).sqrt()
}

/// Half the reciprocal of the median step, or less where the search would cost too much, and whether it is less.
fn highest(t: &[f64], span: f64) -> (f64, bool) {
    let mut sorted = t.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut steps: Vec<f64> =
        sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    let median = steps.get(steps.len() / 2).copied().unwrap_or(span);
    let (told, most) = (0.5 / median, MOST_WORK / (STEPS * span * t.len() as f64));
    (told.min(most), most < told)
}

fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// A common fit: what it leaves, and the amplitude of each line.
struct Fitted {
    rest: Vec<f64>,
    amplitudes: Vec<f64>,
}

impl Curve<'_> {
    /// The frequency of the highest peak of the periodogram of some residuals.
    fn strongest(&self, rest: &[f64], span: f64, highest: f64) -> Option<f64> {
        let powers = self.periodogram(rest, span, highest);
        powers.into_iter().max_by(|a, b| a[1].total_cmp(&b[1])).map(|[frequency, _]| frequency)
    }

    /// Frequencies with which the strongest line would leave as little, the others as they are: aliases by the gaps between the times. (O16)
    fn rivals(&self, frequencies: &[f64], fitted: &Fitted, span: f64, highest: f64) -> Vec<f64> {
        let amplitude = |k: &usize| fitted.amplitudes[*k];
        let Some(first) = (0..frequencies.len()).max_by(|a, b| amplitude(a).total_cmp(&amplitude(b))) else {
            return Vec::new();
        };
        let others: Vec<f64> = [&frequencies[..first], &frequencies[first + 1..]].concat();
        let Some((rest, _)) = self.linear(&others) else { return Vec::new() };
        let mut peaks = self.periodogram(&rest, span, highest);
        peaks.sort_by(|a, b| b[1].total_cmp(&a[1]));
        let mut told = vec![frequencies[first]];
        let mut rivals = Vec::new();
        for [frequency, _] in peaks {
            if told.len() > RIVALS {
                break;
            }
            if told.iter().any(|known| (known - frequency).abs() * span < 1.5) {
                continue;
            }
            told.push(frequency);
            let mut all = [&others[..], &[frequency]].concat();
            let rises = self.fit(&mut all).map_or(f64::INFINITY, |with| {
                self.t.len() as f64 * ((rms(&with.rest) / rms(&fitted.rest)).powi(2) - 1.0)
            });
            if rises < UNTOLD {
                rivals.push(all[all.len() - 1]);
            }
        }
        rivals
    }

    /// Frequencies and powers of some residuals.
    fn periodogram(&self, rest: &[f64], span: f64, highest: f64) -> Vec<[f64; 2]> {
        let step = (STEPS * span).recip();
        let first = (CYCLES * STEPS) as usize;
        let last = (highest / step) as usize;
        let turn = |t: &f64, times: f64| (TAU * step * times * t).sin_cos();
        let mut waves: Vec<[f64; 2]> =
            self.t.iter().map(|t| turn(t, first as f64)).map(|(s, c)| [c, s]).collect();
        let turns: Vec<[f64; 2]> = self.t.iter().map(|t| turn(t, 1.0)).map(|(s, c)| [c, s]).collect();
        let mut powers = Vec::with_capacity(last.saturating_sub(first) + 1);
        for _ in first..=last {
            let [mut real, mut imaginary] = [0.0; 2];
            for ((wave, [c, s]), value) in waves.iter_mut().zip(&turns).zip(rest) {
                real += value * wave[0];
                imaginary += value * wave[1];
                *wave = [wave[0] * c - wave[1] * s, wave[0] * s + wave[1] * c];
            }
            powers.push([(first + powers.len()) as f64 * step, real * real + imaginary * imaginary]);
        }
        powers
    }

    /// Least squares in the constants, the amplitudes and the frequencies, which are moved to their best.
    fn fit(&self, frequencies: &mut [f64]) -> Option<Fitted> {
        let mut found = self.linear(frequencies)?;
        let span = self.t.iter().copied().fold(0.0, f64::max) * 2.0;
        for _ in 0..ITERATIONS {
            if frequencies.is_empty() {
                break;
            }
            let moves = self.moves(frequencies, &found)?;
            let nearest = moves.iter().map(|step| (step * span).abs()).fold(0.0, f64::max);
            let kept = if nearest > 0.3 { 0.3 / nearest } else { 1.0 };
            let moved: Vec<f64> = frequencies.iter().zip(&moves).map(|(f, step)| f + kept * step).collect();
            let next = self.linear(&moved)?;
            if !(rms(&next.0) <= rms(&found.0)) {
                break;
            }
            frequencies.copy_from_slice(&moved);
            found = next;
            if nearest < 1e-9 {
                break;
            }
        }
        let (rest, parameters) = found;
        let amplitude = |k: usize| parameters[self.blocks + 2 * k].hypot(parameters[self.blocks + 2 * k + 1]);
        Some(Fitted { rest, amplitudes: (0..frequencies.len()).map(amplitude).collect() })
    }

    /// Constants and amplitudes at given frequencies: what they leave, and the parameters.
    fn linear(&self, frequencies: &[f64]) -> Option<(Vec<f64>, DVector<f64>)> {
        let columns = self.design(frequencies);
        let y = DVector::from_column_slice(self.y);
        let parameters = solved(&columns, &y)?;
        let rest = y - columns * &parameters;
        Some((rest.as_slice().to_vec(), parameters))
    }

    fn design(&self, frequencies: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(self.t.len(), self.blocks + 2 * frequencies.len(), |row, column| {
            if column < self.blocks {
                return f64::from(u8::from(self.block[row] == column));
            }
            let wave = column - self.blocks;
            let (sine, cosine) = (TAU * frequencies[wave / 2] * self.t[row]).sin_cos();
            if wave.is_multiple_of(2) { cosine } else { sine }
        })
    }

    /// Changes of the frequencies that would lower the squares most, all parameters free.
    fn moves(&self, frequencies: &[f64], (rest, parameters): &(Vec<f64>, DVector<f64>)) -> Option<Vec<f64>> {
        let linear = self.design(frequencies);
        let count = linear.ncols();
        let whole = DMatrix::from_fn(self.t.len(), count + frequencies.len(), |row, column| {
            if column < count {
                return linear[(row, column)];
            }
            let k = column - count;
            let [a, b] = [0, 1].map(|part| parameters[self.blocks + 2 * k + part]);
            let [cosine, sine] = [0, 1].map(|part| linear[(row, self.blocks + 2 * k + part)]);
            TAU * self.t[row] * (b * cosine - a * sine)
        });
        let steps = solved(&whole, &DVector::from_column_slice(rest))?;
        Some(steps.as_slice()[count..].to_vec())
    }
}

/// Linear least squares; none where columns are linearly dependent.
fn solved(columns: &DMatrix<f64>, y: &DVector<f64>) -> Option<DVector<f64>> {
    let sizes: Vec<f64> = columns.column_iter().map(|column| column.norm()).collect();
    if sizes.iter().any(|size| !(*size > 0.0)) {
        return None;
    }
    let mut scaled = columns.clone();
    scaled.column_iter_mut().zip(&sizes).for_each(|(mut column, size)| column /= *size);
    let mut found = scaled.tr_mul(&scaled).cholesky()?.solve(&scaled.tr_mul(y));
    found.iter_mut().zip(&sizes).for_each(|(value, size)| *value /= size);
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three waves of known frequencies at uneven times in two blocks with constants of their own.
    #[test]
    fn frequencies_of_known_waves_are_found() {
        let waves = [(0.137, 1.0, 0.3), (0.0811, 0.4, 1.9), (0.3093, 0.05, 4.0)];
        let t: Vec<f64> = (0..400).map(|k| f64::from(k) + 0.4 * (1.7 * f64::from(k)).sin()).collect();
        let block: Vec<usize> = (0..400).map(|k| usize::from(k >= 170)).collect();
        let value = |(t, block): (&f64, &usize)| {
            let wave = |(f, a, phase): &(f64, f64, f64)| a * (TAU * f * t + phase).cos();
            waves.iter().map(wave).sum::<f64>() + [3.0, -5.0][*block]
        };
        let y: Vec<f64> = t.iter().zip(&block).map(value).collect();
        for unit in [1e-9, 1.0, 1e9] {
            let t: Vec<f64> = t.iter().map(|t| t * unit).collect();
            let found = spectral_lines(&t, &y, &block, 6).unwrap();
            for ((f, a, _), line) in waves.iter().zip(&found.lines) {
                assert!((line.frequency * unit / f - 1.0).abs() < 1e-8, "{line:?}");
                assert!((line.amplitude / a - 1.0).abs() < 1e-6, "{line:?}");
            }
            assert!(found.rest < 1e-6 * found.whole);
        }
    }

    /// The more frequencies are looked at, the higher the highest peak of noise.
    #[test]
    fn noise_of_nights_far_apart_has_no_lines() {
        let t: Vec<f64> = (0..720).map(|k| f64::from(25 * (k / 60)) + f64::from(k % 60) / 288.0).collect();
        for seed in 0..6 {
            let mut random = quasirigid_math::random::Random::new(seed);
            let y: Vec<f64> = t.iter().map(|_| (0..12).map(|_| random.unit()).sum()).collect();
            let found = spectral_lines(&t, &y, &[0; 720], 6).unwrap();
            assert!(found.lines.is_empty(), "seed {seed}: {:?}", found.lines);
        }
    }

    /// Two points a night at the same hours: frequencies a whole number of turns a day apart are told by their short distance alone.
    #[test]
    fn a_line_that_the_nights_leave_open_has_rivals() {
        let f = 3.3;
        let t: Vec<f64> = (0..80).map(|k| f64::from(k / 2) + f64::from(k % 2) / 288.0).collect();
        let mut random = quasirigid_math::random::Random::new(5);
        let y: Vec<f64> = t.iter().map(|t| (TAU * f * t).cos() + 0.2 * random.unit()).collect();
        let found = spectral_lines(&t, &y, &[0; 80], 1).unwrap();
        let told: Vec<f64> = found.lines.iter().map(|line| line.frequency).chain(found.rivals).collect();
        assert!(told.len() > 2 && told.iter().any(|told| (told - f).abs() < 0.02), "{told:?}");
        let whole: Vec<f64> = (0..400).map(|k| f64::from(k) / 40.0).collect();
        let y: Vec<f64> = whole.iter().map(|t| (TAU * f * t).cos()).collect();
        assert_eq!(spectral_lines(&whole, &y, &[0; 400], 1).unwrap().rivals, Vec::<f64>::new());
    }

    #[test]
    fn noise_alone_has_no_lines() {
        let mut random = quasirigid_math::random::Random::new(3);
        let t: Vec<f64> = (0..300).map(f64::from).collect();
        let y: Vec<f64> = t.iter().map(|_| random.unit()).collect();
        assert!(spectral_lines(&t, &y, &[0; 300], 6).unwrap().lines.is_empty());
        assert!(spectral_lines(&t[..5], &y[..5], &[0; 5], 6).is_none());
    }
}
