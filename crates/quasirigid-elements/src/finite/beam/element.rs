//! Timoshenko beam element: geometry, axes of the section and material.
//! Ends nearer than rounding and a direction along the beam are refused here, so that every matrix may divide by the length.
//! Interpolation exact under end loads `[@przemieniecki1968]`, `[@friedman1993]`; matrices in the sibling files.

use nalgebra::{Matrix3, Vector3};

use super::error::{BeamError, Quantity, positive};
use super::section::Section;

/// Straight beam of one section between two nodes, after Timoshenko; Euler–Bernoulli where its shear areas are infinite.
///
/// A section moves as a rigid one: it does not warp, and its shear centre is its centroid. The response to loads at the nodes is exact.
/// With elements of length `h`, frequencies of bending converge with `h⁴`, the contribution of shear with `h²`, as do stretch and twist and
/// all that couples them to bending.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Beam {
    /// Places (m) of the nodes.
    pub(super) ends: [Vector3<f64>; 2],
    /// Unit vectors along the beam, and along `y` and `z` of its section, as rows.
    pub(super) axes: Matrix3<f64>,
    /// Length (m).
    pub(super) length: f64,
    pub(super) section: Section,
    /// Young's modulus (Pa).
    pub(super) young: f64,
    /// Shear modulus (Pa).
    pub(super) shear: f64,
    /// Density (kg/m³), which may be zero.
    pub(super) density: f64,
}

/// Material of a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BeamMaterial {
    /// Young's modulus (Pa).
    pub young: f64,
    /// Shear modulus (Pa).
    pub shear: f64,
    /// Density (kg/m³).
    pub density: f64,
}

/// Sine of the angle between a beam and the direction of its `y` axis below which the direction is refused: the rounding of its digits
/// would show.
const PARALLEL: f64 = 1e-6;

impl Beam {
    /// A beam between two places (m), its section rotated so that `y` is along the projection of a direction across the beam; the beam, `y`
    /// and `z` are right-handed. Without a direction, `y` is towards the axis of the body that is the least parallel to the beam, the first
    /// of them where several are.
    ///
    /// # Errors
    /// [`BeamError`]: ends at one place, a direction along the beam, a modulus or a density that is not positive.
    pub fn new(
        ends: [[f64; 3]; 2],
        direction: Option<[f64; 3]>,
        section: Section,
        BeamMaterial { young, shear, density }: BeamMaterial,
    ) -> Result<Self, BeamError> {
        positive(Quantity::Young, young)?;
        positive(Quantity::ShearModulus, shear)?;
        if density != 0.0 {
            positive(Quantity::Density, density)?;
        }
        let places = ends.map(Vector3::from);
        let along = places[1] - places[0];
        let length = along.norm();
        let size = places[0].amax().max(places[1].amax());
        // Ends nearer than this are one place, written in two ways.
        if !(length > 64.0 * f64::EPSILON * size && length.is_finite()) {
            return Err(BeamError::NoLength { ends });
        }
        let axis = along / length;
        let direction = direction.map_or_else(|| across(&axis), Vector3::from);
        let axes = axes(axis, direction)?;
        Ok(Self { ends: places, axes, length, section, young, shear, density })
    }

    /// Unit vectors along the beam, and along `y` and `z` of its section.
    pub(super) fn directions(&self) -> [Vector3<f64>; 3] {
        [0, 1, 2].map(|row| self.axes.row(row).transpose())
    }
}

/// Axis of the body that is the least parallel to a unit vector.
fn across(axis: &Vector3<f64>) -> Vector3<f64> {
    Vector3::ith(axis.iamin(), 1.0)
}

/// Axes of a beam as rows: along it, and along `y` and `z` of its section.
fn axes(axis: Vector3<f64>, direction: Vector3<f64>) -> Result<Matrix3<f64>, BeamError> {
    let unit = direction / direction.amax();
    let z = axis.cross(&unit.normalize());
    if !(z.norm() > PARALLEL) {
        return Err(BeamError::NoDirection { direction: direction.into(), axis: axis.into() });
    }
    let z = z.normalize();
    Ok(Matrix3::from_rows(&[axis.transpose(), z.cross(&axis).transpose(), z.transpose()]))
}
