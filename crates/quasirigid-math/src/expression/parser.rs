//! Parser of formulas by precedence climbing (Pratt 1973): from text straight to steps.

use std::ops::Range;

use super::ExpressionError;
use super::function::{Binary, CONSTANTS, FUNCTIONS, Operation, Unary};
use super::lexer::{Lexer, Token};
use super::message;
use super::program::Program;

/// Most bytes of a formula.
const MAX_FORMULA: usize = 16_384;
/// Most parentheses, signs and powers inside one another.
const DEEPEST: usize = 200;

/// Precedence of a sign: above `*`, below `^`.
const SIGN: u8 = 3;

/// Reads a formula.
pub fn parse(text: &str, variables: &[&str]) -> Result<Program, ExpressionError> {
    if text.len() > MAX_FORMULA {
        let length = text.len();
        return Err(message::error(
            0..length,
            format!("the formula has {length} bytes, more than {MAX_FORMULA}; split it or tabulate it"),
        ));
    }
    let mut lexer = Lexer::new(text);
    let (token, span) = lexer.read()?;
    if token == Token::End {
        return Err(message::error(span, "the formula is empty; write `0` for nothing"));
    }
    let program = Program::default();
    let mut parser = Parser { text, variables, lexer, program, token, span, before: 0..0, depth: 0 };
    parser.operand(0)?;
    match parser.token {
        Token::End => Ok(parser.program),
        _ => Err(parser.stray()),
    }
}

struct Parser<'a> {
    text: &'a str,
    variables: &'a [&'a str],
    lexer: Lexer<'a>,
    program: Program,
    /// Next token.
    token: Token,
    span: Range<usize>,
    /// Place of the token before.
    before: Range<usize>,
    depth: usize,
}

/// Operation of a symbol between two operands, and its precedence.
fn infix(token: Token) -> Option<(Binary, u8)> {
    match token {
        Token::Symbol('+') => Some((Binary::Add, 1)),
        Token::Symbol('-') => Some((Binary::Subtract, 1)),
        Token::Symbol('*') => Some((Binary::Multiply, 2)),
        Token::Symbol('/') => Some((Binary::Divide, 2)),
        Token::Symbol('^') => Some((Binary::Power, 4)),
        _ => None,
    }
}

impl<'a> Parser<'a> {
    /// Operands joined by operations of at least the precedence `tight`.
    fn operand(&mut self, tight: u8) -> Result<(), ExpressionError> {
        let start = self.span.start;
        self.single()?;
        while let Some((binary, binds)) = infix(self.token).filter(|(_, binds)| *binds >= tight) {
            self.advance()?;
            match binary {
                // Grouped from the right, and a sign may stand in the exponent.
                Binary::Power => self.nested(|parser| parser.operand(SIGN))?,
                _ => self.operand(binds + 1)?,
            }
            self.apply(Operation::Binary(binary), start)?;
        }
        Ok(())
    }

    /// A number, a name, a call, a signed operand or one in parentheses.
    fn single(&mut self) -> Result<(), ExpressionError> {
        let (token, span) = (self.token, self.span.clone());
        match token {
            Token::Number(value) => {
                self.advance()?;
                self.program.constant(value);
            }
            Token::Name => {
                self.advance()?;
                self.name(span)?;
            }
            Token::Symbol('(') => {
                self.advance()?;
                self.nested(|parser| parser.operand(0))?;
                self.close(span)?;
            }
            Token::Symbol('+') => {
                self.advance()?;
                self.nested(|parser| parser.operand(SIGN))?;
            }
            Token::Symbol('-') => {
                self.advance()?;
                self.nested(|parser| parser.operand(SIGN))?;
                self.apply(Operation::Unary(Unary::Negate), span.start)?;
            }
            Token::Symbol(_) | Token::End => return Err(self.missing()),
        }
        match self.token {
            Token::Number(_) | Token::Name | Token::Symbol('(') => Err(self.unjoined()),
            _ => Ok(()),
        }
    }

