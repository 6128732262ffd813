//! Sections of beams of a deck along their length: PBAR, PBEAM, PBARL and PBEAML.
//! Moments of a section are turned to principal axes, so that a product of inertia loses nothing.
//! MSC Nastran Quick Reference Guide, PBEAM and PBEAML: what is blank at the second end is that of the first, and between them on the line.

use super::Reader;
use super::sections::library_section;
use crate::deck::{Bending, Station};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, integer, real_or, real_or_zero};

/// Constants of PBEAM at a station: area, moments in plane 1 and 2, their product, torsion and extra mass; none in a blank field.
type Constants = [Option<f64>; 6];

/// Words with which the line of a station begins, and its number of fields.
fn width(word: &str) -> Option<usize> {
    match word.to_ascii_uppercase().as_str() {
        "YES" => Some(16),
        "NO" | "YESA" => Some(8),
        _ => None,
    }
}

/// Share of the length at which a station is; the second end where it is blank.
fn share(card: &Card, number: usize) -> Result<f64, LocatedProblem> {
    let share = real_or(card.field(number), 1.0)?;
    if share > 0.0 && share <= 1.0 {
        return Ok(share);
    }
    let found = card.field(number).text.into();
    Err((card.line, MatrixProblem::Unexpected { found, row: Row::Property }))
}

fn constants(card: &Card, first: usize) -> Result<Constants, LocatedProblem> {
    let mut constants = [None; 6];
    for (index, constant) in constants.iter_mut().enumerate() {
        let field = card.field(first + index);
        if !field.text.is_empty() {
            *constant = Some(real_or_zero(field)?);
        }
    }
    Ok(constants)
}

fn station(at: f64, constants: Constants, other: &Station) -> Station {
    let Station { area, moments, torsion, extra, .. } = other;
    let blank = [*area, moments[0], moments[1], moments[2], *torsion, *extra];
    // a station without anything has no section of its own
    let own =
        constants[..3].iter().chain(&constants[4..5]).any(|constant| constant.is_some_and(|c| c != 0.0));
    let or = |index: usize| {
        let constant =
            if own { constants[index] } else { constants[index].filter(|constant| *constant != 0.0) };
        constant.unwrap_or(blank[index])
    };
    Station { at, area: or(0), moments: [or(1), or(2), or(3)], torsion: or(4), extra: or(5) }
}

impl Reader {
    pub(super) fn bar(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let material = integer(card.field(3), Row::Property)?;
        let [area, first, second, torsion, extra] =
            [4, 5, 6, 7, 8].map(|number| real_or_zero(card.field(number)));
        let [k1, k2, product] = [18, 19, 20].map(|number| real_or_zero(card.field(number)));
        let (k1, k2) = (k1?, k2?);
        let shear = (k1 > 0.0 && k2 > 0.0).then_some([k1, k2]);
        let moments = [first?, second?, product?];
        let stations = vec![Station { at: 0.0, area: area?, moments, torsion: torsion?, extra: extra? }];
        self.model.of_beams.insert(label, Bending { material, stations, shear });
        Ok(())
    }

    pub(super) fn beam_section(&mut self, card: &Card, label: u64) -> Result<(), LocatedProblem> {
        let material = integer(card.field(3), Row::Property)?;
        let start = station(0.0, constants(card, 4)?, &Station::default());
        let mut given = Vec::new();
        // the line of the stresses at the first end may be missing
        let mut number = if width(card.field(10).text).is_some() { 10 } else { 18 };
        while let Some(width) = width(card.field(number).text) {
            given.push((share(card, number + 1)?, constants(card, number + 2)?));
            number += width;
        }
        given.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut stations = vec![start];
        if let Some((at, constants)) = given.pop() {
            let end = station(at, constants, &start);
            let ends = Bending { material, stations: vec![start, end], shear: None };
            stations.extend(given.into_iter().map(|(at, constants)| station(at, constants, &ends.at(at))));
            stations.push(end);
        }
        let [k1, k2] = [number, number + 1].map(|number| real_or(card.field(number), 1.0));
        let (k1, k2) = (k1?, k2?);
        let neutral = (number + 8..number + 16).map(|number| real_or_zero(card.field(number)));
        if neutral.collect::<Result<Vec<_>, _>>()?.iter().any(|offset| *offset != 0.0) {
            self.model
                .simplify("shear centres and centres of extra mass of beams off their axis are taken on it");
        }
        let shear = (k1 > 0.0 && k2 > 0.0).then_some([k1, k2]);
        self.model.of_beams.insert(label, Bending { material, stations, shear });
        Ok(())
    }

    /// A section of the library by its sizes; false for one that is not known.
    pub(super) fn section(&mut self, card: &Card, label: u64, name: &str) -> Result<bool, LocatedProblem> {
        let material = integer(card.field(3), Row::Property)?;
        let kind = card.field(5).text.to_ascii_uppercase();
        let count = match kind.as_str() {
            "ROD" => 1,
            "TUBE" | "TUBE2" | "BAR" => 2,
            "BOX" | "T" | "L" | "CHAN" | "CHAN1" | "CHAN2" | "I1" | "T1" | "T2" | "Z" | "CROSS" | "H"
            | "HAT" => 4,
            "I" | "BOX1" => 6,
            _ => return Ok(false),
        };
        let blank = vec![0.0; count + 1];
        let first = sizes(card, 10, &blank)?;
        let mut given = vec![(0.0, first.clone())];
        // SO, share of the length, sizes and extra mass of each further place
        let mut number = 11 + count;
        while name == "PBEAML" && !card.fields_from(number).iter().all(|field| field.text.is_empty()) {
            given.push((share(card, number + 1)?, sizes(card, number + 2, &first)?));
            number += count + 3;
        }
        given.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut stations = Vec::with_capacity(given.len());
        for (at, sizes) in given {
            let Some((area, moments, torsion)) = library_section(&kind, &sizes[..count]) else {
                return Ok(false);
            };
            stations.push(Station { at, area, moments, torsion, extra: sizes[count] });
        }
        self.model.of_beams.insert(label, Bending { material, stations, shear: None });
        Ok(true)
    }
}

/// Sizes from a field on; blank ones are those of another place.
fn sizes(card: &Card, first: usize, blank: &[f64]) -> Result<Vec<f64>, LocatedProblem> {
    (first..).zip(blank).map(|(number, blank)| real_or(card.field(number), *blank)).collect()
}
