use std::collections::BTreeMap;
use std::path::Path;

use quasirigid::elements::{Kind, Matrices, Part};

use super::super::rheology::{Scale, rheology};
use super::super::table::{Keys, Table};
use super::super::value::Value;
use super::{Nodes, Read, Sources, attached, rayleigh};
use crate::matrix::{Freedom, MatrixFile, NodeTable, read_freedoms, read_matrix, read_nodes};
use crate::units::Dimension;

pub(super) const MATRICES: Keys = Keys {
    known: &[
        "name",
        "nodes",
        "freedoms",
        "mass",
        "stiffness",
        "damping",
        "length_unit",
        "mass_unit",
        "rheology",
        "attach",
        "rayleigh",
    ],
    later: &[],
};
const FILE: Keys = Keys { known: &["file", "name"], later: &[] };

/// Units of the numbers in the files; the second is that of time.
struct Units {
    length: f64,
    mass: f64,
}

/// Reads `[[matrices]]`: mass, stiffness and damping between the nodes of a table.
pub(super) fn matrices(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let units = units(table);
    let table_of_nodes = table
        .required("nodes", "nodes = \"bracket.inp\"")
        .and_then(|value| opened(&value, sources.folder, read_nodes));
    let listed = match table.get("freedoms") {
        Some(value) => opened(&value, sources.folder, read_freedoms).map(Some),
        None => Some(None),
    };
    let stiffness = table
        .required("stiffness", "stiffness = \"bracket.sti\"")
        .and_then(|value| matrix(&value, sources.folder).map(|matrix| (value, matrix)));
    let mass = table
        .required("mass", "mass = \"bracket.mas\"")
        .and_then(|value| matrix(&value, sources.folder).map(|matrix| (value, matrix)));
    let damping = match table.get("damping") {
        Some(value) => matrix(&value, sources.folder).map(|matrix| Some((value, matrix))),
        None => Some(None),
    };
    let rayleigh = rayleigh(table);
    let known = rheology(table, Scale::OF_SPRING);
    let (units, nodes, listed) = (units?, table_of_nodes?, listed?);
    let labelled = |(value, file)| Labelled::new(value, file, listed.as_deref(), &nodes);
    let (stiffness, mass) = (labelled(stiffness?), labelled(mass?));
    let damping = match damping? {
        Some(damping) => labelled(damping).map(Some),
        None => Some(None),
    };
    let (stiffness, mass, damping) = (stiffness?, mass?, damping?);
    let files: Vec<&Labelled<'_>> = [&stiffness, &mass].into_iter().chain(&damping).collect();
    let rows = Rows::new(&files, &nodes)?;
    let given = Matrices {
        nodes: nodes.nodes().iter().map(|node| node.place.map(|entry| units.length * entry)).collect(),
        node_labels: nodes.nodes().iter().map(|node| node.label).collect(),
        mass: rows.entries(&mass, &units),
        stiffness: rows.entries(&stiffness, &units),
        damping: damping.map_or_else(Vec::new, |damping| rows.entries(&damping, &units)),
        freedoms: rows.places,
        rheology: known.as_ref()?.rheology.clone(),
    };
    let labels = Nodes::of_labels(&given.node_labels);
    let attached = attached(table, &labels)?;
    let part = Part { name: name.to_owned(), kind: Kind::Matrices(given), attached, rayleigh: rayleigh? };
    Some(Read { part, nodes: labels, extremes: vec![known?.extremes] })
}

fn units(table: &Table<'_>) -> Option<Units> {
    let unit = |key: &'static str, dimension: Dimension| match table.get(key) {
        Some(value) => super::super::surface::unit_of(&value, dimension),
        None => Some(1.0),
    };
    let (length, mass) = (unit("length_unit", Dimension::LENGTH), unit("mass_unit", Dimension::MASS));
    Some(Units { length: length?, mass: mass? })
}

/// Reads a file that a value names, looked for beside the model.
fn opened<T, E: std::fmt::Display>(
    value: &Value<'_>,
    folder: &Path,
    read: impl Fn(&Path) -> Result<T, E>,
) -> Option<T> {
    let path = folder.join(value.text()?);
    read(&path).map_err(|error| refuse_file(value, &error.to_string())).ok()
}

fn matrix(value: &Value<'_>, folder: &Path) -> Option<MatrixFile> {
    let (file, name) = if value.is_table() {
        let table = value.table("the matrix", &FILE)?;
        let name = match table.get("name") {
            Some(name) => Some(name.text()?),
            None => None,
        };
        (table.required("file", "file = \"model.op4\"")?, name)
    } else {
        (*value, None)
    };
    opened(&file, folder, |path| read_matrix(path, name))
}

