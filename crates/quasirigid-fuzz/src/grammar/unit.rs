//! Quantities: a number and a product of units.

use arbitrary::Unstructured;

use super::choice::{below, chance, pick};

const SYMBOLS: [&str; 30] = [
    "m", "kg", "s", "N", "rad", "deg", "rpm", "Hz", "in", "ft", "lb", "lbf", "g", "Pa", "J", "W", "h", "d",
    "yr", "A", "T", "cSt", "slug", "km", "µm", "GPa", "Myr", "oz", "V", "mas",
];

/// A quantity.
pub fn quantity(u: &mut Unstructured<'_>) -> String {
    let number =
        pick(u, &["1", "2.5", "-3", "1e300", "1e-300", "0", ".5", "1e400", "nan", "+7", "1e", "12."]);
    format!("{number} {}", product(u, 4))
}

fn product(u: &mut Unstructured<'_>, depth: usize) -> String {
    let mut text = factor(u, depth);
    for _ in 0..below(u, 3) {
        text += pick(u, &[" ", "/", "*", "·", " / "]);
        text += &factor(u, depth);
    }
    text
}

fn factor(u: &mut Unstructured<'_>, depth: usize) -> String {
    let base = if depth > 0 && chance(u, 40) {
        format!("({})", product(u, depth - 1))
    } else {
        format!("{}{}", pick(u, &["", "", "k", "m", "M", "G", "da", "Y"]), pick(u, &SYMBOLS))
    };
    match below(u, 4) {
        0 => format!("{base}^{}", pick(u, &["2", "-1", "3", "0", "99", "2147483648", "-128", "1.5"])),
        _ => base,
    }
}
