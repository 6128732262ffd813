//! The reduced equations in forms that other programs and people read.

mod json;
mod latex;
mod text;

use quasirigid::math::polynomial::{Homogeneous, Series};
use quasirigid::model::{FlexibleBody, ReducedBody};

/// A derived body: what an export says.
#[derive(Clone, Copy, Debug)]
pub struct Derived<'a> {
    /// Name of the body.
    pub name: &'a str,
    /// The flexible body.
    pub body: &'a FlexibleBody,
    /// Its reduced equations.
    pub reduced: &'a ReducedBody,
    /// Natural frequencies (rad/s), ascending: all, or the lowest.
    pub frequencies: &'a [f64],
}

impl Derived<'_> {
    /// Torque `μ` degree by degree, from 4 up; the degrees below are zero for an elastic body.
    fn mu(&self) -> Vec<Homogeneous> {
        (4..=self.reduced.f.degree()).map(|degree| self.reduced.mu(degree)).collect()
    }

    /// Momentum `K` degree by degree, from 3 up.
    fn momentum(&self) -> Vec<&Homogeneous> {
        parts(&self.reduced.K, 3)
    }
}

/// Parts of a series from a degree up.
fn parts(series: &Series, lowest: usize) -> Vec<&Homogeneous> {
    (lowest..=series.degree()).map(|degree| series.part(degree)).collect()
}
