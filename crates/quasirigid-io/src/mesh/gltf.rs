//! glTF 2.0, as JSON or binary: triangles of the meshes in the scene, moved by its nodes; lengths are metres.
//!
//! The `gltf` crate reads and checks the JSON. Bytes of accessors are taken here: the crate's own readers trust their offsets.

use std::borrow::Cow;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Source;
use gltf::json::Root;
use gltf::mesh::Mode;
use gltf::scene::Transform;
use gltf::{Accessor, Document, Gltf, Node, Primitive, Semantic};

use super::TriangleMesh;
use super::draft::Draft;
use super::error::{Fault, MeshError, MeshProblem, Place};
use super::file::MAX_FILE;
use crate::text_file::bytes_of;

/// Beginnings of the names of extensions that change how a scene looks and not where it is.
const LOOKS: [&str; 6] =
    ["KHR_materials_", "KHR_texture_", "KHR_technique", "KHR_lights_", "KHR_xmp", "EXT_texture_"];

/// Whether bytes begin as a glTF file does.
pub(super) fn is_gltf(bytes: &[u8]) -> bool {
    let json =
        || bytes.trim_ascii_start().starts_with(b"{") && bytes.windows(7).any(|part| part == b"\"asset\"");
    bytes.starts_with(b"glTF") || json()
}

/// Triangles of a scene; buffers in other files are looked for beside the file.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let Gltf { document, blob } =
        Gltf::from_slice_without_validation(bytes).map_err(|error| refused(&error.to_string()))?;
    let mut root = document.into_json();
    attributes_exist(&root)?;
    root.extensions_required.retain(|name| !LOOKS.iter().any(|start| name.starts_with(start)));
    let document = Document::from_json(root).map_err(|error| refused(&error.to_string()))?;
    let buffers = document.buffers().map(|buffer| match buffer.source() {
        Source::Bin => Ok(Cow::Borrowed(blob.as_deref().unwrap_or_default())),
        Source::Uri(uri) => bytes_at(uri, file).map(Cow::Owned),
    });
    let buffers = Buffers(buffers.collect::<Result<Vec<_>, _>>()?);
    let mut reading = Reading { buffers, draft: Draft::new(), others: 0 };
    match document.default_scene().or_else(|| document.scenes().next()) {
        Some(scene) => {
            let mut left = document.nodes().len();
            for node in scene.nodes() {
                reading.node(&node, &AT_REST, &mut left)?;
            }
        }
        None => {
            for mesh in document.meshes() {
                mesh.primitives().try_for_each(|primitive| reading.primitive(&primitive, &AT_REST))?;
            }
        }
    }
    let Reading { mut draft, others, .. } = reading;
    if others > 0 {
        draft.remarks.push(format!("{others} sets of points or lines left out"));
    }
    draft.unit = Some((1.0, "glTF is in metres".into()));
    draft.finish(0)
}

/// Refuses attributes of accessors that do not exist, which the checks of the crate presume.
fn attributes_exist(root: &Root) -> Result<(), Fault> {
    let mut primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let missing = primitives.any(|primitive| {
        primitive.attributes.values().any(|accessor| accessor.value() >= root.accessors.len())
    });
    if missing { Err(refused("an accessor does not exist")) } else { Ok(()) }
}

fn refused(cause: &str) -> Fault {
    (Place::File, MeshProblem::Gltf { cause: cause.into() })
}

/// Bytes of a buffer: in the text itself, or in a file beside.
fn bytes_at(uri: &str, file: &Path) -> Result<Vec<u8>, Fault> {
    if let Some(data) = uri.strip_prefix("data:") {
        let text = data.split_once(";base64,").map(|(_, text)| text);
        let bytes = text.and_then(|text| STANDARD.decode(text).ok());
        return bytes.ok_or_else(|| refused("the data of a buffer are no base64"));
    }
    let name = uri.replace("%20", " ");
    let beside = Path::new(&name);
    if name.contains("://") || !beside.is_relative() || beside.components().count() > 8 {
        return Err(refused("a buffer is in a file that is not beside this one"));
    }
    let read = bytes_of(&file.parent().unwrap_or(Path::new("")).join(beside), MAX_FILE);
    read.map_err(|error: MeshError| refused(&error.to_string()))
}

/// Columns of a linear map and a shift.
type Motion = [[f64; 3]; 4];

const AT_REST: Motion = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];

struct Reading<'a> {
    buffers: Buffers<'a>,
    draft: Draft,
    /// Primitives without triangles.
    others: usize,
}

