//! VTK meshes: legacy and XML, arrays that become sets, and refusals by line or byte.
//! Compressed arrays of zeros, a thousand times smaller than their contents, must be refused before memory is taken for them.

use insta::assert_snapshot;
use quasirigid_mesh::Shape;

use super::{bytes, parsed, says, set, with};

const LEGACY: &str = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n0.5\n\
    POINTS 5 float\n0 0 0  1 0 0  0 1 0\n0 0 1\n1 1 1\nCELLS 3 12\n4 0 1 2 3\n1 4\n4 4 1 2 3\nCELL_TYPES 3\n10\n1\n10\n\
    POINT_DATA 5\nSCALARS id int 1\nLOOKUP_TABLE default\n0 1 2 3 4\nVECTORS v float\n0 0 0 1 1 1 2 2 2 3 3 3 4 4 4\n\
    CELL_DATA 3\nSCALARS material int\nLOOKUP_TABLE own\n4 5 4\nLOOKUP_TABLE own 1\n0 0 0 1\n\
    FIELD f 3\nheat 1 3 double\n1 2 3\npart 1 3 unsigned_char\n7 7 8\npair 2 3 int\n1 2 3 4 5 6\nMETADATA\nINFORMATION 0\n\n";

const XML: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n\
    <Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<CellData>\n<DataArray type=\"Int8\" Name=\"part\" format=\"ascii\">\n3\n\
    </DataArray>\n</CellData>\n<Points>\n<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">\n\
    0 0 0 1 0 0\n0 1 0 0 0 1\n</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n\
    0 1 2 3\n</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n\
    <DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

#[test]
fn arrays_among_other_data_become_sets() {
    let mesh = parsed("a.vtk", LEGACY);
    assert_eq!(mesh.nodes[4], [1.0, 1.0, 1.0]);
    let cells: Vec<_> = mesh.cells.iter().map(|cell| (cell.label, cell.shape, cell.nodes.to_vec())).collect();
    assert_eq!(cells, [(0, Shape::Tet4, vec![0, 1, 2, 3]), (2, Shape::Tet4, vec![4, 1, 2, 3])]);
    let names: Vec<&str> = mesh.sets.iter().map(|set| set.name.as_str()).collect();
    assert_eq!(names, ["material=4", "part=7", "part=8"]);
    assert_eq!((&*set(&mesh, "material=4").cells, &*set(&mesh, "part=8").cells), (&[0, 1][..], &[1][..]));
}

/// Base64 by hand: a length of 4 bytes and one type, 10, in one run or in two; a length of 8 bytes has no other choice.
#[test]
fn lengths_are_encoded_with_their_bytes_or_apart() {
    let types = |text: &str, head: &str| {
        let array = "Name=\"types\" format=\"ascii\">10<";
        let xml = XML.replace(array, &format!("Name=\"types\" format=\"binary\">{text}<"));
        parsed("a.vtu", xml.replace("byte_order", &format!("{head} byte_order"))).cells[0].shape
    };
    assert_eq!(types("AQAAAAo=", ""), Shape::Tet4);
    assert_eq!(types("AQAAAA==Cg==", ""), Shape::Tet4);
    assert_eq!(types("AQAAAAAAAAAK", "header_type=\"UInt64\""), Shape::Tet4);
    assert_eq!(types("AQAAAAAAAAA=\n  Cg==\n", "header_type=\"UInt64\""), Shape::Tet4);
}

#[test]
fn arrays_of_many_values_make_no_sets() {
    let count = 1001;
    let lines = |value: &dyn Fn(usize) -> String| (0..count).map(value).collect::<Vec<_>>().join("\n");
    let file = format!(
        "# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 int\n0 0 0 1 0 0\nCELLS {count} {}\n{}\n\
         CELL_TYPES {count}\n{}\nCELL_DATA {count}\nSCALARS id int\nLOOKUP_TABLE default\n{}\nSCALARS half int\n{}\n",
        3 * count,
        lines(&|_| "2 0 1".into()),
        lines(&|_| "3".into()),
        lines(&|cell| cell.to_string()),
        lines(&|cell| (cell.min(999)).to_string()),
    );
    let mesh = parsed("a.vtk", file);
    assert_eq!((mesh.cells.len(), mesh.sets.len()), (count, 1000));
    assert_eq!(set(&mesh, "half=999").cells, [999, 1000]);
}

