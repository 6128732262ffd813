//! Meshes of gmsh: sections `$Name` to `$EndName`, in text or binary.

mod groups;
mod kinds;
mod source;
mod version2;
mod version4;

use quasirigid_mesh::Mesh;

use super::draft::Draft;
use super::problem::VolumeProblem;
use crate::mesh::error::{Fault, MeshProblem, Part, Place, Row};
use crate::mesh::file::Encoding;
use groups::Groups;
use source::Source;

/// Version of a file: their sections differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    V2,
    V40,
    V41,
}

pub(super) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut source = Source::new(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes));
    let (mut draft, mut groups) = (Draft::default(), Groups::default());
    let mut version = None;
    while let Some(line) = source.line() {
        let unexpected =
            || VolumeProblem::Section { found: String::from_utf8_lossy(&line[..line.len().min(80)]).into() };
        let place = source.place();
        let section = line.strip_prefix(b"$").and_then(|name| std::str::from_utf8(name).ok());
        match (section.ok_or_else(|| (place.clone(), unexpected().into()))?, version) {
            ("MeshFormat", None) => version = Some(read_format(&mut source)?),
            ("PhysicalNames", Some(_)) => groups.read_names(&mut source, &mut draft)?,
            ("Nodes", Some(Version::V2)) => version2::read_nodes(&mut source, &mut draft)?,
            ("Elements", Some(Version::V2)) => version2::read_cells(&mut source, &mut draft, &groups)?,
            ("Entities", Some(version)) => version4::read_entities(&mut source, &mut groups, version)?,
            ("Nodes", Some(version)) => version4::read_nodes(&mut source, &mut draft, version)?,
            ("Elements", Some(version)) => version4::read_cells(&mut source, &mut draft, &groups, version)?,
            ("PartitionedEntities", _) => return Err((place, VolumeProblem::Partitioned.into())),
            ("NOD" | "ELM", None) => {
                return Err((place, VolumeProblem::Version { found: "version 1".into() }.into()));
            }
            ("MeshFormat" | "Nodes" | "Elements" | "Entities", _) => {
                return Err((place, unexpected().into()));
            }
            (name, _) if name.starts_with("End") => return Err((place, unexpected().into())),
            (name, _) => source.skip(name)?,
        }
    }
    if version.is_none() {
        return Err((Place::File, VolumeProblem::Section { found: String::new().into() }.into()));
    }
    Ok(draft.mesh())
}

/// `$MeshFormat`: version, and how numbers are written.
fn read_format(source: &mut Source) -> Result<Version, Fault> {
    source.start_text(Row::GmshFormat)?;
    let found = source.remainder()?;
    let refused = || (source.place(), VolumeProblem::Version { found: found.into() }.into());
    let words: Vec<&str> = found.split_whitespace().collect();
    let [version, encoding, "8"] = words.as_slice() else { return Err(refused()) };
    let version = match *version {
        "2" | "2.0" | "2.1" | "2.2" => Version::V2,
        "4" | "4.0" => Version::V40,
        "4.1" => Version::V41,
        _ => return Err(refused()),
    };
    match *encoding {
        "0" => {}
        "1" if version != Version::V40 => {
            source.encoding = Encoding::LittleEndian; // until the number 1 that follows says otherwise
            let one = source.take::<4>()?;
            source.encoding = match i32::from_le_bytes(one) {
                1 => Encoding::LittleEndian,
                _ if i32::from_be_bytes(one) == 1 => Encoding::BigEndian,
                found => return Err((source.place(), VolumeProblem::Label { found: found.into() }.into())),
            };
        }
        _ => return Err(refused()),
    }
    match source.line() {
        Some(b"$EndMeshFormat") => Ok(version),
        _ => Err((source.place(), VolumeProblem::NoSectionEnd { section: "MeshFormat".to_owned() }.into())),
    }
}

/// Adds a cell whose nodes stand in the order of gmsh, and returns its index; none for a point, which is no cell.
fn add_cell(draft: &mut Draft, label: u64, code: u64, nodes: &[u64]) -> Result<Option<usize>, MeshProblem> {
    if code == kinds::POINT {
        return Ok(None);
    }
    if let Some(order) = kinds::pyramid(code) {
        let ordered: Vec<u64> = order.iter().map(|place| nodes[*place]).collect();
        return draft.add_pyramid(label, &ordered).map(Some);
    }
    let kind = kinds::kind(code)?;
    let mut ordered = [0; 27];
    let ordered = &mut ordered[..nodes.len()];
    for (place, node) in ordered.iter_mut().enumerate() {
        *node = nodes[kind.place(place)];
    }
    draft.add_cell(label, kind.shape, ordered).map(Some)
}

/// Number of nodes of a type of gmsh.
fn nodes_of(code: u64) -> Result<usize, MeshProblem> {
    match kinds::pyramid(code) {
        Some(order) => Ok(order.len()),
        None if code == kinds::POINT => Ok(1),
        None => kinds::kind(code).map(|kind| kind.shape.nodes()),
    }
}

/// The index of the node of a physical point.
fn point(draft: &Draft, cell: u64, node: u64) -> Result<usize, VolumeProblem> {
    draft.node(node).ok_or(VolumeProblem::NoSuchNode { cell, node })
}
