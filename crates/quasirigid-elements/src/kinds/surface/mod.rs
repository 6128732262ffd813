//! A solid inside a closed surface: polynomials where they converge, finite elements where they do not.

mod choice;
mod elements;
mod error;

use nalgebra::Matrix3;

use crate::contribution::BuildOptions;
use crate::contribution::{SingleElementBody, WholeBody};
use crate::element::Element;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::kinds::ritz::{Ritz, Solid};
use crate::material::Material;
use crate::model::{Coordinate, FlexibleBody, Marker, Rheology};
use crate::structure::Condensation;
use crate::visual::thinned;
use crate::{Assembly, Incomplete, PartReduction, Visual};
use quasirigid_mesh::surface::ClosedSurface;

/// A homogeneous solid inside a closed surface, elastic throughout: a body without a carrier, and without a mesh of the user's.
///
/// The displacement is a polynomial of the place (G9), or that of finite elements in a mesh made here where polynomials cannot follow the
/// shape (G11). The coordinates are the responses to the loads of a rotation, and the responses to the inertia of those.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Unique name.
    pub name: String,
    /// The surface (m), in the file's frame.
    pub surface: ClosedSurface,
    /// Material of the solid.
    pub material: Material,
    /// Degree of the polynomials; none to choose it, or to take finite elements.
    pub degree: Option<usize>,
    /// About so many tetrahedra in place of polynomials; none to choose.
    pub cells: Option<usize>,
}

/// Approximation of the displacement of a solid inside a surface, with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Kind of functions.
    pub approximation: Approximation,
    /// Estimate of the relative error of the compliance, and so of the power that the solid dissipates: the maximum over the significant
    /// products of the spin. Infinite where nothing is known. (G12)
    pub error: f64,
}

/// Functions that represent a displacement.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// Polynomials of the place up to a degree.
    Polynomials {
        /// The degree.
        degree: usize,
    },
    /// Quadratic tetrahedra, finest in the narrowest neck.
    Elements {
        /// Number of cells.
        cells: usize,
        /// Number of cells asked for, approximately.
        asked: usize,
    },
}

/// Body with its condensation and the approximation used.
pub(crate) struct SurfaceBody {
    pub body: FlexibleBody,
    pub condensation: Option<Condensation>,
    pub resolution: Resolution,
    pub visuals: Vec<Visual>,
}

impl Surface {
    /// Highest degree offered.
    pub const MAX_DEGREE: usize = 12;
    /// Most tetrahedra offered.
    pub const MAX_CELLS: usize = 200_000;

    /// The element with the approximation that was found for it, which is not judged again.
    #[must_use]
    pub fn settled(&self, resolution: &Resolution) -> Self {
        let (degree, cells) = match resolution.approximation {
            Approximation::Polynomials { degree } => (Some(degree), None),
            Approximation::Elements { asked, .. } => (None, Some(asked)),
        };
        Self { degree, cells, ..self.clone() }
    }

    /// First error among the values of the surface.
    fn check_values(&self, place: ElementId) -> Result<(), ElementError> {
        self.material.check(place)?;
        let bodies = self.surface.bodies();
        if bodies > 1 {
            return Err(at(place, Field::FILE)(Problem::SeveralBodies { bodies }));
        }
        match (self.degree, self.cells) {
            (Some(degree), _) if !(1..=Self::MAX_DEGREE).contains(&degree) => {
                Err(at(place, Field::DEGREE)(Problem::Degree { degree, most: Self::MAX_DEGREE }))
            }
            (Some(_), Some(_)) => Err(at(place, Field::CELLS)(Problem::TwoRoads)),
            (_, Some(cells)) if !(1..=Self::MAX_CELLS).contains(&cells) => {
                Err(at(place, Field::CELLS)(Problem::Cells { cells, most: Self::MAX_CELLS }))
            }
            _ => Ok(()),
        }
    }

    /// Polynomials up to a degree, of places along the principal axes: in a thin body that lies aslant, others are linearly dependent up to
    /// rounding.
    fn ritz(&self, degree: usize) -> Result<Ritz, Problem> {
        let axes = self.axes();
        let own = self
            .surface
            .seen(self.surface.centroid(), [0, 1, 2].map(|axis| axes.column(axis).into_owned().into()));
        let [low, high] = own.bounds();
        let scale = [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis]));
        let moments = own.moments(2 * degree, [0.0; 3], scale);
        let unit: f64 = scale.iter().product();
        let moment = |exponents| unit * moments.of(exponents);
        Solid { material: &self.material, axes, scale, moment: &moment }.ritz(degree)
    }

    /// Principal axes of inertia, as columns, right-handed.
    fn axes(&self) -> Matrix3<f64> {
        let [low, high] = self.surface.bounds();
        let size = [0, 1, 2].map(|axis| high[axis] - low[axis]).into_iter().fold(0.0, f64::max);
        let moments = self.surface.moments(2, self.surface.centroid(), [size; 3]);
        let second = Matrix3::from_fn(|a, b| {
            let mut exponents = [0; 3];
            exponents[a] += 1;
            exponents[b] += 1;
            moments.of(exponents)
        });
        let axes = second.symmetric_eigen().eigenvectors;
        // A mirror would turn the surface inside out.
        axes * Matrix3::from_diagonal(&[1.0, 1.0, axes.determinant().signum()].into())
    }

    /// The body of polynomials.
    fn of_polynomials(&self, place: ElementId, ritz: Ritz) -> Result<FlexibleBody, ElementError> {
        let center = self.surface.centroid();
        let block = ritz.block(&self.name, &self.material.rheology);
        let whole = SingleElementBody {
            place,
            center,
            markers: self.tips(&ritz, center),
            coordinates: self.coordinates(block.columns.len()),
            invariants: ritz.invariants,
            block,
        };
        whole.body()
    }

    fn coordinates(&self, count: usize) -> Vec<Coordinate> {
        let coordinate =
            |number| Coordinate { name: format!("\"{}\" shape {}", self.name, number + 1), unit: "m" };
        (0..count).map(coordinate).collect()
    }

    /// The surface, moved by polynomials.
    fn visual(&self, id: ElementId, ritz: &Ritz) -> Visual {
        let center = self.surface.centroid();
        let (kept, triangles) = thinned(self.surface.vertices(), self.surface.triangles());
        let place =
            |vertex: &usize| [0, 1, 2].map(|axis| self.surface.vertices()[*vertex][axis] - center[axis]);
        let vertices = kept.iter().map(place).collect();
        Visual::surface((id, &self.name), (vertices, triangles), |place| ritz.shapes(place))
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
            Some(Marker {
                name,
                position,
                shapes: ritz.shapes(position),
                rotations: Vec::new(),
                curvature: Vec::new(),
                carried: None,
            })
        })
        .collect()
    }
}

impl Element for Surface {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        self.check_values(id).err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        vec![Incomplete::Surfaces]
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.material.rheology]
    }

    fn homogeneous(&self) -> Option<&Material> {
        Some(&self.material)
    }

    fn whole(
        &self,
        id: ElementId,
        reduction: PartReduction,
        asked: BuildOptions,
    ) -> Result<Option<WholeBody>, ElementError> {
        let SurfaceBody { body, condensation, resolution, visuals } = self.built(id, reduction, asked)?;
        Ok(Some(WholeBody { body, condensation, resolution: Some(resolution), visuals }))
    }
}
