//! Tables of bodies as catalogues have them: separators, fixed width, units, rules, VOTable, workbooks; what is made of each is told.

use std::fs;
use std::io::Write;

use base64::Engine;
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
    let spaced = VOTABLE.replace("xmlns=", "xmlns:v=").replace("</", "</v:").replace("<", "<v:");
    let spaced = spaced.replace("<v:/v:", "</v:").replace("<v:?", "<?");
    assert_eq!(read("bodies.vot", spaced.as_bytes()).unwrap(), table);
    let hidden = VOTABLE.replace("<DATA>", "<!-- <TABLEDATA> is below, </TABLEDATA> too --><DATA>");
    assert_eq!(read("bodies.vot", hidden.as_bytes()).unwrap(), table);
    let rows = "<TR><TD>Eros</TD><TD>5.27</TD><TD>2.67</TD></TR>\n";
    let many = read("bodies.vot", VOTABLE.replace(rows, &rows.repeat(4000)).as_bytes()).unwrap();
    assert_eq!((many.rows(), many.unread.len()), (4002, 1), "in several pieces");
    assert_eq!(many.unread[&4001], "line 4008 of the table has 2 values, but the header has 3");
    let fits = VOTABLE.replace("TABLEDATA", "FITS");
    let refused = read("bodies.vot", fits.as_bytes()).unwrap_err().to_string();
    assert!(refused.contains("its rows are in FITS; save the VOTable as TABLEDATA"), "{refused}");
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

