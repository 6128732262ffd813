//! `new`: the kinds, what is written for each, and refusals.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::support::{ROOT, ran, ran_in};

/// Kinds, each with a file of the repository that it reads.
const KINDS: [(&str, Option<&str>); 10] = [
    ("boom-satellite", None),
    ("panels", None),
    ("wheel", None),
    ("tank", None),
    ("mesh", Some("crates/quasirigid-io/tests/data/bodies/hook.msh")),
    ("nastran", Some("part.bdf")),
    ("shape", Some("cube.obj")),
    ("ellipsoid", None),
    ("light-curve", None),
    ("tumblers", None),
];

const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n\
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// A bus of 40 kg with a boom of steel and a mass on its end.
const DECK: &str = "\
GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n\
CBAR,1,1,1,2,0.,1.,0.\nCBAR,2,1,2,3,0.,1.,0.\n\
PBAR,1,1,1.-4,2.-9,2.-9,4.-9\nMAT1,1,2.+11,,.3,7850.\n\
CONM2,11,1,,40.,0.,0.,0.,,+\n+,9.,0.,13.,0.,0.,16.\nCONM2,12,3,,0.5\n";

#[test]
fn the_kinds_are_listed() {
    let listed = ran("new");
    assert_eq!(listed.code, Some(0), "{}", listed.stderr);
    let names = listed.stdout.lines().skip(1).filter_map(|line| line.split_whitespace().next());
    assert!(names.eq(KINDS.iter().map(|(kind, _)| *kind)), "{}", listed.stdout);
    assert!(listed.stdout.lines().all(|line| line.chars().count() <= 80), "{}", listed.stdout);
}

#[test]
fn every_kind_is_a_model_that_is_read_and_answered() {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("cube.obj"), CUBE).unwrap();
    fs::write(folder.path().join("part.bdf"), DECK).unwrap();
    for (kind, file) in KINDS {
        let given = file.map_or_else(String::new, |file| {
            let file = if file.contains('/') { format!("{ROOT}/{file}") } else { file.to_owned() };
            format!(" --file {file}")
        });
        let written = ran_in(folder.path(), &format!("new {kind}{given}"));
        assert_eq!((written.code, &*written.stderr), (Some(0), ""), "{kind}");
        let next = written.stdout.lines().find_map(|line| line.strip_prefix("Next: quasirigid ")).unwrap();
        let asked = if kind == "tumblers" { format!("{next} -o results") } else { format!("{next} --json") };
        let answered = ran_in(folder.path(), &asked);
        assert_eq!(answered.code, Some(0), "{kind}: {asked}: {} {}", answered.stdout, answered.stderr);
        let model = fs::read_to_string(folder.path().join(kind).join("model.toml")).unwrap();
        assert!(model.starts_with("#:schema schema.json\n# "), "{model}");
    }
    let rows = ran_in(Path::new(folder.path()), "new ellipsoid");
    assert!(rows.refusal().contains("already exists"), "{}", rows.stderr);
}

#[test]
fn a_file_is_asked_for_where_one_is_read() {
    let folder = TempDir::new().unwrap();
    let refused = |line: &str| ran_in(folder.path(), line).refusal().to_owned();
    assert!(refused("new tank --file a.msh").contains("reads no file"));
    assert!(refused("new mesh --file a.msh").contains("a.msh: there is no such file"));
    let told = ran_in(folder.path(), "new shape -o a/b");
    assert!(told.refusal().contains("there is no folder"), "{}", told.stderr);
    let told = ran_in(folder.path(), "new shape -o b");
    assert!(told.stdout.contains("Put your file there as \"shape.obj\""), "{}", told.stdout);
    assert!(fs::read_to_string(folder.path().join("b/model.toml")).unwrap().contains("file = \"shape.obj\""));
}
