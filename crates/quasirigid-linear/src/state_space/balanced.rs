//! Balanced truncation of a stable system by square roots of its Gramians, which are never multiplied out. (M23)

use super::lyapunov::{controllable, observable};
use super::schur::{Schur, singular};
use super::{Real, System};
use crate::eigen::NoConvergence;

/// Truncated system, and what its error is known by.
#[derive(Clone, Debug)]
pub(super) struct Balanced {
    pub system: System,
    /// Hankel singular values, descending.
    pub singular_values: Vec<f64>,
    /// Bound on the H∞ norm of the error.
    pub bound: f64,
}

impl Balanced {
    /// Keeps so many states, or fewer where the others are rounding. `[@tombs1987]`
    pub fn of(system: &System, states: usize) -> Result<Self, NoConvergence> {
        let schur = Schur::of(&system.A)?;
        let reached = controllable(&schur, &system.B);
        let seen = observable(&schur, &system.C);
        let (left, values, right) = singular(&(seen.transpose() * &reached))?;
        let size = system.states();
        let rounding = size as f64 * f64::EPSILON * values.first().copied().unwrap_or(0.0);
        let kept = states.min(values.iter().filter(|value| **value > rounding).count());
        let weighted = |root: &Real, vectors: &Real| {
            let mut columns = root * vectors.columns(0, kept);
            columns
                .column_iter_mut()
                .zip(&values)
                .for_each(|(mut column, value)| column.unscale_mut(value.sqrt()));
            columns
        };
        let (rows, columns) = (weighted(&seen, &left).transpose(), weighted(&reached, &right));
        let left_out = values[kept..].iter().map(|value| value.max(rounding)).sum::<f64>();
        Ok(Self {
            system: System {
                A: &rows * &system.A * &columns,
                B: rows * &system.B,
                C: &system.C * columns,
                D: system.D.clone(),
            },
            singular_values: values,
            bound: 2.0 * left_out,
        })
    }
}
