//! Legacy VTK files, text or binary, versions 1 to 5: a line that announces values, then the values.
//! Values that make no sets are read too: in a binary file only their size tells where the next line starts.

pub(in crate::mesh) mod poly;

use quasirigid_mesh::Mesh;

use super::array::{Array, Origin, Scalar, Values, Words, cut};
use super::grid::Grid;
use super::{Fault, MeshProblem, Place, Row, Sets, VolumeProblem};

/// An unstructured grid of a legacy file.
pub(in crate::mesh::volume) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    let mut file = File { bytes, at: 0, start: 0, binary: false };
    let offsets = file.read_header()?;
    let mut parts = Parts::default();
    while let Some(line) = file.line()? {
        file.read_part(line, offsets, &mut parts)?;
    }
    let end = file.end();
    let missing = |part: &str| (end.clone(), VolumeProblem::Missing { keyword: part.into() }.into());
    let (corners, ends) = parts.cells.ok_or_else(|| missing("CELLS"))?;
    let grid = Grid {
        points: parts.points.ok_or_else(|| missing("POINTS"))?,
        corners,
        ends,
        counted: !offsets,
        types: parts.types.ok_or_else(|| missing("CELL_TYPES"))?,
        groups: parts.groups,
    };
    let (mut mesh, mut sets) = (Mesh::default(), Sets::default());
    grid.add_to(&mut mesh, &mut sets, 0)?;
    mesh.sets = sets.sorted();
    Ok(mesh)
}

/// Arrays read so far.
#[derive(Default)]
struct Parts<'a> {
    points: Option<Array<'a>>,
    /// Corners of the cells, and ends of the corners of each.
    cells: Option<(Array<'a>, Array<'a>)>,
    types: Option<Array<'a>>,
    groups: Vec<Array<'a>>,
    /// Whether values belong to cells, and how many there are of each array.
    data: Option<(bool, u64)>,
}

/// A file while it is read.
struct File<'a> {
    bytes: &'a [u8],
    at: usize,
    /// First byte of the last line.
    start: usize,
    binary: bool,
}

impl<'a> File<'a> {
    /// The first lines; returns whether the file has offsets of cells, as those of version 5 have.
    fn read_header(&mut self) -> Result<bool, Fault> {
        let first = self.line()?.unwrap_or_default();
        let version = first.rsplit(' ').next().unwrap_or_default();
        let major: Option<u32> = version.split('.').next().and_then(|major| major.parse().ok());
        let refused = || (self.place(), VolumeProblem::Version { found: first.into() }.into());
        let major = major.filter(|major| (1..=5).contains(major)).ok_or_else(refused)?;
        self.raw_line(); // the title, in any encoding
        let encoding = self.line()?.unwrap_or_default();
        self.binary = match encoding.to_ascii_uppercase().as_str() {
            "ASCII" => false,
            "BINARY" => true,
            _ => return Err(self.unexpected(encoding)),
        };
        Ok(major == 5)
    }

    /// The next line, which may be blank.
    fn raw_line(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = rest.iter().position(|byte| *byte == b'\n');
        self.start = self.at;
        self.at += length.map_or(rest.len(), |length| length + 1);
        Some(rest[..length.unwrap_or(rest.len())].trim_ascii())
    }

