//! The exported equations are those of the library: the JSON text is read back and evaluated.

use quasirigid::model::{FlexibleBody, ReducedBody};
use quasirigid_study::derive::Equations;
use serde_json::Value;

use super::DIRECTIONS;

/// Rounding of some hundred terms, relative to the sum of their sizes.
const SUM_ROUNDING: f64 = 1e-12;

/// Holds the exports of a body to the library.
pub fn agree(body: &FlexibleBody, reduced: &ReducedBody, equations: &Equations<'_>) {
    let text = equations.json();
    let object: Value = serde_json::from_str(&text).expect("the export is JSON");
    let null = nulls(&object, "");
    assert!(null.is_none(), "a number of the export is none: {}", null.unwrap_or_default());
    assert!(!equations.text().is_empty() && !equations.latex().is_empty());
    let above = |series: &quasirigid_math::polynomial::Series, lowest: usize, omega: [f64; 3]| -> Vec<f64> {
        let mut value = vec![0.0; series.rows()];
        (lowest..=series.degree()).for_each(|degree| series.part(degree).add_value(omega, &mut value));
        value
    };
    let cyclic = !body.cyclic().is_empty();
    for omega in DIRECTIONS {
        let mu = (3..=reduced.highest_degree()).map(|degree| reduced.mu(degree).value(omega));
        let torque = mu.fold(vec![0.0; 3], |sum, part| sum.iter().zip(part).map(|(a, b)| a + b).collect());
        same("mu", &object["mu"], omega, &torque);
        same("momentum", &object["momentum"], omega, &above(&reduced.K, if cyclic { 2 } else { 3 }, omega));
        same("energy", &object["energy"], omega, &[reduced.energy(omega)]);
        same("power", &object["power"], omega, &[reduced.dissipated_power(omega)]);
        same("spin_of_momentum", &object["spin_of_momentum"], omega, &above(&reduced.Omega, 1, omega));
        same(
            "energy_of_momentum",
            &object["energy_of_momentum"],
            omega,
            &[reduced.energy_of_momentum.scalar(omega)],
        );
        same("c", &object["c"], omega, &reduced.c.value(omega));
        same("T", &object["T"], omega, &reduced.T.value(omega));
        let q = above(&reduced.q, 2, omega);
        same("displacements", &object["displacements"], omega, &q[..body.elastic()]);
        same("rates", &object["rates"], omega, &above(&reduced.rate, 2, omega)[body.cyclic()]);
    }
}

/// Path of the first null.
fn nulls(value: &Value, path: &str) -> Option<String> {
    match value {
        Value::Null => Some(path.to_owned()),
        Value::Array(items) => {
            items.iter().enumerate().find_map(|(index, item)| nulls(item, &format!("{path}.{index}")))
        }
        Value::Object(entries) => {
            let mut entries = entries.iter().filter(|(key, _)| *key != "forces");
            entries.find_map(|(key, item)| nulls(item, &format!("{path}.{key}")))
        }
        _ => None,
    }
}

/// The terms of an export, evaluated.
fn same(name: &str, terms: &Value, omega: [f64; 3], expected: &[f64]) {
    let mut value = vec![0.0; expected.len()];
    let mut sizes = vec![0.0; expected.len()];
    for term in terms.as_array().into_iter().flatten() {
        let exponents = [0, 1, 2].map(|axis| term["exponents"][axis].as_i64().unwrap_or(0) as i32);
        let monomial: f64 = (0..3).map(|axis| omega[axis].powi(exponents[axis])).product();
        for (row, coefficient) in term["value"].as_array().into_iter().flatten().enumerate() {
            let part = monomial * coefficient.as_f64().unwrap_or(f64::NAN);
            value[row] += part;
            sizes[row] += part.abs();
        }
    }
    for row in 0..expected.len() {
        let gap = (value[row] - expected[row]).abs();
        assert!(
            gap <= SUM_ROUNDING * sizes[row] || !sizes[row].is_finite(),
            "{name}[{row}] at {omega:?}: {} exported, {} in the library",
            value[row],
            expected[row]
        );
    }
}
