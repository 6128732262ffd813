//! Units of the states in which rows and columns of a matrix are alike.

use super::System;

/// Most rounds over the states.
const ROUNDS: usize = 60;

impl System {
    /// The system with its states in other units, powers of two. `[@osborne1960]`
    pub(super) fn balanced(mut self) -> Self {
        for _ in 0..ROUNDS {
            let mut changed = false;
            for state in 0..self.states() {
                let without = |square: f64| (square - self.A[(state, state)].powi(2)).max(0.0).sqrt();
                let row = without(self.A.row(state).norm_squared());
                let column = without(self.A.column(state).norm_squared());
                if row == 0.0 || column == 0.0 {
                    continue;
                }
                let unit = (0.5 * (row / column).log2()).round().exp2();
                if unit != 1.0 {
                    changed = true;
                    self.A.row_mut(state).unscale_mut(unit);
                    self.A.column_mut(state).scale_mut(unit);
                    self.B.row_mut(state).unscale_mut(unit);
                    self.C.column_mut(state).scale_mut(unit);
                }
            }
            if !changed {
                break;
            }
        }
        self
    }
}
