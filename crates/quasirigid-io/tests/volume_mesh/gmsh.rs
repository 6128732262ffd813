//! Gmsh meshes of versions 2.2 and 4.1: text and binary of both byte orders, groups, and refusals by line or byte.
//! Binary files are written here after the manual of gmsh, so that both byte orders are tested.

use insta::assert_snapshot;
use quasirigid_mesh::{Mesh, Shape};

use super::{bytes, parsed, says, set, with};

const V2: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Comments\n9 8 7\n$EndComments\n$PhysicalNames\n1\n3 5 \"body\"\n\
    $EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n9 1 1 1\n$EndNodes\n$Elements\n3\n\
    7 4 2 5 1 1 2 3 4\n8 4 2 5 1 9 2 3 4\n9 2 2 -6 1 1 2 3\n$EndElements\n";

const V4: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 1\n5 0 0 0 1 8 \n2 0 0 0 1 1 0 0 0\n\
    1 0 0 0 1 1 1 2 5 6 1 2\n$EndEntities\n$Nodes\n2 4 1 4\n3 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n2 2 1 1\n4\n\
    0 0 1 0.25 0.5\n$EndNodes\n$Elements\n2 2 1 2\n3 1 4 1\n7 1 2 3 4\n0 5 15 1\n8 4\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";

