//! One shape in every format, with every defect that repair knows: each cell of the matrix is the same body, and says what was done.

use std::fmt::Write;
use std::path::Path;

use quasirigid_io::mesh::triangles_of;
use quasirigid_mesh::surface::{Repairs, repaired};

pub(super) type Soup = (Vec<[f64; 3]>, Vec<[usize; 3]>);

/// A tetrahedron off the origin and off the axes; its coordinates are exact in 32 bits.
fn body() -> Soup {
    let vertices = vec![[0.5, 0.25, -1.0], [3.5, 0.5, -0.75], [0.25, 2.25, -0.5], [1.0, 0.75, 1.5]];
    (vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
}

/// Volume and the six second moments about the origin, by tetrahedra from the origin to each facet.
fn sums((vertices, triangles): &Soup) -> [f64; 7] {
    let mut sums = [0.0; 7];
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| vertices[corner]);
        let volume = (a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))
            / 6.0;
        sums[0] += volume;
        for (k, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
            let total = [a, b, c].map(|p| [p[i], p[j]]);
            let [x, y] = [0, 1].map(|axis| total.iter().map(|p| p[axis]).sum::<f64>());
            let products: f64 = total.iter().map(|[x, y]| x * y).sum();
            sums[1 + k] += volume * (x * y + products) / 20.0;
        }
    }
    sums
}

/// Count that a repair tells.
type Count = fn(&Repairs) -> usize;

/// Every defect, with the count that tells of it.
fn defects() -> Vec<(&'static str, Soup, Count, usize)> {
    let none: Count = |repairs| repairs.counts().len();
    let (vertices, triangles) = body();
    let changed = |change: &dyn Fn(&mut Soup)| {
        let mut soup = body();
        change(&mut soup);
        soup
    };
    let soup = || {
        let places = triangles.iter().flatten().map(|corner| vertices[*corner]).collect();
        (places, (0..4).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect())
    };
    vec![
        ("whole", body(), none, 0),
        ("corners apart", soup(), |repairs| repairs.merged, 8),
        ("a facet turned", changed(&|soup| soup.1[2].swap(0, 1)), |repairs| repairs.reversed, 1),
        (
            "inside out",
            changed(&|soup| soup.1.iter_mut().for_each(|t| t.swap(0, 1))),
            |repairs| repairs.inverted,
            1,
        ),
        ("a facet twice", changed(&|soup| soup.1.push([0, 2, 1])), |repairs| repairs.repeated, 1),
        ("a facet without area", changed(&|soup| soup.1.push([0, 2, 2])), |repairs| repairs.degenerate, 1),
        (
            "a corner apart by rounding",
            changed(&|soup| {
                let [x, y, z] = soup.0[3];
                soup.0.push([x, y, z + 2.0_f64.powi(-20)]);
                soup.1[1][2] = 4;
            }),
            |repairs| usize::from(repairs.merged > 0 && repairs.within > 0.0),
            1,
        ),
        ("a corner unused", changed(&|soup| soup.0.push([9.0; 3])), |repairs| repairs.unused, 1),
    ]
}

fn rows(values: impl IntoIterator<Item = String>, end: &str) -> String {
    values.into_iter().fold(String::new(), |mut text, row| {
        write!(text, "{row}{end}").unwrap();
        text
    })
}

