//! MED meshes of Salome and Code_Aster: cells by type, families and the groups that they belong to.
//! Arrays have all first coordinates or first nodes, then all second ones. The lower face of a solid turns the other way than ours.
//! MED 4.1 documentation, *Numérotation de référence des éléments*, *Le format de fichier*.

use std::collections::{BTreeMap, HashMap};

use quasirigid_mesh::{Mesh, Shape};

use super::arrays::{Arrays, Hdf5, check_length, label, missing, node};
use super::draft::Draft;
use super::kinds::Kind;
use crate::mesh::error::{Fault, Place};

/// Group of the meshes, and of their families.
const MESHES: &str = "ENS_MAA";
const FAMILIES: &str = "FAS";

const TET10: &[u8] = &[0, 2, 1, 3, 6, 5, 4, 7, 9, 8];
const PYRAMID13: &[u8] = &[0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10];
const WEDGE15: &[u8] = &[0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13];
const HEX20: &[u8] = &[0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17];
/// The middles of faces are those of the lower one, the four sides in turn, and the upper one.
const HEX27: &[u8] =
    &[0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26];

/// Whether a container has MED meshes.
pub(super) fn is_mesh(file: &Hdf5) -> bool {
    !file.groups(MESHES).is_empty()
}

/// The nodes, the cells, and a set for each group; and what is left out.
pub(super) fn read(file: &Hdf5) -> Result<(Mesh, Vec<String>), Fault> {
    let meshes = file.groups(MESHES);
    let Some(name) = meshes.first() else { return Err(missing(MESHES)) };
    let mut notes = Vec::new();
    if meshes.len() > 1 {
        notes.push(format!("of {} meshes the first is read, {name:?}", meshes.len()));
    }
    let mesh = format!("{MESHES}/{name}");
    let dimension = file.number(&mesh, "ESP").and_then(|axes| usize::try_from(axes).ok()).unwrap_or(3);
    let step = match file.groups(&mesh) {
        groups if groups.iter().any(|group| group == "NOE") => mesh,
        groups => format!("{mesh}/{}", groups.first().ok_or_else(|| missing("NOE"))?),
    };
    let groups = Groups::read(file, name)?;
    let mut draft = Draft::default();
    let labels = nodes(file, &step, dimension, &groups, &mut draft)?;
    notes.extend(cells(file, &step, &labels, &groups, &mut draft)?);
    Ok((draft.mesh(), notes))
}

/// Names of the groups of each family.
struct Groups {
    of_family: HashMap<i64, Vec<String>>,
}

impl Groups {
    fn read(file: &Hdf5, mesh: &str) -> Result<Self, Fault> {
        let mut of_family = HashMap::new();
        for kind in ["NOEUD", "ELEME"] {
            let path = format!("{FAMILIES}/{mesh}/{kind}");
            for family in file.groups(&path) {
                let path = format!("{path}/{family}");
                let Some(number) = file.number(&path, "NUM") else { continue };
                of_family.insert(number, file.texts(&format!("{path}/GRO/NOM"))?.unwrap_or_default());
            }
        }
        Ok(Self { of_family })
    }

    /// Adds members, with the family of each, to the sets of their groups.
    fn add(
        &self,
        families: &[i64],
        members: &[usize],
        draft: &mut Draft,
        of_nodes: bool,
    ) -> Result<(), Fault> {
        let mut found: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (family, member) in families.iter().zip(members) {
            for name in self.of_family.get(family).into_iter().flatten() {
                found.entry(name).or_default().push(*member);
            }
        }
        for (name, members) in found {
            let place = draft.sets.place(name, name);
            let added = if of_nodes {
                draft.sets.add_nodes(place, &members)
            } else {
                draft.sets.add_cells(place, &members)
            };
            added.map_err(|problem| (Place::File, problem))?;
        }
        Ok(())
    }
}

