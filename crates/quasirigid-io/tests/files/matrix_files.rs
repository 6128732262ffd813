//! One matrix in every format reads as one matrix, and a damaged file is refused by line or byte.

use std::fs;
use std::path::{Path, PathBuf};

use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid_io::matrix::{
    Dof, MatrixFile, dofs_of, matrix_of, nodes_of, read_dofs, read_matrix, read_nodes,
};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/matrix").join(name)
}

/// The stiffness that CalculiX wrote, read here in three lines of its own.
fn stiffness() -> Vec<(usize, usize, f64)> {
    let text = fs::read_to_string(data("beam.sti")).unwrap();
    let upper = text.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let index = |k: usize| words[k].parse::<usize>().unwrap() - 1;
        (index(0), index(1), words[2].parse::<f64>().unwrap())
    });
    let mut entries: Vec<_> = upper
        .flat_map(|(i, j, value)| [(i, j, value), (j, i, value)])
        .filter(|entry| entry.2 != 0.0)
        .collect();
    entries.sort_by_key(|entry| (entry.0, entry.1));
    entries.dedup_by_key(|entry| (entry.0, entry.1));
    entries
}

fn dofs() -> Vec<Dof> {
    read_dofs(&data("beam.dof")).unwrap()
}

/// Files of the stiffness, the name of the matrix, and the relative error of their digits.
const FILES: [(&str, Option<&str>, f64); 25] = [
    ("beam.sti", None, 0.0),
    ("symmetric.mtx", None, 0.0),
    ("general.mtx", None, 0.0),
    ("array.mtx", None, 0.0),
    ("rows.npy", None, 0.0),
    ("columns_big_endian.npy", None, 0.0),
    ("version2.npy", None, 0.0),
    ("csr.npz", None, 0.0),
    ("csc.npz", None, 0.0),
    ("coo.npz", None, 0.0),
    ("dense.npz", Some("K"), 0.0),
    ("dense_compressed.npz", Some("K"), 0.0),
    ("sparse.mat", None, 0.0),
    ("dense.mat", Some("K"), 0.0),
    ("pynastran.op4", None, 0.0),
    ("text_dense.op4", None, 0.0),
    ("text_bigmat.op4", None, 0.0),
    ("text_nonbigmat.op4", Some("kaax"), 0.0),
    ("binary_dense.op4", Some("KAAX"), 0.0),
    ("binary_bigmat.op4", Some("KAAX"), 0.0),
    ("binary_nonbigmat.op4", Some("KAAX"), 0.0),
    // Ten digits fit 16 columns, and three fit 8.
    ("large.bdf", None, 5e-10),
    ("large.bdf", Some("kaax"), 5e-10),
    ("small.bdf", None, 5e-3),
    ("free.dmig", None, 5e-14),
];

/// The stiffness as a `DMIG` matrix between commas, with terms above and below the diagonal and all ways to write
/// exponents.
fn free() -> String {
    let dofs = dofs();
    let number = |value: f64, k: usize| {
        let text = format!("{value:.13e}");
        match k % 3 {
            0 => text,
            1 => text.replace('e', "D"),
            _ => text.replace("e-", "-").replace('e', "+"),
        }
    };
    let mut text =
        String::from("$ Größe in N/m\nCEND\nBEGIN BULK\nDMIG,kaax,0,6,2,0,,,,+A\n+A,\nGRID,1,,0.,0.,0.\n");
    for (j, column) in dofs.iter().enumerate() {
        text += &format!("dmig,KAAX,{},{},", column.node, column.component);
        let here = |i: usize, k: usize| k == j && if (i + j).is_multiple_of(2) { i >= j } else { i < j };
        for (k, (i, _, value)) in stiffness().into_iter().filter(|(i, k, _)| here(*i, *k)).enumerate() {
            let row = dofs[i];
            text += if k % 2 == 1 { ",\n" } else { "" };
            text += &format!(",{}, {},{},", row.node, row.component, number(value, k));
        }
        text += "\n";
    }
    text + "ENDDATA\nDMIG,LOST,0,6,2\n"
}

