//! Matrices and nodes from the files of another program: rows matched to degrees of freedom, numbers taken to SI units.
//! Files name their rows in three ways (labels of their own, a list, or the order of the nodes); all are brought to one numbering.
//! Equation (K9), docs/theory/12-structures.md, uses the entries.

use std::collections::BTreeMap;
use std::path::Path;

use quasirigid_elements::NodalMass;

use super::super::key::{Form, Key, Keys, Shape, TEXT, any, key};
use super::super::surface::unit_of;
use super::super::table::Table;
use super::super::value::Value;
use crate::matrix::{Dof, MatrixFile, MatrixProblem, Node, NodeTable, read_dofs, read_nodes, read_usual};
use crate::units::Dimension;

pub(in crate::model) const FILE: Keys =
    Keys { known: &[key("file", TEXT, ""), key("name", TEXT, "of the matrix in the file")] };

/// A matrix: a file, or a table that names a matrix in a file.
pub(super) const MATRIX: Form = any(&[Shape::Text, Shape::Shared("matrix")]);
pub(super) const NODES: Key = key("nodes", TEXT, "file of their places");
pub(super) const DOFS: Key = key("dofs", TEXT.or("all"), "file of the rows, `node.component`");
pub(super) const LENGTH_UNIT: Key =
    key("length_unit", UNIT_OF_FILES.or("`\"m\"`"), "of the files, with the second");
pub(super) const MASS_UNIT: Key = key("mass_unit", UNIT_OF_FILES.or("`\"kg\"`"), "");
const UNIT_OF_FILES: Form = any(&[Shape::Text, Shape::Number]);

/// Units of the numbers in the files of another program; their unit of time is the second.
pub(super) struct Units {
    pub length: f64,
    pub mass: f64,
}

impl Units {
    pub(super) fn new(table: &Table<'_>) -> Option<Self> {
        let unit = |key: &'static str, dimension: Dimension| {
            table.read_or(key, 1.0, |value| unit_of(&value, dimension))
        };
        let (length, mass) = (unit("length_unit", Dimension::LENGTH), unit("mass_unit", Dimension::MASS));
        Some(Self { length: length?, mass: mass? })
    }
}

/// A matrix of a file, and the value that names it.
pub(super) struct NamedMatrix<'a> {
    pub value: Value<'a>,
    pub matrix: MatrixFile,
}

impl<'a> NamedMatrix<'a> {
    /// Reads the matrix in a file that a value names, looked for beside the model: `"file"` or `{ file, name }`; of several without a name, the
    /// usual one.
    pub(super) fn read(value: Value<'a>, usual: Option<&str>, folder: &Path) -> Option<Self> {
        Self::with(value, usual, folder, |_| ()).map(|(matrix, ())| matrix)
    }

    /// The same with something else from the bytes of the file.
    pub(super) fn with<T>(
        value: Value<'a>,
        usual: Option<&str>,
        folder: &Path,
        beside: impl Fn(&[u8]) -> T,
    ) -> Option<(Self, T)> {
        if !value.is_table() {
            return Self::named(value, value, [None, usual], folder, beside);
        }
        let table = value.table("the matrix", &FILE)?;
        let (file, name) = file_and_name(&table)?;
        Self::named(value, file, [name, usual], folder, beside)
    }

    /// Reads the matrix that the keys `file` and `name` of a table name.
    pub(super) fn in_table(
        value: Value<'a>,
        table: &Table<'a>,
        usual: Option<&str>,
        folder: &Path,
    ) -> Option<Self> {
        let (file, name) = file_and_name(table)?;
        Self::named(value, file, [name, usual], folder, |_| ()).map(|(matrix, ())| matrix)
    }

    fn named<T>(
        value: Value<'a>,
        file: Value<'a>,
        names: [Option<&str>; 2],
        folder: &Path,
        beside: impl Fn(&[u8]) -> T,
    ) -> Option<(Self, T)> {
        let (matrix, found) = opened(&file, folder, |path| read_usual(path, names, &beside))?;
        Some((Self { value, matrix }, found))
    }

