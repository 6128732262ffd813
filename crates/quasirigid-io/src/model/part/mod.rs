//! Parts of finite elements: beams, panels, solids, decks, matrices and modes, their attachments, and the names of their nodes.

pub(super) mod beam;
pub(super) mod connection;
pub(super) mod deck;
mod masses;
pub(super) mod matrices;
pub(super) mod modes;
pub(super) mod network;
mod nodal;
mod nodes;
pub(super) mod panel;
mod placed;
mod reduction;
pub(super) mod solid;

use quasirigid_elements::Part;

use super::key::{COUNTED, Key, Keys, Shape, any, key, quantity, table};
use super::names::NODE;
use super::rheology::Extremes;
use super::table::Table;
use crate::units::Dimension;
pub use deck::deck_notes;
use masses::{MASSES, masses};
pub(super) use modes::NUMBERS as NUMBERS_IN_FILE;
pub(super) use nodal::FILE as MATRIX_IN_FILE;
pub(super) use nodes::Nodes;
pub(super) use reduction::{REDUCTION, reduction};

/// A part, the names of its nodes, and the ranges of its rheologies in the order of its regions, members or layers.
pub(super) struct Read {
    pub(super) part: Part,
    pub(super) nodes: Nodes,
    pub(super) extremes: Vec<Extremes>,
    /// What was left out of files or repaired, in words.
    pub(super) notes: Vec<String>,
}

/// Two directions are one if the sine of the angle between them is below this.
const PARALLEL: f64 = 1e-6;

/// Nodes that are clamped.
const ATTACH: Key = key(
    "attach",
    any(&[Shape::Text, COUNTED, Shape::List(&Shape::Any(NODE))]).or("none"),
    "node, set, or list, clamped on the carrier",
);
/// Damping in proportion.
const RAYLEIGH: Key =
    key("rayleigh", table(&PROPORTIONS).or("0"), "damping in proportion to `mass`, `stiffness`");

const PROPORTIONS: Keys =
    Keys { known: &[key("mass", quantity("1/s").or("0"), ""), key("stiffness", quantity("s").or("0"), "")] };

/// Reads damping in proportion to mass (1/s) and to stiffness (s), none if the table has none.
fn rayleigh(table: &Table<'_>) -> Option<[f64; 2]> {
    let Some(value) = table.get("rayleigh") else { return Some([0.0; 2]) };
    if !value.is_table() {
        return value.mismatch("a table", "write for example { mass = 0.01, stiffness = 1e-4 }");
    }
    let damping = value.table("`rayleigh`", &PROPORTIONS)?;
    let share = |key: &'static str, dimension: Dimension| {
        damping.read_or(key, 0.0, |value| value.non_negative(dimension))
    };
    let (mass, stiffness) = (share("mass", Dimension::RATE), share("stiffness", Dimension::TIME));
    Some([mass?, stiffness?])
}

/// Reads the nodes that are clamped on the carrier, none if the table has none.
fn attached(table: &Table<'_>, nodes: &Nodes) -> Option<Vec<usize>> {
    table.read_or("attach", Vec::new(), |value| nodes.named(&value))
}
