//! Surfaces of triangles, and the bodies that they bound.

use std::path::Path;

use quasirigid_io::mesh::triangles_of;
use quasirigid_mesh::surface::ClosedSurface;

/// Words of PLY files.
pub const PLY: &[&str] = &[
    "ply\n",
    "format ascii 1.0\n",
    "format binary_little_endian 1.0\n",
    "format binary_big_endian 1.0\n",
    "element vertex ",
    "element face ",
    "property float x\n",
    "property list uchar int vertex_indices\n",
    "property list uint double ",
    "end_header\n",
    "comment ",
];

/// Most triangles of a surface that is taken further than its file.
const MAX_TRIANGLES: usize = 2000;

pub fn read(name: &str, bytes: &[u8]) {
    let mesh = match triangles_of(Path::new(name), bytes) {
        Ok(mesh) => mesh,
        Err(error) => return assert!(error.to_string().starts_with(name), "{error}"),
    };
    assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()), "vertices are finite");
    assert!(mesh.triangles.iter().flatten().all(|corner| *corner < mesh.vertices.len()), "corners exist");
    if mesh.triangles.len() > MAX_TRIANGLES {
        return;
    }
    match ClosedSurface::new(mesh.vertices, mesh.triangles) {
        Ok(surface) => {
            assert!(
                surface.volume() > 0.0 || surface.volume() == f64::INFINITY || surface.volume() == 0.0,
                "{}",
                surface.volume()
            );
            let _ = (surface.centroid(), surface.bodies(), surface.is_convex());
        }
        Err(error) => drop(error.to_string()),
    }
}