/// A tetrahedron in two groups and its last corner in one, written here as the manual of gmsh says.
fn binary(version: &str, big: bool) -> Vec<u8> {
    let mut bytes = format!("$MeshFormat\n{version} 1 8\n").into_bytes();
    let put = |bytes: &mut Vec<u8>, value: &[u8]| match big {
        true => bytes.extend(value.iter().rev()),
        false => bytes.extend(value),
    };
    let ints = |bytes: &mut Vec<u8>, values: &[i32]| {
        values.iter().for_each(|value| put(bytes, &value.to_le_bytes()))
    };
    let sizes = |bytes: &mut Vec<u8>, values: &[u64]| {
        values.iter().for_each(|value| put(bytes, &value.to_le_bytes()))
    };
    let reals = |bytes: &mut Vec<u8>, values: &[f64]| {
        values.iter().for_each(|value| put(bytes, &value.to_le_bytes()))
    };
    let places = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    ints(&mut bytes, &[1]);
    bytes.extend(b"\n$EndMeshFormat\n");
    if version == "2.2" {
        bytes.extend(b"$Nodes\n4\n");
        for (label, place) in (1..).zip(places) {
            ints(&mut bytes, &[label]);
            reals(&mut bytes, &place);
        }
        bytes.extend(b"\n$EndNodes\n$Elements\n3\n");
        ints(&mut bytes, &[4, 2, 2, 7, 5, 1, 1, 2, 3, 4, 17, 6, 1, 1, 2, 3, 4]);
        ints(&mut bytes, &[15, 1, 2, 8, 8, 5, 4]);
        bytes.extend(b"\n$EndElements\n");
        return bytes;
    }
    bytes.extend(b"$Entities\n");
    sizes(&mut bytes, &[1, 0, 0, 1]);
    ints(&mut bytes, &[5]);
    reals(&mut bytes, &[0.0, 0.0, 1.0]);
    sizes(&mut bytes, &[1]);
    ints(&mut bytes, &[8, 1]);
    reals(&mut bytes, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    sizes(&mut bytes, &[2]);
    ints(&mut bytes, &[5, 6]);
    sizes(&mut bytes, &[0]);
    bytes.extend(b"\n$EndEntities\n$Nodes\n");
    sizes(&mut bytes, &[1, 4, 1, 4]);
    ints(&mut bytes, &[3, 1, 0]);
    sizes(&mut bytes, &[4, 1, 2, 3, 4]);
    reals(&mut bytes, places.as_flattened());
    bytes.extend(b"\n$EndNodes\n$Elements\n");
    sizes(&mut bytes, &[2, 2, 1, 2]);
    ints(&mut bytes, &[3, 1, 4]);
    sizes(&mut bytes, &[1, 7, 1, 2, 3, 4]);
    ints(&mut bytes, &[0, 5, 15]);
    sizes(&mut bytes, &[1, 8, 4]);
    bytes.extend(b"\n$EndElements\n");
    bytes
}

fn assert_is_tetrahedron(mesh: &Mesh) {
    assert_eq!(mesh.nodes, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(mesh.node_labels, [1, 2, 3, 4]);
    assert_eq!(mesh.cells.len(), 1);
    assert_eq!(
        (mesh.cells[0].label, mesh.cells[0].shape, &*mesh.cells[0].nodes),
        (7, Shape::Tet4, &[0, 1, 2, 3][..])
    );
    assert_eq!((&*set(mesh, "5").cells, &*set(mesh, "6").cells), (&[0][..], &[0][..]));
    assert_eq!((&*set(mesh, "8").cells, &*set(mesh, "8").nodes), (&[][..], &[3][..]));
}

#[test]
fn both_byte_orders_are_read() {
    for version in ["2.2", "4.1"] {
        for big in [false, true] {
            assert_is_tetrahedron(&parsed("a.msh", binary(version, big)));
        }
    }
    assert_is_tetrahedron(&parsed("a.msh", V4)); // with a node that has parameters
    assert_is_tetrahedron(&parsed("a.msh", V4.replace('\n', "\r\n")));
}

#[test]
fn groups_have_names_or_numbers() {
    let mesh = parsed("a.msh", V2);
    assert_eq!(mesh.node_labels, [1, 2, 3, 4, 9]);
    assert_eq!(&*mesh.cells[1].nodes, [4, 1, 2, 3]);
    assert_eq!((&*set(&mesh, "body").cells, &*set(&mesh, "6").cells), (&[0, 1][..], &[2][..]));
}

/// An element in two groups is written twice in version 2.2; the same element in another entity is another.
#[test]
fn a_cell_in_two_groups_is_one() {
    let twice = |entity: &str| V2.replace("8 4 2 5 1 9 2 3 4", &format!("8 4 2 6 {entity} 1 2 3 4"));
    assert_eq!(parsed("a.msh", twice("1")).cells.len(), 2);
    assert_eq!(parsed("a.msh", twice("2")).cells.len(), 3);
}

#[test]
fn sections_are_refused_by_line() {
    assert_snapshot!(with(V2, "2.2 0 8", "2.2 0 4"), @r#"a:2: "2.2 0 4" is not read; save gmsh meshes as version 2.2 or 4.1, VTK grids as version 2 to 5"#);
    assert_snapshot!(with(V2, "2.2 0 8", "3 0 8"), @r#"a:2: "3 0 8" is not read; save gmsh meshes as version 2.2 or 4.1, VTK grids as version 2 to 5"#);
    assert_snapshot!(with(V2, "$Comments", "Comments"), @r#"a:4: "Comments" is not allowed here; a gmsh file begins with $MeshFormat and has sections $Name to $EndName"#);
    assert_snapshot!(with(V2, "$EndComments", "$EndRemarks"), @"a:4: the section $Comments does not end; was the file cut off?");
    assert_snapshot!(with(V2, "$MeshFormat", "$NOD"), @r#"a:1: "version 1" is not read; save gmsh meshes as version 2.2 or 4.1, VTK grids as version 2 to 5"#);
    assert_snapshot!(with(V2, "$Comments", "$PartitionedEntities"), @"a:4: the mesh is partitioned; save it without partitions");
    assert_snapshot!(with(V2, "3 5 \"body\"", "3 5 body"), @r#"a:9: "body" is not allowed here; the name of a group is written dimension number "name""#);
    assert_snapshot!(says("a", "$Nodes\n1\n1 0 0 0\n$EndNodes\n"), @r#"a:1: "$Nodes" is not allowed here; a gmsh file begins with $MeshFormat and has sections $Name to $EndName"#);
}

#[test]
fn nodes_are_refused_by_line() {
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 1"), @"a:17: 3 values; a node is written number x y z");
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 1 1 1"), @"a:17: 5 values; a node is written number x y z");
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 one 1"), @r#"a:17: "one" is not a number; a node is written number x y z"#);
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 nan 1"), @"a:17: the coordinate NaN of node 9 is not finite; correct it, or leave out the node and its cells");
    assert_snapshot!(with(V2, "9 1 1 1", "3 1 1 1"), @"a:17: the number 3 appears twice among the nodes; renumber them");
    assert_snapshot!(with(V2, "$Nodes\n5", "$Nodes\n6"), @"a:18: the section ends after 5 of 6 nodes; is the number wrong?");
    assert_snapshot!(with(V2, "$Nodes\n5", "$Nodes\n4"), @"a:17: more follows the 4 nodes announced; is that number right?");
    assert_snapshot!(says("a", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000\n1 0 0 0\n"), @"a:6: the file ends after 1 of 1000000000 nodes; was it cut off, or is the number wrong?");
    assert_snapshot!(with(V4, "2 4 1 4", "2 5 1 5"), @"a:21: the section ends after 4 of 5 nodes; is the number wrong?");
    assert_snapshot!(with(V4, "2 4 1 4", "2 3 1 4"), @"a:19: more follows the 3 nodes announced; is that number right?");
}

#[test]
fn cells_are_refused_by_line() {
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 4 2 5 1 9 2 3 5"), @"a:22: cell 8 names node 5, which is not among the nodes before it; was the node left out?");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 4 2 5 1 9 2 3"), @"a:22: 8 values; a cell is written number nodes, with type and tags before the nodes in version 2.2");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "7 4 2 5 1 9 2 3 4"), @"a:22: the number 7 appears twice among the cells; renumber them");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 13 2 5 1 9 2 3 4 1"), @"a:22: cells of type 13 (wedge of 18 nodes) are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 13 2 5 1 9 2 3 4"), @"a:22: cells of type 13 (wedge of 18 nodes) are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 29 2 5 1 9 2 3 4"), @"a:22: cells of type 29 are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes");
    assert_snapshot!(with(V4, "3 1 4 1\n", "3 2 4 1\n"), @"a:25: there is no entity 2 of dimension 3 in $Entities; were they left out?");
    assert_snapshot!(with(V4, "8 4\n", "8 5\n"), @"a:28: cell 8 names node 5, which is not among the nodes before it; was the node left out?");
}

#[test]
fn binary_files_are_refused_by_byte() {
    let file = bytes("zoo-4.1-binary.msh");
    assert_snapshot!(says("a.msh", &file[..3000]), @"a.msh: byte 3000: the file ends after 45 of 125 nodes; was it cut off, or is the number wrong?");
    assert_snapshot!(says("a.msh", &file[..24]), @"a.msh: byte 20: the section $MeshFormat does not end; was the file cut off?");
    let small = binary("2.2", true);
    let at = small.windows(7).position(|window| window == b"$Nodes\n").unwrap() + 9;
    let changed = |at: usize, with: &[u8]| {
        let mut bytes = small.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        says("a.msh", bytes)
    };
    assert_snapshot!(changed(at, &[0xFF; 4]), @"a.msh: byte 49: -1 is not a number of nodes or cells; is the file damaged?");
    assert_snapshot!(changed(at + 4, &[0xFF; 8]), @"a.msh: byte 69: the coordinate NaN of node 1 is not finite; correct it, or leave out the node and its cells");
    assert_snapshot!(changed(20, &[9; 4]), @"a.msh: byte 20: 151587081 is not a number of nodes or cells; is the file damaged?");
}