/// A table of every kind of field in binary form, with the marks of missing values if asked; the bytes are written here by the layout of
/// the recommendation.
fn binary_votable(flagged: bool) -> String {
    let fields = [
        ("char", "*", ""),
        ("double", "1", "h"),
        ("float", "2", ""),
        ("int", "1", ""),
        ("short", "1", ""),
        ("long", "1", ""),
        ("unsignedByte", "1", ""),
        ("boolean", "1", ""),
        ("bit", "10", ""),
        ("unicodeChar", "4", ""),
    ];
    let mut bytes: Vec<u8> = Vec::new();
    for (row, name) in ["Eros", ""].into_iter().enumerate() {
        let missing = row == 1;
        if flagged {
            bytes.extend(if missing { [0b0000_0100, 0b0100_0000] } else { [0, 0] });
        }
        bytes.extend((name.len() as u32).to_be_bytes());
        bytes.extend(name.bytes());
        bytes.extend(if missing { f64::NAN } else { 5.27 }.to_be_bytes());
        [0.5_f32, -0.25].iter().for_each(|value| bytes.extend(value.to_be_bytes()));
        bytes.extend(if missing { -99_i32 } else { 433 }.to_be_bytes());
        bytes.extend((-7_i16).to_be_bytes());
        bytes.extend(9_007_199_254_740_993_i64.to_be_bytes());
        bytes.extend([200, b'T', 0b1000_0001, 0b0100_0000]);
        "αβ".encode_utf16().chain([0, 0]).for_each(|unit| bytes.extend(unit.to_be_bytes()));
    }
    let fields: String = (0..)
        .zip(fields)
        .map(|(k, (kind, size, unit))| {
            let null = if kind == "int" { r#"<VALUES null="-99"/>"# } else { "" };
            format!(r#"<FIELD name="c{k}" datatype="{kind}" arraysize="{size}" unit="{unit}">{null}</FIELD>"#)
        })
        .collect();
    let stream = base64::engine::general_purpose::STANDARD.encode(bytes);
    let (start, end) = stream.split_at(37);
    let form = if flagged { "BINARY2" } else { "BINARY" };
    format!(
        "<?xml version=\"1.0\"?>\n<VOTABLE><RESOURCE><TABLE>{fields}<DATA><{form}><STREAM encoding=\"base64\">\n{start}\n  {end}\n</STREAM></{form}></DATA></TABLE></RESOURCE></VOTABLE>"
    )
}

#[test]
fn votable_in_binary_form_has_the_texts_of_elements() {
    for flagged in [false, true] {
        let text = binary_votable(flagged);
        let table = read("bodies.xml", text.as_bytes()).unwrap();
        let rows: Vec<Vec<&str>> =
            (0..2).map(|row| table.columns.iter().map(|column| column[row].as_str()).collect()).collect();
        let first = [
            "Eros",
            "5.27",
            "0.5 -0.25",
            "433",
            "-7",
            "9007199254740993",
            "200",
            "true",
            "1 0 0 0 0 0 0 1 0 1",
            "αβ",
        ];
        assert_eq!(rows[0], first, "{flagged}");
        let (long, unicode) = if flagged { ("", "") } else { (first[5], first[9]) };
        assert_eq!(rows[1], ["", "", first[2], "", first[4], long, first[6], first[7], first[8], unicode]);
        assert_eq!(unit(&table, "c1"), Some("h"));
        assert!(table.unread.is_empty());
        let refused = |text: String| read("bodies.xml", text.as_bytes()).unwrap_err().to_string();
        let cut = refused(text.replace("\n  ", "\n").replacen("datatype=\"short\"", "datatype=\"int\"", 1));
        assert!(
            cut.contains("row 2 of its binary rows ends within a value") || cut.contains("row 1"),
            "{cut}"
        );
        assert!(
            refused(text.replace("\"short\"", "\"word\""))
                .contains("the datatype \"word\", which VOTable does not know")
        );
        assert!(
            refused(text.replace("encoding=\"base64\"", "href=\"rows.bin\""))
                .contains("its rows stand in another file")
        );
        assert!(refused(text.replace("\n  ", "\n*")).contains("its rows are not base64"));
    }
    let endless = binary_votable(false).replace("arraysize=\"*\"", "arraysize=\"0\"");
    let endless =
        endless.replace("arraysize=\"1\"", "arraysize=\"0\"").replace("arraysize=\"2\"", "arraysize=\"0\"");
    let endless =
        endless.replace("arraysize=\"10\"", "arraysize=\"0\"").replace("arraysize=\"4\"", "arraysize=\"0\"");
    let refused = read("bodies.xml", endless.as_bytes()).unwrap_err().to_string();
    assert!(refused.contains("its fields have no length"), "{refused}");
}

/// The layout of the summary of the lightcurve database LCDB, by its published map of columns: three lines of titles, names, a rule; flags
/// without a name, names of columns that stand twice, columns without values, and widths that show in later rows alone.
#[test]
fn lightcurve_database_reads_as_it_is() {
    let columns = [
        ("NUMBER", 0),
        ("NAME", 10),
        ("DESIG", 41),
        ("FAM", 62),
        ("S", 71),
        ("CLASS", 73),
        ("S", 84),
        ("F", 86),
        ("DIA.", 88),
        ("S", 97),
        ("H", 99),
        ("B", 106),
        ("S", 109),
        ("G", 111),
        ("S", 132),
        ("F", 134),
        ("ALBEDO", 136),
        ("F", 143),
        ("PERIOD", 145),
        ("U", 183),
        ("NOTES", 186),
        ("PRI", 208),
    ];
    let line = |texts: &[(usize, &str)]| {
        let mut line = [' '; 215];
        for (start, text) in texts {
            line[*start..].iter_mut().zip(text.chars()).for_each(|(place, letter)| *place = letter);
        }
        line.iter().collect::<String>().trim_end().to_owned() + "\r\n"
    };
    let names: Vec<(usize, &str)> = columns.iter().map(|(name, start)| (*start, *name)).collect();
    let mut text =
        "LIGHTCURVE DATA, a summary\r\n\r\nRevised, 2023\r\nSee the notes\r\n".to_owned() + &line(&names);
    text += &("-".repeat(215) + "\r\n");
    for row in 0..300 {
        text += &line(&[
            (3, "433"),
            (10, "Eros"),
            (41, "1898 DQ"),
            (62, "NEA"),
            (71, "T"),
            (73, "S"),
            (84, "T"),
            (91, "16.84"),
            (97, "T"),
            (100, "10.31"),
            (109, "D"),
            (111, "0.460"),
            (132, "T"),
            (137, "0.25"),
            (147, "5.270"),
            (183, "3"),
            (if row == 250 { 8 } else { 214 }, if row == 250 { "*" } else { " " }),
            (if row == 280 { 143 } else { 214 }, if row == 280 { "<" } else { " " }),
        ]);
    }
    text += &line(&[
        (1, "99942"),
        (10, "Apophis, with a long name"),
        (41, "2004 MN4"),
        (73, "Sq"),
        (90, " 0.375"),
        (143, "S"),
        (146, "30.5600001"),
        (183, "3-"),
    ]);
    text += "        1 note that goes over all of the columns of the table, as a footnote of a printed page would do, and so it is no row; see the text of the paper, which tells more of it and of the others that stand above, among them those of the first and of the last row\r\n";
    let table = read("lc_summary_pub.txt", text.as_bytes()).unwrap();
    let value = |name: &str, row: usize| {
        table.columns[table.column(name).unwrap_or_else(|| panic!("{name}: {:?}", table.names))][row].as_str()
    };
    assert_eq!((table.rows(), table.unread.len()), (302, 1), "{:?}", table.unread);
    assert_eq!(
        (value("NAME", 0), value("DIA.", 0), value("PERIOD", 299), value("H", 7)),
        ("Eros", "16.84", "5.270", "10.31")
    );
    assert_eq!(
        (value("NAME", 300), value("PERIOD", 300), value("DIA.", 300), value("ALBEDO", 300)),
        ("Apophis, with a long name", "30.5600001", "0.375", "")
    );
    assert_eq!(
        (value("F_3", 280), value("PERIOD", 280), value("U", 300)),
        ("<", "5.270", "3-"),
        "{:?}",
        table.names
    );
    assert_eq!(table.unread.keys().copied().collect::<Vec<_>>(), [301]);
    assert!(table.unread[&301].contains("has a text across two columns"), "{:?}", table.unread);
    let told = |start: &str| {
        assert!(table.notes.iter().any(|note| note.starts_with(start)), "{start}: {:?}", table.notes)
    };
    told("3 lines are left out above the names of the columns");
    told("columns named F are numbered: F_1, F_2");
}

#[test]
fn titles_quoted_names_types_and_units_of_comments_are_read() {
    let table = table("A catalogue\nof 2 bodies\n\nname,P [h]\nEros,5.27\nIda,4.63\n");
    assert_eq!(
        (table.names.as_slice(), table.rows()),
        (["name".to_owned(), "P [h]".to_owned()].as_slice(), 2)
    );
    assert_eq!(table.notes, ["2 lines are left out above the names of the columns"]);
    let table = self::table("  # comment\n\"body name\" P\nEros 5.27\n\"2004 FH\" 0.05\n\"open 1\n");
    assert_eq!(table.columns, [["Eros", "2004 FH", ""], ["5.27", "0.05", ""]]);
    assert!(table.unread[&2].contains("is not closed on that line"));
    let table = self::table("name\tP\n11S\t6N\nEros\t5.27\n");
    assert_eq!((table.rows(), table.columns[1][0].as_str()), (1, "5.27"));
    assert!(table.notes.iter().any(|note| note.ends_with("types, as in RDB")));
    assert_eq!(read("a.rdb", b"name\tP\nS\tN\nEros\t5.27\n").unwrap().rows(), 1);
    assert_eq!(self::table("name\tF\nS\tN\nEros\tM\n").rows(), 2, "letters alone may be values");
    let ecsv = "# %ECSV 1.0\n# ---\n# datatype:\n# - {name: name, datatype: string}\n# - {name: P, unit: h, datatype: float64}\n# schema: astropy-2.0\nname P\n\"2004 FH\" 0.05\n";
    let table = self::table(ecsv);
    assert_eq!((unit(&table, "P"), table.columns[0][0].as_str()), (Some("h"), "2004 FH"));
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
