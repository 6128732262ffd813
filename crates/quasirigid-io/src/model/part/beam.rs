//! Beam reader: `[[beam]]`, a frame of named nodes and straight lines, all of one section and one material.
//! Each line is divided into elements; memory is asked for before they exist, since a file can demand any number.

use quasirigid_elements::{Frame, FrameNode, Member, Part, PartKind};

use super::super::key::{Keys, Shape, TEXT, VECTOR, integer, key, list, named};
use super::super::reader::{NAME, Reader, Sources};
use super::super::settings::optional;
use super::super::table::Table;
use super::super::value::Value;
use super::{ATTACH, MASSES, Nodes, RAYLEIGH, Read, attached, masses, rayleigh};
use crate::units::Dimension;

pub(in crate::model) const READER: Reader =
    Reader::of_parts("beam", "[[beam]]", "frame of straight beams", &BEAM, |entry, draft| {
        draft.part(entry, beam(entry.table, entry.name, draft.sources))
    });

const BEAM: Keys = Keys {
    known: &[
        NAME,
        key("nodes", named(&Shape::Vector).in_unit("m"), ""),
        key("lines", list(&Shape::Array(2, &Shape::Text)), "pairs of nodes"),
        key("section", TEXT, ""),
        key("material", TEXT, "isotropic"),
        key("up", VECTOR.or("nearest axis across"), "direction of the section's y"),
        key("elements", integer(1, MOST_ELEMENTS as u64).or("8"), "per line"),
        MASSES,
        ATTACH,
        RAYLEIGH,
    ],
};

/// Elements of a line unless the file chooses another number: the relative error of the energy of a bent cantilever is then 4e-6.
const ELEMENTS: usize = 8;
const MOST_ELEMENTS: usize = 10_000;
/// Bytes that an element takes at least: its own, and six rows of some ten matrices.
const ELEMENT: f64 = 8_000.0;

/// Reads a `[[beam]]`.
pub(super) fn beam(table: &Table<'_>, name: &str, sources: Sources<'_, '_>) -> Option<Read> {
    let help = "nodes = { root = [0, 0, 0], tip = [2, 0, 0] }";
    let frame_nodes = table.read("nodes", help, |value| nodes(&value));
    let section = table
        .read("section", "section = \"tube\", with [section.tube]", |value| sources.sections.named(&value));
    let material =
        table.read("material", "material = \"aluminium\"", |value| sources.materials.isotropic(&value));
    let up = optional(table.get("up"), |value| value.vector(Dimension::NUMBER));
    let elements = table.read_or("elements", ELEMENTS, |value| value.integer(1..=MOST_ELEMENTS));
    let damping = rayleigh(table);
    let frame_nodes = frame_nodes?;
    let nodes = Nodes::of_names(frame_nodes.iter().map(|node| node.name.clone()));
    let lines = table.read("lines", "lines = [[\"root\", \"tip\"]]", |value| lines(&value, &nodes));
    let masses = masses(table, &nodes);
    let attached = attached(table, &nodes);
    let (section, (material, extremes)) = (section?, material?);
    let (up, elements) = (up?, elements?);
    let member = |ends: [usize; 2]| Member {
        ends,
        section,
        up,
        name: String::new(),
        material: material.clone(),
        elements,
    };
    let lines = lines?;
    if let Some(value) = table.get("elements") {
        value.room((lines.len() * elements) as f64, ELEMENT)?;
    }
    let members: Vec<Member> = lines.into_iter().map(member).collect();
    let extremes = vec![extremes; members.len()];
    let kind = PartKind::Frame(Frame { nodes: frame_nodes, members });
    let part = Part { name: name.to_owned(), kind, masses: masses?, attached: attached?, rayleigh: damping? };
    Some(Read { part, nodes, extremes, notes: Vec::new() })
}

/// Reads the nodes of a frame, by name, in the order of the file.
fn nodes(value: &Value<'_>) -> Option<Vec<FrameNode>> {
    let places = value.places("a table of nodes", "write { root = [0, 0, 0], tip = [2, 0, 0] }")?;
    Some(places.into_iter().map(|(name, position)| FrameNode { name, position }).collect())
}

fn lines(value: &Value<'_>, nodes: &Nodes) -> Option<Vec<[usize; 2]>> {
    if value.is_empty() {
        let help = "write lines = [[\"root\", \"tip\"]]";
        return value.refuse("a beam has one line or more", "no lines", help);
    }
    value.list("an array of pairs of nodes", |line| ends(&line, nodes))
}

fn ends(value: &Value<'_>, nodes: &Nodes) -> Option<[usize; 2]> {
    let ends: [usize; 2] = value.array("nodes", |end| nodes.single(&end))?;
    if ends[0] == ends[1] {
        let help = "a line joins two different nodes";
        return value.refuse("both ends of the line are the same", "a line of no length", help);
    }
    Some(ends)
}
