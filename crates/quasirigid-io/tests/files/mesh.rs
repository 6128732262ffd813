//! One surface in every format reads as one mesh, and a damaged file is refused by line or byte.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid_io::mesh::{TriangleMesh, read_triangles, triangles_of};
use quasirigid_mesh::surface::ClosedSurface;
use tempfile::tempdir;

/// Sides of a cuboid off the origin; vertices are numbered as they first come up.
const SIDES: [[usize; 4]; 6] =
    [[0, 1, 2, 3], [4, 5, 6, 7], [0, 4, 7, 1], [3, 2, 6, 5], [0, 3, 5, 4], [1, 7, 6, 2]];
const VERTICES: [[f64; 3]; 8] = [
    [-0.5, 0.25, -3.0],
    [-0.5, 0.25, 1.0],
    [-0.5, 2.0, 1.0],
    [-0.5, 2.0, -3.0],
    [1.25, 0.25, -3.0],
    [1.25, 2.0, -3.0],
    [1.25, 2.0, 1.0],
    [1.25, 0.25, 1.0],
];

fn cuboid() -> TriangleMesh {
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    TriangleMesh {
        vertices: VERTICES.to_vec(),
        triangles: SIDES.into_iter().flat_map(halves).collect(),
        ..TriangleMesh::default()
    }
}

fn obj() -> String {
    let mut text = String::from("# cuboid\nmtllib none\no cuboid\n");
    VERTICES.iter().for_each(|[x, y, z]| writeln!(text, "v {x} {y} {z}").unwrap());
    SIDES
        .iter()
        .for_each(|[a, b, c, d]| writeln!(text, "f {} {} {} {}", a + 1, b + 1, c + 1, d + 1).unwrap());
    text
}

fn stl_text() -> String {
    let mut text = String::from("solid cuboid of sides\n");
    for triangle in cuboid().triangles {
        text.push_str("  facet normal 0 0 1\n    outer loop\n");
        let corners = triangle.map(|corner| VERTICES[corner]);
        corners.iter().for_each(|[x, y, z]| writeln!(text, "      vertex {x:e} {y:e} {z:e}").unwrap());
        text.push_str("    endloop\n  endfacet\n");
    }
    text + "endsolid cuboid of sides\n"
}

fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid names also begin binary files".to_vec();
    bytes.resize(80, 0);
    bytes.extend(12u32.to_le_bytes());
    for triangle in cuboid().triangles {
        bytes.extend([0; 12]);
        bytes.extend(
            triangle.iter().flat_map(|corner| VERTICES[*corner]).flat_map(|x| (x as f32).to_le_bytes()),
        );
        bytes.extend([7, 7]);
    }
    bytes
}

fn ply_text() -> String {
    let mut text = String::from(
        "ply\nformat ascii 1.0\ncomment cuboid\nelement vertex 8\nproperty float y\nproperty double x\nproperty uchar red\n\
         property float z\nelement face 6\nproperty uchar quality\nproperty list uchar int vertex_indices\nend_header\n",
    );
    VERTICES.iter().for_each(|[x, y, z]| writeln!(text, "{y} {x} 255 {z}").unwrap());
    SIDES.iter().for_each(|[a, b, c, d]| writeln!(text, "9 4 {a} {b} {c} {d}").unwrap());
    text
}

/// Values of several types around the coordinates and the corners, and an element that is not needed.
fn ply_binary(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\nelement vertex 8\r\nproperty short flag\r\nproperty double x\r\n\
         property float y\r\nproperty double z\r\nelement edge 2\r\nproperty list ushort char ends\r\nproperty int8 n\r\n\
         element face 12\r\nproperty list uint uint16 vertex_index\r\nproperty list uint8 double uv\r\nend_header\r\n"
    )
    .into_bytes();
    let mut put = |value: &[u8]| match big {
        true => bytes.extend(value.iter().rev()),
        false => bytes.extend(value),
    };
    for [x, y, z] in VERTICES {
        put(&(-300i16).to_le_bytes());
        put(&x.to_le_bytes());
        put(&(y as f32).to_le_bytes());
        put(&z.to_le_bytes());
    }
    for ends in [2u16, 0] {
        put(&ends.to_le_bytes());
        (0..=ends).for_each(|_| put(&(-1i8).to_le_bytes()));
    }
    for triangle in cuboid().triangles {
        put(&3u32.to_le_bytes());
        triangle.iter().for_each(|corner| put(&(*corner as u16).to_le_bytes()));
        put(&[1]);
        put(&f64::NAN.to_le_bytes());
    }
    bytes
}

