//! Animation of a track: attitude of the body and weights of the morph targets.

use quasirigid_io::record::TrackRecord;
use serde_json::{Value, json};

use super::binary::Binary;
use super::mesh::Mesh;

/// Frames of an animation.
pub(super) struct Animation<'a> {
    track: &'a TrackRecord,
    /// Number of coordinates in a frame.
    count: usize,
    times: Vec<f32>,
}

impl<'a> Animation<'a> {
    /// Frames of a track whose whole takes `duration` (s).
    pub fn new(track: &'a TrackRecord, count: usize, duration: f64) -> Self {
        let times = &track.t.0;
        let (first, last) = (times[0], times[times.len() - 1]);
        let pressed = |t: &f64| (duration * (t - first) / (last - first)) as f32;
        Self { track, count, times: times.iter().map(pressed).collect() }
    }

    /// The animation in the document: node 0 turns, and the node of each mesh with targets deforms.
    pub fn json(&self, meshes: &[Mesh], binary: &mut Binary) -> Value {
        let input = binary.times(&self.times);
        let turned = binary.rotations(&self.rotations());
        let mut samplers = vec![json!({ "input": input, "output": turned, "interpolation": "LINEAR" })];
        let mut channels = vec![json!({ "sampler": 0, "target": { "node": 0, "path": "rotation" } })];
        let deforming = meshes.iter().enumerate().filter(|(_, mesh)| !mesh.targets.is_empty());
        for (index, mesh) in deforming {
            let Some(q) = &self.track.q else { break };
            let frames = q.0.chunks_exact(self.count);
            let weights: Vec<f32> =
                frames.flat_map(|q| mesh.targets.iter().map(|(coordinate, _)| q[*coordinate])).collect();
            let output = binary.numbers(&weights);
            channels.push(
                json!({ "sampler": samplers.len(), "target": { "node": 1 + index, "path": "weights" } }),
            );
            samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
        }
        json!({ "name": self.track.system, "samplers": samplers, "channels": channels })
    }

    /// Attitudes, scalar last, each on the side of the one before.
    fn rotations(&self) -> Vec<[f32; 4]> {
        let mut before = [0.0, 0.0, 0.0, 1.0];
        let (quaternions, _) = self.track.attitude.0.as_chunks::<4>();
        let turned = quaternions.iter().map(|[w, x, y, z]| {
            let next = [*x, *y, *z, *w];
            let same: f32 = (0..4).map(|i| next[i] * before[i]).sum();
            before = if same < 0.0 { next.map(|entry| -entry) } else { next };
            before
        });
        turned.collect()
    }
}
