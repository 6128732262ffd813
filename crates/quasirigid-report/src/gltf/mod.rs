//! Body and motion as a binary glTF file, which Blender, browsers and phones open: a mesh for each piece, morph targets for the internal
//! coordinates, and one animation of the attitude and of the coordinates.
//! Format: glTF 2.0 of the Khronos Group. Points and lines become spheres and rods, since most viewers draw neither.

mod animation;
mod binary;
mod mesh;
mod solid;

use quasirigid_io::record::{SceneRecord, TrackRecord};
use serde_json::{Value, json};

use animation::Animation;
use binary::Binary;
use mesh::Mesh;

/// Most coordinates that are morph targets: what phones blend.
const MOST_TARGETS: usize = 8;
/// Largest displacement in the animation, as a share of the radius of the body: smaller ones are exaggerated to it.
const SHARE: f64 = 0.05;

/// Settings of a glTF file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GltfOptions {
    /// Duration of the animation (s), which the run is stretched or pressed to.
    pub duration: f64,
    /// Factor of the displacements; none for one that makes the largest a twentieth of the radius of the body.
    pub deformation: Option<f64>,
}

impl Default for GltfOptions {
    fn default() -> Self {
        Self { duration: 30.0, deformation: None }
    }
}

/// Most revolutions of the body from one frame to the next; none of a scene without frames. From one half on an animation shows the body
/// stroboscopically.
#[must_use]
pub fn revolutions_per_frame(scene: &SceneRecord) -> Option<f64> {
    let track = scene.track.as_ref()?;
    let spins = track
        .omega
        .0
        .chunks_exact(3)
        .map(|omega| omega.iter().map(|w| f64::from(*w).powi(2)).sum::<f64>().sqrt());
    let steps = track.t.0.windows(2).map(|pair| pair[1] - pair[0]);
    let turned = steps.zip(spins).map(|(step, spin)| step * spin / std::f64::consts::TAU);
    Some(turned.fold(0.0, f64::max))
}

/// Body and motion of a scene as a binary glTF file (`.glb`). Unit of length: the metre, or for large bodies the body's radius over ten.
#[must_use]
pub fn gltf(scene: &SceneRecord, options: &GltfOptions) -> Vec<u8> {
    let scale = if scene.radius > 100.0 || scene.radius < 0.01 { 10.0 / scene.radius } else { 1.0 };
    let coordinates = most_moving(scene);
    let deformation = options.deformation.unwrap_or_else(|| exaggeration(scene));
    let mut binary = Binary::default();
    let pieces = || scene.pieces.iter().filter(|piece| !piece.vertices.values.0.is_empty());
    let meshes: Vec<Mesh> =
        pieces().map(|piece| Mesh::new(piece, scene.radius, scale, deformation, &coordinates)).collect();
    let children: Vec<usize> = (1..=meshes.len()).collect();
    let mut nodes = vec![json!({ "name": scene.name, "children": children })];
    nodes.extend(pieces().enumerate().map(|(index, piece)| {
        let name = if piece.name.is_empty() { &piece.kind } else { &piece.name };
        json!({ "name": name, "mesh": index })
    }));
    let animations: Vec<Value> = scene
        .track
        .as_ref()
        .filter(|track| track.t.0.len() > 1)
        .map(|track| {
            Animation::new(track, scene.coordinates.len(), options.duration).json(&meshes, &mut binary)
        })
        .into_iter()
        .collect();
    let primitives: Vec<Value> = meshes.iter().map(|mesh| mesh.json(&mut binary)).collect();
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "quasirigid" },
        "scene": 0,
        "scenes": [{ "name": scene.name, "nodes": [0] }],
        "nodes": nodes,
        "meshes": primitives,
        "materials": mesh::materials(),
        "extras": { "metres_per_unit": 1.0 / scale, "deformation": deformation },
    });
    if !animations.is_empty() {
        document["animations"] = Value::Array(animations);
    }
    binary.file(document)
}

/// Coordinates that displace the body most along the track, at most as many as are morph targets.
fn most_moving(scene: &SceneRecord) -> Vec<usize> {
    let sizes = displacements(scene);
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by(|a, b| sizes[*b].total_cmp(&sizes[*a]));
    order.truncate(MOST_TARGETS);
    order.sort_unstable();
    order
}

/// Factor that makes the largest displacement of the track visible; one where it is already, or where nothing moves.
fn exaggeration(scene: &SceneRecord) -> f64 {
    let largest = displacements(scene).into_iter().fold(0.0, f64::max);
    if largest > 0.0 { (SHARE * scene.radius / largest).max(1.0) } else { 1.0 }
}

/// Largest displacement (m) by each coordinate along the track.
fn displacements(scene: &SceneRecord) -> Vec<f64> {
    let count = scene.coordinates.len();
    let reach = |coordinate: usize| {
        let fields = scene.pieces.iter().flat_map(|piece| &piece.fields);
        let vectors = fields.filter(|field| field.coordinate == coordinate).map(|field| &field.vectors);
        vectors.fold(0.0_f64, |most, vectors| {
            let entries = vectors.values.0.iter().map(|entry| vectors.unit * f64::from(*entry).abs());
            entries.fold(most, f64::max)
        })
    };
    let moved = |track: &TrackRecord, coordinate: usize| {
        let q = track.q.as_ref().map_or(&[][..], |q| &q.0);
        q.iter().skip(coordinate).step_by(count).fold(0.0_f32, |most, q| most.max(q.abs()))
    };
    let size = |coordinate: usize| {
        let track = scene.track.as_ref();
        reach(coordinate) * track.map_or(0.0, |track| f64::from(moved(track, coordinate)))
    };
    (0..count).map(size).collect()
}
