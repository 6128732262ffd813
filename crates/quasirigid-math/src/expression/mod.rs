//! Formulas that users write, with exact derivatives.
//!
//! Numbers, the variables named, `pi` and `e`; `+ - * /`, powers `^` or `**`; `sin cos tan asin acos atan sinh cosh
//! tanh exp ln log10 sqrt abs step` of one argument, `atan2(y, x) pow(a, b) min(a, b) max(a, b) hypot(x, y)` of two;
//! `step(x)` is zero below zero and one from there on. Powers
//! bind more tightly than a sign before them and group from the right: `-x^2` is `-(x^2)`, `a^b^c` is `a^(b^c)`.

mod changes;
mod function;
mod guards;
mod lexer;
mod lobatto;
mod message;
mod parser;
mod program;
mod quiet;
mod rates;
mod rounding;
mod stretches;
#[cfg(feature = "serde")]
mod written;

pub use changes::{Changes, Path};
pub use lobatto::Lobatto;

use super::scalar::Smooth;
use program::{Node, Program, Role};

/// A formula in named variables, read once and evaluated at numbers or at series.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::Written", into = "written::Written"))]
#[derive(Clone, Debug)]
pub struct Expression {
    text: String,
    variables: Vec<String>,
    program: Program,
}

/// A text that is no formula.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct ExpressionError {
    /// Bytes of the text at fault; empty at its end where something is missing there.
    pub span: std::ops::Range<usize>,
    /// Problem and remedy.
    pub message: String,
}

impl Expression {
    /// Reads a formula in the variables named, of at most 16 384 bytes and nested at most 200 deep.
    ///
    /// A variable named like a constant or a function hides it.
    ///
    /// # Errors
    /// [`ExpressionError`] with the place of the first mistake; a part without variables that has no finite value is
    /// one.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, ExpressionError> {
        let program = parser::parse(text, variables)?;
        let variables = variables.iter().map(|name| (*name).to_owned()).collect();
        Ok(Self { text: text.to_owned(), variables, program })
    }

    /// Text of the formula as the user wrote it.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Names of the variables, in the order they were given in.
    #[must_use]
    pub fn variables(&self) -> &[String] {
        &self.variables
    }

    /// Whether the variable with this index, in the order they were named in, occurs.
    #[must_use]
    pub fn uses(&self, variable: usize) -> bool {
        self.program.uses(variable)
    }

    /// Rates `a` of sines and cosines of `a` times a variable, if the formula is a polynomial of these, and the variable occurs nowhere
    /// else; none otherwise.
    #[must_use]
    pub fn rates(&self, variable: usize) -> Option<Vec<f64>> {
        rates::rates(self.program.steps(), variable)
    }

    /// Where the formula changes along a variable, between two values of it; the others stay as `at` has them. (Z2)
    ///
    /// The formula is evaluated `budget` times at most.
    ///
    /// # Panics
    /// If there are fewer variables than were named.
    #[must_use]
    pub fn changes(&self, along: usize, at: &[f64], ends: [f64; 2], budget: u64) -> Changes {
        changes::changes(&self.program, along, at, ends, budget)
    }

    /// Where the formula changes along a path on which its variables move, between two places of it. (Z2)
    ///
    /// The formula is evaluated `budget` times at most.
    #[must_use]
    pub fn changes_on_path(&self, path: &mut Path, ends: [f64; 2], budget: u64) -> Changes {
        changes::changes_on_path(&self.program, path, ends, budget)
    }

    /// Whether the formula hides nothing between the places of a path at which its variables are known, those of [`Lobatto::points`]: no
    /// part of it acts in between. (Z2)
    #[must_use]
    pub fn is_quiet(&self, lobatto: &Lobatto, variables: &[&[f64]; Lobatto::POINTS]) -> bool {
        quiet::is_quiet(&self.program, lobatto, variables)
    }

    /// Whether a part of the formula that has a corner, or may act in a short part of the range of its argument, depends on a variable of
    /// these. (Z2)
    #[must_use]
    pub fn is_narrow_in(&self, mut variables: impl FnMut(usize) -> bool) -> bool {
        let mut moves: Vec<bool> = Vec::new();
        let mut narrow = false;
        for Node { role, operands } in self.program.nodes() {
            let moved = operands.iter().any(|of| moves[*of]);
            narrow |= moved && role.is_narrow();
            moves.push(moved || matches!(role, Role::Variable(variable) if variables(variable)));
        }
        narrow
    }

    /// Value at the variables, in the order in which they were named; NaN where there is none.
    ///
    /// A power with a constant exponent is [`Smooth::powf`], any other is `exp(b ln a)`; `abs`, `min`, `max` and `step` are
    /// the branch that the values choose.
    ///
    /// # Panics
    /// If there are fewer variables than were named.
    #[must_use]
    pub fn value<T: Smooth>(&self, variables: &[T]) -> T {
        self.program.value(variables)
    }
}

impl PartialEq for Expression {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::taylor::Taylor;

