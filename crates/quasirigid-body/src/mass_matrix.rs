//! Mass matrices of a flexible body: with the translation of a free body eliminated (S6), and with the body free to recoil
//! in rotation (V2).

use super::{FlexibleBody, Invariants};
use crate::math::eigen::Dense;
use crate::math::sym3::Sym;
use crate::math::{sym3, vec3};

impl FlexibleBody {
    /// `A x`, with the translation of a free body eliminated. (S6)
    #[must_use]
    pub fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let Invariants { pairs, S, .. } = self.invariants();
        let row = |j: usize| pairs.row(j).map(|(k, pair)| pair.A * x[k]).sum();
        let mut force: Vec<f64> = (0..x.len()).map(row).collect();
        if let Some(per_mass) = self.translation() {
            let moment = S.iter().zip(x).fold([0.0; 3], |sum, (S, x)| vec3::add(sum, vec3::scale(*x, *S)));
            force.iter_mut().zip(S).for_each(|(force, S)| *force -= per_mass * vec3::dot(*S, moment));
        }
        force
    }

    /// `(A − h J⁻¹ hᵀ) x`: mass matrix of the body free to recoil in rotation, times a vector. (V2)
    #[must_use]
    pub fn recoiling_mass_times(&self, x: &[f64]) -> Vec<f64> {
        let Invariants { J, h, .. } = self.invariants();
        let angular_momentum =
            h.iter().zip(x).fold([0.0; 3], |sum, (h, x)| vec3::add(sum, vec3::scale(*x, *h)));
        let turn = sym3::times(sym3::inverse(*J), angular_momentum);
        self.mass_times(x).iter().zip(h).map(|(force, h)| force - vec3::dot(*h, turn)).collect()
    }

    /// Mass matrix `A` with the translation of a free body eliminated, `A − S Sᵀ/m*`. (S6)
    #[must_use]
    pub fn mass_matrix(&self) -> Dense {
        let mut A = Dense::zero(self.coordinates().len());
        for (row, column, pair) in self.invariants().pairs.iter() {
            A.add(row, column, pair.A);
        }
        if let Some(per_mass) = self.translation() {
            for (row, S_row) in self.invariants().S.iter().enumerate() {
                for (column, S_column) in self.invariants().S.iter().enumerate() {
                    A.add(row, column, -per_mass * vec3::dot(*S_row, *S_column));
                }
            }
        }
        A
    }

    /// Mass matrix of the cyclic coordinates alone.
    #[must_use]
    pub fn cyclic_mass(&self) -> Dense {
        let cyclic = self.cyclic();
        let mut A = Dense::zero(cyclic.len());
        for j in cyclic.clone() {
            for (k, pair) in self.invariants().pairs.row(j).filter(|(k, _)| cyclic.contains(k)) {
                A.add(j - cyclic.start, k - cyclic.start, pair.A);
            }
        }
        A
    }

    /// Mass matrix of the cyclic coordinates with the body free to recoil in rotation. (V2)
    #[must_use]
    pub fn recoiling_cyclic_mass(&self) -> Dense {
        recoiling(self.cyclic_mass(), &self.invariants().h[self.cyclic()], self.invariants().J)
    }

    /// Mass matrix with the body free to recoil in rotation, `A − h J⁻¹ hᵀ`. (V2)
    #[must_use]
    pub fn recoiling_mass_matrix(&self) -> Dense {
        let Invariants { J, h, .. } = self.invariants();
        recoiling(self.mass_matrix(), h, *J)
    }
}

/// `A − h J⁻¹ hᵀ`. (V2)
fn recoiling(mut A: Dense, h: &[[f64; 3]], J: Sym) -> Dense {
    let inverse = sym3::inverse(J);
    for (row, h_row) in h.iter().enumerate() {
        let turn = sym3::times(inverse, *h_row);
        for (column, h_column) in h.iter().enumerate() {
            A.add(row, column, -vec3::dot(turn, *h_column));
        }
    }
    A
}
