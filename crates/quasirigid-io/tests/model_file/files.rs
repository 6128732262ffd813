//! Files that are no models: missing, too large, endless, empty, binary, or not TOML.
//! Refusing must be quick: work that grows with the square of the length would hang an editor, so times are limited too.

use std::path::Path;

use insta::assert_snapshot;
use quasirigid_io::model::{FileProblem, Model, ModelError};

use super::{CARRIER, carrier, refusal};

#[test]
fn nonsense_is_refused_without_delay() {
    let start = std::time::Instant::now();
    let refused = refusal(&format!("#{}", " \u{1}".repeat(500_000)));
    assert_snapshot!(refused.lines().last().unwrap_or_default(), @"model.toml:1:201: there are more problems like these");
    // work that grows with the square of the length takes minutes
    assert!(start.elapsed().as_secs() < 10, "{:?}", start.elapsed());
}

#[test]
fn a_file_that_cannot_be_read_is_refused() {
    let missing = Model::read(Path::new("no such folder/model.toml")).expect_err("a refusal");
    assert_snapshot!(missing, @"no such folder/model.toml: there is no such file");
    let folder = Model::read(Path::new("src")).expect_err("a refusal");
    assert_snapshot!(folder, @"src: this is a folder; give the model file inside it");
}

#[test]
fn a_file_that_is_too_large_is_refused_unread() {
    let path = std::env::temp_dir().join(format!("quasirigid-large-{}.toml", std::process::id()));
    let file = std::fs::File::create(&path).expect("a temporary file");
    file.set_len(1 << 33).expect("a sparse file");
    let error = Model::read(&path).expect_err("a refusal");
    std::fs::remove_file(&path).expect("the temporary file");
    assert_eq!(
        error,
        ModelError::Unreadable { file: path, problem: FileProblem::TooLarge { limit: 1 << 26 } }
    );
}

#[cfg(unix)]
#[test]
fn a_file_without_end_is_refused() {
    let error = Model::read(Path::new("/dev/zero")).expect_err("a refusal");
    assert_snapshot!(error, @"/dev/zero: the file is larger than 64 MiB, the most a model file may have");
}

#[test]
fn a_file_is_read_from_disk_and_a_byte_that_is_no_text_is_located() {
    let path = std::env::temp_dir().join(format!("quasirigid-text-{}.toml", std::process::id()));
    std::fs::write(&path, CARRIER).expect("a temporary file");
    let model = Model::read(&path);
    std::fs::write(&path, b"[carrier]\nmass = \"40 \xff\"\n").expect("a temporary file");
    let error = Model::read(&path).expect_err("a refusal").to_string();
    std::fs::remove_file(&path).expect("the temporary file");
    assert_eq!(model.map(|model| carrier(&model.assembly).mass), Ok(40.0));
    assert_snapshot!(error.replace(&*path.to_string_lossy(), "model.toml"), @r#"
    model.toml:2:12: the file is not UTF-8 text: the byte 0xFF is not allowed here
      a model file is a TOML text; save it with the encoding UTF-8
    "#);
}

#[test]
fn an_empty_file_is_refused() {
    assert_snapshot!(refusal(" \n"), @"
    model.toml:1:1: the file is empty
      a model has at least a [carrier] with mass, center_of_mass and inertia, or an [[ellipsoid]] with semi_axes and material
    ");
    assert_snapshot!(refusal("# nothing yet\n"), @"
    model.toml:1:1: the file has comments but no model
      a model has at least a [carrier] with mass, center_of_mass and inertia, or an [[ellipsoid]] with semi_axes and material
    ");
}

#[test]
fn what_is_not_toml_is_refused_where_it_stops_being_so() {
    assert_snapshot!(refusal("[carrier]\nmass = 40 kg # heavy\n"), @r#"
    model.toml:2:8: not valid TOML: string values must be quoted, expected literal string
      a number with its unit stands in quotes: "40 kg"
    "#);
    assert_snapshot!(refusal("[carrier\nmass = 40\n"), @"model.toml:1:9: not valid TOML: unclosed table, expected `]`");
    assert_snapshot!(refusal("[carrier]\nmass = 40\nmass = 41\n[carrier]\n"), @r#"
    model.toml:3:1: not valid TOML: duplicate key
    model.toml:4:2: not valid TOML: duplicate key
    "#);
    assert_snapshot!(refusal("[carrier]\nname = \"never closed\n"), @r#"model.toml:2:21: not valid TOML: invalid basic string, expected `"`"#);
    assert_snapshot!(refusal("[carrier]\ninertia = [1, 2, 3\n"), @"model.toml:2:19: not valid TOML: unclosed array, expected `]`");
}

#[test]
fn nesting_without_end_is_refused() {
    let depth = 100_000;
    assert_snapshot!(refusal(&format!("a = {}", "[".repeat(depth))), @r#"
    model.toml:1:85: not valid TOML: cannot recurse further; max recursion depth met
    model.toml:1:100005: not valid TOML: unclosed array, expected `]`
    "#);
    assert_snapshot!(refusal(&format!("[{}a]", "a.".repeat(depth))), @r#"
    model.toml:1:2: a key with more than 16 parts
      the longest keys of a model have two, as in carrier.mass
    "#);
    assert_snapshot!(refusal(&format!("x = 1\nx = {{ {}a = 1 }}", "\"a,b\" . ".repeat(depth))), @r#"
    model.toml:2:6: a key with more than 16 parts
      the longest keys of a model have two, as in carrier.mass
    "#);
}
