//! `derive`: fields of the JSON, monomials of every order, text and LaTeX that show the same numbers.
//! LaTeX is parsed back to numbers and checked for balance, because no test compiles it.
//! Displacements: (R4), docs/theory/03-reduction.md, the paper's (2.14).

use quasirigid_study::Study;
use serde_json::Value;

use crate::support::{examples, file, numbers, study_of};

fn of(example: &str, order: usize) -> Study {
    Study::open(file(example), Some(order)).unwrap()
}

fn derived(example: &str, order: usize) -> Value {
    serde_json::from_str(&of(example, order).derive().unwrap().json()).unwrap()
}

fn latex(example: &str, order: usize) -> String {
    of(example, order).derive().unwrap().latex()
}
/// Exponents of every monomial from one degree to another: by degree, then in descending powers of x, then of y.
fn monomials(degrees: std::ops::RangeInclusive<u64>) -> Vec<[u64; 3]> {
    let of_degree =
        |d: u64| (0..=d).rev().flat_map(move |i| (0..=d - i).rev().map(move |j| [i, j, d - i - j]));
    degrees.flat_map(of_degree).collect()
}

fn exponents(list: &Value) -> Vec<[u64; 3]> {
    let of = |term: &Value| [0, 1, 2].map(|axis| term["exponents"][axis].as_u64().unwrap());
    list.as_array().unwrap().iter().map(of).collect()
}

#[test]
fn json_has_every_field_of_the_contract() {
    // the liquid of a ring slides, and has no reduced equations
    for example in examples().filter(|name| name != "ring-damper") {
        let json = derived(&example, 3);
        assert!(json["mass"].as_f64().unwrap() > 0.0);
        for name in ["center_of_mass", "pole"] {
            assert_eq!(numbers(&json[name]).len(), 3, "{name}");
        }
        let inertia: Vec<_> = json["inertia"].as_array().unwrap().iter().map(numbers).collect();
        assert_eq!(inertia.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3, 3]);
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            assert_eq!(inertia[row][column], inertia[column][row], "{example}");
        }
        let frequencies = numbers(&json["frequencies"]);
        let vibrates = !["apophis-flyby", "mercury-ring", "spherical-tank"].contains(&example.as_str());
        assert!(frequencies.is_empty() != vibrates && frequencies.is_sorted(), "{frequencies:?}");
        assert_eq!(json["order"], 3);
    }
}

/// Mass and centre of mass of the axial-mass example by hand: 7.1 kg, centred on the origin.
#[test]
fn json_has_the_mass_and_the_centre_of_mass_of_the_file() {
    let json = derived("axial-mass", 3);
    assert!((json["mass"].as_f64().unwrap() - 7.1).abs() < 1e-14);
    assert!(numbers(&json["center_of_mass"]).iter().all(|x| x.abs() < 1e-16), "{json}"); // of 0.5 m
}

#[test]
fn json_has_every_monomial_in_order_at_every_order() {
    for order in [1, 2, 3, 5] {
        let json = derived("three-masses", order);
        let order = order as u64;
        assert_eq!(exponents(&json["mu"]), monomials(4..=order + 2), "mu at order {order}");
        assert_eq!(exponents(&json["momentum"]), monomials(3..=order + 1), "momentum at order {order}");
        for name in ["mu", "momentum"] {
            let terms = json[name].as_array().unwrap();
            assert!(terms.iter().all(|term| numbers(&term["value"]).len() == 3), "{name}");
        }
    }
}

#[test]
fn lower_orders_are_the_beginning_of_higher_ones() {
    let (low, high) = (derived("three-masses", 3), derived("three-masses", 5));
    for name in ["mu", "momentum"] {
        let low = low[name].as_array().unwrap();
        assert_eq!(low[..], high[name].as_array().unwrap()[..low.len()], "{name}");
    }
}

#[test]
fn latex_is_balanced_and_has_the_degrees_of_the_order() {
    for (example, order) in [("three-masses", 1), ("three-masses", 3), ("axial-mass", 5), ("explorer1", 3)] {
        let latex = latex(example, order);
        assert_balanced(&latex);
        assert!(latex.starts_with('%'), "the name is a comment");
        assert_eq!(
            latex.matches(r"\begin{align*}").count(),
            2 * (order - 1),
            "one display a degree, of mu from 4 up and of q from 2 up"
        );
        assert!(!latex.contains("NaN") && !latex.contains("inf"), "{latex}");
        assert!(!latex.contains("\n\n"), "a blank line ends a display");
    }
}

