//! Places to which `simulate` writes its table.

use std::fs;

use insta::assert_snapshot;

use crate::support::{MODEL, Ran, folder_of, folder_with, names, ran_in};

const SHORT: &str = "simulate model.toml --duration 10 --samples 5";

#[test]
fn out_holds_the_bytes_that_would_be_printed() {
    let folder = folder_of("axial-mass");
    let printed = ran_in(folder.path(), SHORT).stdout;
    let written = ran_in(folder.path(), &format!("{SHORT} --out table.csv"));
    assert_eq!((written.code, &*written.stdout, &*written.stderr), (Some(0), "", ""));
    assert_eq!(fs::read_to_string(folder.path().join("table.csv")).unwrap(), printed);
    assert_eq!(names(&folder), ["model.toml", "table.csv", "table.csv.inputs.json"]);
}

#[test]
fn json_goes_beside_the_table_in_a_file() {
    let folder = folder_of("axial-mass");
    let both = ran_in(folder.path(), &format!("{SHORT} --out table.csv --json"));
    assert_eq!(both.json()["t"], 10.0);
    assert_eq!(fs::read_to_string(folder.path().join("table.csv")).unwrap().lines().count(), 6);
}

#[test]
fn file_is_replaced_only_on_request() {
    let folder = folder_of("axial-mass");
    let file = folder.path().join("table.csv");
    fs::write(&file, "precious").unwrap();
    assert_snapshot!(ran_in(folder.path(), &format!("{SHORT} --out table.csv")).refusal(), @r"
    quasirigid: table.csv already exists; choose another with --out, or add
    --overwrite
    ");
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    let refused = ran_in(folder.path(), &format!("{SHORT} --tolerance 1 --out table.csv --overwrite"));
    assert_eq!((refused.code, fs::read_to_string(&file).unwrap().as_str()), (Some(2), "precious"));
    assert_eq!(ran_in(folder.path(), &format!("{SHORT} --out table.csv --overwrite")).code, Some(0));
    assert!(fs::read_to_string(&file).unwrap().starts_with("t,wx,"));
    assert_eq!(names(&folder), ["model.toml", "table.csv", "table.csv.inputs.json"]);
}

/// The propagation would take many seconds; a place that takes no file is found before it, and said in other words.
#[test]
fn place_that_takes_no_file_is_refused_before_the_work() {
    let folder = folder_of("explorer1-stiff");
    let refused = |path: &str| -> Ran {
        let line = format!("simulate model.toml --duration 20h --samples 5 --out {path}");
        ran_in(folder.path(), &line)
    };
    assert_snapshot!(refused("none/table.csv").refusal(), @r"
    quasirigid: cannot write none/table.csv: there is no folder none; create it
    first
    ");
    assert_snapshot!(refused("model.toml/table.csv").refusal(), @r"
    quasirigid: cannot write model.toml/table.csv: there is no folder model.toml;
    create it first
    ");
    fs::create_dir(folder.path().join("made")).unwrap();
    assert_snapshot!(refused("made").refusal(), @"quasirigid: made is a folder; name a file in it with --out");
    #[cfg(target_os = "linux")]
    assert!(refused("/proc/table.csv").refusal().starts_with("quasirigid: cannot write /proc/table.csv: "));
    assert_eq!(names(&folder), ["made", "model.toml"]);
}

#[cfg(unix)]
#[test]
fn file_has_the_access_that_files_usually_have() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_of("axial-mass");
    ran_in(folder.path(), &format!("{SHORT} --out table.csv"));
    let mode = |name: &str| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
    assert_eq!(mode("table.csv"), mode("model.toml")); // the test wrote that one in the ordinary way
}

/// Without --overwrite: were the device taken for a file, it would be refused and not replaced.
#[cfg(target_os = "linux")]
#[test]
fn full_disk_is_a_clear_error() {
    let folder = folder_of("axial-mass");
    let file = ran_in(folder.path(), &format!("{SHORT} --out /dev/full"));
    assert_snapshot!(file.refusal(), @"quasirigid: cannot write /dev/full: No space left on device (os error 28)");
    for line in [SHORT, "check model.toml", "derive model.toml"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = crate::support::program(folder.path());
        let ran: Ran = command.args(line.split(' ')).stdout(full).output().unwrap().into();
        assert_snapshot_of_full_output(&ran);
    }
    assert_eq!(names(&folder), ["model.toml"]);
}

#[cfg(target_os = "linux")]
fn assert_snapshot_of_full_output(ran: &Ran) {
    assert_eq!(ran.code, Some(2));
    assert_eq!(ran.stderr, "quasirigid: cannot write standard output: no storage space\n");
}

#[cfg(unix)]
#[test]
fn pipe_with_a_name_is_written_and_stays_a_pipe() {
    use std::os::unix::fs::FileTypeExt;
    let folder = folder_of("axial-mass");
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read_to_string(pipe).unwrap()
    });
    let written = ran_in(folder.path(), &format!("{SHORT} --out pipe"));
    if written.code != Some(0) {
        fs::write(&pipe, "").unwrap(); // lets the reader go
    }
    assert_eq!((written.code, &*written.stderr), (Some(0), ""));
    assert_eq!(reader.join().unwrap().lines().count(), 6);
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
}

/// `--out -` used to make a file of that name.
#[test]
fn minus_is_standard_output() {
    let folder = folder_with(MODEL);
    let ran = |line: &str| ran_in(folder.path(), line);
    let table = "simulate model.toml --samples 3";
    assert_eq!(ran(&format!("{table} --out -")).stdout, ran(table).stdout);
    let rows = "evolve model.toml --samples 3";
    assert_eq!(ran(&format!("{rows} --out -")).stdout, ran(&format!("{rows} --format csv")).stdout);
    assert_eq!(ran("run model.toml -o spin -q").code, Some(0));
    for (line, begins) in [("report spin --out -", "<!"), ("plot spin --figure energy --out -", "<?xml")] {
        let ran = ran(line);
        assert_eq!((ran.code, &*ran.stderr), (Some(0), ""), "{line}");
        assert!(ran.stdout.trim_start().starts_with(begins), "{line}: {:.80}", ran.stdout);
    }
    for line in [
        "simulate model.toml --samples 3 --out - --json",
        "evolve model.toml --out - --json",
        "run model.toml -o -",
        "report spin --out - --open",
    ] {
        assert!(ran(line).refusal().contains("standard output"), "{line}");
    }
    assert!(!folder.path().join("-").exists());
}
