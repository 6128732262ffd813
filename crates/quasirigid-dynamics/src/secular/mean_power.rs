//! Mean power of a history over its wobble, from the energy dissipated at its rows.
//! Equation (Q20), docs/theory/16-methods.md.

use super::direct::{DirectRow, DirectRun};

/// Half width of the window, in periods of the wobble and in rows.
const PERIODS: f64 = 1.5;
const ROWS: f64 = 8.0;
/// Largest half width, as a share of the history.
const MOST: f64 = 0.25;

impl DirectRun {
    /// Mean power (W) at a row over a wobble of this period (s): that of the row where it is known, else the slope of the dissipated energy.
    pub fn mean_power(&self, row: usize, period: f64) -> f64 {
        self.powers.get(row).copied().unwrap_or_else(|| self.mean_slope(self.rows[row].t, period))
    }

    /// Mean power (W) at a time (s): slope of the dissipated energy over whole periods, continued evenly in the logarithm to the ends of the
    /// history. (Q20)
    fn mean_slope(&self, t: f64, period: f64) -> f64 {
        let end = self.rows[self.rows.len() - 1].t;
        let half = (PERIODS * period).max(ROWS * self.spacing(t)).min(MOST * end);
        let [near, far] = if t < half {
            [half, 2.0 * half]
        } else if t <= end - half {
            return self.slope(t, half);
        } else {
            [end - half, end - 2.0 * half]
        };
        let [at, beyond] = [near, far].map(|centre| self.slope(centre, half));
        let continued = at * (at / beyond).powf((t - near) / (near - far));
        if continued.is_finite() { continued } else { at }
    }

    /// Distance (s) of the rows about a time.
    fn spacing(&self, t: f64) -> f64 {
        let after = self.rows.partition_point(|row| row.t < t).clamp(1, (self.rows.len() - 1).max(1));
        self.rows.get(after).map_or(0.0, |row| row.t - self.rows[after - 1].t)
    }

    /// Slope (W) of the dissipated energy about a time by weighted least squares; each row counts as the time it stands for.
    fn slope(&self, centre: f64, half: f64) -> f64 {
        let rows = &self.rows;
        let first = rows.partition_point(|row| row.t <= centre - half).saturating_sub(1);
        let last = rows.partition_point(|row| row.t < centre + half).min(rows.len() - 1);
        let weight = |i: usize| {
            let u = (rows[i].t - centre) / half;
            let stands_for = rows[(i + 1).min(last)].t - rows[i.max(first + 1) - 1].t;
            stands_for * (1.0 - (u * u).min(1.0)).powi(2)
        };
        let sum =
            |of: &dyn Fn(DirectRow) -> f64| (first..=last).map(|i| weight(i) * of(rows[i])).sum::<f64>();
        let whole = sum(&|_| 1.0);
        let [time, energy] = [sum(&|row| row.t) / whole, sum(&|row| row.dissipated) / whole];
        let slope =
            sum(&|row| (row.t - time) * (row.dissipated - energy)) / sum(&|row| (row.t - time).powi(2));
        if slope.is_finite() { slope } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::dynamics::FullState;

    const RATE: f64 = 0.01;
    const PERIOD: f64 = 7.0;

    /// Energy (J) taken by a power `e^{−rt}(1 + 0.4 cos ωt + 0.6 sin 2ωt)`, whose mean is `e^{−rt}`.
    fn dissipated(t: f64) -> f64 {
        let of = |omega: f64, cosine: f64, sine: f64| {
            let (r, w) = (RATE, omega);
            let primitive = |t: f64| {
                let (s, c) = (w * t).sin_cos();
                (-r * t).exp() * (cosine * (w * s - r * c) - sine * (r * s + w * c)) / (r * r + w * w)
            };
            primitive(t) - primitive(0.0)
        };
        let omega = TAU / PERIOD;
        of(0.0, 1.0, 0.0) + of(omega, 0.4, 0.0) + of(2.0 * omega, 0.0, 0.6)
    }

    fn run(spacing: f64, end: f64) -> DirectRun {
        let count = (end / spacing).round() as usize;
        let row = |i: usize| {
            let t = i as f64 * spacing;
            DirectRow { t, energy: 0.0, dissipated: dissipated(t), revolutions: t }
        };
        DirectRun {
            rows: (0..=count).map(row).collect(),
            powers: Vec::new(),
            ending: super::super::DirectStopReason::Finished,
            last: FullState {
                omega: [0.0; 3],
                attitude: [1.0, 0.0, 0.0, 0.0],
                q: Vec::new(),
                rate: Vec::new(),
                place: [0.0; 3],
                velocity: [0.0; 3],
            },
            budget: Vec::new(),
            energy_drift: 0.0,
            steps: 0,
        }
    }

    #[test]
    fn the_swing_of_the_power_within_a_period_is_not_in_its_mean() {
        for spacing in [0.05, 0.3, 1.0, 2.2, 3.1] {
            let run = run(spacing, 400.0);
            for t in [0.0, 3.0, 20.0, 151.0, 399.0] {
                let ratio = run.mean_slope(t, PERIOD) / (-RATE * t).exp();
                assert!((ratio - 1.0).abs() < 0.02, "spacing {spacing}, t {t}: {ratio}");
            }
        }
    }

    #[test]
    fn rows_that_follow_each_other_after_many_periods_give_the_mean_as_well() {
        let run = run(0.37 * PERIOD, 300.0);
        let ratio = run.mean_slope(0.0, PERIOD);
        assert!((ratio - 1.0).abs() < 0.03, "{ratio}");
    }

    #[test]
    fn short_histories_have_a_power_too() {
        let run = run(1.0, 8.0);
        assert!(run.mean_slope(0.0, PERIOD) > 0.0 && run.mean_slope(8.0, PERIOD) > 0.0);
        let single = DirectRun { rows: run.rows[..1].to_vec(), ..run };
        assert_eq!(single.mean_slope(0.0, PERIOD), 0.0);
    }
}