fn bytes(name: &str) -> Vec<u8> {
    if name == "free.dmig" { free().into_bytes() } else { fs::read(data(name)).unwrap() }
}

fn assert_same(found: &MatrixFile, expected: &[(usize, usize, f64)], tolerance: f64, name: &str) {
    assert_eq!(found.entries.len(), expected.len(), "{name}");
    for (a, b) in found.entries.iter().zip(expected) {
        assert_eq!((a.0, a.1), (b.0, b.1), "{name}");
        assert!((a.2 - b.2).abs() <= tolerance * b.2.abs(), "{name}: {a:?} {b:?}");
    }
}

#[test]
fn one_matrix_in_all_formats_is_one_matrix() {
    let expected = stiffness();
    assert!(expected.len() > 250);
    for (name, matrix, tolerance) in FILES {
        let found =
            matrix_of(Path::new(name), &bytes(name), matrix).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!((found.rows, found.columns), (17, 17), "{name}");
        assert_same(&found, &expected, tolerance, name);
        let labels = (name.ends_with("bdf") || name.ends_with("dmig")).then(dofs);
        assert_eq!(found.labels, labels, "{name}");
    }
}

#[test]
fn the_second_matrix_of_a_file_is_found_by_its_name() {
    let twice: Vec<_> = stiffness().into_iter().map(|(i, j, value)| (i, j, 2.0 * value)).collect();
    let files = ["binary_dense.op4", "binary_bigmat.op4", "binary_nonbigmat.op4"].map(|name| (name, "MAAX"));
    for (name, matrix) in
        files.into_iter().chain([("dense.npz", "M"), ("dense_compressed.npz", "M"), ("dense.mat", "M")])
    {
        assert_same(&read_matrix(&data(name), Some(matrix)).unwrap(), &twice, 0.0, name);
    }
}

/// Blocks of two rows and 17 columns: the stiffness, and twice the stiffness below it.
#[test]
fn blocks_need_not_be_square() {
    let found = read_matrix(&data("bsr.npz"), None).unwrap();
    let below = stiffness().into_iter().map(|(i, j, value)| (i + 17, j + 17, 2.0 * value));
    assert_eq!((found.rows, found.columns), (34, 34));
    assert_same(&found, &stiffness().into_iter().chain(below).collect::<Vec<_>>(), 0.0, "bsr.npz");
}

/// Two rows and three columns; the `coo` file has the 5 as 2 and 3.
#[test]
fn rows_and_columns_are_not_exchanged() {
    let expected = [(0, 0, 1.0), (0, 1, 3.0), (0, 2, 5.0), (1, 0, 2.0), (1, 1, 4.0)];
    let npz = ["wide_csr.npz", "wide_csc.npz", "wide_coo.npz"];
    for name in ["wide.npy", "wide_columns.npy", "wide_text.op4", "wide_binary.op4"].into_iter().chain(npz) {
        let found = read_matrix(&data(name), None).unwrap();
        assert_eq!((found.rows, found.columns), (2, 3), "{name}");
        assert_same(&found, &expected, 0.0, name);
    }
}

/// Displacements along different axes move the mass independently of each other.
#[test]
fn a_mass_of_calculix_has_a_positive_diagonal_and_zeros_between_directions() {
    let (mass, dofs) = (read_matrix(&data("beam.mas"), None).unwrap(), dofs());
    assert!(mass.entries.iter().all(|(i, j, _)| dofs[*i].component == dofs[*j].component));
    assert_eq!(mass.entries.iter().filter(|(i, j, value)| i == j && *value > 0.0).count(), 17);
}

