//! Laws of controllers: linear, and by formulas. (Y1)

use super::{ControlProblem, RelayLaw};
use crate::math::expression::Expression;
use crate::math::taylor::Taylor;

/// Law of a controller with inputs `u` and states `z`. (Y1)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum ControlLaw {
    /// `ż = A z + B u + E e`, `v = C z + D u`; of a sampled controller the next `z`. `e` is what saturation takes from `v`.
    Linear(LinearLaw),
    /// Formulas of the inputs and the states.
    Formulas(FormulaLaw),
    /// Thrusters that are on or off; of a sampled controller. (Y7)
    Relay(RelayLaw),
}

/// Matrices of a linear law, as lists of rows. (Y1)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinearLaw {
    /// States on states.
    pub A: Vec<Vec<f64>>,
    /// Inputs on states.
    pub B: Vec<Vec<f64>>,
    /// States on outputs.
    pub C: Vec<Vec<f64>>,
    /// Inputs on outputs.
    pub D: Vec<Vec<f64>>,
    /// What saturation takes from each output, on states: anti-windup. No columns without one.
    pub E: Vec<Vec<f64>>,
}

/// Formulas in the inputs, then the states. (Y1)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaLaw {
    /// Rates of the states; of a sampled controller their next values.
    pub states: Vec<Expression>,
    /// Outputs.
    pub outputs: Vec<Expression>,
}

impl ControlLaw {
    /// Number of states.
    #[must_use]
    pub fn states(&self) -> usize {
        match self {
            Self::Linear(law) => law.A.len(),
            Self::Formulas(law) => law.states.len(),
            Self::Relay(law) => 2 * law.levels.len(),
        }
    }

    /// Outputs before saturation.
    #[must_use]
    pub fn outputs(&self, inputs: &[f64], states: &[f64]) -> Vec<f64> {
        match self {
            Self::Linear(law) => sum(&times(&law.C, states), &times(&law.D, inputs)),
            Self::Formulas(law) => values(&law.outputs, &[inputs, states].concat()),
            Self::Relay(law) => law.outputs(inputs, states),
        }
    }

    /// Rates of the states; of a sampled controller their next values. `excess` is what saturation takes from the outputs, the limited less
    /// the demanded.
    #[must_use]
    pub fn advance(&self, inputs: &[f64], states: &[f64], excess: &[f64]) -> Vec<f64> {
        match self {
            Self::Linear(law) => {
                let driven = sum(&times(&law.A, states), &times(&law.B, inputs));
                sum(&driven, &times(&law.E, excess))
            }
            Self::Formulas(law) => values(&law.states, &[inputs, states].concat()),
            Self::Relay(law) => law.advance(inputs, states),
        }
    }

    /// Matrices about inputs and states: slopes of the rates of the states and of the outputs; exact, without saturation. None of a law that
    /// jumps.
    #[must_use]
    pub fn linearized(&self, inputs: &[f64], states: &[f64]) -> Option<LinearLaw> {
        Some(match self {
            Self::Relay(_) => return None,
            Self::Linear(law) => law.clone(),
            Self::Formulas(law) => {
                let at = [inputs, states].concat();
                let slopes = |formulas: &[Expression], from: usize, to: usize| {
                    formulas
                        .iter()
                        .map(|formula| (from..to).map(|i| slope(formula, &at, i)).collect())
                        .collect()
                };
                let (ins, all) = (inputs.len(), at.len());
                LinearLaw {
                    A: slopes(&law.states, ins, all),
                    B: slopes(&law.states, 0, ins),
                    C: slopes(&law.outputs, ins, all),
                    D: slopes(&law.outputs, 0, ins),
                    E: Vec::new(),
                }
            }
        })
    }

    /// What is wrong with the sizes and entries of the law, for so many inputs and outputs.
    pub(super) fn problem(&self, inputs: usize, outputs: usize) -> Option<ControlProblem> {
        let Self::Linear(law) = self else { return None };
        let n = law.A.len();
        let anti_windup = law.E.iter().any(|row| !row.is_empty());
        let wanted = [
            ("A", &law.A, [n, n]),
            ("B", &law.B, [n, inputs]),
            ("C", &law.C, [outputs, n]),
            ("D", &law.D, [outputs, inputs]),
            ("E", &law.E, if anti_windup { [n, outputs] } else { [law.E.len(), 0] }),
        ];
        wanted.into_iter().find_map(|(matrix, rows, [height, width])| {
            let fits = rows.len() == height && rows.iter().all(|row| row.len() == width);
            if !fits {
                return Some(ControlProblem::Size { matrix, rows: height, columns: width });
            }
            let finite = rows.iter().flatten().all(|entry| entry.is_finite());
            (!finite).then_some(ControlProblem::NotFinite { matrix })
        })
    }
}

fn values(formulas: &[Expression], at: &[f64]) -> Vec<f64> {
    formulas.iter().map(|formula| formula.value(at)).collect()
}

fn slope(formula: &Expression, at: &[f64], along: usize) -> f64 {
    let mut variables: Vec<Taylor<2>> = at.iter().copied().map(Taylor::from).collect();
    variables[along] = Taylor::variable(at[along]);
    formula.value(&variables).coefficient(1)
}

fn times(matrix: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    matrix.iter().map(|row| row.iter().zip(x).map(|(entry, x)| entry * x).sum()).collect()
}

/// Sum of two lists, the second empty or as long.
fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().enumerate().map(|(i, a)| a + b.get(i).copied().unwrap_or(0.0)).collect()
}
