//! Bang-bang law of thrusters: deadband, hysteresis, minimum on-time. (Y7)

/// Thrusters in pairs that are on or off, one pair for each error. A sampled law alone. (Y7)
///
/// Inputs are the errors, then their rates. States: the sign in which each pair fires, and the samples for which it still must, pair by pair.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct RelayLaw {
    /// Torque of each pair (N·m).
    pub levels: Vec<f64>,
    /// Lead (s): a pair switches by its error plus this times the rate.
    pub lead: f64,
    /// Error beyond which a pair switches on.
    pub on: Vec<f64>,
    /// Error below which a pair switches off, at most that at which it switches on.
    pub off: Vec<f64>,
    /// Samples for which a pair stays on, at least.
    pub least: u32,
}

impl RelayLaw {
    /// Torques (N·m).
    pub(super) fn outputs(&self, inputs: &[f64], states: &[f64]) -> Vec<f64> {
        self.levels.iter().enumerate().map(|(i, level)| level * self.decision(i, inputs, states)[0]).collect()
    }

    /// Next states.
    pub(super) fn advance(&self, inputs: &[f64], states: &[f64]) -> Vec<f64> {
        (0..self.levels.len()).flat_map(|i| self.decision(i, inputs, states)).collect()
    }

    /// Sign in which a pair fires from this sample on, and the samples after it for which it still must.
    fn decision(&self, i: usize, inputs: &[f64], states: &[f64]) -> [f64; 2] {
        let (sign, left) = (states[2 * i], states[2 * i + 1]);
        if left > 0.0 {
            return [sign, left - 1.0];
        }
        let error = inputs[i] + self.lead * inputs[self.levels.len() + i];
        let stays = sign != 0.0 && -sign * error > self.off[i];
        if stays {
            [sign, 0.0]
        } else if error.abs() > self.on[i] {
            [-error.signum(), f64::from(self.least.max(1) - 1)]
        } else {
            [0.0, 0.0]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On beyond 2, off below 1, three samples at least; by hand.
    #[test]
    fn a_pair_switches_with_hysteresis_and_a_least_time() {
        let law = RelayLaw { levels: vec![0.5], lead: 2.0, on: vec![2.0], off: vec![1.0], least: 3 };
        let mut states = vec![0.0, 0.0];
        let errors = [1.5, 2.5, 0.0, 0.0, 1.5, 1.2, 0.9, 1.5, -2.1, -0.1, -0.1, -1.4, -0.9];
        let fired = [0.0, -0.5, -0.5, -0.5, -0.5, -0.5, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5, 0.0];
        for (error, fired) in errors.into_iter().zip(fired) {
            let inputs = [error - 0.6, 0.3];
            assert_eq!(law.outputs(&inputs, &states), [fired], "{error}");
            states = law.advance(&inputs, &states);
        }
    }
}
