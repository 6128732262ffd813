use super::{Node, NodeTable};
use crate::deck::Point;
use crate::matrix::error::{Fault, MatrixProblem, Place};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{bulk_lines, cards_of};
use crate::nastran::grid::Grids;
use crate::nastran::{op2, systems};
use crate::text_file::text;

/// `GRID` cards, in whatever coordinate systems the file has.
pub(in crate::matrix) fn read(bytes: &[u8]) -> Result<NodeTable, Fault> {
    if op2::Layout::of(bytes).is_some() {
        let bulk = op2::bulk(bytes).map_err(|(byte, problem)| (Place::Byte(byte), problem))?;
        let place = |line: usize| line.checked_sub(1).and_then(|line| bulk.places.get(line)).copied();
        let points = points(&bulk.text);
        return table(points.map_err(|(line, problem)| (Place::Byte(place(line).unwrap_or(0)), problem))?);
    }
    let points = points(text::<MatrixProblem>(bytes)?);
    table(points.map_err(|(line, problem)| (Place::Line(line), problem))?)
}

fn table(points: Vec<Point>) -> Result<NodeTable, Fault> {
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
