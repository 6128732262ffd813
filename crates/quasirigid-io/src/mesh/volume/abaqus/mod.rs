//! Meshes of Abaqus and CalculiX: keyword lines and the data lines after them.

mod block;
mod inp;
mod keyword;
mod kinds;
mod sets;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use quasirigid_mesh::Mesh;

use super::draft::Draft;
pub(crate) use super::draft::Pyramid;
use super::others::Other;
use super::problem::VolumeProblem;
use crate::deck::{Places, Run};
use crate::mesh::error::{MeshError, MeshProblem, Part as Kinds, Place, Row};
use crate::mesh::file::MAX_FILE;
use crate::text_file::bytes_of;
pub(crate) use block::Placing;
use block::{Block, Cells};
pub(crate) use inp::{Inp, InpCard, Placed, Scope};
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
/// Keywords of bodies, springs and nodes that follow others: a deck takes them, a mesh counts them.
pub(crate) const OF_BODIES: [&str; 13] = [
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
];
/// Keywords of a body that neither takes.
const NOT_CARRIED: [&str; 3] = ["NONSTRUCTURAL MASS", "EMBEDDED ELEMENT", "CONNECTOR SECTION"];

/// The mesh of a file, and what was left out.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<(Mesh, Vec<String>), MeshError> {
    let read = read_with(file, bytes, None)?;
    Ok((read.mesh, read.notes))
}

/// A file with the cards that are kept by name; elements of other types than those of a mesh are counted and left out.
///
/// # Errors
/// [`MeshError`] says what is wrong and on which line.
pub(crate) fn read_inp(file: &Path, bytes: &[u8], kept: fn(&str) -> bool) -> Result<Inp, MeshError> {
    read_with(file, bytes, Some(kept))
}

fn read_with(file: &Path, bytes: &[u8], kept: Option<fn(&str) -> bool>) -> Result<Inp, MeshError> {
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
        kept,
        cards: Vec::new(),
        counts: BTreeMap::new(),
        types: Vec::new(),
        places: Places::default(),
        next: 1,
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
    part: Option<usize>,
    /// What was added to the numbers of its nodes and cells.
    shifts: [u64; 2],
    placing: Placing,
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
    /// Names of the cards that are kept; none for a mesh alone.
    kept: Option<fn(&str) -> bool>,
    cards: Vec<InpCard>,
    /// Numbers of all cards.
    counts: BTreeMap<String, usize>,
    /// Types of elements, in capitals.
    types: Vec<String>,
    places: Places,
    /// Number of the next line among those of all files.
    next: usize,
}

