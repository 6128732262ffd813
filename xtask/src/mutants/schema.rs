//! A switch for each kind of mutant.
//! Comments `/*m7*/ … /*7m*/` stand around the text of mutant 7 and `/*c7*/ … /*7c*/` around what holds it, so that an error of the
//! compiler tells which mutant it is about.

use std::cmp::Reverse;
use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Arm, BinOp, Expr, ExprBinary, ExprStruct, ExprUnary, Pat};

use super::sample::Mutant;
use super::source::{Edit, Piece, offset};

/// Edits of a file for its mutants, without those whose place takes no switch; an outer one stands before those inside it.
pub fn edits<'m>(text: &'m str, mutants: &[(usize, &'m Mutant)]) -> Result<Vec<Edit>, String> {
    let syntax = syn::parse_file(text).map_err(|error| error.to_string())?;
    let place = |mutant: &Mutant| offset(text, mutant.span[0]).zip(offset(text, mutant.span[1]));
    let placed = mutants.iter().map(|&(number, mutant)| {
        let (start, end) = place(mutant).ok_or_else(|| format!("no such place: {}", mutant.name))?;
        Ok(Placed { number, mutant, range: start..end })
    });
    let mut finder =
        Finder { mutants: placed.collect::<Result<_, String>>()?, edits: Vec::new(), text, operation: None };
    finder.bodies();
    finder.visit_file(&syntax);
    let mut edits = finder.edits;
    edits
        .sort_by_key(|edit| (edit.range.start, !edit.range.is_empty(), Reverse(edit.range.end), edit.mutant));
    Ok(edits)
}

struct Placed<'m> {
    number: usize,
    mutant: &'m Mutant,
    range: Range<usize>,
}

struct Finder<'m> {
    text: &'m str,
    mutants: Vec<Placed<'m>>,
    edits: Vec<Edit>,
    /// Outermost of the operations, one directly in another, that the visitor is in: another operator may regroup them.
    operation: Option<Range<usize>>,
}

fn active(n: usize) -> String {
    format!("/*m{n}*/crate::mutant_switch::active({n})/*{n}m*/")
}

fn text(text: impl Into<String>) -> Piece {
    Piece::Text(text.into())
}

fn edit(n: usize, range: Range<usize>, pieces: Vec<Piece>) -> Edit {
    let pieces = [vec![text(format!("/*c{n}*/"))], pieces, vec![text(format!("/*{n}c*/"))]].concat();
    Edit { mutant: n, range, pieces }
}

/// An expression or, if the switch is thrown, another.
fn choice(n: usize, range: Range<usize>, mutated: &str) -> Edit {
    let original = text(format!("(if !{} {{", active(n)));
    let other = text(format!("}} else {{/*m{n}*/{mutated}/*{n}m*/}})"));
    edit(n, range.clone(), vec![original, Piece::Source(range), other])
}

impl<'m> Finder<'m> {
    /// Bodies that return at once. A function that returns `impl Trait` has one type for all of its returns, so it takes no switch.
    fn bodies(&mut self) {
        let bodies = self.mutants.iter().filter(|placed| placed.mutant.genre == "FnValue");
        let returned = |name: &str| name.split_once(" -> ").is_some_and(|(_, kind)| kind.contains("impl "));
        let early = bodies.filter(|placed| !returned(&placed.mutant.name)).map(|placed| {
            let (n, value) = (placed.number, &placed.mutant.replacement);
            let early = format!("if {} {{/*m{n}*/return {value};/*{n}m*/}} ", active(n));
            edit(n, placed.range.start..placed.range.start, vec![text(early)])
        });
        self.edits.extend(early);
    }

    fn at(&self, genre: &str, range: &Range<usize>) -> Vec<(usize, &'m str, Range<usize>)> {
        let here = self
            .mutants
            .iter()
            .filter(|placed| placed.mutant.genre == genre && placed.range.start == range.start);
        here.map(|placed| (placed.number, placed.mutant.replacement.as_str(), placed.range.clone())).collect()
    }

    /// A choice between a part of the source and the same part with a replacement in it.
    fn choose(&mut self, n: usize, whole: &Range<usize>, part: &Range<usize>, replacement: &str) {
        let [before, after] = [whole.start..part.start, part.end..whole.end].map(|range| &self.text[range]);
        self.edits.push(choice(n, whole.clone(), &format!("{before}{replacement}{after}")));
    }
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_expr_binary(&mut self, it: &'ast ExprBinary) {
        let whole = self.operation.take().unwrap_or_else(|| it.span().byte_range());
        for (n, operator, place) in self.at("BinaryOperator", &it.op.span().byte_range()) {
            self.choose(n, &whole, &place, operator);
        }
        for side in [&it.left, &it.right] {
            let regrouped =
                matches!(&**side, Expr::Binary(inner) if is_logical(&inner.op) || !is_logical(&it.op));
            self.operation = regrouped.then(|| whole.clone());
            self.visit_expr(side);
        }
    }

    fn visit_expr_unary(&mut self, it: &'ast ExprUnary) {
        for (n, replacement, place) in self.at("UnaryOperator", &it.op.span().byte_range()) {
            self.choose(n, &it.span().byte_range(), &place, replacement);
        }
        visit::visit_expr_unary(self, it);
    }

    fn visit_expr_struct(&mut self, it: &'ast ExprStruct) {
        for field in &it.fields {
            for (n, replacement, place) in self.at("StructField", &field.span().byte_range()) {
                self.choose(n, &it.span().byte_range(), &place, replacement);
            }
        }
        visit::visit_expr_struct(self, it);
    }

