//! Rounding of the values of a formula: a bound beside each value, carried along with it.
//! What differs by less is no change of the formula: two parts that cancel leave the rounding of both.
//! Equation (Z2), docs/theory/19-events.md.

use super::function::{Binary, Unary};
use super::program::{Program, Step};

/// A value with the bound of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rounded {
    value: f64,
    error: f64,
}

impl Program {
    /// Bounds of the errors of the values after each of the steps up to the last one asked for, at variables with a relative error. `step` is taken
    /// to have none: where its argument is rounding it has no value. (Z2)
    pub fn errors(&self, (variables, relative): (&[f64], f64), last: usize, errors: &mut Vec<f64>) {
        errors.clear();
        let mut stack: Vec<Rounded> = Vec::new();
        for step in &self.steps()[..=last] {
            let result = match *step {
                Step::Constant(value) => Some(Rounded { value, error: 0.0 }),
                Step::Variable(index) => {
                    let value = variables[index];
                    Some(Rounded { value, error: relative * value.abs() })
                }
                Step::Power(exponent) => stack.pop().map(|x| x.through(|x| x.powf(exponent))),
                Step::Unary(Unary::Step) => {
                    stack.pop().map(|x| Rounded { value: Unary::Step.of(x.value), error: 0.0 })
                }
                Step::Unary(unary) => stack.pop().map(|x| x.through(|x| unary.of(x))),
                Step::Binary(binary) => stack.pop().zip(stack.pop()).map(|(b, a)| a.with(binary, b)),
            };
            let result = result.unwrap_or(Rounded { value: f64::NAN, error: 0.0 });
            errors.push(result.error);
            stack.push(result);
        }
    }
}

impl Rounded {
    /// A value rounded once, beside an error that it has already.
    fn of(value: f64, error: f64) -> Self {
        let error = error + f64::EPSILON * value.abs();
        Self { value, error: if error.is_finite() { error } else { 0.0 } }
    }

    /// Result of a function, with its largest change over the error of its argument.
    fn through(self, function: impl Fn(f64) -> f64) -> Self {
        let value = function(self.value);
        let change = |x: f64| (function(x) - value).abs();
        let changes = [self.value - self.error, self.value + self.error].map(change);
        Self::of(value, changes.into_iter().filter(|change| change.is_finite()).fold(0.0, f64::max))
    }

    /// Result of an operation on two values.
    fn with(self, operation: Binary, other: Self) -> Self {
        let of_first = self.through(|x| operation.of(x, other.value));
        let of_second = other.through(|x| operation.of(self.value, x));
        Self::of(of_first.value, of_first.error + of_second.error)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Expression;

    /// The error of a difference of equal parts is their rounding, and a function multiplies it by its slope.
    #[test]
    fn errors_of_what_cancels_are_those_of_its_parts() {
        let at = |text: &str, t: f64| {
            let formula = Expression::parse(text, &["t"]).unwrap();
            let mut errors = Vec::new();
            formula.program.errors((&[t], f64::EPSILON), formula.program.nodes().len() - 1, &mut errors);
            (formula.value(&[t]), errors[errors.len() - 1])
        };
        for t in [0.3, 17.2, 1e4] {
            for (text, factor) in [("cos(t)^2+sin(t)^2-1", 1.0), ("1e6*(cos(t)^2+sin(t)^2-1)", 1e6)] {
                let (value, error) = at(text, t);
                assert!(
                    value.abs() <= error && error < 1e-14 * factor * (1.0 + t),
                    "{text} {t}: {value} {error}"
                );
            }
            let (_, error) = at("exp(1e3*(t-t))", t);
            assert!(error > 1e2 * f64::EPSILON * t && error < 1e4 * f64::EPSILON * (1.0 + t), "{error}");
        }
    }
}
