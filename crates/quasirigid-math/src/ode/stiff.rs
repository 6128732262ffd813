//! Interface of systems with a stiff linear part, for implicit methods.
//! An implicit method needs the rates at all stages of a step at once; a system that can evaluate them side by side says so.

use super::radau_tableau::SHIFTS;
use super::system::System;
use crate::lanes::Lanes;
use crate::simd::Arithmetic;

/// System with a stiff linear part `L` that hardly changes in a step: `rate = L y + non-stiff rest`.
pub trait Stiff: System<Vec<f64>> {
    /// First of the components that `L` acts on; the components before it are not stiff.
    fn stiff(&self) -> usize;

    /// Whether `L` changes with the state.
    fn changes(&self) -> bool {
        false
    }

    /// Evaluates `L` at a time and a state, if it changes; [`shift`](Self::shift) is due.
    fn renew(&mut self, t: f64, y: &[f64]) {
        let _ = (t, y);
    }

    /// Prepares to solve `(s − L) x = right` at the shifts `s` (1/s): real and imaginary part.
    fn shift(&mut self, shifts: [[f64; 2]; SHIFTS]);

    /// Solves `(s − L) x = right` in place, at the shift with this number.
    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]);

    /// Number of components that steer the rates, in which the stages of a step may be evaluated side by side; none where the rates are found
    /// stage after stage.
    ///
    /// The steering components are those before this number and the stiff ones; the components between are integrals of rates.
    fn steering(&self) -> Option<usize> {
        None
    }

    /// Writes the rates of the steering components at eight states, one in each lane.
    fn rates_beside<R: Arithmetic>(&mut self, y: &[Lanes], rates: &mut [Lanes]) {
        let _ = (y, rates);
    }

    /// Writes the rates of the integrals, at the states of the last [`rates_beside`](Self::rates_beside) with the integrals at the start of the
    /// step: the rate of an integral may depend on one that is constant.
    fn integrands_beside<R: Arithmetic>(&mut self, y: &[Lanes], rates: &mut [Lanes]) {
        let _ = (y, rates);
    }
}
