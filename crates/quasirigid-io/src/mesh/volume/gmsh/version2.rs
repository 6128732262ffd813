//! Sections of version 2.2: nodes and elements one by one, each element with its group.

use super::groups::Groups;
use super::source::{Source, Width};
use super::{Draft, Fault, MeshProblem, Part, Row, add_cell, kinds, nodes_of, point};
use crate::mesh::file::Encoding;

fn read_count(source: &mut Source, part: Part) -> Result<u64, Fault> {
    source.announce(part.clone(), 1);
    source.start_text(Row::GmshCount)?;
    let count = source.parsed()?;
    source.finish_text()?;
    source.announce(part, count);
    Ok(count)
}

/// `$Nodes`
pub(super) fn read_nodes(source: &mut Source, draft: &mut Draft) -> Result<(), Fault> {
    for _ in 0..read_count(source, Part::Nodes)? {
        source.start(Row::GmshNode)?;
        let label = source.label(Width::Int)?;
        let place = source.point()?;
        source.finish()?;
        draft.add_node(label, place).map_err(|problem| (source.place(), problem))?;
        source.count();
    }
    source.close("Nodes")
}

/// `$Elements`
pub(super) fn read_cells(source: &mut Source, draft: &mut Draft, groups: &Groups) -> Result<(), Fault> {
    let mut left = read_count(source, Part::Cells)?;
    let announced = left;
    let mut last = None;
    while left > 0 {
        source.start(Row::GmshCell)?;
        let element = Element::start(source)?;
        if element.follow > left {
            return Err((source.place(), MeshProblem::Surplus { part: Part::Cells, announced }));
        }
        left -= element.follow;
        for _ in 0..element.follow {
            element.read(source, draft, groups, &mut last)?;
        }
    }
    source.close("Elements")
}

/// Properties that elements of a kind share; in a text, each element has its own.
struct Element {
    /// Number of the element, which a binary file gives later.
    label: Option<u64>,
    code: u64,
    tags: u64,
    nodes: usize,
    follow: u64,
}

/// The cell read last: an element in two groups is written twice.
struct Last {
    entity: i64,
    cell: usize,
    code: u64,
    nodes: Vec<u64>,
}

impl Element {
    fn start(source: &mut Source) -> Result<Self, Fault> {
        let text = source.encoding == Encoding::Text;
        let label = if text { Some(source.label(Width::Int)?) } else { None };
        let code = source.label(Width::Int)?;
        let nodes = nodes_of(code).map_err(|problem| (source.place(), problem))?;
        let follow = if text { 1 } else { source.label(Width::Int)? };
        let tags = source.label(Width::Int)?;
        Ok(Self { label, code, tags, nodes, follow })
    }

    fn read(
        &self,
        source: &mut Source,
        draft: &mut Draft,
        groups: &Groups,
        last: &mut Option<Last>,
    ) -> Result<(), Fault> {
        let label = self.label.map_or_else(|| source.label(Width::Int), Ok)?;
        let (mut group, mut entity) = (0, 0);
        for tag in 0..self.tags {
            let value = source.int()?;
            match tag {
                0 => group = value,
                1 => entity = value,
                _ => {} // partitions
            }
        }
        let mut nodes = [0; 27];
        let nodes = &mut nodes[..self.nodes];
        for node in nodes.iter_mut() {
            *node = source.label(Width::Int)?;
        }
        source.finish()?;
        self.add(draft, groups, last, (label, group, entity), nodes)
            .map_err(|problem| (source.place(), problem))?;
        source.count();
        Ok(())
    }

    fn add(
        &self,
        draft: &mut Draft,
        groups: &Groups,
        last: &mut Option<Last>,
        (label, group, entity): (u64, i64, i64),
        nodes: &[u64],
    ) -> Result<(), MeshProblem> {
        let dimension = match self.code {
            kinds::POINT => 0,
            code if kinds::pyramid(code).is_some() => 3,
            code => kinds::kind(code)?.shape.dimension() as i64,
        };
        let set = (group != 0).then(|| groups.set(draft, dimension, group));
        if self.code == kinds::POINT {
            let node = point(draft, label, nodes[0])?;
            return set.map_or(Ok(()), |set| draft.sets.add_nodes(set, &[node]));
        }
        let repeated = last
            .as_ref()
            .filter(|last| (last.entity, last.code) == (entity, self.code) && last.nodes.as_slice() == nodes);
        let cell = match repeated {
            Some(last) => last.cell,
            None => add_cell(draft, label, self.code, nodes)?.expect("points are treated above"),
        };
        *last = Some(Last { entity, cell, code: self.code, nodes: nodes.to_vec() });
        set.map_or(Ok(()), |set| draft.sets.add_cells(set, &[cell]))
    }
}
