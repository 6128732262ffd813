//! `data/published/centre_manifold`: trajectories of the full system to 1e-8, and the energy that the reduced one loses.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/published/centre_manifold");

/// Rows of the table that a command prints: t, spin, and energy.
fn simulated(case: &str, extra: &str, options: &[&str]) -> Vec<[f64; 5]> {
    let folder = tempfile::TempDir::new().unwrap();
    let text = fs::read_to_string(Path::new(FOLDER).join(format!("{case}.toml"))).unwrap();
    fs::write(folder.path().join("model.toml"), text + extra).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_quasirigid"))
        .current_dir(folder.path())
        .args(["simulate", "model.toml", "--quiet"])
        .args(options)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    let row = |line: &str| {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        [fields[0], fields[1], fields[2], fields[3], fields[8]]
    };
    text.lines().skip(1).map(row).collect()
}

fn reference(case: &str) -> Value {
    let text = fs::read_to_string(Path::new(FOLDER).join(format!("{case}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|entry| entry.as_f64().unwrap()).collect()
}

fn assert_follows(case: &str, extra: &str, history: &Value) {
    let times = list(&history["time"]).iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let rows = simulated(case, extra, &["--system", "full", "--times", &times]);
    let energies = list(&history["energy"]);
    let mut worst = [0.0_f64; 2];
    for (i, [_, x, y, z, energy]) in rows.iter().copied().enumerate() {
        let omega = list(&history["omega"][i]);
        for (found, expected) in [x, y, z].iter().zip(&omega) {
            worst[0] = worst[0].max((found - expected).abs());
        }
        worst[1] = worst[1].max((energy / energies[i] - 1.0).abs());
    }
    println!("{case}: spin {:.1e} rad/s, energy {:.1e}", worst[0], worst[1]);
    assert!(worst[0] < 1e-8 && worst[1] < 1e-8, "{case}: {worst:?}");
}

#[test]
fn free_body_follows_the_reference_from_the_slow_manifold() {
    assert_follows("ref-free", "[run]\norder = 5\n", &reference("ref-free")["full"]);
}

#[test]
fn free_body_follows_the_reference_from_rest() {
    let rest = "displacements = \"rest\"\n";
    assert_follows("ref-free", rest, &reference("ref-free")["full_from_rest"]);
}

#[test]
fn decaying_body_follows_the_reference() {
    assert_follows("ref-decay", "", &reference("ref-decay"));
}

/// `ε = 0.08`: at the paper's order the power is in error by `ε²` of itself.
#[test]
fn reduced_body_loses_the_reference_energy() {
    let expected = reference("ref-decay")["energy_loss"].as_f64().unwrap();
    for (order, tolerance) in [("3", 0.02), ("5", 5e-4)] {
        let rows = simulated("ref-decay", "", &["--order", order, "--times", "0,400"]);
        let lost = rows[0][4] - rows[1][4];
        println!("order {order}: {lost:.6e} J of {expected:.6e} J");
        assert!((lost / expected - 1.0).abs() < tolerance, "order {order}: {lost} J, reference {expected} J");
    }
}
