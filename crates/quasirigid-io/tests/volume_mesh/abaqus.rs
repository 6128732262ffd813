use std::fs;

use insta::assert_snapshot;
use quasirigid::math::mesh::Shape;
use quasirigid_io::mesh::read_mesh;

use super::{parsed, says, set, with};

const FILE: &str = "*Heading\nbody, 1 2 3\n** a comment\n*Part, name=A\n*NODE, NSET=Nall\n10, 0., 0, 0\n20, 1.D0,,0.,\n30, 0, 1\n\n\
    40, 0, 0, 1\n50, 1, 1, 1\n*element, type = c3d4, elset=\"Left part\"\n1, 10, 20, 30, 40\n*ELEMENT, TYPE=B32\n3, 10,\n 30, 20\n\
    *ELEMENT, TYPE=C3D4H, ELSET=Right\n7,50,20,30,40,\n*Nset, nset=tip\n50, 40,\n10\n*NSET, NSET=more\nTIP, 30\n\
    *NSET, NSET=some, GENERATE\n10, 35, 20\n*NSET, NSET=all, GENERATE\n1, 1000000000000\n*NSET, NSET=of right, ELSET=right\n\
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
    assert_eq!(nodes("some"), [0, 2]);
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
        let list = |count: usize, of: &dyn Fn(usize) -> String| (1..=count).map(of).collect::<String>();
        let nodes_of_cell =
            list(nodes, &|node| format!(", {node}{}", if node % 8 == 0 { ",\n 1" } else { "" }));
        let _ = nodes_of_cell;
        let corners: Vec<String> = (1..=nodes).map(|node| node.to_string()).collect();
        let lines: Vec<String> = corners.chunks(7).map(|chunk| chunk.join(", ")).collect();
        let file = format!(
            "*NODE\n{}*ELEMENT, TYPE={name}\n1, {}\n",
            list(nodes, &|node| format!("{node}, {node}\n")),
            lines.join(",\n")
        );
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
        ("T3D2", Shape::Line2),
        ("T3D3", Shape::Line3),
    ];
    for (name, expected) in known {
        assert_eq!(shape(name, expected.nodes()), expected, "{name}");
    }
    for name in [
        "C3D5", "C3D13", "C3D15V", "C3D27R8", "CAX4", "B21", "B33", "SC8R", "S7", "R3D4", "MASS", "SPRINGA",
        "C3D", "8",
    ] {
        assert!(
            says("a.inp", FILE.replace("c3d4", name))
                .contains(&format!("a.inp:12: cells of type {name} are not read"))
        );
    }
}

#[test]
fn lines_are_refused() {
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10"), @"");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10, 0 0 0"), @"");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "20, 0, 0, 0"), @"");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "10, 0, 0, -inf"), @"");
    assert_snapshot!(with(FILE, "10, 0., 0, 0", "ten, 0, 0, 0"), @"");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30,45"), @"");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30"), @"");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "7,50,20,30,"), @"");
    assert_snapshot!(with(FILE, "7,50,20,30,40,", "1,50,20,30,40"), @"");
    assert_snapshot!(with(FILE, "TIP, 30", "TOP, 30"), @"");
    assert_snapshot!(with(FILE, "TIP, 30", "TIP, 31"), @"");
    assert_snapshot!(with(FILE, "1, 9, 2", "1, 9, 0"), @"");
    assert_snapshot!(with(FILE, "1, 9, 2", "1"), @"");
    assert_snapshot!(with(FILE, "1, 9, 2", "4, 6, 1"), @"");
    assert_snapshot!(with(FILE, ", elset=\"Left part\"", ""), @"");
    assert_snapshot!(with(FILE, "type = c3d4", "kind = c3d4"), @"");
    assert_snapshot!(says("a.inp", "*NODE\n1, 0\n2, 1\n*ELEMENT, TYPE=B31\n1, 1,"), @"");
}

#[test]
fn what_would_change_the_mesh_is_refused() {
    assert_snapshot!(with(FILE, "*Heading", "*NGEN, NSET=a\n1, 5\n*Heading"), @"");
    assert_snapshot!(with(FILE, "*NODE,", "*NODE, SYSTEM=C,"), @"");
    assert_snapshot!(with(FILE, "*NODE,", "*NODE, INPUT=nodes.txt,"), @"");
    assert_snapshot!(with(FILE, "*Assembly", "*Part, name=B"), @"");
    assert_snapshot!(with(FILE, "*End Instance", "0, 0, 5\n*End Instance"), @"");
    assert_snapshot!(with(FILE, "*End Assembly", "*Instance, name=A-2, part=A\n*End Assembly"), @"");
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
    assert_snapshot!(says(), @"");
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=main.inp\n").unwrap();
    assert_snapshot!(says(), @"");
    for depth in 1..9 {
        fs::write(place(&format!("{depth}.txt")), format!("*INCLUDE, INPUT={}.txt\n", depth + 1)).unwrap();
    }
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=1.txt\n").unwrap();
    assert_snapshot!(says(), @"");
    fs::write(place("cells.txt"), "*INCLUDE, INPUT=none.txt\n").unwrap();
    assert_snapshot!(says(), @"");
    fs::write(place("cells.txt"), "*INCLUDE\n").unwrap();
    assert_snapshot!(says(), @"");
}
