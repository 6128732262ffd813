//! A copy of the workspace with mutants in it, and its compiler.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use super::sample::{Mutant, PACKAGE};
use super::source::{Edits, mutated};
use super::{read, write};

/// Root of the crate, and the module of the switch.
const ROOT: &str = "crates/quasirigid/src/lib.rs";
const SWITCH: &str = "crates/quasirigid/src/mutant_switch.rs";
/// Start of the root: what the compiler sees to fail when it runs is for the tests to find.
const LENIENT: &str = "#![allow(warnings, arithmetic_overflow, unconditional_panic)] ";
/// Folders that the copy does without.
const SKIPPED: [&str; 2] = [".git", "target"];

/// A copy of the workspace.
pub struct Copy {
    /// Its root.
    tree: PathBuf,
    /// What is built of it.
    target: PathBuf,
}

/// What the compiler finds wrong in a file: places in bytes, the one that it names first.
struct Complaint {
    message: String,
    places: Vec<(String, usize)>,
}

impl Copy {
    /// A copy with edits; files that are there already stay, so that what is built of them does too.
    pub fn of(root: &Path, folder: &Path, name: &str, edits: &Edits) -> Result<Self, String> {
        let copy = Self { tree: folder.join(name), target: folder.join("build") };
        let texts = switched(root, edits)?;
        let own = texts.keys().map(|file| copy.tree.join(file)).collect();
        copied(root, &copy.tree, &own).map_err(|error| format!("cannot copy the workspace: {error}"))?;
        texts.iter().try_for_each(|(file, text)| copy.put(file, text))?;
        Ok(copy)
    }

    /// Takes out the edits that do not compile.
    pub fn weed(&self, root: &Path, edits: &mut Edits) -> Result<(), String> {
        loop {
            for (file, text) in switched(root, edits)? {
                self.put(&file, &text)?;
            }
            let complaints = self.check()?;
            if complaints.is_empty() {
                return self.restore(root, edits);
            }
            let mut refused = BTreeSet::new();
            for complaint in &complaints {
                let text = |file: &str| fs::read_to_string(self.tree.join(file)).unwrap_or_default();
                let texts: Vec<(String, usize)> =
                    complaint.places.iter().map(|(file, place)| (text(file), *place)).collect();
                let mut levels = ["m", "c"].into_iter();
                let blamed =
                    levels.find_map(|level| texts.iter().find_map(|(text, at)| inside(text, *at, level)));
                refused.insert(blamed.ok_or_else(|| format!("of no mutant: {}", complaint.message))?);
            }
            if !refused.iter().any(|mutant| edits.has(*mutant)) {
                return Err(format!("still does not compile: {}", complaints[0].message));
            }
            refused.iter().for_each(|mutant| edits.remove(*mutant));
        }
    }

    /// Those mutants without a switch that compile by themselves.
    pub fn alone(&self, root: &Path, mutants: &[Mutant], edits: &Edits) -> Result<BTreeSet<usize>, String> {
        let mut waiting: Vec<usize> = (0..mutants.len()).filter(|n| !edits.has(*n)).collect();
        let mut viable = BTreeSet::new();
        while !waiting.is_empty() {
            let mut files = BTreeSet::new();
            // One of each file, so that a file tells the mutant.
            let (mut batch, rest): (Vec<usize>, Vec<usize>) =
                waiting.into_iter().partition(|n| files.insert(&mutants[*n].file));
            waiting = rest;
            for n in &batch {
                let file = &mutants[*n].file;
                self.put(file, &mutated(&read(&root.join(file))?, &mutants[*n])?)?;
            }
            loop {
                let complaints = self.check()?;
                if complaints.is_empty() {
                    break;
                }
                let named = |n: &usize| complaints.iter().any(|it| it.places[0].0 == mutants[*n].file);
                let (bad, good): (Vec<usize>, Vec<usize>) = batch.into_iter().partition(named);
                if bad.is_empty() {
                    return Err(format!("of no mutant: {}", complaints[0].message));
                }
                for n in bad {
                    self.put(&mutants[n].file, &read(&root.join(&mutants[n].file))?)?;
                }
                batch = good;
            }
            for n in batch {
                self.put(&mutants[n].file, &read(&root.join(&mutants[n].file))?)?;
                viable.insert(n);
            }
        }
        Ok(viable)
    }

    /// Programs of the tests, with one mutant that has no switch.
    pub fn plain(&self, root: &Path, mutant: &Mutant) -> Result<Vec<PathBuf>, String> {
        let original = |file: &str| read(&root.join(file));
        self.put(ROOT, &format!("{LENIENT}{}", original(ROOT)?))?;
        let lenient = if mutant.file == ROOT { LENIENT } else { "" };
        self.put(&mutant.file, &format!("{lenient}{}", mutated(&original(&mutant.file)?, mutant)?))?;
        let programs = self.programs();
        self.put(&mutant.file, &original(&mutant.file)?)?;
        programs
    }

    /// Folder in which the tests of the package run.
    pub fn package(&self) -> PathBuf {
        self.tree.join("crates").join(PACKAGE)
    }

