//! Exodus II meshes, in classic netCDF or in netCDF-4: blocks of elements, sets of nodes and sets of sides by their names or numbers.
//! L. A. Schoof, V. R. Yarberry: EXODUS II: A finite element data model, SAND92-2137; node orders of chapter 4.

mod sides;

use std::collections::BTreeMap;

use quasirigid_mesh::{Mesh, Shape};

use super::arrays::{Arrays, check_length, label, missing, node};
use super::draft::Draft;
use super::kinds::Kind;
use crate::mesh::error::{Fault, Place};

/// Variable of the numbers of the blocks, which every mesh has.
const BLOCKS: &str = "eb_prop1";

/// Quadratic hexahedra and wedges have the middles of their upright edges before those of the upper face.
const HEX20: &[u8] = &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15];
/// Then come the middle of the cell and those of the lower, the upper and the other faces.
const HEX27: &[u8] =
    &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15, 23, 24, 25, 26, 21, 22, 20];
const WEDGE15: &[u8] = &[0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11];

/// Whether a container has an Exodus mesh.
pub(super) fn is_mesh(arrays: &impl Arrays) -> bool {
    arrays.lengths("connect1").is_some() || arrays.lengths(BLOCKS).is_some()
}

/// The nodes, the cells of all blocks, and a set for each block, each set of nodes and each set of sides; and what is left out.
pub(super) fn read(arrays: &impl Arrays) -> Result<(Mesh, Vec<String>), Fault> {
    let mut draft = Draft::default();
    let labels = nodes(arrays, &mut draft)?;
    let (blocks, mut notes) = cells(arrays, &labels, &mut draft)?;
    node_sets(arrays, &labels, &mut draft)?;
    notes.extend(sides::read(arrays, &labels, &blocks, &mut draft)?);
    Ok((draft.mesh(), notes))
}

/// Adds the nodes, and returns their numbers.
fn nodes(arrays: &impl Arrays, draft: &mut Draft) -> Result<Vec<u64>, Fault> {
    let mut along = Vec::new();
    for name in ["coordx", "coordy", "coordz"] {
        along.extend(arrays.reals(name)?);
    }
    if along.is_empty() {
        let all = arrays.reals("coord")?.ok_or_else(|| missing("coordx"))?;
        let count = arrays.lengths("coord").and_then(|lengths| lengths.get(1).copied()).unwrap_or(0).max(1);
        along.extend(all.chunks_exact(count).take(3).map(<[f64]>::to_vec));
    }
    let count = along.first().map_or(0, Vec::len);
    for (axis, values) in along.iter().enumerate() {
        check_length(["coordx", "coordy", "coordz"][axis], values.len(), count)?;
    }
    let labels = labels(arrays, &["node_num_map"], count)?;
    for (node, label) in labels.iter().enumerate() {
        let place = [0, 1, 2].map(|axis| along.get(axis).map_or(0.0, |values: &Vec<f64>| values[node]));
        draft.add_node(*label, place).map_err(|problem| (Place::File, problem))?;
    }
    Ok(labels)
}

/// Numbers by the first map that is there, from 1 without one.
fn labels(arrays: &impl Arrays, names: &[&str], count: usize) -> Result<Vec<u64>, Fault> {
    for name in names {
        let Some(map) = arrays.integers(name)? else { continue };
        check_length(name, map.len(), count)?;
        // a map that was never filled is all zeros
        if map.iter().any(|label| *label != 0) {
            return map.into_iter().map(label).collect();
        }
    }
    Ok((1..=count as u64).collect())
}

/// Names of blocks or sets: their own, or a prefix with their number.
fn names(arrays: &impl Arrays, kind: &str, prefix: &str) -> Result<Vec<String>, Fault> {
    let numbers = arrays.integers(&format!("{kind}_prop1"))?.unwrap_or_default();
    let names = arrays.texts(&format!("{kind}_names"))?.unwrap_or_default();
    let named = |(index, number): (usize, &i64)| match names.get(index) {
        Some(name) if !name.is_empty() => name.clone(),
        _ => format!("{prefix}{number}"),
    };
    Ok(numbers.iter().enumerate().map(named).collect())
}

/// A block: its name, its kind, and the places of its nodes, from 1.
struct Block {
    name: String,
    kind: Option<Kind>,
    /// Whether its first two sides are its faces, before its edges.
    shell: bool,
    per_cell: usize,
    nodes: Vec<i64>,
}

