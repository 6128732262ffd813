//! Formulas: what is read has values and derivatives, with or without end.

use quasirigid_math::expression::Expression;
use quasirigid_math::taylor::Taylor;

/// Words of formulas.
pub const WORDS: &[&str] = &[
    "sin(", "cos(", "atan2(", "pow(", "min(", "max(", "hypot(", "sqrt(", "ln(", "exp(", "abs(", "^", "**",
    "pi", "t", "wx", "-", "(", ")", ",", "1e308", "2^-3",
];

const VARIABLES: [&str; 4] = ["t", "wx", "x", "qw"];
const POINTS: [[f64; 4]; 4] =
    [[0.0; 4], [0.7, -1.3, 2.9, 1.0], [1e300, -1e300, 5e-324, -1.0], [-1.0, 1.0, -0.0, 0.5]];

pub fn text(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let formula = match Expression::parse(text, &VARIABLES) {
        Ok(formula) => formula,
        Err(error) => {
            assert!(text.get(error.span.clone()).is_some(), "{:?} is a place of {text:?}", error.span);
            return assert!(!error.message.is_empty());
        }
    };
    for point in POINTS {
        let value: f64 = formula.value(&point);
        let series = formula.value(&point.map(Taylor::<4>::from));
        let same = series.coefficient(0) == value || series.coefficient(0).is_nan() || value.is_nan();
        assert!(same, "{text:?} at {point:?}: {value} in numbers, {} in series", series.coefficient(0));
    }
    for (index, _) in VARIABLES.iter().enumerate().filter(|(index, _)| !formula.uses(*index)) {
        let mut point = POINTS[1];
        let before: f64 = formula.value(&point);
        point[index] += 1.0;
        let after: f64 = formula.value(&point);
        assert_eq!(before.to_bits(), after.to_bits(), "{text:?} does not use variable {index}");
    }
}
