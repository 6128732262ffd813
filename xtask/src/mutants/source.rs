//! Sources with mutants behind a switch: edits of a text, one inside another.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

use super::sample::Mutant;
use super::{read, schema};

/// Part of an edit.
#[derive(Clone, Debug)]
pub enum Piece {
    /// New text.
    Text(String),
    /// Bytes of the source, with the edits inside them.
    Source(Range<usize>),
}

/// What stands in place of a part of the source.
#[derive(Clone, Debug)]
pub struct Edit {
    pub mutant: usize,
    /// Bytes of the source.
    pub range: Range<usize>,
    pub pieces: Vec<Piece>,
}

/// Edits of the files of a crate.
#[derive(Debug, Default)]
pub struct Edits {
    /// Texts of the files, and their edits: an outer one before those inside it.
    files: BTreeMap<String, (String, Vec<Edit>)>,
}

impl Edits {
    /// Mutants behind a switch, as far as their place takes one.
    pub fn of(root: &Path, mutants: &[Mutant]) -> Result<Self, String> {
        let files: BTreeSet<&str> = mutants.iter().map(|mutant| mutant.file.as_str()).collect();
        let edited = files.into_iter().map(|file| {
            let text = read(&root.join(file))?;
            let here: Vec<_> = (0..).zip(mutants).filter(|(_, mutant)| mutant.file == file).collect();
            let edits = schema::edits(&text, &here).map_err(|error| format!("{file}: {error}"))?;
            Ok((file.to_owned(), (text, edits)))
        });
        Ok(Self { files: edited.collect::<Result<_, String>>()? })
    }

    /// Whether a mutant is behind a switch.
    pub fn has(&self, mutant: usize) -> bool {
        self.files.values().any(|(_, edits)| edits.iter().any(|edit| edit.mutant == mutant))
    }

    /// Takes a mutant out.
    pub fn remove(&mut self, mutant: usize) {
        for (_, edits) in self.files.values_mut() {
            edits.retain(|edit| edit.mutant != mutant);
        }
    }

    /// Paths and new texts of the files.
    pub fn rendered(&self) -> impl Iterator<Item = (&str, String)> {
        self.files.iter().map(|(file, (text, edits))| (file.as_str(), render(text, 0..text.len(), edits)))
    }
}

/// A part of the source with the edits in it, of which an outer one stands before those inside it.
pub fn render(text: &str, part: Range<usize>, edits: &[Edit]) -> String {
    let mut written = String::new();
    let mut place = part.start;
    for (index, edit) in edits.iter().enumerate() {
        if edit.range.start < place || edit.range.end > part.end {
            continue;
        }
        written += &text[place..edit.range.start];
        for piece in &edit.pieces {
            match piece {
                Piece::Text(new) => written += new,
                Piece::Source(range) => written += &render(text, range.clone(), &edits[index + 1..]),
            }
        }
        place = edit.range.end;
    }
    written + &text[place..part.end]
}

/// Offset in bytes of a line and a column in characters, both from 1.
pub fn offset(text: &str, [line, column]: [usize; 2]) -> Option<usize> {
    let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let rest = &text[start..];
    let mut ends = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    ends.nth(column - 1).map(|at| start + at)
}

/// A text with a mutant and no switch.
pub fn mutated(text: &str, mutant: &Mutant) -> Result<String, String> {
    let [start, end] = mutant.span.map(|place| offset(text, place));
    let (start, end) = start.zip(end).ok_or_else(|| format!("no such place: {}", mutant.name))?;
    Ok(format!("{}{}{}", &text[..start], mutant.replacement, &text[end..]))
}
