//! Parts of finite elements: beams, panels, solids, matrices and modes, how they are held, and how a file names their nodes.

mod beam;
mod connection;
mod masses;
mod matrices;
mod modes;
mod network;
mod nodal;
mod nodes;
mod panel;
mod placed;
mod reduction;
mod solid;

use std::path::Path;

use quasirigid::elements::Part;

use super::material::Materials;
use super::rheology::Extremes;
use super::section::Sections;
use super::spans::ElementSpans;
use super::table::{Keys, Table};
use super::value::Value;
use crate::units::Dimension;
pub(super) use connection::{CONNECTION, connection};
use masses::masses;
pub(super) use network::{NETWORK, network};
pub(super) use nodes::Nodes;
pub(super) use reduction::reduction;

/// The part tables of a file.
pub(super) struct PartTables<'a> {
    beams: Vec<Table<'a>>,
    panels: Vec<Table<'a>>,
    solids: Vec<Table<'a>>,
    matrices: Vec<Table<'a>>,
    modes: Vec<Table<'a>>,
}

/// A part, how its nodes are named, and the ranges of its rheologies in the order of its regions, members or layers.
pub(super) struct Read {
    pub(super) part: Part,
    pub(super) nodes: Nodes,
    pub(super) extremes: Vec<Extremes>,
}

/// What parts are made from.
#[derive(Clone, Copy)]
pub(super) struct Sources<'s, 'a> {
    pub(super) materials: &'s Materials<'a>,
    pub(super) sections: &'s Sections<'a>,
    /// Where files are looked for.
    pub(super) folder: &'s Path,
}

impl<'a> PartTables<'a> {
    pub(super) fn new(file: &Table<'a>) -> Self {
        Self {
            beams: file.tables("beam", "[[beam]]", &beam::BEAM),
            panels: file.tables("panel", "[[panel]]", &panel::PANEL),
            solids: file.tables("solid", "[[solid]]", &solid::SOLID),
            matrices: file.tables("matrices", "[[matrices]]", &matrices::MATRICES),
            modes: file.tables("modes", "[[modes]]", &modes::MODES),
        }
    }

    /// Tables with the word for their kind and their number within it, in the order of the parts.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&'static str, usize, &Table<'a>)> {
        let Self { beams, panels, solids, matrices, modes } = self;
        let kinds =
            [("beam", beams), ("panel", panels), ("solid", solids), ("matrices", matrices), ("modes", modes)];
        kinds
            .into_iter()
            .flat_map(|(word, tables)| (1..).zip(tables).map(move |(number, table)| (word, number, table)))
    }

    /// Where the parts stand; the material of a solid of several regions is where they are listed.
    pub(super) fn spans(&self, materials: &Materials<'a>) -> Vec<ElementSpans> {
        let of = |table: &Table<'a>| {
            let mut spans = materials.spans(table);
            spans.values.extend(table.get("materials").map(|several| ("material", several.span())));
            spans
        };
        self.iter().map(|(.., table)| of(table)).collect()
    }

    /// Reads every part, also those after a wrong one.
    pub(super) fn read(&self, names: &[String], sources: Sources<'_, 'a>) -> Option<Vec<Read>> {
        let (beams, rest) = names.split_at(self.beams.len());
        let (panels, rest) = rest.split_at(self.panels.len());
        let (solids, rest) = rest.split_at(self.solids.len());
        let (matrices, modes) = rest.split_at(self.matrices.len());
        let beams = self.beams.iter().zip(beams).map(|(table, name)| beam::beam(table, name, sources));
        let panels = self.panels.iter().zip(panels).map(|(table, name)| panel::panel(table, name, sources));
        let solids = self.solids.iter().zip(solids).map(|(table, name)| solid::solid(table, name, sources));
        let matrices = self.matrices.iter().zip(matrices);
        let matrices = matrices.map(|(table, name)| matrices::matrices(table, name, sources));
        let modes = self.modes.iter().zip(modes).map(|(table, name)| modes::modes(table, name, sources));
        let read: Vec<Option<Read>> =
            beams.chain(panels).chain(solids).chain(matrices).chain(modes).collect();
        read.into_iter().collect()
    }
}

/// Two directions are one if the sine of the angle between them is below this.
const PARALLEL: f64 = 1e-6;

const RAYLEIGH: Keys = Keys { known: &["mass", "stiffness"] };

/// Reads damping in proportion to mass (1/s) and to stiffness (s), none if the table has none.
fn rayleigh(table: &Table<'_>) -> Option<[f64; 2]> {
    let Some(value) = table.get("rayleigh") else { return Some([0.0; 2]) };
    if !value.is_table() {
        return value.mismatch("a table", "write for example { mass = 0.01, stiffness = 1e-4 }");
    }
    let damping = value.table("`rayleigh`", &RAYLEIGH)?;
    let share = |key: &'static str, dimension: Dimension| {
        damping.get(key).map_or(Some(0.0), |value: Value<'_>| value.non_negative(dimension))
    };
    let (mass, stiffness) = (share("mass", Dimension::RATE), share("stiffness", Dimension::TIME));
    Some([mass?, stiffness?])
}

/// Reads the nodes that are clamped on the carrier, none if the table has none.
fn attached(table: &Table<'_>, nodes: &Nodes) -> Option<Vec<usize>> {
    table.get("attach").map_or(Some(Vec::new()), |value| nodes.named(&value))
}