#[test]
fn skew_and_rectangular_matrices_keep_signs_and_sides() {
    let entries = |name: &str, text: &str| matrix_of(Path::new(name), text.as_bytes(), None).unwrap();
    let skew =
        entries("a", "%%MatrixMarket MATRIX coordinate real skew-symmetric\n%\n3 3 2\n2 1 5\n3 2 -1d1\n");
    assert_eq!(skew.entries, [(0, 1, -5.0), (1, 0, 5.0), (1, 2, 10.0), (2, 1, -10.0)]);
    let skew = entries("a", "%%matrixmarket matrix array integer skew-symmetric\n3 3\n5\n0\n-10\n");
    assert_eq!(skew.entries, [(0, 1, -5.0), (1, 0, 5.0), (1, 2, 10.0), (2, 1, -10.0)]);
    let wide = entries("a", "%%MatrixMarket matrix array real general\n2 3\n1\n2\n3\n4\n5\n0\n");
    assert_eq!(wide.entries, [(0, 0, 1.0), (0, 1, 3.0), (0, 2, 5.0), (1, 0, 2.0), (1, 1, 4.0)]);
    let load = "DMIG    P       0       9       1                               2\n\
                DMIG*   P                              9               0\n*                      7               3           1.5-3\n\
                DMIG    P       11                      7       3       -2.\n*                      5                          4.0D+2\n";
    let load = entries("a", load);
    assert_eq!((load.rows, load.columns), (2, 2));
    assert_eq!(load.entries, [(0, 1, 400.0), (1, 0, 1.5e-3), (1, 1, -2.0)]);
    assert_eq!(load.labels.unwrap(), [Dof { node: 5, component: 0 }, Dof { node: 7, component: 3 }]);
}

/// Cuts of the length of the numbers that announce them.
#[test]
fn nodes_are_the_same_in_tables_cards_and_blocks() {
    let beam = read_nodes(&data("beam.inp")).unwrap();
    assert_eq!(beam.nodes().len(), 8);
    let tip = beam.nodes().iter().find(|node| node.label == 15);
    assert_eq!(tip.map(|node| node.place), Some([0.45, 0.3, 1.1]));
    let written = |line: &dyn Fn(u64, [f64; 3]) -> String| -> String {
        beam.nodes().iter().rev().map(|node| line(node.label, node.place)).collect()
    };
    let tables = [
        (
            "a.csv",
            format!("node,x,y,z\n{}", written(&|label, [x, y, z]| format!("{label}, {x},{y:e}, {z}\r\n"))),
        ),
        ("a.txt", written(&|label, [x, y, z]| format!("{label}\t{x} {y} {z}\n# next\n\n"))),
        (
            "a",
            format!(
                "GRDSET                                                  1246\n{}",
                written(&|label, [x, y, z]| {
                    format!("GRID    {label:<8}0       {x:<8.3}{y:<8.3}{z:<8.3}0\n")
                })
            ),
        ),
        ("a.bdf", written(&|label, [x, y, z]| format!("GRID*,{label},,{x:?},{y:?}\n*,{z:?}\n"))),
    ];
    for (name, text) in tables {
        let found = nodes_of(Path::new(name), text.as_bytes()).unwrap_or_else(|e| panic!("{e}"));
        let mut nodes = found.nodes().to_vec();
        // A table keeps its order; cards are sorted.
        if matches!(name, "a.csv" | "a.txt") {
            nodes.reverse();
        }
        assert_eq!(nodes, beam.nodes(), "{text}");
    }
}

/// Message about a file of the stiffness with one thing replaced, without the name of the file.
fn says(name: &str, bytes: &[u8], matrix: Option<&str>) -> String {
    match matrix_of(Path::new(name), bytes, matrix) {
        Ok(_) => "nothing".to_owned(),
        Err(error) => error.to_string(),
    }
}

fn replaced(name: &str, from: &[u8], to: &[u8]) -> Vec<u8> {
    let bytes = bytes(name);
    let at = bytes.windows(from.len()).position(|part| part == from).unwrap();
    [&bytes[..at], to, &bytes[at + from.len()..]].concat()
}

