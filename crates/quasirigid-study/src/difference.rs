//! Difference of two results, in words: which inputs differ, and which answers.
//! A result is the folder of a record or of a study, or a JSON answer; all of them carry what went in under `inputs`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use quasirigid_io::disk::read_regular;
use quasirigid_io::record::TableFormat;
use quasirigid_io::visible::shortened;
use quasirigid_math::memory::{self, TooMuchMemory};
use serde::Serialize;
use serde_json::{Map, Value};

use crate::hashed::Hashed;
use crate::layout::paragraph;
use crate::words::significant;

/// Files of a folder that hold its numbers, in the order in which they are looked for.
const OF_FOLDERS: [&str; 2] = ["record.json", "summary.json"];
/// Bytes in memory for each byte of JSON: a number of two digits takes a value of 32 bytes.
const IN_MEMORY: f64 = 16.0;
/// Most differences of a kind that the text lists.
const LISTED: usize = 25;
/// Keys of a result that say what it was made from, beside `inputs`.
const OF_INPUTS: [&str; 7] = ["model", "version", "study", "sha256", "name", "folder", "body"];
/// Digits of numbers in sentences.
const DIGITS: i32 = 8;
/// Answers that are told first.
const FIRST: [&str; 5] = ["sentence", "message", "verdict", "status", "time"];

/// Result that cannot be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DifferenceError {
    /// A folder without results.
    #[error("{}: no result is here; give the folder of a run or of a study, or a file that a command printed with --json", folder.display())]
    NoResult {
        /// The folder.
        folder: PathBuf,
    },
    /// A file that cannot be read.
    #[error("{}: {cause}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        cause: io::Error,
    },
    /// A file that is no JSON object.
    #[error("{}: this is not a JSON object: {}; give a file that a command printed with --json", path.display(), shortened(cause))]
    NoObject {
        /// The file.
        path: PathBuf,
        /// Message of the reader.
        cause: String,
    },
    /// A file without room in memory.
    #[error("{}: {cause}", path.display())]
    Memory {
        /// The file.
        path: PathBuf,
        /// Memory that it takes.
        cause: TooMuchMemory,
    },
}

/// One difference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Differing {
    /// What differs: a file, a key, a path into the answer.
    pub what: String,
    /// In the first result; `null` where it has none.
    pub first: Value,
    /// In the second.
    pub second: Value,
    /// Difference in words.
    pub sentence: String,
}

/// Difference of two results.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Whether nothing differs.
    pub same: bool,
    /// Inputs that differ.
    pub inputs: Vec<Differing>,
    /// Answers that differ.
    pub answers: Vec<Differing>,
    /// Remarks: results that do not say what went in.
    pub notes: Vec<String>,
}

/// A result: its object, and the checksums of its tables.
struct Found {
    object: Map<String, Value>,
    tables: BTreeMap<String, String>,
}

/// Difference of two results.
///
/// # Errors
/// [`DifferenceError`] for paths without a result.
pub fn difference(first: &Path, second: &Path) -> Result<Difference, DifferenceError> {
    let [mut a, mut b] = [found(first)?, found(second)?];
    let mut found = Difference::default();
    for (path, result) in [(first, &a), (second, &b)] {
        let told = ["inputs", "files"].iter().any(|key| match result.object.get(*key) {
            Some(Value::Object(_)) => true,
            Some(Value::Array(_)) => *key == "files",
            _ => false,
        });
        if !told {
            found.notes.push(format!("{} does not say what went in", path.display()));
        }
    }
    let [of_a, of_b] = [&mut a, &mut b].map(|result| inputs_of(&mut result.object));
    found.inputs = differing(&of_a, &of_b);
    found.answers = differing(&answers_of(a), &answers_of(b));
    found.answers.sort_by_key(|each| {
        let last = each.what.rsplit('.').next().unwrap_or_default();
        (!FIRST.contains(&last), each.what.matches('.').count())
    });
    found.same = found.inputs.is_empty() && found.answers.is_empty();
    Ok(found)
}

fn found(path: &Path) -> Result<Found, DifferenceError> {
    let mut tables = BTreeMap::new();
    let file = if path.is_dir() {
        let there = OF_FOLDERS.map(|name| path.join(name)).into_iter().find(|file| file.exists());
        tables = checksums(path).map_err(|cause| DifferenceError::File { path: path.into(), cause })?;
        there.ok_or_else(|| DifferenceError::NoResult { folder: path.into() })?
    } else {
        path.to_owned()
    };
    let unread = |cause| DifferenceError::File { path: file.clone(), cause };
    let size = file.metadata().map_err(unread)?.len();
    memory::ask(IN_MEMORY * size as f64)
        .map_err(|cause| DifferenceError::Memory { path: file.clone(), cause })?;
    let text = read_regular(&file).map_err(unread)?;
    let object = serde_json::from_slice::<Map<String, Value>>(&text)
        .map_err(|cause| DifferenceError::NoObject { path: file.clone(), cause: cause.to_string() })?;
    Ok(Found { object, tables })
}

/// Checksums of the tables in a folder, by name.
fn checksums(folder: &Path) -> io::Result<BTreeMap<String, String>> {
    let mut sums = BTreeMap::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_table =
            TableFormat::ALL.iter().any(|format| path.extension() == Some(format.ending().as_ref()));
        if is_table && path.is_file() {
            let mut hash = Hashed::default();
            hash.file(&path)?;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            sums.insert(format!("rows of {name}"), hash.finish());
        }
    }
    Ok(sums)
}

