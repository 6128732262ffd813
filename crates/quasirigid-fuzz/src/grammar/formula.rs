//! Formulas in the variables of forces.

use arbitrary::Unstructured;

use super::choice::{below, pick};

/// Deepest tree.
const DEEPEST: usize = 8;

/// A formula.
pub fn formula(u: &mut Unstructured<'_>) -> String {
    tree(u, DEEPEST)
}

fn tree(u: &mut Unstructured<'_>, depth: usize) -> String {
    if depth == 0 {
        return leaf(u);
    }
    match below(u, 8) {
        0 | 1 => leaf(u),
        2 => format!("({})", tree(u, depth - 1)),
        3 => format!("{}{}", pick(u, &["-", "+", "--"]), tree(u, depth - 1)),
        4 => {
            let function = pick(
                u,
                &[
                    "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "ln",
                    "log10", "sqrt", "abs", "nothing",
                ],
            );
            format!("{function}({})", tree(u, depth - 1))
        }
        5 => {
            let function = pick(u, &["atan2", "pow", "min", "max", "hypot"]);
            format!("{function}({}, {})", tree(u, depth - 1), tree(u, depth - 1))
        }
        _ => {
            let left = tree(u, depth - 1);
            format!("{left} {} {}", pick(u, &["+", "-", "*", "/", "^", "**"]), tree(u, depth - 1))
        }
    }
}

fn leaf(u: &mut Unstructured<'_>) -> String {
    let leaves = [
        "0", "1", "t", "x", "wx", "qw", "0.5", "2", "3", "-1", "pi", "e", "1e308", "1e-308", "0.1", "1e400",
        "7", ".5", "2.", "vx",
    ];
    pick(u, &leaves).to_owned()
}
