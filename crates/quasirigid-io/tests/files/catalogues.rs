//! Tables of bodies as catalogues have them: separators, fixed width, units, rules, VOTable, workbooks; what is made of each is told.

use std::fs;
use std::io::Write;

use quasirigid_io::table_file::{BodyTable, TableError, read_bodies};
use tempfile::TempDir;
use zip::write::SimpleFileOptions;

fn read(name: &str, bytes: &[u8]) -> Result<BodyTable, TableError> {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    read_bodies(&path)
}

fn table(text: &str) -> BodyTable {
    read("bodies.txt", text.as_bytes()).unwrap()
}

fn unit<'a>(table: &'a BodyTable, name: &str) -> Option<&'a str> {
    table.units[table.column(name).unwrap()].as_deref()
}

/// The same three bodies in every form.
#[test]
fn every_form_gives_the_same_bodies() {
    let forms = [
        ("comma", "name,P [h],D [km]\n2004 FH,0.05,0.03\nToutatis,130,2.45\nEros,5.27,\n"),
        ("tab", "name\tP [h]\tD [km]\n2004 FH\t0.05\t0.03\nToutatis\t130\t2.45\nEros\t5.27\t\n"),
        ("decimal commas", "name;P [h];D [km]\n2004 FH;0,05;0,03\nToutatis;130;2,45\nEros;5,27;\n"),
        (
            "fixed width",
            "name      P [h]  D [km]\n2004 FH   0.05   0.03\nToutatis  130    2.45\nEros      5.27\n",
        ),
        (
            "fixed width with a rule",
            "name      P [h]  D [km]\n--------  -----  ------\n2004 FH   0.05   0.03\nToutatis  130    2.45\nEros      5.27\n",
        ),
        (
            "units and a rule below, as VizieR",
            "#comment\nname\tP\tD\n \th\tkm\n--------\t-----\t----\n2004 FH\t0.05\t0.03\nToutatis\t130\t2.45\nEros\t5.27\t\n",
        ),
        (
            "names in a comment",
            "# a catalogue\n#name,P [h],D [km]\n2004 FH,0.05,0.03\nToutatis,130,2.45\nEros,5.27,\n",
        ),
    ];
    for (form, text) in forms {
        for text in [text.to_owned(), text.replace('\n', "\r\n")] {
            let table = table(&text);
            assert_eq!(table.columns[0], ["2004 FH", "Toutatis", "Eros"], "{form}: {:?}", table.notes);
            assert_eq!(table.columns[1], ["0.05", "130", "5.27"], "{form}");
            assert_eq!(table.columns[2], ["0.03", "2.45", ""], "{form}");
            assert_eq!(
                (unit(&table, "P"), unit(&table, "D"), unit(&table, "name")),
                (Some("h"), Some("km"), if form.starts_with("units") { Some("") } else { None }),
                "{form}"
            );
            assert!(table.unread.is_empty(), "{form}: {:?}", table.unread);
            assert_eq!(table.notes.is_empty(), form == "comma", "{form}: {:?}", table.notes);
        }
    }
}

#[test]
fn what_the_reader_made_of_the_file_is_told() {
    let table = table(",name;P\n0,Eros;5,27\n1,Ida;1,234\n");
    assert_eq!(table.names, [",name", "P"]);
    // one digit group of three may be thousands, and is left for the study to refuse
    assert_eq!(table.columns[1], ["5.27", "1,234"]);
    assert!(
        table.notes.iter().any(|note| note == "1 numbers have a comma before their decimals"),
        "{:?}",
        table.notes
    );
    let table = self::table(",name,P\n0,Eros,5.27\n1,Ida,4.63\n");
    assert_eq!(table.names, ["name", "P"]);
    assert_eq!(table.notes, ["column 1 has values but no name, and is left out"]);
}

#[test]
fn rows_of_text_are_no_units() {
    // "m" and "s" are names here: no number stands below them
    let table = table("a,b\nm,s\nx,y\n");
    assert_eq!((table.rows(), unit(&table, "a")), (2, None));
    let table = self::table("a,b\nm,s\n1,2\n");
    assert_eq!((table.rows(), unit(&table, "a"), unit(&table, "b")), (1, Some("m"), Some("s")));
}

