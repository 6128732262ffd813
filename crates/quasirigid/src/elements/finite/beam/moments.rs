use nalgebra::{Matrix3, SMatrix, Vector3};

use super::element::Beam;
use super::mass::Slice;

/// Moments of the displacement fields `u_j` of the twelve coordinates, in the axes of the body, with the sections'
/// own extent.
pub(in crate::elements) struct Moments {
    /// `∫ u_j dm`, a column per coordinate.
    pub sum: SMatrix<f64, 3, 12>,
    /// `∫ r u_jᵀ dm` of the place `r` from the origin of the nodes.
    pub place: [Matrix3<f64>; 12],
    /// `∫ u_j u_kᵀ dm`: their traces are the mass matrix.
    pub pairs: [[Matrix3<f64>; 12]; 12],
}

impl Beam {
    /// Moments of the displacement `U + Θ × p` of the places `p` in the sections.
    pub fn moments(&self) -> Moments {
        let mut moments = Moments {
            sum: SMatrix::zeros(),
            place: [Matrix3::zeros(); 12],
            pairs: [[Matrix3::zeros(); 12]; 12],
        };
        self.slices().iter().for_each(|slice| moments.add(self, slice));
        moments
    }
}

impl Moments {
    /// Adds a slice of a beam.
    fn add(&mut self, beam: &Beam, Slice { t, length, fields }: &Slice) {
        let (area, spread) = (beam.section.area, beam.spread());
        let mass = beam.density * length;
        let centre = (0.5 - t) * beam.ends[0] + (0.5 + t) * beam.ends[1];
        let moved: [Vector3<f64>; 12] = std::array::from_fn(|j| fields.place.column(j).into_owned());
        let turned: [Matrix3<f64>; 12] = std::array::from_fn(|j| fields.turn.column(j).cross_matrix());
        self.sum += mass * area * fields.place;
        for j in 0..12 {
            self.place[j] += mass * (area * centre * moved[j].transpose() + spread * turned[j].transpose());
            for k in 0..12 {
                let off = turned[j] * spread * turned[k].transpose();
                self.pairs[j][k] += mass * (area * moved[j] * moved[k].transpose() + off);
            }
        }
    }
}
