//! Folders and files that may not be read or written: for root a file system that is read-only, for others their rights.

use std::fs;
use std::process::Command;

use tempfile::TempDir;

use super::{Mounted, STUDY, can, skip};
use crate::support::{Ran, files, folder_of_study, one_line, ran_in};

/// A folder that is read-only as long as this lives, root or not.
fn sealed(folder: TempDir) -> Option<Mounted> {
    let path = folder.path().to_str().unwrap().to_owned();
    let sealed = Mounted::on(folder, &["--bind", &path])?;
    can("mount", &["-o", "remount,ro,bind", &path]).then_some(sealed)
}

#[cfg(target_os = "linux")]
#[test]
fn read_only_file_system_is_told_by_every_writer() {
    let folder = folder_of_study(STUDY);
    assert_eq!(ran_in(folder.path(), "run model.toml --duration 5 -q -o out").code, Some(0));
    assert_eq!(ran_in(folder.path(), "sweep study.toml -q -o study").code, Some(0));
    let before = files(folder.path());
    let Some(sealed) = sealed(folder) else { return skip("only root may mount a folder read-only") };
    for (line, place) in [
        ("run model.toml --duration 20h -q -o new", "new"),
        ("run model.toml --duration 20h -q -o out --overwrite", "out"),
        ("simulate model.toml --duration 20h --out t.csv", "t.csv"),
        ("evolve model.toml --out e.csv", "e.csv"),
        ("report out", "out/report.html"),
        ("report out --gltf body.glb", "body.glb"),
        ("plot out --figure spin", "spin.svg"),
        ("sweep study.toml -q -o new", "new/parts"),
        ("sweep study.toml -q -o study --resume", "study/"),
    ] {
        let refused = ran_in(sealed.path(), line);
        let said = one_line(&refused.refusal().to_lowercase());
        assert!(said.contains(place) && said.contains("read-only file"), "{line}: {said}");
        assert!(!said.contains(".quasirigid-"), "{line}: {said}");
    }
    assert!(files(sealed.path()) == before);
}

/// The program as somebody without rights here.
fn as_nobody(folder: &TempDir, line: &str) -> Option<Ran> {
    let program = env!("CARGO_BIN_EXE_quasirigid");
    let nobody = ["--reuid", "65534", "--regid", "65534", "--clear-groups"];
    if !Command::new("setpriv")
        .args(nobody)
        .args([program, "--version"])
        .output()
        .is_ok_and(|ran| ran.status.success())
    {
        return None;
    }
    let mut command = Command::new("setpriv");
    Some(
        command
            .args(nobody)
            .arg(program)
            .args(line.split(' '))
            .current_dir(folder.path())
            .output()
            .unwrap()
            .into(),
    )
}

#[cfg(target_os = "linux")]
#[test]
fn missing_rights_are_told() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_of_study(STUDY);
    let allow = |name: &str, mode: u32| {
        fs::set_permissions(folder.path().join(name), fs::Permissions::from_mode(mode)).unwrap();
    };
    allow(".", 0o755);
    fs::copy(folder.path().join("model.toml"), folder.path().join("secret.toml")).unwrap();
    allow("secret.toml", 0o600);
    for (line, words) in [
        ("check secret.toml", "secret.toml: the file cannot be read: permission denied"),
        ("run model.toml --duration 20h -q -o out", "cannot write out: permission denied"),
        ("simulate model.toml --duration 20h -q --out t.csv", "cannot write t.csv: permission denied"),
        ("sweep study.toml -q -o out", "out/parts: permission denied"),
    ] {
        let Some(refused) = as_nobody(&folder, line) else {
            return skip("setpriv is missing, or the program is where nobody else may run it");
        };
        assert!(one_line(&refused.refusal().to_lowercase()).contains(words), "{line}: {}", refused.stderr);
    }
    // a folder that may be written and not read
    fs::create_dir(folder.path().join("blind")).unwrap();
    allow("blind", 0o733);
    for line in ["run model.toml --duration 5 -q -o blind/out", "sweep study.toml -q -o blind/study"] {
        let ran = as_nobody(&folder, line).unwrap();
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
    }
    assert!(folder.path().join("blind/out/record.json").exists());
    assert!(folder.path().join("blind/study/summary.json").exists());
}