    const VARIABLES: [&str; 3] = ["t", "x", "ω₁"];
    #[test]
    fn rates_are_those_of_polynomials_of_sines_and_cosines() {
        let rates = |text: &str| Expression::parse(text, &VARIABLES).unwrap().rates(0);
        assert_eq!(rates("x^2 + sin(x)"), Some(vec![]));
        assert_eq!(rates("-(2*x)*(cos(3*t/2 + x)^2 + sin(-0.5*t)*x)/ω₁ - 1"), Some(vec![1.5, 0.5]));
        for text in [
            "t",
            "t*x",
            "cos(x*t)",
            "exp(cos(t))",
            "1/cos(t)",
            "cos(t)^0.5",
            "abs(sin(t))",
            "step(t-3)",
            "cos(t)+t",
        ] {
            assert_eq!(rates(text), None, "{text}");
        }
    }

    const POINT: [f64; 3] = [0.7, -1.3, 2.9];

    fn value(text: &str) -> f64 {
        Expression::parse(text, &VARIABLES).unwrap().value(&POINT)
    }

    fn refused(text: &str) -> (&str, String) {
        let error = Expression::parse(text, &VARIABLES).unwrap_err();
        (text.get(error.span).expect("a place in the text"), error.message)
    }

    #[test]
    fn formulas_mean_what_they_mean_in_mathematics() {
        let [t, x, w] = POINT;
        let pairs = [
            ("1 - 2 - 3 + t", -4.0 + t),
            ("12/3/2*x", 2.0 * x),
            ("-x^2", -(x * x)),
            ("2^-3 * t", t / 8.0),
            ("t^-2", 1.0 / (t * t)),
            ("2**3**2", 512.0),
            ("-2^-2^-1.", -0.5_f64.sqrt()),
            ("x ^ 3", x * x * x),
            ("x^(6/2)", x * x * x),
            ("--x - +-t", x + t),
            (" 2*(t+ x)\t*\nω₁ ", 2.0 * (t + x) * w),
            (".5 + 2. + 1e-3 + 1.5E+2*x", 2.501 + 150.0 * x),
            ("sin(pi/6) + ln(e)", 1.5),
            ("t^ω₁", t.powf(w)),
            ("pow(t, 2) + pow(x, 3)", t * t + x * x * x),
            ("sin(x)^2 + cos(x)^2", 1.0),
            ("tan(t)*asin(t)*acos(t)*atan(x)", t.tan() * t.asin() * t.acos() * x.atan()),
            ("sinh(x)*cosh(x)*tanh(x)", x.sinh() * x.cosh() * x.tanh()),
            ("exp(x)*log10(t)*sqrt(ω₁)", x.exp() * t.log10() * w.sqrt()),
            ("abs(x)*abs(t)", -x * t),
            ("atan2(x, -t)", x.atan2(-t)),
            ("min(x, t) + 10*max(x, t) + 100*min(t, x) + 1000*max(t, x)", 101.0 * x + 1010.0 * t),
            ("step(x) + 10*step(t) + 100*step(x - x)", 110.0),
            ("hypot(x, t)", x.hypot(t)),
            ("hypot(x - x, 0*t)", 0.0),
            ("hypot(1e200*x, 1e200*t)*1e-200", x.hypot(t)),
        ];
        for (text, expected) in pairs {
            let found = value(text);
            assert!((found - expected).abs() <= 4e-15 * expected.abs(), "{text}: {found} for {expected}");
        }
    }

    #[test]
    fn whole_powers_are_exact() {
        assert_eq!(value("(x - x - 3)^3"), -27.0);
        assert_eq!(value("(t - t)^0"), 1.0);
        let t = [Taylor::<4>::variable(0.0), Taylor::from(0.0), Taylor::from(1.0)];
        let square = Expression::parse("t^2", &VARIABLES).unwrap();
        assert_eq!(square.value(&t).derivatives(), [0.0, 0.0, 2.0, 0.0]);
        assert!(value("x^0.5").is_nan());
    }

    #[test]
    fn branches_are_chosen_by_the_value() {
        let t = [Taylor::<3>::variable(-0.4), Taylor::from(-0.6), Taylor::from(0.0)];
        let slope = |text| Expression::parse(text, &VARIABLES).unwrap().value(&t).coefficient(1);
        assert_eq!(["abs(t)", "abs(-t)", "min(t, x)", "max(t, x)"].map(slope), [-1.0, -1.0, 0.0, 1.0]);
        assert_eq!(slope("t*step(t) - t*step(-t)"), -1.0);
        for text in ["step(ln(x))", "min(ln(x), 1)", "max(1, ln(x))", "min(1, ln(x))", "max(ln(x), 1)"] {
            assert!(value(text).is_nan(), "{text}");
        }
    }

    #[test]
    fn variables_hide_constants_and_are_known_to_occur() {
        let formula = Expression::parse("e*pi + 0*ω₁", &["a", "e", "ω₁"]).unwrap();
        assert_eq!(formula.value(&[7.0, 3.0, 1.0]), 3.0 * std::f64::consts::PI);
        assert_eq!([0, 1, 2, 3].map(|variable| formula.uses(variable)), [false, true, true, false]);
    }

