//! Meshes of NASTRAN bulk data: fields, continuations, includes, coordinate systems and elements, beside places by hand.

use std::fs;
use std::path::Path;

use insta::assert_snapshot;
use quasirigid_io::mesh::{read_mesh, read_volume, volume_of};
use quasirigid_mesh::{Mesh, Shape};

use super::{parsed, says, set};

const FREE: &str = "$ one brick of 1 x 1 x 2\nSOL 103\nCEND\nTITLE = a, b\nBEGIN BULK\n\
    GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.\nGRID,4,,,1.,0.\nGRID,5,,0.,0.,2.\nGRID,6,,1.,0.,2.0\n\
    GRID,7,,1.,1.,2.+0\nGRID,8,,0.,1.,2.\nCHEXA,1,10,1,2,3,4,5,6,+\n+,7,8\nPSOLID,10,1\nMAT1,1,7.+10,,.3,2700. $ light\nENDDATA\nGRID,9\n";

fn sum(mesh: &Mesh) -> f64 {
    (0..mesh.cells.len()).map(|cell| mesh.volume(&[cell])).sum()
}

#[test]
fn small_large_free_and_tabbed_fields_are_one_mesh() {
    let expected = parsed("a.bdf", FREE);
    assert_eq!((expected.nodes.len(), expected.cells.len()), (8, 1));
    assert!((sum(&expected) - 2.0).abs() < 1e-14);
    assert_eq!(set(&expected, "10").cells, [0]);
    let places: Vec<String> = expected
        .node_labels
        .iter()
        .zip(&expected.nodes)
        .map(|(label, [x, y, z])| format!("{label} {x:.3} {y:.3} {z:.3}"))
        .collect();
    let grids = |line: &dyn Fn(&[&str]) -> String| -> String {
        places.iter().map(|place| line(&place.split(' ').collect::<Vec<_>>())).collect()
    };
    let small = grids(&|w| format!("GRID    {:<8}        {:<8}{:>8}{:<8}\n", w[0], w[1], w[2], w[3]))
        + "CHEXA   1       10      1       2       3       4       5       6       +A\n+A      7       8\n";
    let large = grids(&|w| {
        format!(
            "grid*   {:<16}{:16}{:<16}{:<16}*A{}\n*A{:<6}{:<16}\n",
            w[0], "", w[1], w[2], w[0], w[0], w[3]
        )
    }) + "CHEXA*  1               10              1               2\n*       3               4               5               6\n\
           *       7               8\n";
    let tabbed = grids(&|w| format!("GRID\t{}\t\t{}\t{}\t{}\n", w[0], w[1], w[2], w[3]))
        + "CHEXA\t1\t10\t1\t2\t3\t4\t5\t6\n\t7\t8\n";
    let folded = grids(&|w| format!("GRID,{},,{},{},{}\r\n", w[0], w[1], w[2], w[3]))
        + "CHEXA,1,10,1,2,3,4,5,6\r\n,7,8\r\n";
    for text in [small, large, tabbed, folded] {
        assert_eq!(parsed("a.nas", format!("BEGIN BULK\n{text}ENDDATA\n")), expected, "{text}");
        assert_eq!(parsed("a.dat", &text), expected, "bulk data alone");
    }
    assert_eq!(parsed("deck", FREE), expected, "by its words");
}