const VOTABLE: &str = r#"<?xml version="1.0"?>
<VOTABLE version="1.4" xmlns="http://www.ivoa.net/xml/VOTable/v1.3"><RESOURCE><TABLE>
<FIELD name="name" datatype="char" arraysize="*"/>
<FIELD name="Per" datatype="double" unit="h"><VALUES null="-9.99"/></FIELD>
<FIELD name="rho" datatype="double" unit="g/cm3"/>
<DATA><TABLEDATA>
<TR><TD>Eros</TD><TD>5.27</TD><TD>2.67</TD></TR>
<TR><TD>A &amp; B</TD><TD>-9.99</TD><TD/></TR>
<TR><TD>short</TD><TD>1</TD></TR>
</TABLEDATA></DATA></TABLE></RESOURCE></VOTABLE>
"#;

#[test]
fn votable_has_fields_units_and_nulls() {
    let table = read("bodies.vot", VOTABLE.as_bytes()).unwrap();
    assert_eq!(table.names, ["name", "Per", "rho"]);
    assert_eq!(table.columns, [["Eros", "A & B", ""], ["5.27", "", ""], ["2.67", "", ""]]);
    assert_eq!((unit(&table, "Per"), unit(&table, "rho")), (Some("h"), Some("g/cm^3")));
    assert_eq!(table.unread[&2], "line 9 of the table has 2 values, but the header has 3");
    let binary = VOTABLE.replace("TABLEDATA", "BINARY");
    let refused = read("bodies.vot", binary.as_bytes()).unwrap_err().to_string();
    assert!(refused.contains("its rows are in binary form; save the VOTable as TABLEDATA"), "{refused}");
    let old = VOTABLE
        .replace("<VOTABLE", "<!DOCTYPE VOTABLE SYSTEM \"http://us-vo.org/xml/VOTable.dtd\">\n<VOTABLE");
    assert_eq!(read("bodies.vot", old.as_bytes()).unwrap().columns, table.columns);
    let grows = VOTABLE.replace("<VOTABLE", "<!DOCTYPE VOTABLE [<!ENTITY a \"aaaa\">]>\n<VOTABLE");
    assert!(
        read("bodies.vot", grows.as_bytes()).unwrap_err().to_string().contains("defines entities of its own")
    );
    let cut = &VOTABLE[..VOTABLE.len() / 2];
    assert!(read("bodies.vot", cut.as_bytes()).unwrap_err().to_string().contains("this is not valid XML"));
}

/// A workbook with shared texts, a text in place, a formula with its value, a cell left out, and a row of style alone.
fn workbook() -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let sheet = r#"<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>
<row r="1"><c r="A1" t="s"><v>0</v></c><c r="B1" t="s"><v>1</v></c><c r="C1" t="inlineStr"><is><t>D [km]</t></is></c></row>
<row r="2"><c r="A2" t="s"><v>2</v></c><c r="B2"><f>1+4.27</f><v>5.27</v></c><c r="C2"><v>16.8</v></c></row>
<row r="3"><c r="A3" s="1"/></row>
<row r="4"><c r="A4" t="inlineStr"><is><r><t>Tou</t></r><r><t>tatis</t></r></is></c><c r="C4"><v>2.45</v></c></row>
</sheetData></worksheet>"#;
    let texts = r#"<sst xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><si><t>name</t></si><si><t>P [h]</t></si><si><t>Eros</t></si></sst>"#;
    for (name, text) in [
        ("xl/worksheets/sheet1.xml", sheet),
        ("xl/worksheets/sheet2.xml", "<x/>"),
        ("xl/sharedStrings.xml", texts),
    ] {
        archive.start_file(name, SimpleFileOptions::default()).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn workbook_gives_its_first_sheet() {
    let table = read("bodies.xlsx", &workbook()).unwrap();
    assert_eq!(table.columns, [["Eros", "Toutatis"], ["5.27", ""], ["16.8", "2.45"]]);
    assert_eq!(unit(&table, "P"), Some("h"));
    assert_eq!(table.notes, ["the first sheet of a workbook", "1 further sheets are left out"]);
    let mut other = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    other.start_file("a.txt", SimpleFileOptions::default()).unwrap();
    let refused = read("bodies.csv", &other.finish().unwrap().into_inner()).unwrap_err().to_string();
    assert!(refused.contains("not a workbook of Excel"), "{refused}");
}
