//! Bulk data of the geometry in an OUTPUT2 file: each entry of a table becomes the card that it was, so that one reader takes decks and files.
//! Numbers of 32 bits become the shortest decimals that are read back as them, which are those of the deck up to seven digits.

use std::fmt::Write;

use super::layouts::ANALYSIS;
use super::tape::{Block, Tape};
use super::words::Words;
use super::{directions, entries, lists};
use crate::matrix::error::MatrixProblem;
use crate::matrix::listed::LocatedProblem;

/// Cards in free fields, and for each line the byte of the file from which it comes.
#[derive(Default)]
pub(crate) struct Bulk {
    pub text: String,
    pub places: Vec<usize>,
}

/// A field of a card.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Field<'a> {
    Blank,
    Integer(i64),
    Single(f32),
    Double(f64),
    Word(&'a str),
}

/// Blocks of parameters.
pub(super) const PARAMETERS: [&str; 3] = ["PVT0", "PVT", "PVTS"];
/// Case control.
const CASES: [&str; 2] = ["CASECC", "CASEXX"];
/// The blocks of each kind, of which the first that a file has is read: as they are, of the residual structure, and of NX.
const BLOCKS: [&[&str]; 7] = [
    &PARAMETERS,
    &["GEOM1", "GEOM1S", "GEOM1N", "GEOM1X"],
    &["GEOM2", "GEOM2S", "GEOM2N", "GEOM2X"],
    &["EPT", "EPTS", "EPTX"],
    &["MPT", "MPTS", "MPTX"],
    &["GEOM4", "GEOM4S", "GEOM4N", "GEOM4X"],
    &["GEOM"],
];

/// The geometry in the bytes of a file, as bulk data.
///
/// # Errors
/// A file that is damaged, or that has no geometry.
pub(crate) fn bulk(bytes: &[u8]) -> Result<Bulk, LocatedProblem> {
    let tape = Tape::read(bytes)?;
    let (mut bulk, mut found) = (Bulk::default(), false);
    bulk.case_control(&tape);
    for names in BLOCKS {
        if let Some(block) = tape.block(names) {
            bulk.block(&tape, block);
            bulk.others(&tape, block);
            found |= names[0].starts_with("GEOM");
        }
    }
    if !found {
        let names = tape.blocks.iter().map(|block| block.names[0].clone()).collect();
        return Err((0, MatrixProblem::NoGeometry { names }));
    }
    Ok(bulk)
}

impl Bulk {
    fn block(&mut self, tape: &Tape, block: &Block) {
        let mut records: Vec<Words> = block.records.iter().map(|record| tape.words(record)).collect();
        // what a card of layers or of the library became stands beside it under one number: the last one counts
        records.sort_by_key(|words| words.integer(0).map_or(1, lists::rank));
        for words in &records {
            if block.names[0].starts_with("PVT") {
                lists::parameters(self, words);
            } else {
                self.record(words);
            }
        }
    }

    /// The sets of constraints that the subcases choose: the second word of each record. pyNastran, `op2/tables/geom/subcase.py`.
    fn case_control(&mut self, tape: &Tape) {
        let Some(block) = tape.block(&CASES) else { return };
        for words in block.records.iter().skip(1).map(|record| tape.words(record)) {
            if let Some(set) = words.integer(1) {
                self.text.push_str(&format!("MPC = {set}"));
                self.end(words.at);
            }
        }
        self.text.push_str("BEGIN BULK");
        self.end(block.at);
    }

    /// Counts the blocks of the name of one that have something else: superelements, or the model of another step.
    fn others(&mut self, tape: &Tape, block: &Block) {
        let same = |other: &&Block| other.names[0] == block.names[0] && other.at != block.at;
        for other in tape.blocks.iter().filter(same) {
            let alike = other.records.len() == block.records.len()
                && other.records.iter().zip(&block.records).all(|(a, b)| tape.words(a).same(&tape.words(b)));
            if !alike {
                self.card(&other.names[0], other.at, &[]);
            }
        }
    }

    /// A record: three words that tell the kind, then its entries.
    fn record(&mut self, words: &Words) {
        let (Some(a), Some(b), Some(c)) = (words.integer(0), words.integer(1), words.integer(2)) else {
            return;
        };
        // newer releases put their length before the last digits
        let kind = [a, b, c % 10_000];
        let known = directions::take(self, kind, words)
            || lists::take(self, kind, words)
            || entries::take(self, kind, words);
        if !known && a > 0 && a < 65_535 && words.len() > 3 && !ANALYSIS.contains(&a) {
            self.card(&format!("REC{a}"), words.at, &[]);
        }
    }

    /// Adds a card.
    pub(super) fn card(&mut self, name: &str, at: usize, fields: &[Field<'_>]) {
        self.text.push_str(name);
        for (index, field) in fields.iter().enumerate() {
            if index > 0 && index % 8 == 0 {
                self.end(at);
            }
            self.text.push(',');
            self.field(*field);
        }
        self.end(at);
    }

    fn end(&mut self, at: usize) {
        self.text.push('\n');
        self.places.push(at);
    }

    fn field(&mut self, field: Field<'_>) {
        let start = self.text.len();
        let written = match field {
            Field::Blank => Ok(()),
            Field::Integer(value) => write!(self.text, "{value}"),
            Field::Single(value) => write!(self.text, "{value:?}"),
            Field::Double(value) => write!(self.text, "{value:?}"),
            Field::Word(word) => {
                self.text.extend(word.chars().filter(char::is_ascii_alphanumeric));
                Ok(())
            }
        };
        debug_assert!(written.is_ok(), "a string takes all that is written");
        // a real number without a point would be an integer or a continuation
        let real = matches!(field, Field::Single(_) | Field::Double(_));
        if let (true, Some(exponent)) =
            (real && !self.text[start..].contains('.'), self.text[start..].find('e'))
        {
            self.text.insert(start + exponent, '.');
        }
    }
}
