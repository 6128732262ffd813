//! Truncation of a state space: motions that last are split off and kept, of the others the ones that matter least are left out.
//! Equations (M22) and (M23), docs/theory/15-modes.md.

use thiserror::Error;

use super::balanced::Balanced;
use super::poles::Poles;
use super::response::{Response, gain};
use super::scales::{Scales, frequencies};
use super::schur::Schur;
use super::split::split;
use super::{C, StateSpace, System, modal};
use crate::eigen::NoConvergence;

/// Method of truncation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TruncationMethod {
    /// States that are hardly reached by the inputs and hardly seen in the outputs are left out; motions that last are kept.
    Balanced,
    /// Fast modes are left out but for their static response.
    Modal,
}

/// What is asked of a truncation.
#[derive(Clone, Copy, Debug)]
pub struct TruncationRequest<'a> {
    /// Method.
    pub method: TruncationMethod,
    /// Number of states to keep.
    pub states: usize,
    /// Rate (rad/s) besides zero at which rigid motions last: the spin.
    pub rate: f64,
    /// Kind of each input, numbered from 0; inputs of a kind have one scale.
    pub inputs: &'a [usize],
    /// Kind of each output.
    pub outputs: &'a [usize],
}

/// Truncated system with the error. Errors are gains between channels divided by their scales.
#[derive(Clone, Debug, PartialEq)]
pub struct Truncation {
    /// The system.
    pub system: StateSpace,
    /// Number of states that do not decay, of all that are kept.
    pub lasting: usize,
    /// Hankel singular values of the part that decays, descending; none of a modal truncation.
    pub singular_values: Vec<f64>,
    /// Bound on the gain of the error.
    pub bound: f64,
    /// Frequency (rad/s) up to which the bound holds; none where it holds at all frequencies.
    pub up_to: Option<f64>,
    /// Largest gain of the error that was found, up to that frequency.
    pub found: f64,
    /// Frequency (rad/s) of that error.
    pub frequency: f64,
    /// Whether rounding spoils the system: an error beyond its bound was found.
    pub spoiled: bool,
    /// Scale of each input, and of each output.
    pub scales: [Vec<f64>; 2],
}

/// Error of a truncation.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TruncationError {
    /// Fewer states than motions that cannot be left out.
    #[error(
        "{least} states do not decay and have no Gramians: rigid motions, and modes without damping{frequencies}; keep {least} or more, give the modes damping, or truncate by modes"
    )]
    Lasting {
        /// States that must be kept.
        least: usize,
        /// Frequencies of the undamped modes, in words.
        frequencies: String,
    },
    /// Fewer states than rigid and growing motions.
    #[error(
        "{least} states are rigid or growing motions, which no truncation leaves out; keep {least} or more"
    )]
    Rigid {
        /// States that must be kept.
        least: usize,
    },
    /// The boundary is between eigenvalues of one size.
    #[error("{asked} states end between modes of one frequency; keep {below} or {above}")]
    Between {
        /// States asked for.
        asked: usize,
        /// The next number below that is possible.
        below: usize,
        /// The next number above.
        above: usize,
    },
    /// The model is no larger than what is asked for.
    #[error("the model has {states} states; keep fewer")]
    Small {
        /// States of the model.
        states: usize,
    },
    /// The model is too large.
    #[error(
        "the model has {states} states, more than the {MOST_STATES} that are truncated; give it fewer modes or elements"
    )]
    Large {
        /// States of the model.
        states: usize,
    },
    /// The solver.
    #[error(transparent)]
    NoConvergence(#[from] NoConvergence),
}

/// States that are worked with.
const MOST_STATES: usize = 1000;
/// Relative difference of sizes within which modes are not told apart.
const ALIKE: f64 = 1e-6;
/// Ratio of the slowest mode left out to the frequency up to which the rigid motions alone are judged.
const FOLLOWS: f64 = 10.0;
/// Share of a gain that is rounding.
const ROUNDING: f64 = 1e-9;

impl StateSpace {
    /// Leaves out states. (M22), (M23)
    ///
    /// # Errors
    /// [`TruncationError`]: a number of states that cannot be, or a failed solver.
    pub fn truncated(&self, asked: &TruncationRequest<'_>) -> Result<Truncation, TruncationError> {
        let states = self.A.len();
        if states > MOST_STATES {
            return Err(TruncationError::Large { states });
        }
        if asked.states >= states {
            return Err(TruncationError::Small { states });
        }
        let system = System::of(self).balanced();
        let schur = Schur::of(&system.A)?;
        let poles = Poles::of(&schur, asked.rate);
        let grid = frequencies(&poles);
        let kinds = [asked.inputs, asked.outputs];
        let (mut found, scales) = match asked.method {
            TruncationMethod::Balanced => {
                let lasting = poles.lasting(asked.states)?;
                let [own, rest] = split(&system, &schur, &lasting)?;
                let scales = Scales::of(&rest, &grid, kinds)?;
                let part = Balanced::of(&scales.scaled(&rest), asked.states - own.states())?;
                let whole = own.beside(&scales.unscaled(&part.system));
                (Truncation::new(whole, own.states(), part.singular_values, (part.bound, None)), scales)
            }
            TruncationMethod::Modal => {
                let slow = poles.slowest(asked.states)?;
                let [mut own, fast] = split(&system, &schur, &slow)?;
                let [_, vibrations] = split(&system, &schur, &poles.staying())?;
                let scales = Scales::of(&vibrations, &grid, kinds)?;
                let up_to = poles.edge(&slow);
                let bound = modal::bound(&scales.scaled(&fast), up_to)?;
                own.D += modal::static_part(&fast)?;
                let lasting = (0..states).filter(|k| slow[*k] && poles.lasting[*k]).count();
                (Truncation::new(own, lasting, Vec::new(), (bound, Some(up_to))), scales)
            }
        };
        found.compare(&system, &scales, &grid)?;
        found.scales = [scales.inputs, scales.outputs];
        Ok(found)
    }
}