/// Adds the nodes, and returns their numbers.
fn nodes(
    file: &Hdf5,
    step: &str,
    dimension: usize,
    groups: &Groups,
    draft: &mut Draft,
) -> Result<Vec<u64>, Fault> {
    let name = format!("{step}/NOE/COO");
    let coordinates = file.reals(&name)?.ok_or_else(|| missing(&name))?;
    let count = coordinates.len() / dimension.clamp(1, 3);
    check_length(&name, coordinates.len(), count * dimension)?;
    let labels = labels(file, &format!("{step}/NOE/NUM"), count)?;
    let mut members = Vec::with_capacity(count);
    for (node, label) in labels.iter().enumerate() {
        let along = |axis: usize| if axis < dimension { coordinates[axis * count + node] } else { 0.0 };
        let index = draft.add_node(*label, [0, 1, 2].map(along)).map_err(|problem| (Place::File, problem))?;
        members.push(index);
    }
    if let Some(families) = file.integers(&format!("{step}/NOE/FAM"))? {
        groups.add(&families, &members, draft, true)?;
    }
    Ok(labels)
}

/// Numbers of nodes, from 1 where the file has none.
fn labels(file: &Hdf5, name: &str, count: usize) -> Result<Vec<u64>, Fault> {
    let Some(numbers) = file.integers(name)? else {
        return Ok((1..=count as u64).collect());
    };
    check_length(name, numbers.len(), count)?;
    numbers.into_iter().map(label).collect()
}

/// Adds the cells of each type, with numbers of their own, since those of a file may repeat from type to type.
fn cells(
    file: &Hdf5,
    step: &str,
    nodes: &[u64],
    groups: &Groups,
    draft: &mut Draft,
) -> Result<Vec<String>, Fault> {
    let (mut left_out, mut last) = (Vec::new(), 0u64);
    for name in file.groups(&format!("{step}/MAI")) {
        let path = format!("{step}/MAI/{name}");
        let Some(places) = file.integers(&format!("{path}/NOD"))? else {
            left_out.push(name);
            continue;
        };
        let Some(kind) = kind(&name) else {
            if name != "PO1" {
                left_out.push(name);
            }
            continue;
        };
        let count = places.len() / kind.nodes;
        check_length(&path, places.len(), count * kind.nodes)?;
        let (first, mut members) = (last, Vec::with_capacity(count));
        last += count as u64;
        for cell in 0..count {
            let corner = |corner: usize| node(nodes, places[corner * count + cell]);
            let corners = (0..kind.nodes).map(corner).collect::<Result<Vec<_>, _>>()?;
            let added = kind.add(draft, first + cell as u64 + 1, &corners);
            members.push(added.map_err(|problem| (Place::File, problem))?);
        }
        if let Some(families) = file.integers(&format!("{path}/FAM"))? {
            groups.add(&families, &members, draft, false)?;
        }
    }
    let mut notes = Vec::new();
    if !left_out.is_empty() {
        notes.push(format!("cells of these types are left out: {}", left_out.join(", ")));
    }
    Ok(notes)
}

/// Kind of cells of a type; none of one that is not read.
fn kind(name: &str) -> Option<Kind> {
    Some(match name {
        "SE2" => Kind::new(Shape::Line2, 2, &[]),
        "SE3" => Kind::new(Shape::Line3, 3, &[]),
        "TR3" => Kind::new(Shape::Triangle3, 3, &[]),
        "TR6" => Kind::new(Shape::Triangle6, 6, &[]),
        "QU4" => Kind::new(Shape::Quad4, 4, &[]),
        "QU8" => Kind::new(Shape::Quad8, 8, &[]),
        "QU9" => Kind::new(Shape::Quad9, 9, &[]),
        "TE4" => Kind::new(Shape::Tet4, 4, &[0, 2, 1, 3]),
        "T10" => Kind::new(Shape::Tet10, 10, TET10),
        "PY5" => Kind::pyramid(5, &[0, 3, 2, 1, 4]),
        "P13" => Kind::pyramid(13, PYRAMID13),
        "PE6" => Kind::new(Shape::Wedge6, 6, &[0, 2, 1, 3, 5, 4]),
        "P15" => Kind::new(Shape::Wedge15, 15, WEDGE15),
        "HE8" => Kind::new(Shape::Hex8, 8, &[0, 3, 2, 1, 4, 7, 6, 5]),
        "H20" => Kind::new(Shape::Hex20, 20, HEX20),
        "H27" => Kind::new(Shape::Hex27, 27, HEX27),
        _ => return None,
    })
}
