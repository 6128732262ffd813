use std::ops::Range;

use nalgebra::DMatrix;

use super::{Invariants, Pair};
use crate::math::sparse::SparseRows;

/// Curved paths point by point, for the full equations: `r = H_j q_j + Ψ_e y_e` with `y_e = ½ qᵀΓ^e q`. (K12)
///
/// Represented as a body of more coordinates on straight paths, the last of which follow the others.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvedPaths {
    /// Invariants of the body on straight paths: coordinates of the body, then the fields `Ψ_e`.
    pub straight: Invariants,
    /// Coordinates that the fields follow.
    pub coordinates: Range<usize>,
    /// `Γ^e` over those coordinates, symmetric, row by row.
    pub forms: Vec<Vec<f64>>,
}

impl CurvedPaths {
    /// Number of fields.
    #[must_use]
    pub fn fields(&self) -> usize {
        self.forms.len()
    }

    /// Sets the values `y_e` of the fields at displacements of all coordinates, and their slopes `∂y_e/∂q_j`, a row for each field. (K12)
    pub(super) fn follow(&self, q: &[f64], y: &mut [f64], slopes: &mut DMatrix<f64>) {
        let curving = &q[self.coordinates.clone()];
        let size = curving.len();
        for (e, form) in self.forms.iter().enumerate() {
            y[e] = 0.0;
            for (j, row) in form.chunks_exact(size.max(1)).enumerate() {
                let slope: f64 = row.iter().zip(curving).map(|(form, q)| form * q).sum();
                slopes[(e, self.coordinates.start + j)] = slope;
                y[e] += 0.5 * slope * curving[j];
            }
        }
    }

    /// Paths in a body with these of `all` coordinates kept and the others locked; none if coordinates of the paths are locked.
    pub(super) fn locked(&self, all: usize, kept: &Range<usize>) -> Option<Self> {
        let Range { start, end } = self.coordinates;
        if !(kept.start <= start && end <= kept.end) {
            return None;
        }
        let places: Vec<usize> = kept.clone().chain(all..all + self.fields()).collect();
        let place = |j: usize| places.iter().position(|place| *place == j);
        let Invariants { mass, J, S, h, J1, pairs } = &self.straight;
        let pairs: Vec<(usize, usize, Pair)> =
            pairs.iter().filter_map(|(j, k, pair)| Some((place(j)?, place(k)?, *pair))).collect();
        let straight = Invariants {
            mass: *mass,
            J: *J,
            S: places.iter().map(|j| S[*j]).collect(),
            h: places.iter().map(|j| h[*j]).collect(),
            J1: places.iter().map(|j| J1[*j]).collect(),
            pairs: SparseRows::sum(places.len(), pairs),
        };
        let coordinates = start - kept.start..end - kept.start;
        Some(Self { straight, coordinates, forms: self.forms.clone() })
    }
}