/// Adds the cells of all blocks, each to the set of its block; returns the blocks and what is left out.
fn cells(arrays: &impl Arrays, nodes: &[u64], draft: &mut Draft) -> Result<(Vec<Block>, Vec<String>), Fault> {
    let (mut blocks, mut left_out) = (Vec::new(), BTreeMap::<String, usize>::new());
    for (index, name) in names(arrays, "eb", "")?.into_iter().enumerate() {
        let connect = format!("connect{}", index + 1);
        let Some(lengths) = arrays.lengths(&connect) else { continue };
        let [count, per_cell] = lengths[..] else { return Err(missing(&connect)) };
        let kind = arrays.attribute(&connect, "elem_type").unwrap_or_default();
        let found = self::kind(&kind, per_cell);
        if found.is_none() && count > 0 {
            *left_out.entry(format!("{kind} of {per_cell} nodes")).or_default() += count;
        }
        let nodes = arrays.integers(&connect)?.ok_or_else(|| missing(&connect))?;
        check_length(&connect, nodes.len(), count.saturating_mul(per_cell))?;
        let shell = kind.to_ascii_uppercase().starts_with("SHELL");
        blocks.push(Block { name, kind: found, shell, per_cell: per_cell.max(1), nodes });
    }
    let count = blocks.iter().map(|block| block.nodes.len() / block.per_cell).sum();
    let labels = labels(arrays, &["elem_num_map", "elem_map"], count)?;
    let mut numbers = labels.iter();
    for block in &blocks {
        let place = draft.sets.place(&block.name, &block.name);
        for (cell, label) in block.nodes.chunks_exact(block.per_cell).zip(numbers.by_ref()) {
            let Some(kind) = block.kind else { continue };
            let corners = cell.iter().map(|place| node(nodes, *place)).collect::<Result<Vec<_>, _>>()?;
            let added = kind.add(draft, *label, &corners);
            added
                .and_then(|cell| draft.sets.add_cells(place, &[cell]))
                .map_err(|problem| (Place::File, problem))?;
        }
    }
    let mut notes = Vec::new();
    if !left_out.is_empty() {
        let counted: Vec<String> = left_out.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
        notes.push(format!("left out: {}", counted.join(", ")));
    }
    Ok((blocks, notes))
}

fn node_sets(arrays: &impl Arrays, labels: &[u64], draft: &mut Draft) -> Result<(), Fault> {
    for (index, name) in names(arrays, "ns", "ns")?.into_iter().enumerate() {
        let list = format!("node_ns{}", index + 1);
        let Some(places) = arrays.integers(&list)? else { continue };
        let mut members = Vec::with_capacity(places.len());
        for place in places {
            members.extend(draft.node(node(labels, place)?));
        }
        let set = draft.sets.place(&name, &name);
        draft.sets.add_nodes(set, &members).map_err(|problem| (Place::File, problem))?;
    }
    Ok(())
}

/// Kind of cells of a type and a number of nodes; none of one that is not read.
fn kind(name: &str, nodes: usize) -> Option<Kind> {
    let name = name.to_ascii_uppercase();
    let begins = |words: &[&str]| words.iter().any(|word| name.starts_with(word));
    let plain = |shape| Some(Kind::new(shape, nodes, &[]));
    match nodes {
        8 if begins(&["HEX"]) => plain(Shape::Hex8),
        20 if begins(&["HEX"]) => Some(Kind::new(Shape::Hex20, nodes, HEX20)),
        27 if begins(&["HEX"]) => Some(Kind::new(Shape::Hex27, nodes, HEX27)),
        4 if begins(&["TET"]) => plain(Shape::Tet4),
        10 if begins(&["TET"]) => plain(Shape::Tet10),
        6 if begins(&["WED", "PEN"]) => plain(Shape::Wedge6),
        15 if begins(&["WED", "PEN"]) => Some(Kind::new(Shape::Wedge15, nodes, WEDGE15)),
        5 | 13 if begins(&["PYR"]) => Some(Kind::pyramid(nodes, &[])),
        3 if begins(&["TRI", "SHELL"]) => plain(Shape::Triangle3),
        6 if begins(&["TRI", "SHELL"]) => plain(Shape::Triangle6),
        4 if begins(&["QUAD", "SHELL"]) => plain(Shape::Quad4),
        8 if begins(&["QUAD", "SHELL"]) => plain(Shape::Quad8),
        9 if begins(&["QUAD", "SHELL"]) => plain(Shape::Quad9),
        2 if begins(&["BAR", "BEAM", "TRUSS", "ROD", "EDGE"]) => plain(Shape::Line2),
        3 if begins(&["BAR", "BEAM", "TRUSS", "ROD", "EDGE"]) => plain(Shape::Line3),
        _ => None,
    }
}
