//! Meshes of Abaqus and CalculiX: keyword lines and the data lines after them.

mod block;
mod keyword;
mod kinds;
mod sets;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use quasirigid_mesh::Mesh;

use super::draft::Draft;
use super::problem::VolumeProblem;
use crate::mesh::error::{MeshError, MeshProblem, Part as Kinds, Place, Row};
use crate::mesh::file::MAX_FILE;
use crate::text_file::bytes_of;
use block::{Block, Cells, Placing};
use keyword::Keyword;
use sets::Filling;

/// Files that may include one another: as many as Abaqus allows.
const DEEPEST: usize = 5;
/// Most instances named in notes.
const MOST_NAMED: usize = 10;
/// Keywords that make, copy or move nodes and cells.
const GENERATORS: [&str; 9] =
    ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPORT", "SUBMODEL"];

/// Elements that are no cells: they are counted and left out.
const BESIDE: [&str; 12] = [
    "MASS", "ROTARYI", "SPRING", "DASHPOT", "CONN", "DCOUP", "JOINT", "GAP", "ITT", "R3D", "RB3D", "HEATCAP",
];
/// Keywords of a body that are not carried.
const NOT_CARRIED: [&str; 16] = [
    "MASS",
    "ROTARY INERTIA",
    "SPRING",
    "DASHPOT",
    "COUPLING",
    "KINEMATIC",
    "DISTRIBUTING",
    "KINEMATIC COUPLING",
    "DISTRIBUTING COUPLING",
    "MPC",
    "EQUATION",
    "TIE",
    "RIGID BODY",
    "NONSTRUCTURAL MASS",
    "EMBEDDED ELEMENT",
    "CONNECTOR SECTION",
];

pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<(Mesh, Vec<String>), MeshError> {
    let folder = file.parent().unwrap_or(Path::new("")).to_owned();
    let mut reader = Reader {
        folder,
        root: Draft::default(),
        parts: Vec::new(),
        part: None,
        whole: Draft::default(),
        instances: Vec::new(),
        open: None,
        block: Block::Skipped,
        into: Into::Own,
        left_out: BTreeMap::new(),
        read: 0,
    };
    reader.read_file(file, bytes, &mut Vec::new())?;
    let end = Place::Line(bytes.split(|byte| *byte == b'\n').count());
    let located = |problem| MeshError { file: file.to_owned(), place: end.clone(), problem };
    reader.block.finish().map_err(located)?;
    reader.end().map_err(located)
}

/// A part with its nodes and cells, which are numbered apart from those of others.
struct Part {
    name: String,
    draft: Draft,
    placed: bool,
}

/// An instance that is in the mesh.
struct Instance {
    name: String,
    /// What was added to the numbers of its nodes and cells.
    shifts: [u64; 2],
    moved: bool,
}

/// An instance that has begun.
struct Open {
    name: String,
    part: Option<usize>,
    own: Draft,
    placing: Placing,
}

/// Draft into which lines are read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Into {
    /// That of the part or instance that is open, else the one outside of parts.
    Own,
    /// That of all instances.
    Whole,
}