fn plates(together: bool) -> String {
    let mut text = if together { "8 12\n".to_owned() } else { " 8\r\n".to_owned() };
    (1..).zip(VERTICES).for_each(|(n, [x, y, z])| writeln!(text, "  {n} {x:.6} {y:.6} {z:.6}").unwrap());
    if !together {
        text.push_str("12\n");
    }
    let triangles = (1..).zip(cuboid().triangles);
    triangles.for_each(|(n, [a, b, c])| writeln!(text, "{n}, {}, {}, {}", a + 1, b + 1, c + 1).unwrap());
    text
}

/// Every format once.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("cuboid.obj", obj().into()),
        ("cuboid.stl", stl_text().into()),
        ("cuboid.stl", stl_binary()),
        ("cuboid.ply", ply_text().into()),
        ("cuboid.ply", ply_binary(false)),
        ("cuboid.ply", ply_binary(true)),
        ("cuboid.tab", plates(true).into()),
        ("cuboid.plt", plates(false).into()),
    ]
}

fn says(name: &str, bytes: impl AsRef<[u8]>) -> String {
    triangles_of(Path::new(name), bytes.as_ref()).unwrap_err().to_string()
}

#[test]
fn every_format_gives_the_same_mesh() {
    let folder = tempdir().unwrap();
    for (name, bytes) in files() {
        let file = folder.path().join(name);
        fs::write(&file, &bytes).unwrap();
        assert_eq!(read_triangles(&file).unwrap(), cuboid(), "{name}");
        for other in ["cuboid", "cuboid.txt", "cuboid.OBJECT"] {
            assert_eq!(triangles_of(Path::new(other), &bytes).unwrap(), cuboid(), "{name} as {other}");
        }
    }
    let cuboid = cuboid();
    assert!((ClosedSurface::new(cuboid.vertices, cuboid.triangles).unwrap().volume() - 12.25).abs() < 1e-14);
}

#[test]
fn obj_has_many_ways_to_write_a_face() {
    let text = "\u{feff}vn 0 0 1\r\nv 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nf -2/1/1 -1//1 3\r\nv 0 1 \\\r\n 0 # corner\r\n\
                g side\r\nf 1/2 \\\r\n 2/2 \\\r\n -1/2\r\n# no \\\r\nv 9 9 9\r\n";
    let mesh = triangles_of(Path::new("a.obj"), text.as_bytes()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 2]]);
    assert_eq!(mesh.vertices, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3]]);
}

/// Corners of STL meet where they have the same bits, and nowhere else; zero has one sign.
#[test]
fn stl_corners_meet_exactly() {
    let facet = |a: &str, b: &str| {
        format!("facet normal 0 0 0\nouter loop\nvertex {a}\nvertex 1 0 0\nvertex {b}\nendloop\nendfacet\n")
    };
    let text = format!(
        "solid\n{}{}endsolid\n",
        facet("0 0 0", "0 1 0"),
        facet("-0 0 -0.0", "0 1.0000000000000002 0")
    );
    let mesh = triangles_of(Path::new("a.stl"), text.as_bytes()).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 1, 3]]);
}

#[test]
fn plate_tables_may_have_the_exponents_of_fortran() {
    let text = plates(true).replace("-3.000000", "-0.3D+01").replace("1.250000", "1.25d0");
    assert_eq!(triangles_of(Path::new("a.tab"), text.as_bytes()).unwrap(), cuboid());
}

