use quasirigid_elements::{Matrices, NodalMass, Part, PartKind};

use super::super::key::{Keys, key};
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::{RHEOLOGY, Scale, rheology};
use super::super::table::Table;
use super::nodal::{
    DOFS, LENGTH_UNIT, MASS_UNIT, MATRIX, NODES, NamedMatrix, Rows, Units, dof_list, node_table,
};
use super::{ATTACH, MASSES, Nodes, RAYLEIGH, Read, attached, masses, rayleigh};

pub(in crate::model) const READER: Reader = Reader::of_parts(
    "matrices",
    "[[matrices]]",
    "stiffness and mass matrices of another program",
    &MATRICES,
    |entry, draft| draft.part(entry, matrices(entry.table, entry.name, draft.sources)),
);

const MATRICES: Keys = Keys {
    known: &[
        NAME,
        NODES,
        DOFS,
        key("mass", MATRIX, "file"),
        key("stiffness", MATRIX, "file"),
        key("damping", MATRIX.or("none"), "file"),
        LENGTH_UNIT,
        MASS_UNIT,
        RHEOLOGY,
        MASSES,
        ATTACH,
        RAYLEIGH,
    ],
};

/// Reads `[[matrices]]`: mass, stiffness and damping between the nodes of a table.
pub(super) fn matrices(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let folder = sources.folder;
    let (units, nodes, listed) = (Units::new(table), node_table(table, folder), dof_list(table, folder));
    let stiffness = NamedMatrix::required(table, "stiffness", "stiffness = \"bracket.sti\"", folder);
    let mass = NamedMatrix::required(table, "mass", "mass = \"bracket.mas\"", folder);
    let damping = NamedMatrix::optional(table, "damping", folder);
    let rayleigh = rayleigh(table);
    let known = rheology(table, Scale::OF_SPRING);
    let (units, nodes, listed) = (units?, nodes?, listed?);
    let (stiffness, mass, damping) = (stiffness?, mass?, damping?);
    let files: Vec<&NamedMatrix<'_>> = [&stiffness, &mass].into_iter().chain(&damping).collect();
    files.iter().try_for_each(|file| file.square())?;
    let rows = Rows::new(&files, listed.as_deref(), &nodes)?;
    let mass = NodalMass { entries: rows.entries(&mass, &units)?, ..rows.nodal(&units) };
    let given = Matrices {
        stiffness: rows.entries(&stiffness, &units)?,
        damping: damping.as_ref().map_or(Some(Vec::new()), |damping| rows.entries(damping, &units))?,
        rheology: known.as_ref()?.rheology.clone(),
        mass,
    };
    let labels = Nodes::of_labels(&given.mass.node_labels);
    let (masses, attached) = (masses(table, &labels), attached(table, &labels));
    let part = Part {
        name: name.to_owned(),
        kind: PartKind::Matrices(given),
        masses: masses?,
        attached: attached?,
        rayleigh: rayleigh?,
    };
    Some(Read { part, nodes: labels, extremes: vec![known?.extremes], notes: Vec::new() })
}
