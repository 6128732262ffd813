//! Order of an integrator, from histories of one run at several steps.

use serde::Serialize;

use super::drift::Drift;
use super::error::AuditError;
use super::measure::Measured;
use crate::words::significant;

/// Order of the integrator, of several histories.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OrderObject {
    /// Power of the step with which the drift falls; `null` where a history shows none.
    pub order: Option<f64>,
    /// Step (s) of each history.
    pub steps: Vec<f64>,
    /// Drift of each: rate of the wobble (1/s), or where a history shows none the relative change of the energy.
    pub drifts: Vec<f64>,
    /// Step (s) at which the limits would be kept; `null` without limits or order.
    pub enough_step: Option<f64>,
    /// The same in words.
    pub sentence: String,
}

/// A history of a run with its step (s).
pub struct Run {
    step: f64,
    rate: Option<f64>,
    energy: Option<f64>,
    start: [f64; 3],
    duration: f64,
}

/// Limits that were asked for: of relative drifts, and of the time constant (s).
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits {
    /// Of the relative changes of energy and angular momentum.
    pub drift: Option<f64>,
    /// Least time constant (s).
    pub time_constant: Option<f64>,
}

/// Difference of starts and lengths, relative, up to which histories are of one run.
const SAME: f64 = 1e-3;
/// Difference of steps, relative, from which an order shows.
const APART: f64 = 0.05;

impl Run {
    /// The run of a history, at a step (s) or at that of its rows.
    pub fn of(measured: &Measured, drift: &Drift, step: Option<f64>) -> Self {
        let t = &measured.file.t;
        let duration = t.last().unwrap_or(&0.0) - t[0];
        let seen = drift.wobble_trend.filter(super::trend::Trend::is_seen);
        let energy = drift.energy_change;
        Self {
            step: step.unwrap_or(duration / (t.len() - 1) as f64),
            rate: seen.map(|trend| trend.slope.abs()),
            energy: (energy.last.abs() > energy.rounding).then_some(energy.last.abs()),
            start: measured.file.rates[0],
            duration,
        }
    }
}

/// The order that several runs show.
pub fn order(runs: &[Run], limits: Limits, nutation: &str) -> Result<OrderObject, AuditError> {
    let steps: Vec<f64> = runs.iter().map(|run| run.step).collect();
    let refuse = |problem: String| Err(AuditError::Steps { problem });
    let first = &runs[0];
    for (number, run) in runs.iter().enumerate() {
        let apart = (0..3).map(|i| (run.start[i] - first.start[i]).powi(2)).sum::<f64>().sqrt();
        let size = quasirigid_math::vec3::norm(first.start);
        if apart > SAME * size || (run.duration / first.duration - 1.0).abs() > SAME {
            return refuse(format!(
                "history {} starts otherwise than the first, or has another length; give histories of one run at different steps",
                number + 1
            ));
        }
        if !(run.step > 0.0) || runs[..number].iter().any(|other| (other.step / run.step - 1.0).abs() < APART)
        {
            return refuse(format!(
                "the step of history {} is {} s, that of another too; give the step of each, as --steps 0.01,0.005",
                number + 1,
                significant(run.step, 4)
            ));
        }
    }
    let all = |of: fn(&Run) -> Option<f64>| runs.iter().map(of).collect::<Option<Vec<f64>>>();
    let rates = all(|run| run.rate);
    let by_rate = rates.is_some();
    let drifts = rates.or_else(|| all(|run| run.energy));
    let order = drifts.as_ref().map(|drifts| slope(&steps, drifts));
    let smallest = (0..runs.len()).min_by(|a, b| steps[*a].total_cmp(&steps[*b])).unwrap_or(0);
    let enough = order.filter(|order| *order > 0.0).and_then(|order| {
        let run = &runs[smallest];
        let of = |excess: f64| run.step * excess.powf(-order.recip());
        let by_drift = limits.drift.and_then(|limit| Some(of(run.energy? / limit)));
        let by_time = limits.time_constant.and_then(|least| Some(of(run.rate? * least)));
        by_drift.into_iter().chain(by_time).reduce(f64::min)
    });
    let sentence = words(order, by_rate.then_some(nutation), enough);
    Ok(OrderObject { order, steps, drifts: drifts.unwrap_or_default(), enough_step: enough, sentence })
}

/// Slope of logarithms, by least squares.
fn slope(steps: &[f64], drifts: &[f64]) -> f64 {
    let count = steps.len() as f64;
    let [x, y] = [steps, drifts].map(|values| values.iter().map(|value| value.ln()).collect::<Vec<_>>());
    let [mean_x, mean_y] = [&x, &y].map(|values| values.iter().sum::<f64>() / count);
    let both: f64 = x.iter().zip(&y).map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    both / x.iter().map(|x| (x - mean_x).powi(2)).sum::<f64>()
}

fn words(order: Option<f64>, by_rate_of: Option<&str>, enough: Option<f64>) -> String {
    let Some(order) = order else {
        return "The order of the integrator does not show: a history has no drift above its digits."
            .to_owned();
    };
    let what = by_rate_of.map_or_else(
        || "change of the energy".to_owned(),
        |nutation| format!("invented rate of the {nutation}"),
    );
    let first = format!("The {what} falls with the power {} of the step", significant(order, 3));
    match enough {
        Some(step) => format!("{first}; a step of {} s would keep the limit.", significant(step, 3)),
        None if order <= 0.0 => format!("{first}: a smaller step does not help."),
        None => format!("{first}."),
    }
}

/// What one history says of the order.
pub fn unknown() -> &'static str {
    "the order of the integrator does not show in one history; audit one at another step beside it to learn which step is enough"
}
