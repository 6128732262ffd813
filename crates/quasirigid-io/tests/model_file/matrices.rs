//! Mass, damping and stiffness from files of matrices, in every way in which they are read.
#![allow(non_snake_case)]

use std::fmt::Write;
use std::path::Path;

use quasirigid::elements::{Matrices, PartKind};
use quasirigid_io::model::{Model, ModelError};

use super::same::assert_same;
use super::{CARRIER, only_part, written};

/// Stiffness of one hexahedron in the formats of many programs; seven of its displacements are constrained.
const FORMATS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/matrix/model.toml");

/// A carrier and these lines of a table `[[matrices]]`, which start in line 6, beside files.
pub fn beside(files: &[(&str, String)], lines: &str) -> Result<Model, ModelError> {
    written(files, &format!("{CARRIER}[[matrices]]\n{lines}"))
}

fn read(files: &[(&str, String)], lines: &str) -> Model {
    beside(files, lines).unwrap_or_else(|error| panic!("{error}"))
}

fn given(model: &Model) -> &Matrices {
    let PartKind::Matrices(given) = &only_part(&model.assembly).kind else { panic!("matrices") };
    given
}

/// Degrees of freedom of three nodes that turn.
const ALL: usize = 18;

/// A square matrix by rows.
type Square = Vec<Vec<f64>>;

