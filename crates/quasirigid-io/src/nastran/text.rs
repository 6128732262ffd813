//! Text of a deck: its lines and those of the files that it includes, numbered on, so that a problem is told by file and line.
//! Included files lie in the deck's own folder or below it, and not too deep within each other: a deck from elsewhere reads nothing else.

use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

use super::bulk::bulk_lines;
use super::op2::{self, Bulk};
use crate::deck::{Places, Run};
use crate::matrix::error::{MatrixError, MatrixProblem};
use crate::matrix::listed::LocatedProblem;
use crate::text_file::{FileError, Place, bytes_of};

/// Deepest that files may include each other.
const DEEPEST: usize = 20;
/// Bytes of all files together.
const MOST: u64 = 4 * 1024 * 1024 * 1024;

/// A deck with the files that it includes.
#[derive(Default)]
pub(crate) struct Text {
    /// Text of each file.
    texts: Vec<String>,
    /// Bytes of each run of lines in its file.
    bytes: Vec<[usize; 2]>,
    places: Places,
}

impl Text {
    /// Reads a deck from its bytes, and the files that it includes.
    ///
    /// # Errors
    /// [`MatrixError`] for a file that cannot be read, lies elsewhere or is included too deep.
    pub fn read(file: &Path, bytes: &[u8]) -> Result<Self, MatrixError> {
        if op2::Layout::of(bytes).is_some() {
            return Self::of_geometry(file, bytes);
        }
        let folder = file.parent().unwrap_or(Path::new("")).to_owned();
        let mut reader = Reader { folder, deck: Self::default(), next: 1, size: bytes.len() as u64 };
        reader.include(file.to_owned(), text_of(bytes), 0)?;
        Ok(reader.deck)
    }

    /// The geometry of an OUTPUT2 file as a deck.
    fn of_geometry(file: &Path, bytes: &[u8]) -> Result<Self, MatrixError> {
        let located = |(byte, problem)| FileError::new(file)((Place::Byte(byte), problem));
        let Bulk { text, places } = op2::bulk(bytes).map_err(located)?;
        let run = Run { file: 0, lines: [1, 1] };
        let places = Places { files: vec![file.to_owned()], runs: vec![run], bytes: places };
        Ok(Self { bytes: vec![[0, text.len()]], texts: vec![text], places })
    }

    /// Lines of the bulk data with their numbers among all, without comments.
    pub fn bulk(&self) -> impl Iterator<Item = (usize, &str)> {
        let first = self.lines().find(|(_, line)| is_begin(line)).map_or(0, |(number, _)| number);
        bulk_lines(self.lines().filter(move |(number, _)| *number > first))
            .take_while(|(_, line)| !begins_superelement(line))
    }

    /// Sets of this kind that the case control chooses, of each subcase in turn; none where there is no case control.
    pub fn chosen(&self, kind: &str) -> Option<Vec<u64>> {
        let (begin, _) = self.lines().find(|(_, line)| is_begin(line))?;
        let set = |line: &str| {
            let line = line.split('$').next().unwrap_or_default();
            let (name, set) = line.split_once('=')?;
            let set = set.trim().parse().ok().filter(|set| *set > 0)?;
            name.trim().eq_ignore_ascii_case(kind).then_some(set)
        };
        Some(
            self.lines()
                .take_while(|(number, _)| *number < begin)
                .filter_map(|(_, line)| set(line))
                .collect(),
        )
    }

    /// Whether superelements follow the bulk data.
    pub fn superelements(&self) -> usize {
        self.lines().filter(|(_, line)| begins_superelement(line)).count()
    }

    fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.places.runs.iter().zip(&self.bytes).flat_map(|(run, [from, to])| {
            let text = self.texts[run.file].get(*from..*to).unwrap_or_default();
            (run.lines[1]..).zip(text.lines())
        })
    }

    /// Its files and lines.
    pub fn places(self) -> Places {
        self.places
    }

    /// The error of a problem on a line, or of the whole deck for line 0.
    pub fn located(&self, fault: LocatedProblem) -> MatrixError {
        self.places.located(fault)
    }
}

struct Reader {
    folder: PathBuf,
    deck: Text,
    /// Number of the next line among all.
    next: usize,
    size: u64,
}

impl Reader {
    fn include(&mut self, file: PathBuf, text: String, depth: usize) -> Result<(), MatrixError> {
        let source = self.deck.texts.len();
        self.deck.places.files.push(file.clone());
        self.deck.texts.push(String::new());
        let (mut from, mut first, mut at, mut number) = (0, 1, 0, 0);
        let mut lines = text.split_inclusive('\n');
        while let Some(line) = lines.next() {
            let before = at;
            (at, number) = (at + line.len(), number + 1);
            let Some(mut name) = included(line).map(str::to_owned) else { continue };
            self.run(source, [from, before], [first, number]);
            // A name in quotes may go on over several lines.
            while name.starts_with('\'') && !name[1..].contains('\'') {
                let Some(more) = lines.next() else { break };
                (at, number) = (at + more.len(), number + 1);
                name.push_str(more.trim());
            }
            (from, first) = (at, number + 1);
            let name = name.trim_matches(['\'', '"']).to_owned();
            let located = FileError::new(&file);
            let refuse = |problem| located((Place::Line(number), problem));
            let path = Path::new(&name);
            let below =
                path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
            if !below {
                return Err(refuse(MatrixProblem::IncludeElsewhere { file: name.as_str().into() }));
            }
            if depth >= DEEPEST {
                return Err(refuse(MatrixProblem::IncludeDeep {
                    file: name.as_str().into(),
                    limit: DEEPEST,
                }));
            }
            let path = self.folder.join(path);
            let bytes = bytes_of::<MatrixProblem>(&path, MOST)?;
            self.size += bytes.len() as u64;
            if self.size > MOST {
                return Err(refuse(MatrixProblem::TooLarge { limit: MOST }));
            }
            self.include(path, text_of(&bytes), depth + 1)?;
        }
        self.run(source, [from, at], [first, number + 1]);
        self.deck.texts[source] = text;
        Ok(())
    }

    /// Notes lines of a file from one number on, up to another that is none of them.
    fn run(&mut self, source: usize, bytes: [usize; 2], [first, end]: [usize; 2]) {
        self.deck.bytes.push(bytes);
        self.deck.places.runs.push(Run { file: source, lines: [first, self.next] });
        self.next += end.saturating_sub(first);
    }
}

/// The bytes of a deck as text: comments are in any encoding, and each byte that is no UTF-8 is a letter of Latin-1.
fn text_of(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    };
    text.strip_prefix('\u{feff}').unwrap_or(&text).to_owned()
}

/// The file that a line includes, with its quotes.
fn included(line: &str) -> Option<&str> {
    let line = line.trim();
    let rest = line.get(..7).filter(|word| word.eq_ignore_ascii_case("INCLUDE")).map(|_| line[7..].trim());
    rest.filter(|rest| !rest.is_empty() && !rest.starts_with(['=', ',']))
}

/// Whether the bulk data begin after a line.
fn is_begin(line: &str) -> bool {
    let mut words = line.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let mut is = |word: &str| words.next().is_some_and(|found| found.eq_ignore_ascii_case(word));
    is("BEGIN") && is("BULK")
}

fn begins_superelement(line: &str) -> bool {
    let upper = line.trim().to_ascii_uppercase();
    upper.starts_with("BEGIN") && (upper.contains("SUPER") || upper.contains("AUXMODEL"))
}