/// A file while it is read.
struct Reader {
    /// Folder of the files that are included.
    folder: PathBuf,
    /// What is outside of parts.
    root: Draft,
    parts: Vec<Part>,
    /// The part that is open.
    part: Option<usize>,
    /// The instances.
    whole: Draft,
    instances: Vec<Instance>,
    open: Option<Open>,
    /// Meaning of the data lines that follow, and where they go.
    block: Block,
    into: Into,
    /// What is left out, with its number.
    left_out: BTreeMap<String, usize>,
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
                if let Block::Counted(name) = &self.block {
                    *self.left_out.entry(name.clone()).or_default() += 1;
                    continue;
                }
                let draft = match (self.into, &mut self.open, self.part) {
                    (Into::Whole, ..) => &mut self.whole,
                    (Into::Own, Some(open), _) => &mut open.own,
                    (Into::Own, None, Some(part)) => &mut self.parts[part].draft,
                    (Into::Own, None, None) => &mut self.root,
                };
                self.block.read(line, draft).map_err(located)?;
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
        if let (Block::Instance(placing), Some(open)) = (&self.block, &mut self.open) {
            open.placing = *placing;
        }
        if GENERATORS.contains(&keyword.name.as_str()) {
            return Err(VolumeProblem::Generated { found: format!("*{}", keyword.name).into() }.into());
        }
        if NOT_CARRIED.contains(&keyword.name.as_str()) {
            *self.left_out.entry(format!("*{}", keyword.name)).or_default() += 1;
        }
        self.into = Into::Own;
        self.block = match keyword.name.as_str() {
            "NODE" => self.nodes(keyword)?,
            "ELEMENT" => self.cells(keyword)?,
            "NSET" => self.set(keyword, "NSET")?,
            "ELSET" => self.set(keyword, "ELSET")?,
            "PART" => {
                let name = keyword.needs("NAME").unwrap_or_default().to_owned();
                self.parts.push(Part { name, draft: Draft::default(), placed: false });
                self.part = Some(self.parts.len() - 1);
                Block::Skipped
            }
            "END PART" => {
                self.part = None;
                Block::Skipped
            }
            "INSTANCE" => self.instance(keyword)?,
            "END INSTANCE" => {
                self.end_instance()?;
                Block::Skipped
            }
            _ => Block::Skipped,
        };
        Ok(())
    }

    fn instance(&mut self, keyword: &Keyword) -> Result<Block, MeshProblem> {
        self.end_instance()?;
        let name = keyword.needs("NAME")?.to_owned();
        let part = keyword.needs("PART")?;
        let part = self.parts.iter().position(|known| known.name.eq_ignore_ascii_case(part));
        if let Some(part) = part {
            self.parts[part].placed = true;
        }
        self.open = Some(Open { name, part, own: Draft::default(), placing: Placing::default() });
        Ok(Block::Instance(Placing::default()))
    }

    /// Adds the instance that is open to the mesh.
    fn end_instance(&mut self) -> Result<(), MeshProblem> {
        let Some(Open { name, part, own, placing }) = self.open.take() else { return Ok(()) };
        let prefix = format!("{name}.");
        let place = |node| placing.place(node);
        let mut shifts = [0; 2];
        if let Some(part) = part {
            shifts = self.whole.append(&self.parts[part].draft, place, &prefix)?;
        }
        if !own.is_empty() {
            shifts = self.whole.append(&own, place, &prefix)?;
        }
        self.instances.push(Instance { name, shifts, moved: !placing.is_still() });
        Ok(())
    }

    /// The draft into which lines of the file go now.
    fn draft(&mut self) -> &mut Draft {
        match (&mut self.open, self.part) {
            (Some(open), _) => &mut open.own,
            (None, Some(part)) => &mut self.parts[part].draft,
            (None, None) => &mut self.root,
        }
    }

    fn nodes(&mut self, keyword: &Keyword) -> Result<Block, MeshProblem> {
        if let Some(system) = keyword.parameter("SYSTEM").filter(|system| !system.eq_ignore_ascii_case("R")) {
            return Err(VolumeProblem::Generated { found: format!("*NODE, SYSTEM={system}").into() }.into());
        }
        self.own_lines(keyword)?;
        let set = keyword.parameter("NSET").map(|name| Filling::new(self.draft(), name, false, false));
        Ok(Block::Nodes { set })
    }

    fn cells(&mut self, keyword: &Keyword) -> Result<Block, MeshProblem> {
        self.own_lines(keyword)?;
        let name = keyword.needs("TYPE")?;
        let upper = name.to_ascii_uppercase();
        if BESIDE.iter().any(|known| upper.starts_with(known)) {
            return Ok(Block::Counted(format!("{upper} elements")));
        }
        let kind = kinds::Kind::of(name)?;
        let set = keyword.parameter("ELSET").map(|name| Filling::new(self.draft(), name, true, false));
        Ok(Block::Cells(Cells::new(kind, set)))
    }

    fn set(&mut self, keyword: &Keyword, key: &str) -> Result<Block, MeshProblem> {
        let name = keyword.needs(key)?;
        let ranges = keyword.parameter("GENERATE").is_some();
        let of_cells = key == "ELSET";
        let instance = keyword.parameter("INSTANCE").map(|instance| instance.to_ascii_uppercase());
        let instance = instance.and_then(|instance| {
            self.instances.iter().find(|known| known.name.eq_ignore_ascii_case(&instance))
        });
        if let Some(Instance { shifts, .. }) = instance {
            let shift = shifts[usize::from(of_cells)];
            self.into = Into::Whole;
            return Ok(Block::Set(Filling::new(&mut self.whole, name, of_cells, ranges).shifted(shift)));
        }
        let draft = self.draft();
        let set = Filling::new(draft, name, of_cells, ranges);
        if let Some(cells) = keyword.parameter("ELSET").filter(|_| key == "NSET") {
            set.add_nodes_of(draft, cells)?;
        }
        // Elements that are left out may be all members of a set.
        Ok(if of_cells && !self.left_out.is_empty() { Block::Set(set.of_some()) } else { Block::Set(set) })
    }

    /// The mesh of all instances, or of the file and its parts where there are none, and what was left out.
    fn end(mut self) -> Result<(Mesh, Vec<String>), MeshProblem> {
        self.end_instance()?;
        let mut notes = Vec::new();
        if !self.left_out.is_empty() {
            let counted = self.left_out.iter().map(|(name, count)| format!("{count} {name}"));
            notes.push(format!("left out: {}", counted.collect::<Vec<_>>().join(", ")));
        }
        if self.instances.is_empty() {
            for part in &self.parts {
                let prefix = if self.parts.len() > 1 { format!("{}.", part.name) } else { String::new() };
                self.root.append(&part.draft, |node| node, &prefix)?;
            }
            return Ok((self.root.mesh(), notes));
        }
        let unplaced: Vec<&str> =
            self.parts.iter().filter(|part| !part.placed).map(|part| part.name.as_str()).collect();
        if !unplaced.is_empty() {
            notes.push(format!("parts without an instance are left out: {}", unplaced.join(", ")));
        }
        let moved = self.instances.iter().filter(|instance| instance.moved).count();
        if moved > 0 {
            notes.push(format!("instances are moved to their places ({moved})"));
        }
        let renumbered = self.instances.iter().filter(|instance| instance.shifts != [0; 2]);
        for Instance { name, shifts: [nodes, cells], .. } in renumbered.take(MOST_NAMED) {
            notes.push(format!(
                "nodes of the instance {name} are numbered on from {nodes}, its cells from {cells}"
            ));
        }
        if let [only] = &self.instances[..] {
            self.whole.sets.without_prefix(&format!("{}.", only.name));
        }
        if !self.root.is_empty() {
            self.whole.append(&self.root, |node| node, "")?;
        }
        Ok((self.whole.mesh(), notes))
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
