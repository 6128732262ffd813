//! Abaqus meshes: keywords, sets, cell types, includes, and refusals by line.
//! Keywords that generate or move nodes are refused, since a mesh read without them would be another body.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use quasirigid_io::mesh::{read_mesh, volume_of};
use quasirigid_mesh::Shape;

use super::{parsed, says, set, with};

const FILE: &str = "*Heading\nbody, 1 2 3\n** a comment\n*Part, name=A\n*NODE, NSET=Nall\n10, 0., 0, 0\n20, 1.D0,,0.,\n30, 0, 1\n\n\
    40, 0, 0, 1\n50, 1, 1, 1\n*element, type = c3d4, elset=\"Left part\"\n1, 10, 20, 30, 40\n*ELEMENT, TYPE=B32\n3, 10,\n 30, 20\n\
    *ELEMENT, TYPE=C3D4H, ELSET=Right\n7,50,20,30,40,\n*Nset, nset=tip\n50, 40, 50,\n10\n*NSET, NSET=more\nTIP, 30\n\
    *NSET, NSET=some, GENERATE\n10, 35, 20\n10, 9000000000, 40\n*NSET, NSET=all, GENERATE\n1, 1000000000000\n*NSET, NSET=of right, ELSET=right\n\
    *ELSET, ELSET=both\nleft part, RIGHT\n*ELSET, ELSET=odd, GENERATE\n1, 9, 2\n*End Part\n*Assembly\n*Instance, name=A-1, part=A\n\
    *End Instance\n*End Assembly\n*MATERIAL, NAME=steel\n*ELASTIC\n2e11, 0.3\n*STEP\n*END STEP\n";