    /// Puts the original sources back.
    fn restore(&self, root: &Path, edits: &Edits) -> Result<(), String> {
        for file in edits.rendered().map(|(file, _)| file).chain([ROOT]) {
            self.put(file, &read(&root.join(file))?)?;
        }
        fs::remove_file(self.tree.join(SWITCH)).map_err(|error| format!("cannot remove {SWITCH}: {error}"))
    }

    fn put(&self, file: &str, text: &str) -> Result<(), String> {
        let path = self.tree.join(file);
        if fs::read_to_string(&path).is_ok_and(|there| there == text) { Ok(()) } else { write(&path, text) }
    }

    fn check(&self) -> Result<Vec<Complaint>, String> {
        let (messages, _) = self.cargo(&["check", "--lib", "--features", "serde"])?;
        Ok(messages.iter().filter_map(complaint).collect())
    }

    /// Programs of the tests.
    pub fn programs(&self) -> Result<Vec<PathBuf>, String> {
        let (messages, done) = self.cargo(&["test", "--no-run", "--lib", "--test", "suite"])?;
        if !done {
            return Err("the tests do not compile".into());
        }
        let of_tests = messages.iter().filter(|message| message["profile"]["test"] == true);
        Ok(of_tests.filter_map(|message| message["executable"].as_str()).map(PathBuf::from).collect())
    }

    fn cargo(&self, arguments: &[&str]) -> Result<(Vec<Value>, bool), String> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let asked = Command::new(cargo)
            .args(arguments)
            .args(["--package", PACKAGE, "--message-format", "json"])
            .current_dir(&self.tree)
            .env("CARGO_TARGET_DIR", &self.target)
            .stderr(Stdio::null())
            .output();
        let told = asked.map_err(|error| format!("cargo does not run ({error})"))?;
        let lines = told.stdout.split(|byte| *byte == b'\n');
        Ok((lines.filter_map(|line| serde_json::from_slice(line).ok()).collect(), told.status.success()))
    }
}

/// Files of the crate with the switch and with edits.
fn switched(root: &Path, edits: &Edits) -> Result<BTreeMap<String, String>, String> {
    let mut texts: BTreeMap<String, String> =
        edits.rendered().map(|(file, text)| (file.to_owned(), text)).collect();
    if texts.is_empty() {
        return Ok(texts);
    }
    let lib = texts.remove(ROOT).map_or_else(|| read(&root.join(ROOT)), Ok)?;
    texts.insert(ROOT.into(), format!("{LENIENT}{lib}\n#[doc(hidden)]\npub mod mutant_switch;\n"));
    texts.insert(SWITCH.into(), include_str!("switch.rs").into());
    Ok(texts)
}

/// An error of the compiler with the places that it names, those of its notes after its own; a macro is where it is called.
fn complaint(message: &Value) -> Option<Complaint> {
    let message = &message["message"];
    if message["level"] != "error" || message["spans"].as_array()?.is_empty() {
        return None;
    }
    let children = message["children"].as_array().into_iter().flatten();
    let mut spans: Vec<&Value> =
        [message].into_iter().chain(children).flat_map(|it| it["spans"].as_array()).flatten().collect();
    spans.sort_by_key(|span| span["is_primary"] != true);
    let place = |span: &&Value| {
        let mut span = *span;
        while span["expansion"].is_object() {
            span = &span["expansion"]["span"];
        }
        Some((span["file_name"].as_str()?.to_owned(), span["byte_start"].as_u64()? as usize))
    };
    let places = spans.iter().filter_map(place).collect();
    Some(Complaint { message: message["rendered"].as_str()?.to_owned(), places })
}

/// Mutant of the innermost comments of a level, see [`super::schema`], that stand around a place.
fn inside(text: &str, place: usize, level: &str) -> Option<usize> {
    let mut open = Vec::new();
    for comment in text.get(..place)?.split("/*").skip(1).filter_map(|rest| Some(rest.split_once("*/")?.0)) {
        if let Some(number) = comment.strip_prefix(level) {
            open.extend(number.parse::<usize>());
        } else if comment.strip_suffix(level).is_some_and(|number| number.parse::<usize>().is_ok()) {
            open.pop();
        }
    }
    open.pop()
}

/// Copies what differs, and removes what is there no more, but for files of the copy's own.
fn copied(from: &Path, to: &Path, own: &BTreeSet<PathBuf>) -> io::Result<()> {
    fs::create_dir_all(to)?;
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let [source, copy] = [from, to].map(|folder| folder.join(entry.file_name()));
        if SKIPPED.iter().any(|skipped| entry.file_name() == *skipped) {
            continue;
        }
        if entry.file_type()?.is_dir() {
            copied(&source, &copy, own)?;
        } else if !own.contains(&copy) && fs::read(&copy).ok() != Some(fs::read(&source)?) {
            fs::copy(&source, &copy)?;
        }
        names.insert(copy);
    }
    for entry in fs::read_dir(to)? {
        let entry = entry?;
        if names.contains(&entry.path()) || own.contains(&entry.path()) {
            continue;
        }
        if entry.file_type()?.is_dir() {
            fs::remove_dir_all(entry.path())?;
        } else {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
