//! Solid reader: `[[solid]]`, a mesh of cells of one material, or of several by sets.
//! Every solid cell must be in exactly one set: a cell without a material would be a hole, one with two would count twice.

use std::sync::Arc;

use quasirigid_elements::{Grading, Part, PartKind, Region, Solid};
use quasirigid_math::vec3::{cross, dot, norm, scale};
use quasirigid_mesh::Mesh;

use super::super::key::{Keys, Shape, TEXT, array, key, named};
use super::super::reader::{NAME, Reader, Sources};
use super::super::rheology::Extremes;
use super::super::surface::UNIT_OF_CELLS;
use super::super::table::Table;
use super::super::value::Value;
use super::placed::{ATTITUDE, DENSITIES, EXPONENT, FILE, LEAST, POSITION, Placed, THRESHOLD, VOXEL, mesh};
use super::{ATTACH, MASSES, Nodes, PARALLEL, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::units::Dimension;

pub(in crate::model) const READER: Reader = Reader {
    aliases: &[("materials", "material")],
    ..Reader::of_parts("solid", "[[solid]]", "body of finite elements", &SOLID, |entry, draft| {
        draft.part(entry, solid(entry.table, entry.name, draft.sources))
    })
};

const SOLID: Keys = Keys {
    known: &[
        NAME,
        FILE,
        UNIT_OF_CELLS,
        VOXEL,
        THRESHOLD,
        LEAST,
        DENSITIES,
        EXPONENT,
        POSITION,
        ATTITUDE,
        key("material", TEXT, ""),
        key("materials", named(&Shape::Text), "instead, one for each set of cells"),
        key("axes", array(2, &Shape::Vector).or("file's"), "of an orthotropic material"),
        MASSES,
        ATTACH,
        RAYLEIGH,
    ],
};

/// Reads a `[[solid]]` of one material, or of several by sets of its cells.
pub(super) fn solid(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let placed = mesh(table, sources.folder, "file = \"bracket.msh\"", 3);
    let axes =
        table.read_or("axes", [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], |value| axes(&value));
    let damping = rayleigh(table);
    let exponent = exponent(table);
    let Placed { mesh, mut notes, densities, aside } = placed?;
    let nodes = Nodes::of_mesh(&mesh).with_aside(aside);
    let (masses, attached) = (masses(table, &nodes), attached(table, &nodes));
    let regions = match table.get("materials") {
        Some(value) => several(&value, table, &mesh, sources, axes?),
        None => one(table, &mesh, sources, axes?).map(|region| vec![region]),
    };
    let (mut regions, extremes): (Vec<Region>, Vec<Extremes>) = regions?.into_iter().unzip();
    if let Some(densities) = densities {
        notes.extend(grade(table, &mut regions, &densities, exponent?)?);
    }
    let kind = PartKind::Solid(Solid { mesh: Arc::new(mesh), regions });
    let part = Part { name: name.to_owned(), kind, masses: masses?, attached: attached?, rayleigh: damping? };
    Some(Read { part, nodes, extremes, notes })
}

/// Reads the power of the density that moduli follow; there must be densities.
fn exponent(table: &Table<'_>) -> Option<f64> {
    let Some(value) = table.get("stiffness_exponent") else { return Some(0.0) };
    if table.get("densities").is_none() {
        let help = "add `densities`, or leave it out";
        return value.refuse("`stiffness_exponent` is a power of `densities`", "of no densities", help);
    }
    value.between(Dimension::NUMBER, [0.0, MOST_EXPONENT], "between 0 and 10")
}

/// Largest power of the density; bone and foams have 1 to 3.
const MOST_EXPONENT: f64 = 10.0;
/// Least ratio of moduli between two cells that can be told from a gap.
const LEAST_RATIO: f64 = 1e-9;

/// Gives each cell of the regions its density; returns what is to tell of the moduli.
fn grade(
    table: &Table<'_>,
    regions: &mut [Region],
    densities: &[f64],
    exponent: f64,
) -> Option<Option<String>> {
    let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
    for region in regions {
        let own = region.cells.iter().map(|cell| densities[*cell]).collect();
        let grading = Grading { densities: own, exponent };
        for density in &grading.densities {
            let factor = grading.factor(*density, region.material.density());
            (least, greatest) = (least.min(factor), greatest.max(factor));
        }
        region.grading = Some(grading);
    }
    if exponent == 0.0 {
        return Some(None);
    }
    if !(least > LEAST_RATIO * greatest) {
        let value = table.get("stiffness_exponent")?;
        let message =
            format!("the moduli of the voxels are {least:.3e} to {greatest:.3e} times the material's");
        return value.refuse(message, "too far apart", "raise `threshold`, or make the exponent smaller");
    }
    Some(Some(format!("moduli of the voxels are {least:.6} to {greatest:.6} times those of the material")))
}

fn one(
    table: &Table<'_>,
    mesh: &Mesh,
    sources: Sources<'_, '_>,
    axes: [[f64; 3]; 3],
) -> Option<(Region, Extremes)> {
    let help = "material = \"aluminium\", or materials = { SET = \"aluminium\" }";
    let value = table.required("material", help)?;
    let (material, extremes) = sources.materials.named(&value)?;
    let name = value.words().unwrap_or_default().to_owned();
    let cells = solid_cells(mesh).collect();
    Some((Region { cells, name, material, axes, grading: None }, extremes))
}

/// Reads the materials of sets of cells; every solid cell is in one of them.
fn several(
    value: &Value<'_>,
    table: &Table<'_>,
    mesh: &Mesh,
    sources: Sources<'_, '_>,
    axes: [[f64; 3]; 3],
) -> Option<Vec<(Region, Extremes)>> {
    if let Some(both) = table.get("material") {
        let help = "leave out one of `material` and `materials`";
        return both.refuse("the material is given twice", "given twice", help);
    }
    let Some(entries) = value.entries() else {
        return value.mismatch("a table", "write { SET = \"aluminium\" }, for each set of cells in the mesh");
    };
    let mut owners = vec![0_usize; mesh.cells.len()];
    let mut regions = Vec::new();
    for (_, entry) in entries {
        let cells = cells_of(&entry, mesh)?;
        cells.iter().for_each(|cell| owners[*cell] += 1);
        let (material, extremes) = sources.materials.named(&entry)?;
        let name = entry.words().unwrap_or_default().to_owned();
        regions.push((Region { cells, name, material, axes, grading: None }, extremes));
    }
    let wrong: Vec<usize> = solid_cells(mesh).filter(|cell| owners[*cell] != 1).collect();
    let Some(first) = wrong.first() else { return Some(regions) };
    let sets = if owners[*first] == 0 { "none" } else { "more than one" };
    let mut message = format!("cell {} is in {sets} of these sets", mesh.cells[*first].label);
    if wrong.len() > 1 {
        message += &format!(", the first of {} cells that are not in one", wrong.len());
    }
    value.refuse(message, "each cell in one set", "every solid cell needs one material")
}

fn cells_of(entry: &Value<'_>, mesh: &Mesh) -> Option<Vec<usize>> {
    let named = mesh.sets.iter().find(|set| set.name == entry.key());
    let solid = |cell: &usize| mesh.cells[*cell].shape.dimension() == 3;
    match named.map(|set| set.cells.iter().copied().filter(solid).collect::<Vec<_>>()) {
        Some(cells) if !cells.is_empty() => Some(cells),
        _ => {
            let sets = mesh.sets.iter().filter(|set| set.cells.iter().any(solid));
            let names: Vec<&str> = sets.map(|set| set.name.as_str()).collect();
            let help = match names.as_slice() {
                [] => "the mesh has no set of solid cells; give one `material`".to_owned(),
                names => format!("the sets of solid cells are {}", names.join(", ")),
            };
            entry.refuse(
                format!("the mesh has no solid cells in a set {:?}", entry.key()),
                "unknown set",
                help,
            )
        }
    }
}

fn solid_cells(mesh: &Mesh) -> impl Iterator<Item = usize> + '_ {
    mesh.cells.iter().enumerate().filter(|(_, cell)| cell.shape.dimension() == 3).map(|(index, _)| index)
}

/// Reads the directions of axes 1 and 2 of a material; of the second, the part across the first counts.
fn axes(value: &Value<'_>) -> Option<[[f64; 3]; 3]> {
    let [first, second]: [[f64; 3]; 2] = value.array("directions", |item| item.vector(Dimension::NUMBER))?;
    let third = cross(first, second);
    let sine = norm(third) / (norm(first) * norm(second));
    if !(sine > PARALLEL) {
        let help = "write two directions, those of axes 1 and 2 of the material";
        return value.refuse("`axes` are parallel, or one has no length", "no axes", help);
    }
    let unit = |vector: [f64; 3]| scale(dot(vector, vector).sqrt().recip(), vector);
    let (first, third) = (unit(first), unit(third));
    Some([first, cross(third, first), third])
}
