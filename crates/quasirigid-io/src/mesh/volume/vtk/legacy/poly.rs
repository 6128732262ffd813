//! Surfaces of legacy files: points, polygons and strips of triangles.

use super::super::poly::Polygons;
use super::*;

/// A surface of a legacy file.
pub(in crate::mesh) fn read(bytes: &[u8]) -> Result<Polygons, Fault> {
    let mut file = File { bytes, at: 0, start: 0, binary: false };
    let offsets = file.read_header()?;
    let (mut parts, mut cells, mut polygons) = (Parts::default(), Vec::new(), Polygons::default());
    while let Some(line) = file.line()? {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            ["DATASET", "POLYDATA"] => {}
            [kind @ ("POLYGONS" | "TRIANGLE_STRIPS" | "LINES" | "VERTICES"), count, size] => {
                let (count, size) = (file.count(count)?, file.count(size)?);
                let read = if offsets {
                    file.cells_by_offsets(count, size)
                } else {
                    file.counted_cells(count, size)
                };
                let (corners, ends) = read?;
                match *kind {
                    "LINES" => polygons.left_out("lines", count),
                    "VERTICES" => polygons.left_out("vertices", count),
                    kind => cells.push((corners, ends, kind == "TRIANGLE_STRIPS")),
                }
            }
            _ => file.read_part(line, offsets, &mut parts)?,
        }
    }
    let missing = || (file.end(), VolumeProblem::Missing { keyword: "POINTS".into() }.into());
    let first = polygons.points(parts.points.ok_or_else(missing)?)?;
    for (corners, ends, strips) in &cells {
        polygons.cells(corners, ends, first, *strips)?;
    }
    Ok(polygons)
}
