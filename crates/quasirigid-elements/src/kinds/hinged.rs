//! Hinged appendage: a rigid piece on up to three gimbal axes, with its hinge spring.
//! The paths of its points are curved: exactly in the full equations and the modes, to the second order of the angles in the reduced
//! equations.
//! Equations (I8), (I9) and (I12), docs/theory/02-invariants.md.

use nalgebra::{Matrix3, Vector3};

use crate::contribution::MovingBody;
use crate::contribution::{Field as Shape, Piece};
use crate::element::{Element, ElementSite};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::coefficient;
use crate::kinds::prescribed::PrescribedMotion;
use crate::model::{Coordinate, Hinge, Inertia, Rheology};
use crate::number;
use crate::structure::Block;
use crate::visual::{Outline, Vertex, cuboid_of};
use crate::{Assembly, Incomplete};

/// A rigid appendage on a hinge with one, two or three rotational axes: a boom, a whip antenna, a panel.
///
/// The axes turn one inside the other like gimbals: the first is fixed in the carrier, the second is carried by
/// the first, the third by the second. At equilibrium they have the directions given here.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Hinged {
    /// Unique name.
    pub name: String,
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass at equilibrium (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor (kg·m²) about the appendage's own centre of mass, in the file's axes. A thin rod has none
    /// about its own line.
    pub inertia: [[f64; 3]; 3],
    /// Place of the hinge (m), in the file's frame.
    pub hinge: [f64; 3],
    /// Hinge axes, outermost first; any length but zero.
    pub axes: Vec<[f64; 3]>,
    /// Rotational stiffness (N·m/rad), one value per axis or a symmetric matrix in the order of the axes.
    pub stiffness: HingeCoefficient,
    /// Rotational damping (N·m·s/rad), in the same form.
    pub damping: HingeCoefficient,
    /// Rheology of the hinge spring itself: response to periodic strain, beside the damping.
    pub rheology: Rheology,
    /// Angle (rad) of a hinge of one axis that a drive turns or locks, zero at the place given here: then it has neither stiffness nor damping.
    pub angle: Option<PrescribedMotion>,
    /// Places on the appendage at which springs and forces act: names and equilibrium positions (m), in the file's frame.
    pub places: Vec<(String, [f64; 3])>,
}

/// A symmetric linear map from hinge angles to hinge torques.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum HingeCoefficient {
    /// One value per axis.
    PerAxis(Vec<f64>),
    /// Full symmetric matrix, one row per axis.
    Full(Vec<Vec<f64>>),
}

/// Key of the angle.
const ANGLE: Field = Field::new("angle");
/// Sine of the angle between two axes, or triple product of three, above which they are linearly independent.
const INDEPENDENT: f64 = 1e-6;
/// Moment of inertia about an axis, as a share of the appendage's largest, above which the axis moves mass.
const MASSIVE: f64 = 1e-12;

impl Hinged {
    fn moved(&self, place: ElementId) -> Result<MovingBody, ElementError> {
        number::mass(self.mass).map_err(at(place, Field::MASS))?;
        number::finite(&self.center_of_mass).map_err(at(place, Field::CENTER_OF_MASS))?;
        number::finite(&self.hinge).map_err(at(place, Field::HINGE))?;
        let inertia = Inertia::new(self.inertia).map_err(|error| at(place, Field::INERTIA)(error.into()))?;
        let axes = self.unit_axes().map_err(at(place, Field::AXES))?;
        let hinge = Vector3::from(self.hinge);
        let center = Vector3::from(self.center_of_mass) - hinge;
        let piece = Piece::rigid(self.mass, center, &inertia);
        let shapes: Vec<_> = axes.iter().map(|a| Shape::linear(a.cross_matrix())).collect();
        moves_mass(&piece, &shapes).map_err(at(place, Field::AXES))?;
        self.check_drive(place)?;
        let turning = MovingBody {
            piece,
            base: hinge,
            pose: Matrix3::identity(),
            shapes,
            curvature: curvature(&axes),
            coordinates: (1..=axes.len())
                .map(|axis| Coordinate { name: format!("\"{}\" about axis {axis}", self.name), unit: "rad" })
                .collect(),
            axes,
            oriented: true,
            marker: (self.name.clone(), farthest(&piece, center)),
            places: self.placed(hinge).map_err(at(place, Field::PLACES))?,
            law: self.angle.as_ref().and_then(|angle| angle.law().cloned()),
        };
        Ok(match self.locked() {
            Some(angle) => turning.locked(angle),
            None => turning,
        })
    }

    /// Accepts a drive of one axis in place of spring and damper.
    fn check_drive(&self, place: ElementId) -> Result<(), ElementError> {
        let Some(angle) = &self.angle else { return Ok(()) };
        if self.axes.len() != 1 {
            return Err(at(place, ANGLE)(Problem::DrivenAxes { count: self.axes.len() }));
        }
        for (coefficient, field) in [(&self.stiffness, Field::STIFFNESS), (&self.damping, Field::DAMPING)] {
            let matrix = coefficient::hinge_matrix(coefficient, 1).map_err(at(place, field))?;
            if matrix[(0, 0)] != 0.0 {
                return Err(at(place, field)(Problem::DrivenSpring));
            }
        }
        if self.rheology != Rheology::Elastic {
            return Err(at(place, Field::RHEOLOGY)(Problem::DrivenSpring));
        }
        angle.check().map_err(at(place, ANGLE))
    }

