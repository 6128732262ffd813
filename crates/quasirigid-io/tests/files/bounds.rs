//! Files that announce or unpack to far more than they hold are refused before the memory is taken.

use std::fs::{self, File};
use std::io::{Cursor, Write};
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{Repetition, Type as Physical};
use parquet::column::writer::ColumnWriter;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use quasirigid_io::matrix::matrix_of;
use quasirigid_io::mesh::{mesh_of, triangles_of};
use quasirigid_io::record::{RecordError, RunRecord, TableFormat};
use quasirigid_io::table_file::{CellColumn, Cells, TableError, read_bodies, read_parquet, write_parquet};
use serde_json::Value;
use tempfile::tempdir;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::record::sample;
use crate::heap::watched;

const MIB: usize = 1024 * 1024;

/// An archive of one array of so many zeros, a thousand times smaller than they.
fn archive(name: &str, zeros: usize) -> Vec<u8> {
    let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({zeros},), }}");
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(CompressionMethod::Deflated);
    zip.start_file(name, options).unwrap();
    zip.write_all(b"\x93NUMPY\x01\x00").unwrap();
    zip.write_all(&(text.len() as u16).to_le_bytes()).unwrap();
    zip.write_all(text.as_bytes()).unwrap();
    let block = vec![0; MIB];
    (0..8 * zeros / MIB).for_each(|_| zip.write_all(&block).unwrap());
    zip.finish().unwrap().into_inner()
}

#[test]
fn archives_unpack_to_a_multiple_of_their_size_and_no_further() {
    let whole = archive("t.npy", 8 * MIB - 1024);
    assert!(whole.len() < 100_000, "{}", whole.len());
    let bomb = archive("t.npy", 16 * MIB);
    let (refused, largest) = watched(|| matrix_of(Path::new("a.npz"), &bomb, None).unwrap_err().to_string());
    assert!(refused.contains("more than 64 MiB") && largest <= 128 * MIB, "{refused} {largest}");

    let dir = tempdir().unwrap();
    sample().write(dir.path(), &[TableFormat::Npz]).unwrap();
    fs::write(dir.path().join("history-reduced.npz"), &bomb).unwrap();
    let (refused, largest) = watched(|| RunRecord::read(dir.path()).unwrap_err());
    assert!(
        matches!(&refused, RecordError::Table { problem, .. } if problem.contains("more than 64 MiB")),
        "{refused}"
    );
    assert!(largest <= 128 * MIB, "{largest}");
}

/// The end of an archive announces four billion files, or a directory of as many bytes.
#[test]
fn directory_of_an_archive_is_not_believed() {
    let good = archive("t.npy", MIB);
    let end = good.len() - 22;
    for (place, width) in [(8, 4), (12, 4), (16, 4)] {
        let mut bytes = good.clone();
        bytes[end + place..end + place + width].fill(0xfe);
        let (_, largest) = watched(|| matrix_of(Path::new("a.npz"), &bytes, None));
        assert!(largest <= 16 * MIB, "byte {place}: {largest}");
    }
}

#[test]
fn headers_with_absurd_counts_are_not_believed() {
    let npy = |shape: &str| {
        let text = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        [b"\x93NUMPY\x01\x00".as_slice(), &(text.len() as u16).to_le_bytes(), text.as_bytes(), &[0; 64]]
            .concat()
    };
    let matrices: [(&str, Vec<u8>); 5] = [
        ("a.npy", npy("(4000000000, 4000000000)")),
        ("a.npy", npy("(1,) * 99999999999")),
        (
            "a.mtx",
            b"%%MatrixMarket matrix coordinate real general\n900000000 900000000 99999999999\n1 1 1\n"
                .to_vec(),
        ),
        ("a.mtx", b"%%MatrixMarket matrix array real general\n900000000 900000000\n1\n".to_vec()),
        (
            "a.op4",
            b"  99999999  99999999       2       2K       1P,3E23.16\n       1       1       2\n 1.0E+00\n"
                .to_vec(),
        ),
    ];
    for (name, bytes) in matrices {
        let (read, largest) = watched(|| matrix_of(Path::new(name), &bytes, None));
        assert!(read.is_err() && largest < MIB, "{name}: {largest}");
    }
    let stl = [&[b' '; 80][..], &u32::MAX.to_le_bytes(), &[0; 50]].concat();
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\nproperty double y\n\
               property double z\nelement face 4000000000\nproperty list uchar int vertex_indices\nend_header\nxxxx";
    for (name, bytes) in [("a.stl", stl), ("a.ply", ply.into())] {
        let (read, largest) = watched(|| triangles_of(Path::new(name), &bytes));
        assert!(read.is_err() && largest < MIB, "{name}: {largest}");
    }
    let vtk =
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4000000000 double\n0 0 0\n";
    let msh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999\n1 0 0 0\n$EndNodes\n";
    let msh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 99999999999 1 99999999999\n0 1 0 99999999999\n1\n0 0 0\n$EndNodes\n";
    let vtu = "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"9999999999999999999\" \
               NumberOfCells=\"9999999999999999999\"><Points><DataArray type=\"Float64\">0 0 0</DataArray></Points>\
               </Piece></UnstructuredGrid></VTKFile>";
    for (name, text) in [("a.vtk", vtk), ("a.msh", msh), ("b.msh", msh4), ("a.vtu", vtu)] {
        let (read, largest) = watched(|| mesh_of(Path::new(name), text.as_bytes()));
        assert!(read.is_err() && largest < MIB, "{name}: {largest}");
    }
}