#[test]
fn errors_have_their_line_or_byte() {
    let with =
        |name: &str, from: &str, to: &str| says(name, &replaced(name, from.as_bytes(), to.as_bytes()), None);
    let market = |text: &str| says("a.mtx", format!("%%MatrixMarket matrix {text}").as_bytes(), None);
    let dmig = |text: &str| says("a", format!("DMIG,K,0,6,2\n{text}").as_bytes(), None);
    let op4 = |at: usize, byte: u8| {
        let mut bytes = bytes("binary_nonbigmat.op4");
        bytes[at] = byte;
        says("k.op4", &bytes, Some("KAAX"))
    };
    let messages = [
        says("a.mtx", b" \n", None),
        says("a.txt", b"stiffness 3", None),
        says("a.sti", b"1 1 1\n2 2 \xFF", None),
        market("coordinate complex general"),
        market("coordinate pattern general"),
        market("coordinate real hermitian"),
        market("coordinate real general\n3 3\n"),
        market("coordinate real symmetric\n3 2 1\n1 1 1"),
        market("array real general\n0 1000000000000\n1"),
        market("coordinate real general\n3 3 2\n1 1 1\n"),
        market("coordinate real general\n% a\n3 3 1\n1 1 1\n\n1 2 1"),
        market("coordinate real general\n3 3 1\n4 1 1"),
        market("coordinate real general\n3 3 1\n0 1 1"),
        market("coordinate real general\n3 3 1\n1 1 NaN"),
        market("coordinate integer general\n3 3 1\n1 1 1.5"),
        market("coordinate real symmetric\n3 3 3\n2 1 1\n1 1 1\n1 2 1"),
        market("coordinate real skew-symmetric\n3 3 1\n2 2 1"),
        market("array real general\n2 1\n1 2"),
        with("beam.sti", "2 2  1.3609075899951e+10\n", ""),
        with("beam.sti", "1 2 ", "1 1 "),
        with("beam.sti", "2 3  6.8949827344081e+09", "2 3"),
        says("beam.sti", &bytes("beam.sti"), Some("K")),
        with("rows.npy", "'<f8'", "'<c8'"),
        with("rows.npy", "'<f8'", "'<f2'"),
        with("rows.npy", "(17, 17)", "(17, 18)"),
        with("rows.npy", "(17, 17)", "(1,1,17)"),
        with("rows.npy", "(17, 17)", "{17, 17}"),
        with("rows.npy", "NUMPY\u{1}", "NUMPY\u{4}"),
        says("a.npy", &[&bytes("rows.npy")[..136], &[0xFF; 8], &bytes("rows.npy")[144..]].concat(), None),
        says("a.npz", &bytes("dense.npz"), None),
        says("a.npz", &bytes("dense.npz"), Some("C")),
        says("a.npz", &bytes("csr.npz")[..1500], None),
        dmig("DMIG,K,1,1,,1,1,3"),
        dmig("DMIG,K,1,1,,1,1,3.\nDMIG,K,2,1,,1,1,3.\n\n,1,1,4."),
        dmig("DMIG,K,1,1,,1,7,3."),
        dmig("DMIG,K,1,1,,1,2,3.,4."),
        dmig("DMIG,K,1,1,,1,2,3.,,,5"),
        dmig("DMIG,K,0,6,2"),
        dmig("DMIG,M,0,6,2"),
        says("a", b"DMIG,K,0,6,3", None),
        says("a", b"DMIG,K,0,5,1", None),
        says("a", b"DMIG,K,1,1,,1,1,3.", None),
        says("a", b"DMIG,K,0,6,1", Some("M")),
        says("a", b"DMIG,K,0,9,1,,,,3\nDMIG,K,1,1,,1,1,3.", None),
        says("a.bdf", b"GRID,1", None),
        with("text_dense.op4", "      17      17", "      16      17"),
        with("text_dense.op4", "      17      17       6       2", "      17      17       6       3"),
        with("text_dense.op4", "      17      17       6       2", "      17      17       3       2"),
        with("text_dense.op4", "E+", "E++"),
        with("text_nonbigmat.op4", "       1       0", "       1       0 "),
        says("k.op4", &bytes("text_bigmat.op4")[..3000], None),
        says("k.op4", &bytes("binary_dense.op4"), None),
        says("k.op4", &bytes("binary_dense.op4")[..400], Some("KAAX")),
        op4(32, 0),
        op4(36, 0),
        op4(50, 7),
    ];
    let expected = include_str!("../data/matrix/errors.txt");
    assert_eq!(messages.join("\n"), expected.trim_end());
}

