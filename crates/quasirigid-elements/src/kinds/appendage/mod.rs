//! Appendage known by its cantilever modes alone: mass properties, frequencies, damping and participation factors from a vendor's sheet.
//! There are no shapes: no place on it is known, and no term of second order in its coordinates.
//! Equation (K17), docs/theory/12-structures.md.

mod share;

use nalgebra::{Matrix3, Vector3};

use crate::contribution::{ModalBody, Piece};
use crate::element::{Element, ElementSite};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::{Inertia, Rheology};
use crate::number;
use crate::structure::Block;
use crate::visual::{Outline, cuboid_of};
use crate::{Assembly, Incomplete};

/// Appendage clamped at its interface on the carrier, known by its cantilever modes alone. (K17)
///
/// Vectors and tensors have the sheet's axes, with the origin at the interface.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Appendage {
    /// Unique name.
    pub name: String,
    /// Interface (m), in the file's frame.
    pub interface: [f64; 3],
    /// Direction of the sheet's first axis, and one in the plane of its first two, in the file's frame; of any length but zero.
    pub axes: [[f64; 3]; 2],
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m).
    pub center_of_mass: [f64; 3],
    /// Inertia tensor (kg·m²).
    pub inertia: [[f64; 3]; 3],
    /// Point that the inertia tensor is about.
    pub inertia_about: InertiaPoint,
    /// Point (m) that the rotations of the modes are about.
    pub rotation_about: [f64; 3],
    /// Where the mass lies and how it bends.
    pub extent: Extent,
    /// Cantilever modes.
    pub modes: Vec<AppendageMode>,
}

/// Point that an inertia tensor is about.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InertiaPoint {
    /// Own centre of mass.
    CenterOfMass,
    /// Interface.
    Interface,
}

/// Where the mass of an appendage lies, from which its participation factors give the first-order change of inertia. (K17)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// Not known: the load of a steady spin on the modes is taken as that of their mass at the interface.
    Unknown,
    /// On a line of this direction through the interface, and bends across it.
    Line([f64; 3]),
    /// In a plane of this normal through the interface, and bends along the normal.
    Plane([f64; 3]),
}

/// Cantilever mode with mass-normalised participation factors.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AppendageMode {
    /// Frequency (rad/s) with the interface held.
    pub frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Participation in the translations of the interface (kg^½), `∫ φ dm`.
    pub translation: [f64; 3],
    /// Participation in the rotations (kg^½·m), `∫ s × φ dm`.
    pub rotation: [f64; 3],
}

/// Key of the interface.
const INTERFACE: Field = Field::new("at");
/// Key of the inertia about the interface.
const INTERFACE_INERTIA: Field = Field::new("interface_inertia");
/// Key of the point that rotations are about.
const ROTATION_ABOUT: Field = Field::new("rotation_about");
/// Key of the line of an appendage that lies on one.
const LINE: Field = Field::new("line");
/// Key of the normal of an appendage that lies in a plane.
const NORMAL: Field = Field::new("normal");

impl Appendage {
    /// Lowest frequency of the modes (rad/s).
    #[must_use]
    pub fn lowest_frequency(&self) -> f64 {
        self.modes.iter().fold(f64::INFINITY, |lowest, mode| lowest.min(mode.frequency))
    }

    /// The appendage as a contribution to a body, checked.
    fn modal(&self, id: ElementId) -> Result<ModalBody, ElementError> {
        let R = self.rotation().map_err(at(id, Field::AXES))?;
        number::finite(&self.interface).map_err(at(id, INTERFACE))?;
        let own = self.piece(id)?;
        let factors = self.factors(id)?;
        share::within(&own, &factors).map_err(at(id, Field::MODES))?;
        let extent = self.extent(id)?;
        // coordinates are scaled to the rms displacement of the mass
        let unit = self.mass.sqrt();
        let moment = |[_, h]: &[Vector3<f64>; 2]| unit * R * extent.moment(h) * R.transpose();
        Ok(ModalBody {
            piece: Piece { first: R * own.first, second: R * own.second * R.transpose(), ..own },
            base: self.interface.into(),
            name: self.name.clone(),
            sums: factors.iter().map(|[L, _]| unit * R * L).collect(),
            moments: factors.iter().map(moment).collect(),
        })
    }

    /// Axes of the sheet as columns, in the file's frame.
    fn rotation(&self) -> Result<Matrix3<f64>, Problem> {
        let [first, plane] = self.axes;
        let (first, plane) = (number::unit(first)?, number::unit(plane)?);
        let third = number::unit(first.cross(&plane).into()).map_err(|_| Problem::DependentAxes)?;
        Ok(Matrix3::from_columns(&[first, third.cross(&first), third]))
    }

