use nalgebra::{Matrix3, Vector3};

use super::{Field as Shape, Piece};
use crate::math::sym3::Sym;
use crate::model::moment;
use crate::model::{Coordinate, Pair};

/// A piece on the carrier whose coordinates have no shapes: sums over its mass alone. (K17)
///
/// Each coordinate is scaled to the rms displacement of the mass, so that the mass of every coordinate is that of the piece.
pub(crate) struct ModalBody {
    /// Mass and moments about the base.
    pub piece: Piece,
    /// Place of the base (m), in the file's frame.
    pub base: Vector3<f64>,
    /// Name of the element.
    pub name: String,
    /// `∫ u_j dm`.
    pub sums: Vec<Vector3<f64>>,
    /// `∫ s u_jᵀ dm`, with `s` from the base.
    pub moments: Vec<Matrix3<f64>>,
}

impl ModalBody {
    /// Number of coordinates.
    pub fn size(&self) -> usize {
        self.sums.len()
    }

    /// `∫ [2(ρ·ρ) 1 − 2ρρᵀ] dm` about a pole: twice the inertia.
    pub fn twice_inertia(&self, pole: Vector3<f64>) -> Sym {
        let rho = Shape::position(self.base - pole);
        self.piece.inertia(&rho, &rho)
    }

    /// `S_j`, `h_j` and `J_j` about a pole. (I2), (I3)
    pub fn coordinate(&self, j: usize, pole: Vector3<f64>) -> ([f64; 3], [f64; 3], Sym) {
        let W = self.moments[j] + (self.base - pole) * self.sums[j].transpose();
        (self.sums[j].into(), moment::cross(&W), moment::inertia(&W))
    }

    /// Invariants of pairs: modal masses, and nothing of second order, for coordinates numbered from `start`.
    pub fn pairs(&self, start: usize) -> impl Iterator<Item = (usize, usize, Pair)> + '_ {
        let own = Pair { A: self.piece.mass, ..Pair::default() };
        (start..start + self.size()).map(move |j| (j, j, own))
    }

    /// Coordinates by name.
    pub fn coordinates(&self) -> impl Iterator<Item = Coordinate> + '_ {
        let name = |number: usize| format!("\"{}\" mode {number}", self.name);
        (1..=self.size()).map(move |number| Coordinate { name: name(number), unit: "m" })
    }
}
