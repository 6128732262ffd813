//! Derivative of a function that is known by its values alone: central differences extrapolated to a step of zero (Ridders 1982), with an
//! error estimate and with the change of slope of a corner.
//! Differences over one step tell nothing of either: the maximum of two crossing functions has a central difference too.

/// Halvings of the first step.
const HALVINGS: usize = 16;
/// Growth of the error over the least that ends the search, where rounding has taken over: that is once the least is below these shares of
/// the derivative, or of what is enough. Before it steps may be wider than what they are to see.
const WORSE: f64 = 4.0;
const FAIR: f64 = 1e-6;
const FAIR_OF_ENOUGH: f64 = 1e4;
/// Relative error of a corner at which it is one.
const SETTLED: f64 = 0.1;

/// Derivative with what is known of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Derivative {
    /// The derivative.
    pub value: f64,
    /// Estimate of its error.
    pub error: f64,
    /// Half the difference of the slopes after and before the place, as far as it exceeds its own error; zero where the function is smooth.
    pub corner: f64,
    /// Step of the last difference.
    pub step: f64,
}

/// Derivative at zero of a function with the value `at_zero` there, from steps no larger than `first`; extrapolation ends where the error
/// estimate is below `enough`. None where the function has no values on both sides at two successive steps.
///
/// ```
/// use quasirigid_math::derivative::derivative;
///
/// let found = derivative(1.0, 0.1, 1e-12, |x| Some((2.0 * x).exp())).unwrap();
/// assert!((found.value - 2.0).abs() < 1e-11 && found.error < 1e-10 && found.corner < 1e-9);
/// let corner = derivative(0.0, 0.1, 1e-12, |x: f64| Some(x.abs())).unwrap();
/// assert!((corner.corner - 1.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn derivative(
    at_zero: f64,
    first: f64,
    enough: f64,
    mut function: impl FnMut(f64) -> Option<f64>,
) -> Option<Derivative> {
    let (mut slopes, mut corners) = (Extrapolated::default(), Extrapolated::default());
    let mut best: Option<(Entry, f64)> = None;
    let mut corner: Option<Entry> = None;
    for halving in 0..HALVINGS {
        let step = first * 0.5f64.powi(halving as i32);
        let (Some(after), Some(before)) = (function(step), function(-step)) else {
            (slopes, corners) = Default::default();
            continue;
        };
        // the slope's terms go as the even powers of the step, those of the corner as the odd ones
        let slope = slopes.add((after - before) / (2.0 * step), 4.0);
        let bend = corners.add(((after - at_zero) + (before - at_zero)) / (2.0 * step), 2.0);
        let (Some(slope), Some(bend)) = (slope, bend) else { continue };
        if best.is_none_or(|(least, _)| slope.error < least.error) {
            best = Some((slope, step));
        }
        if corner.is_none_or(|least| bend.error < least.error) {
            corner = Some(bend);
        }
        let (Some((least, _)), Some(bend)) = (best, corner) else { continue };
        let settled = bend.error <= enough.max(SETTLED * bend.value.abs());
        let fair = least.error <= (FAIR * least.value.abs()).max(FAIR_OF_ENOUGH * enough);
        if (least.error <= enough && settled) || (fair && slope.error > WORSE * least.error.max(enough)) {
            break;
        }
    }
    let ((slope, step), bend) = (best?, corner?);
    let corner = (bend.value.abs() - bend.error).max(0.0);
    Some(Derivative { value: slope.value, error: slope.error, corner, step })
}

/// Entry of a tableau of extrapolation, with its error estimate.
#[derive(Clone, Copy)]
struct Entry {
    value: f64,
    error: f64,
}

/// Last row of a tableau of extrapolation.
#[derive(Default)]
struct Extrapolated {
    row: Vec<f64>,
}

impl Extrapolated {
    /// Adds the value at half the last step, whose terms fall by `first`, four times as much, and so on; the best entry of the new row, none of
    /// the first row.
    fn add(&mut self, value: f64, first: f64) -> Option<Entry> {
        let mut row = vec![value];
        let mut best: Option<Entry> = None;
        let mut fall = first;
        for before in &self.row {
            let entry = row[row.len() - 1];
            let value = entry + (entry - before) / (fall - 1.0);
            let error = (value - entry).abs().max((value - before).abs());
            if best.is_none_or(|best| error < best.error) {
                best = Some(Entry { value, error });
            }
            row.push(value);
            fall *= 4.0;
        }
        self.row = row;
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_smooth_functions_are_found_within_their_error() {
        type Case = (&'static str, fn(f64) -> f64, f64);
        let cases: [Case; 5] = [
            ("sine", |x| (x + 0.3).sin(), 0.3f64.cos()),
            ("power", |x| (1.0 + x).powf(-2.5), -2.5),
            ("pole", |x| 1.0 / (0.013 + x), -(0.013f64.powi(-2))),
            ("resonance", |x| 1.0 / ((x + 1e-3).powi(2) + 1e-6), -2e-3 / 4e-12),
            ("even", |x| x * x, 0.0),
        ];
        for (name, function, known) in cases {
            let found = derivative(function(0.0), 0.02, 0.0, |x| Some(function(x))).unwrap();
            let gap = (found.value - known).abs();
            assert!(gap <= 1e-8 * known.abs().max(1e-3), "{name}: {gap:e} {found:?}");
            assert!(gap <= 10.0 * found.error + 1e-13 * known.abs(), "{name}: {gap:e} {found:?}");
            assert!(found.corner <= 1e-6 * known.abs().max(1.0), "{name}: {found:?}");
        }
    }

    /// The larger of two functions that cross at zero has two slopes, and so has one with a jump.
    #[test]
    fn corners_and_jumps_are_seen() {
        let crossing = |x: f64| (1.0 + 3.0 * x).max((x - 1.0).exp() * std::f64::consts::E.powi(1));
        let found = derivative(1.0, 0.02, 1e-12, |x| Some(crossing(x))).unwrap();
        assert!((found.corner - 1.0).abs() < 1e-6, "{found:?}");
        let jump = |x: f64| if x > 0.0 { 1.001 } else { 1.0 };
        let found = derivative(1.0, 0.02, 1e-12, |x| Some(jump(x)));
        assert!(found.is_none_or(|found| found.corner > 0.01 || found.error > 0.01), "{found:?}");
    }

    #[test]
    fn rounding_is_in_the_error() {
        let rough = |x: f64| (1.0 + x).sqrt() + 1e-9 * (1e9 * x).sin();
        let found = derivative(1.0, 0.02, 0.0, |x| Some(rough(x))).unwrap();
        assert!((found.value - 0.5).abs() < 5.0 * found.error && found.error < 1e-5, "{found:?}");
    }

    #[test]
    fn steps_beyond_the_edge_of_the_function_are_halved() {
        let found = derivative(0.1, 0.02, 1e-13, |x| (x > -0.003).then(|| (0.01 + x).sqrt())).unwrap();
        assert!((found.value / 5.0 - 1.0).abs() < 1e-9 && found.step < 0.003, "{found:?}");
        assert!(derivative(0.1, 0.02, 1e-13, |x| (x >= 0.0).then_some(x)).is_none());
    }
}
