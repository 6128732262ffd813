//! Visual geometry of the elements, packed.

use quasirigid::elements::Visual;
use quasirigid_io::record::{FieldRecord, Packed, PieceRecord, TurningRecord};

use super::kept::Kept;
use crate::visible::one_line;

/// Cyclic coordinates of the rotors that are drawn, in order.
pub(super) fn rotors(visuals: &[Visual]) -> Vec<usize> {
    visuals.iter().filter_map(|visual| visual.turning.map(|turning| turning.coordinate)).collect()
}

/// Piece of a scene.
pub(super) fn piece(visual: &Visual, kept: &Kept, rotors: &[usize]) -> PieceRecord {
    let field = |(coordinate, vectors): &(usize, Vec<[f64; 3]>)| {
        Some(FieldRecord { coordinate: kept.place(*coordinate)?, vectors: packed(vectors) })
    };
    let turning = visual.turning.and_then(|turning| {
        let rotor = rotors.iter().position(|rotor| *rotor == turning.coordinate)?;
        Some(TurningRecord { axis: turning.axis, center: turning.center, rotor })
    });
    PieceRecord {
        name: one_line(&visual.name),
        kind: if visual.kind == "cavity" { "liquid" } else { visual.kind }.into(),
        vertices: packed(&visual.vertices),
        triangles: indices(&visual.triangles),
        lines: indices(&visual.lines),
        size: visual.radius,
        fields: visual.shapes.iter().filter_map(field).collect(),
        turning,
    }
}

fn packed(vectors: &[[f64; 3]]) -> Packed<f32> {
    Packed(vectors.as_flattened().iter().map(|entry| *entry as f32).collect())
}

fn indices<const N: usize>(groups: &[[usize; N]]) -> Option<Packed<u32>> {
    let flat = groups.as_flattened().iter().map(|index| *index as u32);
    (!groups.is_empty()).then(|| Packed(flat.collect()))
}
