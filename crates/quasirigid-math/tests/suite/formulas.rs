//! Formulas that users write: values are those of their parts, and so are their rates.

use std::fmt;

use proptest::prelude::*;
use quasirigid_math::expression::Expression;
use quasirigid_math::taylor::Taylor;

use super::cases;

/// Coefficients compared: value, first and second derivative.
const TERMS: usize = 3;

/// A formula as a tree.
#[derive(Clone, Debug)]
enum Tree {
    Number(f64),
    /// A variable, differentiated so many times.
    Variable(usize, usize),
    Negate(Box<Tree>),
    Infix(char, Box<Tree>, Box<Tree>),
    Unary(&'static str, Box<Tree>),
    Binary(&'static str, Box<Tree>, Box<Tree>),
    /// Choice: if the first is not above the second the third, else the fourth; no text has it.
    Choice(Box<[Tree; 4]>),
}

use Tree::{Binary, Choice, Infix, Negate, Number, Unary, Variable};

const NAMES: [&str; 3] = ["t", "x", "v_2"];
const POINT: [f64; 3] = [0.3, -0.7, 1.9];
const UNARY: [&str; 14] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln", "log10", "sqrt", "abs",
];
const BINARY: [&str; 4] = ["atan2", "pow", "min", "max"];

fn infix(sign: char, a: &Tree, b: &Tree) -> Tree {
    Infix(sign, Box::new(a.clone()), Box::new(b.clone()))
}

fn unary(name: &'static str, x: &Tree) -> Tree {
    Unary(name, Box::new(x.clone()))
}

fn trees(depth: u32) -> impl Strategy<Value = Tree> {
    let number =
        prop_oneof![0.1..3.0_f64, (0..4u8).prop_map(f64::from), (-30..30i32).prop_map(|n| 1.1f64.powi(n))];
    let leaf = prop_oneof![1 => number.prop_map(Number), 2 => (0..3usize).prop_map(|i| Variable(i, 0))];
    leaf.prop_recursive(depth, 24, 2, |inner| {
        let sign = prop::sample::select(vec!['+', '-', '*', '/', '^']);
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            1 => inner.clone().prop_map(|x| Negate(Box::new(x))),
            4 => (sign, pair.clone()).prop_map(|(sign, (a, b))| infix(sign, &a, &b)),
            2 => (prop::sample::select(UNARY.to_vec()), inner).prop_map(|(name, x)| unary(name, &x)),
            1 => (prop::sample::select(BINARY.to_vec()), pair)
                .prop_map(|(name, (a, b))| Binary(name, Box::new(a), Box::new(b))),
        ]
    })
}

/// As few parentheses as mathematics needs.
impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Number(value) if !(0.1..2.0).contains(value) => write!(f, "{value:e}"),
            Number(value) => write!(f, "{value}"),
            Variable(index, _) => f.write_str(NAMES[*index]),
            Negate(x) => write!(f, "-{}", x.inside(3)),
            Infix('^', a, b) => write!(f, "{}^{}", a.inside(5), b.inside(3)),
            Infix(sign @ ('*' | '/'), a, b) => write!(f, "{}{sign}{}", a.inside(2), b.inside(3)),
            Infix(sign, a, b) => write!(f, "{} {sign} {}", a.inside(1), b.inside(2)),
            Unary(name, x) => write!(f, "{name}({x})"),
            Binary(name, a, b) => write!(f, "{name}({a}, {b})"),
            Choice(_) => Err(fmt::Error),
        }
    }
}

impl Tree {
    /// Text of a part, in parentheses if the part binds less tightly than its place asks.
    fn inside(&self, tight: u8) -> String {
        let binds = match self {
            Infix('+' | '-', ..) => 1,
            Infix('*' | '/', ..) => 2,
            Negate(_) => 3,
            Infix(..) => 4,
            _ => 5,
        };
        if binds < tight { format!("({self})") } else { self.to_string() }
    }

    fn parts(&self) -> Vec<&Tree> {
        match self {
            Number(_) | Variable(..) => Vec::new(),
            Negate(x) | Unary(_, x) => vec![x],
            Infix(_, a, b) | Binary(_, a, b) => vec![a, b],
            Choice(parts) => parts.iter().collect(),
        }
    }

