//! Multi-point constraints of a deck: MPC and MPCADD, of the set that the case control chooses.
//! MSC Nastran Quick Reference Guide, MPC and MPCADD.

use std::collections::BTreeMap;

use quasirigid_math::vec3::scale;

use super::Reader;
use crate::deck::{BASIC, Equations, Term};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;
use crate::nastran::bulk::{Card, integer, integer_or, real_or_zero};

/// Fields of a term, and of both terms of a line with the blank one before and behind them.
const TERM: usize = 3;
const LINE: usize = 8;

/// A constraint as its card has it: point, component from 0 and factor of each term.
struct Written {
    terms: Vec<(u64, u64, f64)>,
    line: usize,
}

/// Constraints by their sets, and sets of sets.
#[derive(Default)]
pub(super) struct Constraints {
    sets: BTreeMap<u64, Vec<Written>>,
    sums: BTreeMap<u64, Vec<u64>>,
}

impl Constraints {
    /// The only set, or set of sets; none where there are several.
    fn only(&self) -> Option<u64> {
        let one = |mut labels: Vec<u64>| if labels.len() == 1 { labels.pop() } else { None };
        one(self.sums.keys().copied().collect()).or_else(|| one(self.sets.keys().copied().collect()))
    }
}

impl Reader {
    /// Takes the card of a constraint; false for another card.
    pub(super) fn constraint(&mut self, card: &Card, name: &str) -> Result<bool, LocatedProblem> {
        let set = || integer(card.field(2), Row::Element);
        match name {
            "MPC" => {
                let mut terms = Vec::new();
                for line in 0..card.fields_from(2).len().div_ceil(LINE) {
                    for first in [3, 3 + TERM].map(|first| line * LINE + first) {
                        if card.field(first).text.is_empty() {
                            continue;
                        }
                        let node = integer(card.field(first), Row::Element)?;
                        let component = integer_or(card.field(first + 1), 0, Row::Element)?;
                        terms.push((node, component, real_or_zero(card.field(first + 2))?));
                    }
                }
                let written = Written { terms, line: card.line };
                self.constraints.sets.entry(set()?).or_default().push(written);
            }
            "MPCADD" => {
                let sets = card.fields_from(3).iter().filter(|field| !field.text.is_empty());
                let sets = sets.map(|field| integer(*field, Row::Element)).collect::<Result<_, _>>()?;
                self.constraints.sums.insert(set()?, sets);
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Makes equations of the constraints of the chosen set; `chosen` are those of the subcases, or none where there is no case control.
    pub(super) fn resolve_constraints(&mut self, chosen: Option<&[u64]>) -> Result<(), LocatedProblem> {
        let constraints = std::mem::take(&mut self.constraints);
        let set = match chosen {
            Some(sets) => {
                if sets.iter().any(|set| *set != sets[0]) {
                    self.model.simplify("subcases with other MPC are taken with those of the first");
                }
                sets.first().copied()
            }
            None => constraints.only(),
        };
        let own = |set| constraints.sums.get(&set).cloned().unwrap_or_else(|| vec![set]);
        let taken: Vec<u64> = set.map(own).unwrap_or_default();
        for (set, all) in &constraints.sets {
            if !taken.contains(set) {
                self.model.leave_out_all("MPC of sets that no case control chooses", all.len());
                continue;
            }
            for written in all {
                self.equation(written)?;
            }
        }
        Ok(())
    }

    fn equation(&mut self, Written { terms, line }: &Written) -> Result<(), LocatedProblem> {
        let mut sum = Vec::new();
        for (node, component, factor) in terms {
            let Some(component) = component.checked_sub(1) else {
                self.model.leave_out("MPC of scalar points");
                return Ok(());
            };
            if component > 5 {
                let found = (component + 1).to_string().into();
                return Err((*line, MatrixProblem::Component { found }));
            }
            let axes = self.model.point(*node, *line)?.axes.unwrap_or(BASIC);
            let along = scale(*factor, axes[component as usize % 3]);
            sum.push(Term { node: *node, rotates: component > 2, along });
        }
        self.model.equations.push(Equations { follower: None, sums: vec![sum], line: *line });
        Ok(())
    }
}
