//! Mode reader: `[[modes]]`, shapes over nodes from another program, with the mass at the nodes and a spectrum or matrices.
//! A shape of the interface has the unit of length of the files and any other has none, so each coordinate has its own scale to SI.
//! Equation (K10), docs/theory/12-structures.md.

use std::path::Path;

use quasirigid_elements::{GivenModes, NodalMass, Part, PartKind, Spectrum};

use super::super::key::{Keys, Shape, TEXT, any, key, list};
use super::super::names::NODE;
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::{RHEOLOGY, Scale, rheology};
use super::super::surface::unit_of;
use super::super::table::Table;
use super::super::value::Value;
use super::nodal::{
    DOFS, LENGTH_UNIT, MASS_UNIT, MATRIX, NODES, NamedMatrix, Rows, Units, dof_list, node_table,
};
use super::{ATTACH, MASSES, Nodes, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::matrix::{FREQUENCIES, MatrixFile, SHAPES};
use crate::nastran::sheet;
use crate::units::Dimension;

pub(in crate::model) const READER: Reader =
    Reader::of_parts("modes", "[[modes]]", "shapes of another program", &MODES, |entry, draft| {
        draft.part(entry, modes(entry.table, entry.name, draft.sources))
    });

const MODES: Keys = Keys {
    known: &[
        NAME,
        NODES,
        DOFS,
        key("mass", MATRIX, "file; matrix, or one number per node"),
        MASSES,
        key("shapes", MATRIX, "file; columns"),
        key(
            "interface",
            list(&Shape::Any(NODE)).or("none"),
            "nodes whose displacements are the first shapes",
        ),
        key(
            "frequencies",
            any(&[Shape::List(&Shape::Number), Shape::Shared("numbers")]).in_unit("rad/s"),
            "",
        ),
        key(
            "damping_ratios",
            any(&[Shape::Number, Shape::List(&Shape::Number), Shape::Shared("numbers")]).or("0"),
            "",
        ),
        key("stiffness", MATRIX, "file; between shapes, instead of `frequencies`"),
        key("damping", MATRIX.or("none"), "file; beside `stiffness`"),
        LENGTH_UNIT,
        MASS_UNIT,
        RHEOLOGY,
        ATTACH,
        RAYLEIGH,
    ],
};

pub(in crate::model) const NUMBERS: Keys = Keys {
    known: &[
        key("file", TEXT, ""),
        key("name", TEXT, "of the matrix in the file"),
        key("unit", any(&[Shape::Text, Shape::Number]).or("SI"), ""),
    ],
};

/// Reads `[[modes]]`: shapes over the nodes of a table, the mass at the nodes, and the frequencies or matrices of the shapes.
pub(super) fn modes(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let folder = sources.folder;
    let (units, nodes, listed) = (Units::new(table), node_table(table, folder), dof_list(table, folder));
    let shapes = table.read("shapes", "shapes = \"wing-shapes.npy\"", |value| {
        NamedMatrix::with(value, Some(SHAPES), folder, sheet::effective)
    });
    let given_mass = NamedMatrix::required(table, "mass", "mass = \"wing-mass.mtx\"", folder);
    let stiffness = NamedMatrix::optional(table, "stiffness", folder);
    let damping = NamedMatrix::optional(table, "damping", folder);
    let rayleigh = rayleigh(table);
    let known = rheology(table, Scale::OF_SPRING);
    let (units, nodes, listed, (shapes, effective)) = (units?, nodes?, listed?, shapes?);
    let (given_mass, stiffness, damping) = (given_mass?, stiffness?, damping?);
    let lumped = given_mass.matrix.rows.min(given_mass.matrix.columns) == 1;
    one_of(table, ["frequencies", "stiffness"], "frequencies = [\"0.4 Hz\", \"1.1 Hz\"]")?;
    if !lumped {
        given_mass.square()?;
    }
    let matrix = Some(&given_mass).filter(|_| !lumped);
    let files: Vec<&NamedMatrix<'_>> = [&shapes].into_iter().chain(matrix).collect();
    let rows = Rows::new(&files, listed.as_deref(), &nodes)?;
    let empty = rows.nodal(&units);
    let labels = Nodes::of_labels(&empty.node_labels);
    let interface = interface(table, &labels)?;
    let entries = match matrix {
        Some(matrix) => rows.entries(matrix, &units)?,
        None => lumps(&given_mass, &empty, &units)?,
    };
    let mass = NodalMass { entries, ..empty };
    let coordinates = Coordinates::new(&mass, &interface, shapes.matrix.columns, &units);
    let spectrum = match stiffness {
        Some(stiffness) => Spectrum::Matrices {
            stiffness: coordinates.entries(&stiffness)?,
            damping: damping.map_or(Some(Vec::new()), |damping| coordinates.entries(&damping))?,
        },
        None => spectrum(table, coordinates.scales.len(), folder)?,
    };
    let shapes = coordinates.shapes(&shapes, &rows, mass.dofs.len())?;
    let checked = effective
        .filter(|_| interface.is_empty())
        .and_then(|listed| effective_masses(&listed, &mass, &shapes, units.mass));
    let given = GivenModes { mass, shapes, interface, spectrum, rheology: known.as_ref()?.rheology.clone() };
    let (masses, attached) = (masses(table, &labels), attached(table, &labels));
    let part = Part {
        name: name.to_owned(),
        kind: PartKind::Modes(given),
        masses: masses?,
        attached: attached?,
        rayleigh: rayleigh?,
    };
    Some(Read { part, nodes: labels, extremes: vec![known?.extremes], notes: checked.into_iter().collect() })
}

/// Compares the effective masses that NASTRAN lists beside the shapes with those of these shapes and masses, in words; none of other modes.
fn effective_masses(listed: &[[f64; 6]], mass: &NodalMass, shapes: &[Vec<f64>], unit: f64) -> Option<String> {
    let count = shapes.first().map_or(0, Vec::len);
    if listed.len() != count || count == 0 {
        return None;
    }
    let axis_of = |row: usize| Some(mass.dofs[row].1).filter(|component| *component < 3);
    let (mut sums, mut whole, mut modal) = (vec![[0.0; 3]; count], [0.0; 3], vec![0.0; count]);
    for (row, column, value) in &mass.entries {
        for mode in 0..count {
            modal[mode] += shapes[*row][mode] * value * shapes[*column][mode];
            if let Some(axis) = axis_of(*column) {
                sums[mode][axis] += shapes[*row][mode] * value;
            }
        }
        if let (Some(a), Some(b)) = (axis_of(*row), axis_of(*column)) {
            whole[a] += if a == b { *value } else { 0.0 };
        }
    }
    let total = whole.iter().fold(0.0, |most: f64, mass| most.max(*mass));
    let apart = |mode: usize, axis: usize| {
        (sums[mode][axis].powi(2) / modal[mode] - unit * listed[mode][axis]).abs() / total
    };
    let most = (0..3 * count).map(|at| apart(at / 3, at % 3)).fold(0.0, f64::max);
    Some(if most < AGREE {
        format!("effective masses are those of MEFFMASS within {:.2} % of the mass", 100.0 * most)
    } else {
        format!(
            "effective masses differ from those of MEFFMASS by up to {:.1} % of the mass: are `mass`, `mass_unit` and `nodes` those of the shapes?",
            100.0 * most
        )
    })
}

/// Share of the mass within which effective masses agree.
const AGREE: f64 = 0.01;

/// Accepts a table that has one of two keys.
fn one_of(table: &Table<'_>, keys: [&'static str; 2], example: &str) -> Option<()> {
    match keys.map(|key| table.get(key)) {
        [None, None] => table.required(keys[0], example).map(drop),
        [Some(_), Some(second)] => {
            let message = format!("`{}` and `{}` are the same quantity", keys[0], keys[1]);
            second.refuse(message, "one too many", "leave one of them out")
        }
        _ => Some(()),
    }
}