    /// Reads a matrix that has to be there.
    pub(super) fn required(
        table: &Table<'a>,
        key: &'static str,
        example: &str,
        folder: &Path,
    ) -> Option<Self> {
        table.read(key, example, |value| Self::read(value, None, folder))
    }

    /// Reads a matrix that may be left out.
    pub(super) fn optional(table: &Table<'a>, key: &'static str, folder: &Path) -> Option<Option<Self>> {
        table.read_or(key, None, |value| Self::read(value, None, folder).map(Some))
    }

    /// Refuses a matrix that is not square.
    pub(super) fn square(&self) -> Option<()> {
        let MatrixFile { rows, columns, .. } = self.matrix;
        if rows == columns {
            return Some(());
        }
        let message = format!("the matrix has {rows} rows and {columns} columns");
        let help = "mass, damping and stiffness are square";
        self.value.refuse(message, "not square", help)
    }
}

/// The keys `file` and `name` of a table.
fn file_and_name<'a>(table: &Table<'a>) -> Option<(Value<'a>, Option<&'a str>)> {
    let name = match table.get("name") {
        Some(name) => Some(name.text()?),
        None => None,
    };
    Some((table.required("file", "file = \"model.op4\"")?, name))
}

/// Reads the table `nodes`.
pub(super) fn node_table(table: &Table<'_>, folder: &Path) -> Option<NodeTable> {
    let value = table.required("nodes", "nodes = \"bracket.inp\"")?;
    opened(&value, folder, read_nodes)
}

/// Reads the list `dofs`, the degrees of freedom of the rows, if there is one.
pub(super) fn dof_list(table: &Table<'_>, folder: &Path) -> Option<Option<Vec<Dof>>> {
    table.read_or("dofs", None, |value| opened(&value, folder, read_dofs).map(Some))
}

/// Reads a file that a value names, looked for beside the model.
fn opened<T, E: std::fmt::Display>(
    value: &Value<'_>,
    folder: &Path,
    read: impl Fn(&Path) -> Result<T, E>,
) -> Option<T> {
    let path = folder.join(value.text()?);
    let help = "it is looked for beside the model; Matrix Market, NumPy, CalculiX, DMIG, OUTPUT2 and OUTPUT4 files are \
                read, and node tables as CSV, GRID cards or *NODE";
    let refuse = |error: E| value.refuse(format!("`{}`: {error}", value.key()), "cannot be used", help);
    read(&path).map_or_else(refuse, Some)
}

/// Rows of the matrices of a part, one for each degree of freedom.
pub(super) struct Rows<'f> {
    nodes: &'f NodeTable,
    /// Degrees of freedom of the rows of matrices without labels of their own.
    listed: Option<&'f [Dof]>,
    /// Number of each degree of freedom among those of all matrices.
    numbers: BTreeMap<Dof, usize>,
    /// Index of the node of each degree of freedom, and its component from 0.
    places: Vec<(usize, usize)>,
    /// Numbers of the degrees of freedom along the axes of the file's frame that make up each of those along the axes of its node,
    /// with their shares.
    along: Vec<Vec<(usize, f64)>>,
}