/// A chain of three systems, rectangular in spherical in cylindrical, and one by grid points, beside the places by hand.
#[test]
fn grid_points_in_chains_of_systems_are_where_they_should_be() {
    // 1: cylinder about x through (1, 2, 3), angle from y; 2: sphere of 1, its origin at r = 2, 90°, 5; 3: rectangular in 2.
    let deck = "GRID,1,3,4.,5.,6.\nGRID,2,2,2.,90.,90.\nGRID,3,1,3.,90.,-1.\nGRID,4,9,0.,2.,0.\n\
        CORD2R,3,2,0.,0.,0.,1.,0.,0.,+\n+,1.,90.,0.\n\
        CORD2S,2,1,2.,90.,5.,2.,90.,6.,+\n+,3.,90.,5.\n\
        CORD2C,1,,1.,2.,3.,2.,2.,3.,+\n+,1.,3.,3.\nCORD1R,9,1,2,3\nCTETRA,1,1,1,2,3,4\n";
    let mesh = parsed("a.bdf", deck);
    // system 1 has x̂ = y, ŷ = z, ẑ = x; system 2 at (6, 2, 5), ẑ = x, x̂ = ŷ of 1's radius at 90° = z, ŷ = ẑ × x̂ = −y
    let near = |node: usize, place: [f64; 3]| {
        let worst = mesh.nodes[node].iter().zip(place).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-13, "{node}: {:?} and not {place:?}", mesh.nodes[node]);
    };
    near(2, [0.0, 2.0, 6.0]);
    near(1, [6.0, 0.0, 5.0]);
    near(0, [6.0 + 6.0, 2.0 - 5.0, 5.0 + 4.0]);
    // system 9: origin 1, z towards 2, x in the plane of 3
    let [a, b, c] = [0, 1, 2].map(|node| mesh.nodes[node]);
    let difference = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| b[k] - a[k]);
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
    };
    let y = cross(difference(a, b), difference(a, c));
    let length = y.iter().map(|x| x * x).sum::<f64>().sqrt();
    near(3, [0, 1, 2].map(|k| a[k] + 2.0 * y[k] / length));

    assert_snapshot!(says("a.bdf", deck.replace("CORD2C,1,,", "CORD2C,1,3,")), @"a.bdf:9: the coordinate system 1 hangs on itself, or on more than 100 others; correct the CORD cards");
    assert_snapshot!(says("a.bdf", deck.replace("GRID,2,2,", "GRID,2,9,")), @"a.bdf:11: the coordinate system 9 hangs on itself, or on more than 100 others; correct the CORD cards");
    assert_snapshot!(says("a.bdf", deck.replace("2,2,2.,", "2,7,2.,")), @"a.bdf:2: no card defines the coordinate system 7; is a CORD card or an included file missing?");
    assert_snapshot!(says("a.bdf", deck.replace("+,1.,3.,3.", "+,3.,2.,3.")), @"a.bdf:9: the three points of the coordinate system 1 are in a line; its plane needs a third direction");
    assert_snapshot!(says("a.bdf", deck.replace("CTETRA,1,1,1,2,3,4", "CTETRA,1,1,1,2,3,5")), @"a.bdf:12: no card gives the grid point or node 5; is an included file missing?");
}

/// Each element of a unit cube with all its middles has the volume of the linear one, and the order of its shape.
#[test]
fn quadratic_cells_stand_in_the_order_of_their_shapes() {
    let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let edges =
        [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 5], [2, 6], [3, 7], [4, 5], [5, 6], [6, 7], [7, 4]];
    let mut text = String::new();
    let mut grid = |label: usize, place: [f64; 3]| {
        let [x, y, z] = place;
        text += &format!("GRID,{label},,{x:?},{y:?},{z:?}\n");
    };
    let corner = |node: usize| corners[node].map(f64::from);
    (0..8).for_each(|node| grid(node + 1, corner(node)));
    for (number, [a, b]) in edges.iter().enumerate() {
        grid(number + 9, [0, 1, 2].map(|k| 0.5 * (corner(*a)[k] + corner(*b)[k])));
    }
    grid(30, [0.5, 0.5, 1.0]);
    let middle = |mesh: &Mesh| mesh.check().unwrap_or_else(|faults| panic!("{faults:?}"));
    let hex = format!("{text}CHEXA,5,1,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16,17,18,19,20\n");
    let mesh = parsed("a.bdf", &hex);
    middle(&mesh);
    assert_eq!((mesh.cells[0].shape, (sum(&mesh) - 1.0).abs() < 1e-14), (Shape::Hex20, true));
    // two middles left out: they are put there
    let part = volume_of(Path::new("a.bdf"), hex.replace(",13,14\n,15,", ",,14\n,,").as_bytes()).unwrap();
    middle(&part.mesh);
    assert_eq!((part.mesh.nodes.len(), part.mesh.nodes[21]), (23, [0.0, 0.0, 0.5]));
    assert_eq!(part.notes, ["middles of edges that cells leave out are put there (2)"]);
    let wedge = format!("{text}CPENTA,5,1,1,2,4,5,6,8\n,9,,12,13,14,16,17,\n,20\n");
    let mesh = parsed("a.bdf", wedge);
    middle(&mesh);
    assert_eq!((mesh.cells[0].shape, (sum(&mesh) - 0.5).abs() < 1e-14), (Shape::Wedge15, true));
    let pyramid = volume_of(Path::new("a.bdf"), format!("{text}CPYRAM,5,1,1,2,3,4,30\n").as_bytes()).unwrap();
    middle(&pyramid.mesh);
    assert_eq!((pyramid.mesh.cells.len(), (sum(&pyramid.mesh) - 1.0 / 3.0).abs() < 1e-14), (2, true));
    assert_eq!(pyramid.notes, ["pyramids are two tetrahedra each (1)"]);
    let quad = volume_of(Path::new("a.bdf"), format!("{text}CQUAD8,5,1,1,2,3,4,9,10\n,11,12\n").as_bytes());
    let shapes: Vec<Shape> = quad.unwrap().mesh.cells.iter().map(|cell| cell.shape).collect();
    assert_eq!(
        shapes,
        [Shape::Quad4, Shape::Triangle3, Shape::Triangle3, Shape::Triangle3, Shape::Triangle3]
    );
}

