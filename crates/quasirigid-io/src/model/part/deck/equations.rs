//! Equations between grid points: each gives one component by others. One that a motion of the whole body would break holds the body to the
//! ground, and is left out as supports are.
//! Equation (K20), docs/theory/12-structures.md.

use std::collections::{BTreeMap, HashMap};

use quasirigid_elements::{Coupling, Mixed, Term as Share};
use quasirigid_math::vec3::{add, cross, minus, norm, scale};

use super::elimination::{Elimination, Form};
use super::links::AFLOAT;
use super::{Made, box_around};
use crate::deck::Term;
use crate::matrix::listed::LocatedProblem;

/// What equations are made with.
struct Bases {
    /// Node that carries each node of a rigid piece, and whether also its rotations.
    of: HashMap<usize, (usize, bool)>,
    /// Nodes that have rotations.
    turned: Vec<bool>,
    /// Size of the deck (m): the length by which rotations are compared with displacements.
    size: f64,
}

/// Displacement or rotation of a node along a vector (m).
type Along = (usize, bool, [f64; 3]);

impl Made {
    pub(super) fn equations(&mut self) -> Result<(), LocatedProblem> {
        if self.deck.equations.is_empty() {
            return Ok(());
        }
        let pieces = self.mixed.couplings.iter().filter_map(|coupling| match coupling {
            Coupling::Rigid { node, base, free } => Some((*node, (*base, free.is_empty()))),
            _ => None,
        });
        let size = norm(box_around(&self.nodes));
        let of = pieces.collect();
        let mut turned = Mixed { mesh: self.mesh(), ..self.mixed.clone() }.turned();
        // A point that is made to follow has its rotations where its equations give them.
        for term in self.deck.equations.iter().filter(|group| group.follower.is_some()) {
            for term in term.sums.iter().filter_map(|sum| sum.first()).filter(|term| term.rotates) {
                let at = self.of(term.node, 0)?;
                turned[at] = true;
            }
        }
        let bases = Bases { of, turned, size: if size > 0.0 { size } else { 1.0 } };
        let mut all = Elimination::default();
        for index in 0..self.deck.equations.len() {
            self.take(index, &bases, &mut all)?;
        }
        let mut nodes: BTreeMap<usize, Vec<(usize, Vec<Share>)>> = BTreeMap::new();
        let unit = |component: usize| if component < 3 { 1.0 } else { bases.size };
        for ((node, component), form) in all.given {
            let share = |((node, of), factor): (_, f64)| Share {
                node,
                component: of,
                share: factor * unit(of) / unit(component),
            };
            nodes.entry(node).or_default().push((component, form.into_iter().map(share).collect()));
        }
        for (node, rows) in nodes {
            self.following.insert(node);
            self.mixed.couplings.push(Coupling::Linear { node, rows });
        }
        Ok(())
    }

    /// Takes the equations of a card.
    fn take(&mut self, index: usize, bases: &Bases, all: &mut Elimination) -> Result<(), LocatedProblem> {
        let line = self.deck.equations[index].line;
        if let Some(label) = self.deck.equations[index].follower {
            let node = self.of(label, line)?;
            if self.following.contains(&node)
                || (0..6).any(|component| all.given.contains_key(&(node, component)))
            {
                self.deck.leave_out("ties of a point that follows others already");
                return Ok(());
            }
        }
        for sum in 0..self.deck.equations[index].sums.len() {
            let terms = self.deck.equations[index].sums[sum].clone();
            let terms: Vec<Along> =
                terms.iter().map(|term| self.along(term, line)).collect::<Result<_, _>>()?;
            let Some((first, ..)) = terms.first().copied() else { continue };
            if self.breaks(&terms) {
                self.deck
                    .leave_out("equations that a motion of the whole body breaks, which act as supports");
                continue;
            }
            let Some(form) = bases.form(&self.nodes, &terms) else {
                self.deck.leave_out("equations with rotations of points that have none");
                continue;
            };
            let following = &self.following;
            let may = |(node, component): (usize, usize)| {
                !following.contains(&node) && (component < 3 || bases.turned[node])
            };
            if !all.take(&form, first, may) {
                self.deck.leave_out("equations of points that all follow others already");
            }
        }
        Ok(())
    }

    /// A term along the axes of the file (m).
    fn along(&self, term: &Term, line: usize) -> Result<Along, LocatedProblem> {
        let unit = if term.rotates { self.given.units.length } else { 1.0 };
        let along = scale(unit, self.given.placement.turned(term.along));
        Ok((self.of(term.node, line)?, term.rotates, along))
    }

    /// Whether a motion of the whole body changes a sum: its factors are a force and a moment.
    fn breaks(&self, terms: &[Along]) -> bool {
        let origin = self.nodes[terms[0].0];
        let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
        let mut most: [f64; 2] = [0.0; 2];
        for (node, rotates, along) in terms {
            most[usize::from(*rotates)] = most[usize::from(*rotates)].max(norm(*along));
            if *rotates {
                moment = add(moment, *along);
            } else {
                force = add(force, *along);
                moment = add(moment, cross(minus(self.nodes[*node], origin), *along));
            }
        }
        let size = norm(box_around(&self.nodes));
        !(norm(force) <= AFLOAT * most[0] && norm(moment) <= AFLOAT * (size * most[0] + most[1]))
    }
}

impl Bases {
    /// The sum by components, those of rigid pieces by the components of what carries them; none with a rotation that nothing has.
    fn form(&self, places: &[[f64; 3]], terms: &[Along]) -> Option<Form> {
        let mut form = Form::new();
        for (node, rotates, along) in terms {
            let (mut node, mut rotates_along) = (*node, if *rotates { *along } else { [0.0; 3] });
            let moves_along = if *rotates { [0.0; 3] } else { *along };
            let start = node;
            while let Some((base, whole)) = self.of.get(&node).copied() {
                if base == start || (!whole && rotates_along != [0.0; 3]) {
                    break;
                }
                let arm = minus(places[node], places[base]);
                rotates_along = add(rotates_along, cross(arm, moves_along));
                node = base;
            }
            for axis in 0..3 {
                if moves_along[axis] != 0.0 {
                    *form.entry((node, axis)).or_default() += moves_along[axis];
                }
                if rotates_along[axis] != 0.0 {
                    if !self.turned[node] {
                        return None;
                    }
                    *form.entry((node, 3 + axis)).or_default() += rotates_along[axis] / self.size;
                }
            }
        }
        Some(form)
    }
}
