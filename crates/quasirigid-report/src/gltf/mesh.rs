//! Mesh of a piece, with a morph target for each coordinate that displaces it.

use quasirigid_io::record::{PieceRecord, VectorsRecord};
use serde_json::{Value, json};

use super::binary::Binary;
use super::solid::Solid;

/// Radius of points, and of lines, over that of the body, where the model gives none.
const POINT: f64 = 0.025;
const LINE: f64 = 0.006;
/// Kinds with a colour of their own; the last one is that of all others.
const COLOURS: [(&str, [f64; 4]); 6] = [
    ("carrier", [0.55, 0.6, 0.68, 1.0]),
    ("point", [0.85, 0.45, 0.1, 1.0]),
    ("panel", [0.1, 0.3, 0.55, 1.0]),
    ("liquid", [0.2, 0.55, 0.8, 0.6]),
    ("rotor", [0.5, 0.3, 0.55, 1.0]),
    ("", [0.6, 0.57, 0.52, 1.0]),
];

/// Mesh of a piece in the unit of the file.
pub(super) struct Mesh {
    places: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Coordinates of the morph targets, with the displacement of each place.
    pub targets: Vec<(usize, Vec<[f32; 3]>)>,
    names: Vec<String>,
    material: usize,
}

impl Mesh {
    /// The mesh; `scale` is the unit of the file per metre, `deformation` multiplies displacements.
    pub fn new(
        piece: &PieceRecord,
        radius: f64,
        scale: f64,
        deformation: f64,
        coordinates: &[usize],
    ) -> Self {
        let scaled = |vectors: &VectorsRecord, factor: f64| -> Vec<[f32; 3]> {
            vectors.unpack().iter().map(|vector| vector.map(|entry| (factor * entry) as f32)).collect()
        };
        let vertices = scaled(&piece.vertices, scale);
        let solid = solid(piece, &vertices, (radius * scale) as f32, scale as f32);
        let target = |coordinate: &usize| {
            let field = piece.fields.iter().find(|field| field.coordinate == *coordinate)?;
            let moved = scaled(&field.vectors, scale * deformation);
            Some((*coordinate, solid.owners.iter().map(|vertex| moved[*vertex]).collect()))
        };
        let targets: Vec<(usize, Vec<[f32; 3]>)> = coordinates.iter().filter_map(target).collect();
        let of_kind = |(kind, _): &(&str, [f64; 4])| *kind == piece.kind;
        Self {
            names: targets.iter().map(|(coordinate, _)| format!("coordinate {}", coordinate + 1)).collect(),
            targets,
            places: solid.places,
            triangles: solid.triangles,
            material: COLOURS.iter().position(of_kind).unwrap_or(COLOURS.len() - 1),
        }
    }

    /// The mesh in the document, with its arrays in the binary part.
    pub fn json(&self, binary: &mut Binary) -> Value {
        let targets: Vec<Value> =
            self.targets.iter().map(|(_, moved)| json!({ "POSITION": binary.vertices(moved) })).collect();
        let mut primitive = json!({
            "attributes": { "POSITION": binary.vertices(&self.places) },
            "indices": binary.triangles(&self.triangles),
            "material": self.material,
        });
        if targets.is_empty() {
            return json!({ "primitives": [primitive] });
        }
        primitive["targets"] = Value::Array(targets);
        json!({
            "primitives": [primitive],
            "weights": vec![0.0; self.targets.len()],
            "extras": { "targetNames": self.names },
        })
    }
}

/// Triangles of a piece; those of points and lines about them.
fn solid(piece: &PieceRecord, vertices: &[[f32; 3]], radius: f32, scale: f32) -> Solid {
    let given = piece.size.map(|size| size as f32 * scale);
    let mut solid = Solid::default();
    if let Some(triangles) = &piece.triangles {
        solid.places = vertices.to_vec();
        solid.owners = (0..vertices.len()).collect();
        solid.triangles =
            triangles.0.as_chunks::<3>().0.iter().map(|corners| corners.map(u32::from)).collect();
    }
    if let Some(lines) = &piece.lines {
        for line in lines.0.as_chunks::<2>().0 {
            let ends = line.map(usize::from);
            solid.rod(ends, ends.map(|vertex| vertices[vertex]), given.unwrap_or(LINE as f32 * radius));
        }
    }
    if piece.triangles.is_none() && piece.lines.is_none() {
        for (vertex, place) in vertices.iter().enumerate() {
            solid.sphere(vertex, *place, given.unwrap_or(POINT as f32 * radius));
        }
    }
    solid
}

/// Materials of the kinds.
pub(super) fn materials() -> Value {
    let material = |(kind, colour): &(&str, [f64; 4])| {
        let mut material = json!({
            "name": if kind.is_empty() { "other" } else { kind },
            "doubleSided": true,
            "pbrMetallicRoughness": { "baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": 0.8 },
        });
        if colour[3] < 1.0 {
            material["alphaMode"] = json!("BLEND");
        }
        material
    };
    COLOURS.iter().map(material).collect()
}
