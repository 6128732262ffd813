//! NRRD: a header of fields, then the values, raw, packed by gzip or as text, or in a file of their own.
//! (Teem: Definition of NRRD File Format)

use std::collections::HashMap;
use std::path::{Component, Path};

use miniz_oxide::inflate::decompress_to_vec_with_limit;
use quasirigid_math::vec3::{add, scale};

use super::{Grid, UNIT, VoxelProblem, counted};
use crate::mesh::error::{MeshError, MeshProblem, Place};
use crate::mesh::file::MAX_FILE;
use crate::mesh::volume::problem::VolumeProblem;
use crate::text_file::{FileError, bytes_of};

/// A type of number: bytes, and whether it is signed or a fraction.
#[derive(Clone, Copy)]
struct Number {
    size: usize,
    signed: bool,
    fraction: bool,
}

pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Grid, MeshError> {
    let named = FileError::new(file);
    let refuse =
        |problem: VoxelProblem| named((Place::File, MeshProblem::from(VolumeProblem::from(problem))));
    let (fields, rest) = fields(bytes);
    let header = Header { fields };
    let grid = header.grid().map_err(refuse)?;
    let detached = header.get("data file").or(header.get("datafile")).map(str::to_owned);
    let own;
    let data = match detached {
        None => rest,
        Some(name) => {
            let path = Path::new(&name);
            let below =
                path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
            if !below || name.starts_with("LIST") || name.contains('%') {
                return Err(refuse(VoxelProblem::Elsewhere { file: name }));
            }
            own = bytes_of::<MeshProblem>(&file.parent().unwrap_or(Path::new("")).join(path), MAX_FILE)?;
            &own[..]
        }
    };
    let values = header.values(data, counted(grid.sizes).map_err(refuse)?).map_err(refuse)?;
    Ok(Grid { values, ..grid })
}

/// The fields of a header in small letters, and the bytes after its blank line.
fn fields(bytes: &[u8]) -> (HashMap<String, String>, &[u8]) {
    let mut fields = HashMap::new();
    let mut rest = bytes;
    while let Some(end) = rest.iter().position(|byte| *byte == b'\n') {
        let line = String::from_utf8_lossy(&rest[..end]).trim().to_owned();
        rest = &rest[end + 1..];
        if line.is_empty() {
            break;
        }
        if let Some((name, value)) = line.split_once(':').filter(|_| !line.starts_with('#')) {
            let value = value.strip_prefix('=').unwrap_or(value);
            fields.entry(name.trim().to_ascii_lowercase()).or_insert_with(|| value.trim().to_owned());
        }
    }
    (fields, rest)
}

struct Header {
    fields: HashMap<String, String>,
}

impl Header {
    fn get(&self, name: &str) -> Option<&str> {
        self.fields.get(name).map(String::as_str)
    }

    fn wrong(&self, name: &'static str, wanted: &'static str) -> VoxelProblem {
        VoxelProblem::Field { name, found: self.get(name).unwrap_or_default().to_owned(), wanted }
    }

    /// The grid without its values.
    fn grid(&self) -> Result<Grid, VoxelProblem> {
        let sizes = self.get("sizes").unwrap_or_default().split_whitespace().map(str::parse::<usize>);
        let sizes: Vec<usize> = sizes
            .collect::<Result<_, _>>()
            .map_err(|_| self.wrong("sizes", "three whole numbers are read"))?;
        let [x, y, z] = sizes[..] else {
            return Err(VoxelProblem::Dimensions { found: format!("{sizes:?}") });
        };
        let directions = self.vectors("space directions")?;
        let mut edges = UNIT;
        if let Some(directions) = &directions {
            edges
                .copy_from_slice(directions.get(..3).ok_or_else(|| self.wrong("space directions", VECTORS))?);
        } else if let Some(text) = self.get("spacings") {
            let spacings = text.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>();
            let spacings = spacings.ok().filter(|all| all.len() == 3 && all.iter().all(|one| *one > 0.0));
            let spacings =
                spacings.ok_or_else(|| self.wrong("spacings", "three positive numbers are read"))?;
            (0..3).for_each(|axis| edges[axis][axis] = spacings[axis]);
        }
        if edges.iter().flatten().any(|entry| !entry.is_finite()) {
            return Err(self.wrong("space directions", VECTORS));
        }
        let half = scale(-0.5, edges.iter().fold([0.0; 3], |sum, edge| add(sum, *edge)));
        // The origin is the centre of the first voxel.
        let corner = match self.vectors("space origin")?.as_deref() {
            Some([origin, ..]) => add(*origin, half),
            _ => [0.0; 3],
        };
        Ok(Grid { sizes: [x, y, z], values: Vec::new(), corner, edges })
    }