    fn is_constant(&self) -> bool {
        !matches!(self, Variable(..)) && self.parts().iter().all(|part| part.is_constant())
    }

    /// Whether some part is a constant without a finite value.
    fn is_refused(&self) -> bool {
        let lost = self.is_constant() && !self.value(&[]).is_finite();
        lost || self.parts().iter().any(|part| part.is_refused())
    }

    /// The value at derivatives of the variables.
    fn value(&self, at: &[[f64; 3]]) -> f64 {
        match self {
            Number(value) => *value,
            Variable(index, order) => at[*order][*index],
            Negate(x) => -x.value(at),
            Infix('^', a, b) | Binary("pow", a, b) => {
                let (base, exponent) = (a.value(at), b.value(at));
                match b.is_constant() {
                    true if exponent.fract() == 0.0 => base.powi(exponent as i32),
                    true => base.powf(exponent),
                    false => (exponent * base.ln()).exp(),
                }
            }
            Infix(sign, a, b) => arithmetic(*sign, a.value(at), b.value(at)),
            Unary(name, x) => function(name, x.value(at)),
            Binary(name, a, b) => match (*name, a.value(at), b.value(at)) {
                ("atan2", a, b) => a.atan2(b),
                (_, a, b) if a.is_nan() || b.is_nan() => f64::NAN,
                ("min", a, b) => {
                    if b < a {
                        b
                    } else {
                        a
                    }
                }
                (_, a, b) => {
                    if b > a {
                        b
                    } else {
                        a
                    }
                }
            },
            Choice(parts) => {
                let [a, b, lower, upper] = parts.as_ref();
                if a.value(at) <= b.value(at) { lower.value(at) } else { upper.value(at) }
            }
        }
    }

    /// The derivative by time, by the rules of the calculus.
    fn rate(&self) -> Tree {
        match self {
            Number(_) => Number(0.0),
            Variable(index, order) => Variable(*index, order + 1),
            Negate(x) => Negate(Box::new(x.rate())),
            Infix('^', a, b) | Binary("pow", a, b) => power_rate(a, b),
            Infix('*', a, b) => infix('+', &infix('*', &a.rate(), b), &infix('*', a, &b.rate())),
            Infix('/', a, b) => {
                let above = infix('-', &a.rate(), &infix('*', &infix('/', a, b), &b.rate()));
                infix('/', &above, b)
            }
            Infix(sign, a, b) => infix(*sign, &a.rate(), &b.rate()),
            Unary(name, x) => infix('*', &slope(name, x), &x.rate()),
            Binary("atan2", y, x) => {
                let above = infix('-', &infix('*', x, &y.rate()), &infix('*', y, &x.rate()));
                infix('/', &above, &infix('+', &infix('*', x, x), &infix('*', y, y)))
            }
            Binary(name, a, b) => {
                let (lower, upper) = if *name == "min" { (a, b) } else { (b, a) };
                Choice(Box::new([(**a).clone(), (**b).clone(), lower.rate(), upper.rate()]))
            }
            Choice(parts) => {
                let [a, b, lower, upper] = parts.as_ref();
                Choice(Box::new([a.clone(), b.clone(), lower.rate(), upper.rate()]))
            }
        }
    }
}

fn arithmetic(sign: char, a: f64, b: f64) -> f64 {
    match sign {
        '+' => a + b,
        '-' => a - b,
        '*' => a * b,
        _ => a / b,
    }
}