impl<'f> Rows<'f> {
    /// The rows of all these matrices.
    pub(super) fn new(
        files: &[&NamedMatrix<'_>],
        listed: Option<&'f [Dof]>,
        nodes: &'f NodeTable,
    ) -> Option<Self> {
        let (numbers, places, along) = (BTreeMap::new(), Vec::new(), Vec::new());
        let mut rows = Self { nodes, listed, numbers, places, along };
        let indices: BTreeMap<u64, usize> =
            nodes.nodes().iter().enumerate().map(|(index, node)| (node.label, index)).collect();
        let mut found = BTreeMap::new();
        for file in files {
            for dof in rows.of(file)? {
                let index = indices.get(&dof.node).copied();
                let component = usize::from(dof.component).checked_sub(1).filter(|known| *known < 6);
                let Some(place) = index.zip(component) else {
                    let help = "every row is about a displacement (1 to 3) or rotation (4 to 6) of a node in the table";
                    let message =
                        format!("there is no degree of freedom {dof} of a node in the table `nodes`");
                    return file.value.refuse(message, "a row without a node", help);
                };
                found.insert(dof, place);
            }
        }
        rows.places = found.values().copied().collect();
        rows.numbers = found.into_keys().enumerate().map(|(number, dof)| (dof, number)).collect();
        rows.along = match rows.turned() {
            Ok(along) => along,
            Err(node) => {
                let message = MatrixProblem::PartOfSystem { node }.to_string();
                return files.first()?.value.refuse(
                    message,
                    "rows in a local system",
                    "see CD of its GRID card",
                );
            }
        };
        Some(rows)
    }

    /// Shares of displacements along the axes of the file's frame in those along the axes of each node.
    ///
    /// # Errors
    /// The label of a node of which not all three components are there.
    fn turned(&self) -> Result<Vec<Vec<(usize, f64)>>, u64> {
        let numbers: BTreeMap<(usize, usize), usize> =
            self.places.iter().enumerate().map(|(number, place)| (*place, number)).collect();
        let shares = |(number, (node, component)): (usize, &(usize, usize))| {
            let Node { label, axes, .. } = self.nodes.nodes()[*node];
            let Some(axes) = axes else { return Ok(vec![(number, 1.0)]) };
            let (first, axis) = (component / 3 * 3, component % 3);
            let share =
                |along: usize| numbers.get(&(*node, first + along)).map(|row| (*row, axes[axis][along]));
            (0..3).map(share).collect::<Option<Vec<_>>>().ok_or(label)
        };
        self.places.iter().enumerate().map(shares).collect()
    }

    /// The nodes in SI units, with the degree of freedom of each row and no mass.
    pub(super) fn nodal(&self, units: &Units) -> NodalMass {
        let nodes = self.nodes.nodes();
        NodalMass {
            nodes: nodes.iter().map(|node| node.place.map(|entry| units.length * entry)).collect(),
            node_labels: nodes.iter().map(|node| node.label).collect(),
            dofs: self.places.clone(),
            entries: Vec::new(),
        }
    }

    /// Entries of a square matrix in SI units, by the numbers of their degrees of freedom.
    pub(super) fn entries(&self, given: &NamedMatrix<'_>, units: &Units) -> Option<Vec<(usize, usize, f64)>> {
        let rows = self.rows_of(given)?;
        let mut entries = Vec::with_capacity(given.matrix.entries.len());
        for (row, column, entry) in &given.matrix.entries {
            for (row, left) in rows[*row] {
                for (column, right) in rows[*column] {
                    let unit = units.mass * units.length.powi(self.turns(*row) + self.turns(*column));
                    entries.push((*row, *column, left * right * unit * entry));
                }
            }
        }
        Some(entries)
    }

    /// Degrees of freedom that make up each row of a matrix, by their numbers, with their shares.
    pub(super) fn rows_of(&self, given: &NamedMatrix<'_>) -> Option<Vec<&[(usize, f64)]>> {
        Some(self.of(given)?.iter().map(|dof| self.along[self.numbers[dof]].as_slice()).collect())
    }

    /// 1 for the row of a rotation, 0 for that of a displacement.
    pub(super) fn turns(&self, row: usize) -> i32 {
        i32::from(self.places[row].1 >= 3)
    }

    /// Degrees of freedom of the rows of a matrix: its own labels, a list, or all components of every node.
    fn of(&self, given: &NamedMatrix<'_>) -> Option<Vec<Dof>> {
        let MatrixFile { rows, labels, .. } = &given.matrix;
        if let Some(labels) = labels {
            return Some(labels.clone());
        }
        let nodes = self.nodes.nodes();
        let per_node = if *rows == 6 * nodes.len() { 6 } else { 3 };
        let dofs = match self.listed {
            Some(listed) => listed.to_vec(),
            None => {
                let of_node =
                    |label: u64| (1..=per_node).map(move |component| Dof { node: label, component });
                nodes.iter().flat_map(|node| of_node(node.label)).collect()
            }
        };
        if dofs.len() == *rows {
            return Some(dofs);
        }
        let message = format!("the matrix has {rows} rows, but {} degrees of freedom are known", dofs.len());
        let help = "say what each row is about: dofs = \"bracket.dof\", with lines node.component; without it the rows \
                    are the three or six components of each node in the order of the table";
        given.value.refuse(message, "rows without `dofs`", help)
    }
}
