//! Units of the states in which rows and columns of a matrix are alike.

use super::System;
use super::components::dependent;

/// Most rounds over the states.
const ROUNDS: usize = 60;

impl System {
    /// The system with its states in other units, powers of two: alike within each group of states that depend on each other, since what
    /// one group gives to another has no size of its own. `[@osborne1960]`
    pub(super) fn balanced(mut self) -> Self {
        for group in dependent(&self.A) {
            let changes =
                |own: &mut Self| group.iter().filter(|state| own.balance(&group, **state)).count() > 0;
            (0..ROUNDS).take_while(|_| changes(&mut self)).for_each(drop);
        }
        self
    }

    /// Whether a state of a group takes another unit.
    fn balance(&mut self, group: &[usize], state: usize) -> bool {
        let others = || group.iter().filter(|other| **other != state);
        let row = others().fold(0.0_f64, |sum, other| sum.hypot(self.A[(state, *other)]));
        let column = others().fold(0.0_f64, |sum, other| sum.hypot(self.A[(*other, state)]));
        let unit = (0.5 * (row / column).log2()).round().exp2();
        if row == 0.0 || column == 0.0 || unit == 1.0 {
            return false;
        }
        self.A.row_mut(state).unscale_mut(unit);
        self.A.column_mut(state).scale_mut(unit);
        self.B.row_mut(state).unscale_mut(unit);
        self.C.column_mut(state).scale_mut(unit);
        true
    }
}
