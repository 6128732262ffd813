//! Times at which a force acts: windows, and tables of its components.
//! Equations (F13), (F14), docs/theory/07-forces.md.

use thiserror::Error;

use crate::math::scalar::Smooth;

/// Windows of time in which a force acts, ascending and apart. (F13)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Windows(Vec<[f64; 2]>);

/// Problem of a list of windows or of a timetable.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum TimingProblem {
    /// There is nothing in it.
    #[error("it is empty: the force would never act")]
    Empty,
    /// A number is not finite.
    #[error("entry {index} has a number that is not finite")]
    NotFinite {
        /// Number of the entry, from 1.
        index: usize,
    },
    /// A window ends before it begins.
    #[error("window {index} ends at {to} s, which is not after its start at {from} s")]
    Reversed {
        /// Number of the window, from 1.
        index: usize,
        /// Begin (s).
        from: f64,
        /// End (s).
        to: f64,
    },
    /// A window begins before the one above it ends.
    #[error("window {index} begins at {from} s, before window {} ends at {until} s", index - 1)]
    Overlap {
        /// Number of the window, from 1.
        index: usize,
        /// Begin (s).
        from: f64,
        /// End of the window before (s).
        until: f64,
    },
    /// Times of a table do not ascend.
    #[error("row {index} is at {t} s, which is not after {before} s in the row before")]
    Unsorted {
        /// Number of the row, from 1.
        index: usize,
        /// Time (s).
        t: f64,
        /// Time of the row before (s).
        before: f64,
    },
}

impl TimingProblem {
    /// Number of the entry at fault, from 1.
    #[must_use]
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Empty => None,
            Self::NotFinite { index }
            | Self::Reversed { index, .. }
            | Self::Overlap { index, .. }
            | Self::Unsorted { index, .. } => Some(*index),
        }
    }
}

impl Windows {
    /// Windows from begin to end (s).
    ///
    /// # Errors
    /// [`TimingProblem`] for windows that are none, overlap, or are out of order.
    pub fn new(windows: Vec<[f64; 2]>) -> Result<Self, TimingProblem> {
        if windows.is_empty() {
            return Err(TimingProblem::Empty);
        }
        for (number, [from, to]) in (1..).zip(&windows) {
            if !(from.is_finite() && to.is_finite()) {
                return Err(TimingProblem::NotFinite { index: number });
            }
            if to <= from {
                return Err(TimingProblem::Reversed { index: number, from: *from, to: *to });
            }
        }
        for (number, pair) in (2..).zip(windows.windows(2)) {
            if pair[1][0] < pair[0][1] {
                return Err(TimingProblem::Overlap { index: number, from: pair[1][0], until: pair[0][1] });
            }
        }
        Ok(Self(windows))
    }

    /// Whether a time (s) lies in a window; its begin does, its end does not. (F13)
    #[must_use]
    pub fn contains(&self, t: f64) -> bool {
        let after = self.0.partition_point(|[from, _]| *from <= t);
        after > 0 && t < self.0[after - 1][1]
    }

    /// Begins and ends (s).
    #[must_use]
    pub fn list(&self) -> &[[f64; 2]] {
        &self.0
    }
}

/// Course of the components between the rows of a timetable.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Each row holds until the next.
    #[default]
    Held,
    /// Straight from row to row.
    Linear,
}

/// Components of a force or torque at given times. Nothing acts before the first row; the last row holds on. (F14)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Timetable {
    times: Vec<f64>,
    components: Vec<[f64; 3]>,
    interpolation: Interpolation,
}