/// The shape in every form with corners that facets share; names tell the form.
pub(super) fn files(soup: &Soup) -> Vec<(&'static str, Vec<u8>)> {
    let (vertices, triangles) = soup;
    let (v, f) = (vertices.len(), triangles.len());
    let place = |[x, y, z]: &[f64; 3]| format!("{x} {y} {z}");
    let exponent = |[x, y, z]: &[f64; 3]| format!("{x:.6E} {y:.6E} {z:.6E}").replace('E', "D");
    let face =
        |first: usize| move |t: &[usize; 3]| format!("{} {} {}", t[0] + first, t[1] + first, t[2] + first);
    let places = |start: &str, end: &str| rows(vertices.iter().map(|v| format!("{start}{}", place(v))), end);
    let faces = |start: &str, first: usize, end: &str| {
        rows(triangles.iter().map(|t| format!("{start}{}", face(first)(t))), end)
    };
    let numbered = |texts: Vec<String>, first: usize| {
        rows((first..).zip(texts).map(|(k, text)| format!("{k} {text}")), "\n")
    };
    let lists = |first| {
        (
            vertices.iter().map(place).collect::<Vec<_>>(),
            triangles.iter().map(face(first)).collect::<Vec<_>>(),
        )
    };
    let (list, from_one) = lists(1);
    let from_zero = lists(0).1;
    let index = format!("{}-1", faces("", 0, " -1 ").trim_end_matches("-1 "));
    let offsets = rows((1..=f).map(|k| (3 * k).to_string()), " ");
    let points = places("", " ");
    let text = |text: String| text.into_bytes();
    vec![
        ("a.obj", text(format!("# shape\n{}g side\n{}", places("v ", "\n"), faces("f ", 1, "\n")))),
        (
            "back.obj",
            text(format!(
                "{}{}",
                places("v ", "\n"),
                rows(triangles.iter().map(|t| t.map(|c| format!("-{}/1/1", v - c)).join(" ")), "\n")
                    .lines()
                    .fold(String::new(), |all, line| all + "f " + line + "\n")
            )),
        ),
        ("vf.tab", text(format!("{}{}", places("v ", "\r\n"), faces("f ", 0, "\r\n")))),
        ("vf-counts.tab", text(format!(" {v} {f}\n{}{}", places("v ", "\n"), faces("f ", 1, "\n")))),
        (
            "numbered.tab",
            text(format!("{v}\n{}{f}\n{}", numbered(list.clone(), 1), numbered(from_one.clone(), 1))),
        ),
        (
            "numbered-zero.tab",
            text(format!("{v} {f}\n{}{}", numbered(list.clone(), 0), numbered(from_zero, 0))),
        ),
        (
            "unnumbered.tab",
            text(format!(
                "! shape\n{v} {f}\n{}{}",
                rows(vertices.iter().map(exponent), "\r\n"),
                faces("", 1, "\r\n")
            )),
        ),
        (
            "no-counts.tab",
            text(format!("{}{}", rows(vertices.iter().map(exponent), "\n"), faces("", 0, "\n"))),
        ),
        ("numbered-no-counts.tab", text(format!("{}{}", numbered(list, 1), numbered(from_one, 1)))),
        ("above.ver", text(format!("{v} {f}\n{}{}", places("", "\n"), faces("3\n", 1, "\n")))),
        (
            "a.off",
            text(format!("OFF\n# shape\n{v} {f} 0\n{}{}", places("", "\n"), faces("3 ", 0, " 255 0 0\n"))),
        ),
        ("line.off", text(format!("COFF {v} {f} 0\n{}{}", places("", " 1 1 1 1\n"), faces("3 ", 0, "\n")))),
        (
            "one.wrl",
            text(format!(
                "#VRML V1.0 ascii\nSeparator {{ Coordinate3 {{ point [ {} ] }} IndexedFaceSet {{ coordIndex [ {index} ] }} }}",
                places("", ", ")
            )),
        ),
        (
            "two.wrl",
            text(format!(
                "#VRML V2.0 utf8\nTransform {{ translation 0 0 0 children Shape {{ geometry IndexedFaceSet {{ coord Coordinate {{ point [ {} ] }} coordIndex [ {index} ] }} }} }}",
                places("", ", ")
            )),
        ),
        (
            "a.ply",
            text(format!(
                "ply\nformat ascii 1.0\nelement vertex {v}\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\nelement face {f}\nproperty list uchar int vertex_index\nend_header\n{}{}",
                places("7 ", "\n"),
                faces("3 ", 0, "\n")
            )),
        ),
        (
            "a.vtp",
            text(format!(
                "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"{v}\" NumberOfPolys=\"{f}\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">{points}</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">{}</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">{offsets}</DataArray></Polys></Piece></PolyData></VTKFile>",
                faces("", 0, " ")
            )),
        ),
        (
            "a.vtk",
            text(format!(
                "# vtk DataFile Version 3.0\nshape\nASCII\nDATASET POLYDATA\nPOINTS {v} double\n{}POLYGONS {f} {}\n{}",
                places("", "\n"),
                4 * f,
                faces("3 ", 0, "\n")
            )),
        ),
        ("a.gltf", text(gltf(soup, true).0)),
        glb(soup),
    ]
}

/// The JSON of a glTF and the bytes of its buffer, which the JSON holds if asked.
fn gltf((vertices, triangles): &Soup, within: bool) -> (String, Vec<u8>) {
    use base64::Engine;
    let (v, f) = (vertices.len(), triangles.len());
    let mut bytes: Vec<u8> = vertices.iter().flatten().flat_map(|x| (*x as f32).to_le_bytes()).collect();
    bytes.extend(triangles.iter().flatten().flat_map(|corner| (*corner as u32).to_le_bytes()));
    let uri = match within {
        true => {
            let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
            format!(r#","uri":"data:application/octet-stream;base64,{data}""#)
        }
        false => String::new(),
    };
    let bound = |pick: fn(f64, f64) -> f64| {
        [0, 1, 2].map(|axis| vertices.iter().map(|v| v[axis]).reduce(pick).unwrap())
    };
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"extensionsUsed":["KHR_texture_basisu"],"extensionsRequired":["KHR_texture_basisu"],"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"buffers":[{{"byteLength":{}{uri}}}],"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":{v},"type":"VEC3","min":{:?},"max":{:?}}},{{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]}}"#,
        bytes.len(),
        12 * v,
        12 * v,
        12 * f,
        bound(f64::min),
        bound(f64::max),
        3 * f
    );
    (json, bytes)
}

