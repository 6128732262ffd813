//! Unit expressions: products, quotients and powers of symbols, parsed by recursive descent.
//! Factors are kept as fractions `up / down`, so that decimal units need one rounding only; a product after `/` is refused as ambiguous.

use super::UnitError;
use super::dimension::Exponents;
use super::symbols::{Unit, suggestion, unit};

/// Deepest nesting of parentheses that is read.
const DEEPEST: usize = 8;

/// A unit expression as a fraction `up / down` of the SI unit with the same exponents.
#[derive(Clone, Copy, Debug)]
pub(super) struct Expression {
    up: f64,
    down: f64,
    pub(super) exponents: Exponents,
    /// Whether hertz takes part.
    pub(super) hertz: bool,
}

impl Expression {
    /// Reads a whole unit expression.
    pub(super) fn parse(text: &str) -> Result<Self, UnitError> {
        let mut parser = Parser { text, rest: text, depth: 0 };
        let expression = parser.product()?;
        match parser.peek() {
            None => Ok(expression),
            found => Err(parser.unexpected(found)),
        }
    }

    /// The number of SI units in `number` of these. One division or multiplication by an integer keeps decimal units
    /// exact.
    pub(super) fn in_si(&self, number: f64) -> f64 {
        if self.up >= self.down { number * (self.up / self.down) } else { number / (self.down / self.up) }
    }

    /// Whether an angle takes part: beside one, hertz are 1/s and not revolutions per second.
    pub(super) fn has_angle(&self) -> bool {
        let [.., radian] = self.exponents;
        radian != 0
    }

    fn times(self, other: Self) -> Self {
        Self {
            up: self.up * other.up,
            down: self.down * other.down,
            exponents: std::array::from_fn(|i| self.exponents[i].saturating_add(other.exponents[i])),
            hertz: self.hertz || other.hertz,
        }
    }

    fn raised(self, power: i32) -> Self {
        let (up, down) = if power < 0 { (self.down, self.up) } else { (self.up, self.down) };
        let size = power.abs();
        Self {
            up: up.powi(size),
            down: down.powi(size),
            exponents: self.exponents.map(|exponent| exponent.saturating_mul(power)),
            hertz: self.hertz,
        }
    }
}

/// Recursive descent: a product of powers of factors.
struct Parser<'a> {
    text: &'a str,
    rest: &'a str,
    depth: usize,
}

impl Parser<'_> {
    /// `power { [ "*" | "·" ] power | "/" power }`
    fn product(&mut self) -> Result<Expression, UnitError> {
        let mut product = self.power()?;
        let mut divided = false;
        loop {
            match self.peek() {
                None | Some(')') => return Ok(product),
                Some('/') => {
                    self.skip('/');
                    divided = true;
                    product = product.times(self.power()?.raised(-1));
                }
                Some(_) if divided => {
                    return Err(UnitError::AmbiguousQuotient { unit: self.text.to_owned() });
                }
                Some(sign @ ('*' | '·' | '⋅' | '×')) => {
                    self.skip(sign);
                    product = product.times(self.power()?);
                }
                Some(_) => product = product.times(self.power()?),
            }
        }
    }

    /// `factor [ ( "^" | "**" ) integer ]`, or an integer in superscript.
    fn power(&mut self) -> Result<Expression, UnitError> {
        let factor = self.factor()?;
        self.peek();
        let superscript = self.superscript();
        if !superscript.is_empty() {
            return Ok(factor.raised(exponent(&superscript)?));
        }
        let Some(rest) = self.rest.strip_prefix("**").or_else(|| self.rest.strip_prefix('^')) else {
            return Ok(factor);
        };
        self.rest = rest.trim_start();
        let sign = usize::from(self.rest.starts_with(['+', '-']));
        let digits = self.rest[sign..]
            .find(|c: char| !c.is_ascii_digit() && c != '.')
            .unwrap_or(self.rest.len() - sign);
        let (written, rest) = self.rest.split_at(sign + digits);
        self.rest = rest;
        if written.is_empty() {
            let found = self.peek();
            return Err(self.unexpected(found));
        }
        Ok(factor.raised(exponent(written)?))
    }

    /// `symbol | "1" | "(" product ")"`
    fn factor(&mut self) -> Result<Expression, UnitError> {
        match self.peek() {
            Some('(') if self.depth == DEEPEST => Err(UnitError::TooDeep),
            Some('(') => {
                self.skip('(');
                self.depth += 1;
                let product = self.product()?;
                self.depth -= 1;
                match self.peek() {
                    Some(')') => self.skip(')'),
                    found => return Err(self.unexpected(found)),
                }
                Ok(product)
            }
            Some('1') => {
                self.skip('1');
                named("1")
            }
            Some(c) if is_letter(c) => {
                let end = self.rest.find(|c| !is_letter(c)).unwrap_or(self.rest.len());
                let (symbol, rest) = self.rest.split_at(end);
                self.rest = rest;
                named(symbol)
            }
            found => Err(self.unexpected(found)),
        }
    }

    /// Superscript digits and sign at the start of the rest, as ordinary ones.
    fn superscript(&mut self) -> String {
        const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
        const PLAIN: &str = "0123456789-";
        let plain =
            |c: char| RAISED.chars().position(|raised| raised == c).and_then(|i| PLAIN.chars().nth(i));
        let written: String = self.rest.chars().map_while(plain).collect();
        self.rest = self.rest.trim_start_matches(|c| RAISED.contains(c));
        written
    }

    /// The next character that is not a space.
    fn peek(&mut self) -> Option<char> {
        self.rest = self.rest.trim_start();
        self.rest.chars().next()
    }

    fn skip(&mut self, c: char) {
        self.rest = self.rest.strip_prefix(c).unwrap_or(self.rest);
    }

    fn unexpected(&self, found: Option<char>) -> UnitError {
        UnitError::Syntax { unit: self.text.to_owned(), found }
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '°'
}

fn named(symbol: &str) -> Result<Expression, UnitError> {
    let Some(Unit { up, down, exponents }) = unit(symbol) else {
        return Err(UnitError::UnknownUnit { symbol: symbol.to_owned(), suggestion: suggestion(symbol) });
    };
    Ok(Expression { up, down, exponents, hertz: symbol.ends_with("Hz") })
}

fn exponent(written: &str) -> Result<i32, UnitError> {
    match written.parse() {
        Ok(power @ -9..=9) => Ok(power),
        _ => Err(UnitError::Power { exponent: written.to_owned() }),
    }
}
