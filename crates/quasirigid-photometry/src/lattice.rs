//! The two frequencies of a tumbling body: every line of its light curve is a sum of whole multiples of them. Equation (O17).

use crate::spectrum::{Line, Spectrum};

/// Greatest multiple of a frequency.
const MOST: i32 = 6;
/// Distance from a multiple, over the resolution, within which a line is one.
const NEAR: f64 = 0.15;
/// Lines that give candidates.
const GIVING: usize = 7;
/// Cost of a multiple, and of the second frequency, over that of power which is not explained.
const MULTIPLE: f64 = 0.01;
const SECOND: f64 = 0.02;
/// Chance matches of a line with the multiples of two frequencies above which they tell nothing.
const MOST_CHANCE: f64 = 0.2;
/// Pairs that are told.
const TOLD: usize = 5;

/// Multiples of two frequencies that a line is the sum of.
pub type LineNumbers = [i32; 2];

/// Two frequencies, or one, of which the lines of a light curve are sums of multiples.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyPair {
    /// First frequency, per unit of time.
    pub first: f64,
    /// Second frequency; none where the multiples of one are enough.
    pub second: Option<f64>,
    /// Standard deviations of both, from those of the lines.
    pub deviations: [f64; 2],
    /// Multiples of each line; none of a line that is no such sum.
    pub numbers: Vec<Option<LineNumbers>>,
    /// Share of the power in the lines that are such sums.
    pub explained: f64,
    /// What is not explained and how high the multiples are: the lowest is best.
    pub cost: f64,
}

/// Multiples of each line by two frequencies, or by one.
#[must_use]
pub fn numbers_of(spectrum: &Spectrum, first: f64, second: Option<f64>) -> Vec<Option<LineNumbers>> {
    spectrum.lines.iter().map(|line| numbers(line, spectrum.resolution, first, second)).collect()
}

/// Share of the power in the lines that are sums of multiples; one, to the last digit, where all are.
#[must_use]
pub fn explained(spectrum: &Spectrum, numbers: &[Option<LineNumbers>]) -> f64 {
    let power = |line: &Line| line.amplitude * line.amplitude;
    let whole: f64 = spectrum.lines.iter().map(power).sum();
    let known = spectrum.lines.iter().zip(numbers).filter(|(_, numbers)| numbers.is_some());
    known.map(|(line, _)| power(line)).sum::<f64>() / whole
}

/// Whether a line anywhere would hardly be a sum of multiples of two frequencies, or of one, by chance. (O17)
#[must_use]
pub fn tells_numbers(spectrum: &Spectrum, first: f64, second: Option<f64>) -> bool {
    let most = if second.is_some() { MOST } else { 0 };
    let sums = (-MOST..=MOST).flat_map(|j| (-most..=most).map(move |k| (j, k)));
    let within = sums.filter(|(j, k)| {
        let sum = f64::from(*j) * first + f64::from(*k) * second.unwrap_or(0.0);
        sum > 0.0 && sum <= spectrum.highest
    });
    within.count() as f64 * 2.0 * NEAR * spectrum.resolution <= MOST_CHANCE * spectrum.highest
}

/// The lowest multiples whose sum is a line, the first not negative. (O17)
fn numbers(line: &Line, resolution: f64, first: f64, second: Option<f64>) -> Option<LineNumbers> {
    let mut best: Option<(i32, f64, LineNumbers)> = None;
    let most = if second.is_some() { MOST } else { 0 };
    for j in -MOST..=MOST {
        for k in -most..=most {
            let off = (line.frequency - f64::from(j) * first - f64::from(k) * second.unwrap_or(0.0)).abs();
            let height = j.abs() + k.abs();
            let lower = best.is_none_or(|(known, distance, _)| (height, off) < (known, distance));
            if off <= (NEAR * resolution).max(3.0 * line.deviation) && lower {
                best = Some((height, off, [j, k]));
            }
        }
    }
    best.map(|(_, _, numbers)| numbers)
}

/// Pairs of frequencies of which the lines are sums of multiples, the best first: a light curve alone often leaves a choice.
#[must_use]
pub fn frequency_pairs(spectrum: &Spectrum) -> Vec<FrequencyPair> {
    let candidates = candidates(spectrum);
    let mut pairs: Vec<FrequencyPair> = Vec::new();
    for (at, first) in candidates.iter().enumerate() {
        pairs.extend(judged(spectrum, *first, None));
        for second in &candidates[..at] {
            pairs.extend(judged(spectrum, *first, Some(*second)));
        }
    }
    pairs.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut told: Vec<FrequencyPair> = Vec::new();
    for pair in pairs {
        let Some(pair) = fitted(spectrum, pair) else { continue };
        if !told.iter().any(|known| is_same(known, &pair, spectrum.resolution)) {
            told.push(pair);
        }
        if told.len() == TOLD {
            break;
        }
    }
    told
}

/// Frequencies of the strongest lines, their halves, and halves and wholes of their sums and differences.
fn candidates(spectrum: &Spectrum) -> Vec<f64> {
    let strong: Vec<f64> = spectrum.lines.iter().take(GIVING).map(|line| line.frequency).collect();
    let mut found: Vec<f64> = Vec::new();
    for (at, one) in strong.iter().enumerate() {
        found.extend([*one, 0.5 * one]);
        for other in &strong[..at] {
            found.extend([one + other, (one - other).abs(), 0.5 * (one + other), 0.5 * (one - other).abs()]);
        }
    }
    found.retain(|frequency| *frequency > spectrum.resolution);
    found.sort_by(f64::total_cmp);
    found.dedup_by(|a, b| (*a - *b).abs() < 0.01 * spectrum.resolution);
    found
}

