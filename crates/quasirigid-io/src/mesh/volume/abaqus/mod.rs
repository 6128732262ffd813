//! Meshes of Abaqus and CalculiX: keyword lines and the data lines after them.

mod block;
mod keyword;
mod kinds;
mod sets;

use std::path::{Path, PathBuf};

use quasirigid_mesh::Mesh;

use super::draft::Draft;
use super::problem::VolumeProblem;
use crate::mesh::error::{MeshError, MeshProblem, Part, Place, Row};
use crate::mesh::file::MAX_FILE;
use crate::text_file::bytes_of;
use block::{Block, Cells};
use keyword::Keyword;
use sets::Filling;

/// Files that may include one another: as many as Abaqus allows.
const DEEPEST: usize = 5;
/// Keywords that make, copy or move nodes and cells.
const GENERATORS: [&str; 9] =
    ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPORT", "SUBMODEL"];

pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Mesh, MeshError> {
    let folder = file.parent().unwrap_or(Path::new("")).to_owned();
    let mut reader =
        Reader { folder, draft: Draft::default(), block: Block::Skipped, parts: 0, instances: 0, read: 0 };
    reader.read_file(file, bytes, &mut Vec::new())?;
    let end = Place::Line(bytes.split(|byte| *byte == b'\n').count());
    let located = |problem| MeshError { file: file.to_owned(), place: end, problem };
    reader.block.finish().map_err(located)?;
    Ok(reader.draft.mesh())
}

/// A file while it is read.
struct Reader {
    /// Folder of the files that are included.
    folder: PathBuf,
    draft: Draft,
    /// Meaning of the data lines that follow.
    block: Block,
    parts: usize,
    instances: usize,
    /// Bytes of the files included so far.
    read: u64,
}

impl Reader {
    /// Reads a file within those that include it.
    fn read_file(&mut self, file: &Path, bytes: &[u8], within: &mut Vec<PathBuf>) -> Result<(), MeshError> {
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        for (number, line) in (1..).zip(bytes.split(|byte| *byte == b'\n')) {
            let line = line.trim_ascii();
            if line.is_empty() || line.starts_with(b"**") {
                continue; // comments may be in any encoding
            }
            let located = |problem| MeshError { file: file.to_owned(), place: Place::Line(number), problem };
            let wrong = |error: std::str::Utf8Error| MeshProblem::NotText { byte: line[error.valid_up_to()] };
            let line = std::str::from_utf8(line).map_err(wrong).map_err(located)?;
            let Some(keyword) = line.strip_prefix('*').map(Keyword::new) else {
                self.block.read(line, &mut self.draft).map_err(located)?;
                continue;
            };
            if keyword.name == "INCLUDE" {
                let name = keyword.needs("INPUT").map_err(|problem| located(problem.into()))?;
                let included = self.folder.join(name);
                within.push(file.to_owned());
                if within.len() >= DEEPEST || within.contains(&included) {
                    return Err(located(VolumeProblem::Include { file: included, limit: DEEPEST }.into()));
                }
                let bytes = bytes_of::<MeshProblem>(&included, MAX_FILE)?;
                self.read += bytes.len() as u64;
                if self.read > MAX_FILE {
                    return Err(located(MeshProblem::TooLarge { limit: MAX_FILE }));
                }
                self.read_file(&included, &bytes, within)?;
                within.pop();
            } else {
                self.start(&keyword).map_err(located)?;
            }
        }
        Ok(())
    }

    /// Starts the block of a keyword.
    fn start(&mut self, keyword: &Keyword) -> Result<(), MeshProblem> {
        self.block.finish()?;
        if GENERATORS.contains(&keyword.name.as_str()) {
            return Err(VolumeProblem::Generated { found: format!("*{}", keyword.name).into() }.into());
        }
        self.block = match keyword.name.as_str() {
            "NODE" => self.nodes(keyword)?,
            "ELEMENT" => self.cells(keyword)?,
            "NSET" => self.set(keyword, "NSET")?,
            "ELSET" => self.set(keyword, "ELSET")?,
            "PART" => {
                self.parts += 1;
                one(self.parts, "a second *PART")?;
                Block::Skipped
            }
            "INSTANCE" => {
                self.instances += 1;
                one(self.instances, "a second *INSTANCE")?;
                Block::Instance
            }
            _ => Block::Skipped,
        };
        Ok(())
    }

    fn nodes(&mut self, keyword: &Keyword) -> Result<Block, MeshProblem> {
        if let Some(system) = keyword.parameter("SYSTEM").filter(|system| !system.eq_ignore_ascii_case("R")) {
            return Err(VolumeProblem::Generated { found: format!("*NODE, SYSTEM={system}").into() }.into());
        }
        self.own_lines(keyword)?;
        let set = keyword.parameter("NSET").map(|name| Filling::new(&mut self.draft, name, false, false));
        Ok(Block::Nodes { set })
    }

    fn cells(&mut self, keyword: &Keyword) -> Result<Block, MeshProblem> {
        self.own_lines(keyword)?;
        let kind = kinds::Kind::of(keyword.needs("TYPE")?)?;
        let set = keyword.parameter("ELSET").map(|name| Filling::new(&mut self.draft, name, true, false));
        Ok(Block::Cells(Cells::new(kind, set)))
    }

    fn set(&mut self, keyword: &Keyword, key: &str) -> Result<Block, MeshProblem> {
        let name = keyword.needs(key)?;
        let ranges = keyword.parameter("GENERATE").is_some();
        let set = Filling::new(&mut self.draft, name, key == "ELSET", ranges);
        if let Some(cells) = keyword.parameter("ELSET").filter(|_| key == "NSET") {
            set.add_nodes_of(&mut self.draft, cells)?;
        }
        Ok(Block::Set(set))
    }

    /// Refuses a block whose lines are in another file.
    fn own_lines(&self, keyword: &Keyword) -> Result<(), MeshProblem> {
        match keyword.parameter("INPUT") {
            Some(file) => {
                Err(VolumeProblem::Generated { found: format!("*{}, INPUT={file}", keyword.name).into() }
                    .into())
            }
            None => Ok(()),
        }
    }
}

fn one(count: usize, what: &str) -> Result<(), MeshProblem> {
    if count < 2 { Ok(()) } else { Err(VolumeProblem::Assembly { found: what.into() }.into()) }
}
