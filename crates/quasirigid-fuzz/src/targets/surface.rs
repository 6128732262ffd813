//! Surfaces of triangles, and the bodies that they bound.

use std::path::Path;

use quasirigid_io::mesh::triangles_of;
use quasirigid_mesh::surface::repaired;

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

/// Words of VRML files.
pub const VRML: &[&str] = &[
    "#VRML V2.0 utf8\n",
    "#VRML V1.0 ascii\n",
    "Separator {",
    "Transform {",
    "translation 0 0 0 ",
    "IndexedFaceSet {",
    "coord Coordinate { point [",
    "Coordinate3 { point [",
    "coordIndex [",
    "DEF A ",
    "USE A ",
    "ccw FALSE",
    "-1 ",
    "] }",
];

/// Words of glTF files.
pub const GLTF: &[&str] = &[
    "{\"asset\":{\"version\":\"2.0\"},",
    "\"scenes\":[{\"nodes\":[0]}],",
    "\"nodes\":[{\"mesh\":0}],",
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],",
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:;base64,",
    "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}],",
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}]",
    "\"children\":[0]",
    "\"byteStride\":",
];

/// Words of surfaces of VTK.
pub const VTP: &[&str] = &[
    "<VTKFile type=\"PolyData\">",
    "<PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\">",
    "<Points><DataArray type=\"Float64\" format=\"ascii\">",
    "<Polys><DataArray type=\"Int32\" Name=\"connectivity\">",
    "<DataArray type=\"Int32\" Name=\"offsets\">",
    "</DataArray>",
    "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\n",
    "POINTS 3 double\n",
    "POLYGONS 1 4\n",
    "TRIANGLE_STRIPS 1 4\n",
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
    match repaired(mesh.vertices, mesh.triangles) {
        Ok((surface, _)) => {
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