#[test]
fn files_that_are_no_surface_are_refused() {
    let folder = tempdir().unwrap();
    let without_folder = |name: &str| {
        let error = read_triangles(&folder.path().join(name)).unwrap_err().to_string();
        error.replace(&folder.path().display().to_string(), "[folder]")
    };
    assert_snapshot!(without_folder("none.obj"), @"[folder]/none.obj: entity not found; is the name right, and is the file readable?");
    assert_snapshot!(without_folder(""), @"[folder]/: this is a folder; give the file of the mesh inside it");
    assert_snapshot!(says("a.obj", ""), @"a.obj: the file is empty; was its download cut off?");
    assert_snapshot!(says("a.ply", "\n \n"), @"a.ply: the file is empty; was its download cut off?");
    assert_snapshot!(says("a.html", "<!doctype html><html lang=en>"), @"a.html: the file is a web page, which is not a known surface format; give an OBJ, STL, PLY, OFF, VRML, glTF or VTK file, or a plate table");
    assert_snapshot!(says("a.stl", "dear reader, this is no surface"), @"a.stl: the file is text, which is not a known surface format; give an OBJ, STL, PLY, OFF, VRML, glTF or VTK file, or a plate table");
    assert_snapshot!(says("a.obj", b"v 0 0 0\n# caf\xE9\n"), @"a.obj: the file has no faces; export the surface as triangles");
    assert_snapshot!(says("a.obj", b"v 0\0 0 0\n"), @"a.obj: the file is binary, which is not a known surface format; give an OBJ, STL, PLY, OFF, VRML, glTF or VTK file, or a plate table");
    assert_snapshot!(says("a.obj", "v 0 0 0\nv 1 0 0\n"), @"a.obj: the file has no faces; export the surface as triangles");
    assert_snapshot!(says("a.txt", "3 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n"), @"a.txt: the file has no faces; export the surface as triangles");
}