    /// Vectors such as `(1,0,0) (0,1,0)`; `none` is left out.
    fn vectors(&self, name: &'static str) -> Result<Option<Vec<[f64; 3]>>, VoxelProblem> {
        let Some(text) = self.get(name) else { return Ok(None) };
        let mut vectors = Vec::new();
        for piece in text.split('(').skip(1) {
            let inside = piece.split(')').next().unwrap_or_default();
            let entries = inside.split(',').map(|entry| entry.trim().parse::<f64>());
            let entries = entries.collect::<Result<Vec<_>, _>>().ok();
            let vector = entries.and_then(|entries| <[f64; 3]>::try_from(entries).ok());
            vectors.push(vector.ok_or_else(|| self.wrong(name, VECTORS))?);
        }
        Ok(Some(vectors))
    }

    fn number(&self) -> Result<Number, VoxelProblem> {
        let whole = |size, signed| Ok(Number { size, signed, fraction: false });
        match self.get("type").unwrap_or_default() {
            "signed char" | "int8" | "int8_t" => whole(1, true),
            "uchar" | "unsigned char" | "uint8" | "uint8_t" => whole(1, false),
            "short" | "short int" | "signed short" | "int16" | "int16_t" => whole(2, true),
            "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => whole(2, false),
            "int" | "signed int" | "int32" | "int32_t" => whole(4, true),
            "uint" | "unsigned int" | "uint32" | "uint32_t" => whole(4, false),
            "longlong" | "long long" | "int64" | "int64_t" => whole(8, true),
            "ulonglong" | "unsigned long long" | "uint64" | "uint64_t" => whole(8, false),
            "float" => Ok(Number { size: 4, signed: true, fraction: true }),
            "double" => Ok(Number { size: 8, signed: true, fraction: true }),
            _ => Err(self.wrong("type", "integers of 8 to 64 bits, float and double are read")),
        }
    }

    /// The values of the grid.
    fn values(&self, data: &[u8], count: usize) -> Result<Vec<f64>, VoxelProblem> {
        let number = self.number()?;
        let encoding = self.get("encoding").unwrap_or_default().to_ascii_lowercase();
        if ["ascii", "text", "txt"].contains(&encoding.as_str()) {
            let text = String::from_utf8_lossy(data);
            let values = text.split_whitespace().map(str::parse::<f64>).collect::<Result<Vec<_>, _>>();
            let values = values.map_err(|_| self.wrong("encoding", "text has numbers between blanks"))?;
            let finite = values.iter().all(|value| value.is_finite());
            return if values.len() == count && finite {
                Ok(values)
            } else {
                Err(VoxelProblem::Length { announced: count, found: values.len() })
            };
        }
        let announced = count.saturating_mul(number.size);
        let unpacked;
        let data = match encoding.as_str() {
            "raw" => data,
            "gzip" | "gz" => {
                unpacked = gunzipped(data, announced).ok_or_else(|| {
                    self.wrong("encoding", "the values are no gzip stream of the grid's length")
                })?;
                &unpacked[..]
            }
            _ => return Err(self.wrong("encoding", "raw, gzip and text are read; save with one of these")),
        };
        let skipped = match self.get("byte skip").or(self.get("byteskip")).map(str::parse::<i64>) {
            Some(Ok(-1)) => data.len().saturating_sub(announced),
            Some(Ok(skip)) => usize::try_from(skip).unwrap_or(0),
            _ => 0,
        };
        let data = data.get(skipped..).unwrap_or_default();
        if data.len() < announced {
            return Err(VoxelProblem::Length { announced, found: data.len() });
        }
        let big = self.get("endian").is_some_and(|endian| endian.eq_ignore_ascii_case("big"));
        let values: Vec<f64> =
            data[..announced].chunks_exact(number.size).map(|bytes| number.value(bytes, big)).collect();
        match values.iter().find(|value| !value.is_finite()) {
            Some(value) => Err(VoxelProblem::NoLabel { found: value.to_string() }),
            None => Ok(values),
        }
    }
}

const VECTORS: &str = "three vectors such as (1,0,0) are read";

impl Number {
    fn value(self, bytes: &[u8], big: bool) -> f64 {
        let mut bits: u64 = 0;
        for (at, byte) in bytes.iter().enumerate() {
            let place = if big { bytes.len() - 1 - at } else { at };
            bits |= u64::from(*byte) << (8 * place);
        }
        match (self.fraction, self.size) {
            (true, 4) => f32::from_bits(bits as u32).into(),
            (true, _) => f64::from_bits(bits),
            (false, size) if self.signed => {
                let shift = 64 - 8 * size;
                (((bits << shift) as i64) >> shift) as f64
            }
            _ => bits as f64,
        }
    }
}

/// The bytes of a gzip stream, which are at most so many.
fn gunzipped(data: &[u8], most: usize) -> Option<Vec<u8>> {
    let [0x1f, 0x8b, 8, flags, ..] = *data else { return None };
    let mut rest = data.get(10..)?;
    if flags & 4 != 0 {
        let length = usize::from(*rest.first()?) + 256 * usize::from(*rest.get(1)?);
        rest = rest.get(2 + length..)?;
    }
    for flag in [8, 16] {
        if flags & flag != 0 {
            let end = rest.iter().position(|byte| *byte == 0)?;
            rest = rest.get(end + 1..)?;
        }
    }
    if flags & 2 != 0 {
        rest = rest.get(2..)?;
    }
    decompress_to_vec_with_limit(rest, most).ok()
}
