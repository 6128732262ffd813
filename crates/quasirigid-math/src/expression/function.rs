//! Functions a formula can call.

use crate::scalar::Smooth;

/// Operation on one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unary {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Log10,
    Sqrt,
    Abs,
    Step,
}

/// Operation on two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Atan2,
    Min,
    Max,
    Hypot,
}

/// Operation with its number of operands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Operation {
    Unary(Unary),
    Binary(Binary),
}

/// Names and uses of the functions, in the order in which messages list them.
pub const FUNCTIONS: [(&str, &str, Operation); 20] = [
    ("sin", "sin(x)", Operation::Unary(Unary::Sin)),
    ("cos", "cos(x)", Operation::Unary(Unary::Cos)),
    ("tan", "tan(x)", Operation::Unary(Unary::Tan)),
    ("asin", "asin(x)", Operation::Unary(Unary::Asin)),
    ("acos", "acos(x)", Operation::Unary(Unary::Acos)),
    ("atan", "atan(x)", Operation::Unary(Unary::Atan)),
    ("atan2", "atan2(y, x)", Operation::Binary(Binary::Atan2)),
    ("sinh", "sinh(x)", Operation::Unary(Unary::Sinh)),
    ("cosh", "cosh(x)", Operation::Unary(Unary::Cosh)),
    ("tanh", "tanh(x)", Operation::Unary(Unary::Tanh)),
    ("exp", "exp(x)", Operation::Unary(Unary::Exp)),
    ("ln", "ln(x)", Operation::Unary(Unary::Ln)),
    ("log10", "log10(x)", Operation::Unary(Unary::Log10)),
    ("sqrt", "sqrt(x)", Operation::Unary(Unary::Sqrt)),
    ("abs", "abs(x)", Operation::Unary(Unary::Abs)),
    ("step", "step(x)", Operation::Unary(Unary::Step)),
    ("pow", "pow(a, b)", Operation::Binary(Binary::Power)),
    ("min", "min(a, b)", Operation::Binary(Binary::Min)),
    ("max", "max(a, b)", Operation::Binary(Binary::Max)),
    ("hypot", "hypot(x, y)", Operation::Binary(Binary::Hypot)),
];

/// Constants with names.
pub const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("e", std::f64::consts::E)];

impl Unary {
    /// The result for one operand.
    pub fn of<T: Smooth>(self, x: T) -> T {
        match self {
            Self::Negate => -x,
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Asin => x.asin(),
            Self::Acos => x.acos(),
            Self::Atan => x.atan(),
            Self::Sinh => x.sinh_cosh().0,
            Self::Cosh => x.sinh_cosh().1,
            Self::Tanh => x.tanh(),
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Log10 => x.log10(),
            Self::Sqrt => x.sqrt(),
            Self::Abs if x.value() < 0.0 => -x,
            Self::Abs => x,
            Self::Step if x.value().is_nan() => x,
            Self::Step => T::from(f64::from(u8::from(x.value() >= 0.0))),
        }
    }
}

impl Binary {
    /// The result for two operands.
    pub fn of<T: Smooth>(self, a: T, b: T) -> T {
        match self {
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Power => (b * a.ln()).exp(),
            Self::Atan2 => a.atan2(b),
            // NaN wins on either side.
            Self::Min if a.value() <= b.value() || a.value().is_nan() => a,
            Self::Max if a.value() >= b.value() || a.value().is_nan() => a,
            Self::Min | Self::Max => b,
            Self::Hypot => hypot(a, b),
        }
    }
}

impl Operation {
    /// Number of operands.
    pub fn arity(self) -> usize {
        match self {
            Self::Unary(_) => 1,
            Self::Binary(_) => 2,
        }
    }
}

/// `√(x² + y²)`, in units of the larger so that no square overflows.
fn hypot<T: Smooth>(x: T, y: T) -> T {
    let larger = x.value().abs().max(y.value().abs());
    let unit = T::from(if larger.is_normal() { larger } else { 1.0 });
    let (x, y) = (x / unit, y / unit);
    (x * x + y * y).sqrt() * unit
}
