//! A release, as far as a machine can make it: the versions agree, the tree is clean, and what a release consists of lies in `dist`. Nothing
//! is tagged, signed or sent: the last lines say what a person does next.

mod materials;
mod plan;
mod versions;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use sha2::{Digest, Sha256};

use crate::test;
use crate::tree::Tree;
use plan::{FOLDER, Release, Step, next, plan, shown};

pub use versions::check;

type Done = Result<(), String>;

/// Builds a release, or with `only_plan` says how it would be built.
///
/// # Errors
/// A sentence on what differs, is not committed or failed.
pub fn run(root: &Path, tree: &Tree, only_plan: bool) -> Done {
    let findings = check(tree);
    if let Some(finding) = findings.first() {
        return Err(format!("versions differ: {finding}"));
    }
    let version = versions::version(tree).ok_or("the workspace has no version")?;
    let python = if only_plan { "python3".into() } else { test::environment(root)? };
    let release = Release {
        epoch: asked(root, "git log -1 --format=%ct")?,
        host: host(root)?,
        profile: profile(tree).into(),
        target: test::target(root).display().to_string(),
        python: python.display().to_string(),
        version,
    };
    let steps = plan(&release);
    if !only_plan {
        clean(root)?;
        empty(&root.join(FOLDER))?;
        steps.iter().try_for_each(|step| execute(root, &release, step))?;
    }
    println!("\nquasirigid {}, commit {}", release.version, asked(root, "git log -1 --format=%h%x20(%cs)")?);
    for (number, step) in (1..).zip(&steps) {
        println!("  {number}. {step}");
    }
    if versions::entry(tree).is_some_and(|(_, day)| day == versions::UNRELEASED) {
        println!(
            "\nThe changelog says \"{}\": write the day there and into CITATION.cff, and commit.",
            versions::UNRELEASED
        );
    }
    println!("\n{}", next(&release.version));
    Ok(())
}

/// The profile of programs that are given away, if the workspace has one of its own.
fn profile(tree: &Tree) -> &'static str {
    let manifest = tree.text("Cargo.toml").unwrap_or_default();
    if manifest.contains("\n[profile.dist]\n") { "dist" } else { "release" }
}

fn clean(root: &Path) -> Done {
    let changed = asked(root, "git status --porcelain")?;
    if changed.is_empty() { Ok(()) } else { Err(format!("not committed:\n{changed}")) }
}

fn host(root: &Path) -> Result<String, String> {
    let told = asked(root, "rustc -vV")?;
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc names no host".to_owned())
}

fn execute(root: &Path, release: &Release, step: &Step) -> Done {
    println!("\nxtask release: {step}");
    match step {
        Step::Run(command) => call(root, release, command),
        Step::Gather { files, folder } => gather(root, files, &root.join(folder)),
        Step::Materials { package, features, file } => {
            list(root, release, package, features, &root.join(file))
        }
        Step::Checksums { file } => sum(&root.join(FOLDER), &root.join(file)),
    }
}

/// Runs a program with the date of the commit, and without the builder's folders in what it compiles.
fn call(root: &Path, release: &Release, command: &[String]) -> Done {
    let home = std::env::var_os("CARGO_HOME")
        .map(PathBuf::from)
        .or_else(|| Some(std::env::home_dir()?.join(".cargo")));
    let remap = |folder: &Path, name: &str| format!("--remap-path-prefix={}={name}", folder.display());
    let flags: Vec<String> =
        std::iter::once(remap(root, ".")).chain(home.map(|home| remap(&home, "cargo"))).collect();
    let status = Command::new(&command[0])
        .args(&command[1..])
        .current_dir(root)
        .env("SOURCE_DATE_EPOCH", &release.epoch)
        .env("CARGO_ENCODED_RUSTFLAGS", flags.join("\u{1f}"))
        .status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{} failed, {status}", shown(command))),
        Err(error) => Err(format!("{} does not run: {error}", command[0])),
    }
}

fn gather(root: &Path, files: &[String], folder: &Path) -> Done {
    fs::create_dir_all(folder).map_err(|error| told(folder, &error))?;
    files.iter().map(|file| root.join(file)).try_for_each(|file| {
        let name = file.file_name().unwrap_or_default();
        fs::copy(&file, folder.join(name)).map(drop).map_err(|error| told(&file, &error))
    })
}

fn list(root: &Path, release: &Release, package: &str, features: &str, file: &Path) -> Done {
    let metadata = "cargo metadata --format-version 1 --locked --filter-platform";
    let metadata = asked(root, &format!("{metadata} {}{features}", release.host))?;
    let metadata = serde_json::from_str(&metadata).map_err(|error| format!("cargo metadata: {error}"))?;
    let lock = root.join("Cargo.lock");
    let lock = fs::read_to_string(&lock).map_err(|error| told(&lock, &error))?;
    let time = asked(root, "git log -1 --format=%cd --date=format-local:%Y-%m-%dT%H:%M:%SZ")?;
    let list = materials::materials(&metadata, &lock, package, &time)?;
    fs::write(file, format!("{list:#}\n")).map_err(|error| told(file, &error))
}

/// Writes the checksums of the files of a folder, by name, as `sha256sum` does.
fn sum(folder: &Path, file: &Path) -> Done {
    let entries = fs::read_dir(folder).map_err(|error| told(folder, &error))?;
    let mut paths: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    paths.sort_unstable();
    let mut lines = String::new();
    for path in paths {
        let bytes = fs::read(&path).map_err(|error| told(&path, &error))?;
        let sum: String = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        lines += &format!("{sum}  {name}\n");
    }
    fs::write(file, lines).map_err(|error| told(file, &error))
}

/// What is left of an earlier release would get into the checksums.
fn empty(folder: &Path) -> Done {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| told(folder, &error))?;
    }
    fs::create_dir_all(folder).map_err(|error| told(folder, &error))
}

/// What a program prints.
fn asked(root: &Path, command: &str) -> Result<String, String> {
    let mut words = command.split(' ');
    let program = words.next().unwrap_or_default();
    let output = Command::new(program).args(words).current_dir(root).env("TZ", "UTC").output();
    match output {
        Ok(output) if output.status.success() => {
            Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
        }
        Ok(output) => Err(format!("{command} failed: {}", String::from_utf8_lossy(&output.stderr).trim())),
        Err(error) => Err(format!("{program} does not run: {error}")),
    }
}

fn told(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tree::sample;

    #[test]
    fn a_profile_of_its_own_is_taken() {
        assert_eq!(profile(&sample(&[("Cargo.toml", "[profile.release]\nlto = true\n")])), "release");
        assert_eq!(
            profile(&sample(&[("Cargo.toml", "[workspace]\n\n[profile.dist]\nlto = true\n")])),
            "dist"
        );
    }

    #[test]
    fn checksums_are_sorted_and_those_of_the_files() {
        let folder = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        put("b", "abc");
        put("c", "abc");
        put("a", "");
        let file = folder.path().join("SHA256SUMS");
        sum(folder.path(), &file).unwrap();
        // From FIPS 180-4 and its examples.
        assert_eq!(
            fs::read_to_string(&file).unwrap(),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855  a\n\
             ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  b\n\
             ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  c\n"
        );
    }
}