/// Binary glTF: a head, the JSON, the buffer, each padded to four bytes.
pub(super) fn glb(soup: &Soup) -> (&'static str, Vec<u8>) {
    let (json, buffer) = gltf(soup, false);
    let mut json = json.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let length = |bytes: &[u8]| (bytes.len() as u32).to_le_bytes();
    let chunks = [&length(&json), &b"JSON"[..], &json, &length(&buffer), b"BIN\0", &buffer].concat();
    let all = (12 + chunks.len() as u32).to_le_bytes();
    ("a.glb", [&b"glTF"[..], &2_u32.to_le_bytes(), &all, &chunks].concat())
}

/// Binary PLY in both orders of bytes, with a property between the coordinates.
pub(super) fn ply_binary((vertices, triangles): &Soup) -> Vec<(&'static str, Vec<u8>)> {
    let of = |little: bool| {
        let order = if little { "little" } else { "big" };
        let mut bytes = format!(
            "ply\nformat binary_{order}_endian 1.0\nelement vertex {}\nproperty float z\nproperty uchar red\nproperty double y\nproperty float x\nelement face {}\nproperty list uchar uint vertex_indices\nend_header\n",
            vertices.len(),
            triangles.len()
        )
        .into_bytes();
        let mut put = |big: &[u8]| match little {
            true => bytes.extend(big.iter().rev()),
            false => bytes.extend(big),
        };
        for [x, y, z] in vertices {
            put(&(*z as f32).to_be_bytes());
            put(&[7]);
            put(&y.to_be_bytes());
            put(&(*x as f32).to_be_bytes());
        }
        for corners in triangles {
            put(&[3]);
            corners.iter().for_each(|corner| put(&(*corner as u32).to_be_bytes()));
        }
        bytes
    };
    vec![("little.ply", of(true)), ("big.ply", of(false))]
}

pub(super) fn stl_text((vertices, triangles): &Soup) -> (&'static str, Vec<u8>) {
    let facet = |corners: &[usize; 3]| {
        let corners = corners.map(|corner| vertices[corner].map(|x| format!("{x:e}")).join(" "));
        format!(
            "facet normal 0 0 0\n outer loop\n  vertex {}\n endloop\nendfacet",
            corners.join("\n  vertex ")
        )
    };
    (
        "text.stl",
        format!("solid shape\n{}endsolid shape\n", rows(triangles.iter().map(facet), "\n")).into_bytes(),
    )
}

/// Binary STL whose head begins with the word of the other form.
pub(super) fn stl_binary((vertices, triangles): &Soup) -> (&'static str, Vec<u8>) {
    let mut bytes = b"solid as some programs begin".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corners in triangles {
        bytes.extend([0; 12]);
        corners.iter().for_each(|corner| {
            vertices[*corner].iter().for_each(|x| bytes.extend((*x as f32).to_le_bytes()))
        });
        bytes.extend([0; 2]);
    }
    ("binary.stl", bytes)
}

/// Every file of a shape: those whose facets share corners, and those whose facets have their own.
fn all_files(soup: &Soup) -> Vec<(&'static str, Vec<u8>)> {
    [files(soup), ply_binary(soup), vec![stl_text(soup), stl_binary(soup)]].concat()
}