/// What went in, by words; the keys that say so are taken out of the object.
fn inputs_of(object: &mut Map<String, Value>) -> BTreeMap<String, Value> {
    let mut all = BTreeMap::new();
    let inputs = match object.remove("inputs") {
        Some(Value::Object(inputs)) => inputs,
        // of a study `inputs` are the columns that vary, and its files stand beside them
        Some(columns) if object.contains_key("files") => {
            leaves("column", &columns, &mut all);
            Map::from_iter([("files".to_owned(), object.remove("files").unwrap_or_default())])
        }
        _ => return all, // the checksum of the model is then compared among the answers
    };
    OF_INPUTS.iter().for_each(|key| drop(object.remove(*key)));
    let list = |key: &str| inputs.get(key).and_then(Value::as_array).into_iter().flatten();
    let text = |item: &Value, key: &str| item[key].as_str().unwrap_or_default().to_owned();
    for file in list("files") {
        let told = format!("{} bytes, SHA-256 {}", file["bytes"], text(file, "sha256"));
        all.insert(format!("file {}", text(file, "name")), told.into());
    }
    for value in list("values") {
        let unit = text(value, "unit");
        let name =
            if unit.is_empty() { text(value, "key") } else { format!("{} ({unit})", text(value, "key")) };
        all.insert(name, value["value"].clone());
    }
    if let Some(body) = inputs.get("body") {
        leaves("body", body, &mut all);
    }
    if let Some(version) = inputs.get("version") {
        all.insert("version of quasirigid".to_owned(), version.clone());
    }
    all
}

fn answers_of(found: Found) -> BTreeMap<String, Value> {
    let mut all = BTreeMap::new();
    leaves("", &Value::Object(found.object), &mut all);
    all.extend(found.tables.into_iter().map(|(name, sum)| (name, sum.into())));
    all
}

/// Leaves of a value by their paths; entries of a list by name where they have one, numbers in a list together.
fn leaves(path: &str, value: &Value, all: &mut BTreeMap<String, Value>) {
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    match value {
        Value::Object(entries) => entries.iter().for_each(|(key, value)| leaves(&below(key), value, all)),
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_array()) => {
            for (number, item) in (1..).zip(items) {
                let name = ["name", "system", "key"].iter().find_map(|key| item[*key].as_str());
                let unique = name.filter(|name| {
                    items.iter().filter(|item| item["name"] == *name || item["system"] == *name).count() <= 1
                });
                leaves(&below(&unique.map_or_else(|| i32::to_string(&number), str::to_owned)), item, all);
            }
        }
        leaf => drop(all.insert(path.to_owned(), leaf.clone())),
    }
}

fn differing(first: &BTreeMap<String, Value>, second: &BTreeMap<String, Value>) -> Vec<Differing> {
    let names: BTreeSet<&String> = first.keys().chain(second.keys()).collect();
    let difference = |name: &String| {
        let [a, b] = [first, second].map(|side| side.get(name));
        (a != b).then(|| Differing {
            what: name.clone(),
            first: a.cloned().unwrap_or_default(),
            second: b.cloned().unwrap_or_default(),
            sentence: sentence(name, a, b),
        })
    };
    names.into_iter().filter_map(difference).collect()
}

fn sentence(name: &str, a: Option<&Value>, b: Option<&Value>) -> String {
    match (a, b) {
        (Some(a), None) => format!("{name}: {} in the first, nothing in the second", told(a)),
        (None, Some(b)) => format!("{name}: nothing in the first, {} in the second", told(b)),
        (Some(Value::Array(a)), Some(Value::Array(b))) if a.len() == b.len() && a.len() > 3 => {
            let count = a.iter().zip(b).filter(|(a, b)| a != b).count();
            format!("{name}: {count} of {} entries differ", a.len())
        }
        (Some(_), Some(_)) if name.starts_with("rows of ") => format!("{name} differ"),
        (Some(a), Some(b)) => match (a.as_f64(), b.as_f64()) {
            (Some(from), Some(to)) => format!("{name}: {}, then {}{}", told(a), told(b), relative(from, to)),
            _ => format!("{name}: {}, then {}", told(a), told(b)),
        },
        (None, None) => String::new(),
    }
}

/// Relative difference of two numbers in words, where the first is one to be relative to.
fn relative(from: f64, to: f64) -> String {
    let percent = 100.0 * (to - from) / from.abs();
    if !percent.is_finite() {
        return String::new();
    }
    format!(" ({} % {})", significant(percent.abs(), 2), if percent > 0.0 { "more" } else { "less" })
}

fn told(value: &Value) -> String {
    match value {
        Value::String(text) => shortened(text).into_owned(),
        Value::Number(number) if number.is_f64() => {
            number.as_f64().map_or_else(|| number.to_string(), |value| significant(value, DIGITS))
        }
        Value::Array(items) if items.len() <= 3 && items.iter().all(Value::is_number) => {
            items.iter().map(told).collect::<Vec<_>>().join(", ")
        }
        other => shortened(&other.to_string()).into_owned(),
    }
}

/// Difference in words, for a terminal of 80 columns.
#[must_use]
pub fn text(difference: &Difference) -> String {
    let mut text = String::new();
    let mut line = |line: &str, first: &str| text.push_str(&(paragraph(line, first, "    ") + "\n"));
    if difference.same {
        line("The results are the same, and so are their inputs.", "");
    }
    for (title, list, none) in [
        ("Inputs that differ:", &difference.inputs, "No input differs."),
        ("Answers that differ:", &difference.answers, "No answer differs."),
    ] {
        if difference.same {
            break;
        }
        line(if list.is_empty() { none } else { title }, "");
        list.iter().take(LISTED).for_each(|each| line(&each.sentence, "  "));
        if list.len() > LISTED {
            line(&format!("and {} more; --json lists them", list.len() - LISTED), "  ");
        }
    }
    difference.notes.iter().for_each(|note| line(&format!("note: {note}."), ""));
    text
}