fn refuse_file(value: &Value<'_>, error: &str) {
    let help = "it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG and OUTPUT4 files are read, and \
                node tables as CSV, GRID cards or *NODE";
    value.refuse::<()>(format!("`{}`: {error}", value.key()), "cannot be used", Some(help.to_owned()));
}

/// A matrix with what each of its rows is about.
struct Labelled<'a> {
    value: Value<'a>,
    file: MatrixFile,
    freedoms: Vec<Freedom>,
}

impl<'a> Labelled<'a> {
    fn new(
        value: Value<'a>,
        file: MatrixFile,
        listed: Option<&[Freedom]>,
        nodes: &NodeTable,
    ) -> Option<Self> {
        let freedoms = freedoms_of(&value, &file, listed, nodes)?;
        Some(Self { value, file, freedoms })
    }
}

/// Freedoms of all matrices, and where they stand among the nodes.
struct Rows {
    /// Number of each freedom.
    numbers: BTreeMap<Freedom, usize>,
    /// Index of the node of each freedom, and its component from 0.
    places: Vec<(usize, usize)>,
}

impl Rows {
    fn new(files: &[&Labelled<'_>], nodes: &NodeTable) -> Option<Self> {
        let indices: BTreeMap<u64, usize> =
            nodes.nodes().iter().enumerate().map(|(index, node)| (node.label, index)).collect();
        let mut found = BTreeMap::new();
        for Labelled { value, freedoms, .. } in files {
            for freedom in freedoms {
                let index = indices.get(&freedom.node).copied();
                let component =
                    usize::from(freedom.component).checked_sub(1).filter(|component| *component < 6);
                let Some(place) = index.zip(component) else {
                    let help = "every row is about a displacement (1 to 3) or rotation (4 to 6) of a node in the table";
                    let message = format!("there is no freedom {freedom} of a node in the table `nodes`");
                    return value.refuse(message, "a row without a node", Some(help.to_owned()));
                };
                found.insert(*freedom, place);
            }
        }
        let places = found.values().copied().collect();
        let numbers = found.into_keys().enumerate().map(|(number, freedom)| (freedom, number)).collect();
        Some(Self { numbers, places })
    }

    /// Entries of a matrix in SI units, by the numbers of their freedoms.
    fn entries(
        &self,
        Labelled { file, freedoms, .. }: &Labelled<'_>,
        units: &Units,
    ) -> Vec<(usize, usize, f64)> {
        let number = |row: usize| self.numbers[&freedoms[row]];
        let turns = |number: usize| i32::from(self.places[number].1 >= 3);
        let entry = |(row, column, entry): &(usize, usize, f64)| {
            let (row, column) = (number(*row), number(*column));
            let unit = units.mass * units.length.powi(turns(row) + turns(column));
            (row, column, unit * entry)
        };
        file.entries.iter().map(entry).collect()
    }
}

/// What the rows of a matrix are about: as it says itself, as a list says, or the three displacements of every node.
fn freedoms_of(
    value: &Value<'_>,
    file: &MatrixFile,
    listed: Option<&[Freedom]>,
    nodes: &NodeTable,
) -> Option<Vec<Freedom>> {
    if file.rows != file.columns {
        let message = format!("the matrix has {} rows and {} columns", file.rows, file.columns);
        return value.refuse(
            message,
            "not square",
            Some("mass, damping and stiffness are square".to_owned()),
        );
    }
    if let Some(labels) = &file.labels {
        return Some(labels.clone());
    }
    let count = nodes.nodes().len();
    let per_node = if file.rows == 6 * count { 6 } else { 3 };
    let freedoms = match listed {
        Some(listed) => listed.to_vec(),
        None => {
            let of_node =
                |label: u64| (1..=per_node).map(move |component| Freedom { node: label, component });
            nodes.nodes().iter().flat_map(|node| of_node(node.label)).collect()
        }
    };
    if freedoms.len() == file.rows {
        return Some(freedoms);
    }
    let message = format!("the matrix has {} rows, but {} freedoms are known", file.rows, freedoms.len());
    let help = "say what each row is about: freedoms = \"bracket.dof\", with lines node.component; without it the rows are \
                the three or six components of each node in the order of the table";
    value.refuse(message, "rows without freedoms", Some(help.to_owned()))
}