#[test]
fn errors_in_nodes_and_dofs_have_their_line() {
    let nodes = |name: &str, text: &str| nodes_of(Path::new(name), text.as_bytes()).unwrap_err().to_string();
    let dofs = |text: &str| dofs_of(Path::new("a.dof"), text.as_bytes()).unwrap_err().to_string();
    let messages = [
        nodes("a.csv", "node,x,y,z\nfirst,0,0,0"),
        nodes("a.csv", "1,0,0"),
        nodes("a.csv", "1 0 0 inf"),
        nodes("a.csv", "1 0 0 0\n2 0 0 0\n1 1 1 1"),
        nodes("a.csv", "# none"),
        nodes("a.inp", "*NODE, NSET=A\n1, 0, 0, 0,\n*NODE PRINT\nU\n*NODE, SYSTEM=C\n2, 1, 90, 0"),
        nodes("a.inp", "*NODE\n1, 0, 0, 0\n*TRANSFORM, TYPE=C"),
        nodes("a.inp", "*NODE\n1, 0, 0"),
        nodes("a.inp", "*STEP"),
        nodes("a.bdf", "GRID,1,,0.,0.,0.,3"),
        nodes("a.bdf", "GRID,1,,0.,0.,0\n"),
        nodes("a.bdf", "GRDSET,,2\nGRID,1,,0.,0.,0."),
        dofs("1.1\n1.7"),
        dofs("1.1\n2 2\n1 1"),
        dofs("1.1\n2\n"),
        dofs("1.x\n"),
        dofs("\n"),
    ];
    assert_eq!(messages.join("\n"), include_str!("../data/matrix/errors_in_nodes.txt").trim_end());
}

