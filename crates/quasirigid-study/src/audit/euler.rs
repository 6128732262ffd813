//! Unit of the rates against that of the times, from the motion itself: Euler's equations are of first order in time and of second in the rates.
//!
//! For numbers `w` of the rates and `t` of the times `dw/dt = c J⁻¹(Jw × w)`, where `c` is the product of the units in SI: 1 of rad/s and s. (J2)
//! The factor is found by least squares: each stretch of rows is propagated from its first row by Euler's equations, and its last row is
//! compared. A constant torque adds the same to every stretch, and is taken out.

use quasirigid_math::vec3::{add, dot, norm, scale};

use super::rigid::Rigid;

/// Factor of the units that fits a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnitFit {
    /// Factor `c`.
    pub factor: f64,
    /// Standard error of the factor, relative.
    pub error: f64,
    /// Share of the change of the rates that Euler's equations leave unexplained, as a root of squares.
    pub misfit: f64,
    /// Mean rotation (rad) over a stretch of rows at this factor: beyond π other factors may show the same rows.
    pub turn: f64,
}

/// Stretches of rows that are compared.
const STRETCHES: usize = 100;
/// Change of the rates over a stretch beside their whole range, from which rounding does not matter.
const CHANGE: f64 = 0.3;
/// Largest rotation (rad) of a step of the propagation, and of a whole stretch.
const STEP: f64 = 0.1;
const LONGEST: f64 = 100.0;
/// Iterations of the factor.
const ITERATIONS: usize = 4;
/// Stretches that are too few to take a torque out of them.
const FEW: usize = 8;
/// Share of rounding in the squares of the changes above which nothing is told.
const NOISE: f64 = 0.1;

/// History as numbers without units.
pub struct Numbers<'a> {
    /// Times.
    pub t: &'a [f64],
    /// Rates.
    pub rates: &'a [[f64; 3]],
    /// Most by which rounding may have changed the rates of a row.
    pub rounding: &'a dyn Fn(usize) -> [f64; 3],
}

/// The factors that fit, each next to one of those to start from, or all of them the best; none where the rates change too little to tell.
pub fn unit_fit(body: &Rigid, history: &Numbers<'_>, starts: &[f64]) -> Option<Vec<UnitFit>> {
    let stride = stride(history)?;
    let stretches = stretches(history, stride);
    if !changes(body, history, &stretches) {
        return None;
    }
    let linear = linear(body, history, &stretches);
    let fits = starts.iter().copied().chain(linear).filter_map(|start| fit(body, history, &stretches, start));
    Some(fits.collect())
}

/// Whether the rates change by more than rounding makes, a constant torque apart.
fn changes(body: &Rigid, history: &Numbers<'_>, stretches: &[(usize, usize)]) -> bool {
    let noise: f64 = stretches.iter().map(|stretch| noise(history, *stretch)).sum();
    let whole = sums(body, history, stretches, 0.0).map_or(0.0, |sums| sums.whole);
    whole * NOISE > noise
}

/// Square of the rounding of the change over a stretch.
fn noise(history: &Numbers<'_>, (a, b): (usize, usize)) -> f64 {
    [a, b]
        .map(|row| (history.rounding)(row).map(|error| error * error / 3.0).iter().sum::<f64>())
        .iter()
        .sum()
}

/// Number of rows over which the rates change much; none where rounding covers all changes.
fn stride(history: &Numbers<'_>) -> Option<usize> {
    let rows = history.rates.len();
    let mean = history.rates.iter().fold([0.0; 3], |sum, w| add(sum, scale((rows as f64).recip(), *w)));
    let about = |w: &[f64; 3]| norm(add(*w, scale(-1.0, mean))).powi(2);
    let range = (history.rates.iter().map(about).sum::<f64>() / rows as f64).sqrt();
    let mut stride = 1;
    loop {
        let stretches = stretches(history, stride);
        let change =
            |(a, b): &(usize, usize)| difference(history, *a, *b).map(|part| part * part).iter().sum::<f64>();
        let (changes, noises): (f64, f64) = (
            stretches.iter().map(change).sum(),
            stretches.iter().map(|stretch| noise(history, *stretch)).sum(),
        );
        let enough = changes > (CHANGE * range).powi(2) * stretches.len() as f64;
        if stretches.is_empty() {
            return None;
        }
        if enough || 4 * stride >= rows {
            return (changes * NOISE > noises).then_some(stride);
        }
        stride *= 2;
    }
}

/// First and last rows of stretches spread over the history. Every other one is shorter by a row, where there are rows between: what looks the
/// same after whole periods more in both must do so from row to row.
fn stretches(history: &Numbers<'_>, stride: usize) -> Vec<(usize, usize)> {
    let starts = history.rates.len().saturating_sub(stride);
    let count = starts.min(STRETCHES);
    let length = |k: usize| if stride > 1 { stride - k % 2 } else { stride };
    (0..count)
        .map(|k| (k * starts / count, length(k)))
        .map(|(start, length)| (start, start + length))
        .collect()
}

