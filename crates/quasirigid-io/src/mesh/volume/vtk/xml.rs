//! XML files of VTK (`.vtu`): arrays as text, as base64, or as bytes appended after the XML.
//! Appended raw bytes are no XML, so the file is split before it is parsed; decompression is limited by the counts of the grid.

pub(in crate::mesh) mod poly;

use std::borrow::Cow;

use quasirigid_math::memory;
use quasirigid_mesh::Mesh;
use roxmltree::{Document, Node};

use super::array::{Array, Origin, Scalar, Values, Words};
use super::data::{Encoded, Layout};
use super::grid::Grid;
use super::{Fault, MeshProblem, Place, Sets, VolumeProblem};
use crate::mesh::file::MAX_FILE;
use crate::text_file::text;

const APPENDED: &[u8] = b"<AppendedData";
const CLOSING: &[u8] = b"</VTKFile>";
/// Corners that a cell has at most.
const MAX_CORNERS: u64 = 27;
/// Bytes that an array may decompress to for each byte of the file, and always.
const INFLATION: u64 = 100;
const ALWAYS_UNPACKED: u64 = 16 * 1024 * 1024;

/// An unstructured grid as XML, `.vtu`.
pub(in crate::mesh::volume) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let (header, appended) = split(bytes);
    let document = parsed(text(&header)?)?;
    let file = File::new(&document, appended, "UnstructuredGrid")?;
    let grid = file.child(document.root_element(), "UnstructuredGrid")?;
    let (mut mesh, mut sets, mut cells) = (Mesh::default(), Sets::default(), 0);
    for piece in grid.children().filter(|child| child.has_tag_name("Piece")) {
        cells += file.grid(piece)?.add_to(&mut mesh, &mut sets, cells)?;
    }
    mesh.sets = sets.sorted();
    Ok(mesh)
}

fn parsed(text: &str) -> Result<Document<'_>, Fault> {
    Document::parse(text).map_err(|error| {
        let place = error.pos();
        (Place::Line(place.row as usize), VolumeProblem::Xml { column: place.col }.into())
    })
}

/// The part of a file that is XML, and its appended bytes, which may be none.
fn split(bytes: &[u8]) -> (Cow<'_, [u8]>, &[u8]) {
    let tag = bytes.windows(APPENDED.len()).position(|window| window == APPENDED);
    let end = tag.and_then(|tag| Some(tag + bytes[tag..].iter().position(|byte| *byte == b'>')?));
    let Some(end) = end else { return (Cow::Borrowed(bytes), &[]) };
    let mut header = bytes[..end].to_vec();
    if !header.ends_with(b"/") {
        header.push(b'/');
    }
    header.push(b'>');
    header.extend(CLOSING);
    let data = &bytes[end + 1..];
    let start = data.iter().position(|byte| *byte == b'_').map_or(data.len(), |mark| mark + 1);
    (Cow::Owned(header), &data[start..])
}

/// Layout that all arrays of a file share.
struct File<'a, 'input> {
    document: &'a Document<'input>,
    layout: Layout,
    /// Appended bytes, and whether they are base64.
    appended: &'a [u8],
    appended_base64: bool,
    /// Bytes that an array may decompress to.
    unpacked: u64,
}

impl<'a, 'input> File<'a, 'input> {
    fn new(document: &'a Document<'input>, appended: &'a [u8], kind: &str) -> Result<Self, Fault> {
        let root = document.root_element();
        let encoding = root.children().find(|child| child.has_tag_name("AppendedData"));
        let size = (document.input_text().len() + appended.len()) as u64;
        let mut file = Self {
            unpacked: size.saturating_mul(INFLATION).clamp(ALWAYS_UNPACKED, MAX_FILE),
            document,
            layout: Layout { big_endian: false, wide: false, compressed: false },
            appended,
            appended_base64: encoding.and_then(|data| data.attribute("encoding")) == Some("base64"),
        };
        if !root.has_tag_name("VTKFile") || root.attribute("type") != Some(kind) {
            return Err(file.lacks(root, &format!("type={kind:?}")));
        }
        file.layout.big_endian = match root.attribute("byte_order") {
            None | Some("LittleEndian") => false,
            Some("BigEndian") => true,
            _ => return Err(file.lacks(root, "byte_order")),
        };
        file.layout.wide = match root.attribute("header_type") {
            None | Some("UInt32") => false,
            Some("UInt64") => true,
            _ => return Err(file.lacks(root, "header_type")),
        };
        file.layout.compressed = match root.attribute("compressor") {
            None | Some("") => false,
            Some("vtkZLibDataCompressor") => true,
            Some(found) => {
                return Err((file.place(root), VolumeProblem::Compressor { found: found.into() }.into()));
            }
        };
        Ok(file)
    }

    /// Place of the start of an element.
    fn place(&self, node: Node) -> Place {
        Place::Line(self.document.text_pos_at(node.range().start).row as usize)
    }

    fn lacks(&self, node: Node, missing: &str) -> Fault {
        let (element, missing) = (node.tag_name().name().to_owned(), missing.to_owned());
        (self.place(node), VolumeProblem::Attribute { element, missing }.into())
    }

