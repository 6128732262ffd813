//! Surfaces as XML (`.vtp`): points, polygons and strips of triangles.

use super::super::poly::Polygons;
use super::*;

/// A surface of VTK as XML, piece after piece.
pub(in crate::mesh) fn read(bytes: &[u8]) -> Result<Polygons, Fault> {
    let (header, appended) = split(bytes);
    let document = parsed(text(&header)?)?;
    let file = File::new(&document, appended, "PolyData")?;
    let surface = file.child(document.root_element(), "PolyData")?;
    let mut polygons = Polygons::default();
    for piece in surface.children().filter(|child| child.has_tag_name("Piece")) {
        let points = file.count(piece, "NumberOfPoints")?.saturating_mul(3);
        if points == 0 {
            continue;
        }
        let places = file.child(file.child(piece, "Points")?, "DataArray")?;
        let first = polygons.points(file.array(places, points)?.has(points)?)?;
        for (tag, count) in [("Polys", "NumberOfPolys"), ("Strips", "NumberOfStrips")] {
            let Some(listed) = piece.children().find(|child| child.has_tag_name(tag)) else { continue };
            let cells = if piece.has_attribute(count) { file.count(piece, count)? } else { 0 };
            if cells == 0 {
                continue;
            }
            let array = |name: &str| {
                let mut arrays = listed.children().filter(|child| child.has_tag_name("DataArray"));
                let array = arrays.find(|array| array.attribute("Name") == Some(name));
                array.ok_or_else(|| file.lacks(listed, &format!("<DataArray Name={name:?}>")))
            };
            let corners = file.array(array("connectivity")?, u64::MAX)?;
            let ends = file.array(array("offsets")?, cells)?.has(cells)?;
            polygons.cells(&corners, &ends, first, tag == "Strips")?;
        }
        for (tag, count) in [("vertices", "NumberOfVerts"), ("lines", "NumberOfLines")] {
            polygons.left_out(tag, if piece.has_attribute(count) { file.count(piece, count)? } else { 0 });
        }
    }
    Ok(polygons)
}