fn difference(history: &Numbers<'_>, a: usize, b: usize) -> [f64; 3] {
    add(history.rates[b], scale(-1.0, history.rates[a]))
}

/// The factor by the mean of both ends of each stretch, which is near where stretches are short.
fn linear(body: &Rigid, history: &Numbers<'_>, stretches: &[(usize, usize)]) -> Option<f64> {
    let (mut upper, mut lower) = (0.0, 0.0);
    for (a, b) in stretches {
        let ends = add(body.acceleration(history.rates[*a]), body.acceleration(history.rates[*b]));
        let flow = scale(0.5 * (history.t[*b] - history.t[*a]), ends);
        let change = difference(history, *a, *b);
        upper += (0..3).map(|i| flow[i] * change[i]).sum::<f64>();
        lower += flow.iter().map(|part| part * part).sum::<f64>();
    }
    Some(upper / lower).filter(|factor| *factor > 0.0 && factor.is_finite())
}

/// The factor next to a start, by Gauss and Newton; none where stretches are too long to propagate.
fn fit(body: &Rigid, history: &Numbers<'_>, stretches: &[(usize, usize)], start: f64) -> Option<UnitFit> {
    let mut factor = start;
    for _ in 0..ITERATIONS {
        let Sums { with_slope, slope, .. } = sums(body, history, stretches, factor)?;
        let change = with_slope / slope;
        if !change.is_finite() {
            break;
        }
        factor *= (1.0 + change).clamp(0.5, 2.0);
        if change.abs() < 1e-9 {
            break;
        }
    }
    let Sums { residual, whole, slope, .. } = sums(body, history, stretches, factor)?;
    let free = (3 * stretches.len()).saturating_sub(4).max(1) as f64;
    let turn = |(a, b): &(usize, usize)| norm(history.rates[*a]) * (history.t[*b] - history.t[*a]);
    let turn = factor * stretches.iter().map(turn).sum::<f64>() / stretches.len() as f64;
    let misfit = (residual / whole).sqrt();
    misfit.is_finite().then(|| UnitFit { factor, error: (residual / free / slope).sqrt(), misfit, turn })
}

/// Sums of squares over the stretches.
struct Sums {
    residual: f64,
    whole: f64,
    /// Of the slope of the propagated end by the logarithm of the factor, and of the residual with it.
    slope: f64,
    with_slope: f64,
}

fn sums(body: &Rigid, history: &Numbers<'_>, stretches: &[(usize, usize)], factor: f64) -> Option<Sums> {
    const SMALL: f64 = 1e-5;
    let (mut times, mut residuals, mut slopes, mut changes) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (a, b) in stretches {
        let (from, time) = (history.rates[*a], history.t[*b] - history.t[*a]);
        let end = propagated(body, from, factor * time)?;
        let further = propagated(body, from, factor * (1.0 + SMALL) * time)?;
        times.push(time);
        residuals.push(add(history.rates[*b], scale(-1.0, end)));
        slopes.push(scale(SMALL.recip(), add(further, scale(-1.0, end))));
        changes.push(difference(history, *a, *b));
    }
    if times.len() >= FEW {
        for vectors in [&mut residuals, &mut slopes, &mut changes] {
            without_torque(&times, vectors);
        }
    }
    Some(Sums {
        residual: product(&residuals, &residuals),
        whole: product(&changes, &changes),
        slope: product(&slopes, &slopes),
        with_slope: product(&residuals, &slopes),
    })
}

/// Takes out what a constant torque adds to each stretch, in proportion to its time.
fn without_torque(times: &[f64], vectors: &mut [[f64; 3]]) {
    let squares: f64 = times.iter().map(|time| time * time).sum();
    let torque = times
        .iter()
        .zip(&*vectors)
        .fold([0.0; 3], |sum, (time, vector)| add(sum, scale(time / squares, *vector)));
    for (time, vector) in times.iter().zip(vectors) {
        *vector = add(*vector, scale(-time, torque));
    }
}

fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum()
}

/// The rates after a time, by the classical method of Runge and Kutta; none where the body turns too far.
fn propagated(body: &Rigid, mut w: [f64; 3], time: f64) -> Option<[f64; 3]> {
    let turn = norm(w) * time;
    if !(turn < LONGEST) {
        return None;
    }
    let steps = (turn / STEP).ceil().max(1.0);
    let h = time / steps;
    for _ in 0..steps as usize {
        let first = body.acceleration(w);
        let second = body.acceleration(add(w, scale(0.5 * h, first)));
        let third = body.acceleration(add(w, scale(0.5 * h, second)));
        let fourth = body.acceleration(add(w, scale(h, third)));
        let sum = add(add(first, fourth), scale(2.0, add(second, third)));
        w = add(w, scale(h / 6.0, sum));
    }
    Some(w)
}