    /// The next line that is not blank.
    fn line(&mut self) -> Result<Option<&'a str>, Fault> {
        while let Some(line) = self.raw_line() {
            if !line.is_empty() {
                let wrong =
                    |error: std::str::Utf8Error| MeshProblem::NotText { byte: line[error.valid_up_to()] };
                return std::str::from_utf8(line).map(Some).map_err(|error| (self.place(), wrong(error)));
            }
        }
        Ok(None)
    }

    /// Place of the last line.
    fn place(&self) -> Place {
        if self.binary { Place::Byte(self.start) } else { self.words().line(self.start) }
    }

    fn end(&self) -> Place {
        if self.binary {
            Place::Byte(self.bytes.len())
        } else {
            self.words().line(self.bytes.trim_ascii_end().len())
        }
    }

    fn words(&self) -> Words<'a> {
        Words { bytes: self.bytes, at: self.at, first_line: 1 }
    }

    fn unexpected(&self, line: &str) -> Fault {
        (self.place(), VolumeProblem::Keyword { found: line.into() }.into())
    }

    /// A line that announces values, and these values.
    fn read_part(&mut self, line: &'a str, offsets: bool, parts: &mut Parts<'a>) -> Result<(), Fault> {
        let words: Vec<&str> = line.split_whitespace().collect();
        // A vertical tab is a blank to `split_whitespace` and not to `trim_ascii`.
        let Some((keyword, values)) = words.split_first() else { return Err(self.unexpected(line)) };
        let keyword = keyword.to_ascii_uppercase();
        let of_cells = matches!(parts.data, Some((true, _)));
        let count = parts.data.map_or(0, |(_, count)| count);
        match (keyword.as_str(), values) {
            ("DATASET", [kind]) if kind.eq_ignore_ascii_case("UNSTRUCTURED_GRID") => {}
            ("POINTS", [points, scalar]) if parts.points.is_none() => {
                let points = self.count(points)?.saturating_mul(3);
                parts.points = Some(self.array("POINTS", self.scalar(scalar)?, points)?);
            }
            ("CELLS", [cells, size]) if parts.cells.is_none() => {
                let (cells, size) = (self.count(cells)?, self.count(size)?);
                let read = if offsets {
                    self.cells_by_offsets(cells, size)
                } else {
                    self.counted_cells(cells, size)
                };
                parts.cells = Some(read?);
            }
            ("CELL_TYPES", [cells]) if parts.types.is_none() => {
                let cells = self.count(cells)?;
                parts.types = Some(self.array("CELL_TYPES", Scalar::Int32, cells)?);
            }
            ("CELL_DATA", [count]) => parts.data = Some((true, self.count(count)?)),
            ("POINT_DATA", [count]) => parts.data = Some((false, self.count(count)?)),
            ("FIELD", [_, arrays]) => {
                for _ in 0..self.count(arrays)? {
                    let group = self.field_array()?;
                    parts.groups.extend(group.filter(|_| of_cells));
                }
            }
            ("METADATA", []) => while self.raw_line().is_some_and(|line| !line.is_empty()) {},
            ("SCALARS", [name, scalar, rest @ ..]) if rest.len() < 2 && parts.data.is_some() => {
                let components = rest.first().map_or(Ok(1), |components| self.count(components))?;
                let scalar = self.scalar(scalar)?;
                self.take_lookup_table()?;
                let array = self.array(name, scalar, count.saturating_mul(components))?;
                parts.groups.extend(Some(array).filter(|_| of_cells && components == 1 && scalar.is_whole()));
            }
            ("LOOKUP_TABLE", [name, size]) => {
                let scalar = if self.binary { Scalar::UInt8 } else { Scalar::Float32 };
                self.array(name, scalar, self.count(size)?.saturating_mul(4))?;
            }
            (_, rest) => {
                let (scalar, components) = self.attribute(line, &keyword, rest)?;
                self.array(line, scalar, count.saturating_mul(components))?;
            }
        }
        Ok(())
    }

    /// Type and components of values that make no sets.
    fn attribute(&self, line: &str, keyword: &str, rest: &[&str]) -> Result<(Scalar, u64), Fault> {
        Ok(match (keyword, rest) {
            ("VECTORS" | "NORMALS", [_, scalar]) => (self.scalar(scalar)?, 3),
            ("TENSORS", [_, scalar]) => (self.scalar(scalar)?, 9),
            ("TENSORS6", [_, scalar]) => (self.scalar(scalar)?, 6),
            ("GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS", [_, scalar]) => (self.scalar(scalar)?, 1),
            ("TEXTURE_COORDINATES", [_, components, scalar]) => {
                (self.scalar(scalar)?, self.count(components)?)
            }
            ("COLOR_SCALARS", [_, components]) => {
                (if self.binary { Scalar::UInt8 } else { Scalar::Float32 }, self.count(components)?)
            }
            _ => return Err(self.unexpected(line)),
        })
    }

    /// One array of a field, if the array has one whole number for each cell or point.
    fn field_array(&mut self) -> Result<Option<Array<'a>>, Fault> {
        let line = self.line()?.ok_or_else(|| (self.end(), cut("FIELD", 1, 0)))?;
        let words: Vec<&str> = line.split_whitespace().collect();
        if words == ["METADATA"] {
            while self.raw_line().is_some_and(|line| !line.is_empty()) {}
            return self.field_array();
        }
        let [name, components, tuples, scalar] = words.as_slice() else { return Err(self.unexpected(line)) };
        let (components, tuples) = (self.count(components)?, self.count(tuples)?);
        let scalar = self.scalar(scalar)?;
        let array = self.array(name, scalar, components.saturating_mul(tuples))?;
        Ok(Some(array).filter(|_| components == 1 && scalar.is_whole()))
    }

    /// The line between the name of scalars and their values, if there is one.
    fn take_lookup_table(&mut self) -> Result<(), Fault> {
        let before = (self.at, self.start);
        let line = self.line();
        if !matches!(line, Ok(Some(line)) if line.to_ascii_uppercase().starts_with("LOOKUP_TABLE")) {
            (self.at, self.start) = before;
        }
        Ok(())
    }

    /// Cells of versions before 5: the number of corners, then the corners.
    fn counted_cells(&mut self, cells: u64, size: u64) -> Result<(Array<'a>, Array<'a>), Fault> {
        let array = self.array("CELLS", Scalar::Int32, size)?;
        let (mut corners, mut ends) = (Vec::new(), Vec::new());
        let mut rest = array.whole()?;
        for cell in 0..cells {
            let place = || array.origin.place(array.values.len() - rest.len());
            let part = "CELLS".to_owned();
            let [count, after @ ..] = rest else {
                return Err((
                    place(),
                    VolumeProblem::ArrayLength { array: part, found: cell, expected: cells }.into(),
                ));
            };
            let here = usize::try_from(*count).ok().and_then(|count| after.split_at_checked(count));
            let (here, after) = here.ok_or_else(|| {
                let (start, total) = ((array.values.len() - after.len()) as u64, array.values.len() as u64);
                let problem = match u64::try_from(*count) {
                    Ok(count) => {
                        VolumeProblem::Offset { cell, start, end: start.saturating_add(count), total }
                    }
                    Err(_) => VolumeProblem::Label { found: *count },
                };
                (place(), problem.into())
            })?;
            corners.extend(here);
            ends.push(corners.len() as i64);
            rest = after;
        }
        let (name, origin) = (array.name.clone(), array.origin);
        let ends = Array { name: name.clone(), values: Values::Whole(ends), origin: origin.clone() };
        Ok((Array { name, values: Values::Whole(corners), origin }, ends))
    }

    /// Cells of version 5: offsets, one more than cells, then corners.
    fn cells_by_offsets(&mut self, offsets: u64, size: u64) -> Result<(Array<'a>, Array<'a>), Fault> {
        let mut ends = self.announced("OFFSETS", offsets)?;
        if let Values::Whole(ends) = &mut ends.values
            && !ends.is_empty()
        {
            ends.remove(0);
        }
        Ok((self.announced("CONNECTIVITY", size)?, ends))
    }

    fn announced(&mut self, name: &str, count: u64) -> Result<Array<'a>, Fault> {
        let line = self.line()?.ok_or_else(|| (self.end(), cut(name, count, 0)))?;
        match line.split_whitespace().collect::<Vec<_>>().as_slice() {
            [keyword, scalar] if keyword.eq_ignore_ascii_case(name) => {
                self.array(name, self.scalar(scalar)?, count)
            }
            _ => Err(self.unexpected(line)),
        }
    }

    fn count(&self, word: &str) -> Result<u64, Fault> {
        let wrong = |_| (self.place(), MeshProblem::NotANumber { found: word.into(), row: Row::VtkKeyword });
        word.parse().map_err(wrong)
    }

    fn scalar(&self, name: &str) -> Result<Scalar, Fault> {
        Scalar::named(name).map_err(|problem| (self.place(), problem))
    }

    /// The next values.
    fn array(&mut self, name: &str, scalar: Scalar, count: u64) -> Result<Array<'a>, Fault> {
        let start = self.at;
        let (values, origin) = if self.binary {
            let rest = &self.bytes[start..];
            let size = scalar.size(count).filter(|size| *size <= rest.len());
            let size =
                size.ok_or_else(|| (self.end(), cut(name, count, (rest.len() / scalar.width()) as u64)))?;
            self.at += size;
            let mut values = Values::from_bytes(&rest[..size], scalar, true);
            if let Values::Whole(values) = &mut values {
                values.truncate(count as usize); // bits fill their last byte
            }
            (values, Origin::Bytes { start, width: scalar.width() })
        } else {
            let mut words = self.words();
            let values = Values::from_words(&mut words, scalar, count)?;
            self.at = words.at;
            (values, Origin::Words { bytes: self.bytes, start, first_line: 1 })
        };
        let found = values.len() as u64;
        if found < count && !self.bytes[self.at..].trim_ascii().is_empty() {
            let array = name.to_owned();
            let problem = VolumeProblem::ArrayLength { array, found, expected: count };
            return Err((origin.place(values.len()), problem.into()));
        }
        if found < count {
            return Err((self.end(), cut(name, count, found)));
        }
        Ok(Array { name: name.to_owned(), values, origin })
    }
}