    /// Angle (rad) at which the hinge is locked.
    fn locked(&self) -> Option<f64> {
        self.angle.as_ref()?.constant()
    }

    /// Whether the hinge turns at all: not where it is locked at an angle.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.locked().is_none()
    }

    fn placed(&self, hinge: Vector3<f64>) -> Result<Vec<(String, Vector3<f64>)>, Problem> {
        let placed = |(name, place): &(String, [f64; 3])| {
            number::finite(place)?;
            Ok((format!("{:?} {name}", self.name), Vector3::from(*place) - hinge))
        };
        self.places.iter().map(placed).collect()
    }

    /// Stiffness and damping about the axes of the hinge, with coordinates numbered from `start`. (I9)
    fn about_axes(&self, place: ElementId, start: usize) -> Result<Block, ElementError> {
        let count = self.axes.len();
        if !(1..=3).contains(&count) {
            return Err(at(place, Field::AXES)(Problem::AxisCount { count }));
        }
        let stiffness =
            coefficient::hinge_matrix(&self.stiffness, count).map_err(at(place, Field::STIFFNESS))?;
        let damping = coefficient::hinge_matrix(&self.damping, count).map_err(at(place, Field::DAMPING))?;
        let rows = |matrix: nalgebra::DMatrix<f64>| {
            matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
        };
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))?;
        Ok(Block {
            name: self.name.clone(),
            rheology: self.rheology.clone(),
            columns: (start..start + count).collect(),
            stiffness: rows(stiffness),
            damping: rows(damping),
        })
    }

    /// The hinge with its axes, with coordinates numbered from `start`.
    pub(crate) fn hinge(&self, index: usize, start: usize) -> Result<Hinge, ElementError> {
        let axes = self.unit_axes().map_err(at(ElementKind::Hinged.at(index), Field::AXES))?;
        let axes = axes.into_iter().enumerate().map(|(j, axis)| (start + j, axis.into()));
        Ok(Hinge { name: self.name.clone(), axes: axes.collect() })
    }

    fn unit_axes(&self) -> Result<Vec<Vector3<f64>>, Problem> {
        let axes = self.axes.iter().map(|axis| number::unit(*axis)).collect::<Result<Vec<_>, _>>()?;
        let independence = match axes.as_slice() {
            [_] => 1.0,
            [a, b] => a.cross(b).norm(),
            [a, b, c] => a.cross(b).dot(c).abs(),
            _ => return Err(Problem::AxisCount { count: axes.len() }),
        };
        if independence > INDEPENDENT { Ok(axes) } else { Err(Problem::DependentAxes) }
    }
}

impl Element for Hinged {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        let spring = if self.angle.is_some() { None } else { self.about_axes(id, 0).err() };
        self.moved(id).err().into_iter().chain(spring).collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        if self.turns() { vec![Incomplete::Hinges] } else { Vec::new() }
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.rheology]
    }

    /// Box with the mass and the inertia of the appendage, and lines from its hinge to the places on it.
    fn outline(&self, _: ElementId, _: &Assembly) -> Option<Outline> {
        let second = Inertia::new(self.inertia).ok()?.second_moments();
        let mut outline = Outline::own(cuboid_of(self.mass, self.center_of_mass.into(), second)?);
        let hinge = outline.vertices.len();
        let ends = std::iter::once(&self.center_of_mass).chain(self.places.iter().map(|(_, place)| place));
        outline.vertices.push(Vertex::Own(self.hinge));
        outline.vertices.extend(ends.map(|end| Vertex::Own(*end)));
        outline.lines = (hinge + 1..outline.vertices.len()).map(|end| [hinge, end]).collect();
        Some(outline)
    }

    fn moving_body(&self, id: ElementId) -> Result<Option<MovingBody>, ElementError> {
        self.moved(id).map(Some)
    }

    fn block(&self, site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        if self.angle.is_some() { Ok(None) } else { self.about_axes(site.id, site.start).map(Some) }
    }
}

/// Curvature of the paths: `G_jk s = a_j × (a_k × s)` for `j ≤ k`, outer axis first, symmetric. (I8)
fn curvature(axes: &[Vector3<f64>]) -> Vec<Vec<Shape>> {
    let turn = |j: usize, k: usize| -> Matrix3<f64> { axes[j].cross_matrix() * axes[k].cross_matrix() };
    (0..axes.len())
        .map(|j| (0..axes.len()).map(|k| Shape::linear(turn(j.min(k), j.max(k)))).collect())
        .collect()
}

fn moves_mass(piece: &Piece, shapes: &[Shape]) -> Result<(), Problem> {
    let largest = piece.second.trace();
    let still = shapes.iter().position(|H| !(piece.dot(H, H) > MASSIVE * largest));
    still.map_or(Ok(()), |axis| Err(Problem::MasslessAxis { axis: axis + 1 }))
}

/// Watched place: one radius of gyration from the hinge along the line on which most of the mass lies.
fn farthest(piece: &Piece, center: Vector3<f64>) -> Vector3<f64> {
    let eigen = piece.second.symmetric_eigen();
    let longest = eigen.eigenvalues.imax();
    let gyration = (eigen.eigenvalues[longest].max(0.0) / piece.mass).sqrt();
    let line = eigen.eigenvectors.column(longest);
    gyration * line * line.dot(&center).signum()
}