#[test]
fn files_below_the_deck_are_included_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    fs::create_dir(place("parts")).unwrap();
    let [head, tail] =
        FREE.split_once("CHEXA").map(|(head, tail)| [head.to_owned(), format!("CHEXA{tail}")]).unwrap();
    fs::write(place("main.bdf"), format!("{head}INCLUDE 'parts/\n  cells.inc'\nCONM2,9,1,,3.\nENDDATA\n"))
        .unwrap();
    fs::write(place("parts/cells.inc"), tail.replace("ENDDATA\nGRID,9\n", "$")).unwrap();
    let read = read_volume(&place("main.bdf")).unwrap();
    assert_eq!(read.mesh, parsed("a.bdf", FREE));
    assert_eq!(read.notes, ["read as a mesh alone, without its 1 CONM2, 1 materials; a [[deck]] takes them"]);

    let refused = |text: &str| {
        fs::write(place("main.bdf"), format!("{head}INCLUDE '{text}'\n")).unwrap();
        let text = read_mesh(&place("main.bdf")).unwrap_err().to_string();
        text.replace(&folder.path().display().to_string(), "[folder]")
    };
    assert_snapshot!(refused("../other.bdf"), @r#"[folder]/main.bdf:14: INCLUDE "../other.bdf" is not in the folder of this file or below it; copy it there and name it from there"#);
    assert_snapshot!(refused("/etc/passwd"), @r#"[folder]/main.bdf:14: INCLUDE "/etc/passwd" is not in the folder of this file or below it; copy it there and name it from there"#);
    assert_snapshot!(refused("none.bdf"), @"[folder]/none.bdf: entity not found; is the name right, and is the file readable?");
    assert_snapshot!(refused("main.bdf"), @r#"[folder]/main.bdf:14: "main.bdf" is included within itself, or more than 20 files deep"#);
    fs::write(place("parts/cells.inc"), "GRID,99\nCTRIA3,1,1,x,2,3\n").unwrap();
    assert_snapshot!(refused("parts/cells.inc"), @r#"[folder]/parts/cells.inc:2: "x" is not a number that is allowed here; an element has whole numbers for itself, its property and its grid points"#);
    fs::write(place("parts/cells.inc"), "$ nothing\nCTRIA3,1,1,x,2,3\n").unwrap();
    assert_snapshot!(refused("parts/cells.inc"), @r#"[folder]/parts/cells.inc:2: "x" is not a number that is allowed here; an element has whole numbers for itself, its property and its grid points"#);
}

/// What a mesh does not carry is counted by card.
#[test]
fn cards_that_are_left_out_are_counted() {
    let deck = FREE.replace(
        "ENDDATA",
        "CSHEAR,7,1,1,2,3,4\nSPC1,1,123,1,2\nSPC1,1,123,3\nEIGRL,1,,,10\nPARAM,POST,-1\nENDDATA",
    );
    let read = volume_of(Path::new("a.bdf"), deck.as_bytes()).unwrap();
    assert_eq!(read.notes[0], "left out: 1 CSHEAR, 2 SPC1");
}
