//! Helpers of the tests: the program, models, answers.

use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::{Arc, LazyLock, Mutex, OnceLock};

use serde_json::Value;
use tempfile::TempDir;

pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
pub const EXAMPLES: [&str; 17] = [
    "apophis",
    "axial-mass",
    "boom-satellite",
    "duende",
    "explorer1",
    "explorer1-stiff",
    "friction-wheel",
    "gravity-gradient",
    "heavy-top",
    "inferred-damping",
    "mercury-ring",
    "nutation-damper",
    "oumuamua",
    "spherical-tank",
    "three-masses",
    "toutatis",
    "two-tanks",
];

/// Examples of finite elements and networks, which take longer; they have tests of their own.
pub const STRUCTURES: [&str; 4] = ["apophis-shape", "quillen-network", "solar-panels", "spin-up-beam"];

/// Examples without reduced equations, which have tests of their own.
pub const SLIDING: [&str; 1] = ["ring-damper"];

/// Examples with controllers, whose histories are those of the full system.
pub const CONTROLLED: [&str; 1] = ["detumbling-cubesat"];

/// Examples in sunlight, which have tests of their own.
pub const SUNLIT: [&str; 1] = ["sunlit-rock"];

/// Studies of many bodies, each of the model of another example.
pub const STUDIES: [&str; 2] = ["apophis-flyby", "damper-study"];

/// A rigid body with one mass on a spring; the tests replace parts of it.
pub const MODEL: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.1, 0.0]
inertia = [9.0, 13.0, 16.0]
[[point]]
name = \"tip\"
mass = 1.0
position = [0.8, 0.3, 0.5]
[[spring]]
from = \"tip\"
to = \"carrier\"
stiffness = 600.0
damping = 30.0
[initial]
angular_velocity = [0.12, 0.035, 0.02]
[run]
duration = 60
";

/// A text whose lines were wrapped, on one line.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Exit code and output of a command.
#[derive(Clone, Debug)]
pub struct Ran {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl Ran {
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// The message of a command that could not run.
    #[track_caller]
    pub fn refusal(&self) -> &str {
        assert_eq!((self.code, &*self.stdout), (Some(2), ""), "{}", self.stderr);
        &self.stderr
    }
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Self { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }
}

/// The program, in a folder, as if nobody had set a terminal.
pub fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_quasirigid"));
    command.current_dir(folder).env_remove("COLUMNS").env_remove("CLICOLOR_FORCE").env_remove("NO_COLOR");
    command
}

/// Runs a command line, split at spaces, in a folder.
pub fn ran_in(folder: &Path, line: &str) -> Ran {
    program(folder).args(line.split_whitespace()).output().unwrap().into()
}

/// Answers by model and command line.
type Answers = Mutex<HashMap<[String; 2], Arc<OnceLock<Ran>>>>;

/// The answer to a command line, which is run once however many tests ask.
fn shared(model: &str, line: &str, run: impl FnOnce() -> Ran) -> Ran {
    static ANSWERS: LazyLock<Answers> = LazyLock::new(Answers::default);
    let answer = Arc::clone(ANSWERS.lock().unwrap().entry([model, line].map(str::to_owned)).or_default());
    answer.get_or_init(run).clone()
}

/// The answer to a command line in the root of the repository; for commands that write nothing.
pub fn ran(line: &str) -> Ran {
    shared("", line, || ran_in(Path::new(ROOT), line))
}

/// A folder with a `model.toml`.
pub fn folder_with(model: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("model.toml"), model).unwrap();
    folder
}

/// A folder with a model and a study.
pub fn folder_of_study(study: &str) -> TempDir {
    let folder = folder_with(MODEL);
    fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

/// A folder with the model of an example.
pub fn folder_of(example: &str) -> TempDir {
    let text = fs::read_to_string(format!("{ROOT}/examples/{example}/model.toml")).unwrap();
    folder_with(&text)
}

/// The answer to a command line in a new folder with this `model.toml`.
pub fn ran_with(model: &str, line: &str) -> Ran {
    shared(model, line, || ran_in(folder_with(model).path(), line))
}

/// Names of the entries of a folder, hidden files too.
pub fn names(folder: impl AsRef<Path>) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Every file below a folder, by its path.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for name in names(folder) {
        let path = folder.join(&name);
        if path.is_dir() {
            files.extend(
                self::files(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)),
            );
        } else {
            files.insert(name, fs::read(path).unwrap());
        }
    }
    files
}

/// Copies a folder with its contents.
pub fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for name in names(from) {
        let (from, to): (PathBuf, PathBuf) = (from.join(&name), to.join(&name));
        if from.is_dir() { copy(&from, &to) } else { fs::copy(&from, &to).map(drop).unwrap() }
    }
}

/// A table as `simulate` prints it.
pub struct Table {
    pub header: Vec<String>,
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    pub fn of(csv: &str) -> Self {
        let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let header: Vec<_> = lines.next().unwrap().into_iter().map(str::to_owned).collect();
        let rows: Vec<Vec<f64>> =
            lines.map(|line| line.iter().map(|field| field.parse().unwrap()).collect()).collect();
        assert!(rows.iter().all(|row| row.len() == header.len()), "a row of another width");
        Self { header, rows }
    }

    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.header.iter().position(|each| each == name).unwrap();
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// A vector of three columns in one row.
    pub fn vector(&self, names: [&str; 3], row: usize) -> [f64; 3] {
        names.map(|name| self.column(name)[row])
    }
}

/// Distance of two vectors relative to the second.
pub fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    let norm = |entries: [f64; N]| entries.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(std::array::from_fn(|i| a[i] - b[i])) / norm(b)
}

/// The numbers of a JSON array.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|entry| entry.as_f64().unwrap()).collect()
}
