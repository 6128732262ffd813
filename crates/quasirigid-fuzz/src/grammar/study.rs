//! Study files.

use arbitrary::Unstructured;

use super::choice::{below, chance, pick};
use super::number::Numbers;

const KEYS: [&str; 6] = [
    "carrier.mass",
    "spring.1.stiffness",
    "\\\"material.rock.rheology.Q\\\"",
    "point.tip.position.2",
    "carrier",
    "a.b.c.d.e.f",
];
const QUANTITIES: [&str; 8] = [
    "evolve.time",
    "check.valid",
    "modes.nutation.time_constant",
    "simulate.energy",
    "derive.mu",
    "modes.stable",
    "nothing",
    "check.T1",
];

/// A study.
pub fn study(u: &mut Unstructured<'_>) -> String {
    let mut text = "model = \"model.toml\"\n".to_owned();
    if chance(u, 128) {
        text += &format!("seed = {}\n", pick(u, &["0", "7", "-1", "9223372036854775807", "1.5"]));
    }
    let samples = pick(u, &["5", "1000", "1", "0", "10000000000", "10000000001", "65537"]);
    text += &format!("samples = {samples}\n");
    if chance(u, 128) {
        text += &format!("sampling = \"{}\"\n", pick(u, &["sobol", "latin-hypercube", "random", "none"]));
    }
    let mut numbers = Numbers::new(u);
    text += "[vary]\n";
    for _ in 0..1 + below(numbers.u, 4) {
        let key = pick(numbers.u, &KEYS);
        text += &format!("\"{key}\" = {}\n", values(&mut numbers));
    }
    if chance(numbers.u, 40) {
        text += "[table]\nfile = \"bodies.csv\"\ncolumns = { \"a_km\" = { key = \"ellipsoid.1.semi_axes.1\", unit = \"km\" } }\nkeep = [\"name\"]\n";
    }
    let quantities: Vec<String> =
        (0..1 + below(numbers.u, 3)).map(|_| format!("\"{}\"", pick(numbers.u, &QUANTITIES))).collect();
    text += &format!("[answer]\nquantities = [{}]\n", quantities.join(", "));
    if chance(numbers.u, 60) {
        text += &format!("percentiles = [{}, {}]\n", numbers.near(20.0), numbers.near(50.0));
    }
    if chance(numbers.u, 60) {
        text += &format!("times = [{}, \"1 h\"]\n", numbers.near(20.0));
    }
    text
}

fn values(numbers: &mut Numbers<'_, '_>) -> String {
    let (a, b) = (numbers.near(1.0), numbers.near(100.0));
    let unit = pick(numbers.u, &["N/m", "km", "kg", "Hz", "furlong"]);
    let (a, b) =
        if chance(numbers.u, 100) { (format!("\"{a} {unit}\""), format!("\"{b} {unit}\"")) } else { (a, b) };
    let count = numbers.count(40);
    match below(numbers.u, 7) {
        0 => format!("{{ linear = [{a}, {b}], count = {count} }}"),
        1 => format!("{{ geometric = [{a}, {b}], count = {count} }}"),
        2 => format!("{{ list = [{a}, {b}, {a}] }}"),
        3 => format!("{{ uniform = [{a}, {b}] }}"),
        4 => format!("{{ log-uniform = [{a}, {b}] }}"),
        5 => format!("{{ normal = {{ mean = {a}, deviation = {b}, min = {a} }} }}"),
        _ => format!("{{ log-normal = {{ median = {a}, decades = {} }} }}", numbers.near(1.0)),
    }
}
