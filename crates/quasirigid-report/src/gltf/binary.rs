//! Binary part of a glTF file: arrays with their accessors, and the container of both parts.

use serde_json::{Value, json};

/// Arrays of a file.
#[derive(Default)]
pub(super) struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

/// Component types.
const FLOAT: u32 = 5126;
const UNSIGNED: u32 = 5125;
/// Targets of buffers.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;

impl Binary {
    /// Vectors of vertices; returns the accessor.
    pub fn vertices(&mut self, vectors: &[[f32; 3]]) -> usize {
        let bounds = |pick: fn(f32, f32) -> f32| {
            let first = vectors.first().copied().unwrap_or_default();
            vectors
                .iter()
                .fold(first, |sum, vector| std::array::from_fn(|axis| pick(sum[axis], vector[axis])))
        };
        let accessor = self.accessor(vectors.as_flattened(), FLOAT, "VEC3", vectors.len(), Some(VERTICES));
        self.accessors[accessor]["min"] = json!(bounds(f32::min));
        self.accessors[accessor]["max"] = json!(bounds(f32::max));
        accessor
    }

    /// Indices of triangles; returns the accessor.
    pub fn triangles(&mut self, triangles: &[[u32; 3]]) -> usize {
        let flat = triangles.as_flattened();
        let view = self.view(flat.iter().flat_map(|index| index.to_le_bytes()), Some(INDICES));
        self.accessors.push(json!({
            "bufferView": view, "componentType": UNSIGNED, "count": flat.len(), "type": "SCALAR",
        }));
        self.accessors.len() - 1
    }

    /// Times of frames; returns the accessor.
    pub fn times(&mut self, times: &[f32]) -> usize {
        let accessor = self.accessor(times, FLOAT, "SCALAR", times.len(), None);
        self.accessors[accessor]["min"] = json!([times.first()]);
        self.accessors[accessor]["max"] = json!([times.last()]);
        accessor
    }

    /// Unit quaternions of frames, scalar last; returns the accessor.
    pub fn rotations(&mut self, rotations: &[[f32; 4]]) -> usize {
        self.accessor(rotations.as_flattened(), FLOAT, "VEC4", rotations.len(), None)
    }

    /// Numbers; returns the accessor.
    pub fn numbers(&mut self, numbers: &[f32]) -> usize {
        self.accessor(numbers, FLOAT, "SCALAR", numbers.len(), None)
    }

    fn accessor(
        &mut self,
        numbers: &[f32],
        component: u32,
        kind: &str,
        count: usize,
        target: Option<u32>,
    ) -> usize {
        let view = self.view(numbers.iter().flat_map(|number| number.to_le_bytes()), target);
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "count": count, "type": kind,
        }));
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// The file: a header, the document and the arrays, each chunk of a whole number of words.
    pub fn file(self, mut document: Value) -> Vec<u8> {
        document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        document["bufferViews"] = Value::Array(self.views);
        document["accessors"] = Value::Array(self.accessors);
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut arrays = self.bytes;
        arrays.resize(arrays.len().next_multiple_of(4), 0);
        let mut file = Vec::with_capacity(28 + text.len() + arrays.len());
        let size = |length: usize| (length as u32).to_le_bytes();
        file.extend(b"glTF");
        file.extend(2_u32.to_le_bytes());
        file.extend(size(28 + text.len() + arrays.len()));
        file.extend(size(text.len()));
        file.extend(b"JSON");
        file.extend(text);
        file.extend(size(arrays.len()));
        file.extend(b"BIN\0");
        file.extend(arrays);
        file
    }
}