fn function(name: &str, x: f64) -> f64 {
    match name {
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "atan" => x.atan(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "exp" => x.exp(),
        "ln" => x.ln(),
        "log10" => x.log10(),
        "sqrt" => x.sqrt(),
        _ => {
            if x < 0.0 {
                -x
            } else {
                x
            }
        }
    }
}

fn power_rate(a: &Tree, b: &Tree) -> Tree {
    if b.is_constant() {
        let lower = infix('^', a, &infix('-', b, &Number(1.0)));
        return infix('*', &infix('*', b, &lower), &a.rate());
    }
    let by_exponent = infix('*', &b.rate(), &unary("ln", a));
    let by_base = infix('*', b, &infix('/', &a.rate(), a));
    infix('*', &infix('^', a, b), &infix('+', &by_exponent, &by_base))
}

/// The derivative of a function by its argument.
fn slope(name: &'static str, x: &Tree) -> Tree {
    let one = Number(1.0);
    let square = |x: &Tree| infix('*', x, x);
    let over = |x: &Tree| infix('/', &Number(1.0), x);
    match name {
        "sin" => unary("cos", x),
        "cos" => Negate(Box::new(unary("sin", x))),
        "tan" => over(&square(&unary("cos", x))),
        "asin" => over(&unary("sqrt", &infix('-', &one, &square(x)))),
        "acos" => Negate(Box::new(slope("asin", x))),
        "atan" => over(&infix('+', &one, &square(x))),
        "sinh" => unary("cosh", x),
        "cosh" => unary("sinh", x),
        "tanh" => over(&square(&unary("cosh", x))),
        "exp" => unary("exp", x),
        "ln" => over(x),
        "log10" => over(&infix('*', x, &Number(std::f64::consts::LN_10))),
        "sqrt" => over(&infix('*', &Number(2.0), &unary("sqrt", x))),
        _ => infix('/', x, &unary("abs", x)),
    }
}

fn same(found: f64, expected: f64) -> bool {
    found == expected || (found.is_nan() && expected.is_nan())
}

/// Text of words that formulas have, in any order.
fn soup() -> impl Strategy<Value = String> {
    let words = [
        "t", "x", "sin", "atan2", "pi", "(", "(", ")", ")", ",", "+", "-", "*", "**", "/", "^", " ", "1",
        "2.5", ".", "1e", "e-3", "1e400", "²", "ω", "é", "\n",
    ];
    prop::collection::vec(prop::sample::select(words.to_vec()), 0..40).prop_map(|words| words.concat())
}

proptest! {
    #![proptest_config(cases(1000))]

    /// Precedence, grouping, names and the values of constants, to the last bit.
    #[test]
    fn a_formula_has_the_value_of_its_tree(tree in trees(6), at in prop::array::uniform3(-2.0..2.0_f64)) {
        match Expression::parse(&tree.to_string(), &NAMES) {
            Ok(formula) => {
                prop_assert!(!tree.is_refused(), "{tree}");
                let (found, expected) = (formula.value(&at), tree.value(&[at]));
                prop_assert!(same(found, expected), "{tree}: {found} for {expected}");
                let series = formula.value(&at.map(Taylor::<4>::variable)).coefficient(0);
                prop_assert!(same(series, expected), "{tree}: series begins with {series}, not {expected}");
            }
            Err(error) => prop_assert!(tree.is_refused(), "{tree}: {error}"),
        }
    }

    /// Derivatives by time along moving variables are those of the calculus.
    #[test]
    fn the_rate_of_a_formula_is_that_of_the_calculus(
        tree in trees(3).prop_filter("a formula", |tree| !tree.is_refused()),
        at in prop::array::uniform3(prop::array::uniform3(-1.5..1.5_f64)),
    ) {
        let formula = Expression::parse(&tree.to_string(), &NAMES).unwrap();
        let path = |i: usize| Taylor::new([at[0][i], at[1][i], 0.5 * at[2][i]]);
        let found = formula.value(&[0, 1, 2].map(path)).derivatives();
        let mut rate = tree.clone();
        let expected: [f64; TERMS] = std::array::from_fn(|k| {
            if k > 0 {
                rate = rate.rate();
            }
            rate.value(&at)
        });
        // Where a derivative is large the formula is steep or nearly singular, and rounding is large too.
        if !expected.iter().all(|d| d.abs() < 1e4) {
            return Ok(());
        }
        for k in 0..TERMS {
            let gap = (found[k] - expected[k]).abs();
            prop_assert!(gap <= 1e-10 * (1.0 + expected[k].abs()), "{tree}: {found:?} for {expected:?}");
        }
    }

    /// Every text is read, or its first mistake is reported at its place.
    #[test]
    fn no_text_is_too_strange(text in prop_oneof![".{0,40}", soup()]) {
        match Expression::parse(&text, &NAMES) {
            Ok(formula) => {
                let series = formula.value(&POINT.map(Taylor::<2>::from));
                prop_assert!(same(series.coefficient(0), formula.value(&POINT)), "{text}");
            }
            Err(error) => {
                prop_assert!(text.get(error.span.clone()).is_some(), "{error:?}");
                prop_assert!(!error.message.is_empty());
            }
        }
    }
}
