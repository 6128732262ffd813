//! Proportional, integral and derivative action on errors, as a linear law. (Y5)

use super::LinearLaw;

/// PID law `v = −s (k_P e + k_I ∫e dt + k_D ė)`, one output for each error `e`. (Y5)
///
/// Inputs are the errors, then their rates where these are measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pid {
    /// Gains `k_P`, one for each error.
    pub proportional: Vec<f64>,
    /// Gains `k_I` (1/s more), as many.
    pub integral: Vec<f64>,
    /// Gains `k_D` (s more), as many.
    pub derivative: Vec<f64>,
    /// Signs `s` of the outputs, as many: −1 of the motor of a wheel, whose reaction acts on the carrier.
    pub signs: Vec<f64>,
    /// Whether the rates of the errors are measured; else the derivative is that of the filtered error, and needs the filter.
    pub has_rates: bool,
    /// Time constant (s) of the low-pass filter of the derivative.
    pub filter: Option<f64>,
    /// Time constant (s) in which the integral is taken back while an output saturates.
    pub anti_windup: Option<f64>,
}

impl Pid {
    /// The law of a continuous controller, or of one that is sampled at a period (s). States: integrals, then filtered signals.
    #[must_use]
    pub fn law(&self, period: Option<f64>) -> LinearLaw {
        let n = self.proportional.len();
        let inputs = if self.has_rates { 2 * n } else { n };
        let integrals = if self.integral.iter().any(|gain| *gain != 0.0) { n } else { 0 };
        let filtered = if self.filter.is_some() { n } else { 0 };
        let states = integrals + filtered;
        let zero = |rows: usize, columns: usize| vec![vec![0.0; columns]; rows];
        let mut law = LinearLaw {
            A: zero(states, states),
            B: zero(states, inputs),
            C: zero(n, states),
            D: zero(n, inputs),
            E: zero(states, if self.anti_windup.is_some() && integrals > 0 { n } else { 0 }),
        };
        let step = period.unwrap_or(1.0);
        for i in 0..n {
            let sign = -self.signs[i];
            law.D[i][i] = sign * self.proportional[i];
            if integrals > 0 {
                law.A[i][i] = if period.is_some() { 1.0 } else { 0.0 };
                law.B[i][i] = step;
                law.C[i][i] = sign * self.integral[i];
                if let Some(time) = self.anti_windup.filter(|_| self.integral[i] != 0.0) {
                    law.E[i][i] = step * sign / (self.integral[i] * time);
                }
            }
            self.derive(&mut law, i, integrals + i, period);
        }
        law
    }

    /// Adds the derivative of an error, with the state of its filter.
    fn derive(&self, law: &mut LinearLaw, i: usize, state: usize, period: Option<f64>) {
        let n = self.proportional.len();
        let gain = -self.signs[i] * self.derivative[i];
        let source = if self.has_rates { n + i } else { i };
        let Some(filter) = self.filter else {
            if self.has_rates {
                law.D[i][source] += gain;
            }
            return;
        };
        (law.A[state][state], law.B[state][source]) = match period {
            None => (-1.0 / filter, 1.0 / filter),
            Some(period) => ((-period / filter).exp(), -(-period / filter).exp_m1()),
        };
        if self.has_rates {
            law.C[i][state] = gain;
        } else {
            law.C[i][state] = -gain / filter;
            law.D[i][source] += gain / filter;
        }
    }
}
