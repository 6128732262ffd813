//! Sets of sides of Exodus: the nodes of the faces of solids, of the faces and edges of shells and of the edges of plane cells.
//! Numbers of sides: EXODUS II, SAND92-2137, chapter 4.

use super::{Block, names, node};
use crate::deck::edges;
use crate::mesh::error::{Fault, Place};
use crate::mesh::volume::arrays::{Arrays, check_length};
use crate::mesh::volume::draft::Draft;

const TET: &[&[usize]] = &[&[0, 1, 3], &[1, 2, 3], &[0, 2, 3], &[0, 1, 2]];
const PYRAMID: &[&[usize]] = &[&[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4], &[0, 1, 2, 3]];
const WEDGE: &[&[usize]] = &[&[0, 1, 3, 4], &[1, 2, 4, 5], &[0, 2, 3, 5], &[0, 1, 2], &[3, 4, 5]];
const HEX: &[&[usize]] =
    &[&[0, 1, 4, 5], &[1, 2, 5, 6], &[2, 3, 6, 7], &[0, 3, 4, 7], &[0, 1, 2, 3], &[4, 5, 6, 7]];
/// Place of the middle of each side of a hexahedron of 27 nodes.
const MIDDLES: [usize; 6] = [22, 21, 23, 20, 24, 25];

/// Adds a set of nodes for each set of sides; returns how many sides are left out, in words.
pub(super) fn read(
    arrays: &impl Arrays,
    labels: &[u64],
    blocks: &[Block],
    draft: &mut Draft,
) -> Result<Option<String>, Fault> {
    let numbers = arrays.integers("ss_prop1")?.unwrap_or_default();
    let mut left_out = 0_usize;
    for (index, name) in names(arrays, "ss", "ss")?.into_iter().enumerate() {
        let [elements, sides] = ["elem_ss", "side_ss"].map(|list| format!("{list}{}", index + 1));
        let (Some(cells), Some(numbers_of_sides)) = (arrays.integers(&elements)?, arrays.integers(&sides)?)
        else {
            continue;
        };
        check_length(&sides, numbers_of_sides.len(), cells.len())?;
        let mut members = Vec::new();
        for (cell, side) in cells.iter().zip(&numbers_of_sides) {
            match nodes(blocks, labels, *cell, *side)? {
                Some(nodes) => members.extend(nodes.iter().filter_map(|label| draft.node(*label))),
                None => left_out += 1,
            }
        }
        members.sort_unstable();
        members.dedup();
        // a block of the same name keeps it
        let taken = draft.sets.of_key(&name).is_some_and(|set| !set.cells.is_empty());
        let name = if taken { format!("ss{}", numbers[index]) } else { name };
        let set = draft.sets.place(&name, &name);
        draft.sets.add_nodes(set, &members).map_err(|problem| (Place::File, problem))?;
    }
    Ok((left_out > 0).then(|| {
        format!("sides of cells that are left out, or that have no such side, are left out ({left_out})")
    }))
}

/// Numbers of the nodes of a side of the cell at a place from 1; none of a cell that is not read or has no such side.
fn nodes(blocks: &[Block], labels: &[u64], cell: i64, side: i64) -> Result<Option<Vec<u64>>, Fault> {
    let indices = usize::try_from(cell).ok().and_then(|cell| cell.checked_sub(1));
    let (Some(mut cell), Some(side)) =
        (indices, usize::try_from(side).ok().and_then(|side| side.checked_sub(1)))
    else {
        return Ok(None);
    };
    for block in blocks {
        let count = block.nodes.len() / block.per_cell;
        if cell >= count {
            cell -= count;
            continue;
        }
        let Some(kind) = block.kind else { return Ok(None) };
        let places = &block.nodes[cell * block.per_cell..(cell + 1) * block.per_cell];
        let nodes = places.iter().map(|place| node(labels, *place)).collect::<Result<Vec<_>, _>>()?;
        let nodes = kind.ordered(&nodes);
        return Ok(match kind.shape {
            Some(shape) if shape.dimension() < 3 => flat(&nodes, shape.corners(), side, block.shell),
            Some(shape) => solid(&nodes, shape.corners(), side),
            None => solid(&nodes, 5, side),
        });
    }
    Ok(None)
}

/// Nodes of an edge of a plane cell, or of a shell, whose first two sides are its faces.
fn flat(nodes: &[u64], corners: usize, side: usize, shell: bool) -> Option<Vec<u64>> {
    let edge = match (shell, side) {
        (true, 0 | 1) => return Some(nodes.to_vec()),
        (true, side) => side - 2,
        (false, side) => side,
    };
    if edge >= corners || corners < 3 {
        return None;
    }
    let middle = nodes.get(corners + edge).copied();
    Some([nodes[edge], nodes[(edge + 1) % corners]].into_iter().chain(middle).collect())
}

/// Nodes of a face of a solid: its corners, and what lies in the middle of its edges and of itself.
fn solid(nodes: &[u64], corners: usize, side: usize) -> Option<Vec<u64>> {
    let sides = match corners {
        4 => TET,
        5 => PYRAMID,
        6 => WEDGE,
        _ => HEX,
    };
    let face = sides.get(side)?;
    let mut found: Vec<u64> = face.iter().map(|corner| nodes[*corner]).collect();
    for (edge, ends) in edges(corners).iter().enumerate() {
        if ends.iter().all(|end| face.contains(end)) {
            found.extend(nodes.get(corners + edge));
        }
    }
    if nodes.len() == 27 {
        found.push(nodes[MIDDLES[side]]);
    }
    Some(found)
}
