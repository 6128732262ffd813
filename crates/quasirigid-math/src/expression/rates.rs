//! Sines and cosines of one variable in a formula: whether the variable occurs in them alone, and at which rates.

use super::function::{Binary, Unary};
use super::program::Step;

/// A part of a formula by how the variable occurs in it.
#[derive(Clone, Copy, Debug)]
enum Part {
    Constant(f64),
    /// The variable does not occur.
    Free,
    /// The variable times this number, and what does not depend on it.
    Linear(f64),
    /// Polynomial of sines and cosines of multiples of the variable.
    Wave,
}

/// Rates of the sines and cosines of a variable, if these are in sums, products and whole powers, and the variable occurs nowhere else.
pub(super) fn rates(steps: &[Step], variable: usize) -> Option<Vec<f64>> {
    let (mut stack, mut rates): (Vec<Part>, Vec<f64>) = (Vec::new(), Vec::new());
    for step in steps {
        let part = match *step {
            Step::Constant(value) => Part::Constant(value),
            Step::Variable(index) if index == variable => Part::Linear(1.0),
            Step::Variable(_) => Part::Free,
            Step::Power(exponent) => power(stack.pop()?, exponent)?,
            Step::Unary(unary) => match (unary, stack.pop()?) {
                (Unary::Sin | Unary::Cos, Part::Linear(rate)) => {
                    rates.push(rate.abs());
                    Part::Wave
                }
                (Unary::Negate, Part::Linear(rate)) => Part::Linear(-rate),
                (Unary::Negate, part) => part,
                (_, Part::Constant(_) | Part::Free) => Part::Free,
                _ => return None,
            },
            Step::Binary(binary) => {
                let (right, left) = (stack.pop()?, stack.pop()?);
                joined(binary, left, right)?
            }
        };
        stack.push(part);
    }
    match stack.pop()? {
        Part::Linear(_) => None,
        _ => Some(rates),
    }
}

fn power(part: Part, exponent: f64) -> Option<Part> {
    match part {
        Part::Constant(_) | Part::Free => Some(Part::Free),
        Part::Wave if exponent >= 1.0 && exponent.fract() == 0.0 => Some(Part::Wave),
        _ => None,
    }
}

fn joined(binary: Binary, left: Part, right: Part) -> Option<Part> {
    use Part::{Constant, Free, Linear, Wave};
    let without = |part: Part| matches!(part, Constant(_) | Free);
    Some(match (binary, left, right) {
        (_, a, b) if without(a) && without(b) => Free,
        (Binary::Add, Linear(a), Linear(b)) => Linear(a + b),
        (Binary::Subtract, Linear(a), Linear(b)) => Linear(a - b),
        (Binary::Add | Binary::Subtract, Linear(a), b) if without(b) => Linear(a),
        (Binary::Add, a, Linear(b)) if without(a) => Linear(b),
        (Binary::Subtract, a, Linear(b)) if without(a) => Linear(-b),
        (Binary::Multiply, Linear(a), Constant(b)) | (Binary::Multiply, Constant(b), Linear(a)) => {
            Linear(a * b)
        }
        (Binary::Divide, Linear(a), Constant(b)) => Linear(a / b),
        (Binary::Divide, Wave, b) if without(b) => Wave,
        (Binary::Add | Binary::Subtract | Binary::Multiply, a, b)
            if !matches!(a, Linear(_)) && !matches!(b, Linear(_)) =>
        {
            Wave
        }
        _ => return None,
    })
}
