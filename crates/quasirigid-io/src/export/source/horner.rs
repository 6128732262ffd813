//! Polynomials of three variables as source text, in nested form, which every language writes alike.

use std::collections::BTreeMap;

use quasirigid_math::polynomial::Series;
use quasirigid_math::polynomial::monomial::exponents;

/// Columns after which a line is broken.
const WIDTH: usize = 100;

/// A row of a map as an expression of named variables; monomials that do not occur are left out.
pub(super) fn expression(map: &Series, row: usize, variables: [&str; 3]) -> String {
    let all = (0..=map.degree()).flat_map(exponents);
    let terms = all.map(|powers| (powers, map.coefficient(row, powers))).filter(|(_, c)| *c != 0.0);
    nested(terms.collect(), &variables)
}

/// A number with all its digits, as every language reads it.
pub(super) fn number(value: f64) -> String {
    format!("{:e}", value + 0.0)
}

/// Lines of an expression, broken before its sums grow too long; `continued` ends every line but the last.
pub(super) fn broken(expression: &str, indent: &str, continued: &str) -> String {
    let mut text = String::new();
    let mut column = 0;
    for (place, summand) in expression.split(" + ").enumerate() {
        if place > 0 {
            text.push_str(" +");
            if column + summand.len() > WIDTH {
                text.push_str(continued);
                text.push('\n');
                text.push_str(indent);
                column = indent.len();
            } else {
                text.push(' ');
            }
        }
        text.push_str(summand);
        column += summand.len() + 3;
    }
    text
}

/// Horner's form in the first of some variables, whose coefficients have that form in the others.
fn nested(terms: Vec<([usize; 3], f64)>, variables: &[&str]) -> String {
    let axis = 3 - variables.len();
    let Some((variable, others)) = variables.split_first() else {
        return number(terms.iter().map(|(_, coefficient)| coefficient).sum());
    };
    let mut powers: BTreeMap<usize, Vec<_>> = BTreeMap::new();
    for term in terms {
        powers.entry(term.0[axis]).or_default().push(term);
    }
    let mut text = String::new();
    let mut above = 0;
    for (power, terms) in powers.into_iter().rev() {
        let inner = nested(terms, others);
        text = if text.is_empty() {
            inner
        } else {
            format!("{inner} + {}", times(variable, above - power, &text))
        };
        above = power;
    }
    match (text.is_empty(), above) {
        (true, _) => "0.0".into(),
        (false, 0) => text,
        _ => times(variable, above, &text),
    }
}

/// A power of a variable times an expression.
fn times(variable: &str, power: usize, factor: &str) -> String {
    let powers = vec![variable; power].join("*");
    let single = !factor.starts_with('-') && !factor.contains(' ');
    if single { format!("{powers}*{factor}") } else { format!("{powers}*({factor})") }
}

#[cfg(test)]
mod tests {
    use quasirigid_math::polynomial::Homogeneous;

    use super::*;

    #[test]
    fn polynomials_are_nested_without_terms_that_do_not_occur() {
        let mut map = Series::zero(3, 1);
        let mut cubic = Homogeneous::zero(3, 1);
        for (powers, coefficient) in [([3, 0, 0], 2.0), ([1, 0, 2], -0.5), ([0, 2, 1], 1e-7)] {
            cubic.row_mut(0)[quasirigid_math::polynomial::monomial::index(powers)] = coefficient;
        }
        map.set(cubic);
        assert_eq!(expression(&map, 0, ["x", "y", "z"]), "y*y*z*1e-7 + x*(z*z*(-5e-1) + x*x*2e0)");
        assert_eq!(expression(&Series::zero(2, 1), 0, ["x", "y", "z"]), "0.0");
        let long = vec!["1.25e-3*x"; 30].join(" + ");
        let lines = broken(&long, "    ", " ...");
        assert!(lines.lines().count() > 2 && lines.lines().all(|line| line.len() < WIDTH + 20), "{lines}");
        assert_eq!(lines.replace(" ...\n    ", " "), long);
    }
}
