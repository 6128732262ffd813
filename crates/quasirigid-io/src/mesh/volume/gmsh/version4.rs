//! Sections of versions 4.0 and 4.1: nodes and elements in blocks, one for each entity.

use super::groups::Groups;
use super::source::{Source, Width};
use super::{Draft, Fault, MeshProblem, Part, Row, Version, VolumeProblem, add_cell, nodes_of, point};

/// Width of the numbers of nodes and elements.
fn label_width(version: Version) -> Width {
    if version == Version::V41 { Width::Size } else { Width::Int }
}

/// `$Entities`: the groups of each point, curve, surface and volume.
pub(super) fn read_entities(source: &mut Source, groups: &mut Groups, version: Version) -> Result<(), Fault> {
    source.announce(Part::Entities, 1);
    source.start(Row::GmshCount)?;
    let mut counts = [0u64; 4];
    for count in &mut counts {
        *count = source.label(Width::Size)?;
    }
    source.finish()?;
    let announced = counts.iter().fold(0, |sum: u64, count| sum.saturating_add(*count));
    source.announce(Part::Entities, announced);
    let of_entity = groups.of_entity.get_or_insert_default();
    for (dimension, count) in (0..).zip(counts) {
        for _ in 0..count {
            source.start(Row::GmshEntity)?;
            let (tag, groups) = read_entity(source, dimension, version)?;
            source.finish()?;
            of_entity.insert((dimension, tag), groups);
            source.count();
        }
    }
    source.close("Entities")
}

fn read_entity(source: &mut Source, dimension: i64, version: Version) -> Result<(i64, Vec<i64>), Fault> {
    let tag = source.int()?;
    source.point()?; // the place of a point, or the lower corner of a box
    if dimension > 0 || version == Version::V40 {
        source.point()?;
    }
    let groups = (0..source.label(Width::Size)?).map(|_| source.int()).collect::<Result<_, _>>()?;
    if dimension > 0 {
        for _ in 0..source.label(Width::Size)? {
            source.int()?; // an entity of the boundary
        }
    }
    Ok((tag, groups))
}

/// Beginning of a block of nodes or elements.
struct Block {
    dimension: i64,
    tag: i64,
    /// Whether nodes have parameters, or the type of elements.
    kind: u64,
    count: u64,
}

impl Block {
    fn read(source: &mut Source, version: Version) -> Result<Self, Fault> {
        source.start(Row::GmshBlock)?;
        let (first, second) = (source.int()?, source.int()?);
        let (dimension, tag) = if version == Version::V41 { (first, second) } else { (second, first) };
        let kind = source.label(Width::Int)?;
        let count = source.label(Width::Size)?;
        source.finish()?;
        Ok(Self { dimension, tag, kind, count })
    }

    /// Refuses a block with more than the section has left.
    fn taken_from(&self, left: u64, source: &Source, part: Part, announced: u64) -> Result<u64, Fault> {
        left.checked_sub(self.count).ok_or((source.place(), MeshProblem::Surplus { part, announced }))
    }
}

/// Numbers of blocks, and of nodes or elements in them.
fn read_counts(source: &mut Source, part: Part, version: Version) -> Result<(u64, u64), Fault> {
    source.announce(part.clone(), 1);
    source.start(Row::GmshCount)?;
    let (blocks, count) = (source.label(Width::Size)?, source.label(Width::Size)?);
    if version == Version::V41 {
        source.label(Width::Size)?; // least number
        source.label(Width::Size)?; // greatest
    }
    source.finish()?;
    source.announce(part, count);
    Ok((blocks, count))
}

/// Refuses a section whose blocks have less than it announces.
fn complete(source: &Source, part: Part, announced: u64, left: u64) -> Result<(), Fault> {
    let short = VolumeProblem::Short { part, announced, found: announced - left };
    if left == 0 { Ok(()) } else { Err((source.place(), short.into())) }
}

/// `$Nodes`
pub(super) fn read_nodes(source: &mut Source, draft: &mut Draft, version: Version) -> Result<(), Fault> {
    let (blocks, announced) = read_counts(source, Part::Nodes, version)?;
    let mut left = announced;
    let mut labels = Vec::new();
    for _ in 0..blocks {
        let block = Block::read(source, version)?;
        left = block.taken_from(left, source, Part::Nodes, announced)?;
        let parameters = if block.kind == 0 { 0 } else { block.dimension.clamp(0, 3) };
        labels.clear();
        if version == Version::V41 {
            for _ in 0..block.count {
                source.start(Row::GmshNode)?;
                labels.push(source.label(Width::Size)?);
                source.finish()?;
            }
        }
        for node in 0..block.count as usize {
            source.start(Row::GmshNode)?;
            let label = labels.get(node).map_or_else(|| source.label(Width::Int), |label| Ok(*label))?;
            let place = source.point()?;
            for _ in 0..parameters {
                source.real()?;
            }
            source.finish()?;
            draft.add_node(label, place).map_err(|problem| (source.place(), problem))?;
            source.count();
        }
    }
    complete(source, Part::Nodes, announced, left)?;
    source.close("Nodes")
}

/// `$Elements`
pub(super) fn read_cells(
    source: &mut Source,
    draft: &mut Draft,
    groups: &Groups,
    version: Version,
) -> Result<(), Fault> {
    let (blocks, announced) = read_counts(source, Part::Cells, version)?;
    let mut left = announced;
    for _ in 0..blocks {
        let block = Block::read(source, version)?;
        left = block.taken_from(left, source, Part::Cells, announced)?;
        let here = source.place();
        let nodes = nodes_of(block.kind).map_err(|problem| (here.clone(), problem))?;
        let sets =
            groups.sets(draft, block.dimension, block.tag).map_err(|problem| (here, problem.into()))?;
        for _ in 0..block.count {
            source.start(Row::GmshCell)?;
            read_cell(source, draft, &block, nodes, label_width(version), &sets)?;
            source.count();
        }
    }
    complete(source, Part::Cells, announced, left)?;
    source.close("Elements")
}

fn read_cell(
    source: &mut Source,
    draft: &mut Draft,
    block: &Block,
    count: usize,
    width: Width,
    sets: &[usize],
) -> Result<(), Fault> {
    let label = source.label(width)?;
    let mut nodes = [0; 27];
    let nodes = &mut nodes[..count];
    for node in nodes.iter_mut() {
        *node = source.label(width)?;
    }
    source.finish()?;
    let mut add = || -> Result<(), MeshProblem> {
        let cell = add_cell(draft, label, block.kind, nodes)?;
        let node = if cell.is_none() { Some(point(draft, label, nodes[0])?) } else { None };
        for set in sets {
            draft.sets.add_cells(*set, cell.as_slice())?;
            draft.sets.add_nodes(*set, node.as_slice())?;
        }
        Ok(())
    };
    add().map_err(|problem| (source.place(), problem))
}
