//! Every test, of Rust and of Python, by one command.
//! The tests of the Python package need an interpreter and libraries, which not every machine has; a missing one is told with the
//! way to get it, and is no failure unless Python is required, as it is on the server. The package is put together from the library that
//! the build of the workspace makes: a wheel compiles most of it a second time, with other features of its dependencies, and is tested on
//! request. Executables of tests and Python run side by side, since many wait for other programs; each tells its result at its end.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::ffi::OsStr;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Output};
use std::thread;

use crate::lanes::{self, Executable, Job};

/// Versions of what the tests of Python need.
const REQUIREMENTS: &str = "requirements-test.txt";
/// Processes that share the tests of Python, file by file: many wait for a browser or a kernel.
const WORKERS: &str = "2";
/// Interpreter that `PYTHON` may replace.
const INTERPRETER: &str = "python3";
/// A program that an interpreter which can do the work runs in silence.
const PROBE: &str = "\
import sys
if sys.version_info < (3, 11): sys.exit('Python 3.11 or newer, not %d.%d' % sys.version_info[:2])
try: import ensurepip, venv
except ImportError as error: sys.exit('the module %s of Python' % error.name)";

pub type Step = Result<(), String>;

/// Kinds of targets; naming them also builds the library of the Python package, with the features that the tests have.
const TARGETS: [&str; 3] = ["--lib", "--bins", "--tests"];
/// All features, which the first build of a user leaves out, and the profile of tests, in which our crates are optimised.
const BUILT: [&str; 3] = ["--all-features", "--profile", "test"];
/// A program that prints the folder of an environment's packages.
const PACKAGES: &str = "import sysconfig; print(sysconfig.get_path('purelib'))";

/// Wishes of the caller.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wishes {
    /// Whether a missing interpreter is a failure.
    pub python: bool,
    /// Whether the wheel is built and tested, as users install it.
    pub wheel: bool,
}

/// Runs the tests of Rust beside those of Python. Those of Python come first: they take long, and much of it is waiting.
pub fn run(root: &Path, wishes: Wishes) -> Step {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let all = |verb| [verb, "--workspace"].into_iter().chain(BUILT);
    let python = match interpreter(root) {
        Ok(python) => Some(python),
        Err(missing) if wishes.python => return Err(missing),
        Err(missing) => {
            println!("\nxtask test: the tests of Python are LEFT OUT: {missing}");
            None
        }
    };
    let (executables, own) = thread::scope(|scope| {
        let environment = python.map(|python| scope.spawn(move || installed(root, &python)));
        let executables = Executable::all(root, &cargo, all("build").chain(TARGETS))?;
        let joined = environment.map(|thread| thread.join());
        let own = joined.map(|made| made.unwrap_or_else(|_| Err("a thread panicked".to_owned())));
        Ok::<_, String>((executables, own.transpose()?))
    })?;
    let of_python = own.iter().map(|own| -> Job { Box::new(|| of_python(root, own, wishes.wheel)) });
    let of_rust = executables.iter().map(|own| -> Job { Box::new(|| own.run(&cargo)) });
    let documents: Job = Box::new(|| quiet(root, &cargo, all("test").chain(["--doc", "--quiet"])));
    lanes::run(of_python.chain(of_rust).chain([documents]).collect())
}

/// Folder of cargo's output.
pub fn target(root: &Path) -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from)
}

/// The interpreter of an environment with what the tests need, maturin among it.
///
/// # Errors
/// A sentence on what is missing.
pub fn environment(root: &Path) -> Result<PathBuf, String> {
    installed(root, &interpreter(root)?)
}

/// An interpreter with what the tests need, or a sentence on what is missing.
fn interpreter(root: &Path) -> Result<PathBuf, String> {
    let python = std::env::var_os("PYTHON").map_or_else(|| INTERPRETER.into(), PathBuf::from);
    let asked = Command::new(&python).args(["-c", PROBE]).current_dir(root).output();
    let advice = "; install Python 3.11 or newer with its venv module (Debian: apt install python3-venv), or name one \
                  with the environment variable PYTHON";
    match asked {
        Ok(answer) if answer.status.success() => Ok(python),
        Ok(answer) => {
            let missing = String::from_utf8_lossy(&answer.stderr);
            Err(format!("missing is {}{advice}", missing.trim()))
        }
        Err(error) => Err(format!("{} does not run ({error}){advice}", python.display())),
    }
}

/// The package in its environment, and its tests.
fn of_python(root: &Path, own: &Path, wheel: bool) -> Step {
    let target = target(root);
    let told = Command::new(own).args(["-c", PACKAGES]).output();
    let packages = told.map_err(|error| format!("{} does not run ({error})", own.display()))?.stdout;
    let package = Path::new(String::from_utf8_lossy(&packages).trim()).join("quasirigid");
    let copied = match fs::remove_dir_all(&package) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ if wheel => Ok(()),
        _ => copy_package(root, &target, &package),
    };
    copied.map_err(|error| format!("cannot make {}: {error}", package.display()))?;
    if wheel {
        install_wheel(root, &target, own)?;
    }
    let suite = ["-m", "pytest", "-q", "-n", WORKERS, "--dist", "loadfile", "crates/quasirigid-python/tests"];
    quiet(root, own, suite)?;
    quiet(root, own, ["-m", "mypy", "-p", "quasirigid"])?;
    quiet(root, own, ["-m", "mypy.stubtest", "--mypy-config-file", "pyproject.toml", "quasirigid"])
}