impl Reading<'_> {
    /// Adds the meshes of a node and of those below it, as long as nodes are left: each has one place in a tree.
    fn node(&mut self, node: &Node<'_>, above: &Motion, left: &mut usize) -> Result<(), Fault> {
        let mut open = vec![(node.clone(), *above)];
        while let Some((node, above)) = open.pop() {
            *left = left.checked_sub(1).ok_or_else(|| refused("its nodes are no tree"))?;
            let motion = after(&above, &motion(node.transform()));
            if let Some(mesh) = node.mesh() {
                mesh.primitives().try_for_each(|primitive| self.primitive(&primitive, &motion))?;
            }
            open.extend(node.children().map(|child| (child, motion)));
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive<'_>, motion: &Motion) -> Result<(), Fault> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.others += 1;
            return Ok(());
        }
        let places = primitive.get(&Semantic::Positions).ok_or_else(|| refused("a mesh has no POSITION"))?;
        if (places.data_type(), places.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            return Err(refused("a POSITION is not three numbers of 32 bits"));
        }
        let first = self.draft.vertices.len();
        for place in self.buffers.elements::<12>(&places)? {
            let place = [0, 4, 8].map(|at| {
                f64::from(f32::from_le_bytes([place[at], place[at + 1], place[at + 2], place[at + 3]]))
            });
            if let Some(x) = place.iter().find(|x| !x.is_finite()) {
                return Err((Place::File, MeshProblem::NotFinite { found: x.to_string().into() }));
            }
            self.draft.vertices.push(at(motion, place));
        }
        let count = self.draft.vertices.len() - first;
        let indices: Vec<u32> = match primitive.indices() {
            Some(indices) => self.buffers.indices(&indices)?,
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
        };
        if let Some(index) = indices.iter().find(|index| **index as usize >= count) {
            let found = index.to_string().into();
            return Err((Place::File, MeshProblem::NoSuchVertex { found, first: 0, vertices: count }));
        }
        let mirrored =
            quasirigid_math::vec3::dot(quasirigid_math::vec3::cross(motion[0], motion[1]), motion[2]) < 0.0;
        let mut add = |corners: [u32; 3]| {
            let [a, b, c] =
                corners.map(|corner| u32::try_from(first).unwrap_or(u32::MAX).saturating_add(corner));
            self.draft.polygon(&if mirrored { [a, c, b] } else { [a, b, c] }, 0);
        };
        match primitive.mode() {
            Mode::TriangleStrip => {
                for (k, corners) in indices.windows(3).enumerate() {
                    add(if k % 2 == 0 {
                        [corners[0], corners[1], corners[2]]
                    } else {
                        [corners[1], corners[0], corners[2]]
                    });
                }
            }
            Mode::TriangleFan => {
                (1..indices.len().saturating_sub(1))
                    .for_each(|k| add([indices[0], indices[k], indices[k + 1]]));
            }
            _ => indices.as_chunks::<3>().0.iter().for_each(|corners| add(*corners)),
        }
        Ok(())
    }
}

/// Bytes of the buffers of a file.
struct Buffers<'a>(Vec<Cow<'a, [u8]>>);

impl Buffers<'_> {
    fn indices(&self, accessor: &Accessor<'_>) -> Result<Vec<u32>, Fault> {
        Ok(match (accessor.data_type(), accessor.dimensions()) {
            (DataType::U8, Dimensions::Scalar) => {
                self.elements::<1>(accessor)?.map(|[byte]| u32::from(*byte)).collect()
            }
            (DataType::U16, Dimensions::Scalar) => {
                self.elements::<2>(accessor)?.map(|bytes| u16::from_le_bytes(*bytes).into()).collect()
            }
            (DataType::U32, Dimensions::Scalar) => {
                self.elements::<4>(accessor)?.map(|bytes| u32::from_le_bytes(*bytes)).collect()
            }
            _ => return Err(refused("corners are not whole numbers")),
        })
    }

    /// Bytes of the elements of an accessor, each of so many.
    fn elements<const N: usize>(
        &self,
        accessor: &Accessor<'_>,
    ) -> Result<impl Iterator<Item = &[u8; N]>, Fault> {
        if accessor.sparse().is_some() {
            return Err(refused("an accessor is sparse, which is not read"));
        }
        let view = accessor.view().ok_or_else(|| refused("an accessor has no bytes"))?;
        let stride = view.stride().unwrap_or(N).max(1);
        let within = || {
            let buffer = self.0.get(view.buffer().index())?;
            let view = buffer.get(view.offset()..view.offset().checked_add(view.length())?)?;
            let bytes = view.get(accessor.offset()..)?;
            let before = accessor.count().checked_sub(1)?.checked_mul(stride)?;
            bytes.get(..before.checked_add(N)?)
        };
        let bytes = within()
            .ok_or_else(|| refused("an accessor reaches beyond its buffer; was the file cut off?"))?;
        Ok((0..accessor.count()).filter_map(move |k| bytes[k * stride..].first_chunk()))
    }
}

/// The motion of a node, with the rotation as its quaternion says.
fn motion(transform: Transform) -> Motion {
    match transform {
        Transform::Matrix { matrix } => matrix.map(|[x, y, z, _]| [x, y, z].map(f64::from)),
        Transform::Decomposed { translation, rotation, scale } => {
            let [x, y, z, w] = rotation.map(f64::from);
            let square = (x * x + y * y + z * z + w * w).max(f64::MIN_POSITIVE);
            let columns = [
                [w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
                [2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)],
                [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z],
            ];
            let column = |k: usize| columns[k].map(|entry| entry * f64::from(scale[k]) / square);
            [column(0), column(1), column(2), translation.map(f64::from)]
        }
    }
}

/// A place after a motion.
fn at([x, y, z, shift]: &Motion, place: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| shift[i] + place[0] * x[i] + place[1] * y[i] + place[2] * z[i])
}

/// A motion after another.
fn after(above: &Motion, below: &Motion) -> Motion {
    let [.., shift] = above;
    let turned = |column: [f64; 3]| {
        let moved = at(above, column);
        std::array::from_fn(|i| moved[i] - shift[i])
    };
    [turned(below[0]), turned(below[1]), turned(below[2]), at(above, below[3])]
}
