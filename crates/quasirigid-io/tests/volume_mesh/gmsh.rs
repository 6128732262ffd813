use insta::assert_snapshot;
use quasirigid::math::mesh::{Mesh, Shape};

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
    assert_snapshot!(with(V2, "2.2 0 8", "2.2 0 4"), @"");
    assert_snapshot!(with(V2, "2.2 0 8", "3 0 8"), @"");
    assert_snapshot!(with(V2, "$Comments", "Comments"), @"");
    assert_snapshot!(with(V2, "$EndComments", "$EndRemarks"), @"");
    assert_snapshot!(with(V2, "$MeshFormat", "$NOD"), @"");
    assert_snapshot!(with(V2, "$Comments", "$PartitionedEntities"), @"");
    assert_snapshot!(with(V2, "3 5 \"body\"", "3 5 body"), @"");
    assert_snapshot!(says("a", "$Nodes\n1\n1 0 0 0\n$EndNodes\n"), @"");
}

#[test]
fn nodes_are_refused_by_line() {
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 1"), @"");
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 1 1 1"), @"");
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 one 1"), @"");
    assert_snapshot!(with(V2, "9 1 1 1", "9 1 nan 1"), @"");
    assert_snapshot!(with(V2, "9 1 1 1", "3 1 1 1"), @"");
    assert_snapshot!(with(V2, "$Nodes\n5", "$Nodes\n6"), @"");
    assert_snapshot!(with(V2, "$Nodes\n5", "$Nodes\n4"), @"");
    assert_snapshot!(says("a", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000\n1 0 0 0\n"), @"");
    assert_snapshot!(with(V4, "2 4 1 4", "2 5 1 5"), @"");
    assert_snapshot!(with(V4, "2 4 1 4", "2 3 1 4"), @"");
}

#[test]
fn cells_are_refused_by_line() {
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 4 2 5 1 9 2 3 5"), @"");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 4 2 5 1 9 2 3"), @"");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "7 4 2 5 1 9 2 3 4"), @"");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 7 2 5 1 9 2 3 4 1"), @"");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 13 2 5 1 9 2 3 4"), @"");
    assert_snapshot!(with(V2, "8 4 2 5 1 9 2 3 4", "8 29 2 5 1 9 2 3 4"), @"");
    assert_snapshot!(with(V4, "3 1 4 1\n", "3 2 4 1\n"), @"");
    assert_snapshot!(with(V4, "8 4\n", "8 5\n"), @"");
}

#[test]
fn binary_files_are_refused_by_byte() {
    let file = bytes("zoo-4.1-binary.msh");
    assert_snapshot!(says("a.msh", &file[..3000]), @"");
    assert_snapshot!(says("a.msh", &file[..24]), @"");
    let small = binary("2.2", true);
    let at = small.windows(7).position(|window| window == b"$Nodes\n").unwrap() + 9;
    let changed = |at: usize, with: &[u8]| {
        let mut bytes = small.clone();
        bytes[at..at + with.len()].copy_from_slice(with);
        says("a.msh", bytes)
    };
    assert_snapshot!(changed(at, &[0xFF; 4]), @"");
    assert_snapshot!(changed(at + 4, &[0xFF; 8]), @"");
    assert_snapshot!(changed(26, &[9; 4]), @"");
}
