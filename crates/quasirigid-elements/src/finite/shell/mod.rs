//! Thin plates and curved shells of layers: triangles and quadrilaterals with six degrees of freedom at every node.
//!
//! A displacement is three translations (m), then three rotations (rad) per node, all along the axes of the body. At the height `z` over
//! the nodes the material moves by `u + θ × z n`; `n` is the normal about which the nodes run counter-clockwise.
//!
//! Every strain is a fixed function of the displacement that does not depend on the material, so that stiffness and mass are linear in the
//! section: the matrices of the layers of one material add to those of the others.

mod error;
mod lumped_masses;
mod mass;
mod plane;
mod quad;
mod sample;
mod section;
mod triangle;

#[cfg(test)]
mod tests;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

pub use self::error::{Constant, ShellError};
pub(crate) use self::lumped_masses::lumped_masses;
pub(crate) use self::mass::mass;
pub(crate) use self::section::{Ply, ShellSection};

use self::plane::Plane;
use self::quad::Quad;
use self::sample::Sample;
use self::triangle::Triangle;
use quasirigid_mesh::Shape;

/// Stiffness: the forces (N) and moments (N·m) at the nodes per unit of their displacements.
///
/// Symmetric, positive semi-definite, linear in the section; it vanishes for the six motions of a rigid body and for
/// nothing else. The section is in the axes that the projection of `reference` begins.
///
/// A quadrilateral resists a rotation of *one* node about the normal only weakly, as thin as the shell is: distribute such a moment over
/// several nodes. A triangle has no flexibility in transverse shear: thick cores need quadrilaterals.
///
/// # Errors
/// A shape that is no shell, or nodes and a reference between which no element is possible.
pub(crate) fn stiffness(
    shape: Shape,
    nodes: &[Vector3<f64>],
    reference: Vector3<f64>,
    section: &ShellSection,
) -> Result<DMatrix<f64>, ShellError> {
    let plane = Plane::new(shape, nodes, reference)?;
    let sum = |sum: DMatrix<f64>, sample: &Sample| sum + sample.stiffness(section);
    let drilling = match shape {
        Shape::Quad4 => Quad::new(&plane)?.drilling(section),
        _ => DMatrix::zeros(6 * nodes.len(), 6 * nodes.len()),
    };
    let local = samples(shape, &plane)?.iter().fold(drilling, sum);
    let turn = plane.turn();
    Ok(turn.tr_mul(&local) * turn)
}

/// Geometric stiffness of the membrane forces that the displacement `u` of the nodes produces:
///
/// ```text
/// ½ qᵀ K q = ½ ∫ N_αβ  ∂q/∂x_α · ∂q/∂x_β  dA,     N = A ε(u) + B κ(u)
/// ```
///
/// with all three components of the translation `q`, so that a rotation of the whole element rotates its forces too. The dead stress is
/// positive in tension; the buckling load is the `λ` at which `stiffness + λ geometric` is singular.
///
/// # Errors
/// As for [`stiffness`].
pub(crate) fn geometric(
    shape: Shape,
    nodes: &[Vector3<f64>],
    reference: Vector3<f64>,
    section: &ShellSection,
    u: &DVector<f64>,
) -> Result<DMatrix<f64>, ShellError> {
    let plane = Plane::new(shape, nodes, reference)?;
    if u.len() != 6 * nodes.len() {
        return Err(ShellError::Displacement { expected: 6 * nodes.len(), found: u.len() });
    }
    let local = plane.turn() * u;
    let mut stiffness = DMatrix::zeros(u.len(), u.len());
    for sample in samples(shape, &plane)? {
        let tension = sample.tension(section, &local);
        let scalar: DMatrix<f64> = sample.area * sample.slopes.tr_mul(&(tension * &sample.slopes));
        for (i, j) in (0..nodes.len()).flat_map(|i| (0..nodes.len()).map(move |j| (i, j))) {
            let mut block = stiffness.fixed_view_mut::<3, 3>(6 * i, 6 * j);
            block += scalar[(i, j)] * Matrix3::identity();
        }
    }
    Ok(stiffness)
}

fn samples(shape: Shape, plane: &Plane) -> Result<Vec<Sample>, ShellError> {
    match shape {
        Shape::Quad4 => Ok(Quad::new(plane)?.samples()),
        _ => Ok(Triangle::new(plane).samples()),
    }
}