impl Timetable {
    /// From rows of time (s) and components (N or N·m).
    ///
    /// # Errors
    /// [`TimingProblem`] for no rows, numbers that are not finite, and times that do not ascend.
    pub fn new(rows: &[(f64, [f64; 3])], interpolation: Interpolation) -> Result<Self, TimingProblem> {
        if rows.is_empty() {
            return Err(TimingProblem::Empty);
        }
        let finite =
            |(t, value): &(f64, [f64; 3])| t.is_finite() && value.iter().all(|part| part.is_finite());
        if let Some(index) = rows.iter().position(|row| !finite(row)) {
            return Err(TimingProblem::NotFinite { index: index + 1 });
        }
        let ascends = |pair: &[(f64, [f64; 3])]| pair[1].0 > pair[0].0;
        if let Some(index) = rows.windows(2).position(|pair| !ascends(pair)) {
            return Err(TimingProblem::Unsorted {
                index: index + 2,
                t: rows[index + 1].0,
                before: rows[index].0,
            });
        }
        let (times, components) = rows.iter().copied().unzip();
        Ok(Self { times, components, interpolation })
    }

    /// Times of the rows (s).
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Components at a time, which may be a series: those of the piece that its value lies in. (F14)
    #[must_use]
    pub fn at<T: Smooth>(&self, t: T) -> [T; 3] {
        let after = self.times.partition_point(|time| *time <= t.value());
        if after == 0 {
            return [T::from(0.0); 3];
        }
        let value = self.components[after - 1];
        if self.interpolation == Interpolation::Held || after == self.times.len() {
            return value.map(T::from);
        }
        let (from, to) = (self.times[after - 1], self.times[after]);
        let share = (t - T::from(from)) * T::from(1.0 / (to - from));
        std::array::from_fn(|i| T::from(value[i]) + share * T::from(self.components[after][i] - value[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::taylor::Taylor;

    #[test]
    fn windows_hold_their_begin_and_not_their_end() {
        let windows = Windows::new(vec![[1.0, 2.0], [2.0, 3.0], [5.0, 6.0]]).unwrap();
        let inside = [0.9, 1.0, 1.5, 2.0, 3.0, 4.0, 5.5, 6.0].map(|t| windows.contains(t));
        assert_eq!(inside, [false, true, true, true, false, false, true, false]);
    }

    #[test]
    fn windows_that_mean_nothing_are_refused() {
        let refused = |list: &[[f64; 2]]| Windows::new(list.to_vec()).unwrap_err();
        assert_eq!(refused(&[]), TimingProblem::Empty);
        assert!(matches!(refused(&[[2.0, 1.0]]), TimingProblem::Reversed { index: 1, .. }));
        assert!(matches!(refused(&[[1.0, 1.0]]), TimingProblem::Reversed { .. }));
        assert!(matches!(refused(&[[0.0, 2.0], [1.0, 3.0]]), TimingProblem::Overlap { index: 2, .. }));
        assert!(matches!(refused(&[[5.0, 6.0], [1.0, 3.0]]), TimingProblem::Overlap { index: 2, .. }));
        assert!(matches!(refused(&[[0.0, f64::NAN]]), TimingProblem::NotFinite { index: 1 }));
    }

    #[test]
    fn rows_are_held_or_joined_by_lines() {
        let rows = [(1.0, [1.0, 0.0, -2.0]), (3.0, [2.0, 4.0, 0.0])];
        let [held, linear] =
            [Interpolation::Held, Interpolation::Linear].map(|way| Timetable::new(&rows, way).unwrap());
        assert_eq!(held.at(0.5), [0.0; 3]);
        assert_eq!(held.at(2.9), [1.0, 0.0, -2.0]);
        assert_eq!(held.at(99.0), [2.0, 4.0, 0.0]);
        assert_eq!(linear.at(1.5), [1.25, 1.0, -1.5]);
        let slope = linear.at(Taylor::<3>::variable(2.0)).map(|part| part.coefficient(1));
        assert_eq!(slope, [0.5, 2.0, 1.0]);
        assert_eq!(linear.at(3.0), [2.0, 4.0, 0.0]);
        assert!(matches!(
            Timetable::new(&[(1.0, [0.0; 3]), (1.0, [0.0; 3])], Interpolation::Held),
            Err(TimingProblem::Unsorted { index: 2, .. })
        ));
    }
}
