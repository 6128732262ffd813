use nalgebra::{Matrix3, Vector3};

use super::assembly::at;
use super::error::{ElementError, Field, Place, Problem};
use super::matrices::Block;
use super::{Point, coefficient};
use crate::model::Rheology;

/// A linear spring with a linear dashpot beside it, between two ends.
///
/// It acts on the displacement of one end relative to the other, taken in body axes, so a body that turns
/// steadily does not work it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// One end.
    pub from: End,
    /// The other end.
    pub to: End,
    /// Force per displacement and force per rate.
    pub law: Law,
    /// How the spring itself answers periodic strain, beside the dashpot.
    pub rheology: Rheology,
}

/// What an end of a spring is fixed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// The carrier.
    Carrier,
    /// The point with this index in [`Assembly::points`](super::Assembly::points).
    Point(usize),
}

/// Stiffness and damping of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Force `−(stiffness · r + damping · ṙ)` for a relative displacement `r`.
    Spatial {
        /// Stiffness (N/m).
        stiffness: Coefficient,
        /// Damping (N·s/m).
        damping: Coefficient,
    },
    /// Force along the line that joins the ends at equilibrium, and none across it.
    Axial {
        /// Stiffness (N/m).
        stiffness: f64,
        /// Damping (N·s/m).
        damping: f64,
        /// Where the carrier's end sits (m, file's frame); needed when one end is the carrier.
        anchor: Option<[f64; 3]>,
    },
}

/// A symmetric linear map from displacement to force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficient {
    /// The same in every direction.
    Isotropic(f64),
    /// One value per axis of the file's frame.
    Diagonal([f64; 3]),
    /// Full symmetric matrix in the axes of the file's frame.
    Full([[f64; 3]; 3]),
}

impl Spring {
    /// Stiffness and damping over the coordinates of both ends; `starts` holds the first coordinate of each point. (I9)
    pub(super) fn block(
        &self,
        index: usize,
        points: &[Point],
        starts: &[usize],
    ) -> Result<Block, ElementError> {
        let place = Place::Spring(index);
        if self.from == self.to {
            return Err(at(place, Field::To)(Problem::SameEnds));
        }
        let (stiffness, damping) = self.matrices(place, points)?;
        let mut ends = Vec::new();
        for (end, sign, field) in [(self.from, 1.0, Field::From), (self.to, -1.0, Field::To)] {
            let End::Point(number) = end else { continue };
            let point =
                points.get(number).ok_or(Problem::NoSuchPoint { index: number }).map_err(at(place, field))?;
            let directions = point.directions().map_err(at(Place::Point(number), Field::Motion))?;
            let first = starts[number];
            ends.extend(directions.iter().enumerate().map(|(j, (e, _))| (first + j, sign * e)));
        }
        let form = |matrix: Matrix3<f64>| {
            let row = |e: &Vector3<f64>| ends.iter().map(|(_, f)| e.dot(&(matrix * f))).collect();
            ends.iter().map(|(_, e)| row(e)).collect()
        };
        self.rheology.check().map_err(|error| at(place, Field::Rheology)(error.into()))?;
        Ok(Block {
            rheology: self.rheology.clone(),
            stiffness: form(stiffness),
            damping: form(damping),
            columns: ends.iter().map(|(column, _)| *column).collect(),
        })
    }

    fn matrices(&self, place: Place, points: &[Point]) -> Result<(Matrix3<f64>, Matrix3<f64>), ElementError> {
        let (stiffness, damping, direction) = match self.law {
            Law::Spatial { stiffness, damping } => (stiffness, damping, None),
            Law::Axial { stiffness, damping, anchor } => {
                let from = self.place_of(self.from, anchor, points).map_err(at(place, Field::From))?;
                let to = self.place_of(self.to, anchor, points).map_err(at(place, Field::To))?;
                let line = coefficient::unit((to - from).into())
                    .map_err(|_| at(place, Field::To)(Problem::NoLine))?;
                (Coefficient::Isotropic(stiffness), Coefficient::Isotropic(damping), Some(line))
            }
        };
        let stiffness = coefficient::matrix(stiffness).map_err(at(place, Field::Stiffness))?;
        let damping = coefficient::matrix(damping).map_err(at(place, Field::Damping))?;
        let along = direction.map_or(Matrix3::identity(), |n| n * n.transpose());
        Ok((along * stiffness * along, along * damping * along))
    }

    fn place_of(
        &self,
        end: End,
        anchor: Option<[f64; 3]>,
        points: &[Point],
    ) -> Result<Vector3<f64>, Problem> {
        let place = match end {
            End::Carrier => anchor.ok_or(Problem::NoAnchor)?,
            End::Point(index) => points.get(index).ok_or(Problem::NoSuchPoint { index })?.position,
        };
        coefficient::finite(&place)?;
        Ok(place.into())
    }
}
