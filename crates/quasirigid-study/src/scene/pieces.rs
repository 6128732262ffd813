//! Visual geometry of the elements, packed.

use quasirigid::elements::Visual;
use quasirigid_io::record::{FieldRecord, Packed, PieceRecord, RotorAxisRecord, VectorsRecord};
use quasirigid_io::visible::one_line;

use super::kept::Kept;

/// Cyclic coordinates of the rotors that are drawn, in order.
pub(super) fn rotors(visuals: &[Visual]) -> Vec<usize> {
    visuals.iter().filter_map(|visual| visual.turning.map(|turning| turning.coordinate)).collect()
}

/// Piece of a scene.
pub(super) fn piece(visual: &Visual, kept: &Kept, rotors: &[usize]) -> PieceRecord {
    let field = |(coordinate, vectors): &(usize, Vec<[f64; 3]>)| {
        Some(FieldRecord { coordinate: kept.place(*coordinate)?, vectors: VectorsRecord::pack(vectors) })
    };
    let turning = visual.turning.and_then(|turning| {
        let rotor = rotors.iter().position(|rotor| *rotor == turning.coordinate)?;
        Some(RotorAxisRecord { axis: turning.axis, center: turning.center, rotor })
    });
    PieceRecord {
        name: one_line(&visual.name),
        kind: if visual.kind == "cavity" { "liquid" } else { visual.kind }.into(),
        vertices: VectorsRecord::pack(&visual.vertices),
        triangles: indices(&visual.triangles),
        lines: indices(&visual.lines),
        size: visual.radius,
        fields: visual.shapes.iter().filter_map(field).collect(),
        turning,
    }
}

/// Groups of vertices; none where there are none, or where a vertex has too large a number.
fn indices<const N: usize>(groups: &[[usize; N]]) -> Option<Packed<u16>> {
    let flat: Option<Vec<u16>> =
        groups.as_flattened().iter().map(|index| u16::try_from(*index).ok()).collect();
    flat.filter(|flat| !flat.is_empty()).map(Packed)
}
