//! Workspace in memory: all paths, and the texts that the checks read.
//! Checks take a tree and never the disk, so that tests run them on a few made-up files.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::Path;

/// Folders that hold nothing the workspace ships.
const SKIPPED: [&str; 3] = [".git", "dist", "target"];

/// Endings of the paths of files whose text the checks read.
const READ: [&str; 8] = [".rs", ".py", ".md", ".toml", ".bib", ".cff", ".yaml", ".ci/run"];

/// The workspace in memory: every path, and the text of the files that the checks read.
///
/// Paths are relative to the root, with `/` between their parts. As in a checkout, a folder exists if it holds a file.
#[derive(Debug, Default)]
pub struct Tree {
    files: BTreeMap<String, String>,
}

impl Tree {
    /// Reads the workspace at `root`.
    ///
    /// # Errors
    /// A folder or file that cannot be read, by name.
    pub fn load(root: &Path) -> io::Result<Self> {
        let mut tree = Self::default();
        tree.load_folder(root, "")?;
        Ok(tree)
    }

    fn load_folder(&mut self, folder: &Path, prefix: &str) -> io::Result<()> {
        for entry in std::fs::read_dir(folder).map_err(|error| named(folder, &error))? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            if SKIPPED.contains(&name.as_str()) {
                continue;
            }
            let path = format!("{prefix}{name}");
            if entry.file_type()?.is_dir() {
                self.load_folder(&entry.path(), &format!("{path}/"))?;
            } else {
                let read = READ.iter().any(|end| path.ends_with(end));
                let text = if read { read_text(&entry.path())? } else { String::new() };
                self.files.insert(path, text);
            }
        }
        Ok(())
    }

    /// Whether a file or folder has this path.
    pub fn exists(&self, path: &str) -> bool {
        self.files.keys().any(|file| file == path || is_below(file, path))
    }

    /// Text of the file at `path`, if there is one.
    pub fn text(&self, path: &str) -> Option<&str> {
        self.files.get(path).map(String::as_str)
    }

    /// Paths and texts of the files in `folder` and below it whose name ends in `end`, in order.
    pub fn files<'t>(&'t self, folder: &'t str, end: &'t str) -> impl Iterator<Item = (&'t str, &'t str)> {
        self.files
            .iter()
            .map(|(path, text)| (path.as_str(), text.as_str()))
            .filter(move |(path, _)| is_below(path, folder) && path.ends_with(end))
    }

    /// Names of the crates in `crates/`, in order.
    pub fn crates(&self) -> BTreeSet<&str> {
        let inside = self.files.keys().filter_map(|path| path.strip_prefix("crates/"));
        inside.filter_map(|path| path.split_once('/')).map(|(name, _)| name).collect()
    }
}

/// Whether `path` lies in `folder` or below it; the root is the empty folder.
pub fn is_below(path: &str, folder: &str) -> bool {
    folder.is_empty() || path.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/'))
}

fn read_text(path: &Path) -> io::Result<String> {
    std::fs::read_to_string(path).map_err(|error| named(path, &error))
}

fn named(path: &Path, error: &io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

/// A small workspace for the tests, written to a temporary folder and read back.
#[cfg(test)]
pub fn sample(files: &[(&str, &str)]) -> Tree {
    let root = tempfile::tempdir().expect("a temporary folder");
    for (path, text) in files {
        let path = root.path().join(path);
        std::fs::create_dir_all(path.parent().expect("a file has a folder")).expect("a new folder");
        std::fs::write(path, text).expect("a new file");
    }
    Tree::load(root.path()).expect("the folder just written")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_knows_its_files_folders_and_crates() {
        let tree = sample(&[
            ("crates/one/src/lib.rs", "fn f() {}"),
            ("crates/two/Cargo.toml", ""),
            ("crates/one-more/src/lib.rs", ""),
        ]);
        assert!(tree.exists("crates/one/src"));
        assert!(!tree.exists("crates/one/sr"));
        assert_eq!(tree.text("crates/one/src/lib.rs"), Some("fn f() {}"));
        assert_eq!(tree.crates(), BTreeSet::from(["one", "one-more", "two"]));
        let rust: Vec<_> = tree.files("crates/one", ".rs").map(|(path, _)| path).collect();
        assert_eq!(rust, ["crates/one/src/lib.rs"]);
    }

    #[test]
    fn an_empty_folder_does_not_exist() {
        let root = tempfile::tempdir().expect("a temporary folder");
        std::fs::create_dir(root.path().join("empty")).expect("a new folder");
        assert!(!Tree::load(root.path()).expect("the folder just made").exists("empty"));
    }

    #[test]
    fn build_output_is_no_part_of_the_tree() {
        let tree =
            sample(&[("target/debug/lib.rs", ""), ("dist/a.md", ""), (".git/config", ""), (".ci/run", "x")]);
        assert!(!tree.exists("target") && !tree.exists("dist") && !tree.exists(".git"));
        assert_eq!(tree.text(".ci/run"), Some("x"));
    }
}
