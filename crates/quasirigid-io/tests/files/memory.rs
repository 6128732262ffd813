//! Reading takes less than ten times the length of a file, in every format.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use quasirigid_io::matrix::matrix_of;
use quasirigid_io::mesh::{mesh_of, triangles_of};
use quasirigid_io::table_file::read_bodies;

use super::shapes::{Soup, files, glb, ply_binary, stl_binary, stl_text};
use crate::heap::most_held;

/// Nodes along each side.
const SIDE: usize = 60;
const MOST: f64 = 10.0;

/// A sheet of triangles; only read, so it need not close.
fn sheet() -> Soup {
    let place = |k: usize| [k % SIDE, k / SIDE].map(|x| 0.123_456 * (x as f64 + 1.0));
    let vertices = (0..SIDE * SIDE)
        .map(place)
        .map(|[x, y]| [x, y, 0.015_625 * (x * y)].map(|x| (x as f32).into()))
        .collect();
    let cells = (0..SIDE - 1).flat_map(|row| (0..SIDE - 1).map(move |column| row * SIDE + column));
    (vertices, cells.flat_map(|k| [[k, k + 1, k + SIDE], [k + 1, k + SIDE + 1, k + SIDE]]).collect())
}

/// Tetrahedra of such a sheet and the sheet above, one on each triangle.
fn cells() -> (Vec<[f64; 3]>, Vec<[usize; 4]>) {
    let (mut vertices, triangles) = sheet();
    let count = vertices.len();
    vertices.extend(sheet().0.iter().map(|[x, y, z]| [*x, *y, z + 1.0]));
    let cells = triangles.iter().map(|[a, b, c]| [*a, *b, *c, a + count]).collect();
    (vertices, cells)
}

fn lines<T>(things: &[T], line: impl Fn(usize, &T) -> String) -> String {
    things.iter().enumerate().fold(String::new(), |mut text, (k, thing)| {
        writeln!(text, "{}", line(k + 1, thing)).unwrap();
        text
    })
}

fn volumes() -> Vec<(&'static str, String)> {
    let (nodes, cells) = cells();
    let (n, c) = (nodes.len(), cells.len());
    let place = |[x, y, z]: &[f64; 3], between: &str| format!("{x:.6}{between}{y:.6}{between}{z:.6}");
    let list = |cell: &[usize; 4], first: usize, between: &str| {
        cell.map(|node| (node + first).to_string()).join(between)
    };
    vec![
        (
            "a.bdf",
            format!(
                "BEGIN BULK\n{}{}MAT1,1,7.+10,,.3,2700.\nPSOLID,1,1\nENDDATA\n",
                lines(&nodes, |k, node| format!("GRID,{k},,{}", place(node, ","))),
                lines(&cells, |k, cell| format!("CTETRA,{k},1,{}", list(cell, 1, ",")))
            ),
        ),
        (
            "a.inp",
            format!(
                "*NODE\n{}*ELEMENT, TYPE=C3D4, ELSET=ALL\n{}",
                lines(&nodes, |k, node| format!("{k}, {}", place(node, ", "))),
                lines(&cells, |k, cell| format!("{k}, {}", list(cell, 1, ", ")))
            ),
        ),
        (
            "a.msh",
            format!(
                "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{n}\n{}$EndNodes\n$Elements\n{c}\n{}$EndElements\n",
                lines(&nodes, |k, node| format!("{k} {}", place(node, " "))),
                lines(&cells, |k, cell| format!("{k} 4 2 1 1 {}", list(cell, 1, " ")))
            ),
        ),
        (
            "a.vtk",
            format!(
                "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {n} double\n{}CELLS {c} {}\n{}CELL_TYPES {c}\n{}",
                lines(&nodes, |_, node| place(node, " ")),
                5 * c,
                lines(&cells, |_, cell| format!("4 {}", list(cell, 0, " "))),
                lines(&cells, |_, _| "10".to_owned())
            ),
        ),
        (
            "a.vtu",
            format!(
                "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"{n}\" NumberOfCells=\"{c}\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n{}</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n{}</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n{}</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n{}</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>",
                lines(&nodes, |_, node| place(node, " ")),
                lines(&cells, |_, cell| list(cell, 0, " ")),
                lines(&cells, |k, _| (4 * k).to_string()),
                lines(&cells, |_, _| "10".to_owned())
            ),
        ),
    ]
}