/// Reads the nodes of the interface, in their order.
fn interface(table: &Table<'_>, labels: &Nodes) -> Option<Vec<usize>> {
    let Some(value) = table.get("interface") else { return Some(Vec::new()) };
    value.list("a list of nodes", |node| labels.single(&node))
}

/// Reads a lumped mass for each node, and gives it to the displacements of the node that have a row.
fn lumps(given: &NamedMatrix<'_>, nodal: &NodalMass, units: &Units) -> Option<Vec<(usize, usize, f64)>> {
    let masses = column(given, nodal.nodes.len(), "node")?;
    let of_row = |(row, (node, component)): (usize, &(usize, usize))| {
        (*component < 3).then_some((row, row, units.mass * masses[*node]))
    };
    Some(nodal.dofs.iter().enumerate().filter_map(of_row).collect())
}

/// Reads the numbers of a file with one number for each node or mode.
fn column(given: &NamedMatrix<'_>, count: usize, of: &str) -> Option<Vec<f64>> {
    let MatrixFile { rows, columns, .. } = given.matrix;
    if (rows, columns) != (count, 1) && (rows, columns) != (1, count) {
        let key = given.value.key();
        let message = format!("`{key}` has {rows} rows and {columns} columns, and there are {count} {of}s");
        return given.value.refuse(message, "of another size", format!("give one number for each {of}"));
    }
    let mut numbers = vec![0.0; count];
    given.matrix.entries.iter().for_each(|(row, column, entry)| numbers[*row.max(column)] = *entry);
    Some(numbers)
}