/// Entities that name each other, a thousand million laughs in the end, and entities that name files.
#[test]
fn xml_has_no_entities_and_bounded_depth() {
    let mut laughs = "<!ENTITY a0 \"ha\">".to_owned();
    for level in 1..10 {
        let ten = format!("&a{};", level - 1).repeat(10);
        laughs.push_str(&format!("<!ENTITY a{level} \"{ten}\">"));
    }
    for (entities, name) in [(&*laughs, "a9"), ("<!ENTITY f SYSTEM \"file:///etc/passwd\">", "f")] {
        let text = format!(
            "<?xml version=\"1.0\"?><!DOCTYPE VTKFile [{entities}]><VTKFile type=\"UnstructuredGrid\">&{name};</VTKFile>"
        );
        let (read, largest) = watched(|| mesh_of(Path::new("a.vtu"), text.as_bytes()));
        assert!(read.is_err() && largest < MIB, "{largest}");
    }
    let deep = format!("<VTKFile type=\"UnstructuredGrid\">{}", "<a>".repeat(1_000_000));
    let (read, largest) = watched(|| mesh_of(Path::new("a.vtu"), deep.as_bytes()));
    assert!(read.is_err() && largest < 256 * MIB, "{largest}");
    let long = format!("<VTKFile type=\"UnstructuredGrid\" version=\"{}\"/>", "1".repeat(MIB));
    let (read, largest) = watched(|| mesh_of(Path::new("a.vtu"), long.as_bytes()));
    assert!(read.is_err() && largest < 8 * MIB, "{largest}");
}

/// Equal texts take the room of one in a Parquet file, and equal numbers or missing ones next to none.
#[test]
fn tables_of_equal_values_are_bounded() {
    let dir = tempdir().unwrap();
    let written = |name: &str, cells: Cells| {
        let path = dir.path().join(name);
        let columns = [CellColumn { name: "a".into(), unit: String::new(), cells }];
        write_parquet(&path, File::create(&path).unwrap(), &columns, &[]).unwrap();
        assert!(path.metadata().unwrap().len() < 100_000);
        path
    };
    let path = written("texts.parquet", Cells::Texts(vec![Some("x".repeat(16 * 1024)); 5000]));
    let (refused, largest) = watched(|| read_bodies(&path).unwrap_err());
    assert!(
        matches!(&refused, TableError::Parquet { cause, .. } if cause.contains("more than 64 MiB")),
        "{refused}"
    );
    assert!(largest < 8 * MIB, "{largest}");
    let path = written("rows.parquet", Cells::Booleans(vec![None; 1_000_001]));
    let (refused, largest) = watched(|| read_parquet(&path, None).unwrap_err());
    assert!(refused.to_string().contains("1000001 rows"), "{refused}");
    assert!(largest < MIB, "{largest}");
    let path = written("part.parquet", Cells::Booleans(vec![None; 1_000_000]));
    assert_eq!(read_parquet(&path, None).unwrap()[0].len(), 1_000_000);
}

/// A history of any length, even in one row group, passes through little memory.
#[test]
fn long_history_in_one_group_takes_little_memory() {
    const ROWS: usize = 4_000_000;
    let (dir, record) = (tempdir().unwrap(), sample());
    record.write(dir.path(), &[TableFormat::Parquet]).unwrap();
    let json = dir.path().join("record.json");
    let mut document: Value = serde_json::from_slice(&fs::read(&json).unwrap()).unwrap();
    document["histories"][0]["rows"] = ROWS.into();
    fs::write(&json, document.to_string()).unwrap();
    let column = |name: &str| {
        let field =
            Type::primitive_type_builder(name, Physical::DOUBLE).with_repetition(Repetition::REQUIRED);
        Arc::new(field.build().unwrap())
    };
    let names: Vec<_> = record.histories[0].columns.iter().map(|each| column(&each.name)).collect();
    let schema = Arc::new(Type::group_type_builder("rows").with_fields(names.clone()).build().unwrap());
    let file = dir.path().join("history-reduced.parquet");
    let mut writer = SerializedFileWriter::new(File::create(&file).unwrap(), schema, Arc::default()).unwrap();
    let mut group = writer.next_row_group().unwrap();
    for _ in names {
        let mut place = group.next_column().unwrap().unwrap();
        let ColumnWriter::DoubleColumnWriter(out) = place.untyped() else { unreachable!() };
        out.write_batch(&vec![1.0; ROWS], None, None).unwrap();
        place.close().unwrap();
    }
    group.close().unwrap();
    writer.close().unwrap();
    assert!(file.metadata().unwrap().len() < 100_000);
    let (read, largest) = watched(|| RunRecord::read(dir.path()).unwrap());
    assert_eq!(read.histories[0].rows, ROWS as u64);
    assert!(largest < 8 * MIB, "{largest}");
}

#[cfg(unix)]
#[test]
fn table_of_bodies_that_never_ends_is_refused() {
    for path in ["/dev/zero", "/"] {
        assert!(matches!(read_bodies(Path::new(path)), Err(TableError::NoFile { .. })), "{path}");
    }
}
