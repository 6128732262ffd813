//! Names that would be something else in an output: formulas, markup, commands of terminals, ends of lines and comments.
//! Every output shows them as names, and the tables of a study are read back with the names that were written.

use std::fs;
use std::path::Path;

use quasirigid_io::table_file::read_bodies;
use tempfile::TempDir;

use crate::support::{MODEL, Ran, folder_with, ran_in};

/// Names as TOML writes them.
const NAMES: [&str; 12] = [
    r#"=HYPERLINK(\"//a\",\"b\")"#,
    "+1+cmd|' /C calc'!A0",
    "a;=1+1;",
    "@SUM(1)",
    r"\t=1",
    "</script><script>alert(1)</script>",
    r#"\"><svg onload=alert(1)>"#,
    r"\u001b[31m\u009b1m\u202e\u2028",
    r"one\r\ntwo\n=3",
    "*/ int x;",
    r#"\"\"\"\nimport os"#,
    r"\\end{equation*}\r\\input{x}",
];

fn folder_named(name: &str) -> TempDir {
    folder_with(&format!("[body]\nname = \"{name}\"\n{}", MODEL.replace("\"tip\"", &format!("\"{name}\""))))
}

#[track_caller]
fn ran_to_the_end(folder: &Path, line: &str) -> Ran {
    let ran = ran_in(folder, line);
    assert!(matches!(ran.code, Some(0 | 1)), "{line}: {ran:?}");
    let steers = |letter: char| letter.is_control() && letter != '\n' || "\u{202e}\u{2028}".contains(letter);
    let printed = [&ran.stdout, &ran.stderr];
    assert!(!printed.iter().any(|text| text.contains(steers)), "{line}: {ran:?}");
    ran
}

/// Whether a spreadsheet computes a cell of a line, in the settings of any country.
fn has_formula(table: &str) -> bool {
    let cells = table.split([',', ';', '\n', '\r', '\t', '"']);
    let is_formula = |cell: &str| cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
    cells.map(str::trim_start).any(is_formula)
}

#[test]
fn texts_and_tables_on_the_terminal_show_names() {
    let longest = "n".repeat(300);
    for name in NAMES.into_iter().chain([&*longest]) {
        let folder = folder_named(name);
        for line in ["check model.toml", "modes model.toml", "evolve model.toml", "derive model.toml"] {
            let ran = ran_to_the_end(folder.path(), line);
            assert!(!ran.stdout.lines().any(|line| line.starts_with("two")), "{line}: {}", ran.stdout);
        }
        let table = ran_to_the_end(
            folder.path(),
            "simulate model.toml --system full --samples 2 --coordinates --quiet",
        );
        assert!(!has_formula(&table.stdout), "{}", table.stdout);
        assert_eq!(table.stdout.lines().count(), 3, "{}", table.stdout);
        let latex = ran_to_the_end(folder.path(), "derive model.toml --format latex");
        let comments = latex.stdout.lines().filter(|line| line.starts_with('%')).count();
        assert!(comments >= 2 && !latex.stdout.contains("\n\\input"), "{}", latex.stdout);
        ran_to_the_end(folder.path(), "check model.toml --json").json();
        ran_to_the_end(folder.path(), "derive model.toml --format json").json();
    }
}

#[test]
fn refusals_and_arguments_show_names() {
    for name in NAMES {
        let model = format!("{}[[spring]]\nfrom = \"{name}\"\nto = \"{name}\"\n", MODEL);
        ran_refused(folder_with(&model).path(), "check model.toml");
    }
    let argument = "check model.toml --a\u{1b}[2J\u{202e}b";
    let refused = ran_refused(folder_with(MODEL).path(), argument);
    assert!(refused.stderr.contains("--a\\u001b[2J\\u202eb"), "{}", refused.stderr);
}

#[track_caller]
fn ran_refused(folder: &Path, line: &str) -> Ran {
    let refused = ran_in(folder, line);
    let text = refused.refusal();
    assert!(!text.contains(|letter: char| letter.is_control() && letter != '\n'), "{text:?}");
    assert!(!text.contains(['\u{202e}', '\u{2028}']), "{text:?}");
    refused
}

#[test]
fn record_and_pictures_show_names() {
    for name in NAMES {
        let folder = folder_named(name);
        ran_to_the_end(folder.path(), "run model.toml -o out --quiet");
        let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
        assert_eq!(page.matches("<script>").count(), 2, "the page's own, of figures and of the viewer");
        assert!(!page.contains("<svg onload") && !page.contains(['\u{1b}', '\u{202e}']), "{name}");
        ran_to_the_end(folder.path(), "plot out --figure motion --out motion.svg --quiet");
        for picture in ["motion.svg", "out/sphere.svg"] {
            let text = fs::read_to_string(folder.path().join(picture)).unwrap();
            let known = |letter: char| {
                letter >= ' ' && !"\u{7f}\u{202e}\u{fffe}".contains(letter) || "\n\t".contains(letter)
            };
            assert!(text.chars().all(known) && !text.contains("<script"), "{picture} of {name}");
        }
        for table in ["history-reduced.csv", "history-rigid.csv"] {
            assert!(
                !has_formula(&fs::read_to_string(folder.path().join("out").join(table)).unwrap()),
                "{table}"
            );
        }
        ran_to_the_end(folder.path(), "report out --gltf body.glb --quiet");
    }
}

/// Keys with such names, texts that are carried through, and the reasons of refusals.
#[test]
fn tables_of_a_study_are_read_back_and_hold_no_formula() {
    let folder = folder_named("=1+1");
    let kept = ["=1+1", "-2+3", "-2", "@x", "a;=1", "it's", "'=1", "\"><svg onload=x>"];
    let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
    let rows: String = kept.iter().map(|text| format!("{},{},1.0\n", quoted(text), quoted(text))).collect();
    fs::write(folder.path().join("bodies.csv"), format!("=note,body.name,carrier.mass\n{rows}")).unwrap();
    fs::write(
        folder.path().join("study.toml"),
        "model = \"model.toml\"\n[table]\nfile = \"bodies.csv\"\nkeep = [\"=note\"]\n[vary]\n\
         \"point.=1+1.mass\" = { list = [1.0] }\n[answer]\nquantities = [\"check.T1\"]\n",
    )
    .unwrap();
    ran_to_the_end(folder.path(), "sweep study.toml -o out");
    let rows = folder.path().join("out/rows.csv");
    let text = fs::read_to_string(&rows).unwrap();
    assert!(!has_formula(&text), "{text}");
    assert!(text.starts_with("row,body.name,"), "{text}");
    let table = read_bodies(&rows).unwrap();
    let column = |name: &str| {
        &table.columns[table
            .names
            .iter()
            .position(|known| known == name)
            .unwrap_or_else(|| panic!("{:?}", table.names))]
    };
    // a cell that a spreadsheet has saved with its apostrophe is read without it
    let read = kept.map(|text| if text == "'=1" { "=1" } else { text });
    assert_eq!(*column("=note"), read);
    assert_eq!(*column("body.name"), read);
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(!page.contains("<svg onload"));
}