#[test]
fn every_format_with_every_defect_is_the_same_body() {
    let exact = sums(&body());
    for (defect, soup, count, expected) in defects() {
        for (name, bytes) in all_files(&soup) {
            let cell = format!("{name}, {defect}");
            let mesh =
                triangles_of(Path::new(name), &bytes).unwrap_or_else(|error| panic!("{cell}: {error}"));
            // the reader of STL makes corners of the same coordinates one, and has no corner without a facet
            let stl = name.ends_with(".stl");
            let (count, expected): (Count, usize) = match (stl, defect) {
                (true, "corners apart" | "a corner unused") => (|repairs| repairs.counts().len(), 0),
                _ => (count, expected),
            };
            let corners = match (stl, defect) {
                (true, "a corner apart by rounding") => 5,
                (true, _) => 4,
                _ => soup.0.len(),
            };
            assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (corners, soup.1.len()), "{cell}");
            let (surface, repairs) =
                repaired(mesh.vertices, mesh.triangles).unwrap_or_else(|error| panic!("{cell}: {error}"));
            assert_eq!(count(&repairs), expected, "{cell}: {repairs}");
            let found = sums(&(surface.vertices().to_vec(), surface.triangles().to_vec()));
            let moments = surface.moments(2, [0.0; 3], [1.0; 3]);
            let exponents = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [1, 1, 0], [1, 0, 1], [0, 1, 1]];
            // one of the two corners stays, half a rounding away
            let near = if defect == "a corner apart by rounding" { 1e-5 } else { 1e-12 };
            for ((exact, found), exponents) in exact.into_iter().zip(found).zip(exponents) {
                assert!((found / exact - 1.0).abs() < near, "{cell}: {found} {exact}");
                assert!((moments.of(exponents) / exact - 1.0).abs() < near, "{cell}: {exponents:?}");
            }
        }
    }
}

