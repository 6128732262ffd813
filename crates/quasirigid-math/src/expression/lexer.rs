//! Lexer of formulas.

use std::ops::Range;

use super::ExpressionError;
use super::message;

/// Token of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Token {
    /// A number without a sign.
    Number(f64),
    /// A name of a variable, a constant or a function.
    Name,
    /// One of `+ - * / ^ ( ) ,`; `**` is `^`.
    Symbol(char),
    /// End of the text.
    End,
}

/// Reads a text word by word.
pub struct Lexer<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Lexer<'a> {
    /// Lexer at the start of a text.
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// Next token and its place.
    pub fn read(&mut self) -> Result<(Token, Range<usize>), ExpressionError> {
        let rest = self.text[self.at..].trim_start();
        let start = self.text.len() - rest.len();
        let (token, length) = match rest.chars().next() {
            None => (Token::End, 0),
            Some('*') if rest.starts_with("**") => (Token::Symbol('^'), 2),
            Some(symbol) if "+-*/^(),".contains(symbol) => (Token::Symbol(symbol), 1),
            Some(first) if first.is_ascii_digit() || first == '.' => {
                let length = number_length(rest);
                let number = rest[..length].parse().ok().filter(|number: &f64| number.is_finite());
                let Some(number) = number else {
                    return Err(message::number(rest, start..start + length));
                };
                (Token::Number(number), length)
            }
            Some(first) if first.is_alphabetic() || first == '_' => {
                (Token::Name, rest.find(|c| !in_name(c)).unwrap_or(rest.len()))
            }
            Some(other) => return Err(message::character(other, start)),
        };
        self.at = start + length;
        Ok((token, start..self.at))
    }
}

/// Letters, digits and indices of any script; a raised figure is no index but a power.
fn in_name(character: char) -> bool {
    (character.is_alphanumeric() && !"¹²³".contains(character)) || character == '_'
}

/// Bytes of the digits and points that a text begins with, and of a power of ten after them.
fn number_length(text: &str) -> usize {
    let digits = |from: usize, point: char| {
        let other = text[from..].find(|c: char| !(c.is_ascii_digit() || c == point));
        other.map_or(text.len(), |length| from + length)
    };
    let mantissa = digits(0, '.');
    let exponent = text[mantissa..].strip_prefix(['e', 'E']);
    let Some(exponent) = exponent.map(|after| after.strip_prefix(['+', '-']).unwrap_or(after)) else {
        return mantissa;
    };
    let start = text.len() - exponent.len();
    let end = digits(start, '0');
    if end > start { end } else { mantissa }
}
