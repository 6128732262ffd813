//! LaTeX export: the reduced equations as displays for `amsmath`, three terms to a line.
//! Coefficients are rounded to ten digits and rounding noise is left out, so the text is for reading; JSON has every digit.
//! Equations (R4) and (R7), docs/theory/03-reduction.md.

use std::fmt::{self, Write};

use quasirigid_math::polynomial::Homogeneous;

use super::{Derived, MAX_PRINTED};
use crate::visible::one_line;

/// Terms smaller than this share of the largest of their degree are rounding and left out.
const KEPT: f64 = 1e-13;
/// Terms to a line.
const TERMS_PER_LINE: usize = 3;

impl Derived<'_> {
    /// The equations of motion as LaTeX displays, for a document that loads `amsmath`.
    #[must_use]
    pub fn latex(&self) -> String {
        let mut latex = String::new();
        self.write_latex(&mut latex).expect("a string takes any text");
        latex
    }

    fn write_latex(&self, out: &mut String) -> fmt::Result {
        let degrees = self.mu();
        let sum: Vec<_> = degrees.iter().map(|part| format!(r"\mu_{{{}}}(\omega)", part.degree())).collect();
        let sum = if sum.is_empty() { "0".into() } else { sum.join(" + ") };
        writeln!(out, "% {}, order {}; SI units, body axes", one_line(self.name), self.reduced.order)?;
        let sum = if self.forces.is_some() {
            writeln!(
                out,
                "% without the forces mu and q are the polynomials below; with them see derive --format text"
            )?;
            r"M^\ast + \mu".into()
        } else {
            sum
        };
        let k = self.body.wheels().angular_momentum(0.0);
        let angular_momentum = if self.body.wheels().is_empty() { "J\\omega" } else { "(J\\omega + k)" };
        writeln!(
            out,
            "\\begin{{equation*}}\n  J\\dot\\omega + \\omega\\times {angular_momentum} = {sum}, \\qquad"
        )?;
        writeln!(out, "  J = \\begin{{pmatrix}}")?;
        for row in self.body.inertia() {
            writeln!(out, "    {} \\\\", row.map(number).join(" & "))?;
        }
        write!(out, "  \\end{{pmatrix}}")?;
        if !self.body.wheels().is_empty() {
            let k = k.map(number).join(" \\\\ ");
            write!(out, ", \\quad\n  k = \\begin{{pmatrix}} {k} \\end{{pmatrix}}")?;
        }
        writeln!(out, "\n\\end{{equation*}}")?;
        let axes = ["x", "y", "z"].map(str::to_owned);
        degrees.iter().try_for_each(|part| display(out, (r"\mu", r"\omega"), &axes, part))?;
        self.write_latex_displacements(out)
    }

    /// Displacements on the slow manifold, the paper's (2.14); above [`MAX_PRINTED`] coordinates a comment names the JSON export. (R4)
    fn write_latex_displacements(&self, out: &mut String) -> fmt::Result {
        let (elastic, degrees) = (self.body.elastic(), self.displacements());
        if elastic == 0 || degrees.is_empty() {
            return Ok(());
        }
        if elastic > MAX_PRINTED {
            return writeln!(out, "% q(omega) of {elastic} internal coordinates: with --format json");
        }
        for (number, coordinate) in self.body.coordinates()[..elastic].iter().enumerate() {
            let name = one_line(&coordinate.name.replace('"', ""));
            writeln!(out, "% q_{}: {name}, {}", number + 1, coordinate.unit)?;
        }
        let sum: Vec<_> = degrees.iter().map(|part| format!("q_{{{}}}(\\omega)", part.degree())).collect();
        writeln!(out, "\\begin{{equation*}}\n  q = {}\n\\end{{equation*}}", sum.join(" + "))?;
        let numbers: Vec<_> = (1..=elastic).map(|number| number.to_string()).collect();
        degrees.iter().try_for_each(|part| display(out, ("q", r"\omega"), &numbers, part))
    }
}

/// One degree of a map, a line for each row: the symbol has the degree and the name of the row for indices; then the symbol of the
/// argument.
pub(super) fn display(
    out: &mut String,
    (symbol, argument): (&str, &str),
    names: &[String],
    part: &Homogeneous,
) -> fmt::Result {
    writeln!(out, "\\begin{{align*}}")?;
    for (axis, name) in names.iter().enumerate() {
        let comma = if name.is_empty() { "" } else { "," };
        write!(out, "  {symbol}_{{{}{comma}{name}}} &= ", part.degree())?;
        let terms: Vec<_> = part
            .terms()
            .filter(|(_, value)| value[axis].abs() > KEPT * part.amax())
            .map(|(exponents, value)| term(value[axis], exponents, argument))
            .collect();
        let first = terms.first().map(|term| term.trim_start_matches("+ ").to_owned());
        let terms: Vec<_> = first.into_iter().chain(terms.into_iter().skip(1)).collect();
        let mut lines: Vec<_> = terms.chunks(TERMS_PER_LINE).map(|line| line.join(" ")).collect();
        if lines.is_empty() {
            lines.push("0".into());
        }
        let end = if axis + 1 < names.len() { " \\\\" } else { "" };
        writeln!(out, "{}{end}", lines.join(" \\\\\n  &\\quad "))?;
    }
    writeln!(out, "\\end{{align*}}")
}

fn term(coefficient: f64, exponents: [usize; 3], argument: &str) -> String {
    let sign = if coefficient < 0.0 { "-" } else { "+" };
    let factors = exponents.iter().zip(["x", "y", "z"]).filter(|(power, _)| **power > 0);
    let factors = factors.map(|(power, axis)| match power {
        1 => format!("{argument}_{axis}"),
        _ => format!("{argument}_{axis}^{{{power}}}"),
    });
    let factors = factors.collect::<String>();
    let space = if factors.is_empty() { "" } else { "\\," };
    format!("{sign} {}{space}{factors}", number(coefficient.abs()))
}

/// Ten significant digits, or all of them where they are fewer, with the power of ten set as such.
fn number(value: f64) -> String {
    let (exact, rounded) = (format!("{:e}", value + 0.0), format!("{value:.9e}"));
    let text = if exact.len() < rounded.len() { exact } else { rounded };
    match text.split_once('e') {
        Some((mantissa, "0")) => mantissa.into(),
        Some((mantissa, exponent)) => format!(r"{mantissa}\cdot 10^{{{exponent}}}"),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_after_the_point_say_that_a_number_is_rounded() {
        let pairs = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-2.5, "-2.5"),
            (1.0 + 1e-12, "1.000000000"),
            (0.1 + 0.2, r"3.000000000\cdot 10^{-1}"),
            (1.5e-7, r"1.5\cdot 10^{-7}"),
            (4000.0, r"4\cdot 10^{3}"),
            (1.23456789, "1.23456789"),
            (std::f64::consts::PI, "3.141592654"),
        ];
        for (value, text) in pairs {
            assert_eq!(number(value), text);
        }
    }
}