impl Truncation {
    fn new(
        system: System,
        lasting: usize,
        singular_values: Vec<f64>,
        (bound, up_to): (f64, Option<f64>),
    ) -> Self {
        Self {
            system: system.listed(),
            lasting,
            singular_values,
            bound,
            up_to,
            found: 0.0,
            frequency: 0.0,
            spoiled: false,
            scales: [Vec::new(), Vec::new()],
        }
    }

    /// Compares responses at frequencies.
    fn compare(&mut self, full: &System, scales: &Scales, grid: &[f64]) -> Result<(), NoConvergence> {
        let own = Response::of(&scales.scaled(&System::of(&self.system)))?;
        let full = Response::of(&scales.scaled(full))?;
        for frequency in grid.iter().filter(|frequency| self.up_to.is_none_or(|last| **frequency <= last)) {
            let s = C::new(0.0, *frequency);
            let (whole, part) = (full.at(s), own.at(s));
            let size = gain(&whole);
            if !size.is_finite() {
                continue; // at a pole that lasts
            }
            let error = gain(&(&whole - part)) - ROUNDING * size;
            self.spoiled |= error > (1.0 + ROUNDING) * self.bound;
            if error > self.found {
                (self.found, self.frequency) = (error, *frequency);
            }
        }
        Ok(())
    }
}

impl Poles {
    /// The eigenvalues that do not decay.
    fn lasting(&self, asked: usize) -> Result<Vec<bool>, TruncationError> {
        let least = self.lasting.iter().filter(|lasts| **lasts).count();
        if asked >= least {
            return Ok(self.lasting.clone());
        }
        let undamped =
            (0..self.values.len()).filter(|k| self.lasting[*k] && !self.rigid[*k] && !self.growing[*k]);
        let listed: Vec<_> = undamped
            .map(|k| self.values[k].im)
            .filter(|frequency| *frequency > 0.0)
            .map(|frequency| format!("{frequency:.4}"))
            .collect();
        let frequencies =
            if listed.is_empty() { String::new() } else { format!(" at {} rad/s", listed.join(", ")) };
        Err(TruncationError::Lasting { least, frequencies })
    }

    /// The rigid and growing motions.
    fn staying(&self) -> Vec<bool> {
        self.rigid.iter().zip(&self.growing).map(|(rigid, growing)| *rigid || *growing).collect()
    }

    /// Frequency (rad/s) of the fastest mode that is kept, or where those left out begin to follow.
    fn edge(&self, kept: &[bool]) -> f64 {
        let sizes =
            |own: bool| (0..kept.len()).filter(move |k| kept[*k] == own).map(|k| self.values[k].norm());
        sizes(true).fold(sizes(false).fold(f64::INFINITY, f64::min) / FOLLOWS, f64::max)
    }

    /// The rigid and growing motions, and the slowest of the others.
    fn slowest(&self, asked: usize) -> Result<Vec<bool>, TruncationError> {
        let staying = self.staying();
        let own = |k: usize| staying[k];
        let mut order: Vec<usize> = (0..self.values.len()).collect();
        let size = |k: usize| if own(k) { 0.0 } else { self.values[k].norm() };
        order.sort_by(|a, b| size(*a).total_cmp(&size(*b)));
        let least = (0..order.len()).filter(|k| own(*k)).count();
        if asked < least {
            return Err(TruncationError::Rigid { least });
        }
        let between = |states: usize| {
            let on = |place: usize| order.get(place).map(|k| size(*k));
            let (Some(last), Some(next)) = (states.checked_sub(1).and_then(on), on(states)) else {
                return false;
            };
            states > least && next <= (1.0 + ALIKE) * last
        };
        if between(asked) {
            let below = (least..asked).rev().find(|states| !between(*states)).unwrap_or(least);
            let above = (asked..=order.len()).find(|states| !between(*states)).unwrap_or(order.len());
            return Err(TruncationError::Between { asked, below, above });
        }
        let mut first = vec![false; order.len()];
        order[..asked].iter().for_each(|k| first[*k] = true);
        Ok(first)
    }
}
