//! PLY header: encoding, elements with their counts, and properties with their types.
//! A file without coordinates of vertices or corners of faces is refused here, so that the readers of values need not check.

use crate::mesh::error::{Fault, MeshProblem, Part, Place};
use crate::mesh::file::Encoding;

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Float32,
    Float64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::Int8,
            "uchar" | "uint8" => Self::UInt8,
            "short" | "int16" => Self::Int16,
            "ushort" | "uint16" => Self::UInt16,
            "int" | "int32" => Self::Int32,
            "uint" | "uint32" => Self::UInt32,
            "float" | "float32" => Self::Float32,
            "double" | "float64" => Self::Float64,
            _ => return None,
        })
    }
}

/// One number, or a list of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { length: Scalar, item: Scalar },
}

/// A named value of every element of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
}

/// Elements of a kind.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub part: Part,
    pub count: u64,
    pub properties: Vec<Property>,
}

impl Element {
    fn axis(&self, name: &str) -> Option<usize> {
        self.properties
            .iter()
            .position(|property| property.name == name && matches!(property.kind, Kind::Scalar(_)))
    }

    fn list(&self) -> Option<usize> {
        let is_list = |property: &Property| matches!(property.kind, Kind::List { .. });
        let named =
            |property: &Property| ["vertex_indices", "vertex_index"].contains(&property.name.as_str());
        self.properties.iter().position(|property| is_list(property) && named(property))
    }

    /// Indices of the properties x, y and z.
    pub(super) fn axes(&self) -> [usize; 3] {
        ["x", "y", "z"].map(|name| self.axis(name).expect("the header was refused without it"))
    }

    /// Index of the property that lists the corners of a face.
    pub(super) fn corners(&self) -> usize {
        self.list().expect("the header was refused without it")
    }
}

/// Header of a PLY file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Lines of the header.
    pub lines: usize,
    /// Bytes of the header.
    pub size: usize,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, Fault> {
        let (mut encoding, mut elements) = (None, Vec::new());
        let (mut lines, mut size) = (0, 0);
        loop {
            let rest = &bytes[size..];
            let Some(length) = rest.iter().position(|byte| *byte == b'\n') else {
                return Err((Place::Line(lines + 1), MeshProblem::NoHeaderEnd));
            };
            (lines, size) = (lines + 1, size + length + 1);
            let line = String::from_utf8_lossy(rest[..length].trim_ascii()); // comments may be in any encoding
            let refused = || (Place::Line(lines), MeshProblem::Header { found: (&*line).into() });
            let words: Vec<&str> = line.split_whitespace().collect();
            match words.as_slice() {
                ["ply"] if lines == 1 => {}
                [] | ["comment" | "obj_info", ..] => {}
                ["end_header"] => break,
                ["format", name, "1.0"] if encoding.is_none() => {
                    encoding = Some(encoding_named(name).ok_or_else(refused)?);
                }
                ["element", name, count] => {
                    let element = Element::new(name, count).ok_or_else(refused)?;
                    if elements.iter().any(|other: &Element| other.part == element.part) {
                        return Err(refused());
                    }
                    elements.push(element);
                }
                ["property", rest @ ..] => {
                    let property = Property::new(rest).ok_or_else(refused)?;
                    elements.last_mut().ok_or_else(refused)?.properties.push(property);
                }
                _ => return Err(refused()),
            }
        }
        let place = Place::Line(lines);
        let encoding = encoding.ok_or((place.clone(), MeshProblem::Header { found: "end_header".into() }))?;
        let header = Self { encoding, elements, lines, size };
        header.check().map_err(|problem| (place, problem))?;
        Ok(header)
    }

    /// Vertices have x, y, z and faces have corners.
    fn check(&self) -> Result<(), MeshProblem> {
        let [vertices, faces] = [self.element(Part::Vertices)?, self.element(Part::Faces)?];
        if ["x", "y", "z"].iter().any(|name| vertices.axis(name).is_none()) {
            return Err(MeshProblem::NoProperty { part: Part::Vertices });
        }
        if faces.list().is_none() {
            return Err(MeshProblem::NoProperty { part: Part::Faces });
        }
        Ok(())
    }

    fn element(&self, part: Part) -> Result<&Element, MeshProblem> {
        self.elements.iter().find(|element| element.part == part).ok_or(MeshProblem::Nothing { part })
    }

    /// Number of vertices that the file announces.
    pub(super) fn vertices(&self) -> usize {
        let count = self.element(Part::Vertices).map_or(0, |element| element.count);
        usize::try_from(count).unwrap_or(usize::MAX)
    }
}

fn encoding_named(name: &str) -> Option<Encoding> {
    match name {
        "ascii" => Some(Encoding::Text),
        "binary_little_endian" => Some(Encoding::LittleEndian),
        "binary_big_endian" => Some(Encoding::BigEndian),
        _ => None,
    }
}

impl Element {
    fn new(name: &str, count: &str) -> Option<Self> {
        let part = match name {
            "vertex" => Part::Vertices,
            "face" => Part::Faces,
            name => Part::Elements(name.to_owned()),
        };
        Some(Self { part, count: count.parse().ok()?, properties: Vec::new() })
    }
}

impl Property {
    fn new(words: &[&str]) -> Option<Self> {
        match words {
            ["list", length, item, name] => {
                let kind = Kind::List { length: Scalar::named(length)?, item: Scalar::named(item)? };
                Some(Self { name: (*name).to_owned(), kind })
            }
            [scalar, name] => {
                Some(Self { name: (*name).to_owned(), kind: Kind::Scalar(Scalar::named(scalar)?) })
            }
            _ => None,
        }
    }
}