    #[test]
    fn formulas_are_equal_if_their_texts_are() {
        let parse = |text| Expression::parse(text, &VARIABLES).unwrap();
        assert_eq!(parse("t + x"), parse("t + x"));
        assert_ne!(parse("t + x"), parse("t+x"));
        assert_eq!(parse("t+x").text(), "t+x");
    }

    #[test]
    fn what_needs_much_room_is_evaluated_too() {
        for depth in (2..20).chain([150]) {
            let text = format!("{}x{}", "(t + x) - (".repeat(depth), ")".repeat(depth));
            let expected = if depth % 2 == 0 { POINT[1] } else { POINT[0] };
            assert!((value(&text) - expected).abs() < 1e-13, "{text}");
        }
        let wide = vec!["(t)"; 2000].join(" + ");
        assert!((value(&wide) - 1400.0).abs() < 1e-9);
    }

    #[test]
    fn mistakes_are_told_in_their_place() {
        let table = [
            ("", "", "the formula is empty; write `0` for nothing"),
            ("2x", "x", "no sign between `2` and `x`; write `2*x` for a product"),
            ("2 (t)", "(", "no sign between `2` and `(`; write `2*(` for a product"),
            ("(t)x", "x", "no sign between `)` and `x`; write `)*x` for a product"),
            ("x 3", "3", "no sign between `x` and `3`; write `x*3` for a product"),
            ("2e*t + 1", "e", "no sign between `2` and `e`; write `2*e` for a product"),
            ("t +", "", "the formula is incomplete; a number, a name or `(` is missing after `+`"),
            ("* t", "*", "a number, a name or `(` is missing before `*`"),
            ("t + )", ")", "a number, a name or `(` is missing between `+` and `)`"),
            ("sin()", ")", "a number, a name or `(` is missing between `(` and `)`"),
            ("(t*(x + 1)", "(", "this `(` is never closed; add `)`"),
            ("sin(t", "(", "this `(` is never closed; add `)`"),
            ("t)", ")", "this `)` closes nothing; remove it, or open `(` before"),
            ("0,5*t", ",", "`,` separates arguments of a function only; decimals have a point, as in `0.5`"),
            ("(t, x)", ",", "`,` separates arguments of a function only; decimals have a point, as in `0.5`"),
            ("1.2.3*t", "1.2.3", "`1.2.3` has 2 decimal points; a number has one at most"),
            (". + t", ".", "a decimal point without digits; write a number such as `0.5`"),
            ("1e999", "1e999", "`1e999` is beyond the largest number, 1.8e308"),
            ("2*foo", "foo", "unknown name `foo`; known are `t`, `x`, `ω₁`, `pi`, `e`"),
            ("sin t", "sin", "`sin` is a function; write `sin(x)`"),
            ("atan2(t)*2", "atan2(t)", "`atan2` takes 2 arguments, found 1; write `atan2(y, x)`"),
            ("1+sin(t, x)", "sin(t, x)", "`sin` takes 1 argument, found 2; write `sin(x)`"),
            (
                "t + 1/(2-2)*t",
                "1/(2-2)",
                "`1/(2-2)` is inf; a part without variables must be a finite number",
            ),
            (
                "t*-sqrt(-2)",
                "sqrt(-2)",
                "`sqrt(-2)` is NaN; a part without variables must be a finite number",
            ),
            ("x²", "²", "`²` is not allowed in a formula; write `^2`"),
            ("2×t", "×", "`×` is not allowed in a formula; write `*`"),
        ];
        for (text, place, message) in table {
            assert_eq!(refused(text), (place, message.to_owned()), "{text}");
        }
        let (place, message) = refused("t + sn(t)");
        assert_eq!(place, "sn");
        assert!(message.starts_with("unknown function `sn`; known are `sin`, `cos`"), "{message}");
        let (place, message) = refused("t = 1");
        assert_eq!(place, "=");
        assert!(message.ends_with("a formula has numbers, names, `+ - * / ^`, parentheses and commas"));
    }

    #[test]
    fn depth_and_length_are_bounded() {
        let nested = |depth: usize| format!("{}t{}", "(".repeat(depth), ")".repeat(depth));
        assert!(Expression::parse(&nested(200), &VARIABLES).is_ok());
        for text in [nested(201), "-".repeat(201) + "t", "t^".repeat(201) + "t", "sin(".repeat(201)] {
            assert!(refused(&text).1.starts_with("more than 200 parentheses, signs or powers"), "{text}");
        }
        assert!(refused(&nested(100_000)).1.starts_with("the formula has 200001 bytes, more than 16384"));
        assert!(Expression::parse(&("t+".repeat(8191) + "t "), &VARIABLES).is_ok());
        assert!(Expression::parse(&("t+".repeat(8191) + "t  "), &VARIABLES).is_err());
    }
}
