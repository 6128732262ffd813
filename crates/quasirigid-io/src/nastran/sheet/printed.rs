//! `MEFFMASS` in a print file: the tables of participation factors and of effective masses, and the rigid body mass matrix. A page repeats
//! the headings of the columns without the title of the table; the first subcase that has the tables counts.

use super::tables::agree;
use super::{Sheet, SheetMode};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::matrix::text::number;

const FACTORS: &str = "MODAL PARTICIPATION FACTORS";
const EFFECTIVE: &str = "MODAL EFFECTIVE MASS";
const RIGID: &str = "A-SET RIGID BODY MASS MATRIX";
const EIGENVALUES: &str = "R E A L   E I G E N V A L U E S";
/// Share by which factors are taken smaller: prints have seven digits, and all modes together carry no more than the mass.
const ROUNDING: f64 = 1e-5;
/// Beginning of the titles of the other tables.
const OTHERS: &str = "MODAL EFFECTIVE";

pub(super) fn has_factors(bytes: &[u8]) -> bool {
    bytes.windows(FACTORS.len()).any(|part| part == FACTORS.as_bytes())
}

/// Table that a line belongs to.
#[derive(Clone, Copy, PartialEq)]
enum Table {
    None,
    Factors,
    Effective,
    Rigid,
    Eigenvalues,
}

/// What a print has of the tables: frequency (Hz) and factors, effective masses, and rows of the rigid body.
#[derive(Default)]
struct Printed {
    factors: Vec<(f64, [f64; 6])>,
    effective: Vec<[f64; 6]>,
    rigid: Vec<[f64; 6]>,
    /// Whether some mode of the file has another modal mass than one.
    scaled: bool,
}

pub(super) fn read(bytes: &[u8]) -> Result<Sheet, LocatedProblem> {
    tables(bytes)?.sheet().map_err(|problem| (0, problem))
}

/// Effective masses, where the print has them.
pub(super) fn effective(bytes: &[u8]) -> Option<Vec<[f64; 6]>> {
    tables(bytes).ok().map(|printed| printed.effective).filter(|rows| !rows.is_empty())
}

fn tables(bytes: &[u8]) -> Result<Printed, LocatedProblem> {
    let text = String::from_utf8_lossy(bytes);
    let (mut printed, mut table) = (Printed::default(), Table::None);
    for (line, content) in (1..).zip(text.lines()) {
        let title = content.trim();
        table = match title {
            FACTORS => Table::Factors,
            EFFECTIVE => Table::Effective,
            RIGID => Table::Rigid,
            _ if title.starts_with(OTHERS) => Table::None,
            _ if title.starts_with(EIGENVALUES) => Table::Eigenvalues,
            _ => table,
        };
        printed.take(table, content, line)?;
    }
    Ok(printed)
}

impl Printed {
    fn take(&mut self, table: Table, content: &str, line: usize) -> Result<(), LocatedProblem> {
        let words: Vec<&str> = content.split_whitespace().collect();
        let value = |word: &str| number(word, Row::Mode).map_err(|problem| (line, problem));
        match (table, words.as_slice()) {
            (Table::Factors | Table::Effective, [mode, frequency, six @ ..]) if six.len() == 6 => {
                let known = if table == Table::Factors { self.factors.len() } else { self.effective.len() };
                if mode.parse() != Ok(known + 1) {
                    return Ok(()); // a heading, or another subcase
                }
                let frequency = value(frequency)?;
                let six = values(six, value)?;
                if table == Table::Factors {
                    self.factors.push((frequency, six));
                } else {
                    self.effective.push(six);
                }
            }
            (Table::Rigid, ["*", six @ .., "*"]) if six.len() == 6 && self.rigid.len() < 6 => {
                self.rigid.push(values(six, value)?);
            }
            (Table::Eigenvalues, [mode, order, _, _, _, mass, _])
                if mode.parse::<usize>().is_ok() && order.parse::<usize>().is_ok() =>
            {
                self.scaled |= value(mass)? != 1.0;
            }
            _ => {}
        }
        Ok(())
    }

    fn sheet(self) -> Result<Sheet, MatrixProblem> {
        let refuse = |what: &'static str| Err(MatrixProblem::Sheet { what });
        let Ok(rigid) = <[[f64; 6]; 6]>::try_from(self.rigid) else { return refuse(NO_RIGID) };
        let scales: Vec<f64> = match (self.effective.as_slice(), self.scaled) {
            ([], false) => vec![1.0; self.factors.len()],
            ([], true) => return refuse(NO_SCALE),
            (effective, _) if effective.len() != self.factors.len() => return refuse(NO_SCALE),
            (effective, _) => self
                .factors
                .iter()
                .zip(effective)
                .map(|((_, factors), effective)| scale(factors, effective))
                .collect(),
        };
        let mode = |((frequency, factors), scale): (&(f64, [f64; 6]), &f64)| SheetMode {
            frequency: std::f64::consts::TAU * frequency,
            factors: factors.map(|factor| scale * factor),
        };
        let mut sheet = Sheet { rigid, modes: self.factors.iter().zip(&scales).map(mode).collect() };
        if !self.effective.is_empty() {
            agree(&sheet, &self.effective)?;
        }
        for mode in &mut sheet.modes {
            mode.factors = mode.factors.map(|factor| (1.0 - ROUNDING) * factor);
        }
        Ok(sheet)
    }
}

/// Root of the modal mass, by the greatest of the effective masses.
fn scale(factors: &[f64; 6], effective: &[f64; 6]) -> f64 {
    let greatest = (0..6).max_by(|a, b| effective[*a].total_cmp(&effective[*b])).unwrap_or(0);
    let scale = (effective[greatest] / factors[greatest].powi(2)).sqrt();
    if scale.is_finite() { scale } else { 1.0 }
}

fn values(
    words: &[&str],
    value: impl Fn(&str) -> Result<f64, LocatedProblem>,
) -> Result<[f64; 6], LocatedProblem> {
    let mut values = [0.0; 6];
    for (entry, word) in values.iter_mut().zip(words) {
        *entry = value(word)?;
    }
    Ok(values)
}

const NO_RIGID: &str =
    "the print has participation factors without the rigid body mass matrix; ask for MEFFMASS(PRINT,ALL)";
const NO_SCALE: &str = "the modes are not of unit modal mass, and their effective masses are not printed; ask for MEFFMASS(PRINT,ALL)";