/// What is no body, in every format: refused with the place, or a question, always in the same words.
#[test]
fn every_format_names_what_bounds_no_body() {
    let shifted = |by: [f64; 3]| {
        let (mut vertices, mut triangles) = body();
        vertices.extend(body().0.iter().map(|v| std::array::from_fn::<f64, 3, _>(|k| v[k] + by[k])));
        triangles.extend(body().1.iter().map(|corners| corners.map(|corner| corner + 4)));
        (vertices, triangles)
    };
    let mut open = shifted([9.0, 0.0, 0.0]);
    open.1.pop();
    let says = |(name, bytes): &(&str, Vec<u8>)| {
        let mesh = triangles_of(Path::new(name), bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        match repaired(mesh.vertices, mesh.triangles) {
            Ok((surface, _)) => format!("{} bodies", surface.bodies()),
            Err(error) => error.to_string(),
        }
    };
    for (soup, said) in [
        (open, "the surface has 1 hole: 3 edges, "),
        (shifted([0.25, 0.25, 0.25]), "cross or touch"),
        (shifted([9.0, 0.0, 0.0]), "2 bodies"),
    ] {
        let all: Vec<String> = all_files(&soup).iter().map(says).collect();
        all.iter().for_each(|words| assert!(words.contains(said), "{words}"));
        let places = |words: &String| words.replace(|letter: char| !letter.is_ascii_digit(), " ");
        if said.contains("hole") {
            all.iter().for_each(|words| assert_eq!(places(words), places(&all[0])));
        }
    }
}

/// Two bodies back to back in a facet are one; the wall between them is told.
#[test]
fn every_format_joins_parts_that_touch() {
    let (mut vertices, mut triangles) = body();
    // the image of the apex in the plane of the first facet, from corners of its own
    let [a, b, c] = triangles[0].map(|corner| vertices[corner]);
    let middle: [f64; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
    let apex = std::array::from_fn(|k| (2.0 * middle[k] - vertices[3][k]) as f32 as f64);
    let first = triangles[0];
    vertices.extend([a, b, c, apex]);
    let [p, q, r, s] = [4, 5, 6, 7];
    triangles.extend([[p, r, q], [p, q, s], [q, r, s], [r, p, s]]);
    let exact = sums(&(vertices.clone(), triangles.clone()));
    assert_eq!(first, [0, 2, 1]);
    for (name, bytes) in all_files(&(vertices, triangles)) {
        let mesh = triangles_of(Path::new(name), &bytes).unwrap();
        let (surface, repairs) =
            repaired(mesh.vertices, mesh.triangles).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((surface.bodies(), repairs.walls), (1, 2), "{name}: {repairs}");
        assert!((surface.volume() / exact[0] - 1.0).abs() < 1e-6, "{name}");
    }
}

/// A label beside the file tells its unit, in every format that has none of its own; two units in it are a question.
#[test]
fn every_format_takes_its_unit_from_a_label() {
    let folder = tempfile::tempdir().unwrap();
    let pds3 =
        "PDS_VERSION_ID = PDS3\r\nOBJECT = COLUMN\r\n  NAME = \"X\"\r\n  UNIT = \"KM\"\r\nEND_OBJECT\r\n";
    let pds4 = "<Field_Character>\n  <name>X</name>\n  <unit>km</unit>\n</Field_Character>\n";
    for (name, bytes) in all_files(&body()) {
        let file = folder.path().join(name);
        std::fs::write(&file, bytes).unwrap();
        let label = |ending: &str, text: &str| std::fs::write(file.with_extension(ending), text).unwrap();
        let unit = || quasirigid_io::mesh::read_triangles(&file).map(|mesh| mesh.unit);
        let own = name.contains(".gl");
        assert_eq!(unit().unwrap().is_some(), own, "{name}");
        for (ending, text) in [("lbl", pds3), ("xml", pds4)] {
            label(ending, text);
            let (size, words) = unit().unwrap().unwrap();
            assert!(
                own && size == 1.0 || size == 1e3 && words.ends_with("says km"),
                "{name}: {size} {words}"
            );
            label(ending, &(text.to_owned() + &text.replace("KM", "M").replace("km", "m")));
            assert!(own || unit().unwrap_err().to_string().contains("km"), "{name}");
            std::fs::remove_file(file.with_extension(ending)).unwrap();
        }
    }
}

#[test]
fn a_hole_is_named_and_corners_apart_by_more_than_rounding_stay_open() {
    let (mut vertices, mut triangles) = body();
    vertices.extend(body().0.iter().map(|[x, y, z]| [x + 9.0, *y, *z]));
    triangles.extend(body().1.iter().map(|corners| corners.map(|corner| corner + 4)));
    triangles.pop();
    let message = repaired(vertices, triangles).unwrap_err().to_string();
    assert!(message.starts_with("the surface has 1 hole: 3 edges, "), "{message}");
    for (apart, closes) in [(0.9e-5, true), (1.1e-5, false)] {
        let (mut vertices, mut triangles) = body();
        let size = (3.25_f64.powi(2) + 2.0_f64.powi(2) + 2.5_f64.powi(2)).sqrt(); // diagonal of the box
        vertices.push([vertices[3][0], vertices[3][1], vertices[3][2] + apart * size]);
        triangles[1][2] = 4;
        assert_eq!(repaired(vertices, triangles).is_ok(), closes, "{apart}");
    }
}

#[test]
fn corners_are_numbered_from_zero_where_one_is_zero_and_this_is_told() {
    let told = |name: &str| {
        let (name, bytes) = files(&body()).into_iter().find(|(other, _)| *other == name).unwrap();
        triangles_of(Path::new(name), &bytes).unwrap().remarks
    };
    assert_eq!(told("vf.tab"), ["corners are numbered from 0, since one of them is 0"]);
    assert!(told("vf-counts.tab").is_empty());
}

#[test]
fn an_off_file_may_have_its_counts_behind_its_first_word() {
    let text =
        String::from_utf8(files(&body()).into_iter().find(|(name, _)| *name == "a.off").unwrap().1).unwrap();
    let text = text.replacen("OFF\n# shape\n", "\t  OFF", 1);
    assert_eq!(triangles_of(Path::new("a.off"), text.as_bytes()).unwrap().triangles, body().1);
}

#[test]
fn a_polygon_that_is_not_convex_is_cut_within_itself() {
    // A step of height 1: the fan about its first corner would leave it.
    let outline = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]];
    let ring: Vec<[i32; 2]> = outline[3..].iter().chain(&outline[..3]).copied().collect();
    let mut text = String::new();
    for z in [0, 1] {
        ring.iter().for_each(|[x, y]| writeln!(text, "v {x} {y} {z}").unwrap());
    }
    text.push_str("f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n");
    (0..6).for_each(|k| {
        writeln!(text, "f {} {} {} {}", k + 1, (k + 1) % 6 + 1, (k + 1) % 6 + 7, k + 7).unwrap()
    });
    let mesh = triangles_of(Path::new("a.obj"), text.as_bytes()).unwrap();
    let (surface, repairs) = repaired(mesh.vertices, mesh.triangles).unwrap();
    assert!(repairs.none() && (surface.volume() - 3.0).abs() < 1e-14, "{repairs} {}", surface.volume());
}

#[test]
fn what_would_be_another_shape_is_refused() {
    let says =
        |name: &str, text: &str| triangles_of(Path::new(name), text.as_bytes()).unwrap_err().to_string();
    let moved = says("a.wrl", "#VRML V2.0 utf8\nTransform { scale 2 2 2 children [ ] }");
    assert!(moved.contains("\"scale\" moves or resizes"), "{moved}");
    let cut = says("a.wrl", "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet {");
    assert!(cut.contains("ends within 2 pairs of braces"), "{cut}");
    let counts = says("a.tab", "4 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert!(counts.contains("the file ends after 3 of 4 vertices"), "{counts}");
    let whole = says("a.tab", "0 0 0\n1 0 0\n0 1 0\n1 2 3\n");
    assert!(whole.contains("the first line has the number of vertices"), "{whole}");
}
