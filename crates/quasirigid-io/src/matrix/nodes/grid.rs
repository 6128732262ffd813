use super::{Node, NodeTable};
use crate::deck::Point;
use crate::matrix::error::{Fault, MatrixProblem, Place};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{bulk_lines, cards_of};
use crate::nastran::grid::Grids;
use crate::nastran::systems;
use crate::text_file::text;

/// `GRID` cards, in whatever coordinate systems the file has.
pub(in crate::matrix) fn read(bytes: &[u8]) -> Result<NodeTable, Fault> {
    let points = points(text::<MatrixProblem>(bytes)?);
    let points = points.map_err(|(line, problem)| (Place::Line(line), problem))?;
    if points.is_empty() {
        return Err((Place::File, MatrixProblem::NoNodes));
    }
    let node = |Point { label, place, axes, .. }: Point| Node { label, place, axes };
    Ok(NodeTable { nodes: points.into_iter().map(node).collect() })
}

fn points(text: &str) -> Result<Vec<Point>, LocatedProblem> {
    let wanted = |name: &str| {
        let is = |known: &&str| name.eq_ignore_ascii_case(known);
        ["GRID", "GRDSET"].iter().chain(&systems::CARDS).any(is)
    };
    let mut grids = Grids::default();
    for card in cards_of(bulk_lines((1..).zip(text.lines())), wanted) {
        grids.take(&card?)?;
    }
    grids.points()
}