#[test]
fn errors_in_obj_have_their_line() {
    let with = |line: &str| says("a.obj", format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 3\n"));
    assert_snapshot!(with("v 1 2"), @"a.obj:4: 2 values; a vertex is written v x y z");
    assert_snapshot!(with("v 1 2 z"), @r#"a.obj:4: "z" is not a number; a vertex is written v x y z"#);
    assert_snapshot!(with("v 1 2 1e999"), @"a.obj:4: the coordinate 1e999 is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(with("v nan 2 1"), @"a.obj:4: the coordinate nan is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(with("f 1 2 \\\n4 3"), @"a.obj:4: there is no vertex 4; 3 vertices are numbered from 1 here");
    assert_snapshot!(with("f 1 2 0"), @"a.obj:5: there is no vertex 3; 3 vertices are numbered from 0 here");
    assert_snapshot!(with("f 1 2 -4"), @"a.obj:4: there is no vertex -4; 3 vertices are numbered from 1 here");
    assert_snapshot!(with("f 1 2 99999999999999999999"), @"a.obj:4: there is no vertex 99999999999999999999; 3 vertices are numbered from 1 here");
    assert_snapshot!(with("f 1 2 x/1"), @r#"a.obj:4: "x/1" is not a number; a face is written f a b c, or f a/t/n b/t/n c/t/n"#);
}

#[test]
fn errors_in_stl_have_their_line_or_byte() {
    let with = |lines: &str| says("a.stl", format!("solid\nfacet normal 0 0 1\nouter loop\n{lines}"));
    let corners = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
    assert_snapshot!(with("vertex 1 2\n"), @"a.stl:4: 2 values; a corner is written vertex x y z");
    assert_snapshot!(with("vertex 1 2 inf\n"), @"a.stl:4: the coordinate inf is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(with("corner 1 2 3\n"), @r#"a.stl:4: "corner 1 2 3" is not allowed here; a facet is written facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet"#);
    assert_snapshot!(with("vertex 0 0 0\nendloop\nendfacet\n"), @"a.stl:6: a facet of 1 corners; STL has triangles only");
    assert_snapshot!(with(&format!("{corners}facet normal 0 0 1\n")), @r#"a.stl:7: "facet normal 0 0 1" is not allowed here; a facet is written facet normal x y z, outer loop, three times vertex x y z, endloop, endfacet"#);
    assert_snapshot!(with(&format!("{corners}endloop\nendfacet\n")), @"a.stl:8: the file ends without endsolid; was it cut off?");
    let changed = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = stl_binary();
        change(&mut bytes);
        says("a.stl", bytes)
    };
    assert_snapshot!(changed(&|bytes| bytes.truncate(83)), @"a.stl: byte 83: the file ends after 0 of 1 faces; was it cut off, or is the number wrong?");
    assert_snapshot!(changed(&|bytes| bytes.truncate(200)), @"a.stl: byte 200: the file ends after 2 of 12 faces; was it cut off, or is the number wrong?");
    assert_snapshot!(changed(&|bytes| bytes.push(0)), @"a.stl: byte 684: more follows the 12 faces announced; is that number right?");
    assert_snapshot!(changed(&|bytes| bytes[150..154].copy_from_slice(&f32::NAN.to_le_bytes())), @"a.stl: byte 150: the coordinate NaN is not finite; leave out this vertex and its faces, and close the gap");
}

#[test]
fn errors_in_ply_have_their_line_or_byte() {
    let with = |from: &str, to: &str| says("a.ply", ply_text().replacen(from, to, 1));
    assert_snapshot!(with("ascii", "text"), @r#"a.ply:2: "format text 1.0" is not allowed here in a PLY header; after ply come format (ascii, binary_little_endian or binary_big_endian) 1.0, element NAME COUNT, property TYPE NAME or property list TYPE TYPE NAME, end_header"#);
    assert_snapshot!(with("vertex 8", "vertex -8"), @r#"a.ply:4: "element vertex -8" is not allowed here in a PLY header; after ply come format (ascii, binary_little_endian or binary_big_endian) 1.0, element NAME COUNT, property TYPE NAME or property list TYPE TYPE NAME, end_header"#);
    assert_snapshot!(with("end_header", "comment"), @r#"a.ply:13: "0.25 -0.5 255 -3" is not allowed here in a PLY header; after ply come format (ascii, binary_little_endian or binary_big_endian) 1.0, element NAME COUNT, property TYPE NAME or property list TYPE TYPE NAME, end_header"#);
    assert_snapshot!(says("a.ply", "ply\nformat ascii 1.0\nelement ver"), @"a.ply:3: the header has no end_header; was the file cut off?");
    assert_snapshot!(with("float z", "float w"), @"a.ply:12: the vertices lack x, y or z; add it when you export the surface");
    assert_snapshot!(with("vertex_indices", "corners"), @"a.ply:12: the faces lack the list vertex_indices; add it when you export the surface");
    assert_snapshot!(with("element face 6", "element strip 6"), @"a.ply:12: the file has no faces; export the surface as triangles");
    assert_snapshot!(with("0.25 -0.5 255 -3", "0.25 -0.5 255"), @"a.ply:13: 3 values; the line of an element has one value for each of its properties, and lists begin with their length");
    assert_snapshot!(with("0.25 -0.5 255 -3", "0.25 -0.5 255 -3 0"), @"a.ply:13: 5 values; the line of an element has one value for each of its properties, and lists begin with their length");
    assert_snapshot!(with("0.25 -0.5 255 -3", "0.25 -inf 255 -3"), @"a.ply:13: the coordinate -inf is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(with("9 4 0 1 2 3", "9 4 0 8 2 3"), @"a.ply:21: there is no vertex 8; 8 vertices are numbered from 0 here");
    assert_snapshot!(with("9 4 0 1 2 3", "9 4 0 -1 2 3"), @"a.ply:21: there is no vertex -1; 8 vertices are numbered from 0 here");
    assert_snapshot!(with("9 4 0 1 2 3", "9 -4 0 1 2 3"), @"a.ply:21: a list cannot have -4 entries; is the header right about the types?");
    assert_snapshot!(with("9 4 0 1 2 3", "9 4000000 0 1 2 3"), @"a.ply:21: 6 values; the line of an element has one value for each of its properties, and lists begin with their length");
    assert_snapshot!(with("face 6", "face 5"), @"a.ply:26: more follows the 5 faces announced; is that number right?");
    assert_snapshot!(with("face 6", "face 7"), @"a.ply:26: the file ends after 6 of 7 faces; was it cut off, or is the number wrong?");
    let changed = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = ply_binary(true);
        change(&mut bytes);
        says("a.ply", bytes)
    };
    let body = String::from_utf8_lossy(&ply_binary(true)).find("end_header\r\n").unwrap() + 12;
    assert_eq!(body, 295);
    assert_snapshot!(changed(&|bytes| bytes.truncate(body + 40)), @"a.ply: byte 335: the file ends after 1 of 8 vertices; was it cut off, or is the number wrong?");
    assert_snapshot!(changed(&|bytes| bytes.truncate(body + 177)), @r#"a.ply: byte 472: the file ends after 0 of 2 elements "edge"; was it cut off, or is the number wrong?"#);
    assert_snapshot!(changed(&|bytes| bytes.push(0)), @"a.ply: byte 707: more follows the 12 faces announced; is that number right?");
    assert_snapshot!(changed(&|bytes| bytes[body + 2..body + 10].fill(0xFF)), @"a.ply: byte 297: the coordinate NaN is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(changed(&|bytes| bytes[body + 188] = 0x20), @"a.ply: byte 483: there is no vertex 8192; 8 vertices are numbered from 0 here");
}

#[test]
fn errors_in_plate_tables_have_their_line() {
    let with = |from: &str, to: &str| says("a.tab", plates(false).replacen(from, to, 1));
    assert_snapshot!(with(" 8\r\n", "8 12 4\n"), @"a.tab:1: 3 values; the first line has the number of vertices, then perhaps the number of faces");
    assert_snapshot!(with(" 8\r\n", "eight\n"), @r#"a.tab:1: "eight" is not a number; the first line has the number of vertices, then perhaps the number of faces"#);
    assert_snapshot!(with(" 8\r\n", "9\n"), @"a.tab:10: 1 values; a vertex is written number x y z, or x y z, alike in all rows, as often as the first line says");
    assert_snapshot!(with("  3 ", "  4 "), @"a.tab:4: number 4 appears where 3 should; rows are numbered from 0 or 1 without a gap");
    assert_snapshot!(with("1.250000", "NaN"), @"a.tab:6: the coordinate NaN is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(with("  3 -0.5", "  3 0 -0.5"), @"a.tab:4: 5 values; a vertex is written number x y z, or x y z, alike in all rows, as often as the first line says");
    assert_snapshot!(with("\n12\n", "\n13\n"), @"a.tab:22: the file ends after 12 of 13 faces; was it cut off, or is the number wrong?");
    assert_snapshot!(with("\n12\n", "\n11\n"), @"a.tab:22: more follows the 11 faces announced; is that number right?");
    assert_snapshot!(with("1, 1, 2, 3", "1, 0, 2, 3"), @"a.tab:14: there is no vertex 8; 8 vertices are numbered from 0 here");
    assert_snapshot!(with("1, 1, 2, 3", "1, 1, 2, 9"), @"a.tab:11: there is no vertex 9; 8 vertices are numbered from 1 here");
    assert_snapshot!(with("1, 1, 2, 3", "1, 1, 2.5, 3"), @r#"a.tab:11: "2.5" is not a number; a face is written number a b c, or a b c, alike in all rows"#);
}

/// A header costs nothing: memory and time follow the bytes that are there.
#[test]
fn a_billion_announced_is_not_a_billion_taken() {
    let billion = "1000000000";
    let text = ply_text().replacen("vertex 8", &format!("vertex {billion}"), 1);
    assert_snapshot!(says("a.ply", text), @"a.ply:21: 6 values; the line of an element has one value for each of its properties, and lists begin with their length");
    let binary = |from: &str, to: &str| {
        let (bytes, from) = (ply_binary(false), from.as_bytes());
        let at = bytes.windows(from.len()).position(|part| part == from).unwrap();
        says("a.ply", [&bytes[..at], to.as_bytes(), &bytes[at + from.len()..]].concat())
    };
    assert_snapshot!(binary("vertex 8", &format!("vertex {billion}")), @"a.ply: byte 673: the coordinate NaN is not finite; leave out this vertex and its faces, and close the gap");
    assert_snapshot!(binary("face 12", &format!("face {billion}")), @"a.ply: byte 718: the file ends after 12 of 1000000000 faces; was it cut off, or is the number wrong?");
    assert_snapshot!(binary("element edge 2", &format!("element none {billion}\r\nelement edge {billion}")), @r#"a.ply: byte 744: the file ends after 6 of 1000000000 elements "edge"; was it cut off, or is the number wrong?"#);
    assert_snapshot!(says("a.tab", format!("{billion} {billion}\n1 0 0 0\n")), @"a.tab:2: the file ends after 1 of 1000000000 vertices; was it cut off, or is the number wrong?");
    let mut stl = stl_binary();
    stl[80..84].copy_from_slice(&1_000_000_000u32.to_le_bytes());
    assert_snapshot!(says("a.stl", stl), @"a.stl: byte 684: the file ends after 12 of 1000000000 faces; was it cut off, or is the number wrong?");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) })]

    #[test]
    fn random_bytes_never_panic(bytes in vec(any::<u8>(), 0..400), name in 0..8usize) {
        let (name, file) = &files()[name];
        let _ = triangles_of(Path::new(name), &bytes);
        let _ = triangles_of(Path::new(name), &[&file[..file.len().min(330)], &bytes].concat());
    }

    #[test]
    fn random_text_never_panics(text in "(ply|solid|[vf]|facet|vertex|[0-9.eD/+-]{1,5}|[ \n\\\\#,]|\\PC){0,80}", name in 0..8usize) {
        let _ = triangles_of(Path::new(files()[name].0), text.as_bytes());
    }

    /// A mesh that survives a cut or a change has corners that exist and vertices that are finite.
    #[test]
    fn damaged_files_are_refused_or_whole(
        name in 0..8usize, end in 0.0..1.5f64, changes in vec((0.0..1.0f64, any::<u8>()), 0..4),
    ) {
        let (name, mut bytes) = files().swap_remove(name);
        let place = |part: f64| ((bytes.len() as f64 * part) as usize).min(bytes.len());
        let (end, changes): (usize, Vec<_>) = (place(end), changes.iter().map(|(at, byte)| (place(*at), *byte)).collect());
        changes.into_iter().for_each(|(at, byte)| bytes[at] = byte);
        bytes.truncate(end);
        if let Ok(mesh) = triangles_of(Path::new(name), &bytes) {
            prop_assert!(mesh.triangles.iter().flatten().all(|corner| *corner < mesh.vertices.len()));
            prop_assert!(mesh.vertices.iter().flatten().all(|x| x.is_finite()));
        }
    }
}

/// The radar shape model of Apophis, where it lies beside the repository.
#[test]
fn a_radar_shape_model_is_a_closed_surface() {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/reference/apophis-radar-shape.obj");
    if !file.exists() {
        println!("skipped: no {}", file.display());
        return;
    }
    let mesh = read_triangles(&file).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (2000, 3996));
    let surface = ClosedSurface::new(mesh.vertices, mesh.triangles).unwrap();
    assert_eq!(surface.edges().count(), 5994);
}