#[test]
fn legacy_files_are_refused_by_line() {
    assert_snapshot!(with(LEGACY, "Version 3.0", "Version 6.0"), @r##"a:1: "# vtk DataFile Version 6.0" is not read; save gmsh meshes as version 2.2 or 4.1, VTK grids as version 2 to 5"##);
    assert_snapshot!(with(LEGACY, "ASCII", "TEXT"), @r#"a:3: "TEXT" is not allowed here; a VTK file of cells has ASCII or BINARY, DATASET UNSTRUCTURED_GRID, POINTS, CELLS and CELL_TYPES, then CELL_DATA and POINT_DATA"#);
    assert_snapshot!(with(LEGACY, "UNSTRUCTURED_GRID", "POLYDATA"), @r#"a:4: "DATASET POLYDATA" is not allowed here; a VTK file of cells has ASCII or BINARY, DATASET UNSTRUCTURED_GRID, POINTS, CELLS and CELL_TYPES, then CELL_DATA and POINT_DATA"#);
    assert_snapshot!(with(LEGACY, "POINTS 5", "POINTS 6"), @r#"a:12: the array "POINTS" has 15 values instead of 18; is the file damaged?"#);
    assert_snapshot!(with(LEGACY, "POINTS 5", "POINTS 1000000000"), @r#"a:12: the array "POINTS" has 15 values instead of 3000000000; is the file damaged?"#);
    assert_snapshot!(with(LEGACY, "POINTS 5", "POINTS five"), @r#"a:8: "five" is not a number; a keyword is expected here, perhaps with name, type and number of the values after it"#);
    assert_snapshot!(with(LEGACY, "CELLS 3 12", "\u{b}\nCELLS 3 12"), @r#"a:12: "\u{b}" is not allowed here; a VTK file of cells has ASCII or BINARY, DATASET UNSTRUCTURED_GRID, POINTS, CELLS and CELL_TYPES, then CELL_DATA and POINT_DATA"#);
    assert_snapshot!(with(LEGACY, "5 float", "5 complex"), @r#"a:8: values of type "complex" are not read; save them as numbers"#);
    assert_snapshot!(with(LEGACY, "0 0 1\n1 1 1", "0 0 1\n1 inf 1"), @"a:11: the coordinate inf of node 4 is not finite; correct it, or leave out the node and its cells");
    assert_snapshot!(with(LEGACY, "4 4 1 2 3", "4 5 1 2 3"), @"a:15: cell 2 names node 5, which is not among the nodes before it; was the node left out?");
    assert_snapshot!(with(LEGACY, "4 4 1 2 3", "4 -1 1 2 3"), @"a:15: -1 is not a number of nodes or cells; is the file damaged?");
    assert_snapshot!(with(LEGACY, "4 4 1 2 3", "3 4 1 2 3"), @"a:15: 3 nodes for a tetrahedron of 4 nodes; is the type of the cell right?");
    assert_snapshot!(with(LEGACY, "4 4 1 2 3", "5 4 1 2 3"), @"a:15: the nodes of cell 2 end at 13, of 12 and after 8; offsets must rise up to the last");
    assert_snapshot!(with(LEGACY, "10\n1\n10", "10\n1\n32"), @"a:19: cells of type 32 (wedge of 18 nodes) are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes");
    assert_snapshot!(with(LEGACY, "10\n1\n10", "10\n1\n1.5"), @r#"a:19: "1.5" is not a number; an array has as many numbers as its line announces, of the type it announces"#);
    assert_snapshot!(with(LEGACY, "CELL_TYPES 3\n10", "CELL_TYPES 2"), @r#"a:17: the array "CELL_TYPES" has 2 values instead of 3; is the file damaged?"#);
    assert_snapshot!(says("a.vtk", &LEGACY[..LEGACY.find("CELL_TYPES").unwrap()]), @"a.vtk:15: the file ends without CELL_TYPES; was it cut off?");
    assert_snapshot!(with(LEGACY, "material", "a b"), @r#"a:27: "int" is not a number; a keyword is expected here, perhaps with name, type and number of the values after it"#);
}

#[test]
fn binary_legacy_files_are_refused_by_byte() {
    let file = bytes("zoo-5.1-binary.vtk");
    assert_snapshot!(says("a.vtk", &file[..2000]), @r#"a.vtk: byte 2000: the file ends after 238 of 375 values of "POINTS"; was it cut off, or is the number wrong?"#);
    let points = file.windows(7).position(|window| window == b"double\n").unwrap() + 7;
    let mut changed = file.clone();
    changed[points + 8..points + 16].fill(0xFF);
    assert_snapshot!(says("a.vtk", changed), @"a.vtk: byte 97: the coordinate NaN of node 0 is not finite; correct it, or leave out the node and its cells");
}

#[test]
fn xml_is_refused_by_line() {
    assert_eq!(parsed("a.vtu", XML).sets[0].name, "part=3");
    assert_snapshot!(with(XML, "</Cells>", "</Cell>"), @"a:22: the XML is damaged at column 1; was the file cut off, or not written by VTK?");
    assert_snapshot!(with(XML, "type=\"UnstructuredGrid\"", "type=\"PolyData\""), @r#"a:2: <VTKFile> lacks type="UnstructuredGrid", or it cannot be understood; save an unstructured grid by a program based on VTK"#);
    assert_snapshot!(with(XML, "\"LittleEndian\"", "\"LittleEndian\" compressor=\"vtkLZ4DataCompressor\""), @r#"a:2: the compression "vtkLZ4DataCompressor" is not read; save with zlib or without compression"#);
    assert_snapshot!(with(XML, "NumberOfPoints=\"4\"", "NumberOfPoints=\"5\""), @r#"a:12: the array "Points" has 12 values instead of 15; is the file damaged?"#);
    assert_snapshot!(with(XML, "NumberOfCells=\"1\"", "NumberOfCells=\"many\""), @"a:4: <Piece> lacks NumberOfCells, or it cannot be understood; save an unstructured grid by a program based on VTK");
    assert_snapshot!(with(XML, "NumberOfCells=\"1\"", "NumberOfCells=\"1000000000000\""), @r#"a:20: the array "offsets" has 1 values instead of 1000000000000; is the file damaged?"#);
    assert_snapshot!(with(XML, "Name=\"offsets\"", "Name=\"ends\""), @r#"a:16: <Cells> lacks <DataArray Name="offsets">, or it cannot be understood; save an unstructured grid by a program based on VTK"#);
    assert_snapshot!(with(XML, "0 1 0 0 0 1", "0 1 0 0 0 x"), @r#"a:13: "x" is not a number; an array has as many numbers as its line announces, of the type it announces"#);
    assert_snapshot!(with(XML, "0 1 0 0 0 1", "0 nan 0 0 0 1"), @"a:13: the coordinate NaN of node 2 is not finite; correct it, or leave out the node and its cells");
    assert_snapshot!(with(XML, "0 1 2 3", "0 1\n2 4"), @"a:18: cell 0 names node 4, which is not among the nodes before it; was the node left out?");
    assert_snapshot!(with(XML, ">4<", ">5<"), @"a:20: the nodes of cell 0 end at 5, of 4 and after 0; offsets must rise up to the last");
    assert_snapshot!(with(XML, ">4<", ">3<"), @"a:18: 3 nodes for a tetrahedron of 4 nodes; is the type of the cell right?");
    assert_snapshot!(with(XML, ">10<", ">42<"), @"a:21: cells of type 42 (polyhedron) are not read; lines, triangles, quadrilaterals, tetrahedra, wedges and hexahedra of first or second order are, but no wedges of 18 nodes");
    assert_snapshot!(with(XML, "format=\"ascii\">10<", "format=\"binary\">AQAAAA!=<"), @r#"a:21: the array "types" is not base64 text, or it is cut off; was the file edited?"#);
    assert_snapshot!(with(XML, "format=\"ascii\">10<", "format=\"appended\" offset=\"9\"><"), @"a:21: <DataArray> lacks offset, or it cannot be understood; save an unstructured grid by a program based on VTK");
}

#[test]
fn damaged_blocks_are_named() {
    let mut file = bytes("zoo-raw-zlib.vtu");
    let data = file
        .windows(4)
        .rposition(|window| window == b"\x78\x5E\x63\x60" || window[..2] == *b"\x78\x5E")
        .unwrap();
    file[data + 4] ^= 0xFF;
    assert_snapshot!(says("a.vtu", file), @r#"a.vtu:39: block 0 of the array "types" cannot be decompressed; is the file damaged?"#);
}

/// 64 MiB of zeros are 64 kB in a file: they are refused by the counts of the file before anything of that size is made.
#[test]
fn arrays_that_decompress_to_more_than_the_counts_need_are_refused() {
    let block = 1usize << 22;
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&vec![0; block], 6);
    let array = |blocks: usize, points: bool| {
        let point = miniz_oxide::deflate::compress_to_vec_zlib(&[0; 12], 6);
        let (count, size, packed) = if points { (1, 12, &point) } else { (blocks, block, &packed) };
        let head = [count as u64, size as u64, 0].into_iter().chain(vec![packed.len() as u64; count]);
        let mut bytes: Vec<u8> = head.flat_map(u64::to_le_bytes).collect();
        (0..count).for_each(|_| bytes.extend(packed));
        bytes
    };
    let file = |cells: u64, blocks: usize| {
        let (points, zeros) = (array(1, true), array(blocks, false));
        let names = ["connectivity", "offsets", "types"].map(|name| {
            format!(
                "<DataArray type=\"UInt8\" Name=\"{name}\" format=\"appended\" offset=\"{}\"/>",
                points.len()
            )
        });
        let head = format!(
            "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" NumberOfCells=\"{cells}\"><Points>\
             <DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points><Cells>{}</Cells></Piece>\
             </UnstructuredGrid><AppendedData encoding=\"raw\">_",
            names.concat()
        );
        [head.as_bytes(), &points, &zeros, b"</AppendedData></VTKFile>"].concat()
    };
    let few = says("a.vtu", file(1000, 4));
    assert!(few.contains("array \"connectivity\" decompresses to more than 27000 bytes"), "{few}");
    let many = says("a.vtu", file(16 << 22, 16));
    assert!(many.contains("decompresses to more than 16777216 bytes"), "{many}");
    let enough = says("a.vtu", file(4 << 22, 4));
    assert!(enough.contains("cells of type 0 are not read"), "{enough}");
}