    /// Mass and moments about the interface, in the sheet's axes.
    fn piece(&self, id: ElementId) -> Result<Piece, ElementError> {
        number::mass(self.mass).map_err(at(id, Field::MASS))?;
        number::finite(&self.center_of_mass).map_err(at(id, Field::CENTER_OF_MASS))?;
        let center = Vector3::from(self.center_of_mass);
        let (arm, field) = match self.inertia_about {
            InertiaPoint::CenterOfMass => (center, Field::INERTIA),
            InertiaPoint::Interface => (Vector3::zeros(), INTERFACE_INERTIA),
        };
        let about = Inertia::new(self.inertia).map_err(|error| at(id, field)(error.into()))?;
        let second = about.second_moments() + self.mass * arm * arm.transpose();
        let own = second - self.mass * center * center.transpose();
        let own = own.trace() * Matrix3::identity() - own;
        Inertia::new(own.into()).map_err(|error| at(id, field)(error.into()))?;
        Ok(Piece { mass: self.mass, first: self.mass * center, second })
    }

    /// Participation factors of each mode in translations and in rotations about the interface, in the sheet's axes.
    fn factors(&self, id: ElementId) -> Result<Vec<[Vector3<f64>; 2]>, ElementError> {
        number::finite(&self.rotation_about).map_err(at(id, ROTATION_ABOUT))?;
        let about = Vector3::from(self.rotation_about);
        if self.modes.is_empty() {
            return Err(at(id, Field::MODES)(Problem::NoSheetModes));
        }
        let factor = |mode: &AppendageMode| {
            number::positive(mode.frequency)?;
            number::non_negative(mode.damping_ratio)?;
            number::finite(&mode.translation)?;
            number::finite(&mode.rotation)?;
            let L = Vector3::from(mode.translation);
            Ok([L, Vector3::from(mode.rotation) + about.cross(&L)])
        };
        self.modes.iter().map(factor).collect::<Result<_, _>>().map_err(at(id, Field::MODES))
    }

    /// Extent with its direction of unit length.
    fn extent(&self, id: ElementId) -> Result<Extent, ElementError> {
        Ok(match self.extent {
            Extent::Unknown => Extent::Unknown,
            Extent::Line(line) => Extent::Line(number::unit(line).map_err(at(id, LINE))?.into()),
            Extent::Plane(normal) => Extent::Plane(number::unit(normal).map_err(at(id, NORMAL))?.into()),
        })
    }
}

impl Extent {
    /// `∫ s φᵀ dm` about the interface, from the participation factors `h` in rotations. Its antisymmetric part is
    /// `h`; the symmetric one is known on a line and in a plane. (K17)
    fn moment(self, h: &Vector3<f64>) -> Matrix3<f64> {
        let antisymmetric = |h: Vector3<f64>| -0.5 * h.cross_matrix();
        match self {
            Self::Unknown => antisymmetric(*h),
            Self::Line(line) => {
                let a = Vector3::from(line);
                a * h.cross(&a).transpose() + antisymmetric(a * a.dot(h))
            }
            Self::Plane(normal) => {
                let n = Vector3::from(normal);
                n.cross(h) * n.transpose() + antisymmetric(n * n.dot(h))
            }
        }
    }
}

impl Element for Appendage {
    fn check(&self, id: ElementId, _: &Assembly) -> Vec<ElementError> {
        self.modal(id).err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        let load = (self.extent == Extent::Unknown).then_some(Incomplete::SheetLoads);
        load.into_iter().chain([Incomplete::Sheets]).collect()
    }

    /// Box with the mass and the inertia of the appendage, which stands still.
    fn outline(&self, id: ElementId, _: &Assembly) -> Option<Outline> {
        let (R, piece) = (self.rotation().ok()?, self.piece(id).ok()?);
        let center = piece.first / piece.mass;
        let second = piece.second - piece.mass * center * center.transpose();
        let place = Vector3::from(self.interface) + R * center;
        Some(Outline::still(cuboid_of(self.mass, place, R * second * R.transpose())?))
    }

    fn modal_body(&self, id: ElementId) -> Result<Option<ModalBody>, ElementError> {
        self.modal(id).map(Some)
    }

    fn block(&self, site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        let diagonal = |entry: &dyn Fn(&AppendageMode) -> f64| {
            let row = |j: usize| (0..self.modes.len()).map(move |k| if j == k { 1.0 } else { 0.0 });
            let scaled = |(j, mode)| row(j).map(|one| one * entry(mode)).collect();
            self.modes.iter().enumerate().map(scaled).collect()
        };
        Ok(Some(Block {
            name: self.name.clone(),
            rheology: Rheology::Elastic,
            columns: (site.start..site.start + self.modes.len()).collect(),
            stiffness: diagonal(&|mode| self.mass * mode.frequency.powi(2)),
            damping: diagonal(&|mode| 2.0 * self.mass * mode.damping_ratio * mode.frequency),
        }))
    }
}