    fn child(&self, node: Node<'a, 'input>, name: &str) -> Result<Node<'a, 'input>, Fault> {
        node.children()
            .find(|child| child.has_tag_name(name))
            .ok_or_else(|| self.lacks(node, &format!("<{name}>")))
    }

    fn count(&self, node: Node, name: &str) -> Result<u64, Fault> {
        let count = node.attribute(name).and_then(|count| count.trim().parse().ok());
        count.ok_or_else(|| self.lacks(node, name))
    }

    fn grid(&self, piece: Node<'a, 'input>) -> Result<Grid<'a>, Fault> {
        let (points, cells) = (self.count(piece, "NumberOfPoints")?, self.count(piece, "NumberOfCells")?);
        let places = self.child(piece, "Points")?;
        let place = self.child(places, "DataArray")?;
        let listed = self.child(piece, "Cells")?;
        let named = |name: &str| {
            let mut arrays = listed.children().filter(|child| child.has_tag_name("DataArray"));
            let array = arrays.find(|array| array.attribute("Name") == Some(name));
            array.ok_or_else(|| self.lacks(listed, &format!("<DataArray Name={name:?}>")))
        };
        Ok(Grid {
            points: self.array(place, points.saturating_mul(3))?.has(points.saturating_mul(3))?,
            corners: self.array(named("connectivity")?, cells.saturating_mul(MAX_CORNERS))?,
            ends: self.array(named("offsets")?, cells)?.has(cells)?,
            counted: false,
            types: self.array(named("types")?, cells)?.has(cells)?,
            groups: self.groups(piece, cells)?,
        })
    }

    /// Arrays of one whole number for each cell.
    fn groups(&self, piece: Node<'a, 'input>, cells: u64) -> Result<Vec<Array<'a>>, Fault> {
        let data = piece.children().filter(|child| child.has_tag_name("CellData"));
        let arrays = data.flat_map(|data| data.children()).filter(|child| child.has_tag_name("DataArray"));
        let groups = arrays.filter(|array| {
            let kind = array.attribute("type").map(Scalar::named);
            let single = matches!(array.attribute("NumberOfComponents"), None | Some("1"));
            single && matches!(kind, Some(Ok(scalar)) if scalar.is_whole())
        });
        groups.map(|array| self.array(array, cells)?.has(cells)).collect()
    }

    /// An array of so many values, or fewer.
    fn array(&self, node: Node<'a, 'input>, most: u64) -> Result<Array<'a>, Fault> {
        let here = |problem| (self.place(node), problem);
        let name = node.attribute("Name").unwrap_or("Points").to_owned();
        let scalar = node.attribute("type").ok_or_else(|| self.lacks(node, "type"))?;
        let scalar = Scalar::named(scalar).map_err(here)?;
        let content = content(node).and_then(|text| text.text()).unwrap_or_default();
        if node.attribute("format").is_none_or(|format| format == "ascii") {
            return self.words(node, name, scalar);
        }
        let encoded = match node.attribute("format") {
            Some("binary") => {
                let characters = content.bytes().filter(|byte| !byte.is_ascii_whitespace());
                Encoded::Base64(Cow::Owned(characters.collect()))
            }
            Some("appended") => {
                let offset = usize::try_from(self.count(node, "offset")?).unwrap_or(usize::MAX);
                let from = self.appended.get(offset..).ok_or_else(|| self.lacks(node, "offset"))?;
                if self.appended_base64 { Encoded::Base64(Cow::Borrowed(from)) } else { Encoded::Raw(from) }
            }
            _ => return Err(self.lacks(node, "format")),
        };
        let limit = scalar.size(most).map_or(u64::MAX, |size| size as u64).min(self.unpacked);
        let bytes = self.layout.decoded(&encoded, &name, limit).map_err(here)?;
        let wide = bytes.len() / scalar.width() * size_of::<f64>();
        memory::ask(wide as f64).map_err(|cause| here(MeshProblem::Memory(cause)))?;
        let values = Values::from_bytes(&bytes, scalar, self.layout.big_endian);
        Ok(Array { name, values, origin: Origin::Somewhere(self.place(node)) })
    }

    /// An array of words.
    fn words(&self, node: Node<'a, 'input>, name: String, scalar: Scalar) -> Result<Array<'a>, Fault> {
        let text = content(node);
        let bytes = text.and_then(|text| text.text()).unwrap_or_default().as_bytes();
        let first = text.map_or(node.range().start, |text| text.range().start);
        let first_line = self.document.text_pos_at(first).row as usize;
        let mut words = Words { bytes, at: 0, first_line };
        let values = Values::from_words(&mut words, scalar, u64::MAX)?;
        Ok(Array { name, values, origin: Origin::Words { bytes, start: 0, first_line } })
    }
}

/// The text of an array, which may stand behind other elements.
fn content<'a, 'input>(array: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    array.children().find(|child| child.is_text() && child.text().is_some_and(|text| !text.trim().is_empty()))
}