/// (2.14) of the paper, as the text and the object have it.
#[test]
fn latex_has_the_displacements_of_the_json() {
    let latex = latex("three-masses", 3);
    let json = derived("three-masses", 3);
    let names: Vec<_> =
        json["coordinates"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    for (number, name) in (1..).zip(&names) {
        let name = name.replace('"', "");
        assert!(latex.contains(&format!("% q_{number}: {name}, m\n")), "{latex}");
    }
    assert!(latex.contains("  q = q_{2}(\\omega) + q_{3}(\\omega)\n"), "{latex}");
    let terms = json["displacements"].as_array().unwrap();
    let term = terms.iter().find(|term| term["exponents"] == serde_json::json!([1, 0, 2])).unwrap();
    let exact = numbers(&term["value"]);
    assert_eq!(exact.len(), names.len());
    for (number, exact) in (1..).zip(exact) {
        let shown = coefficient(&latex, &format!("q_{{3,{number}}}"), r"\omega_x\omega_z^{2}");
        assert!((shown - exact).abs() <= 1e-9 * exact.abs(), "{shown} {exact}"); // ten digits are printed
    }
}

/// The number before a monomial in the row of a symbol.
fn coefficient(latex: &str, symbol: &str, monomial: &str) -> f64 {
    let (_, rest) = latex.split_once(&format!("  {symbol} &= ")).unwrap();
    let row = rest.split("\n\\end").next().unwrap().split("\n  q_").next().unwrap();
    let row = row.replace("\\\\\n  &\\quad ", "");
    let pieces: Vec<_> = row.split(r"\,").collect();
    let is_after = |piece: &str| piece.split(' ').next() == Some(monomial);
    let after = pieces.iter().position(|piece| is_after(piece)).unwrap();
    let before = pieces[after - 1];
    let sign = before.rfind("+ ").max(before.rfind("- "));
    let digits = sign.map_or(before, |at| &before[at + 2..]).replace(r"\cdot 10^{", "e").replace('}', "");
    let size: f64 = digits.trim().parse().unwrap();
    if sign.is_some_and(|at| before[at..].starts_with('-')) { -size } else { size }
}

/// Braces close, environments close in the order in which they opened, and columns of a display are two.
fn assert_balanced(latex: &str) {
    let mut depth = 0;
    for letter in latex.chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        assert!(depth >= 0, "a brace closes nothing:\n{latex}");
    }
    assert_eq!(depth, 0, "braces stay open:\n{latex}");
    let mut open = Vec::new();
    for command in latex.split('\\').skip(1) {
        if let Some(rest) = command.strip_prefix("begin{") {
            open.push(rest.split('}').next().unwrap());
        } else if let Some(rest) = command.strip_prefix("end{") {
            assert_eq!(open.pop(), rest.split('}').next(), "{latex}");
        }
    }
    assert_eq!(open, [""; 0], "{latex}");
    for display in latex.split(r"\begin{align*}").skip(1) {
        let (display, _) = display.split_once(r"\end{align*}").unwrap();
        assert!(display.split(r"\\").all(|line| line.matches('&').count() == 1), "{display}");
    }
}

#[test]
fn text_shows_the_numbers_of_the_json() {
    let study = study_of("three-masses");
    let text = study.derive().unwrap().text();
    assert!(text.starts_with(&format!("{}: reduced equations of order 3\n", study.model.name)), "{text}");
    let terms = derived("three-masses", 3)["mu"].as_array().unwrap().clone();
    let term = terms.iter().find(|term| term["exponents"] == serde_json::json!([2, 1, 1])).unwrap();
    let row = text.lines().find(|line| line.starts_with("  wx^2 wy wz ")).unwrap();
    let shown: Vec<f64> = row.split_whitespace().skip(3).map(|word| word.parse().unwrap()).collect();
    for (shown, exact) in shown.iter().zip(numbers(&term["value"])) {
        assert!((shown - exact).abs() <= 1e-9 * exact.abs(), "{shown} {exact}"); // ten digits are printed
    }
    assert_eq!(shown.len(), 3);
}
