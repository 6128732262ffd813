//! Tables of many rows: what is written as Parquet is read back to the bit, and bad lines of a table of bodies are kept apart.

use std::fs;

use quasirigid_io::table_file::{
    CellColumn, Cells, TableError, csv_header, csv_rows, read_bodies, read_parquet, write_parquet,
};
use tempfile::TempDir;

fn columns() -> Vec<CellColumn> {
    let column = |name: &str, unit: &str, cells| CellColumn { name: name.into(), unit: unit.into(), cells };
    let numbers = [Some(0.1), None, Some(f64::INFINITY), Some(5e-324), Some(-0.0)];
    vec![
        column("row", "", Cells::Counts((0..5).collect())),
        column("spring.1.stiffness", "N/m", Cells::Numbers(numbers.to_vec())),
        column("valid", "", Cells::Booleans(vec![Some(true), None, Some(false), None, None])),
        column(
            "name, \"x\"",
            "",
            Cells::Texts(vec![Some("a".into()), None, Some("é\n,\"".into()), Some(String::new()), None]),
        ),
        column("empty", "s", Cells::Numbers(vec![None; 5])),
    ]
}

#[test]
fn parquet_is_read_back_to_the_bit() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("part.parquet");
    let bytes = |metadata: &[(&str, String)]| {
        let mut bytes = Vec::new();
        write_parquet(&path, &mut bytes, &columns(), metadata).unwrap();
        bytes
    };
    let metadata = [("quasirigid.study", "abc".to_owned())];
    fs::write(&path, bytes(&metadata)).unwrap();
    assert_eq!(read_parquet(&path, None).unwrap(), columns());
    assert_eq!(read_parquet(&path, Some(&["valid"])).unwrap(), columns()[2..3]);
    assert_eq!(bytes(&metadata), bytes(&metadata), "the same columns give the same bytes");
    let bodies = read_bodies(&path).unwrap();
    assert_eq!(bodies.columns[1], ["0.1", "", "inf", "5e-324", "-0.0"]);
}

#[test]
fn csv_quotes_what_needs_quotes() {
    let text = [csv_header(&columns()), csv_rows(&columns())].concat();
    let text = String::from_utf8(text).unwrap();
    assert_eq!(text.lines().next(), Some("row,spring.1.stiffness [N/m],valid,\"name, \"\"x\"\"\",empty [s]"));
    assert_eq!(text.lines().nth(1), Some("0,0.1,true,a,"));
}

#[test]
fn lines_that_cannot_be_read_are_kept_apart() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("bodies.csv");
    fs::write(&path, b"\xef\xbb\xbfa, b\n# a comment\n1,2\n3\n4,\xff\n5,6,7\n\n8,9\n").unwrap();
    let bodies = read_bodies(&path).unwrap();
    assert_eq!(bodies.names, ["a", "b"]);
    assert_eq!(bodies.columns[0], ["1", "", "", "", "8"]);
    let reasons: Vec<_> = bodies.unread.iter().map(|(row, reason)| (*row, reason.as_str())).collect();
    assert_eq!(
        reasons,
        [
            (1, "line 4 of the table has 1 values, but the header has 2"),
            (2, "line 5 of the table is not UTF-8 text"),
            (3, "line 6 of the table has 3 values, but the header has 2"),
        ]
    );
}

/// A quotation mark without its partner used to take the rows up to the next mark.
#[test]
fn lone_quotation_mark_spoils_its_own_line_alone() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("bodies.csv");
    let good = "\"x, \"\"y\"\"\",2\n";
    let text = format!("a,b\n# a \"comment\n{good}\"lone,1\n\n{good}3\",\"4\n{good}5\",6\n");
    for text in [text.clone(), text.replace('\n', "\r\n"), format!("\u{feff}{text}")] {
        fs::write(&path, text).unwrap();
        let bodies = read_bodies(&path).unwrap();
        assert_eq!(bodies.columns[0], ["x, \"y\"", "", "x, \"y\"", "", "x, \"y\"", "5\""]);
        let lines: Vec<_> = bodies.unread.values().map(String::as_str).collect();
        let reason =
            |line: usize| format!("a quotation mark in line {line} of the table is not closed on that line");
        assert_eq!(lines, [reason(4), reason(7)]);
    }
    fs::write(&path, "a,b\r1,2\r3,4\r").unwrap(); // lines as they ended on a Macintosh
    assert_eq!(read_bodies(&path).unwrap().columns, [["1", "3"], ["2", "4"]]);
    for names in ["\"a,b\n1,2\n", "\u{feff}\"a,b\n1,2\n"] {
        fs::write(&path, names).unwrap();
        assert!(matches!(read_bodies(&path), Err(TableError::Names { .. })));
    }
}

/// Programs of tables end every line with a comma.
#[test]
fn commas_at_the_end_of_lines_make_no_column() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("bodies.csv");
    for text in ["a,b,\n1,2,\n3,4,\n", "a,b\n1,2,\n3,4,,\n", "a,,b,\n1,,2,\n3,,4,\n"] {
        fs::write(&path, text).unwrap();
        let bodies = read_bodies(&path).unwrap();
        assert_eq!(
            (bodies.names, bodies.columns),
            (
                vec!["a".into(), "b".into()],
                vec![vec!["1".to_owned(), "3".into()], vec!["2".into(), "4".into()],]
            ),
            "{text}"
        );
        assert!(bodies.unread.is_empty());
    }
    fs::write(&path, ",,\n,2,\n").unwrap();
    let refused = read_bodies(&path).unwrap_err();
    assert!(matches!(refused, TableError::Unnamed { column: 2, .. }), "{refused}");
}

#[test]
fn tables_that_are_none_are_refused() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    assert!(matches!(read_bodies(&path("none.csv", b"a,b\n")), Err(TableError::Empty { .. })));
    assert!(matches!(read_bodies(&path("empty.csv", b"")), Err(TableError::Empty { .. })));
    let twice = read_bodies(&path("twice.csv", b"a,b,a\n1,2,3\n")).unwrap();
    assert_eq!(twice.names, ["a_1", "b", "a_2"]);
    assert_eq!(twice.notes, ["columns named a are numbered: a_1, a_2 and so on"]);
    assert!(matches!(read_bodies(&path("bad.parquet", b"PAR1 no")), Err(TableError::Parquet { .. })));
    assert!(matches!(read_bodies(&folder.path().join("missing.csv")), Err(TableError::File { .. })));
}