/// The sources of the package with the library that the build of the workspace made.
fn copy_package(root: &Path, target: &Path, package: &Path) -> io::Result<()> {
    fs::create_dir_all(package)?;
    for entry in fs::read_dir(root.join("crates/quasirigid-python/python/quasirigid"))? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            fs::copy(entry.path(), package.join(entry.file_name()))?;
        }
    }
    let library = format!("{DLL_PREFIX}_core{DLL_SUFFIX}");
    let extension = if cfg!(windows) { "_core.pyd" } else { "_core.abi3.so" };
    fs::copy(target.join("debug").join(library), package.join(extension)).map(drop)
}

/// The wheel, built and installed.
fn install_wheel(root: &Path, target: &Path, own: &Path) -> Step {
    let wheels = target.join("python-wheel");
    // A wheel of an earlier version would be installed with the new one.
    if wheels.exists() {
        fs::remove_dir_all(&wheels).map_err(|error| format!("cannot empty {}: {error}", wheels.display()))?;
    }
    let wheel = ["-m", "maturin", "build", "--profile", "dev", "--interpreter"].map(OsStr::new);
    let wheel = wheel.into_iter().chain([own.as_os_str(), "--out".as_ref(), wheels.as_os_str()]);
    step(root, own, wheel)?;
    let install = ["-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--force-reinstall"];
    let found = ["--find-links".as_ref(), wheels.as_os_str(), "quasirigid".as_ref()];
    step(root, own, install.map(OsStr::new).into_iter().chain(found))
}

/// Makes the environment, unless the one that is there has these requirements.
fn installed(root: &Path, python: &Path) -> Result<PathBuf, String> {
    let environment = target(root).join("python-venv");
    let own = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let file = root.join(REQUIREMENTS);
    let wanted =
        fs::read_to_string(&file).map_err(|error| format!("cannot read {}: {error}", file.display()))?;
    let stamp = environment.join(REQUIREMENTS);
    if own.exists() && fs::read_to_string(&stamp).is_ok_and(|installed| installed == wanted) {
        return Ok(own);
    }
    let made = ["-m", "venv", "--clear"].map(OsStr::new).into_iter().chain([environment.as_os_str()]);
    step(root, python, made)?;
    // What is imported is compiled then: a part of the libraries, half of whose installation would go into compiling all.
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile", "-r"];
    step(root, &own, install.into_iter().chain([REQUIREMENTS]))?;
    fs::write(&stamp, wanted).map_err(|error| format!("cannot write {}: {error}", stamp.display()))?;
    Ok(own)
}

/// Runs a program in the root of the workspace, and says which one failed.
fn step<S: AsRef<OsStr>>(
    root: &Path,
    program: impl AsRef<OsStr>,
    arguments: impl IntoIterator<Item = S>,
) -> Step {
    let (mut command, shown) = command(root, program, arguments);
    println!("\nxtask test: {shown}");
    judged(command.status(), &shown)
}

/// The same; what it prints comes at its end.
fn quiet<S: AsRef<OsStr>>(
    root: &Path,
    program: impl AsRef<OsStr>,
    arguments: impl IntoIterator<Item = S>,
) -> Step {
    let (mut command, shown) = command(root, program, arguments);
    told_at_its_end(&mut command, &shown, str::to_owned)
}

/// Runs a command, and prints at its end what it told: all where it fails, else what a function leaves of it.
pub fn told_at_its_end(command: &mut Command, shown: &str, passed: impl Fn(&str) -> String) -> Step {
    let ended = command.output().map(|Output { status, stdout, stderr }| {
        let told = [stdout, stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
        println!("\nxtask test: {shown}\n{}", if status.success() { passed(&told) } else { told });
        status
    });
    judged(ended, shown)
}

fn command<S: AsRef<OsStr>>(
    root: &Path,
    program: impl AsRef<OsStr>,
    arguments: impl IntoIterator<Item = S>,
) -> (Command, String) {
    let mut command = Command::new(&program);
    command.args(arguments).current_dir(root);
    // Python prints at once, and reads the package that is installed alone.
    command.env("PYTHONUNBUFFERED", "1").env_remove("PYTHONPATH");
    let shown = format!("{command:?}").replace('"', "");
    (command, shown)
}

pub fn judged(ended: io::Result<ExitStatus>, shown: &str) -> Step {
    match ended {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("failed, {status}: {shown}")),
        Err(error) => Err(format!("does not run ({error}): {shown}")),
    }
}