fn matrices() -> Vec<(&'static str, String)> {
    let size = 5000_usize;
    let rows: Vec<usize> = (0..size).collect();
    let value = |row: usize| 1e5 + 0.125 * row as f64;
    let card =
        |row: usize| format!("DMIG    KAA     {row:>8}{:>8}        {row:>8}{:>8}{:>8.1}", 1, 1, value(row));
    vec![
        (
            "a.mtx",
            format!(
                "%%MatrixMarket matrix coordinate real symmetric\n{size} {size} {size}\n{}",
                lines(&rows, |k, row| format!("{k} {k} {:.9e}", value(*row)))
            ),
        ),
        ("a.sti", lines(&rows, |k, row| format!("{k} {k} {:.9e}", value(*row)))),
        (
            "a.bdf",
            format!("DMIG    KAA            0       6       2       0\n{}", lines(&rows, |k, _| card(k))),
        ),
    ]
}

fn tables() -> Vec<(&'static str, String)> {
    let rows: Vec<usize> = (0..5000).collect();
    let values = |row: usize| {
        [
            format!("body {row}"),
            format!("{:.4}", 5.27 + row as f64),
            format!("{:.3}", 0.01 * row as f64),
            "0.25".to_owned(),
        ]
    };
    let header = "name,P [h],D [km],pV\n";
    let fixed = |[a, b, c, d]: [String; 4]| format!("{a:<12} {b:>12} {c:>10} {d:>6}");
    let cell = |text: String| format!("<TD>{text}</TD>");
    vec![
        ("a.csv", header.to_owned() + &lines(&rows, |_, row| values(*row).join(","))),
        (
            "a.txt",
            format!("{:<12} {:>12} {:>10} {:>6}\n", "name", "P", "D", "pV")
                + &lines(&rows, |_, row| fixed(values(*row))),
        ),
        (
            "a.vot",
            format!(
                "<?xml version=\"1.0\"?><VOTABLE><RESOURCE><TABLE>{}<DATA><TABLEDATA>\n{}</TABLEDATA></DATA></TABLE></RESOURCE></VOTABLE>",
                ["name", "P", "D", "pV"]
                    .map(|name| format!("<FIELD name=\"{name}\" datatype=\"char\" arraysize=\"*\"/>"))
                    .concat(),
                lines(&rows, |_, row| format!("<TR>{}</TR>", values(*row).map(cell).concat()))
            ),
        ),
    ]
}

#[test]
fn reading_takes_less_than_ten_times_the_file() {
    let mut told = Vec::new();
    let mut judge = |name: &str, length: usize, held: usize| {
        told.push((name.to_owned(), 1.0 + held as f64 / length as f64))
    };
    let soup = sheet();
    let surfaces =
        [files(&soup), vec![stl_text(&soup), stl_binary(&soup), glb(&soup)], ply_binary(&soup)].concat();
    for (name, bytes) in surfaces {
        let (read, held) = most_held(|| triangles_of(Path::new(name), &bytes));
        read.unwrap_or_else(|error| panic!("{name}: {error}"));
        judge(name, bytes.len(), held);
    }
    for (name, text) in volumes() {
        let (read, held) = most_held(|| mesh_of(Path::new(name), text.as_bytes()));
        read.unwrap_or_else(|error| panic!("{name}: {error}"));
        judge(&format!("cells {name}"), text.len(), held);
    }
    for (name, text) in matrices() {
        let key = name.ends_with("bdf").then_some("KAA");
        let (read, held) = most_held(|| matrix_of(Path::new(name), text.as_bytes(), key));
        read.unwrap_or_else(|error| panic!("{name}: {error}"));
        judge(&format!("matrix {name}"), text.len(), held);
    }
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in tables() {
        let path = folder.path().join(name);
        fs::write(&path, &text).unwrap();
        let (read, held) = most_held(|| read_bodies(&path));
        assert_eq!(read.unwrap_or_else(|error| panic!("{name}: {error}")).rows(), 5000, "{name}");
        judge(&format!("table {name}"), text.len(), held);
    }
    let above: Vec<_> = told.iter().filter(|(_, times)| *times > MOST).collect();
    assert!(above.is_empty(), "{above:.1?} of {told:.1?}");
}
