//! Surfaces: faces of elements, or nodes alone.

use quasirigid_mesh::Shape;

use super::Reader;
use super::fields::fields;
use super::names::no;
use crate::deck::edges;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::{Placed, Pyramid};

/// A surface.
#[derive(Default)]
pub(super) struct Surface {
    /// Corners of each face, then the middles of its edges, as indices of nodes.
    pub faces: Vec<Face>,
    /// Nodes that are given alone.
    pub nodes: Vec<usize>,
}

/// A face of an element.
pub(super) struct Face {
    pub corners: usize,
    pub nodes: Vec<usize>,
    /// Whether it is a shell itself.
    pub shell: bool,
}

/// Corners of the faces S1, S2, ... of a solid.
fn sides(corners: usize) -> &'static [&'static [usize]] {
    match corners {
        4 => &[&[0, 1, 2], &[0, 3, 1], &[1, 3, 2], &[2, 3, 0]],
        5 => &[&[0, 1, 2, 3], &[0, 4, 1], &[1, 4, 2], &[2, 4, 3], &[3, 4, 0]],
        6 => &[&[0, 1, 2], &[3, 5, 4], &[0, 3, 4, 1], &[1, 4, 5, 2], &[2, 5, 3, 0]],
        _ => &[&[0, 1, 2, 3], &[4, 7, 6, 5], &[0, 4, 5, 1], &[1, 5, 6, 2], &[2, 6, 7, 3], &[3, 7, 4, 0]],
    }
}

impl Surface {
    /// All nodes, once each, ascending.
    pub fn all(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.faces.iter().flat_map(|face| face.nodes.iter().copied()).collect();
        all.extend(&self.nodes);
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl Reader {
    /// A surface by its name, as a card in a place says it.
    pub(super) fn surface(
        &self,
        placed: &Placed,
        name: &str,
        line: usize,
    ) -> Result<Surface, LocatedProblem> {
        let upper = name.trim_matches('"').to_ascii_uppercase();
        let mut surface = Surface::default();
        let mut found = false;
        for at in self.cards(&["SURFACE"]) {
            let card = &self.cards[at];
            let own = card.parameter("NAME").unwrap_or_default().to_ascii_uppercase();
            for there in self.placed(card.scope) {
                let prefixed = format!("{}{own}", there.prefix.to_ascii_uppercase());
                if prefixed != upper && own != upper
                    || there.instance.is_some()
                        && placed.instance.is_some()
                        && there.instance != placed.instance
                {
                    continue;
                }
                found = true;
                let of_nodes = card.parameter("TYPE").is_some_and(|kind| kind.eq_ignore_ascii_case("NODE"));
                for (line, text) in &card.lines {
                    self.fill(&mut surface, &there, &fields(text), of_nodes, *line)?;
                }
            }
        }
        if !found {
            // A set of nodes serves as a surface.
            let nodes = self.nodes(placed, name, line).map_err(|_| no("surface", name, line))?;
            surface.nodes = nodes.iter().filter_map(|node| self.node_of.get(node).copied()).collect();
        }
        Ok(surface)
    }

    fn fill(
        &self,
        surface: &mut Surface,
        placed: &Placed,
        fields: &[&str],
        of_nodes: bool,
        line: usize,
    ) -> Result<(), LocatedProblem> {
        let name = fields.first().copied().unwrap_or_default();
        if of_nodes {
            let nodes = self.nodes(placed, name, line)?;
            surface.nodes.extend(nodes.iter().filter_map(|node| self.node_of.get(node).copied()));
            return Ok(());
        }
        let side = fields.get(1).copied().unwrap_or_default().to_ascii_uppercase();
        for cell in self.elements(placed, name, line)?.cells {
            surface.faces.extend(self.face(cell, &side));
        }
        Ok(())
    }

    /// A face of a pyramid, by its first half.
    fn face_of_pyramid(&self, cell: usize, side: &str) -> Option<Face> {
        let Pyramid { second, least } = self.inp.pyramids.get(&cell)?;
        let [first, second] = [cell, *second].map(|half| &self.inp.mesh.cells[half].nodes);
        let base = [first[0], first[1], first[2], second[2]];
        let all = [0, 1, 2, 3].map(|corner| base[(corner + 4 - least) % 4]);
        let number: usize = side.strip_prefix('S')?.parse().ok()?;
        let corners = sides(5).get(number.checked_sub(1)?)?;
        let nodes = corners.iter().map(|corner| all.get(*corner).copied().unwrap_or(first[3])).collect();
        Some(Face { corners: corners.len(), nodes, shell: false })
    }

    /// A face of a solid, or a shell itself.
    fn face(&self, cell: usize, side: &str) -> Option<Face> {
        if self.inp.types[usize::from(self.inp.type_of[cell])].starts_with("C3D5") {
            return self.face_of_pyramid(cell, side);
        }
        let cell = &self.inp.mesh.cells[cell];
        let count = cell.shape.corners();
        if cell.shape.dimension() == 2 {
            let nodes = cell.nodes.iter().copied().take(2 * count).collect();
            return Some(Face { corners: count, nodes, shell: true });
        }
        let number: usize = side.strip_prefix('S')?.parse().ok()?;
        let corners = sides(count).get(number.checked_sub(1)?)?;
        let mut nodes: Vec<usize> = corners.iter().map(|corner| cell.nodes[*corner]).collect();
        if cell.shape.nodes() > count && cell.shape != Shape::Line3 {
            for (at, from) in corners.iter().enumerate() {
                let to = corners[(at + 1) % corners.len()];
                let middle =
                    edges(count).iter().position(|edge| *edge == [*from, to] || *edge == [to, *from]);
                nodes.extend(middle.and_then(|middle| cell.nodes.get(count + middle)));
            }
        }
        (cell.shape.dimension() == 3).then_some(Face { corners: corners.len(), nodes, shell: false })
    }
}
