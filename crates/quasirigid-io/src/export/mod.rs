//! The reduced equations in forms that other programs and people read.

mod comparison;
mod forces;
mod json;
mod latex;
mod source;
mod text;

pub use comparison::Mechanism;
pub use forces::{DisplacedLoads, Forces, StartLoads};
pub use source::{Exported, Fmi, Fmu, FreeBody, SourceFile, Target, identifier, momentum_of};
use std::ops::Range;

use quasirigid_body::{FlexibleBody, ReducedBody};
use quasirigid_math::polynomial::{Homogeneous, Series};

/// Derived body: the content of an export.
#[derive(Clone, Copy, Debug)]
pub struct Derived<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// The flexible body.
    pub body: &'a FlexibleBody,
    /// Reduced equations of the body.
    pub reduced: &'a ReducedBody,
    /// Natural frequencies (rad/s), ascending: all, or the lowest.
    pub frequencies: &'a [f64],
    /// Mechanisms of dissipation, each with the others locked: inside, and elastic; none of a body that has not both.
    pub mechanisms: &'a [Mechanism],
    /// External forces and the inertial force of a driven pole, if anything acts.
    pub forces: Option<&'a Forces>,
}

/// Internal coordinates whose displacements are printed for people, at most.
const MAX_PRINTED: usize = 12;

impl Derived<'_> {
    /// Whether the body has internal rotors or liquids.
    fn turns_inside(&self) -> bool {
        !self.body.cyclic().is_empty()
    }

    /// Whether every internal coordinate is elastic.
    fn elastic_only(&self) -> bool {
        !self.turns_inside() && self.body.wheels().is_empty()
    }

    /// Elastic coordinates, degree by degree from 2 up. (R4)
    fn displacements(&self) -> Vec<Homogeneous> {
        let elastic = 0..self.body.elastic();
        parts(&self.reduced.q, 2).into_iter().map(|part| rows(part, elastic.clone())).collect()
    }

    /// Rates of the internal rotors and liquids, degree by degree from 2 up. (C3)
    fn rates(&self) -> Vec<Homogeneous> {
        parts(&self.reduced.rate, 2).into_iter().map(|part| rows(part, self.body.cyclic())).collect()
    }

    /// Torque `μ` degree by degree, from 4 up for an elastic body, from 3 with rotors and liquids; the degrees below are zero.
    fn mu(&self) -> Vec<Homogeneous> {
        let lowest = if self.turns_inside() { 3 } else { 4 };
        (lowest..=self.reduced.f.degree()).map(|degree| self.reduced.mu(degree)).collect()
    }

    /// Angular momentum `K` degree by degree, from 3 up for an elastic body, from 2 with rotors and liquids.
    fn angular_momentum(&self) -> Vec<&Homogeneous> {
        parts(&self.reduced.K, if self.turns_inside() { 2 } else { 3 })
    }

    /// Power degree by degree, from 6 up for an elastic body, from 4 with rotors and liquids.
    fn power(&self) -> Vec<&Homogeneous> {
        parts(&self.reduced.power, if self.turns_inside() { 4 } else { 6 })
    }
}

/// Some rows of a map.
fn rows(part: &Homogeneous, kept: Range<usize>) -> Homogeneous {
    let mut some = Homogeneous::zero(part.degree(), kept.len());
    kept.enumerate().for_each(|(to, from)| some.add_row(to, 1.0, (part, from)));
    some
}

/// Parts of a series from a degree up.
fn parts(series: &Series, lowest: usize) -> Vec<&Homogeneous> {
    (lowest..=series.degree()).map(|degree| series.part(degree)).collect()
}