    /// A variable, a constant or a call of a function, whose name has just been read.
    fn name(&mut self, span: Range<usize>) -> Result<(), ExpressionError> {
        let name = &self.text[span.clone()];
        if let Some(index) = self.variables.iter().position(|variable| *variable == name) {
            self.program.variable(index);
        } else if let Some((_, value)) = CONSTANTS.iter().find(|(constant, _)| *constant == name) {
            self.program.constant(*value);
        } else if let Some((name, usage, function)) = FUNCTIONS.iter().find(|(known, ..)| *known == name) {
            self.call(name, usage, *function, span)?;
        } else {
            let called = self.token == Token::Symbol('(');
            return Err(message::unknown(name, span, called, self.variables));
        }
        Ok(())
    }

    fn call(
        &mut self,
        name: &str,
        usage: &str,
        function: Operation,
        span: Range<usize>,
    ) -> Result<(), ExpressionError> {
        if self.token != Token::Symbol('(') {
            return Err(message::error(span, format!("`{name}` is a function; write `{usage}`")));
        }
        let open = self.span.clone();
        let mut found = 0;
        loop {
            self.advance()?;
            self.nested(|parser| parser.operand(0))?;
            found += 1;
            if self.token != Token::Symbol(',') {
                break;
            }
        }
        self.close(open)?;
        if found == function.arity() {
            self.apply(function, span.start)
        } else {
            Err(message::arguments(name, usage, function.arity(), found, span.start..self.before.end))
        }
    }

    fn nested(
        &mut self,
        inside: impl FnOnce(&mut Self) -> Result<(), ExpressionError>,
    ) -> Result<(), ExpressionError> {
        if self.depth == DEEPEST {
            return Err(message::error(
                self.span.clone(),
                format!(
                    "more than {DEEPEST} parentheses, signs or powers inside one another; split the formula"
                ),
            ));
        }
        self.depth += 1;
        inside(self)?;
        self.depth -= 1;
        Ok(())
    }

    /// The parenthesis that closes the one at `open`.
    fn close(&mut self, open: Range<usize>) -> Result<(), ExpressionError> {
        match self.token {
            Token::Symbol(')') => self.advance(),
            Token::End => Err(message::error(open, "this `(` is never closed; add `)`")),
            _ => Err(self.stray()),
        }
    }

    /// Appends an operation, whose operands begin at `start`.
    fn apply(&mut self, operation: Operation, start: usize) -> Result<(), ExpressionError> {
        self.program.apply(operation).map_err(|value| {
            let constant = &self.text[start..self.before.end];
            let finite = "a part without variables must be a finite number";
            message::error(start..self.before.end, format!("`{constant}` is {value}; {finite}"))
        })
    }

    fn advance(&mut self) -> Result<(), ExpressionError> {
        self.before = self.span.clone();
        (self.token, self.span) = self.lexer.read()?;
        Ok(())
    }

    /// Error: an operand is missing.
    fn missing(&self) -> ExpressionError {
        let wanted = "a number, a name or `(` is missing";
        let message = match self.token {
            Token::End => format!("the formula is incomplete; {wanted} after `{}`", self.before()),
            _ if self.before.is_empty() => format!("{wanted} before `{}`", self.found()),
            _ => format!("{wanted} between `{}` and `{}`", self.before(), self.found()),
        };
        message::error(self.span.clone(), message)
    }

    /// Error: two operands stand side by side.
    fn unjoined(&self) -> ExpressionError {
        let (before, found) = (self.before(), self.found());
        let message =
            format!("no sign between `{before}` and `{found}`; write `{before}*{found}` for a product");
        message::error(self.span.clone(), message)
    }

    /// Error: a token that cannot follow a complete operand.
    fn stray(&self) -> ExpressionError {
        let message = match self.token {
            Token::Symbol(',') => {
                "`,` separates arguments of a function only; decimals have a point, as in `0.5`"
            }
            _ => "this `)` closes nothing; remove it, or open `(` before",
        };
        message::error(self.span.clone(), message)
    }

    fn found(&self) -> &'a str {
        &self.text[self.span.clone()]
    }

    fn before(&self) -> &'a str {
        &self.text[self.before.clone()]
    }
}
