use super::error::{ElementError, Field, Place, Problem, at};
use super::material::Material;
use super::ritz::{Ritz, Solid};
use super::whole::Whole;
use crate::math::surface::ClosedSurface;
use crate::model::{Coordinate, FlexibleBody, Marker};

/// A homogeneous solid inside a closed surface, elastic throughout: a body without a carrier, and without a mesh. (G9)
///
/// Its displacement is a polynomial of the place, and every integral over the solid one over the surface. The coordinates
/// are its answers to the loads of a rotation, and theirs.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Unique name.
    pub name: String,
    /// The surface (m), in the file's frame.
    pub surface: ClosedSurface,
    /// What it is made of.
    pub material: Material,
    /// Degree of the polynomials; none to raise it until the compliance has converged.
    pub degree: Option<usize>,
}

/// How well polynomials resolve a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Degree of the polynomials.
    pub degree: usize,
    /// Share of the compliance that the last two degrees brought: an estimate of what is still missing.
    pub missing: f64,
}

/// Degrees tried one after the other, and the highest offered.
const DEGREES: [usize; 5] = [4, 6, 8, 10, 12];
/// Share of the compliance, brought by the last two degrees, at which it has converged.
const CONVERGED: f64 = 1e-3;

impl Surface {
    /// Highest degree offered.
    pub const MOST: usize = 12;

    /// The body.
    ///
    /// # Errors
    /// [`ElementError`] for a value that no solid has, and for polynomials that rounding cannot tell apart.
    pub fn body(&self, index: usize) -> Result<FlexibleBody, ElementError> {
        let (ritz, _) = self.resolved(index)?;
        let center = self.surface.centroid();
        let block = ritz.block(&self.name, &self.material.rheology);
        let coordinate =
            |number| Coordinate { name: format!("\"{}\" shape {}", self.name, number + 1), unit: "m" };
        let whole = Whole {
            place: Place::Surface(index),
            center,
            markers: self.tips(&ritz, center),
            coordinates: (0..block.columns.len()).map(coordinate).collect(),
            invariants: ritz.invariants,
            block,
        };
        whole.body()
    }

    /// How well the polynomials that the body is made of resolve it.
    ///
    /// # Errors
    /// As [`body`](Self::body).
    pub fn resolution(&self, index: usize) -> Result<Resolution, ElementError> {
        Ok(self.resolved(index)?.1)
    }

    /// Everything wrong with its values, the first of it.
    pub(super) fn check(&self, index: usize) -> Result<(), ElementError> {
        let place = Place::Surface(index);
        self.material.check(place)?;
        match self.degree {
            Some(degree) if !(1..=Self::MOST).contains(&degree) => {
                Err(at(place, Field::Degree)(Problem::Degree { degree, most: Self::MOST }))
            }
            _ => Ok(()),
        }
    }

    fn resolved(&self, index: usize) -> Result<(Ritz, Resolution), ElementError> {
        self.check(index)?;
        let found = match self.degree {
            Some(degree) => self.ritz(degree),
            None => self.converged(),
        };
        found.map_err(at(Place::Surface(index), Field::Degree))
    }

    /// The first degree at which the compliance has converged, or the highest that rounding leaves.
    fn converged(&self) -> Result<(Ritz, Resolution), Problem> {
        let mut best = self.ritz(DEGREES[0])?;
        for degree in &DEGREES[1..] {
            if best.1.missing < CONVERGED {
                break;
            }
            match self.ritz(*degree) {
                Ok(better) => best = better,
                Err(_) => break,
            }
        }
        Ok(best)
    }

    fn ritz(&self, degree: usize) -> Result<(Ritz, Resolution), Problem> {
        let [low, high] = self.surface.bounds();
        let scale = [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis]));
        let moments = self.surface.moments(2 * degree, self.surface.centroid(), scale);
        let unit: f64 = scale.iter().product();
        let solid =
            Solid { material: &self.material, scale, moment: &|exponents| unit * moments.of(exponents) };
        let ritz = solid.ritz(degree)?;
        let missing = ritz.shares.iter().rev().take(2).sum();
        Ok((ritz, Resolution { degree, missing }))
    }

    /// The vertices farthest along each axis, both ways.
    fn tips(&self, ritz: &Ritz, center: [f64; 3]) -> Vec<Marker> {
        let farthest = |axis: usize, sign: f64| {
            let along = |vertex: &&[f64; 3]| sign * (vertex[axis] - center[axis]);
            self.surface.vertices().iter().max_by(|a, b| along(a).total_cmp(&along(b)))
        };
        let ends = (0..3).flat_map(|axis| [(axis, 1.0, '+'), (axis, -1.0, '-')]);
        ends.filter_map(|(axis, sign, word)| {
            let vertex = farthest(axis, sign)?;
            let position = [0, 1, 2].map(|i| vertex[i] - center[i]);
            let name = format!("{} along {word}{}", self.name, ['x', 'y', 'z'][axis]);
            Some(Marker { name, position, shapes: ritz.shapes(position), curvature: Vec::new() })
        })
        .collect()
    }
}
