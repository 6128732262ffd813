//! What a file of Abaqus has beside its mesh: types, elements that are no cells, the places of its parts, and the cards that are kept.

use std::collections::{BTreeMap, HashMap};

use quasirigid_mesh::Mesh;

use super::super::draft::Pyramid;
use super::super::others::Others;
use super::block::Placing;
use super::keyword::Keyword;
use crate::deck::Places;

/// A file of Abaqus.
pub(crate) struct Inp {
    pub mesh: Mesh,
    /// Types of elements in capitals, and that of each cell.
    pub types: Vec<String>,
    pub type_of: Vec<u16>,
    /// Node towards which a beam has its first axis, by the index of its cell.
    pub towards: Vec<(usize, u64)>,
    /// Pyramids by the indices of their first halves.
    pub pyramids: HashMap<usize, Pyramid>,
    pub others: Others,
    /// Where parts and instances are: their prefixes and shifts of numbers.
    pub placed: Vec<Placed>,
    /// Cards that are kept, in order.
    pub cards: Vec<InpCard>,
    /// Numbers of all cards.
    pub counts: BTreeMap<String, usize>,
    /// Elements that are left out, by type.
    pub left_out: BTreeMap<String, usize>,
    /// What was left out or changed.
    pub notes: Vec<String>,
    pub places: Places,
}

/// A part in its place.
#[derive(Clone)]
pub(crate) struct Placed {
    /// The part, and the instance; none for what is outside of parts.
    pub part: Option<usize>,
    pub instance: Option<usize>,
    /// Before the names of its sets.
    pub prefix: String,
    /// What was added to the numbers of its nodes and elements.
    pub shifts: [u64; 2],
    pub placing: Placing,
}

/// Where a card stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scope {
    /// Outside of parts and instances.
    Whole,
    /// In a part.
    Part(usize),
    /// In an instance.
    Instance(usize),
}

/// A card with its lines.
pub(crate) struct InpCard {
    /// In capitals.
    pub name: String,
    parameters: Vec<(String, String)>,
    pub line: usize,
    pub lines: Vec<(usize, String)>,
    pub scope: Scope,
}

impl InpCard {
    pub(super) fn new(keyword: &Keyword, line: usize, scope: Scope) -> Self {
        let parameters =
            keyword.parameters.iter().map(|(key, value)| (key.clone(), (*value).to_owned())).collect();
        Self { name: keyword.name.clone(), parameters, line, lines: Vec::new(), scope }
    }

    /// The value of a parameter; empty where it has none.
    pub fn parameter(&self, key: &str) -> Option<&str> {
        self.parameters.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
    }
}
