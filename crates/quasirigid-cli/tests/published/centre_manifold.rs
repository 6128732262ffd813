//! `data/published/centre_manifold`: polynomials to 1e-10 of the largest coefficient of their degree, as SOURCE.md says.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/published/centre_manifold");
const TOLERANCE: f64 = 1e-10;

/// Coefficients by degree and exponents.
type Terms = BTreeMap<usize, BTreeMap<[u64; 3], Vec<f64>>>;

fn derived(case: &str, order: usize) -> Value {
    let model = Path::new(FOLDER).join(format!("{case}.toml"));
    let output = Command::new(env!("CARGO_BIN_EXE_quasirigid"))
        .args(["derive", model.to_str().unwrap(), "--order", &order.to_string(), "--format", "json"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn reference(case: &str) -> Value {
    let text = std::fs::read_to_string(Path::new(FOLDER).join(format!("{case}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(entries) => entries.iter().flat_map(numbers).collect(),
        _ => vec![value.as_f64().unwrap()],
    }
}

fn terms(list: &Value) -> Terms {
    let mut terms = Terms::new();
    for term in list.as_array().unwrap() {
        let exponents = [0, 1, 2].map(|i| term["exponents"][i].as_u64().unwrap());
        let degree = exponents.iter().sum::<u64>() as usize;
        terms.entry(degree).or_default().insert(exponents, numbers(&term["value"]));
    }
    terms
}

/// Largest difference between two lists relative to the largest entry of the second.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    found.iter().zip(expected).fold(0.0_f64, |worst, (a, b)| worst.max((a - b).abs())) / size
}

/// Every degree of `expected` is in `found`, with every monomial, and agrees.
fn assert_terms_agree(name: &str, found: &Terms, expected: &Terms) {
    for (degree, expected) in expected {
        let found = &found[degree];
        assert_eq!(found.len(), (degree + 1) * (degree + 2) / 2, "{name}: every monomial of degree {degree}");
        assert_eq!(found.len(), expected.len());
        let flat =
            |terms: &BTreeMap<[u64; 3], Vec<f64>>| terms.values().flatten().copied().collect::<Vec<_>>();
        let error = difference(&flat(found), &flat(expected));
        println!("{name}, degree {degree}: {error:.1e}");
        assert!(error < TOLERANCE, "{name}, degree {degree}: {error:e}");
    }
}

fn assert_list_agrees(name: &str, found: &Value, expected: &Value) {
    let error = difference(&numbers(found), &numbers(expected));
    println!("{name}: {error:.1e}");
    assert!(error < TOLERANCE, "{name}: {error:e}");
}

#[test]
fn free_body_has_the_reference_equations() {
    let (found, expected) = (derived("ref-free", 3), reference("ref-free"));
    assert_eq!(found["order"], 3);
    for name in ["mass", "center_of_mass", "inertia", "frequencies"] {
        assert_list_agrees(name, &found[name], &expected[name]);
    }
    assert_eq!(terms(&found["mu"]).keys().copied().collect::<Vec<_>>(), [4, 5]);
    assert_terms_agree("mu", &terms(&found["mu"]), &terms(&expected["mu"]));
    assert_terms_agree("momentum", &terms(&found["momentum"]), &terms(&expected["momentum"]));
}

#[test]
fn free_body_has_the_reference_equations_beyond_the_paper() {
    let (found, expected) = (derived("ref-free", 5), reference("ref-free"));
    assert_terms_agree("mu", &terms(&found["mu"]), &terms(&expected["mu"]));
    assert_terms_agree("mu_higher", &terms(&found["mu"]), &terms(&expected["mu_higher"]));
}

#[test]
fn body_with_a_fixed_point_has_the_reference_equations() {
    let (found, expected) = (derived("ref-fixed", 3), reference("ref-fixed"));
    for name in ["mass", "inertia"] {
        assert_list_agrees(name, &found[name], &expected[name]);
    }
    assert_terms_agree("mu", &terms(&found["mu"]), &terms(&expected["mu"]));
    assert_terms_agree("momentum", &terms(&found["momentum"]), &terms(&expected["momentum"]));
}

#[test]
fn decaying_body_has_the_reference_inertia() {
    let (found, expected) = (derived("ref-decay", 3), reference("ref-decay"));
    assert_list_agrees("inertia", &found["inertia"], &expected["inertia"]);
}