/// A header costs nothing: memory and time follow the bytes that are there.
#[test]
fn a_billion_announced_is_not_a_billion_taken() {
    let sizes = "1000000000000 1000000000000";
    let refused = |name: &str, bytes: &[u8]| matrix_of(Path::new(name), bytes, None).is_err();
    assert!(refused("a", format!("%%MatrixMarket matrix array real general\n{sizes}\n1\n").as_bytes()));
    assert!(refused(
        "a",
        format!("%%MatrixMarket matrix coordinate real general\n{sizes} 99999999999\n1 1 1").as_bytes()
    ));
    assert!(refused("a.sti", b"1 1 1\n99999999999 99999999999 1\n"));
    assert!(refused("a", &replaced("rows.npy", b"(17, 17)", b"(999999999,9999999999)")));
    assert!(refused("a", &replaced("text_dense.op4", b"      17      17", b"9999999999999999")));
    assert!(refused("a", &replaced("text_nonbigmat.op4", b"       0      35", b"       099999999")));
    assert!(refused("a", b"DMIG,K,0,9,1,,,,999999999\nDMIG,K,1,1,,1,1,3."));
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1024) })]

    /// Entries that survive a cut or a change lie inside the matrix, are finite and in order, and take no more than the file's bytes.
    #[test]
    fn damaged_files_are_refused_or_whole(
        file in 0..FILES.len(), end in 0.5..1.5f64, changes in vec((0.0..1.0f64, any::<u8>()), 0..4),
        early in any::<bool>(),
    ) {
        let (name, matrix, _) = FILES[file];
        let mut bytes = bytes(name);
        let length = if early { bytes.len().min(200) } else { bytes.len() };
        let place = |part: f64| ((length as f64 * part) as usize).min(bytes.len() - 1);
        let (end, changes): (usize, Vec<_>) =
            (place(end) + 1, changes.iter().map(|(at, byte)| (place(*at), *byte)).collect());
        changes.into_iter().for_each(|(at, byte)| bytes[at] = byte);
        bytes.truncate(end);
        let _ = nodes_of(Path::new(name), &bytes);
        let _ = dofs_of(Path::new(name), &bytes);
        if let Ok(found) = matrix_of(Path::new(name), &bytes, matrix) {
            prop_assert!(found.entries.len() <= 2 * 8 * bytes.len().max(300));
            let inside = |(i, j, value): &(usize, usize, f64)| *i < found.rows && *j < found.columns && value.is_finite();
            prop_assert!(found.entries.iter().all(inside));
            prop_assert!(found.entries.windows(2).all(|pair| (pair[0].0, pair[0].1) < (pair[1].0, pair[1].1)));
        }
    }

    /// A number in a text, replaced by another.
    #[test]
    fn other_numbers_never_panic(
        file in 0..FILES.len(), which in any::<prop::sample::Index>(),
        number in "-?[0-9]{1,20}|[0-9]\\.[0-9]?[-+][0-9]{1,4}|nan|1e999|",
    ) {
        let (name, matrix, _) = FILES[file];
        let text = String::from_utf8_lossy(&bytes(name)).into_owned();
        let starts: Vec<usize> = text.match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at).collect();
        let start = starts[which.index(starts.len().min(400))];
        let end = text[start..].find(|c: char| !c.is_ascii_digit()).map_or(text.len(), |length| start + length);
        let changed = format!("{}{number}{}", &text[..start], &text[end..]);
        let _ = matrix_of(Path::new(name), changed.as_bytes(), matrix);
    }

    #[test]
    fn random_text_never_panics(
        text in "(DMIG|GRID|\\*NODE|K|%%MatrixMarket matrix|array|coordinate|real|[0-9.eD+-]{1,5}|[ \n*,$]|\\PC){0,60}",
        name in 0..5usize,
    ) {
        let name = Path::new(["a.sti", "a.bdf", "a.op4", "a.inp", "a.dof"][name]);
        let _ = matrix_of(name, text.as_bytes(), None);
        let _ = (nodes_of(name, text.as_bytes()), dofs_of(name, text.as_bytes()));
    }
}

/// An archive a thousand times smaller than its contents is not unpacked.
#[test]
fn archives_that_inflate_are_refused() {
    use std::io::Write;
    let archive = |mebi: usize| {
        let numbers = mebi << 17;
        let head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({numbers},), }}");
        let mut out = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        let options =
            zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
        out.start_file("K.npy", options).unwrap();
        out.write_all(b"\x93NUMPY\x01\0").unwrap();
        out.write_all(&(head.len() as u16).to_le_bytes()).unwrap();
        out.write_all(head.as_bytes()).unwrap();
        (0..mebi).for_each(|_| out.write_all(&vec![0; 1 << 20]).unwrap());
        out.finish().unwrap().into_inner()
    };
    let read = |mebi| quasirigid_io::matrix::matrix_of(std::path::Path::new("a.npz"), &archive(mebi), None);
    let said = read(80).unwrap_err().to_string();
    assert!(said.contains("unpacks to more than 64 MiB"), "{said}");
    assert_eq!(read(8).unwrap().rows, 1 << 20);
}