fn square(size: usize, entry: impl Fn(usize, usize) -> f64) -> Square {
    (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
}

/// Three nodes that turn, their displacements and rotations coupled (SI).
fn stiffness(i: usize, j: usize) -> f64 {
    let lever = |row: usize| if row % 6 < 3 { 1.0 } else { 0.3 };
    let shared = if i == j { 14.0 } else { ((i * j) as f64 + (i + j) as f64).sin() };
    500.0 * lever(i) * lever(j) * shared
}

fn damping(i: usize, j: usize) -> f64 {
    0.02 * stiffness(i, j) + if i == j { 0.3 } else { 0.0 }
}

/// Lumped masses with rotary inertia, and mass between the displacements of two nodes.
fn mass(i: usize, j: usize) -> f64 {
    const J: [[f64; 3]; 3] = [[0.3, 0.02, -0.01], [0.02, 0.4, 0.03], [-0.01, 0.03, 0.5]];
    let (a, b) = (i % 6, j % 6);
    match (i / 6 == j / 6, a < 3, b < 3) {
        (true, true, true) if a == b => 2.0 + (i / 6) as f64,
        (false, true, true) if a == b => 0.1 * (i / 6 + j / 6) as f64,
        (true, false, false) => J[a - 3][b - 3],
        _ => 0.0,
    }
}

/// 1 for the row of a rotation, of six rows to a node, else 0.
fn turns(row: usize) -> i32 {
    i32::from(row % 6 >= 3)
}

/// A matrix of six rows to a node in units of length (m) and mass (kg).
fn in_units(entry: impl Fn(usize, usize) -> f64, length: f64, mass: f64) -> Square {
    square(ALL, |i, j| entry(i, j) / (mass * length.powi(turns(i) + turns(j))))
}

/// The displacements alone, of three rows to a node.
fn moved(entry: impl Fn(usize, usize) -> f64) -> Square {
    let row = |i: usize| 6 * (i / 3) + i % 3;
    square(ALL / 2, |i, j| entry(row(i), row(j)))
}

pub fn market(matrix: &[Vec<f64>]) -> String {
    let size = matrix.len();
    let mut text = format!("%%MatrixMarket matrix array real general\n{size} {size}\n");
    for j in 0..size {
        for row in matrix {
            writeln!(text, "{:e}", row[j]).expect("memory");
        }
    }
    text
}

/// A matrix on the points 3, 7 and 11 as NASTRAN punches it, between commas.
fn dmig(name: &str, matrix: &[Vec<f64>]) -> String {
    let dof = |row: usize| format!("{},{}", [3, 7, 11][row / 6], row % 6 + 1);
    let mut text = format!("DMIG,{name},0,1,2,0\n");
    for j in 0..matrix.len() {
        for (i, row) in matrix.iter().enumerate().filter(|(_, row)| row[j] != 0.0) {
            writeln!(text, "DMIG,{name},{},,{},{:.16E}", dof(j), dof(i), row[j]).expect("memory");
        }
    }
    text
}

/// A matrix as the module `OUTPUT4` of NASTRAN writes it in text.
fn op4(name: &str, matrix: &[Vec<f64>]) -> String {
    let size = matrix.len();
    let mut text = format!("{size:8}{size:8}{:8}{:8}{name:<8}1P,3E23.16\n", 6, 2);
    for j in 0..size {
        writeln!(text, "{:8}{:8}{:8}", j + 1, 1, size).expect("memory");
        for three in matrix.chunks(3) {
            let values: String = three.iter().map(|row| format!("{:23.16E}", row[j])).collect();
            writeln!(text, "{values}").expect("memory");
        }
    }
    writeln!(text, "{:8}{:8}{:8}\n{:23.16E}", size + 1, 1, 1, 1.0).expect("memory");
    text
}

/// Places of the nodes; the file has them in another order.
fn nodes(unit: f64) -> String {
    let line = |label: u64, place: [f64; 3]| {
        let [x, y, z] = place.map(|entry| entry / unit);
        format!("{label} {x:e} {y:e} {z:e}\n")
    };
    line(3, [1.4, -0.6, 0.8]) + &line(7, [0.5, 0.2, -0.3]) + &line(11, [0.3, -0.1, 0.2])
}

const KEYS: &str = "nodes = \"nodes.txt\"\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\n";

/// The nodes by files of Matrix Market in SI units, with these further lines.
fn plain(lines: &str) -> Model {
    let files = [
        ("nodes.txt", nodes(1.0)),
        ("K.mtx", market(&in_units(stiffness, 1.0, 1.0))),
        ("M.mtx", market(&in_units(mass, 1.0, 1.0))),
        ("B.mtx", market(&in_units(damping, 1.0, 1.0))),
    ];
    read(&files, &format!("{KEYS}{lines}attach = 11\n"))
}

/// A body does not know its units: rows about rotations have those of length once or twice.
#[test]
fn matrices_in_other_units_are_the_same_body() {
    let (length, gram) = (1e-3, 1e-3);
    let files = [
        ("nodes.txt", nodes(length)),
        ("K.mtx", market(&in_units(stiffness, length, gram))),
        ("M.mtx", market(&in_units(mass, length, gram))),
        ("B.mtx", market(&in_units(damping, length, gram))),
    ];
    let units = "length_unit = \"mm\"\nmass_unit = \"g\"\ndamping = \"B.mtx\"\nattach = 11\n";
    let grams = beside(&files, &format!("{KEYS}{units}")).unwrap_or_else(|error| panic!("{error}"));
    assert_same(&grams, &plain("damping = \"B.mtx\"\n"), 1e-12);
}

/// Stiffness and damping of NASTRAN by point and component, mass by the order of the nodes; six components of each.
#[test]
fn rows_with_labels_and_rows_in_order_are_the_same_dofs() {
    let (inch, pound) = (0.0254, 0.453_592_37);
    let cards =
        dmig("KAAX", &in_units(stiffness, inch, pound)) + &dmig("BAAX", &in_units(damping, inch, pound));
    let files = [
        ("nodes.txt", nodes(inch)),
        ("model.pch", cards),
        ("model.op4", op4("MAAX", &in_units(mass, inch, pound))),
    ];
    let lines = "nodes = \"nodes.txt\"\nstiffness = { file = \"model.pch\", name = \"KAAX\" }\nmass = \"model.op4\"\n\
                 damping = { file = \"model.pch\", name = \"baax\" }\nlength_unit = \"in\"\nmass_unit = \"lb\"\nattach = 11\n";
    assert_same(&read(&files, lines), &plain("damping = \"B.mtx\"\n"), 1e-12);
}

/// A list of degrees of freedom in any order; without a list three rows belong to each node, in the order of the table.
#[test]
fn a_list_of_dofs_says_what_the_rows_are_about() {
    const LIST: [&str; 9] = ["7.2", "3 1", "11.1", "7.3", "3.3", "11.3", "7.1", "3.2", "11 2"];
    // where these are among 3.1, 3.2, 3.3, 7.1, …
    const ORDER: [usize; 9] = [4, 0, 6, 5, 2, 8, 3, 1, 7];
    let files = |K: Square, M: Square| {
        let list = LIST.join("\n");
        [("nodes.txt", nodes(1.0)), ("K.mtx", market(&K)), ("M.mtx", market(&M)), ("rows.dof", list)]
    };
    let attached = format!("{KEYS}attach = 11\n");
    let in_order = read(&files(moved(stiffness), moved(mass)), &attached);
    let mixed = |matrix: Square| square(9, |i, j| matrix[ORDER[i]][ORDER[j]]);
    let files = files(mixed(moved(stiffness)), mixed(moved(mass)));
    let listed = read(&files, &format!("{attached}dofs = \"rows.dof\"\n"));
    assert_eq!(given(&listed).mass.dofs, (0..9).map(|row| (row / 3, row % 3)).collect::<Vec<_>>());
    assert_same(&listed, &in_order, 1e-13);
}

/// Three rows to a node in one matrix, six in the other.
#[test]
fn matrices_may_have_different_dofs() {
    let displacements = |i, j| if turns(i) + turns(j) == 0 { mass(i, j) } else { 0.0 };
    let files = |M: Square| {
        [("nodes.txt", nodes(1.0)), ("K.mtx", market(&square(ALL, stiffness))), ("M.mtx", market(&M))]
    };
    let attached = format!("{KEYS}attach = 11\n");
    let fewer = read(&files(moved(mass)), &attached);
    assert_eq!(given(&fewer).mass.dofs.len(), ALL);
    assert_same(&fewer, &read(&files(square(ALL, displacements)), &attached), 1e-13);
}

/// Degrees of freedom that the other program constrained have no rows, and are fixed to the carrier without further keys.
#[test]
fn a_node_without_rows_is_held_on_the_carrier() {
    let free = |matrix: Square| square(6, |i, j| matrix[i][j]);
    let files = [
        ("nodes.txt", nodes(1.0)),
        ("K.mtx", market(&free(moved(stiffness)))),
        ("M.mtx", market(&free(moved(mass)))),
        ("rows.dof", "3.1\n3.2\n3.3\n7.1\n7.2\n7.3\n".to_owned()),
    ];
    let held = read(&files, &format!("{KEYS}dofs = \"rows.dof\"\n"));
    let light = |i: usize, j: usize| if i.max(j) < 12 { mass(i, j) } else { 0.0 };
    let files =
        [("nodes.txt", nodes(1.0)), ("K.mtx", market(&moved(stiffness))), ("M.mtx", market(&moved(light)))];
    assert_same(&held, &read(&files, &format!("{KEYS}attach = 11\n")), 1e-13);
}

/// Two methods to a mass on springs.
#[test]
fn a_node_on_springs_is_a_point_on_springs() {
    let (k, c) = ([[90.0, 5.0, -8.0], [5.0, 70.0, 4.0], [-8.0, 4.0, 60.0]], [0.4, 0.2, 0.3]);
    let files = [
        ("nodes.txt", "1 0.8 0.3 0.5\n2 0 0 0\n".to_owned()),
        ("rows.dof", "1.1\n1.2\n1.3\n".to_owned()),
        ("K.mtx", market(&square(3, |i, j| k[i][j]))),
        ("M.mtx", market(&square(3, |i, j| if i == j { 1.5 } else { 0.0 }))),
        ("B.mtx", market(&square(3, |i, j| if i == j { c[i] } else { 0.0 }))),
    ];
    let node = read(&files, &format!("{KEYS}dofs = \"rows.dof\"\ndamping = \"B.mtx\"\n"));
    let point = super::read(&format!(
        "{CARRIER}[[point]]\nname = \"tip\"\nmass = 1.5\nposition = [0.8, 0.3, 0.5]\n\
         [[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = {k:?}\ndamping = {c:?}\n"
    ));
    assert_same(&node, &point, 1e-12);
}

#[test]
fn damping_comes_with_a_rheology_or_in_proportion() {
    let voigt = plain("rheology = { kind = \"kelvin-voigt\", time = \"20 ms\" }\n");
    assert_same(&voigt, &plain("rayleigh = { stiffness = 0.02 }\n"), 1e-13);
    let both = plain(
        "rayleigh = { stiffness = \"10 ms\" }\nrheology = { kind = \"kelvin-voigt\", time = \"10 ms\" }\n",
    );
    assert_same(&both, &voigt, 1e-13);
}

/// Programs write from 10 to 17 digits.
#[test]
fn every_format_has_the_same_stiffness() {
    let read = |stiffness: &str| {
        let lines = format!(
            "[[matrices]]\nnodes = \"beam.inp\"\ndofs = \"beam.dof\"\nstiffness = {stiffness}\nmass = \"beam.mas\"\n"
        );
        Model::parse(Path::new(FORMATS), &format!("{CARRIER}{lines}"))
            .unwrap_or_else(|error| panic!("{error}"))
    };
    let calculix = read("\"beam.sti\"");
    assert_eq!(given(&calculix).mass.dofs.len(), 17);
    let formats = [
        ("\"symmetric.mtx\"", 1e-13),
        ("\"array.mtx\"", 1e-13),
        ("\"rows.npy\"", 1e-15),
        ("\"csr.npz\"", 1e-15),
        ("{ file = \"dense.npz\", name = \"K\" }", 1e-15),
        ("{ file = \"large.bdf\", name = \"KAAX\" }", 1e-9),
        ("\"text_dense.op4\"", 1e-13),
        ("{ file = \"binary_bigmat.op4\", name = \"KAAX\" }", 1e-15),
    ];
    for (format, tolerance) in formats {
        let model = read(format);
        let (found, expected) = (given(&model), given(&calculix));
        assert_eq!(
            (&found.mass.dofs, &found.mass.nodes),
            (&expected.mass.dofs, &expected.mass.nodes),
            "{format}"
        );
        assert_eq!(found.stiffness.len(), expected.stiffness.len(), "{format}");
        for (entry, known) in found.stiffness.iter().zip(&expected.stiffness) {
            assert_eq!((entry.0, entry.1), (known.0, known.1), "{format}");
            assert!((entry.2 - known.2).abs() <= tolerance * 2e10, "{format}: {entry:?} {known:?}");
        }
    }
}

/// Rows of a node along axes of its own: `CD` of node 3 is a cylinder about z, of node 7 a rectangular system; the coordinates of node 3
/// are cylindrical too, those of node 11 partly blank.
#[test]
fn rows_in_local_systems_of_grid_points_are_turned() {
    let place = [1.4_f64, -0.6, 0.8];
    let (radius, angle) = (place[0].hypot(place[1]), place[1].atan2(place[0]));
    let nodes = format!(
        "CORD2C,4,,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\nCORD2R,5,,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\n\
         GRID*,3,4,{radius:?},{:?}\n*,0.8,4\nGRID,7,,0.5,0.2,-0.3,5\nGRID,11,,0.3,-0.1,0.2\n",
        angle.to_degrees()
    );
    let (sin, cos) = angle.sin_cos();
    // axes of each node as rows
    let axes = [
        [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    ];
    let turned = |matrix: &dyn Fn(usize, usize) -> f64| {
        let global = in_units(matrix, 1.0, 1.0);
        square(ALL, |i, j| {
            let share = |row: usize, k: usize| axes[row / 6][row % 3][k];
            (0..9)
                .map(|k| share(i, k / 3) * share(j, k % 3) * global[i / 3 * 3 + k / 3][j / 3 * 3 + k % 3])
                .sum()
        })
    };
    let files = |dofs: &str| {
        [
            ("nodes.bdf", nodes.clone()),
            ("rows.dof", dofs.to_owned()),
            ("K.mtx", market(&turned(&stiffness))),
            ("M.mtx", market(&turned(&mass))),
        ]
    };
    let keys = KEYS.replace("nodes.txt", "nodes.bdf");
    let local = beside(&files(""), &format!("{keys}attach = 11\n"));
    assert_same(&local.unwrap_or_else(|error| panic!("{error}")), &plain(""), 1e-11);
    let some: String = (0..ALL).map(|row| format!("{} {}\n", [3, 7, 11][row / 6], row % 6 + 1)).collect();
    let mut without = files(&some.replace("3 2\n", "12 1\n"));
    without[0].1 += "GRID,12,,1.\n";
    let refusal = beside(&without, &format!("{keys}dofs = \"rows.dof\"\nattach = 11\n"));
    let message = refusal.expect_err("a node without one of its rows").to_string();
    assert!(message.contains("node 3 counts its displacements in a local system"), "{message}");
}

/// Lines of `*MATRIX OUTPUT`: by numbers in both triangles or in one, and by nodes.
#[test]
fn bare_lines_are_the_matrices_of_their_rows() {
    let (K, M) = (in_units(stiffness, 1.0, 1.0), in_units(mass, 1.0, 1.0));
    let lines = |matrix: &Square, keep: fn(usize, usize) -> bool, labels: bool| {
        let name = |row: usize| {
            if labels { format!("{} {}", [3, 7, 11][row / 6], row % 6 + 1) } else { (row + 1).to_string() }
        };
        let mut text = String::new();
        for (i, row) in matrix.iter().enumerate() {
            for (j, value) in row.iter().enumerate().filter(|(j, value)| keep(i, *j) && **value != 0.0) {
                writeln!(text, "{} {} {value:.16E}", name(i), name(j)).expect("memory");
            }
        }
        text
    };
    type Keep = fn(usize, usize) -> bool;
    let forms: [(Keep, bool); 4] =
        [(|_, _| true, false), (|i, j| i <= j, false), (|i, j| i >= j, true), (|_, _| true, true)];
    for (keep, labels) in forms {
        let files = [
            ("nodes.txt", nodes(1.0)),
            ("K.mtx", lines(&K, keep, labels)),
            ("M.mtx", lines(&M, keep, labels).replace(' ', ", ")),
        ];
        let lines = format!("{KEYS}attach = 11\n");
        assert_same(&read(&files, &lines), &plain(""), 1e-12);
    }
}
