//! Consistency of a scene: lengths of its arrays, and numbers of vertices, coordinates and rotors that exist.

use super::scene::{FieldRecord, PieceRecord, SceneRecord, TrackRecord};

impl SceneRecord {
    /// What does not fit together in a scene that was read, if anything.
    pub(super) fn damage(&self) -> Option<String> {
        let coordinates = self.coordinates.len();
        let rotors = self
            .pieces
            .iter()
            .filter_map(|piece| piece.turning.as_ref())
            .map(|turning| turning.rotor + 1)
            .max();
        let pieces = self.pieces.iter().find_map(|piece| {
            let problem = of_piece(piece, coordinates)?;
            Some(format!("{problem} of the piece {:?}", piece.name))
        });
        pieces.or_else(|| of_track(self.track.as_ref()?, coordinates, rotors.unwrap_or(0)))
    }
}

fn of_piece(piece: &PieceRecord, coordinates: usize) -> Option<&'static str> {
    let numbers = piece.vertices.values.0.len();
    let joins = |joined: Option<&Vec<u16>>, corners: usize| {
        joined.is_none_or(|vertices| {
            vertices.len().is_multiple_of(corners)
                && vertices.iter().all(|vertex| usize::from(*vertex) < numbers / 3)
        })
    };
    let fits =
        |field: &FieldRecord| field.coordinate < coordinates && field.vectors.values.0.len() == numbers;
    let triangles = piece.triangles.as_ref().map(|packed| &packed.0);
    let lines = piece.lines.as_ref().map(|packed| &packed.0);
    [
        (numbers.is_multiple_of(3), "the vertices"),
        (joins(triangles, 3), "the triangles"),
        (joins(lines, 2), "the lines"),
        (piece.fields.iter().all(fits), "the displacements"),
    ]
    .into_iter()
    .find_map(|(fits, part)| (!fits).then_some(part))
}

fn of_track(track: &TrackRecord, coordinates: usize, rotors: usize) -> Option<String> {
    let frames = track.t.0.len();
    let angles = track.rotors.as_ref().map_or(0, |angles| angles.0.len());
    let per_frame = |numbers: usize, count: usize| numbers == frames * count;
    let fit = [
        per_frame(track.attitude.0.len(), 4),
        per_frame(track.omega.0.len(), 3),
        per_frame(track.momentum.0.len(), 3),
        per_frame(track.dissipated.0.len(), 1),
        track.q.as_ref().is_none_or(|q| per_frame(q.0.len(), coordinates)),
        track.rotors.is_none() || angles.is_multiple_of(frames.max(1)) && angles >= rotors * frames,
    ];
    fit.contains(&false).then(|| format!("the arrays of the history {:?}", track.system))
}