fn judged(spectrum: &Spectrum, first: f64, second: Option<f64>) -> Option<FrequencyPair> {
    let numbers = numbers_of(spectrum, first, second);
    let explained = explained(spectrum, &numbers);
    // every line counts alike: weak ones tell the multiples as well as strong ones
    let heights = numbers.iter().flatten().map(|[j, k]| f64::from(j.abs() + k.abs()));
    let height = heights.sum::<f64>() / spectrum.lines.len() as f64;
    let used = |which: usize| numbers.iter().flatten().any(|numbers| numbers[which] != 0);
    if !used(0) || (second.is_some() && !used(1)) {
        return None;
    }
    let missed = numbers.iter().filter(|numbers| numbers.is_none()).count() as f64 / numbers.len() as f64;
    let cost =
        1.0 - explained + 0.2 * missed + MULTIPLE * height + if second.is_some() { SECOND } else { 0.0 };
    Some(FrequencyPair { first, second, deviations: [0.0; 2], numbers, explained, cost })
}

/// The pair at the weighted least squares of its lines; none where they do not tell both frequencies.
fn fitted(spectrum: &Spectrum, pair: FrequencyPair) -> Option<FrequencyPair> {
    let [mut aa, mut ab, mut bb, mut ay, mut by] = [0.0; 5];
    for (line, numbers) in spectrum.lines.iter().zip(&pair.numbers) {
        let Some(numbers) = numbers else { continue };
        let [a, b] = numbers.map(f64::from);
        // a line without noise still has the error of what is left out
        let weight = line.deviation.max(1e-4 * spectrum.resolution).powi(-2);
        aa += weight * a * a;
        ab += weight * a * b;
        bb += weight * b * b;
        ay += weight * a * line.frequency;
        by += weight * b * line.frequency;
    }
    let Some(_) = pair.second else {
        return Some(FrequencyPair { first: ay / aa, deviations: [aa.sqrt().recip(), 0.0], ..pair });
    };
    let determinant = aa * bb - ab * ab;
    if !(determinant > 1e-9 * aa * bb) {
        return None;
    }
    let [first, second] = [(bb * ay - ab * by) / determinant, (aa * by - ab * ay) / determinant];
    let deviations = [(bb / determinant).sqrt(), (aa / determinant).sqrt()];
    Some(FrequencyPair { first, second: Some(second), deviations, ..pair })
}

impl FrequencyPair {
    /// The frequencies that fit lines best whose multiples are known; none where the lines do not tell them.
    #[must_use]
    pub fn of_numbers(
        spectrum: &Spectrum,
        numbers: Vec<Option<LineNumbers>>,
        has_second: bool,
    ) -> Option<Self> {
        let explained = explained(spectrum, &numbers);
        let second = has_second.then_some(0.0);
        let found =
            Self { first: 0.0, second, deviations: [0.0; 2], numbers, explained, cost: 1.0 - explained };
        fitted(spectrum, found).filter(|found| found.first.is_finite())
    }
}

fn is_same(a: &FrequencyPair, b: &FrequencyPair, resolution: f64) -> bool {
    let near = |x: f64, y: f64| (x - y).abs() < NEAR * resolution;
    match (a.second, b.second) {
        (None, None) => near(a.first, b.first),
        (Some(c), Some(d)) => near(a.first, b.first) && near(c, d) || near(a.first, d) && near(c, b.first),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spectrum(lines: &[(f64, f64)]) -> Spectrum {
        let line = |(frequency, amplitude): &(f64, f64)| Line {
            frequency: *frequency,
            deviation: 1e-6,
            amplitude: *amplitude,
        };
        let lines = lines.iter().map(line).collect();
        Spectrum {
            lines,
            resolution: 0.01,
            highest: 5.0,
            is_cut: false,
            rivals: Vec::new(),
            rest: 0.0,
            whole: 1.0,
        }
    }

    /// Sums of two frequencies that no common measure has.
    #[test]
    fn two_frequencies_are_found_in_their_sums() {
        let [f, g] = [0.3713, 0.2169];
        let sums = [(2, 0, 1.0), (2, -2, 0.6), (0, 2, 0.3), (1, 1, 0.2), (2, 2, 0.1)];
        let lines: Vec<_> =
            sums.iter().map(|(j, k, a)| (f64::from(*j) * f + f64::from(*k) * g, *a)).collect();
        let spectrum = spectrum(&lines);
        let pairs = frequency_pairs(&spectrum);
        let best = &pairs[0];
        assert!(best.second.is_some() && best.explained > 1.0 - 1e-12, "{best:?}");
        // the lattice of the sums is that of f + g and f − g, which have a pair among the best
        let is = |x: f64| (x - f - g).abs() < 1e-5 || (x - f + g).abs() < 1e-5;
        assert!(pairs.iter().any(|pair| is(pair.first) && pair.second.is_some_and(is)), "{pairs:#?}");
        let numbers = numbers_of(&spectrum, f, Some(g));
        assert_eq!(numbers, sums.map(|(j, k, _)| Some([j, k])).to_vec());
        let told = FrequencyPair::of_numbers(&spectrum, numbers, true).unwrap();
        assert!((told.first - f).abs() < 1e-9 && (told.second.unwrap() - g).abs() < 1e-9);
    }

    #[test]
    fn multiples_of_one_frequency_need_no_second() {
        let pairs = frequency_pairs(&spectrum(&[(0.5, 1.0), (1.0, 0.3), (0.25, 0.1)]));
        assert_eq!(pairs[0].second, None);
        assert!((pairs[0].first - 0.25).abs() < 1e-9, "{pairs:?}");
    }
}