impl Reader {
    /// Reads a file within those that include it.
    fn read_file(&mut self, file: &Path, bytes: &[u8], within: &mut Vec<PathBuf>) -> Result<(), MeshError> {
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let this = self.places.files.len();
        self.places.files.push(file.to_owned());
        self.places.runs.push(Run { file: this, lines: [1, self.next] });
        for (number, line) in (1..).zip(bytes.split(|byte| *byte == b'\n')) {
            let line = line.trim_ascii();
            let here = self.next;
            self.next += 1;
            if line.is_empty() || line.starts_with(b"**") {
                continue; // comments may be in any encoding
            }
            let located = |problem| MeshError { file: file.to_owned(), place: Place::Line(number), problem };
            let wrong = |error: std::str::Utf8Error| MeshProblem::NotText { byte: line[error.valid_up_to()] };
            let line = std::str::from_utf8(line).map_err(wrong).map_err(located)?;
            let Some(keyword) = line.strip_prefix('*').map(Keyword::new) else {
                if let Block::Counted { name, goes_on } = &mut self.block {
                    if !std::mem::replace(goes_on, line.ends_with(',')) {
                        *self.left_out.entry(name.clone()).or_default() += 1;
                    }
                    continue;
                }
                if let Block::Card(index) = self.block {
                    self.cards[index].lines.push((here, line.to_owned()));
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
                self.places.runs.push(Run { file: this, lines: [number + 1, self.next] });
            } else {
                self.start(&keyword, here).map_err(located)?;
            }
        }
        Ok(())
    }

    /// Starts the block of a keyword.
    fn start(&mut self, keyword: &Keyword, line: usize) -> Result<(), MeshProblem> {
        self.block.finish()?;
        if let (Block::Instance(placing), Some(open)) = (&self.block, &mut self.open) {
            open.placing = *placing;
        }
        if GENERATORS.contains(&keyword.name.as_str()) {
            return Err(VolumeProblem::Generated { found: format!("*{}", keyword.name).into() }.into());
        }
        *self.counts.entry(keyword.name.clone()).or_default() += 1;
        let name = keyword.name.as_str();
        if self.kept.is_none() && (OF_BODIES.contains(&name) || NOT_CARRIED.contains(&name)) {
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
            name => {
                let kept = self.kept.is_some_and(|kept| kept(name));
                if kept { self.card(keyword, line) } else { Block::Skipped }
            }
        };
        Ok(())
    }

    /// Keeps a card with the lines that follow.
    fn card(&mut self, keyword: &Keyword, line: usize) -> Block {
        let scope = match (&self.open, self.part) {
            (Some(_), _) => Scope::Instance(self.instances.len()),
            (None, Some(part)) => Scope::Part(part),
            (None, None) => Scope::Whole,
        };
        self.cards.push(InpCard::new(keyword, line, scope));
        Block::Card(self.cards.len() - 1)
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
        self.instances.push(Instance { name, part, shifts, placing });
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
        let set = keyword.parameter("ELSET").map(|name| Filling::new(self.draft(), name, true, false));
        let beside = BESIDE.iter().any(|known| upper.starts_with(known));
        let kind = match kinds::Kind::of(name) {
            Ok(kind) => Some(kind),
            Err(_) if beside => None,
            // A deck leaves out what is no body; a mesh would lack cells.
            Err(_) if self.kept.is_some() => {
                return Ok(Block::Counted { name: format!("{upper} elements"), goes_on: false });
            }
            Err(problem) => return Err(problem.into()),
        };
        let number = match self.types.iter().position(|known| *known == upper) {
            Some(known) => known,
            None => {
                self.types.push(upper);
                self.types.len() - 1
            }
        };
        let number = u16::try_from(number).map_err(|_| VolumeProblem::Kind { found: name.into() })?;
        Ok(match kind {
            Some(kind) => Block::Cells(Cells::new(kind, number, set)),
            None => Block::Others { kind: number, set },
        })
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
    fn end(mut self) -> Result<Inp, MeshProblem> {
        self.end_instance()?;
        let mut notes = Vec::new();
        if self.kept.is_none() {
            let drafts = self.parts.iter().map(|part| &part.draft).chain([&self.root, &self.whole]);
            for element in drafts.flat_map(|draft| &draft.others.all) {
                let name = format!("{} elements", self.types[usize::from(element.kind)]);
                *self.left_out.entry(name).or_default() += 1;
            }
        }
        if self.kept.is_none() && !self.left_out.is_empty() {
            let counted = self.left_out.iter().map(|(name, count)| format!("{count} {name}"));
            notes.push(format!("left out: {}", counted.collect::<Vec<_>>().join(", ")));
        }
        let outside = |shifts| Placed {
            part: None,
            instance: None,
            prefix: String::new(),
            shifts,
            placing: Placing::default(),
        };
        let mut placed = Vec::new();
        if self.instances.is_empty() {
            placed.push(outside([0; 2]));
            for (number, part) in self.parts.iter().enumerate() {
                let prefix = if self.parts.len() > 1 { format!("{}.", part.name) } else { String::new() };
                let shifts = self.root.append(&part.draft, |node| node, &prefix)?;
                placed.push(Placed { part: Some(number), prefix, ..outside(shifts) });
            }
            self.whole = std::mem::take(&mut self.root);
        } else {
            notes.extend(self.notes_of_instances());
            for (number, Instance { name, part, shifts, placing }) in self.instances.iter().enumerate() {
                let (prefix, instance) = (format!("{name}."), Some(number));
                placed.push(Placed { part: *part, instance, prefix, shifts: *shifts, placing: *placing });
            }
            if let [only] = &self.instances[..] {
                self.whole.sets.without_prefix(&format!("{}.", only.name));
            }
            let shifts =
                if self.root.is_empty() { [0; 2] } else { self.whole.append(&self.root, |node| node, "")? };
            placed.push(outside(shifts));
        }
        let type_of = std::mem::take(&mut self.whole.types);
        let towards = std::mem::take(&mut self.whole.towards);
        let others = std::mem::take(&mut self.whole.others);
        let pyramids = self.whole.pyramids.clone();
        let Self { types, cards, counts, left_out, places, whole, .. } = self;
        let mesh = whole.mesh();
        Ok(Inp {
            mesh,
            types,
            type_of,
            towards,
            pyramids,
            others,
            placed,
            cards,
            counts,
            left_out,
            notes,
            places,
        })
    }

    /// Where parts are left out, moved or numbered on.
    fn notes_of_instances(&self) -> Vec<String> {
        let mut notes = Vec::new();
        let unplaced: Vec<&str> =
            self.parts.iter().filter(|part| !part.placed).map(|part| part.name.as_str()).collect();
        if !unplaced.is_empty() {
            notes.push(format!("parts without an instance are left out: {}", unplaced.join(", ")));
        }
        let moved = self.instances.iter().filter(|instance| !instance.placing.is_still()).count();
        if moved > 0 {
            notes.push(format!("instances are moved to their places ({moved})"));
        }
        let renumbered = self.instances.iter().filter(|instance| instance.shifts != [0; 2]);
        for Instance { name, shifts: [nodes, cells], .. } in renumbered.take(MOST_NAMED) {
            notes.push(format!(
                "nodes of the instance {name} are numbered on from {nodes}, its cells from {cells}"
            ));
        }
        notes
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