#[test]
fn sets_list_generate_and_name_one_another() {
    let mesh = parsed("a.inp", FILE);
    assert_eq!(mesh.node_labels, [10, 20, 30, 40, 50]);
    assert_eq!(mesh.nodes[1..3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let cells: Vec<_> = mesh.cells.iter().map(|cell| (cell.label, cell.shape, cell.nodes.to_vec())).collect();
    let line = (3, Shape::Line3, vec![0, 1, 2]); // its middle is the second node of Abaqus
    assert_eq!(cells, [(1, Shape::Tet4, vec![0, 1, 2, 3]), line, (7, Shape::Tet4, vec![4, 1, 2, 3])]);
    let nodes = |name: &str| set(&mesh, name).nodes.clone();
    assert_eq!(nodes("Nall"), [0, 1, 2, 3, 4]);
    assert_eq!(nodes("tip"), [0, 3, 4]);
    assert_eq!(nodes("more"), [0, 2, 3, 4]);
    assert_eq!(nodes("some"), [0, 2, 4]);
    assert_eq!(nodes("all"), [0, 1, 2, 3, 4]);
    assert_eq!(nodes("of right"), [1, 2, 3, 4]);
    let cells = |name: &str| set(&mesh, name).cells.clone();
    assert_eq!(
        (cells("Left part"), cells("Right"), cells("both"), cells("odd")),
        (vec![0], vec![2], vec![0, 2], vec![0, 1, 2])
    );
    assert_eq!(mesh.sets.len(), 10);
}

#[test]
fn types_with_the_geometry_of_a_shape_are_read() {
    let shape = |name: &str, nodes: usize| {
        let places: String = (1..=nodes).map(|node| format!("{node}, {node}\n")).collect();
        let corners: Vec<String> = (1..=nodes).map(|node| node.to_string()).collect();
        let lines: Vec<String> = corners.chunks(7).map(|chunk| chunk.join(", ")).collect();
        let file = format!("*NODE\n{places}*ELEMENT, TYPE={name}\n1, {}\n", lines.join(",\n"));
        parsed("a.inp", file).cells[0].shape
    };
    let known = [
        ("C3D4T", Shape::Tet4),
        ("C3D10M", Shape::Tet10),
        ("C3D10MT", Shape::Tet10),
        ("C3D6", Shape::Wedge6),
        ("C3D15", Shape::Wedge15),
        ("C3D8", Shape::Hex8),
        ("C3D8I", Shape::Hex8),
        ("C3D8R", Shape::Hex8),
        ("C3D20RH", Shape::Hex20),
        ("C3D27", Shape::Hex27),
        ("S3", Shape::Triangle3),
        ("S4R5", Shape::Quad4),
        ("S6", Shape::Triangle6),
        ("S8R", Shape::Quad8),
        ("STRI3", Shape::Triangle3),
        ("STRI65", Shape::Triangle6),
        ("M3D4R", Shape::Quad4),
        ("CPS8", Shape::Quad8),
        ("CPE3", Shape::Triangle3),
        ("B31", Shape::Line2),
        ("B32R", Shape::Line3),
        ("B33", Shape::Line2),
        ("T3D2", Shape::Line2),
        ("T3D3", Shape::Line3),
    ];
    for (name, expected) in known {
        assert_eq!(shape(name, expected.nodes()), expected, "{name}");
    }
    for name in ["C3D13", "C3D15V", "C3D27R8", "CAX4", "B21", "SC8R", "S7", "C3D", "8"] {
        assert!(
            says("a.inp", FILE.replace("c3d4", name))
                .contains(&format!("a.inp:12: cells of type {name} are not read"))
        );
    }
}

/// Every node of every type is in the sets of nodes of its elements: by a set of elements in a list, in a range, in another set or beside
/// the elements. Elements of all types stand apart in one file.
#[test]
fn sets_of_elements_have_all_their_nodes() {
    const TYPES: [(&str, usize); 18] = [
        ("C3D4", 4),
        ("C3D5", 5),
        ("C3D6", 6),
        ("C3D8", 8),
        ("C3D10", 10),
        ("C3D15", 15),
        ("C3D20", 20),
        ("C3D27", 27),
        ("S3", 3),
        ("S4", 4),
        ("S6", 6),
        ("S8R", 8),
        ("STRI65", 6),
        ("B31", 2),
        ("B32", 3),
        ("T3D2", 2),
        ("T3D3", 3),
        ("C3D5", 5),
    ];
    let (mut places, mut elements, mut sets, mut next) = (String::new(), String::new(), String::new(), 1);
    for (number, (name, count)) in (1..).zip(TYPES) {
        // of the second pyramid the last corner of the base has the least number
        let mut labels: Vec<usize> = (next..next + count).collect();
        if number == TYPES.len() {
            labels[..4].rotate_left(1);
        }
        labels
            .iter()
            .for_each(|label| places += &format!("{label}, {label}, {}, {}\n", label % 7, label % 5));
        let labels: Vec<String> = labels.iter().map(ToString::to_string).collect();
        let lines: Vec<String> = labels.chunks(7).map(|chunk| chunk.join(", ")).collect();
        elements += &format!("*ELEMENT, TYPE={name}, ELSET=own{number}\n{number}, {}\n", lines.join(",\n"));
        sets += &format!(
            "*ELSET, ELSET=list{number}\n{number}\n*ELSET, ELSET=range{number}, GENERATE\n{number}, {number}\n\
             *ELSET, ELSET=set{number}\nrange{number}\n"
        );
        for kind in ["own", "list", "range", "set"] {
            sets += &format!("*NSET, NSET=of {kind}{number}, ELSET={kind}{number}\n");
        }
        next += count;
    }
    let mesh = parsed("a.inp", format!("*NODE\n{places}{elements}{sets}"));
    let mut first = 0;
    for (number, (name, count)) in (1..).zip(TYPES) {
        let mut expected: Vec<u64> = (first + 1..=first + count).map(|label| label as u64).collect();
        for kind in ["own", "list", "range", "set"] {
            let mut found: Vec<u64> = set(&mesh, &format!("of {kind}{number}"))
                .nodes
                .iter()
                .map(|node| mesh.node_labels[*node])
                .collect();
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected, "{name} by {kind}");
        }
        first += count;
    }
}

#[test]
fn lines_are_refused() {
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10"), @"a:6: 1 values; a node is written number, x, y, z");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10, 0 0 0"), @r#"a:6: "0 0 0" is not a number; a node is written number, x, y, z"#);
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "20, 0, 0, 0"), @"a:7: the number 20 appears twice among the nodes; renumber them");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10, 0, 0, -inf"), @"a:6: the coordinate -inf of node 10 is not finite; correct it, or leave out the node and its cells");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "ten, 0, 0, 0"), @r#"a:6: "ten" is not a number; a node is written number, x, y, z"#);
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30,45"), @"a:18: cell 7 names node 45, which is not among the nodes before it; was the node left out?");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30"), @"a:18: 3 nodes for a tetrahedron of 4 nodes; is the type of the cell right?");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30,"), @"a:19: 3 nodes for a tetrahedron of 4 nodes; is the type of the cell right?");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "1,50,20,30,40"), @"a:18: the number 1 appears twice among the cells; renumber them");
    assert_snapshot!(with(FILE, "TIP, 30", "TOP, 30"), @r#"a:23: the set "more" names TOP, which is not among the nodes before it; was it left out?"#);
    assert_snapshot!(with(FILE, "TIP, 30", "TIP, 31"), @r#"a:23: the set "more" names 31, which is not among the nodes before it; was it left out?"#);
    assert_snapshot!(with(FILE, "1, 9, 2", "1, 9, 0"), @r#"a:33: "step 0" is not a number; a range is written first, last, step"#);
    assert_snapshot!(with(FILE, "1, 9, 2", "1"), @"a:33: 1 values; a range is written first, last, step");
    assert_snapshot!(with(FILE, "1, 9, 2", "4, 6, 1"), @r#"a:33: the set "odd" names 4 to 6, which is not among the cells before it; was it left out?"#);
    assert_snapshot!(with(FILE, ", elset=\"Left part\"", ""), @r#"a:31: the set "both" names left part, which is not among the cells before it; was it left out?"#);
    assert_snapshot!(with(FILE, "type = c3d4", "kind = c3d4"), @"a:12: *ELEMENT lacks TYPE=; add it");
    assert_snapshot!(says("a.inp", "*NODE\n1, 0\n2, 1\n*ELEMENT, TYPE=B31\n1, 1,"), @"a.inp:5: 1 nodes for a line of 2 nodes; is the type of the cell right?");
}

#[test]
fn what_would_change_the_mesh_is_refused() {
    assert_snapshot!(with(FILE, "*Heading", "*NGEN, NSET=a\n1, 5\n*Heading"), @"a:1: *NGEN is not read, and without it the mesh would be another; save a flattened file with every node and cell");
    assert_snapshot!(with(FILE, "*NODE,", "*NODE, SYSTEM=C,"), @"a:5: *NODE, SYSTEM=C is not read, and without it the mesh would be another; save a flattened file with every node and cell");
    assert_snapshot!(with(FILE, "*NODE,", "*NODE, INPUT=nodes.txt,"), @"a:5: *NODE, INPUT=nodes.txt is not read, and without it the mesh would be another; save a flattened file with every node and cell");
    assert_snapshot!(with(FILE, "*End Instance", "0, 0, 5, 7\n*End Instance"), @"a:37: 4 values; an instance is placed by a line x, y, z and perhaps one with two points of an axis and an angle in degrees");
}

/// A unit tetrahedron twice, the second moved by (5, 0, 0) and turned by 90° about the line from (5, 0, 0) along z; a part without an
/// instance, a reference point of the assembly and a mass are beside them.
const TWICE: &str = "*Part, name=T\n*Node\n1, 0, 0, 0\n2, 2, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*Element, type=C3D4, elset=all\n8, 1, 2, 3, 4\n\
    *Nset, nset=corner\n2\n*End Part\n*Part, name=idle\n*Node\n1, 9, 9, 9\n*End Part\n*Assembly, name=A\n\
    *Instance, name=one, part=T\n*End Instance\n*Instance, name=two, part=T\n5, 0, 0\n5, 0, 0, 5, 0, 3, 90\n*End Instance\n\
    *Node\n1, 7, 7, 7\n*Element, type=MASS, elset=point\n1, 1\n*Mass, elset=point\n3.\n\
    *Nset, nset=tip, instance=two\n2\n*Nset, nset=tip, instance=one\n2, 3\n*End Assembly\n";

#[test]
fn instances_are_moved_and_numbered_on() {
    let read = volume_of(Path::new("a.inp"), TWICE.as_bytes()).unwrap();
    let mesh = read.mesh;
    assert_eq!(mesh.node_labels, [1, 2, 3, 4, 5, 6, 7, 8, 9]);
    let near = |node: usize, place: [f64; 3]| {
        mesh.nodes[node].iter().zip(place).all(|(found, expected)| (found - expected).abs() < 1e-14)
    };
    assert!(
        near(1, [2.0, 0.0, 0.0]) && near(5, [5.0, 2.0, 0.0]) && near(6, [4.0, 0.0, 0.0]),
        "{:?}",
        mesh.nodes
    );
    assert!((mesh.volume(&[0, 1]) - 2.0 / 3.0).abs() < 1e-14);
    let cells: Vec<u64> = mesh.cells.iter().map(|cell| cell.label).collect();
    assert_eq!(cells, [8, 16]);
    assert_eq!(set(&mesh, "tip").nodes, [1, 2, 5]);
    assert_eq!((&set(&mesh, "two.corner").nodes[..], &set(&mesh, "two.all").cells[..]), (&[5][..], &[1][..]));
    let expected = [
        "left out: 1 *MASS, 1 MASS elements",
        "parts without an instance are left out: idle",
        "instances are moved to their places (1)",
        "nodes of the instance two are numbered on from 4, its cells from 8",
    ];
    assert_eq!(read.notes, expected);
}

/// The sets of a single instance keep their names, and so do its numbers.
#[test]
fn a_single_instance_keeps_its_names() {
    let only = TWICE
        .replace("*Instance, name=two, part=T\n5, 0, 0\n5, 0, 0, 5, 0, 3, 90\n*End Instance\n", "")
        .replace("*Nset, nset=tip, instance=two\n2\n", "");
    let mesh = parsed("a.inp", only);
    assert_eq!((set(&mesh, "corner").nodes.clone(), set(&mesh, "tip").nodes.clone()), (vec![1], vec![1, 2]));
}

#[test]
fn files_are_included() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    fs::write(place("main.inp"), "*NODE\n*INCLUDE, INPUT=nodes.txt\n3, 0, 1\n*Include, input=cells.txt\n")
        .unwrap();
    fs::write(place("nodes.txt"), "1, 0, 0, 0\n2, 1, 0, 0\n").unwrap(); // goes on with *NODE
    fs::write(place("cells.txt"), "*ELEMENT, TYPE=S3\n4, 1, 2, 3\n").unwrap();
    let mesh = read_mesh(&place("main.inp")).unwrap();
    assert_eq!((mesh.node_labels, mesh.cells[0].nodes.to_vec()), (vec![1, 2, 3], vec![0, 1, 2]));

    let says = || {
        let text = read_mesh(&place("main.inp")).unwrap_err().to_string();
        text.replace(&folder.path().display().to_string(), "[folder]")
    };
    fs::write(place("cells.txt"), "*ELEMENT, TYPE=S3\n4, 1, 2, 9\n").unwrap();
    assert_snapshot!(says(), @"[folder]/cells.txt:2: cell 4 names node 9, which is not among the nodes before it; was the node left out?");
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=main.inp\n").unwrap();
    assert_snapshot!(says(), @"[folder]/cells.txt:1: [folder]/main.inp is included within itself, or more than 5 files deep");
    for depth in 1..9 {
        fs::write(place(&format!("{depth}.txt")), format!("*INCLUDE, INPUT={}.txt\n", depth + 1)).unwrap();
    }
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=1.txt\n").unwrap();
    assert_snapshot!(says(), @"[folder]/3.txt:1: [folder]/4.txt is included within itself, or more than 5 files deep");
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=none.txt\n").unwrap();
    assert_snapshot!(says(), @"[folder]/none.txt: entity not found; is the name right, and is the file readable?");
    fs::write(place("cells.txt"), "*INCLUDE\n").unwrap();
    assert_snapshot!(says(), @"[folder]/cells.txt:1: *INCLUDE lacks INPUT=; add it");
}