    fn visit_arm(&mut self, it: &'ast Arm) {
        let pattern = it.pat.span().byte_range();
        let guard = match &it.pat {
            Pat::Guard(pattern) => Some(pattern.guard.span().byte_range()),
            _ => None,
        };
        for (n, ..) in self.at("MatchArm", &it.span().byte_range()) {
            self.edits.push(match guard.clone() {
                Some(guard) => around(n, guard, "!", "&&"),
                None => edit(n, pattern.end..pattern.end, vec![text(format!(" if !{}", active(n)))]),
            });
        }
        if let Some(guard) = guard {
            for (n, value, _) in self.at("MatchArmGuard", &guard) {
                let [not, operator] = if value == "true" { ["", "||"] } else { ["!", "&&"] };
                self.edits.push(around(n, guard.clone(), not, operator));
            }
        }
        visit::visit_arm(self, it);
    }
}

/// Whether the operands are conditions, one of which may be a `let`.
fn is_logical(operator: &BinOp) -> bool {
    matches!(operator, BinOp::And(_) | BinOp::Or(_))
}

/// A guard together with the switch.
fn around(n: usize, guard: Range<usize>, not: &str, operator: &str) -> Edit {
    let switch = text(format!("({not}{} {operator} (", active(n)));
    edit(n, guard.clone(), vec![switch, Piece::Source(guard), text("))")])
}

#[cfg(test)]
mod tests {
    use super::edits;
    use crate::mutants::sample::Mutant;
    use crate::mutants::source::{mutated, render};

    /// A mutant of the first place of `old` in the text.
    fn mutant(text: &str, genre: &str, old: &str, new: &str) -> Mutant {
        let start = text.find(old).expect("the place");
        let place = |at: usize| {
            let before = &text[..at];
            let line = before.rfind('\n').map_or(0, |end| end + 1);
            [before.matches('\n').count() + 1, before[line..].chars().count() + 1]
        };
        let span = [place(start), place(start + old.len())];
        let [name, file] = ["a.rs:1:1: replace f -> f64 with 1.0", "a.rs"].map(str::to_owned);
        Mutant { name, file, genre: genre.into(), replacement: new.into(), span }
    }

    /// The text with switches, without their comments and with a short name.
    fn switched(text: &str, mutants: &[Mutant]) -> String {
        let numbered: Vec<_> = mutants.iter().enumerate().collect();
        let written = render(text, 0..text.len(), &edits(text, &numbered).expect("a sound text"));
        let parts = written.split("/*").map(|part| part.split_once("*/").map_or(part, |(_, rest)| rest));
        parts.collect::<String>().replace("crate::mutant_switch::active", "on")
    }

    #[test]
    fn each_kind_of_mutant_has_its_switch() {
        for (text, genre, old, new, expected) in [
            ("fn f() -> f64 { a }", "FnValue", "a }", "1.0", "fn f() -> f64 { if on(0) {return 1.0;} a }"),
            (
                "fn f() { g(a + b) }",
                "BinaryOperator",
                "+",
                "-",
                "fn f() { g((if !on(0) {a + b} else {a - b})) }",
            ),
            ("fn f() { g(-a) }", "UnaryOperator", "-", "", "fn f() { g((if !on(0) {-a} else {a})) }"),
            (
                "fn f() { S { a: 1, ..s } }",
                "StructField",
                "a: 1,",
                "",
                "fn f() { (if !on(0) {S { a: 1, ..s }} else {S {  ..s }}) }",
            ),
            (
                "fn f() { match a { 1 => 2, _ => 3 } }",
                "MatchArm",
                "1 => 2,",
                "",
                "fn f() { match a { 1 if !on(0) => 2, _ => 3 } }",
            ),
            (
                "fn f() { match a { n if n > 2 => 2, _ => 3 } }",
                "MatchArm",
                "n if n > 2 => 2,",
                "",
                "fn f() { match a { n if (!on(0) && (n > 2)) => 2, _ => 3 } }",
            ),
            (
                "fn f() { match a { n if n > 2 => 2, _ => 3 } }",
                "MatchArmGuard",
                "n > 2",
                "true",
                "fn f() { match a { n if (on(0) || (n > 2)) => 2, _ => 3 } }",
            ),
        ] {
            assert_eq!(switched(text, &[mutant(text, genre, old, new)]), expected);
        }
    }

    /// `a - b·c` with `+` for `·` is `(a - b) + c`.
    #[test]
    fn another_operator_regroups_the_operations_around_it() {
        let text = "fn f() { g(é, a - b * c) && a < b * c }";
        let mutant = mutant(text, "BinaryOperator", "*", "+");
        assert_eq!(
            switched(text, std::slice::from_ref(&mutant)),
            "fn f() { g(é, (if !on(0) {a - b * c} else {a - b + c})) && a < b * c }"
        );
        assert_eq!(mutated(text, &mutant).expect("a place"), "fn f() { g(é, a - b + c) && a < b * c }");
    }

    #[test]
    fn one_mutant_stands_inside_another() {
        let text = "fn f() -> f64 { (a + b) * -c }";
        let of = |genre, old, new| mutant(text, genre, old, new);
        let mutants = [
            of("BinaryOperator", "+", "-"),
            of("BinaryOperator", "*", "/"),
            of("FnValue", "(a + b) * -c", "1.0"),
        ];
        assert_eq!(
            switched(text, &mutants),
            "fn f() -> f64 { if on(2) {return 1.0;} \
             (if !on(1) {((if !on(0) {a + b} else {a - b})) * -c} else {(a + b) / -c}) }"
        );
    }
}