/// Values of a symmetric and of a general matrix as `scipy.io.hb_write` and ANSYS lay them out, without blanks between numbers.
#[test]
fn harwell_boeing_files_are_read_by_their_formats() {
    let general = "Title                                                                   KEY\n\
                   \x20            4             1             1             2             0\n\
                   RUA                        2             3             4             0\n\
                   (4I3)           (4I3)           (2E11.4)\n  1  2  4  5\n  2  1  2  1\n-1.5000E+00 2.0000E+00\n-3.2500E+00-4.0000E+00\n";
    let read = |text: &str| matrix_of(Path::new("a.hb"), text.as_bytes(), None);
    let matrix = read(general).unwrap();
    assert_eq!((matrix.rows, matrix.columns), (2, 3));
    assert_eq!(matrix.entries, [(0, 1, 2.0), (0, 2, -4.0), (1, 0, -1.5), (1, 1, -3.25)]);
    let symmetric = general
        .replace("RUA                        2             3", "RSA                        3             3")
        .replace("\n  2  1  2  1\n", "\n  3  2  3  3\n");
    let entries = read(&symmetric).unwrap().entries;
    let expected = [(0, 2, -1.5), (1, 1, 2.0), (1, 2, -3.25), (2, 0, -1.5), (2, 1, -3.25), (2, 2, -4.0)];
    assert_eq!(entries, expected);
    let says = |from: &str, to: &str| read(&general.replacen(from, to, 1)).unwrap_err().to_string();
    insta::assert_snapshot!(says("  1  2  4  5", "  1  4  2  5"), @r#"a.hb:5: "column pointers" is not allowed here; pointers ascend from 1 to one more than the entries, and rows count from 1"#);
    insta::assert_snapshot!(says("-3.2500E+00-4.0000E+00\n", ""), @"a.hb:7: the file ends after 2 of 4 entries; was it cut off, or is the number wrong?");
    insta::assert_snapshot!(says("RUA", "PUA"), @"a.hb:3: the file has the pattern of a matrix only; write it with its values, as real");
    insta::assert_snapshot!(says("  2  1  2  1", "  2  1  9  1"), @"a.hb:8: row 9, column 2 lies outside a matrix of 2 rows and 3 columns; are its sizes right?");
}

/// The binary files again in words of 64 bits, of either byte order: lengths in bytes, integers and numbers of eight, two words a number
/// become one.
#[test]
fn output4_in_words_of_64_bits_is_the_same_matrix() {
    let short = bytes("binary_dense.op4");
    let expected = matrix_of(Path::new("k.op4"), &short, Some("KAAX")).unwrap();
    for big_endian in [false, true] {
        let mut long = Vec::new();
        let word = |out: &mut Vec<u8>, value: i64| {
            out.extend(if big_endian { value.to_be_bytes() } else { value.to_le_bytes() });
        };
        let mut at = 0;
        let (mut header, mut last) = (true, 0);
        while at < short.len() {
            let integer = |at: usize| i32::from_be_bytes(short[at..at + 4].try_into().unwrap());
            let length = integer(at) as usize;
            let record = at + 4;
            let mut content = Vec::new();
            if header {
                (0..4).for_each(|k| word(&mut content, integer(record + 4 * k).into()));
                content.extend(&short[record + 16..record + 24]);
                content.extend([b' '; 8]);
                (header, last) = (false, integer(record));
            } else {
                let column = integer(record);
                word(&mut content, column.into());
                word(&mut content, integer(record + 4).into());
                word(&mut content, (integer(record + 8) / 2).into());
                for value in short[record + 12..record + length].chunks(8) {
                    let value = f64::from_be_bytes(value.try_into().unwrap());
                    content.extend(if big_endian { value.to_be_bytes() } else { value.to_le_bytes() });
                }
                header = column > last;
            }
            let length = content.len() as u32;
            let mark = if big_endian { length.to_be_bytes() } else { length.to_le_bytes() };
            long.extend(mark);
            long.extend(&content);
            long.extend(mark);
            at = record + integer(at) as usize + 4;
        }
        assert_eq!(matrix_of(Path::new("k.op4"), &long, Some("KAAX")).unwrap(), expected, "{big_endian}");
    }
}
