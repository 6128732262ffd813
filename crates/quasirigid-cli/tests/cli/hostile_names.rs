//! Names that would be something else in an output: formulas, markup, commands of terminals, ends of lines and comments.
//! Every output shows them as names, and the tables of a study are read back with the names that were written.

use std::fs;
use std::path::Path;

use quasirigid_io::table_file::read_bodies;
use tempfile::TempDir;

use crate::support::{MODEL, Ran, folder_with, program, ran_in};

/// Names as TOML writes them.
const NAMES: [&str; 9] = [
    r#"=HYPERLINK(\"//a\",\"b\")"#,
    "+1+cmd|' /C calc'!A0",
    "a;=1+1;",
    "@SUM(1)",
    "</script><script>alert(1)</script>",
    r#"\"><svg onload=alert(1)>"#,
    r"\u001b[31m\u009b1m\u202e",
    r#"*/ int x; \"\"\" import os"#,
    r"\\end{equation*} \\input{x}",
];

/// Texts in more than a line, which are no names.
const BROKEN: [&str; 4] = [r"\t=1", r"one\r\ntwo\n=3", r"a\rb", r"a\u2028b"];

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
    let cells = table.split([',', ';', '\n', '\r', '\t']);
    let is_formula = |cell: &str| cell.starts_with(['=', '+', '-', '@']) && cell.parse::<f64>().is_err();
    cells.map(|cell| cell.trim_start().trim_start_matches('"').trim_start()).any(is_formula)
}

#[test]
fn texts_and_tables_on_the_terminal_show_names() {
    let longest = "n".repeat(300);
    for name in NAMES.into_iter().chain([&*longest]) {
        let folder = folder_named(name);
        for line in ["check model.toml", "modes model.toml", "evolve model.toml", "derive model.toml"] {
            ran_to_the_end(folder.path(), line);
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
    for name in BROKEN {
        let refused = ran_refused(folder_named(name).path(), "check model.toml");
        assert_eq!(
            refused.stderr.matches("is not in one line, as a name is").count(),
            2,
            "{}",
            refused.stderr
        );
    }
    for (argument, shown) in [("--a\u{202e}b", "--a\\u202eb"), ("--a\u{1b}[2Jb", "--ab")] {
        let refused = ran_refused(folder_with(MODEL).path(), &format!("check model.toml {argument}"));
        assert!(refused.stderr.contains(shown), "{}", refused.stderr);
    }
}

/// The file of a model that gives no name gives it its own, which may be any.
#[cfg(unix)]
#[test]
fn name_of_a_file_stays_in_its_line() {
    let name = "one\r\\input{x}\ntwo\u{1b}[2J";
    let folder = folder_with(MODEL);
    fs::copy(folder.path().join("model.toml"), folder.path().join(format!("{name}.toml"))).unwrap();
    for line in ["check", "modes", "evolve", "derive", "verify --halvings 1 --revolutions 1"] {
        let mut arguments = line.split_whitespace();
        let mut command = program(folder.path());
        command.args(arguments.next()).arg(format!("{name}.toml")).args(arguments);
        let ran = Ran::from(command.output().unwrap());
        assert!(ran.stdout.contains("one\\u000d\\input{x}\\u000atwo\\u001b[2J: "), "{line}: {ran:?}");
    }
    let latex = ["derive", &format!("{name}.toml"), "--format", "latex"];
    let ran = Ran::from(program(folder.path()).args(latex).output().unwrap());
    assert!(ran.stdout.starts_with("% one\\u000d\\input{x}\\u000atwo\\u001b[2J, order"), "{ran:?}");
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
         'point.\"=1+1\".mass' = { list = [1.0] }\n[answer]\nquantities = [\"check.T1\"]\n",
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
