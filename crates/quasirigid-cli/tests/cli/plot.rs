//! Figures of a record as files of their own, the comparison of records, and the browser.

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use insta::assert_snapshot;
use tempfile::TempDir;

use crate::support::{folder_of, names, one_line, program, ran_in};

/// A folder with the records `spin` and `stiff` of one body.
static RECORDS: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = folder_of("axial-mass");
    for options in ["-o spin", "-o stiff --order 5"] {
        let line = format!("run model.toml --duration 60 --samples 301 --quiet {options}");
        assert_eq!(ran_in(folder.path(), &line).code, Some(0));
    }
    folder
});

fn ran(line: &str) -> crate::support::Ran {
    ran_in(RECORDS.path(), line)
}

fn read(name: &str) -> Vec<u8> {
    fs::read(RECORDS.path().join(name)).unwrap()
}

#[test]
fn figures_are_listed_and_drawn() {
    let listed = ran("plot spin").stdout;
    assert_eq!(
        listed.lines().collect::<Vec<_>>(),
        ["spin", "energy", "nutation", "difference", "campbell", "sphere", "motion"]
    );
    for figure in listed.lines() {
        let drawn = ran(&format!("plot spin --figure {figure}"));
        assert_eq!(
            (drawn.code, one_line(&drawn.stderr)),
            (Some(0), format!("quasirigid: wrote {figure}.svg"))
        );
        assert!(String::from_utf8(read(&format!("{figure}.svg"))).unwrap().contains("</svg>"));
    }
    let again = ran("plot spin --figure spin");
    assert_snapshot!(one_line(again.refusal()), @"quasirigid: spin.svg already exists; choose another with --out, or add --overwrite");
}

#[test]
fn format_is_asked_for_or_that_of_the_name() {
    let drawn = ran("plot spin --figure energy --out loss.PNG --pixels 640 --quiet");
    if ["no fonts", "without PNG"].iter().any(|why| drawn.stderr.contains(why)) {
        assert_eq!(drawn.code, Some(2));
        return; // a machine without fonts refuses in words, and so does a program without the feature
    }
    assert_eq!(drawn.code, Some(0), "{drawn:?}");
    let png = read("loss.PNG");
    assert_eq!(&png[1..4], b"PNG");
    assert_eq!(u32::from_be_bytes(png[16..20].try_into().unwrap()), 640);
    assert_eq!(ran("plot spin --figure energy --format png --quiet").code, Some(0));
    assert_eq!(&read("energy.png")[1..4], b"PNG");
    assert_snapshot!(one_line(ran("plot spin --figure energy --out a.pdf").refusal()), @"quasirigid: a.pdf: pictures are svg or png files; name the format with --format");
    assert_snapshot!(one_line(ran("plot spin --figure energy --pixels 800 --out b.svg").refusal()), @"quasirigid: --pixels belongs to PNG pictures; an SVG picture has any size");
    assert_snapshot!(one_line(ran("plot spin --figure energy --pixels 8 --out b.png").refusal()), @"quasirigid: a picture can be 64 to 16384 pixels wide, not 8");
    assert!(!names(RECORDS.path()).iter().any(|name| name.starts_with("b.") || name.starts_with("a.")));
}

#[test]
fn figure_that_a_record_lacks_is_refused_by_name() {
    assert_snapshot!(one_line(ran("plot spin --figure wobble").refusal()), @r#"quasirigid: spin: the record has no figure "wobble"; it has spin, energy, nutation, difference, campbell, sphere, motion"#);
    assert!(ran("plot nowhere").refusal().contains("nowhere"));
}

#[test]
fn records_stand_side_by_side() {
    let made = ran("report spin stiff -o side.html");
    assert_eq!((made.code, one_line(&made.stderr)), (Some(0), "quasirigid: wrote side.html".into()));
    let page = String::from_utf8(read("side.html")).unwrap();
    let differs = page.split("What is the same").next().unwrap();
    assert!(differs.contains("<th scope=\"row\">Order of the equations</th><td>3</td><td>5</td>"));
    assert!(page.contains("data-label=\"spin\"") && page.contains("data-label=\"stiff\""));
    assert_snapshot!(one_line(ran("report spin stiff --gltf two.glb").refusal()), @"quasirigid: a glTF file shows one body in motion; name one record with --gltf");
}

/// The report is opened by the program that the desktop has for it.
#[cfg(target_os = "linux")]
#[test]
fn report_is_opened_in_the_browser() {
    use std::os::unix::fs::PermissionsExt;
    let tools = TempDir::new().unwrap();
    let (opened, script) = (tools.path().join("opened"), tools.path().join("xdg-open"));
    fs::write(
        &script,
        format!("#!/bin/sh\nprintf %s \"$1\" > {0}.part && mv {0}.part {0}\n", opened.display()),
    )
    .unwrap();
    fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:/bin:/usr/bin", tools.path().display());
    let status = program(RECORDS.path())
        .args(["report", "spin", "--open", "--quiet"])
        .env("PATH", path)
        .status()
        .unwrap();
    assert!(status.success());
    let waited = (0..200).any(|_| {
        std::thread::sleep(std::time::Duration::from_millis(20));
        opened.exists()
    });
    assert!(waited, "nothing was opened");
    assert!(Path::new(&fs::read_to_string(&opened).unwrap()).ends_with("spin/report.html"));
    let nothing = program(RECORDS.path())
        .args(["report", "spin", "--open", "--quiet"])
        .env("PATH", tools.path().join("none"))
        .output()
        .unwrap();
    assert!(String::from_utf8_lossy(&nothing.stderr).contains("open it by hand"), "{nothing:?}");
}