/// Reads the frequencies and damping ratios of modes.
fn spectrum(table: &Table<'_>, modes: usize, folder: &Path) -> Option<Spectrum> {
    if let Some(value) = table.get("damping") {
        let help = "write damping_ratios = 0.01, or `stiffness` in place of `frequencies`";
        return value.refuse("`damping` is a matrix beside `stiffness`", "beside frequencies", help);
    }
    let value = table.required("frequencies", "frequencies = [\"0.4 Hz\", \"1.1 Hz\"]")?;
    let frequencies = numbers(&value, Dimension::FREQUENCY, modes, folder);
    let damping_ratios = match table.get("damping_ratios") {
        Some(value) if value.is_number() => {
            value.non_negative(Dimension::NUMBER).map(|ratio| vec![ratio; modes])
        }
        Some(value) => numbers(&value, Dimension::NUMBER, modes, folder),
        None => Some(vec![0.0; modes]),
    };
    Some(Spectrum::Modes { frequencies: frequencies?, damping_ratios: damping_ratios? })
}

/// Reads one quantity for each mode: a list of them, or `{ file, name, unit }`.
fn numbers(value: &Value<'_>, dimension: Dimension, modes: usize, folder: &Path) -> Option<Vec<f64>> {
    if !value.is_table() {
        return value.list("a list with a number for each mode", |item| item.quantity(dimension));
    }
    let table = value.table("the numbers", &NUMBERS)?;
    let unit = table.get("unit").map_or(Some(1.0), |unit| unit_of(&unit, dimension))?;
    let given = NamedMatrix::in_table(*value, &table, Some(FREQUENCIES), folder)?;
    Some(column(&given, modes, "mode")?.into_iter().map(|number| unit * number).collect())
}

/// Generalised coordinates, and their scales from the units of the files.
struct Coordinates<'u> {
    units: &'u Units,
    /// SI units in one unit of each: metres for displacements of the interface, one for the others.
    scales: Vec<f64>,
}

impl<'u> Coordinates<'u> {
    fn new(mass: &NodalMass, interface: &[usize], count: usize, units: &'u Units) -> Self {
        let of_interface = mass.rows_of(interface).into_iter();
        let scale = |(_, component): (usize, usize)| if component < 3 { units.length } else { 1.0 };
        let scales = of_interface.map(scale).chain(std::iter::repeat(1.0)).take(count).collect();
        Self { units, scales }
    }

    /// Entries of a square matrix between the coordinates, in SI units.
    fn entries(&self, given: &NamedMatrix<'_>) -> Option<Vec<(usize, usize, f64)>> {
        given.square()?;
        let (size, count) = (given.matrix.rows, self.scales.len());
        if size != count {
            let key = given.value.key();
            let message = format!("`{key}` has {size} rows, and there are {count} shapes");
            let help = "it is between the shapes: a row and a column for each, in their order";
            return given.value.refuse(message, "of another size", help);
        }
        let energy = self.units.mass * self.units.length.powi(2);
        let entry = |(row, column, entry): &(usize, usize, f64)| {
            (*row, *column, energy * entry / (self.scales[*row] * self.scales[*column]))
        };
        Some(given.matrix.entries.iter().map(entry).collect())
    }

    /// The shapes in SI units, a row for each of so many degrees of freedom.
    fn shapes(&self, given: &NamedMatrix<'_>, rows: &Rows<'_>, dofs: usize) -> Option<Vec<Vec<f64>>> {
        let given_rows = rows.rows_of(given)?;
        let mut shapes = vec![vec![0.0; self.scales.len()]; dofs];
        for (row, column, share) in &given.matrix.entries {
            for (row, along) in given_rows[*row] {
                let unit = self.units.length.powi(1 - rows.turns(*row)) / self.scales[*column];
                shapes[*row][*column] += unit * along * share;
            }
        }
        Some(shapes)
    }
}
